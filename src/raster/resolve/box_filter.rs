//! The mean of what lies inside: by its own radius, of the pixel's own samples.

use crate::raster::resolve::weigh::Weigh;

pub(super) struct BoxFilter;

impl Weigh for BoxFilter {
    fn radius(&self) -> f64 {
        0.5
    }

    fn weight(&self, _: f64) -> f64 {
        1.0
    }
}
