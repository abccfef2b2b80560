//! The means of values that are spread around a known mean and rounded, and of their light, without looking at each of them.
//!
//! ```text
//!    light |            .'      f curves upwards, so the mean light of values around m is at least f(m), and at most
//!          |          .'
//!          |       .·'              f(m) + max f'' / 2 · mean square of their distance from m
//!          |  ..·'
//!          +------m------ value  which is no more than f(m + that / f'(m)).
//! ```
//!
//! Samples are rounded by half a unit, which moves both ends by as much; where colours are painted over them, and the outcome is
//! rounded again, by more. As stored values the ends lie close together, and bytes
//! are rounded from stored values: nearly always both ends are rounded to one byte, and then the mean light is, too. Elsewhere
//! somebody has to look at the values themselves. The mean of what is stored lies between such ends as well; there is nothing
//! between these but the rounding.

#![expect(
    clippy::inline_always,
    reason = "a function that is not inlined into its dispatch loses the vector instructions"
)]

use fearless_simd::prelude::*;
use fearless_simd::{Simd, f64x8, u64x8};

use super::Premultiplied16;

const ONE: f64 = Premultiplied16::ONE as f64;
/// Where the straight part of the curve ends (IEC 61966-2-1), with a small step and a kink.
const BEND: f64 = 0.040_45 * ONE;
/// Beyond, light is the power 2.4 of `stored * SLOPE + OFFSET`.
const SLOPE: f64 = 1.0 / (ONE * 1.055);
const OFFSET: f64 = 0.055 / 1.055;

/// The most that `SLOPE` is of the base of that power: at the bend.
const STEEPEST: f64 = SLOPE / (BEND * SLOPE + OFFSET);
/// The curve bends so little that it does not matter where on it values lie, in units.
const LITTLE: f64 = 0.05;

/// What the curve is off where it bends and light is rounded to whole numbers, even in the dark.
const OF_LIGHT: f64 = 0.1;
/// Planes are rounded, too.
const OF_PLANES: f64 = 0.01;

/// Values may lie so far out of range: planes are rounded.
const SLACK: f64 = 1e-3;

/// The values of one channel at the samples of eight pixels, before they are rounded as samples store them.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ValueSpread<S: Simd> {
    /// In units of [`Premultiplied16`].
    pub(crate) mean: f64x8<S>,
    /// No two values are farther apart.
    pub(crate) reach: f64,
    pub(crate) limits: ValueLimits,
}

/// What is known of the values that samples store, in units of [`Premultiplied16`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct ValueLimits {
    /// Those that would lie outside are clamped.
    pub(crate) range: [f64; 2],
    /// How far rounding may have moved a value, and what is not known of their mean.
    pub(crate) rounded: f64,
}

impl ValueLimits {
    /// Of values that are rounded once.
    pub(crate) const STORED: Self = Self {
        range: [0.0, ONE],
        rounded: 0.5,
    };
}

impl<S: Simd> ValueSpread<S> {
    /// The bytes of the mean light, rounded to nearest, and a bit for each pixel of which that is certain; `squares` are the mean
    /// squares of how far the values are from their mean.
    #[inline(always)]
    pub(crate) fn bytes_of_light(self, simd: S, squares: f64x8<S>) -> (u64x8<S>, u64) {
        let Self { mean, reach, limits } = self;
        let off = limits.rounded + OF_LIGHT;
        let widest = reach + off;
        // Half of the second derivative, at its greatest, over the first.
        let most = reach * reach / 4.0 * (STEEPEST * (widest * STEEPEST + 1.0)) * (1.4 / 2.0);
        let bent = if most < LITTLE {
            f64x8::splat(simd, most)
        } else {
            let base = mean.max(f64x8::splat(simd, BEND)) * SLOPE + OFFSET;
            let step = f64x8::splat(simd, SLOPE) / base;
            squares * (step * (step * widest + 1.0)) * (1.4 / 2.0)
        };
        let is_smooth = (mean - BEND).abs().simd_gt(f64x8::splat(simd, reach + 2.0 * off));
        let (bytes, certain) = self.between(simd, mean - off, mean + off + bent);
        (bytes, certain & is_smooth.to_bitmask())
    }

    /// The bytes of the mean of what is stored, rounded to nearest, and a bit for each pixel of which that is certain.
    #[inline(always)]
    pub(crate) fn bytes(self, simd: S) -> (u64x8<S>, u64) {
        let off = self.limits.rounded + OF_PLANES;
        self.between(simd, self.mean - off, self.mean + off)
    }

    /// The bytes that lie nearest to means from `least` to `most`, and where that is one and no value is clamped.
    #[inline(always)]
    fn between(self, simd: S, least: f64x8<S>, most: f64x8<S>) -> (u64x8<S>, u64) {
        // Where whole numbers stand in the lower bits.
        const WHOLE: f64 = (1_u64 << 52) as f64;
        let Self { mean, reach, limits } = self;
        let [least_value, most_value] = limits.range;
        // Half a byte more, so that cutting off rounds.
        let low = ((least + 128.0) * (1.0 / 256.0)).floor();
        let high = ((most + 128.0) * (1.0 / 256.0)).floor();
        let is_one = low.simd_eq(high);
        let in_range = mean.simd_gt(f64x8::splat(simd, least_value + (reach - SLACK)))
            & mean.simd_lt(f64x8::splat(simd, most_value + SLACK - reach));
        let bytes = (low.max(f64x8::splat(simd, 0.0)) + WHOLE).bitcast::<u64x8<S>>() & 0xFF;
        (bytes, (is_one & in_range).to_bitmask())
    }
}

#[cfg(test)]
mod tests {
    use arbtest::arbitrary::{Result, Unstructured};
    use fearless_simd::dispatch;

    use super::*;
    use crate::color::{ResolveSpace, SampleMean};
    use crate::rules::Rules;
    use crate::simd;

    /// Some values, their mean, their mean square distance from there, and their greatest.
    fn values(u: &mut Unstructured<'_>, count: u32) -> Result<(Vec<f64>, [f64; 3])> {
        let unit = |value: u16| f64::from(value) / f64::from(u16::MAX);
        let bright = unit(u.arbitrary()?);
        // Often in the dark, where the curve bends.
        let middle = if u.arbitrary()? { bright } else { bright * bright * 0.1 } * ONE;
        let reach = unit(u.arbitrary()?).powi(4) * ONE / 8.0;
        let mut values = Vec::new();
        for _ in 0..count {
            values.push((middle + (unit(u.arbitrary()?) * 2.0 - 1.0) * reach).clamp(0.0, ONE));
        }
        let mean = values.iter().sum::<f64>() / f64::from(count);
        let off = |value: &f64| (value - mean).abs();
        let squares = values.iter().map(|value| off(value).powi(2)).sum::<f64>() / f64::from(count);
        let end = |which: fn(f64, f64) -> f64| values.iter().copied().fold(mean, which);
        let reach = end(f64::max) - end(f64::min);
        Ok((values, [mean, squares, reach]))
    }

    #[test]
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "values of a channel"
    )]
    fn certain_bytes_are_those_of_the_samples() {
        let (mut certain, mut all) = ([0; 2], [0; 2]);
        arbtest::arbtest(|u| {
            let count = u.int_in_range(2..=64)?;
            let (values, [mean, squares, reach]) = values(u, count)?;
            let samples: Vec<Premultiplied16> = values
                .iter()
                .map(|value| Premultiplied16([value.round() as u16, 0, 0, Premultiplied16::ONE]))
                .collect();
            let pixel = |space| SampleMean::new(space, count, Rules::Standard).pixel(&samples);
            let expected =
                [ResolveSpace::Linear, ResolveSpace::Stored].map(|space| u64::from(pixel(space) >> 16 & 0xFF));
            for (name, level) in simd::tested() {
                let found = dispatch!(level, simd => {
                    let number = |value| f64x8::splat(simd, value);
                    let spread = ValueSpread { mean: number(mean), reach, limits: ValueLimits::STORED };
                    let light = spread.bytes_of_light(simd, number(squares));
                    [light, spread.bytes(simd)].map(|(bytes, mask)| (bytes.to_array(), mask))
                });
                for (i, ((bytes, mask), expected)) in found.into_iter().zip(expected).enumerate() {
                    assert!(mask == 0 || mask == 0xFF, "all pixels are alike");
                    all[i] += 1;
                    if mask != 0 {
                        certain[i] += 1;
                        assert_eq!(bytes, [expected; 8], "{name}: {mean}, {squares}, {reach}: {values:?}");
                    }
                }
            }
            Ok(())
        })
        .budget_ms(500);
        for (certain, all) in certain.into_iter().zip(all) {
            assert!(certain * 2 > all, "{certain} of {all} are certain");
        }
    }
}
