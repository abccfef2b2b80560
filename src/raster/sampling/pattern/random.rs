//! Points anywhere, none of which knows of another: what other patterns are measured by.

use std::sync::Arc;

use super::arrange::{Arrange, Place, Position};
use super::random_bits::hash;
use crate::raster::sampling::rate::SampleRate;

/// Uniformly distributed in the pixel.
pub(super) struct Random;

/// So many of them.
#[derive(Debug)]
struct Points(u32);

impl Arrange for Random {
    fn prepare(&self, rate: SampleRate) -> Arc<dyn Place> {
        Arc::new(Points(rate.samples()))
    }
}

impl Place for Points {
    fn place(&self, random: u64, places: &mut Vec<Position>) {
        places.extend((0..self.0).map(|sample| {
            let [x, y, ..] = hash(random, sample.into()).to_le_bytes();
            [x, y]
        }));
    }
}
