//! Cells of a pixel's side: which points of the lattice lie in each.

use super::arrange::byte;
use crate::geometry::subpixel::SubpixelGrid;

/// Where a cell begins along one side of a pixel, and how many points of the lattice have their middles in it: one at least,
/// where there are no more cells than points.
pub(super) type Cell = [u32; 2];

/// Those of `n` equal cells.
pub(super) fn cells(n: u32) -> Vec<Cell> {
    // The first point of the lattice whose middle lies in cell `k` or later.
    let first = |k: u32| (2 * k * SubpixelGrid::FINE_SIDE).saturating_sub(n).div_ceil(2 * n);
    (0..n).map(|k| [first(k), first(k + 1) - first(k)]).collect()
}

/// A point of a cell, by 16 random bits.
#[inline]
pub(super) fn anywhere([start, length]: Cell, random: u32) -> u8 {
    byte(start + ((random * length) >> 16))
}
