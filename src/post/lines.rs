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

/// The edges around 64 pixels of a row, or of a column: each word between the one before and the one after it.
#[derive(Clone, Copy, Debug)]
pub(super) struct LineWords {
    line: [u64; 3],
    /// What crosses lines: in the two rows before them, and in the two after.
    crossing: [[u64; 3]; 4],
}

impl LineWords {
    /// Around the pixels of word number `word` of the row, or column, `across`.
    #[inline]
    pub(super) fn new(edges: &Edges, axis: Axis, word: usize, across: i32) -> Self {
        let [line, crossing] = axis.sides();
        let bits = axis.bits(edges);
        let around = |word: usize| bits.around(word, across);
        let [before, own, after] = [around(word - 1), around(word), around(word + 1)];
        // Spelled out: compilers leave `map` of such arrays a function of its own.
        let crosses = |row: usize| [before[row][crossing], own[row][crossing], after[row][crossing]];
        Self {
            line: [before[2][line], own[2][line], after[2][line]],
            crossing: [crosses(0), crosses(1), crosses(2), crosses(3)],
        }
    }

    /// What crosses lines, on either side.
    #[inline]
    fn crossed(&self) -> [u64; 3] {
        let [_, far, near, _] = self.crossing;
        [far[0] | near[0], far[1] | near[1], far[2] | near[2]]
    }

    /// The lines of all edges of the 64 pixels, each with the pixel's bit. The pixels of a line share what crosses its ends.
    #[inline]
    pub(super) fn for_each_line(&self, mut each: impl FnMut(u32, Line)) {
        let (line, crossed) = (self.line, self.crossed());
        let goes_on = (line[1] << 1 | line[0] >> 63) & !crossed[1];
        let next_goes_on = (line[1] >> 1 | line[2] << 63) & !(crossed[1] >> 1 | crossed[2] << 63);
        let (mut begins, ends) = (line[1] & !goes_on, line[1] & !next_goes_on);
        let mut others = line[1];
        while begins != 0 {
            let begin = begins.trailing_zeros();
            begins &= begins - 1;
            let count = (ends >> begin).trailing_zeros() + 1;
            // Lines that go on in the next word, and those that no pixel sees whole, are followed from each pixel.
            if count > u32::from(LONGEST) + 1 {
                continue;
            }
            others &= !((u64::MAX >> (64 - count)) << begin);
            let ends = [self.end(64 + begin), self.end(64 + begin + count)];
            for (before, after) in (0..).zip((0..u8::try_from(count).unwrap_or(LONGEST)).rev()) {
                let lengths = [before, after];
                each(begin + u32::from(before), Line { lengths, ends });
            }
        }
        for bit in bits::ones(others) {
            each(bit, self.line(bit));
        }
    }

    /// The line that an edge of the pixel with this bit is part of.
    #[inline]
    pub(super) fn line(&self, bit: u32) -> Line {
        let (lines, crossed) = (self.line, self.crossed());
        // It goes on before a pixel that nothing crosses, where the one before has an edge.
        let goes_on = bits::up_to(bit, [lines[0], lines[1]]) << 1 & !bits::up_to(bit, [crossed[0], crossed[1]]);
        let before = goes_on.leading_ones().min(LONGEST.into());
        let goes_on = bits::after(bit, [lines[1], lines[2]]) & !bits::after(bit, [crossed[1], crossed[2]]);
        let after = goes_on.trailing_ones().min(LONGEST.into());
        // Counted from the word before.
        let (begin, end) = (64 + bit - before, 64 + bit + 1 + after);
        Line {
            lengths: [
                u8::try_from(before).unwrap_or(LONGEST),
                u8::try_from(after).unwrap_or(LONGEST),
            ],
            ends: [self.end(begin), self.end(end)],
        }
    }

    #[inline]
    fn end(&self, at: u32) -> End {
        let (word, bit) = ((at / 64) as usize, at % 64);
        let crosses = |row: usize| self.crossing[row][word % 3] >> bit & 1 != 0;
        End {
            near: crosses(2),
            far: crosses(1),
            goes_on: [crosses(3), crosses(0)],
        }
    }
}

impl Line {
    /// The line that an edge of the pixel at `place`, along the axis and across it, is part of.
    #[inline]
    pub(super) fn through(edges: &Edges, axis: Axis, [along, across]: [i32; 2]) -> Self {
        let (word, bit) = bits::place(along);
        LineWords::new(edges, axis, word, across).line(bit)
    }

    /// The number of its pattern among the sixteen that ends can make: a bit for each crossing edge, those on the own side
    /// first, those where it begins before those where it ends.
    pub(super) fn pattern(self) -> usize {
        let [begin, end] = self.ends;
        let bit = |crosses: bool, bit: usize| usize::from(crosses) << bit;
        bit(begin.near, 0) | bit(end.near, 1) | bit(begin.far, 2) | bit(end.far, 3)
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
        let [begin, end] = self.ends;
        let kept = |side: usize| 8 - lost[0] * u16::from(begin.goes_on[side]) - lost[1] * u16::from(end.goes_on[side]);
        [kept(0), kept(1)]
    }
}
