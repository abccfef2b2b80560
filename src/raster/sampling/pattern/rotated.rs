//! The canonical arrangement of `n x n` samples in as many columns and rows (Chiu, Shirley and Wang, "Multi-jittered sampling",
//! Graphics Gems IV, 1994).

use std::sync::Arc;

use super::arrange::{Arrange, Fixed, Place};
use crate::geometry::subpixel::SubpixelGrid;
use crate::raster::sampling::rate::SampleRate;

/// In cell `(i, j)`, each axis is moved by what the other one counts.
pub(super) struct Rotated;

impl Arrange for Rotated {
    fn prepare(&self, rate: SampleRate) -> Arc<dyn Place> {
        let n = rate.side();
        // Point `k` of `n^2` in a row of as many has its middle at `(k + 1/2) / n^2`.
        let at = |k: u32| (2 * k + 1) * SubpixelGrid::FINE_SIDE / (2 * n * n);
        Fixed::by(rate, |sample| {
            let (i, j) = (sample % n, sample / n);
            [at(i * n + j), at(j * n + n - 1 - i)]
        })
    }
}
