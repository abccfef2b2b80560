//! Which primitive each sample of a tile shows.
//!
//! # Compressed samples
//!
//! A pixel whose samples all show the same primitive stores that once. The first edge that crosses it makes it a pair:
//! two primitives, and one bit per sample that says which of them it shows. Only what a third one shares is split into a
//! number per sample. A primitive that covers a pixel wholly makes it one again. So flat areas cost one store per pixel
//! at every sample rate, most edges a few bits, and nothing is shaded before it is known to be seen.

use crate::raster::surface_id::{ROW, SPLIT, SurfaceId, TWO_SURFACES};
use std::ops::Range;

use crate::raster::coverage::pixel_rows::PixelRow;
use crate::raster::paint::visibility::packed::{PER_WORD, changed, covered, joined, lanes, of_two, splat, spread};
use crate::raster::paint::visibility::two_surfaces::{TwoSurfacePixels, TwoSurfaceRow, TwoSurfaces};
use crate::raster::span::{PixelRect, Span};

/// Pixels of a block.
pub(crate) const BLOCK: usize = 8;

/// Most samples along the side of a pixel that may be a pair.
const MAX_TWO_SURFACE_SIDE: usize = 8;

/// The surfaces of a rectangle of pixels.
#[derive(Debug)]
pub(crate) struct VisibilityBuffer {
    pub(crate) rect: PixelRect,
    width: usize,
    /// Samples along one side of a pixel.
    side: usize,
    /// Words that one sample row of a pixel takes: four samples each, the last one perhaps with some to spare.
    words: usize,
    /// How many samples each of these words holds.
    used: Vec<u32>,
    /// The bits of all samples of a pixel; none where there are too many for pairs.
    all: u64,
    /// Row by row one surface per pixel, or [`TWO_SURFACES`], or [`SPLIT`]; beyond the tile's right side something.
    pub(in crate::raster) whole: Vec<[SurfaceId; ROW]>,
    /// For each row a bit for each pixel that was a pair or split once; it need not be any more.
    pub(in crate::raster) shared: Vec<u64>,
    /// What pairs show.
    pub(in crate::raster) pairs: TwoSurfacePixels,
    /// The surfaces of split pixels, pixel by pixel. Allocated with the first split.
    samples: Vec<u64>,
}

/// A row of a tile's pixels.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Shown<'a> {
    /// What each shows; beyond the tile's right side something.
    pub(crate) whole: &'a [SurfaceId; ROW],
    /// The pixels that may be pairs or split, a bit for each.
    pub(crate) shared: u64,
    /// What those show that are pairs; of no account for others.
    pub(crate) pairs: TwoSurfaceRow<'a>,
}

/// A pixel of a tile: its row and its column, counted from the tile's first pixel.
type PixelIndex = (usize, usize);

/// Which ends of spans may lie in a pixel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Sides {
    Left,
    Right,
    Both,
}

/// Pixels side by side in a row that show the same.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Run {
    /// All samples of these pixels show one surface.
    Whole(SurfaceId),
    /// The samples of these pixels show two surfaces each.
    TwoSurfacePixels,
    /// The samples of these pixels differ.
    Split,
}

impl VisibilityBuffer {
    /// A tile of no pixels with `side x side` samples each.
    pub(crate) fn new(side: i32) -> Self {
        let side = usize::try_from(side).unwrap_or(1);
        Self {
            rect: PixelRect::EMPTY,
            width: 0,
            side,
            words: side.div_ceil(PER_WORD),
            used: (0..side)
                .step_by(PER_WORD)
                .map(|at| u32::try_from((side - at).min(PER_WORD)).unwrap_or(0))
                .collect(),
            all: if side <= MAX_TWO_SURFACE_SIDE {
                u64::MAX >> (64 - side * side)
            } else {
                0
            },
            whole: Vec::new(),
            shared: Vec::new(),
            pairs: TwoSurfacePixels::new(side),
            samples: Vec::new(),
        }
    }

    /// Makes it the tile of `rect` in which every sample shows `surface`.
    pub(crate) fn reset(&mut self, rect: PixelRect, surface: SurfaceId) {
        self.rect = rect;
        self.width = rect.x.length();
        debug_assert!(self.width <= ROW, "a tile is {} pixels wide", self.width);
        let rows = rect.y.length();
        self.whole.clear();
        self.whole.resize(rows, [surface; ROW]);
        self.shared.clear();
        self.shared.resize(rows, 0);
        if self.all != 0 {
            self.pairs.make_room(rows);
        }
    }

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
    pub(in crate::raster) fn paint_samples(&mut self, pixel: PixelIndex, covered: u64, surface: SurfaceId) {
        let shown = self.whole[pixel.0][pixel.1 % ROW];
        if shown == surface {
            return;
        }
        if shown >= TWO_SURFACES {
            return self.paint_shared(pixel, covered, surface);
        }
        self.share(pixel, TWO_SURFACES);
        let pair = TwoSurfaces {
            mask: covered,
            first: shown,
            second: surface,
        };
        self.pairs.set(pixel, pair);
    }

    /// Makes a pixel a [`TWO_SURFACES`] or [`SPLIT`].
    #[inline(always)]
    #[expect(clippy::inline_always, reason = "a few instructions for every pixel on an edge")]
    fn share(&mut self, (y, x): PixelIndex, kind: SurfaceId) {
        self.whole[y][x % ROW] = kind;
        self.shared[y] |= 1 << (x % ROW);
    }

    /// As [`VisibilityBuffer::paint_samples`] where samples differ already.
    #[inline(never)]
    fn paint_shared(&mut self, pixel: PixelIndex, covered: u64, surface: SurfaceId) {
        let shown = self.whole[pixel.0][pixel.1];
        if shown == TWO_SURFACES && self.paint_pair(pixel, covered, surface) {
            return;
        }
        if self.side == PER_WORD {
            return self.paint_words(pixel, covered, surface);
        }
        self.split(pixel);
        let painted = splat(surface);
        let (side, words) = (self.side, self.words);
        let first = self.first_word(pixel);
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

    /// As [`VisibilityBuffer::paint_samples`] where a pixel that is a pair or split has 4 x 4 samples and shows three surfaces.
    /// To split such a pixel first and to paint it then, as others, costs a flat scene 4 % more.
    #[inline]
    fn paint_words(&mut self, pixel: PixelIndex, covered: u64, surface: SurfaceId) {
        self.make_room();
        let first = self.first_word(pixel);
        let pair = self.pair(pixel);
        let Some(words) = self.samples.get_mut(first..).and_then(<[u64]>::first_chunk_mut) else {
            return;
        };
        let before: [u64; PER_WORD] = match pair {
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

    /// Lets samples of a pixel that is a pair show `surface`; false, and nothing done, where it would show three.
    #[inline]
    fn paint_pair(&mut self, pixel: PixelIndex, covered: u64, surface: SurfaceId) -> bool {
        let TwoSurfaces { mask, first, second } = self.pairs.get(pixel);
        let pair = if second == surface {
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
        self.set_pair(pixel, pair);
        true
    }

    /// Lets a pixel show two surfaces, or the one that is left of them.
    #[inline(always)]
    #[expect(clippy::inline_always, reason = "a few instructions for every pixel on an edge")]
    fn set_pair(&mut self, pixel: PixelIndex, pair: TwoSurfaces) {
        if pair.mask == 0 {
            self.whole[pixel.0][pixel.1] = pair.first;
        } else if pair.mask == self.all {
            self.whole[pixel.0][pixel.1] = pair.second;
        } else {
            self.share(pixel, TWO_SURFACES);
            self.pairs.set(pixel, pair);
        }
    }

    /// Lets the samples that a row of pixels covers show what `change` makes of what they show.
    pub(crate) fn change(&mut self, row: &PixelRow<'_>, mut change: impl FnMut(SurfaceId) -> SurfaceId) {
        let left = self.rect.x.start;
        let y = offset(self.rect.y.start, row.y);
        if !row.full.is_empty() {
            let full = self.columns(row.full);
            self.change_whole(y, full, &mut change);
        }
        for x in row.partial() {
            let covered = if self.all != 0 {
                mask(self.side, x, row.spans(), Sides::Both)
            } else {
                0
            };
            self.change_samples(((y, offset(left, x)), x), (covered, row.spans()), &mut change);
        }
    }

    /// Lets the samples that `spans` cover in a pixel, by its place and its column in the frame, show what `change` makes
    /// of what they show; `covered` are their bits, if it may be a pair.
    #[inline(always)]
    #[expect(clippy::inline_always, reason = "a dozen instructions for every pixel on an edge")]
    pub(in crate::raster) fn change_samples(
        &mut self,
        (pixel, x): (PixelIndex, i32),
        (covered, spans): (u64, &[Span]),
        change: &mut impl FnMut(SurfaceId) -> SurfaceId,
    ) {
        let shown = self.whole[pixel.0][pixel.1];
        if shown != SPLIT && self.all != 0 && (covered == 0 || self.change_pair(pixel, covered, change)) {
            return;
        }
        self.split(pixel);
        self.each_covered_word(pixel, x, spans, |word, mask| {
            if mask != 0 {
                *word = *word & !mask | changed(*word, mask, change) & mask;
            }
        });
    }

    /// Lets samples of a pixel that is not split show what `change` makes of what they show; false, and nothing done,
    /// where the pixel would show three surfaces or more.
    fn change_pair(
        &mut self,
        pixel: PixelIndex,
        covered: u64,
        change: &mut impl FnMut(SurfaceId) -> SurfaceId,
    ) -> bool {
        let shown = self.whole[pixel.0][pixel.1];
        let pair = if shown == TWO_SURFACES {
            let TwoSurfaces { mask, first, second } = self.pairs.get(pixel);
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
        self.set_pair(pixel, pair);
        true
    }

    /// As [`VisibilityBuffer::change`] for all samples.
    pub(crate) fn change_all(&mut self, mut change: impl FnMut(SurfaceId) -> SurfaceId) {
        for y in 0..self.whole.len() {
            self.change_whole(y, 0..self.width, &mut change);
        }
    }

    /// As [`VisibilityBuffer::change`] for all samples of the pixels `xs` of row `y`.
    pub(crate) fn change_pixels(&mut self, xs: Span, y: i32, mut change: impl FnMut(SurfaceId) -> SurfaceId) {
        self.change_whole(offset(self.rect.y.start, y), self.columns(xs), &mut change);
    }

    /// Lets all samples of the pixels `xs` of row `y` show `surface`.
    #[inline]
    pub(crate) fn paint_pixels(&mut self, xs: Span, y: i32, surface: SurfaceId) {
        let xs = self.columns(xs);
        self.whole[offset(self.rect.y.start, y)][xs].fill(surface);
    }

    /// Columns counted from the tile's left side.
    #[inline]
    fn columns(&self, xs: Span) -> Range<usize> {
        let left = self.rect.x.start;
        offset(left, xs.start)..offset(left, xs.end)
    }

    /// Lets all samples of the pixels `xs` of row number `y` show what `change` makes of what they show.
    pub(in crate::raster) fn change_whole(
        &mut self,
        y: usize,
        xs: Range<usize>,
        change: &mut impl FnMut(SurfaceId) -> SurfaceId,
    ) {
        let mut start = xs.start;
        while start < xs.end {
            let row = &mut self.whole[y];
            let shown = row[start];
            let end = start + run_length(&row[start..xs.end], shown);
            match shown {
                SPLIT => {
                    let per_pixel = self.side * self.words;
                    let first = self.first_word((y, start));
                    for word in &mut self.samples[first..first + (end - start) * per_pixel] {
                        *word = changed(*word, u64::MAX, change);
                    }
                }
                TWO_SURFACES => {
                    for x in start..end {
                        let TwoSurfaces { mask, first, second } = self.pairs.get((y, x));
                        let (first, second) = (change(first), change(second));
                        self.pairs.set((y, x), TwoSurfaces { mask, first, second });
                    }
                }
                _ => row[start..end].fill(change(shown)),
            }
            start = end;
        }
    }

    /// All pixels.
    fn places(&self) -> impl Iterator<Item = PixelIndex> + use<> {
        let width = self.width;
        (0..self.whole.len()).flat_map(move |y| (0..width).map(move |x| (y, x)))
    }

    /// Lets each sample show what `mix` makes of its surface here and in a `layer` of the same rectangle.
    pub(crate) fn composite(&mut self, layer: &Self, mut mix: impl FnMut(SurfaceId, SurfaceId) -> SurfaceId) {
        let per_pixel = self.side * self.words;
        for pixel in self.places() {
            if let (Some(below), Some(above)) = (self.pair(pixel), layer.pair(pixel))
                && (below.mask == 0 || above.mask == 0 || below.mask == above.mask)
            {
                let pair = TwoSurfaces {
                    mask: below.mask | above.mask,
                    first: mix(below.first, above.first),
                    second: mix(below.second, above.second),
                };
                self.set_pair(pixel, pair);
                continue;
            }
            self.split(pixel);
            let first = self.first_word(pixel);
            for i in 0..per_pixel {
                let above = match layer.pair(pixel) {
                    None => layer.samples[first + i],
                    Some(pair) => layer.word(pair, i),
                };
                let (below, above) = (lanes(self.samples[first + i]), lanes(above));
                let mixed = [0, 1, 2, 3].map(|i| mix(below[i], above[i]));
                self.samples[first + i] = joined(mixed);
            }
        }
    }

    /// What a pixel shows that is not split; a single surface twice, with no bit set.
    #[inline]
    fn pair(&self, pixel: PixelIndex) -> Option<TwoSurfaces> {
        match self.whole[pixel.0][pixel.1] {
            SPLIT => None,
            TWO_SURFACES => Some(self.pairs.get(pixel)),
            surface => Some(TwoSurfaces {
                mask: 0,
                first: surface,
                second: surface,
            }),
        }
    }

    /// Four samples of a pixel that shows a pair, as word `i` of the split pixel.
    #[inline]
    fn word(&self, pair: TwoSurfaces, i: usize) -> u64 {
        if pair.mask == 0 {
            return splat(pair.first);
        }
        let (row, column) = (i / self.words, i % self.words * PER_WORD);
        of_two(
            [splat(pair.first), splat(pair.second)],
            pair.mask >> (row * self.side + column),
        )
    }

    /// Calls `paint` for every word of a split pixel with the bits of the samples that `spans` cover; `x` is the pixel's
    /// column in the frame.
    #[inline]
    fn each_covered_word(&mut self, pixel: PixelIndex, x: i32, spans: &[Span], mut paint: impl FnMut(&mut u64, u64)) {
        let left = x * i32::try_from(self.side).unwrap_or(1);
        if self.words == 1 {
            let first = self.first_word(pixel);
            let samples = &mut self.samples[first..][..self.side];
            for (word, span) in samples.iter_mut().zip(spans) {
                paint(word, covered(*span, left));
            }
            return;
        }
        let first = self.first_word(pixel);
        let samples = &mut self.samples[first..][..self.side * self.words];
        for (words, span) in samples.chunks_exact_mut(self.words).zip(spans) {
            for (word, left) in words.iter_mut().zip((left..).step_by(PER_WORD)) {
                paint(word, covered(*span, left));
            }
        }
    }

    /// Gives a pixel one surface per sample, if it is not split yet.
    #[inline]
    fn split(&mut self, pixel: PixelIndex) {
        let Some(pair) = self.pair(pixel) else {
            return;
        };
        self.make_room();
        self.share(pixel, SPLIT);
        let first = self.first_word(pixel);
        let (side, words) = (self.side, self.words);
        let surfaces = [splat(pair.first), splat(pair.second)];
        let samples = &mut self.samples[first..][..side * words];
        if words == 1 {
            // Without a division for the rows, which costs as much as all the rest.
            for (word, shift) in samples.iter_mut().zip((0..).step_by(side)) {
                *word = of_two(surfaces, pair.mask >> (shift % 64));
            }
            return;
        }
        for (y, row) in samples.chunks_exact_mut(words).enumerate() {
            for (word, shift) in row.iter_mut().zip((y * side..).step_by(PER_WORD)) {
                *word = of_two(surfaces, pair.mask >> (shift % 64));
            }
        }
    }

    /// Makes sure that there is room for the samples of all pixels.
    #[inline]
    fn make_room(&mut self) {
        let count = self.first_word((self.whole.len(), 0));
        if self.samples.len() < count {
            self.samples.resize(count, 0);
        }
    }

    /// Where the samples of a split pixel begin.
    #[inline]
    fn first_word(&self, (y, x): PixelIndex) -> usize {
        (y * self.width + x) * self.side * self.words
    }

    /// What each pixel of row `y` shows.
    #[inline]
    pub(crate) fn row(&self, y: i32) -> &[SurfaceId] {
        &self.whole[offset(self.rect.y.start, y)][..self.width]
    }

    /// The runs of row `y` from left to right, each with its range of pixels counted from the tile's left side.
    #[inline]
    pub(crate) fn runs(&self, y: i32) -> impl Iterator<Item = (Run, Range<usize>)> + '_ {
        let line = self.row(y);
        let mut start = 0;
        std::iter::from_fn(move || {
            let surface = *line.get(start)?;
            let end = start + run_length(&line[start..], surface);
            let range = start..end;
            start = end;
            let run = match surface {
                SPLIT => Run::Split,
                TWO_SURFACES => Run::TwoSurfacePixels,
                surface => Run::Whole(surface),
            };
            Some((run, range))
        })
    }

    /// The pixels of row `y`.
    #[inline(always)]
    #[expect(clippy::inline_always, reason = "vector instructions reach inlined code only")]
    pub(crate) fn shown(&self, y: i32) -> Shown<'_> {
        let y = offset(self.rect.y.start, y);
        Shown {
            whole: &self.whole[y],
            shared: self.shared[y],
            pairs: self.pairs.row(y),
        }
    }

    /// What the pixels of row `y` show that are pairs; of no account for others.
    #[inline]
    pub(crate) fn pairs(&self, y: i32) -> TwoSurfaceRow<'_> {
        self.pairs.row(offset(self.rect.y.start, y))
    }

    /// The bits of all samples of a pixel that may be a pair.
    pub(crate) fn all(&self) -> u64 {
        self.all
    }

    /// The surfaces of a split pixel's samples, row by row; `x` counts from the tile's left side.
    #[inline]
    pub(crate) fn samples(&self, x: usize, y: i32) -> impl Iterator<Item = SurfaceId> + '_ {
        self.words(x, y)
            .chunks_exact(self.words)
            .flat_map(|row| row.iter().flat_map(|word| lanes(*word)).take(self.side))
    }

    /// Calls `visit` with the samples of a split pixel, four in a word, each with how many of them count.
    #[inline]
    pub(crate) fn each_sample_word(&self, x: usize, y: i32, mut visit: impl FnMut(u64, u32)) {
        let words = self.words(x, y);
        if self.words == 1 {
            for word in words {
                visit(*word, self.used[0]);
            }
            return;
        }
        for row in words.chunks_exact(self.words) {
            for (word, used) in row.iter().zip(&self.used) {
                visit(*word, *used);
            }
        }
    }

    /// The samples of a split pixel, four in each word; `None` where some words hold fewer.
    #[inline]
    pub(crate) fn full_words(&self, x: usize, y: i32) -> Option<&[u64]> {
        self.side.is_multiple_of(PER_WORD).then(|| self.words(x, y))
    }

    #[inline]
    fn words(&self, x: usize, y: i32) -> &[u64] {
        let first = self.first_word((offset(self.rect.y.start, y), x));
        &self.samples[first..][..self.side * self.words]
    }

    /// Renumbers all surfaces in use: `renumber` is called once for each, in no particular order.
    pub(crate) fn renumber(&mut self, renumber: impl Fn(SurfaceId) -> SurfaceId) {
        for pixel in self.places() {
            match self.whole[pixel.0][pixel.1] {
                TWO_SURFACES => {
                    let TwoSurfaces { mask, first, second } = self.pairs.get(pixel);
                    let (first, second) = (renumber(first), renumber(second));
                    self.pairs.set(pixel, TwoSurfaces { mask, first, second });
                }
                SPLIT => {
                    let first = self.first_word(pixel);
                    for word in &mut self.samples[first..][..self.side * self.words] {
                        *word = joined(lanes(*word).map(&renumber));
                    }
                }
                whole => self.whole[pixel.0][pixel.1] = renumber(whole),
            }
        }
    }

    /// Calls `seen` with every surface in use, often several times.
    pub(crate) fn each_slot(&self, mut seen: impl FnMut(SurfaceId)) {
        for pixel in self.places() {
            match self.whole[pixel.0][pixel.1] {
                SPLIT => {
                    for word in &self.samples[self.first_word(pixel)..][..self.side * self.words] {
                        lanes(*word).into_iter().for_each(&mut seen);
                    }
                }
                TWO_SURFACES => {
                    let pair = self.pairs.get(pixel);
                    [pair.first, pair.second].into_iter().for_each(&mut seen);
                }
                whole => seen(whole),
            }
        }
    }
}

/// How many surfaces at the beginning of `line` are `surface`.
#[inline]
fn run_length(line: &[SurfaceId], surface: SurfaceId) -> usize {
    let mut length = 0;
    // Long runs in blocks, which compilers compare as one.
    for block in line.chunks_exact(BLOCK) {
        if block != [surface; BLOCK] {
            break;
        }
        length += BLOCK;
    }
    length + line[length..].iter().take_while(|found| **found == surface).count()
}

/// The bits of the samples that `spans` cover in a pixel with `side` samples a row; `x` is its column in the frame.
#[inline]
fn mask(side: usize, x: i32, spans: &[Span], sides: Sides) -> u64 {
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

/// A distance inside a tile, which is never negative.
#[inline]
fn offset(from: i32, to: i32) -> usize {
    debug_assert!(to >= from, "{to} lies at or after the tile's start {from}");
    (to - from).cast_unsigned() as usize
}
