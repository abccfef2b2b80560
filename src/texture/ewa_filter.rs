//! The elliptical weighted average at samples. The samples of a pixel have ellipses alike that lie close together: the texels
//! under any of them are looked at once, four of a row or of a column at a time, and weighed for sixteen samples.
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

impl WeighSamples for EwaFilter<'_> {
    #[inline(always)]
    fn channels<S: Simd>(&self, simd: S, places: &Places) -> Option<[f32x16<S>; 4]> {
        simd.vectorize(
            #[inline(always)]
            || {
                let samples = Samples::new(simd, self, places)?;
                Some(if self.is_opaque {
                    self.channels_by::<S, 3>(simd, &samples)
                } else {
                    self.channels_by::<S, 4>(simd, &samples)
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
        let Some(samples) = Samples::new(simd, self, &Places::one(at)) else {
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

    /// As [`WeighSamples::channels`], of which some are not the greatest number.
    #[inline(always)]
    fn channels_by<S: Simd, const CHANNELS: usize>(&self, simd: S, samples: &Samples<S>) -> [f32x16<S>; 4] {
        let quadratic = self.quadratic;
        let [a, b, c] = quadratic.series.map(|factor| f32x16::splat(simd, factor));
        let kept = u32x16::splat(simd, KEPT);
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
                        let within = (most - beside * beside).max(nothing);
                        let weight = within * (within * (within * (within + c) + b) + a);
                        let weight: f32x16<S> = (weight.bitcast::<u32x16<S>>() & kept).bitcast();
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

impl<S: Simd> Samples<S> {
    /// `None` where they lie too far apart to be weighed together, which one alone does not.
    #[inline(always)]
    fn new(simd: S, filter: &EwaFilter<'_>, places: &Places) -> Option<Self> {
        /// So many texels from each other.
        const FAR: f32 = 64.0;
        /// As [`Samples::reach`].
        const MOST_REACH: f32 = 2.5;
        let mut base = [0.0; 2];
        let mut lanes = [[0.0; LANES]; 2];
        let near_level = filter
            .line
            .turned(places.near(filter.texels.wrap, filter.texels.size()));
        for ((base, lanes), mut inside) in base.iter_mut().zip(&mut lanes).zip(near_level) {
            for at in &mut inside {
                *at = (*at * PARTS + 0.5).floor() / PARTS;
            }
            *base = inside[0].floor();
            for (lane, at) in lanes.iter_mut().zip(&inside) {
                *lane = narrow(at - *base);
            }
        }
        let last = places.count.clamp(1, LANES) - 1;
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
        [(nearest - half).ceil(), (nearest + half).floor()].map(|ends| ends.to_int::<i32x16<S>>().into())
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
