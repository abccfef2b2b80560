//! The ideal filter, a sine over its argument, cut off softly by a wider copy of itself: Duchon, "Lanczos filtering in one and
//! two dimensions" (Journal of Applied Meteorology 18, 1979).

use std::f64::consts::PI;

use crate::raster::resolve::weigh::Weigh;

/// With so many lobes on each side, the middle one counted by half.
pub(super) struct Lanczos(pub(super) f64);

/// `sin(pi x) / (pi x)`.
fn sinc(x: f64) -> f64 {
    let turn = PI * x;
    // Nearer to zero the sine is its argument.
    if turn.abs() < 1e-9 { 1.0 } else { turn.sin() / turn }
}

impl Weigh for Lanczos {
    fn radius(&self) -> f64 {
        self.0
    }

    fn weight(&self, distance: f64) -> f64 {
        sinc(distance) * sinc(distance / self.0)
    }
}
