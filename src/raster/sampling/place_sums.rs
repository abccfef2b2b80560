//! What the places of some samples of a pixel add up to: enough to say where their middle is and how far they are spread.

#![expect(
    clippy::inline_always,
    reason = "only what is inlined into a dispatched function is compiled for its vector instructions"
)]

use fearless_simd::prelude::*;
use fearless_simd::{Simd, i16x32, i32x16, mask32x16, u8x32, u32x8, u32x16};

use crate::raster::sampling::positions::Position;

/// Samples whose places are looked at together.
pub(crate) const TOGETHER: usize = 16;

/// Pixels whose places are added up together.
const PIXELS: usize = 8;

/// Samples that a part of a table stands for.
const BYTE: usize = 8;

/// The sums over some samples of a pixel, in points of the lattice.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct PlaceSums {
    pub(crate) count: u32,
    /// Columns and rows.
    pub(crate) places: [u32; 2],
    /// Squares of columns, products of columns and rows, and squares of rows.
    pub(crate) squares: [u32; 3],
}

/// The sums over any samples of a pixel where these lie at the same places in every pixel: for each eight of them one sum for each
/// byte of a mask.
#[derive(Debug, Default)]
pub(crate) struct PlaceSumsByMask(Vec<[PlaceSums; 1 << BYTE]>);

impl PlaceSums {
    /// Of one sample.
    fn of([column, row]: Position) -> Self {
        let [x, y] = [column, row].map(u32::from);
        Self {
            count: 1,
            places: [x, y],
            squares: [x * x, x * y, y * y],
        }
    }

    #[inline(always)]
    fn plus(self, other: Self) -> Self {
        let ([x, y], [right, down]) = (self.places, other.places);
        let ([a, b, c], [xx, xy, yy]) = (self.squares, other.squares);
        Self {
            count: self.count + other.count,
            places: [x + right, y + down],
            squares: [a + xx, b + xy, c + yy],
        }
    }

    /// The mean column and row.
    pub(crate) fn means(&self) -> [f64; 2] {
        self.places.map(|sum| f64::from(sum) / f64::from(self.count.max(1)))
    }

    /// Of those of up to 64 samples that a mask names, the first one by its lowest bit; without `SQUARES` these are zero.
    #[inline(always)]
    pub(crate) fn of_masked<S: Simd, const SQUARES: bool>(simd: S, places: &[Position], mask: u64) -> Self {
        let mut sums = Self::default();
        for (first, places) in (0..u64::BITS).step_by(TOGETHER).zip(places.chunks(TOGETHER)) {
            let bits = mask >> first & ((1 << TOGETHER) - 1);
            if bits != 0 {
                sums = sums.plus(Self::of_sixteen::<S, SQUARES>(simd, &sixteen(places), bits));
            }
        }
        sums
    }

    /// Of all samples.
    #[inline(always)]
    pub(crate) fn of_all<S: Simd>(simd: S, places: &[Position]) -> Self {
        let mut sums = Self::default();
        for places in places.chunks(TOGETHER) {
            let bits = (1 << places.len()) - 1;
            sums = sums.plus(Self::of_sixteen::<S, true>(simd, &sixteen(places), bits));
        }
        sums
    }

    /// The columns and rows of all samples alone.
    #[inline(always)]
    pub(crate) fn places_of_all<S: Simd>(simd: S, places: &[Position]) -> [u32; 2] {
        let mut sums = [0; 2];
        for places in places.chunks(TOGETHER) {
            // Those that are made up lie at zero.
            let (first, second) = u8x32::from_slice(simd, sixteen(places).as_flattened()).widen();
            let both = sum(first.combine(second).bitcast());
            sums = [sums[0] + (both & 0xFFFF), sums[1] + (both >> 16)];
        }
        sums
    }

    /// [`PlaceSums::places_of_all`] of up to eight pixels of so many samples each, one pixel after the other: what columns add up to
    /// in the lower half of each lane, rows in the upper half.
    #[inline(always)]
    pub(crate) fn places_of_pixels<S: Simd>(simd: S, count: usize, places: &[Position]) -> u32x8<S> {
        if count == TOGETHER
            && let Some(places) = places.first_chunk::<{ PIXELS * TOGETHER }>()
        {
            return places_of_eight(simd, places.as_chunks().0);
        }
        let mut sums = [0; PIXELS];
        for (sum, places) in sums.iter_mut().zip(places.chunks_exact(count.max(1))) {
            let [columns, rows] = Self::places_of_all(simd, places);
            *sum = columns | rows << 16;
        }
        u32x8::simd_from(simd, sums)
    }

    #[inline(always)]
    fn of_sixteen<S: Simd, const SQUARES: bool>(simd: S, places: &[Position; TOGETHER], bits: u64) -> Self {
        let (first, second) = u8x32::from_slice(simd, places.as_flattened()).widen();
        let all: u32x16<S> = first.combine(second).bitcast();
        let named = mask32x16::from_bitmask(simd, bits).select(all, u32x16::splat(simd, 0));
        // Sixteen columns of a byte fit the lower half.
        let both = sum(named.bitcast());
        let squares = if SQUARES {
            let columns: i16x32<S> = (named & 0xFFFF).bitcast();
            let rows: i16x32<S> = (named >> 16).bitcast();
            [
                sum(columns.pairwise_dot_product(columns)),
                sum(columns.pairwise_dot_product(rows)),
                sum(rows.pairwise_dot_product(rows)),
            ]
        } else {
            [0; 3]
        };
        Self {
            count: bits.count_ones(),
            places: [both & 0xFFFF, both >> 16],
            squares,
        }
    }
}

/// As [`PlaceSums::places_of_pixels`] of eight pixels with [`TOGETHER`] samples each.
#[inline(always)]
fn places_of_eight<S: Simd>(simd: S, pixels: &[[Position; TOGETHER]]) -> u32x8<S> {
    // The first eight samples plus the last eight, one by one: a column in the lower half of each lane, a row in the upper.
    let halves = |i: usize| -> u32x8<S> {
        let (first, second) = u8x32::from_slice(simd, pixels[i].as_flattened()).widen();
        (first + second).bitcast()
    };
    // Lane by lane what two vectors add up to, those of the first and the second in turn.
    let both = |first: u32x8<S>, second: u32x8<S>| first.zip_low(second) + first.zip_high(second);
    let fours = [
        both(both(halves(0), halves(4)), both(halves(2), halves(6))),
        both(both(halves(1), halves(5)), both(halves(3), halves(7))),
    ];
    both(fours[0], fours[1])
}

/// The places of up to sixteen samples, and zeros.
#[inline(always)]
pub(crate) fn sixteen(places: &[Position]) -> [Position; TOGETHER] {
    if let Some(places) = places.first_chunk() {
        return *places;
    }
    let mut all = [[0; 2]; TOGETHER];
    all[..places.len()].copy_from_slice(places);
    all
}

#[inline(always)]
fn sum<S: Simd>(lanes: i32x16<S>) -> u32 {
    let mut sum = 0_u32;
    for lane in lanes.to_array() {
        sum = sum.wrapping_add(lane.cast_unsigned());
    }
    sum
}

impl PlaceSumsByMask {
    /// Of samples at these places.
    pub(crate) fn new(places: &[Position]) -> Self {
        let table = |places: &[Position]| {
            let mut sums = [PlaceSums::default(); 1 << BYTE];
            for (bit, place) in places.iter().enumerate() {
                // All with the bits below are known.
                let (known, others) = sums.split_at_mut(1 << bit);
                for (sum, known) in others.iter_mut().zip(known) {
                    *sum = known.plus(PlaceSums::of(*place));
                }
            }
            sums
        };
        Self(places.chunks(BYTE).map(table).collect())
    }

    /// Of those of 64 samples from `first` on, a multiple of 64, that a mask names.
    #[inline(always)]
    pub(crate) fn of(&self, first: usize, mask: u64) -> PlaceSums {
        let mut sums = PlaceSums::default();
        for (table, byte) in self.0[first / BYTE..].iter().zip(mask.to_le_bytes()) {
            sums = sums.plus(table[usize::from(byte)]);
        }
        sums
    }
}

#[cfg(test)]
mod tests {
    use fearless_simd::dispatch;

    use super::*;
    use crate::simd;

    #[test]
    fn sums_are_those_of_the_places_one_by_one() {
        arbtest::arbtest(|u| {
            let count = u.int_in_range(1..=256)?;
            let places: Vec<Position> = (0..count).map(|_| u.arbitrary()).collect::<Result<_, _>>()?;
            let table = PlaceSumsByMask::new(&places);
            for (first, places) in (0..).step_by(64).zip(places.chunks(64)) {
                let mask = u.arbitrary::<u64>()? & u64::MAX >> (64 - places.len());
                let named = places.iter().enumerate().filter(|(i, _)| mask >> i & 1 == 1);
                let expected = named.fold(PlaceSums::default(), |sums, (_, place)| {
                    sums.plus(PlaceSums::of(*place))
                });
                assert_eq!(table.of(first, mask), expected, "by the table: {mask:b} of {places:?}");
                for (name, level) in simd::tested() {
                    let found = dispatch!(level, simd => PlaceSums::of_masked::<_, true>(simd, places, mask));
                    assert_eq!(found, expected, "{name}: {mask:b} of {places:?}");
                }
            }
            let all = places
                .iter()
                .fold(PlaceSums::default(), |sums, place| sums.plus(PlaceSums::of(*place)));
            for (name, level) in simd::tested() {
                let found = dispatch!(level, simd => {
                    (PlaceSums::of_all(simd, &places), PlaceSums::places_of_all(simd, &places))
                });
                assert_eq!(found, (all, all.places), "{name}: all of {places:?}");
            }
            let count = *u.choose(&[16, 16, 5, 33])?;
            let pixels = places.chunks_exact(count).take(PIXELS);
            let expected: Vec<u32> = pixels
                .map(|places| {
                    let of = |axis: usize| places.iter().map(|place| u32::from(place[axis])).sum::<u32>();
                    of(0) | of(1) << 16
                })
                .collect();
            for (name, level) in simd::tested() {
                let found = dispatch!(level, simd => PlaceSums::places_of_pixels(simd, count, &places).to_array());
                assert_eq!(
                    found[..expected.len()],
                    expected,
                    "{name}: pixels of {count} of {places:?}"
                );
            }
            Ok(())
        })
        .budget_ms(300);
    }
}
