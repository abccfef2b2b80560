//! Sums over some samples of a pixel that are known to lie between two ends, and the pixel where both ends make the same.
//!
//! ```text
//!     byte 118         byte 119        byte 120
//!   |- - - - - - - -|- -[====]- - - -|- - - - -[==|==]-    mean of a pixel's samples
//!                      certain            somebody has to look at the samples
//! ```

#![expect(
    clippy::inline_always,
    reason = "a function that is not inlined into its dispatch loses the vector instructions"
)]

use fearless_simd::prelude::*;
use fearless_simd::{Simd, f32x16, f64x8, u64x8};

use super::light::{ALL_LIGHT, ONE_LIGHT};
use super::near_light::{LIGHT_OFF, near_light_of_stored};
use super::value_spread::PIXELS;
use super::{Light, Premultiplied16, SampleMean};

/// Between what red, green and blue of some opaque samples of a pixel add up to: stored values, or their light in parts of all
/// light.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct SumBounds {
    pub(crate) least: [u64; 3],
    pub(crate) most: [u64; 3],
    /// How many samples.
    pub(crate) count: u32,
}

impl SumBounds {
    /// What `count` samples add up to of which nothing is known.
    pub(crate) fn unknown(count: u32, mean: &SampleMean) -> Self {
        let one = match mean {
            SampleMean::Stored(_) => u64::from(Premultiplied16::ONE),
            SampleMean::Linear(_) => ALL_LIGHT,
        };
        Self {
            least: [0; 3],
            most: [one * u64::from(count); 3],
            count,
        }
    }

    /// The pixel that these samples make with others whose channels add up to `sums`, if it is certain.
    #[inline]
    pub(crate) fn pixel_with_sums(&self, sums: [u32; 4], mean: &SampleMean) -> Option<u32> {
        let SampleMean::Stored(resolver) = mean else {
            return None;
        };
        self.same_of_both(|ends| {
            let all: [u32; 4] = std::array::from_fn(|k| match ends.get(k) {
                Some(sum) => sums[k] + u32::try_from(*sum).unwrap_or(0),
                None => sums[k] + self.count * u32::from(Premultiplied16::ONE),
            });
            resolver.pixel(all)
        })
    }

    /// The same with others of this light.
    #[inline]
    pub(crate) fn pixel_with_light(&self, light: Light, mean: &SampleMean) -> Option<u32> {
        let SampleMean::Linear(resolver) = mean else {
            return None;
        };
        if light == Light::default() && self.count == resolver.count() {
            return self.same_of_both(|ends| resolver.opaque_pixel(ends));
        }
        self.same_of_both(|ends| {
            let mut all = light;
            all += Light::of_opaque(ends, self.count);
            resolver.pixel(all)
        })
    }

    #[inline]
    fn same_of_both(&self, pixel: impl Fn([u64; 3]) -> u32) -> Option<u32> {
        let least = pixel(self.least);
        (self.least == self.most || pixel(self.most) == least).then_some(least)
    }
}

/// Between what the sums of a channel over `counts` samples of [`PIXELS`] pixels lie whose means, or the values whose light is the mean of
/// theirs, lie between such ends, in units of [`Premultiplied16`].
#[inline(always)]
pub(crate) fn sums_between<S: Simd>(
    simd: S,
    [least, most]: [f32x16<S>; 2],
    counts: f32x16<S>,
    mean: &SampleMean,
) -> [[u64; PIXELS]; 2] {
    match mean {
        SampleMean::Stored(_) => [sums_at(simd, least, counts, 1.0), sums_at(simd, most, counts, 1.0)],
        SampleMean::Linear(_) => [
            sums_at(simd, light_at(simd, least) - LIGHT_OFF, counts, ONE_LIGHT),
            sums_at(simd, light_at(simd, most) + LIGHT_OFF, counts, ONE_LIGHT),
        ],
    }
}

/// The light of values, in units of [`Premultiplied16`], but for [`LIGHT_OFF`]; nothing lies beyond black and white.
#[inline(always)]
fn light_at<S: Simd>(simd: S, values: f32x16<S>) -> f32x16<S> {
    let inside = values
        .max(f32x16::splat(simd, 0.0))
        .min(f32x16::splat(simd, f32::from(Premultiplied16::ONE)));
    near_light_of_stored(simd, inside)
}

/// The sums of `counts` numbers whose means are these, in parts of one, rounded down.
#[inline(always)]
fn sums_at<S: Simd>(simd: S, means: f32x16<S>, counts: f32x16<S>, one: f64) -> [u64; PIXELS] {
    // Rounding leaves room below black, where there is no sum.
    let (means, counts) = (means.max(f32x16::splat(simd, 0.0)).widen(), counts.widen());
    let mut sums = [0; PIXELS];
    let (first, second) = sums.split_at_mut(PIXELS / 2);
    whole(means.0 * counts.0 * one).store_slice(first);
    whole(means.1 * counts.1 * one).store_slice(second);
    sums
}

/// Numbers that are not negative, rounded down.
#[inline(always)]
fn whole<S: Simd>(values: f64x8<S>) -> u64x8<S> {
    // Where whole numbers stand in the lower bits.
    const WHOLE: f64 = (1_u64 << 52) as f64;
    (values.floor() + WHOLE).bitcast::<u64x8<S>>() & ((1 << 52) - 1)
}

impl std::ops::AddAssign for SumBounds {
    #[inline]
    fn add_assign(&mut self, other: Self) {
        for k in 0..3 {
            self.least[k] += other.least[k];
            self.most[k] += other.most[k];
        }
        self.count += other.count;
    }
}
