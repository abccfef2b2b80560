//! Runs of columns or rows, and the rectangles that two of them make.
//!
//! ```text
//!      0   1   2   3   4   5
//!    |   | # | # | # |   |       start 1, end 4
//! ```

use crate::geometry::subpixel::{GridPoint, SubpixelGrid};
use crate::rules::Rules;

/// Sample columns and rows of the box that a small triangle fits in.
pub(crate) const SMALL: i32 = 8;

/// A half-open range of columns, or of rows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Span {
    /// The first.
    pub(crate) start: i32,
    /// One beyond the last; at or before `start` when empty.
    pub(crate) end: i32,
}

/// A half-open rectangle of columns and rows: of pixels, of samples or of tiles, as the name of what holds it says.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct SpanRect {
    /// The columns.
    pub(crate) x: Span,
    /// The rows.
    pub(crate) y: Span,
}

/// How much of a rectangle of samples a shape covers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Reach {
    /// It may cover some of the samples.
    Part,
    /// All samples.
    All,
}

impl Span {
    /// Whether nothing is in it.
    pub(crate) fn is_empty(self) -> bool {
        self.start >= self.end
    }

    /// Nothing: the union with it is the other span, the intersection is empty. Far enough from the ends of the numbers
    /// that columns of a frame may be added.
    pub(crate) const EMPTY: Self = Self {
        start: i32::MAX / 2,
        end: i32::MIN / 2,
    };

    /// The seed of an intersection.
    pub(in crate::raster) const EVERYTHING: Self = Self {
        start: i32::MIN,
        end: i32::MAX,
    };

    /// How many columns or rows it has.
    #[inline]
    pub(crate) fn length(self) -> usize {
        to_index(self.end.saturating_sub(self.start))
    }

    /// The smallest span that holds both.
    pub(crate) fn union(self, other: Self) -> Self {
        Self {
            start: self.start.min(other.start),
            end: self.end.max(other.end),
        }
    }

    /// What lies in both.
    pub(crate) fn intersection(self, other: Self) -> Self {
        Self {
            start: self.start.max(other.start),
            end: self.end.min(other.end),
        }
    }
}

impl Default for Span {
    fn default() -> Self {
        Self::EMPTY
    }
}

impl SpanRect {
    /// Nothing: the union with it is the other rectangle.
    pub(crate) const EMPTY: Self = Self {
        x: Span::EMPTY,
        y: Span::EMPTY,
    };

    /// Whether nothing is in it.
    #[inline]
    pub(crate) fn is_empty(self) -> bool {
        self.x.is_empty() || self.y.is_empty()
    }

    /// The smallest rectangle that holds both.
    pub(crate) fn union(self, other: Self) -> Self {
        Self {
            x: self.x.union(other.x),
            y: self.y.union(other.y),
        }
    }

    /// The columns and rows of samples between a triangle's least and greatest corner; empty in a direction in which it holds
    /// no sample.
    #[inline]
    pub(crate) fn of_samples([a, b, c]: [GridPoint; 3], grid: SubpixelGrid, rules: Rules) -> Self {
        let span = |a: i32, b: i32, c: i32| Span {
            start: grid.sample_at_or_after(a.min(b).min(c)),
            end: end_of(grid, a.max(b).max(c), rules),
        };
        Self {
            x: span(a.x, b.x, c.x),
            y: span(a.y, b.y, c.y),
        }
    }

    /// The columns and rows of samples that a triangle touches anything of, where a sample stands for all that lies around it:
    /// with one sample per pixel, the pixels.
    #[inline]
    pub(crate) fn of_touched([a, b, c]: [GridPoint; 3], grid: SubpixelGrid) -> Self {
        let span = |a: i32, b: i32, c: i32| Span {
            start: a.min(b).min(c) >> grid.bits(),
            end: (a.max(b).max(c) + (1 << grid.bits()) - 1) >> grid.bits(),
        };
        Self {
            x: span(a.x, b.x, c.x),
            y: span(a.y, b.y, c.y),
        }
    }

    /// What lies in both.
    #[inline]
    pub(crate) fn intersection(self, other: Self) -> Self {
        Self {
            x: self.x.intersection(other.x),
            y: self.y.intersection(other.y),
        }
    }

    /// Whether so many samples fit the bits of a coverage mask.
    #[inline]
    pub(crate) fn is_small(self) -> bool {
        self.x.end - self.x.start <= SMALL && self.y.end - self.y.start <= SMALL
    }
}

/// A distance inside a frame as an index; none is negative.
#[inline]
pub(crate) fn to_index(distance: i32) -> usize {
    distance.max(0).cast_unsigned() as usize
}

/// A span of pixels as a span of samples.
pub(crate) fn scaled(pixels: Span, side: i32) -> Span {
    Span {
        start: pixels.start * side,
        end: pixels.end * side,
    }
}

/// One beyond the last sample that belongs to what ends at `coordinate`.
pub(crate) fn end_of(grid: SubpixelGrid, coordinate: i32, rules: Rules) -> i32 {
    match rules {
        Rules::Standard | Rules::Float => grid.sample_at_or_after(coordinate),
        Rules::Course => grid.sample_after(coordinate),
    }
}
