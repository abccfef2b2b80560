//! Points anywhere in each of `n x n` cells that lie in `n^2` different columns and rows, too, neighbours alike (Kensler,
//! "Correlated multi-jittered sampling", Pixar Technical Memo 13-01, 2013).

#![expect(
    clippy::inline_always,
    reason = "a function that is not inlined into its dispatch loses the vector instructions"
)]

use std::sync::Arc;

use fearless_simd::prelude::*;
use fearless_simd::{Simd, dispatch};

use super::arrange::{Arrange, Place, Position, with_places};
use super::cells::{Cell, anywhere, cells};
use super::random_bits::{halves, hash_eight, low_quarter};
use crate::raster::sampling::rate::SampleRate;
use crate::simd;

/// Row by row.
pub(super) struct MultiJittered;

/// The columns, or rows, that samples lie in.
#[derive(Debug)]
struct Strata {
    /// Cells along a side of the pixel.
    side: u32,
    /// The square of that many.
    narrow: Vec<Cell>,
}

impl Arrange for MultiJittered {
    fn prepare(&self, rate: SampleRate) -> Arc<dyn Place> {
        let side = rate.side();
        Arc::new(Strata {
            side,
            narrow: cells(side * side),
        })
    }
}

/// The most cells along a side of a pixel.
const MOST: usize = 16;

impl Place for Strata {
    fn place(&self, pixels: &[u64], places: &mut Vec<Position>) {
        dispatch!(simd::level(), simd => self.place_with(simd, pixels, places));
    }
}

impl Strata {
    #[inline(always)]
    fn place_with<S: Simd>(&self, simd: S, pixels: &[u64], places: &mut Vec<Position>) {
        let n = self.side;
        for (random, places) in with_places(pixels, self.narrow.len(), places) {
            let (mut across, mut down) = ([0; MOST], [0; MOST]);
            let [pattern, _] = halves(random);
            for (i, (across, down)) in (0..n).zip(across.iter_mut().zip(&mut down)) {
                *across = permuted(i, n, pattern.wrapping_mul(0xA511_E9B3));
                *down = permuted(i, n, pattern.wrapping_mul(0x63D8_3595));
            }
            let mut bits = [0; 8];
            let (mut i, mut j) = (0, 0);
            for (sample, place) in (0_u64..).zip(places) {
                let lane = (sample % 8) as usize;
                if lane == 0 {
                    bits = hash_eight(simd, random, sample).to_array();
                }
                // Each axis is moved by what the other one counts, in an order of the pixel's own.
                let strata = [i * n + down[j as usize % MOST], j * n + across[i as usize % MOST]];
                let [column, row] = [self.narrow[strata[0] as usize], self.narrow[strata[1] as usize]];
                *place = [
                    anywhere(column, low_quarter(bits[lane])),
                    anywhere(row, low_quarter(bits[lane] >> 16)),
                ];
                i += 1;
                if i == n {
                    (i, j) = (0, j + 1);
                }
            }
        }
    }
}

/// Where number `i` of `count` goes in the permutation with this seed: a hash of as many bits as are needed, again and again
/// until it is one of them.
fn permuted(i: u32, count: u32, seed: u32) -> u32 {
    let mask = count.next_power_of_two() - 1;
    let mut at = i;
    loop {
        at ^= seed;
        at = at.wrapping_mul(0xE170_893D);
        at ^= seed >> 16;
        at ^= (at & mask) >> 4;
        at ^= seed >> 8;
        at = at.wrapping_mul(0x0929_EB3F);
        at ^= seed >> 23;
        at ^= (at & mask) >> 1;
        at = at.wrapping_mul(1 | seed >> 27);
        at = at.wrapping_mul(0x6935_FA69);
        at ^= (at & mask) >> 11;
        at = at.wrapping_mul(0x74DC_B303);
        at ^= (at & mask) >> 2;
        at = at.wrapping_mul(0x9E50_1CC3);
        at ^= (at & mask) >> 2;
        at = at.wrapping_mul(0xC860_A3DF);
        at &= mask;
        at ^= at >> 5;
        if at < count {
            // Before the sum: one that wraps around would take two numbers to one.
            return (at + seed % count) % count;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::raster::sampling::pattern::random_bits::hash;

    #[test]
    fn points_are_those_of_one_sample_after_the_other() {
        arbtest::arbtest(|u| {
            let n = u.int_in_range(1..=16_u32)?;
            let pixels: [u64; 2] = u.arbitrary()?;
            let mut found = Vec::new();
            let rate = SampleRate::new(n * n).expect("a rate");
            MultiJittered.prepare(rate).place(&pixels, &mut found);
            let narrow = cells(n * n);
            let one = |random: u64, sample: u32| {
                let [pattern, _] = halves(random);
                let (i, j) = (sample % n, sample / n);
                let strata = [
                    i * n + permuted(j, n, pattern.wrapping_mul(0x63D8_3595)),
                    j * n + permuted(i, n, pattern.wrapping_mul(0xA511_E9B3)),
                ];
                let bits = hash(random, sample.into());
                [0, 1].map(|axis| anywhere(narrow[strata[axis] as usize], low_quarter(bits >> (16 * axis))))
            };
            let expected: Vec<Position> = pixels
                .iter()
                .flat_map(|random| (0..n * n).map(move |sample| (*random, sample)))
                .map(|(random, sample)| one(random, sample))
                .collect();
            assert_eq!(found, expected, "{n} x {n}");
            Ok(())
        })
        .budget_ms(200);
    }

    #[test]
    fn each_cell_column_and_row_holds_one_point() {
        arbtest::arbtest(|u| {
            let n = u.int_in_range(1..=16_u32)?;
            let rate = SampleRate::new(n * n).expect("a rate");
            let mut places = Vec::new();
            MultiJittered.prepare(rate).place(&[u.arbitrary()?], &mut places);
            // Which of so many equal parts of the side a point's middle lies in.
            let part = |at: u8, parts: u32| (2 * u32::from(at) + 1) * parts / 512;
            let count = |of: &dyn Fn(&Position) -> u32| {
                let mut parts: Vec<u32> = places.iter().map(of).collect();
                parts.sort_unstable();
                parts.dedup();
                parts.len()
            };
            let all = (n * n) as usize;
            assert_eq!(count(&|[x, _]| part(*x, n * n)), all, "columns of {places:?}");
            assert_eq!(count(&|[_, y]| part(*y, n * n)), all, "rows of {places:?}");
            assert_eq!(
                count(&|[x, y]| part(*y, n) * n + part(*x, n)),
                all,
                "cells of {places:?}"
            );
            Ok(())
        })
        .budget_ms(200);
    }

    #[test]
    fn permutations_have_each_number_once() {
        for count in 1..=16 {
            for seed in [0, 1, 0x1234_5678, u32::MAX] {
                let mut all: Vec<u32> = (0..count).map(|i| permuted(i, count, seed)).collect();
                all.sort_unstable();
                assert!(all.into_iter().eq(0..count), "{count} by {seed}");
            }
        }
    }
}
