//! Opaque paint: lets covered samples show a surface.

use crate::raster::coverage::covered::Covered;
use crate::raster::paint::short_runs::fill_run;
use crate::raster::paint::visibility::buffer::{VisibilityBuffer, offset};
use crate::raster::paint::visibility::packed::{PER_WORD, of_two, splat, spread};
use crate::raster::paint::visibility::two_surfaces::{PixelIndex, TwoSurfaces};
use crate::raster::sampling::mask::SampleMask;
use crate::raster::surface_id::{ROW, SPLIT, SurfaceId, TWO_SURFACES};

impl VisibilityBuffer {
    /// Lets every sample show `surface`.
    pub(crate) fn cover(&mut self, surface: SurfaceId) {
        self.whole.fill([surface; ROW]);
    }

    /// Lets covered samples in row `y` of pixels show `surface`.
    #[inline(always)]
    #[expect(clippy::inline_always, reason = "a dozen instructions for every pixel on an edge")]
    pub(crate) fn paint(&mut self, y: i32, covered: Covered, surface: SurfaceId) {
        let y = offset(self.rect.y.start, y);
        match covered {
            Covered::Whole(xs) => {
                let xs = self.columns(xs);
                fill_run(&mut self.whole[y][xs], surface);
            }
            Covered::Part(x, mask) => {
                let x = offset(self.rect.x.start, x);
                let pixel = PixelIndex { y, x };
                if self.all == 0 {
                    self.paint_split(pixel, mask, surface);
                } else {
                    self.paint_samples(pixel, mask.low(), surface);
                }
            }
        }
    }

    /// Lets some samples of a pixel show `surface`, at least one and not all.
    #[inline(always)]
    #[expect(clippy::inline_always, reason = "a dozen instructions for every pixel on an edge")]
    pub(super) fn paint_samples(&mut self, pixel: PixelIndex, covered: u64, surface: SurfaceId) {
        let shown = self.whole[pixel.y][pixel.x % ROW];
        if shown == surface {
            return;
        }
        if shown >= TWO_SURFACES {
            return self.paint_shared(pixel, covered, surface);
        }
        self.share(pixel, TWO_SURFACES);
        let two = TwoSurfaces {
            mask: covered,
            first: shown,
            second: surface,
        };
        self.two_surfaces.set(pixel, two);
    }

    /// As [`VisibilityBuffer::paint_samples`] where samples differ already.
    #[inline(never)]
    fn paint_shared(&mut self, pixel: PixelIndex, covered: u64, surface: SurfaceId) {
        let shown = self.whole[pixel.y][pixel.x];
        if shown == TWO_SURFACES && self.paint_two(pixel, covered, surface) {
            return;
        }
        if self.side == PER_WORD {
            return self.paint_packed(pixel, covered, surface);
        }
        self.paint_split(pixel, SampleMask::of_bits(covered), surface);
    }

    /// As [`VisibilityBuffer::paint_samples`] of a pixel that is split, or is from now on.
    fn paint_split(&mut self, pixel: PixelIndex, covered: SampleMask, surface: SurfaceId) {
        self.split(pixel);
        let painted = splat(surface);
        self.each_covered_word(pixel, covered, |word, mask| *word = *word & !mask | painted & mask);
    }

    /// As [`VisibilityBuffer::paint_samples`] where a pixel that shows two surfaces or is split has 4 x 4 samples and shows three surfaces.
    /// To split such a pixel first and to paint it then, as others, costs a flat scene 4 % more.
    #[inline]
    fn paint_packed(&mut self, pixel: PixelIndex, covered: u64, surface: SurfaceId) {
        self.make_room();
        let first = self.first_packed(pixel);
        let two = self.one_or_two(pixel);
        let Some(words) = self.samples.get_mut(first..).and_then(<[u64]>::first_chunk_mut) else {
            return;
        };
        let before: [u64; PER_WORD] = match two {
            None => *words,
            Some(TwoSurfaces { mask, first, second }) => {
                let surfaces = [splat(first), splat(second)];
                [0, 4, 8, 12].map(|shift| of_two(surfaces, mask >> shift))
            }
        };
        let painted = splat(surface);
        for ((word, before), shift) in words.iter_mut().zip(before).zip([0, 4, 8, 12]) {
            let mask = spread(covered >> shift);
            *word = before & !mask | painted & mask;
        }
        self.share(pixel, SPLIT);
    }

    /// Lets samples of a pixel of two surfaces show `surface`; false, and nothing done, where it would show three.
    #[inline]
    fn paint_two(&mut self, pixel: PixelIndex, covered: u64, surface: SurfaceId) -> bool {
        let TwoSurfaces { mask, first, second } = self.two_surfaces.get(pixel);
        let two = if second == surface {
            TwoSurfaces {
                mask: mask | covered,
                first,
                second,
            }
        } else if first == surface {
            TwoSurfaces {
                mask: mask & !covered,
                first,
                second,
            }
        } else if mask & !covered == 0 {
            TwoSurfaces {
                mask: covered,
                first,
                second: surface,
            }
        } else if self.all & !mask & !covered == 0 {
            TwoSurfaces {
                mask: covered,
                first: second,
                second: surface,
            }
        } else {
            return false;
        };
        self.set_two(pixel, two);
        true
    }

    /// Calls `paint` for every word of a split pixel with the bits of the samples that are covered.
    #[inline]
    pub(super) fn each_covered_word(
        &mut self,
        pixel: PixelIndex,
        covered: SampleMask,
        mut paint: impl FnMut(&mut u64, u64),
    ) {
        let (side, words) = (self.side, self.words);
        let first = self.first_packed(pixel);
        let samples = &mut self.samples[first..][..side * words];
        let of_row = (1 << side) - 1;
        if words == 1 {
            for (word, shift) in samples.iter_mut().zip((0..).step_by(side)) {
                paint(word, spread(covered.low() >> shift & of_row));
            }
            return;
        }
        for (row, words) in samples.chunks_exact_mut(words).enumerate() {
            let bits = covered.from(row * side) & of_row;
            for (word, shift) in words.iter_mut().zip((0..).step_by(PER_WORD)) {
                paint(word, spread(bits >> shift));
            }
        }
    }
}
