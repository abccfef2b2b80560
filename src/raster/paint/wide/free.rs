//! Weighted sums of samples that lie anywhere in their pixels: each weighs what its own place says.

use crate::color::{ResolveSpace, WeightedSum};
use crate::raster::paint::sample_colors::{PixelColors, SampleColors};
use crate::raster::paint::wide::flat::FlatPixels;
use crate::raster::resolve::axis_weights::AxisWeights;
use crate::raster::sampling::positions::{Position, SamplePositions};

/// Where the samples of a pixel lie, and what a sample weighs by its place.
#[derive(Debug)]
pub(super) struct WeighedPositions {
    pub(super) positions: SamplePositions,
    pub(super) weights: AxisWeights,
}

/// Sums up weighted samples, reusing its memory.
#[derive(Debug)]
pub(super) struct FreeSums {
    space: ResolveSpace,
    /// Samples of a pixel.
    count: usize,
    /// Pixels on each side.
    margin: i32,
    /// Where samples lie at the same places in every pixel: what those of each pixel around weigh, and all of a pixel together.
    same: Vec<(i64, Vec<i64>)>,
    /// Else where those of each pixel of the tile lie.
    places: Vec<Position>,
    /// What the samples of one pixel weigh.
    weights: Vec<i64>,
}

impl FreeSums {
    pub(super) fn new(space: ResolveSpace, samples: &WeighedPositions) -> Self {
        let WeighedPositions { positions, weights } = samples;
        let margin = weights.margin();
        let around = (-margin..=margin).flat_map(|below| (-margin..=margin).map(move |right| [right, below]));
        let mut memory = Vec::new();
        let of_pixel = |beside: [i32; 2]| {
            let places = positions.of_pixel([0, 0], &mut memory);
            let all: Vec<i64> = weights.of_samples(beside, places).collect();
            (all.iter().sum(), all)
        };
        Self {
            space,
            count: positions.count(),
            margin,
            same: if positions.are_same() {
                around.map(of_pixel).collect()
            } else {
                Vec::new()
            },
            places: Vec::new(),
            weights: Vec::new(),
        }
    }

    /// What the samples of each pixel around one weigh, row by row, together and one by one, where they lie at the same places in
    /// every pixel; else nothing.
    pub(super) fn same(&self) -> &[(i64, Vec<i64>)] {
        &self.same
    }

    /// Calls `put` with each pixel of a tile that is not flat, by column and row, and its sum.
    pub(super) fn each(
        &mut self,
        colors: &SampleColors,
        samples: &WeighedPositions,
        flat: &FlatPixels,
        put: &mut impl FnMut([usize; 2], WeightedSum),
    ) {
        if self.same.is_empty() {
            self.find_places(colors, &samples.positions);
        }
        for y in 0..flat.height() {
            for x in flat.mixed(y).runs().flatten() {
                put([x, y], self.sum(colors, &samples.weights, [x, y]));
            }
        }
    }

    /// Notes where the samples of all pixels lie.
    fn find_places(&mut self, colors: &SampleColors, positions: &SamplePositions) {
        let mut memory = Vec::new();
        self.places.clear();
        for y in colors.rect.y.start..colors.rect.y.end {
            for x in colors.rect.x.start..colors.rect.x.end {
                self.places.extend(positions.of_pixel([x, y], &mut memory));
            }
        }
    }

    /// The sum of all samples around the pixel of the tile in column `x` and row `y`.
    fn sum(&mut self, colors: &SampleColors, weights: &AxisWeights, [x, y]: [usize; 2]) -> WeightedSum {
        let mut sum = WeightedSum::default();
        let around = (-self.margin..=self.margin).flat_map(|y| (-self.margin..=self.margin).map(move |x| [x, y]));
        for (number, beside) in around.enumerate() {
            let [right, below] = beside.map(|at| (at + self.margin).cast_unsigned() as usize);
            let index = (y + below) * colors.width() + x + right;
            let (all, each) = if let Some((all, each)) = self.same.get(number) {
                (*all, each)
            } else {
                let places = &self.places[index * self.count..][..self.count];
                self.weights.clear();
                self.weights.extend(weights.of_samples(beside, places));
                (self.weights.iter().sum(), &self.weights)
            };
            match colors.pixel(index) {
                PixelColors::Whole(color) => sum.add(all, self.space.parts(color)),
                PixelColors::Split(samples) => {
                    for (weight, sample) in each.iter().zip(samples) {
                        sum.add(*weight, self.space.parts(*sample));
                    }
                }
            }
        }
        sum
    }
}
