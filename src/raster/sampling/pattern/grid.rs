//! The middles of `n x n` equal cells.

use std::sync::Arc;

use super::arrange::{Arrange, Fixed, Place};
use crate::raster::sampling::rate::SampleRate;

/// On a lattice of `n x n` points.
pub(super) struct Grid;

impl Arrange for Grid {
    fn prepare(&self, rate: SampleRate) -> Arc<dyn Place> {
        let side = rate.side();
        Fixed::by(rate, |i| [i % side, i / side])
    }
}
