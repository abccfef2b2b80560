//! What the pixels of a row of a tile show, a bit for each, the first in the lowest one.

#![expect(
    clippy::inline_always,
    reason = "only what is inlined into a dispatched function is compiled for its vector instructions"
)]

use fearless_simd::prelude::*;
use fearless_simd::{Simd, u16x32};

use crate::raster::surface_id::{ROW, SPLIT, SurfaceId, TWO_SURFACES};

/// Pixels that are compared at once: half a row.
const AT_ONCE: usize = ROW / 2;

/// Which pixels of two rows show the same surface.
#[inline(always)]
pub(super) fn equal<S: Simd>(simd: S, row: &[SurfaceId; ROW], other: &[SurfaceId; ROW]) -> u64 {
    bits_equal(simd, row, other) | bits_equal(simd, &row[AT_ONCE..], &other[AT_ONCE..]) << AT_ONCE
}

/// Which pixels of a row show the surface of the next one; the last one has none.
#[inline(always)]
pub(super) fn equal_to_next<S: Simd>(simd: S, row: &[SurfaceId; ROW]) -> u64 {
    // The halves share a pixel, since the last one of the row has none next to it.
    bits_equal(simd, row, &row[1..]) | bits_equal(simd, &row[AT_ONCE - 1..], &row[AT_ONCE..]) << (AT_ONCE - 1)
}

/// Which pixels of a row show one surface.
#[inline(always)]
pub(super) fn whole<S: Simd>(simd: S, row: &[SurfaceId; ROW]) -> u64 {
    const { assert!(SPLIT == TWO_SURFACES + 1, "nothing lies above these two") };
    let mut bits = 0;
    for (at, row) in row.as_chunks::<AT_ONCE>().0.iter().enumerate() {
        let whole = u16x32::simd_from(simd, *row).simd_lt(u16x32::splat(simd, TWO_SURFACES));
        bits |= whole.to_bitmask() << (AT_ONCE * at);
    }
    bits
}

/// Which of the first pixels of two rows show the same surface.
#[inline(always)]
fn bits_equal<S: Simd>(simd: S, row: &[SurfaceId], other: &[SurfaceId]) -> u64 {
    let (Some(row), Some(other)) = (row.first_chunk::<AT_ONCE>(), other.first_chunk::<AT_ONCE>()) else {
        return 0;
    };
    u16x32::simd_from(simd, *row)
        .simd_eq(u16x32::simd_from(simd, *other))
        .to_bitmask()
}

#[cfg(test)]
mod tests {
    use fearless_simd::dispatch;

    use super::*;
    use crate::simd;

    #[test]
    fn rows_are_compared_as_pixel_by_pixel_on_every_level() {
        arbtest::arbtest(|u| {
            let mut row = || -> arbtest::arbitrary::Result<[SurfaceId; ROW]> {
                let mut row = [0; ROW];
                for surface in &mut row {
                    *surface = *u.choose(&[3, 3, 3, 4, 0x8000, TWO_SURFACES, SPLIT])?;
                }
                Ok(row)
            };
            let (row, other) = (row()?, row()?);
            let bits =
                |is_set: &dyn Fn(usize) -> bool| (0..ROW).fold(0_u64, |bits, x| bits | u64::from(is_set(x)) << x);
            for (name, level) in simd::tested() {
                dispatch!(level, simd => {
                    assert_eq!(equal(simd, &row, &other), bits(&|x| row[x] == other[x]), "{name}");
                    let next = bits(&|x| row.get(x + 1) == Some(&row[x]));
                    assert_eq!(equal_to_next(simd, &row), next, "{name}");
                    assert_eq!(whole(simd, &row), bits(&|x| row[x] < TWO_SURFACES), "{name}");
                });
            }
            Ok(())
        })
        .budget_ms(200);
    }
}
