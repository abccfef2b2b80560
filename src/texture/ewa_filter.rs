//! The elliptical weighted average at samples. The samples of a pixel have ellipses alike that lie close together: the texels
//! under any of them are looked at once, four of a row or of a column at a time, and weighed for sixteen samples.
//!
//! Samples that lie far apart, as where a bias sharpens, share few texels: there each of sixteen reads its own.
//!
//! What a sample gets does not depend on those beside it. Places are whole multiples of a small part of a texel, so that all
//! distances are exact, whatever they are counted from; a texel beyond its rim weighs nothing, and adds nothing.

#![expect(
    clippy::inline_always,
    reason = "a function that is not inlined into its dispatch loses the vector instructions"
)]

use fearless_simd::prelude::*;
use fearless_simd::{Simd, dispatch, f32x16, i32x16, u32x16};
use glam::DVec2;

use super::ellipse::{KEPT, Quadratic, TO_PARTS};
use super::sample_places::{LANES, Places, WeighSamples, rounded};
use super::texel_blocks::{EndlessLevel, Line};
use super::{MipLevel, Wrap};
use crate::color::Premultiplied16;
use crate::simd;

/// Parts of a texel that places are rounded to. With them and a few hundred texels, 32-bit floats are exact.
const PARTS: f64 = 1024.0;

type Lanes = [f32; LANES];

/// A level read by an ellipse.
#[derive(Clone, Copy, Debug)]
pub(super) struct EwaFilter<'a> {
    pub(super) texels: EndlessLevel<'a>,
    /// That of the ellipse, whose columns are called rows where it is higher than wide: so there are fewer of them.
    pub(super) quadratic: Quadratic,
    pub(super) line: Line,
    /// Whether all texels are opaque.
    pub(super) is_opaque: bool,
}

/// Some samples, in texels from a texel near them. The last ones are the first one again where there are fewer than lanes.
struct Samples<S: Simd> {
    base: [i32; 2],
    x: f32x16<S>,
    y: f32x16<S>,
    /// A point amid them, and how many times as large an ellipse about it must be to hold those of all.
    middle: [f32; 2],
    reach: f32,
}

/// The first texels of samples that each read their own.
struct Apart {
    /// In the level, counted along its rows.
    offsets: [i32; LANES],
    /// What is added to them for the next column, and for the next row.
    steps: [i32; 2],
    /// The first and the last column, then row, of which all have a texel inside the level; counted from their first.
    inside: [[i32; 2]; 2],
}

impl WeighSamples for EwaFilter<'_> {
    #[inline(always)]
    fn channels<S: Simd>(&self, simd: S, places: &Places) -> Option<[f32x16<S>; 4]> {
        let count = places.count;
        simd.vectorize(
            #[inline(always)]
            || {
                let places = self.rounded_places(places);
                let samples = Samples::new(simd, self, &places, count);
                Some(match (samples, self.is_opaque) {
                    (Some(samples), true) => self.channels_by::<S, 3>(simd, &samples),
                    (Some(samples), false) => self.channels_by::<S, 4>(simd, &samples),
                    (None, true) => self.channels_apart::<S, 3>(simd, &places),
                    (None, false) => self.channels_apart::<S, 4>(simd, &places),
                })
            },
        )
    }
}

impl EwaFilter<'_> {
    /// Calls `read` with the column and row of each texel that weighs at a point, and with its weight; they sum to one.
    pub(super) fn each(&self, at: DVec2, mut read: impl FnMut([i32; 2], f64)) {
        let found = dispatch!(simd::level(), simd => self.weights(simd, at));
        let total: f64 = found.iter().map(|(_, part)| part).sum();
        for (at, part) in found {
            read(at, part / total);
        }
    }

    fn weights<S: Simd>(&self, simd: S, at: DVec2) -> Vec<([i32; 2], f64)> {
        let mut found = Vec::new();
        let places = self.rounded_places(&Places::one(at));
        let Some(samples) = Samples::new(simd, self, &places, 1) else {
            return found;
        };
        let [px, py] = [samples.x, samples.y].map(|lanes| Lanes::from(lanes)[0]);
        for y in samples.rows(self.quadratic) {
            let [first, last] = samples.columns(simd, self.quadratic, y).map(|columns| columns[0]);
            for x in first..=last {
                let within = self.quadratic.within([x as f32 - px, y as f32 - py]);
                let part = self.quadratic.weight(within);
                if part > 0.0 {
                    let at = self.line.turned([samples.base[0] + x, samples.base[1] + y]);
                    found.push((at, f64::from(part)));
                }
            }
        }
        found
    }

    /// Places along lines and across them, near the level, rounded to [`PARTS`].
    #[inline(always)]
    fn rounded_places(&self, places: &Places) -> [[f64; LANES]; 2] {
        let mut found = self.line.turned(places.near(self.texels.wrap, self.texels.size()));
        for at in found.as_flattened_mut() {
            *at = (*at * PARTS + 0.5).floor() / PARTS;
        }
        if self.texels.wrap == Wrap::Repeat {
            // In the second copy there is the same as in the first, which is read without looking what stands there.
            for (lanes, side) in found
                .iter_mut()
                .zip(self.line.turned(self.texels.size()).map(f64::from))
            {
                for at in lanes {
                    *at -= if *at < side { 0.0 } else { side };
                }
            }
        }
        found
    }

    /// As [`EwaFilter::channels_by`], of samples that each read the texels around them.
    #[inline(always)]
    fn channels_apart<S: Simd, const CHANNELS: usize>(&self, simd: S, places: &[[f64; LANES]; 2]) -> [f32x16<S>; 4] {
        let quadratic = self.quadratic;
        let series = quadratic.series.map(|factor| f32x16::splat(simd, factor));
        let nothing = f32x16::splat(simd, 0.0);
        let (mut bases, mut parts) = ([[0; LANES]; 2], [[0.0; LANES]; 2]);
        for i in 0..2 {
            for lane in 0..LANES {
                let base = places[i][lane].floor();
                (bases[i][lane], parts[i][lane]) = (near(narrow(base)), narrow(places[i][lane] - base));
            }
        }
        let [x, y] = parts.map(|lanes| f32x16::simd_from(simd, lanes));
        let apart = Apart::new(self, &bases);
        let (mut total, mut sums) = (nothing, [nothing; CHANNELS]);
        let half = quadratic.half_height() + MARGIN;
        for row in near((-half).floor())..=near((1.0 + half).ceil()) {
            let below = f32x16::splat(simd, row as f32) - y;
            let most = quadratic.most - below * below * quadratic.fall;
            let nearest = (below * quadratic.lean + TO_PARTS) - TO_PARTS;
            let half = most.max(nothing).sqrt() + MARGIN;
            let middle = x + nearest;
            let (left, right) = ((middle - half).reduce_min(), (middle + half).reduce_max());
            let columns = near(left.ceil())..=near(right.floor());
            let are_inside = apart.are_inside(&columns, row);
            for column in columns {
                let beside = f32x16::splat(simd, column as f32) - x - nearest;
                let weight = weight(simd, series, most - beside * beside);
                total += weight;
                let mut texels = if are_inside {
                    apart.texels(simd, self.texels.level, [column, row])
                } else {
                    self.each_texel(simd, &bases, [column, row])
                };
                for sum in &mut sums {
                    let channel: i32x16<S> = (texels & 0xFF).bitcast();
                    *sum = weight.mul_add(channel.to_float::<f32x16<S>>(), *sum);
                    texels >>= 8;
                }
            }
        }
        rounded(
            simd,
            sums,
            f32x16::splat(simd, f32::from(Premultiplied16::PER_BYTE)) / total,
        )
    }

    /// The texels so far from some others, of which some lie beyond the level.
    #[inline(never)]
    fn each_texel<S: Simd>(&self, simd: S, bases: &[[i32; LANES]; 2], [column, row]: [i32; 2]) -> u32x16<S> {
        let EndlessLevel { level, wrap } = self.texels;
        let mut found = [0; LANES];
        for (found, (x, y)) in found.iter_mut().zip(bases[0].iter().zip(&bases[1])) {
            *found = u32::from_le_bytes(level.wrapped(wrap, self.line.turned([x + column, y + row])));
        }
        u32x16::simd_from(simd, found)
    }

    /// As [`WeighSamples::channels`], of which some are not the greatest number.
    #[inline(always)]
    fn channels_by<S: Simd, const CHANNELS: usize>(&self, simd: S, samples: &Samples<S>) -> [f32x16<S>; 4] {
        let quadratic = self.quadratic;
        let series = quadratic.series.map(|factor| f32x16::splat(simd, factor));
        let nothing = f32x16::splat(simd, 0.0);
        let mut total = nothing;
        let mut sums = [nothing; CHANNELS];
        let rows = samples.rows(quadratic);
        let mut y = *rows.start();
        while y <= *rows.end() {
            let [lefts, rights] = samples.columns(simd, quadratic, y);
            for (left, right) in lefts.into_iter().zip(rights) {
                if y > *rows.end() {
                    break;
                }
                let columns = [left, right].map(|x| samples.base[0] + x);
                let row = self.texels.line(self.line, samples.base[1] + y, columns);
                let below = f32x16::splat(simd, y as f32) - samples.y;
                let most = quadratic.most - below * below * quadratic.fall;
                let nearest = (below * quadratic.lean + TO_PARTS) - TO_PARTS;
                let mut beside = f32x16::splat(simd, left as f32) - samples.x - nearest;
                for number in 0..row.blocks {
                    for texel in &row.block(simd, number) {
                        let weight = weight(simd, series, most - beside * beside);
                        total += weight;
                        for (sum, channel) in sums.iter_mut().zip(texel) {
                            *sum = weight.mul_add(*channel, *sum);
                        }
                        beside += 1.0;
                    }
                }
                y += 1;
            }
        }
        let factor = f32x16::splat(simd, f32::from(Premultiplied16::PER_BYTE)) / total;
        rounded(simd, sums, factor)
    }
}

impl Apart {
    #[inline(always)]
    fn new(filter: &EwaFilter<'_>, bases: &[[i32; LANES]; 2]) -> Self {
        let EwaFilter { texels, line, .. } = filter;
        let steps = line.turned([1, texels.level.stride().cast_signed()]);
        let mut offsets = [0; LANES];
        for (offset, (x, y)) in offsets.iter_mut().zip(bases[0].iter().zip(&bases[1])) {
            *offset = x.wrapping_mul(steps[0]).wrapping_add(y.wrapping_mul(steps[1]));
        }
        let size = line.turned(texels.size());
        let mut inside = [[0; 2]; 2];
        for ((inside, bases), side) in inside.iter_mut().zip(bases).zip(size) {
            let (mut least, mut most) = (bases[0], bases[0]);
            for base in bases {
                (least, most) = (least.min(*base), most.max(*base));
            }
            *inside = [-least, side.cast_signed() - 1 - most];
        }
        Self { offsets, steps, inside }
    }

    /// Whether the texels of all samples in these columns of a row lie inside the level.
    #[inline(always)]
    fn are_inside(&self, columns: &std::ops::RangeInclusive<i32>, row: i32) -> bool {
        let [across, down] = self.inside;
        across[0] <= *columns.start() && *columns.end() <= across[1] && down[0] <= row && row <= down[1]
    }

    /// Those so far from the first ones, where they do.
    #[inline(always)]
    fn texels<S: Simd>(&self, simd: S, level: &MipLevel, [column, row]: [i32; 2]) -> u32x16<S> {
        let beyond = column * self.steps[0] + row * self.steps[1];
        let texels = level.texels();
        let mut found = [0; LANES];
        for (found, offset) in found.iter_mut().zip(&self.offsets) {
            *found = u32::from_le_bytes(texels[(offset + beyond).cast_unsigned() as usize]);
        }
        u32x16::simd_from(simd, found)
    }
}

/// See [`Quadratic::weight`].
#[inline(always)]
fn weight<S: Simd>(simd: S, [a, b, c]: [f32x16<S>; 3], within: f32x16<S>) -> f32x16<S> {
    let within = within.max(f32x16::splat(simd, 0.0));
    let weight = within * (within * (within * (within + c) + b) + a);
    (weight.bitcast::<u32x16<S>>() & u32x16::splat(simd, KEPT)).bitcast()
}

impl<S: Simd> Samples<S> {
    /// `None` where they lie too far apart to be weighed together, which one alone does not.
    #[inline(always)]
    fn new(simd: S, filter: &EwaFilter<'_>, places: &[[f64; LANES]; 2], count: usize) -> Option<Self> {
        /// So many texels from each other.
        const FAR: f32 = 64.0;
        /// As [`Samples::reach`].
        const MOST_REACH: f32 = 2.5;
        let mut base = [0.0; 2];
        let mut lanes = [[0.0; LANES]; 2];
        for ((base, lanes), places) in base.iter_mut().zip(&mut lanes).zip(places) {
            *base = places[0].floor();
            for (lane, at) in lanes.iter_mut().zip(places) {
                *lane = narrow(at - *base);
            }
        }
        let last = count.clamp(1, LANES) - 1;
        let middle = lanes.map(|lanes| (lanes[0] + lanes[last]) * 0.5);
        let [x, y] = lanes.map(|lanes| f32x16::simd_from(simd, lanes));
        if x.abs().max(y.abs()).reduce_max() > FAR {
            return None;
        }
        let Quadratic { down, lean, growth, .. } = filter.quadratic;
        let below = y - middle[1];
        let beside = x - middle[0] - below * lean;
        let beyond = below * below * down + beside * beside * growth;
        let reach = 1.0 + beyond.reduce_max().sqrt();
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

    /// The first and the last columns under any ellipse, of a row and of those below it.
    #[inline(always)]
    fn columns(&self, simd: S, quadratic: Quadratic, y: i32) -> [[i32; LANES]; 2] {
        const NUMBERS: Lanes = [
            0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0, 10.0, 11.0, 12.0, 13.0, 14.0, 15.0,
        ];
        let Quadratic { down, lean, growth, .. } = quadratic;
        let below = f32x16::simd_from(simd, NUMBERS) + y as f32 - self.middle[1];
        let rest = (self.reach * self.reach - below * below * down).max(f32x16::splat(simd, 0.0));
        let nearest = below * lean + self.middle[0];
        let half = (rest / growth).sqrt() + MARGIN;
        let (left, right) = ((nearest - half).ceil(), (nearest + half).floor());
        [left.to_int::<i32x16<S>>().into(), right.to_int::<i32x16<S>>().into()]
    }
}

/// More than rounding moves a rim by, in texels.
const MARGIN: f32 = 1.0 / 64.0;

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

#[cfg(test)]
mod tests {
    use super::super::{Footprint, MipPyramid};
    use super::*;

    #[test]
    fn samples_far_apart_are_weighed_as_each_alone() {
        let texel = |i: u32| {
            let [a, b, c, ..] = (i.wrapping_mul(0x9E37_79B9) >> 3).to_le_bytes();
            [a, b, c, 255]
        };
        let pyramid = MipPyramid::build(MipLevel::new(40, 24, (0..40 * 24).map(texel).collect()));
        let steps = [DVec2::new(0.03, 0.01), DVec2::new(-0.02, 0.06)];
        let footprint = Footprint {
            dx: steps[0],
            dy: steps[1],
        };
        let (ellipse, _) = super::super::Ellipse::new(&footprint, &pyramid);
        let (line, quadratic) = ellipse.quadratic();
        for (wrap, is_opaque) in [(Wrap::Clamp, true), (Wrap::Repeat, false), (Wrap::Mirror, true)] {
            let filter = EwaFilter {
                texels: EndlessLevel {
                    level: &pyramid.levels()[ellipse.level],
                    wrap,
                },
                quadratic,
                line,
                is_opaque,
            };
            // Some beyond the level, then all inside.
            let size = filter.texels.size().map(f64::from);
            for is_inside in [false, true] {
                let mut places = Places::one(DVec2::ZERO);
                places.count = LANES;
                for lane in 0..LANES {
                    let i = lane as f64;
                    let parts = DVec2::new(i, i * 7.0 % 16.0) * 0.03 + 0.28;
                    (places.x[lane], places.y[lane]) = if is_inside {
                        (size[0] * parts.x, size[1] * parts.y)
                    } else {
                        (i * 2.9 - 5.3, (i * 7.0) % 23.0 - 2.1)
                    };
                }
                compare(&filter, &places, is_inside);
            }
        }
    }

    /// Weighs samples together and each alone.
    fn compare(filter: &EwaFilter<'_>, places: &Places, is_inside: bool) {
        let bases = filter
            .rounded_places(places)
            .map(|lanes| lanes.map(|at| near(narrow(at.floor()))));
        let found = Apart::new(filter, &bases).are_inside(&(-1..=1), 1);
        assert_eq!(found, is_inside, "where all texels lie: {places:?}");
        for (name, level) in simd::tested() {
            let mut together = [Premultiplied16::TRANSPARENT; LANES];
            dispatch!(level, simd => filter.colors(simd, places, &mut together));
            for (lane, together) in together.iter().enumerate() {
                let mut alone = [Premultiplied16::TRANSPARENT];
                dispatch!(level, simd => filter.colors(simd, &places.alone(lane), &mut alone));
                let wrap = filter.texels.wrap;
                assert_eq!(alone[0], *together, "{wrap:?}, sample {lane}, {name}");
            }
        }
    }
}
