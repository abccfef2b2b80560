//! The fragments of one primitive, shaded together: whole pixels at once, then parts of pixels 64 samples at a time.

use crate::color::Resolver;
use crate::raster::paint::visibility::shading_queue::Fragment;
use crate::raster::sampling::mask::MASK_BITS;
use crate::raster::shading::Shader;
use crate::raster::shading::context::{PixelRun, Pixels, Wanted};
use crate::texture::SampleGrid;

/// The fragments of one primitive.
#[derive(Clone, Copy, Debug)]
pub(super) struct Fragments<'f> {
    /// Pixels of which all samples show it; where all of a run are alike (`is_level`), the first one stands for them.
    pub(super) runs: &'f [PixelRun],
    pub(super) is_level: bool,
    /// Parts of pixels, whose places these are, and how many samples a pixel has.
    pub(super) parts: &'f [Fragment],
    pub(super) places: &'f [[u16; 2]],
    pub(super) count: u32,
}

/// Memory for the fragments of one primitive.
#[derive(Debug, Default)]
pub(super) struct FragmentSums {
    /// Pixels of the tile all of whose samples count.
    whole: Vec<[u16; 2]>,
    whole_sums: Vec<[u32; 4]>,
    /// Others, which of their samples count, and where their sums go.
    places: Vec<[u16; 2]>,
    masks: Vec<u64>,
    targets: Vec<u32>,
    sums: Vec<[u32; 4]>,
}

impl FragmentSums {
    /// Finds the sums of all samples of whole pixels, and of the parts of others as far as they are among their first 64 samples. Where
    /// there is a shorter way to the `means` of whole pixels, which must be opaque then, these are found instead; whether they are.
    pub(super) fn find(
        &mut self,
        fragments: Fragments<'_>,
        grid: SampleGrid,
        shader: &Shader<'_>,
        means: Option<(&Resolver, &mut [u32])>,
    ) -> bool {
        let Fragments { runs, is_level, .. } = fragments;
        self.whole.clear();
        if is_level {
            self.whole.extend(runs.iter().map(|run| run.first()));
        } else {
            PixelRun::add_places(runs, &mut self.whole);
        }
        self.gather(fragments, 0);
        let whole_sums = room_for(&mut self.whole_sums, self.whole.len());
        let sums = room_for(&mut self.sums, self.places.len());
        let pixels = |places| Pixels { grid, places };
        let wanted = Wanted {
            sums: [whole_sums, sums],
            means,
        };
        shader.sums_or_means(pixels(&self.whole), pixels(&self.places).masked(&self.masks, 0), wanted)
    }

    /// The sums of whole pixels, or one for each run, after [`FragmentSums::find`] that did not find their means.
    pub(super) fn whole_sums(&mut self) -> &mut [[u32; 4]] {
        &mut self.whole_sums[..self.whole.len()]
    }

    /// Calls `add` with the sum of every part of a pixel, after [`FragmentSums::find`]: with the number of the pixel, the sum, and how
    /// many samples it is of. How many samples were shaded.
    #[inline]
    pub(super) fn each_part(
        &mut self,
        fragments: Fragments<'_>,
        grid: SampleGrid,
        shader: &Shader<'_>,
        mut add: impl FnMut(u32, [u32; 4], u32),
    ) -> u64 {
        let mut shaded = 0;
        for first in (0..fragments.count).step_by(MASK_BITS) {
            if first > 0 {
                self.gather(fragments, first);
                let sums = room_for(&mut self.sums, self.places.len());
                let pixels = Pixels {
                    grid,
                    places: &self.places,
                };
                if !self.places.is_empty() {
                    shader.masked_sums(pixels.masked(&self.masks, first), sums);
                }
            }
            for ((target, sum), mask) in self.targets.iter().zip(&self.sums).zip(&self.masks) {
                let samples = mask.count_ones();
                shaded += u64::from(samples);
                add(*target, *sum, samples);
            }
        }
        shaded
    }

    /// Gathers the parts of pixels that are among the 64 samples from `first` on.
    fn gather(&mut self, Fragments { parts, places, .. }: Fragments<'_>, first: u32) {
        self.places.clear();
        self.masks.clear();
        self.targets.clear();
        for fragment in parts {
            if u32::from(fragment.first) == first {
                self.places.push(places[fragment.pixel as usize]);
                self.masks.push(fragment.mask);
                self.targets.push(fragment.pixel);
            }
        }
    }
}

/// Room for so many sums. What stands there is left as it is: whoever finds sums writes all of them.
fn room_for(sums: &mut Vec<[u32; 4]>, count: usize) -> &mut [[u32; 4]] {
    if sums.len() < count {
        sums.resize(count, [0; 4]);
    }
    let room = &mut sums[..count];
    if cfg!(debug_assertions) {
        room.fill([u32::MAX; 4]);
    }
    room
}
