//! One point anywhere in each of `n x n` cells (Cook, "Stochastic sampling in computer graphics", ACM Transactions on Graphics
//! 5, 1986).

#![expect(
    clippy::inline_always,
    reason = "a function that is not inlined into its dispatch loses the vector instructions"
)]

use std::sync::Arc;

use fearless_simd::prelude::*;
use fearless_simd::{Simd, dispatch, u16x32};

use super::arrange::{Arrange, Place, Position, take_places, with_places};
use super::cells::{CellBlock, TOGETHER, cells, mean_range};
use super::random_bits::hash_eight;
use crate::raster::sampling::rate::SampleRate;
use crate::simd;

/// Row by row.
pub(super) struct Jittered;

/// The cells of samples.
#[derive(Debug)]
struct Jitter {
    count: usize,
    cells: Vec<CellBlock>,
    mean_range: [f64; 2],
}

impl Arrange for Jittered {
    fn prepare(&self, rate: SampleRate) -> Arc<dyn Place> {
        let cells = cells(rate.side());
        let all: Vec<[[u32; 2]; 2]> = cells
            .iter()
            .flat_map(|row| cells.iter().map(|column| [*column, *row]))
            .collect();
        Arc::new(Jitter {
            count: all.len(),
            mean_range: mean_range(&cells),
            cells: all
                .chunks(TOGETHER)
                .map(|cells| CellBlock::new(cells.as_flattened()))
                .collect(),
        })
    }
}

impl Place for Jitter {
    fn place(&self, pixels: &[u64], places: &mut Vec<Position>) {
        dispatch!(simd::level(), simd => self.place_with(simd, pixels, places));
    }

    fn mean_range(&self) -> [f64; 2] {
        self.mean_range
    }
}

impl Jitter {
    #[inline(always)]
    fn place_with<S: Simd>(&self, simd: S, pixels: &[u64], places: &mut Vec<Position>) {
        for (random, places) in with_places(pixels, self.count, places) {
            let mut first = 0;
            for (cells, places) in self.cells.iter().zip(places.chunks_mut(TOGETHER)) {
                let bits: u16x32<S> = hash_eight(simd, random, first).bitcast();
                take_places(&cells.anywhere(simd, bits), places);
                first += 8;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::raster::sampling::pattern::cells::anywhere;
    use crate::raster::sampling::pattern::random_bits::{hash, low_quarter};

    #[test]
    fn jitter_of_many_samples_is_that_of_one_sample_after_the_other() {
        arbtest::arbtest(|u| {
            let side = u.int_in_range(1..=16)?;
            let rate = SampleRate::new(side * side).expect("a rate");
            let pixel: u64 = u.arbitrary()?;
            let mut found = Vec::new();
            Jittered.prepare(rate).place(&[pixel], &mut found);
            let cells = cells(side);
            let one = |sample: u32| {
                let random = hash(pixel, u64::from(sample / 2)) >> (sample % 2 * 32);
                let [column, row] = [sample % side, sample / side].map(|at| cells[at as usize]);
                [
                    anywhere(column, low_quarter(random)),
                    anywhere(row, low_quarter(random >> 16)),
                ]
            };
            let expected: Vec<Position> = (0..side * side).map(one).collect();
            assert_eq!(found, expected, "{side} x {side}");
            Ok(())
        })
        .budget_ms(200);
    }
}
