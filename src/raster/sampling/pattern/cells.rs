//! Cells of a pixel's side: which points of the lattice lie in each.

#![expect(
    clippy::inline_always,
    reason = "a function that is not inlined into its dispatch loses the vector instructions"
)]

use fearless_simd::prelude::*;
use fearless_simd::{Simd, u16x32};

use super::arrange::Position;
#[cfg(test)]
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

/// Between what the mean of one point in each cell lies.
pub(super) fn mean_range(cells: &[Cell]) -> [f64; 2] {
    let (mut least, mut most) = (0, 0);
    for [start, length] in cells {
        least += start;
        most += start + length.saturating_sub(1);
    }
    [least, most].map(|sum| f64::from(sum) / cells.len().max(1) as f64)
}

/// A point of a cell, by 16 random bits: what [`CellBlock::anywhere`] is tested against.
#[cfg(test)]
pub(super) fn anywhere([start, length]: Cell, random: u32) -> u8 {
    byte(start + ((random * length) >> 16))
}

/// Samples that are placed together.
pub(super) const TOGETHER: usize = 16;

/// The cells of [`TOGETHER`] samples: the column and the row of each, where it begins and how long it is.
#[derive(Clone, Debug)]
pub(super) struct CellBlock {
    pub(super) starts: [u16; 2 * TOGETHER],
    pub(super) lengths: [u16; 2 * TOGETHER],
}

impl CellBlock {
    /// Of columns and rows by turns.
    pub(super) fn new(cells: &[Cell]) -> Self {
        let narrow = |at: u32| u16::try_from(at).unwrap_or(u16::MAX);
        let (mut starts, mut lengths) = ([0; 2 * TOGETHER], [0; 2 * TOGETHER]);
        for ((start, length), cell) in starts.iter_mut().zip(&mut lengths).zip(cells) {
            [*start, *length] = cell.map(narrow);
        }
        Self { starts, lengths }
    }

    /// A point of each cell, by 16 random bits for each column and each row.
    #[inline(always)]
    pub(super) fn anywhere<S: Simd>(&self, simd: S, random: u16x32<S>) -> [Position; TOGETHER] {
        let (random, mut inside) = (random.to_array(), [0; 2 * TOGETHER]);
        for (i, inside) in inside.iter_mut().enumerate() {
            let [_, _, low, high] = (u32::from(random[i]) * u32::from(self.lengths[i])).to_le_bytes();
            *inside = u16::from_le_bytes([low, high]);
        }
        // Bytes are made in registers: two stores that one load reads again would make it wait.
        let (first, second) = (u16x32::simd_from(simd, inside) + u16x32::simd_from(simd, self.starts)).split();
        let mut found = [[0; 2]; TOGETHER];
        first.narrow(second).store_slice(found.as_flattened_mut());
        found
    }
}
