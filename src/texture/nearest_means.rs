//! Pixels that are means of samples, each of which reads the nearest texel of one level, without a sum for each of them.
//!
//! The samples of sixteen pixels are added up side by side, two channels of a pixel in each lane; sums of bytes fit 16 bits:
//!
//! ```text
//!     texel of each lane    a b g r  ->  . b . r  and  . a . g        then   . B . R  and  . A . G  ->  A R G B
//! ```

#![expect(
    clippy::inline_always,
    reason = "a function that is not inlined into its dispatch loses the vector instructions"
)]

use fearless_simd::prelude::*;
use fearless_simd::{Simd, u32x4, u32x16};

use super::filter_plan::Plan;
use super::nearest_samples::NearestSamples;
use super::nearest_sums::{Found, exact_sum};
use super::texel_coordinates::MAX_LANES;
use crate::color::Resolver;
use crate::simd::put_lanes;

/// Every other byte.
const EVERY_OTHER: u32 = 0x00FF_00FF;

/// Means of as many bytes as a pixel has samples.
#[derive(Clone, Copy, Debug)]
pub(super) struct ByteMean<'r> {
    resolver: &'r Resolver,
    /// What is added to a sum before it is shifted.
    half: u32,
    shift: u32,
}

impl<'r> ByteMean<'r> {
    /// As a resolver finds them; `None` where it does not shift.
    pub(super) fn new(resolver: &'r Resolver) -> Option<Self> {
        // A byte is stored as 256 times itself.
        Some(Self {
            resolver,
            half: resolver.half() >> 8,
            shift: resolver.shift()?.checked_sub(8)?,
        })
    }

    /// Pixels `0xAARRGGBB`, of sums of red and blue, and of green and alpha, the former in the lower 16 bits of each.
    #[inline(always)]
    fn pixels<S: Simd>(self, simd: S, red_blue: u32x16<S>, green_alpha: u32x16<S>) -> u32x16<S> {
        let half = u32x16::splat(simd, self.half | self.half << 16);
        let red_blue = (red_blue + half) >> self.shift & EVERY_OTHER;
        let green_alpha = (green_alpha + half) >> self.shift & EVERY_OTHER;
        red_blue << 16 | red_blue >> 16 | green_alpha << 8
    }
}

/// The pixels of a list that are opaque, one after the other.
#[inline(always)]
pub(super) fn means<S: Simd, const N: usize>(
    simd: S,
    (plan, samples): (&Plan<'_>, &NearestSamples<'_, N>),
    mean: ByteMean<'_>,
    pixels: &[[u16; 2]],
    values: &mut [u32],
) {
    let middle = samples.middle(plan);
    let texels = samples.level.level.texels();
    let mut found = Found::<N>::NONE;
    let last = pixels.len().saturating_sub(MAX_LANES);
    for first in (0..pixels.len()).step_by(MAX_LANES) {
        // The last ones are found together with some before them, once more: so all loops are as long as vectors.
        let first = first.min(last);
        let (pixels, values) = (&pixels[first..], &mut values[first..]);
        let count = pixels.len().min(MAX_LANES);
        let (pixels, values) = (&pixels[..count], &mut values[..count]);
        let mut uncertain = found.find(simd, samples, (pixels, 0), middle);
        for first in (0..pixels.len()).step_by(S::u32s::LEN).skip(1) {
            uncertain |= found.find(simd, samples, (pixels, first), middle).from(first);
        }
        let mut red_blue = u32x16::splat(simd, 0);
        let mut green_alpha = u32x16::splat(simd, 0);
        for found in &found.texels[..samples.count] {
            let texels = read(simd, texels, found);
            red_blue += texels & EVERY_OTHER;
            green_alpha += texels >> 8 & EVERY_OTHER;
        }
        let means = mean.pixels(simd, red_blue, green_alpha);
        put_lanes(means, values);
        for lane in uncertain.lanes(pixels.len()) {
            values[lane] = mean
                .resolver
                .pixel(exact_sum(simd, (plan, samples.side), pixels[lane], None));
        }
    }
}

/// The texel of each lane.
#[inline(always)]
pub(super) fn read<S: Simd>(simd: S, texels: &[[u8; 4]], found: &[u32; MAX_LANES]) -> u32x16<S> {
    let (fours, _) = found.as_chunks::<4>();
    let low = read_four(simd, texels, fours[0]).combine(read_four(simd, texels, fours[1]));
    let high = read_four(simd, texels, fours[2]).combine(read_four(simd, texels, fours[3]));
    low.combine(high)
}

#[inline(always)]
fn read_four<S: Simd>(simd: S, texels: &[[u8; 4]], found: [u32; 4]) -> u32x4<S> {
    let [a, b, c, d] = found;
    // No map: it would be a call for each.
    let texel = |at: u32| u32::from_le_bytes(texels[at as usize]);
    u32x4::simd_from(simd, [texel(a), texel(b), texel(c), texel(d)])
}

#[cfg(test)]
mod tests {
    use super::super::filter_plan::PixelList;
    use super::super::{Filter, MipLevel, MipPyramid, PixelSampling, PixelWork, SamplingSettings, oracle};
    use super::*;
    use crate::rules::Rules;
    use crate::simd;

    #[test]
    fn means_are_those_of_the_sums_on_every_level() {
        let (mut short, mut all) = (0, 0);
        arbtest::arbtest(|u| {
            let texels = (0..19 * 23).map(|i: u32| [i.to_le_bytes()[0], u.arbitrary().unwrap_or(0), 7, 255]);
            let base = MipLevel::new(19, 23, texels.collect());
            let pyramid = MipPyramid::build(base);
            let map = oracle::map(u, &pyramid.levels()[0])?;
            let mut grid = oracle::grid(u, &map)?;
            grid.side = *u.choose(&[1, 2, 4, 8, 16, 3])?;
            let settings = SamplingSettings {
                pixel: PixelSampling::Nearest,
                ..oracle::settings(u)?
            };
            let filter = Filter::new(&pyramid, &map, &settings);
            let count = u.int_in_range(0..=40)?;
            let mut pixel = || Ok([u.int_in_range(0..=70)?, u.int_in_range(0..=70)?]);
            let pixels: Vec<[u16; 2]> = (0..count).map(|_| pixel()).collect::<arbtest::arbitrary::Result<_>>()?;
            let resolver = Resolver::new(grid.side * grid.side, *u.choose(&Rules::ALL)?);
            let (whole, parts) = pixels.split_at(u.int_in_range(0..=count)?);
            let masks = vec![u.arbitrary()?; parts.len()];
            let list = |pixels, masks| PixelList { pixels, masks };
            let lists = [list(whole, None), list(parts, (grid.side <= 8).then_some(&masks[..]))];
            for (name, level) in simd::tested() {
                let mut values = vec![0; whole.len()];
                let [mut first, mut second] = [whole, parts].map(|pixels| vec![[0; 4]; pixels.len()]);
                let work = PixelWork {
                    lists,
                    sums: [&mut first, &mut second],
                    means: Some((&resolver, &mut values)),
                };
                let are_means = filter.sums_or_means(level, grid, work);
                all += 1;
                short += u32::from(are_means);
                let sums_of = |list: PixelList<'_>| {
                    let mut sums = vec![[0; 4]; list.pixels.len()];
                    filter.sums(level, grid, list, &mut sums);
                    sums
                };
                let [whole, parts] = lists.map(sums_of);
                let told = || format!("{name}: {filter:?} {resolver:?}");
                if are_means {
                    let expected: Vec<u32> = whole.iter().map(|sum| resolver.pixel(*sum)).collect();
                    assert_eq!(values, expected, "{}", told());
                } else {
                    assert_eq!(first, whole, "{}", told());
                }
                assert_eq!(second, parts, "{}", told());
            }
            Ok(())
        })
        .budget_ms(if cfg!(feature = "scalar") { 3000 } else { 600 });
        assert!(short * 10 > all, "{short} of {all} had a short way");
    }
}
