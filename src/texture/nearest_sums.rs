//! The sums of pixels' samples where each reads the nearest texel of one level: a fetch a sample, and little else, or a fetch for
//! each of four texels where all samples of a pixel lie in these.
//!
//! Pixels for which it is not certain which texels their samples read are read again, sample by sample.

#![expect(
    clippy::inline_always,
    reason = "a function that is not inlined into its dispatch loses the vector instructions"
)]

use fearless_simd::prelude::*;
use fearless_simd::{Simd, u8x16, u16x8, u32x4};
use glam::DVec2;

use super::bilinear::add;
use super::covered::Covered;
use super::filter_plan::{Axis, PixelList, Plan};
use super::filtered_samples::SampleKernel;
use super::fixed_point::FRACTION_BITS;
use super::nearest_counts::{Counts, FourTexels};
use super::nearest_samples::{FEW, MANY, NearestSamples, Uncertain};
use super::sample_filter::RowPairs;
use super::simd_channels::Spread;
use super::texel_coordinates::{MAX_LANES, in_texture};
use super::wrap;
use crate::color::Premultiplied16;

/// Which texels the samples of a vector of pixels read.
pub(super) struct Found<const N: usize> {
    /// For each sample the texel of each pixel.
    pub(super) texels: [[u32; MAX_LANES]; N],
}

/// The sums over the samples of pixels.
#[inline(always)]
pub(super) fn sum<S: Simd, const N: usize>(
    simd: S,
    plan: &Plan<'_>,
    samples: &NearestSamples<'_, N>,
    list: PixelList<'_>,
    sums: &mut [[u32; 4]],
) {
    let lanes = S::u32s::LEN;
    let texels = samples.level.level.texels();
    let middle = samples.middle(plan);
    let mut found = Found::NONE;
    for (i, (pixels, sums)) in list.pixels.chunks(lanes).zip(sums.chunks_mut(lanes)).enumerate() {
        let masks = list.masks.map(|masks| &masks[i * lanes..][..pixels.len()]);
        let uncertain = found.find(simd, samples, (pixels, 0), middle);
        let found_texels = &found.texels[..samples.count];
        match masks {
            None => {
                for (lane, sum) in sums.iter_mut().enumerate() {
                    sum_all(simd, texels, found_texels, lane).store_slice(sum);
                }
            }
            Some(masks) => {
                for (lane, (sum, mask)) in sums.iter_mut().zip(masks).enumerate() {
                    if N == FEW {
                        sum_masked(simd, texels, found_texels, lane, *mask).store_slice(sum);
                    } else {
                        *sum = sum_some(texels, found_texels, lane, *mask);
                    }
                }
            }
        }
        sum_uncertain(simd, (plan, samples.side), uncertain, (pixels, masks), sums);
    }
}

/// As [`sum`] where all samples of a pixel lie in four texels at most.
#[inline(always)]
pub(super) fn sum_counted<S: Simd, const N: usize>(
    simd: S,
    plan: &Plan<'_>,
    (samples, four): (&NearestSamples<'_, N>, FourTexels),
    list: PixelList<'_>,
    sums: &mut [[u32; 4]],
) {
    let lanes = S::u32s::LEN;
    let middle = samples.middle(plan);
    let count = samples.side * samples.side;
    let spread = Spread::new(simd);
    let rows = RowPairs::new(&samples.level);
    let mut counts = Counts::NONE;
    for (i, (pixels, sums)) in list.pixels.chunks(lanes).zip(sums.chunks_mut(lanes)).enumerate() {
        let masks = list.masks.map(|masks| &masks[i * lanes..][..pixels.len()]);
        let centres = samples.centres_around(simd, pixels, middle);
        counts.count(simd, (samples, four), centres, Covered::new(simd, count, masks));
        for (lane, sum) in sums.iter_mut().enumerate() {
            let columns = rows.columns(
                simd,
                spread,
                counts.firsts[lane % MAX_LANES],
                counts.in_texels[lane % MAX_LANES],
            );
            let (left, right) = columns.split();
            // A byte is stored as 256 times itself.
            ((left + right) << 8).bitcast::<u32x4<S>>().store_slice(sum);
        }
        sum_uncertain(simd, (plan, samples.side), counts.uncertain, (pixels, masks), sums);
    }
}

/// The sums of those pixels for which it was not certain where their samples lie.
#[inline(always)]
fn sum_uncertain<S: Simd>(
    simd: S,
    (plan, side): (&Plan<'_>, u32),
    uncertain: Uncertain,
    (pixels, masks): (&[[u16; 2]], Option<&[u64]>),
    sums: &mut [[u32; 4]],
) {
    for lane in uncertain.lanes(pixels.len()) {
        sums[lane] = exact_sum(simd, (plan, side), pixels[lane], masks.map(|masks| masks[lane]));
    }
}

/// The sum of a pixel's samples as they are decided one by one.
#[inline(always)]
pub(super) fn exact_sum<S: Simd>(
    simd: S,
    (plan, side): (&Plan<'_>, u32),
    pixel: [u16; 2],
    mask: Option<u64>,
) -> [u32; 4] {
    if (side * side) as usize > FEW {
        exact::<S, MANY>(simd, plan, side, pixel, mask)
    } else {
        exact::<S, FEW>(simd, plan, side, pixel, mask)
    }
}

impl<const N: usize> Found<N> {
    pub(super) const NONE: Self = Self {
        texels: [[0; MAX_LANES]; N],
    };

    /// Finds the texels of up to a vector of pixels from the one of number `first` on, which is that of their lane; `middle` is the
    /// centre of the pixel that lists are counted from. For which pixels that is uncertain, from the first one on.
    #[inline(always)]
    pub(super) fn find<S: Simd>(
        &mut self,
        simd: S,
        samples: &NearestSamples<'_, N>,
        (pixels, first): (&[[u16; 2]], usize),
        middle: DVec2,
    ) -> Uncertain {
        let pixels = &pixels[first..];
        if let Some([x, y]) = &samples.endless {
            let (at, level) = (samples.centres(simd, pixels, middle), &samples.level);
            let centres = [at.endless(simd, &level.x, x), at.endless(simd, &level.y, y)];
            self.find_around(
                simd,
                (samples, first),
                centres,
                #[inline(always)]
                |[column, row]| [in_texture(simd, x, column), in_texture(simd, y, row)],
            )
        } else {
            self.find_around(
                simd,
                (samples, first),
                samples.centres_around(simd, pixels, middle),
                #[inline(always)]
                |at| at,
            )
        }
    }

    /// The same of pixels whose centres lie there, in fixed point; `inside` says what places of samples stand for.
    #[inline(always)]
    fn find_around<S: Simd>(
        &mut self,
        simd: S,
        (samples, first): (&NearestSamples<'_, N>, usize),
        [x, y]: [S::i32s; 2],
        inside: impl Fn([S::i32s; 2]) -> [S::i32s; 2],
    ) -> Uncertain {
        let number = |value: i32| S::i32s::splat(simd, value);
        let level = &samples.level;
        let last = [level.level.width(), level.level.height()].map(|size| size.cast_signed() - 1);
        let last: S::i16s = number(last[0] | last[1] << 16).bitcast();
        let stride: S::i16s = number(1 | level.level.stride().cast_signed() << 16).bitcast();
        let fraction: S::i16s = number((1 << FRACTION_BITS) - 1).bitcast();
        let mut distance = S::i16s::splat(simd, i16::MAX);
        let count = samples.count;
        let offsets = samples.x.of_samples[..count].iter().zip(&samples.y.of_samples[..count]);
        for (texels, (right, down)) in self.texels.iter_mut().zip(offsets) {
            let (x, y) = (x + number(*right), y + number(*down));
            // The upper halves are no distances, and nobody looks at them.
            distance = distance
                .min(x.bitcast::<S::i16s>() & fraction)
                .min(y.bitcast::<S::i16s>() & fraction);
            let [x, y] = inside([x, y]);
            let (column, row) = (x >> FRACTION_BITS, y >> FRACTION_BITS << 16);
            let at: S::i16s = (column & number(0xFFFF) | row).bitcast();
            let inside = at.max(S::i16s::splat(simd, 0)).min(last);
            let offset: S::u32s = inside.pairwise_dot_product(stride).bitcast();
            offset.store_slice(&mut texels[first..first + S::u32s::LEN]);
        }
        Uncertain::new(simd, distance)
    }
}

/// The sum of the texels that all samples of a pixel read.
#[inline(always)]
fn sum_all<S: Simd>(simd: S, texels: &[[u8; 4]], found: &[[u32; MAX_LANES]], lane: usize) -> u32x4<S> {
    let texel = |found: &[u32; MAX_LANES]| u32::from_le_bytes(texels[found[lane % MAX_LANES] as usize]);
    // Of every second sample: half of 256 bytes fit 16 bits.
    let mut halves = u16x8::splat(simd, 0);
    let (fours, rest) = found.as_chunks::<4>();
    for [a, b, c, d] in fours {
        halves += every_other(simd, u32x4::simd_from(simd, [texel(a), texel(b), texel(c), texel(d)]));
    }
    let mut sums = whole(simd, halves);
    for found in rest {
        sums += whole(simd, every_other(simd, u32x4::simd_from(simd, [texel(found), 0, 0, 0])));
    }
    // A byte is stored as 256 times itself.
    sums << 8
}

/// The same of those that a mask names. All are read: to look which ones costs more.
#[inline(always)]
fn sum_masked<S: Simd>(simd: S, texels: &[[u8; 4]], found: &[[u32; MAX_LANES]], lane: usize, mask: u64) -> u32x4<S> {
    /// All bits of those of four numbers that a mask of four names.
    const NAMED: [[u32; 4]; 16] = {
        let mut named = [[0; 4]; 16];
        let mut mask = 0;
        while mask < 16 {
            let mut i = 0;
            while i < 4 {
                named[mask][i] = if mask >> i & 1 == 1 { u32::MAX } else { 0 };
                i += 1;
            }
            mask += 1;
        }
        named
    };
    let texel = |found: &[u32; MAX_LANES]| u32::from_le_bytes(texels[found[lane % MAX_LANES] as usize]);
    let (fours, rest) = found.as_chunks::<4>();
    let mut halves = u16x8::splat(simd, 0);
    let mut mask = mask;
    for [a, b, c, d] in fours {
        let named = u32x4::simd_from(simd, NAMED[(mask & 15) as usize]);
        halves += every_other(
            simd,
            u32x4::simd_from(simd, [texel(a), texel(b), texel(c), texel(d)]) & named,
        );
        mask >>= 4;
    }
    let mut sums = whole(simd, halves);
    for found in rest {
        let named = if mask & 1 == 1 { u32::MAX } else { 0 };
        sums += whole(
            simd,
            every_other(simd, u32x4::simd_from(simd, [texel(found) & named, 0, 0, 0])),
        );
        mask >>= 1;
    }
    // A byte is stored as 256 times itself.
    sums << 8
}

/// The sums of two of four texels each: those of the lower two in the lower four numbers.
#[inline(always)]
fn every_other<S: Simd>(simd: S, texels: u32x4<S>) -> u16x8<S> {
    let (bytes, zero) = (texels.bitcast::<u8x16<S>>(), u8x16::splat(simd, 0));
    bytes.zip_low(zero).bitcast::<u16x8<S>>() + bytes.zip_high(zero).bitcast::<u16x8<S>>()
}

/// The sums of the lower four numbers and the upper four.
#[inline(always)]
fn whole<S: Simd>(simd: S, halves: u16x8<S>) -> u32x4<S> {
    let zero = u16x8::splat(simd, 0);
    halves.zip_low(zero).bitcast::<u32x4<S>>() + halves.zip_high(zero).bitcast::<u32x4<S>>()
}

/// The same of those of the first 64 samples that a mask names.
#[inline(always)]
fn sum_some(texels: &[[u8; 4]], found: &[[u32; MAX_LANES]], lane: usize, mask: u64) -> [u32; 4] {
    const EVERY_OTHER: u32 = 0x00FF_00FF;
    // Two bytes in each: 64 of them fit 16 bits.
    let (mut red_blue, mut green_alpha, mut rest) = (0, 0, mask);
    while rest != 0 {
        let Some(found) = found.get(rest.trailing_zeros() as usize) else {
            break;
        };
        let texel = u32::from_le_bytes(texels[found[lane % MAX_LANES] as usize]);
        red_blue += texel & EVERY_OTHER;
        green_alpha += texel >> 8 & EVERY_OTHER;
        rest &= rest - 1;
    }
    let [low, high] = [0xFFFF, 0xFFFF_0000];
    [
        (red_blue & low) << 8,
        (green_alpha & low) << 8,
        (red_blue & high) >> 8,
        (green_alpha & high) >> 8,
    ]
}

/// The sum of a pixel's samples as they are decided one by one.
#[cold]
#[inline(never)]
fn exact<S: Simd, const N: usize>(simd: S, plan: &Plan<'_>, side: u32, pixel: [u16; 2], mask: Option<u64>) -> [u32; 4] {
    /// Fewer are found sooner by themselves.
    const VECTOR: u32 = 5;
    let samples = (0..side).flat_map(|row| (0..side).map(move |column| [column, row]));
    let masked = samples.zip(0..).filter(|(_, i)| {
        let bit = |mask: u64| mask.checked_shr(*i).unwrap_or(0) & 1;
        mask.is_none_or(|mask| bit(mask) == 1)
    });
    let inside = masked.map(|(inside, _)| inside);
    if mask.map_or(side * side, u64::count_ones) < VECTOR {
        let mut sums = [0; 4];
        for [column, row] in inside {
            add_sample(
                plan,
                [u32::from(pixel[0]) * side + column, u32::from(pixel[1]) * side + row],
                &mut sums,
            );
        }
        return sums.map(|sum: i32| sum.cast_unsigned() << 8);
    }
    let mut sums = [0; 4];
    exact_colors::<S, N>(simd, plan, (side, pixel), inside, |color| {
        for (sum, channel) in sums.iter_mut().zip(color.0) {
            *sum += u32::from(channel);
        }
    });
    sums
}

/// Adds the texel of the sample in that column and row of the list's.
fn add_sample(plan: &Plan<'_>, sample: [u32; 2], sums: &mut [i32; 4]) {
    let level = &plan.finer;
    let from_pivot = plan.first + DVec2::from_array(sample.map(f64::from));
    let at = |axis: &Axis| {
        let texels = (axis.at_pivot + from_pivot.x * axis.right) + from_pivot.y * axis.down;
        wrap::place(axis.last, (plan.wrap, plan.pixel), texels, None)
    };
    let at = [at(&level.x), at(&level.y)];
    add(level.level, (plan.pixel, plan.wrap), at, 1, sums);
}

/// Calls `each` with the colours of samples that lie there in a pixel, at most `N`, as they are decided one by one.
#[inline(always)]
pub(super) fn exact_colors<S: Simd, const N: usize>(
    simd: S,
    plan: &Plan<'_>,
    (side, pixel): (u32, [u16; 2]),
    inside: impl Iterator<Item = [u32; 2]>,
    each: impl FnMut(Premultiplied16),
) {
    let (mut points, mut colors) = ([[0; 2]; N], [Premultiplied16::TRANSPARENT; N]);
    let mut count = 0;
    for (point, inside) in points.iter_mut().zip(inside) {
        let sample = |axis: usize| u32::from(pixel[axis]) * side + inside[axis];
        *point = [0, 1].map(|axis| u16::try_from(sample(axis)).unwrap_or(u16::MAX));
        count += 1;
    }
    let (points, colors) = (&points[..count], &mut colors[..count]);
    SampleKernel::new(plan).filter(simd.level(), points, colors);
    colors.iter().copied().for_each(each);
}
