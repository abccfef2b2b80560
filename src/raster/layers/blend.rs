//! A layer whose colours are blended with those below it.

use crate::color::{BlendMode, Premultiplied16, unit_to_16};
use crate::raster::layers::composite::Composite;
use crate::rules::Rules;

/// Samples that are faded together.
const TOGETHER: usize = 64;

/// The mode, and the layer's opacity, of [`Premultiplied16::ONE`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Blend {
    mode: BlendMode,
    opacity: u16,
}

impl Blend {
    pub(super) fn new(mode: BlendMode, opacity: f32) -> Self {
        Self {
            mode,
            opacity: unit_to_16(opacity.clamp(0.0, 1.0)),
        }
    }
}

impl Composite for Blend {
    fn fragment(self, sample: Premultiplied16) -> Premultiplied16 {
        sample.faded(self.opacity)
    }

    fn over(self, fragment: Premultiplied16, below: Premultiplied16, rules: Rules) -> Premultiplied16 {
        self.mode.blend(fragment, below, rules)
    }

    fn composite(self, layer: &[Premultiplied16], below: &mut [Premultiplied16], rules: Rules) {
        if self.opacity == Premultiplied16::ONE {
            self.mode.blend_all(layer, below, rules);
            return;
        }
        let mut faded = [Premultiplied16::TRANSPARENT; TOGETHER];
        for (layer, below) in layer.chunks(TOGETHER).zip(below.chunks_mut(TOGETHER)) {
            let faded = &mut faded[..layer.len()];
            for (faded, sample) in faded.iter_mut().zip(layer) {
                *faded = self.fragment(*sample);
            }
            self.mode.blend_all(faded, below, rules);
        }
    }

    fn is_copied(self, _: &[Premultiplied16], below: Premultiplied16, rules: Rules) -> bool {
        self.opacity == Premultiplied16::ONE && rules != Rules::Course && below == Premultiplied16::TRANSPARENT
    }

    fn hides(self, fragment: Premultiplied16) -> bool {
        self.mode == BlendMode::Normal && fragment.is_opaque()
    }

    fn opacity(self) -> f64 {
        f64::from(self.opacity) / f64::from(Premultiplied16::ONE)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::raster::layers::Compositing;

    #[test]
    fn a_blended_layer_mixes_with_what_is_below_it() {
        let color = |bytes| Premultiplied16::from_bytes(bytes);
        let multiply = Compositing::blended(BlendMode::Multiply, 1.0);
        let mixed = multiply.composited(color([255, 0, 0, 255]), color([128, 128, 0, 255]), Rules::Standard);
        assert_eq!(mixed, color([128, 0, 0, 255]), "what both let through");
        let half = Compositing::blended(BlendMode::Multiply, 0.5);
        let mixed = half.composited(color([0, 0, 0, 255]), color([255; 4]), Rules::Standard);
        assert_eq!(
            mixed,
            Premultiplied16([32_640, 32_640, 32_640, Premultiplied16::ONE]),
            "half of it"
        );
    }
}
