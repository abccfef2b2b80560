//! What the bytes of the nearest texels count, summed over pixels whose samples lie elsewhere in each.
//!
//! A sample's texel is `corner + right * column + down * row` on both axes. Columns and rows fit 8 bits, and steps are taken apart
//! into high and low parts of 16 bits: of these a machine multiplies and adds two for each of sixteen samples in one instruction.
//!
//! As in `nearest_sums`, pixels with a sample so close to the edge of a texel that rounding might have carried it across are read
//! again, sample by sample.

#![expect(
    clippy::inline_always,
    reason = "a function that is not inlined into its dispatch loses the vector instructions"
)]

use fearless_simd::prelude::*;
use fearless_simd::{Level, Simd, dispatch, i16x32, i32x16, u8x16, u8x32, u16x8, u32x4, u32x16};

use super::PixelSampling;
use super::filter_plan::{Axis, GridLevel, Plan};
use super::fixed_point::FRACTION_BITS;
use super::nearest_samples::{AWAY, FARTHEST, LARGEST, LIST, MANY, UNCERTAIN, ones};
use super::nearest_values::{ByteValues, ValueList, add, exact};
use super::texel_coordinates::{MAX_LANES, Positions, columns_and_rows};

/// Samples that are looked at together.
const TOGETHER: usize = 16;

/// The steps from one point of a pixel's lattice to the next on one axis of a level, in units of fixed point.
#[derive(Clone, Copy, Debug)]
struct Steps {
    /// High and low parts, each a pair in a word: that to the right lower.
    high: u32,
    low: u32,
    /// Corners that far outside the level have no sample in it, in texels.
    reach: f64,
}

/// A level, and the steps on both axes.
#[derive(Clone, Copy, Debug)]
struct Scattered<'a> {
    level: GridLevel<'a>,
    x: Steps,
    y: Steps,
}

/// Red, green and blue of what all samples of each pixel count; `false` where other texels than the nearest of one level are read,
/// or numbers do not fit.
pub(super) fn sum(level: Level, plan: &Plan<'_>, side: u32, list: ValueList<'_>, sums: &mut [[u64; 3]]) -> bool {
    let Some(scattered) =
        Scattered::new(plan, side).filter(|_| list.count.is_multiple_of(TOGETHER) && list.fits_masks())
    else {
        return false;
    };
    dispatch!(level, simd => sum_with(simd, (plan, side), &scattered, list, sums));
    true
}

#[inline(always)]
fn sum_with<S: Simd>(
    simd: S,
    (plan, side): (&Plan<'_>, u32),
    scattered: &Scattered<'_>,
    list: ValueList<'_>,
    sums: &mut [[u64; 3]],
) {
    let places = list.inside.chunks(list.count * MAX_LANES);
    let lists = list
        .pixels
        .chunks(MAX_LANES)
        .zip(sums.chunks_mut(MAX_LANES))
        .zip(places);
    let mut texels = [[0; TOGETHER]; MAX_LANES];
    for (i, ((pixels, sums), inside)) in lists.enumerate() {
        let masks = list.masks_of(i * MAX_LANES, pixels.len());
        let corners = scattered.corners(simd, plan, side, pixels);
        let mut distances = [i32x16::splat(simd, i32::MAX); MAX_LANES];
        sums.fill([0; 3]);
        for first in (0..list.count).step_by(TOGETHER) {
            // All texels are found before any is read: what has just been stored is read again from memory, not taken apart.
            let of_pixels = inside.chunks_exact(list.count).zip(&corners).zip(&mut distances);
            for (((inside, corner), distance), texels) in of_pixels.zip(&mut texels) {
                let Some(inside) = inside[first..].first_chunk() else {
                    continue;
                };
                *distance = scattered.find(simd, *corner, inside, texels).min(*distance);
            }
            for (lane, (sum, texels)) in sums.iter_mut().zip(&texels).enumerate() {
                match masks {
                    None => scattered.add(simd, texels, list.values, sum),
                    Some(masks) => scattered.add_some(simd, (texels, masks[lane] >> first), list.values, sum),
                }
            }
        }
        let of_pixels = inside.chunks_exact(list.count).zip(distances).zip(pixels);
        for (lane, (((inside, distance), pixel), sum)) in of_pixels.zip(sums).enumerate() {
            if distance.simd_lt(i32x16::splat(simd, UNCERTAIN)).any_true() {
                let mask = masks.map(|masks| masks[lane]);
                *sum = exact::<S, MANY>(simd, (plan, side), *pixel, (inside, mask, list.values));
            }
        }
    }
}

impl<'a> Scattered<'a> {
    fn new(plan: &Plan<'a>, side: u32) -> Option<Self> {
        let is_one = plan.pixel == PixelSampling::Nearest && plan.coarser.is_none() && plan.line.taps.count == 1;
        let level = plan.finer;
        if !is_one || plan.endless(&level.x).is_some() || plan.endless(&level.y).is_some() {
            return None;
        }
        let steps = |axis: &Axis| {
            let farthest = plan.first.abs() + LIST;
            let largest = axis.at_pivot.abs() + farthest.x * axis.right.abs() + farthest.y * axis.down.abs();
            Steps::new(axis, side).filter(|steps| largest < LARGEST && steps.reach < FARTHEST)
        };
        Some(Self {
            x: steps(&level.x)?,
            y: steps(&level.y)?,
            level,
        })
    }

    /// Where the lattices of some pixels begin, in fixed point.
    #[inline(always)]
    fn corners<S: Simd>(&self, simd: S, plan: &Plan<'_>, side: u32, pixels: &[[u16; 2]]) -> [[i32; 2]; MAX_LANES] {
        let lanes = S::u32s::LEN;
        let mut corners = [[0; 2]; MAX_LANES];
        for (pixels, corners) in pixels.chunks(lanes).zip(corners.chunks_mut(lanes)) {
            let [columns, rows] = columns_and_rows(simd, pixels);
            let size = S::f32s::splat(simd, side as f32);
            let at = Positions::new(simd, [columns * size, rows * size], plan.first);
            let x = at.around(simd, &self.level.x, self.x.reach);
            let y = at.around(simd, &self.level.y, self.y.reach);
            for (corner, (x, y)) in corners.iter_mut().zip(x.as_slice().iter().zip(y.as_slice())) {
                *corner = [*x, *y];
            }
        }
        corners
    }

    /// Finds the texels of some samples of the pixel whose lattice begins there, and how far each is from the edges of its texel.
    #[inline(always)]
    fn find<S: Simd>(
        &self,
        simd: S,
        corner: [i32; 2],
        inside: &[[u8; 2]; TOGETHER],
        texels: &mut [u32; TOGETHER],
    ) -> i32x16<S> {
        let number = |value: i32| i32x16::splat(simd, value);
        let level = self.level.level;
        let last = [level.width(), level.height()].map(|size| size.cast_signed() - 1);
        let last: i16x32<S> = number(last[0] | last[1] << 16).bitcast();
        let stride: i16x32<S> = number(1 | level.stride().cast_signed() << 16).bitcast();
        let fraction = number((1 << FRACTION_BITS) - 1);
        let (first, second) = u8x32::from_slice(simd, inside.as_flattened()).widen();
        let places: i16x32<S> = first.combine(second).bitcast();
        let x = self.x.along(simd, places, corner[0]);
        let y = self.y.along(simd, places, corner[1]);
        let at: i16x32<S> = ((x >> FRACTION_BITS) & number(0xFFFF) | y >> FRACTION_BITS << 16).bitcast();
        let found = at.max(i16x32::splat(simd, 0)).min(last).pairwise_dot_product(stride);
        found.bitcast::<u32x16<S>>().store_slice(texels);
        (x & fraction).min(y & fraction)
    }

    /// Adds what some texels count.
    #[inline(always)]
    fn add<S: Simd>(&self, simd: S, found: &[u32; TOGETHER], values: ByteValues<'_>, sum: &mut [u64; 3]) {
        let texels = self.level.level.texels();
        match values {
            ByteValues::Stored => {
                for (sum, found) in sum.iter_mut().zip(stored(simd, texels, found)) {
                    *sum += u64::from(found);
                }
            }
            ByteValues::Table(_) => {
                // Not in the list, which would be written to for each sample.
                let mut all = *sum;
                for texel in found {
                    add(&mut all, texels[*texel as usize], 1, values);
                }
                *sum = all;
            }
        }
    }

    /// Adds what those count that a mask names by its lowest bits.
    #[inline(always)]
    fn add_some<S: Simd>(
        &self,
        simd: S,
        (found, mask): (&[u32; TOGETHER], u64),
        values: ByteValues<'_>,
        sum: &mut [u64; 3],
    ) {
        const ALL: u64 = (1 << TOGETHER) - 1;
        if mask & ALL == ALL {
            return self.add(simd, found, values, sum);
        }
        let texels = self.level.level.texels();
        let mut all = *sum;
        for sample in ones(mask & ALL) {
            add(&mut all, texels[found[sample % TOGETHER] as usize], 1, values);
        }
        *sum = all;
    }
}

impl Steps {
    /// `None` where they do not fit.
    #[expect(clippy::cast_possible_truncation, reason = "small numbers, as was asked before")]
    fn new(axis: &Axis, side: u32) -> Option<Self> {
        let reach = (axis.right.abs() + axis.down.abs()) * f64::from(side - 1) + AWAY;
        let steps = [axis.right, axis.down].map(|step| (step * f64::from(1 << FRACTION_BITS) * 65_536.0).round());
        // With a half more the high part has 16 bits.
        if !steps.iter().all(|step| step.abs() < f64::from(i32::MAX - (1 << 15))) {
            return None;
        }
        let high = steps.map(|step| (step as i32 + (1 << 15)) >> 16);
        let low = [0, 1].map(|i| steps[i] as i32 - (high[i] << 16));
        let word = |[right, down]: [i32; 2]| right.cast_unsigned() & 0xFFFF | down.cast_unsigned() << 16;
        Some(Self {
            high: word(high),
            low: word(low),
            reach,
        })
    }

    /// Where samples lie on the axis, from the corner of their pixel, and half of [`UNCERTAIN`] more.
    #[inline(always)]
    fn along<S: Simd>(self, simd: S, places: i16x32<S>, corner: i32) -> i32x16<S> {
        let sums = |steps: u32, from: i32| {
            let steps: i16x32<S> = u32x16::splat(simd, steps).bitcast();
            places.pairwise_dot_product(steps) + i32x16::splat(simd, from)
        };
        sums(self.high, corner + UNCERTAIN / 2) + (sums(self.low, 1 << 15) >> 16)
    }
}

/// The sums of the bytes of red, green and blue, each 256 times itself.
#[inline(always)]
fn stored<S: Simd>(simd: S, texels: &[[u8; 4]], found: &[u32; TOGETHER]) -> [u32; 3] {
    let zero = u8x16::splat(simd, 0);
    // Of every second sample: they fit 16 bits.
    let mut halves = u16x8::splat(simd, 0);
    for four in found.as_chunks::<4>().0 {
        let four = four.map(|texel| u32::from_le_bytes(texels[texel as usize]));
        let bytes: u8x16<S> = u32x4::simd_from(simd, four).bitcast();
        halves += bytes.zip_low(zero).bitcast::<u16x8<S>>() + bytes.zip_high(zero).bitcast::<u16x8<S>>();
    }
    let halves = halves.to_array();
    [0, 1, 2].map(|i| (u32::from(halves[i]) + u32::from(halves[i + 4])) << 8)
}

#[cfg(test)]
mod tests {
    use arbtest::arbitrary::Result;

    use super::super::{SampleGrid, oracle};
    use super::*;
    use crate::simd;

    #[test]
    fn values_are_those_of_each_sample() {
        const PIXELS: usize = 19;
        let table = std::array::from_fn(|byte| u32::try_from(byte * byte).expect("a few bits") << 12 | 5);
        let mut taken = 0;
        arbtest::arbtest(|u| {
            let pyramid = oracle::pyramid(u)?;
            let mut map = oracle::map(u, &pyramid.levels()[0])?;
            if u.arbitrary()? {
                // Samples on the very edges of texels.
                let [width, height] = [pyramid.levels()[0].width(), pyramid.levels()[0].height()].map(f64::from);
                (map.dx, map.dy) = (glam::DVec2::X / width, glam::DVec2::Y / height / 2.0);
            }
            let grid = SampleGrid {
                side: *u.choose(&[4, 16, 256])?,
                origin: [u.int_in_range(-40..=40)?, u.int_in_range(-40..=40)?],
            };
            let filter = oracle::nearest(u, &pyramid, &map)?;
            let plan = filter.plan(grid);
            let count = *u.choose(&[16, 16, 48])?;
            let most = u8::try_from(grid.side - 1).expect("a byte");
            let mut at = || u.int_in_range(0..=most);
            let inside = (0..count * PIXELS)
                .map(|_| Ok([at()?, at()?]))
                .collect::<Result<Vec<[u8; 2]>>>()?;
            let mut pixel = || Ok([u.int_in_range(0..=70)?, u.int_in_range(0..=70)?]);
            let pixels: Vec<[u16; 2]> = (0..PIXELS).map(|_| pixel()).collect::<Result<_>>()?;
            let masks = pixels.iter().map(|_| u.arbitrary()).collect::<Result<Vec<u64>>>()?;
            let list = ValueList {
                pixels: &pixels,
                count,
                masks: u.arbitrary::<bool>()?.then_some(&masks[..]),
                inside: &inside,
                values: *u.choose(&[ByteValues::Stored, ByteValues::Table(&table)])?,
            };
            let expected = oracle::value_sums(&plan, grid.side, list);
            for (name, level) in simd::tested() {
                let mut found = vec![[0; 3]; pixels.len()];
                if !sum(level, &plan, grid.side, list, &mut found) {
                    return Ok(());
                }
                assert_eq!(found, expected, "{name}: {filter:?} {grid:?}");
            }
            taken += 1;
            Ok(())
        })
        .budget_ms(if cfg!(feature = "scalar") { 8000 } else { 1500 });
        assert!(taken > 20, "{taken} were summed");
    }
}
