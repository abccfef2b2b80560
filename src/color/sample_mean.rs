//! What the samples of pixels are averaged with where each of them is shaded and rounded for itself.

#![expect(
    clippy::inline_always,
    reason = "a function that is not inlined into its dispatch loses the vector instructions"
)]

use fearless_simd::{Simd, dispatch};

use super::{LightResolver, NearLight, Premultiplied16, ResolveSpace, Resolver};
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

    /// The light of each byte of an opaque sample, where that is what is averaged, and not what is stored.
    pub fn byte_light(&self) -> Option<&'static [u32; 256]> {
        match self {
            Self::Stored(_) => None,
            Self::Linear(_) => Some(LightResolver::of_bytes()),
        }
    }

    /// The pixel of the sums of red, green and blue, stored or of [`SampleMean::byte_light`], over as many opaque samples as there are
    /// in one.
    #[inline]
    pub fn pixel_of_values(&self, sums: [u64; 3]) -> u32 {
        match self {
            Self::Stored(resolver) => {
                let [r, g, b] = sums.map(|sum| u32::try_from(sum).unwrap_or(u32::MAX));
                resolver.pixel([r, g, b, resolver.count() * u32::from(Premultiplied16::ONE)])
            }
            Self::Linear(resolver) => resolver.opaque_pixel(sums),
        }
    }

    /// The pixels of opaque samples, one pixel after the other.
    pub fn opaque_pixels(&self, samples: &[Premultiplied16], pixels: &mut [u32]) {
        dispatch!(simd::level(), simd => self.opaque_pixels_with(simd, samples, pixels));
    }

    #[inline(always)]
    fn opaque_pixels_with<S: Simd>(&self, simd: S, samples: &[Premultiplied16], pixels: &mut [u32]) {
        match self {
            Self::Stored(resolver) => {
                let samples = samples.chunks_exact(resolver.count() as usize);
                for (pixel, samples) in pixels.iter_mut().zip(samples) {
                    *pixel = resolver.pixel(Premultiplied16::sums(samples));
                }
            }
            Self::Linear(resolver) => NearLight::new(resolver).of_samples(simd, samples, pixels),
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
            let bytes: Vec<Premultiplied16> = samples
                .iter()
                .map(|sample| Premultiplied16(sample.0.map(|channel| channel & 0xFF00)))
                .collect();
            for space in ResolveSpace::ALL {
                let mean = SampleMean::new(space, count, rules);
                for samples in bytes.chunks_exact(count as usize) {
                    let light = mean.byte_light();
                    let value = |channel: u16| match light {
                        Some(light) => u64::from(light[usize::from(channel >> 8)]),
                        None => u64::from(channel),
                    };
                    let sums = [0, 1, 2].map(|k| samples.iter().map(|sample| value(sample.0[k])).sum());
                    assert_eq!(
                        mean.pixel_of_values(sums),
                        mean.pixel(samples),
                        "by its bytes: {samples:?}"
                    );
                }
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
