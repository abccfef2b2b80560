//! How a frame is cut into tiles, and what is painted for each.
//!
//! Where pixels take samples of their neighbours, a tile is painted with a margin of pixels all around it. What is painted is
//! the frame with such a margin, and its columns and rows are counted from the margin's first: so a tile's own pixels have the
//! numbers in the frame that the first of its painted ones have in what is painted, and no number is below zero.
//!
//! ```text
//!      painted  0 1 2 3 4 5 6 7 8 9         margin 1, tiles of 4
//!      frame    . 0 1 2 3 4 5 6 7 .
//!      tile 0   < _ _ _ _ >
//!      tile 1           < _ _ _ _ >
//! ```

use crate::raster::SampleRate;
use crate::raster::span::{Span, SpanRect};

/// How a frame is cut into tiles.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct TileLayout {
    /// Sides of a tile in pixels: powers of two, so that finding a pixel's tile is a shift.
    width_log2: u32,
    height_log2: u32,
    /// Pixels on each side of a tile that are painted with it.
    margin: u32,
    /// Tiles in a row, rows of tiles.
    pub(crate) columns: u32,
    pub(crate) rows: u32,
}

impl TileLayout {
    /// Tiles whose samples, when every pixel is split, still stay in a core's cache: at most 260 kB at any rate.
    ///
    /// With a `margin` they are narrower, so that the margins, too, fit a row of surfaces.
    pub(crate) fn for_rate(rate: SampleRate, margin: u32, size: [u32; 2]) -> Self {
        let sides_log2 = match rate.side() {
            1..=4 if margin > 0 => [5, 5],
            1..=4 => [6, 5],
            5 | 6 => [5, 4],
            7 | 8 => [4, 4],
            9..=11 => [4, 3],
            _ => [3, 3],
        };
        Self::new(sides_log2, size)
    }

    /// Tiles of `2^sides_log2` pixels, at most 64 wide.
    pub(crate) fn new([width_log2, height_log2]: [u32; 2], size: [u32; 2]) -> Self {
        let count = |pixels: u32, log2: u32| pixels.div_ceil(1 << log2);
        Self {
            width_log2,
            height_log2,
            margin: 0,
            columns: count(size[0], width_log2),
            rows: count(size[1], height_log2),
        }
    }

    /// The same tiles, each painted with so many pixels on each side.
    pub(crate) fn with_margin(self, margin: u32) -> Self {
        Self { margin, ..self }
    }

    /// By how many pixels the painted ones of a tile reach into the next.
    pub(crate) fn overlap(self) -> i32 {
        2 * self.margin.cast_signed()
    }

    /// What is painted for a tile that has these pixels of the frame, as counted in what is painted.
    pub(crate) fn painted(self, pixels: SpanRect) -> SpanRect {
        let wider = |span: Span| Span {
            start: span.start,
            end: span.end + self.overlap(),
        };
        SpanRect {
            x: wider(pixels.x),
            y: wider(pixels.y),
        }
    }

    /// Sides of what is painted for a whole tile in pixels.
    pub(crate) fn painted_sides(self) -> [usize; 2] {
        [self.width_log2, self.height_log2].map(|log2| (1_usize << log2) + 2 * self.margin as usize)
    }

    /// Sides of a tile in pixels, as powers of two.
    pub(crate) fn sides_log2(self) -> [u32; 2] {
        [self.width_log2, self.height_log2]
    }

    /// Rows of pixels in a row of tiles.
    pub(crate) fn tile_height(self) -> u32 {
        1 << self.height_log2
    }

    /// The tile columns or rows for which a half-open, non-empty box of pixels is painted, clipped to the frame.
    pub(crate) fn tiles_of(self, pixels: SpanRect) -> SpanRect {
        let range = |span: Span, log2: u32, count: u32| Span {
            start: ((span.start - self.overlap()) >> log2).max(0),
            end: (((span.end - 1) >> log2) + 1).min(count.cast_signed()),
        };
        SpanRect {
            x: range(pixels.x, self.width_log2, self.columns),
            y: range(pixels.y, self.height_log2, self.rows),
        }
    }

    /// The pixels of a tile that are resolved, clipped to a frame of `size`.
    pub(crate) fn pixels(self, column: u32, row: u32, size: [u32; 2]) -> SpanRect {
        let span = |index: u32, log2: u32, limit: u32| Span {
            start: (index << log2).cast_signed(),
            end: ((index + 1) << log2).min(limit).cast_signed(),
        };
        SpanRect {
            x: span(column, self.width_log2, size[0]),
            y: span(row, self.height_log2, size[1]),
        }
    }
}
