//! Pixels that several surfaces share, of some of whose parts only bounds are known: which of these pixels are certain all the same.
//!
//! What parts of smooth colours add up to is known but for rounding, without shading any of their samples; so nearly always both
//! ends make the same pixel. The parts of the others are shaded sample by sample after all.

use crate::color::{SampleMean, SumBounds};
use crate::raster::frame::block::PixelBlock;
use crate::raster::paint::visibility::shading_queue::Fragment;
use crate::raster::paint::visibility::shading_queue::SharedPixels;
use crate::raster::surface_id::SurfaceId;

/// What is known of the pixels of a tile that wait for their sums.
#[derive(Debug, Default)]
pub(super) struct BoundedParts {
    /// Of each pixel what its bounded parts add up to; empty where no part of any is bounded.
    of_pixels: Vec<SumBounds>,
    /// The surfaces of which all parts are bounded, in order.
    surfaces: Vec<SurfaceId>,
    /// What is found of the fragments at work.
    found: Vec<SumBounds>,
    /// Whether each pixel is open.
    is_open: Vec<bool>,
}

impl BoundedParts {
    /// Forgets all of a tile.
    pub(super) fn clear(&mut self) {
        self.of_pixels.clear();
        self.surfaces.clear();
    }

    pub(super) fn is_empty(&self) -> bool {
        self.surfaces.is_empty()
    }

    /// Has `find` bound fragments of a surface, of a tile in which so many pixels wait; how many samples they have, if it can.
    pub(super) fn add(
        &mut self,
        surface: SurfaceId,
        fragments: &[Fragment],
        pixels: usize,
        find: impl FnOnce(&mut [SumBounds]) -> bool,
    ) -> Option<usize> {
        if self.found.len() < fragments.len() {
            self.found.resize(fragments.len(), SumBounds::default());
        }
        let found = &mut self.found[..fragments.len()];
        if !find(found) {
            return None;
        }
        if self.surfaces.last() != Some(&surface) {
            self.surfaces.push(surface);
        }
        self.of_pixels.resize(pixels, SumBounds::default());
        let mut samples = 0;
        for (Fragment { pixel, .. }, bounds) in fragments.iter().zip(found) {
            self.of_pixels[*pixel as usize] += *bounds;
            samples += bounds.count as usize;
        }
        Some(samples)
    }

    /// Puts the pixels that are certain, once all that is not bounded was added to their sums or lights; whether any is not.
    pub(super) fn put_certain(
        &mut self,
        pixels: &SharedPixels<'_>,
        mean: &SampleMean,
        block: &mut PixelBlock<'_>,
    ) -> bool {
        self.is_open.clear();
        self.is_open.resize(pixels.places.len(), false);
        let mut any = false;
        for (i, bounds) in self.of_pixels.iter().enumerate() {
            let pixel = match mean {
                SampleMean::Stored(_) => bounds.pixel_with_sums(pixels.sums[i], mean),
                SampleMean::Linear(_) => bounds.pixel_with_light(pixels.lights[i], mean),
            };
            if let Some(pixel) = pixel {
                block.put(pixels.places[i], pixel);
            } else {
                self.is_open[i] = true;
                any = true;
            }
        }
        any
    }

    /// The fragments of a surface that are still to be shaded: those that are bounded, of pixels that are open.
    pub(super) fn open(&self, surface: SurfaceId, fragments: &[Fragment], open: &mut Vec<Fragment>) {
        open.clear();
        if self.surfaces.binary_search(&surface).is_ok() {
            let is_open = |fragment: &&Fragment| self.is_open[fragment.pixel as usize];
            open.extend(fragments.iter().filter(is_open));
        }
    }

    /// Whether a pixel was left open.
    pub(super) fn is_open(&self, pixel: usize) -> bool {
        self.is_open[pixel]
    }
}
