//! What every resolve filter answers.

/// A resolve filter.
pub(super) trait Weigh: Sync {
    /// What a sample weighs that lies at this offset from the pixel's middle, in pixels; in parts of whatever the weights of
    /// all samples add up to.
    fn weight(&self, offset: [f64; 2]) -> f64;

    /// Whether all samples of the pixel weigh alike, and no others anything.
    fn is_even(&self) -> bool {
        false
    }
}
