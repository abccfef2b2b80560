//! The first two dimensions of Sobol's sequence ("On the distribution of points in a cube and the approximate evaluation of
//! integrals", USSR Computational Mathematics and Mathematical Physics 7, 1967), a (0, 2)-sequence: of `2^m` points each
//! elementary interval of that area, cells as well as columns and rows, holds exactly one. Scrambled after Owen ("Randomly
//! permuted (t, m, s)-nets and (t, s)-sequences", 1995), which keeps that, with the hash of Laine and Karras as Burley has it
//! ("Practical hash-based Owen scrambling", Journal of Computer Graphics Techniques 9, 2020).

#![expect(
    clippy::inline_always,
    reason = "a function that is not inlined into its dispatch loses the vector instructions"
)]

use std::sync::Arc;

use fearless_simd::prelude::*;
use fearless_simd::{Simd, dispatch, u16x32, u32x16};

use super::arrange::{Arrange, Place, Position, take_places, with_places};
use super::cells::{cells, mean_range};
use super::random_bits::first_sixteen;
use crate::raster::sampling::rate::SampleRate;
use crate::simd;

/// Its first points, scrambled.
pub(super) struct Sobol;

/// The points of the sequence before they are scrambled: the first bits of each coordinate, the very first lowest.
///
/// The hash carries from lower to higher bits only. A place on the lattice takes eight bits, and so none above them has to be
/// known: numbers of 16 bits, of which every machine multiplies eight at once.
#[derive(Debug)]
struct Points {
    count: usize,
    /// [`TOGETHER`] at a time, the last ones followed by others.
    blocks: Vec<[[u16; 2]; TOGETHER]>,
}

/// Points that are scrambled together.
const TOGETHER: usize = 16;

impl Arrange for Sobol {
    fn prepare(&self, rate: SampleRate) -> Arc<dyn Place> {
        let first = |part: u32| first_sixteen(part.reverse_bits().into());
        let block = |number: u32| {
            let mut block = [[0; 2]; TOGETHER];
            for (point, number) in block.iter_mut().zip(number..) {
                *point = self::point(number).map(first);
            }
            block
        };
        Arc::new(Points {
            count: rate.samples() as usize,
            blocks: (0..rate.samples()).step_by(TOGETHER).map(block).collect(),
        })
    }
}

impl Place for Points {
    fn place(&self, pixels: &[u64], places: &mut Vec<Position>) {
        dispatch!(simd::level(), simd => self.place_with(simd, pixels, places));
    }

    fn mean_range(&self) -> [f64; 2] {
        match u32::try_from(self.count) {
            // Of so many columns, and rows, each holds one point.
            Ok(count) if count.is_power_of_two() => mean_range(&cells(count)),
            _ => [0.0, f64::from(u8::MAX)],
        }
    }
}

impl Points {
    #[inline(always)]
    fn place_with<S: Simd>(&self, simd: S, pixels: &[u64], places: &mut Vec<Position>) {
        for (random, places) in with_places(pixels, self.count, places) {
            let scramble = Scramble::new(simd, random);
            for (places, block) in places.chunks_mut(TOGETHER).zip(&self.blocks) {
                take_places(&scramble.places(block), places);
            }
        }
    }
}

/// Turns over each bit as a hash of those before it says: of columns and rows by turns.
#[derive(Clone, Copy)]
struct Scramble<S: Simd> {
    simd: S,
    added: u16x32<S>,
    factor: u16x32<S>,
}

impl<S: Simd> Scramble<S> {
    /// Columns by the lower half of these bits, rows by the upper one.
    #[inline(always)]
    fn new(simd: S, random: u64) -> Self {
        let [across, down] = [random, random >> 32];
        let by_turns = |column: u16, row: u16| {
            let pair = u32::from(column) | u32::from(row) << 16;
            u32x16::splat(simd, pair).bitcast()
        };
        Self {
            simd,
            added: by_turns(first_sixteen(across), first_sixteen(down)),
            factor: by_turns(first_sixteen(across >> 16) | 1, first_sixteen(down >> 16) | 1),
        }
    }

    /// The places on the lattice of points whose coordinates begin with these bits, the first one lowest.
    #[inline(always)]
    fn places(self, points: &[[u16; 2]; TOGETHER]) -> [Position; TOGETHER] {
        let number = |number| u16x32::splat(self.simd, number);
        let mut bits = u16x32::from_slice(self.simd, points.as_flattened());
        bits ^= bits * number(0xADEA);
        bits += self.added;
        bits *= self.factor;
        bits ^= bits * number(0x6C56);
        bits ^= bits * number(0x2864);
        // The lower byte, mirrored: its halves, quarters and bits change places.
        for (shift, low) in [(4, 0x0F), (2, 0x33), (1, 0x55)] {
            let low = number(low);
            bits = (bits >> shift) & low | (bits & low) << shift;
        }
        let (first, second) = bits.split();
        let mut found = [[0; 2]; TOGETHER];
        first.narrow(second).store_slice(found.as_flattened_mut());
        found
    }
}

/// A point of the sequence: the bits of its number mirrored; and combined as Pascal's triangle says.
pub(super) fn point(number: u32) -> [u32; 2] {
    let (mut bits, mut direction, mut second) = (number, 1 << 31, 0);
    while bits > 0 {
        if bits & 1 == 1 {
            second ^= direction;
        }
        bits >>= 1;
        direction ^= direction >> 1;
    }
    [number.reverse_bits(), second]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::raster::sampling::pattern::random_bits::halves;

    /// The hash as published, of all 32 bits.
    fn scrambled(value: u32, seed: u32) -> u32 {
        let mut bits = value.reverse_bits();
        bits ^= bits.wrapping_mul(0x3D20_ADEA);
        bits = bits.wrapping_add(seed);
        bits = bits.wrapping_mul(seed >> 16 | 1);
        bits ^= bits.wrapping_mul(0x0552_6C56);
        bits ^= bits.wrapping_mul(0x53A2_2864);
        bits.reverse_bits()
    }

    #[test]
    fn places_are_those_of_the_whole_hash() {
        arbtest::arbtest(|u| {
            let rate = SampleRate::new(u.int_in_range(1..=256)?).expect("a rate");
            let random = u.arbitrary()?;
            let mut places = Vec::new();
            Sobol.prepare(rate).place(&[random], &mut places);
            let seeds = halves(random);
            let expected: Vec<Position> = (0..rate.samples())
                .map(|number| {
                    let point = point(number);
                    [0, 1].map(|axis| {
                        let [top, ..] = scrambled(point[axis], seeds[axis]).to_be_bytes();
                        top
                    })
                })
                .collect();
            assert_eq!(places, expected, "{random:x}");
            Ok(())
        })
        .budget_ms(200);
    }

    #[test]
    fn each_elementary_interval_holds_one_point() {
        arbtest::arbtest(|u| {
            let log2 = u.int_in_range(0..=8_u32)?;
            let rate = SampleRate::new(1 << log2).expect("a rate");
            let mut places = Vec::new();
            Sobol.prepare(rate).place(&[u.arbitrary()?], &mut places);
            for across in 0..=log2 {
                let down = log2 - across;
                let mut intervals: Vec<[u32; 2]> = places
                    .iter()
                    .map(|[x, y]| [u32::from(*x) << across >> 8, u32::from(*y) << down >> 8])
                    .collect();
                intervals.sort_unstable();
                intervals.dedup();
                assert_eq!(
                    intervals.len(),
                    1 << log2,
                    "{places:?}: one in each of 2^{across} x 2^{down}"
                );
            }
            Ok(())
        })
        .budget_ms(200);
    }

    #[test]
    fn points_are_those_of_the_sequence() {
        let parts = |number| point(number).map(|part| f64::from(part) / f64::from(1_u32 << 31) / 2.0);
        let first = [0, 1, 2, 3, 4, 5].map(parts);
        // As published tables have it.
        let known = [
            [0.0, 0.0],
            [0.5, 0.5],
            [0.25, 0.75],
            [0.75, 0.25],
            [0.125, 0.625],
            [0.625, 0.125],
        ];
        assert_eq!(first, known, "the first points");
    }
}
