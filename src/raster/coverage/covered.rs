//! What a shape covers in a row of pixels whose samples lie off the grid.

use crate::raster::sampling::mask::SampleMask;
use crate::raster::span::Span;

/// What a shape covers in a row of pixels.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Covered {
    /// All samples of these pixels.
    Whole(Span),
    /// Some samples of the pixel in this column: neither none nor all.
    Part(i32, SampleMask),
}
