//! What the samples of pixels are averaged with where each of them is shaded and rounded for itself.

#![expect(
    clippy::inline_always,
    reason = "a function that is not inlined into its dispatch loses the vector instructions"
)]

use fearless_simd::{Simd, dispatch};

use super::{LightResolver, Premultiplied16, ResolveSpace, Resolver};
use crate::rules::Rules;
use crate::simd;

/// How samples are averaged.
#[derive(Clone, Copy, Debug)]
pub enum SampleMean {
    /// Their stored values.
    Stored(Resolver),
    /// Their light.
    Linear(LightResolver),
}

impl SampleMean {
    /// Of `count` samples, in values that `space` says.
    pub fn new(space: ResolveSpace, count: u32, rules: Rules) -> Self {
        match space {
            // The mean of one sample is that sample in either.
            ResolveSpace::Linear if count > 1 => Self::Linear(LightResolver::new(count, rules)),
            _ => Self::Stored(Resolver::new(count, rules)),
        }
    }

    /// The pixel `0xAARRGGBB` of as many samples as there are in one.
    #[inline]
    pub fn pixel(&self, samples: &[Premultiplied16]) -> u32 {
        match self {
            Self::Stored(resolver) => resolver.pixel(Premultiplied16::sums(samples)),
            Self::Linear(resolver) => resolver.mean(samples),
        }
    }

    /// The pixels of opaque samples, one pixel after the other.
    pub fn opaque_pixels(&self, samples: &[Premultiplied16], pixels: &mut [u32]) {
        dispatch!(simd::level(), simd => self.opaque_pixels_with(simd, samples, pixels));
    }

    #[inline(always)]
    fn opaque_pixels_with<S: Simd>(&self, _: S, samples: &[Premultiplied16], pixels: &mut [u32]) {
        let count = samples.len() / pixels.len().max(1);
        let samples = samples.chunks_exact(count.max(1));
        match self {
            Self::Stored(resolver) => {
                for (pixel, samples) in pixels.iter_mut().zip(samples) {
                    *pixel = resolver.pixel(Premultiplied16::sums(samples));
                }
            }
            Self::Linear(resolver) => {
                for (pixel, samples) in pixels.iter_mut().zip(samples) {
                    *pixel = resolver.opaque_mean(samples);
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pixels_side_by_side_are_those_of_one_by_one() {
        arbtest::arbtest(|u| {
            let count = *u.choose(&[1_u32, 2, 4, 5, 16, 64])?;
            let rules = *u.choose(&Rules::ALL)?;
            let mut channel = || u.int_in_range(0..=Premultiplied16::ONE);
            let samples: Vec<Premultiplied16> = (0..count * 7)
                .map(|_| {
                    Ok(Premultiplied16([
                        channel()?,
                        channel()?,
                        channel()?,
                        Premultiplied16::ONE,
                    ]))
                })
                .collect::<arbtest::arbitrary::Result<_>>()?;
            for space in ResolveSpace::ALL {
                let mean = SampleMean::new(space, count, rules);
                let expected: Vec<u32> = samples
                    .chunks_exact(count as usize)
                    .map(|samples| space.resolve(samples, rules))
                    .collect();
                for (name, level) in simd::tested() {
                    let mut found = vec![0; 7];
                    dispatch!(level, simd => mean.opaque_pixels_with(simd, &samples, &mut found));
                    assert_eq!(found, expected, "{name}: {count} samples, {space:?}, {rules:?}");
                }
                let one_by_one = samples.chunks_exact(count as usize).map(|samples| mean.pixel(samples));
                assert!(
                    one_by_one.eq(expected.iter().copied()),
                    "{count} samples, {space:?}, {rules:?}"
                );
            }
            Ok(())
        })
        .budget_ms(200);
    }
}
