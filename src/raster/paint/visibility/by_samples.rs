//! What samples that are shaded and rounded one by one are averaged with, and the memory for it: `resolve_by_samples` uses it.

#![expect(
    clippy::inline_always,
    reason = "a function that is not inlined into its dispatch loses the vector instructions"
)]

use fearless_simd::{Simd, dispatch};

use crate::color::{Light, Premultiplied16, RunningSums, SampleMean, SumBounds};
use crate::raster::frame::block::PixelBlock;
use crate::raster::paint::put_runs::put_runs;
use crate::raster::paint::visibility::bounded_parts::BoundedParts;
use crate::raster::paint::visibility::fragment_points::{PixelPlaces, pack};
use crate::raster::paint::visibility::known_pixels::KnownPixels;
use crate::raster::paint::visibility::shading_queue::{Fragment, MASK_BITS, SharedPixels};
use crate::raster::paint::visibility::surface_shader::SurfaceShader;
use crate::raster::sampling::place_sums::{PlaceSums, PlaceSumsByMask};
use crate::raster::sampling::positions::{Position, SamplePositions};
use crate::raster::shading::context::{BoundedPixels, PixelRun, Pixels, PlacedParts, PlacedPixels, ShadeContext};
use crate::simd::{self, PACKED};
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
    running: RunningSums,
    /// Pixels of which all samples are shaded, and what becomes of them.
    pub(super) whole: Vec<[u16; 2]>,
    pub(super) pixels: Vec<u32>,
    /// The numbers of those that depend on where exactly their samples lie, and memory to shade these alone.
    pub(super) open: Vec<usize>,
    apart: WholePixels,
    /// Where the samples of these pixels lie, and the random bits that say so; once where they are the same in every pixel.
    pub(super) inside: Vec<Position>,
    random: Vec<u64>,
    /// Where the samples of the pixels of a tile lie that several surfaces share, one pixel after the other, once anybody asked.
    pub(super) shared: Vec<Position>,
    /// The first points of the pixels of fragments.
    corners: Vec<[u16; 2]>,
    /// The masks of fragments, and what red, green and blue of their samples add up to.
    masks: Vec<u64>,
    values: Vec<[u64; 3]>,
    /// What the places of some samples add up to, where these are the same in every pixel; and those of the parts at work.
    by_mask: PlaceSumsByMask,
    sums: Vec<PlaceSums>,
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
    /// Finds the samples of fragments, each of one of the pixels of `whole`, which are placed; `grid` counts the tile's.
    pub(super) fn gather(&mut self, fragments: &[Fragment], positions: &SamplePositions, grid: SampleGrid) {
        self.corners.clear();
        self.corners
            .extend(self.whole.iter().map(|place| first_point(*place, grid)));
        let count = fragments.iter().map(|part| part.mask.count_ones() as usize).sum();
        self.points.clear();
        self.points.resize(count + PACKED, [0; 2]);
        let pixels = PixelPlaces {
            corners: &self.corners,
            inside: &self.inside,
            count: positions.count(),
        };
        dispatch!(simd::level(), simd => pack(simd, fragments, pixels, &mut self.points));
        self.points.truncate(count);
    }

    /// Shades the samples of fragments and adds them up, each to its pixel. How many samples.
    pub(super) fn add_fragments(
        &mut self,
        shader: &SurfaceShader<'_>,
        samples: TileSamples<'_>,
        fragments: &[Fragment],
        pixels: &mut SharedPixels<'_>,
    ) -> usize {
        self.whole.clear();
        self.whole
            .extend(fragments.iter().map(|part| pixels.places[part.pixel as usize]));
        self.place(samples.positions, samples.grid);
        if let Some(count) = self.add_values(shader, samples, fragments, pixels) {
            return count;
        }
        self.gather(fragments, samples.positions, samples.grid);
        self.shade(shader, samples.grid);
        let colors = &self.colors[..self.points.len()];
        let counts = fragments.iter().map(|part| part.mask.count_ones());
        let mut fragments = fragments.iter();
        let mut pixel = || fragments.next().map_or(0, |part| part.pixel as usize);
        match samples.mean {
            SampleMean::Stored(_) => self.running.stored(colors, counts, |found| {
                for (sum, channel) in pixels.sums[pixel()].iter_mut().zip(found) {
                    *sum += channel;
                }
            }),
            SampleMean::Linear(resolver) => {
                self.running
                    .opaque_light(resolver, colors, counts, |light| pixels.lights[pixel()] += light);
            }
        }
        self.points.len()
    }

    /// Adds up the samples of fragments of the pixels of `whole`, which are placed, where the paint knows their sums without shading them
    /// one by one. How many samples, then.
    fn add_values(
        &mut self,
        shader: &SurfaceShader<'_>,
        TileSamples { positions, mean, grid }: TileSamples<'_>,
        fragments: &[Fragment],
        pixels: &mut SharedPixels<'_>,
    ) -> Option<usize> {
        let (lowest, tints) = shader.tinted()?;
        // Masks count from the first sample, then.
        if positions.count() > MASK_BITS {
            return None;
        }
        self.masks.clear();
        self.masks.extend(fragments.iter().map(|part| part.mask));
        self.values.clear();
        self.values.resize(fragments.len(), [0; 3]);
        let placed = PlacedPixels {
            pixels: Pixels {
                grid,
                places: &self.whole,
            },
            count: positions.count(),
            inside: &self.inside,
            tints,
        };
        if !lowest.placed_sums(placed, &self.masks, mean, &mut self.values) {
            return None;
        }
        let mut samples = 0;
        for (Fragment { pixel, mask, .. }, values) in fragments.iter().zip(&self.values) {
            let (pixel, count) = (*pixel as usize, mask.count_ones());
            samples += count as usize;
            match mean {
                SampleMean::Stored(_) => add_stored(&mut pixels.sums[pixel], *values, count),
                SampleMean::Linear(_) => pixels.lights[pixel] += Light::of_opaque(*values, count),
            }
        }
        Some(samples)
    }

    /// Between what the samples of fragments add up to, of pixels at these places of the tile, where there is a way to know without
    /// shading them; whether there is one.
    pub(super) fn bound(
        &mut self,
        shader: &SurfaceShader<'_>,
        TileSamples { positions, mean, grid }: TileSamples<'_>,
        (fragments, places): (&[Fragment], &[[u16; 2]]),
        bounds: &mut [SumBounds],
    ) -> bool {
        let Some((lowest, tints)) = shader.tinted() else {
            return false;
        };
        let parts = || {
            let shades = self;
            shades.whole.clear();
            shades
                .whole
                .extend(fragments.iter().map(|part| places[part.pixel as usize]));
            if !positions.are_same() && shades.shared.is_empty() {
                let pixels = places.iter().map(|place| pixel_of(*place, grid));
                positions.add(pixels, &mut shades.random, &mut shades.shared);
            }
            shades.sum_places(positions, fragments, matches!(mean, SampleMean::Linear(_)));
            let pixels = Pixels {
                grid,
                places: &shades.whole,
            };
            PlacedParts {
                pixels,
                sums: &shades.sums,
                tints,
            }
        };
        lowest.part_bounds(parts, mean, bounds)
    }

    /// Finds what the places of the samples of fragments add up to, and their squares where these matter.
    fn sum_places(&mut self, positions: &SamplePositions, fragments: &[Fragment], squares: bool) {
        self.sums.clear();
        if positions.are_same() {
            let sums = fragments
                .iter()
                .map(|Fragment { first, mask, .. }| self.by_mask.of(usize::from(*first), *mask));
            self.sums.extend(sums);
            return;
        }
        let (sums, inside) = (&mut self.sums, &self.shared);
        let parts = fragments.iter().map(|Fragment { first, pixel, mask }| {
            let first = *pixel as usize * positions.count() + usize::from(*first);
            (&inside[first..(first + MASK_BITS).min(inside.len())], *mask)
        });
        if squares {
            dispatch!(simd::level(), simd => add_sums::<_, true>(simd, parts, sums));
        } else {
            dispatch!(simd::level(), simd => add_sums::<_, false>(simd, parts, sums));
        }
    }

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

/// Adds the sums of so many opaque samples.
#[inline]
fn add_stored(sum: &mut [u32; 4], [r, g, b]: [u64; 3], count: u32) {
    let alpha = u64::from(count) * u64::from(Premultiplied16::ONE);
    for (sum, channel) in sum.iter_mut().zip([r, g, b, alpha]) {
        *sum += u32::try_from(channel).unwrap_or(u32::MAX);
    }
}

/// Adds what the places of the samples of parts add up to, by those of up to [`MASK_BITS`] samples, the first one by the lowest bit
/// of a mask.
#[inline(always)]
fn add_sums<'p, S: Simd, const SQUARES: bool>(
    simd: S,
    parts: impl Iterator<Item = (&'p [Position], u64)>,
    sums: &mut Vec<PlaceSums>,
) {
    for (inside, mask) in parts {
        sums.push(PlaceSums::of_masked::<S, SQUARES>(simd, inside, mask));
    }
}

/// A pixel of a tile in the frame.
#[inline(always)]
fn pixel_of(place: [u16; 2], grid: SampleGrid) -> [i32; 2] {
    [
        grid.origin[0] + i32::from(place[0]),
        grid.origin[1] + i32::from(place[1]),
    ]
}

/// The first point of a pixel's lattice: no tile has more than `2^14` along a side.
#[inline(always)]
fn first_point(place: [u16; 2], grid: SampleGrid) -> [u16; 2] {
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
