//! What an arrangement of samples is: it places the samples of one pixel after the other, on a lattice of points: 256 of them
//! along each side of a pixel, or for the grid one for each of its columns.

#![expect(
    clippy::inline_always,
    reason = "a function that is not inlined into its dispatch loses the vector instructions"
)]

use std::fmt::Debug;
use std::sync::Arc;

use crate::raster::sampling::pattern::random_bits::mix_all;
use crate::raster::sampling::rate::SampleRate;

/// Column and row of a sample inside its pixel, in points of the lattice.
pub(crate) type Position = [u8; 2];

/// An arrangement of samples.
pub(in crate::raster::sampling) trait Arrange: Sync {
    /// Makes ready to place as many samples as `rate` says.
    fn prepare(&self, rate: SampleRate) -> Arc<dyn Place>;
}

/// Places the samples of one pixel after the other.
pub(in crate::raster::sampling) trait Place: Debug + Send + Sync {
    /// Makes the random bits of pixels from their numbers, see [`number_of`].
    fn random(&self, pixels: &mut [u64], seed: u64) {
        mix_all(pixels, seed);
    }

    /// Adds the places of the samples of pixels, one pixel after the other: each has random bits of its own.
    fn place(&self, pixels: &[u64], places: &mut Vec<Position>);

    /// Between what the mean column of the samples of any pixel lies, and the mean row.
    fn mean_range(&self) -> [f64; 2] {
        [0.0, f64::from(u8::MAX)]
    }
}

/// The column and the row of a pixel in one number, from which [`Place::random`] makes bits.
#[inline]
pub(in crate::raster::sampling) fn number_of([x, y]: [i32; 2]) -> u64 {
    u64::from(x.cast_unsigned()) | u64::from(y.cast_unsigned()) << 32
}

/// The random bits of pixels, each with new places for `count` samples.
#[inline]
pub(super) fn with_places<'p>(
    pixels: &'p [u64],
    count: usize,
    places: &'p mut Vec<Position>,
) -> impl Iterator<Item = (u64, &'p mut [Position])> {
    let first = places.len();
    places.resize(first + pixels.len() * count, [0; 2]);
    pixels.iter().copied().zip(places[first..].chunks_exact_mut(count))
}

/// Takes as many of these places as there is room for.
#[inline(always)]
pub(super) fn take_places<const N: usize>(found: &[Position; N], places: &mut [Position]) {
    // Of a length that is known they are moved at once, not by a call.
    if let Ok(places) = <&mut [Position; N]>::try_from(&mut *places) {
        *places = *found;
    } else {
        places.copy_from_slice(&found[..places.len()]);
    }
}

/// Places that need no random bits.
#[derive(Debug)]
pub(super) struct Fixed(Vec<Position>);

impl Fixed {
    /// Where `place` says, sample by sample, in points of the lattice.
    pub(super) fn by(rate: SampleRate, place: impl Fn(u32) -> [u32; 2]) -> Arc<dyn Place> {
        let places = (0..rate.samples()).map(|sample| place(sample).map(byte));
        Arc::new(Self(places.collect()))
    }
}

impl Place for Fixed {
    fn place(&self, pixels: &[u64], places: &mut Vec<Position>) {
        for _ in pixels {
            places.extend_from_slice(&self.0);
        }
    }
}

/// A point of the lattice, which has 256 along each side at most.
#[inline]
pub(super) fn byte(point: u32) -> u8 {
    debug_assert!(point < 256, "{point} lies on the lattice");
    let [low, ..] = point.to_le_bytes();
    low
}
