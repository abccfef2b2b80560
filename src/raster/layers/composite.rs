//! What every way to composite a layer answers.

use crate::color::Premultiplied16;
use crate::rules::Rules;

/// How the samples of a finished layer are composited.
pub(super) trait Composite: Copy {
    /// The fragment that a sample of the layer becomes.
    fn fragment(self, sample: Premultiplied16) -> Premultiplied16;

    /// What a sample shows once a fragment is painted over it.
    #[inline]
    fn over(self, fragment: Premultiplied16, below: Premultiplied16, rules: Rules) -> Premultiplied16 {
        // Nothing shows through what is opaque, and most of a layer is.
        if fragment.is_opaque() && rules != Rules::Course {
            fragment
        } else {
            fragment.over(below, rules)
        }
    }

    /// Composites many samples of the layer with those below it.
    #[inline]
    fn composite(self, layer: &[Premultiplied16], below: &mut [Premultiplied16], rules: Rules) {
        self.each(layer, below, rules);
    }

    /// The same, one after the other.
    #[inline]
    fn each(self, layer: &[Premultiplied16], below: &mut [Premultiplied16], rules: Rules) {
        for (below, sample) in below.iter_mut().zip(layer) {
            // Most samples are where the layer is not. Under the course's rules painting nothing truncates, too.
            let nothing = sample.0[3] == 0 && self.keeps_below() && rules != Rules::Course;
            if !nothing {
                *below = self.over(self.fragment(*sample), *below, rules);
            }
        }
    }

    /// Whether samples at which the layer is transparent leave what is below them as it is.
    fn keeps_below(self) -> bool {
        true
    }

    /// Whether such a sample leaves what is below it as it is.
    fn keeps_under(self, sample: Premultiplied16) -> bool {
        self.keeps_below() && sample == Premultiplied16::TRANSPARENT
    }

    /// Whether samples of the layer over one colour become what the layer holds.
    fn is_copied(self, _layer: &[Premultiplied16], _below: Premultiplied16, _rules: Rules) -> bool {
        false
    }

    /// Whether nothing of what is below is left under such a fragment.
    fn hides(self, fragment: Premultiplied16) -> bool {
        fragment.is_opaque()
    }

    /// How much of the layer's own opacity is left, `0.0..=1.0`.
    fn opacity(self) -> f64;
}
