//! Random bits that depend on nothing but what they are of: a pixel, a sample, a seed.

#![expect(
    clippy::inline_always,
    reason = "a function that is not inlined into its dispatch loses the vector instructions"
)]

use fearless_simd::prelude::*;
use fearless_simd::{Simd, dispatch, u64x8};

use crate::simd;

/// What the bits of a pixel gain from number to number: `2^64` by the golden ratio.
const GOLDEN: u64 = 0x9E37_79B9_7F4A_7C15;
const FACTORS: [u64; 2] = [0xBF58_476D_1CE4_E5B9, 0x94D0_49BB_1331_11EB];

/// Random bits, number by number, of a pixel: what [`hash_eight`] is tested against.
#[cfg(test)]
pub(in crate::raster::sampling) fn hash(pixel: u64, number: u64) -> u64 {
    mix(pixel.wrapping_add((number + 1).wrapping_mul(GOLDEN)))
}

/// Random bits of a pixel, of eight numbers one after the other.
#[inline(always)]
pub(super) fn hash_eight<S: Simd>(simd: S, pixel: u64, first: u64) -> u64x8<S> {
    let steps = [1_u64, 2, 3, 4, 5, 6, 7, 8].map(|number| number.wrapping_mul(GOLDEN));
    let number = |value| u64x8::splat(simd, value);
    let first = number(pixel.wrapping_add(first.wrapping_mul(GOLDEN)));
    mix_eight(simd, u64x8::simd_from(simd, steps) + first)
}

/// [`mix`] of each of these and of a seed.
pub(super) fn mix_all(all: &mut [u64], seed: u64) {
    dispatch!(simd::level(), simd => mix_all_with(simd, all, seed));
}

#[inline(always)]
fn mix_all_with<S: Simd>(simd: S, all: &mut [u64], seed: u64) {
    let (eights, rest) = all.as_chunks_mut();
    for bits in eights {
        let seeded = u64x8::simd_from(simd, *bits) ^ u64x8::splat(simd, seed);
        *bits = mix_eight(simd, seeded).to_array();
    }
    for bits in rest {
        *bits = mix(*bits ^ seed);
    }
}

/// [`mix`] of eight at once.
#[inline(always)]
fn mix_eight<S: Simd>(simd: S, mut bits: u64x8<S>) -> u64x8<S> {
    bits = (bits ^ bits >> 30) * u64x8::splat(simd, FACTORS[0]);
    bits = (bits ^ bits >> 27) * u64x8::splat(simd, FACTORS[1]);
    bits ^ bits >> 31
}

/// The finaliser of `SplitMix` (Steele, Lea and Flood, "Fast splittable pseudorandom number generators", OOPSLA 2014).
#[inline]
pub(in crate::raster::sampling) fn mix(mut bits: u64) -> u64 {
    bits = (bits ^ bits >> 30).wrapping_mul(FACTORS[0]);
    bits = (bits ^ bits >> 27).wrapping_mul(FACTORS[1]);
    bits ^ bits >> 31
}

/// The lowest 16 of some random bits.
#[cfg(test)]
pub(super) fn low_quarter(random: u64) -> u32 {
    first_sixteen(random).into()
}

/// The same as a number that has no more.
#[inline]
pub(super) fn first_sixteen(random: u64) -> u16 {
    let [low, high, ..] = random.to_le_bytes();
    u16::from_le_bytes([low, high])
}

/// The lower and the upper half of some random bits.
pub(super) fn halves(random: u64) -> [u32; 2] {
    let [a, b, c, d, e, f, g, h] = random.to_le_bytes();
    [u32::from_le_bytes([a, b, c, d]), u32::from_le_bytes([e, f, g, h])]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn eight_numbers_are_hashed_as_one_by_one() {
        arbtest::arbtest(|u| {
            let (pixel, first) = (u.arbitrary()?, u.int_in_range(0..=255)?);
            let expected: Vec<u64> = (first..first + 8).map(|number| hash(pixel, number)).collect();
            for (name, level) in simd::tested() {
                let found: [u64; 8] = dispatch!(level, simd => hash_eight(simd, pixel, first).to_array());
                assert_eq!(found.to_vec(), expected, "{name}: {pixel:x} from {first}");
            }
            Ok(())
        })
        .budget_ms(100);
    }

    #[test]
    fn many_are_mixed_as_one_by_one() {
        arbtest::arbtest(|u| {
            let all: Vec<u64> = (0..u.int_in_range(0..=30)?)
                .map(|_| u.arbitrary())
                .collect::<Result<_, _>>()?;
            let seed = u.arbitrary()?;
            let expected: Vec<u64> = all.iter().map(|bits| mix(bits ^ seed)).collect();
            for (name, level) in simd::tested() {
                let mut found = all.clone();
                dispatch!(level, simd => mix_all_with(simd, &mut found, seed));
                assert_eq!(found, expected, "{name}: {all:x?} of {seed:x}");
            }
            Ok(())
        })
        .budget_ms(100);
    }
}
