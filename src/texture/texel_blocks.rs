//! The texels of a level in blocks of four of a row or of a column, as floats: for filters that weigh areas.

#![expect(
    clippy::inline_always,
    reason = "a function that is not inlined into its dispatch loses the vector instructions"
)]

use fearless_simd::prelude::*;
use fearless_simd::{Simd, f32x8, i32x8, u8x16, u32x4, u32x8};

use super::{MipLevel, Wrap};

/// Texels of a line that are looked at together.
pub(super) const BLOCK: usize = 4;

/// A level, and what stands beyond it.
#[derive(Clone, Copy, Debug)]
pub(super) struct EndlessLevel<'a> {
    pub(super) level: &'a MipLevel,
    pub(super) wrap: Wrap,
}

/// Along what texels follow each other.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Line {
    Row,
    Column,
}

/// Texels of a line from one on, in whole blocks.
#[derive(Clone, Copy)]
pub(super) struct LineTexels<'a> {
    of: EndlessLevel<'a>,
    line: Line,
    /// Where the first one stands in the line, and the number of the line.
    first: [i32; 2],
    pub(super) blocks: usize,
    /// From the first one on, where those that are used lie inside the level; else none.
    inside: &'a [[u8; 4]],
}

impl Line {
    /// Along this line and across it, from columns and rows, or the other way round.
    #[inline(always)]
    pub(super) fn turned<T>(self, [x, y]: [T; 2]) -> [T; 2] {
        match self {
            Self::Row => [x, y],
            Self::Column => [y, x],
        }
    }
}

impl<'a> EndlessLevel<'a> {
    /// Width and height in texels.
    #[inline(always)]
    pub(super) fn size(self) -> [u32; 2] {
        [self.level.width(), self.level.height()]
    }

    /// The texels of a line by its number, from one to another.
    #[inline(always)]
    pub(super) fn line(self, line: Line, number: i32, [first, last]: [i32; 2]) -> LineTexels<'a> {
        let Self { level, wrap } = self;
        let count = last.saturating_sub(first).saturating_add(1).max(0).cast_unsigned() as usize;
        let mut found = LineTexels {
            of: self,
            line,
            first: [first, number],
            blocks: count.div_ceil(BLOCK),
            inside: &[],
        };
        let [length, lines] = line.turned(self.size());
        if first >= 0 && last < length.cast_signed() {
            let is_inside = 0 <= number && number < lines.cast_signed();
            let number = if is_inside { number } else { wrap.texel(number, lines) };
            let [x, y] = line.turned([first, number]).map(|at| at.cast_unsigned() as usize);
            found.inside = &level.texels()[y * level.stride() as usize + x..];
        }
        found
    }
}

impl LineTexels<'_> {
    /// The texels of a block, by its number.
    #[inline(always)]
    pub(super) fn block<S: Simd>(&self, simd: S, number: usize) -> [[f32; 4]; BLOCK] {
        let stride = self.of.level.stride() as usize;
        // After the last row of a level there is room for more than a block.
        let texels = match self.line {
            Line::Row => self.inside.get(number * BLOCK..(number + 1) * BLOCK),
            Line::Column => self
                .inside
                .get(number * BLOCK * stride..(number + 1) * BLOCK * stride - stride + 1),
        };
        let bytes: u8x16<S> = match (self.line, texels) {
            (Line::Row, Some(texels)) => {
                let mut bytes = [0; 4 * BLOCK];
                bytes.copy_from_slice(texels.as_flattened());
                u8x16::simd_from(simd, bytes)
            }
            // As numbers they go from register to register: a vector of what was just stored one by one has to wait for it.
            (Line::Column, Some(texels)) => in_vector(simd, |i| texels[i * stride]),
            (_, None) => {
                let texels = self.beyond(number);
                in_vector(simd, |i| texels[i])
            }
        };
        let words = bytes.widen();
        let halves: (u32x8<S>, u32x8<S>) = words.0.combine(words.1).widen();
        let mut found = [[0.0; 4]; BLOCK];
        for (found, half) in found.as_flattened_mut().chunks_mut(8).zip([halves.0, halves.1]) {
            half.bitcast::<i32x8<S>>().to_float::<f32x8<S>>().store_slice(found);
        }
        // From memory a number fills a vector in the instruction that uses it; the compiler would take vectors apart.
        std::hint::black_box(found)
    }

    #[inline(never)]
    fn beyond(&self, number: usize) -> [[u8; 4]; BLOCK] {
        let [first, line] = self.first;
        let at = |i: usize| first + i32::try_from(number * BLOCK + i).unwrap_or(0);
        std::array::from_fn(|i| self.of.level.wrapped(self.of.wrap, self.line.turned([at(i), line])))
    }
}

/// A block of texels by their numbers in it.
#[inline(always)]
fn in_vector<S: Simd>(simd: S, texel: impl Fn(usize) -> [u8; 4]) -> u8x16<S> {
    let words = [0, 1, 2, 3].map(|i| u32::from_le_bytes(texel(i)));
    u32x4::simd_from(simd, words).bitcast()
}
