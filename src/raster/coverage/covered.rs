//! The one form in which painters get coverage: runs of pixels of which all samples are covered, and a mask for each pixel
//! on an edge.

use crate::raster::sampling::mask::SampleMask;
use crate::raster::span::{Span, SpanRect};

/// What a shape covers in a row of pixels.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Covered {
    /// All samples of these pixels.
    Whole(Span),
    /// Some samples of the pixel in this column: neither none nor all.
    Part(i32, SampleMask),
}

impl Covered {
    /// The pixels, in row `y`.
    #[inline]
    pub(crate) fn pixels(&self, y: i32) -> SpanRect {
        let one = |start: i32| Span { start, end: start + 1 };
        SpanRect {
            x: match self {
                Self::Whole(xs) => *xs,
                Self::Part(x, _) => one(*x),
            },
            y: one(y),
        }
    }

    /// How many samples these are, where a pixel has so many.
    #[inline]
    pub(crate) fn count(&self, per_pixel: usize) -> usize {
        match self {
            Self::Whole(xs) => xs.length() * per_pixel,
            Self::Part(_, mask) => mask.count(),
        }
    }
}
