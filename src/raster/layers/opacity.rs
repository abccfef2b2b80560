//! A layer that is painted as if it were one shape of some opacity.

use crate::color::{Premultiplied16, unit_to_16};
use crate::raster::layers::composite::Composite;

/// The opacity, of [`Premultiplied16::ONE`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Opacity(u16);

impl Opacity {
    pub(super) fn new(opacity: f32) -> Self {
        Self(unit_to_16(opacity.clamp(0.0, 1.0)))
    }
}

impl Composite for Opacity {
    #[inline]
    fn fragment(self, sample: Premultiplied16) -> Premultiplied16 {
        sample.faded(self.0)
    }

    fn opacity(self) -> f64 {
        f64::from(self.0) / f64::from(Premultiplied16::ONE)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::raster::layers::Compositing;
    use crate::rules::Rules;

    #[test]
    fn half_of_an_opaque_layer_lets_half_of_what_is_below_through() {
        let [white, black] = [255, 0].map(|value| Premultiplied16::from_bytes([value, value, value, 255]));
        let half = Compositing::with_opacity(0.5);
        assert_eq!(half.fragment(white), Premultiplied16([32_640; 4]), "half of it");
        let mixed = half.composited(white, black, Rules::Standard);
        assert_eq!(mixed, Premultiplied16([32_640, 32_640, 32_640, Premultiplied16::ONE]));
        let nothing = half.composited(Premultiplied16::TRANSPARENT, white, Rules::Standard);
        assert_eq!(nothing, white, "what is transparent changes nothing");
        assert_eq!(
            Compositing::with_opacity(7.0).opacity().to_bits(),
            1.0_f64.to_bits(),
            "clamped"
        );
    }
}
