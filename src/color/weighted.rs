//! Samples of different weights to pixels: sums of stored values, or of the light that they stand for, in whole numbers.
//!
//! Weights are whole numbers too, and some may be below zero; what all of them add up to is the 1 by which a sum is divided.
//! So nothing is rounded before the pixel is, and samples that are all alike are the pixel that one of them is.

use std::sync::LazyLock;

use super::light::straight;
use super::light_scale::{Steps, whole_light};
use super::{Premultiplied16, ResolveSpace};
use crate::rules::Rules;

/// Bits of linear light: fine enough to tell all stored values apart, the darkest too, and the weighted sum of some thousand samples
/// fits 64 bits.
const BITS: u32 = 24;
const ONE_LIGHT: f64 = (1_u32 << BITS) as f64;

/// Linear light of every stored channel.
static LIGHT: LazyLock<Vec<i32>> = LazyLock::new(|| (0..=Premultiplied16::ONE).map(light).collect());

/// The same of every byte, side by side.
static LIGHT_OF_BYTES: LazyLock<[i32; 256]> =
    LazyLock::new(|| std::array::from_fn(|byte| LIGHT[byte * usize::from(Premultiplied16::PER_BYTE)]));

/// How light becomes bytes.
static STEPS: LazyLock<[Steps<BITS>; 2]> = LazyLock::new(Steps::both);

/// Linear light of a stored channel.
fn light(stored: u16) -> i32 {
    whole_light::<BITS>(stored.into()).cast_signed()
}

/// Red, green, blue and alpha of some samples, each times its weight; and the sum of the weights, which must be above zero.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct WeightedSum {
    /// Of what [`ResolveSpace::parts`] makes of the samples.
    pub channels: [i64; 4],
    /// Of the weights.
    pub weight: i64,
}

impl WeightedSum {
    /// Adds what of samples is summed up, which weigh so much together.
    #[inline]
    pub fn add(&mut self, weight: i64, parts: [i32; 4]) {
        for (channel, part) in self.channels.iter_mut().zip(parts) {
            *channel += weight * i64::from(part);
        }
        self.weight += weight;
    }
}

impl ResolveSpace {
    /// What of a sample is summed up: the channels as it stores them; or the light of red, green and blue, weighted by alpha,
    /// and alpha.
    #[inline]
    pub fn parts(self, sample: Premultiplied16) -> [i32; 4] {
        let Premultiplied16([r, g, b, alpha]) = sample;
        match self {
            Self::Stored => sample.0.map(i32::from),
            Self::Linear => {
                let lit = [r, g, b].map(|channel| faded(LIGHT[usize::from(straight(channel, alpha))], alpha));
                [lit[0], lit[1], lit[2], i32::from(alpha)]
            }
        }
    }

    /// What of an opaque sample is summed up in light, for each value that a channel may have: of `2^24` parts.
    pub(crate) fn light() -> &'static [i32] {
        &LIGHT
    }

    /// What [`ResolveSpace::parts`] are at most, but for alpha.
    fn full(self) -> f64 {
        match self {
            Self::Stored => f64::from(Premultiplied16::ONE),
            Self::Linear => ONE_LIGHT,
        }
    }

    /// The mean that a sum stands for, each channel in `0.0..=255.0` where it is one that a pixel can show; in
    /// [`ResolveSpace::Linear`] light.
    pub fn weighted_mean(self, sum: WeightedSum) -> [f64; 4] {
        let full = [self.full(), self.full(), self.full(), f64::from(Premultiplied16::ONE)];
        [0, 1, 2, 3].map(|k| sum.channels[k] as f64 / sum.weight as f64 / full[k] * 255.0)
    }

    /// By how many levels the mean that a sum stands for is beyond what a pixel can show: how far the least channel is below nothing,
    /// and the greatest above the opacity, or that above 1; in [`ResolveSpace::Linear`] light. Zero where nothing is.
    pub fn beyond_pixel(self, sum: WeightedSum) -> [f64; 2] {
        let [r, g, b, alpha] = self.weighted_mean(sum);
        let most = alpha.clamp(0.0, 255.0);
        let below = [r, g, b, alpha].map(|channel| -channel);
        let above = [r - most, g - most, b - most, alpha - 255.0];
        [below, above].map(|beyond| beyond.into_iter().fold(0.0, f64::max))
    }

    /// The straight 8-bit pixel `0xAARRGGBB`, rounded to nearest or truncated as `rules` say. Opacity beyond `0..=1` is
    /// clamped, and colours beyond nothing and the opacity.
    pub fn weighted_pixel(self, sum: WeightedSum, rules: Rules) -> u32 {
        let WeightedSum { channels, weight } = sum;
        let one = i64::from(Premultiplied16::ONE) * weight;
        let alpha = channels[3].clamp(0, one);
        let [r, g, b, _] = channels;
        let per_level = i64::from(Premultiplied16::PER_BYTE) * weight;
        let opacity = divided(alpha, per_level, rules);
        if alpha == 0 {
            return opacity << 24;
        }
        let [r, g, b] = [r, g, b].map(|channel| match self {
            Self::Stored => {
                let channel = channel.clamp(0, alpha);
                if alpha == one {
                    divided(channel, per_level, rules)
                } else {
                    divided(channel * 255, alpha, rules)
                }
            }
            Self::Linear if alpha == one => byte(channel.div_euclid(weight), rules),
            Self::Linear => {
                let full = i128::from(channel) * i128::from(Premultiplied16::ONE);
                let light = full.div_euclid(alpha.into());
                byte(i64::try_from(light).unwrap_or(i64::MAX), rules)
            }
        });
        opacity << 24 | r << 16 | g << 8 | b
    }

    /// The opaque pixel `0xAARRGGBB` that is the mean of two opaque ones, of which the second weighs `part` of `2^15` parts;
    /// rounded to nearest.
    #[inline]
    pub fn opaque_mean(self, pixels: [u32; 2], part: u16) -> u32 {
        const PART_BITS: u32 = 15;
        let [[_, first @ ..], [_, second @ ..]] = pixels.map(u32::to_be_bytes);
        // Written out, since arrays that are mapped are not always inlined.
        let [r, g, b] = match self {
            Self::Stored => {
                let part = i32::from(part);
                let mean = |first: u8, second: u8| {
                    let (first, second) = (i32::from(first), i32::from(second));
                    (((first << PART_BITS) + (second - first) * part + (1 << (PART_BITS - 1))) >> PART_BITS)
                        .cast_unsigned()
                };
                [
                    mean(first[0], second[0]),
                    mean(first[1], second[1]),
                    mean(first[2], second[2]),
                ]
            }
            Self::Linear => {
                let (lights, steps) = (&*LIGHT_OF_BYTES, Steps::by_rules(&STEPS, Rules::Standard));
                let part = i64::from(part);
                let light = |byte: u8| i64::from(lights[usize::from(byte)]);
                let mean = |first: u8, second: u8| {
                    let (first, second) = (light(first), light(second));
                    // Between the two, so not below zero.
                    let light = ((first << PART_BITS) + (second - first) * part) >> PART_BITS;
                    steps.byte(light.cast_unsigned())
                };
                [
                    mean(first[0], second[0]),
                    mean(first[1], second[1]),
                    mean(first[2], second[2]),
                ]
            }
        };
        0xFF00_0000 | r << 16 | g << 8 | b
    }
}

/// The byte of this light.
fn byte(light: i64, rules: Rules) -> u32 {
    Steps::by_rules(&STEPS, rules).byte(light.max(0).cast_unsigned())
}

/// A part of light, to nearest.
#[inline]
fn faded(light: i32, alpha: u16) -> i32 {
    const ONE: i64 = Premultiplied16::ONE as i64;
    if alpha == Premultiplied16::ONE {
        return light;
    }
    i32::try_from((i64::from(light) * i64::from(alpha) + ONE / 2) / ONE).unwrap_or(light)
}

/// `sum / full`, neither below zero, as `rules` round it, at most 255.
fn divided(sum: i64, full: i64, rules: Rules) -> u32 {
    super::divide_wide(sum.cast_unsigned(), full.cast_unsigned(), rules)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sum(space: ResolveSpace, samples: &[(Premultiplied16, i64)]) -> WeightedSum {
        let mut sum = WeightedSum::default();
        for (sample, weight) in samples {
            sum.add(*weight, space.parts(*sample));
        }
        sum
    }

    #[test]
    fn samples_that_weigh_alike_are_their_mean() {
        arbtest::arbtest(|u| {
            let count = u.int_in_range(1..=12)?;
            let translucent: bool = u.arbitrary()?;
            let mut samples = Vec::new();
            for _ in 0..count {
                let alpha = if translucent {
                    u.int_in_range(0..=Premultiplied16::ONE)?
                } else {
                    Premultiplied16::ONE
                };
                let channels = [u.int_in_range(0..=alpha)?, u.int_in_range(0..=alpha)?, 0];
                samples.push(Premultiplied16([channels[0], channels[1], channels[2], alpha]));
            }
            let weight = u.int_in_range(1..=1 << 26)?;
            let weighted: Vec<_> = samples.iter().map(|sample| (*sample, weight)).collect();
            for rules in Rules::ALL {
                let stored = sum(ResolveSpace::Stored, &weighted);
                let found = ResolveSpace::Stored.weighted_pixel(stored, rules);
                assert_eq!(
                    found,
                    ResolveSpace::Stored.resolve(&samples, rules),
                    "{samples:?} {rules:?}"
                );
                // The box's mean of light is kept finer.
                let lit = sum(ResolveSpace::Linear, &weighted);
                let found = ResolveSpace::Linear.weighted_pixel(lit, rules).to_be_bytes();
                let mean = ResolveSpace::Linear.resolve(&samples, rules).to_be_bytes();
                let is_near = found.iter().zip(mean).all(|(a, b)| a.abs_diff(b) <= 1);
                assert!(
                    is_near || stored.channels[3] < weight * 400,
                    "{found:?} {mean:?} {samples:?} {rules:?}"
                );
            }
            Ok(())
        })
        .budget_ms(300);
    }

    #[test]
    fn opaque_samples_of_one_colour_stay_as_they_are_whatever_they_weigh() {
        for value in (0..=Premultiplied16::ONE).step_by(7) {
            let sample = Premultiplied16([value, 0, Premultiplied16::ONE - value, Premultiplied16::ONE]);
            for space in ResolveSpace::ALL {
                let sum = sum(space, &[(sample, 70_000), (sample, -5_001), (sample, 3)]);
                for rules in Rules::ALL {
                    let found = space.weighted_pixel(sum, rules);
                    assert_eq!(found, sample.to_pixel(rules), "{sample:?} {space:?} {rules:?}");
                }
            }
        }
    }

    #[test]
    fn what_no_pixel_can_show_is_clamped() {
        let [white, black] = [255, 0].map(|value| Premultiplied16::from_bytes([value, value, value, 255]));
        let red = Premultiplied16::from_bytes([200, 0, 0, 255]);
        let nothing = Premultiplied16::TRANSPARENT;
        for space in ResolveSpace::ALL {
            let pixel = |samples: &[_]| space.weighted_pixel(sum(space, samples), Rules::Standard);
            assert_eq!(pixel(&[(white, 11), (black, -1)]), 0xFFFF_FFFF, "beyond white");
            assert_eq!(pixel(&[(black, 11), (white, -1)]), 0xFF00_0000, "beyond black");
            assert_eq!(pixel(&[(nothing, 11), (red, -1)]), 0, "less than nothing");
            assert_eq!(pixel(&[(red, 11), (nothing, -1)]) >> 24, 255, "more than opaque");
            for (samples, expected) in [
                ([(white, 11), (black, -1)], [0.0, 25.5]),
                ([(black, 11), (white, -1)], [25.5, 0.0]),
                ([(nothing, 11), (red, -1)], [25.5, 0.0]),
                ([(red, 11), (nothing, -1)], [0.0, 25.5]),
                ([(white, 1), (black, 1)], [0.0, 0.0]),
            ] {
                let beyond = space.beyond_pixel(sum(space, &samples));
                let off = [0, 1].map(|end| (beyond[end] - expected[end]).abs());
                assert!(off[0] < 0.01 && off[1] < 0.01, "{samples:?} in {space:?}: {beyond:?}");
            }
        }
    }
}
