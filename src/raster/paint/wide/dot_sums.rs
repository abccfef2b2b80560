//! Weighted sums of stored values on a grid, by dot products of 16-bit numbers.
//!
//! The same sums as those of [`super::separable`], where the weights of all columns add up to so little that a row's sum fits
//! 32 bits: up to 4 x 4 samples with every filter. Stored values are moved below zero by half their range, so that they fit 16
//! bits with a sign; a machine multiplies and adds eight or more of these at a time.
//!
//! ```text
//!    samples of a row    r0 g0 b0 a0  r1 g1 b1 a1  ...
//!    as they are kept    r0 r1 g0 g1  b0 b1 a0 a1  ...       two columns side by side
//!    times the weights   w0 w1 w0 w1  w0 w1 w0 w1  ...
//! ```

#![expect(
    clippy::inline_always,
    reason = "only what is inlined into a dispatched function is compiled for its vector instructions"
)]

use std::ops::Range;

use fearless_simd::prelude::*;
use fearless_simd::{Simd, dispatch, f64x8, i16x8, i16x16, i32x4, i32x8};

use crate::color::{Premultiplied16, ResolveSpace, WeightedSum};
use crate::raster::frame::block::PixelBlock;
use crate::raster::paint::sample_colors::{PixelColors, SampleColors};
use crate::raster::paint::wide::flat::FlatPixels;
use crate::raster::resolve::axis_weights::AxisWeights;
use crate::rules::Rules;
use crate::simd;

/// By how much stored values are moved, so that they fit 16 bits with a sign.
const MOVED: i32 = 1 << 15;
/// Numbers of two samples that lie side by side.
const PAIR: usize = 8;
/// Numbers that are multiplied at once: of two pairs.
const AT_ONCE: usize = 2 * PAIR;
/// Rows of samples that are summed up together, and pixels.
const ROWS: usize = 4;
const TOGETHER: usize = 4;

/// Sums up weighted samples, reusing its memory.
#[derive(Debug)]
pub(super) struct DotSums {
    rules: Rules,
    /// Samples along the side of a pixel, and the pairs of columns that they are.
    side: usize,
    pairs: usize,
    /// Pixels on each side.
    margin: usize,
    /// Pairs around a pixel that weigh nothing on the left, and what the others weigh.
    first_pair: usize,
    weights: Vec<i16>,
    /// Rows around a pixel that weigh nothing at the top, and what the others weigh.
    first_row: usize,
    rows: Vec<f64>,
    /// What the columns of each pixel around one weigh together.
    of_pixels: Vec<i32>,
    mean: Mean,
    /// The row of pixels at work, each of its rows of samples after the other: so many numbers each.
    samples: Vec<i16>,
    stride: usize,
    /// The sums of the last rows of samples, so many to a row, each row in the place of the one that is no longer needed.
    sums: Vec<[f64; 4]>,
    width: usize,
}

/// What makes a pixel of a sum.
#[derive(Clone, Copy, Debug)]
struct Mean {
    /// What all samples weigh together.
    total: i64,
    /// What was taken from the sum because values were moved.
    moved: f64,
    /// The sum of opaque samples' alpha.
    one: f64,
    /// What rounds, in parts of a sum: half a level or nothing, and half of what is between two sums.
    rounding: f64,
    /// Levels in a part of a sum.
    levels: f64,
}

impl DotSums {
    /// `None` where sums may not fit.
    pub(super) fn new(weights: &AxisWeights, side: i32, rules: Rules) -> Option<Self> {
        let margin = weights.margin();
        let of_pixels = (-margin..=margin).map(|beside| weights.of_pixel(beside));
        let all: Vec<i32> = of_pixels.clone().flatten().copied().collect();
        let most: i32 = all.iter().map(|weight| weight.abs()).sum();
        most.checked_mul(MOVED)?;
        let narrow: Vec<i16> = all
            .iter()
            .map(|weight| i16::try_from(*weight).ok())
            .collect::<Option<_>>()?;
        let side = side.cast_unsigned() as usize;
        let pairs = narrow.chunks(side).flat_map(|columns| columns.chunks(2));
        let pairs: Vec<[i16; 2]> = pairs
            .map(|pair| [0, 1].map(|at| pair.get(at).copied().unwrap_or(0)))
            .collect();
        let (first_pair, inner) = trimmed(&pairs, &[0, 0]);
        let mut columns: Vec<i16> = inner.iter().flat_map(|pair| pair.repeat(PAIR / 2)).collect();
        columns.resize(columns.len().next_multiple_of(AT_ONCE), 0);
        let (first_row, rows) = trimmed(&all, &0);
        let total = all.iter().map(|weight| i64::from(*weight)).sum::<i64>().pow(2);
        Some(Self {
            rules,
            side,
            pairs: side.div_ceil(2),
            margin: margin.cast_unsigned() as usize,
            first_pair,
            weights: columns,
            first_row,
            rows: rows.iter().map(|weight| f64::from(*weight)).collect(),
            of_pixels: of_pixels.map(|columns| columns.iter().sum()).collect(),
            mean: Mean::new(total, rules),
            samples: Vec::new(),
            stride: 0,
            sums: Vec::new(),
            width: 0,
        })
    }

    /// What all samples around a pixel weigh together; pixels can be resolved only where that is above zero.
    pub(super) fn total(&self) -> i64 {
        self.mean.total
    }

    /// Resolves the pixels of a tile that are not flat.
    pub(super) fn resolve(&mut self, colors: &SampleColors, flat: &FlatPixels, block: &mut PixelBlock<'_>) {
        let around = 2 * self.margin + 1;
        self.stride = (colors.width() * self.pairs * PAIR + AT_ONCE).next_multiple_of(AT_ONCE);
        self.samples.resize(self.side * self.stride, 0);
        self.width = flat.width() + TOGETHER;
        self.sums.resize(around * self.side * self.width, [0.0; 4]);
        let rows = block.rect.y;
        for y in 0..flat.height() + 2 * self.margin {
            let first = y % around * self.side * self.width;
            for run in flat.around(y, self.margin).runs() {
                let (whole, is_split) = colors.row(y);
                let read = run.start..run.end + 2 * self.margin;
                if is_split[read.clone()].contains(&true) {
                    dispatch!(simd::level(), simd => self.read(simd, colors, y, read));
                    dispatch!(simd::level(), simd => self.across(simd, run, first));
                } else {
                    dispatch!(simd::level(), simd => self.across_whole(simd, whole, run, first));
                }
            }
            let Some(row) = y.checked_sub(2 * self.margin) else {
                continue;
            };
            let line = block.line(rows.start + i32::try_from(row).unwrap_or(0));
            for run in flat.mixed(row).runs() {
                dispatch!(simd::level(), simd => self.down(simd, row, run, line));
            }
        }
    }

    /// Reads some pixels of a row.
    #[inline(always)]
    fn read<S: Simd>(&mut self, simd: S, colors: &SampleColors, y: usize, pixels: Range<usize>) {
        simd.vectorize(
            #[inline(always)]
            || {
                let numbers = self.pairs * PAIR;
                for x in pixels {
                    match colors.pixel(y * colors.width() + x) {
                        PixelColors::Whole(color) => {
                            let pair = i16x8::simd_from(simd, side_by_side(simd, moved(color), moved(color)));
                            for row in 0..self.side {
                                let found = &mut self.samples[row * self.stride + x * numbers..][..numbers];
                                for found in found.as_chunks_mut::<PAIR>().0 {
                                    pair.store_slice(found);
                                }
                            }
                        }
                        PixelColors::Split(samples) => {
                            for row in 0..self.side {
                                let found = &mut self.samples[row * self.stride + x * numbers..][..numbers];
                                let samples = &samples[row * self.side..][..self.side];
                                let (pairs, rest) = samples.as_chunks();
                                let (found, last) = found.split_at_mut(pairs.len() * PAIR);
                                for (found, [left, right]) in found.as_chunks_mut().0.iter_mut().zip(pairs) {
                                    *found = side_by_side(simd, moved(*left), moved(*right));
                                }
                                if let ([left], Some(found)) = (rest, last.as_chunks_mut().0.first_mut()) {
                                    *found = side_by_side(simd, moved(*left), [0; 4]);
                                }
                            }
                        }
                    }
                }
            },
        );
    }

    /// Sums up the rows of samples around pixels side by side.
    #[inline(always)]
    fn across<S: Simd>(&mut self, simd: S, pixels: Range<usize>, first: usize) {
        simd.vectorize(
            #[inline(always)]
            || {
                for top in (0..self.side).step_by(ROWS) {
                    for x in pixels.clone() {
                        let start = (x * self.pairs + self.first_pair) * PAIR;
                        if top + ROWS <= self.side {
                            self.rows_at::<S, ROWS>(simd, top, start, first + top * self.width + x);
                        } else {
                            for row in top..self.side {
                                self.rows_at::<S, 1>(simd, row, start, first + row * self.width + x);
                            }
                        }
                    }
                }
            },
        );
    }

    /// Some of them for one pixel.
    #[inline(always)]
    fn rows_at<S: Simd, const N: usize>(&mut self, simd: S, top: usize, start: usize, place: usize) {
        let (weights, _) = self.weights.as_chunks::<AT_ONCE>();
        let mut sums = [i32x8::splat(simd, 0); N];
        let rows: [&[[i16; AT_ONCE]]; N] = std::array::from_fn(|row| {
            let numbers = &self.samples[(top + row) * self.stride + start..][..self.weights.len()];
            numbers.as_chunks().0
        });
        for (at, weights) in weights.iter().enumerate() {
            let weights = i16x16::simd_from(simd, *weights);
            for (sum, row) in sums.iter_mut().zip(rows) {
                if let Some(numbers) = row.get(at) {
                    *sum += i16x16::simd_from(simd, *numbers).pairwise_dot_product(weights);
                }
            }
        }
        for (row, sum) in sums.into_iter().enumerate() {
            let (left, right) = sum.split();
            self.sums[place + row * self.width] = (left + right).to_array().map(f64::from);
        }
    }

    /// The same for pixels that show one colour each, as all around them do: their rows are alike.
    #[inline(always)]
    fn across_whole<S: Simd>(&mut self, simd: S, colors: &[Premultiplied16], pixels: Range<usize>, first: usize) {
        simd.vectorize(
            #[inline(always)]
            || {
                for x in pixels {
                    let mut sum = i32x4::splat(simd, 0);
                    for (color, weight) in colors[x..].iter().zip(&self.of_pixels) {
                        sum += i32x4::simd_from(simd, moved(*color).map(i32::from)) * *weight;
                    }
                    let sum = sum.to_array().map(f64::from);
                    for row in 0..self.side {
                        self.sums[first + row * self.width + x] = sum;
                    }
                }
            },
        );
    }

    /// Sums up the last rows around pixels side by side, and makes pixels of them.
    #[inline(always)]
    fn down<S: Simd>(&self, simd: S, row: usize, pixels: Range<usize>, line: &mut [u32]) {
        simd.vectorize(
            #[inline(always)]
            || {
                let all = (2 * self.margin + 1) * self.side;
                let first = (row * self.side + self.first_row) % all;
                // From the first row to the end of the memory, and on from its start.
                let (before, after) = self.rows.split_at(self.rows.len().min(all - first));
                for start in pixels.clone().step_by(TOGETHER) {
                    let mut sums = [f64x8::splat(simd, 0.0); TOGETHER / 2];
                    for (first, weights) in [(first, before), (0, after)] {
                        for (row, weight) in weights.iter().enumerate() {
                            let at = (first + row) * self.width + start;
                            let (twos, _) = self.sums[at..at + TOGETHER].as_flattened().as_chunks();
                            for (sum, two) in sums.iter_mut().zip(twos) {
                                *sum = f64x8::simd_from(simd, *two).mul_add(*weight, *sum);
                            }
                        }
                    }
                    let found = sums.map(f64x8::to_array);
                    let (found, _) = found.as_flattened().as_chunks();
                    for (pixel, sum) in line[start..pixels.end].iter_mut().zip(found) {
                        *pixel = self.mean.pixel(*sum, self.rules);
                    }
                }
            },
        );
    }
}

impl Mean {
    fn new(total: i64, rules: Rules) -> Self {
        let total_weight = total as f64;
        let per_level = f64::from(Premultiplied16::PER_BYTE) * total_weight;
        let half = match rules {
            Rules::Standard | Rules::Float => per_level / 2.0,
            Rules::Course => 0.0,
        };
        Self {
            total,
            moved: f64::from(MOVED) * total_weight,
            one: f64::from(Premultiplied16::ONE) * total_weight,
            // Sums are whole, and levels far apart: a level's least sum is found in it whatever the division rounds.
            rounding: half + 0.5,
            levels: per_level.recip(),
        }
    }

    /// The pixel for a sum of values that were moved.
    #[inline(always)]
    fn pixel(&self, sum: [f64; 4], rules: Rules) -> u32 {
        let sum = sum.map(|channel| channel + self.moved);
        if sum[3] < self.one {
            return self.translucent(sum, rules);
        }
        let [r, g, b, _] = sum.map(|channel| level((channel.clamp(0.0, self.one) + self.rounding) * self.levels));
        0xFF00_0000 | r << 16 | g << 8 | b
    }

    /// The same of what is not opaque.
    #[inline(never)]
    #[expect(clippy::cast_possible_truncation, reason = "whole numbers below 2^53")]
    fn translucent(&self, sum: [f64; 4], rules: Rules) -> u32 {
        let sum = WeightedSum {
            channels: sum.map(|channel| channel as i64),
            weight: self.total,
        };
        ResolveSpace::Stored.weighted_pixel(sum, rules)
    }
}

/// A level's number.
#[inline(always)]
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "from nothing to a little above 255"
)]
fn level(levels: f64) -> u32 {
    levels as u32
}

/// A stored colour's channels, moved below zero by half their range.
#[inline(always)]
#[expect(clippy::cast_possible_wrap, reason = "the highest bit becomes the sign")]
fn moved(color: Premultiplied16) -> [i16; 4] {
    color.0.map(|channel| (channel ^ 1 << 15) as i16)
}

/// Two samples, channel by channel.
#[inline(always)]
fn side_by_side<S: Simd>(simd: S, left: [i16; 4], right: [i16; 4]) -> [i16; PAIR] {
    let both = i16x8::from_slice(simd, [left, right].as_flattened());
    both.zip_low(both.slide::<4>(both)).to_array()
}

/// Without what is `nothing` at both ends, and how many were left out at the first.
fn trimmed<'t, T: PartialEq>(all: &'t [T], nothing: &T) -> (usize, &'t [T]) {
    let first = all.iter().take_while(|one| *one == nothing).count();
    let inner = &all[first..];
    let last = inner.iter().rev().take_while(|one| *one == nothing).count();
    (first, &inner[..inner.len() - last])
}

#[cfg(test)]
mod tests {
    use arbtest::arbitrary::{Result, Unstructured};

    use super::*;
    use crate::raster::SampleRate;
    use crate::raster::paint::sample_colors::ShadedColors;
    use crate::raster::paint::wide::separable::SeparableSums;
    use crate::raster::random::any_filter;
    use crate::raster::resolve::{FilterRadius, ResolveFilter};
    use crate::raster::span::{Span, SpanRect};

    /// Pixels of the tile.
    const SIZE: [i32; 2] = [13, 6];

    fn weights(filter: ResolveFilter, side: i32) -> AxisWeights {
        AxisWeights::new(filter.sized(None), side)
    }

    /// A tile and its margin, some pixels of which are split.
    fn painted(u: &mut Unstructured<'_>, side: i32, margin: i32) -> Result<SampleColors> {
        let rate = SampleRate::new((side * side).cast_unsigned()).expect("a square");
        let [x, y] = SIZE.map(|length| Span {
            start: 0,
            end: length + 2 * margin,
        });
        let mut colors = SampleColors::new(rate, Rules::Standard, ResolveSpace::Stored);
        colors.reset(SpanRect { x, y }, Premultiplied16([Premultiplied16::ONE; 4]));
        let opaque = u.ratio(3, 4)?;
        for _ in 0..u.int_in_range(0..=20)? {
            let (row, start) = (u.int_in_range(0..=y.end - 1)?, u.int_in_range(0..=x.end - 1)?);
            let pixels = Span {
                start,
                end: u.int_in_range(start + 1..=x.end)?,
            };
            let samples = if u.arbitrary()? {
                pixels.length() * usize::try_from(side * side).unwrap_or(0)
            } else {
                1
            };
            let any = |_| {
                let alpha = if opaque {
                    Premultiplied16::ONE
                } else {
                    u.int_in_range(0..=Premultiplied16::ONE)?
                };
                let mut channel = || u.int_in_range(0..=alpha);
                Ok(Premultiplied16([channel()?, channel()?, channel()?, alpha]))
            };
            let found = (0..samples).map(any).collect::<Result<Vec<_>>>()?;
            if samples == 1 {
                colors.fill(pixels, row, found[0]);
            } else {
                colors.write(pixels, row, ShadedColors { colors: &found, opaque });
            }
        }
        Ok(colors)
    }

    #[test]
    fn sums_are_those_of_whole_numbers_without_a_limit() {
        let mut tried = 0;
        arbtest::arbtest(|u| {
            let side = u.int_in_range(1..=6)?;
            let rules = *u.choose(&Rules::ALL)?;
            let weights = AxisWeights::new(any_filter(u)?, side);
            let Some(mut sums) = DotSums::new(&weights, side, rules).filter(|sums| sums.total() > 0) else {
                return Ok(());
            };
            tried += 1;
            let margin = weights.margin();
            let colors = painted(u, side, margin)?;
            let mut flat = FlatPixels::default();
            flat.find(&colors, margin.cast_unsigned() as usize);
            let [width, height] = SIZE.map(|length| usize::try_from(length).unwrap_or(0));
            let mut expected = vec![0; width * height];
            SeparableSums::<i64>::new(ResolveSpace::Stored, &weights, side).each(&colors, &flat, &mut |[x, y], sum| {
                expected[y * width + x] = ResolveSpace::Stored.weighted_pixel(sum, rules);
            });
            let mut found = vec![0; width * height];
            let [x, y] = SIZE.map(|end| Span { start: 0, end });
            sums.resolve(
                &colors,
                &flat,
                &mut PixelBlock::in_rows(SpanRect { x, y }, &mut found, width),
            );
            assert_eq!(found, expected, "side {side}, margin {margin}, {rules:?}");
            Ok(())
        })
        .budget_ms(800);
        assert!(tried > 20, "{tried} tiles were resolved");
    }

    #[test]
    fn every_filter_fits_up_to_4_samples_along_a_side() {
        for filter in ResolveFilter::ALL {
            for side in 1..=4 {
                let stretched = AxisWeights::new(filter.sized(FilterRadius::new(FilterRadius::MAX)), side);
                for weights in [weights(filter, side), stretched] {
                    assert!(
                        DotSums::new(&weights, side, Rules::Standard).is_some(),
                        "{filter:?}, {side}"
                    );
                }
            }
            let many = DotSums::new(&weights(filter, 16), 16, Rules::Standard);
            assert!(many.is_none(), "{filter:?}: 16 columns weigh too much for 32 bits");
        }
    }

    #[test]
    fn levels_are_those_of_an_exact_division() {
        let total = 41_231_i64.pow(2);
        let per_level = i64::from(Premultiplied16::PER_BYTE) * total;
        for rules in Rules::ALL {
            let mean = Mean::new(total, rules);
            for level in 0..=255 {
                // The sums on both sides of where a level starts.
                for beside in [-1, 0, 1] {
                    let half = if rules == Rules::Course { 0 } else { per_level / 2 };
                    let sum = (level * per_level - half + beside).clamp(0, 255 * per_level);
                    let exact = WeightedSum {
                        channels: [sum, sum, sum, 255 * per_level],
                        weight: total,
                    };
                    let moved = exact.channels.map(|channel| channel as f64 - mean.moved);
                    assert_eq!(
                        mean.pixel(moved, rules),
                        ResolveSpace::Stored.weighted_pixel(exact, rules),
                        "level {level}, {beside} beside, {rules:?}"
                    );
                }
            }
        }
    }
}
