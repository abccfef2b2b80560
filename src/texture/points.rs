//! Filtering many samples at once: first their coordinates and weights, in vectors of samples; then their texels, in
//! vectors of channels. The same arithmetic as one by one in `cell`, number by number, whatever the vectors' width.

#![expect(
    clippy::inline_always,
    reason = "a function that is not inlined into its dispatch loses the vector instructions"
)]

use fearless_simd::prelude::*;
use fearless_simd::{Simd, dispatch, i16x8, i16x16, i32x4, i32x8, u8x16, u8x32, u16x8, u16x16, u32x4, u64x2, u64x4};

use glam::DVec2;

use super::PixelSampling;
use super::cell::{FRACTION_BITS, SUM_SHIFT, TO_FIXED};
use super::filter::{Axis, GridLevel, Plan};
use crate::color::Premultiplied16;
use crate::simd::Level;

/// Samples that are prepared together; their offsets and weights stay in the nearest cache.
const BLOCK: usize = 32;
/// The most lanes of 32 bits that a vector has.
pub(super) const MAX_LANES: usize = 16;
/// The second factor of a pair that rounds a product to nearest before its fraction is cut off; its partner is 1.
const ROUND: i32 = 1 << (FRACTION_BITS - 1 + 16);

/// Where the samples of a block read one level.
struct Cells {
    /// The first of the four texels around each sample.
    offsets: [u32; BLOCK],
    /// Their weights, 16 bits each from the lowest: upper left, lower left, upper right, lower right.
    weights: [u64; BLOCK],
}

/// Positions of samples relative to the pivot, in samples; the first and the second half of the lanes.
pub(super) struct Positions<S: Simd> {
    columns: [S::f64s; 2],
    rows: [S::f64s; 2],
}

/// The texels of a level and where to read them.
#[derive(Clone, Copy)]
struct Source<'a> {
    /// The texels from the first one on, and from the second row on; equally many.
    upper: &'a [[u8; 4]],
    lower: &'a [[u8; 4]],
    cells: &'a Cells,
}

/// See [`super::Filter::points`].
pub(super) fn filter(level: Level, plan: &Plan<'_>, points: &[[u16; 2]], out: &mut [Premultiplied16]) {
    dispatch!(level, simd => filter_with(simd, plan, points, out));
}

/// See [`super::Filter::pixels`].
pub(super) fn filter_pixels(level: Level, plan: &Plan<'_>, points: &[[u16; 2]], out: &mut [u32]) {
    dispatch!(level, simd => filter_pixels_with(simd, plan, points, out));
}

#[inline(always)]
pub(super) fn filter_with<S: Simd>(simd: S, plan: &Plan<'_>, points: &[[u16; 2]], out: &mut [Premultiplied16]) {
    let mut cells = [Cells::EMPTY; 2];
    for (points, out) in points.chunks(BLOCK).zip(out.chunks_mut(BLOCK)) {
        filter_block(simd, plan, points, &mut cells, out);
    }
}

#[inline(always)]
fn filter_pixels_with<S: Simd>(simd: S, plan: &Plan<'_>, points: &[[u16; 2]], out: &mut [u32]) {
    let mut cells = [Cells::EMPTY; 2];
    let mut colors = [Premultiplied16::TRANSPARENT; BLOCK];
    for (points, out) in points.chunks(BLOCK).zip(out.chunks_mut(BLOCK)) {
        let colors = &mut colors[..points.len().next_multiple_of(4)];
        filter_block(simd, plan, points, &mut cells, colors);
        for (colors, out) in colors.chunks_exact(4).zip(out.chunks_mut(4)) {
            let pixels = opaque_pixels(simd, colors).to_array();
            out.copy_from_slice(&pixels[..out.len()]);
        }
    }
}

/// Colours at up to [`BLOCK`] samples.
#[inline(always)]
fn filter_block<S: Simd>(
    simd: S,
    plan: &Plan<'_>,
    points: &[[u16; 2]],
    cells: &mut [Cells; 2],
    out: &mut [Premultiplied16],
) {
    let [finer, coarser] = cells;
    let lanes = S::u32s::LEN;
    for (i, points) in points.chunks(lanes).enumerate() {
        let at = Positions::new(simd, columns_and_rows(simd, points), plan.first);
        finer.prepare(simd, plan.pixel, &plan.finer, (&at, i * lanes));
        if let Some(level) = &plan.coarser {
            coarser.prepare(simd, plan.pixel, level, (&at, i * lanes));
        }
    }
    let finer = Source::new(&plan.finer, finer);
    let coarser = plan.coarser.as_ref().map(|level| Source::new(level, coarser));
    match (plan.pixel, coarser) {
        (PixelSampling::Nearest, None) => {
            for (i, color) in out.iter_mut().enumerate() {
                *color = Premultiplied16::from_bytes(finer.texel(i));
            }
        }
        (PixelSampling::Nearest, Some(coarser)) => {
            let masses = plan.coarser.map_or(0, |level| level.mass) << 16 | plan.finer.mass;
            for (i, out) in out.chunks_mut(2).enumerate() {
                let first = mixed(simd, finer.texel(2 * i), coarser.texel(2 * i), masses);
                let second = mixed(simd, finer.texel(2 * i + 1), coarser.texel(2 * i + 1), masses);
                store(first, second, out);
            }
        }
        (PixelSampling::Bilinear, None) => {
            for (i, out) in out.chunks_mut(2).enumerate() {
                let (first, second) = (finer.bilinear(simd, 2 * i), finer.bilinear(simd, 2 * i + 1));
                store(both_columns(first), both_columns(second), out);
            }
        }
        (PixelSampling::Bilinear, Some(coarser)) => {
            for (i, out) in out.chunks_mut(2).enumerate() {
                let first = finer.bilinear(simd, 2 * i) + coarser.bilinear(simd, 2 * i);
                let second = finer.bilinear(simd, 2 * i + 1) + coarser.bilinear(simd, 2 * i + 1);
                store(both_columns(first), both_columns(second), out);
            }
        }
    }
}

/// Sample or pixel columns and rows as floats, of at most as many as a vector has lanes.
#[inline(always)]
pub(super) fn columns_and_rows<S: Simd>(simd: S, points: &[[u16; 2]]) -> [S::f32s; 2] {
    let lanes = S::u32s::LEN;
    let both: S::u32s = if points.len() == lanes {
        S::u16s::from_slice(simd, points.as_flattened()).bitcast()
    } else {
        let mut padded = [[0; 2]; MAX_LANES];
        padded[..points.len()].copy_from_slice(points);
        S::u16s::from_slice(simd, padded[..lanes].as_flattened()).bitcast()
    };
    let column: S::i32s = (both & S::u32s::splat(simd, 0xFFFF)).bitcast();
    let row: S::i32s = (both >> 16).bitcast();
    [S::f32s::float_from(column), S::f32s::float_from(row)]
}

impl<S: Simd> Positions<S> {
    /// Of samples counted from one at `first`. All numbers are exact: whole ones below `2^20` and multiples of `2^-20`.
    #[inline(always)]
    pub(super) fn new(simd: S, [columns, rows]: [S::f32s; 2], first: DVec2) -> Self {
        let (columns, rows) = (columns.widen(), rows.widen());
        let (left, top) = (S::f64s::splat(simd, first.x), S::f64s::splat(simd, first.y));
        Self {
            columns: [columns.0 + left, columns.1 + left],
            rows: [rows.0 + top, rows.1 + top],
        }
    }

    /// Where samples lie on an axis, inside the level, in fixed point; see `cell::to_fixed`.
    #[inline(always)]
    fn fixed(&self, simd: S, axis: &Axis) -> S::i32s {
        self.round(simd, axis, (0.0, axis.last), TO_FIXED)
    }

    /// Where samples lie on an axis, at most two texels outside the level, with `bits` fractional bits.
    #[inline(always)]
    pub(super) fn near(&self, simd: S, axis: &Axis, bits: u32) -> S::i32s {
        // One half more than in `cell`, so that negative numbers stand below it in two's complement.
        let to_fixed = 1.5 * (1_u64 << (52 - bits)) as f64;
        self.round(simd, axis, (-2.0, axis.last + 2.0), to_fixed)
    }

    #[inline(always)]
    fn round(&self, simd: S, axis: &Axis, limits: (f64, f64), to_fixed: f64) -> S::i32s {
        let half = self.round_half(simd, axis, limits, (0, to_fixed));
        half.narrow(self.round_half(simd, axis, limits, (1, to_fixed)))
    }

    #[inline(always)]
    fn round_half(&self, simd: S, axis: &Axis, (least, most): (f64, f64), (half, to_fixed): (usize, f64)) -> S::i64s {
        let right = self.columns[half] * S::f64s::splat(simd, axis.right);
        let down = self.rows[half] * S::f64s::splat(simd, axis.down);
        let at = (S::f64s::splat(simd, axis.at_pivot) + right) + down;
        let inside = at.max(S::f64s::splat(simd, least)).min(S::f64s::splat(simd, most));
        (inside + S::f64s::splat(simd, to_fixed)).bitcast()
    }
}

impl Cells {
    const EMPTY: Self = Self {
        offsets: [0; BLOCK],
        weights: [0; BLOCK],
    };

    /// Notes the cells of a vector of samples from number `first` on.
    #[inline(always)]
    fn prepare<S: Simd>(
        &mut self,
        simd: S,
        pixel: PixelSampling,
        level: &GridLevel<'_>,
        (at, first): (&Positions<S>, usize),
    ) {
        let lanes = S::u32s::LEN;
        let number = |value| S::i32s::splat(simd, value);
        let (x, y) = (at.fixed(simd, &level.x), at.fixed(simd, &level.y));
        let stride = number(level.level.stride().cast_signed());
        let offsets = (y >> FRACTION_BITS) * stride + (x >> FRACTION_BITS);
        let offsets: S::u32s = offsets.bitcast();
        offsets.store_slice(&mut self.offsets[first..first + lanes]);
        if pixel == PixelSampling::Nearest {
            return;
        }
        let fraction = number((1 << FRACTION_BITS) - 1);
        let share = |weight: S::i32s, part: S::i16s| {
            let product: S::i32s = (weight | number(1 << 16))
                .bitcast::<S::i16s>()
                .pairwise_dot_product(part);
            product >> FRACTION_BITS
        };
        let (x, y) = (
            (x & fraction | number(ROUND)).bitcast(),
            (y & fraction | number(ROUND)).bitcast(),
        );
        let lower = share(number(level.mass), y);
        let upper = number(level.mass) - lower;
        // No part of a difference is negative, so that nothing is borrowed from the upper half.
        let right = share(upper, x) | share(lower, x) << 16;
        let left = (upper | lower << 16) - right;
        store_columns::<S>(left, right, &mut self.weights[first..first + lanes]);
    }
}

impl<'a> Source<'a> {
    #[inline(always)]
    fn new(level: &GridLevel<'a>, cells: &'a Cells) -> Self {
        let (texels, stride) = (level.level.texels(), level.level.stride() as usize);
        let count = texels.len() - stride;
        Self {
            upper: &texels[..count],
            lower: &texels[stride..][..count],
            cells,
        }
    }

    /// The first texel of sample `i`.
    #[inline(always)]
    fn texel(&self, i: usize) -> [u8; 4] {
        self.upper[self.cells.offsets[i % BLOCK] as usize]
    }

    /// Red, green, blue and alpha of sample `i` in the units of the weights: the left column's sums, then the right's.
    #[inline(always)]
    fn bilinear<S: Simd>(&self, simd: S, i: usize) -> i32x8<S> {
        let at = self.cells.offsets[i % BLOCK] as usize;
        let upper: u8x16<S> = u64x2::simd_from(simd, [row(self.upper, at), 0]).bitcast();
        let lower: u8x16<S> = u64x2::simd_from(simd, [row(self.lower, at), 0]).bitcast();
        columns(simd, upper.zip_low(lower), self.cells.weights[i % BLOCK])
    }
}

/// Writes the weights of 2 x 2 texels for a vector of samples as [`columns`] takes them; in the lower 16 bits of `left`
/// and `right` the upper texels' ones.
#[inline(always)]
pub(super) fn store_columns<S: Simd>(left: S::i32s, right: S::i32s, out: &mut [u64]) {
    let (low, high) = out[..S::u32s::LEN].split_at_mut(S::u32s::LEN / 2);
    left.zip_low(right).bitcast::<S::u64s>().store_slice(low);
    left.zip_high(right).bitcast::<S::u64s>().store_slice(high);
}

/// Two columns of two texels with their weights: red, green, blue and alpha of the left column, then of the right one.
///
/// `texels` holds the left column's upper and lower red, upper and lower green and so on, then the right column's;
/// `weights` 16 bits each from the lowest: upper left, lower left, upper right, lower right.
#[inline(always)]
pub(super) fn columns<S: Simd>(simd: S, texels: u8x16<S>, weights: u64) -> i32x8<S> {
    /// Each half of a 64-bit number four times, first the lower one.
    const SPREAD: [u8; 32] = [
        0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3, 4, 5, 6, 7, 4, 5, 6, 7, 4, 5, 6, 7, 4, 5, 6, 7,
    ];
    let (left, right) = texels.widen();
    let channels: i16x16<S> = left.combine(right).bitcast();
    let weights: u8x32<S> = u64x4::splat(simd, weights).bitcast();
    let weights: i16x16<S> = weights
        .swizzle_dyn_within_blocks(u8x32::simd_from(simd, SPREAD))
        .bitcast();
    channels.pairwise_dot_product(weights)
}

/// Two neighbouring texels as one number.
#[inline(always)]
fn row(texels: &[[u8; 4]], at: usize) -> u64 {
    let mut bytes = [0; 8];
    bytes.copy_from_slice(texels[at..at + 2].as_flattened());
    u64::from_le_bytes(bytes)
}

/// The sums of a sample's left and right column.
#[inline(always)]
fn both_columns<S: Simd>(sums: i32x8<S>) -> i32x4<S> {
    let (left, right) = sums.split();
    left + right
}

/// Two texels with the weights in the two halves of `masses`, in their units.
#[inline(always)]
fn mixed<S: Simd>(simd: S, finer: [u8; 4], coarser: [u8; 4], masses: i32) -> i32x4<S> {
    let word = |texel| -> u8x16<S> { u32x4::simd_from(simd, [u32::from_le_bytes(texel), 0, 0, 0]).bitcast() };
    let (channels, _) = word(finer).zip_low(word(coarser)).widen();
    let channels: i16x8<S> = channels.bitcast();
    let weights: i16x8<S> = i32x4::splat(simd, masses).bitcast();
    channels.pairwise_dot_product(weights)
}

/// Rounds the sums of two samples to the bits that are stored; see `cell::to_channel`.
#[inline(always)]
fn store<S: Simd>(first: i32x4<S>, second: i32x4<S>, out: &mut [Premultiplied16]) {
    let half = 1 << (SUM_SHIFT - 1);
    let first: u32x4<S> = ((first + half) >> SUM_SHIFT).bitcast();
    let second: u32x4<S> = ((second + half) >> SUM_SHIFT).bitcast();
    let channels = first.relaxed_narrow(second).to_array();
    for (color, channels) in out.iter_mut().zip(channels.as_chunks().0) {
        *color = Premultiplied16(*channels);
    }
}

/// Four opaque colours as pixels; see [`Premultiplied16::to_pixel`].
#[inline(always)]
fn opaque_pixels<S: Simd>(simd: S, colors: &[Premultiplied16]) -> u32x4<S> {
    /// From red, green, blue, alpha to the bytes of `0xAARRGGBB` from the lowest.
    const ORDER: [u8; 16] = [2, 1, 0, 3, 6, 5, 4, 7, 10, 9, 8, 11, 14, 13, 12, 15];
    let mut channels = [0; 16];
    for (channels, color) in channels.as_chunks_mut().0.iter_mut().zip(colors) {
        *channels = color.0;
    }
    let (first, second) = u16x16::simd_from(simd, channels).split();
    let byte = |channels: u16x8<S>| (channels + Premultiplied16::PER_BYTE / 2) >> 8;
    let bytes = byte(first).relaxed_narrow(byte(second));
    bytes.swizzle_dyn_within_blocks(u8x16::simd_from(simd, ORDER)).bitcast()
}

#[cfg(test)]
mod tests {
    use std::time::Instant;

    use arbtest::arbitrary;

    use super::super::{Filter, LevelSampling, MipLevel, MipPyramid, SampleGrid, UvMap, oracle};
    use super::*;
    use crate::rules::Rules;
    use crate::simd;

    #[test]
    fn points_are_what_single_samples_are_on_every_level() {
        arbtest::arbtest(|u| {
            let pyramid = oracle::pyramid(u)?;
            let map = oracle::map(u, &pyramid.levels()[0])?;
            let grid = oracle::grid(u, &map)?;
            let filter = oracle::filter(u, &pyramid, &map)?;
            let count = u.int_in_range(0..=100)?;
            let mut point = || Ok([u.int_in_range(0..=1100)?, u.int_in_range(0..=1100)?]);
            let points = (0..count)
                .map(|_| point())
                .collect::<arbitrary::Result<Vec<[u16; 2]>>>()?;
            let plan = filter.plan(grid);
            let expected: Vec<_> = points
                .iter()
                .map(|at| oracle::point(&plan, at.map(u32::from)))
                .collect();
            for (name, level) in simd::tested() {
                let mut found = vec![Premultiplied16::TRANSPARENT; count];
                filter.points(level, grid, &points, &mut found);
                assert_eq!(found, expected, "{name}: {filter:?} {grid:?}");
            }
            Ok(())
        })
        .budget_ms(1000);
    }

    #[test]
    fn pixels_are_those_of_opaque_points() {
        arbtest::arbtest(|u| {
            let texels = (0..31 * 5)
                .map(|i: u32| [i.to_le_bytes()[0], u.arbitrary().unwrap_or(0), 7, 255])
                .collect();
            let pyramid = MipPyramid::build(MipLevel::new(31, 5, texels));
            let map = oracle::map(u, &pyramid.levels()[0])?;
            let grid = oracle::grid(u, &map)?;
            let filter = oracle::filter(u, &pyramid, &map)?;
            let count = u.int_in_range(0..=70)?;
            let points: Vec<[u16; 2]> = (0..count).map(|i| [i * 13 % 64, i * 5 % 64]).collect();
            let plan = filter.plan(grid);
            let color = |at: &[u16; 2]| oracle::point(&plan, at.map(u32::from)).to_pixel(Rules::Standard);
            let expected: Vec<_> = points.iter().map(color).collect();
            for (name, level) in simd::tested() {
                let mut found = vec![0; points.len()];
                filter.pixels(level, grid, &points, &mut found);
                assert_eq!(found, expected, "{name}: {filter:?} {grid:?}");
            }
            Ok(())
        })
        .budget_ms(400);
    }

    #[test]
    fn points_are_within_a_tenth_of_a_byte_of_the_definition() {
        let mut worst = 0.0_f64;
        arbtest::arbtest(|u| {
            let pyramid = oracle::pyramid(u)?;
            let map = oracle::map(u, &pyramid.levels()[0])?;
            let grid = oracle::grid(u, &map)?;
            let level = *u.choose(&LevelSampling::ALL)?;
            let filter = Filter::new(&pyramid, &map, PixelSampling::Bilinear, level);
            let plan = filter.plan(grid);
            for _ in 0..100 {
                let at = [u.int_in_range(0..=1100)?, u.int_in_range(0..=1100)?];
                let (found, exact) = (oracle::point(&plan, at), oracle::exact_point(&plan, at));
                for (found, exact) in found.0.iter().zip(exact) {
                    let error = (f64::from(*found) / 256.0 - exact).abs();
                    worst = worst.max(error);
                    assert!(error < 0.1, "{found} / 256 is not {exact}: {filter:?} {grid:?} {at:?}");
                }
            }
            Ok(())
        })
        .budget_ms(600);
        assert!(worst > 0.0, "something was compared");
    }

    #[test]
    fn points_move_with_their_triangle_by_whole_pixels() {
        arbtest::arbtest(|u| {
            let pyramid = oracle::pyramid(u)?;
            let mut map = oracle::map(u, &pyramid.levels()[0])?;
            let mut grid = oracle::grid(u, &map)?;
            // A corner as the sub-pixel grid has it.
            let units = f64::from(grid.side * 1024);
            map.pivot = (map.pivot * units).round() / units;
            let settings = (*u.choose(&PixelSampling::ALL)?, *u.choose(&LevelSampling::ALL)?);
            let points: Vec<[u16; 2]> = (0..64).map(|i| [i * 7 % 64, i]).collect();
            let colors = |map: &UvMap, grid: SampleGrid| {
                let mut colors = [Premultiplied16::TRANSPARENT; 64];
                Filter::new(&pyramid, map, settings.0, settings.1).points(simd::level(), grid, &points, &mut colors);
                colors
            };
            let here = colors(&map, grid);
            let by = [u.int_in_range(-9000..=9000)?, u.int_in_range(-9000..=9000)?];
            let x = (map.pivot.x * units).round() + f64::from(by[0]) * units;
            let y = (map.pivot.y * units).round() + f64::from(by[1]) * units;
            map.pivot = DVec2::new(x, y) / units;
            grid.origin = [grid.origin[0] + by[0], grid.origin[1] + by[1]];
            assert_eq!(colors(&map, grid), here, "moved by {by:?}: {map:?}");
            Ok(())
        })
        .budget_ms(300);
    }

    /// `cargo test --release -- --ignored --nocapture speed_of_points`
    #[test]
    #[ignore = "a measurement"]
    fn speed_of_points() {
        let size = 1024;
        let texels = (0..size * size)
            .map(|i: u32| i.wrapping_mul(0x9E37_79B1).to_le_bytes())
            .collect();
        let pyramid = MipPyramid::build(MipLevel::new(size, size, texels));
        let points: Vec<[u16; 2]> = (0..64 * 64).map(|i| [i % 64, i / 64]).collect();
        let cycle = oracle::cycle();
        for (turn, name) in [(0.0, "upright"), (0.6, "turned")] {
            let turn = DVec2::from_angle(turn) * 1.3 / f64::from(size);
            let map = UvMap {
                pivot: DVec2::new(-500.0, -500.0),
                uv: DVec2::ZERO,
                dx: turn,
                dy: turn.perp(),
            };
            for pixel in PixelSampling::ALL {
                for sampling in [LevelSampling::Zero, LevelSampling::Linear] {
                    let filter = Filter::new(&pyramid, &map, pixel, sampling);
                    for (level_name, level) in simd::tested() {
                        let grid = SampleGrid {
                            side: 1,
                            origin: [0, 0],
                        };
                        let mut out = vec![Premultiplied16::TRANSPARENT; points.len()];
                        let mut pixels = vec![0; points.len()];
                        let mut best = [f64::MAX; 2];
                        for _ in 0..200 {
                            let start = Instant::now();
                            filter.points(level, grid, &points, &mut out);
                            best[0] = best[0].min(start.elapsed().as_secs_f64());
                            let start = Instant::now();
                            filter.pixels(level, grid, &points, &mut pixels);
                            best[1] = best[1].min(start.elapsed().as_secs_f64());
                        }
                        let [colors, pixels] = best.map(|best| best / points.len() as f64 / cycle);
                        eprintln!(
                            "{name:8} {:8} {:6} {level_name:8} points {colors:6.2} pixels {pixels:6.2} cycles",
                            pixel.name(),
                            sampling.name()
                        );
                    }
                }
            }
        }
    }
}
