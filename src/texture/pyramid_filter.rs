//! How a level's texels become those of the next coarser one: the kernels, and their weights.
//!
//! Kernels are centred on a coarse texel and measured in coarse texels. Of an image of an even side each coarse texel lies between
//! two fine ones, and the weights are the same for all:
//!
//! ```text
//!   fine     |  .  |  .  |  .  |  .  |  .  |  .  |
//!   box                  | 1/2 | 1/2 |
//!   tent           | 1/8 | 3/8 | 3/8 | 1/8 |
//!   Kaiser   ... six on each side, some below zero ...
//! ```
//!
//! Source of the tent and of the Kaiser window: Castano, "Mipmap filtering" in the NVIDIA Texture Tools, whose defaults these are
//! (half width 3, parameter 4); Kaiser and Schafer, "On the use of the I0-sinh window for spectrum analysis", 1980.

/// How a texel of a coarser mip level is made of those of the finer one.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum PyramidFilter {
    /// The mean over the texel's own area.
    #[default]
    Box,
    /// A tent as wide as two texels: softer, and fewer aliases.
    Tent,
    /// A sinc under a Kaiser window, as wide as six texels: sharper; it rings at edges.
    Kaiser,
}

impl PyramidFilter {
    /// Every value, in the order of menus.
    pub const ALL: [Self; 3] = [Self::Box, Self::Tent, Self::Kaiser];

    /// The name used in the command line and the interface.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Box => "box",
            Self::Tent => "tent",
            Self::Kaiser => "kaiser",
        }
    }

    /// How far from its middle it reaches, in coarse texels.
    fn reach(self) -> f64 {
        match self {
            Self::Box => 0.5,
            Self::Tent => 1.0,
            Self::Kaiser => 3.0,
        }
    }

    /// Its height this far from its middle, in coarse texels; weights are divided by their sum.
    fn height(self, distance: f64) -> f64 {
        let distance = distance.abs();
        match self {
            Self::Box => f64::from(u8::from(distance < 0.5)),
            Self::Tent => (1.0 - distance).max(0.0),
            Self::Kaiser => {
                const PARAMETER: f64 = 4.0;
                let part = (distance / self.reach()).min(1.0);
                sinc(distance) * bessel_i0(PARAMETER * (1.0 - part * part).sqrt()) / bessel_i0(PARAMETER)
            }
        }
    }
}

/// What makes a coarse texel along one axis: weights of fine texels, whose sum is one.
#[derive(Clone, Debug)]
pub(super) struct Weights {
    /// The fine texel of the first weight; below 0 and beyond the side the nearest texel stands in.
    pub(super) first: i64,
    pub(super) weights: Vec<f32>,
}

/// The weights of each of `coarse` texels that a side of `fine` texels becomes.
#[expect(
    clippy::cast_possible_truncation,
    reason = "places of texels, and weights that lose only digits"
)]
pub(super) fn weights(filter: PyramidFilter, fine: u32, coarse: u32) -> Vec<Weights> {
    let ratio = f64::from(fine) / f64::from(coarse);
    let one = |i: u32| {
        let middle = (f64::from(i) + 0.5) * ratio;
        let reach = filter.reach() * ratio;
        let first = (middle - reach - 0.5).ceil() as i64;
        let last = (middle + reach - 0.5).floor() as i64;
        let heights: Vec<f64> = (first..=last)
            .map(|texel| filter.height((texel as f64 + 0.5 - middle) / ratio))
            .collect();
        let sum: f64 = heights.iter().sum();
        Weights {
            first,
            weights: heights.iter().map(|height| (height / sum) as f32).collect(),
        }
    };
    (0..coarse).map(one).collect()
}

/// `sin(pi x) / (pi x)`.
fn sinc(x: f64) -> f64 {
    let x = std::f64::consts::PI * x;
    if x.abs() < 1e-9 { 1.0 } else { x.sin() / x }
}

/// The modified Bessel function of the first kind and order zero, by its power series; good for small `x`.
fn bessel_i0(x: f64) -> f64 {
    let quarter = x * x / 4.0;
    let (mut sum, mut term) = (1.0, 1.0);
    for k in 1..40 {
        let k = f64::from(k);
        term *= quarter / (k * k);
        sum += term;
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn weights_of_even_sides_are_those_of_the_books() {
        let tent = weights(PyramidFilter::Tent, 8, 4);
        assert_eq!(tent[1].first, 1, "one beyond its own two");
        assert_eq!(tent[1].weights, [0.125, 0.375, 0.375, 0.125]);
        let kaiser = weights(PyramidFilter::Kaiser, 32, 16);
        let (left, right) = kaiser[8].weights.split_at(6);
        assert_eq!(kaiser[8].first, 11, "five beyond its own two");
        // The definition, evaluated elsewhere, from the middle outwards.
        let wanted = [0.443_077, 0.133_992, -0.065_689, -0.033_919, 0.016_232, 0.006_307];
        for (k, wanted) in wanted.into_iter().enumerate() {
            assert!((f64::from(right[k]) - wanted).abs() < 1e-5, "{k}: {right:?}");
            assert!((left[5 - k] - right[k]).abs() < 1e-6, "alike on both sides");
        }
    }

    #[test]
    fn weights_sum_to_one_around_their_middle() {
        for filter in [PyramidFilter::Tent, PyramidFilter::Kaiser] {
            for (fine, coarse) in [(2, 1), (3, 1), (5, 2), (7, 3), (64, 32), (101, 50), (1, 1)] {
                for (i, at) in weights(filter, fine, coarse).into_iter().enumerate() {
                    let sum: f32 = at.weights.iter().sum();
                    assert!((sum - 1.0).abs() < 1e-5, "{filter:?} {fine} -> {coarse}: {sum}");
                    let middle: f64 = at
                        .weights
                        .iter()
                        .zip(at.first..)
                        .map(|(weight, texel)| f64::from(*weight) * (texel as f64 + 0.5))
                        .sum();
                    let wanted = (i as f64 + 0.5) * f64::from(fine) / f64::from(coarse);
                    assert!(
                        (middle - wanted).abs() < 0.1,
                        "{filter:?} {fine} -> {coarse}, {i}: {middle}"
                    );
                }
            }
        }
    }

    #[test]
    fn bessel_function_has_its_published_values() {
        // Abramowitz and Stegun, table 9.8.
        for (x, value) in [(0.0, 1.0), (1.0, 1.266_065_878), (4.0, 11.301_921_95)] {
            assert!((bessel_i0(x) - value).abs() < 1e-7, "{x}: {}", bessel_i0(x));
        }
    }
}
