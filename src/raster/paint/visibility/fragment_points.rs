//! Where the samples of fragments lie: the points that their masks name, one after the other.

#![expect(
    clippy::inline_always,
    reason = "only what is inlined into a dispatched function is compiled for its vector instructions"
)]

use fearless_simd::prelude::*;
use fearless_simd::{Simd, u8x32, u16x16, u32x8};

use crate::raster::paint::visibility::shading_queue::Fragment;
use crate::raster::sampling::place_sums::{TOGETHER, sixteen};
use crate::raster::sampling::positions::Position;
use crate::simd::{PACKED, pack_four};

/// The samples of pixels.
#[derive(Clone, Copy, Debug)]
pub(super) struct PixelPlaces<'p> {
    /// The first point of the lattice of each pixel.
    pub(super) corners: &'p [[u16; 2]],
    /// Where the samples of each lie inside, one pixel after the other; only once where they lie at the same places in all.
    pub(super) inside: &'p [Position],
    /// How many a pixel has.
    pub(super) count: usize,
}

/// The points of fragments, each of one of the pixels; `points` has room for all of them and [`PACKED`] more.
#[inline(always)]
pub(super) fn pack<S: Simd>(simd: S, fragments: &[Fragment], pixels: PixelPlaces<'_>, points: &mut [[u16; 2]]) {
    let step = if pixels.inside.len() == pixels.count {
        0
    } else {
        pixels.count
    };
    let mut at = 0;
    for ((i, Fragment { first, mask, .. }), corner) in fragments.iter().enumerate().zip(pixels.corners) {
        let [left, top] = corner.map(u32::from);
        let corner: u16x16<S> = u32x8::splat(simd, left | top << 16).bitcast();
        let of_pixel = &pixels.inside[i * step..][..pixels.count][usize::from(*first)..];
        let mut rest = *mask;
        for places in of_pixel.chunks(TOGETHER) {
            let (low, high) = u8x32::from_slice(simd, sixteen(places).as_flattened()).widen();
            for eight in [low + corner, high + corner] {
                let (low, high) = eight.split();
                for four in [low, high] {
                    if let Some(points) = points[at..].first_chunk_mut() {
                        at += pack_four(simd, four, rest, points);
                    }
                    rest >>= PACKED;
                }
            }
            if rest == 0 {
                break;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use fearless_simd::dispatch;

    use super::*;
    use crate::simd;

    #[test]
    fn packed_points_are_those_that_masks_name() {
        arbtest::arbtest(|u| {
            let count = *u.choose(&[1, 4, 16, 16, 33, 64, 100])?;
            let are_same: bool = u.arbitrary()?;
            let corners: Vec<[u16; 2]> = (0..7).map(|_| u.arbitrary()).collect::<Result<_, _>>()?;
            let pixels = if are_same { 1 } else { corners.len() };
            let inside: Vec<Position> = (0..pixels * count).map(|_| u.arbitrary()).collect::<Result<_, _>>()?;
            let mut expected = Vec::new();
            let mut fragments = Vec::new();
            for (i, [left, top]) in corners.iter().enumerate() {
                let first = u.int_in_range(0..=(count - 1) / 64)? * 64;
                let mask = u.arbitrary::<u64>()? & u64::MAX >> (64 - (count - first).min(64));
                fragments.push(Fragment {
                    first: u16::try_from(first).expect("a sample"),
                    pixel: 0,
                    mask,
                });
                let places = &inside[if are_same { 0 } else { i * count }..][..count][first..];
                for (bit, [column, row]) in places.iter().enumerate().take(64) {
                    if mask >> bit & 1 == 1 {
                        expected.push([left.wrapping_add((*column).into()), top.wrapping_add((*row).into())]);
                    }
                }
            }
            let pixels = PixelPlaces {
                corners: &corners,
                inside: &inside,
                count,
            };
            for (name, level) in simd::tested() {
                let mut found = vec![[0; 2]; expected.len() + PACKED];
                dispatch!(level, simd => pack(simd, &fragments, pixels, &mut found));
                found.truncate(expected.len());
                assert_eq!(found, expected, "{name}: {fragments:?}");
            }
            Ok(())
        })
        .budget_ms(200);
    }
}
