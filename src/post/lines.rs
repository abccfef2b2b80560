//! Lines of edges along rows and columns: how far they go on from a pixel, and what crosses them where they end.
//!
//! ```text
//!     far    |                        a crossing edge beyond the line, `far`, where it begins
//!            +-----+-----+-----+      the line: top edges of pixels, here of three
//!     near          pixel      |      a crossing edge on the pixel's own side, `near`, where it ends
//!            <before><     after>     one pixel before this one, one after it
//! ```
//!
//! Columns are rows turned over the diagonal: left edges are lines then, and top edges cross them.

use super::bits::{self, Bits};
use super::edges::{Edges, LEFT, TOP};

/// Pixels that a line is followed in each direction: 16 steps of two.
pub(super) const LONGEST: u8 = 32;

/// Which way lines go.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Axis {
    /// Along a row: top edges.
    Row,
    /// Along a column: left edges.
    Column,
}

impl Axis {
    /// A pixel at this place along the line's axis and across it.
    #[inline]
    pub(super) fn pixel(self, [along, across]: [i32; 2]) -> [i32; 2] {
        match self {
            Self::Row => [along, across],
            Self::Column => [across, along],
        }
    }

    /// A pixel's place along the axis and across it.
    pub(super) fn place(self, pixel: [i32; 2]) -> [i32; 2] {
        self.pixel(pixel)
    }

    /// The edges by rows or columns along it.
    #[inline]
    fn bits(self, edges: &Edges) -> &Bits {
        match self {
            Self::Row => &edges.rows,
            Self::Column => &edges.columns,
        }
    }

    /// The edge that is part of a line, and the one that crosses it.
    #[inline]
    fn sides(self) -> [usize; 2] {
        match self {
            Self::Row => [TOP, LEFT],
            Self::Column => [LEFT, TOP],
        }
    }
}

/// An end of a line: which edges cross it there.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct End {
    /// On the side of the pixel itself.
    pub(super) near: bool,
    /// On the side of its neighbour beyond the line.
    pub(super) far: bool,
    /// Whether that on the own side goes on for another pixel, and that on the other.
    pub(super) goes_on: [bool; 2],
}

/// A line of edges, as one of its pixels sees it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Line {
    /// How many pixels it goes on to the left or upwards, and to the right or downwards: each at most [`LONGEST`].
    pub(super) lengths: [u8; 2],
    /// How it ends there.
    pub(super) ends: [End; 2],
}

impl Line {
    /// The line that an edge of the pixel at `place`, along the axis and across it, is part of.
    pub(super) fn through(edges: &Edges, axis: Axis, [along, across]: [i32; 2]) -> Self {
        let [line, crossing] = axis.sides();
        let bits = axis.bits(edges);
        let (number, bit) = bits::place(along);
        let near = [number - 1, number, number + 1].map(|word| {
            let own = bits.word(word, across);
            (own[line], own[crossing] | bits.word(word, across - 1)[crossing])
        });
        let [lines, crossed] = [near.map(|(line, _)| line), near.map(|(_, crossed)| crossed)];
        // It goes on before a pixel that nothing crosses, where the one before has an edge.
        let goes_on = bits::up_to(bit, [lines[0], lines[1]]) << 1 & !bits::up_to(bit, [crossed[0], crossed[1]]);
        let before = goes_on.leading_ones().min(LONGEST.into());
        let goes_on = bits::after(bit, [lines[1], lines[2]]) & !bits::after(bit, [crossed[1], crossed[2]]);
        let after = goes_on.trailing_ones().min(LONGEST.into());
        let [before, after] = [before, after].map(|length| u8::try_from(length).unwrap_or(LONGEST));
        let end_at = |along: i32| {
            let (word, bit) = bits::place(along);
            let crosses = |row: i32| bits.word(word, across + row)[crossing] >> bit & 1 != 0;
            End {
                near: crosses(0),
                far: crosses(-1),
                goes_on: [crosses(1), crosses(-2)],
            }
        };
        let (begin, end) = (along - i32::from(before), along + 1 + i32::from(after));
        Self {
            lengths: [before, after],
            ends: [end_at(begin), end_at(end)],
        }
    }

    /// The number of its pattern among the sixteen that ends can make: a bit for each crossing edge, those on the own side
    /// first, those where it begins before those where it ends.
    pub(super) fn pattern(self) -> usize {
        let [begin, end] = self.ends;
        [begin.near, end.near, begin.far, end.far]
            .into_iter()
            .enumerate()
            .map(|(bit, crosses)| usize::from(crosses) << bit)
            .sum()
    }

    /// What corners leave of the weight of each side, in eighths: a crossing edge that goes on is a corner of the shape, which
    /// must not be rounded off, and stands at the end that is nearer.
    pub(super) fn kept_by_corners(self) -> [u16; 2] {
        /// Three quarters: corners are rounded by 25 %.
        const CORNER: u16 = 6;
        let [before, after] = self.lengths;
        let lost = match before.cmp(&after) {
            std::cmp::Ordering::Less => [CORNER, 0],
            std::cmp::Ordering::Equal => [CORNER / 2; 2],
            std::cmp::Ordering::Greater => [0, CORNER],
        };
        [0, 1].map(|side| {
            let corners = self.ends.iter().zip(lost).filter(|(end, _)| end.goes_on[side]);
            8 - corners.map(|(_, lost)| lost).sum::<u16>()
        })
    }
}
