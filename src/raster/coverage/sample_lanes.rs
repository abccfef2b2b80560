//! The samples of a pixel side by side in vectors, and which of them lie on one side of an edge: several at once.
//!
//! An edge function is `value + right * column + down * row` at the points of a pixel's lattice. Coordinates on the lattice fit
//! 8 bits and steps 32, so that with a value of fewer than 50 bits all of it is exact in 64-bit floats; and where the value is
//! larger than that, it alone decides.

#![expect(
    clippy::inline_always,
    reason = "a function that is not inlined into its dispatch loses the vector instructions"
)]

use fearless_simd::Simd;
use fearless_simd::prelude::*;

use crate::raster::sampling::positions::{Position, SamplePositions};
use crate::raster::span::Span;

/// The most samples that a pixel may have here: a bit for each.
const MOST: usize = 64;

/// Jittered positions that are kept, by the lowest bits of their pixels' columns and rows.
const KEPT_BITS: [u32; 2] = [6, 5];

/// The samples of one pixel after the other.
#[derive(Debug)]
pub(in crate::raster) struct SampleLanes {
    positions: SamplePositions,
    count: usize,
    /// Where they lie: in every pixel, or in the one at work.
    columns: [f64; MOST],
    rows: [f64; MOST],
    /// The latest pixels, each with its positions; none where all are the same.
    pixels: Vec<[i32; 2]>,
    kept: Vec<Position>,
    memory: Vec<Position>,
}

/// An edge function in a pixel, in steps of its lattice.
#[derive(Clone, Copy, Debug)]
pub(super) struct PixelEdge {
    /// At the pixel's first point.
    pub(super) value: i64,
    /// What it gains one point to the right, and down.
    pub(super) right: i32,
    pub(super) down: i32,
}

impl SampleLanes {
    /// For patterns of at most 64 samples.
    pub(super) fn new(positions: SamplePositions) -> Option<Self> {
        let count = positions.count();
        if count > MOST {
            return None;
        }
        let pixels = if positions.are_same() {
            0
        } else {
            1 << KEPT_BITS.iter().sum::<u32>()
        };
        let mut lanes = Self {
            count,
            columns: [0.0; MOST],
            rows: [0.0; MOST],
            pixels: vec![[i32::MIN; 2]; pixels],
            kept: vec![[0; 2]; pixels * count],
            memory: Vec::with_capacity(MOST),
            positions,
        };
        if lanes.positions.are_same() {
            let places = lanes.positions.of_pixel([0; 2], &mut lanes.memory);
            set(&mut lanes.columns, &mut lanes.rows, places);
        }
        Some(lanes)
    }

    /// The bits of all samples.
    pub(super) fn all(&self) -> u64 {
        u64::MAX >> (MOST - self.count)
    }

    /// Goes to the pixel in this column and row of the frame.
    #[inline(always)]
    pub(super) fn go_to(&mut self, pixel: [i32; 2]) {
        if self.pixels.is_empty() {
            return;
        }
        let [column, row] = [0, 1].map(|i| (pixel[i].cast_unsigned() & ((1 << KEPT_BITS[i]) - 1)) as usize);
        let at = row << KEPT_BITS[0] | column;
        let kept = &mut self.kept[at * self.count..][..self.count];
        if self.pixels[at] != pixel {
            self.pixels[at] = pixel;
            kept.copy_from_slice(self.positions.of_pixel(pixel, &mut self.memory));
        }
        set(&mut self.columns, &mut self.rows, kept);
    }

    /// The samples at which an edge function is not below zero, and maybe bits beyond the last sample.
    #[inline(always)]
    pub(super) fn inside<S: Simd>(&self, simd: S, edge: PixelEdge) -> u64 {
        let lanes = S::f64s::LEN;
        let number = |value: f64| S::f64s::splat(simd, value);
        let (value, right, down) = (
            number(edge.value as f64),
            number(f64::from(edge.right)),
            number(f64::from(edge.down)),
        );
        let mut bits = 0;
        for first in (0..self.count).step_by(lanes) {
            let column = S::f64s::from_slice(simd, &self.columns[first..first + lanes]);
            let row = S::f64s::from_slice(simd, &self.rows[first..first + lanes]);
            let at = (value + right * column) + down * row;
            bits |= at.simd_ge(number(0.0)).to_bitmask() << first;
        }
        bits
    }

    /// The samples in some rows of the lattice, and maybe bits beyond the last sample.
    #[inline(always)]
    pub(super) fn in_rows<S: Simd>(&self, simd: S, rows: Span) -> u64 {
        let edge = |value: i32, down| PixelEdge {
            value: value.into(),
            right: 0,
            down,
        };
        self.inside(simd, edge(-rows.start, 1)) & self.inside(simd, edge(rows.end - 1, -1))
    }

    /// The number of a sample's row.
    #[inline]
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "a whole number below 256"
    )]
    pub(super) fn row(&self, sample: usize) -> usize {
        self.rows[sample % MOST] as usize
    }
}

#[inline(always)]
fn set(columns: &mut [f64; MOST], rows: &mut [f64; MOST], places: &[Position]) {
    for ((column, row), place) in columns.iter_mut().zip(rows).zip(places) {
        [*column, *row] = place.map(f64::from);
    }
}

#[cfg(test)]
mod tests {
    use fearless_simd::dispatch;

    use super::*;
    use crate::raster::{SamplePattern, SampleRate};
    use crate::simd;

    #[test]
    fn sides_of_edges_are_those_of_integers_on_every_level() {
        arbtest::arbtest(|u| {
            let pattern = *u.choose(&SamplePattern::ALL)?;
            let rates: &[u32] = if pattern.needs_square() {
                &[1, 4, 9, 16, 64]
            } else {
                &[1, 3, 16, 33, 63]
            };
            let rate = SampleRate::new(*u.choose(rates)?).expect("a rate");
            let positions = SamplePositions::new(pattern, rate, crate::raster::Seed::default());
            let mut lanes = SampleLanes::new(positions.clone()).expect("few samples");
            for _ in 0..8 {
                let pixel = [u.int_in_range(0..=200)?, u.int_in_range(0..=200)?];
                let mut memory = Vec::new();
                let places = positions.of_pixel(pixel, &mut memory);
                let shift = u.int_in_range(0..=30)?;
                let mut step = || -> arbtest::arbitrary::Result<i32> { Ok(u.arbitrary::<i32>()? >> shift) };
                let (right, down) = (step()?, step()?);
                // Often exactly on the edge.
                let [column, row] = u.choose(places)?.map(i64::from);
                let value = -(i64::from(right) * column + i64::from(down) * row) + u.int_in_range(-1..=1)?;
                let edge = PixelEdge { value, right, down };
                let start = u.int_in_range(0..=255)?;
                let rows = Span {
                    start,
                    end: u.int_in_range(start..=256)?,
                };
                let bit = |is: bool, sample: usize| u64::from(is) << sample;
                let (mut inside, mut in_rows) = (0, 0);
                for (sample, [column, row]) in places.iter().enumerate() {
                    let at = value + i64::from(right) * i64::from(*column) + i64::from(down) * i64::from(*row);
                    inside |= bit(at >= 0, sample);
                    in_rows |= bit((rows.start..rows.end).contains(&i32::from(*row)), sample);
                }
                lanes.go_to(pixel);
                for (name, level) in simd::tested() {
                    let found = dispatch!(level, simd => (lanes.inside(simd, edge), lanes.in_rows(simd, rows)));
                    let found = (found.0 & lanes.all(), found.1 & lanes.all());
                    assert_eq!(found, (inside, in_rows), "{name}: {edge:?} {rows:?} {places:?}");
                }
                for (sample, [_, row]) in places.iter().enumerate() {
                    assert_eq!(lanes.row(sample), usize::from(*row), "row of sample {sample}");
                }
            }
            Ok(())
        })
        .budget_ms(500);
    }
}
