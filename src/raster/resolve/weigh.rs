//! What every resolve filter answers.

/// A resolve filter. All are products of what a sample weighs by its column and by its row.
pub(super) trait Weigh: Sync {
    /// How far from the pixel's middle samples weigh anything, in pixels, where nobody asks for another radius.
    fn radius(&self) -> f64;

    /// What a sample weighs by its distance from the middle along one axis, in pixels; at most about 1, and asked for
    /// `0.0..radius` only. What the weights of all samples add up to is made 1 later.
    fn weight(&self, distance: f64) -> f64;
}
