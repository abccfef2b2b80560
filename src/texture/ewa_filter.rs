//! The elliptical weighted average at samples. The samples of a pixel have ellipses alike that lie close together: the texels
//! under any of them are looked at once, four of a row at a time, and weighed for sixteen samples.
//!
//! What a sample gets does not depend on those beside it. Places are whole multiples of a small part of a texel, so that all
//! distances are exact, whatever they are counted from; a texel beyond its rim weighs nothing, and adds nothing.

#![expect(
    clippy::inline_always,
    reason = "a function that is not inlined into its dispatch loses the vector instructions"
)]

use fearless_simd::prelude::*;
use fearless_simd::{Level, Simd, dispatch, f32x16, i32x8, u8x16, u32x8};
use glam::DVec2;

use super::ellipse::{Quadratic, SERIES, weight};
use super::filter_plan::{PixelList, Plan};
use super::fixed_point::REACH;
use super::sample_places::{LANES, PixelPlaces, Places, whole, whole_sum};
use super::{MipLevel, Wrap};
use crate::color::Premultiplied16;

/// Parts of a texel that places are rounded to. With them and a few hundred texels, 32-bit floats are exact.
const PARTS: f64 = 1024.0;
/// Adding this to a 32-bit float that is smaller rounds it to a whole number.
const ROUNDING: f32 = 8_388_608.0;
/// Texels of a row that are looked at together. Those beyond the ellipses weigh nothing.
const BLOCK: usize = 4;

type Lanes = [f32; LANES];

/// A level read by an ellipse.
#[derive(Clone, Copy, Debug)]
pub(super) struct EwaFilter<'a> {
    pub(super) level: &'a MipLevel,
    pub(super) wrap: Wrap,
    /// That of the ellipse.
    pub(super) quadratic: Quadratic,
    /// Whether all texels are opaque.
    pub(super) is_opaque: bool,
}

/// Some samples, in texels from a texel near them. The last ones are the first one again where there are fewer than lanes.
struct Samples {
    base: [i32; 2],
    x: Lanes,
    y: Lanes,
    /// A point amid them, and how many times as large an ellipse about it must be to hold those of all.
    middle: [f32; 2],
    reach: f32,
}

impl EwaFilter<'_> {
    /// The colours at some points, up to [`LANES`], in texels; whole coordinates are centres.
    pub(super) fn colors(&self, simd: Level, places: &Places, out: &mut [Premultiplied16]) {
        dispatch!(simd, simd => {
            if let Some(channels) = channels(simd, self, places) {
                let channels: [Lanes; 4] = channels.map(Into::into);
                for (i, out) in out.iter_mut().enumerate().take(places.count) {
                    *out = Premultiplied16(channels.map(|channel| whole(channel[i])));
                }
            } else {
                for (lane, out) in out.iter_mut().enumerate().take(places.count) {
                    let channels = channels(simd, self, &places.alone(lane));
                    *out = channels.map_or(Premultiplied16::TRANSPARENT, |channels| {
                        Premultiplied16(channels.map(|channel| whole(Lanes::from(channel)[0])))
                    });
                }
            }
        });
    }

    /// The sums of the colours of pixels' samples; see [`super::Filter::sums`].
    pub(super) fn sums(
        &self,
        simd: Level,
        (plan, side): (&Plan<'_>, u32),
        list: PixelList<'_>,
        sums: &mut [[u32; 4]],
    ) {
        let samples = PixelPlaces::new(side);
        dispatch!(simd, simd => simd.vectorize(
            #[inline(always)]
            || samples.each_of(plan, list, sums, |places, sum| {
                if !add(simd, self, places, sum) {
                    for lane in 0..places.count {
                        add(simd, self, &places.alone(lane), sum);
                    }
                }
            }),
        ));
    }

    /// Calls `read` with the column and row of each texel that weighs at a point, and with its weight; they sum to one.
    pub(super) fn each(&self, at: DVec2, mut read: impl FnMut([i32; 2], f64)) {
        let Some(samples) = Samples::new(self, &Places::one(at)) else {
            return;
        };
        let mut found = Vec::new();
        for y in samples.rows(self.quadratic) {
            let [first, last] = samples.columns(self.quadratic, y).map(|columns| columns[0]);
            let below = y as f32 - samples.y[0];
            for x in first..=last {
                let part = weight(self.quadratic.within([x as f32 - samples.x[0], below]));
                if part > 0.0 {
                    found.push(([samples.base[0] + x, samples.base[1] + y], f64::from(part)));
                }
            }
        }
        let total: f64 = found.iter().map(|(_, part)| part).sum();
        for (at, part) in found {
            read(at, part / total);
        }
    }

    /// Coordinates near the level, where what is repeated is the same. Places are finite, see [`super::Filter`].
    #[inline(always)]
    fn inside(&self, at: &[f64; LANES], side: u32) -> [f64; LANES] {
        let side = f64::from(side);
        let mut found = [0.0; LANES];
        if self.wrap == Wrap::Clamp {
            for (found, at) in found.iter_mut().zip(at) {
                *found = at.max(-REACH).min(side + REACH);
            }
            return found;
        }
        // Two copies, of which the second one may be turned round.
        let period = 2.0 * side;
        for (found, at) in found.iter_mut().zip(at) {
            // Far away there is a lattice of numbers that is coarser than texels.
            *found = (at - (at / period).floor() * period).max(0.0).min(period);
        }
        found
    }

    /// The texels of a row from one column to another, and some more.
    #[inline(always)]
    fn row(&self, y: i32, [first, last]: [i32; 2]) -> Option<&[[[u8; 4]; BLOCK]]> {
        if first < 0 || last >= self.level.width().cast_signed() {
            return None;
        }
        let y = self.wrap.texel(y, self.level.height()).cast_unsigned() as usize;
        let start = y * self.level.stride() as usize + first.cast_unsigned() as usize;
        let blocks = (last - first).max(0).cast_unsigned() as usize / BLOCK + 1;
        // After the last row of a level there is more than a block.
        Some(self.level.texels()[start..][..blocks * BLOCK].as_chunks().0)
    }

    /// Texels of which some lie beyond the level.
    #[inline(never)]
    fn beyond(&self, [x, y]: [i32; 2]) -> [[u8; 4]; BLOCK] {
        std::array::from_fn(|i| self.level.wrapped(self.wrap, [x + NUMBERS[i], y]))
    }
}

/// What to add for the texels of a block, and for the rows of a vector.
const NUMBERS: [i32; LANES] = [0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15];

impl Samples {
    /// `None` where they lie too far apart to be weighed together, which one alone does not.
    #[inline(always)]
    fn new(filter: &EwaFilter<'_>, places: &Places) -> Option<Self> {
        /// So many texels from each other.
        const FAR: f32 = 64.0;
        /// As [`Samples::reach`].
        const MOST_REACH: f32 = 2.5;
        let mut base = [0.0; 2];
        let mut lanes = [[0.0; LANES]; 2];
        let axes = [(&places.x, filter.level.width()), (&places.y, filter.level.height())];
        for ((base, lanes), (at, side)) in base.iter_mut().zip(&mut lanes).zip(axes) {
            let mut inside = filter.inside(at, side);
            for at in &mut inside {
                *at = (*at * PARTS + 0.5).floor() / PARTS;
            }
            *base = inside[0].floor();
            for (lane, at) in lanes.iter_mut().zip(&inside) {
                *lane = narrow(at - *base);
            }
        }
        let [x, y] = lanes;
        let last = places.count.clamp(1, LANES) - 1;
        let middle = [(x[0] + x[last]) * 0.5, (y[0] + y[last]) * 0.5];
        let (mut beyond, mut apart) = ([0.0; LANES], [0.0; LANES]);
        for i in 0..LANES {
            beyond[i] = 1.0 - filter.quadratic.within([x[i] - middle[0], y[i] - middle[1]]);
            apart[i] = x[i].abs().max(y[i].abs());
        }
        if greatest(apart) > FAR {
            return None;
        }
        let reach = 1.0 + greatest(beyond).max(0.0).sqrt();
        (reach < MOST_REACH).then_some(Self {
            base: base.map(|at| near(narrow(at))),
            x,
            y,
            middle,
            reach,
        })
    }

    /// The rows of texels under any ellipse.
    #[inline(always)]
    fn rows(&self, quadratic: Quadratic) -> std::ops::RangeInclusive<i32> {
        let half = quadratic.half_height() * self.reach + MARGIN;
        near((self.middle[1] - half).ceil())..=near((self.middle[1] + half).floor())
    }

    /// The first and the last columns of a row and of those below it.
    #[inline(always)]
    fn columns(&self, quadratic: Quadratic, y: i32) -> [[i32; LANES]; 2] {
        let mut found = [[0; LANES]; 2];
        for i in 0..LANES {
            let (nearest, half) = quadratic.chord((y + NUMBERS[i]) as f32 - self.middle[1], self.reach);
            let (nearest, half) = (self.middle[0] + nearest, half + MARGIN);
            found[0][i] = near((nearest - half).ceil());
            found[1][i] = near((nearest + half).floor());
        }
        found
    }
}

/// More than rounding moves a rim by, in texels.
const MARGIN: f32 = 1.0 / 64.0;

/// Adds the colours at places to a sum; whether that was possible, which is as for [`Samples::new`].
#[inline(always)]
fn add<S: Simd>(simd: S, filter: &EwaFilter<'_>, places: &Places, sums: &mut [u32; 4]) -> bool {
    let Some(channels) = channels(simd, filter, places) else {
        return false;
    };
    let mut live = [0.0; LANES];
    live[..places.count.min(LANES)].fill(1.0);
    let live = f32x16::simd_from(simd, live);
    for (sum, channel) in sums.iter_mut().zip(channels) {
        // Whole numbers, of which sums are exact.
        *sum += whole_sum((channel * live).reduce_sum());
    }
    true
}

/// The channels of the colours at places, as whole numbers; `None` as for [`Samples::new`].
#[inline(always)]
fn channels<S: Simd>(simd: S, filter: &EwaFilter<'_>, places: &Places) -> Option<[f32x16<S>; 4]> {
    simd.vectorize(
        #[inline(always)]
        || {
            let samples = Samples::new(filter, places)?;
            Some(if filter.is_opaque {
                channels_by::<S, 3>(simd, filter, &samples)
            } else {
                channels_by::<S, 4>(simd, filter, &samples)
            })
        },
    )
}

/// As [`channels`], of which some are not the greatest number.
#[inline(always)]
fn channels_by<S: Simd, const CHANNELS: usize>(
    simd: S,
    filter: &EwaFilter<'_>,
    samples: &Samples,
) -> [f32x16<S>; 4] {
    let quadratic = filter.quadratic;
    let [px, py] = [samples.x, samples.y].map(|lanes| f32x16::simd_from(simd, lanes));
    let mut total = f32x16::splat(simd, 0.0);
    let mut sums = [total; CHANNELS];
    let rows = samples.rows(quadratic);
    for first in rows.clone().step_by(LANES) {
        let [lefts, rights] = samples.columns(quadratic, first);
        for (y, (left, right)) in (first..=*rows.end()).zip(lefts.into_iter().zip(rights)) {
            let below = f32x16::splat(simd, y as f32) - py;
            let most = 1.0 - below * below * quadratic.down;
            let nearest = below * quadratic.lean;
            let columns = [left, right].map(|x| samples.base[0] + x);
            let inside = filter.row(samples.base[1] + y, columns);
            for (i, x) in (left..=right).step_by(BLOCK).enumerate() {
                let block = match inside {
                    Some(blocks) => blocks[i],
                    None => filter.beyond([samples.base[0] + x, samples.base[1] + y]),
                };
                for (texel, number) in floats(simd, block).iter().zip(NUMBERS) {
                    let beside = f32x16::splat(simd, (x + number) as f32) - px - nearest;
                    let within = (most - beside * beside * quadratic.growth).max(f32x16::splat(simd, 0.0));
                    let [a, b, c, d] = SERIES;
                    let weight = within * (within * (within * (within * d + c) + b) + a);
                    total += weight;
                    for (sum, channel) in sums.iter_mut().zip(texel) {
                        *sum += weight * *channel;
                    }
                }
            }
        }
    }
    let scale = f32x16::splat(simd, f32::from(Premultiplied16::PER_BYTE)) / total;
    let mut found = [f32x16::splat(simd, f32::from(Premultiplied16::ONE)); 4];
    for (found, sum) in found.iter_mut().zip(sums) {
        *found = sum * scale + ROUNDING - ROUNDING;
    }
    found
}

/// Texels as floats.
#[inline(always)]
fn floats<S: Simd>(simd: S, texels: [[u8; 4]; BLOCK]) -> [[f32; 4]; BLOCK] {
    let mut bytes = [0; 4 * BLOCK];
    bytes.copy_from_slice(texels.as_flattened());
    let words = u8x16::simd_from(simd, bytes).widen();
    let mut found = [[0.0; 4]; BLOCK];
    let (low, high) = words.0.combine(words.1).widen();
    for (found, half) in found.as_flattened_mut().chunks_mut(8).zip([low, high]) {
        let half: u32x8<S> = half;
        half.bitcast::<i32x8<S>>().to_float::<fearless_simd::f32x8<S>>().store_slice(found);
    }
    found
}

#[inline(always)]
fn greatest(mut lanes: Lanes) -> f32 {
    for half in [8, 4, 2, 1] {
        for i in 0..half {
            lanes[i] = if lanes[i] > lanes[i + half] {
                lanes[i]
            } else {
                lanes[i + half]
            };
        }
    }
    lanes[0]
}

#[inline(always)]
#[expect(clippy::cast_possible_truncation, reason = "a place near a level")]
fn near(at: f32) -> i32 {
    at as i32
}

#[inline(always)]
#[expect(clippy::cast_possible_truncation, reason = "a place near a level")]
fn narrow(at: f64) -> f32 {
    at as f32
}
