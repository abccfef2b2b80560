//! The fragments of one primitive, shaded together: whole pixels at once, then parts of pixels 64 samples at a time.

use crate::raster::paint::visibility::shading_queue::Fragment;
use crate::raster::shading::Shader;
use crate::raster::shading::context::{PixelRun, Pixels};
use crate::texture::SampleGrid;

/// Memory for the fragments of one primitive.
#[derive(Debug, Default)]
pub(super) struct FragmentSums {
    /// Pixels of the tile, and which of their samples; the latter empty where it is all.
    places: Vec<[u16; 2]>,
    masks: Vec<u64>,
    /// Where their sums go.
    targets: Vec<u32>,
    sums: Vec<[u32; 4]>,
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

    /// Calls `add` with the sum of every part of a pixel, of which each has `count` samples: with the number of the pixel, whose
    /// places these are, the sum, and how many samples it is of. How many samples were shaded.
    #[inline]
    pub(super) fn each_part(
        &mut self,
        (fragments, places): (&[Fragment], &[[u16; 2]]),
        grid: SampleGrid,
        (shader, count): (&Shader<'_>, u32),
        mut add: impl FnMut(u32, [u32; 4], u32),
    ) -> u64 {
        let mut shaded = 0;
        if fragments.is_empty() {
            return shaded;
        }
        for first in (0..count).step_by(64) {
            self.gather(fragments, places, first);
            if self.places.is_empty() {
                continue;
            }
            self.make_sums();
            let pixels = Pixels {
                grid,
                places: &self.places,
            };
            shader.masked_sums(pixels.masked(&self.masks, first), &mut self.sums);
            for ((target, sum), mask) in self.targets.iter().zip(&self.sums).zip(&self.masks) {
                let samples = mask.count_ones();
                shaded += u64::from(samples);
                add(*target, *sum, samples);
            }
        }
        shaded
    }

    /// Gathers the fragments that are parts of pixels; of the 64 samples from `first` on.
    fn gather(&mut self, fragments: &[Fragment], places: &[[u16; 2]], first: u32) {
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

    fn make_sums(&mut self) {
        self.sums.clear();
        self.sums.resize(self.places.len(), [0; 4]);
    }
}
