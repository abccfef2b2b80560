//! The mean of a pixel's own samples.

use crate::raster::resolve::weigh::Weigh;

pub(super) struct BoxFilter;

impl Weigh for BoxFilter {
    fn weight(&self, _: [f64; 2]) -> f64 {
        1.0
    }

    fn is_even(&self) -> bool {
        true
    }
}
