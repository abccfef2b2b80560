//! A straight slope down on each side, as linear interpolation between pixels has it: a box folded with a box.

use crate::raster::resolve::weigh::Weigh;

pub(super) struct Tent;

impl Weigh for Tent {
    fn radius(&self) -> f64 {
        1.0
    }

    fn weight(&self, distance: f64) -> f64 {
        1.0 - distance
    }
}
