//! Pixels that are means of the light of samples, each of which reads the nearest texel of one level, or four texels at most for
//! all samples of a pixel.
//!
//! Sixteen pixels stand side by side as in `nearest_means`, and the light of their texels is found as near as that tells nearly
//! every pixel ([`NearLight`]). What that leaves open is summed up texel by texel, and where it is not certain which texels samples
//! read, these are decided one by one.

#![expect(
    clippy::inline_always,
    reason = "a function that is not inlined into its dispatch loses the vector instructions"
)]

use fearless_simd::prelude::*;
use fearless_simd::{Level, Simd, dispatch, f32x16, i32x16, u32x16, u64x8};

use super::covered::Covered;
use super::filter_plan::Plan;
use super::nearest_counts::{Counts, FourTexels};
use super::nearest_means::read;
use super::nearest_samples::{FEW, MANY, NearestSamples, Uncertain, ones};
use super::nearest_sums::Found;
use super::nearest_values::{ValueList, add, exact};
use super::texel_coordinates::MAX_LANES;
use crate::color::{LightResolver, NearLight, near_light};
use crate::simd::put_lanes;

/// The opaque pixels of a list without masks, whose samples lie in the same places in all; `false` where other texels than the
/// nearest are read.
pub(super) fn pixels(
    level: Level,
    (plan, side): (&Plan<'_>, u32),
    (list, resolver): (ValueList<'_>, &LightResolver),
    pixels: &mut [u32],
) -> bool {
    if list.inside.len() > FEW {
        pixels_of::<MANY>(level, (plan, side), (list, resolver), pixels)
    } else {
        pixels_of::<FEW>(level, (plan, side), (list, resolver), pixels)
    }
}

// Not inlined: its memory is not for lists that do not need it.
#[inline(never)]
fn pixels_of<const N: usize>(
    level: Level,
    (plan, side): (&Plan<'_>, u32),
    (list, resolver): (ValueList<'_>, &LightResolver),
    pixels: &mut [u32],
) -> bool {
    let Some(samples) = NearestSamples::<N>::of_places(plan, side, list.inside) else {
        return false;
    };
    let work = LightWork {
        plan,
        samples: &samples,
        list,
        near: NearLight::new(resolver),
    };
    match FourTexels::of(&samples) {
        Some(four) => dispatch!(level, simd => work.pixels_counted(simd, four, pixels)),
        None => dispatch!(level, simd => work.pixels_of_each(simd, pixels)),
    }
    true
}

/// The pixels of one triangle that are wanted.
struct LightWork<'w, const N: usize> {
    plan: &'w Plan<'w>,
    samples: &'w NearestSamples<'w, N>,
    list: ValueList<'w>,
    near: NearLight<'w>,
}

impl<const N: usize> LightWork<'_, N> {
    /// By reading the texel of each sample.
    #[inline(always)]
    fn pixels_of_each<S: Simd>(&self, simd: S, pixels: &mut [u32]) {
        let middle = self.samples.middle(self.plan);
        let texels = self.samples.level.level.texels();
        let mut found = Found::<N>::NONE;
        for (places, pixels) in self.list.pixels.chunks(MAX_LANES).zip(pixels.chunks_mut(MAX_LANES)) {
            let mut uncertain = Uncertain::NONE;
            for first in (0..places.len()).step_by(S::u32s::LEN) {
                uncertain |= found.find(simd, self.samples, (places, first), middle).from(first);
            }
            let found = &found.texels[..self.samples.count];
            let mut sums = [f32x16::splat(simd, 0.0); 3];
            for found in found {
                add_light(simd, &mut sums, read(simd, texels, found), None);
            }
            let of_lane = |lane: usize| {
                let mut sum = [0; 3];
                for found in found {
                    add(&mut sum, texels[found[lane % MAX_LANES] as usize], 1, self.list.values);
                }
                sum
            };
            self.put(simd, (places, uncertain), (sums, of_lane), pixels);
        }
    }

    /// By counting in which texels samples lie.
    #[inline(always)]
    fn pixels_counted<S: Simd>(&self, simd: S, four: FourTexels, pixels: &mut [u32]) {
        let middle = self.samples.middle(self.plan);
        let (texels, stride) = (self.samples.level.level.texels(), self.samples.level.level.stride());
        let steps = [0, stride, 1, stride + 1];
        let count = u32::try_from(self.samples.count).unwrap_or(u32::MAX);
        let mut found = Counts::NONE;
        for (places, pixels) in self.list.pixels.chunks(MAX_LANES).zip(pixels.chunks_mut(MAX_LANES)) {
            let (mut firsts, mut in_texels) = ([0; MAX_LANES], [0; MAX_LANES]);
            let mut uncertain = Uncertain::NONE;
            for first in (0..places.len()).step_by(S::u32s::LEN) {
                let centres = self.samples.centres_around(simd, &places[first..], middle);
                found.count(simd, (self.samples, four), centres, Covered::new(simd, count, None));
                firsts[first..][..S::u32s::LEN].copy_from_slice(&found.firsts[..S::u32s::LEN]);
                in_texels[first..][..S::u32s::LEN].copy_from_slice(&found.in_texels[..S::u32s::LEN]);
                uncertain |= found.uncertain.from(first);
            }
            let mut sums = [f32x16::splat(simd, 0.0); 3];
            for (step, counts) in steps.into_iter().zip(by_texel(simd, &in_texels)) {
                let mut at = [0; MAX_LANES];
                for (at, first) in at.iter_mut().zip(firsts) {
                    *at = first + step;
                }
                add_light(simd, &mut sums, read(simd, texels, &at), Some(counts));
            }
            let of_lane = |lane: usize| {
                let mut sum = [0; 3];
                for (step, shift) in steps.into_iter().zip([0, 16, 32, 48]) {
                    let count = in_texels[lane % MAX_LANES] >> shift & 0xFFFF;
                    let texel = texels[(firsts[lane % MAX_LANES] + step) as usize];
                    add(&mut sum, texel, count, self.list.values);
                }
                sum
            };
            self.put(simd, (places, uncertain), (sums, of_lane), pixels);
        }
    }

    /// Puts the pixels of sums of light, as far as they are certain; `of_lane` sums up the others.
    #[inline(always)]
    fn put<S: Simd>(
        &self,
        simd: S,
        (places, uncertain): (&[[u16; 2]], Uncertain),
        (sums, of_lane): ([f32x16<S>; 3], impl Fn(usize) -> [u64; 3]),
        pixels: &mut [u32],
    ) {
        let (found, certain) = self.near.pixels(simd, sums);
        put_lanes(found, pixels);
        for lane in ones(!certain & ((1 << pixels.len()) - 1)) {
            pixels[lane] = self.near.resolver().opaque_pixel(of_lane(lane));
        }
        for lane in uncertain.lanes(pixels.len()) {
            let all = (self.list.inside, None, self.list.values);
            let sum = exact::<S, N>(simd, (self.plan, self.samples.side), places[lane], all);
            pixels[lane] = self.near.resolver().opaque_pixel(sum);
        }
    }
}

/// Adds the light of red, green and blue of the texel of each lane, as often as counts say.
#[inline(always)]
fn add_light<S: Simd>(simd: S, sums: &mut [f32x16<S>; 3], texels: u32x16<S>, counts: Option<f32x16<S>>) {
    let mut rest = texels;
    for sum in sums {
        let light = near_light(simd, number(rest & 0xFF));
        *sum += match counts {
            Some(counts) => light * counts,
            None => light,
        };
        rest >>= 8;
    }
}

/// Small numbers.
#[inline(always)]
fn number<S: Simd>(numbers: u32x16<S>) -> f32x16<S> {
    numbers.bitcast::<i32x16<S>>().to_float()
}

/// The counts of [`Counts::in_texels`] of sixteen pixels, texel by texel.
#[inline(always)]
fn by_texel<S: Simd>(simd: S, in_texels: &[u64; MAX_LANES]) -> [f32x16<S>; 4] {
    let (low, high) = in_texels.split_at(MAX_LANES / 2);
    let low: u32x16<S> = u64x8::from_slice(simd, low).bitcast();
    let high: u32x16<S> = u64x8::from_slice(simd, high).bitcast();
    let (left, right) = (low.unzip_low(high), low.unzip_high(high));
    [
        number(left & 0xFFFF),
        number(left >> 16),
        number(right & 0xFFFF),
        number(right >> 16),
    ]
}

#[cfg(test)]
mod tests {
    use arbtest::arbitrary::Result;

    use super::super::nearest_values::ByteValues;
    use super::super::{MipLevel, MipPyramid, SampleGrid, oracle};
    use super::*;
    use crate::rules::Rules;
    use crate::simd;

    #[test]
    fn pixels_are_those_of_the_light_of_each_sample() {
        let (mut few, mut other) = (0, 0);
        arbtest::arbtest(|u| {
            let dark = u.int_in_range(0..=7)?;
            let mut texel = |_| Ok([u.arbitrary::<u8>()? >> dark, u.arbitrary()?, 7, 255]);
            let texels = (0..19 * 23).map(&mut texel).collect::<Result<Vec<_>>>()?;
            let pyramid = MipPyramid::build(MipLevel::new(19, 23, texels));
            let mut map = oracle::map(u, &pyramid.levels()[0])?;
            let grid = SampleGrid {
                side: *u.choose(&[1, 2, 3, 4, 16])?,
                origin: [u.int_in_range(-40..=40)?, u.int_in_range(-40..=40)?],
            };
            if u.arbitrary()? {
                (map.dx, map.dy) = (map.dx / 50.0, map.dy / 50.0);
            }
            let filter = oracle::nearest(u, &pyramid, &map)?;
            let plan = filter.plan(grid);
            let most = u8::try_from(grid.side - 1).expect("a byte");
            let mut at = || u.int_in_range(0..=most);
            let count = grid.side * grid.side;
            let inside = (0..count).map(|_| Ok([at()?, at()?])).collect::<Result<Vec<_>>>()?;
            let mut pixel = || Ok([u.int_in_range(0..=70)?, u.int_in_range(0..=70)?]);
            let places: Vec<[u16; 2]> = (0..37).map(|_| pixel()).collect::<Result<_>>()?;
            let list = ValueList {
                pixels: &places,
                count: inside.len(),
                masks: None,
                inside: &inside,
                values: ByteValues::Table(LightResolver::of_bytes()),
            };
            let resolver = LightResolver::new(count, Rules::Standard);
            let sums = oracle::value_sums(&plan, grid.side, list);
            let expected: Vec<u32> = sums.into_iter().map(|sum| resolver.opaque_pixel(sum)).collect();
            for (name, level) in simd::tested() {
                let mut found = vec![0; places.len()];
                if !pixels(level, (&plan, grid.side), (list, &resolver), &mut found) {
                    return Ok(());
                }
                assert_eq!(found, expected, "{name}: {filter:?} {grid:?} {inside:?}");
            }
            let samples = NearestSamples::<MANY>::of_places(&plan, grid.side, &inside);
            let counted = samples.and_then(|samples| FourTexels::of(&samples));
            *(if counted.is_some() { &mut few } else { &mut other }) += 1;
            Ok(())
        })
        .budget_ms(if cfg!(feature = "scalar") { 8000 } else { 1500 });
        assert!(few > 20 && other > 20, "both ways were taken: {few} and {other}");
    }
}
