//! The elliptical weighted average at samples. The samples of a pixel have ellipses alike that lie close together: the texels
//! under any of them are looked at once, and weighed for sixteen samples at a time.
//!
//! What a sample gets does not depend on those beside it. Places are whole multiples of a small part of a texel, so that all
//! distances are exact, whatever they are counted from; a texel beyond its rim weighs nothing, and adds nothing.

#![expect(
    clippy::inline_always,
    reason = "a function that is not inlined into its dispatch loses the vector instructions"
)]

use fearless_simd::prelude::*;
use fearless_simd::{Level, Simd, dispatch, f32x16};
use glam::DVec2;

use super::ellipse::{Ellipse, Quadratic, SERIES, weight};
use super::fixed_point::REACH;
use super::sample_places::{LANES, Places, whole, whole_sum};
use super::{MipLevel, Wrap};
use crate::color::Premultiplied16;

/// Parts of a texel that places are rounded to. With them and a few hundred texels, 32-bit floats are exact.
const PARTS: f64 = 1024.0;
/// Adding this to a 32-bit float that is smaller rounds it to a whole number.
const ROUNDING: f32 = 8_388_608.0;

type Lanes = [f32; LANES];

/// A level read by an ellipse.
#[derive(Clone, Copy, Debug)]
pub(super) struct EwaFilter<'a> {
    pub(super) level: &'a MipLevel,
    pub(super) wrap: Wrap,
    pub(super) ellipse: Ellipse,
    /// Whether all texels are opaque.
    pub(super) is_opaque: bool,
}

/// The texels of a row as floats, kept so that their memory is.
pub(super) type RowTexels = Vec<[f32; 4]>;

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
    pub(super) fn colors(&self, simd: Level, places: &Places, row: &mut RowTexels, out: &mut [Premultiplied16]) {
        if let Some(channels) = dispatch!(simd, simd => channels(simd, self, places, row)) {
            for (i, out) in out.iter_mut().enumerate().take(places.count) {
                *out = Premultiplied16(channels.map(|channel| whole(channel[i])));
            }
        } else {
            for (lane, out) in out.iter_mut().enumerate().take(places.count) {
                let channels = dispatch!(simd, simd => channels(simd, self, &places.alone(lane), row));
                *out = channels.map_or(Premultiplied16::TRANSPARENT, |channels| {
                    Premultiplied16(channels.map(|channel| whole(channel[0])))
                });
            }
        }
    }

    /// Adds those colours to `sums`.
    pub(super) fn add(&self, simd: Level, places: &Places, row: &mut RowTexels, sums: &mut [u32; 4]) {
        if let Some(channels) = dispatch!(simd, simd => channels(simd, self, places, row)) {
            for (sum, channel) in sums.iter_mut().zip(&channels) {
                *sum += total(channel, places.count);
            }
        } else if places.count > 1 {
            for lane in 0..places.count {
                self.add(simd, &places.alone(lane), row, sums);
            }
        }
    }

    /// Calls `read` with the column and row of each texel that weighs at a point, and with its weight; they sum to one.
    pub(super) fn each(&self, at: DVec2, mut read: impl FnMut([i32; 2], f64)) {
        let Some(samples) = Samples::new(self, &Places::one(at)) else {
            return;
        };
        let quadratic = self.ellipse.quadratic();
        let mut found = Vec::new();
        for y in samples.rows(quadratic) {
            let [first, last] = samples.columns(quadratic, y);
            let below = y as f32 - samples.y[0];
            for x in first..=last {
                let part = weight(quadratic.within([x as f32 - samples.x[0], below]));
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

    /// Coordinates near the level, where what is repeated is the same.
    #[inline(always)]
    fn inside(&self, at: &[f64; LANES], side: u32) -> [f64; LANES] {
        let side = f64::from(side);
        let mut found = [0.0; LANES];
        if self.wrap == Wrap::Clamp {
            for (found, at) in found.iter_mut().zip(at) {
                let near = at.max(-REACH).min(side + REACH);
                *found = if at.is_finite() { near } else { 0.0 };
            }
            return found;
        }
        // Two copies, of which the second one may be turned round.
        let period = 2.0 * side;
        for (found, at) in found.iter_mut().zip(at) {
            *found = if *at >= 0.0 && *at < period {
                *at
            } else if at.is_finite() {
                // Far away there is a lattice of numbers that is coarser than texels.
                (at - (at / period).floor() * period).clamp(0.0, period)
            } else {
                0.0
            };
        }
        found
    }

    /// Fetches the texels of a row from one column to another, which may lie beyond the level.
    #[inline(always)]
    fn fetch(&self, y: i32, [first, last]: [i32; 2], row: &mut RowTexels) {
        row.clear();
        let (width, y) = (self.level.width(), self.wrap.texel(y, self.level.height()));
        let all = self.level.row(y.cast_unsigned() as usize);
        let as_floats = |texel: &[u8; 4]| texel.map(f32::from);
        if first >= 0 && last < width.cast_signed() {
            let inside = &all[first.cast_unsigned() as usize..=last.cast_unsigned() as usize];
            row.extend(inside.iter().map(as_floats));
        } else {
            let texel = |x: i32| as_floats(&all[self.wrap.texel(x, width).cast_unsigned() as usize]);
            row.extend((first..=last).map(texel));
        }
    }
}

impl Samples {
    /// `None` where they lie too far apart to be weighed together, which one alone does not.
    #[inline(always)]
    fn new(filter: &EwaFilter<'_>, places: &Places) -> Option<Self> {
        /// So many texels from each other.
        const FAR: f64 = 64.0;
        /// As [`Samples::reach`].
        const MOST_REACH: f32 = 2.5;
        let mut base = [0.0; 2];
        let mut lanes = [[0.0; LANES]; 2];
        let mut farthest: f64 = 0.0;
        let axes = [(&places.x, filter.level.width()), (&places.y, filter.level.height())];
        for ((base, lanes), (at, side)) in base.iter_mut().zip(&mut lanes).zip(axes) {
            let mut inside = filter.inside(at, side);
            for at in &mut inside {
                *at = (*at * PARTS + 0.5).floor() / PARTS;
            }
            *base = inside[0].floor();
            for (lane, at) in lanes.iter_mut().zip(&inside) {
                *lane = narrow(at - *base);
                farthest = farthest.max((at - *base).abs());
            }
        }
        if farthest > FAR {
            return None;
        }
        let [x, y] = lanes;
        let last = places.count.clamp(1, LANES) - 1;
        let middle = [(x[0] + x[last]) * 0.5, (y[0] + y[last]) * 0.5];
        let quadratic = filter.ellipse.quadratic();
        let mut beyond = [0.0; LANES];
        for i in 0..LANES {
            beyond[i] = 1.0 - quadratic.within([x[i] - middle[0], y[i] - middle[1]]);
        }
        let reach = 1.0 + greatest(beyond).max(0.0).sqrt();
        (reach < MOST_REACH).then_some(Self {
            base: base.map(near),
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
        near((self.middle[1] - half).ceil().into())..=near((self.middle[1] + half).floor().into())
    }

    /// The first and the last column of a row.
    #[inline(always)]
    fn columns(&self, quadratic: Quadratic, y: i32) -> [i32; 2] {
        let (nearest, half) = quadratic.chord(y as f32 - self.middle[1], self.reach);
        let (nearest, half) = (self.middle[0] + nearest, half + MARGIN);
        [
            near((nearest - half).ceil().into()),
            near((nearest + half).floor().into()),
        ]
    }
}

/// More than rounding moves a rim by, in texels.
const MARGIN: f32 = 1.0 / 64.0;

/// The channels of the colours at places, as whole numbers; `None` as for [`Samples::new`].
#[inline(always)]
fn channels<S: Simd>(simd: S, filter: &EwaFilter<'_>, places: &Places, row: &mut RowTexels) -> Option<[Lanes; 4]> {
    simd.vectorize(
        #[inline(always)]
        || {
            let samples = Samples::new(filter, places)?;
            Some(if filter.is_opaque {
                channels_by::<S, 3>(simd, filter, &samples, row)
            } else {
                channels_by::<S, 4>(simd, filter, &samples, row)
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
    row: &mut RowTexels,
) -> [Lanes; 4] {
    let quadratic = filter.ellipse.quadratic();
    let [px, py] = [samples.x, samples.y].map(|lanes| f32x16::simd_from(simd, lanes));
    let mut total = f32x16::splat(simd, 0.0);
    let mut sums = [total; CHANNELS];
    for y in samples.rows(quadratic) {
        let columns = samples.columns(quadratic, y);
        if columns[0] > columns[1] {
            continue;
        }
        filter.fetch(samples.base[1] + y, columns.map(|x| samples.base[0] + x), row);
        let below = f32x16::splat(simd, y as f32) - py;
        let most = 1.0 - below * below * quadratic.down;
        let nearest = below * quadratic.lean;
        let mut right = f32x16::splat(simd, columns[0] as f32) - px;
        for texel in row.iter() {
            let beside = right - nearest;
            let within = (most - beside * beside * quadratic.growth).max(f32x16::splat(simd, 0.0));
            let [a, b, c, d] = SERIES;
            let weight = within * (within * (within * (within * d + c) + b) + a);
            total += weight;
            for (sum, channel) in sums.iter_mut().zip(texel) {
                *sum += weight * *channel;
            }
            right += 1.0;
        }
    }
    let scale = f32x16::splat(simd, f32::from(Premultiplied16::PER_BYTE)) / total;
    let mut found = [[f32::from(Premultiplied16::ONE); LANES]; 4];
    for (found, sum) in found.iter_mut().zip(sums) {
        *found = (sum * scale + ROUNDING - ROUNDING).into();
    }
    found
}

/// The sum of so many lanes: whole numbers, of which it is exact.
#[inline]
fn total(lanes: &Lanes, count: usize) -> u32 {
    let mut rest = [0.0; LANES];
    rest[..count].copy_from_slice(&lanes[..count]);
    for half in [8, 4, 2, 1] {
        for i in 0..half {
            rest[i] += rest[i + half];
        }
    }
    whole_sum(rest[0])
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
fn near(at: f64) -> i32 {
    at as i32
}

#[inline(always)]
#[expect(clippy::cast_possible_truncation, reason = "distances of few texels")]
fn narrow(at: f64) -> f32 {
    at as f32
}
