//! What samples that are shaded and rounded one by one are averaged with, and the memory for it: `resolve_by_samples` uses it.

#![expect(
    clippy::inline_always,
    reason = "a function that is not inlined into its dispatch loses the vector instructions"
)]

use fearless_simd::{Simd, dispatch};

use crate::color::{Light, Premultiplied16, RunningSums, SampleMean};
use crate::raster::frame::block::PixelBlock;
use crate::raster::paint::put_runs::put_runs;
use crate::raster::paint::visibility::bounded_parts::BoundedParts;
use crate::raster::paint::visibility::known_pixels::KnownPixels;
use crate::raster::paint::visibility::shading_queue::Fragment;
use crate::raster::paint::visibility::surface_shader::SurfaceShader;
use crate::raster::sampling::place_sums::{PlaceSums, PlaceSumsByMask};
use crate::raster::sampling::positions::{Position, SamplePositions};
use crate::raster::shading::context::{BoundedPixels, PixelRun, Pixels, PlacedPixels, ShadeContext};
use crate::simd;
use crate::texture::SampleGrid;

/// Pixels that are shaded together, and some more: so many that their samples stay in a core's cache.
pub(super) const TOGETHER: usize = 256;

/// What samples are averaged with, and memory.
#[derive(Debug)]
pub(super) struct BySamples {
    pub(super) positions: SamplePositions,
    pub(super) mean: SampleMean,
    /// The light of surfaces, and the same as [`Light::weighted`] has it.
    pub(super) lights: Vec<Light>,
    pub(super) near_lights: Vec<[f32; 4]>,
    pub(super) known: KnownPixels,
    pub(super) parts: BoundedParts,
    /// Fragments of pixels that are open.
    pub(super) open: Vec<Fragment>,
    pub(super) shades: SampleShades,
}

/// Where the samples of a tile lie, and how they are averaged.
#[derive(Clone, Copy, Debug)]
pub(super) struct TileSamples<'s> {
    pub(super) positions: &'s SamplePositions,
    pub(super) mean: &'s SampleMean,
    pub(super) grid: SampleGrid,
}

/// The samples of some fragments of a primitive.
#[derive(Debug, Default)]
pub(super) struct SampleShades {
    pub(super) points: Vec<[u16; 2]>,
    pub(super) colors: Vec<Premultiplied16>,
    /// Those of a paint above.
    pub(super) above: Vec<Premultiplied16>,
    pub(super) running: RunningSums,
    /// Pixels of which all samples are shaded, and what becomes of them.
    pub(super) whole: Vec<[u16; 2]>,
    pub(super) pixels: Vec<u32>,
    /// The numbers of those that depend on where exactly their samples lie, and memory to shade these alone.
    pub(super) open: Vec<usize>,
    apart: WholePixels,
    /// Where the samples of these pixels lie, and the random bits that say so; once where they are the same in every pixel.
    pub(super) inside: Vec<Position>,
    pub(super) random: Vec<u64>,
    /// Where the samples of the pixels of a tile lie that several surfaces share, one pixel after the other, once anybody asked.
    pub(super) shared: Vec<Position>,
    /// The first points of the pixels of fragments.
    pub(super) corners: Vec<[u16; 2]>,
    /// The masks of fragments, and what red, green and blue of their samples add up to.
    pub(super) masks: Vec<u64>,
    pub(super) values: Vec<[u64; 3]>,
    /// What the places of some samples add up to, where these are the same in every pixel; and those of the parts at work.
    pub(super) by_mask: PlaceSumsByMask,
    pub(super) sums: Vec<PlaceSums>,
}

/// Pixels of which all samples are shaded, and what becomes of them.
#[derive(Debug, Default)]
struct WholePixels {
    whole: Vec<[u16; 2]>,
    pixels: Vec<u32>,
}

impl WholePixels {
    /// Changes places with those that are shaded.
    fn swap(&mut self, shades: &mut SampleShades) {
        std::mem::swap(&mut self.whole, &mut shades.whole);
        std::mem::swap(&mut self.pixels, &mut shades.pixels);
    }
}

impl BySamples {
    pub(super) fn new(context: &ShadeContext<'_>, positions: SamplePositions) -> Self {
        let side = context.rate.side();
        let rules = context.sampling.rules;
        let inside = if positions.are_same() {
            positions.of_pixel([0; 2], &mut Vec::new()).to_vec()
        } else {
            Vec::new()
        };
        Self {
            positions,
            mean: SampleMean::new(context.space, side * side, rules),
            lights: Vec::new(),
            near_lights: Vec::new(),
            known: KnownPixels::default(),
            parts: BoundedParts::default(),
            open: Vec::new(),
            shades: SampleShades {
                by_mask: PlaceSumsByMask::new(&inside),
                inside,
                ..SampleShades::default()
            },
        }
    }

    /// Whether light is averaged.
    pub(super) fn is_linear(&self) -> bool {
        matches!(self.mean, SampleMean::Linear(_))
    }
}

impl SampleShades {
    /// Finds where the samples of the pixels of `whole` lie.
    pub(super) fn place(&mut self, positions: &SamplePositions, grid: SampleGrid) {
        if !positions.are_same() {
            let pixels = self.whole.iter().map(|place| pixel_of(*place, grid));
            self.inside.clear();
            positions.add(pixels, &mut self.random, &mut self.inside);
        }
    }

    /// Shades the samples.
    pub(super) fn shade(&mut self, shader: &SurfaceShader<'_>, grid: SampleGrid) {
        let count = self.points.len();
        if self.colors.len() < count {
            self.colors.resize(count, Premultiplied16::TRANSPARENT);
        }
        shader.points(grid, &self.points, &mut self.colors[..count], &mut self.above);
    }

    /// Takes runs of whole pixels of one primitive until there are many pixels to shade together, only the first one of each row
    /// where all of a row are alike (`repeats`); how many runs.
    pub(super) fn take(&mut self, runs: &[PixelRun], repeats: bool) -> usize {
        self.whole.clear();
        let (mut taken, mut pixels) = (0, 0);
        for run in runs {
            if pixels >= TOGETHER {
                break;
            }
            taken += 1;
            if !repeats {
                pixels += run.len();
            } else if self.whole.last().is_none_or(|last| last[1] != run.row) {
                self.whole.push(run.first());
                pixels += 1;
            }
        }
        if !repeats {
            PixelRun::add_places(&runs[..taken], &mut self.whole);
        }
        taken
    }

    /// Puts the pixels of these runs, once they are shaded.
    pub(super) fn put(&self, runs: &[PixelRun], repeats: bool, block: &mut PixelBlock<'_>) {
        if !repeats {
            return put_runs(runs, false, &self.pixels, block);
        }
        let mut at = 0;
        for run in runs {
            at += usize::from(self.whole[at][1] != run.row);
            block.run(run.row, run.columns()).fill(self.pixels[at]);
        }
    }

    /// Finds the pixels of which all samples are opaque and shaded, those of `whole`.
    pub(super) fn shade_whole(&mut self, shader: &SurfaceShader<'_>, samples: TileSamples<'_>) {
        self.pixels.clear();
        self.pixels.resize(self.whole.len(), 0);
        if samples.positions.are_same() || !self.shade_certain(shader, samples) {
            self.shade_all(shader, samples);
        }
    }

    /// The same, as far as it does not matter where exactly samples lie before anybody places them; whether there is a way to know.
    fn shade_certain(&mut self, shader: &SurfaceShader<'_>, samples: TileSamples<'_>) -> bool {
        let Some((lowest, tints)) = shader.tinted() else {
            return false;
        };
        let TileSamples { positions, mean, grid } = samples;
        self.open.clear();
        let pixels = Pixels {
            grid,
            places: &self.whole,
        };
        let bounded = BoundedPixels::new(pixels, positions.mean_range(), tints);
        if !lowest.bounded_pixels(bounded, mean, &mut self.pixels, &mut self.open) {
            return false;
        }
        if self.open.is_empty() {
            return true;
        }
        // All pixels wait here while those that are open have their place.
        let mut apart = std::mem::take(&mut self.apart);
        let open = std::mem::take(&mut self.open);
        apart.whole.clear();
        apart.whole.extend(open.iter().map(|i| self.whole[*i]));
        apart.pixels.clear();
        apart.pixels.resize(open.len(), 0);
        apart.swap(self);
        self.shade_all(shader, samples);
        apart.swap(self);
        for (i, pixel) in open.iter().zip(&apart.pixels) {
            self.pixels[*i] = *pixel;
        }
        (self.apart, self.open) = (apart, open);
        true
    }

    /// The same, from where samples lie.
    fn shade_all(&mut self, shader: &SurfaceShader<'_>, TileSamples { positions, mean, grid }: TileSamples<'_>) {
        self.place(positions, grid);
        let tinted = shader.tinted();
        let placed = PlacedPixels {
            pixels: Pixels {
                grid,
                places: &self.whole,
            },
            count: positions.count(),
            inside: &self.inside,
            tints: tinted.map(|(_, tints)| tints).unwrap_or_default(),
        };
        if !tinted.is_some_and(|(lowest, _)| lowest.placed_pixels(placed, mean, &mut self.pixels)) {
            self.points.clear();
            self.points.resize(self.whole.len() * placed.count, [0; 2]);
            dispatch!(simd::level(), simd => points_of(simd, placed, &mut self.points));
            self.shade(shader, grid);
            mean.opaque_pixels(&self.colors[..self.points.len()], &mut self.pixels);
        }
    }
}

/// A pixel of a tile in the frame.
#[inline(always)]
pub(super) fn pixel_of(place: [u16; 2], grid: SampleGrid) -> [i32; 2] {
    [
        grid.origin[0] + i32::from(place[0]),
        grid.origin[1] + i32::from(place[1]),
    ]
}

/// The first point of a pixel's lattice: no tile has more than `2^14` along a side.
#[inline(always)]
pub(super) fn first_point(place: [u16; 2], grid: SampleGrid) -> [u16; 2] {
    let at = |pixel: u16| u16::try_from(u32::from(pixel) * grid.side).unwrap_or(u16::MAX);
    [at(place[0]), at(place[1])]
}

#[inline(always)]
fn point_at([left, top]: [u16; 2], [column, row]: Position) -> [u16; 2] {
    [left.wrapping_add(column.into()), top.wrapping_add(row.into())]
}

/// The samples of all pixels, one pixel after the other.
#[inline(always)]
pub(super) fn points_of<S: Simd>(_: S, placed: PlacedPixels<'_>, points: &mut [[u16; 2]]) {
    let points = points.chunks_exact_mut(placed.count);
    for (i, (place, points)) in placed.pixels.places.iter().zip(points).enumerate() {
        let corner = first_point(*place, placed.pixels.grid);
        for (point, inside) in points.iter_mut().zip(placed.inside(i)) {
            *point = point_at(corner, *inside);
        }
    }
}
