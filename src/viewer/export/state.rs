//! What saves pictures, and what reads saved ones back.

use crate::viewer::export::restored::{Grammar, Restored};
use crate::viewer::export::saver::Saver;

/// What saves pictures, and what a saved one brings back.
#[derive(Debug)]
pub(in crate::viewer) struct Export {
    pub(in crate::viewer) saver: Saver,
    /// Reads command lines; without it no picture brings a state back, and there are no sheets.
    pub(in crate::viewer) grammar: Option<Grammar>,
    /// What was restored from a picture, until its scene was read.
    pub(in crate::viewer) restored: Option<Restored>,
}
