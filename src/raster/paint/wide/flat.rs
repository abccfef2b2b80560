//! Pixels in the middle of pixels that all show one and the same colour: whatever these weigh, the sum is that colour.
//!
//! They are found by their colours, or, before there are any, by their surfaces.
//!
//! ```text
//!      a a a a b        of a row: whole pixels with as many like them to the right as lie around a pixel
//!      a a a a b        of two rows: pixels like those above
//!      a a a a a        margin 1: all nine of 3 x 3, three times across and twice down
//! ```

#![expect(
    clippy::inline_always,
    reason = "only what is inlined into a dispatched function is compiled for its vector instructions"
)]

use std::ops::Range;

use fearless_simd::prelude::*;
use fearless_simd::{Simd, dispatch, u8x16, u64x8};

use crate::color::Premultiplied16;
use crate::raster::paint::sample_colors::SampleColors;
use crate::simd;

/// Which pixels of a tile are flat.
#[derive(Debug, Default)]
pub(in crate::raster::paint) struct FlatPixels {
    /// Pixels in a row of the tile.
    width: usize,
    /// Row by row, which pixels are not flat.
    mixed: Vec<PixelBits>,
    /// Of each painted row which pixels start as many as lie around one that show one colour, and which of these show the
    /// colour of the row above.
    across: Vec<u128>,
    down: Vec<u128>,
    /// Of each painted row which pixels are not split.
    whole: Vec<u128>,
}

/// What of a painted row is alike, the first pixel in the lowest bit; nobody asks for bits beyond the last pixel.
#[derive(Clone, Copy, Debug)]
pub(in crate::raster::paint) struct RowLikeness {
    /// Pixels that are not split.
    pub(in crate::raster::paint) whole: u128,
    /// Of these the ones that show what the next pixel shows, which is not split either.
    pub(in crate::raster::paint) pairs: u128,
    /// And those that show what the pixel above shows, which need not be right where that is split.
    pub(in crate::raster::paint) above: u128,
}

/// Some pixels of a row of a tile.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(in crate::raster::paint) struct PixelBits(u64);

impl PixelBits {
    pub(in crate::raster::paint) const ALL: Self = Self(u64::MAX);

    /// The first pixel in the lowest bit.
    pub(super) fn new(bits: u64) -> Self {
        Self(bits)
    }

    /// The first pixel in the lowest bit.
    pub(in crate::raster::paint) fn word(self) -> u64 {
        self.0
    }

    /// Those of the first `count`.
    pub(in crate::raster::paint) fn first(self, count: usize) -> Self {
        Self(self.0 & u64::MAX >> (64 - count.clamp(1, 64)))
    }

    /// Those of either.
    pub(in crate::raster::paint) fn union(self, other: Self) -> Self {
        Self(self.0 | other.0)
    }

    pub(in crate::raster::paint) fn is_empty(self) -> bool {
        self.0 == 0
    }

    /// How many there are.
    pub(in crate::raster::paint) fn count(self) -> usize {
        self.0.count_ones() as usize
    }

    pub(in crate::raster::paint) fn contains(self, x: usize) -> bool {
        x < 64 && self.0 >> x & 1 == 1
    }

    /// These, and as many to the right of each.
    pub(in crate::raster::paint) fn widened(self, by: usize) -> Self {
        Self((0..=by.min(63)).fold(0, |all, by| all | self.0 << by))
    }

    /// The others of the first `count`.
    pub(in crate::raster::paint) fn others(self, count: usize) -> Self {
        Self(!self.0).first(count)
    }

    /// The pixels as runs side by side, from left to right.
    pub(in crate::raster::paint) fn runs(self) -> impl Iterator<Item = Range<usize>> {
        let mut rest = self.0;
        let mut at = 0;
        std::iter::from_fn(move || {
            if rest == 0 {
                return None;
            }
            let gap = rest.trailing_zeros();
            rest >>= gap;
            let length = rest.trailing_ones();
            rest = rest.checked_shr(length).unwrap_or(0);
            let start = at + gap as usize;
            at = start + length as usize;
            Some(start..at)
        })
    }
}

impl FlatPixels {
    /// Looks at a tile that was painted with so many pixels around it.
    pub(super) fn find(&mut self, colors: &SampleColors, margin: usize) {
        let level = simd::level();
        self.begin(colors.width(), margin);
        for y in 0..colors.rect.y.length() {
            let (row, is_split) = colors.row(y);
            let above = y.checked_sub(1).map(|above| colors.row(above));
            if above.is_some_and(|(above, was_split)| above == row && was_split == is_split) {
                self.repeat();
                continue;
            }
            let whole_here = dispatch!(level, simd => whole(simd, is_split));
            let pairs = dispatch!(level, simd => alike(simd, &row[..row.len() - 1], &row[1..]));
            let above = above.map_or(
                0,
                |(above, was_split)| dispatch!(level, simd => alike(simd, row, above) & whole(simd, was_split)),
            );
            self.push(
                RowLikeness {
                    whole: whole_here,
                    pairs: pairs & whole_here & whole_here >> 1,
                    above,
                },
                margin,
            );
        }
        self.finish(margin);
    }

    /// Starts a tile of which so many pixels of a row are painted, `margin` of them on each side of its own.
    #[inline]
    pub(in crate::raster::paint) fn begin(&mut self, painted: usize, margin: usize) {
        self.width = painted - 2 * margin;
        self.across.clear();
        self.down.clear();
        self.whole.clear();
    }

    /// Notes the next painted row, from above.
    #[inline]
    pub(in crate::raster::paint) fn push(&mut self, row: RowLikeness, margin: usize) {
        let across = shifted(row.pairs, 2 * margin) & row.whole;
        self.across.push(across);
        // Above, too, they are whole where they start as many that are; elsewhere nobody asks.
        self.down.push(across & row.above);
        self.whole.push(row.whole);
    }

    /// Notes a row that shows what the one above shows.
    #[inline]
    pub(in crate::raster::paint) fn repeat(&mut self) {
        let across = self.across.last().copied().unwrap_or(0);
        self.across.push(across);
        self.down.push(across);
        self.whole.push(self.whole.last().copied().unwrap_or(0));
    }

    /// Finds the flat pixels once all rows are noted.
    #[inline]
    pub(in crate::raster::paint) fn finish(&mut self, margin: usize) {
        let beside = 2 * margin;
        let rows = self.across.len().saturating_sub(beside);
        self.mixed.clear();
        self.mixed.extend((0..rows).map(|y| {
            let flat = self.down[y + 1..][..beside]
                .iter()
                .fold(self.across[y], |flat, down| flat & down);
            PixelBits(low(flat)).others(self.width)
        }));
    }

    /// Notes that the pixel in column `x` and row `y` of the tile is not flat.
    pub(in crate::raster::paint) fn mix(&mut self, [x, y]: [usize; 2]) {
        self.mixed[y].0 |= 1 << x;
    }

    /// Notes again which pixels are split, once samples were put.
    pub(in crate::raster::paint) fn note_split(&mut self, colors: &SampleColors) {
        let level = simd::level();
        for (y, found) in self.whole.iter_mut().enumerate() {
            let (_, is_split) = colors.row(y);
            *found = dispatch!(level, simd => whole(simd, is_split));
        }
    }

    /// Whether all pixels are flat.
    pub(in crate::raster::paint) fn are_all(&self) -> bool {
        self.mixed.iter().all(|row| row.is_empty())
    }

    /// Pixels in a row.
    pub(in crate::raster::paint) fn width(&self) -> usize {
        self.width
    }

    /// Rows of pixels.
    pub(in crate::raster::paint) fn height(&self) -> usize {
        self.mixed.len()
    }

    /// The columns around whose pixel in a painted row lies one that is not flat, up to `margin` rows above or below.
    pub(in crate::raster::paint) fn around(&self, painted: usize, margin: usize) -> PixelBits {
        let rows = painted.saturating_sub(2 * margin)..self.height().min(painted + 1);
        self.mixed[rows]
            .iter()
            .fold(PixelBits::default(), |all, row| all.union(*row))
    }

    /// The pixels of a painted row that are split, the first in the lowest bit, and anything beyond its last pixel.
    pub(super) fn split(&self, painted: usize) -> u128 {
        !self.whole[painted]
    }

    /// The pixels of a row that are not flat.
    pub(in crate::raster::paint) fn mixed(&self, y: usize) -> PixelBits {
        self.mixed[y]
    }
}

/// Which pixels are not split, the first in the lowest bit.
#[inline(always)]
fn whole<S: Simd>(simd: S, split: &[bool]) -> u128 {
    simd.vectorize(
        #[inline(always)]
        || {
            let (sixteens, rest) = split.as_chunks::<16>();
            let mut bits = 0;
            for (at, split) in sixteens.iter().enumerate() {
                let whole = u8x16::simd_from(simd, split.map(u8::from)).simd_eq(u8x16::splat(simd, 0));
                bits |= u128::from(whole.to_bitmask()) << (16 * at);
            }
            for (at, split) in (16 * sixteens.len()..).zip(rest) {
                bits |= u128::from(!split) << at;
            }
            bits
        },
    )
}

/// Which colours are those of another row, as long, in the same place; the first in the lowest bit.
#[inline(always)]
fn alike<S: Simd>(simd: S, colors: &[Premultiplied16], others: &[Premultiplied16]) -> u128 {
    simd.vectorize(
        #[inline(always)]
        || {
            debug_assert_eq!(colors.len(), others.len(), "as long");
            let (eights, rest) = colors.as_chunks::<8>();
            let (of_others, others) = others.as_chunks::<8>();
            let mut bits = 0;
            for (at, (colors, others)) in eights.iter().zip(of_others).enumerate() {
                let [colors, others] = [colors, others].map(|all| u64x8::simd_from(simd, all.map(word)));
                bits |= u128::from(colors.simd_eq(others).to_bitmask()) << (8 * at);
            }
            for (at, (color, other)) in (8 * eights.len()..).zip(rest.iter().zip(others)) {
                bits |= u128::from(color == other) << at;
            }
            bits
        },
    )
}

/// A colour's channels as one number.
#[inline(always)]
fn word(color: Premultiplied16) -> u64 {
    let [r, g, b, a] = color.0.map(u64::from);
    r | g << 16 | b << 32 | a << 48
}

/// Bits that are followed by ones: so many, with themselves.
#[inline]
fn shifted(bits: u128, count: usize) -> u128 {
    (0..count).fold(u128::MAX, |all, by| all & bits >> by)
}

/// The 64 lowest.
#[expect(clippy::cast_possible_truncation, reason = "that is what it is for")]
fn low(bits: u128) -> u64 {
    bits as u64
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::color::ResolveSpace;
    use crate::raster::SampleRate;
    use crate::raster::paint::sample_colors::{PixelColors, ShadedColors};
    use crate::raster::span::{Span, SpanRect};
    use crate::rules::Rules;

    #[test]
    fn runs_hold_the_pixels_in_order() {
        for bits in [0, 1, 0b1011, u64::MAX, 1 << 63, u64::MAX << 60 | 0b110] {
            let found: Vec<usize> = PixelBits(bits).runs().flatten().collect();
            let expected: Vec<usize> = (0..64).filter(|at| bits >> at & 1 == 1).collect();
            assert_eq!(found, expected, "{bits:b}");
            assert!(
                (0..72).all(|x| PixelBits(bits).contains(x) == expected.contains(&x)),
                "{bits:b}"
            );
        }
    }

    #[test]
    fn flat_pixels_are_those_around_which_all_show_one_colour() {
        let (mut flat_ones, mut mixed_ones) = (0, 0);
        arbtest::arbtest(|u| {
            let margin = u.int_in_range(0..=4)?;
            let size = [u.int_in_range(1..=64)?, u.int_in_range(1..=6)?];
            let [x, y] = size.map(|length| Span {
                start: 0,
                end: length + 2 * i32::try_from(margin).unwrap_or(0),
            });
            let mut colors = SampleColors::new(
                SampleRate::new(4).expect("a rate"),
                Rules::Standard,
                ResolveSpace::Stored,
            );
            let gray = |level: u8| Premultiplied16::from_bytes([level, level, level, 255]);
            colors.reset(SpanRect { x, y }, gray(0));
            for _ in 0..u.int_in_range(0..=4)? {
                let start = u.int_in_range(0..=x.end - 1)?;
                let pixels = Span {
                    start,
                    end: u.int_in_range(start + 1..=x.end)?,
                };
                let color = gray(u.int_in_range(0..=1)?);
                let mut split = vec![color; 4 * pixels.length()];
                split.iter_mut().step_by(4).for_each(|first| *first = gray(2));
                let rows = u.int_in_range(0..=y.end - 1)?..=y.end - 1;
                for row in rows {
                    if u.ratio(1, 8)? {
                        let opaque = true;
                        colors.write(pixels, row, ShadedColors { colors: &split, opaque });
                    } else {
                        colors.fill(pixels, row, color);
                    }
                }
            }
            let mut flat = FlatPixels::default();
            flat.find(&colors, margin);
            let [width, height] = size.map(|length| usize::try_from(length).unwrap_or(0));
            assert_eq!((flat.width(), flat.height()), (width, height), "the tile's own pixels");
            for (x, y) in (0..height).flat_map(|y| (0..width).map(move |x| (x, y))) {
                let around = (y..=y + 2 * margin).flat_map(|y| (x..=x + 2 * margin).map(move |x| (x, y)));
                let mut shown = around.map(|(x, y)| colors.pixel(y * colors.width() + x));
                let first = shown.next().expect("a pixel");
                let is_flat = matches!(first, PixelColors::Whole(_)) && shown.all(|other| other == first);
                assert_eq!(
                    !flat.mixed(y).contains(x),
                    is_flat,
                    "{x}, {y}, margin {margin}, {size:?}"
                );
                *(if is_flat { &mut flat_ones } else { &mut mixed_ones }) += 1;
            }
            Ok(())
        })
        .budget_ms(600);
        assert!(
            flat_ones > 100 && mixed_ones > 100,
            "{flat_ones} flat, {mixed_ones} mixed"
        );
    }
}
