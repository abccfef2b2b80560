//! Where the samples of pixels lie in a level, in 64-bit floats: for filters that weigh areas, up to sixteen at a time.

#![expect(
    clippy::inline_always,
    reason = "a function that is not inlined into its dispatch loses the vector instructions"
)]

use glam::DVec2;

use super::filter_plan::{Axis, PixelList, Plan};

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
            self.each(plan, *pixel, list.masks.map(|masks| masks[i]), |places| add(places, sum));
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
