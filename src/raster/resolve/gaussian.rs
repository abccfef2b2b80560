//! A Gaussian bell, lowered so that it ends at nothing, as in Pharr, Jakob and Humphreys, "Physically Based Rendering" (4th
//! edition, 2023), section 8.8.

use crate::raster::resolve::weigh::Weigh;

/// The bell's standard deviation, in pixels.
const SIGMA: f64 = 0.5;
/// Where it ends.
const RADIUS: f64 = 1.5;

pub(super) struct Gaussian;

fn bell(distance: f64) -> f64 {
    (-distance * distance / (2.0 * SIGMA * SIGMA)).exp()
}

impl Weigh for Gaussian {
    fn radius(&self) -> f64 {
        RADIUS
    }

    fn weight(&self, distance: f64) -> f64 {
        bell(distance) - bell(RADIUS)
    }
}
