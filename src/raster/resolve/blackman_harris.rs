//! Four cosines that add up to a bell with hardly any lobes beside it in its spectrum: the minimum four-term window of Harris,
//! "On the use of windows for harmonic analysis with the discrete Fourier transform" (Proceedings of the IEEE 66, 1978).

use std::f64::consts::PI;

use crate::raster::resolve::weigh::Weigh;

/// What the cosine of no, one, two and three half turns between middle and radius weighs.
const TERMS: [f64; 4] = [0.35875, 0.48829, 0.14128, 0.01168];
const RADIUS: f64 = 1.5;

pub(super) struct BlackmanHarris;

impl Weigh for BlackmanHarris {
    fn radius(&self) -> f64 {
        RADIUS
    }

    fn weight(&self, distance: f64) -> f64 {
        let turn = PI * distance / RADIUS;
        let terms = TERMS.iter().zip([0.0, 1.0, 2.0, 3.0]);
        terms.map(|(weight, times)| weight * (turn * times).cos()).sum()
    }
}
