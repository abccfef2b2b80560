//! A layer that is painted as if it were one shape of some opacity.

use crate::color::{Premultiplied16, unit_to_16};
use crate::raster::layers::composite::Composite;
use crate::rules::Rules;

/// Samples that are looked at together.
const TOGETHER: usize = 16;

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

    #[inline]
    fn composite(self, layer: &[Premultiplied16], below: &mut [Premultiplied16], rules: Rules) {
        if rules == Rules::Course {
            return self.each(layer, below, rules);
        }
        if self.0 != Premultiplied16::ONE {
            return Premultiplied16::each_faded_over(self.0, layer, below);
        }
        // An isolated group is opaque or absent at most samples, and its neighbours are as it is.
        for (layer, below) in layer.chunks(TOGETHER).zip(below.chunks_mut(TOGETHER)) {
            let all = |is: fn(&Premultiplied16) -> bool| layer.iter().fold(true, |all, sample| all & is(sample));
            if all(|sample| sample.is_opaque()) {
                below.copy_from_slice(layer);
            } else if !all(|sample| sample.0[3] == 0) {
                self.each(layer, below, rules);
            }
        }
    }

    fn is_copied(self, layer: &[Premultiplied16], below: Premultiplied16, rules: Rules) -> bool {
        self.0 == Premultiplied16::ONE
            && rules != Rules::Course
            && (below == Premultiplied16::TRANSPARENT || layer.iter().all(|sample| sample.is_opaque()))
    }

    fn opacity(self) -> f64 {
        f64::from(self.0) / f64::from(Premultiplied16::ONE)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::raster::layers::Compositing;

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

    #[test]
    fn many_samples_are_composited_as_each_alone() {
        arbtest::arbtest(|u| {
            let mut color = || -> arbtest::arbitrary::Result<Premultiplied16> {
                let alpha = *u.choose(&[0, Premultiplied16::ONE, Premultiplied16::ONE, 300])?;
                Ok(Premultiplied16([u.int_in_range(0..=alpha)?, 0, alpha, alpha]))
            };
            // Some stretches are all opaque, or all absent.
            let mut layer = (0..40).map(|_| color()).collect::<Result<Vec<_>, _>>()?;
            let below = (0..97).map(|_| color()).collect::<Result<Vec<_>, _>>()?;
            layer.extend([Premultiplied16::TRANSPARENT; 25]);
            layer.extend([Premultiplied16::from_bytes([9, 8, 7, 255]); 32]);
            for rules in [Rules::Standard, Rules::Course] {
                for opacity in [1.0, 0.4] {
                    let way = Opacity::new(opacity);
                    let (mut together, mut alone) = (below.clone(), below.clone());
                    way.composite(&layer, &mut together, rules);
                    way.each(&layer, &mut alone, rules);
                    assert_eq!(together, alone, "{rules:?}, {opacity}");
                }
            }
            Ok(())
        })
        .budget_ms(100);
    }
}
