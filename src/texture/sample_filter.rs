//! Filtering many samples at once: first their coordinates and weights, in vectors of samples; then their texels, in
//! vectors of channels. The same arithmetic as one by one in `bilinear`, number by number, whatever the vectors' width.

#![expect(
    clippy::inline_always,
    reason = "a function that is not inlined into its dispatch loses the vector instructions"
)]

use fearless_simd::prelude::*;
use fearless_simd::{Simd, i16x16, i32x8, u8x16, u16x8, u32x4, u64x2};

use super::PixelSampling;
use super::filter_plan::{GridLevel, Plan};
use super::fixed_point::FRACTION_BITS;
use super::simd_channels::{FromColors, Spread, both_columns, in_columns, round, widen};
use super::texel_coordinates::{Positions, columns_and_rows};

/// Samples that are prepared together; few, so that short lists do not pay for clearing memory.
pub(super) const BLOCK: usize = 16;
/// The second factor of a pair that rounds a product to nearest before its fraction is cut off; its partner is 1.
const ROUND: i32 = 1 << (FRACTION_BITS - 1 + 16);

/// Where the samples of a block read one level.
pub(super) struct Cells {
    /// The first of the four texels around each sample.
    offsets: [u32; BLOCK],
    /// Their weights, as [`Spread::columns`] takes them.
    weights: [u64; BLOCK],
}

/// Where a vector of samples lies in a level, inside it and in fixed point.
#[derive(Clone, Copy)]
pub(super) struct SampleVector<S: Simd> {
    pub(super) at: [S::i32s; 2],
    /// The number of its first sample in the block.
    pub(super) first: usize,
}

/// The texels of a level and where to read them.
#[derive(Clone, Copy)]
pub(super) struct Source<'a> {
    rows: RowPairs<'a>,
    cells: &'a Cells,
    mass: i32,
}

/// The texels of a level from the first one on, and from the second row on; equally many.
#[derive(Clone, Copy)]
pub(super) struct RowPairs<'a> {
    upper: &'a [[u8; 4]],
    lower: &'a [[u8; 4]],
}

/// Filters samples of one tap each, which read the nearest texel or the four around them.
#[inline(always)]
pub(super) fn filter_with<S: Simd, C: FromColors>(simd: S, plan: &Plan<'_>, points: &[[u16; 2]], out: &mut [C]) {
    let mut cells = [Cells::EMPTY; 2];
    let spread = Spread::new(simd);
    for (points, out) in points.chunks(BLOCK).zip(out.chunks_mut(BLOCK)) {
        prepare(simd, plan, points, &mut cells);
        weigh(simd, spread, plan, &cells, out);
    }
}

/// The colours of up to [`BLOCK`] samples that read the levels there.
#[inline(always)]
pub(super) fn weigh<S: Simd, C: FromColors>(
    simd: S,
    spread: Spread<S>,
    plan: &Plan<'_>,
    [finer, coarser]: &[Cells; 2],
    out: &mut [C],
) {
    let finer = Source::new(&plan.finer, finer);
    let coarser = plan.coarser.as_ref().map(|level| Source::new(level, coarser));
    match (plan.pixel, coarser) {
        (PixelSampling::Nearest, None) => nearest(simd, finer, out),
        (PixelSampling::Nearest, Some(coarser)) => nearest_mixed(simd, finer, coarser, out),
        (_, None) => bilinear(simd, spread, finer, out),
        (_, Some(coarser)) => trilinear(simd, spread, [finer, coarser], out),
    }
}

/// Notes where up to [`BLOCK`] samples read the levels.
#[inline(always)]
fn prepare<S: Simd>(simd: S, plan: &Plan<'_>, points: &[[u16; 2]], [finer, coarser]: &mut [Cells; 2]) {
    let lanes = S::u32s::LEN;
    let last = points.len().saturating_sub(lanes);
    for first in (0..points.len()).step_by(lanes) {
        // The last vector begins earlier rather than to be short.
        let first = first.min(last);
        let at = Positions::new(simd, columns_and_rows(simd, &points[first..]), plan.first);
        finer.note(
            simd,
            plan.pixel,
            &plan.finer,
            SampleVector::new(simd, &at, &plan.finer, first),
        );
        if let Some(level) = &plan.coarser {
            coarser.note(simd, plan.pixel, level, SampleVector::new(simd, &at, level, first));
        }
    }
}

/// Calls `$colors` for the numbers of each four samples and writes what becomes of them; it is no function, because a
/// closure would not be inlined.
macro_rules! by_fours {
    ($simd:expr, $out:expr, |$i:ident| $colors:expr) => {{
        let (fours, rest) = $out.as_chunks_mut::<4>();
        let mut $i = 0;
        for four in fours {
            *four = C::four($simd, $colors);
            $i += 4;
        }
        if !rest.is_empty() {
            for (out, color) in rest.iter_mut().zip(C::four($simd, $colors)) {
                *out = color;
            }
        }
    }};
}
pub(super) use by_fours;

#[inline(always)]
fn nearest<S: Simd, C: FromColors>(simd: S, texels: Source<'_>, out: &mut [C]) {
    by_fours!(simd, out, |i| {
        let bytes = texels.four(simd, i);
        let zero = u8x16::splat(simd, 0);
        let (low, high) = (zero.zip_low(bytes), zero.zip_high(bytes));
        low.bitcast::<u16x8<S>>().combine(high.bitcast::<u16x8<S>>())
    });
}

#[inline(always)]
fn nearest_mixed<S: Simd, C: FromColors>(simd: S, finer: Source<'_>, coarser: Source<'_>, out: &mut [C]) {
    let masses: i16x16<S> = i32x8::splat(simd, coarser.mass << 16 | finer.mass).bitcast();
    by_fours!(simd, out, |i| {
        let (fine, coarse) = (finer.four(simd, i), coarser.four(simd, i));
        let low: i16x16<S> = widen(fine.zip_low(coarse));
        let high: i16x16<S> = widen(fine.zip_high(coarse));
        round(
            simd,
            low.pairwise_dot_product(masses),
            high.pairwise_dot_product(masses),
        )
    });
}

#[inline(always)]
fn bilinear<S: Simd, C: FromColors>(simd: S, spread: Spread<S>, texels: Source<'_>, out: &mut [C]) {
    by_fours!(simd, out, |i| {
        let low = both_columns(texels.bilinear(simd, spread, i), texels.bilinear(simd, spread, i + 1));
        let high = both_columns(
            texels.bilinear(simd, spread, i + 2),
            texels.bilinear(simd, spread, i + 3),
        );
        round(simd, low, high)
    });
}

#[inline(always)]
fn trilinear<S: Simd, C: FromColors>(simd: S, spread: Spread<S>, [finer, coarser]: [Source<'_>; 2], out: &mut [C]) {
    by_fours!(simd, out, |i| {
        let first = finer.bilinear(simd, spread, i) + coarser.bilinear(simd, spread, i);
        let second = finer.bilinear(simd, spread, i + 1) + coarser.bilinear(simd, spread, i + 1);
        let third = finer.bilinear(simd, spread, i + 2) + coarser.bilinear(simd, spread, i + 2);
        let fourth = finer.bilinear(simd, spread, i + 3) + coarser.bilinear(simd, spread, i + 3);
        round(simd, both_columns(first, second), both_columns(third, fourth))
    });
}

impl<S: Simd> SampleVector<S> {
    #[inline(always)]
    fn new(simd: S, at: &Positions<S>, level: &GridLevel<'_>, first: usize) -> Self {
        Self {
            at: [at.fixed(simd, &level.x), at.fixed(simd, &level.y)],
            first,
        }
    }
}

impl Cells {
    pub(super) const EMPTY: Self = Self {
        offsets: [0; BLOCK],
        weights: [0; BLOCK],
    };

    /// Notes the cells of a vector of samples.
    #[inline(always)]
    pub(super) fn note<S: Simd>(
        &mut self,
        simd: S,
        pixel: PixelSampling,
        level: &GridLevel<'_>,
        vector: SampleVector<S>,
    ) {
        let SampleVector { at: [x, y], first } = vector;
        let lanes = S::u32s::LEN;
        let number = |value| S::i32s::splat(simd, value);
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
        let (low, high) = self.weights[first..first + lanes].split_at_mut(lanes / 2);
        let weights = in_columns::<S>(left, right);
        weights[0].store_slice(low);
        weights[1].store_slice(high);
    }
}

impl<'a> Source<'a> {
    #[inline(always)]
    pub(super) fn new(level: &GridLevel<'a>, cells: &'a Cells) -> Self {
        Self {
            rows: RowPairs::new(level),
            cells,
            mass: level.mass,
        }
    }

    /// The first texels of four samples.
    #[inline(always)]
    fn four<S: Simd>(&self, simd: S, i: usize) -> u8x16<S> {
        let texel = |i: usize| u32::from_le_bytes(self.rows.upper[self.cells.offsets[i % BLOCK] as usize]);
        u32x4::simd_from(simd, [texel(i), texel(i + 1), texel(i + 2), texel(i + 3)]).bitcast()
    }

    /// Red, green, blue and alpha of sample `i` in the units of the weights: the left column's sums, then the right's.
    #[inline(always)]
    pub(super) fn bilinear<S: Simd>(&self, simd: S, spread: Spread<S>, i: usize) -> i32x8<S> {
        let i = i % BLOCK;
        self.rows
            .columns(simd, spread, self.cells.offsets[i], self.cells.weights[i])
    }
}

impl<'a> RowPairs<'a> {
    #[inline(always)]
    pub(super) fn new(level: &GridLevel<'a>) -> Self {
        let (texels, stride) = (level.level.texels(), level.level.stride() as usize);
        let count = texels.len() - stride;
        Self {
            upper: &texels[..count],
            lower: &texels[stride..][..count],
        }
    }

    /// The 2 x 2 texels from number `first` on with their weights, as [`Spread::columns`] has them.
    #[inline(always)]
    pub(super) fn columns<S: Simd>(&self, simd: S, spread: Spread<S>, first: u32, weights: u64) -> i32x8<S> {
        let at = first as usize;
        let upper: u8x16<S> = u64x2::simd_from(simd, [row(self.upper, at), 0]).bitcast();
        let lower: u8x16<S> = u64x2::simd_from(simd, [row(self.lower, at), 0]).bitcast();
        spread.columns(simd, upper.zip_low(lower), weights)
    }
}

/// Two neighbouring texels as one number.
#[inline(always)]
fn row(texels: &[[u8; 4]], at: usize) -> u64 {
    let mut bytes = [0; 8];
    bytes.copy_from_slice(texels[at..at + 2].as_flattened());
    u64::from_le_bytes(bytes)
}

#[cfg(test)]
mod tests {
    use arbtest::arbitrary;
    use glam::DVec2;

    use super::super::{Filter, MipLevel, MipPyramid, SampleGrid, SamplingSettings, UvMap, oracle};
    use super::*;
    use crate::color::Premultiplied16;
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
    fn points_are_within_a_part_of_a_byte_of_the_definition() {
        let mut worst = 0.0_f64;
        arbtest::arbtest(|u| {
            let pyramid = oracle::pyramid(u)?;
            let map = oracle::map(u, &pyramid.levels()[0])?;
            let grid = oracle::grid(u, &map)?;
            let settings = SamplingSettings {
                pixel: *u.choose(&PixelSampling::ALL[1..])?,
                ..oracle::settings(u)?
            };
            // Of sixteen weights that are rounded, more is left over than of four.
            let most = if settings.pixel.cubic().is_some() { 0.2 } else { 0.1 };
            let filter = Filter::new(&pyramid, &map, &settings);
            let plan = filter.plan(grid);
            for _ in 0..100 {
                let at = [u.int_in_range(0..=1100)?, u.int_in_range(0..=1100)?];
                let Some(exact) = oracle::exact_point(&plan, at) else {
                    continue;
                };
                let found = oracle::point(&plan, at);
                for (found, exact) in found.0.iter().zip(exact) {
                    let error = (f64::from(*found) / 256.0 - exact).abs();
                    worst = worst.max(error);
                    assert!(error < most, "{found} / 256 is not {exact}: {filter:?} {grid:?} {at:?}");
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
            let settings = oracle::settings(u)?;
            let points: Vec<[u16; 2]> = (0..64).map(|i| [i * 7 % 64, i]).collect();
            let colors = |map: &UvMap, grid: SampleGrid| {
                let mut colors = [Premultiplied16::TRANSPARENT; 64];
                Filter::new(&pyramid, map, &settings).points(simd::level(), grid, &points, &mut colors);
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
}
