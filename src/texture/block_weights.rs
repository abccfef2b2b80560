//! Which blocks of texels the samples of a vector read, and what each texel weighs: 4 x 4 texels for a cubic kernel, and 2 x 2
//! across the border of a texture that is wrapped.
//!
//! ```text
//!      weights of two rows, column by column      0 1 2 3
//!                                                 0 1 2 3      each with its neighbour below as one number
//! ```

#![expect(
    clippy::inline_always,
    reason = "a function that is not inlined into its dispatch loses the vector instructions"
)]

use fearless_simd::prelude::*;
use fearless_simd::{Simd, u8x16, u64x2};

use super::cubic::{TexelWeights, WHOLE};
use super::filter_plan::{Axis, GridLevel, Plan};
use super::fixed_point::{FRACTION_BITS, tap_offset};
use super::texel_coordinates::{Positions, in_texture};
use super::wrap::{Endless, outside};
use super::{MipLevel, PixelSampling, Wrap};

/// Texels on each axis of a block across a border, and of one that a cubic kernel reads.
pub(super) const SMALL: usize = 2;
pub(super) const LARGE: usize = 4;
const HALF: i32 = 1 << (FRACTION_BITS - 1);

/// One tap of every sample in one level.
#[derive(Clone, Copy)]
pub(super) struct Tap<'p> {
    pub(super) plan: &'p Plan<'p>,
    pub(super) weights: &'p TexelWeights,
    pub(super) level: &'p GridLevel<'p>,
    pub(super) number: u32,
}

/// Where the samples of a vector read a level.
pub(super) struct Blocks<S: Simd> {
    /// Column and row of the first texel.
    pub(super) corners: [S::i32s; 2],
    /// The weights of texels in pairs, the lower one's in the upper 16 bits: the columns of the first two rows, then those of
    /// the others. Small blocks have two pairs.
    pub(super) weights: [S::i32s; 8],
}

/// How far a tap lies from its samples on an axis, and what becomes of places beyond the border.
#[derive(Clone, Copy)]
pub(super) struct Step {
    offset: i32,
    /// Between these lie places where the border's texels go on.
    ends: [i32; 2],
    endless: Option<Endless>,
}

/// Where the taps of one number read a level whose samples have no other.
#[derive(Clone, Copy)]
pub(super) struct OneTap<'p> {
    pub(super) tap: Tap<'p>,
    right: Step,
    down: Step,
}

impl<'p> OneTap<'p> {
    #[inline(always)]
    pub(super) fn new(plan: &'p Plan<'p>, weights: &'p TexelWeights, level: &'p GridLevel<'p>) -> Self {
        let tap = Tap {
            plan,
            weights,
            level,
            number: 0,
        };
        Self {
            tap,
            right: Step::new(tap, &level.x),
            down: Step::new(tap, &level.y),
        }
    }

    /// Columns and rows, in fixed point.
    #[inline(always)]
    pub(super) fn places<S: Simd>(&self, simd: S, at: &Positions<S>) -> [S::i32s; 2] {
        let GridLevel { x, y, .. } = self.tap.level;
        let x = place_centres(simd, self.right.endless.as_ref(), 1, (at, x));
        let y = place_centres(simd, self.down.endless.as_ref(), 1, (at, y));
        [self.right.place(simd, x), self.down.place(simd, y)]
    }
}

impl Step {
    #[inline(always)]
    pub(super) fn new(Tap { plan, number, .. }: Tap<'_>, axis: &Axis) -> Self {
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
    pub(super) fn place<S: Simd>(&self, simd: S, centre: S::i32s) -> S::i32s {
        let number = |value| S::i32s::splat(simd, value);
        let place = centre + number(self.offset);
        let Some(endless) = &self.endless else {
            return place.max(number(self.ends[0])).min(number(self.ends[1]));
        };
        in_texture(simd, endless, place) - number(endless.fixed_centre)
    }
}

/// Where samples of so many taps lie on an axis, in fixed point; not yet inside the level where taps are added.
#[inline(always)]
pub(super) fn place_centres<S: Simd>(
    simd: S,
    endless: Option<&Endless>,
    taps: u32,
    (at, axis): (&Positions<S>, &Axis),
) -> S::i32s {
    match (endless, taps) {
        (Some(endless), _) => at.endless(simd, axis, endless),
        (None, 1) => at.near(simd, axis, FRACTION_BITS),
        (None, _) => at.far(simd, axis),
    }
}

impl<S: Simd> Blocks<S> {
    /// Of taps that lie there, with blocks of `SIDE x SIDE` texels.
    #[inline(always)]
    pub(super) fn new<const SIDE: usize>(simd: S, tap: Tap<'_>, [x, y]: [S::i32s; 2]) -> Self {
        let number = |value| S::i32s::splat(simd, value);
        let before = number(i32::from(SIDE != SMALL));
        let fraction = number((1 << FRACTION_BITS) - 1);
        let mass = number(tap.level.mass);
        Self {
            corners: [(x >> FRACTION_BITS) - before, (y >> FRACTION_BITS) - before],
            weights: if SIDE == SMALL {
                // Without its fraction a coordinate weighs its own texel alone.
                let kept = match tap.plan.pixel {
                    PixelSampling::Nearest => number(0),
                    _ => fraction,
                };
                small_weights(simd, mass, [x & kept, y & kept])
            } else {
                large_weights(simd, tap.weights, mass, [x & fraction, y & fraction])
            },
        }
    }
}

/// See `bilinear::weights`.
#[inline(always)]
fn small_weights<S: Simd>(simd: S, mass: S::i32s, [x, y]: [S::i32s; 2]) -> [S::i32s; 8] {
    let lower = share(simd, mass, y);
    let upper = mass - lower;
    let right = share(simd, upper, x) | share(simd, lower, x) << 16;
    // No part of a difference is negative, so that nothing is borrowed from the upper half.
    let left = (upper | lower << 16) - right;
    let none = S::i32s::splat(simd, 0);
    [left, right, none, none, none, none, none, none]
}

/// See [`TexelWeights::shares`].
#[inline(always)]
fn large_weights<S: Simd>(simd: S, weights: &TexelWeights, mass: S::i32s, [x, y]: [S::i32s; 2]) -> [S::i32s; 8] {
    let columns = axis_weights(simd, weights, x);
    let rows = shares(simd, axis_weights(simd, weights, y), mass);
    let [a, b, c, d] = in_pairs(simd, shares(simd, columns, rows[0]), shares(simd, columns, rows[1]));
    let [e, f, g, h] = in_pairs(simd, shares(simd, columns, rows[2]), shares(simd, columns, rows[3]));
    [a, b, c, d, e, f, g, h]
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

/// The rows of the block that starts with a level's texel at `offset`. Small blocks have two rows.
#[inline(always)]
pub(super) fn rows<S: Simd, const SIDE: usize>(simd: S, level: &MipLevel, offset: usize) -> [u8x16<S>; 4] {
    let stride = level.stride() as usize;
    // There is room for four in each row.
    let texels = &level.texels()[offset..][..(SIDE - 1) * stride + LARGE];
    let (first, second) = (row(simd, texels), row(simd, &texels[stride..]));
    if SIDE == SMALL {
        return [first, second, first, second];
    }
    [
        first,
        second,
        row(simd, &texels[2 * stride..]),
        row(simd, &texels[3 * stride..]),
    ]
}

/// The same of a block of which some texels lie beyond the level, by its first column and row.
#[inline(always)]
pub(super) fn rows_beyond<S: Simd, const SIDE: usize>(
    simd: S,
    level: &MipLevel,
    wrap: Wrap,
    corner: [i32; 2],
) -> [u8x16<S>; 4] {
    // As numbers they go from register to register: a vector of what was just stored one by one has to wait for it.
    beyond::<SIDE>(level, wrap, corner).map(|row| u64x2::simd_from(simd, row).bitcast())
}

/// Rows of texels, two in each number.
#[cold]
#[inline(never)]
fn beyond<const SIDE: usize>(level: &MipLevel, wrap: Wrap, [left, top]: [i32; 2]) -> [[u64; 2]; LARGE] {
    let columns = wrapped::<SIDE>(wrap, left, level.width());
    let rows = wrapped::<SIDE>(wrap, top, level.height());
    let mut found = [[0; 2]; LARGE];
    for (found, y) in found.iter_mut().zip(rows).take(SIDE) {
        let texel = |i: usize| u64::from(u32::from_le_bytes(level.texel(columns[i], y)));
        *found = [texel(0) | texel(1) << 32, 0];
        if SIDE == LARGE {
            found[1] = texel(2) | texel(3) << 32;
        }
    }
    found
}

/// What stands in `SIDE` columns or rows from one on.
#[inline]
fn wrapped<const SIDE: usize>(wrap: Wrap, first: i32, side: u32) -> [i32; LARGE] {
    let mut found = [0; LARGE];
    for (found, at) in found.iter_mut().zip(first..).take(SIDE) {
        *found = wrap.texel(at, side);
    }
    found
}

/// Four texels.
#[inline(always)]
fn row<S: Simd>(simd: S, texels: &[[u8; 4]]) -> u8x16<S> {
    let mut bytes = [0; 16];
    bytes.copy_from_slice(texels[..4].as_flattened());
    u8x16::simd_from(simd, bytes)
}
