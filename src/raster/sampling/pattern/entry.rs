//! What there is to say of a pattern.

use crate::raster::sampling::pattern::arrange::Arrange;

/// What there is to say of a pattern.
pub(super) struct Entry {
    /// The name used in the command line and the interface.
    pub(super) name: &'static str,
    /// Where the samples of a pixel lie, in few words.
    pub(super) description: &'static str,
    /// Whom it goes back to; empty where it is everybody's.
    pub(super) source: &'static str,
    /// Whether it divides a pixel into cells, so that only square numbers of samples are possible.
    pub(super) needs_square: bool,
    pub(super) spread: Spread,
    pub(super) arrange: &'static dyn Arrange,
}

/// How the samples of one pixel go with those of another.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Spread {
    /// They need no random bits: every pixel has the same.
    Fixed,
    /// Every pixel has the same, by the random bits of a seed.
    Alike,
    /// Each has its own: a scene that moves by whole pixels changes its picture.
    Own,
}
