//! Planes of colours as seen from some pixels: near the first of these, numbers of 32 bits are enough, sixteen pixels at once. What
//! these lose is added to what is known of the values there ([`crate::color::ValueLimits`]).

#![expect(
    clippy::inline_always,
    reason = "only what is inlined into a dispatched function is compiled for its vector instructions"
)]

use std::ops::Range;

use fearless_simd::prelude::*;
use fearless_simd::{Simd, f32x16, i32x16, u16x32, u32x16};

use crate::color::{PIXELS, Premultiplied16, SpreadLimits, ValueLimits, ValueSpread};
use crate::raster::attributes::Planes;
use crate::raster::sampling::place_sums::PlaceSums;
use crate::raster::shading::context::Pixels;
use crate::raster::shading::kernel::{ONE, first_sample};

/// How the samples of [`PIXELS`] pixels are spread, in points of the lattice.
pub(super) struct PlaceSpreads<S: Simd> {
    /// How many these are.
    pub(super) counts: f32x16<S>,
    /// Of columns and of rows.
    pub(super) means: [f32x16<S>; 2],
    /// The mean squares of how far columns and rows are from there, and between these the mean of their products.
    squares: [f32x16<S>; 3],
}

/// Planes through what samples show once flat colours are painted over them.
pub(super) struct TintedPlanes {
    /// In units of [`Premultiplied16`].
    planes: Planes<3>,
    limits: [ValueLimits; 3],
}

/// The same as seen from the first of some pixels: near it 32 bits are enough, and how far they are not is known.
pub(super) struct NearPlanes {
    first: [u16; 2],
    /// At some point of that pixel.
    at_first: [f32; 3],
    /// Change from one pixel to the next on its right, and to the one below.
    right: [f32; 3],
    down: [f32; 3],
    /// Change from one point of the lattice to the next.
    pub(super) dx: [f32; 3],
    pub(super) dy: [f32; 3],
    /// What is known of the values of each pixel.
    limits: [SpreadLimits; 3],
}

impl TintedPlanes {
    /// Source-over of one after the other keeps planes plane. Every one rounds what it leaves of what was rounded before it.
    #[inline(always)]
    pub(super) fn new(planes: &Planes<3>, tints: &[Premultiplied16]) -> Self {
        let (mut planes, mut limits) = (*planes, [ValueLimits::STORED; 3]);
        for tint in tints {
            let left = 1.0 - f64::from(tint.0[3]) / ONE;
            planes = planes.scaled(left);
            for ((at_pivot, limits), channel) in planes.at_pivot.iter_mut().zip(&mut limits).zip(tint.0) {
                let channel = f64::from(channel);
                *at_pivot += channel;
                limits.rounded = limits.rounded * left + 0.5;
                for end in &mut limits.range {
                    *end = (*end * left + channel).min(ONE);
                }
            }
        }
        Self { planes, limits }
    }

    /// The same where samples have weights that add up to so much without their signs: each moves the sum by what rounding moved it,
    /// times its weight.
    pub(super) fn weighted(mut self, unsigned: f64) -> Self {
        for limits in &mut self.limits {
            limits.rounded *= unsigned;
        }
        self
    }

    /// The same where nobody knows how far samples have moved together, up to `points` of the lattice on each axis; `None` where few
    /// pixels would be certain.
    pub(super) fn moved_by(mut self, points: f64) -> Option<Self> {
        /// Units, of the 256 of a byte, between the ends of all channels: beyond, half of the pixels are asked for twice.
        const MOST: f64 = 64.0;
        let mut all = 0.0;
        for (k, limits) in self.limits.iter_mut().enumerate() {
            limits.rounded += (self.planes.dx[k].abs() + self.planes.dy[k].abs()) * points;
            all += limits.rounded;
        }
        (all < MOST).then_some(self)
    }

    /// As seen from the first of these pixels, at this point of the lattice inside of it; no two samples that count for a pixel lie
    /// farther apart than `reach` on each axis.
    #[inline(always)]
    #[expect(clippy::cast_possible_truncation, reason = "what is lost is told")]
    pub(super) fn near(&self, Pixels { grid, places }: Pixels<'_>, inside: [f64; 2], reach: f64) -> NearPlanes {
        /// Numbers of 32 bits are off by `2^-24` of themselves; each is, as well as up to five sums, and products of two.
        const OFF: f64 = 1.0 / (1_u32 << 21) as f64;
        let Self { planes, limits } = self;
        let (side, first) = (f64::from(grid.side), places.first().copied().unwrap_or_default());
        let from_pivot =
            |axis: usize| first_sample(grid)[axis] + f64::from(first[axis]) * side + inside[axis] - planes.pivot[axis];
        let (right, down) = (from_pivot(0), from_pivot(1));
        let [width, height] = farthest(first, places);
        let at_first = [0, 1, 2].map(|k| planes.at_pivot[k] + planes.dy[k] * down + planes.dx[k] * right);
        let of = |k: usize| {
            let [dx, dy] = [planes.dx[k].abs(), planes.dy[k].abs()];
            let most = at_first[k].abs() + (dx * (width + 1.0) + dy * (height + 1.0)) * side;
            limits[k].within((dx + dy) * reach, most * OFF)
        };
        let limits = [of(0), of(1), of(2)];
        NearPlanes {
            first,
            at_first: at_first.map(|value| value as f32),
            right: planes.dx.map(|value| (value * side) as f32),
            down: planes.dy.map(|value| (value * side) as f32),
            dx: planes.dx.map(|value| value as f32),
            dy: planes.dy.map(|value| value as f32),
            limits,
        }
    }
}

/// The lists of up to [`PIXELS`] of so many pixels, and how many of each were in the one before: where there are enough, the last one begins
/// earlier rather than to be short.
#[inline(always)]
pub(super) fn blocks(pixels: usize) -> impl Iterator<Item = (Range<usize>, usize)> {
    (0..pixels).step_by(PIXELS).map(move |next| {
        let first = next.min(pixels.saturating_sub(PIXELS));
        (first..pixels.min(first + PIXELS), next - first)
    })
}

/// How many columns and rows from the first one the farthest of some pixels are.
#[inline(always)]
fn farthest(first: [u16; 2], places: &[[u16; 2]]) -> [f64; 2] {
    let (mut least, mut most) = (first, first);
    for place in places {
        for axis in 0..2 {
            least[axis] = least[axis].min(place[axis]);
            most[axis] = most[axis].max(place[axis]);
        }
    }
    [0, 1].map(|axis| f64::from((first[axis] - least[axis]).max(most[axis] - first[axis])))
}

impl NearPlanes {
    /// Columns and rows of up to [`PIXELS`] pixels, from the first one; what is left over repeats the first of them.
    #[inline(always)]
    pub(super) fn columns_and_rows<S: Simd>(&self, simd: S, places: &[[u16; 2]]) -> [f32x16<S>; 2] {
        let all = if let Some(places) = places.first_chunk() {
            *places
        } else {
            let mut all = [self.first; PIXELS];
            for (all, place) in all.iter_mut().zip(places) {
                *all = *place;
            }
            all
        };
        let both: u32x16<S> = u16x32::from_slice(simd, all.as_flattened()).bitcast();
        let [column, row] = self.first.map(f32::from);
        [number(both & 0xFFFF) - column, number(both >> 16) - row]
    }

    /// The pixels there, and a bit for each that is certain. Where samples lie at other places in each, `means` says where their
    /// middles are; `bytes` says the bytes of a channel by its number.
    #[inline(always)]
    pub(super) fn pixels<S: Simd>(
        &self,
        at: [f32x16<S>; 2],
        means: Option<[f32x16<S>; 2]>,
        bytes: impl Fn(ValueSpread<S>, usize) -> (u32x16<S>, u64),
    ) -> (u32x16<S>, u64) {
        let (mut pixels, mut certain) = (u32x16::splat(at[0].simd, 0xFF), u64::MAX);
        for k in 0..3 {
            let (found, of_channel) = bytes(self.spread(k, at, means), k);
            certain &= of_channel;
            pixels = pixels << 8 | found;
        }
        (pixels, certain)
    }

    /// A channel of the pixels there.
    #[inline(always)]
    pub(super) fn spread<S: Simd>(
        &self,
        k: usize,
        [columns, rows]: [f32x16<S>; 2],
        means: Option<[f32x16<S>; 2]>,
    ) -> ValueSpread<S> {
        let mut mean = columns * self.right[k] + self.at_first[k] + rows * self.down[k];
        if let Some([columns, rows]) = means {
            mean = mean + columns * self.dx[k] + rows * self.dy[k];
        }
        ValueSpread {
            mean,
            limits: self.limits[k],
        }
    }
}

impl<S: Simd> PlaceSpreads<S> {
    /// Of samples whose places add up to this.
    #[inline(always)]
    pub(super) fn new(simd: S, sums: &[PlaceSums; PIXELS]) -> Self {
        let [mut counts, mut right, mut down] = [[0; PIXELS]; 3];
        let mut squares = [[0; PIXELS]; 3];
        for (i, sums) in sums.iter().enumerate() {
            counts[i] = sums.count;
            [right[i], down[i]] = sums.places;
            for (squares, of_sums) in squares.iter_mut().zip(sums.squares) {
                squares[i] = of_sums;
            }
        }
        let counts = number(u32x16::simd_from(simd, counts));
        let per_sample = f32x16::splat(simd, 1.0) / counts.max(f32x16::splat(simd, 1.0));
        let mean = |sums: [u32; PIXELS]| number(u32x16::simd_from(simd, sums)) * per_sample;
        let (x, y) = (mean(right), mean(down));
        let [xx, xy, yy] = squares;
        Self {
            counts,
            means: [x, y],
            squares: [mean(xx) - x * x, mean(xy) - x * y, mean(yy) - y * y],
        }
    }

    /// Of pixels whose samples all lie at the same places, which add up to this.
    #[inline(always)]
    pub(super) fn of_each(simd: S, sums: &PlaceSums) -> Self {
        let number = |value: u32| f32x16::float_from(i32x16::splat(simd, value.cast_signed()));
        let count = number(sums.count);
        let per_sample = f32x16::splat(simd, 1.0) / count.max(f32x16::splat(simd, 1.0));
        let [x, y] = [number(sums.places[0]) * per_sample, number(sums.places[1]) * per_sample];
        let [xx, xy, yy] = sums.squares;
        Self {
            counts: count,
            means: [x, y],
            squares: [
                number(xx) * per_sample - x * x,
                number(xy) * per_sample - x * y,
                number(yy) * per_sample - y * y,
            ],
        }
    }

    /// Of values that change so much from one point of the lattice to the next, across and down, the mean squares of how far they are
    /// from their mean.
    #[inline(always)]
    pub(super) fn squares_along(&self, dx: f32, dy: f32) -> f32x16<S> {
        let [xx, xy, yy] = self.squares;
        xx * (dx * dx) + xy * (2.0 * dx * dy) + yy * (dy * dy)
    }
}

/// Whole numbers as floats.
#[inline(always)]
pub(super) fn number<S: Simd>(whole: u32x16<S>) -> f32x16<S> {
    f32x16::float_from(whole.bitcast::<i32x16<S>>())
}
