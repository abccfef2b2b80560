//! The means of values that are spread around a known mean and rounded, and of their light, without looking at each of them.
//!
//! ```text
//!    light |            .'      f curves upwards, so the mean light of values around m is at least f(m), and at most
//!          |          .'
//!          |       .·'              f(m) + max f'' / 2 · mean square of their distance from m
//!          |  ..·'
//!          +------m------ value  which is no more than f(m + that / f'(m)); with min f'', at least a little more than f(m).
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
use fearless_simd::{Simd, f32x16, u32x16};

use super::Premultiplied16;

const ONE: f64 = Premultiplied16::ONE as f64;
/// Where the straight part of the curve ends (IEC 61966-2-1), with a small step and a kink.
const BEND: f32 = 0.040_45 * Premultiplied16::ONE as f32;
/// Beyond, light is the power 2.4 of `stored * SLOPE + OFFSET`.
const SLOPE: f32 = 1.0 / (Premultiplied16::ONE as f32 * 1.055);
const OFFSET: f32 = 0.055 / 1.055;

/// The most that `SLOPE` is of the base of that power: at the bend.
const STEEPEST: f64 = (SLOPE / (BEND * SLOPE + OFFSET)) as f64;
/// The curve bends so little that it is not worth a division to know where on it values lie, in units: rounding leaves more open.
const LITTLE: f32 = 0.5;
/// It bends so little that it rarely matters.
const MUCH: f32 = 4.0;

/// What the curve is off where it bends and light is rounded to whole numbers, even in the dark.
const OF_LIGHT: f64 = 0.1;
/// Planes are rounded, too.
const OF_PLANES: f64 = 0.01;
/// What the few sums here are off at most: numbers of 32 bits up to [`ONE`] are rounded to parts of 256.
const OF_SUMS: f64 = 0.02;

/// Values may lie so far out of range: planes are rounded.
const SLACK: f64 = 1e-3;

/// Pixels of which something is found together.
pub(crate) const PIXELS: usize = 16;

/// The values of one channel at the samples of [`PIXELS`] pixels, before they are rounded as samples store them.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ValueSpread<S: Simd> {
    /// In units of [`Premultiplied16`].
    pub(crate) mean: f32x16<S>,
    pub(crate) limits: SpreadLimits,
}

/// What is known of the values that samples store, in units of [`Premultiplied16`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct ValueLimits {
    /// Those that would lie outside are clamped.
    pub(crate) range: [f64; 2],
    /// How far rounding may have moved a value, and what is not known of their mean.
    pub(crate) rounded: f64,
}

/// What is known of the values of one pixel, of which no two are farther apart than some reach.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SpreadLimits {
    /// No two values are farther apart.
    reach: f32,
    /// How far rounding may move the mean of what is stored.
    rounded: f32,
    /// How far rounding may move the value whose light is the mean light, and how far from there any value may lie.
    off: f32,
    widest: f32,
    /// Between these means no value is clamped.
    unclamped: [f32; 2],
    /// So near to the bend some values may lie on its other side.
    near_bend: f32,
    /// What the curve adds at most, wherever on it values lie and however they are spread: half of its second derivative, at its
    /// greatest, over the first.
    most_bent: f32,
}

/// A bit for each of [`PIXELS`].
const ALL: u64 = (1 << PIXELS) - 1;

/// Between what a mean lies, in units of [`Premultiplied16`], and a bit for each of [`PIXELS`] pixels of which that is certain.
pub(crate) type Ends<S> = ([f32x16<S>; 2], u64);

impl ValueLimits {
    /// Of values that are rounded once.
    pub(crate) const STORED: Self = Self {
        range: [0.0, ONE],
        rounded: 0.5,
    };

    /// Of the values of one pixel, where no two are farther apart than `reach` and their mean is known but for `inexact`.
    #[expect(clippy::cast_possible_truncation, reason = "what is lost is within the slack")]
    pub(crate) fn within(self, reach: f64, inexact: f64) -> SpreadLimits {
        let Self {
            range: [least, most],
            rounded,
        } = self;
        let inexact = inexact + OF_SUMS;
        let off = rounded + OF_LIGHT + inexact;
        let widest = reach + off;
        SpreadLimits {
            reach: reach as f32,
            rounded: (rounded + OF_PLANES + inexact) as f32,
            off: off as f32,
            widest: widest as f32,
            unclamped: [(least + (reach - SLACK)) as f32, (most + SLACK - reach) as f32],
            near_bend: (reach + 2.0 * off) as f32,
            most_bent: (reach * reach / 4.0 * (STEEPEST * (widest * STEEPEST + 1.0)) * (1.4 / 2.0)) as f32,
        }
    }
}

impl SpreadLimits {
    /// The most that the mean square of how far values are from their mean can be: half of them lie at either end.
    pub(crate) fn most_squares(&self) -> f32 {
        self.reach * self.reach / 4.0
    }
}

impl<S: Simd> ValueSpread<S> {
    /// The bytes of the mean light, rounded to nearest, and a bit for each pixel of which that is certain; `squares` says between
    /// what the mean squares lie of how far the values are from their mean, where these matter.
    #[inline(always)]
    pub(crate) fn bytes_of_light(self, simd: S, squares: impl FnOnce() -> [f32x16<S>; 2]) -> (u32x16<S>, u64) {
        let SpreadLimits { off, most_bent, .. } = self.limits;
        if most_bent < MUCH {
            let (bytes, is_one) = bytes_between(simd, [self.mean - off, self.mean + (off + most_bent)]);
            // Nearly always. Without a division it takes half of the time.
            if is_one == ALL || most_bent < LITTLE {
                return (bytes, is_one & self.is_unclamped(simd) & self.is_smooth(simd));
            }
        }
        let (ends, certain) = self.ends_of_light(simd, squares());
        let (bytes, is_one) = bytes_between(simd, ends);
        (bytes, certain & is_one)
    }

    /// The bytes of the mean of what is stored, rounded to nearest, and a bit for each pixel of which that is certain.
    #[inline(always)]
    pub(crate) fn bytes(self, simd: S) -> (u32x16<S>, u64) {
        let (ends, certain) = self.ends(simd);
        let (bytes, is_one) = bytes_between(simd, ends);
        (bytes, certain & is_one)
    }

    /// The ends of the value whose light is the mean light; between `squares` lie the mean squares of how far the values are from their
    /// mean.
    #[inline(always)]
    pub(crate) fn ends_of_light(self, simd: S, squares: [f32x16<S>; 2]) -> Ends<S> {
        let Self { mean, limits } = self;
        let zero = f32x16::splat(simd, 0.0);
        let (least, most) = if limits.most_bent < LITTLE {
            (zero, f32x16::splat(simd, limits.most_bent))
        } else {
            let base = mean.max(f32x16::splat(simd, BEND)) * SLOPE + OFFSET;
            let step = f32x16::splat(simd, SLOPE) / base;
            // The second derivative is the power 0.4: of `1 - x` that is at least `1 - x`, and of `1 + x` at most `1 + 0.4 x`.
            let (x, half) = (step * limits.widest, step * (1.4 / 2.0));
            let (bent, most_bent) = (squares[0] * half, squares[1] * half);
            let least = (bent - bent * x).max(zero) * (f32x16::splat(simd, 1.0) - step * bent).max(zero);
            // Below, the curve is a straight line.
            let is_curved = mean.simd_gt(f32x16::splat(simd, BEND));
            (is_curved.select(least, zero), most_bent + most_bent * x * 0.4)
        };
        let certain = self.is_unclamped(simd) & self.is_smooth(simd);
        ([mean - limits.off + least, mean + limits.off + most], certain)
    }

    /// The ends of the mean of what is stored.
    #[inline(always)]
    pub(crate) fn ends(self, simd: S) -> Ends<S> {
        let off = self.limits.rounded;
        ([self.mean - off, self.mean + off], self.is_unclamped(simd))
    }

    /// A bit for each pixel of which no value is clamped.
    #[inline(always)]
    fn is_unclamped(self, simd: S) -> u64 {
        let [least, most] = self.limits.unclamped;
        let is_unclamped = self.mean.simd_gt(f32x16::splat(simd, least)) & self.mean.simd_lt(f32x16::splat(simd, most));
        is_unclamped.to_bitmask()
    }

    /// A bit for each pixel none of whose values lies where the curve has its kink.
    #[inline(always)]
    fn is_smooth(self, simd: S) -> u64 {
        let near = f32x16::splat(simd, self.limits.near_bend);
        (self.mean - BEND).abs().simd_gt(near).to_bitmask()
    }
}

/// The bytes that lie nearest to values between these ends, and a bit for each pixel of which that is one.
#[inline(always)]
fn bytes_between<S: Simd>(simd: S, [least, most]: [f32x16<S>; 2]) -> (u32x16<S>, u64) {
    // Where whole numbers stand in the lower bits.
    const WHOLE: f32 = (1 << 23) as f32;
    // Half a byte more, so that cutting off rounds.
    let low = ((least + 128.0) * (1.0 / 256.0)).floor();
    let high = ((most + 128.0) * (1.0 / 256.0)).floor();
    let bytes = (low.max(f32x16::splat(simd, 0.0)) + WHOLE).bitcast::<u32x16<S>>() & 0xFF;
    (bytes, low.simd_eq(high).to_bitmask())
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
            let expected = [ResolveSpace::Linear, ResolveSpace::Stored].map(|space| pixel(space) >> 16 & 0xFF);
            for (name, level) in simd::tested() {
                let found = dispatch!(level, simd => {
                    let number = |value: f64| f32x16::splat(simd, value as f32);
                    let spread = ValueSpread { mean: number(mean), limits: ValueLimits::STORED.within(reach, 0.0) };
                    let light = spread.bytes_of_light(simd, || [number(squares); 2]);
                    [light, spread.bytes(simd)].map(|(bytes, mask)| (bytes.to_array(), mask))
                });
                for (i, ((bytes, mask), expected)) in found.into_iter().zip(expected).enumerate() {
                    assert!(mask == 0 || mask == ALL, "all pixels are alike");
                    all[i] += 1;
                    if mask != 0 {
                        certain[i] += 1;
                        assert_eq!(
                            bytes, [expected; PIXELS],
                            "{name}: {mean}, {squares}, {reach}: {values:?}"
                        );
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
