//! Linear light (IEC 61966-2-1): of stored values, summed up over samples, and as bytes again.
//!
//! Sums are whole numbers, so that it does not matter in which order samples are added, and whether one by one or so many
//! alike at once. From a sum to a byte leads a table: light is cut into pieces so narrow that two of them side by side hold
//! at most two steps from a byte to the next, and those are compared exactly.

use std::sync::LazyLock;

use super::Premultiplied16;
use crate::rules::Rules;

/// Linear light is kept in parts of this: fine enough to tell all stored values apart, and the sum of 256 samples times
/// their alpha fits 64 bits.
pub(super) const ONE_LIGHT: f64 = (1_u64 << 31) as f64;

/// Light that a piece of [`Steps::below`] spans: less than lies between any two bytes, which is least in the dark.
const PIECE_BITS: u32 = 19;
const PIECES: usize = (1 << (31 - PIECE_BITS)) + 1;

/// Linear light of every stored channel; all of it for numbers that are none.
static LIGHT: LazyLock<Box<[u32; 1 << 16]>> = LazyLock::new(|| {
    let mut all = Box::new([of_stored(Premultiplied16::ONE.into()); 1 << 16]);
    for (light, stored) in all.iter_mut().zip(0..=Premultiplied16::ONE) {
        *light = of_stored(stored.into());
    }
    all
});

/// How light becomes bytes, rounded to nearest; and truncated.
static STEPS: LazyLock<[Steps; 2]> = LazyLock::new(|| [0.5, 0.0].map(Steps::new));

/// Where light becomes the next byte.
#[derive(Debug)]
pub(super) struct Steps {
    /// The least light of each byte from 1 on, and more than all light.
    pub(super) least: [u32; 256],
    /// How many of these lie below the least light of each piece, or there.
    below: [u8; PIECES],
}

/// The light of some samples: red, green and blue weighted by alpha, and alpha.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Light([u64; 4]);

/// Makes pixels of the light of a fixed number of samples.
#[derive(Clone, Copy, Debug)]
pub struct LightResolver {
    count: u32,
    rules: Rules,
    steps: &'static Steps,
    light: &'static [u32; 1 << 16],
    /// What alpha sums up to where all are opaque, and how many pieces of light one unit of a sum is then.
    opaque: u64,
    per_opaque: f64,
}

/// Linear light of a stored channel.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "between nothing and ONE_LIGHT"
)]
fn of_stored(stored: f64) -> u32 {
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

impl Steps {
    /// With this much of a byte being enough for the next one's light to be `1 - below` away.
    fn new(below: f64) -> Self {
        let per_byte = f64::from(Premultiplied16::PER_BYTE);
        let mut least = [u32::MAX; 256];
        for (least, byte) in least.iter_mut().zip(1..=255_u8) {
            *least = of_stored((f64::from(byte) - below) * per_byte);
        }
        let mut pieces = [0; PIECES];
        for (piece, below) in (0_u64..).zip(&mut pieces) {
            let count = least.partition_point(|light| u64::from(*light) <= piece << PIECE_BITS);
            *below = u8::try_from(count).unwrap_or(u8::MAX);
        }
        Self { least, below: pieces }
    }

    /// As `rules` say.
    pub(super) fn of(rules: Rules) -> &'static Self {
        match rules {
            Rules::Standard | Rules::Float => &STEPS[0],
            Rules::Course => &STEPS[1],
        }
    }

    /// The byte for a sum of light weighted by alphas; `scale` is about what makes pieces of such a sum, and no more.
    #[inline]
    #[expect(
        clippy::cast_possible_truncation,
        reason = "a byte, and a piece's number of a sum below 2^56"
    )]
    fn byte(&self, sum: u64, alphas: u64, scale: f64) -> u32 {
        // Rounded to a whole number in the lowest bits: a conversion would care for numbers out of range.
        const WHOLE: f64 = (1_u64 << 52) as f64;
        let piece = (sum.cast_signed() as f64 * scale - 0.5).max(0.0) + WHOLE;
        let piece = (piece.to_bits() & 0xFFFF) as usize;
        let byte = usize::from(self.below[piece.min(PIECES - 1)]);
        // The sum lies in this piece or in the next one. A mean is at least some light where as many of it are no more than
        // the sum: nothing is rounded.
        let is_reached = |byte: usize| usize::from(u64::from(self.least[byte % 256]) * alphas <= sum);
        let (first, second) = (is_reached(byte), is_reached(byte + 1));
        (byte + first + (first & second)) as u32
    }
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
            steps: Steps::of(rules),
            light: &LIGHT,
            opaque,
            per_opaque: pieces_of(opaque),
        }
    }

    /// The pixel `0xAARRGGBB` of the light of all samples. Where these are all alike and not opaque, it may be another one than
    /// theirs: they lose nothing on the way only where they are opaque.
    #[inline]
    pub fn pixel(&self, Light([r, g, b, alphas]): Light) -> u32 {
        if alphas == self.opaque {
            let byte = |sum| self.steps.byte(sum, alphas, self.per_opaque);
            return 0xFF00_0000 | byte(r) << 16 | byte(g) << 8 | byte(b);
        }
        self.translucent([r, g, b], alphas)
    }

    #[inline(never)]
    fn translucent(&self, [r, g, b]: [u64; 3], alphas: u64) -> u32 {
        let sum = u32::try_from(alphas).unwrap_or(u32::MAX);
        let opacity = Premultiplied16::resolve([0, 0, 0, sum], self.count, self.rules) & 0xFF00_0000;
        if alphas == 0 {
            return opacity;
        }
        let scale = pieces_of(alphas);
        let byte = |sum| self.steps.byte(sum, alphas, scale);
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
        self.pixel(self.opaque_light(samples))
    }

    /// The light of opaque samples.
    #[inline]
    pub fn opaque_light(&self, samples: &[Premultiplied16]) -> Light {
        let mut sums = [0_u64; 3];
        for Premultiplied16([r, g, b, _]) in samples {
            for (sum, channel) in sums.iter_mut().zip([r, g, b]) {
                *sum += u64::from(self.light[usize::from(*channel)]);
            }
        }
        let [r, g, b] = sums.map(|sum| sum * u64::from(Premultiplied16::ONE));
        Light([r, g, b, samples.len() as u64 * u64::from(Premultiplied16::ONE)])
    }
}

/// What makes pieces of light of sums over these alphas, and a little less: so rounding never leads into the piece beyond.
fn pieces_of(alphas: u64) -> f64 {
    const LESS: f64 = 1.0 - 1.0 / (1_u64 << 40) as f64;
    LESS / (alphas as f64 * f64::from(1_u32 << PIECE_BITS))
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
                *sum += u64::from(of_stored(stored.into())) * u64::from(*alpha);
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
                let least = of_stored((f64::from(*byte) - below) * f64::from(Premultiplied16::PER_BYTE));
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
    fn every_step_from_byte_to_byte_is_where_its_least_light_is() {
        for rules in Rules::ALL {
            let steps = Steps::of(rules);
            for count in [1_u64, 3, 16, 256] {
                let alphas = count * u64::from(Premultiplied16::ONE);
                for (byte, least) in (1_u32..).zip(&steps.least[..255]) {
                    let sum = u64::from(*least) * alphas;
                    let of = |sum| steps.byte(sum, alphas, pieces_of(alphas));
                    assert_eq!((of(sum - 1), of(sum)), (byte - 1, byte), "{rules:?}, {count} samples");
                }
            }
            for pair in steps.least[..255].windows(2) {
                assert!(
                    pair[1] - pair[0] > 1 << PIECE_BITS,
                    "at most one step in a piece: {pair:?}"
                );
            }
        }
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
