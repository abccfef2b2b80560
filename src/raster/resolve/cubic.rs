//! The cubic kernels, as resolve filters: textures are read by the same ones.

use crate::raster::resolve::weigh::Weigh;
pub(super) use crate::texture::Cubic;

impl Weigh for Cubic {
    fn radius(&self) -> f64 {
        Self::RADIUS
    }

    fn weight(&self, distance: f64) -> f64 {
        Self::weight(*self, distance)
    }
}
