//! From the mean light of opaque texels to bytes, by a look into a table: which bytes they are is what [`PyramidValues`] says.
//!
//! Between two neighbouring 32-bit floats lies each step from a byte to the next. Light is cut into pieces that hold at most one
//! step each, so that one comparison tells the byte.

use super::pyramid_values::PyramidValues;
use crate::color::Premultiplied16;

/// Pieces that light is cut into: a piece spans less than lies between any two bytes, which is least in the dark.
const PIECES: usize = 1 << 12;

/// Where light, which is 0 to 1, becomes the next byte.
#[derive(Debug)]
pub(super) struct LightBytes {
    /// The least light of each byte from 1 on, and more than all light.
    least: [f32; 256],
    /// How many of these each piece of light begins with, or has below it.
    below: [u8; PIECES + 1],
}

impl LightBytes {
    /// Those of values of light.
    pub(super) fn new(values: &PyramidValues) -> Self {
        let byte = |bits: u32| {
            let light = f32::from_bits(bits);
            values.texel([light, light, light, 1.0])[0]
        };
        let mut least = [f32::INFINITY; 256];
        for (least, next) in least.iter_mut().zip(1..=u8::MAX) {
            // Floats that are not below zero are in the order of their bits.
            let (mut below, mut above) = (0, 1.0_f32.to_bits());
            while above - below > 1 {
                let middle = u32::midpoint(below, above);
                if byte(middle) < next {
                    below = middle;
                } else {
                    above = middle;
                }
            }
            *least = f32::from_bits(above);
        }
        let mut pieces = [0; PIECES + 1];
        let mut start = 0.0;
        for below in &mut pieces {
            let count = least.partition_point(|light| *light <= start);
            *below = u8::try_from(count).unwrap_or(u8::MAX);
            start += 1.0 / PIECES as f32;
        }
        Self { least, below: pieces }
    }

    /// Whether so much alpha is all of it.
    #[inline]
    pub(super) fn is_opaque(alpha: f32) -> bool {
        let alpha = f64::from(alpha) * f64::from(Premultiplied16::ONE);
        let one = f64::from(Premultiplied16::ONE);
        (one - 0.5..one + 0.5).contains(&alpha)
    }

    /// The byte of this light.
    #[inline]
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "between nothing and the number of pieces"
    )]
    pub(super) fn byte(&self, light: f32) -> u8 {
        let light = light.clamp(0.0, 1.0);
        let below = self.below[((light * PIECES as f32) as usize).min(PIECES)];
        below + u8::from(self.least[usize::from(below)] <= light)
    }
}

#[cfg(test)]
mod tests {
    use super::super::PyramidFilter;
    use super::*;
    use crate::color::ResolveSpace;

    #[test]
    fn bytes_are_those_of_texels() {
        let values = PyramidValues::new(ResolveSpace::Linear, PyramidFilter::Box);
        let bytes = LightBytes::new(&values);
        let check = |light: f32| {
            let texel = values.texel([light, light, light, 1.0]);
            assert_eq!([bytes.byte(light), 255], [texel[0], texel[3]], "{light}");
        };
        for least in &bytes.least[..255] {
            for i in -3..=3 {
                check(f32::from_bits(least.to_bits().wrapping_add_signed(i)));
            }
        }
        let mut distances = bytes.least[..255].windows(2).map(|pair| pair[1] - pair[0]);
        assert!(
            distances.all(|between| between > 1.0 / PIECES as f32),
            "at most one step in a piece"
        );
        for i in 0..=60_000_u16 {
            check(f32::from(i) / 60_000.0);
        }
        for light in [-1.0, -1e-9, -0.0, 1.000_001, 7.0] {
            check(light);
        }
    }

    #[test]
    fn alpha_is_all_of_it_where_texels_are_opaque() {
        let values = PyramidValues::new(ResolveSpace::Linear, PyramidFilter::Box);
        for alpha in (0..4000_u16).map(|i| 1.0 + (f32::from(i) - 2000.0) / 1e8) {
            let texel = values.texel([0.5, 0.5, 0.5, alpha]);
            if LightBytes::is_opaque(alpha) {
                assert_eq!(texel, values.texel([0.5, 0.5, 0.5, 1.0]), "{alpha}");
            }
        }
        assert!(LightBytes::is_opaque(1.0) && !LightBytes::is_opaque(0.999) && !LightBytes::is_opaque(f32::NAN));
    }
}
