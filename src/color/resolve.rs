//! Samples to pixels: the mean of stored values, or of the light that they stand for.

use std::sync::LazyLock;

use super::Premultiplied16;
use crate::rules::Rules;

/// In which values samples are averaged.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum ResolveSpace {
    /// In the sRGB-encoded values that samples store, as the course does and most software.
    #[default]
    Stored,
    /// In linear light (IEC 61966-2-1), as an eye far away mixes them.
    Linear,
}

/// Linear light is kept in parts of this: fine enough to tell all stored values apart, and the sum of 256 samples times
/// their alpha fits 64 bits.
const ONE_LIGHT: f64 = (1_u64 << 31) as f64;

/// Linear light of every stored channel.
static LIGHT: LazyLock<Vec<u32>> =
    LazyLock::new(|| (0..=Premultiplied16::ONE).map(|stored| light(stored.into())).collect());

/// The least light of each byte from 1 on, rounded to nearest; and truncated.
static LEAST: LazyLock<[Vec<u32>; 2]> = LazyLock::new(|| {
    let per_byte = f64::from(Premultiplied16::PER_BYTE);
    [0.5, 0.0].map(|below| {
        (1..=255)
            .map(|byte| light((f64::from(byte) - below) * per_byte))
            .collect()
    })
});

/// Linear light of a stored channel.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "between nothing and ONE_LIGHT"
)]
fn light(stored: f64) -> u32 {
    (light_of(stored) * ONE_LIGHT).round() as u32
}

/// Linear light of a stored channel, `0.0..=1.0`.
pub(super) fn light_of(stored: f64) -> f64 {
    let stored = stored / f64::from(Premultiplied16::ONE);
    if stored <= 0.040_45 {
        stored / 12.92
    } else {
        ((stored + 0.055) / 1.055).powf(2.4)
    }
}

impl ResolveSpace {
    /// Every value, in the order of menus.
    pub const ALL: [Self; 2] = [Self::Stored, Self::Linear];

    /// The name used in the command line and the interface.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Stored => "stored",
            Self::Linear => "linear",
        }
    }

    /// The straight 8-bit pixel `0xAARRGGBB` that is the mean of samples, of which there must be 1 to 256, rounded to
    /// nearest or truncated as `rules` say. Samples that are all alike are that pixel in either space.
    #[inline]
    pub fn resolve(self, samples: &[Premultiplied16], rules: Rules) -> u32 {
        match self {
            Self::Stored => stored_mean(samples, rules),
            Self::Linear if samples.windows(2).all(|pair| pair[0] == pair[1]) => stored_mean(samples, rules),
            Self::Linear => linear_mean(samples, rules),
        }
    }
}

impl Premultiplied16 {
    /// The sum of each channel of at most 256 colours.
    #[inline(always)]
    #[expect(clippy::cast_possible_truncation, reason = "halves of numbers")]
    pub fn sums(colors: &[Self]) -> [u32; 4] {
        const EVERY_OTHER: u64 = 0x0000_FFFF_0000_FFFF;
        let (mut red_blue, mut green_alpha) = (0, 0);
        for color in colors {
            let word = color.to_word();
            red_blue += word & EVERY_OTHER;
            green_alpha += word >> 16 & EVERY_OTHER;
        }
        [
            red_blue as u32,
            green_alpha as u32,
            (red_blue >> 32) as u32,
            (green_alpha >> 32) as u32,
        ]
    }

    /// The linear light of red, green and blue, weighted by alpha, and alpha; each in `0.0..=255.0`: what
    /// [`ResolveSpace::Linear`] averages.
    pub fn light(self) -> [f64; 4] {
        let [r, g, b, alpha] = self.0;
        let opacity = f64::from(alpha) / f64::from(Self::ONE);
        let of = |channel| f64::from(LIGHT[straight(channel, alpha)]) / ONE_LIGHT * 255.0 * opacity;
        [of(r), of(g), of(b), 255.0 * opacity]
    }
}

/// The stored value of linear light, both in `0.0..=255.0`: the way back.
pub fn encoded(light: f64) -> f64 {
    let light = light / 255.0;
    let stored = if light <= 0.003_130_8 {
        light * 12.92
    } else {
        1.055 * light.powf(1.0 / 2.4) - 0.055
    };
    stored * 255.0
}

#[inline]
fn stored_mean(samples: &[Premultiplied16], rules: Rules) -> u32 {
    Premultiplied16::resolve(
        Premultiplied16::sums(samples),
        u32::try_from(samples.len()).unwrap_or(u32::MAX),
        rules,
    )
}

/// Alpha is no light: its mean is that of the stored values. Each sample's light counts by its alpha.
fn linear_mean(samples: &[Premultiplied16], rules: Rules) -> u32 {
    let (mut sums, mut alphas) = ([0_u64; 3], 0_u32);
    for Premultiplied16([r, g, b, alpha]) in samples {
        alphas += u32::from(*alpha);
        for (sum, channel) in sums.iter_mut().zip([r, g, b]) {
            *sum += u64::from(LIGHT[straight(*channel, *alpha)]) * u64::from(*alpha);
        }
    }
    let count = u32::try_from(samples.len()).unwrap_or(u32::MAX);
    let opacity = Premultiplied16::resolve([0, 0, 0, alphas], count, rules) & 0xFF00_0000;
    if alphas == 0 {
        return opacity;
    }
    let least = match rules {
        Rules::Standard | Rules::Float => &LEAST[0],
        Rules::Course => &LEAST[1],
    };
    // A mean is at least some light where as many of it are no more than the sum: nothing is rounded before.
    let [r, g, b] = sums.map(|sum| {
        let byte = least.partition_point(|light| u64::from(*light) * u64::from(alphas) <= sum);
        u32::try_from(byte).unwrap_or(255)
    });
    opacity | r << 16 | g << 8 | b
}

/// The index of a premultiplied channel's straight value among all stored ones.
#[inline]
pub(super) fn straight(channel: u16, alpha: u16) -> usize {
    const ONE: u32 = Premultiplied16::ONE as u32;
    if alpha == Premultiplied16::ONE {
        return usize::from(channel.min(Premultiplied16::ONE));
    }
    let alpha = u32::from(alpha.max(1));
    ((u32::from(channel) * ONE + alpha / 2) / alpha).min(ONE) as usize
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The mean by the standard's formulas in 64-bit floats; straight channels in `0.0..=255.0`, and alpha.
    fn exact(samples: &[Premultiplied16]) -> [f64; 4] {
        let one = f64::from(Premultiplied16::ONE);
        let alphas: f64 = samples.iter().map(|sample| f64::from(sample.0[3]) / one).sum();
        let mut mean = [0.0; 4];
        for (k, mean) in mean.iter_mut().take(3).enumerate() {
            let lit: f64 = samples
                .iter()
                .filter(|sample| sample.0[3] > 0)
                .map(|sample| {
                    let (channel, alpha) = (f64::from(sample.0[k]), f64::from(sample.0[3]));
                    let stored = (channel / alpha).min(1.0);
                    let light = if stored <= 0.040_45 {
                        stored / 12.92
                    } else {
                        ((stored + 0.055) / 1.055).powf(2.4)
                    };
                    light * alpha / one
                })
                .sum();
            let light = if alphas > 0.0 { lit / alphas } else { 0.0 };
            let stored = if light <= 0.003_130_8 {
                light * 12.92
            } else {
                1.055 * light.powf(1.0 / 2.4) - 0.055
            };
            *mean = stored * 255.0;
        }
        mean[3] = alphas / samples.len() as f64 * 255.0;
        mean
    }

    #[test]
    fn linear_means_are_those_of_the_formulas() {
        arbtest::arbtest(|u| {
            let translucent = u.arbitrary()?;
            let mut sample = || -> arbtest::arbitrary::Result<Premultiplied16> {
                let alpha = if translucent {
                    u.int_in_range(0..=Premultiplied16::ONE)?
                } else {
                    Premultiplied16::ONE
                };
                Ok(Premultiplied16([
                    u.int_in_range(0..=alpha)?,
                    u.int_in_range(0..=alpha)?,
                    0,
                    alpha,
                ]))
            };
            let samples: Vec<_> = (0..17).map(|_| sample()).collect::<Result<_, _>>()?;
            let exact = exact(&samples);
            for (rules, rounding) in [(Rules::Standard, 0.5), (Rules::Course, 0.0)] {
                let [a, r, g, b] = ResolveSpace::Linear.resolve(&samples, rules).to_be_bytes();
                for (found, exact) in [r, g, b, a].into_iter().zip(exact) {
                    // A sample's straight value is one of 65281, and the curve is steepest in the dark.
                    let slack = if translucent { 0.02 } else { 0.0001 };
                    let (low, high) = ((exact - slack + rounding).floor(), (exact + slack + rounding).floor());
                    assert!(
                        f64::from(found) >= low && f64::from(found) <= high,
                        "{found} is not {exact} by {rules:?}: {samples:?}"
                    );
                }
            }
            Ok(())
        })
        .budget_ms(300);
    }

    #[test]
    fn half_black_half_white_is_half_the_light() {
        let samples = [
            Premultiplied16::from_bytes([0, 0, 0, 255]),
            Premultiplied16::from_bytes([255; 4]),
        ];
        assert_eq!(
            ResolveSpace::Linear.resolve(&samples, Rules::Standard),
            0xFFBC_BCBC,
            "188 stands for a half"
        );
        assert_eq!(
            ResolveSpace::Stored.resolve(&samples, Rules::Standard),
            0xFF80_8080,
            "128 is halfway stored"
        );
    }

    #[test]
    fn equal_samples_are_their_pixel_in_both_spaces() {
        for value in (0..=Premultiplied16::ONE).step_by(13) {
            for alpha in [value, Premultiplied16::ONE, 40_000] {
                let sample = Premultiplied16([value.min(alpha), 0, value.min(alpha) / 3, alpha]);
                for rules in Rules::ALL {
                    for space in ResolveSpace::ALL {
                        assert_eq!(
                            space.resolve(&[sample; 9], rules),
                            sample.to_pixel(rules),
                            "{sample:?} {rules:?} {space:?}"
                        );
                    }
                    // The curve and its way back lose nothing, but for the straight value of what is translucent.
                    if alpha == Premultiplied16::ONE {
                        assert_eq!(
                            linear_mean(&[sample; 4], rules),
                            sample.to_pixel(rules),
                            "{sample:?} {rules:?} there and back"
                        );
                    }
                }
            }
        }
    }

    #[test]
    fn nothing_and_an_opaque_sample_keep_their_colour() {
        let red = Premultiplied16::from_bytes([200, 30, 0, 255]);
        let mixed = ResolveSpace::Linear.resolve(&[red, Premultiplied16::TRANSPARENT], Rules::Standard);
        assert_eq!(mixed, 0x80C8_1E00, "half of it, in the same colour");
        let nothing = [Premultiplied16::TRANSPARENT, Premultiplied16([0, 0, 0, 0])];
        assert_eq!(ResolveSpace::Linear.resolve(&nothing, Rules::Standard), 0, "nothing");
    }
}
