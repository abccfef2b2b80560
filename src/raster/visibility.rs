//! Which primitive each sample of a tile shows.
//!
//! # Compressed samples
//!
//! A pixel whose samples all show the same primitive stores that once. The first edge that crosses it splits it into
//! one number per sample; a primitive that covers it wholly makes it one again. So flat areas cost one store per pixel
//! at every sample rate, and nothing is shaded before it is known to be seen.

use std::ops::Range;

use super::pixel_row::PixelRow;
use super::rows::Span;
use super::tile::PixelRect;

/// A primitive's number inside a tile.
pub(crate) type Slot = u16;

/// Stands for a pixel that is split.
const SPLIT: Slot = Slot::MAX;

/// Most slots of a tile.
pub(crate) const MAX_SLOTS: usize = SPLIT as usize;

/// Samples of a sample row in one word.
const PER_WORD: usize = 4;

/// The bits of the first `i` samples of a word.
const FIRST: [u64; PER_WORD + 1] = [0, 0xFFFF, 0xFFFF_FFFF, 0xFFFF_FFFF_FFFF, u64::MAX];

/// The slots of a rectangle of pixels.
#[derive(Debug)]
pub(crate) struct VisibilityTile {
    pub(crate) rect: PixelRect,
    width: usize,
    /// Samples along one side of a pixel.
    side: usize,
    /// Words that one sample row of a pixel takes: four samples each, the last one perhaps with some to spare.
    words: usize,
    /// How many samples each of these words holds.
    used: Vec<u32>,
    /// One slot per pixel, or [`SPLIT`].
    whole: Vec<Slot>,
    /// The slots of split pixels, pixel by pixel. Allocated with the first split.
    samples: Vec<u64>,
}

/// Pixels side by side in a row that show the same.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Run {
    /// All samples of these pixels show one slot.
    Whole(Slot),
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
            side,
            words: side.div_ceil(PER_WORD),
            used: (0..side)
                .step_by(PER_WORD)
                .map(|at| u32::try_from((side - at).min(PER_WORD)).unwrap_or(0))
                .collect(),
            whole: Vec::new(),
            samples: Vec::new(),
        }
    }

    /// Makes it the tile of `rect` in which every sample shows `slot`.
    pub(crate) fn reset(&mut self, rect: PixelRect, slot: Slot) {
        let length = |span: Span| usize::try_from(span.end - span.start).unwrap_or(0);
        self.rect = rect;
        self.width = length(rect.x);
        self.whole.clear();
        self.whole.resize(self.width * length(rect.y), slot);
    }

    /// Lets every sample show `slot`.
    pub(crate) fn cover(&mut self, slot: Slot) {
        self.whole.fill(slot);
    }

    /// Lets the samples that a row of pixels covers show `slot`.
    #[inline]
    pub(crate) fn paint(&mut self, row: &PixelRow, slot: Slot) {
        let left = self.rect.x.start;
        let line = offset(self.rect.y.start, row.y) * self.width;
        if !row.full.is_empty() {
            self.whole[line + offset(left, row.full.start)..line + offset(left, row.full.end)].fill(slot);
        }
        for x in row.partial() {
            self.paint_part(line + offset(left, x), x, row.spans(), slot);
        }
    }

    /// Lets the samples of one pixel that `spans` cover show `slot`; `x` is the pixel's column in the frame.
    #[inline]
    fn paint_part(&mut self, pixel: usize, x: i32, spans: &[Span], slot: Slot) {
        let shown = self.whole[pixel];
        if shown == slot {
            return;
        }
        let painted = splat(slot);
        if self.words > 1 {
            if shown != SPLIT {
                self.split(pixel, shown);
            }
            self.each_covered_word(pixel, x, spans, |word, mask| *word = *word & !mask | painted & mask);
            return;
        }
        if shown != SPLIT {
            self.make_room();
            self.whole[pixel] = SPLIT;
        }
        let samples = &mut self.samples[pixel * self.side..][..self.side];
        let left = x * i32::try_from(self.side).unwrap_or(1);
        if shown == SPLIT {
            for (word, span) in samples.iter_mut().zip(spans) {
                let mask = covered(*span, left);
                *word = *word & !mask | painted & mask;
            }
        } else {
            let below = splat(shown);
            for (word, span) in samples.iter_mut().zip(spans) {
                let mask = covered(*span, left);
                *word = below & !mask | painted & mask;
            }
        }
    }

    /// Lets the samples that a row of pixels covers show what `change` makes of what they show.
    pub(crate) fn change(&mut self, row: &PixelRow, mut change: impl FnMut(Slot) -> Slot) {
        let left = self.rect.x.start;
        let line = offset(self.rect.y.start, row.y) * self.width;
        self.change_whole(
            line + offset(left, row.full.start.min(row.full.end))..line + offset(left, row.full.end),
            &mut change,
        );
        for x in row.partial() {
            let pixel = line + offset(left, x);
            let shown = self.whole[pixel];
            if shown != SPLIT {
                self.split(pixel, shown);
            }
            self.each_covered_word(pixel, x, row.spans(), |word, mask| {
                if mask != 0 {
                    *word = *word & !mask | changed(*word, mask, &mut change) & mask;
                }
            });
        }
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
        let line = offset(self.rect.y.start, y) * self.width;
        let left = self.rect.x.start;
        line + offset(left, xs.start)..line + offset(left, xs.end)
    }

    fn change_whole(&mut self, pixels: Range<usize>, change: &mut impl FnMut(Slot) -> Slot) {
        let per_pixel = self.side * self.words;
        let mut start = pixels.start;
        while start < pixels.end {
            let shown = self.whole[start];
            let end = start + run_length(&self.whole[start..pixels.end], shown);
            if shown == SPLIT {
                for word in &mut self.samples[start * per_pixel..end * per_pixel] {
                    *word = changed(*word, u64::MAX, change);
                }
            } else {
                self.whole[start..end].fill(change(shown));
            }
            start = end;
        }
    }

    /// Lets each sample show what `mix` makes of its slot here and in a `layer` of the same rectangle.
    pub(crate) fn composite(&mut self, layer: &Self, mut mix: impl FnMut(Slot, Slot) -> Slot) {
        let per_pixel = self.side * self.words;
        for pixel in 0..self.whole.len() {
            let (below, above) = (self.whole[pixel], layer.whole[pixel]);
            if below != SPLIT && above != SPLIT {
                self.whole[pixel] = mix(below, above);
                continue;
            }
            if below != SPLIT {
                self.split(pixel, below);
            }
            for word in pixel * per_pixel..(pixel + 1) * per_pixel {
                let above = if above == SPLIT {
                    layer.samples[word]
                } else {
                    splat(above)
                };
                let (below, above) = (lanes(self.samples[word]), lanes(above));
                let mixed = [0, 1, 2, 3].map(|i| mix(below[i], above[i]));
                self.samples[word] = joined(mixed);
            }
        }
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

    /// Gives a pixel one slot per sample.
    #[inline]
    fn split(&mut self, pixel: usize, shown: Slot) {
        self.make_room();
        let per_pixel = self.side * self.words;
        self.whole[pixel] = SPLIT;
        self.samples[pixel * per_pixel..][..per_pixel].fill(splat(shown));
    }

    /// Makes sure that there is room for the samples of all pixels.
    #[inline]
    fn make_room(&mut self) {
        let count = self.whole.len() * self.side * self.words;
        if self.samples.len() < count {
            self.samples.resize(count, 0);
        }
    }

    /// The runs of row `y` from left to right, each with its range of pixels counted from the tile's left side.
    #[inline]
    pub(crate) fn runs(&self, y: i32) -> impl Iterator<Item = (Run, Range<usize>)> + '_ {
        let line = &self.whole[offset(self.rect.y.start, y) * self.width..][..self.width];
        let mut start = 0;
        std::iter::from_fn(move || {
            let slot = *line.get(start)?;
            let end = start + run_length(&line[start..], slot);
            let range = start..end;
            start = end;
            let run = if slot == SPLIT { Run::Split } else { Run::Whole(slot) };
            Some((run, range))
        })
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
        let pixel = offset(self.rect.y.start, y) * self.width + x;
        &self.samples[pixel * self.side * self.words..][..self.side * self.words]
    }

    /// Renumbers all slots in use: `renumber` is called once for each, in no particular order.
    pub(crate) fn renumber(&mut self, renumber: impl Fn(Slot) -> Slot) {
        let per_pixel = self.side * self.words;
        for (pixel, slot) in self.whole.iter_mut().enumerate() {
            if *slot != SPLIT {
                *slot = renumber(*slot);
                continue;
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
            if *slot == SPLIT {
                for word in &self.samples[pixel * per_pixel..][..per_pixel] {
                    lanes(*word).into_iter().for_each(&mut seen);
                }
            } else {
                seen(*slot);
            }
        }
    }
}

/// How many slots at the beginning of `line` are `slot`.
#[inline]
fn run_length(line: &[Slot], slot: Slot) -> usize {
    const BLOCK: usize = 8;
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

/// A word of four slots.
#[inline]
fn joined([a, b, c, d]: [Slot; PER_WORD]) -> u64 {
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
