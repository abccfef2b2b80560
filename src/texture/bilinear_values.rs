//! What all samples of pixels add up to that each read four texels, of one level or two, or some of them, or the means of their light:
//! exactly as one by one, sixteen samples at once.
//!
//! Where the samples of a pixel lie in no block, or where it is in doubt which texels they read, they are shaded one by one after all;
//! so they are where the light that is found leaves two bytes open.

#![expect(
    clippy::inline_always,
    reason = "a function that is not inlined into its dispatch loses the vector instructions"
)]

use fearless_simd::prelude::*;
use fearless_simd::{Level, Simd, dispatch, f32x16, i32x16, mask32x16, u16x32, u32x16};

use super::bilinear::SUM_SHIFT;
use super::filter_plan::{GridLevel, Plan};
use super::filtered_samples::SampleKernel;
use super::nearest_samples::ones;
use super::nearest_values::{ByteValues, ValueList};
use super::sample_blocks::{BlockAxis, Blocks, Inside, LANES, Steps, halves, is_in_doubt, is_near, number};
use super::{PixelSampling, Wrap};
use crate::color::{NearLight, Premultiplied16, near_light_of_stored};
use crate::simd::put_lanes;

/// Fewer samples do not fill a vector well enough.
const FEWEST: usize = 9;
/// Fewer pixels are not worth what has to be prepared.
const FEWEST_PIXELS: usize = 6;

/// Some pixels of one triangle.
#[derive(Clone, Copy)]
pub(super) struct BilinearList<'w> {
    plan: &'w Plan<'w>,
    side: u32,
    list: ValueList<'w>,
    /// The least and the greatest column and row of a sample in its pixel.
    outermost: [[f64; 2]; 2],
}

/// Memory of [`BilinearList::sums_of_some`], so that no vector lies in two cache lines.
#[repr(align(64))]
struct Scratch {
    /// Red, green and blue of a vector of samples of each pixel, and what all vectors add up to.
    read: [[[i32; LANES]; LANES]; 3],
    sums: [[[f32; LANES]; LANES]; 3],
}

/// Red, green and blue of the samples of [`LANES`] pixels.
struct Sums<S: Simd> {
    /// What they add up to.
    sums: [f32x16<S>; 3],
    /// A bit for each pixel of which that is known.
    known: u64,
}

impl<'w> BilinearList<'w> {
    /// The samples of the pixels of a list, where each reads four texels of a level; `None` where they read others, or are too few.
    pub(super) fn new(plan: &'w Plan<'w>, side: u32, list: ValueList<'w>) -> Option<Self> {
        let reads_four = plan.pixel == PixelSampling::Bilinear && plan.wrap == Wrap::Clamp && plan.line.taps.count == 1;
        let levels = [Some(&plan.finer), plan.coarser.as_ref()];
        let axes = levels.into_iter().flatten().flat_map(|level| [&level.x, &level.y]);
        let farthest = plan.first.abs().max_element() + f64::from(u16::MAX);
        let are_enough = list.count >= FEWEST && list.pixels.len() >= FEWEST_PIXELS;
        if !reads_four || !are_enough || !list.fits_masks() || !axes.into_iter().all(|axis| is_near(axis, farthest)) {
            return None;
        }
        let (mut least, mut most) = ([0.0; 2], [f64::from(side - 1); 2]);
        if list.inside.len() == list.count {
            for k in [0, 1] {
                let places = list.inside.iter().map(|place| f64::from(place[k]));
                (least[k], most[k]) = (places.clone().fold(255.0, f64::min), places.fold(0.0, f64::max));
            }
        }
        Some(Self {
            plan,
            side,
            list,
            outermost: [least, most],
        })
    }

    /// The opaque pixels of the means of the light of all samples; whether this machine finds them.
    pub(super) fn light_pixels(self, level: Level, near: &NearLight<'_>, pixels: &mut [u32]) -> bool {
        dispatch!(level, simd => self.light_pixels_with(simd, near, pixels))
    }

    /// What red, green and blue of what samples store add up to, of those that masks name; whether this machine finds that.
    pub(super) fn sums(self, level: Level, sums: &mut [[u64; 3]]) -> bool {
        matches!(self.list.values, ByteValues::Stored) && dispatch!(level, simd => self.sums_with(simd, sums))
    }

    #[inline(always)]
    fn light_pixels_with<S: Simd>(self, simd: S, near: &NearLight<'_>, pixels: &mut [u32]) -> bool {
        if !has_blocks(simd) {
            return false;
        }
        let (mut scratch, mut open) = (Scratch::NEW, Vec::new());
        for (first, pixels) in (0..).step_by(LANES).zip(pixels.chunks_mut(LANES)) {
            let Sums { sums, known } = self.sums_of_some::<S, true>(simd, &mut scratch, (first, pixels.len()));
            let (found, certain) = near.pixels(simd, sums);
            put_lanes(found, pixels);
            let left = !(certain & known) & first_bits(pixels.len());
            open.extend(ones(left).map(|i| first + i));
        }
        let resolver = near.resolver();
        self.one_by_one(simd.level(), &open, |i, samples| {
            pixels[i] = resolver.opaque_mean(samples);
        });
        true
    }

    #[inline(always)]
    fn sums_with<S: Simd>(self, simd: S, sums: &mut [[u64; 3]]) -> bool {
        if !has_blocks(simd) {
            return false;
        }
        let (mut scratch, mut open) = (Scratch::NEW, Vec::new());
        for (first, sums) in (0..).step_by(LANES).zip(sums.chunks_mut(LANES)) {
            let found = self.sums_of_some::<S, false>(simd, &mut scratch, (first, sums.len()));
            let mut by_channel = [[0; LANES]; 3];
            for (values, sum) in by_channel.iter_mut().zip(found.sums) {
                sum.to_int::<i32x16<S>>().store_array(values);
            }
            for (i, sum) in sums.iter_mut().enumerate() {
                *sum = [0, 1, 2].map(|k| u64::from(by_channel[k][i % LANES].cast_unsigned()));
            }
            let left = !found.known & first_bits(sums.len());
            open.extend(ones(left).map(|i| first + i));
        }
        self.one_by_one(simd.level(), &open, |i, samples| {
            let mut sum = [0; 3];
            for (sample, Premultiplied16([red, green, blue, _])) in samples.iter().enumerate() {
                if self.list.masks.is_none_or(|masks| masks[i] >> sample & 1 == 1) {
                    for (sum, channel) in sum.iter_mut().zip([red, green, blue]) {
                        *sum += u64::from(*channel);
                    }
                }
            }
            sums[i] = sum;
        });
        true
    }

    /// Shades the samples of some pixels one by one and visits them.
    #[inline(never)]
    fn one_by_one(self, level: Level, pixels: &[usize], mut visit: impl FnMut(usize, &[Premultiplied16])) {
        /// Pixels that are shaded together.
        const TOGETHER: usize = 16;
        let kernel = SampleKernel::new(self.plan);
        let (mut points, mut colors) = (Vec::new(), Vec::new());
        for pixels in pixels.chunks(TOGETHER) {
            points.clear();
            for pixel in pixels {
                points.extend(self.points(*pixel));
            }
            colors.clear();
            colors.resize(points.len(), Premultiplied16::TRANSPARENT);
            kernel.filter(level, &points, &mut colors);
            for (pixel, colors) in pixels.iter().zip(colors.chunks_exact(self.list.count)) {
                visit(*pixel, colors);
            }
        }
    }

    /// The samples of a pixel of the list.
    fn points(&self, pixel: usize) -> impl Iterator<Item = [u16; 2]> {
        // No tile has more than `2^14` pixels along a side.
        let at = |place: u16| u16::try_from(u32::from(place) * self.side).unwrap_or(u16::MAX);
        let corner = self.list.pixels[pixel].map(at);
        let inside = self.inside(pixel).iter();
        inside.map(move |place| [0, 1].map(|k| corner[k].wrapping_add(u16::from(place[k]))))
    }

    /// Where the samples of a pixel of the list lie in it.
    #[inline(always)]
    fn inside(&self, pixel: usize) -> &'w [[u8; 2]] {
        let ValueList { inside, count, .. } = self.list;
        let first = if self.are_same() { 0 } else { pixel * count };
        &inside[first..first + count]
    }

    /// Whether samples lie in the same places in all pixels.
    #[inline(always)]
    fn are_same(&self) -> bool {
        self.list.inside.len() == self.list.count
    }

    /// What the samples that take part of up to [`LANES`] pixels add up to, or their light, in parts of all light.
    ///
    /// First what all samples read, then what that makes: what one sample needs waits for itself again and again.
    #[inline(always)]
    fn sums_of_some<S: Simd, const IS_LIGHT: bool>(
        self,
        simd: S,
        Scratch { read, sums }: &mut Scratch,
        (first, count): (usize, usize),
    ) -> Sums<S> {
        let pixels = &self.list.pixels[first..first + count];
        let finer = self.blocks(simd, &self.plan.finer, pixels);
        let mut known = finer.x.fits & finer.y.fits & first_bits(count);
        let mut coarser = None;
        if let Some(level) = &self.plan.coarser {
            let blocks = self.blocks(simd, level, pixels);
            known &= blocks.x.fits & blocks.y.fits;
            coarser = Some(blocks);
        }
        let (mut lanes, mut lane_count) = ([0; LANES], 0);
        for i in ones(known) {
            lanes[lane_count % LANES] = i % LANES;
            lane_count += 1;
        }
        let lanes = &lanes[..lane_count];
        for vector in (0..self.list.count).step_by(LANES) {
            let mut steps = self.steps(simd, 0, vector);
            for i in lanes {
                if !self.are_same() {
                    steps = self.steps(simd, first + i, vector);
                }
                let (mut values, mut doubt) = finer.read(simd, steps[0], *i);
                if let Some(coarser) = &coarser {
                    let (others, other_doubt) = coarser.read(simd, steps[1], *i);
                    doubt = doubt.min(other_doubt);
                    for (value, other) in values.iter_mut().zip(others) {
                        *value += other;
                    }
                }
                for (read, value) in read.iter_mut().zip(values) {
                    value.store_array(&mut read[*i]);
                }
                known &= !(u64::from(is_in_doubt(simd, doubt)) << *i);
            }
            let there = self.there(first, count, vector);
            for (sums, read) in sums.iter_mut().zip(&*read) {
                for i in lanes {
                    let value = value::<S, IS_LIGHT>(simd, i32x16::load_array_ref(simd, &read[*i]));
                    let there = mask32x16::from_bitmask(simd, there[*i]);
                    let counting = there.select(value, f32x16::splat(simd, 0.0));
                    let sum = if vector == 0 {
                        counting
                    } else {
                        f32x16::load_array_ref(simd, &sums[*i]) + counting
                    };
                    sum.store_array(&mut sums[*i]);
                }
            }
        }
        let [red, green, blue] = &*sums;
        Sums {
            sums: [of_each(simd, red), of_each(simd, green), of_each(simd, blue)],
            known,
        }
    }

    /// Of some pixels, which of a vector of samples from this one on take part: a bit for each.
    #[inline(always)]
    fn there(&self, first: usize, count: usize, vector: usize) -> [u64; LANES] {
        let mut there = [first_bits(self.list.count - vector); LANES];
        if let Some(masks) = self.list.masks_of(first, count) {
            for (there, mask) in there.iter_mut().zip(masks) {
                *there &= mask >> vector;
            }
        }
        there
    }

    /// How far samples of a pixel, from this one on, lie from its first point in both levels.
    #[inline(always)]
    fn steps<S: Simd>(&self, simd: S, pixel: usize, first: usize) -> [Steps<S>; 2] {
        let inside = Inside::new(simd, &self.inside(pixel)[first..]);
        let finer = inside.steps(simd, &self.plan.finer);
        let mut steps = [finer; 2];
        if let Some(coarser) = &self.plan.coarser {
            steps[1] = inside.steps(simd, coarser);
        }
        steps
    }

    /// Finds the blocks of up to [`LANES`] pixels in a level.
    #[inline(always)]
    fn blocks<S: Simd>(&self, simd: S, level: &'w GridLevel<'w>, pixels: &[[u16; 2]]) -> Blocks<'w> {
        let mut padded = [[0; 2]; LANES];
        padded[..pixels.len()].copy_from_slice(pixels);
        let both: u32x16<S> = u16x32::from_slice(simd, padded.as_flattened()).bitcast();
        let side = self.side as f32;
        let corners = [
            halves(number(both & 0xFFFF) * side, self.plan.first.x),
            halves(number(both >> 16) * side, self.plan.first.y),
        ];
        Blocks {
            level,
            x: BlockAxis::new(simd, corners, &level.x, self.outermost),
            y: BlockAxis::new(simd, corners, &level.y, self.outermost),
        }
    }
}

impl Scratch {
    const NEW: Self = Self {
        read: [[[0; LANES]; LANES]; 3],
        sums: [[[0.0; LANES]; LANES]; 3],
    };
}

/// Whether a vector holds the block of texels that samples of a pixel read.
#[inline(always)]
fn has_blocks<S: Simd>(_: S) -> bool {
    S::u32s::LEN == LANES
}

/// A bit for each of so many samples of a vector.
#[inline(always)]
fn first_bits(count: usize) -> u64 {
    u64::MAX >> (64 - count.min(LANES))
}

/// What samples store, or its light, from their weighted sums.
#[inline(always)]
fn value<S: Simd, const IS_LIGHT: bool>(simd: S, sums: i32x16<S>) -> f32x16<S> {
    let stored = (sums + (1 << (SUM_SHIFT - 1))) >> SUM_SHIFT;
    let value: f32x16<S> = stored.to_float();
    if IS_LIGHT {
        near_light_of_stored(simd, value)
    } else {
        value
    }
}

/// What the lanes of each of [`LANES`] vectors add up to.
#[inline(always)]
fn of_each<S: Simd>(simd: S, vectors: &[[f32; LANES]; LANES]) -> f32x16<S> {
    // Of two that stand half of all apart half as many sums of each, in turns: so they end up in order.
    let mut sums = [f32x16::splat(simd, 0.0); LANES];
    for (sum, vector) in sums.iter_mut().zip(vectors) {
        *sum = f32x16::load_array_ref(simd, vector);
    }
    let mut half = LANES / 2;
    while half > 0 {
        for i in 0..half {
            let (a, b) = (sums[i], sums[i + half]);
            sums[i] = a.zip_low(b) + a.zip_high(b);
        }
        half /= 2;
    }
    sums[0]
}

#[cfg(test)]
mod tests {
    use arbtest::arbitrary::{Result, Unstructured};
    use glam::DVec2;

    use super::super::{Filter, LevelSampling, MipLevel, MipPyramid, SampleGrid, SamplingSettings, UvMap, oracle};
    use super::*;
    use crate::color::LightResolver;
    use crate::rules::Rules;
    use crate::simd;

    /// A map that reads few texels in each pixel, more often than not.
    fn map(u: &mut Unstructured<'_>, base: &MipLevel) -> Result<UvMap> {
        let mut map = oracle::map(u, base)?;
        if u.ratio(3, 4)? {
            let scale = f64::from(u.int_in_range(1..=1000)?) / 1000.0 / f64::from(base.width());
            let turned = DVec2::from_angle(f64::from(u.int_in_range(0..=628)?) / 100.0);
            (map.dx, map.dy) = (turned * scale, turned.perp() * scale);
            map.pivot = DVec2::new(3.25, 4.5);
            map.uv = DVec2::new(0.4, 0.6);
        }
        Ok(map)
    }

    /// Where samples lie in one pixel, or in each of so many.
    fn inside(u: &mut Unstructured<'_>, (side, count): (u32, usize), pixels: usize) -> Result<Vec<[u8; 2]>> {
        let most = u8::try_from(side - 1).expect("a byte");
        let all = if u.arbitrary()? { count } else { count * pixels };
        (0..all)
            .map(|_| Ok([u.int_in_range(0..=most)?, u.int_in_range(0..=most)?]))
            .collect()
    }

    /// Some of so many samples of each of so many pixels, where masks have bits for them.
    fn masks(u: &mut Unstructured<'_>, count: usize, pixels: usize) -> Result<Option<Vec<u64>>> {
        let all = (0..pixels).map(|_| u.arbitrary()).collect::<Result<_>>()?;
        Ok((count <= 64).then_some(all))
    }

    #[test]
    fn sums_and_light_are_those_of_samples_one_by_one() {
        let (mut found, mut in_blocks) = (0, 0);
        arbtest::arbtest(|u| {
            let mut texel = |_| Ok([u.arbitrary()?, u.arbitrary()?, u.arbitrary()?, 255]);
            let texels = (0..31 * 27).map(&mut texel).collect::<Result<Vec<_>>>()?;
            let pyramid = MipPyramid::build(MipLevel::new(31, 27, texels));
            let settings = SamplingSettings {
                pixel: PixelSampling::Bilinear,
                level: *u.choose(&[LevelSampling::Zero, LevelSampling::Linear])?,
                ..SamplingSettings::default()
            };
            let map = map(u, &pyramid.levels()[0])?;
            let filter = Filter::new(&pyramid, &map, &settings);
            let (side, count) = *u.choose(&[(3, 9), (4, 16), (5, 25), (16, 256), (256, 16), (256, 11)])?;
            let grid = SampleGrid {
                side,
                origin: [u.int_in_range(-9..=9)?, u.int_in_range(-9..=9)?],
            };
            let mut place = || Ok([u.int_in_range(0..=60)?, u.int_in_range(0..=60)?]);
            let places: Vec<[u16; 2]> = (0..21).map(|_| place()).collect::<Result<_>>()?;
            let inside = inside(u, (side, count), places.len())?;
            let plan = filter.plan(grid);
            let list = ValueList {
                pixels: &places,
                count,
                inside: &inside,
                masks: None,
                values: ByteValues::Stored,
            };
            let Some(list) = BilinearList::new(&plan, side, list) else {
                return Ok(());
            };
            let samples = |pixel: usize| -> Vec<Premultiplied16> {
                let points = list.points(pixel);
                points.map(|at| oracle::point(&plan, at.map(u32::from))).collect()
            };
            let masks = masks(u, count, places.len())?;
            let resolver = LightResolver::new(u32::try_from(count).expect("few"), Rules::Standard);
            for (name, level) in simd::tested() {
                let (mut sums, mut pixels) = (vec![[0; 3]; places.len()], vec![0; places.len()]);
                if !list.sums(level, &mut sums) || !list.light_pixels(level, &NearLight::new(&resolver), &mut pixels) {
                    continue;
                }
                if let Some(masks) = &masks {
                    parts_are_those_of_samples(level, (list, masks), &samples);
                }
                found += 1;
                in_blocks += dispatch!(level, simd => known(simd, list)).count_ones();
                for (i, (sum, pixel)) in sums.into_iter().zip(pixels).enumerate() {
                    let samples = samples(i);
                    let [r, g, b, _] = Premultiplied16::sums(&samples);
                    assert_eq!(
                        sum,
                        [r, g, b].map(u64::from),
                        "{name}: {i} of {filter:?} {grid:?} {inside:?}"
                    );
                    let expected = resolver.opaque_mean(&samples);
                    assert_eq!(pixel, expected, "{name}: {i} of {filter:?} {grid:?}");
                }
            }
            Ok(())
        })
        .budget_ms(if cfg!(feature = "scalar") { 4000 } else { 1500 });
        let is_possible = simd::available().iter().any(|(name, _)| *name == "avx512");
        assert_eq!(found > 0, is_possible, "found where vectors hold a block");
        assert!(
            in_blocks >= found * 5,
            "{in_blocks} pixels of {found} lists lay in blocks"
        );
    }

    /// Compares what parts of pixels add up to with the samples of these pixels.
    fn parts_are_those_of_samples(
        level: Level,
        (list, masks): (BilinearList<'_>, &[u64]),
        samples: &impl Fn(usize) -> Vec<Premultiplied16>,
    ) {
        let list = BilinearList {
            list: ValueList {
                masks: Some(masks),
                ..list.list
            },
            ..list
        };
        let mut sums = vec![[0; 3]; masks.len()];
        assert!(list.sums(level, &mut sums), "parts where wholes are found");
        for (i, sum) in sums.into_iter().enumerate() {
            let named = samples(i)
                .into_iter()
                .enumerate()
                .filter(|(j, _)| masks[i] >> j & 1 == 1);
            let part: Vec<_> = named.map(|(_, color)| color).collect();
            let [r, g, b, _] = Premultiplied16::sums(&part);
            assert_eq!(sum, [r, g, b].map(u64::from), "{:b} of pixel {i}", masks[i]);
        }
    }

    /// A bit for each of the first pixels of a list whose samples were not shaded one by one.
    #[inline(always)]
    fn known<S: Simd>(simd: S, list: BilinearList<'_>) -> u64 {
        let mut scratch = Scratch::NEW;
        list.sums_of_some::<S, false>(simd, &mut scratch, (0, LANES)).known
    }

    #[test]
    fn what_lies_on_a_tie_is_in_doubt() {
        // Samples half a part of the finest fraction from where it is rounded to.
        let texels = (0..8_u8).map(|i| [i * 30, 255 - i * 30, 7, 255]);
        let pyramid = MipPyramid::build(MipLevel::new(8, 8, texels.cycle().take(64).collect()));
        let step = 1.0 / f64::from(1 << 18);
        let map = UvMap {
            pivot: DVec2::splat(0.125),
            uv: DVec2::splat(0.5),
            dx: DVec2::new(step, 0.0),
            dy: DVec2::new(0.0, step),
        };
        let settings = SamplingSettings {
            pixel: PixelSampling::Bilinear,
            ..SamplingSettings::default()
        };
        let filter = Filter::new(&pyramid, &map, &settings);
        let grid = SampleGrid {
            side: 4,
            origin: [0; 2],
        };
        let plan = filter.plan(grid);
        let places: Vec<[u16; 2]> = (0..16).map(|i| [i, 1]).collect();
        let inside: Vec<[u8; 2]> = (0..16).map(|i| [i % 4, i / 4]).collect();
        let list = ValueList {
            pixels: &places,
            count: 16,
            inside: &inside,
            masks: None,
            values: ByteValues::Stored,
        };
        let list = BilinearList::new(&plan, 4, list).expect("each reads four texels");
        for (name, level) in simd::available() {
            let known = dispatch!(level, simd => known(simd, list));
            assert!(known.count_ones() < 16, "{name}: {known:b}");
            let mut sums = vec![[0; 3]; places.len()];
            if list.sums(level, &mut sums) {
                for (i, sum) in sums.into_iter().enumerate() {
                    let points = list.points(i).map(|at| oracle::point(&plan, at.map(u32::from)));
                    let [r, g, b, _] = Premultiplied16::sums(&points.collect::<Vec<_>>());
                    assert_eq!(sum, [r, g, b].map(u64::from), "{name}: {i}");
                }
            }
        }
    }
}
