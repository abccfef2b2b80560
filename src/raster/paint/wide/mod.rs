//! The resolve of tiles whose pixels take samples of their neighbours too.
//!
//! A tile is painted with a margin, down to the colour of each sample, and each of its own pixels is the weighted sum of all samples
//! around it.
//! All sums are whole numbers: they do not depend on the order of their terms, and so neither on tiles and threads nor on the
//! way that a pixel goes:
//!
//! | pixels | by |
//! |---|---|
//! | in the middle of pixels that show one colour | nothing but that colour ([`flat`]) |
//! | in the middle of a gradient's pixels, or of a triangle's | the colour there, if it is certain (`visibility::wide_shades`) |
//! | with at most 4 x 4 samples or so on a grid, of stored values | rows, then columns, in numbers of 16 bits ([`dot_sums`], [`dot_means`]) |
//! | with samples on a grid | rows, then columns ([`separable`]) |
//! | with stored values at the same places in every pixel | all pixels around a split one at once ([`same_places`]) |
//! | with opaque samples anywhere, and in light | 32-bit floats, if these leave nothing open ([`near_sums`], [`near_means`]) |
//! | with samples anywhere | each sample's own weight ([`free`]) |
//!
//! Where samples lie anywhere, weights below zero may happen to outweigh the others. A pixel whose weights add up to less than
//! an eighth of what evenly spread samples would weigh is the mean of its own samples.

mod dot_means;
mod dot_sums;
mod finish;
pub(in crate::raster::paint) mod flat;
mod free;
mod near_means;
mod near_sums;
#[cfg(test)]
mod random_tile;
mod same_places;
mod separable;

use crate::color::{Premultiplied16, ResolveSpace, WeightedSum};
use crate::raster::frame::block::PixelBlock;
use crate::raster::paint::sample_colors::SampleColors;
use crate::raster::paint::wide::dot_sums::DotSums;
use crate::raster::paint::wide::finish::{Finish, is_too_little};
use crate::raster::paint::wide::flat::FlatPixels;
use crate::raster::paint::wide::free::{FreeSums, WeighedPositions};
use crate::raster::paint::wide::near_sums::{NearSums, PaintedTile};
use crate::raster::paint::wide::same_places::SamePlaces;
use crate::raster::paint::wide::separable::SeparableSums;
use crate::raster::resolve::axis_weights::AxisWeights;
use crate::raster::sampling::positions::{Position, SamplePositions};
use crate::raster::shading::context::ShadeContext;
use crate::rules::Rules;

/// The most samples along the side of a pixel, on a grid, for which all pixels around a sample at once take less time than rows and then
/// columns.
const MOST_NEAR: i32 = 8;

/// Resolves tiles, one after the other, reusing its memory.
#[derive(Debug)]
pub(in crate::raster) struct WideResolve {
    samples: WeighedPositions,
    space: ResolveSpace,
    rules: Rules,
    /// What becomes of pixels by how far they were clamped, where that is shown.
    clamped: Option<fn([f64; 2], u32) -> u32>,
    flat: FlatPixels,
    /// What resolves tiles of opaque samples without `sums`.
    near: Option<NearSums>,
    sums: Sums,
}

/// What sums up weighted samples.
#[derive(Debug)]
enum Sums {
    /// Stored values on a grid, so few that a row's sum fits 32 bits.
    Dots(DotSums),
    /// Stored values on a grid: the sums fit the whole numbers of floats.
    Stored(SeparableSums<f64>),
    /// Light on a grid.
    Light(SeparableSums<i64>),
    /// Stored values at the same places in every pixel.
    Same(SamePlaces),
    /// Samples anywhere.
    Free(FreeSums),
}

/// What each sample of a pixel weighs, and shows.
pub(in crate::raster) type WeighedSamples = Vec<(i64, Premultiplied16)>;

/// The samples that a pixel is made of.
#[derive(Clone, Debug, PartialEq)]
pub(in crate::raster) struct WeighedPixels {
    /// Of each pixel that has any: how many columns and rows beside the pixel it lies, and what its samples weigh, in the order
    /// of the pattern, and show.
    pub(in crate::raster) pixels: Vec<([i32; 2], WeighedSamples)>,
    /// Of all of them.
    pub(in crate::raster) sum: WeightedSum,
    /// Whether the filter's weights add up to too little, so that the pixel is the mean of its own samples.
    pub(in crate::raster) is_own_mean: bool,
}

impl Sums {
    /// Of samples that do not lie on a grid.
    fn free(space: ResolveSpace, samples: &WeighedPositions) -> Self {
        let sums = FreeSums::new(space, samples);
        let margin = samples.weights.margin().cast_unsigned() as usize;
        match space {
            ResolveSpace::Stored if !sums.same().is_empty() => {
                SamePlaces::new(sums.same(), margin).map_or(Self::Free(sums), Self::Same)
            }
            ResolveSpace::Stored | ResolveSpace::Linear => Self::Free(sums),
        }
    }
}

impl WideResolve {
    /// For one drawing.
    pub(in crate::raster) fn new(context: &ShadeContext<'_>, positions: &SamplePositions) -> Self {
        let side = context.grid.side();
        let samples = WeighedPositions {
            positions: positions.clone(),
            weights: AxisWeights::new(context.filter, side),
        };
        let is_grid = (side * side).cast_unsigned() == context.rate.samples();
        let rules = context.sampling.rules;
        let sums = match context.space {
            _ if !is_grid => Sums::free(context.space, &samples),
            ResolveSpace::Stored => match DotSums::new(&samples.weights, side, rules) {
                // They clamp what they sum up at once.
                Some(sums) if context.clamped.is_none() && !is_too_little(sums.total(), positions.count()) => {
                    Sums::Dots(sums)
                }
                _ => Sums::Stored(SeparableSums::new(context.space, &samples.weights, side)),
            },
            ResolveSpace::Linear => Sums::Light(SeparableSums::new(context.space, &samples.weights, side)),
        };
        let is_near = match sums {
            Sums::Dots(_) | Sums::Stored(_) => false,
            Sums::Light(_) => side <= MOST_NEAR,
            Sums::Same(_) | Sums::Free(_) => true,
        };
        // They, too, clamp what they sum up at once.
        let is_near = is_near && context.clamped.is_none();
        let near = is_near.then(|| NearSums::new(context.space, &samples, rules)).flatten();
        Self {
            samples,
            near,
            space: context.space,
            rules,
            clamped: context.clamped,
            flat: FlatPixels::default(),
            sums,
        }
    }

    /// Resolves the pixels of `block` from the samples around them.
    pub(in crate::raster) fn resolve(&mut self, colors: &SampleColors, block: &mut PixelBlock<'_>) {
        self.flat.find(colors, self.margin());
        self.put_flat(colors, block);
        self.resolve_mixed(colors, block);
    }

    /// Pixels on each side of a tile that are painted with it.
    pub(in crate::raster::paint) fn margin(&self) -> usize {
        self.samples.weights.margin().cast_unsigned() as usize
    }

    /// What weights add up to without their signs, in parts of what they do with these, where they are the same around every pixel,
    /// on both of its sides, and weigh stored values.
    pub(in crate::raster::paint) fn unsigned(&self) -> Option<f64> {
        match &self.sums {
            Sums::Dots(_) | Sums::Stored(_) => self.samples.weights.unsigned(),
            Sums::Light(_) | Sums::Same(_) | Sums::Free(_) => None,
        }
    }

    /// Which pixels of the tile are flat, for those who find them in another way.
    pub(in crate::raster::paint) fn flat(&mut self) -> &mut FlatPixels {
        &mut self.flat
    }

    /// Resolves the pixels that are not flat: of others than those around them no colours are looked at.
    pub(in crate::raster::paint) fn resolve_mixed(&mut self, colors: &SampleColors, block: &mut PixelBlock<'_>) {
        let margin = self.margin();
        if self.flat.are_all() {
            return;
        }
        if let Sums::Dots(sums) = &mut self.sums {
            return sums.resolve(colors, &self.flat, block);
        }
        let finish = Finish {
            colors,
            margin,
            space: self.space,
            rules: self.rules,
            clamped: self.clamped,
        };
        if let Some(near) = &mut self.near {
            let tile = PaintedTile {
                colors,
                samples: &self.samples,
                flat: &self.flat,
            };
            if near.resolve(tile, &finish, block) {
                return;
            }
        }
        let mut put = |[x, y]: [usize; 2], sum: WeightedSum| {
            let line = block.line(block.rect.y.start + i32::try_from(y).unwrap_or(0));
            line[x] = finish.pixel([x, y], sum);
        };
        match &mut self.sums {
            Sums::Dots(_) => {}
            Sums::Stored(sums) => sums.each(colors, &self.flat, &mut put),
            Sums::Light(sums) => sums.each(colors, &self.flat, &mut put),
            Sums::Same(sums) => sums.each(colors, &self.flat, &mut put),
            Sums::Free(sums) => sums.each(colors, &self.samples, &self.flat, &mut put),
        }
    }

    /// Resolves what needs no sum.
    fn put_flat(&self, colors: &SampleColors, block: &mut PixelBlock<'_>) {
        let margin = self.margin();
        let width = self.flat.width();
        for (y, row) in (0..).zip(block.rect.y.start..block.rect.y.end) {
            let (whole, _) = colors.row(y + margin);
            let (whole, line) = (&whole[margin..][..width], block.line(row));
            for run in self.flat.mixed(y).others(width).runs() {
                // Those of a run are among each other's neighbours, and so of one colour, where a pixel has any.
                let alike = if margin == 0 { 1 } else { run.len() };
                for (colors, pixels) in whole[run.clone()].chunks(alike).zip(line[run].chunks_mut(alike)) {
                    let pixel = colors[0].to_pixel(self.rules);
                    pixels.fill(self.clamped.map_or(pixel, |color| color([0.0; 2], pixel)));
                }
            }
        }
    }

    /// The samples of a tile of one pixel and its margin, with what each weighs.
    pub(in crate::raster) fn neighbourhood(&self, colors: &SampleColors) -> WeighedPixels {
        let margin = self.samples.weights.margin();
        let WeighedPositions { positions, weights } = &self.samples;
        let count = positions.count();
        let corner = [colors.rect.x.start, colors.rect.y.start];
        let mut memory = Vec::new();
        let mut of_pixel = |[right, below]: [i32; 2]| {
            let pixel = [corner[0] + margin + right, corner[1] + margin + below];
            let places: &[Position] = positions.of_pixel(pixel, &mut memory);
            let weights = weights.of_samples([right, below], places);
            let colors = (0..count).map(|sample| colors.sample(pixel[0], pixel[1], sample));
            weights.zip(colors).collect::<Vec<_>>()
        };
        let around = (-margin..=margin).flat_map(|below| (-margin..=margin).map(move |right| [right, below]));
        let mut pixels: Vec<_> = around.map(|beside| (beside, of_pixel(beside))).collect();
        let samples = pixels.iter().flat_map(|(_, samples)| samples);
        let is_own_mean = is_too_little(samples.map(|(weight, _)| weight).sum(), count);
        if is_own_mean {
            pixels.retain(|(beside, _)| *beside == [0, 0]);
            for (weight, _) in pixels.iter_mut().flat_map(|(_, samples)| samples) {
                *weight = 1;
            }
        }
        pixels.retain(|(_, samples)| samples.iter().any(|(weight, _)| *weight != 0));
        let mut sum = WeightedSum::default();
        for (weight, color) in pixels.iter().flat_map(|(_, samples)| samples) {
            sum.add(*weight, self.space.parts(*color));
        }
        WeighedPixels {
            pixels,
            sum,
            is_own_mean,
        }
    }
}
