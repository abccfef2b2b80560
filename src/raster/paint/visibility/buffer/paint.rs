//! Opaque paint: lets covered samples show a surface.

use crate::raster::coverage::pixel_rows::PixelRow;
use crate::raster::paint::visibility::buffer::{PixelIndex, VisibilityBuffer, offset};
use crate::raster::paint::visibility::packed::{PER_WORD, covered, of_two, splat, spread};
use crate::raster::paint::visibility::two_surfaces::TwoSurfaces;
use crate::raster::span::Span;
use crate::raster::surface_id::{ROW, SPLIT, SurfaceId, TWO_SURFACES};

/// Which ends of spans may lie in a pixel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Sides {
    Left,
    Right,
    Both,
}

impl VisibilityBuffer {
    /// Lets every sample show `surface`.
    pub(crate) fn cover(&mut self, surface: SurfaceId) {
        self.whole.fill([surface; ROW]);
    }

    /// Lets the samples that a row of pixels covers show `surface`.
    #[inline]
    pub(crate) fn paint(&mut self, row: &PixelRow<'_>, surface: SurfaceId) {
        let y = offset(self.rect.y.start, row.y);
        if !row.full.is_empty() {
            let full = self.columns(row.full);
            self.whole[y][full].fill(surface);
        }
        if self.all == 0 {
            let left = self.rect.x.start;
            for x in row.partial() {
                let pixel = (y, offset(left, x));
                self.split(pixel);
                let painted = splat(surface);
                self.each_covered_word(pixel, x, row.spans(), |word, mask| {
                    *word = *word & !mask | painted & mask;
                });
            }
            return;
        }
        self.paint_partial(self.side, row, y, surface);
    }

    /// Lets all samples of the pixels `xs` of row `y` show `surface`.
    #[inline]
    pub(crate) fn paint_pixels(&mut self, xs: Span, y: i32, surface: SurfaceId) {
        let xs = self.columns(xs);
        self.whole[offset(self.rect.y.start, y)][xs].fill(surface);
    }

    /// Lets the samples of a row of pixels that is covered in part show `surface`; `y` is its number.
    fn paint_partial(&mut self, side: usize, row: &PixelRow<'_>, y: usize, surface: SurfaceId) {
        let (left, spans) = (self.rect.x.start, row.spans());
        if row.full.is_empty() {
            for x in row.touched.start..row.touched.end {
                let covered = mask(side, x, spans, Sides::Both);
                if covered != 0 {
                    self.paint_samples((y, offset(left, x)), covered, surface);
                }
            }
            return;
        }
        // Beside pixels that are full, each holds some covered samples, and none holds all.
        for x in row.touched.start..row.full.start {
            self.paint_samples((y, offset(left, x)), mask(side, x, spans, Sides::Left), surface);
        }
        for x in row.full.end..row.touched.end {
            self.paint_samples((y, offset(left, x)), mask(side, x, spans, Sides::Right), surface);
        }
    }

    /// Lets some samples of a pixel show `surface`, at least one and not all.
    #[inline(always)]
    #[expect(clippy::inline_always, reason = "a dozen instructions for every pixel on an edge")]
    pub(super) fn paint_samples(&mut self, pixel: PixelIndex, covered: u64, surface: SurfaceId) {
        let shown = self.whole[pixel.0][pixel.1 % ROW];
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
        let shown = self.whole[pixel.0][pixel.1];
        if shown == TWO_SURFACES && self.paint_two(pixel, covered, surface) {
            return;
        }
        if self.side == PER_WORD {
            return self.paint_packed(pixel, covered, surface);
        }
        self.split(pixel);
        let painted = splat(surface);
        let (side, words) = (self.side, self.words);
        let first = self.first_packed(pixel);
        let samples = &mut self.samples[first..][..side * words];
        if words == 1 {
            for (word, shift) in samples.iter_mut().zip((0..).step_by(side)) {
                let mask = spread(covered >> shift);
                *word = *word & !mask | painted & mask;
            }
            return;
        }
        for (row, of_row) in samples.chunks_exact_mut(words).enumerate() {
            for (word, shift) in of_row.iter_mut().zip((row * side..).step_by(PER_WORD)) {
                let mask = spread(covered >> shift);
                *word = *word & !mask | painted & mask;
            }
        }
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

    /// Calls `paint` for every word of a split pixel with the bits of the samples that `spans` cover; `x` is the pixel's
    /// column in the frame.
    #[inline]
    pub(super) fn each_covered_word(
        &mut self,
        pixel: PixelIndex,
        x: i32,
        spans: &[Span],
        mut paint: impl FnMut(&mut u64, u64),
    ) {
        let left = x * i32::try_from(self.side).unwrap_or(1);
        if self.words == 1 {
            let first = self.first_packed(pixel);
            let samples = &mut self.samples[first..][..self.side];
            for (word, span) in samples.iter_mut().zip(spans) {
                paint(word, covered(*span, left));
            }
            return;
        }
        let first = self.first_packed(pixel);
        let samples = &mut self.samples[first..][..self.side * self.words];
        for (words, span) in samples.chunks_exact_mut(self.words).zip(spans) {
            for (word, left) in words.iter_mut().zip((left..).step_by(PER_WORD)) {
                paint(word, covered(*span, left));
            }
        }
    }
}

/// The bits of the samples that `spans` cover in a pixel with `side` samples a row; `x` is its column in the frame.
#[inline]
pub(super) fn mask(side: usize, x: i32, spans: &[Span], sides: Sides) -> u64 {
    let width = i32::try_from(side).unwrap_or(1);
    let left = x * width;
    let all = (1_u64 << width) - 1;
    let up_to = |column: i32| (1_u64 << (column - left).clamp(0, width)) - 1;
    let mut mask = 0;
    for span in spans[..side].iter().rev() {
        let of_row = match sides {
            Sides::Left => all & !up_to(span.start),
            Sides::Right => up_to(span.end),
            Sides::Both => up_to(span.end) & !up_to(span.start),
        };
        mask = mask << width | of_row;
    }
    mask
}
