//! Points anywhere in each of `n x n` cells that lie in `n^2` different columns and rows, too, neighbours alike (Kensler,
//! "Correlated multi-jittered sampling", Pixar Technical Memo 13-01, 2013).

#![expect(
    clippy::inline_always,
    reason = "a function that is not inlined into its dispatch loses the vector instructions"
)]

use std::sync::Arc;

use fearless_simd::prelude::*;
use fearless_simd::{Simd, dispatch, u16x32, u32x4, u32x8, u32x16};

use super::arrange::{Arrange, Place, Position, take_places, with_places};
use super::cells::{CellBlock, TOGETHER, cells, mean_range};
use super::random_bits::{halves, hash_eight};
use crate::raster::sampling::rate::SampleRate;
use crate::simd;

/// Row by row.
pub(super) struct MultiJittered;

/// The columns, or rows, that samples lie in.
#[derive(Debug)]
struct Strata {
    /// Cells along a side of the pixel.
    side: u32,
    /// The square of that many: where each begins, and how long it is.
    starts: Vec<u16>,
    lengths: Vec<u16>,
    mean_range: [f64; 2],
}

impl Arrange for MultiJittered {
    fn prepare(&self, rate: SampleRate) -> Arc<dyn Place> {
        let side = rate.side();
        let narrow = cells(side * side);
        let numbers = |which: usize| {
            narrow
                .iter()
                .map(|cell| u16::try_from(cell[which]).unwrap_or(u16::MAX))
                .collect()
        };
        Arc::new(Strata {
            side,
            starts: numbers(0),
            lengths: numbers(1),
            mean_range: mean_range(&narrow),
        })
    }
}

/// The most cells along a side of a pixel.
const MOST: usize = 16;
/// Numbers that are permuted together.
const LANES: usize = 8;

impl Place for Strata {
    fn place(&self, pixels: &[u64], places: &mut Vec<Position>) {
        if self.side == SIDE_OF_SIXTEEN {
            dispatch!(simd::level(), simd => place_sixteen(simd, pixels, places));
        } else {
            dispatch!(simd::level(), simd => self.place_with(simd, pixels, places));
        }
    }

    fn mean_range(&self) -> [f64; 2] {
        self.mean_range
    }
}

/// The side of pixels of 16 samples, which are placed in registers.
const SIDE_OF_SIXTEEN: u32 = 4;

/// Each of the 16 columns of such a pixel is `1 << 4` points wide.
const WIDTH_BITS: u32 = 4;

/// Every order that [`permuted`] gives to the numbers 0 to 3, times the width of a column: of a seed it looks at seven bits only,
/// which [`order_of_four`] puts side by side.
static ORDERS_OF_FOUR: [[u32; 4]; 128] = {
    let mut orders = [[0; 4]; 128];
    let mut order = 0;
    while order < 128_u32 {
        let mut i = 0;
        while i < 4 {
            let [mixed, middle, high, low] = [order & 3, order >> 2 & 3, order >> 4 & 1, order >> 5];
            let seed = low | (mixed ^ low) << 8 | middle << 23 | high << 28;
            orders[order as usize][i as usize] = permuted(i, 4, seed) << WIDTH_BITS;
            i += 1;
        }
        order += 1;
    }
    orders
};

/// The order that a seed gives to four numbers: see [`ORDERS_OF_FOUR`].
#[inline(always)]
fn order_of_four(seed: u32) -> &'static [u32; 4] {
    let mixed = (seed ^ seed >> 8 ^ seed >> 16) & 3;
    let order = mixed | (seed >> 23 & 3) << 2 | (seed >> 28 & 1) << 4 | (seed & 3) << 5;
    &ORDERS_OF_FOUR[order as usize]
}

/// As [`Strata::place_with`] where pixels have [`TOGETHER`] samples.
#[inline(always)]
fn place_sixteen<S: Simd>(simd: S, pixels: &[u64], places: &mut Vec<Position>) {
    // The column and the row that each sample's cell begins with.
    let mut corners = [0; TOGETHER];
    for (corner, sample) in corners.iter_mut().zip(0..) {
        *corner = ((sample % 4) | ((sample / 4) << 16)) << (2 + WIDTH_BITS);
    }
    let corners = u32x16::simd_from(simd, corners);
    for (random, places) in with_places(pixels, TOGETHER, places) {
        let [across, down] = seeds_of(random);
        // The order of columns moves rows, for each row of samples alike; that of rows moves columns, along a row alike.
        let row = u32x4::from_slice(simd, order_of_four(across)) << 16;
        let [first, second, third, fourth] = *order_of_four(down);
        let upper = (row + u32x4::splat(simd, first)).combine(row + u32x4::splat(simd, second));
        let lower = (row + u32x4::splat(simd, third)).combine(row + u32x4::splat(simd, fourth));
        let starts: u16x32<S> = (corners + upper.combine(lower)).bitcast();
        let inside = bits(simd, random, 0) >> (16 - WIDTH_BITS);
        let (low, high) = (starts + inside).split();
        let found: [u8; 2 * TOGETHER] = low.narrow(high).to_array();
        places.copy_from_slice(found.as_chunks::<2>().0);
    }
}

/// The seeds of the two permutations of a pixel: of columns and of rows.
fn seeds_of(random: u64) -> [u32; 2] {
    let [pattern, _] = halves(random);
    [pattern.wrapping_mul(0xA511_E9B3), pattern.wrapping_mul(0x63D8_3595)]
}

impl Strata {
    #[inline(always)]
    fn place_with<S: Simd>(&self, simd: S, pixels: &[u64], places: &mut Vec<Position>) {
        let side = self.side as usize;
        let (starts, lengths) = (&self.starts[..side * side], &self.lengths[..side * side]);
        // The numbers of columns, and then of rows.
        let mut numbers = [0; 2 * MOST];
        for (number, i) in numbers[..2 * side].iter_mut().zip((0..self.side).cycle()) {
            *number = i;
        }
        let mut cells = CellBlock::new(&[]);
        for (random, places) in with_places(pixels, side * side, places) {
            let (mut orders, mut seeds, mut shifts) = ([0; 2 * MOST], [0; 2 * MOST], [0; 2 * MOST]);
            for (axis, seed) in seeds_of(random).into_iter().enumerate() {
                seeds[axis * side..(axis + 1) * side].fill(seed);
                shifts[axis * side..(axis + 1) * side].fill(seed % self.side);
            }
            for first in (0..2 * side).step_by(LANES) {
                let lanes = first..first + LANES;
                let [number, seed, shift] = [&numbers, &seeds, &shifts]
                    .map(|all: &[u32; 2 * MOST]| u32x8::from_slice(simd, &all[lanes.clone()]));
                eight_permuted(simd, number, self.side, [seed, shift]).store_slice(&mut orders[lanes]);
            }
            let (across, down) = (&orders[..side], &orders[side..2 * side]);
            let (mut i, mut j) = (0, 0);
            for (places, first) in places.chunks_mut(TOGETHER).zip((0..).step_by(TOGETHER)) {
                for sample in 0..places.len() {
                    // Each axis is moved by what the other one counts, in an order of the pixel's own.
                    let strata = [i * side + down[j] as usize, j * side + across[i] as usize];
                    for (axis, stratum) in strata.into_iter().enumerate() {
                        cells.starts[2 * sample + axis] = starts[stratum];
                        cells.lengths[2 * sample + axis] = lengths[stratum];
                    }
                    i += 1;
                    if i == side {
                        (i, j) = (0, j + 1);
                    }
                }
                take_places(&cells.anywhere(simd, bits(simd, random, first)), places);
            }
        }
    }
}

/// 16 random bits for the column and the row of each of [`TOGETHER`] samples from one on.
#[inline(always)]
fn bits<S: Simd>(simd: S, random: u64, first: u64) -> u16x32<S> {
    let (a, b) = hash_eight(simd, random, first).split();
    let (c, d) = hash_eight(simd, random, first + 8).split();
    a.narrow(b).combine(c.narrow(d)).bitcast()
}

/// Where numbers of `count` go in the permutations with these seeds: a hash of as many bits as are needed, again and again until
/// it is one of them; then moved by the seed modulo `count`.
#[inline(always)]
fn eight_permuted<S: Simd>(simd: S, numbers: u32x8<S>, count: u32, [seed, shifts]: [u32x8<S>; 2]) -> u32x8<S> {
    let number = |value: u32| u32x8::splat(simd, value);
    let mask = number(count.next_power_of_two() - 1);
    let mut at = numbers;
    let mut done = at;
    let mut waits = at.simd_eq(at);
    loop {
        at ^= seed;
        at *= number(0xE170_893D);
        at ^= seed >> 16;
        at ^= (at & mask) >> 4;
        at ^= seed >> 8;
        at *= number(0x0929_EB3F);
        at ^= seed >> 23;
        at ^= (at & mask) >> 1;
        at *= seed >> 27 | number(1);
        at *= number(0x6935_FA69);
        at ^= (at & mask) >> 11;
        at *= number(0x74DC_B303);
        at ^= (at & mask) >> 2;
        at *= number(0x9E50_1CC3);
        at ^= (at & mask) >> 2;
        at *= number(0xC860_A3DF);
        at &= mask;
        at ^= at >> 5;
        done = waits.select(at, done);
        waits &= at.simd_ge(number(count));
        if !waits.any_true() {
            break;
        }
    }
    // Moved before the sum: one that wraps around would take two numbers to one.
    let moved = done + shifts;
    let count = number(count);
    moved.simd_ge(count).select(moved - count, moved)
}

/// One number of [`eight_permuted`].
const fn permuted(i: u32, count: u32, seed: u32) -> u32 {
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
    use crate::raster::sampling::pattern::cells::anywhere;
    use crate::raster::sampling::pattern::random_bits::{hash, low_quarter};

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
                let [across, down] = seeds_of(random);
                let (i, j) = (sample % n, sample / n);
                let strata = [i * n + permuted(j, n, down), j * n + permuted(i, n, across)];
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
    fn orders_of_four_are_permutations() {
        arbtest::arbtest(|u| {
            let seed = u.arbitrary()?;
            let expected = [0, 1, 2, 3].map(|i| permuted(i, 4, seed) << WIDTH_BITS);
            assert_eq!(*order_of_four(seed), expected, "by {seed:x}");
            Ok(())
        })
        .budget_ms(100);
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
