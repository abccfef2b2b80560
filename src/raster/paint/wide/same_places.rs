//! Weighted sums of stored values, of samples that lie at the same places in every pixel.
//!
//! A pixel adds its samples to the sums of all pixels around it, each time with other weights. So its channels are taken apart
//! once, and everything else is sums of products, as many at a time as a vector holds.
//!
//! ```text
//!     . . .
//!     . # .      margin 1: the samples of # are added to nine sums, its own among them
//!     . . .
//! ```
//!
//! All numbers are whole, and all sums are below `2^53`: 64-bit floats hold them exactly, in whatever order.

#![expect(
    clippy::inline_always,
    reason = "only what is inlined into a dispatched function is compiled for its vector instructions"
)]

use fearless_simd::prelude::*;
use fearless_simd::{Simd, dispatch, f64x8};

use crate::color::{Premultiplied16, ResolveSpace, WeightedSum};
use crate::raster::paint::sample_colors::{PixelColors, SampleColors};
use crate::raster::paint::wide::flat::FlatPixels;
use crate::simd;

/// Numbers that are multiplied at once.
const LANES: usize = 8;

/// Sums up weighted samples, reusing its memory.
#[derive(Debug)]
pub(super) struct SamePlaces {
    /// Pixels on each side.
    margin: usize,
    /// Of each pixel around one, row by row.
    around: Vec<Weights>,
    /// What all samples around a pixel weigh together.
    total: i64,
    /// The channels of the samples of the pixel at work.
    channels: [Vec<f64>; 4],
    /// Of each pixel of the tile, row by row, the sums of the channels in parts.
    sums: Vec<[[f64; LANES]; 4]>,
}

/// What the samples of a pixel weigh.
#[derive(Debug)]
struct Weights {
    all: f64,
    /// Each of them, filled up with nothing to whole vectors.
    each: Vec<f64>,
}

impl SamePlaces {
    /// Of weights of each pixel around one, row by row, together and for each sample; `None` where sums may not be exact.
    pub(super) fn new(around: &[(i64, Vec<i64>)], margin: usize) -> Option<Self> {
        let unsigned: u64 = around
            .iter()
            .flat_map(|(_, each)| each)
            .map(|weight| weight.unsigned_abs())
            .sum();
        if unsigned.checked_mul(Premultiplied16::ONE.into())? >= 1 << 53 {
            return None;
        }
        let weights = |(all, each): &(i64, Vec<i64>)| {
            let mut each: Vec<f64> = each.iter().map(|weight| *weight as f64).collect();
            each.resize(each.len().next_multiple_of(LANES), 0.0);
            Weights { all: *all as f64, each }
        };
        Some(Self {
            margin,
            around: around.iter().map(weights).collect(),
            total: around.iter().map(|(all, _)| all).sum(),
            channels: Default::default(),
            sums: Vec::new(),
        })
    }

    /// Calls `put` with each pixel of a tile that is not flat, by column and row, and its sum.
    pub(super) fn each(
        &mut self,
        colors: &SampleColors,
        flat: &FlatPixels,
        put: &mut impl FnMut([usize; 2], WeightedSum),
    ) {
        self.sums.clear();
        self.sums.resize(flat.width() * flat.height(), [[0.0; LANES]; 4]);
        dispatch!(simd::level(), simd => self.add_all(simd, colors, flat));
        for y in 0..flat.height() {
            for x in flat.mixed(y).runs().flatten() {
                put([x, y], self.sum(y * flat.width() + x));
            }
        }
    }

    #[expect(clippy::cast_possible_truncation, reason = "whole numbers below 2^53")]
    fn sum(&self, pixel: usize) -> WeightedSum {
        let mut sum = WeightedSum {
            channels: [0; 4],
            weight: self.total,
        };
        for (channel, parts) in sum.channels.iter_mut().zip(&self.sums[pixel]) {
            *channel = parts.iter().sum::<f64>() as i64;
        }
        sum
    }

    /// Adds all painted pixels to the sums of those around them.
    #[inline(always)]
    fn add_all<S: Simd>(&mut self, simd: S, colors: &SampleColors, flat: &FlatPixels) {
        simd.vectorize(
            #[inline(always)]
            || {
                let beside = 2 * self.margin;
                for y in 0..flat.height() + beside {
                    let rows = y.saturating_sub(beside)..flat.height().min(y + 1);
                    let mixed = rows.fold(0, |mixed, row| mixed | u128::from(flat.mixed(row).word()));
                    for x in 0..colors.width() {
                        // The columns of the tile that this pixel is beside.
                        let touched = window(x, beside);
                        if mixed & touched != 0 {
                            self.add(simd, colors.pixel(y * colors.width() + x), ([x, y], flat));
                        }
                    }
                }
            },
        );
    }

    /// Adds the pixel in this column and row of what was painted to the sums around it.
    #[inline(always)]
    fn add<S: Simd>(&mut self, simd: S, pixel: PixelColors<'_>, ([x, y], flat): ([usize; 2], &FlatPixels)) {
        let Self {
            margin,
            around,
            channels,
            sums,
            ..
        } = self;
        let beside = 2 * *margin;
        let is_opaque = if let PixelColors::Split(samples) = pixel {
            take_apart(samples, channels)
        } else {
            false
        };
        for row in y.saturating_sub(beside)..flat.height().min(y + 1) {
            let mut columns = u128::from(flat.mixed(row).word()) & window(x, beside);
            while columns != 0 {
                let column = columns.trailing_zeros() as usize;
                columns &= columns - 1;
                let weights = &around[(y - row) * (beside + 1) + x - column];
                let sums = &mut sums[row * flat.width() + column];
                match pixel {
                    PixelColors::Whole(color) => add_whole(weights, color, sums),
                    PixelColors::Split(_) => add_split(simd, weights, (channels, is_opaque), sums),
                }
            }
        }
    }
}

/// The columns of a tile that a pixel in column `x` of what was painted is beside.
#[inline(always)]
fn window(x: usize, beside: usize) -> u128 {
    let upto = u128::MAX >> (127 - x.min(127));
    upto & !(upto >> (beside + 1).min(127))
}

/// Takes the channels of samples apart, filled up to whole vectors; whether all are opaque.
#[inline(always)]
fn take_apart(samples: &[Premultiplied16], channels: &mut [Vec<f64>; 4]) -> bool {
    let filled = samples.len().next_multiple_of(LANES);
    let mut alpha = u16::MAX;
    for (k, channel) in channels.iter_mut().enumerate() {
        channel.resize(filled, 0.0);
        for (number, sample) in channel.iter_mut().zip(samples) {
            *number = f64::from(sample.0[k]);
        }
    }
    for sample in samples {
        alpha = alpha.min(sample.0[3]);
    }
    alpha == Premultiplied16::ONE
}

#[inline(always)]
fn add_whole(weights: &Weights, color: Premultiplied16, sums: &mut [[f64; LANES]; 4]) {
    for (sum, part) in sums.iter_mut().zip(ResolveSpace::Stored.parts(color)) {
        sum[0] += weights.all * f64::from(part);
    }
}

#[inline(always)]
fn add_split<S: Simd>(
    simd: S,
    weights: &Weights,
    (channels, is_opaque): (&[Vec<f64>; 4], bool),
    sums: &mut [[f64; LANES]; 4],
) {
    let count = if is_opaque { 3 } else { 4 };
    for (sum, channel) in sums.iter_mut().zip(channels).take(count) {
        let mut found = f64x8::simd_from(simd, *sum);
        for (weights, numbers) in weights
            .each
            .as_chunks::<LANES>()
            .0
            .iter()
            .zip(channel.as_chunks::<LANES>().0)
        {
            found = f64x8::simd_from(simd, *weights).mul_add(f64x8::simd_from(simd, *numbers), found);
        }
        *sum = found.to_array();
    }
    if is_opaque {
        sums[3][0] += weights.all * f64::from(Premultiplied16::ONE);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::raster::paint::wide::free::{FreeSums, WeighedPositions};
    use crate::raster::paint::wide::random_tile::{SIZE, painted};
    use crate::raster::random::any_filter;
    use crate::raster::resolve::axis_weights::AxisWeights;
    use crate::raster::sampling::positions::SamplePositions;
    use crate::raster::{SamplePattern, SampleRate, Seed};

    #[test]
    fn sums_are_those_of_samples_one_by_one() {
        let patterns = [
            SamplePattern::Hammersley,
            SamplePattern::Rotated,
            SamplePattern::SobolSame,
            SamplePattern::R2,
        ];
        let mut tried = 0;
        arbtest::arbtest(|u| {
            let count = *u.choose(&[1, 4, 9, 16, 25, 64])?;
            let rate = SampleRate::new(count).expect("a rate");
            let pattern = *u.choose(&patterns)?;
            let samples = WeighedPositions {
                positions: SamplePositions::new(pattern, rate, Seed::default()),
                weights: AxisWeights::new(any_filter(u)?, 256),
            };
            let margin = samples.weights.margin();
            let mut free = FreeSums::new(ResolveSpace::Stored, &samples);
            let Some(mut same) = SamePlaces::new(free.same(), margin.cast_unsigned() as usize) else {
                return Ok(());
            };
            tried += 1;
            let colors = painted(u, count.cast_signed(), margin)?;
            let mut flat = FlatPixels::default();
            flat.find(&colors, margin.cast_unsigned() as usize);
            let [mut found, mut expected] = [Vec::new(), Vec::new()];
            same.each(&colors, &flat, &mut |pixel, sum| found.push((pixel, sum)));
            free.each(&colors, &samples, &flat, &mut |pixel, sum| expected.push((pixel, sum)));
            assert_eq!(
                found, expected,
                "{pattern:?}, {count} samples, margin {margin}, {SIZE:?}"
            );
            Ok(())
        })
        .budget_ms(800);
        assert!(tried > 20, "{tried} tiles were resolved");
    }
}
