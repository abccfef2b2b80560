//! Filtering samples that read blocks of texels: 4 x 4 by a cubic kernel, and across the border of a texture that is wrapped
//! 2 x 2 or one; with one tap or several.
//!
//! ```text
//!      o   o   o   o        o texels with their weights, products of a column's and a row's
//!      o   o   o   o        # the sample
//!            #
//!      o   o   o   o        weights in the corners may be above zero again:
//!      o   o   o   o        below zero times below zero
//! ```
//!
//! First the weights of many samples are found, in vectors of samples; then their texels are added, in vectors of channels,
//! two rows and two columns at a time as `sample_filter` does. Each number is that of `bilinear::each`, whatever the
//! vectors' width. Blocks that reach beyond the level are put together texel by texel, by what stands there.
//!
//! Some weights are below zero, so that a sum may be no colour. It is clamped once, when everything that a sample reads is in
//! it: alpha to what there can be, then each premultiplied channel to alpha. So a texel that shines through never becomes
//! brighter than it could be over black.

#![expect(
    clippy::inline_always,
    reason = "a function that is not inlined into its dispatch loses the vector instructions"
)]

use fearless_simd::prelude::*;
use fearless_simd::{Simd, i32x8, u8x16, u8x32};

use super::bilinear::per_tap;
use super::cubic::{TexelWeights, WHOLE};
use super::filter_plan::{Axis, GridLevel, Plan};
use super::fixed_point::{FRACTION_BITS, MASS, tap_offset};
use super::sample_filter::{BLOCK, SampleVector, by_fours};
use super::simd_channels::{FromColors, Spread, both_columns, in_columns, mean, round};
use super::texel_coordinates::{Positions, columns_and_rows, in_texture};
use super::wrap::{Endless, outside};
use super::{MipLevel, PixelSampling, Wrap};

/// Texels on each axis of a block across a border, and of one that a cubic kernel reads.
const SMALL: usize = 2;
const LARGE: usize = 4;
/// Stands for the offset of a block that reaches beyond the level.
const BEYOND: i32 = -1;
const HALF: i32 = 1 << (FRACTION_BITS - 1);

/// Where the samples of a block read one level.
struct Cells {
    /// The first texel of each sample's block, or [`BEYOND`].
    offsets: [i32; BLOCK],
    /// Its column, and its row.
    corners: [[i32; BLOCK]; 2],
    /// The weights of 2 x 2 texels each, as [`Spread::columns`] takes them: upper left, upper right, lower left, lower right.
    /// Small blocks have the first ones alone.
    weights: [[u64; BLOCK]; 4],
}

/// One tap of every sample in one level.
#[derive(Clone, Copy)]
struct Tap<'p> {
    plan: &'p Plan<'p>,
    weights: &'p TexelWeights,
    level: &'p GridLevel<'p>,
    number: u32,
}

/// Filters samples; see [`super::Filter::points`].
#[inline(always)]
pub(super) fn filter_with<S: Simd, C: FromColors>(
    simd: S,
    plan: &Plan<'_>,
    weights: &TexelWeights,
    points: &[[u16; 2]],
    out: &mut [C],
) {
    if plan.pixel.cubic().is_none() {
        filter_blocks::<S, C, SMALL>(simd, plan, weights, points, out);
    } else {
        filter_blocks::<S, C, LARGE>(simd, plan, weights, points, out);
    }
}

/// The same with blocks of `SIDE x SIDE` texels.
#[inline(always)]
fn filter_blocks<S: Simd, C: FromColors, const SIDE: usize>(
    simd: S,
    plan: &Plan<'_>,
    weights: &TexelWeights,
    points: &[[u16; 2]],
    out: &mut [C],
) {
    let spread = Spread::new(simd);
    let count = plan.line.taps.count;
    let scale = per_tap(count);
    let mut cells = Cells::EMPTY;
    for (points, out) in points.chunks(BLOCK).zip(out.chunks_mut(BLOCK)) {
        // Even and odd columns of each sample.
        let mut sums = [i32x8::splat(simd, 0); BLOCK];
        for level in [Some(&plan.finer), plan.coarser.as_ref()].into_iter().flatten() {
            let centres = centres(simd, plan, level, points);
            for number in 0..count {
                let tap = Tap {
                    plan,
                    weights,
                    level,
                    number,
                };
                cells.fill::<S, SIDE>(simd, tap, &centres, points.len());
                for (i, sum) in sums.iter_mut().enumerate().take(points.len()) {
                    *sum += cells.sum::<S, SIDE>(simd, spread, (plan, level.level), i);
                }
            }
        }
        by_fours!(simd, out, |i| {
            let at = |k: usize| sums[(i + k) % BLOCK];
            let low = clamped(simd, both_columns(at(0), at(1)), count);
            let high = clamped(simd, both_columns(at(2), at(3)), count);
            if count == 1 {
                round(simd, low, high)
            } else {
                mean(simd, low, high, scale)
            }
        });
    }
}

/// Where the samples of a block lie in a level, in fixed point: columns, then rows; not yet inside it where taps are added.
type Centres = [[i32; BLOCK]; 2];

#[inline(always)]
fn centres<S: Simd>(simd: S, plan: &Plan<'_>, level: &GridLevel<'_>, points: &[[u16; 2]]) -> Centres {
    let lanes = S::u32s::LEN;
    let last = points.len().saturating_sub(lanes);
    let mut centres = [[0; BLOCK]; 2];
    for first in (0..points.len()).step_by(lanes) {
        // The last vector begins earlier rather than to be short.
        let first = first.min(last);
        let at = Positions::new(simd, columns_and_rows(simd, &points[first..]), plan.first);
        for (centres, axis) in centres.iter_mut().zip([&level.x, &level.y]) {
            let places = match (plan.endless(axis), plan.line.taps.count) {
                (Some(endless), _) => at.endless(simd, axis, &endless),
                (None, 1) => at.near(simd, axis, FRACTION_BITS),
                (None, _) => at.far(simd, axis),
            };
            places.store_slice(&mut centres[first..first + lanes]);
        }
    }
    centres
}

/// Sums of two samples as what a colour can be: see the module.
#[inline(always)]
fn clamped<S: Simd>(simd: S, sums: i32x8<S>, taps: u32) -> i32x8<S> {
    /// Alpha, which is the last channel, in the place of each.
    const ALPHA: [u8; 32] = [
        12, 13, 14, 15, 12, 13, 14, 15, 12, 13, 14, 15, 12, 13, 14, 15, 12, 13, 14, 15, 12, 13, 14, 15, 12, 13, 14, 15,
        12, 13, 14, 15,
    ];
    let most = i32::from(u8::MAX) * MASS * taps.cast_signed();
    let inside = sums.max(i32x8::splat(simd, 0)).min(i32x8::splat(simd, most));
    let alpha = inside
        .bitcast::<u8x32<S>>()
        .swizzle_dyn_within_blocks(u8x32::simd_from(simd, ALPHA));
    inside.min(alpha.bitcast::<i32x8<S>>())
}

impl Cells {
    const EMPTY: Self = Self {
        offsets: [0; BLOCK],
        corners: [[0; BLOCK]; 2],
        weights: [[0; BLOCK]; 4],
    };

    /// Notes the cells of a tap of up to [`BLOCK`] samples.
    #[inline(always)]
    fn fill<S: Simd, const SIDE: usize>(&mut self, simd: S, tap: Tap<'_>, centres: &Centres, count: usize) {
        let lanes = S::u32s::LEN;
        let last = count.saturating_sub(lanes);
        let (right, down) = (Step::new(tap, &tap.level.x), Step::new(tap, &tap.level.y));
        for first in (0..count).step_by(lanes) {
            let first = first.min(last);
            let [columns, rows] = centres;
            let x = S::i32s::from_slice(simd, &columns[first..first + lanes]);
            let y = S::i32s::from_slice(simd, &rows[first..first + lanes]);
            let at = [right.place(simd, x), down.place(simd, y)];
            self.note::<S, SIDE>(simd, tap, SampleVector { at, first });
        }
    }

    /// Notes the cells of a vector of samples.
    #[inline(always)]
    fn note<S: Simd, const SIDE: usize>(&mut self, simd: S, tap: Tap<'_>, vector: SampleVector<S>) {
        let Tap {
            plan, weights, level, ..
        } = tap;
        let SampleVector { at: [x, y], first } = vector;
        let lanes = S::u32s::LEN;
        let number = |value| S::i32s::splat(simd, value);
        let (before, side) = if SIDE == SMALL { (0, 2) } else { (1, 4) };
        let (left, top) = (
            (x >> FRACTION_BITS) - number(before),
            (y >> FRACTION_BITS) - number(before),
        );
        left.store_slice(&mut self.corners[0][first..first + lanes]);
        top.store_slice(&mut self.corners[1][first..first + lanes]);
        let farthest = |size: u32| number(size.cast_signed() - side);
        let inside = left.simd_ge(number(0))
            & top.simd_ge(number(0))
            & left.simd_le(farthest(level.level.width()))
            & top.simd_le(farthest(level.level.height()));
        let offsets = top * number(level.level.stride().cast_signed()) + left;
        let offsets = inside.select(offsets, number(BEYOND));
        offsets.store_slice(&mut self.offsets[first..first + lanes]);

        let fraction = number((1 << FRACTION_BITS) - 1);
        if SIDE == SMALL {
            // Without its fraction a coordinate weighs its own texel alone.
            let kept = match plan.pixel {
                PixelSampling::Nearest => number(0),
                _ => fraction,
            };
            let lower = share(simd, number(level.mass), y & kept);
            let upper = number(level.mass) - lower;
            let right = share(simd, upper, x & kept) | share(simd, lower, x & kept) << 16;
            // No part of a difference is negative, so that nothing is borrowed from the upper half.
            let left = (upper | lower << 16) - right;
            return self.keep::<S>(0, first, in_columns::<S>(left, right));
        }
        let columns = axis_weights(simd, weights, x & fraction);
        let rows = shares(simd, axis_weights(simd, weights, y & fraction), number(level.mass));
        for (half, rows) in rows.as_chunks::<2>().0.iter().enumerate() {
            let (upper, lower) = (shares(simd, columns, rows[0]), shares(simd, columns, rows[1]));
            let [first_column, second, third, fourth] = in_pairs(simd, upper, lower);
            self.keep::<S>(2 * half, first, in_columns::<S>(first_column, second));
            self.keep::<S>(2 * half + 1, first, in_columns::<S>(third, fourth));
        }
    }

    /// Keeps the weights of a vector's quarters.
    #[inline(always)]
    fn keep<S: Simd>(&mut self, quarter: usize, first: usize, [low, high]: [S::u64s; 2]) {
        let lanes = S::u32s::LEN;
        let (first, second) = self.weights[quarter][first..first + lanes].split_at_mut(lanes / 2);
        low.store_slice(first);
        high.store_slice(second);
    }

    /// Red, green, blue and alpha of sample `i` in the units of the weights: even columns, then odd columns.
    #[inline(always)]
    fn sum<S: Simd, const SIDE: usize>(
        &self,
        simd: S,
        spread: Spread<S>,
        (plan, level): (&Plan<'_>, &MipLevel),
        i: usize,
    ) -> i32x8<S> {
        let i = i % BLOCK;
        let stride = level.stride() as usize;
        let quarter = |texels, quarter: usize| spread.columns(simd, texels, self.weights[quarter][i]);
        if SIDE == SMALL {
            let rows: [u8x16<S>; 2] = if let Ok(offset) = usize::try_from(self.offsets[i]) {
                // There is room for four.
                let texels = &level.texels()[offset..][..stride + LARGE];
                [0, stride].map(|row| u8x16::simd_from(simd, bytes(&texels[row..])))
            } else {
                let [upper, lower, ..] = self.beyond(plan.wrap, level, i);
                [upper, lower].map(|row| u8x16::simd_from(simd, bytes(&row)))
            };
            return quarter(rows[0].zip_low(rows[1]), 0);
        }
        let rows: [u8x16<S>; 4] = if let Ok(offset) = usize::try_from(self.offsets[i]) {
            let texels = &level.texels()[offset..][..3 * stride + LARGE];
            [0, 1, 2, 3].map(|row| u8x16::simd_from(simd, bytes(&texels[row * stride..])))
        } else {
            let rows = self.beyond(plan.wrap, level, i);
            rows.map(|row| u8x16::simd_from(simd, bytes(&row)))
        };
        let upper = quarter(rows[0].zip_low(rows[1]), 0) + quarter(rows[0].zip_high(rows[1]), 1);
        let lower = quarter(rows[2].zip_low(rows[3]), 2) + quarter(rows[2].zip_high(rows[3]), 3);
        upper + lower
    }

    /// A block of which some texels lie beyond the level.
    #[cold]
    #[inline(never)]
    fn beyond(&self, wrap: Wrap, level: &MipLevel, i: usize) -> [[[u8; 4]; LARGE]; LARGE] {
        let [left, top] = self.corners.map(|corners| corners[i % BLOCK]);
        [0, 1, 2, 3].map(|y| [0, 1, 2, 3].map(|x| level.wrapped(wrap, [left + x, top + y])))
    }
}

/// How far a tap lies from its samples on an axis, and what becomes of places beyond the border.
#[derive(Clone, Copy)]
struct Step {
    offset: i32,
    /// Between these lie places where the border's texels go on.
    ends: [i32; 2],
    endless: Option<Endless>,
}

impl Step {
    #[inline(always)]
    fn new(Tap { plan, number, .. }: Tap<'_>, axis: &Axis) -> Self {
        let offset = match plan.line.taps.count {
            1 => 0.0,
            _ => axis.tap(&plan.line, number),
        };
        let endless = plan.endless(axis);
        Self {
            offset: endless.map_or_else(|| tap_offset(offset), |endless| endless.offset(offset)),
            ends: [-outside(plan.pixel), axis.last + outside(plan.pixel)].map(tap_offset),
            endless,
        }
    }

    /// Where taps lie whose samples lie there; see `wrap::place`.
    #[inline(always)]
    fn place<S: Simd>(&self, simd: S, centre: S::i32s) -> S::i32s {
        let number = |value| S::i32s::splat(simd, value);
        let place = centre + number(self.offset);
        let Some(endless) = &self.endless else {
            return place.max(number(self.ends[0])).min(number(self.ends[1]));
        };
        in_texture(simd, endless, place) - number(endless.fixed_centre)
    }
}

/// The weights of the first, the third and the fourth texel of an axis; see [`TexelWeights::shares`].
#[inline(always)]
fn axis_weights<S: Simd>(simd: S, weights: &TexelWeights, fractions: S::i32s) -> [S::i32s; 3] {
    let t = S::f32s::float_from(fractions);
    let [first, third, fourth] = weights.polynomials;
    // No closure for all of them: it would not be inlined.
    [
        polynomial(simd, first, t),
        polynomial(simd, third, t),
        polynomial(simd, fourth, t),
    ]
}

#[inline(always)]
fn polynomial<S: Simd>(simd: S, [cube, square, linear, constant]: [f32; 4], t: S::f32s) -> S::i32s {
    let number = |value| S::f32s::splat(simd, value);
    let weight = ((number(cube) * t + number(square)) * t + number(linear)) * t + number(constant);
    let bits: S::i32s = (weight + number(WHOLE)).bitcast();
    bits - S::i32s::splat(simd, WHOLE.to_bits().cast_signed())
}

/// How totals are shared by four texels; see [`TexelWeights::shares`].
#[inline(always)]
fn shares<S: Simd>(simd: S, [first, third, fourth]: [S::i32s; 3], total: S::i32s) -> [S::i32s; 4] {
    let (first, third, fourth) = (
        share(simd, total, first),
        share(simd, total, third),
        share(simd, total, fourth),
    );
    [first, total - first - third - fourth, third, fourth]
}

/// See `fixed_point::share`.
#[inline(always)]
fn share<S: Simd>(simd: S, total: S::i32s, part: S::i32s) -> S::i32s {
    (total * part + S::i32s::splat(simd, HALF)) >> FRACTION_BITS
}

/// Weights of the same column in two rows as one number each, the upper row's in the lower half.
#[inline(always)]
fn in_pairs<S: Simd>(simd: S, upper: [S::i32s; 4], lower: [S::i32s; 4]) -> [S::i32s; 4] {
    // Weights below zero are as many bits in the lower half as in the upper one.
    let low = S::i32s::splat(simd, 0xFFFF);
    [
        upper[0] & low | lower[0] << 16,
        upper[1] & low | lower[1] << 16,
        upper[2] & low | lower[2] << 16,
        upper[3] & low | lower[3] << 16,
    ]
}

/// Four texels.
#[inline(always)]
fn bytes(texels: &[[u8; 4]]) -> [u8; 16] {
    let mut bytes = [0; 16];
    bytes.copy_from_slice(texels[..4].as_flattened());
    bytes
}
