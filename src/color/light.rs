//! Linear light (IEC 61966-2-1) summed up over samples, and as bytes again.
//!
//! Sums are whole numbers, so that it does not matter in which order samples are added, and whether one by one or so many
//! alike at once.

use std::sync::LazyLock;

use super::Premultiplied16;
use super::light_scale::{Steps, whole_light};
use crate::rules::Rules;

/// Bits of linear light: fine enough to tell all stored values apart, and the sum of 256 samples times their alpha fits 64 bits.
const BITS: u32 = 31;
pub(super) const ALL_LIGHT: u64 = 1 << BITS;
pub(super) const ONE_LIGHT: f64 = ALL_LIGHT as f64;

/// Linear light of every stored channel; all of it for numbers that are none.
static LIGHT: LazyLock<Box<[u32; 1 << 16]>> = LazyLock::new(|| {
    let mut all = Box::new([whole_light::<BITS>(Premultiplied16::ONE.into()); 1 << 16]);
    for (light, stored) in all.iter_mut().zip(0..=Premultiplied16::ONE) {
        *light = whole_light::<BITS>(stored.into());
    }
    all
});

/// Linear light of every byte.
static LIGHT_OF_BYTES: LazyLock<[u32; 256]> =
    LazyLock::new(|| std::array::from_fn(|byte| LIGHT[byte * usize::from(Premultiplied16::PER_BYTE)]));

/// How light becomes bytes.
static STEPS: LazyLock<[Steps<BITS>; 2]> = LazyLock::new(Steps::both);

/// The light of some samples: red, green and blue weighted by alpha, and alpha.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Light([u64; 4]);

/// Makes pixels of the light of a fixed number of samples.
#[derive(Clone, Copy, Debug)]
pub struct LightResolver {
    count: u32,
    rules: Rules,
    steps: &'static Steps<BITS>,
    light: &'static [u32; 1 << 16],
    /// What alpha sums up to where all are opaque.
    opaque: u64,
    /// What divides by the number of samples: `2^63` by it, rounded up.
    reciprocal: u64,
}

impl Light {
    /// The light of one sample.
    #[inline]
    pub fn new(color: Premultiplied16) -> Self {
        of_color(&LIGHT, color)
    }

    /// Straight red, green and blue of what some colours with these weights show together, in parts of [`ONE_LIGHT`]; weights add
    /// up to `2^16`.
    pub(super) fn mean(colors: [Premultiplied16; 2], weights: [u32; 2]) -> [u32; 3] {
        let [a, b] = colors.map(|color| Self::new(color).0);
        // At most 31 bits of light, 16 of alpha and 16 of weight.
        let sum = |k: usize| a[k] * u64::from(weights[0]) + b[k] * u64::from(weights[1]);
        let alphas = sum(3).max(1);
        [0, 1, 2].map(|k| u32::try_from((sum(k) + alphas / 2) / alphas).unwrap_or(u32::MAX))
    }

    /// Red, green and blue weighted by alpha, and alpha, of one sample: `0.0..=1.0`.
    #[inline]
    #[expect(clippy::cast_possible_truncation, reason = "between 0 and 1")]
    pub fn weighted(self) -> [f32; 4] {
        let Self([r, g, b, alpha]) = self;
        let one = f64::from(Premultiplied16::ONE);
        let light = |sum: u64| (sum as f64 / (one * ONE_LIGHT)) as f32;
        [light(r), light(g), light(b), (alpha as f64 / one) as f32]
    }

    /// The light of one sample from its [`Light::weighted`] parts, rounded.
    #[inline]
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "not below 0; `as` saturates"
    )]
    pub fn of_weighted([r, g, b, alpha]: [f32; 4]) -> Self {
        let one = f64::from(Premultiplied16::ONE);
        let light = |part: f32| (f64::from(part) * one * ONE_LIGHT).round() as u64;
        Self([light(r), light(g), light(b), (f64::from(alpha) * one).round() as u64])
    }

    /// Red, green and blue of so many opaque samples, in parts of [`ONE_LIGHT`].
    #[inline]
    pub(crate) fn of_opaque(sums: [u64; 3], count: u32) -> Self {
        let opaque = u64::from(Premultiplied16::ONE);
        let [r, g, b] = sums.map(|sum| sum * opaque);
        Self([r, g, b, u64::from(count) * opaque])
    }

    /// Red of opaque samples, in parts of all light.
    #[cfg(test)]
    pub(crate) fn opaque_red(self) -> u64 {
        self.0[0] / u64::from(Premultiplied16::ONE)
    }

    /// So many times the same.
    #[inline]
    #[must_use]
    pub fn times(self, count: u32) -> Self {
        Self(self.0.map(|sum| sum * u64::from(count)))
    }
}

impl std::ops::AddAssign for Light {
    #[inline]
    fn add_assign(&mut self, other: Self) {
        for (sum, light) in self.0.iter_mut().zip(other.0) {
            *sum += light;
        }
    }
}

impl LightResolver {
    /// For `count` samples per pixel, 1 to 256.
    pub fn new(count: u32, rules: Rules) -> Self {
        let opaque = u64::from(count) * u64::from(Premultiplied16::ONE);
        Self {
            count,
            rules,
            steps: Steps::by_rules(&STEPS, rules),
            light: &LIGHT,
            opaque,
            reciprocal: (1_u64 << 63).div_ceil(u64::from(count.max(1))),
        }
    }

    /// The pixel `0xAARRGGBB` of the light of all samples. Where these are all alike and not opaque, it may be another one than
    /// theirs: they lose nothing on the way only where they are opaque.
    #[inline]
    pub fn pixel(&self, Light([r, g, b, alphas]): Light) -> u32 {
        if alphas == self.opaque {
            return self.opaque_pixel([r, g, b].map(|sum| sum / u64::from(Premultiplied16::ONE)));
        }
        self.translucent([r, g, b], alphas)
    }

    /// Samples per pixel.
    #[inline]
    pub(super) fn count(&self) -> u32 {
        self.count
    }

    /// How means are rounded.
    pub(super) fn rules(&self) -> Rules {
        self.rules
    }

    /// The light of each stored channel of an opaque colour, in parts of [`ONE_LIGHT`].
    #[inline]
    pub(super) fn of_stored(&self) -> &'static [u32; 1 << 16] {
        self.light
    }

    /// The light of each byte of an opaque colour.
    pub(crate) fn of_bytes() -> &'static [u32; 256] {
        &LIGHT_OF_BYTES
    }

    /// The pixel of the light of all samples, which are opaque, in parts of [`ONE_LIGHT`].
    #[inline]
    #[expect(clippy::cast_possible_truncation, reason = "a product of at most 39 and 63 bits")]
    pub(crate) fn opaque_pixel(&self, [r, g, b]: [u64; 3]) -> u32 {
        // What rounding the reciprocal up adds is less than the part of one sample: the whole part of the mean stays.
        let byte = |sum: u64| {
            let mean = (u128::from(sum) * u128::from(self.reciprocal)) >> 63;
            self.steps.byte(mean as u64)
        };
        0xFF00_0000 | byte(r) << 16 | byte(g) << 8 | byte(b)
    }

    #[inline(never)]
    fn translucent(&self, [r, g, b]: [u64; 3], alphas: u64) -> u32 {
        let sum = u32::try_from(alphas).unwrap_or(u32::MAX);
        let opacity = Premultiplied16::resolve([0, 0, 0, sum], self.count, self.rules) & 0xFF00_0000;
        if alphas == 0 {
            return opacity;
        }
        let byte = |sum: u64| self.steps.byte(sum / alphas);
        opacity | byte(r) << 16 | byte(g) << 8 | byte(b)
    }

    /// The mean of samples, of which there are as many as a pixel has; those that are all alike are their pixel.
    #[inline]
    pub fn mean(&self, samples: &[Premultiplied16]) -> u32 {
        let Some(first) = samples.first() else {
            return 0;
        };
        let (mut differ, mut translucent) = (0, 0);
        for sample in samples {
            let word = sample.to_word();
            differ |= word ^ first.to_word();
            translucent |= sample.0[3] ^ Premultiplied16::ONE;
        }
        if differ == 0 {
            return first.to_pixel(self.rules);
        }
        if translucent != 0 {
            let mut sum = Light::default();
            for sample in samples {
                sum += of_color(self.light, *sample);
            }
            return self.pixel(sum);
        }
        self.opaque_mean(samples)
    }

    /// As [`LightResolver::mean`] of opaque samples.
    #[inline]
    pub fn opaque_mean(&self, samples: &[Premultiplied16]) -> u32 {
        self.opaque_pixel(self.opaque_sums(samples))
    }

    /// The light of opaque samples.
    #[inline]
    pub fn opaque_light(&self, samples: &[Premultiplied16]) -> Light {
        // A pixel has few samples.
        Light::of_opaque(
            self.opaque_sums(samples),
            u32::try_from(samples.len()).unwrap_or(u32::MAX),
        )
    }

    /// The light of opaque samples in parts of [`ONE_LIGHT`].
    #[inline]
    fn opaque_sums(&self, samples: &[Premultiplied16]) -> [u64; 3] {
        let mut sums = [0_u64; 3];
        for Premultiplied16([r, g, b, _]) in samples {
            for (sum, channel) in sums.iter_mut().zip([r, g, b]) {
                *sum += u64::from(self.light[usize::from(*channel)]);
            }
        }
        sums
    }
}

/// The stored channel whose light is nearest: the way back from [`ONE_LIGHT`] parts.
pub(super) fn stored_light(light: u32) -> u16 {
    let known = &LIGHT[..=usize::from(Premultiplied16::ONE)];
    let above = known.partition_point(|known| *known < light).min(known.len() - 1);
    let below = above.saturating_sub(1);
    let nearest = if known[above].abs_diff(light) <= known[below].abs_diff(light) {
        above
    } else {
        below
    };
    u16::try_from(nearest).unwrap_or(Premultiplied16::ONE)
}

#[inline]
fn of_color(light: &[u32; 1 << 16], color: Premultiplied16) -> Light {
    let Premultiplied16([r, g, b, alpha]) = color;
    let weight = u64::from(alpha);
    let of = |channel| u64::from(light[usize::from(straight(channel, alpha))]) * weight;
    Light([of(r), of(g), of(b), weight])
}

/// The straight value of a premultiplied channel.
#[inline]
pub(super) fn straight(channel: u16, alpha: u16) -> u16 {
    const ONE: u32 = Premultiplied16::ONE as u32;
    if alpha == Premultiplied16::ONE {
        return channel.min(Premultiplied16::ONE);
    }
    let alpha = u32::from(alpha.max(1));
    ((u32::from(channel) * ONE + alpha / 2) / alpha).min(ONE) as u16
}

impl Premultiplied16 {
    /// The linear light of red, green and blue, weighted by alpha, and alpha; each in `0.0..=255.0`: what
    /// [`super::ResolveSpace::Linear`] averages.
    pub fn light(self) -> [f64; 4] {
        let [r, g, b, alpha] = self.0;
        let opacity = f64::from(alpha) / f64::from(Self::ONE);
        let of = |channel| f64::from(LIGHT[usize::from(straight(channel, alpha))]) / ONE_LIGHT * 255.0 * opacity;
        [of(r), of(g), of(b), 255.0 * opacity]
    }
}

#[cfg(test)]
mod tests {
    use arbtest::arbitrary::{Result, Unstructured};

    use super::*;

    /// The mean as it is defined: each byte's least light against the sum, one after the other.
    fn plain_mean(samples: &[Premultiplied16], rules: Rules) -> u32 {
        let (mut sums, mut alphas) = ([0_u64; 3], 0_u32);
        for Premultiplied16([r, g, b, alpha]) in samples {
            alphas += u32::from(*alpha);
            for (sum, channel) in sums.iter_mut().zip([r, g, b]) {
                let stored = straight(*channel, *alpha);
                *sum += u64::from(whole_light::<BITS>(stored.into())) * u64::from(*alpha);
            }
        }
        let count = u32::try_from(samples.len()).expect("a few");
        let opacity = Premultiplied16::resolve([0, 0, 0, alphas], count, rules) & 0xFF00_0000;
        if alphas == 0 {
            return opacity;
        }
        let below = if rules == Rules::Course { 0.0 } else { 0.5 };
        let [r, g, b] = sums.map(|sum| {
            let is_reached = |byte: &u32| {
                let least = whole_light::<BITS>((f64::from(*byte) - below) * f64::from(Premultiplied16::PER_BYTE));
                u64::from(least) * u64::from(alphas) <= sum
            };
            (1..=255).take_while(is_reached).count()
        });
        let byte = |count: usize| u32::try_from(count).expect("a byte");
        opacity | byte(r) << 16 | byte(g) << 8 | byte(b)
    }

    fn color(u: &mut Unstructured<'_>, opaque: bool) -> Result<Premultiplied16> {
        let mut channel = || u.int_in_range(0..=Premultiplied16::ONE);
        let alpha = if opaque { Premultiplied16::ONE } else { channel()? };
        // Dark ones, too, where bytes are closest.
        let mut below = |shift: u16| Ok((channel()? >> shift).min(alpha));
        Ok(Premultiplied16([below(0)?, below(3)?, below(7)?, alpha]))
    }

    #[test]
    fn means_by_table_are_those_of_the_definition() {
        arbtest::arbtest(|u| {
            let rules = *u.choose(&Rules::ALL)?;
            let opaque = u.arbitrary()?;
            let count = *u.choose(&[1_u32, 2, 4, 5, 16, 64, 256])?;
            let [first, second] = [color(u, opaque)?, color(u, opaque)?];
            let samples: Vec<_> = (0..count)
                .map(|_| match u.int_in_range(0..=2)? {
                    0 => Ok(first),
                    1 => Ok(second),
                    _ => color(u, opaque),
                })
                .collect::<Result<_>>()?;
            let resolver = LightResolver::new(count, rules);
            let alike = samples.iter().all(|sample| *sample == samples[0]);
            let expected = if alike {
                samples[0].to_pixel(rules)
            } else {
                plain_mean(&samples, rules)
            };
            assert_eq!(resolver.mean(&samples), expected, "{samples:?} {rules:?}");
            if opaque {
                assert_eq!(resolver.opaque_mean(&samples), expected, "{samples:?} {rules:?}");
            }
            if !alike {
                let mut sum = Light::default();
                for sample in &samples {
                    sum += Light::new(*sample);
                }
                assert_eq!(resolver.pixel(sum), expected, "by its sum: {samples:?} {rules:?}");
            }
            Ok(())
        })
        .budget_ms(500);
    }

    #[test]
    fn opaque_light_is_its_byte_again() {
        for rules in Rules::ALL {
            let resolver = LightResolver::new(4, rules);
            for stored in 0..=Premultiplied16::ONE {
                let color = Premultiplied16([stored, stored, stored, Premultiplied16::ONE]);
                assert_eq!(
                    resolver.pixel(Light::new(color).times(4)),
                    color.to_pixel(rules),
                    "{stored} there and back"
                );
            }
        }
    }
}
