//! Points anywhere, none of which knows of another: what other patterns are measured by.

#![expect(
    clippy::inline_always,
    reason = "a function that is not inlined into its dispatch loses the vector instructions"
)]

use std::sync::Arc;

use fearless_simd::prelude::*;
use fearless_simd::{Simd, dispatch, u8x32};

use super::arrange::{Arrange, Place, Position, take_places, with_places};
use super::random_bits::hash_eight;
use crate::raster::sampling::rate::SampleRate;
use crate::simd;

/// Uniformly distributed in the pixel.
pub(super) struct Random;

/// Points that are placed together.
const TOGETHER: usize = 16;

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
            for places in places.chunks_mut(TOGETHER) {
                let (a, b) = hash_eight(simd, random, first).split();
                let (c, d) = hash_eight(simd, random, first + 8).split();
                // The lowest byte of each is a column, the next one a row.
                let lowest: u8x32<S> = a.narrow(b).narrow(c.narrow(d)).bitcast();
                let mut found = [[0; 2]; TOGETHER];
                lowest.store_slice(found.as_flattened_mut());
                take_places(&found, places);
                first += 16;
            }
        }
    }
}
