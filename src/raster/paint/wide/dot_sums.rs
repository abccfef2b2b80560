//! Weighted sums of stored values on a grid, by dot products of 16-bit numbers.
//!
//! The same sums as those of [`super::separable`], where the weights of all columns add up to so little that a row's sum fits
//! 32 bits: up to 4 x 4 samples with every filter. Stored values are moved below zero by half their range, so that they fit 16
//! bits with a sign; a machine multiplies and adds eight or more of these at a time.
//!
//! ```text
//!    samples of a row    r0 g0 b0 a0  r1 g1 b1 a1  ...
//!    as they are summed  r0 r1 g0 g1  b0 b1 a0 a1  ...       two columns side by side
//!    times the weights   w0 w1 w0 w1  w0 w1 w0 w1  ...
//! ```
//!
//! A pixel that shows one colour weighs as much in each of its rows, so those around a pixel are summed up once; to that each
//! split pixel adds its rows, in blocks of 4 x 4 samples. The sums of rows are cut into halves of 16 bits, of which the lower
//! ones are moved like stored values, so that dot products sum them up once more.

#![expect(
    clippy::inline_always,
    reason = "only what is inlined into a dispatched function is compiled for its vector instructions"
)]

use std::ops::Range;

use fearless_simd::prelude::*;
use fearless_simd::{Simd, dispatch, i16x8, i16x32, i32x4, i32x16, u16x32, u32x4, u32x8, u32x16, u64x2};

use crate::color::Premultiplied16;
use crate::raster::frame::block::PixelBlock;
use crate::raster::paint::sample_colors::{PixelColors, SampleColors};
use crate::raster::paint::wide::dot_means::{MOVED, Mean, TOGETHER};
use crate::raster::paint::wide::flat::FlatPixels;
use crate::raster::resolve::axis_weights::AxisWeights;
use crate::rules::Rules;
use crate::simd;

const MOVED_WORD: u64 = 0x8000_8000_8000_8000;
/// Rows and columns of samples that are summed up together.
const BLOCK: usize = 4;
/// The most of these along the side of a pixel: weights of more columns add up to too much.
const MOST_BLOCKS: usize = 2;
/// Numbers that are multiplied at once.
const AT_ONCE: usize = 32;

/// Sums up weighted samples, reusing its memory.
#[derive(Debug)]
pub(super) struct DotSums {
    /// Samples along the side of a pixel, and the blocks that they are.
    side: usize,
    blocks: usize,
    /// Pixels on each side.
    margin: usize,
    /// For each block of columns around a pixel what the first two weigh, and the others, once for each channel.
    columns: Vec<[[i16; 2 * BLOCK]; 2]>,
    /// For each block of rows what they weigh, in the order of `halves`.
    rows: Vec<[i16; AT_ONCE]>,
    /// What the columns of pixels around one weigh together, two pixels side by side: which of them the left one is, and both, once
    /// for each channel.
    of_pixels: Vec<(usize, [i16; 2 * BLOCK])>,
    mean: Mean,
    /// The row of pixels at work: those that show one colour, moved, and nothing for others; then each beside the next one.
    whole: Vec<u64>,
    pairs: Vec<[i16; 2 * BLOCK]>,
    /// For each pixel of the tile, block by block, the sums of its rows of samples: four channels each.
    sums: Vec<[i32; 4 * BLOCK]>,
    /// The same of the last rows of pixels, each in the place of the one that is no longer needed: first the lower halves, of the
    /// first and third row side by side, and of the second and fourth; then the higher ones.
    halves: Vec<[i16; AT_ONCE]>,
    width: usize,
}

/// A row of what was painted.
#[derive(Clone, Copy)]
struct PaintedRow<'c> {
    colors: &'c SampleColors,
    y: usize,
    /// Its split pixels, the first in the lowest bit.
    split: u128,
}

impl DotSums {
    /// `None` where sums may not fit.
    pub(super) fn new(weights: &AxisWeights, side: i32, rules: Rules) -> Option<Self> {
        let margin = weights.margin();
        let of_pixels = (-margin..=margin).map(|beside| weights.of_pixel(beside));
        let all: Vec<i32> = of_pixels.clone().flatten().copied().collect();
        let most: i32 = all.iter().map(|weight| weight.abs()).sum();
        most.checked_mul(MOVED.into())?;
        let narrow: Vec<i16> = all
            .iter()
            .map(|weight| i16::try_from(*weight).ok())
            .collect::<Option<_>>()?;
        let side = side.cast_unsigned() as usize;
        if side > MOST_BLOCKS * BLOCK {
            return None;
        }
        let blocks = narrow.chunks(side).flat_map(|pixel| pixel.chunks(BLOCK));
        let blocks = blocks.map(|block| [0, 1, 2, 3].map(|at| block.get(at).copied().unwrap_or(0)));
        Some(Self {
            side,
            blocks: side.div_ceil(BLOCK),
            margin: margin.cast_unsigned() as usize,
            columns: blocks
                .clone()
                .map(|[a, b, c, d]| [[a, b], [c, d]].map(repeated))
                .collect(),
            rows: blocks.map(|[a, b, c, d]| halves_weights([a, b, c, d])).collect(),
            of_pixels: weights_of_pairs(&of_pixels.map(|columns| columns.iter().sum()).collect::<Vec<_>>()),
            mean: Mean::new([all.iter().map(|weight| i64::from(*weight)).sum(), most.into()], rules),
            whole: Vec::new(),
            pairs: Vec::new(),
            sums: Vec::new(),
            halves: Vec::new(),
            width: 0,
        })
    }

    /// What all samples around a pixel weigh together; pixels can be resolved only where that is above zero.
    pub(super) fn total(&self) -> i64 {
        self.mean.total()
    }

    /// Resolves the pixels of a tile that are not flat.
    pub(super) fn resolve(&mut self, colors: &SampleColors, flat: &FlatPixels, block: &mut PixelBlock<'_>) {
        let around = 2 * self.margin + 1;
        self.whole.resize(colors.width() + 1, 0);
        self.pairs.resize(colors.width() + TOGETHER, [0; 2 * BLOCK]);
        self.width = flat.width();
        self.sums.resize((self.width + TOGETHER) * self.blocks, [0; 4 * BLOCK]);
        self.halves
            .resize((around * self.width + TOGETHER) * self.blocks, [0; AT_ONCE]);
        if self.blocks == 1 {
            dispatch!(simd::level(), simd => self.rows::<_, 1>(simd, colors, flat, block));
        } else {
            dispatch!(simd::level(), simd => self.rows::<_, 2>(simd, colors, flat, block));
        }
    }

    /// Row by row: all of a tile in one go, since most runs of pixels are short.
    #[inline(always)]
    fn rows<S: Simd, const BLOCKS: usize>(
        &mut self,
        simd: S,
        colors: &SampleColors,
        flat: &FlatPixels,
        block: &mut PixelBlock<'_>,
    ) {
        simd.vectorize(
            #[inline(always)]
            || {
                let around = 2 * self.margin + 1;
                let rows = block.rect.y;
                for y in 0..flat.height() + 2 * self.margin {
                    let row = PaintedRow {
                        colors,
                        y,
                        split: flat.split(y),
                    };
                    for run in flat.around(y, self.margin).runs() {
                        self.across::<S, BLOCKS>(simd, row, run, y % around * self.width);
                    }
                    let Some(row) = y.checked_sub(2 * self.margin) else {
                        continue;
                    };
                    let line = block.line(rows.start + i32::try_from(row).unwrap_or(0));
                    for run in flat.mixed(row).runs() {
                        self.down::<S, BLOCKS>(simd, row, run, line);
                    }
                }
            },
        );
    }

    /// Sums up the rows of samples around pixels side by side, and puts them into the memory of rows, where those of the first pixel
    /// have this place.
    #[inline(always)]
    fn across<S: Simd, const BLOCKS: usize>(
        &mut self,
        simd: S,
        row: PaintedRow<'_>,
        pixels: Range<usize>,
        place: usize,
    ) {
        let read = pixels.start..pixels.end + 2 * self.margin;
        let (shown, split) = row.colors.row(row.y);
        let seen = shown[read.clone()].iter().zip(&split[read.clone()]);
        for (whole, (color, split)) in self.whole[read.clone()].iter_mut().zip(seen) {
            let kept = u64::from(*split).wrapping_sub(1);
            *whole = (color.to_word() ^ MOVED_WORD) & kept;
        }
        let both = self.whole[read.start..].windows(2);
        for (pair, whole) in self.pairs[read.clone()].iter_mut().zip(both) {
            *pair = beside(simd, [whole[0], whole[1]]).to_array();
        }
        let of_run = u128::MAX >> (u128::BITS as usize - read.len()) << read.start;
        let mut split = row.split & of_run;
        self.add_whole::<S, BLOCKS>(simd, pixels.clone(), split, place);
        // Pixels before this one are done.
        let mut first = pixels.start;
        while split != 0 {
            let x = split.trailing_zeros() as usize;
            split &= split - 1;
            if let PixelColors::Split(samples) = row.colors.pixel(row.y * row.colors.width() + x) {
                self.add_split::<S, BLOCKS>(simd, x, samples, &pixels);
            }
            // Those that no later one adds to.
            let next = split.trailing_zeros() as usize;
            first = first.max(x.saturating_sub(2 * self.margin));
            let last = pixels
                .end
                .min(x + 1)
                .min(next.saturating_sub(2 * self.margin))
                .max(first);
            self.keep::<S, BLOCKS>(simd, first..last, place);
            first = last;
        }
    }

    /// Puts the finished sums of some pixels into the memory of rows.
    #[inline(always)]
    fn keep<S: Simd, const BLOCKS: usize>(&mut self, simd: S, pixels: Range<usize>, place: usize) {
        let (first, last) = (pixels.start * BLOCKS, pixels.end * BLOCKS);
        let found = &mut self.halves[place * BLOCKS..][first..last];
        for (halves, sums) in found.iter_mut().zip(&self.sums[first..last]) {
            *halves = cut(simd, *sums);
        }
    }

    /// The sums of rows around pixels, of what pixels of one colour add to them: as much to each row. Where there are others, by their
    /// columns in what was painted, these are yet to be added.
    #[inline(always)]
    fn add_whole<S: Simd, const BLOCKS: usize>(&mut self, simd: S, pixels: Range<usize>, split: u128, place: usize) {
        let around = u128::MAX >> (u128::BITS as usize - (TOGETHER + 2 * self.margin));
        for start in pixels.clone().step_by(TOGETHER) {
            let mut sum = i32x16::splat(simd, 0);
            for (beside, weights) in &self.of_pixels {
                if let Some(numbers) = self.pairs[start + beside..].as_flattened().first_chunk::<AT_ONCE>() {
                    let weights = i16x32::block_splat(i16x8::simd_from(simd, *weights));
                    sum += i16x32::simd_from(simd, *numbers).pairwise_dot_product(weights);
                }
            }
            for (pixel, halves) in (start..).zip(cut_alike(simd, sum)) {
                if pixel < pixels.end {
                    self.halves[(place + pixel) * BLOCKS..][..BLOCKS].fill(halves);
                }
            }
            if split >> start & around == 0 {
                continue;
            }
            let sums = sum.to_array();
            let of_pixels = self.sums[start * BLOCKS..].chunks_exact_mut(BLOCKS);
            for (found, sum) in of_pixels.zip(sums.as_chunks().0) {
                found.fill(i32x16::block_splat(i32x4::simd_from(simd, *sum)).to_array());
            }
        }
    }

    /// Adds the rows of a split pixel in column `x` of what was painted to the sums of those of `pixels` around which it lies.
    #[inline(always)]
    fn add_split<S: Simd, const BLOCKS: usize>(
        &mut self,
        simd: S,
        x: usize,
        samples: &[Premultiplied16],
        pixels: &Range<usize>,
    ) {
        let touched = pixels.start.max(x.saturating_sub(2 * self.margin))..pixels.end.min(x + 1);
        for row in 0..BLOCKS {
            for column in 0..BLOCKS {
                let (left, right) = match samples.first_chunk() {
                    Some(all) if self.side == BLOCK => (columns(simd, all, 0), columns(simd, all, 2)),
                    _ => {
                        let part = part(samples, self.side, [row, column]);
                        (columns(simd, &part, 0), columns(simd, &part, 2))
                    }
                };
                // The last of these pixels has it nearest to its left end.
                let weights = self.columns[(x + 1 - touched.end) * BLOCKS..].chunks_exact(BLOCKS);
                let sums = self.sums[touched.start * BLOCKS..touched.end * BLOCKS].chunks_exact_mut(BLOCKS);
                for (sums, weights) in sums.rev().zip(weights) {
                    let [of_left, of_right] = weights[column];
                    let of_left = i16x32::block_splat(i16x8::simd_from(simd, of_left));
                    let of_right = i16x32::block_splat(i16x8::simd_from(simd, of_right));
                    let found = left.pairwise_dot_product(of_left) + right.pairwise_dot_product(of_right);
                    sums[row] = (i32x16::simd_from(simd, sums[row]) + found).to_array();
                }
            }
        }
    }

    /// Sums up the last rows around pixels side by side, and makes pixels of them.
    #[inline(always)]
    fn down<S: Simd, const BLOCKS: usize>(&self, simd: S, row: usize, pixels: Range<usize>, line: &mut [u32]) {
        let around = 2 * self.margin + 1;
        for start in pixels.clone().step_by(TOGETHER) {
            let mut sums = [i32x16::splat(simd, 0); TOGETHER];
            let mut at = row % around;
            for weights in self.rows.chunks_exact(BLOCKS) {
                let halves = &self.halves[(at * self.width + start) * BLOCKS..][..TOGETHER * BLOCKS];
                for (sum, halves) in sums.iter_mut().zip(halves.chunks_exact(BLOCKS)) {
                    for (halves, weights) in halves.iter().zip(weights) {
                        let weights = i16x32::simd_from(simd, *weights);
                        *sum += i16x32::simd_from(simd, *halves).pairwise_dot_product(weights);
                    }
                }
                at = if at + 1 == around { 0 } else { at + 1 };
            }
            let end = pixels.end.min(start + TOGETHER);
            self.mean.put(simd, sums, &mut line[start..end]);
        }
    }
}

/// What pixels side by side weigh, in pairs. Those that weigh more than fits are taken twice.
fn weights_of_pairs(of_pixels: &[i32]) -> Vec<(usize, [i16; 2 * BLOCK])> {
    let mut rest = of_pixels.to_vec();
    let mut all = Vec::new();
    while rest.iter().any(|weight| *weight != 0) {
        for (number, pair) in rest.chunks_mut(2).enumerate() {
            let mut taken = [0; 2];
            for (taken, weight) in taken.iter_mut().zip(pair) {
                let fits = (*weight).clamp(i16::MIN.into(), i16::MAX.into());
                *taken = i16::try_from(fits).unwrap_or(0);
                *weight -= fits;
            }
            if taken != [0; 2] {
                all.push((2 * number, repeated(taken)));
            }
        }
    }
    all
}

/// The weights of two columns, once for each channel.
fn repeated([left, right]: [i16; 2]) -> [i16; 2 * BLOCK] {
    [left, right, left, right, left, right, left, right]
}

/// The weights of four rows, in the order of [`DotSums::halves`].
fn halves_weights([a, b, c, d]: [i16; BLOCK]) -> [i16; AT_ONCE] {
    let mut weights = [0; AT_ONCE];
    for (found, pair) in weights.chunks_mut(2 * BLOCK).zip([[a, c], [b, d], [a, c], [b, d]]) {
        found.copy_from_slice(&repeated(pair));
    }
    weights
}

/// The sums of four rows, in halves.
#[inline(always)]
fn cut<S: Simd>(simd: S, sums: [i32; 4 * BLOCK]) -> [i16; AT_ONCE] {
    const LOW: u32 = 0xFFFF;
    let sums: u32x16<S> = i32x16::simd_from(simd, sums).bitcast();
    let (first, last) = sums.split();
    let low = ((first & u32x8::splat(simd, LOW)) | (last << 16)) ^ u32x8::splat(simd, 0x8000_8000);
    let high = (first >> 16) | (last & u32x8::splat(simd, !LOW));
    let halves: i16x32<S> = low.combine(high).bitcast();
    halves.to_array()
}

/// The sums of four rows in halves, for each of four pixels all of whose rows have the same sum.
#[inline(always)]
fn cut_alike<S: Simd>(simd: S, sums: i32x16<S>) -> [[i16; AT_ONCE]; TOGETHER] {
    const LOW: u32 = 0xFFFF;
    let sums: u32x16<S> = sums.bitcast();
    let low = ((sums & u32x16::splat(simd, LOW)) | (sums << 16)) ^ u32x16::splat(simd, 0x8000_8000);
    let high = (sums >> 16) | (sums & u32x16::splat(simd, !LOW));
    let ((a, b), (c, d)) = (low.split(), high.split());
    let ((a, b), (c, d)) = ((a.split(), b.split()), (c.split(), d.split()));
    [
        twice_each(a.0, c.0),
        twice_each(a.1, c.1),
        twice_each(b.0, d.0),
        twice_each(b.1, d.1),
    ]
}

/// Both halves of a pixel's sums, twice each.
#[inline(always)]
fn twice_each<S: Simd>(low: u32x4<S>, high: u32x4<S>) -> [i16; AT_ONCE] {
    let halves: i16x32<S> = low.combine(low).combine(high.combine(high)).bitcast();
    halves.to_array()
}

/// A column of a block and the next one, side by side, moved.
#[inline(always)]
fn columns<S: Simd>(simd: S, block: &[Premultiplied16; BLOCK * BLOCK], column: usize) -> i16x32<S> {
    let upper = pair(simd, block, column).combine(pair(simd, block, BLOCK + column));
    let lower = pair(simd, block, 2 * BLOCK + column).combine(pair(simd, block, 3 * BLOCK + column));
    let stored: u16x32<S> = upper.combine(lower).bitcast();
    (stored ^ u16x32::splat(simd, MOVED)).bitcast()
}

/// A sample of a block and the next one, channel by channel.
#[inline(always)]
fn pair<S: Simd>(simd: S, block: &[Premultiplied16; BLOCK * BLOCK], first: usize) -> i16x8<S> {
    beside(simd, [block[first].to_word(), block[first + 1].to_word()])
}

/// Two colours side by side, channel by channel.
#[inline(always)]
fn beside<S: Simd>(simd: S, words: [u64; 2]) -> i16x8<S> {
    let both: i16x8<S> = u64x2::simd_from(simd, words).bitcast();
    both.zip_low(both.slide::<4>(both))
}

/// A block of a pixel of `side x side` samples; beyond its last row and column what is nothing once it is moved.
#[inline(always)]
fn part(samples: &[Premultiplied16], side: usize, [row, column]: [usize; 2]) -> [Premultiplied16; BLOCK * BLOCK] {
    let mut block = [Premultiplied16([MOVED; 4]); BLOCK * BLOCK];
    let rows = samples.chunks_exact(side).skip(row * BLOCK);
    for (found, samples) in block.chunks_exact_mut(BLOCK).zip(rows) {
        for (found, sample) in found.iter_mut().zip(&samples[column * BLOCK..]) {
            *found = *sample;
        }
    }
    block
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::color::ResolveSpace;
    use crate::raster::paint::wide::random_tile::{SIZE, painted};
    use crate::raster::paint::wide::separable::SeparableSums;
    use crate::raster::random::any_filter;
    use crate::raster::resolve::{FilterRadius, ResolveFilter};
    use crate::raster::span::{Span, SpanRect};

    fn weights(filter: ResolveFilter, side: i32) -> AxisWeights {
        AxisWeights::new(filter.sized(None), side)
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
            let colors = painted(u, side * side, margin)?;
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
}
