//! Where the samples of a vector lie in a level, in fixed point.

#![expect(
    clippy::inline_always,
    reason = "a function that is not inlined into its dispatch loses the vector instructions"
)]

use fearless_simd::Simd;
use fearless_simd::prelude::*;
use glam::DVec2;

use super::filter_plan::Axis;
use super::fixed_point::{FRACTION_BITS, REACH, TO_FIXED};
use super::wrap::Endless;

/// The most lanes of 32 bits that a vector has.
pub(super) const MAX_LANES: usize = 16;

/// Positions of samples relative to the pivot, in samples; the first and the second half of the lanes.
pub(super) struct Positions<S: Simd> {
    columns: [S::f64s; 2],
    rows: [S::f64s; 2],
}

/// How coordinates become fixed point: clamped to `least..=most`, and rounded by adding `to_fixed`.
#[derive(Clone, Copy)]
struct Rounding {
    least: f64,
    most: f64,
    to_fixed: f64,
}

/// Sample or pixel columns and rows as floats, of as many as a vector has lanes.
#[inline(always)]
pub(super) fn columns_and_rows<S: Simd>(simd: S, points: &[[u16; 2]]) -> [S::f32s; 2] {
    let lanes = S::u32s::LEN;
    let both: S::u32s = if let Some(points) = points.get(..lanes) {
        S::u16s::from_slice(simd, points.as_flattened()).bitcast()
    } else {
        let mut padded = [[0; 2]; MAX_LANES];
        // The last one again and again; copying just those there are would be a call.
        if let Some(last) = points.len().checked_sub(1) {
            for (i, padded) in padded[..lanes].iter_mut().enumerate() {
                *padded = points[i.min(last)];
            }
        }
        S::u16s::from_slice(simd, padded[..lanes].as_flattened()).bitcast()
    };
    let column: S::i32s = (both & S::u32s::splat(simd, 0xFFFF)).bitcast();
    let row: S::i32s = (both >> 16).bitcast();
    [S::f32s::float_from(column), S::f32s::float_from(row)]
}

/// Places in fixed point from the corner of the first texel of an axis that goes on for ever, which may lie up to a period
/// before the first one: where the same is shown in the texture itself.
#[inline(always)]
pub(super) fn in_texture<S: Simd>(simd: S, endless: &Endless, places: S::i32s) -> S::i32s {
    let number = |value: i32| S::u32s::splat(simd, value.cast_unsigned());
    let places: S::u32s = places.bitcast();
    // Without a sign, numbers below zero are the largest.
    let inside = places.min(places + number(endless.fixed_period));
    inside.min(number(endless.fixed_turn) - inside).bitcast()
}

impl<S: Simd> Positions<S> {
    /// Of samples counted from one at `first`. All numbers are exact: whole ones below `2^20` and multiples of `2^-20`.
    #[inline(always)]
    pub(super) fn new(simd: S, [columns, rows]: [S::f32s; 2], first: DVec2) -> Self {
        let (columns, rows) = (columns.widen(), rows.widen());
        let (left, top) = (S::f64s::splat(simd, first.x), S::f64s::splat(simd, first.y));
        Self {
            columns: [columns.0 + left, columns.1 + left],
            rows: [rows.0 + top, rows.1 + top],
        }
    }

    /// Where samples lie on an axis, inside the level, in fixed point; see `fixed_point::to_fixed`.
    #[inline(always)]
    pub(super) fn fixed(&self, simd: S, axis: &Axis) -> S::i32s {
        let rounding = Rounding {
            least: 0.0,
            most: axis.last,
            to_fixed: TO_FIXED,
        };
        self.round(simd, axis, rounding)
    }

    /// Where samples lie on an axis, at most [`REACH`] texels outside the level, in fixed point; see `wrap::place`.
    #[inline(always)]
    pub(super) fn far(&self, simd: S, axis: &Axis) -> S::i32s {
        self.around(simd, axis, REACH)
    }

    /// Where samples lie on an axis, at most two texels outside the level, with `bits` fractional bits.
    #[inline(always)]
    pub(super) fn near(&self, simd: S, axis: &Axis, bits: u32) -> S::i32s {
        // One half more than in `bilinear`, so that negative numbers stand below it in two's complement.
        let rounding = Rounding {
            least: -2.0,
            most: axis.last + 2.0,
            to_fixed: 1.5 * (1_u64 << (52 - bits)) as f64,
        };
        self.round(simd, axis, rounding)
    }

    /// As [`Positions::far`], at most `reach` texels outside the level.
    #[inline(always)]
    pub(super) fn around(&self, simd: S, axis: &Axis, reach: f64) -> S::i32s {
        let rounding = Rounding {
            least: -reach,
            most: axis.last + reach,
            to_fixed: 1.5 * TO_FIXED,
        };
        self.round(simd, axis, rounding)
    }

    /// Where samples lie on an axis that goes on for ever, from the corner of its first texel, in the first period, in fixed
    /// point; see `wrap::place`.
    #[inline(always)]
    pub(super) fn endless(&self, simd: S, axis: &Axis, endless: &Endless) -> S::i32s {
        self.in_period(simd, axis, endless, 1.5 * TO_FIXED)
    }

    /// The same with `bits` fractional bits, from where coordinates are counted from.
    #[inline(always)]
    pub(super) fn near_endless(&self, simd: S, axis: &Axis, endless: &Endless, bits: u32) -> S::i32s {
        let from_corner = self.in_period(simd, axis, endless, 1.5 * (1_u64 << (52 - bits)) as f64);
        from_corner - S::i32s::splat(simd, endless.fixed_centre >> (FRACTION_BITS - bits))
    }

    #[inline(always)]
    fn in_period(&self, simd: S, axis: &Axis, endless: &Endless, to_fixed: f64) -> S::i32s {
        let half = self.endless_half(simd, axis, (endless, to_fixed), 0);
        half.narrow(self.endless_half(simd, axis, (endless, to_fixed), 1))
    }

    #[inline(always)]
    fn endless_half(&self, simd: S, axis: &Axis, (endless, to_fixed): (&Endless, f64), half: usize) -> S::i64s {
        let from_corner = self.at(simd, axis, half) + S::f64s::splat(simd, endless.first_centre);
        let periods = (from_corner * S::f64s::splat(simd, endless.inverse)).floor();
        let within = from_corner - periods * S::f64s::splat(simd, endless.period);
        let inside = within
            .max(S::f64s::splat(simd, 0.0))
            .min(S::f64s::splat(simd, endless.period));
        (inside + S::f64s::splat(simd, to_fixed)).bitcast()
    }

    #[inline(always)]
    fn round(&self, simd: S, axis: &Axis, rounding: Rounding) -> S::i32s {
        let half = self.round_half(simd, axis, rounding, 0);
        half.narrow(self.round_half(simd, axis, rounding, 1))
    }

    #[inline(always)]
    fn round_half(&self, simd: S, axis: &Axis, rounding: Rounding, half: usize) -> S::i64s {
        let at = self.at(simd, axis, half);
        let Rounding { least, most, to_fixed } = rounding;
        let inside = at.max(S::f64s::splat(simd, least)).min(S::f64s::splat(simd, most));
        (inside + S::f64s::splat(simd, to_fixed)).bitcast()
    }

    #[inline(always)]
    fn at(&self, simd: S, axis: &Axis, half: usize) -> S::f64s {
        let right = self.columns[half] * S::f64s::splat(simd, axis.right);
        let down = self.rows[half] * S::f64s::splat(simd, axis.down);
        (S::f64s::splat(simd, axis.at_pivot) + right) + down
    }
}
