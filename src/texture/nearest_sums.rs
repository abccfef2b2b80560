//! The sums of pixels' samples where each reads the nearest texel of one level: a fetch a sample, and little else.
//!
//! A pixel's samples stand around its centre as those of every other pixel do. So the centre is placed in the level once, in
//! fixed point, and a sample's texel takes two additions and two shifts:
//!
//! ```text
//!     texel k-1 |      texel k      | texel k+1       # a sample's place, as the sum of two rounded numbers
//!               |~  #           #  ~|                 ~ so close to an edge that rounding might have carried it across
//! ```
//!
//! Where a texture is repeated or mirrored, the centre is brought into the first period and the samples' distances into the one
//! before it: so their sum is less than a period outside of the first one.
//!
//! `wrap::place` decides what a sample reads. Sums of rounded numbers may differ from it by a little more than one
//! unit: pixels with a sample so close to the edge of a texel are read again by that very function, sample by sample.

#![expect(
    clippy::inline_always,
    reason = "a function that is not inlined into its dispatch loses the vector instructions"
)]

use fearless_simd::prelude::*;
use fearless_simd::{Simd, u8x16, u16x8, u32x4};
use glam::DVec2;

use super::PixelSampling;
use super::bilinear::add;
use super::covered::Covered;
use super::filter_plan::{Axis, GridLevel, PixelList, Plan};
use super::fixed_point::FRACTION_BITS;
use super::nearest_counts::{Counts, FourTexels};
use super::sample_filter::RowPairs;
use super::simd_channels::Spread;
use super::texel_coordinates::{MAX_LANES, Positions, columns_and_rows, in_texture};
use super::wrap::{self, Endless};
use super::{block_filter, sample_filter};
use crate::color::Premultiplied16;

/// Samples of a pixel that take little memory, and as many as there may be.
pub(super) const FEW: usize = 16;
pub(super) const MANY: usize = 256;
/// Where samples lie is known to less than half of this: three numbers are rounded by half a unit each.
pub(super) const UNCERTAIN: i32 = 4;
/// How far samples may lie from their pixel's centre, in texels: with the largest level on one side of them, columns and rows
/// fit 16 bits.
pub(super) const FARTHEST: f64 = 8000.0;
/// Centres outside a level are brought so near that all samples stay this far from it, in texels. One would do; no simple fraction
/// leaves samples on the edges of texels, where each would be read again by itself.
pub(super) const AWAY: f64 = 1.381_966;
/// Coordinates below this are exact to far less than a unit, however large the numbers that they are sums of.
pub(super) const LARGEST: f64 = (1_u64 << 30) as f64;
/// No list reaches further from the pixel that it is counted from, in samples.
pub(super) const LIST: f64 = (1_u32 << 20) as f64;

/// Where the samples of every pixel lie.
#[derive(Debug)]
pub(super) struct NearestSamples<'a, const N: usize> {
    pub(super) level: GridLevel<'a>,
    side: u32,
    pub(super) count: usize,
    pub(super) x: Offsets<N>,
    pub(super) y: Offsets<N>,
    /// Both axes, where they go on for ever.
    pub(super) endless: Option<[Endless; 2]>,
}

/// The same on one axis.
#[derive(Debug)]
pub(super) struct Offsets<const N: usize> {
    /// From the pixel's centre, in fixed point, and half of [`UNCERTAIN`] more: so what is uncertain lies just behind the edge
    /// of a texel. On an axis that goes on for ever, brought into the period before it.
    pub(super) of_samples: [i32; N],
    /// Centres that far outside the level have no sample in it, in texels.
    pub(super) reach: f64,
}

/// Which texels the samples of a vector of pixels read.
pub(super) struct Found<const N: usize> {
    /// For each sample the texel of each pixel.
    pub(super) texels: [[u32; MAX_LANES]; N],
    pub(super) uncertain: Uncertain,
}

/// The pixels of a vector of which a sample may lie in another texel than the one that was found: a bit for each.
#[derive(Clone, Copy, Debug)]
pub(super) struct Uncertain(u64);

impl<'a, const N: usize> NearestSamples<'a, N> {
    /// For a plan that reads the nearest texel of one level, at all samples of a grid; `None` where it does not, or numbers are too
    /// large.
    pub(super) fn new(plan: &Plan<'a>, side: u32) -> Option<Self> {
        Self::at(plan, side, (side * side) as usize, |axis| Offsets::of_grid(axis, side))
    }

    /// As [`NearestSamples::new`], at samples that lie there in a pixel of `side` columns and rows.
    pub(super) fn of_places(plan: &Plan<'a>, side: u32, places: &[[u8; 2]]) -> Option<Self> {
        Self::at(plan, side, places.len(), |axis| Offsets::of_places(axis, side, places))
    }

    fn at(plan: &Plan<'a>, side: u32, count: usize, offsets: impl Fn(&Axis) -> Option<Offsets<N>>) -> Option<Self> {
        let is_one = plan.pixel == PixelSampling::Nearest && plan.coarser.is_none() && plan.line.taps.count == 1;
        if !is_one || count > N {
            return None;
        }
        let offsets = |axis: &Axis| {
            let farthest = plan.first.abs() + LIST;
            let largest = axis.at_pivot.abs() + farthest.x * axis.right.abs() + farthest.y * axis.down.abs();
            offsets(axis).filter(|offsets| largest < LARGEST && offsets.reach < FARTHEST)
        };
        let mut samples = Self {
            x: offsets(&plan.finer.x)?,
            y: offsets(&plan.finer.y)?,
            endless: None,
            level: plan.finer,
            side,
            count,
        };
        if let Some((x, y)) = plan.endless(&plan.finer.x).zip(plan.endless(&plan.finer.y)) {
            samples.x.bring_before(&x);
            samples.y.bring_before(&y);
            samples.endless = Some([x, y]);
        }
        Some(samples)
    }

    /// Where the centres of up to a vector of pixels lie; `middle` is that of the pixel that lists are counted from.
    #[inline(always)]
    pub(super) fn centres<S: Simd>(&self, simd: S, pixels: &[[u16; 2]], middle: DVec2) -> Positions<S> {
        let side = S::f32s::splat(simd, self.side as f32);
        let [columns, rows] = columns_and_rows(simd, pixels);
        Positions::new(simd, [columns * side, rows * side], middle)
    }

    /// Where the centres of up to a vector of pixels lie in the level or around it, in fixed point.
    #[inline(always)]
    pub(super) fn centres_around<S: Simd>(&self, simd: S, pixels: &[[u16; 2]], middle: DVec2) -> [S::i32s; 2] {
        let at = self.centres(simd, pixels, middle);
        [
            at.around(simd, &self.level.x, self.x.reach),
            at.around(simd, &self.level.y, self.y.reach),
        ]
    }

    /// The centre of the pixel that lists are counted from, in samples from the pivot.
    pub(super) fn middle(&self, plan: &Plan<'_>) -> DVec2 {
        plan.first + f64::from(self.side - 1) / 2.0
    }
}

impl<const N: usize> Offsets<N> {
    /// Of all samples of a grid.
    fn of_grid(axis: &Axis, side: u32) -> Option<Self> {
        let middle = f64::from(side - 1) / 2.0;
        let mut of_samples = [0; N];
        for (j, row) in of_samples
            .chunks_exact_mut(side as usize)
            .take(side as usize)
            .enumerate()
        {
            let down = (j as f64 - middle) * axis.down;
            for (i, offset) in row.iter_mut().enumerate() {
                *offset = to_units(down + (i as f64 - middle) * axis.right) + UNCERTAIN / 2;
            }
        }
        Self::within(axis, side, of_samples)
    }

    /// Of samples that lie there in a pixel.
    fn of_places(axis: &Axis, side: u32, places: &[[u8; 2]]) -> Option<Self> {
        let middle = f64::from(side - 1) / 2.0;
        let mut of_samples = [0; N];
        for (offset, [column, row]) in of_samples.iter_mut().zip(places) {
            let down = (f64::from(*row) - middle) * axis.down;
            *offset = to_units(down + (f64::from(*column) - middle) * axis.right) + UNCERTAIN / 2;
        }
        Self::within(axis, side, of_samples)
    }

    fn within(axis: &Axis, side: u32, of_samples: [i32; N]) -> Option<Self> {
        let reach = (axis.right.abs() + axis.down.abs()) * (f64::from(side - 1) / 2.0) + AWAY;
        reach.is_finite().then_some(Self { of_samples, reach })
    }

    /// How far samples lie apart, in texels; those of a few places less.
    pub(super) fn spread(&self) -> f64 {
        2.0 * (self.reach - AWAY)
    }

    /// Brings samples into the period before the first one, on an axis that goes on for ever.
    fn bring_before(&mut self, endless: &Endless) {
        for offset in &mut self.of_samples {
            *offset = endless.before(*offset);
        }
    }
}

/// A distance in texels in fixed point, rounded to nearest; by adding, because rounding is a call on some machines.
#[expect(
    clippy::cast_possible_truncation,
    reason = "the fixed-point number is in the lower half"
)]
fn to_units(texels: f64) -> i32 {
    const WHOLE: f64 = 1.5 * (1_u64 << (52 - FRACTION_BITS)) as f64;
    (texels + WHOLE).to_bits() as i32
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
        found.find(simd, samples, pixels, middle);
        let found_texels = &found.texels[..samples.count];
        match masks {
            None => {
                for (lane, sum) in sums.iter_mut().enumerate() {
                    sum_all(simd, texels, found_texels, lane).store_slice(sum);
                }
            }
            Some(masks) => {
                for (lane, (sum, mask)) in sums.iter_mut().zip(masks).enumerate() {
                    *sum = sum_some(texels, found_texels, lane, *mask);
                }
            }
        }
        sum_uncertain(simd, (plan, samples.side), found.uncertain, (pixels, masks), sums);
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
        let mask = masks.map(|masks| masks[lane]);
        sums[lane] = if (side * side) as usize > FEW {
            exact::<S, MANY>(simd, plan, side, pixels[lane], mask)
        } else {
            exact::<S, FEW>(simd, plan, side, pixels[lane], mask)
        };
    }
}

impl Uncertain {
    pub(super) const NONE: Self = Self(0);

    /// Of pixels whose samples are so far from the edges of their texels, as they were found, at least: in the lower half of
    /// each lane.
    #[inline(always)]
    pub(super) fn new<S: Simd>(simd: S, distance: S::i16s) -> Self {
        let distance = distance.bitcast::<S::i32s>() & S::i32s::splat(simd, 0xFFFF);
        Self(distance.simd_lt(S::i32s::splat(simd, UNCERTAIN)).to_bitmask())
    }

    /// The lanes of these pixels, of the first `count`.
    #[inline(always)]
    pub(super) fn lanes(self, count: usize) -> impl Iterator<Item = usize> {
        let mut rest = self.0 & ((1 << count) - 1);
        std::iter::from_fn(move || {
            let lane = rest.trailing_zeros();
            rest &= rest.wrapping_sub(1);
            (lane < u64::BITS).then_some(lane as usize)
        })
    }
}

impl<const N: usize> Found<N> {
    pub(super) const NONE: Self = Self {
        texels: [[0; MAX_LANES]; N],
        uncertain: Uncertain::NONE,
    };

    /// Finds the texels of up to a vector of pixels; `middle` is the centre of the pixel that lists are counted from.
    #[inline(always)]
    pub(super) fn find<S: Simd>(
        &mut self,
        simd: S,
        samples: &NearestSamples<'_, N>,
        pixels: &[[u16; 2]],
        middle: DVec2,
    ) {
        if let Some([x, y]) = &samples.endless {
            let (at, level) = (samples.centres(simd, pixels, middle), &samples.level);
            let centres = [at.endless(simd, &level.x, x), at.endless(simd, &level.y, y)];
            self.find_around(
                simd,
                samples,
                centres,
                #[inline(always)]
                |[column, row]| [in_texture(simd, x, column), in_texture(simd, y, row)],
            );
        } else {
            self.find_around(
                simd,
                samples,
                samples.centres_around(simd, pixels, middle),
                #[inline(always)]
                |at| at,
            );
        }
    }

    /// The same of pixels whose centres lie there, in fixed point; `inside` says what places of samples stand for.
    #[inline(always)]
    fn find_around<S: Simd>(
        &mut self,
        simd: S,
        samples: &NearestSamples<'_, N>,
        [x, y]: [S::i32s; 2],
        inside: impl Fn([S::i32s; 2]) -> [S::i32s; 2],
    ) {
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
            offset.store_slice(&mut texels[..S::u32s::LEN]);
        }
        self.uncertain = Uncertain::new(simd, distance);
    }
}

/// The sum of the texels that all samples of a pixel read.
#[inline(always)]
fn sum_all<S: Simd>(simd: S, texels: &[[u8; 4]], found: &[[u32; MAX_LANES]], lane: usize) -> u32x4<S> {
    let texel = |found: &[u32; MAX_LANES]| u32::from_le_bytes(texels[found[lane % MAX_LANES] as usize]);
    let zero = u8x16::splat(simd, 0);
    let widened = |texels: [u32; 4]| {
        let bytes: u8x16<S> = u32x4::simd_from(simd, texels).bitcast();
        bytes.zip_low(zero).bitcast::<u16x8<S>>() + bytes.zip_high(zero).bitcast::<u16x8<S>>()
    };
    // Of every second sample: half of 256 bytes fit 16 bits.
    let mut halves = u16x8::splat(simd, 0);
    let (fours, rest) = found.as_chunks::<4>();
    for [a, b, c, d] in fours {
        halves += widened([texel(a), texel(b), texel(c), texel(d)]);
    }
    let mut sums = whole(simd, halves);
    for found in rest {
        sums += whole(simd, widened([texel(found), 0, 0, 0]));
    }
    // A byte is stored as 256 times itself.
    sums << 8
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
    simd.vectorize(
        #[inline(always)]
        || match plan.block() {
            Some(weights) => block_filter::filter_with(simd, plan, &weights, points, colors),
            None => sample_filter::filter_with(simd, plan, points, colors),
        },
    );
    colors.iter().copied().for_each(each);
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Else every pixel beyond the border would be read sample by sample: nine times as long.
    #[test]
    fn pixels_far_outside_a_level_are_certain() {
        const ONE: i32 = 1 << FRACTION_BITS;
        for (right, down) in [(0.25, 0.0), (0.0, -0.7), (0.3, 0.3), (1.0, 0.5), (-2.0, 1.25)] {
            let axis = Axis {
                at_pivot: 0.0,
                right,
                down,
                last: 63.0,
            };
            for side in [2, 3, 4] {
                let offsets = Offsets::<FEW>::of_grid(&axis, side).expect("not too far");
                for centre in [-offsets.reach, axis.last + offsets.reach] {
                    let places = offsets.of_samples[..(side * side) as usize].iter();
                    let least = places.map(|offset| (to_units(centre) + offset) & (ONE - 1)).min();
                    assert!(least >= Some(UNCERTAIN), "{right}, {down} at {side}: {least:?}");
                }
            }
        }
    }
}
