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
    /// Else where those of pixels around which one is not flat lie: row by row, from the first of these to the last.
    places: Vec<Position>,
    /// For each painted row where its places begin, and of which column these are.
    rows: Vec<(usize, usize)>,
    random: Vec<u64>,
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
            rows: Vec::new(),
            random: Vec::new(),
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
        self.find_places(colors, &samples.positions, flat);
        for y in 0..flat.height() {
            for x in flat.mixed(y).runs().flatten() {
                put([x, y], self.sum(colors, &samples.weights, [x, y]));
            }
        }
    }

    /// Notes where the samples of the pixels of a tile lie, unless that is the same in all: of those around which one is not flat.
    pub(super) fn find_places(&mut self, colors: &SampleColors, positions: &SamplePositions, flat: &FlatPixels) {
        self.places.clear();
        self.rows.clear();
        if !self.same.is_empty() {
            return;
        }
        let margin = self.margin.cast_unsigned() as usize;
        for (y, row) in (colors.rect.y.start..colors.rect.y.end).enumerate() {
            let around = flat.around(y, margin).word();
            let first = around.trailing_zeros();
            self.rows.push((self.places.len(), first as usize));
            if around != 0 {
                let start = colors.rect.x.start + first.cast_signed();
                let end = colors.rect.x.start + (u64::BITS - around.leading_zeros()).cast_signed() + 2 * self.margin;
                positions.add((start..end).map(|x| [x, row]), &mut self.random, &mut self.places);
            }
        }
    }

    /// Where the samples of the pixel in this column and row of what was painted lie; nowhere if that is the same in all.
    #[inline]
    pub(super) fn places_of(&self, [x, y]: [usize; 2]) -> &[Position] {
        if self.same.is_empty() {
            let (start, first) = self.rows[y];
            &self.places[start + (x - first) * self.count..][..self.count]
        } else {
            &[]
        }
    }

    /// The sum of all samples around the pixel of the tile in column `x` and row `y`.
    pub(super) fn sum(&self, colors: &SampleColors, weights: &AxisWeights, [x, y]: [usize; 2]) -> WeightedSum {
        let mut sum = WeightedSum::default();
        let around = (-self.margin..=self.margin).flat_map(|y| (-self.margin..=self.margin).map(move |x| [x, y]));
        for (number, beside) in around.enumerate() {
            let [right, below] = beside.map(|at| (at + self.margin).cast_unsigned() as usize);
            let (column, row) = (x + right, y + below);
            let pixel = colors.pixel(row * colors.width() + column);
            if let Some((all, each)) = self.same.get(number) {
                self.add(&mut sum, pixel, (*all, each.iter().copied()));
                continue;
            }
            let each = weights.of_samples(beside, self.places_of([column, row]));
            match pixel {
                PixelColors::Whole(_) => self.add(&mut sum, pixel, (each.sum(), std::iter::empty())),
                PixelColors::Split(_) => self.add(&mut sum, pixel, (0, each)),
            }
        }
        sum
    }

    /// Adds the samples of a pixel to a sum, by what all weigh together if they show one colour, else by what each does.
    fn add(&self, sum: &mut WeightedSum, pixel: PixelColors<'_>, (all, each): (i64, impl Iterator<Item = i64>)) {
        match pixel {
            PixelColors::Whole(color) => sum.add(all, self.space.parts(color)),
            PixelColors::Split(samples) => {
                for (weight, sample) in each.zip(samples) {
                    sum.add(weight, self.space.parts(*sample));
                }
            }
        }
    }
}
