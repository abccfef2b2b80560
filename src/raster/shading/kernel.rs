//! What kernels that shade several samples at once share.

#![expect(
    clippy::inline_always,
    reason = "only what is inlined into a dispatched function is compiled for its vector instructions"
)]

use fearless_simd::prelude::*;
use fearless_simd::{Simd, f64x8, u16x16, u32x8, u64x8};

use crate::color::Premultiplied16;
use crate::texture::SampleGrid;

/// Samples that are shaded together.
pub(super) const LANES: usize = 8;

/// The largest value of a channel.
pub(super) const ONE: f64 = Premultiplied16::ONE as f64;

/// At `2^52` a float holds whole numbers only, which then stand in its lower bits: cheaper than a conversion, which must
/// also care for numbers out of range.
pub(super) const WHOLE: f64 = 4_503_599_627_370_496.0;

/// The place of the first sample of a grid's origin, in samples.
#[inline(always)]
pub(super) fn first_sample(grid: SampleGrid) -> [f64; 2] {
    grid.origin.map(|pixel| f64::from(pixel) * f64::from(grid.side) + 0.5)
}

/// Columns and rows of up to [`LANES`] samples or pixels, at least one; what is left over repeats the first of them.
#[inline(always)]
pub(super) fn columns_and_rows<S: Simd>(simd: S, points: &[[u16; 2]]) -> [f64x8<S>; 2] {
    let mut all = [points[0]; LANES];
    // A number of lanes that is known makes vector code of the loop.
    if let Some(points) = points.first_chunk::<LANES>() {
        all = *points;
    } else {
        all[..points.len()].copy_from_slice(points);
    }
    let both: u32x8<S> = u16x16::from_slice(simd, all.as_flattened()).bitcast();
    [number(both & 0xFFFF), number(both >> 16)]
}

/// Whole numbers as floats: see [`WHOLE`].
#[inline(always)]
pub(super) fn number<S: Simd>(whole: u32x8<S>) -> f64x8<S> {
    let (low, high) = whole.widen();
    let bits: u64x8<S> = low.combine(high) | WHOLE.to_bits();
    bits.bitcast::<f64x8<S>>() - WHOLE
}

/// Where up to [`LANES`] samples lie, in samples of the frame, as [`columns_and_rows`] has them.
#[inline(always)]
pub(super) fn places_of<S: Simd>(simd: S, grid: SampleGrid, points: &[[u16; 2]]) -> [f64x8<S>; 2] {
    let [left, top] = first_sample(grid);
    let [columns, rows] = columns_and_rows(simd, points);
    [columns + left, rows + top]
}

/// Numbers of `0.0..=limit` (clamped, at most `2^32`) rounded to whole ones; what is no number becomes 0.
#[inline(always)]
pub(super) fn whole<S: Simd>(simd: S, value: f64x8<S>, limit: f64) -> u64x8<S> {
    whole_up_to(simd, value, f64x8::splat(simd, limit))
}

/// The same with a limit for each.
#[inline(always)]
pub(super) fn whole_up_to<S: Simd>(simd: S, value: f64x8<S>, limit: f64x8<S>) -> u64x8<S> {
    let value = value.max_precise(f64x8::splat(simd, 0.0)).min(limit) + WHOLE;
    value.bitcast::<u64x8<S>>() & 0xFFFF_FFFF
}

/// The lower half of some bits.
#[inline(always)]
#[expect(clippy::cast_possible_truncation, reason = "the lower half is meant")]
pub(super) fn low_word(bits: u64) -> u32 {
    bits as u32
}
