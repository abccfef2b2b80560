//! The second step of a tile where every sample is shaded and rounded for itself: off the grid, where no sum of a primitive's
//! samples is known before, in linear light, which is no sum of what samples store, and where translucent paints are shaded.
//!
//! As in `resolve` only what is seen is shaded, primitive by primitive. Pixels that show one primitive are averaged as soon as
//! their samples are shaded; what several share is added up, and where it matters little what exactly the samples of a part show,
//! only bounds of that are: see `bounded_parts`. Tiles of flat colours alone are those of `flat_light`.

use crate::raster::frame::block::PixelBlock;
use crate::raster::paint::visibility::by_samples::{BySamples, TOGETHER, TileSamples};
use crate::raster::paint::visibility::painter::VisibilityPainter;
use crate::raster::paint::visibility::shading_queue::{ShadingQueue, SharedPixels, ToShade};
use crate::raster::paint::visibility::surface_shader::SurfaceShader;

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
}
