//! A layer that is not seen: what lies below stays as far as the layer lets it.
//!
//! A clip path is such a layer, too. Its shapes are opaque, so that each sample is inside or outside, and no edge is
//! averaged before it is known what lies below.

use crate::color::Premultiplied16;
use crate::raster::layers::composite::Composite;
use crate::rules::Rules;

/// How much of each channel red, green and blue give to the luminance (SVG 2, section 14.4.2), of 65 536.
const LUMINANCE: [u32; 3] = [13_926, 46_884, 4_726];

/// What of the layer counts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Mask {
    /// Its opacity.
    Alpha,
    /// How light it is, times its opacity.
    Luminance,
}

impl Mask {
    pub(super) fn new(luminance: bool) -> Self {
        if luminance { Self::Luminance } else { Self::Alpha }
    }
}

impl Composite for Mask {
    /// White, as opaque as what lies below stays.
    #[inline]
    fn fragment(self, sample: Premultiplied16) -> Premultiplied16 {
        let kept = match self {
            Self::Alpha => sample.0[3],
            Self::Luminance => {
                let sum: u32 = (0..3).map(|i| u32::from(sample.0[i]) * LUMINANCE[i]).sum();
                u16::try_from((sum + 0x8000) >> 16).unwrap_or(u16::MAX)
            }
        };
        Premultiplied16([kept.min(Premultiplied16::ONE); 4])
    }

    #[inline]
    fn over(self, fragment: Premultiplied16, below: Premultiplied16, _: Rules) -> Premultiplied16 {
        below.faded(fragment.0[3])
    }

    fn hides(self, fragment: Premultiplied16) -> bool {
        fragment.0[3] == 0
    }

    fn opacity(self) -> f64 {
        1.0
    }

    fn keeps_below(self) -> bool {
        false
    }

    fn keeps_under(self, sample: Premultiplied16) -> bool {
        self.fragment(sample).is_opaque()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::raster::layers::Compositing;

    #[test]
    fn what_is_below_stays_as_far_as_the_mask_lets_it() {
        let below = Premultiplied16::from_bytes([200, 100, 50, 255]);
        let [alpha, luminance] = [false, true].map(Compositing::mask);
        let masked = |mask: Compositing, layer: [u8; 4]| {
            mask.composited(Premultiplied16::from_bytes(layer), below, Rules::Standard)
        };
        let nothing = Premultiplied16::TRANSPARENT;
        for layer in [[0, 0, 0, 255], [255; 4], [254; 4], [0; 4]].map(Premultiplied16::from_bytes) {
            for mask in [alpha, luminance] {
                let kept = mask.composited(layer, below, Rules::Standard) == below;
                assert_eq!(mask.keeps_under(layer), kept, "{mask:?} of {layer:?}");
            }
        }
        assert_eq!(masked(alpha, [0, 0, 0, 255]), below, "whatever its colour");
        assert_eq!(masked(alpha, [0; 4]), nothing);
        assert_eq!(masked(luminance, [255; 4]), below, "white lets all through");
        assert_eq!(masked(luminance, [0, 0, 0, 255]), nothing, "black nothing");
        let green = masked(luminance, [0, 255, 0, 255]).0[3];
        assert!(green.abs_diff(46_701) <= 1, "0.7154 of it: {green}");
        let half = masked(luminance, [128; 4]).0[3];
        assert_eq!(half, 128 * 256, "half a white");
    }
}
