//! Where the samples of pixels lie in a level, in 64-bit floats: for filters that weigh areas, up to sixteen at a time.

#![expect(
    clippy::inline_always,
    reason = "a function that is not inlined into its dispatch loses the vector instructions"
)]

use fearless_simd::prelude::*;
use fearless_simd::{Simd, f32x16};
use glam::DVec2;

use super::Wrap;
use super::filter_plan::{Axis, PixelList, Plan};
use super::fixed_point::REACH;
use crate::color::Premultiplied16;

/// Adding this to a 32-bit float that is smaller rounds it to a whole number.
pub(super) const ROUNDING: f32 = 8_388_608.0;
/// Samples that are read together.
pub(super) const LANES: usize = 16;

/// Some samples of a pixel, in texels; whole coordinates are centres. Lanes from `count` on repeat the first.
#[derive(Clone, Copy, Debug)]
pub(super) struct Places {
    pub(super) x: [f64; LANES],
    pub(super) y: [f64; LANES],
    pub(super) count: usize,
}

/// The samples of every pixel, counted from its first.
#[derive(Debug)]
pub(super) struct PixelPlaces {
    side: u32,
    /// Columns and rows, sixteen by sixteen.
    samples: Vec<([f64; LANES], [f64; LANES], usize)>,
}

impl Places {
    /// Of samples in these columns and rows, counted from the first one of the plan's grid.
    #[inline(always)]
    fn new(plan: &Plan<'_>, columns: &[f64; LANES], rows: &[f64; LANES], count: usize) -> Self {
        let place = |axis: &Axis| {
            let mut found = [0.0; LANES];
            for i in 0..LANES {
                let [right, down] = [plan.first.x + columns[i], plan.first.y + rows[i]];
                found[i] = (axis.at_pivot + right * axis.right) + down * axis.down;
            }
            found
        };
        Self {
            x: place(&plan.finer.x),
            y: place(&plan.finer.y),
            count,
        }
    }

    /// Of up to [`LANES`] samples, of which there is at least one.
    pub(super) fn of_points(plan: &Plan<'_>, points: &[[u16; 2]]) -> Self {
        let first = points.first().copied().unwrap_or_default();
        let coordinate = |axis: usize| {
            let mut found = [f64::from(first[axis]); LANES];
            for (found, point) in found.iter_mut().zip(points) {
                *found = f64::from(point[axis]);
            }
            found
        };
        Self::new(plan, &coordinate(0), &coordinate(1), points.len().min(LANES))
    }

    /// Of one sample.
    pub(super) fn alone(&self, lane: usize) -> Self {
        Self::one(self.at(lane))
    }

    /// Of one place.
    pub(super) fn one(at: DVec2) -> Self {
        Self {
            x: [at.x; LANES],
            y: [at.y; LANES],
            count: 1,
        }
    }

    /// The same near a level of this size, where what is repeated is the same. Places are finite, see [`super::Filter`].
    #[inline(always)]
    pub(super) fn near(&self, wrap: Wrap, size: [u32; 2]) -> [[f64; LANES]; 2] {
        let mut found = [self.x, self.y];
        for (lanes, side) in found.iter_mut().zip(size.map(f64::from)) {
            for at in lanes {
                *at = match wrap {
                    Wrap::Clamp => at.max(-REACH).min(side + REACH),
                    // Two copies, of which the second one may be turned round. Far away there is a lattice of numbers that is
                    // coarser than texels.
                    Wrap::Repeat | Wrap::Mirror => {
                        let period = 2.0 * side;
                        (*at - (*at / period).floor() * period).max(0.0).min(period)
                    }
                };
            }
        }
        found
    }

    pub(super) fn at(&self, lane: usize) -> DVec2 {
        DVec2::new(self.x[lane % LANES], self.y[lane % LANES])
    }
}

impl PixelPlaces {
    pub(super) fn new(side: u32) -> Self {
        let all: Vec<[u32; 2]> = (0..side).flat_map(|y| (0..side).map(move |x| [x, y])).collect();
        let lanes = |samples: &[[u32; 2]]| {
            let mut found = ([0.0; LANES], [0.0; LANES], samples.len());
            for i in 0..LANES {
                let [x, y] = samples.get(i).copied().unwrap_or(samples[0]).map(f64::from);
                (found.0[i], found.1[i]) = (x, y);
            }
            found
        };
        Self {
            side,
            samples: all.chunks(LANES).map(lanes).collect(),
        }
    }

    /// Sums over the samples of pixels: calls `add` with some that take part, and with what to add to.
    #[inline(always)]
    pub(super) fn each_of(
        &self,
        plan: &Plan<'_>,
        list: PixelList<'_>,
        sums: &mut [[u32; 4]],
        mut add: impl FnMut(&Places, &mut [u32; 4]),
    ) {
        for (i, (pixel, sum)) in list.pixels.iter().zip(sums).enumerate() {
            *sum = [0; 4];
            self.each(plan, *pixel, list.masks.map(|masks| masks[i]), |places| {
                add(places, sum);
            });
        }
    }

    /// Calls `visit` with the samples of a pixel that take part, in the order of their numbers.
    #[inline(always)]
    fn each(&self, plan: &Plan<'_>, pixel: [u16; 2], mask: Option<u64>, mut visit: impl FnMut(&Places)) {
        let [left, top] = pixel.map(|at| f64::from(u32::from(at) * self.side));
        for (i, (columns, rows, count)) in self.samples.iter().enumerate() {
            let (mut columns, mut rows, mut count) = (*columns, *rows, *count);
            if let Some(mask) = mask {
                // Samples from the 64th on have no bit, and take no part.
                let shift = u32::try_from(i * LANES).unwrap_or(u64::BITS);
                let mut rest = mask.checked_shr(shift).unwrap_or(0) & ((1 << count) - 1);
                if rest == 0 {
                    continue;
                }
                count = 0;
                let first = rest.trailing_zeros() as usize;
                let (mut chosen, mut below) = ([columns[first]; LANES], [rows[first]; LANES]);
                while rest != 0 {
                    let lane = rest.trailing_zeros() as usize;
                    (chosen[count], below[count]) = (columns[lane], rows[lane]);
                    count += 1;
                    rest &= rest - 1;
                }
                (columns, rows) = (chosen, below);
            }
            for i in 0..LANES {
                columns[i] += left;
                rows[i] += top;
            }
            visit(&Places::new(plan, &columns, &rows, count));
        }
    }
}

/// What finds the colours of sixteen samples at a time.
pub(super) trait WeighSamples {
    /// The channels of the colours at some places, as whole numbers; `None` where they lie too far apart to be looked at together,
    /// which one alone does not.
    fn channels<S: Simd>(&self, simd: S, places: &Places) -> Option<[f32x16<S>; 4]>;

    /// The colours at some places.
    #[inline(always)]
    fn colors<S: Simd>(&self, simd: S, places: &Places, out: &mut [Premultiplied16]) {
        let color =
            |channels: &[[f32; LANES]; 4], lane: usize| Premultiplied16([0, 1, 2, 3].map(|i| whole(channels[i][lane])));
        if let Some(channels) = self.channels(simd, places) {
            let channels = channels.map(Into::into);
            for (lane, out) in out.iter_mut().enumerate().take(places.count) {
                *out = color(&channels, lane);
            }
            return;
        }
        for (lane, out) in out.iter_mut().enumerate().take(places.count) {
            if let Some(channels) = self.channels(simd, &places.alone(lane)) {
                *out = color(&channels.map(Into::into), 0);
            }
        }
    }

    /// The sums of the colours of pixels' samples; see [`super::Filter::sums`].
    #[inline(always)]
    fn sums<S: Simd>(&self, simd: S, (plan, side): (&Plan<'_>, u32), list: PixelList<'_>, sums: &mut [[u32; 4]]) {
        let samples = PixelPlaces::new(side);
        simd.vectorize(
            #[inline(always)]
            || {
                samples.each_of(plan, list, sums, |places, sum| {
                    if let Some(channels) = self.channels(simd, places) {
                        add(simd, channels, places.count, sum);
                        return;
                    }
                    for lane in 0..places.count {
                        if let Some(channels) = self.channels(simd, &places.alone(lane)) {
                            add(simd, channels, 1, sum);
                        }
                    }
                });
            },
        );
    }
}

/// Sums times a factor as whole numbers; channels that were not summed are the greatest.
#[inline(always)]
pub(super) fn rounded<S: Simd, const CHANNELS: usize>(
    simd: S,
    sums: [f32x16<S>; CHANNELS],
    factor: f32x16<S>,
) -> [f32x16<S>; 4] {
    let mut found = [f32x16::splat(simd, f32::from(Premultiplied16::ONE)); 4];
    for (found, sum) in found.iter_mut().zip(sums) {
        *found = sum * factor + ROUNDING - ROUNDING;
    }
    found
}

/// Adds the channels of so many colours to a sum.
#[inline(always)]
fn add<S: Simd>(simd: S, channels: [f32x16<S>; 4], count: usize, sums: &mut [u32; 4]) {
    let mut taken = [0.0; LANES];
    taken[..count.min(LANES)].fill(1.0);
    let taken = f32x16::simd_from(simd, taken);
    for (sum, channel) in sums.iter_mut().zip(channels) {
        // Of whole numbers sums are exact.
        *sum += whole_sum((channel * taken).reduce_sum());
    }
}

/// A channel that was rounded already: a whole number of at most 65280.
#[inline]
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "a whole number of at most 65280"
)]
pub(super) fn whole(channel: f32) -> u16 {
    channel as u16
}

/// The sum of such channels over up to [`LANES`] samples.
#[inline]
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "a whole number of at most sixteen times 65280"
)]
pub(super) fn whole_sum(channel: f32) -> u32 {
    channel as u32
}
