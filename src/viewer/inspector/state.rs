//! What is inspected: the magnifier and its pin, and what was found out about the pixel.

use crate::inspect::TexelPlace;
use crate::viewer::inspector::contributions::Contributing;
use crate::viewer::inspector::explanation::Explaining;
use crate::viewer::inspector::samples::Probing;
use crate::viewer::inspector::{Inspector, PlacedInset};

/// The magnifier, and the answers about its pixel.
#[derive(Debug)]
pub(in crate::viewer) struct Inspection {
    pub(in crate::viewer) magnifier: Inspector,
    /// Where the inset lies in the window.
    pub(in crate::viewer) inset: Option<PlacedInset>,
    /// B's, where both share the window.
    pub(in crate::viewer) other_inset: Option<PlacedInset>,
    pub(in crate::viewer) samples: Probing,
    pub(in crate::viewer) explanation: Explaining,
    pub(in crate::viewer) contributions: Contributing,
    /// The texel of the explanation that the pointer is over.
    pub(in crate::viewer) pointed_texel: Option<TexelPlace>,
}

impl Inspection {
    pub(in crate::viewer) fn new(samples: Probing, explanation: Explaining, contributions: Contributing) -> Self {
        Self {
            magnifier: Inspector::default(),
            inset: None,
            other_inset: None,
            samples,
            explanation,
            contributions,
            pointed_texel: None,
        }
    }
}
