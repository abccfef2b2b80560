//! Weights of windows that fade out as a Gaussian does.

/// `exp(-x^2 / (2 sigma^2))` from `-radius` to `radius`, without the ends that are below a float's resolution.
pub(super) fn gaussian(sigma: f64, radius: u32) -> Vec<f64> {
    let radius = f64::from(radius);
    let offsets = std::iter::successors(Some(-radius), |x| Some(x + 1.0)).take_while(|x| *x <= radius);
    let weights = offsets.map(|x| (-x * x / (2.0 * sigma * sigma)).exp());
    weights.filter(|weight| *weight > 1e-9).collect()
}

/// The same weights with the sum 1.
pub(super) fn normalized(weights: &[f64]) -> Vec<f32> {
    let sum: f64 = weights.iter().sum();
    weights.iter().map(|weight| single(weight / sum)).collect()
}

/// The nearest float of 32 bits.
#[expect(clippy::cast_possible_truncation, reason = "rounds to a float of 32 bits")]
pub(super) const fn single(value: f64) -> f32 {
    value as f32
}
