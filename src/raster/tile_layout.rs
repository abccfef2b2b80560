//! How a frame is cut into tiles.

use crate::raster::SampleRate;
use crate::raster::span::{PixelRect, Span};

/// How a frame is cut into tiles.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct TileLayout {
    /// Sides of a tile in pixels: powers of two, so that finding a pixel's tile is a shift.
    width_log2: u32,
    height_log2: u32,
    /// Tiles in a row, rows of tiles.
    pub(crate) columns: u32,
    pub(crate) rows: u32,
}

impl TileLayout {
    /// Tiles whose samples, when every pixel is split, still stay in a core's cache: at most 260 kB at any rate.
    pub(crate) fn for_rate(rate: SampleRate, size: [u32; 2]) -> Self {
        let sides_log2 = match rate.side() {
            1..=4 => (6, 5),
            5 | 6 => (5, 4),
            7 | 8 => (4, 4),
            9..=11 => (4, 3),
            _ => (3, 3),
        };
        Self::new(sides_log2, size)
    }

    /// Tiles of `2^sides_log2` pixels, at most 64 wide.
    pub(crate) fn new((width_log2, height_log2): (u32, u32), size: [u32; 2]) -> Self {
        let count = |pixels: u32, log2: u32| pixels.div_ceil(1 << log2);
        Self {
            width_log2,
            height_log2,
            columns: count(size[0], width_log2),
            rows: count(size[1], height_log2),
        }
    }

    /// Sides of a tile in pixels, as powers of two.
    pub(crate) fn sides_log2(self) -> (u32, u32) {
        (self.width_log2, self.height_log2)
    }

    /// Rows of pixels in a row of tiles.
    pub(crate) fn tile_height(self) -> u32 {
        1 << self.height_log2
    }

    /// The tile columns or rows that a half-open, non-empty box of pixels touches, clipped to the frame.
    pub(crate) fn tiles_of(self, pixels: PixelRect) -> PixelRect {
        let range = |span: Span, log2: u32, count: u32| Span {
            start: (span.start >> log2).max(0),
            end: (((span.end - 1) >> log2) + 1).min(count.cast_signed()),
        };
        PixelRect {
            x: range(pixels.x, self.width_log2, self.columns),
            y: range(pixels.y, self.height_log2, self.rows),
        }
    }

    /// The pixels of a tile, clipped to a frame of `size`.
    pub(crate) fn pixels(self, column: u32, row: u32, size: [u32; 2]) -> PixelRect {
        let span = |index: u32, log2: u32, limit: u32| Span {
            start: (index << log2).cast_signed(),
            end: ((index + 1) << log2).min(limit).cast_signed(),
        };
        PixelRect {
            x: span(column, self.width_log2, size[0]),
            y: span(row, self.height_log2, size[1]),
        }
    }
}
