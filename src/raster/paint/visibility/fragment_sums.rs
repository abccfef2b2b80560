//! What the samples of fragments add up to, each fragment's to its pixel: one by one, or as the paint knows it, or between bounds.

#![expect(
    clippy::inline_always,
    reason = "a function that is not inlined into its dispatch loses the vector instructions"
)]

use fearless_simd::{Simd, dispatch};

use crate::color::{Light, Premultiplied16, SampleMean, SumBounds};
use crate::raster::paint::visibility::by_samples::{SampleShades, TileSamples, first_point, pixel_of};
use crate::raster::paint::visibility::fragment_points::{PixelPlaces, pack};
use crate::raster::paint::visibility::shading_queue::{Fragment, MASK_BITS, SharedPixels};
use crate::raster::paint::visibility::surface_shader::SurfaceShader;
use crate::raster::sampling::place_sums::PlaceSums;
use crate::raster::sampling::positions::{Position, SamplePositions};
use crate::raster::shading::context::{Pixels, PlacedParts, PlacedPixels};
use crate::simd::{self, PACKED};
use crate::texture::SampleGrid;

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
        self.place_fragments(samples.positions, samples.grid, (fragments, pixels.places));
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
            shades.note_places(fragments, places);
            if !positions.are_same() {
                shades.place_shared(positions, grid, places);
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

    /// Makes the pixels of fragments those of `whole`.
    fn note_places(&mut self, fragments: &[Fragment], places: &[[u16; 2]]) {
        self.whole.clear();
        self.whole
            .extend(fragments.iter().map(|part| places[part.pixel as usize]));
    }

    /// Makes the pixels of fragments those of `whole`, and finds where their samples lie.
    fn place_fragments(
        &mut self,
        positions: &SamplePositions,
        grid: SampleGrid,
        (fragments, places): (&[Fragment], &[[u16; 2]]),
    ) {
        self.note_places(fragments, places);
        if positions.are_same() {
            return;
        }
        self.place_shared(positions, grid, places);
        self.inside.clear();
        for Fragment { pixel, .. } in fragments {
            let of_pixel = &self.shared[*pixel as usize * positions.count()..][..positions.count()];
            self.inside.extend_from_slice(of_pixel);
        }
    }

    /// Finds where the samples of all pixels of a tile lie that surfaces share, unless somebody has.
    fn place_shared(&mut self, positions: &SamplePositions, grid: SampleGrid, places: &[[u16; 2]]) {
        if self.shared.is_empty() {
            let pixels = places.iter().map(|place| pixel_of(*place, grid));
            positions.add(pixels, &mut self.random, &mut self.shared);
        }
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
