//! Layers: what takes the samples of a tile and composites them with those below.
//!
//! ```text
//!      begin_layer      paint, paint, ...       end_layer
//!      a transparent    samples of the tile     each sample of the layer becomes a fragment,
//!      buffer on top    gather in the layer     which is composited with the sample below
//! ```
//!
//! [`stack`] holds the buffers, whatever a painter keeps in them. How a finished layer is composited is a [`Composite`]; to
//! add one, write it in a file of its own and add a line to the table below. Painters ask a [`Compositing`] and know none.

mod blend;
mod composite;
mod mask;
mod opacity;
pub(in crate::raster) mod stack;

use crate::color::{BlendMode, Premultiplied16};
use crate::raster::layers::blend::Blend;
use crate::raster::layers::composite::Composite;
use crate::raster::layers::mask::Mask;
use crate::raster::layers::opacity::Opacity;
use crate::rules::Rules;

/// Makes the enum of all ways, and what hands a question to the one that is there.
macro_rules! composites {
    ($($(#[$doc:meta])* $make:ident($($part:ident: $of:ty),*) => $kind:ident,)+) => {
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        enum AnyComposite {
            $($kind($kind),)+
        }

        impl Composite for AnyComposite {
            fn fragment(self, sample: Premultiplied16) -> Premultiplied16 {
                match self {
                    $(Self::$kind(own) => own.fragment(sample),)+
                }
            }

            fn over(self, fragment: Premultiplied16, below: Premultiplied16, rules: Rules) -> Premultiplied16 {
                match self {
                    $(Self::$kind(own) => own.over(fragment, below, rules),)+
                }
            }

            fn composite(self, layer: &[Premultiplied16], below: &mut [Premultiplied16], rules: Rules) {
                match self {
                    $(Self::$kind(own) => own.composite(layer, below, rules),)+
                }
            }

            fn keeps_below(self) -> bool {
                match self {
                    $(Self::$kind(own) => own.keeps_below(),)+
                }
            }

            fn keeps_under(self, sample: Premultiplied16) -> bool {
                match self {
                    $(Self::$kind(own) => own.keeps_under(sample),)+
                }
            }

            fn is_copied(self, layer: &[Premultiplied16], below: Premultiplied16, rules: Rules) -> bool {
                match self {
                    $(Self::$kind(own) => own.is_copied(layer, below, rules),)+
                }
            }

            fn hides(self, fragment: Premultiplied16) -> bool {
                match self {
                    $(Self::$kind(own) => own.hides(fragment),)+
                }
            }

            fn opacity(self) -> f64 {
                match self {
                    $(Self::$kind(own) => own.opacity(),)+
                }
            }
        }

        impl Compositing {
            $(
                $(#[$doc])*
                pub fn $make($($part: $of),*) -> Self {
                    Self(AnyComposite::$kind($kind::new($($part),*)))
                }
            )+
        }
    };
}

// The table of ways to composite a layer: a line for each.
composites! {
    /// Source over, as if the layer were one shape of an opacity that is clamped to `0.0..=1.0`.
    with_opacity(opacity: f32) => Opacity,
    /// Blended with what is below it, at an opacity that is clamped to `0.0..=1.0`.
    blended(mode: BlendMode, opacity: f32) => Blend,
    /// Not seen itself: what is below stays as far as the layer is opaque or, if `luminance`, light.
    mask(luminance: bool) => Mask,
}

/// How a finished layer is composited.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Compositing(AnyComposite);

impl Compositing {
    /// The fragment that a sample of the layer becomes.
    #[inline]
    pub(crate) fn fragment(self, sample: Premultiplied16) -> Premultiplied16 {
        self.0.fragment(sample)
    }

    /// What a sample shows once the layer's is composited with it.
    #[inline]
    pub(crate) fn composited(self, sample: Premultiplied16, below: Premultiplied16, rules: Rules) -> Premultiplied16 {
        self.0.over(self.0.fragment(sample), below, rules)
    }

    /// Composites many samples of the layer with those below it.
    #[inline]
    pub(crate) fn composite(self, layer: &[Premultiplied16], below: &mut [Premultiplied16], rules: Rules) {
        self.0.composite(layer, below, rules);
    }

    /// Whether samples at which the layer is transparent leave what is below them as it is.
    #[inline]
    pub fn keeps_below(self) -> bool {
        self.0.keeps_below()
    }

    /// Whether such a sample of the layer leaves what is below it as it is.
    #[inline]
    pub(crate) fn keeps_under(self, sample: Premultiplied16) -> bool {
        self.0.keeps_under(sample)
    }

    /// Whether samples of the layer over one colour become what the layer holds.
    #[inline]
    pub(crate) fn is_copied(self, layer: &[Premultiplied16], below: Premultiplied16, rules: Rules) -> bool {
        self.0.is_copied(layer, below, rules)
    }

    /// Whether nothing of what is below is left under such a fragment.
    pub fn hides(self, fragment: Premultiplied16) -> bool {
        self.0.hides(fragment)
    }

    /// How much of the layer's own opacity is left, `0.0..=1.0`.
    pub fn opacity(self) -> f64 {
        self.0.opacity()
    }
}
