//! Points anywhere, none of which knows of another: what other patterns are measured by.

#![expect(
    clippy::inline_always,
    reason = "a function that is not inlined into its dispatch loses the vector instructions"
)]

use std::sync::Arc;

use fearless_simd::prelude::*;
use fearless_simd::{Simd, dispatch};

use super::arrange::{Arrange, Place, Position, with_places};
use super::random_bits::hash_eight;
use crate::raster::sampling::rate::SampleRate;
use crate::simd;

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
    fn place(&self, pixels: &[u64], places: &mut Vec<Position>) {
        dispatch!(simd::level(), simd => self.place_with(simd, pixels, places));
    }
}

impl Points {
    #[inline(always)]
    fn place_with<S: Simd>(&self, simd: S, pixels: &[u64], places: &mut Vec<Position>) {
        for (random, places) in with_places(pixels, self.0 as usize, places) {
            let mut first = 0;
            for places in places.chunks_mut(8) {
                let bits = hash_eight(simd, random, first).to_array();
                for (place, bits) in places.iter_mut().zip(bits) {
                    let [x, y, ..] = bits.to_le_bytes();
                    *place = [x, y];
                }
                first += 8;
            }
        }
    }
}
