//! The second step of a tile where every sample is shaded and rounded for itself: off the grid, where no sum of a primitive's
//! samples is known before, in linear light, which is no sum of what samples store, and where translucent paints are shaded.
//!
//! As in `resolve` only what is seen is shaded, primitive by primitive. Pixels that show one primitive are averaged as soon as
//! their samples are shaded; what several share is added up, and where it matters little what exactly the samples of a part show,
//! only bounds of that are: see `bounded_parts`. In tiles of flat colours light is added up by surface.

use crate::color::{Light, LightResolver, SampleMean};
use crate::raster::frame::block::PixelBlock;
use crate::raster::paint::visibility::buffer::VisibilityBuffer;
use crate::raster::paint::visibility::by_samples::{BySamples, TOGETHER, TileSamples};
use crate::raster::paint::visibility::packed::lanes;
use crate::raster::paint::visibility::painter::VisibilityPainter;
use crate::raster::paint::visibility::resolve::each_shared;
use crate::raster::paint::visibility::shading_queue::{ShadingQueue, SharedPixels, ToShade};
use crate::raster::paint::visibility::surface_shader::SurfaceShader;
use crate::raster::paint::visibility::surfaces::SurfaceTable;
use crate::raster::paint::visibility::two_surfaces::TwoSurfaces;
use crate::raster::surface_id::{MAX_SURFACES, SurfaceId, TWO_SURFACES};

impl VisibilityPainter<'_> {
    /// Shades everything that waits, sample by sample as far as that matters, and puts all pixels into `block`, whose first pixel is
    /// `origin`.
    pub(super) fn shade_samples(&mut self, origin: [i32; 2], block: &mut PixelBlock<'_>) {
        let Self {
            context,
            surfaces,
            unresolved,
            by_samples,
            ..
        } = self;
        let BySamples {
            positions,
            mean,
            parts,
            shades,
            ..
        } = by_samples;
        let ShadingQueue {
            places,
            sums,
            lights,
            sorted,
            ..
        } = unresolved;
        parts.clear();
        shades.shared.clear();
        let (count, grid) = (positions.count(), context.samples_from(origin));
        let samples = TileSamples { positions, mean, grid };
        let mut shared = SharedPixels { places, sums, lights };
        for ToShade {
            surface,
            mut runs,
            fragments,
        } in sorted.by_surface()
        {
            let Some(shader) = SurfaceShader::new(context, surfaces.get(surface), &surfaces.stacks) else {
                continue;
            };
            // Where all pixels of a row get the same colours, that of the first one.
            let repeats = shader.is_level() && positions.are_same();
            while !runs.is_empty() {
                let (taken, others) = runs.split_at(shades.take(runs, repeats));
                shades.shade_whole(&shader, samples);
                shades.put(taken, repeats, block);
                let pixels = shades.whole.len();
                self.samples_shaded += shader.evaluations((pixels * count) as u64, pixels);
                runs = others;
            }
            for fragments in fragments.chunks(TOGETHER) {
                let bounded = parts.add(surface, fragments, shared.places.len(), |bounds| {
                    shades.bound(&shader, samples, (fragments, shared.places), bounds)
                });
                let shaded = bounded.unwrap_or_else(|| shades.add_fragments(&shader, samples, fragments, &mut shared));
                self.samples_shaded += shader.evaluations(shaded as u64, fragments.len());
            }
        }
        if parts.is_empty() {
            self.put_shared(block, |_| true);
        } else if parts.put_certain(&shared, mean, block) {
            self.shade_open(origin);
            self.put_shared(block, |i| self.by_samples.parts.is_open(i));
        }
    }

    /// Shades the parts of pixels that bounds leave open.
    #[inline(never)]
    fn shade_open(&mut self, origin: [i32; 2]) {
        let Self {
            context,
            surfaces,
            unresolved,
            by_samples,
            ..
        } = self;
        let BySamples {
            positions,
            mean,
            parts,
            open,
            shades,
            ..
        } = by_samples;
        let ShadingQueue {
            places,
            sums,
            lights,
            sorted,
            ..
        } = unresolved;
        let samples = TileSamples {
            positions,
            mean,
            grid: context.samples_from(origin),
        };
        let mut shared = SharedPixels { places, sums, lights };
        for ToShade { surface, fragments, .. } in sorted.by_surface() {
            parts.open(surface, fragments, open);
            if open.is_empty() {
                continue;
            }
            let Some(shader) = SurfaceShader::new(context, surfaces.get(surface), &surfaces.stacks) else {
                continue;
            };
            for fragments in open.chunks(TOGETHER) {
                shades.add_fragments(&shader, samples, fragments, &mut shared);
            }
        }
    }

    /// Resolves a tile of flat colours into the means of their light.
    pub(super) fn resolve_light(&mut self, block: &mut PixelBlock<'_>) {
        let SampleMean::Linear(resolver) = self.by_samples.mean else {
            return;
        };
        let all = (0..self.surfaces.len()).map(|i| SurfaceId::try_from(i).unwrap_or(0));
        let BySamples { lights, known, .. } = &mut self.by_samples;
        known.clear();
        lights.clear();
        lights.extend(all.map(|surface| Light::new(self.surfaces.get(surface).flat)));
        let (tile, surfaces, lights) = (self.layers.base(), &self.surfaces, &*lights);
        let flat = FlatLight {
            surfaces,
            lights,
            resolver,
            count: self.resolver.count(),
        };
        for y in tile.rect.y.start..tile.rect.y.end {
            let line = block.line(y);
            let Some(table) = surfaces.flat_resolve() else {
                flat.row_of_many(tile, y, line);
                continue;
            };
            let shown = tile.shown(y);
            table.row(shown.whole, line);
            each_shared(
                &shown,
                line,
                |two| known.pixel(two, || flat.two(two)),
                |x| flat.split(tile, x, y),
            );
        }
    }
}

/// What pixels of flat colours are resolved by.
struct FlatLight<'s> {
    surfaces: &'s SurfaceTable<'s>,
    lights: &'s [Light],
    resolver: LightResolver,
    count: u32,
}

impl FlatLight<'_> {
    /// The pixel that shows two surfaces.
    #[inline]
    fn two(&self, TwoSurfaces { mask, first, second }: TwoSurfaces) -> u32 {
        let shown = self.surfaces.get(first);
        // What is all alike is its pixel.
        if shown.flat == self.surfaces.get(second).flat {
            return shown.pixel;
        }
        let of_second = mask.count_ones();
        let [first, second] = [first, second].map(|surface| self.lights[usize::from(surface)]);
        let mut sum = first.times(self.count - of_second);
        sum += second.times(of_second);
        self.resolver.pixel(sum)
    }

    /// The pixel in column `x` of the tile and row `y`, which is split.
    #[inline]
    fn split(&self, tile: &VisibilityBuffer, x: usize, y: i32) -> u32 {
        let (mut sum, mut first, mut differ) = (Light::default(), None, false);
        tile.each_packed(x, y, |word, used| {
            for surface in &lanes(word)[..used as usize] {
                sum += self.lights[usize::from(*surface)];
                let known = first.get_or_insert(*surface);
                differ |= known != surface && self.surfaces.get(*known).flat != self.surfaces.get(*surface).flat;
            }
        });
        match first {
            Some(surface) if !differ => self.surfaces.get(surface).pixel,
            _ => self.resolver.pixel(sum),
        }
    }

    /// A row where there are many surfaces.
    #[cold]
    fn row_of_many(&self, tile: &VisibilityBuffer, y: i32, line: &mut [u32]) {
        let row_of_two = tile.two_surfaces(y);
        for ((x, surface), pixel) in tile.row(y).iter().enumerate().zip(line) {
            *pixel = match *surface {
                TWO_SURFACES => self.two(row_of_two.get(x)),
                surface if usize::from(surface) < MAX_SURFACES => self.surfaces.get(surface).pixel,
                _ => self.split(tile, x, y),
            };
        }
    }
}
