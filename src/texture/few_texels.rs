//! Means over boxes of few texels, texel by texel, of sixteen samples at a time: quicker than sums at corners, of which every
//! sample has sixteen of its own.
//!
//! Which columns and rows a box holds parts of is the same question twice, so that a texel weighs the product of both answers:
//! each row is weighed by columns first.

#![expect(
    clippy::inline_always,
    reason = "a function that is not inlined into its dispatch loses the vector instructions"
)]

use fearless_simd::prelude::*;
use fearless_simd::{Simd, f32x16};
use glam::DVec2;

use super::sample_places::{LANES, Places, WeighSamples, rounded};
use super::texel_blocks::{BLOCK, EndlessLevel, Line};
use crate::color::Premultiplied16;

/// Columns, and rows, that are looked at together.
const MOST: usize = 16;

/// A level read by small boxes.
#[derive(Clone, Copy, Debug)]
pub(super) struct FewTexels<'a> {
    pub(super) texels: EndlessLevel<'a>,
    /// Width and height of the boxes in texels.
    pub(super) sides: DVec2,
    /// Whether all texels are opaque.
    pub(super) is_opaque: bool,
}

/// Where the boxes of some samples lie on an axis, in texels from a whole one near them.
struct Borders<S: Simd> {
    base: i32,
    from: f32x16<S>,
    to: f32x16<S>,
    /// The first texel, counted from `base`, and how many there are to the last.
    first: i32,
    count: usize,
}

impl FewTexels<'_> {
    /// Whether the samples of a pixel, which lie so far apart, have so few texels below them that this is quicker than a table.
    pub(super) fn are_enough(sides: DVec2, apart: DVec2) -> bool {
        /// Vector instructions for one sample more by a table, times sixteen.
        const MOST_WORK: f64 = 800.0;
        let count = sides + apart + 1.0;
        count.max_element() <= MOST as f64 && count.y * (count.x * 6.0 + 24.0) < MOST_WORK
    }
}

impl WeighSamples for FewTexels<'_> {
    #[inline(always)]
    fn channels<S: Simd>(&self, simd: S, places: &Places) -> Option<[f32x16<S>; 4]> {
        simd.vectorize(
            #[inline(always)]
            || {
                let [x, y] = places.near(self.texels.wrap, self.texels.size());
                let x = Borders::new(simd, &x, self.sides.x * 0.5)?;
                let y = Borders::new(simd, &y, self.sides.y * 0.5)?;
                Some(if self.is_opaque {
                    self.channels_by::<S, 3>(simd, &x, &y)
                } else {
                    self.channels_by::<S, 4>(simd, &x, &y)
                })
            },
        )
    }
}

impl FewTexels<'_> {
    /// As [`WeighSamples::channels`], of which some are not the greatest number.
    #[inline(always)]
    fn channels_by<S: Simd, const CHANNELS: usize>(&self, simd: S, x: &Borders<S>, y: &Borders<S>) -> [f32x16<S>; 4] {
        let nothing = f32x16::splat(simd, 0.0);
        let mut parts = [nothing; MOST];
        let mut column = x.first as f32;
        for part in &mut parts[..x.count.next_multiple_of(BLOCK)] {
            *part = x.part(simd, column);
            column += 1.0;
        }
        let left = x.base + x.first;
        let columns = [left, left + i32::try_from(x.count).unwrap_or(0) - 1];
        let mut sums = [nothing; CHANNELS];
        for row in (y.first..).take(y.count) {
            let texels = self.texels.line(Line::Row, y.base + row, columns);
            let mut in_row = [nothing; CHANNELS];
            for (number, parts) in parts.as_chunks::<BLOCK>().0.iter().enumerate().take(texels.blocks) {
                for (texel, part) in texels.block(simd, number).iter().zip(parts) {
                    for (sum, channel) in in_row.iter_mut().zip(texel) {
                        *sum += *part * *channel;
                    }
                }
            }
            let part = y.part(simd, row as f32);
            for (sum, in_row) in sums.iter_mut().zip(in_row) {
                *sum += in_row * part;
            }
        }
        let factor = narrow(f64::from(Premultiplied16::PER_BYTE) / self.sides.element_product());
        rounded(simd, sums, f32x16::splat(simd, factor))
    }
}

impl<S: Simd> Borders<S> {
    /// Of boxes twice `half` long about places, whose whole coordinates are centres; `None` where they lie too far apart.
    #[inline(always)]
    fn new(simd: S, at: &[f64; LANES], half: f64) -> Option<Self> {
        let base = (at[0] + 0.5 - half).floor();
        let (mut from, mut to) = ([0.0; LANES], [0.0; LANES]);
        for i in 0..LANES {
            let middle = at[i] + 0.5 - base;
            (from[i], to[i]) = (narrow(middle - half), narrow(middle + half));
        }
        let (from, to) = (f32x16::simd_from(simd, from), f32x16::simd_from(simd, to));
        let (first, end) = (from.reduce_min().floor(), to.reduce_max().ceil());
        (end - first <= MOST as f32).then(|| Self {
            base: whole(base),
            from,
            to,
            first: whole(first.into()),
            count: whole((end - first).into()).max(1).cast_unsigned() as usize,
        })
    }

    /// The parts of a texel that boxes hold.
    #[inline(always)]
    fn part(&self, simd: S, texel: f32) -> f32x16<S> {
        let held = self.to.min(f32x16::splat(simd, texel + 1.0)) - self.from.max(f32x16::splat(simd, texel));
        held.max(f32x16::splat(simd, 0.0))
    }
}

#[inline(always)]
#[expect(clippy::cast_possible_truncation, reason = "a place near a level")]
fn whole(at: f64) -> i32 {
    at as i32
}

#[inline(always)]
#[expect(clippy::cast_possible_truncation, reason = "distances of few texels")]
fn narrow(at: f64) -> f32 {
    at as f32
}
