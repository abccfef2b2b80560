//! Where the samples of pixels lie that read the nearest texel of one level each.
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
//! unit: pixels with a sample so close to the edge of a texel are [`Uncertain`].

#![expect(
    clippy::inline_always,
    reason = "a function that is not inlined into its dispatch loses the vector instructions"
)]

use fearless_simd::Simd;
use fearless_simd::prelude::*;
use glam::DVec2;

use super::PixelSampling;
use super::filter_plan::{Axis, GridLevel, Plan};
use super::fixed_point::FRACTION_BITS;
use super::texel_coordinates::{Positions, columns_and_rows};
use super::wrap::Endless;

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
    pub(super) side: u32,
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

impl Uncertain {
    pub(super) const NONE: Self = Self(0);

    /// Of pixels whose samples are so far from the edges of their texels, as they were found, at least: in the lower half of
    /// each lane.
    #[inline(always)]
    pub(super) fn new<S: Simd>(simd: S, distance: S::i16s) -> Self {
        let distance = distance.bitcast::<S::i32s>() & S::i32s::splat(simd, 0xFFFF);
        Self(distance.simd_lt(S::i32s::splat(simd, UNCERTAIN)).to_bitmask())
    }

    /// The same of pixels from lane `first` on.
    #[inline(always)]
    #[must_use]
    pub(super) fn from(self, first: usize) -> Self {
        Self(self.0 << first)
    }

    /// The lanes of these pixels, of the first `count`.
    #[inline(always)]
    pub(super) fn lanes(self, count: usize) -> impl Iterator<Item = usize> {
        ones(self.0 & ((1 << count) - 1))
    }
}

/// The numbers of the bits that are set, from the lowest on.
#[inline(always)]
pub(super) fn ones(mask: u64) -> impl Iterator<Item = usize> {
    let mut rest = mask;
    std::iter::from_fn(move || {
        let bit = rest.trailing_zeros();
        rest &= rest.wrapping_sub(1);
        (bit < u64::BITS).then_some(bit as usize)
    })
}

impl std::ops::BitOrAssign for Uncertain {
    #[inline(always)]
    fn bitor_assign(&mut self, others: Self) {
        self.0 |= others.0;
    }
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
