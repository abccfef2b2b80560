//! Weighted sums of samples on a grid: a sample weighs the product of its column's and its row's weight, so that each row of
//! samples is summed up first, and then these sums, column by column.
//!
//! A pixel that shows one colour has the same samples in each of its rows. Rows of such pixels have one sum.

#![expect(
    clippy::inline_always,
    reason = "only what is inlined into a dispatched function is compiled for its vector instructions"
)]

use std::fmt::Debug;

use fearless_simd::prelude::*;
use fearless_simd::{Simd, dispatch, f64x4};

use crate::color::{ResolveSpace, WeightedSum};
use crate::raster::paint::sample_colors::{PixelColors, SampleColors};
use crate::raster::paint::wide::flat::{FlatPixels, PixelBits};
use crate::raster::resolve::axis_weights::AxisWeights;
use crate::simd;

/// Numbers that are whole and stay so.
pub(super) trait Whole: Copy + Debug + Default {
    /// A weight, or a part of a sample.
    fn of(number: i32) -> Self;

    /// `self + a * b`.
    fn plus_times(self, a: Self, b: Self) -> Self;

    /// The number.
    fn get(self) -> i64;

    /// `sum`, and each of `parts` times its weight.
    #[inline(always)]
    fn plus_weighted<S: Simd>(_: S, sum: [Self; 4], weights: &[Self], parts: &[[Self; 4]]) -> [Self; 4] {
        weights
            .iter()
            .zip(parts)
            .fold(sum, |sum, (weight, parts)| plus_times(sum, *weight, *parts))
    }
}

impl Whole for i64 {
    #[inline(always)]
    fn of(number: i32) -> Self {
        number.into()
    }

    #[inline(always)]
    fn plus_times(self, a: Self, b: Self) -> Self {
        self + a * b
    }

    #[inline(always)]
    fn get(self) -> i64 {
        self
    }
}

/// As long as no number exceeds `2^53`.
impl Whole for f64 {
    #[inline(always)]
    fn of(number: i32) -> Self {
        number.into()
    }

    // A fused multiplication would be a call on machines that have none, and what is exact is not rounded anyway.
    #[inline(always)]
    #[expect(clippy::suboptimal_flops, reason = "see above")]
    fn plus_times(self, a: Self, b: Self) -> Self {
        self + a * b
    }

    #[inline(always)]
    #[expect(clippy::cast_possible_truncation, reason = "a whole number below 2^53")]
    fn get(self) -> i64 {
        debug_assert!(self.abs() < 9_007_199_254_740_992.0, "{self} is exact");
        self as i64
    }

    #[inline(always)]
    fn plus_weighted<S: Simd>(simd: S, sum: [Self; 4], weights: &[Self], parts: &[[Self; 4]]) -> [Self; 4] {
        let mut sum = f64x4::simd_from(simd, sum);
        for (weight, parts) in weights.iter().zip(parts) {
            sum += f64x4::simd_from(simd, *parts) * *weight;
        }
        sum.into()
    }
}

/// Sums up weighted samples on a grid, reusing its memory.
#[derive(Debug)]
pub(super) struct SeparableSums<T> {
    space: ResolveSpace,
    /// Samples along the side of a pixel.
    side: usize,
    /// Pixels on each side.
    margin: usize,
    /// What columns, or rows, of samples weigh; those of the first pixel first. And those of each pixel together.
    weights: Vec<T>,
    of_pixels: Vec<T>,
    /// What all samples weigh together.
    total: i64,
    /// The row of pixels at work: the parts of pixels that show one colour, and of each sample of the others.
    whole: Vec<[T; 4]>,
    samples: Vec<[T; 4]>,
    split: Vec<bool>,
    /// The last rows of pixels, each in the place of the one that is no longer needed: for each pixel of the tile the sums of
    /// its rows of samples, and whether all are as the first.
    rows: Vec<[T; 4]>,
    alike: Vec<bool>,
    /// The sums of a row of pixels.
    found: Vec<[i64; 4]>,
}

impl<T: Whole> SeparableSums<T> {
    pub(super) fn new(space: ResolveSpace, weights: &AxisWeights, side: i32) -> Self {
        let margin = weights.margin();
        let all: Vec<i32> = (-margin..=margin)
            .flat_map(|beside| weights.of_pixel(beside))
            .copied()
            .collect();
        let side = side.cast_unsigned() as usize;
        let of_pixels = all.chunks(side).map(|columns| columns.iter().sum());
        let axis: i64 = all.iter().map(|weight| i64::from(*weight)).sum();
        Self {
            space,
            side,
            margin: margin.cast_unsigned() as usize,
            of_pixels: of_pixels.map(T::of).collect(),
            weights: all.into_iter().map(T::of).collect(),
            total: axis * axis,
            whole: Vec::new(),
            samples: Vec::new(),
            split: Vec::new(),
            rows: Vec::new(),
            alike: Vec::new(),
            found: Vec::new(),
        }
    }

    /// Calls `put` with each pixel of a tile that is not flat, by column and row, and its sum.
    pub(super) fn each(
        &mut self,
        colors: &SampleColors,
        flat: &FlatPixels,
        put: &mut impl FnMut([usize; 2], WeightedSum),
    ) {
        let (width, around) = (flat.width(), 2 * self.margin + 1);
        self.rows.resize(around * width * self.side, Default::default());
        self.alike.resize(around * width, false);
        for y in 0..flat.height() + 2 * self.margin {
            let wanted = flat.around(y, self.margin);
            if !wanted.is_empty() {
                self.read(colors, y, wanted);
                dispatch!(simd::level(), simd => across(simd, self, (y % around) * width, wanted));
            }
            if let Some(row) = y.checked_sub(2 * self.margin) {
                self.found.resize(width, [0; 4]);
                dispatch!(simd::level(), simd => down(simd, self, row, flat.mixed(row)));
                for x in flat.mixed(row).runs().flatten() {
                    let (channels, weight) = (self.found[x], self.total);
                    put([x, row], WeightedSum { channels, weight });
                }
            }
        }
    }

    /// Reads the pixels of a row that lie around those that are wanted.
    fn read(&mut self, colors: &SampleColors, y: usize, wanted: PixelBits) {
        let (width, per_pixel) = (colors.width(), self.side * self.side);
        let beside = 2 * self.margin;
        self.whole.resize(width, Default::default());
        self.split.resize(width, false);
        self.samples.resize(width * per_pixel, Default::default());
        // The last pixel around those that are wanted so far.
        let mut last = None;
        for x in 0..width {
            if wanted.contains(x) {
                last = Some(x + beside);
            }
            if last.is_none_or(|last| last < x) {
                continue;
            }
            match colors.pixel(y * width + x) {
                PixelColors::Whole(color) => {
                    self.split[x] = false;
                    self.whole[x] = self.space.parts(color).map(T::of);
                }
                PixelColors::Split(samples) => {
                    self.split[x] = true;
                    for (parts, sample) in self.samples[x * per_pixel..].iter_mut().zip(samples) {
                        *parts = self.space.parts(*sample).map(T::of);
                    }
                }
            }
        }
    }
}

/// Sums up the rows of samples around the pixels that are wanted; `place` is that of the first in the memory of rows.
#[inline(always)]
fn across<S: Simd, T: Whole>(simd: S, sums: &mut SeparableSums<T>, place: usize, wanted: PixelBits) {
    simd.vectorize(
        #[inline(always)]
        || {
            let (side, around) = (sums.side, 2 * sums.margin + 1);
            let (rows, alike) = (&mut sums.rows, &mut sums.alike);
            for x in wanted.runs().flatten() {
                let split = &sums.split[x..x + around];
                let mut even = [T::default(); 4];
                for ((parts, weight), split) in sums.whole[x..x + around].iter().zip(&sums.of_pixels).zip(split) {
                    if !split {
                        even = plus_times(even, *weight, *parts);
                    }
                }
                alike[place + x] = !split.contains(&true);
                let found = &mut rows[(place + x) * side..][..side];
                found.fill(even);
                if alike[place + x] {
                    continue;
                }
                for beside in (0..around).filter(|beside| split[*beside]) {
                    let weights = &sums.weights[beside * side..][..side];
                    let samples = &sums.samples[(x + beside) * side * side..][..side * side];
                    for (found, samples) in found.iter_mut().zip(samples.chunks_exact(side)) {
                        *found = T::plus_weighted(simd, *found, weights, samples);
                    }
                }
            }
        },
    );
}

/// The sums of all samples around the pixels of a row that are not flat: of the last rows.
#[inline(always)]
fn down<S: Simd, T: Whole>(simd: S, sums: &mut SeparableSums<T>, row: usize, mixed: PixelBits) {
    simd.vectorize(
        #[inline(always)]
        || {
            let (side, around, width) = (sums.side, 2 * sums.margin + 1, sums.found.len());
            for x in mixed.runs().flatten() {
                let mut all = [T::default(); 4];
                for beside in 0..around {
                    let at = (row + beside) % around * width + x;
                    let rows = &sums.rows[at * side..][..side];
                    if sums.alike[at] {
                        all = plus_times(all, sums.of_pixels[beside], rows[0]);
                        continue;
                    }
                    all = T::plus_weighted(simd, all, &sums.weights[beside * side..][..side], rows);
                }
                sums.found[x] = all.map(T::get);
            }
        },
    );
}

/// `sum + weight * parts`.
#[inline(always)]
fn plus_times<T: Whole>(sum: [T; 4], weight: T, parts: [T; 4]) -> [T; 4] {
    std::array::from_fn(|k| sum[k].plus_times(weight, parts[k]))
}
