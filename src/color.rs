//! Colours: straight and premultiplied, floats and bytes. The only file that knows gamma.

mod blend;
mod blend_all;
mod colormap;
mod light;
mod light_scale;
mod mix;
mod near_light;
mod over;
mod ramp;
mod resolve;
mod resolver;
mod running_sums;
mod sample_mean;
mod spaces;
mod sum_bounds;
mod value_spread;
mod weighted;

use fearless_simd::{Simd, dispatch};

use crate::rules::Rules;
use crate::simd;

pub use blend::BlendMode;
pub use colormap::Colormap;
pub use light::{Light, LightResolver};
pub(crate) use near_light::{NearLight, certain_bytes, certain_bytes_of_light, near_light, near_light_of_stored};
pub use ramp::{Mix, Ramp, Spread, Stop, Stretch};
pub use resolve::{ResolveSpace, encoded};
pub use resolver::Resolver;
pub(crate) use running_sums::RunningSums;
pub use sample_mean::SampleMean;
pub use spaces::ColorSpace;
pub(crate) use sum_bounds::{SumBounds, sums_between};
pub(crate) use value_spread::{PIXELS, SpreadLimits, ValueLimits, ValueSpread};
pub use weighted::WeightedSum;

/// A straight (not premultiplied) sRGB-encoded colour; each channel and alpha in `0.0..=1.0`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rgba {
    /// Red, sRGB-encoded.
    pub r: f32,
    /// Green, sRGB-encoded.
    pub g: f32,
    /// Blue, sRGB-encoded.
    pub b: f32,
    /// Opacity.
    pub a: f32,
}

impl Rgba {
    /// Opaque black.
    pub const BLACK: Self = Self::opaque(0.0, 0.0, 0.0);
    /// Opaque white.
    pub const WHITE: Self = Self::opaque(1.0, 1.0, 1.0);
    /// Nothing at all.
    pub const TRANSPARENT: Self = Self {
        r: 0.0,
        g: 0.0,
        b: 0.0,
        a: 0.0,
    };

    /// A colour that hides what is below it.
    pub const fn opaque(r: f32, g: f32, b: f32) -> Self {
        Self { r, g, b, a: 1.0 }
    }

    /// From straight bytes.
    pub fn from_bytes([r, g, b, a]: [u8; 4]) -> Self {
        let unit = |byte: u8| f32::from(byte) / 255.0;
        Self {
            r: unit(r),
            g: unit(g),
            b: unit(b),
            a: unit(a),
        }
    }

    /// The same colour with its opacity multiplied by `opacity`.
    #[must_use]
    pub fn faded(self, opacity: f32) -> Self {
        Self {
            a: self.a * opacity,
            ..self
        }
    }

    /// Straight bytes, each rounded or truncated as `rules` say.
    pub fn to_bytes(self, rules: Rules) -> [u8; 4] {
        [self.r, self.g, self.b, self.a].map(|channel| unit_to_byte(channel, rules))
    }
}

/// A channel in `0.0..=1.0` (clamped) as a byte: rounded to nearest, or truncated under the course's rules.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "clamped to 0..=255 first; NaN becomes 0"
)]
pub fn unit_to_byte(channel: f32, rules: Rules) -> u8 {
    let scaled = channel.clamp(0.0, 1.0) * 255.0;
    match rules {
        Rules::Standard | Rules::Float => (scaled + 0.5) as u8,
        Rules::Course => scaled as u8,
    }
}

/// The linear light of an sRGB-encoded channel; both in `0.0..=1.0` (IEC 61966-2-1).
pub fn srgb_to_linear(stored: f32) -> f32 {
    if stored <= 0.040_45 {
        stored / 12.92
    } else {
        ((stored + 0.055) / 1.055).powf(2.4)
    }
}

/// The sRGB-encoded channel of linear light; the inverse of [`srgb_to_linear`].
pub fn linear_to_srgb(light: f32) -> f32 {
    if light <= 0.003_130_8 {
        light * 12.92
    } else {
        1.055 * light.powf(1.0 / 2.4) - 0.055
    }
}

/// A premultiplied sRGB-encoded colour as samples store it: 16 bits per channel, red green blue alpha.
///
/// A byte `c` is stored as `256 c`, exactly, so that opaque flat colours come out of a frame as they went in, and so is
/// one half, so that half of white over black is the middle; the extra bits keep interpolated, filtered and blended
/// colours exact to far less than a byte.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Premultiplied16(pub [u16; 4]);

impl Premultiplied16 {
    /// Nothing at all.
    pub const TRANSPARENT: Self = Self([0; 4]);
    /// What one level of a byte is worth.
    pub const PER_BYTE: u16 = 256;
    /// The largest value of a channel.
    pub const ONE: u16 = 255 * Self::PER_BYTE;

    /// What every fragment adds where fragments are counted: it lets all shine through that is below it. Red is the mean
    /// number of fragments in eighths, as a byte.
    pub const FRAGMENT: Self = Self([Self::PER_BYTE * Self::FRAGMENT_BYTES, 0, 0, 0]);
    /// What one fragment is worth in a resolved byte where fragments are counted.
    pub const FRAGMENT_BYTES: u16 = 8;

    /// From a straight colour. The course's rules first truncate the channels to bytes.
    pub fn from_straight(color: Rgba, rules: Rules) -> Self {
        let alpha = color.a.clamp(0.0, 1.0);
        let channel = |value: f32| match rules {
            Rules::Course if alpha >= 1.0 => unit_to_byte(value, rules).into_16(),
            Rules::Standard | Rules::Course | Rules::Float => unit_to_16(value.clamp(0.0, 1.0) * alpha),
        };
        Self([channel(color.r), channel(color.g), channel(color.b), unit_to_16(alpha)])
    }

    /// From premultiplied bytes; exact.
    #[inline]
    pub fn from_bytes(channels: [u8; 4]) -> Self {
        Self(channels.map(Into16::into_16))
    }

    /// As one number, red in its lowest 16 bits.
    #[inline]
    pub fn to_word(self) -> u64 {
        let [r, g, b, a] = self.0.map(u64::from);
        r | g << 16 | b << 32 | a << 48
    }

    /// From one number that holds the channels, red in its lowest 16 bits.
    #[inline]
    #[expect(clippy::cast_possible_truncation, reason = "the lowest bits are meant")]
    pub fn from_word(word: u64) -> Self {
        Self([
            word as u16,
            (word >> 16) as u16,
            (word >> 32) as u16,
            (word >> 48) as u16,
        ])
    }

    /// From premultiplied channels in `0.0..=255.0`, such as filtered texels; rounded to nearest, or truncated to bytes
    /// under the course's rules.
    #[inline]
    pub fn from_byte_range(channels: [f32; 4], rules: Rules) -> Self {
        /// `2^23`: at this size a 32-bit float holds whole numbers only, so that adding it rounds; no conversion of a
        /// float to an integer is as cheap, since those must also care for numbers out of range.
        const WHOLE: f32 = 8_388_608.0;
        let whole = |value: f32| (value + WHOLE).to_bits().to_le_bytes();
        Self(channels.map(|channel| match rules {
            Rules::Standard | Rules::Float => {
                let [low, high, ..] = whole(channel * f32::from(Self::PER_BYTE));
                u16::from_le_bytes([low, high])
            }
            Rules::Course => {
                let [nearest, ..] = whole(channel);
                (nearest - u8::from(f32::from(nearest) > channel)).into_16()
            }
        }))
    }

    /// The same colour with every channel cut to a byte.
    #[inline]
    #[must_use]
    pub(crate) fn truncated(self) -> Self {
        Self(self.0.map(|channel| channel / Self::PER_BYTE * Self::PER_BYTE))
    }

    /// Whether it hides what is below it.
    #[inline]
    pub fn is_opaque(self) -> bool {
        self.0[3] == Self::ONE
    }

    /// The same colour at a fraction of its opacity.
    #[inline]
    #[must_use]
    pub fn faded(self, opacity: u16) -> Self {
        if opacity == Self::ONE {
            return self;
        }
        Self(self.0.map(|channel| {
            let scaled = div_one(u32::from(channel) * u32::from(opacity));
            u16::try_from(scaled).unwrap_or(u16::MAX)
        }))
    }

    /// The straight 8-bit pixel `0xAARRGGBB` of a pixel whose samples all have this colour; the same as
    /// [`Premultiplied16::resolve`] of one of them, and much cheaper where it is opaque.
    #[inline]
    pub fn to_pixel(self, rules: Rules) -> u32 {
        if !self.is_opaque() {
            return Self::resolve(self.0.map(u32::from), 1, rules);
        }
        let half = match rules {
            Rules::Standard | Rules::Float => Self::PER_BYTE / 2,
            Rules::Course => 0,
        };
        // A channel is at most `ONE`, so that the sum neither overflows nor exceeds a byte.
        let [r, g, b, _] = self.0.map(|channel| u32::from((channel + half) / Self::PER_BYTE));
        0xFF00_0000 | r << 16 | g << 8 | b
    }

    /// [`Premultiplied16::to_pixel`] of many opaque colours.
    pub fn opaque_to_pixels(colors: &[Self], rules: Rules, pixels: &mut [u32]) {
        dispatch!(simd::level(), simd => Self::opaque_to_pixels_with(simd, colors, rules, pixels));
    }

    /// Four channels at once in one 64-bit number.
    #[inline(always)]
    #[expect(clippy::inline_always, reason = "vector instructions reach inlined code only")]
    fn opaque_to_pixels_with<S: Simd>(_: S, colors: &[Self], rules: Rules, pixels: &mut [u32]) {
        let half = match rules {
            Rules::Standard | Rules::Float => 0x0080_0080_0080_0080,
            Rules::Course => 0,
        };
        for (pixel, color) in pixels.iter_mut().zip(colors) {
            // A byte in every other byte, red in the lowest one.
            let spread = (color.to_word() + half) >> 8;
            let (red, green) = ((spread & 0xFF) << 16, spread >> 8 & 0xFF00);
            let (blue, alpha) = (spread >> 32 & 0xFF, spread >> 24 & 0xFF00_0000);
            *pixel = low_half(red | green | blue | alpha);
        }
    }

    /// The straight 8-bit pixel `0xAARRGGBB` that is the mean of `count` samples with these channel sums, rounded to
    /// nearest or truncated as `rules` say.
    #[inline]
    pub fn resolve(sums: [u32; 4], count: u32, rules: Rules) -> u32 {
        let full = u32::from(Self::PER_BYTE) * count;
        let alpha = divide(sums[3], full, rules);
        let [r, g, b] = if sums[3] == u32::from(Self::ONE) * count {
            [sums[0], sums[1], sums[2]].map(|sum| divide(sum, full, rules))
        } else if sums[3] == 0 {
            [0; 3]
        } else {
            [sums[0], sums[1], sums[2]].map(|sum| divide_wide(u64::from(sum) * 255, u64::from(sums[3]), rules))
        };
        alpha << 24 | r << 16 | g << 8 | b
    }
}

/// Bytes as 16-bit channels.
trait Into16 {
    /// `0..=255` onto `0..=Premultiplied16::ONE`, exactly.
    fn into_16(self) -> u16;
}

impl Into16 for u8 {
    #[inline]
    fn into_16(self) -> u16 {
        u16::from(self) * Premultiplied16::PER_BYTE
    }
}

/// A channel in `0.0..=1.0` (clamped) as 16 bits, rounded to nearest.
#[inline]
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "`as` saturates at both ends of u16"
)]
pub fn unit_to_16(channel: f32) -> u16 {
    (channel * f32::from(Premultiplied16::ONE) + 0.5) as u16
}

/// The product of two channels as a channel, rounded to nearest.
#[inline]
fn div_one(product: u32) -> u32 {
    const ONE: u32 = Premultiplied16::ONE as u32;
    // `ONE * ONE + ONE / 2` fits 32 bits.
    (product + ONE / 2) / ONE
}

/// `sum / full` as `rules` round it, at most 255. Where the number of samples is a power of two, `full` is one too.
#[inline]
fn divide(sum: u32, full: u32, rules: Rules) -> u32 {
    let sum = match rules {
        Rules::Standard | Rules::Float => sum + full / 2,
        Rules::Course => sum,
    };
    let mean = if full.is_power_of_two() {
        sum >> full.trailing_zeros()
    } else {
        sum / full
    };
    mean.min(255)
}

/// The lower 32 bits.
#[inline]
#[expect(clippy::cast_possible_truncation, reason = "the caller wants just these bits")]
fn low_half(word: u64) -> u32 {
    word as u32
}

fn divide_wide(sum: u64, full: u64, rules: Rules) -> u32 {
    let rounded = match rules {
        Rules::Standard | Rules::Float => (sum + full / 2) / full,
        Rules::Course => sum / full,
    };
    u32::try_from(rounded).unwrap_or(255).min(255)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bytes_survive_both_rules() {
        for byte in 0..=255 {
            let color = Rgba::from_bytes([byte, 0, 255, 255]);
            for rules in Rules::ALL {
                assert_eq!(color.to_bytes(rules), [byte, 0, 255, 255], "{rules:?} as bytes");
                let stored = Premultiplied16::from_straight(color, rules);
                let sums = stored.0.map(u32::from);
                let pixel = Premultiplied16::resolve(sums, 1, rules);
                assert_eq!(pixel, 0xFF00_00FF | u32::from(byte) << 16, "{rules:?} through a sample");
            }
        }
    }

    #[test]
    fn pixel_of_one_colour_is_the_pixel_of_its_mean() {
        for value in (0..=Premultiplied16::ONE).step_by(17) {
            for alpha in [Premultiplied16::ONE, value, 30_000] {
                let color = Premultiplied16([value.min(alpha), 0, (value / 2).min(alpha), alpha]);
                for rules in Rules::ALL {
                    let mean = Premultiplied16::resolve(color.0.map(|channel| 4 * u32::from(channel)), 4, rules);
                    assert_eq!(color.to_pixel(rules), mean, "{color:?} under {rules:?}");
                    if color.is_opaque() {
                        let mut pixels = [0; 3];
                        Premultiplied16::opaque_to_pixels(&[color; 3], rules, &mut pixels);
                        assert_eq!(pixels, [mean; 3], "many of {color:?} under {rules:?}");
                    }
                }
            }
        }
    }

    #[test]
    fn over_keeps_opaque_and_transparent_exact() {
        let red = Premultiplied16::from_straight(Rgba::opaque(1.0, 0.25, 0.0), Rules::Standard);
        let blue = Premultiplied16::from_straight(Rgba::opaque(0.0, 0.0, 1.0), Rules::Standard);
        assert_eq!(red.over(blue, Rules::Standard), red, "opaque hides");
        assert_eq!(
            Premultiplied16::TRANSPARENT.over(blue, Rules::Standard),
            blue,
            "transparent leaves alone"
        );
        let half = Premultiplied16::from_straight(Rgba { a: 0.5, ..Rgba::WHITE }, Rules::Standard);
        let mixed = half.over(
            Premultiplied16::from_straight(Rgba::BLACK, Rules::Standard),
            Rules::Standard,
        );
        assert_eq!(mixed.0, [32_640, 32_640, 32_640, 65_280], "half white over black");
    }

    #[test]
    fn resolve_rounds_halves_up_or_truncates() {
        let sums = [256, 256 * 3, 0, 65_280 * 2];
        assert_eq!(
            Premultiplied16::resolve(sums, 2, Rules::Standard),
            0xFF01_0200,
            "0.5 and 1.5 go up"
        );
        assert_eq!(
            Premultiplied16::resolve(sums, 2, Rules::Course),
            0xFF00_0100,
            "and down"
        );
    }

    #[test]
    fn resolve_gives_straight_colour() {
        let half = Premultiplied16::from_straight(
            Rgba {
                r: 1.0,
                g: 0.5,
                b: 0.0,
                a: 0.5,
            },
            Rules::Standard,
        );
        let pixel = Premultiplied16::resolve(half.0.map(u32::from), 1, Rules::Standard);
        assert_eq!(pixel, 0x80FF_8000, "red stays full under half opacity");
    }
}
