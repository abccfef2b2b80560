//! Which primitive each sample of a tile shows.
//!
//! # Compressed samples
//!
//! A pixel whose samples all show the same primitive stores that once. The first edge that crosses it makes it a pair:
//! two primitives, and one bit per sample that says which of them it shows. Only what a third one shares is split into a
//! number per sample. A primitive that covers a pixel wholly makes it one again. So flat areas cost one store per pixel
//! at every sample rate, most edges a few bits, and nothing is shaded before it is known to be seen.

use std::ops::Range;

use fearless_simd::Simd;
use fearless_simd::prelude::*;

use super::four::{Ends, Window, each_window, fill};
use super::pairs::{self, Pair, PairRow, Pairs, QUAD, Quad};
use super::pixel_row::PixelRow;
use super::rows::Span;
use super::tile::PixelRect;

/// A primitive's number inside a tile.
pub(crate) type Slot = u16;

/// Stands for a pixel that is split.
const SPLIT: Slot = Slot::MAX;

/// Stands for a pixel that shows a [`Pair`].
pub(crate) const PAIR: Slot = Slot::MAX - 1;

/// Bits of which one is set for each shared pixel of four, and perhaps for others.
const PERHAPS_SHARED: u64 = 0x8000_8000_8000_8000;

/// Most slots of a tile.
pub(crate) const MAX_SLOTS: usize = PAIR as usize;

/// Pixels of a block.
pub(crate) const BLOCK: usize = 8;

/// Pixels of which a word has a bit each.
pub(crate) const STRETCH: usize = BLOCK * BLOCK;

/// Most samples along the side of a pixel that may be a pair.
const MAX_PAIR_SIDE: usize = 8;

/// Samples of a sample row in one word.
const PER_WORD: usize = 4;

/// The bits of the first `i` samples of a word.
const FIRST: [u64; PER_WORD + 1] = [0, 0xFFFF, 0xFFFF_FFFF, 0xFFFF_FFFF_FFFF, u64::MAX];

/// For four bits the sixteen bits of a word that belong to each.
const SPREAD_BITS: [u64; 16] = {
    let mut spread = [0; 16];
    let mut bits = 0;
    while bits < 16 {
        let mut lane = 0;
        while lane < PER_WORD {
            if bits >> lane & 1 != 0 {
                spread[bits] |= 0xFFFF << (16 * lane);
            }
            lane += 1;
        }
        bits += 1;
    }
    spread
};

/// The slots of a rectangle of pixels.
#[derive(Debug)]
pub(crate) struct VisibilityTile {
    pub(crate) rect: PixelRect,
    width: usize,
    /// Distance between two rows of pixels: whole blocks.
    stride: usize,
    /// Samples along one side of a pixel.
    side: usize,
    /// Words that one sample row of a pixel takes: four samples each, the last one perhaps with some to spare.
    words: usize,
    /// How many samples each of these words holds.
    used: Vec<u32>,
    /// The bits of all samples of a pixel; none where there are too many for pairs.
    all: u64,
    /// One slot per pixel, or [`PAIR`], or [`SPLIT`].
    whole: Vec<Slot>,
    /// For each block of pixels side by side a bit for each that was a pair or split once; it need not be any more.
    shared: Vec<u8>,
    /// What pairs show, pixel by pixel.
    pairs: Pairs,
    /// The slots of split pixels, pixel by pixel. Allocated with the first split.
    samples: Vec<u64>,
}

/// Pixels side by side, [`STRETCH`] or up to the tile's right side.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Stretch<'a> {
    /// What each shows; beyond the tile's right side something.
    pub(crate) shown: &'a [[Slot; BLOCK]],
    /// The pixels that may be pairs or split, a bit for each.
    pub(crate) shared: u64,
    /// What those show that are pairs; of no account for others.
    pub(crate) pairs: PairRow<'a>,
}

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
    /// All samples of these pixels show one slot.
    Whole(Slot),
    /// The samples of these pixels show two slots each.
    Pairs,
    /// The samples of these pixels differ.
    Split,
}

impl VisibilityTile {
    /// A tile of no pixels with `side x side` samples each.
    pub(crate) fn new(side: i32) -> Self {
        let side = usize::try_from(side).unwrap_or(1);
        Self {
            rect: PixelRect::NOTHING,
            width: 0,
            stride: 0,
            side,
            words: side.div_ceil(PER_WORD),
            used: (0..side)
                .step_by(PER_WORD)
                .map(|at| u32::try_from((side - at).min(PER_WORD)).unwrap_or(0))
                .collect(),
            all: if side <= MAX_PAIR_SIDE {
                u64::MAX >> (64 - side * side)
            } else {
                0
            },
            whole: Vec::new(),
            shared: Vec::new(),
            pairs: Pairs::new(side),
            samples: Vec::new(),
        }
    }

    /// Makes it the tile of `rect` in which every sample shows `slot`.
    pub(crate) fn reset(&mut self, rect: PixelRect, slot: Slot) {
        let length = |span: Span| usize::try_from(span.end - span.start).unwrap_or(0);
        self.rect = rect;
        self.width = length(rect.x);
        self.stride = self.width.next_multiple_of(BLOCK);
        self.whole.clear();
        self.whole.resize(self.stride * length(rect.y), slot);
        self.shared.clear();
        self.shared.resize(self.whole.len() / BLOCK, 0);
        if self.all != 0 {
            self.pairs.make_room(self.whole.len());
        }
    }

    /// Lets every sample show `slot`.
    pub(crate) fn cover(&mut self, slot: Slot) {
        self.whole.fill(slot);
    }

    /// Lets the samples that a row of pixels covers show `slot`.
    #[inline]
    pub(crate) fn paint(&mut self, row: &PixelRow<'_>, slot: Slot) {
        let left = self.rect.x.start;
        let line = offset(self.rect.y.start, row.y) * self.stride;
        if !row.full.is_empty() {
            self.whole[line + offset(left, row.full.start)..line + offset(left, row.full.end)].fill(slot);
        }
        if self.all == 0 {
            for x in row.partial() {
                let pixel = line + offset(left, x);
                self.split(pixel);
                let painted = splat(slot);
                self.each_covered_word(pixel, x, row.spans(), |word, mask| {
                    *word = *word & !mask | painted & mask;
                });
            }
            return;
        }
        self.paint_partial(self.side, row, line, slot);
    }

    /// As [`VisibilityTile::paint`] where a pixel has 4 x 4 samples.
    #[inline(always)]
    #[expect(
        clippy::inline_always,
        reason = "a call for each row of pixels would cost as much as the rest"
    )]
    pub(crate) fn paint_four<S: Simd>(&mut self, simd: S, row: &PixelRow<'_>, slot: Slot) {
        let left = self.rect.x.start;
        let line = offset(self.rect.y.start, row.y) * self.stride;
        self.note_shared(line, row);
        let last = left + self.last_quad();
        if row.full.is_empty() {
            return each_window(
                simd,
                row.spans(),
                (row.touched, last),
                Ends::Both,
                #[inline(always)]
                |window| self.paint_quad(simd, line + offset(left, window.x), window, slot),
            );
        }
        let (before, after) = row.beside_full();
        each_window(
            simd,
            row.spans(),
            (before, last),
            Ends::Left,
            #[inline(always)]
            |window| self.paint_quad(simd, line + offset(left, window.x), window, slot),
        );
        each_window(
            simd,
            row.spans(),
            (after, last),
            Ends::Right,
            #[inline(always)]
            |window| self.paint_quad(simd, line + offset(left, window.x), window, slot),
        );
        // Last: slots that were just written as vectors are read slowly.
        let slots = &mut self.whole[line..line + self.stride];
        fill(slots, offset(left, row.full.start), offset(left, row.full.end), slot);
    }

    /// Lets the samples of a row of pixels that is covered in part show `slot`; `line` is the index of its first pixel.
    fn paint_partial(&mut self, side: usize, row: &PixelRow<'_>, line: usize, slot: Slot) {
        let (left, spans) = (self.rect.x.start, row.spans());
        if row.full.is_empty() {
            for x in row.touched.start..row.touched.end {
                let covered = mask(side, x, spans, Sides::Both);
                if covered != 0 {
                    self.paint_samples(line + offset(left, x), covered, slot);
                }
            }
            return;
        }
        // Beside pixels that are full, each holds some covered samples, and none holds all.
        for x in row.touched.start..row.full.start {
            self.paint_samples(line + offset(left, x), mask(side, x, spans, Sides::Left), slot);
        }
        for x in row.full.end..row.touched.end {
            self.paint_samples(line + offset(left, x), mask(side, x, spans, Sides::Right), slot);
        }
    }

    /// Lets some samples of a pixel show `slot`, at least one and not all.
    #[inline(always)]
    #[expect(clippy::inline_always, reason = "a dozen instructions for every pixel on an edge")]
    fn paint_samples(&mut self, pixel: usize, covered: u64, slot: Slot) {
        let shown = self.whole[pixel];
        if shown == slot {
            return;
        }
        if shown >= PAIR {
            return self.paint_shared(pixel, covered, slot);
        }
        self.share(pixel, PAIR);
        let pair = Pair {
            mask: covered,
            first: shown,
            second: slot,
        };
        self.pairs.set(pixel, pair);
    }

    /// Makes a pixel a [`PAIR`] or [`SPLIT`].
    #[inline(always)]
    #[expect(clippy::inline_always, reason = "a few instructions for every pixel on an edge")]
    fn share(&mut self, pixel: usize, kind: Slot) {
        self.whole[pixel] = kind;
        self.shared[pixel / BLOCK] |= 1 << (pixel % BLOCK);
    }

    /// As [`VisibilityTile::paint_samples`] where samples differ already.
    #[inline(never)]
    fn paint_shared(&mut self, pixel: usize, covered: u64, slot: Slot) {
        if self.whole[pixel] == PAIR && self.paint_pair(pixel, covered, slot) {
            return;
        }
        self.split(pixel);
        let painted = splat(slot);
        let (side, words) = (self.side, self.words);
        let samples = &mut self.samples[pixel * side * words..][..side * words];
        if words == 1 {
            for (word, shift) in samples.iter_mut().zip((0..).step_by(side)) {
                let mask = SPREAD_BITS[(covered >> shift & 0xF) as usize];
                *word = *word & !mask | painted & mask;
            }
            return;
        }
        for (row, of_row) in samples.chunks_exact_mut(words).enumerate() {
            for (word, shift) in of_row.iter_mut().zip((row * side..).step_by(PER_WORD)) {
                let mask = SPREAD_BITS[(covered >> shift & 0xF) as usize];
                *word = *word & !mask | painted & mask;
            }
        }
    }

    /// The bits of the samples that `spans` cover in the pixel in column `x` of the frame.
    #[inline]
    fn mask(&self, x: i32, spans: &[Span]) -> u64 {
        match self.side {
            4 => mask(4, x, spans, Sides::Both),
            side => mask(side, x, spans, Sides::Both),
        }
    }

    /// Lets samples of a pixel that is a pair show `slot`; false, and nothing done, where it would show three.
    #[inline]
    fn paint_pair(&mut self, pixel: usize, covered: u64, slot: Slot) -> bool {
        let Pair { mask, first, second } = self.pairs.get(pixel);
        let pair = if second == slot {
            Pair {
                mask: mask | covered,
                first,
                second,
            }
        } else if first == slot {
            Pair {
                mask: mask & !covered,
                first,
                second,
            }
        } else if mask & !covered == 0 {
            Pair {
                mask: covered,
                first,
                second: slot,
            }
        } else if self.all & !mask & !covered == 0 {
            Pair {
                mask: covered,
                first: second,
                second: slot,
            }
        } else {
            return false;
        };
        self.set_pair(pixel, pair);
        true
    }

    /// Lets a pixel show two slots, or the one that is left of them.
    #[inline(always)]
    #[expect(clippy::inline_always, reason = "a few instructions for every pixel on an edge")]
    fn set_pair(&mut self, pixel: usize, pair: Pair) {
        if pair.mask == 0 {
            self.whole[pixel] = pair.first;
        } else if pair.mask == self.all {
            self.whole[pixel] = pair.second;
        } else {
            self.share(pixel, PAIR);
            self.pairs.set(pixel, pair);
        }
    }

    /// Lets the samples that a row of pixels covers show what `change` makes of what they show.
    pub(crate) fn change(&mut self, row: &PixelRow<'_>, mut change: impl FnMut(Slot) -> Slot) {
        let left = self.rect.x.start;
        let line = offset(self.rect.y.start, row.y) * self.stride;
        self.change_whole(
            line + offset(left, row.full.start.min(row.full.end))..line + offset(left, row.full.end),
            &mut change,
        );
        for x in row.partial() {
            let covered = if self.all != 0 { self.mask(x, row.spans()) } else { 0 };
            self.change_samples((line + offset(left, x), x), (covered, row.spans()), &mut change);
        }
    }

    /// As [`VisibilityTile::change`] where a pixel has 4 x 4 samples.
    #[inline(always)]
    #[expect(
        clippy::inline_always,
        reason = "a call for each row of pixels would cost as much as the rest"
    )]
    pub(crate) fn change_four<S: Simd>(&mut self, simd: S, row: &PixelRow<'_>, mut change: impl FnMut(Slot) -> Slot) {
        let left = self.rect.x.start;
        let line = offset(self.rect.y.start, row.y) * self.stride;
        if !row.full.is_empty() {
            self.change_whole(
                line + offset(left, row.full.start)..line + offset(left, row.full.end),
                &mut change,
            );
        }
        self.note_shared(line, row);
        let last = left + self.last_quad();
        if row.full.is_empty() {
            return each_window(
                simd,
                row.spans(),
                (row.touched, last),
                Ends::Both,
                #[inline(always)]
                |window| self.change_quad(simd, line + offset(left, window.x), (window, row.spans()), &mut change),
            );
        }
        let (before, after) = row.beside_full();
        each_window(
            simd,
            row.spans(),
            (before, last),
            Ends::Left,
            #[inline(always)]
            |window| self.change_quad(simd, line + offset(left, window.x), (window, row.spans()), &mut change),
        );
        each_window(
            simd,
            row.spans(),
            (after, last),
            Ends::Right,
            #[inline(always)]
            |window| self.change_quad(simd, line + offset(left, window.x), (window, row.spans()), &mut change),
        );
    }

    /// The first of the last four pixels of a row.
    fn last_quad(&self) -> i32 {
        i32::try_from(self.stride.saturating_sub(QUAD)).unwrap_or(i32::MAX)
    }

    /// Notes which pixels of a row may be shared once those covered in part are; `line` is the index of its first pixel.
    #[inline(always)]
    #[expect(clippy::inline_always, reason = "a few instructions for every row of pixels")]
    fn note_shared(&mut self, line: usize, row: &PixelRow<'_>) {
        let left = self.rect.x.start;
        let shared = &mut self.shared[line / BLOCK..][..self.stride / BLOCK];
        let bits = |span: Span| bits(offset(left, span.start), offset(left, span.end));
        if let Ok(bytes) = <&mut [u8; BLOCK]>::try_from(&mut *shared) {
            let full = if row.full.is_empty() { 0 } else { bits(row.full) };
            *bytes = ((u64::from_le_bytes(*bytes) | bits(row.touched)) & !full).to_le_bytes();
            return;
        }
        for x in row.partial() {
            let at = offset(left, x);
            shared[at / BLOCK] |= 1 << (at % BLOCK);
        }
    }

    /// Lets those samples of four pixels show `slot` that a window covers; pixels of which it covers all are left alone.
    #[inline(always)]
    #[expect(clippy::inline_always, reason = "vector instructions reach inlined code only")]
    fn paint_quad<S: Simd>(&mut self, simd: S, pixel: usize, Window { live, masks, .. }: Window, slot: Slot) {
        let Some(whole) = self.whole[pixel..].first_chunk_mut() else {
            return;
        };
        let word = joined(*whole);
        if word & live & PERHAPS_SHARED != 0 {
            return self.paint_shared_quad(pixel, masks, slot);
        }
        let number = |number| Quad::splat(simd, number);
        let (shown, covered) = (pairs::quad(simd, word), pairs::quad(simd, masks));
        let painted = in_part(simd, covered) & !shown.simd_eq(number(slot));
        pairs::put(whole, painted.select(number(PAIR), shown));
        self.pairs
            .set_quad(simd, (pixel, painted), (covered, shown, number(slot)));
    }

    /// As [`VisibilityTile::paint_quad`] pixel by pixel.
    #[inline(never)]
    fn paint_shared_quad(&mut self, pixel: usize, masks: u64, slot: Slot) {
        for (pixel, covered) in (pixel..).zip(lanes(masks)) {
            if covered != 0 && covered != u16::MAX {
                self.paint_samples(pixel, u64::from(covered), slot);
            }
        }
    }

    /// As [`VisibilityTile::change_samples`] for the four pixels of a window from index `pixel` on; those of which it
    /// covers all samples are left alone.
    #[inline(always)]
    #[expect(clippy::inline_always, reason = "vector instructions reach inlined code only")]
    fn change_quad<S: Simd>(
        &mut self,
        simd: S,
        pixel: usize,
        (Window { x, live, masks }, spans): (Window, &[Span]),
        change: &mut impl FnMut(Slot) -> Slot,
    ) {
        let Some(whole) = self.whole[pixel..].first_chunk_mut() else {
            return;
        };
        let word = joined(*whole);
        let first = (word >> (live.trailing_zeros() % 64)) as Slot;
        if first >= PAIR || (word ^ splat(first)) & live != 0 {
            for ((pixel, x), covered) in (pixel..).zip(x..).zip(lanes(masks)) {
                if covered != 0 && covered != u16::MAX {
                    self.change_samples((pixel, x), (u64::from(covered), spans), change);
                }
            }
            return;
        }
        if masks == 0 {
            return;
        }
        let number = |number| Quad::splat(simd, number);
        let (shown, covered) = (pairs::quad(simd, word), pairs::quad(simd, masks));
        let changed = in_part(simd, covered);
        pairs::put(whole, changed.select(number(PAIR), shown));
        self.pairs
            .set_quad(simd, (pixel, changed), (covered, shown, number(change(first))));
    }

    /// Lets the samples that `spans` cover in a pixel, by its index and its column in the frame, show what `change` makes
    /// of what they show; `covered` are their bits, if it may be a pair.
    #[inline(always)]
    #[expect(clippy::inline_always, reason = "a dozen instructions for every pixel on an edge")]
    fn change_samples(
        &mut self,
        (pixel, x): (usize, i32),
        (covered, spans): (u64, &[Span]),
        change: &mut impl FnMut(Slot) -> Slot,
    ) {
        if self.whole[pixel] != SPLIT && self.all != 0 && (covered == 0 || self.change_pair(pixel, covered, change)) {
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
    /// where the pixel would show three slots or more.
    fn change_pair(&mut self, pixel: usize, covered: u64, change: &mut impl FnMut(Slot) -> Slot) -> bool {
        let shown = self.whole[pixel];
        let pair = if shown == PAIR {
            let Pair { mask, first, second } = self.pairs.get(pixel);
            let (of_first, of_second) = (self.all & !mask, mask);
            // Each is covered as a whole or not at all.
            if [of_first, of_second]
                .iter()
                .any(|part| part & covered != 0 && part & !covered != 0)
            {
                return false;
            }
            let mut changed = |part: u64, slot| if part & covered == 0 { slot } else { change(slot) };
            Pair {
                mask,
                first: changed(of_first, first),
                second: changed(of_second, second),
            }
        } else {
            Pair {
                mask: covered,
                first: shown,
                second: change(shown),
            }
        };
        self.set_pair(pixel, pair);
        true
    }

    /// As [`VisibilityTile::change`] for all samples.
    pub(crate) fn change_all(&mut self, mut change: impl FnMut(Slot) -> Slot) {
        self.change_whole(0..self.whole.len(), &mut change);
    }

    /// As [`VisibilityTile::change`] for all samples of the pixels `xs` of row `y`.
    pub(crate) fn change_pixels(&mut self, xs: Span, y: i32, mut change: impl FnMut(Slot) -> Slot) {
        self.change_whole(self.pixels(xs, y), &mut change);
    }

    /// Lets all samples of the pixels `xs` of row `y` show `slot`.
    #[inline]
    pub(crate) fn paint_pixels(&mut self, xs: Span, y: i32, slot: Slot) {
        let pixels = self.pixels(xs, y);
        self.whole[pixels].fill(slot);
    }

    /// The indices of pixels.
    #[inline]
    fn pixels(&self, xs: Span, y: i32) -> Range<usize> {
        let line = offset(self.rect.y.start, y) * self.stride;
        let left = self.rect.x.start;
        line + offset(left, xs.start)..line + offset(left, xs.end)
    }

    /// Lets a pair show what `change` makes of its slots.
    fn change_slots(&mut self, pixel: usize, mut change: impl FnMut(Slot) -> Slot) {
        let Pair { mask, first, second } = self.pairs.get(pixel);
        let (first, second) = (change(first), change(second));
        self.pairs.set(pixel, Pair { mask, first, second });
    }

    fn change_whole(&mut self, pixels: Range<usize>, change: &mut impl FnMut(Slot) -> Slot) {
        let per_pixel = self.side * self.words;
        let mut start = pixels.start;
        while start < pixels.end {
            let shown = self.whole[start];
            let end = start + run_length(&self.whole[start..pixels.end], shown);
            match shown {
                SPLIT => {
                    for word in &mut self.samples[start * per_pixel..end * per_pixel] {
                        *word = changed(*word, u64::MAX, change);
                    }
                }
                PAIR => {
                    for pixel in start..end {
                        self.change_slots(pixel, &mut *change);
                    }
                }
                _ => self.whole[start..end].fill(change(shown)),
            }
            start = end;
        }
    }

    /// Lets each sample show what `mix` makes of its slot here and in a `layer` of the same rectangle.
    pub(crate) fn composite(&mut self, layer: &Self, mut mix: impl FnMut(Slot, Slot) -> Slot) {
        let per_pixel = self.side * self.words;
        for pixel in 0..self.whole.len() {
            if let (Some(below), Some(above)) = (self.pair(pixel), layer.pair(pixel))
                && (below.mask == 0 || above.mask == 0 || below.mask == above.mask)
            {
                let pair = Pair {
                    mask: below.mask | above.mask,
                    first: mix(below.first, above.first),
                    second: mix(below.second, above.second),
                };
                self.set_pair(pixel, pair);
                continue;
            }
            self.split(pixel);
            for i in 0..per_pixel {
                let above = match layer.pair(pixel) {
                    None => layer.samples[pixel * per_pixel + i],
                    Some(pair) => layer.word(pair, i),
                };
                let word = pixel * per_pixel + i;
                let (below, above) = (lanes(self.samples[word]), lanes(above));
                let mixed = [0, 1, 2, 3].map(|i| mix(below[i], above[i]));
                self.samples[word] = joined(mixed);
            }
        }
    }

    /// What a pixel shows that is not split; a single slot twice, with no bit set.
    #[inline]
    fn pair(&self, pixel: usize) -> Option<Pair> {
        match self.whole[pixel] {
            SPLIT => None,
            PAIR => Some(self.pairs.get(pixel)),
            slot => Some(Pair {
                mask: 0,
                first: slot,
                second: slot,
            }),
        }
    }

    /// Four samples of a pixel that shows a pair, as word `i` of the split pixel.
    #[inline]
    fn word(&self, pair: Pair, i: usize) -> u64 {
        if pair.mask == 0 {
            return splat(pair.first);
        }
        let (row, column) = if self.words == 1 {
            (i, 0)
        } else {
            (i / self.words, i % self.words * PER_WORD)
        };
        let second = SPREAD_BITS[(pair.mask >> (row * self.side + column) & 0xF) as usize];
        splat(pair.first) & !second | splat(pair.second) & second
    }

    /// Calls `paint` for every word of a split pixel with the bits of the samples that `spans` cover; `x` is the pixel's
    /// column in the frame.
    #[inline]
    fn each_covered_word(&mut self, pixel: usize, x: i32, spans: &[Span], mut paint: impl FnMut(&mut u64, u64)) {
        let left = x * i32::try_from(self.side).unwrap_or(1);
        if self.words == 1 {
            let samples = &mut self.samples[pixel * self.side..][..self.side];
            for (word, span) in samples.iter_mut().zip(spans) {
                paint(word, covered(*span, left));
            }
            return;
        }
        let per_pixel = self.side * self.words;
        let samples = &mut self.samples[pixel * per_pixel..][..per_pixel];
        for (words, span) in samples.chunks_exact_mut(self.words).zip(spans) {
            for (word, left) in words.iter_mut().zip((left..).step_by(PER_WORD)) {
                paint(word, covered(*span, left));
            }
        }
    }

    /// Gives a pixel one slot per sample, if it is not split yet.
    #[inline]
    fn split(&mut self, pixel: usize) {
        let Some(pair) = self.pair(pixel) else {
            return;
        };
        self.make_room();
        let per_pixel = self.side * self.words;
        self.share(pixel, SPLIT);
        for i in 0..per_pixel {
            self.samples[pixel * per_pixel + i] = self.word(pair, i);
        }
    }

    /// Makes sure that there is room for the samples of all pixels.
    #[inline]
    fn make_room(&mut self) {
        let count = self.whole.len() * self.side * self.words;
        if self.samples.len() < count {
            self.samples.resize(count, 0);
        }
    }

    /// What each pixel of row `y` shows.
    #[inline]
    pub(crate) fn row(&self, y: i32) -> &[Slot] {
        &self.whole[offset(self.rect.y.start, y) * self.stride..][..self.width]
    }

    /// The runs of row `y` from left to right, each with its range of pixels counted from the tile's left side.
    #[inline]
    pub(crate) fn runs(&self, y: i32) -> impl Iterator<Item = (Run, Range<usize>)> + '_ {
        let line = self.row(y);
        let mut start = 0;
        std::iter::from_fn(move || {
            let slot = *line.get(start)?;
            let end = start + run_length(&line[start..], slot);
            let range = start..end;
            start = end;
            let run = match slot {
                SPLIT => Run::Split,
                PAIR => Run::Pairs,
                slot => Run::Whole(slot),
            };
            Some((run, range))
        })
    }

    /// The pixels of row `y` from left to right.
    #[inline(always)]
    #[expect(clippy::inline_always, reason = "vector instructions reach inlined code only")]
    pub(crate) fn stretches(&self, y: i32) -> impl Iterator<Item = Stretch<'_>> {
        let blocks = self.stride / BLOCK;
        let first = offset(self.rect.y.start, y) * blocks;
        let (shown, _) = self.whole[first * BLOCK..][..self.stride].as_chunks();
        let shared = self.shared[first..][..blocks].chunks(BLOCK);
        let starts = (first * BLOCK..).step_by(STRETCH);
        let parts = shown.chunks(BLOCK).zip(shared).zip(starts);
        parts.map(|((shown, shared), start)| Stretch {
            shown,
            shared: word_of(shared),
            pairs: self.pairs.row(start, shown.len() * BLOCK),
        })
    }

    /// What the pixels of row `y` show that are pairs; of no account for others.
    #[inline]
    pub(crate) fn pairs(&self, y: i32) -> PairRow<'_> {
        self.pairs.row(offset(self.rect.y.start, y) * self.stride, self.width)
    }

    /// The bits of all samples of a pixel that may be a pair.
    pub(crate) fn all(&self) -> u64 {
        self.all
    }

    /// The slots of a split pixel's samples, row by row; `x` counts from the tile's left side.
    #[inline]
    pub(crate) fn samples(&self, x: usize, y: i32) -> impl Iterator<Item = Slot> + '_ {
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

    #[inline]
    fn words(&self, x: usize, y: i32) -> &[u64] {
        let pixel = offset(self.rect.y.start, y) * self.stride + x;
        &self.samples[pixel * self.side * self.words..][..self.side * self.words]
    }

    /// Renumbers all slots in use: `renumber` is called once for each, in no particular order.
    pub(crate) fn renumber(&mut self, renumber: impl Fn(Slot) -> Slot) {
        let per_pixel = self.side * self.words;
        for (pixel, slot) in self.whole.iter_mut().enumerate() {
            match *slot {
                PAIR => {
                    let Pair { mask, first, second } = self.pairs.get(pixel);
                    let (first, second) = (renumber(first), renumber(second));
                    self.pairs.set(pixel, Pair { mask, first, second });
                    continue;
                }
                SPLIT => {}
                whole => {
                    *slot = renumber(whole);
                    continue;
                }
            }
            for word in &mut self.samples[pixel * per_pixel..][..per_pixel] {
                *word = joined(lanes(*word).map(&renumber));
            }
        }
    }

    /// Calls `seen` with every slot in use, often several times.
    pub(crate) fn each_slot(&self, mut seen: impl FnMut(Slot)) {
        let per_pixel = self.side * self.words;
        for (pixel, slot) in self.whole.iter().enumerate() {
            match *slot {
                SPLIT => {
                    for word in &self.samples[pixel * per_pixel..][..per_pixel] {
                        lanes(*word).into_iter().for_each(&mut seen);
                    }
                }
                PAIR => {
                    let pair = self.pairs.get(pixel);
                    [pair.first, pair.second].into_iter().for_each(&mut seen);
                }
                whole => seen(whole),
            }
        }
    }
}

/// Up to eight bytes, the first one lowest.
#[inline(always)]
#[expect(clippy::inline_always, reason = "one instruction, mostly")]
fn word_of(bytes: &[u8]) -> u64 {
    match <[u8; BLOCK]>::try_from(bytes) {
        Ok(bytes) => u64::from_le_bytes(bytes),
        Err(_) => bytes.iter().rev().fold(0, |word, byte| word << 8 | u64::from(*byte)),
    }
}

/// How many slots at the beginning of `line` are `slot`.
#[inline]
fn run_length(line: &[Slot], slot: Slot) -> usize {
    let mut length = 0;
    // Long runs in blocks, which compilers compare as one.
    for block in line.chunks_exact(BLOCK) {
        if block != [slot; BLOCK] {
            break;
        }
        length += BLOCK;
    }
    length + line[length..].iter().take_while(|found| **found == slot).count()
}

/// The bits of the samples that `spans` cover in a pixel with `side` samples a row; `x` is its column in the frame.
#[inline(always)]
#[expect(clippy::inline_always, reason = "faster where `side` is known")]
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

/// The bits of the four samples from column `left` on that a span covers. Bits beyond a pixel's last column are of no
/// account.
#[inline]
fn covered(span: Span, left: i32) -> u64 {
    let first = |at: i32| FIRST[(at - left).clamp(0, 4).cast_unsigned() as usize];
    first(span.end) & !first(span.start)
}

/// Four times the same slot.
#[inline]
pub(crate) fn splat(slot: Slot) -> u64 {
    u64::from(slot) * 0x0001_0001_0001_0001
}

/// The four slots of a word.
#[inline]
#[expect(clippy::cast_possible_truncation, reason = "the lower sixteen bits are meant")]
pub(crate) fn lanes(word: u64) -> [Slot; PER_WORD] {
    [
        word as u16,
        (word >> 16) as u16,
        (word >> 32) as u16,
        (word >> 48) as u16,
    ]
}

/// Which of four masks name some samples but not all.
#[inline(always)]
#[expect(clippy::inline_always, reason = "vector instructions reach inlined code only")]
fn in_part<S: Simd>(simd: S, masks: Quad<S>) -> pairs::QuadMask<S> {
    // None becomes one, and all zero.
    let one = Quad::splat(simd, 1);
    (masks + one).simd_gt(one)
}

/// The bits from number `start` to `end` of a word, at least one.
#[inline]
fn bits(start: usize, end: usize) -> u64 {
    u64::MAX >> (64 - (end - start)) << start
}

/// A word of four slots.
#[inline]
pub(crate) fn joined([a, b, c, d]: [Slot; PER_WORD]) -> u64 {
    u64::from(a) | u64::from(b) << 16 | u64::from(c) << 32 | u64::from(d) << 48
}

/// A word with the slots in `mask` changed; the others are unspecified.
#[inline]
fn changed(word: u64, mask: u64, change: &mut impl FnMut(Slot) -> Slot) -> u64 {
    let slots = lanes(word);
    if word == splat(slots[0]) {
        return splat(change(slots[0]));
    }
    let mut found = slots;
    for (i, slot) in found.iter_mut().enumerate() {
        if mask & FIRST[i + 1] & !FIRST[i] != 0 {
            *slot = change(*slot);
        }
    }
    joined(found)
}

/// A distance inside a tile, which is never negative.
#[inline]
fn offset(from: i32, to: i32) -> usize {
    debug_assert!(to >= from, "{to} lies at or after the tile's start {from}");
    (to - from).cast_unsigned() as usize
}
