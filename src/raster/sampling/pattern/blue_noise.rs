//! The same points in every pixel, shifted otherwise in each: by a tile of blue noise, so that what neighbours get wrong has
//! no low frequencies and looks like fine grain instead of blotches.
//!
//! ```text
//!    .-----.-----.
//!    |o    |  o  |     shifts wrap around at the pixel's edges; they are the numbers of a tile
//!    |  o  |    o|     of 64 x 64, across, and of its transpose, down
//!    '-----'-----'
//! ```
//!
//! The tile is made by void and cluster (Ulichney, "The void-and-cluster method for dither array generation", SPIE 1913,
//! 1993), the shifts are those of Georgiev and Fajardo ("Blue-noise dithered sampling", SIGGRAPH Talks 2016), the points those
//! of Sobol's sequence, as many in each column and row when they are shifted.

#![expect(
    clippy::inline_always,
    reason = "a function that is not inlined into its dispatch loses the vector instructions"
)]

use std::sync::{Arc, LazyLock};

use fearless_simd::prelude::*;
use fearless_simd::{Simd, dispatch, u8x32, u16x16};

use super::arrange::{Arrange, Place, Position, take_places, with_places};
use super::random_bits::{first_sixteen, halves};
use super::sobol::point;
use crate::raster::sampling::rate::SampleRate;
use crate::simd;

/// The tile's side, a power of two.
const SIDE: usize = 64;
const CELLS: usize = SIDE * SIDE;
/// Points that are shifted together.
const TOGETHER: usize = 16;
/// The points of a full tile, and those that it is begun with.
const ALL: u16 = 1 << 12;
const FIRST: u16 = ALL / 10;

/// A Gaussian of 1.5 cells, as parts of `2^12`: what a point adds to places so many columns, or rows, away.
const SPREAD: [u32; 7] = [4096, 3280, 1684, 554, 117, 16, 1];

/// For each cell its number in the order in which points fill the tile.
static TILE: LazyLock<Box<[u16; CELLS]>> = LazyLock::new(|| void_and_cluster(0x2545_F491_4F6C_DD1D));

/// The first points of a sequence, shifted.
pub(super) struct BlueNoise;

/// The points before they are shifted.
#[derive(Debug)]
struct Points {
    count: usize,
    blocks: Vec<[Position; TOGETHER]>,
    tile: &'static [u16; CELLS],
}

impl Arrange for BlueNoise {
    fn prepare(&self, rate: SampleRate) -> Arc<dyn Place> {
        let top = |part: u32| part.to_be_bytes()[0];
        let count = rate.samples() as usize;
        let mut blocks = vec![[[0; 2]; TOGETHER]; count.div_ceil(TOGETHER)];
        for (found, number) in blocks.as_flattened_mut().iter_mut().zip(0..rate.samples()) {
            *found = point(number).map(top);
        }
        Arc::new(Points {
            count,
            blocks,
            tile: &TILE,
        })
    }
}

impl Place for Points {
    /// The shifts of a pixel, across in the lowest byte and down in the next.
    fn random(&self, pixels: &mut [u64], seed: u64) {
        let seeds = halves(seed);
        for pixel in pixels {
            let at = halves(*pixel);
            // A seed is another part of the tile, which goes on for ever.
            let [x, y] = [0, 1].map(|axis| at[axis].wrapping_add(seeds[axis]) as usize % SIDE);
            let shift = |cell: usize| u64::from(self.tile[cell] >> 4);
            *pixel = shift(y * SIDE + x) | shift(x * SIDE + y) << 8;
        }
    }

    fn place(&self, pixels: &[u64], places: &mut Vec<Position>) {
        dispatch!(simd::level(), simd => self.place_with(simd, pixels, places));
    }
}

impl Points {
    #[inline(always)]
    fn place_with<S: Simd>(&self, simd: S, pixels: &[u64], places: &mut Vec<Position>) {
        for (random, places) in with_places(pixels, self.count, places) {
            let shift: u8x32<S> = u16x16::splat(simd, first_sixteen(random)).bitcast();
            for (places, points) in places.chunks_mut(TOGETHER).zip(&self.blocks) {
                let mut found = [[0; 2]; TOGETHER];
                (u8x32::from_slice(simd, points.as_flattened()) + shift).store_slice(found.as_flattened_mut());
                take_places(&found, places);
            }
        }
    }
}

/// Points in a tile, and how crowded each of its cells is by them.
#[derive(Clone)]
struct Crowd {
    taken: [bool; CELLS],
    /// What all points add up to, as parts of `2^24`.
    crowded: [u32; CELLS],
}

impl Crowd {
    fn toggle(&mut self, cell: usize) {
        self.taken[cell] = !self.taken[cell];
        let is_taken = self.taken[cell];
        let reach = SPREAD.len() - 1;
        let (x, y) = (cell % SIDE, cell / SIDE);
        for down in 0..=2 * reach {
            for across in 0..=2 * reach {
                let near = (y + SIDE + down - reach) % SIDE * SIDE + (x + SIDE + across - reach) % SIDE;
                let added = SPREAD[across.abs_diff(reach)] * SPREAD[down.abs_diff(reach)];
                if is_taken {
                    self.crowded[near] += added;
                } else {
                    self.crowded[near] -= added;
                }
            }
        }
    }

    /// The most crowded point.
    fn cluster(&self) -> usize {
        let points = (0..CELLS).filter(|cell| self.taken[*cell]);
        points.max_by_key(|cell| self.crowded[*cell]).unwrap_or(0)
    }

    /// The least crowded place that is free.
    fn void(&self) -> usize {
        let free = (0..CELLS).filter(|cell| !self.taken[*cell]);
        free.min_by_key(|cell| self.crowded[*cell]).unwrap_or(0)
    }
}

/// The order in which points fill a tile, each where it has most room, beginning with some at random that were moved apart.
fn void_and_cluster(mut random: u64) -> Box<[u16; CELLS]> {
    let mut crowd = Crowd {
        taken: [false; CELLS],
        crowded: [0; CELLS],
    };
    let mut count = 0;
    while count < FIRST {
        // Xorshift (Marsaglia 2003): any numbers will do.
        random ^= random << 13;
        random ^= random >> 7;
        random ^= random << 17;
        let cell = (random >> 40) as usize % CELLS;
        if !crowd.taken[cell] {
            crowd.toggle(cell);
            count += 1;
        }
    }
    // Until the most crowded point has no more room elsewhere. Each move leaves less crowding in all, so this ends.
    loop {
        let cluster = crowd.cluster();
        crowd.toggle(cluster);
        let void = crowd.void();
        if crowd.crowded[void] >= crowd.crowded[cluster] {
            crowd.toggle(cluster);
            break;
        }
        crowd.toggle(void);
    }
    let mut order = Box::new([0; CELLS]);
    let mut emptied = crowd.clone();
    // Those at the beginning, the most crowded one last.
    for number in (0..FIRST).rev() {
        let cluster = emptied.cluster();
        emptied.toggle(cluster);
        order[cluster] = number;
    }
    for number in FIRST..ALL {
        let void = crowd.void();
        crowd.toggle(void);
        order[void] = number;
    }
    order
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::raster::sampling::pattern::arrange::number_of;

    /// The mean square of what the means over `side x side` cells are off the mean of all.
    fn of_blocks(side: usize, value: impl Fn(usize, usize) -> f64) -> f64 {
        let blocks = SIDE / side;
        let squares = (0..blocks * blocks).map(|block| {
            let (left, top) = (block % blocks * side, block / blocks * side);
            let values = (0..side * side).map(|i| value(left + i % side, top + i / side));
            (values.sum::<f64>() / (side * side) as f64 - 0.5).powi(2)
        });
        squares.sum::<f64>() / (blocks * blocks) as f64
    }

    #[test]
    fn tile_has_each_number_once_and_no_low_frequencies() {
        let mut numbers = TILE.to_vec();
        numbers.sort_unstable();
        assert!(numbers.iter().copied().eq(0..4096), "each number once");
        let value = |x: usize, y: usize| (f64::from(TILE[y * SIDE + x]) + 0.5) / 4096.0;
        // The larger the blocks, the lower the frequencies.
        for (side, most) in [(4, 0.25), (8, 0.12), (16, 0.06)] {
            // Numbers without any order have the variance 1/12, and their means that of their share.
            let white = 1.0 / 12.0 / (side * side) as f64;
            let found = of_blocks(side, value);
            assert!(
                found < most * white,
                "{side} x {side}: {} of white noise",
                found / white
            );
        }
        // However full it is: these are the dots of a dithered grey.
        for part in [0.1, 0.3, 0.5, 0.8] {
            let dots = |x, y| {
                if value(x, y) < part {
                    0.5 + 1.0 - part
                } else {
                    0.5 - part
                }
            };
            let found = of_blocks(8, dots) / (part * (1.0 - part) / 64.0);
            assert!(found < 0.2, "{part} of all: {found} of white noise");
        }
    }

    #[test]
    fn pixels_have_the_same_points_shifted() {
        let places = |at: [i32; 2], seed: u64| {
            let place = BlueNoise.prepare(SampleRate::new(7).expect("a rate"));
            let mut places = Vec::new();
            let mut pixel = [number_of(at)];
            place.random(&mut pixel, seed);
            place.place(&pixel, &mut places);
            places
        };
        let first = places([0, 0], 5);
        for at in [[1, 0], [0, 1], [63, 12], [-1, -7], [1000, 3]] {
            let found = places(at, 5);
            assert_ne!(found, first, "shifted in {at:?}");
            let shift = |i: usize| [0, 1].map(|axis: usize| found[i][axis].wrapping_sub(first[i][axis]));
            assert!((1..7).all(|i| shift(i) == shift(0)), "{at:?}: {found:?} from {first:?}");
            let [x, y] = at;
            assert_eq!(found, places([x + 64, y - 64], 5), "the tile goes on for ever");
        }
        assert_ne!(first, places([0, 0], 6), "a seed is another part of it");
    }
}
