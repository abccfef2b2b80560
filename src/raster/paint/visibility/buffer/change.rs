//! Translucent paint and layers: lets covered samples show another surface, by what they show.

use std::ops::Range;

use crate::raster::coverage::covered::Covered;
use crate::raster::paint::visibility::buffer::{VisibilityBuffer, offset, run_length};
use crate::raster::paint::visibility::packed::{PER_WORD, changed, joined, lanes, of_two, splat};
use crate::raster::paint::visibility::two_surfaces::{PixelIndex, TwoSurfaces};
use crate::raster::sampling::mask::SampleMask;
use crate::raster::surface_id::{SPLIT, SurfaceId, TWO_SURFACES};

/// What samples show when a layer ends.
pub(crate) trait Composer {
    /// Whether samples keep what they show where the layer shows this.
    fn keeps_below(&self, above: SurfaceId) -> bool;

    /// What a sample shows, by what it shows below the layer and in it.
    fn composited(&mut self, below: SurfaceId, above: SurfaceId) -> SurfaceId;
}

impl VisibilityBuffer {
    /// Lets covered samples in row `y` of pixels show what `change` makes of what they show.
    #[inline(always)]
    #[expect(clippy::inline_always, reason = "a dozen instructions for every pixel on an edge")]
    pub(crate) fn change(&mut self, y: i32, covered: Covered, mut change: impl FnMut(SurfaceId) -> SurfaceId) {
        let y = offset(self.rect.y.start, y);
        match covered {
            Covered::Whole(xs) => self.change_whole(y, self.columns(xs), &mut change),
            Covered::Part(x, mask) => {
                let x = offset(self.rect.x.start, x);
                self.change_samples(PixelIndex { y, x }, mask, &mut change);
            }
        }
    }

    /// Lets some samples of a pixel, at least one, show what `change` makes of what they show.
    #[inline(always)]
    #[expect(clippy::inline_always, reason = "a dozen instructions for every pixel on an edge")]
    pub(super) fn change_samples(
        &mut self,
        pixel: PixelIndex,
        covered: SampleMask,
        change: &mut impl FnMut(SurfaceId) -> SurfaceId,
    ) {
        let shown = self.whole[pixel.y][pixel.x];
        if shown != SPLIT && self.all != 0 && self.change_two(pixel, covered.low(), change) {
            return;
        }
        self.split(pixel);
        self.each_covered_word(
            pixel,
            covered,
            #[inline(always)]
            |word, mask| {
                if mask != 0 {
                    *word = *word & !mask | changed(*word, mask, change) & mask;
                }
            },
        );
    }

    /// Lets samples of a pixel that is not split show what `change` makes of what they show; false, and nothing done,
    /// where the pixel would show three surfaces or more.
    fn change_two(&mut self, pixel: PixelIndex, covered: u64, change: &mut impl FnMut(SurfaceId) -> SurfaceId) -> bool {
        let shown = self.whole[pixel.y][pixel.x];
        let two = if shown == TWO_SURFACES {
            let TwoSurfaces { mask, first, second } = self.two_surfaces.get(pixel);
            let (of_first, of_second) = (self.all & !mask, mask);
            // Each is covered as a whole or not at all.
            if [of_first, of_second]
                .iter()
                .any(|part| part & covered != 0 && part & !covered != 0)
            {
                return false;
            }
            let mut changed = |part: u64, surface| if part & covered == 0 { surface } else { change(surface) };
            TwoSurfaces {
                mask,
                first: changed(of_first, first),
                second: changed(of_second, second),
            }
        } else {
            TwoSurfaces {
                mask: covered,
                first: shown,
                second: change(shown),
            }
        };
        self.set_two(pixel, two);
        true
    }

    /// Lets all samples of the pixels `xs` of row number `y` show what `change` makes of what they show.
    pub(super) fn change_whole(&mut self, y: usize, xs: Range<usize>, change: &mut impl FnMut(SurfaceId) -> SurfaceId) {
        let mut start = xs.start;
        while start < xs.end {
            let row = &mut self.whole[y];
            let shown = row[start];
            let end = start + run_length(&row[start..xs.end], shown);
            match shown {
                SPLIT => {
                    let per_pixel = self.side * self.words;
                    let first = self.first_packed(PixelIndex { y, x: start });
                    for word in &mut self.samples[first..first + (end - start) * per_pixel] {
                        *word = changed(*word, u64::MAX, change);
                    }
                }
                TWO_SURFACES => {
                    for x in start..end {
                        let pixel = PixelIndex { y, x };
                        let TwoSurfaces { mask, first, second } = self.two_surfaces.get(pixel);
                        let (first, second) = (change(first), change(second));
                        self.two_surfaces.set(pixel, TwoSurfaces { mask, first, second });
                    }
                }
                _ => row[start..end].fill(change(shown)),
            }
            start = end;
        }
    }

    /// Lets each sample show what `composer` makes of its surface here and in a `layer` of the same rectangle.
    pub(crate) fn composite(&mut self, layer: &Self, composer: &mut impl Composer) {
        for (y, line) in layer.whole.iter().enumerate() {
            let line = &line[..layer.width];
            let mut start = 0;
            while start < line.len() {
                let above = line[start];
                let end = start + run_length(&line[start..], above);
                if above == SPLIT || above == TWO_SURFACES {
                    for x in start..end {
                        self.composite_pixel(PixelIndex { y, x }, layer, composer);
                    }
                } else if !composer.keeps_below(above) {
                    self.change_whole(y, start..end, &mut |below| composer.composited(below, above));
                }
                start = end;
            }
        }
    }

    fn composite_pixel(&mut self, pixel: PixelIndex, layer: &Self, composer: &mut impl Composer) {
        let above = layer.one_or_two(pixel);
        if let (Some(below), Some(above)) = (self.one_or_two(pixel), above)
            && (below.mask == 0 || below.mask == above.mask)
        {
            let two = TwoSurfaces {
                mask: above.mask,
                first: composer.composited(below.first, above.first),
                second: composer.composited(below.second, above.second),
            };
            self.set_two(pixel, two);
            return;
        }
        self.split(pixel);
        let first = self.first_packed(pixel);
        for i in 0..self.side * self.words {
            let above = match above {
                None => layer.samples[first + i],
                Some(two) => layer.word(two, i),
            };
            let (below, above) = (lanes(self.samples[first + i]), lanes(above));
            let mixed = [0, 1, 2, 3].map(|i| composer.composited(below[i], above[i]));
            self.samples[first + i] = joined(mixed);
        }
    }

    /// Four samples of a pixel of at most two surfaces, as word `i` of the split pixel.
    #[inline]
    fn word(&self, two: TwoSurfaces, i: usize) -> u64 {
        if two.mask == 0 {
            return splat(two.first);
        }
        let (row, column) = (i / self.words, i % self.words * PER_WORD);
        of_two(
            [splat(two.first), splat(two.second)],
            two.mask >> (row * self.side + column),
        )
    }

    /// Renumbers all surfaces in use: `renumber` is called once for each, in no particular order.
    pub(crate) fn renumber(&mut self, renumber: impl Fn(SurfaceId) -> SurfaceId) {
        for pixel in self.places() {
            match self.whole[pixel.y][pixel.x] {
                TWO_SURFACES => {
                    let TwoSurfaces { mask, first, second } = self.two_surfaces.get(pixel);
                    let (first, second) = (renumber(first), renumber(second));
                    self.two_surfaces.set(pixel, TwoSurfaces { mask, first, second });
                }
                SPLIT => {
                    let first = self.first_packed(pixel);
                    for word in &mut self.samples[first..][..self.side * self.words] {
                        *word = joined(lanes(*word).map(&renumber));
                    }
                }
                whole => self.whole[pixel.y][pixel.x] = renumber(whole),
            }
        }
    }

    /// Calls `seen` with every surface in use, often several times.
    pub(crate) fn each_surface(&self, mut seen: impl FnMut(SurfaceId)) {
        for pixel in self.places() {
            match self.whole[pixel.y][pixel.x] {
                SPLIT => {
                    for word in &self.samples[self.first_packed(pixel)..][..self.side * self.words] {
                        lanes(*word).into_iter().for_each(&mut seen);
                    }
                }
                TWO_SURFACES => {
                    let two = self.two_surfaces.get(pixel);
                    [two.first, two.second].into_iter().for_each(&mut seen);
                }
                whole => seen(whole),
            }
        }
    }
}
