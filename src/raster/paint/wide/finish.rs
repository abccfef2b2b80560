//! Weighted sums to pixels.

use crate::color::{Premultiplied16, ResolveSpace, WeightedSum};
use crate::raster::paint::sample_colors::{PixelColors, SampleColors};
use crate::raster::resolve::axis_weights::AxisWeights;
use crate::rules::Rules;

/// Whether the weights of all samples, of which a pixel has `count`, add up to so little that they mean nothing.
pub(super) fn is_too_little(weight: i64, count: usize) -> bool {
    let even = AxisWeights::ONE * AxisWeights::ONE * count as f64;
    (weight as f64) < even / 8.0
}

/// Makes pixels of sums.
pub(super) struct Finish<'s> {
    pub(super) colors: &'s SampleColors,
    pub(super) margin: usize,
    pub(super) space: ResolveSpace,
    pub(super) rules: Rules,
    pub(super) clamped: Option<fn([f64; 2], u32) -> u32>,
}

impl Finish<'_> {
    /// The pixel of the tile in column `x` and row `y`.
    pub(super) fn pixel(&self, at: [usize; 2], sum: WeightedSum) -> u32 {
        let pixel = self.color(at, sum);
        let Some(color) = self.clamped else {
            return pixel;
        };
        let is_its_own = is_too_little(sum.weight, self.colors.per_pixel());
        let beyond = if is_its_own {
            [0.0; 2]
        } else {
            self.space.beyond_pixel(sum)
        };
        color(beyond, pixel)
    }

    /// Its colour.
    fn color(&self, [x, y]: [usize; 2], sum: WeightedSum) -> u32 {
        if is_too_little(sum.weight, self.colors.per_pixel()) {
            return self.own([x, y]);
        }
        // The light of what shines through is rounded once for each sample: alike ones are not to suffer from that.
        let shines_through = sum.channels[3] != i64::from(Premultiplied16::ONE) * sum.weight;
        if self.space == ResolveSpace::Linear
            && shines_through
            && let Some(color) = self.only_color([x, y])
        {
            return color.to_pixel(self.rules);
        }
        self.space.weighted_pixel(sum, self.rules)
    }

    /// The mean of its own samples.
    fn own(&self, [x, y]: [usize; 2]) -> u32 {
        match self
            .colors
            .pixel((y + self.margin) * self.colors.width() + x + self.margin)
        {
            PixelColors::Whole(color) => color.to_pixel(self.rules),
            PixelColors::Split(samples) => self.space.resolve(samples, self.rules),
        }
    }

    /// What all samples around it show, if that is one colour.
    fn only_color(&self, [x, y]: [usize; 2]) -> Option<Premultiplied16> {
        let side = 2 * self.margin + 1;
        let first = y * self.colors.width() + x;
        let indices = (0..side).flat_map(|row| (0..side).map(move |column| (row, column)));
        let mut only = None;
        for (row, column) in indices {
            let index = first + row * self.colors.width() + column;
            let whole;
            let samples = match self.colors.pixel(index) {
                PixelColors::Whole(color) => {
                    whole = [color];
                    &whole[..]
                }
                PixelColors::Split(samples) => samples,
            };
            for sample in samples {
                if *only.get_or_insert(*sample) != *sample {
                    return None;
                }
            }
        }
        only
    }
}
