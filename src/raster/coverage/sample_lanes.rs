//! The samples of a pixel side by side in vectors, and which of them lie on one side of an edge: sixteen at once.
//!
//! An edge function is `value + right * column + down * row` at the points of a pixel's lattice. Columns and rows fit 8 bits and
//! steps 31, so that each step is taken apart into `65536 * high + low`, where both parts fit 16 bits with a sign: of these a
//! machine multiplies and adds two for each sample in one instruction. The same is done with the value, and sums of high and of
//! low parts fit 32 bits. The whole is below zero where the high sum is, once the low one has carried over.

#![expect(
    clippy::inline_always,
    reason = "a function that is not inlined into its dispatch loses the vector instructions"
)]

use fearless_simd::prelude::*;
use fearless_simd::{Simd, i16x32, i32x16, mask32x16, u8x32, u32x16};

use crate::raster::sampling::positions::{Position, SamplePositions};
use crate::raster::span::Span;

/// The most samples that a pixel may have here: a bit for each.
const MOST: usize = 64;

/// Samples that are looked at together.
pub(super) const TOGETHER: usize = 16;

/// The pixels whose own positions are kept: all of a tile, or a row of as many.
const KEPT: usize = 1 << 11;

/// By how much rows of pixels are shifted among them: no tile is wider.
const ROW_BITS: u32 = 6;

/// The samples of one pixel after the other.
#[derive(Debug)]
pub(in crate::raster) struct SampleLanes {
    positions: SamplePositions,
    count: usize,
    /// The latest pixels, each with the places of its samples; none where all are the same.
    pixels: Vec<[i32; 2]>,
    /// The places of [`TOGETHER`] samples each, of as many as a pixel has and more: of each of those pixels, or of all.
    kept: Vec<[Position; TOGETHER]>,
    /// The first ones of the pixel at work.
    first: usize,
    /// Pixels whose places are to be found, as they are kept, and room for more; with the random bits that say so, and memory for
    /// what is found.
    missing: Vec<usize>,
    random: Vec<u64>,
    memory: Vec<Position>,
}

/// What an edge function gains from one point of a pixel's lattice to the next.
#[derive(Clone, Copy, Debug)]
pub(super) struct EdgeSteps {
    /// To the right and down.
    pub(super) right: i32,
    pub(super) down: i32,
    /// Their high and their low parts, each pair in a word: that to the right lower.
    high: u32,
    low: u32,
}

/// What an edge function gains from a pixel's first point to each of [`TOGETHER`] samples: `65536 * high + low`.
#[derive(Clone, Copy)]
pub(super) struct EdgeGains<S: Simd> {
    simd: S,
    high: i32x16<S>,
    low: i32x16<S>,
}

/// The places of [`TOGETHER`] samples: a column and a row of the lattice for each.
#[derive(Clone, Copy)]
pub(super) struct SampleBlock<S: Simd> {
    simd: S,
    places: i16x32<S>,
}

impl SampleLanes {
    /// For patterns of at most 64 samples.
    pub(super) fn new(positions: SamplePositions) -> Option<Self> {
        let count = positions.count();
        if count > MOST {
            return None;
        }
        let pixels = if positions.are_same() { 0 } else { KEPT };
        let mut lanes = Self {
            count,
            pixels: vec![[i32::MIN; 2]; pixels],
            kept: vec![[[0; 2]; TOGETHER]; pixels.max(1) * count.div_ceil(TOGETHER)],
            first: 0,
            missing: vec![0; pixels],
            random: Vec::new(),
            memory: Vec::new(),
            positions,
        };
        if lanes.positions.are_same() {
            let places = lanes.positions.of_pixel([0; 2], &mut lanes.memory);
            lanes.kept.as_flattened_mut()[..count].copy_from_slice(places);
        }
        Some(lanes)
    }

    /// The bits of all samples.
    pub(super) fn all(&self) -> u64 {
        u64::MAX >> (MOST - self.count)
    }

    /// Whether all pixels have their samples in the same places.
    pub(super) fn are_same(&self) -> bool {
        self.pixels.is_empty()
    }

    /// Goes to the pixel in this column and row of the frame.
    #[inline(always)]
    pub(super) fn go_to(&mut self, pixel: [i32; 2]) {
        if self.pixels.is_empty() {
            return;
        }
        let at = kept_at(pixel);
        if self.pixels[at] != pixel {
            let [x, y] = pixel;
            self.prepare(std::iter::once((Span { start: x, end: x + 1 }, y)));
        }
        self.first = at * self.count.div_ceil(TOGETHER);
    }

    /// Finds the places of the samples of pixels that are about to be gone to, columns of a row at a time: together they cost far less.
    pub(super) fn prepare(&mut self, runs: impl Iterator<Item = (Span, i32)>) {
        let Self {
            positions,
            count: samples,
            pixels: latest,
            kept,
            missing,
            random,
            memory,
            ..
        } = self;
        if latest.is_empty() {
            return;
        }
        let mut count = 0;
        'all: for (columns, y) in runs {
            for x in columns.start..columns.end {
                let (pixel, at) = ([x, y], kept_at([x, y]));
                // Noted first and counted where it is missing: shapes side by side share pixels, and a branch would be taken by chance.
                let Some(missing) = missing.get_mut(count) else {
                    // More would take the place of the first ones.
                    break 'all;
                };
                *missing = at;
                count += usize::from(latest[at] != pixel);
                latest[at] = pixel;
            }
        }
        let missing = &missing[..count];
        if missing.is_empty() {
            return;
        }
        memory.clear();
        positions.add(missing.iter().map(|at| latest[*at]), random, memory);
        let blocks = samples.div_ceil(TOGETHER);
        for (at, places) in missing.iter().zip(memory.chunks_exact(*samples)) {
            let kept = &mut kept[at * blocks..][..blocks];
            let (full, rest) = places.as_chunks();
            // Not as a slice, which would be a call.
            for (kept, full) in kept.iter_mut().zip(full) {
                *kept = *full;
            }
            if let Some(last) = kept.get_mut(full.len()) {
                last[..rest.len()].copy_from_slice(rest);
            }
        }
    }

    /// All samples, and maybe some beyond the last, each block with the number of its first sample.
    #[inline(always)]
    pub(super) fn blocks<S: Simd>(&self, simd: S) -> impl Iterator<Item = (usize, SampleBlock<S>)> {
        let blocks = self.kept[self.first..][..self.count.div_ceil(TOGETHER)].iter();
        let places = blocks.map(move |places| SampleBlock::new(simd, places));
        (0..).step_by(TOGETHER).zip(places)
    }
}

/// Which of those that are kept a pixel is.
#[inline(always)]
fn kept_at([x, y]: [i32; 2]) -> usize {
    x.wrapping_add(y << ROW_BITS).cast_unsigned() as usize % KEPT
}

impl EdgeSteps {
    /// Of an edge that gains so much one point to the right, and down: less than `2^31 - 2^15` each.
    #[inline(always)]
    pub(super) fn new(right: i32, down: i32) -> Self {
        let high = [right, down].map(|step| (step + (1 << 15)) >> 16);
        let low = [right - (high[0] << 16), down - (high[1] << 16)];
        let word = |[right, down]: [i32; 2]| right.cast_unsigned() & 0xFFFF | down.cast_unsigned() << 16;
        Self {
            right,
            down,
            high: word(high),
            low: word(low),
        }
    }
}

impl<S: Simd> SampleBlock<S> {
    #[inline(always)]
    fn new(simd: S, places: &[Position; TOGETHER]) -> Self {
        let (first, second) = u8x32::from_slice(simd, places.as_flattened()).widen();
        Self {
            simd,
            places: first.combine(second).bitcast(),
        }
    }

    /// What an edge function with these steps gains from the pixel's first point to each sample.
    #[inline(always)]
    pub(super) fn gains(self, steps: EdgeSteps) -> EdgeGains<S> {
        let both = |steps: u32| u32x16::splat(self.simd, steps).bitcast::<i16x32<S>>();
        EdgeGains {
            simd: self.simd,
            high: self.places.pairwise_dot_product(both(steps.high)),
            low: self.places.pairwise_dot_product(both(steps.low)),
        }
    }

    /// The rows of the lattice that the samples lie in.
    #[inline(always)]
    pub(super) fn rows(self) -> i32x16<S> {
        self.places.bitcast::<i32x16<S>>() >> 16
    }
}

impl<S: Simd> EdgeGains<S> {
    /// The samples at which the edge function is not below zero that has this value at the pixel's first point.
    #[inline(always)]
    #[expect(clippy::cast_possible_truncation, reason = "clamped, or sixteen bits")]
    pub(super) fn inside(self, value: i64) -> mask32x16<S> {
        // Beyond that it alone decides, whatever the steps add.
        const MOST: i64 = 1 << 30;
        let number = |part: i64| i32x16::splat(self.simd, part as i32);
        let high = self.high + number((value >> 16).clamp(-MOST, MOST));
        let low = self.low + number(value & 0xFFFF);
        (high + (low >> 16)).simd_ge(number(0))
    }
}

#[cfg(test)]
mod tests {
    use fearless_simd::dispatch;

    use super::*;
    use crate::raster::{SamplePattern, SampleRate};
    use crate::simd;

    /// The samples at which an edge function is not below zero, a bit for each, and the row of each of the first ones.
    #[inline(always)]
    fn found<S: Simd>(simd: S, lanes: &SampleLanes, value: i64, steps: EdgeSteps) -> (u64, Vec<i32>) {
        let (mut inside, mut rows) = (0, Vec::new());
        for (first, samples) in lanes.blocks(simd) {
            inside |= samples.gains(steps).inside(value).to_bitmask() << first;
            rows.extend(samples.rows().to_array());
        }
        rows.truncate(lanes.count);
        (inside & lanes.all(), rows)
    }

    #[test]
    fn sides_of_edges_are_those_of_integers_on_every_level() {
        arbtest::arbtest(|u| {
            let pattern = *u.choose(&SamplePattern::ALL)?;
            let rates: &[u32] = if pattern.needs_square() {
                &[1, 4, 9, 16, 64]
            } else {
                &[1, 3, 16, 33, 63]
            };
            let rate = SampleRate::new(*u.choose(rates)?).expect("a rate");
            let positions = SamplePositions::new(pattern, rate, crate::raster::Seed::default());
            let mut lanes = SampleLanes::new(positions.clone()).expect("few samples");
            for _ in 0..8 {
                let pixel = [u.int_in_range(0..=200)?, u.int_in_range(0..=200)?];
                let mut memory = Vec::new();
                let places = positions.of_pixel(pixel, &mut memory);
                let shift = u.int_in_range(1..=30)?;
                let mut step = || -> arbtest::arbitrary::Result<i32> { Ok(u.arbitrary::<i32>()? >> shift) };
                let (right, down) = (step()?, step()?);
                // Often exactly on the edge, and sometimes far from it.
                let [column, row] = u.choose(places)?.map(i64::from);
                let off = u.int_in_range(-1..=1)? << *u.choose(&[0, 0, 0, 20, 50])?;
                let value = -(i64::from(right) * column + i64::from(down) * row) + off;
                let at = |[column, row]: [i64; 2]| value + i64::from(right) * column + i64::from(down) * row;
                let is_inside = places.iter().map(|place| at(place.map(i64::from)) >= 0);
                let inside: u64 = (0..).zip(is_inside).map(|(sample, is)| u64::from(is) << sample).sum();
                let rows: Vec<i32> = places.iter().map(|[_, row]| i32::from(*row)).collect();
                if u.arbitrary()? {
                    // Some of them in its place.
                    let before = pixel[0] - u.int_in_range(0..=5)? * 1000;
                    let columns = Span {
                        start: before,
                        end: before + 2010,
                    };
                    lanes.prepare(std::iter::once((columns, pixel[1])));
                }
                lanes.go_to(pixel);
                let steps = EdgeSteps::new(right, down);
                for (name, level) in simd::tested() {
                    let found = dispatch!(level, simd => found(simd, &lanes, value, steps));
                    assert_eq!(
                        found,
                        (inside, Vec::clone(&rows)),
                        "{name}: {value} {steps:?} {places:?}"
                    );
                }
            }
            Ok(())
        })
        .budget_ms(500);
    }
}
