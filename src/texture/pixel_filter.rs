//! The sums of pixels' samples: each a weighted sum of few texels, where the samples are close together, and of
//! filtered samples elsewhere.

#![expect(
    clippy::inline_always,
    reason = "a function that is not inlined into its dispatch loses the vector instructions"
)]

use fearless_simd::prelude::*;
use fearless_simd::{Simd, dispatch, i32x8, u16x8, u32x4};

use super::block_weights::{LARGE, rows, rows_beyond};
use super::covered::Covered;
use super::filter_plan::{PixelList, Plan};
use super::filtered_samples::SampleKernel;
use super::fixed_point::{MASS, MASS_BITS};
use super::folded_blocks::Folded;
use super::nearest_counts::FourTexels;
use super::nearest_means::{self, ByteMean};
use super::nearest_samples::{FEW, MANY, NearestSamples};
use super::nearest_sums;
use super::sample_offsets::{Footing, Footings, MAX_SIDE, Scale};
use super::simd_channels::{self, Spread};
use super::tent_weights::weigh;
use super::texel_coordinates::{Positions, columns_and_rows};
use super::{PixelSampling, Wrap};
use crate::color::{Premultiplied16, Resolver};
use crate::simd::{Level, PACKED, pack_four};

/// Where a vector of pixels reads one level.
struct Blocks<S: Simd, const ENDLESS: bool> {
    /// The first of the 4 x 4 texels of each pixel.
    offsets: S::u32s,
    /// The weights of 2 x 2 texels as [`Spread::columns`] takes them, for the first and the second half of the lanes: at
    /// the upper left, at the upper right, at the lower left, at the lower right.
    weights: [[S::u64s; 2]; 4],
    /// Bit by bit, the pixels whose texels lie across a border, and column and row of the first of them.
    beyond: u64,
    corners: [S::i32s; 2],
}

/// Samples that are filtered together: of several pixels, so that vectors are full.
const BATCH: usize = 64;

/// Some samples of some pixels, one pixel after the other.
struct Batch {
    points: [[u16; 2]; BATCH + PACKED],
    count: usize,
    /// Whose they are: pixels of a list, and where the samples of each end.
    pixels: [(u32, u32); BATCH],
    pixel_count: usize,
}

/// The next sample of a list that is to be filtered: the number of its pixel, and its own in the pixel.
#[derive(Clone, Copy)]
struct NextSample {
    pixel: usize,
    sample: usize,
}

/// What is wanted of the pixels of one triangle.
#[derive(Debug)]
pub struct PixelWork<'w> {
    /// Pixels of which all samples count, and others.
    pub lists: [PixelList<'w>; 2],
    /// Where their sums go: as many as pixels.
    pub sums: [&'w mut [[u32; 4]]; 2],
    /// What makes pixels of the sums of the former, which are opaque, and where these may go instead.
    pub means: Option<(&'w Resolver, &'w mut [u32])>,
}

/// The sums of pixels, or their means; whether the latter. See [`super::Filter::sums`].
pub(super) fn find(level: Level, plan: &Plan<'_>, side: u32, mut work: PixelWork<'_>) -> bool {
    if plan.pixel == PixelSampling::Nearest
        && let Some(are_means) = find_nearest(level, plan, side, &mut work)
    {
        return are_means;
    }
    let scale = Scale::new(side);
    let (footings, kernel) = (Footings::of_plan(plan, scale), SampleKernel::new(plan));
    for (list, sums) in work.by_list() {
        match &footings {
            Some(footings) if plan.wrap == Wrap::Clamp => {
                dispatch!(level, simd => sum_texels::<_, false>(simd, plan, footings, list, sums));
            }
            Some(footings) => dispatch!(level, simd => sum_texels::<_, true>(simd, plan, footings, list, sums)),
            None => dispatch!(level, simd => sum_samples(simd, &kernel, scale.side, list, sums)),
        }
    }
    false
}

impl<'w> PixelWork<'w> {
    /// What is wanted of one list.
    pub(super) fn of_list(list: PixelList<'w>, sums: &'w mut [[u32; 4]]) -> Self {
        let none = PixelList {
            pixels: &[],
            masks: None,
        };
        Self {
            lists: [list, none],
            sums: [sums, &mut []],
            means: None,
        }
    }

    /// The lists in which there are any pixels.
    fn by_list(&mut self) -> impl Iterator<Item = (PixelList<'w>, &mut [[u32; 4]])> {
        let both = self.lists.into_iter().zip(&mut self.sums);
        both.map(|(list, sums)| (list, &mut **sums))
            .filter(|(list, _)| !list.pixels.is_empty())
    }
}

/// Fetches a texel for every sample, or fewer, where that is all; if so, whether means were found.
fn find_nearest(level: Level, plan: &Plan<'_>, side: u32, work: &mut PixelWork<'_>) -> Option<bool> {
    if (side * side) as usize > FEW {
        find_nearest_of::<MANY>(level, plan, side, work)
    } else {
        find_nearest_of::<FEW>(level, plan, side, work)
    }
}

// Not inlined: its memory is not for lists that do not need it.
#[inline(never)]
fn find_nearest_of<const N: usize>(level: Level, plan: &Plan<'_>, side: u32, work: &mut PixelWork<'_>) -> Option<bool> {
    /// Fewer samples are read as quickly as counted.
    const MANY_SAMPLES: u32 = 9;
    let samples = &NearestSamples::<N>::new(plan, side)?;
    let four = (side * side >= MANY_SAMPLES).then(|| FourTexels::of(samples)).flatten();
    if let Some(four) = four {
        for (list, sums) in work.by_list() {
            dispatch!(level, simd => nearest_sums::sum_counted(simd, plan, (samples, four), list, sums));
        }
        return Some(false);
    }
    let mut are_means = false;
    if let Some((resolver, values)) = &mut work.means
        && let Some(mean) = ByteMean::new(resolver)
    {
        let pixels = work.lists[0].pixels;
        dispatch!(level, simd => nearest_means::means(simd, (plan, samples), mean, pixels, values));
        are_means = true;
        work.lists[0].pixels = &[];
    }
    for (list, sums) in work.by_list() {
        dispatch!(level, simd => nearest_sums::sum(simd, plan, samples, list, sums));
    }
    Some(are_means)
}

/// Filters every sample.
#[inline(always)]
fn sum_samples<S: Simd>(simd: S, kernel: &SampleKernel<'_>, side: u32, list: PixelList<'_>, sums: &mut [[u32; 4]]) {
    let mut inside = [[0; 2]; MAX_SIDE * MAX_SIDE];
    let columns = side as usize;
    for (j, row) in (0..).zip(inside.chunks_exact_mut(columns).take(columns)) {
        for (i, sample) in (0..).zip(row) {
            *sample = [i, j];
        }
    }
    let inside = &inside[..columns * columns];
    let mut colors = [Premultiplied16::TRANSPARENT; BATCH];
    sums.fill([0; 4]);
    let mut batch = Batch::EMPTY;
    let mut next = NextSample { pixel: 0, sample: 0 };
    let are_whole = list.masks.is_none() && inside.len() <= BATCH;
    while next.pixel < list.pixels.len() {
        let first = next.pixel;
        if are_whole {
            batch.fill_whole(list.pixels, inside, side, &mut next);
        } else {
            batch.fill(simd, list, (inside, side), &mut next);
        }
        let points = &batch.points[..batch.count];
        let colors = &mut colors[..batch.count];
        kernel.filter(simd.level(), points, colors);
        if are_whole {
            for (sum, colors) in sums[first..].iter_mut().zip(colors.chunks_exact(inside.len())) {
                *sum = Premultiplied16::sums(colors);
            }
        } else {
            batch.add_to(sums, colors);
        }
    }
}

impl Batch {
    const EMPTY: Self = Self {
        points: [[0; 2]; BATCH + PACKED],
        count: 0,
        pixels: [(0, 0); BATCH],
        pixel_count: 0,
    };

    /// Takes all samples of as many pixels as fit from the next one on, which moves on. In a pixel they lie `inside`.
    #[inline(always)]
    fn fill_whole(&mut self, pixels: &[[u16; 2]], inside: &[[u16; 2]], side: u32, next: &mut NextSample) {
        let side = u16::try_from(side).unwrap_or(1);
        let together = BATCH / inside.len();
        let pixels = &pixels[next.pixel..pixels.len().min(next.pixel + together)];
        for (pixel, points) in pixels.iter().zip(self.points.chunks_exact_mut(inside.len())) {
            let corner = pixel.map(|at| at.wrapping_mul(side));
            let ((fours, rest), (fours_inside, rest_inside)) = (points.as_chunks_mut::<4>(), inside.as_chunks::<4>());
            // A length that is known makes vector code of the loop.
            for (points, inside) in fours.iter_mut().zip(fours_inside) {
                for (point, inside) in points.iter_mut().zip(inside) {
                    *point = point_at(corner, *inside);
                }
            }
            for (point, inside) in rest.iter_mut().zip(rest_inside) {
                *point = point_at(corner, *inside);
            }
        }
        self.count = pixels.len() * inside.len();
        next.pixel += pixels.len();
    }

    /// Takes samples, as many as fit, from `next` on, and moves it on. In a pixel they lie `inside`.
    #[inline(always)]
    fn fill<S: Simd>(
        &mut self,
        simd: S,
        list: PixelList<'_>,
        (inside, side): (&[[u16; 2]], u32),
        next: &mut NextSample,
    ) {
        let side = u16::try_from(side).unwrap_or(1);
        (self.count, self.pixel_count) = (0, 0);
        let NextSample { mut pixel, mut sample } = *next;
        while pixel < list.pixels.len() && self.count <= BATCH - PACKED && self.pixel_count < BATCH {
            let corner = list.pixels[pixel].map(|at| at.saturating_mul(side));
            sample = match list.masks {
                None => self.take(corner, inside, sample),
                Some(masks) => self.take_some(simd, corner, &inside[..inside.len().min(64)], (sample, masks[pixel])),
            };
            let number = |count: usize| u32::try_from(count).unwrap_or(u32::MAX);
            self.pixels[self.pixel_count] = (number(pixel), number(self.count));
            self.pixel_count += 1;
            if sample >= inside.len() {
                (pixel, sample) = (pixel + 1, 0);
            }
        }
        *next = NextSample { pixel, sample };
    }

    /// Takes samples of the pixel whose first one is at `corner`, from one on; the number of the next one.
    #[inline(always)]
    fn take(&mut self, corner: [u16; 2], inside: &[[u16; 2]], from: usize) -> usize {
        let end = inside.len().min(from + BATCH - self.count);
        let (fours, rest) = inside[from..end].as_chunks::<4>();
        // A length that is known makes vector code of the loop.
        for four in fours {
            if let Some(points) = self.points[self.count..].first_chunk_mut::<4>() {
                for (point, inside) in points.iter_mut().zip(four) {
                    *point = point_at(corner, *inside);
                }
            }
            self.count += 4;
        }
        for inside in rest {
            self.points[self.count % BATCH] = point_at(corner, *inside);
            self.count += 1;
        }
        end
    }

    /// The same of those that a mask names, [`PACKED`] at a time; `usize::MAX` once all of them are taken.
    #[inline(always)]
    fn take_some<S: Simd>(
        &mut self,
        simd: S,
        [left, top]: [u16; 2],
        inside: &[[u16; 2]],
        (from, mask): (usize, u64),
    ) -> usize {
        let corner: u16x8<S> = u32x4::splat(simd, u32::from(left) | u32::from(top) << 16).bitcast();
        let mut rest = mask.checked_shr(u32::try_from(from).unwrap_or(64)).unwrap_or(0);
        for (first, inside) in (from..).step_by(PACKED).zip(inside[from..].chunks(PACKED)) {
            if rest == 0 {
                break;
            }
            if self.count > BATCH - PACKED {
                return first;
            }
            let mut four = [[0; 2]; PACKED];
            if let Some(inside) = inside.first_chunk() {
                four = *inside;
            } else {
                four[..inside.len()].copy_from_slice(inside);
                rest &= (1 << inside.len()) - 1;
            }
            let points = u16x8::from_slice(simd, four.as_flattened()) + corner;
            if let Some(taken) = self.points[self.count..].first_chunk_mut() {
                self.count += pack_four(simd, points, rest, taken);
            }
            rest >>= PACKED;
        }
        usize::MAX
    }

    /// Adds the colours of the samples to the sums of their pixels.
    #[inline(always)]
    fn add_to(&self, sums: &mut [[u32; 4]], colors: &[Premultiplied16]) {
        let mut first = 0;
        for (pixel, end) in &self.pixels[..self.pixel_count] {
            let (pixel, end) = (*pixel as usize, *end as usize);
            let of_batch = Premultiplied16::sums(&colors[first..end]);
            for (sum, channel) in sums[pixel].iter_mut().zip(of_batch) {
                *sum += channel;
            }
            first = end;
        }
    }
}

/// Where a sample lies that lies `inside` a pixel; no list is so large that this overflows.
#[inline(always)]
fn point_at([left, top]: [u16; 2], [x, y]: [u16; 2]) -> [u16; 2] {
    [left.wrapping_add(x), top.wrapping_add(y)]
}

/// Weighs the texels below every pixel, of a texture that ends or goes on for ever.
#[inline(always)]
fn sum_texels<S: Simd, const ENDLESS: bool>(
    simd: S,
    plan: &Plan<'_>,
    Footings { finer, coarser }: &Footings<'_>,
    list: PixelList<'_>,
    sums: &mut [[u32; 4]],
) {
    let scale = finer.scale;
    let lanes = S::u32s::LEN;
    let spread = Spread::new(simd);
    let middle = plan.first + f64::from(scale.side - 1) / 2.0;
    for (i, (pixels, sums)) in list.pixels.chunks(lanes).zip(sums.chunks_mut(lanes)).enumerate() {
        let [columns, rows] = columns_and_rows(simd, pixels);
        let side = S::f32s::splat(simd, scale.side as f32);
        let at = Positions::new(simd, [columns * side, rows * side], middle);
        let masks = list.masks.map(|masks| &masks[i * lanes..][..pixels.len()]);
        let (covered, count) = Covered::new(simd, scale.side * scale.side, masks);
        let total = count << scale.sample_bits;
        let number = |value| S::i32s::splat(simd, value);
        let part = coarser.as_ref().map_or(number(0), |coarser| {
            (total * number(coarser.level.mass) + number(MASS / 2)) >> MASS_BITS
        });
        let fine = Blocks::<S, ENDLESS>::outlined(simd, finer, &at, covered, total - part);
        let coarse = coarser.as_ref().map(|coarser| {
            (
                Blocks::<S, ENDLESS>::outlined(simd, coarser, &at, covered, part),
                coarser,
            )
        });
        for (lane, sum) in sums.iter_mut().enumerate() {
            let mut channels = fine.sum(simd, spread, (finer, plan.wrap), lane);
            if let Some((coarse, coarser)) = &coarse {
                channels += coarse.sum(simd, spread, (coarser, plan.wrap), lane);
            }
            let (left, right) = channels.split();
            let channels = left + right;
            // A byte times a sample's weight becomes 256.
            let scaled = if scale.sample_bits >= 8 {
                let shift = scale.sample_bits - 8;
                (channels + ((1 << shift) >> 1)) >> shift
            } else {
                channels << (8 - scale.sample_bits)
            };
            *sum = scaled.bitcast::<u32x4<S>>().to_array();
        }
    }
}

impl<S: Simd, const ENDLESS: bool> Blocks<S, ENDLESS> {
    /// [`Blocks::new`], compiled once for the two levels.
    #[inline(never)]
    fn outlined(simd: S, footing: &Footing<'_>, at: &Positions<S>, covered: Covered<S>, total: S::i32s) -> Self {
        simd.vectorize(
            #[inline(always)]
            || Self::new(simd, footing, at, covered, total),
        )
    }

    #[inline(always)]
    fn new(simd: S, footing: &Footing<'_>, at: &Positions<S>, covered: Covered<S>, total: S::i32s) -> Self {
        let weighed = if footing.is_narrow() {
            weigh::<S, 2, ENDLESS>(simd, footing, at, covered, total)
        } else {
            weigh::<S, 3, ENDLESS>(simd, footing, at, covered, total)
        };
        let Folded {
            offsets,
            weights,
            corners,
            beyond,
        } = if ENDLESS {
            Folded::new(simd, footing, weighed)
        } else {
            Folded::inside(simd, footing, weighed)
        };
        let both = |row: usize, column: usize| weights[row][column] | weights[row + 1][column] << 16;
        let quarter =
            |row: usize, column: usize| simd_channels::in_columns::<S>(both(row, column), both(row, column + 1));
        Self {
            offsets,
            weights: [quarter(0, 0), quarter(0, 2), quarter(2, 0), quarter(2, 2)],
            beyond,
            corners,
        }
    }

    /// Red, green, blue and alpha of a pixel in the units of the weights: even columns, then odd columns.
    #[inline(always)]
    fn sum(&self, simd: S, spread: Spread<S>, (footing, wrap): (&Footing<'_>, Wrap), lane: usize) -> i32x8<S> {
        let level = footing.level.level;
        let rows = if !ENDLESS || self.beyond >> lane & 1 == 0 {
            rows::<S, LARGE>(simd, level, self.offsets.as_slice()[lane] as usize)
        } else {
            let corner = self.corners.each_ref().map(|corners| corners.as_slice()[lane]);
            rows_beyond::<S, LARGE>(simd, level, wrap, corner)
        };
        let half = S::u64s::LEN;
        let weights = |i: usize| self.weights[i][usize::from(lane >= half)].as_slice()[lane % half];
        let quarter = |texels, i: usize| spread.columns(simd, texels, weights(i));
        let upper = quarter(rows[0].zip_low(rows[1]), 0) + quarter(rows[0].zip_high(rows[1]), 1);
        let lower = quarter(rows[2].zip_low(rows[3]), 2) + quarter(rows[2].zip_high(rows[3]), 3);
        upper + lower
    }
}

#[cfg(test)]
mod tests {
    use arbtest::arbitrary;

    use super::super::{Filter, PixelSampling, SamplingSettings, oracle};
    use super::*;
    use crate::simd;

    #[test]
    fn sums_are_what_their_definition_says_on_every_level() {
        let (mut weighed, mut endless, mut filtered) = (0, 0, 0);
        arbtest::arbtest(|u| {
            let pyramid = oracle::pyramid(u)?;
            let map = oracle::map(u, &pyramid.levels()[0])?;
            let grid = oracle::grid(u, &map)?;
            let mut settings = oracle::settings(u)?;
            if u.int_in_range(0..=3)? == 0 {
                // As often those that go on for ever and are weighed as any.
                (settings.pixel, settings.wrap) = (PixelSampling::Bilinear, *u.choose(&Wrap::ALL[1..])?);
            }
            let filter = Filter::new(&pyramid, &map, &settings);
            let plan = filter.plan(grid);
            if Footings::of_plan(&plan, Scale::new(grid.side)).is_some() {
                *(if plan.wrap == Wrap::Clamp {
                    &mut weighed
                } else {
                    &mut endless
                }) += 1;
            } else {
                filtered += 1;
            }
            let count = u.int_in_range(0..=40)?;
            let mut pixel = || Ok([u.int_in_range(0..=70)?, u.int_in_range(0..=70)?]);
            let pixels = (0..count)
                .map(|_| pixel())
                .collect::<arbitrary::Result<Vec<[u16; 2]>>>()?;
            let masks = (0..count)
                .map(|_| u.arbitrary())
                .collect::<arbitrary::Result<Vec<u64>>>()?;
            let masks = (grid.side <= 8 && u.arbitrary()?).then_some(&masks[..]);
            let expected: Vec<_> = pixels
                .iter()
                .enumerate()
                .map(|(i, at)| {
                    let covered = |j: u32| masks.is_none_or(|masks| masks[i] >> j & 1 == 1);
                    oracle::pixel_sum(&plan, grid.side, at.map(u32::from), covered)
                })
                .collect();
            for (name, level) in simd::tested() {
                let mut found = vec![[0; 4]; count];
                filter.sums(level, grid, PixelList { pixels: &pixels, masks }, &mut found);
                assert_eq!(found, expected, "{name}: {filter:?} {grid:?} {masks:x?}");
            }
            Ok(())
        })
        // Not optimised, it is slower by far.
        .budget_ms(if cfg!(feature = "scalar") { 10_000 } else { 2000 });
        assert!(
            weighed > 20 && endless > 20 && filtered > 20,
            "all ways were taken: {weighed}, {endless} and {filtered}"
        );
    }

    #[test]
    fn sums_move_no_pixel_by_a_quarter_of_a_byte_from_the_definition() {
        arbtest::arbtest(|u| {
            let pyramid = oracle::pyramid(u)?;
            let map = oracle::map(u, &pyramid.levels()[0])?;
            let grid = oracle::grid(u, &map)?;
            let settings = SamplingSettings {
                pixel: PixelSampling::Bilinear,
                wrap: *u.choose(&Wrap::ALL)?,
                ..oracle::settings(u)?
            };
            let filter = Filter::new(&pyramid, &map, &settings);
            let plan = filter.plan(grid);
            let mask: u64 = if grid.side <= 8 && u.arbitrary()? {
                u.arbitrary()?
            } else {
                u64::MAX
            };
            let covered = |j: u32| j >= 64 || mask >> j & 1 == 1;
            // Weights are rounded once a pixel, however few of its samples are covered: what counts is its colour, to which
            // the sum over covered samples is added.
            let samples = f64::from(grid.side * grid.side);
            for _ in 0..10 {
                let at = [u.int_in_range(0..=70)?, u.int_in_range(0..=70)?];
                let found = oracle::pixel_sum(&plan, grid.side, at, covered);
                let mut exact = [0.0; 4];
                let mut is_near = true;
                for j in (0..grid.side * grid.side).filter(|j| covered(*j)) {
                    let point = [at[0] * grid.side + j % grid.side, at[1] * grid.side + j / grid.side];
                    let sample = oracle::exact_point(&plan, point);
                    is_near &= sample.is_some();
                    let Some(sample) = sample else {
                        continue;
                    };
                    for (sum, channel) in exact.iter_mut().zip(sample) {
                        *sum += channel;
                    }
                }
                if !is_near {
                    assert_ne!(plan.wrap, Wrap::Clamp, "only what goes on for ever may be far away");
                    continue;
                }
                for (found, exact) in found.iter().zip(exact) {
                    let error = (f64::from(*found) / 256.0 - exact).abs() / samples;
                    assert!(
                        error < 0.25,
                        "{error}: {found} / 256 is not {exact}: {filter:?} {grid:?} {at:?} {mask:x}"
                    );
                }
            }
            Ok(())
        })
        .budget_ms(1000);
    }
}
