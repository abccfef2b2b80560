//! The fragments of one primitive, shaded together: whole pixels at once, then parts of pixels 64 samples at a time.

use crate::raster::paint::visibility::shading_queue::Fragment;
use crate::raster::shading::Shader;
use crate::raster::shading::context::{PixelRun, Pixels};
use crate::texture::SampleGrid;

/// Memory for the fragments of one primitive.
#[derive(Debug, Default)]
pub(super) struct FragmentSums {
    /// Pixels of the tile, and which of their samples; the latter empty where it is all.
    pub(super) places: Vec<[u16; 2]>,
    pub(super) masks: Vec<u64>,
    /// Where their sums go.
    pub(super) targets: Vec<u32>,
    pub(super) sums: Vec<[u32; 4]>,
}

impl FragmentSums {
    /// The sums of all samples of the pixels of runs, one after the other; where all of a run are alike (`is_level`), only of the
    /// first one.
    pub(super) fn sums_of(
        &mut self,
        (runs, is_level): (&[PixelRun], bool),
        grid: SampleGrid,
        shader: &Shader<'_>,
    ) -> &mut [[u32; 4]] {
        self.places.clear();
        for run in runs {
            if is_level {
                self.places.push(run.first());
            } else {
                self.places.extend(run.places());
            }
        }
        self.make_sums();
        if !self.places.is_empty() {
            let places = &self.places;
            shader.pixel_sums(Pixels { grid, places }, &mut self.sums);
        }
        &mut self.sums
    }

    /// Gathers the fragments that are parts of pixels; of the 64 samples from `first` on.
    pub(super) fn gather(&mut self, fragments: &[Fragment], places: &[[u16; 2]], first: u32) {
        self.places.clear();
        self.masks.clear();
        self.targets.clear();
        for fragment in fragments {
            if u32::from(fragment.first) == first {
                self.places.push(places[fragment.pixel as usize]);
                self.masks.push(fragment.mask);
                self.targets.push(fragment.pixel);
            }
        }
    }

    /// Shades the fragments that were gathered, of the 64 samples from `first` on.
    pub(super) fn shade_parts(&mut self, grid: SampleGrid, first: u32, shader: &Shader<'_>) {
        self.make_sums();
        if !self.places.is_empty() {
            let places = &self.places;
            shader.masked_sums(Pixels { grid, places }.masked(&self.masks, first), &mut self.sums);
        }
    }

    fn make_sums(&mut self) {
        self.sums.clear();
        self.sums.resize(self.places.len(), [0; 4]);
    }
}
