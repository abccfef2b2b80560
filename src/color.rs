//! Colours: straight and premultiplied, floats and bytes. The only file that knows gamma.

use crate::rules::Rules;

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
        Rules::Standard => (scaled + 0.5) as u8,
        Rules::Course => scaled as u8,
    }
}
