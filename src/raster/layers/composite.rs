//! What every way to composite a layer answers.

use crate::color::Premultiplied16;
use crate::rules::Rules;

/// How the samples of a finished layer are composited.
pub(super) trait Composite: Copy {
    /// The fragment that a sample of the layer becomes.
    fn fragment(self, sample: Premultiplied16) -> Premultiplied16;

    /// What a sample shows once a fragment is painted over it.
    fn over(self, fragment: Premultiplied16, below: Premultiplied16, rules: Rules) -> Premultiplied16 {
        fragment.over(below, rules)
    }

    /// Whether samples at which the layer is transparent leave what is below them as it is.
    fn keeps_below(self) -> bool {
        true
    }

    /// Whether nothing of what is below is left under such a fragment.
    fn hides(self, fragment: Premultiplied16) -> bool {
        fragment.is_opaque()
    }

    /// How much of the layer's own opacity is left, `0.0..=1.0`.
    fn opacity(self) -> f64;
}
