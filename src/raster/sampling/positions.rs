//! Where the samples of each pixel lie, on the lattice of a sub-pixel grid.

use std::sync::Arc;

use crate::geometry::subpixel::SubpixelGrid;
use crate::raster::sampling::pattern::Seed;
pub(crate) use crate::raster::sampling::pattern::arrange::Position;
use crate::raster::sampling::pattern::arrange::{Place, number_of};
use crate::raster::{SamplePattern, SampleRate};

/// Where the samples of each pixel lie.
#[derive(Clone, Debug)]
pub(crate) struct SamplePositions {
    /// How many samples a pixel has.
    count: usize,
    /// Where they lie in every pixel; empty where each pixel has its own.
    same: Vec<Position>,
    /// What places those of each pixel, by its place and these random bits.
    own: Arc<dyn Place>,
    seed: u64,
    /// The column and the row of the frame's first pixel in what is painted.
    margin: i32,
}

/// The lattice that the samples of a pattern lie on.
pub(crate) fn lattice(pattern: SamplePattern, rate: SampleRate) -> SubpixelGrid {
    match pattern {
        SamplePattern::Grid => SubpixelGrid::new(rate.side()),
        _ => SubpixelGrid::fine(),
    }
}

impl SamplePositions {
    /// The places of a pattern on its [`lattice`].
    pub(crate) fn new(pattern: SamplePattern, rate: SampleRate, seed: Seed) -> Self {
        let own = pattern.arrange().prepare(rate);
        let seed = seed.bits();
        let mut same = Vec::new();
        if !pattern.differs_by_pixel() {
            own.place(&[seed], &mut same);
        }
        Self {
            count: rate.samples() as usize,
            same,
            own,
            seed,
            margin: 0,
        }
    }

    /// The same in a frame around which so many pixels are painted on each side.
    pub(crate) fn with_margin(self, margin: u32) -> Self {
        Self {
            margin: margin.cast_signed(),
            ..self
        }
    }

    /// How many samples a pixel has.
    pub(crate) fn count(&self) -> usize {
        self.count
    }

    /// Whether they lie at the same places in every pixel.
    pub(crate) fn are_same(&self) -> bool {
        !self.same.is_empty()
    }

    /// Where the samples of a pixel lie, by its column and row in what is painted; `memory` is overwritten.
    #[inline]
    pub(crate) fn of_pixel<'s>(&'s self, [x, y]: [i32; 2], memory: &'s mut Vec<Position>) -> &'s [Position] {
        if !self.same.is_empty() {
            return &self.same;
        }
        let mut random = [self.number_of([x, y])];
        self.own.random(&mut random, self.seed);
        memory.clear();
        self.own.place(&random, memory);
        memory
    }

    /// Adds where the samples of pixels lie, one pixel after the other, by their columns and rows in what is painted; `random` is
    /// overwritten.
    pub(crate) fn add(
        &self,
        pixels: impl Iterator<Item = [i32; 2]>,
        random: &mut Vec<u64>,
        places: &mut Vec<Position>,
    ) {
        random.clear();
        random.extend(pixels.map(|pixel| self.number_of(pixel)));
        self.own.random(random, self.seed);
        self.own.place(random, places);
    }

    /// Between what the mean column of the samples of any pixel lies, and the mean row.
    pub(crate) fn mean_range(&self) -> [f64; 2] {
        self.own.mean_range()
    }

    /// The number of a pixel, by its column and row in what is painted.
    #[inline]
    fn number_of(&self, [x, y]: [i32; 2]) -> u64 {
        // A pixel of the frame has the same one however much is painted around it.
        number_of([x - self.margin, y - self.margin])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn means_lie_in_their_range() {
        for pattern in SamplePattern::ALL
            .into_iter()
            .filter(|pattern| pattern.differs_by_pixel())
        {
            let rates = [1, 2, 3, 4, 9, 16, 33, 64, 256].map(|samples| SampleRate::new(samples).expect("a rate"));
            for rate in rates.into_iter().filter(|rate| pattern.takes(*rate)) {
                let positions = SamplePositions::new(pattern, rate, Seed::default());
                let [least, most] = positions.mean_range();
                for i in 0..200 {
                    let places = positions.of_pixel([i, i * i % 17], &mut Vec::new()).to_vec();
                    for axis in 0..2 {
                        let sum: u32 = places.iter().map(|place| u32::from(place[axis])).sum();
                        let mean = f64::from(sum) / f64::from(rate.samples());
                        assert!(
                            (least..=most).contains(&mean),
                            "{pattern:?}, {rate:?}: {mean} is not in {least}..={most}"
                        );
                    }
                }
            }
        }
    }
}
