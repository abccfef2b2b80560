//! Samples of different weights to pixels: sums of stored values, or of the light that they stand for, in whole numbers.
//!
//! Weights are whole numbers too, and some may be below zero; what all of them add up to is the 1 by which a sum is divided.
//! So nothing is rounded before the pixel is, and samples that are all alike are the pixel that one of them is.

use std::sync::LazyLock;

use super::light::{light_of, straight};
use super::{Premultiplied16, ResolveSpace};
use crate::rules::Rules;

/// Linear light is kept in parts of this: fine enough to tell all stored values apart, the darkest too, and the weighted sum
/// of some thousand samples fits 64 bits.
const ONE_LIGHT: f64 = (1_u32 << 24) as f64;

/// Linear light of every stored channel.
static LIGHT: LazyLock<Vec<i32>> =
    LazyLock::new(|| (0..=Premultiplied16::ONE).map(|stored| light(stored.into())).collect());

/// How light becomes bytes, rounded to nearest; and truncated.
static STEPS: LazyLock<[Steps; 2]> = LazyLock::new(|| [0.5, 0.0].map(Steps::new));

/// Light that a piece of [`Steps::below`] spans: less than lies between any two bytes, which is least in the dark.
const PIECE_BITS: u32 = 12;
const PIECES: usize = (1 << (24 - PIECE_BITS)) + 1;

/// Where light becomes the next byte.
#[derive(Debug)]
struct Steps {
    /// The least light of each byte from 1 on, and more than all light.
    least: [i32; 256],
    /// How many of these each piece of light begins with, or has below it.
    below: [u8; PIECES],
}

impl Steps {
    /// With this much of a byte being enough for the next one's light to be `1 - below` away.
    fn new(below: f64) -> Self {
        let per_byte = f64::from(Premultiplied16::PER_BYTE);
        let mut least = [i32::MAX; 256];
        for (least, byte) in least.iter_mut().zip(1..=255_u8) {
            *least = light((f64::from(byte) - below) * per_byte);
        }
        let mut pieces = [0; PIECES];
        for (piece, below) in (0..).zip(&mut pieces) {
            let count = least.partition_point(|light| *light <= piece << PIECE_BITS);
            *below = u8::try_from(count).unwrap_or(u8::MAX);
        }
        Self { least, below: pieces }
    }

    /// As `rules` say.
    fn of(rules: Rules) -> &'static Self {
        match rules {
            Rules::Standard | Rules::Float => &STEPS[0],
            Rules::Course => &STEPS[1],
        }
    }

    /// The byte of this light.
    #[inline]
    fn byte(&self, light: i64) -> u32 {
        let light = i32::try_from(light.clamp(0, 1 << 24)).unwrap_or(0);
        let below = self.below[(light.cast_unsigned() >> PIECE_BITS) as usize % PIECES];
        u32::from(below) + u32::from(self.least[usize::from(below)] <= light)
    }
}

/// Linear light of a stored channel.
#[expect(clippy::cast_possible_truncation, reason = "between nothing and ONE_LIGHT")]
fn light(stored: f64) -> i32 {
    (light_of(stored) * ONE_LIGHT).round() as i32
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
            // A light is at least another, which is a whole number, where the whole part of it is.
            Self::Linear if alpha == one => Steps::of(rules).byte(channel.div_euclid(weight)),
            Self::Linear => encoded(channel, alpha, rules),
        });
        opacity << 24 | r << 16 | g << 8 | b
    }

    /// The opaque pixel `0xAARRGGBB` that is the mean of two opaque ones, of which the second weighs `part` of `2^15` parts;
    /// rounded to nearest.
    #[inline]
    pub fn opaque_mean(self, pixels: [u32; 2], part: u16) -> u32 {
        const BITS: u32 = 15;
        let [[_, first @ ..], [_, second @ ..]] = pixels.map(u32::to_be_bytes);
        // Written out, since arrays that are mapped are not always inlined.
        let [r, g, b] = match self {
            Self::Stored => {
                let part = i32::from(part);
                let mean = |first: u8, second: u8| {
                    let (first, second) = (i32::from(first), i32::from(second));
                    (((first << BITS) + (second - first) * part + (1 << (BITS - 1))) >> BITS).cast_unsigned()
                };
                [
                    mean(first[0], second[0]),
                    mean(first[1], second[1]),
                    mean(first[2], second[2]),
                ]
            }
            Self::Linear => {
                let steps = Steps::of(Rules::Standard);
                let part = i64::from(part);
                let light = |byte: u8| i64::from(LIGHT[usize::from(Premultiplied16::PER_BYTE) * usize::from(byte)]);
                let mean = |first: u8, second: u8| {
                    let (first, second) = (light(first), light(second));
                    steps.byte(((first << BITS) + (second - first) * part) >> BITS)
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

/// The byte of the light `channel / alpha` of a sum that is not opaque.
fn encoded(channel: i64, alpha: i64, rules: Rules) -> u32 {
    let least = &Steps::of(rules).least[..255];
    // A light is at least another where as much of that is no more: nothing is rounded before.
    let sum = i128::from(channel) * i128::from(Premultiplied16::ONE);
    let byte = least.partition_point(|light| i128::from(*light) * i128::from(alpha) <= sum);
    u32::try_from(byte).unwrap_or(255)
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
        }
    }
}
