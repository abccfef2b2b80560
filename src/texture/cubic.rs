//! Cubic kernels: two pieces of polynomials on each side of the middle, by two parameters `(B, C)`: Mitchell and Netravali,
//! "Reconstruction filters in computer graphics" (SIGGRAPH 1988), equation 8. Catmull-Rom is that of Keys, "Cubic convolution
//! interpolation for digital image processing" (IEEE Transactions on Acoustics, Speech, and Signal Processing 29, 1981; the
//! family is older: Catmull and Rom, "A class of local interpolating splines", 1974).
//!
//! | filter | B | C | |
//! |---|---|---|---|
//! | B-spline | 1 | 0 | never below zero, the softest |
//! | Mitchell-Netravali | 1/3 | 1/3 | what viewers of the paper liked best: a little blur, a little ringing |
//! | Catmull-Rom | 0 | 1/2 | goes through the samples: sharp, and rings |
//!
//! Resolve filters weigh samples by them, pixel sampling texels. There the texels lie one apart, and a point that lies `t`
//! beyond texel 1 reads four of them on each axis:
//!
//! ```text
//!     texel      0       1       2       3
//!     centre     +       +--t--# +       +
//!     distance   1 + t   t       1 - t   2 - t
//! ```

use super::PixelSampling;
use super::fixed_point::{FRACTION_BITS, share};

/// A cubic kernel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cubic {
    b: f64,
    c: f64,
}

/// What a point weighs three of the four texels of an axis by, as polynomials of how far it is beyond the second one, in
/// fixed point: the first texel, the third and the fourth. The second one takes the rest, so that all sum to one exactly.
///
/// Bilinear weights are such polynomials, too, of the third texel alone; and those of the nearest texel are nothing.
#[derive(Clone, Copy, Debug)]
pub(super) struct TexelWeights {
    /// From the cube down to the constant.
    pub(super) polynomials: [[f32; 4]; 3],
}

/// Adding this to a 32-bit float of less than `2^22` rounds it to a whole number, which then stands in the lower bits.
pub(super) const WHOLE: f32 = 12_582_912.0;

impl Cubic {
    /// The softest.
    pub const B_SPLINE: Self = Self { b: 1.0, c: 0.0 };
    /// Sharp, and rings.
    pub const CATMULL_ROM: Self = Self { b: 0.0, c: 0.5 };
    /// Between both.
    pub const MITCHELL: Self = Self {
        b: 1.0 / 3.0,
        c: 1.0 / 3.0,
    };
    /// How far from its middle it reaches.
    pub const RADIUS: f64 = 2.0;

    /// Its height this far from its middle, for distances of `0.0..=2.0`. At any place the heights of a row of kernels that
    /// stand one apart sum to one.
    pub fn weight(self, distance: f64) -> f64 {
        let (Self { b, c }, x) = (self, distance);
        let [cubic, square, linear, constant] = if x < 1.0 {
            [12.0 - 9.0 * b - 6.0 * c, -18.0 + 12.0 * b + 6.0 * c, 0.0, 6.0 - 2.0 * b]
        } else {
            [
                -b - 6.0 * c,
                6.0 * b + 30.0 * c,
                -12.0 * b - 48.0 * c,
                8.0 * b + 24.0 * c,
            ]
        };
        (((cubic * x + square) * x + linear) * x + constant) / 6.0
    }

    /// The weights of four texels at a point that lies `t`, `0.0..=1.0`, beyond the second one.
    pub(super) fn weights(self, t: f64) -> [f64; 4] {
        [1.0 + t, t, 1.0 - t, 2.0 - t].map(|distance| self.weight(distance))
    }
}

impl TexelWeights {
    /// Those of a pixel sampling; of a cubic kernel its heights at `1 + t`, `1 - t` and `2 - t`, multiplied out.
    pub(super) fn new(pixel: PixelSampling) -> Self {
        let Some(Cubic { b, c }) = pixel.cubic() else {
            let slope = if pixel == PixelSampling::Bilinear { 1.0 } else { 0.0 };
            return Self {
                polynomials: [[0.0; 4], [0.0, 0.0, slope, 0.0], [0.0; 4]],
            };
        };
        let first = [-b - 6.0 * c, 3.0 * b + 12.0 * c, -3.0 * b - 6.0 * c, b];
        let third = [
            -12.0 + 9.0 * b + 6.0 * c,
            18.0 - 15.0 * b - 12.0 * c,
            3.0 * b + 6.0 * c,
            b,
        ];
        let fourth = [b + 6.0 * c, -6.0 * c, 0.0, 0.0];
        let one = f64::from(1 << FRACTION_BITS);
        // Of `t` times one, and times one: powers of two change no digit.
        let scales = [one.powi(-2), one.recip(), 1.0, one];
        Self {
            polynomials: [first, third, fourth].map(|of| [0, 1, 2, 3].map(|i| to_single(of[i] / 6.0 * scales[i]))),
        }
    }

    /// How `total` is shared by the four texels, at a fraction of [`FRACTION_BITS`] bits beyond the second one.
    #[inline]
    pub(super) fn shares(&self, fraction: i32, total: i32) -> [i32; 4] {
        let t = fraction as f32;
        let [first, third, fourth] = self.polynomials.map(|[cube, square, linear, constant]| {
            let weight = ((cube * t + square) * t + linear) * t + constant;
            share(
                total,
                (weight + WHOLE).to_bits().cast_signed() - WHOLE.to_bits().cast_signed(),
            )
        });
        [first, total - first - third - fourth, third, fourth]
    }
}

#[expect(clippy::cast_possible_truncation, reason = "the kernels calculate in 32 bits")]
fn to_single(value: f64) -> f32 {
    value as f32
}

#[cfg(test)]
mod tests {
    use super::super::fixed_point::MASS;
    use super::*;

    const KERNELS: [PixelSampling; 3] = [
        PixelSampling::CatmullRom,
        PixelSampling::BSpline,
        PixelSampling::Mitchell,
    ];

    /// Every kernel with its name.
    fn kernels() -> impl Iterator<Item = (&'static str, Cubic, TexelWeights)> {
        KERNELS
            .into_iter()
            .filter_map(|pixel| Some((pixel.name(), pixel.cubic()?, TexelWeights::new(pixel))))
    }

    #[test]
    fn weights_sum_to_one_everywhere() {
        for (name, cubic, shares) in kernels() {
            for fraction in 0..1 << FRACTION_BITS {
                let t = f64::from(fraction) / f64::from(1 << FRACTION_BITS);
                let sum: f64 = cubic.weights(t).iter().sum();
                assert!((sum - 1.0).abs() < 1e-12, "{name} at {t}: {sum}");
                let whole = shares.shares(fraction, MASS);
                assert_eq!(whole.iter().sum::<i32>(), MASS, "{name} at {t}: to the last unit");
            }
        }
    }

    #[test]
    fn shares_are_the_kernel_of_the_paper() {
        for (name, cubic, shares) in kernels() {
            for fraction in 0..1 << FRACTION_BITS {
                let t = f64::from(fraction) / f64::from(1 << FRACTION_BITS);
                let whole = shares.shares(fraction, MASS);
                for (share, weight) in whole.into_iter().zip(cubic.weights(t)) {
                    let error = f64::from(share) - weight * f64::from(MASS);
                    assert!(error.abs() <= 2.5, "{name} at {t}: {error} units off");
                }
            }
        }
    }

    #[test]
    fn bilinear_and_nearest_weights_are_polynomials_too() {
        for fraction in (0..1 << FRACTION_BITS).step_by(7) {
            let [bilinear, nearest] = [PixelSampling::Bilinear, PixelSampling::Nearest].map(TexelWeights::new);
            let right = share(MASS, fraction);
            assert_eq!(
                bilinear.shares(fraction, MASS),
                [0, MASS - right, right, 0],
                "at {fraction}"
            );
            assert_eq!(nearest.shares(fraction, MASS), [0, MASS, 0, 0], "at {fraction}");
        }
    }

    #[test]
    fn kernels_reproduce_straight_lines() {
        // Also where they blur: each has the first moment of a delta. Catmull-Rom reproduces parabolas as well (Keys).
        for (name, cubic, _) in kernels() {
            for t in [0.0, 0.1, 0.25, 0.5, 0.9] {
                let moment = |power: i32| -> f64 {
                    let places = [-1.0_f64, 0.0, 1.0, 2.0].map(|place| place.powi(power));
                    cubic
                        .weights(t)
                        .iter()
                        .zip(places)
                        .map(|(weight, place)| weight * place)
                        .sum()
                };
                assert!((moment(1) - t).abs() < 1e-12, "{name} at {t}: {}", moment(1));
                let parabola = (moment(2) - t * t).abs();
                assert_eq!(
                    parabola < 1e-12,
                    cubic == Cubic::CATMULL_ROM,
                    "{name} at {t}: {parabola}"
                );
            }
        }
    }

    #[test]
    fn kernels_are_smooth_where_their_pieces_meet() {
        for (name, cubic, _) in kernels() {
            for knot in [1.0, 2.0] {
                let step = 1e-7;
                let before = (cubic.weight(knot) - cubic.weight(knot - step)) / step;
                let after = if knot < Cubic::RADIUS {
                    (cubic.weight(knot + step) - cubic.weight(knot)) / step
                } else {
                    0.0
                };
                assert!(
                    (before - after).abs() < 1e-5,
                    "{name} at {knot}: {before}, then {after}"
                );
            }
            assert!(cubic.weight(Cubic::RADIUS).abs() < 1e-12, "{name} ends at nothing");
        }
    }

    #[test]
    fn every_sampling_that_is_cubic_has_its_kernel() {
        let kernels = PixelSampling::ALL.map(PixelSampling::cubic);
        assert_eq!(
            kernels,
            [
                None,
                None,
                Some(Cubic::CATMULL_ROM),
                Some(Cubic::B_SPLINE),
                Some(Cubic::MITCHELL)
            ]
        );
    }
}
