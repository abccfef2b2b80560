//! Rectangles of a frame's pixels.

use crate::raster::span::{Span, SpanRect};

/// A rectangle of a frame's pixels: it covers `[x, x + width) x [y, y + height)`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Region {
    /// First column.
    pub x: u32,
    /// First row.
    pub y: u32,
    /// Columns.
    pub width: u32,
    /// Rows.
    pub height: u32,
}

impl Region {
    /// A whole frame of `size` pixels.
    pub const fn of_size([width, height]: [u32; 2]) -> Self {
        Self {
            x: 0,
            y: 0,
            width,
            height,
        }
    }

    /// A single pixel, in column `x` and row `y`.
    pub const fn of_pixel([x, y]: [u32; 2]) -> Self {
        Self {
            x,
            y,
            width: 1,
            height: 1,
        }
    }

    /// Column after the last.
    pub fn right(self) -> u32 {
        self.x.saturating_add(self.width)
    }

    /// Row after the last.
    pub fn bottom(self) -> u32 {
        self.y.saturating_add(self.height)
    }

    /// Whether it holds no pixel.
    pub fn is_empty(self) -> bool {
        self.width == 0 || self.height == 0
    }

    /// The pixels that both cover; empty where there are none.
    #[must_use]
    pub fn intersection(self, other: Self) -> Self {
        let (x, y) = (self.x.max(other.x), self.y.max(other.y));
        Self {
            x,
            y,
            width: self.right().min(other.right()).saturating_sub(x),
            height: self.bottom().min(other.bottom()).saturating_sub(y),
        }
    }

    /// The pixels of a tile, which lie inside the frame.
    pub(in crate::raster) fn of_tile(rect: SpanRect) -> Self {
        let length = |span: Span| (span.end - span.start).max(0).cast_unsigned();
        Self {
            x: rect.x.start.max(0).cast_unsigned(),
            y: rect.y.start.max(0).cast_unsigned(),
            width: length(rect.x),
            height: length(rect.y),
        }
    }
}
