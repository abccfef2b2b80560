//! Which primitive each sample of a tile shows.
//!
//! # Compressed samples
//!
//! A pixel whose samples all show the same primitive stores that once. The first edge that crosses it makes it show two:
//! two primitives, and one bit per sample that says which of them it shows. Only what a third one shares is split into a
//! number per sample. A primitive that covers a pixel wholly makes it one again. So flat areas cost one store per pixel
//! at every sample rate, most edges a few bits, and nothing is shaded before it is known to be seen.
//!
//! [`paint`] and [`change`] are the two ways to paint, by opaque and by translucent colours; [`narrow_rows`] does both
//! four pixels at a time where a pixel has 2 x 2 or 4 x 4 samples.

mod change;
mod narrow_rows;
mod paint;

use std::ops::Range;

use fearless_simd::Simd;

pub(crate) use change::Composer;

use crate::raster::paint::visibility::packed::{PER_WORD, lanes, of_two, splat};
use crate::raster::paint::visibility::row_bits::equal_to_next;
use crate::raster::paint::visibility::two_surfaces::{PixelIndex, TwoSurfacePixels, TwoSurfaceRow, TwoSurfaces};
use crate::raster::span::{Span, SpanRect};
use crate::raster::surface_id::{ROW, SPLIT, SurfaceId, TWO_SURFACES};

/// Pixels of a block.
const BLOCK: usize = 8;

/// Most samples along the side of a pixel that may show two surfaces.
const MAX_TWO_SURFACE_SIDE: usize = 8;

/// The surfaces of a rectangle of pixels.
#[derive(Debug)]
pub(crate) struct VisibilityBuffer {
    pub(crate) rect: SpanRect,
    width: usize,
    /// Samples along one side of a pixel.
    side: usize,
    /// Words that a sample row of a pixel takes: four samples each, and the last one up to four.
    words: usize,
    /// How many samples each of these words holds.
    used: Vec<u32>,
    /// The bits of all samples of a pixel; none where there are too many for two surfaces.
    all: u64,
    /// Row by row one surface per pixel, or [`TWO_SURFACES`], or [`SPLIT`]; undefined beyond the tile's right side.
    whole: Vec<[SurfaceId; ROW]>,
    /// For each row a bit for each pixel that showed two surfaces or was split once; it need not be any more.
    shared: Vec<u64>,
    /// What pixels of two surfaces show.
    two_surfaces: TwoSurfacePixels,
    /// The surfaces of split pixels, pixel by pixel. Allocated with the first split.
    samples: Vec<u64>,
}

/// A row of a tile's pixels.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Shown<'a> {
    /// What each shows; undefined beyond the tile's right side.
    pub(crate) whole: &'a [SurfaceId; ROW],
    /// The pixels that may show two surfaces or be split, a bit for each.
    pub(crate) shared: u64,
    /// The two surfaces of pixels that show two; undefined for others.
    pub(crate) two_surfaces: TwoSurfaceRow<'a>,
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
            rect: SpanRect::EMPTY,
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
            two_surfaces: TwoSurfacePixels::new(side),
            samples: Vec::new(),
        }
    }

    /// Makes it the tile of `rect` in which every sample shows `surface`.
    pub(crate) fn reset(&mut self, rect: SpanRect, surface: SurfaceId) {
        self.rect = rect;
        self.width = rect.x.length();
        debug_assert!(self.width <= ROW, "a tile is {} pixels wide", self.width);
        let rows = rect.y.length();
        self.whole.clear();
        self.whole.resize(rows, [surface; ROW]);
        self.shared.clear();
        self.shared.resize(rows, 0);
        if self.all != 0 {
            self.two_surfaces.make_room(rows);
        }
    }

    /// Makes a pixel a [`TWO_SURFACES`] or [`SPLIT`].
    #[inline(always)]
    #[expect(clippy::inline_always, reason = "a few instructions for every pixel on an edge")]
    fn share(&mut self, PixelIndex { y, x }: PixelIndex, kind: SurfaceId) {
        self.whole[y][x % ROW] = kind;
        self.shared[y] |= 1 << (x % ROW);
    }

    /// Lets a pixel show two surfaces, or the one that is left of them.
    #[inline(always)]
    #[expect(clippy::inline_always, reason = "a few instructions for every pixel on an edge")]
    fn set_two(&mut self, pixel: PixelIndex, two: TwoSurfaces) {
        if two.mask == 0 {
            self.whole[pixel.y][pixel.x] = two.first;
        } else if two.mask == self.all {
            self.whole[pixel.y][pixel.x] = two.second;
        } else {
            self.share(pixel, TWO_SURFACES);
            self.two_surfaces.set(pixel, two);
        }
    }

    /// Columns counted from the tile's left side.
    #[inline]
    fn columns(&self, xs: Span) -> Range<usize> {
        let left = self.rect.x.start;
        offset(left, xs.start)..offset(left, xs.end)
    }

    /// All pixels.
    fn places(&self) -> impl Iterator<Item = PixelIndex> + use<> {
        let width = self.width;
        (0..self.whole.len()).flat_map(move |y| (0..width).map(move |x| PixelIndex { y, x }))
    }

    /// What a pixel shows that is not split; a single surface twice, with no bit set.
    #[inline]
    fn one_or_two(&self, pixel: PixelIndex) -> Option<TwoSurfaces> {
        match self.whole[pixel.y][pixel.x] {
            SPLIT => None,
            TWO_SURFACES => Some(self.two_surfaces.get(pixel)),
            surface => Some(TwoSurfaces {
                mask: 0,
                first: surface,
                second: surface,
            }),
        }
    }

    /// Gives a pixel one surface per sample, if it is not split yet.
    #[inline]
    fn split(&mut self, pixel: PixelIndex) {
        let Some(two) = self.one_or_two(pixel) else {
            return;
        };
        self.make_room();
        self.share(pixel, SPLIT);
        let first = self.first_packed(pixel);
        let (side, words) = (self.side, self.words);
        let surfaces = [splat(two.first), splat(two.second)];
        let samples = &mut self.samples[first..][..side * words];
        if words == 1 {
            // Without a division for the rows, which costs as much as all the rest.
            for (word, shift) in samples.iter_mut().zip((0..).step_by(side)) {
                *word = of_two(surfaces, two.mask >> (shift % 64));
            }
            return;
        }
        for (y, row) in samples.chunks_exact_mut(words).enumerate() {
            for (word, shift) in row.iter_mut().zip((y * side..).step_by(PER_WORD)) {
                *word = of_two(surfaces, two.mask >> (shift % 64));
            }
        }
    }

    /// Makes sure that there is room for the samples of all pixels.
    #[inline]
    fn make_room(&mut self) {
        let count = self.first_packed(PixelIndex {
            y: self.whole.len(),
            x: 0,
        });
        if self.samples.len() < count {
            self.samples.resize(count, 0);
        }
    }

    /// Where the samples of a split pixel begin.
    #[inline]
    fn first_packed(&self, PixelIndex { y, x }: PixelIndex) -> usize {
        (y * self.width + x) * self.side * self.words
    }

    /// What each pixel of row `y` shows.
    #[inline]
    pub(crate) fn row(&self, y: i32) -> &[SurfaceId] {
        &self.whole[offset(self.rect.y.start, y)][..self.width]
    }

    /// The last pixels of the runs of each row, a bit for each; the last one of a row may have none.
    #[inline(always)]
    #[expect(clippy::inline_always, reason = "vector instructions reach inlined code only")]
    pub(crate) fn run_ends<S: Simd>(&self, simd: S, ends: &mut Vec<u64>) {
        ends.clear();
        // No adapter, which compilers may leave a function of its own, without vector instructions.
        for row in &self.whole {
            ends.push(!equal_to_next(simd, row) & u64::MAX >> 1);
        }
    }

    /// The runs of row `y` from left to right, each with its range of pixels counted from the tile's left side; `ends` as
    /// [`VisibilityBuffer::run_ends`] has them.
    #[inline]
    pub(crate) fn runs(&self, y: i32, ends: u64) -> impl Iterator<Item = (Run, Range<usize>)> + '_ {
        let line = self.row(y);
        let mut start = 0;
        std::iter::from_fn(move || {
            let surface = *line.get(start)?;
            let length = (ends >> (start % ROW)).trailing_zeros() as usize + 1;
            let range = start..line.len().min(start + length);
            start = range.end;
            let run = match surface {
                SPLIT => Run::Split,
                TWO_SURFACES => Run::TwoSurfacePixels,
                surface => Run::Whole(surface),
            };
            Some((run, range))
        })
    }

    /// As [`VisibilityBuffer::runs`], whose ends are found first.
    #[cfg(test)]
    fn found_runs(&self, y: i32) -> impl Iterator<Item = (Run, Range<usize>)> + '_ {
        let mut ends = Vec::new();
        fearless_simd::dispatch!(crate::simd::level(), simd => self.run_ends(simd, &mut ends));
        self.runs(y, ends[offset(self.rect.y.start, y)])
    }

    /// The pixels of row `y`.
    #[inline(always)]
    #[expect(clippy::inline_always, reason = "vector instructions reach inlined code only")]
    pub(crate) fn shown(&self, y: i32) -> Shown<'_> {
        let y = offset(self.rect.y.start, y);
        Shown {
            whole: &self.whole[y],
            shared: self.shared[y],
            two_surfaces: self.two_surfaces.row(y),
        }
    }

    /// The two surfaces of those pixels of row `y` that show two; undefined for others.
    #[inline]
    pub(crate) fn two_surfaces(&self, y: i32) -> TwoSurfaceRow<'_> {
        self.two_surfaces.row(offset(self.rect.y.start, y))
    }

    /// The bits of all samples of a pixel that may show two surfaces.
    pub(crate) fn all(&self) -> u64 {
        self.all
    }

    /// The surfaces of a split pixel's samples, row by row; `x` counts from the tile's left side.
    #[inline]
    pub(crate) fn samples(&self, x: usize, y: i32) -> impl Iterator<Item = SurfaceId> + Clone + '_ {
        self.words(x, y)
            .chunks_exact(self.words)
            .flat_map(|row| row.iter().flat_map(|word| lanes(*word)).take(self.side))
    }

    /// The same, a word for each row, where that is enough.
    #[inline]
    pub(crate) fn word_rows(&self, x: usize, y: i32) -> Option<&[u64]> {
        (self.words == 1).then(|| self.words(x, y))
    }

    /// The same four to a word, row by row; the last word of a row may hold fewer.
    #[inline]
    pub(crate) fn rows_of_words(&self, x: usize, y: i32) -> impl Iterator<Item = &[u64]> {
        self.words(x, y).chunks_exact(self.words)
    }

    /// Samples along the side of a pixel.
    pub(crate) fn side(&self) -> usize {
        self.side
    }

    /// Calls `visit` with the samples of a split pixel, four in a word, each with how many of them count.
    #[inline]
    pub(crate) fn each_packed(&self, x: usize, y: i32, mut visit: impl FnMut(u64, u32)) {
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
    pub(crate) fn full_packed(&self, x: usize, y: i32) -> Option<&[u64]> {
        self.side.is_multiple_of(PER_WORD).then(|| self.words(x, y))
    }

    #[inline]
    fn words(&self, x: usize, y: i32) -> &[u64] {
        let first = self.first_packed(PixelIndex {
            y: offset(self.rect.y.start, y),
            x,
        });
        &self.samples[first..][..self.side * self.words]
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

/// A distance inside a tile, which is never negative.
#[inline]
fn offset(from: i32, to: i32) -> usize {
    debug_assert!(to >= from, "{to} lies at or after the tile's start {from}");
    (to - from).cast_unsigned() as usize
}

#[cfg(test)]
mod tests {
    use std::cell::Cell;

    use arbtest::arbitrary::{Result, Unstructured};

    use super::*;
    use crate::raster::coverage::covered::Covered;
    use crate::raster::coverage::mask8x8::CoverageMask;
    use crate::raster::coverage::pixel_rows::each_covered;
    use crate::raster::coverage::span_rows::MaskRows;
    use crate::raster::random::check_until;
    use crate::raster::span::scaled;

    const RECT: SpanRect = SpanRect {
        x: Span { start: 3, end: 14 },
        y: Span { start: 5, end: 12 },
    };

    /// A way to composite that keeps what is below some surfaces.
    struct Sums;

    impl Composer for Sums {
        fn keeps_below(&self, above: SurfaceId) -> bool {
            above.is_multiple_of(3)
        }

        fn composited(&mut self, below: SurfaceId, above: SurfaceId) -> SurfaceId {
            if self.keeps_below(above) {
                below
            } else {
                (below * 3 + above * 7) % 1000
            }
        }
    }

    /// What each sample shows, one by one: pixels row by row, and in each its samples row by row.
    #[derive(Clone, Debug, PartialEq)]
    struct Plain(Vec<Vec<SurfaceId>>);

    impl Plain {
        fn of(tile: &VisibilityBuffer) -> Self {
            let mut pixels = Vec::new();
            for y in RECT.y.start..RECT.y.end {
                for (run, xs) in tile.found_runs(y) {
                    for x in xs {
                        let count = tile.side * tile.side;
                        pixels.push(match run {
                            Run::Whole(surface) => vec![surface; count],
                            Run::Split => tile.samples(x, y).collect(),
                            Run::TwoSurfacePixels => {
                                let two = tile.two_surfaces(y).get(x);
                                let second = |i: usize| two.mask >> i & 1 == 1;
                                let shown = |i| if second(i) { two.second } else { two.first };
                                (0..count).map(shown).collect()
                            }
                        });
                    }
                }
            }
            Self(pixels)
        }

        /// Changes the samples for whose column and row in the frame `is_meant` says yes.
        fn change(&mut self, side: i32, is_meant: impl Fn(i32, i32) -> bool, change: impl Fn(SurfaceId) -> SurfaceId) {
            let width = RECT.x.end - RECT.x.start;
            for (pixel, samples) in (0..).zip(&mut self.0) {
                let [x, y] = [RECT.x.start + pixel % width, RECT.y.start + pixel / width];
                for (i, shown) in (0..).zip(samples) {
                    if is_meant(x * side + i % side, y * side + i / side) {
                        *shown = change(*shown);
                    }
                }
            }
        }
    }

    /// A few samples whose rows each are one run, as triangles cover them.
    fn few_samples(u: &mut Unstructured<'_>, side: i32) -> Result<CoverageMask> {
        let mut within = |span: Span, shape: i32| u.int_in_range(span.start * side..=span.end * side - shape);
        let (column, row) = (within(RECT.x, 1)?, within(RECT.y, 1)?);
        let (mut mask, rows) = (0, u.int_in_range(1..=8)?);
        for row in 0..rows {
            let start = u.int_in_range(0..=7)?;
            let length = u.int_in_range(1..=8 - start)?;
            mask |= ((1_u64 << length) - 1) << start << (8 * row);
        }
        Ok(CoverageMask { column, row, mask })
    }

    fn holds(coverage: CoverageMask, column: i32, row: i32) -> bool {
        let (i, j) = (column - coverage.column, row - coverage.row);
        (0..8).contains(&i) && (0..8).contains(&j) && coverage.mask >> (8 * j + i) & 1 == 1
    }

    /// Paints the same on both.
    fn step(u: &mut Unstructured<'_>, (tile, plain): (&mut VisibilityBuffer, &mut Plain), side: i32) -> Result<()> {
        let surface = u.int_in_range(0..=3)?;
        let other = |shown: SurfaceId| (shown * 5 + 3) % 11;
        let xs = Span {
            start: u.int_in_range(RECT.x.start..=RECT.x.end - 1)?,
            end: RECT.x.end,
        };
        let y = u.int_in_range(RECT.y.start..=RECT.y.end - 1)?;
        let in_run = |column: i32, row: i32| row / side == y && xs.start <= column / side;
        match u.int_in_range(0..=9)? {
            0 => {
                tile.cover(surface);
                plain.change(side, |_, _| true, |_| surface);
            }
            1 => {
                tile.paint(y, Covered::Whole(xs), surface);
                plain.change(side, in_run, |_| surface);
            }
            2 => {
                tile.change(y, Covered::Whole(xs), other);
                plain.change(side, in_run, other);
            }
            3 => {
                for y in RECT.y.start..RECT.y.end {
                    tile.change(y, Covered::Whole(RECT.x), other);
                }
                plain.change(side, |_, _| true, other);
            }
            4 => {
                tile.renumber(|shown| shown + 1);
                plain.change(side, |_, _| true, |shown| shown + 1);
            }
            kind => {
                let coverage = few_samples(u, side)?;
                let covered = |column, row| holds(coverage, column, row);
                let mut rows = MaskRows::new(coverage.within(scaled(RECT.x, side), scaled(RECT.y, side)));
                if kind < 8 {
                    each_covered(&mut rows, side, RECT.x, |y, covered| tile.paint(y, covered, surface));
                    plain.change(side, covered, |_| surface);
                } else {
                    each_covered(&mut rows, side, RECT.x, |y, covered| tile.change(y, covered, other));
                    plain.change(side, covered, other);
                }
            }
        }
        Ok(())
    }

    #[test]
    fn compressed_samples_show_what_plain_ones_would() {
        let (split, shared) = (Cell::new(0), Cell::new(0));
        check_until(
            1000,
            || split.get() > 0 && shared.get() > 0,
            |u| {
                let side = *u.choose(&[1, 2, 3, 4, 5, 7, 8, 9, 12])?;
                let new = || {
                    let mut tile = VisibilityBuffer::new(side);
                    tile.reset(RECT, 0);
                    let plain = Plain::of(&tile);
                    (tile, plain)
                };
                let ((mut tile, mut plain), (mut layer, mut plain_layer)) = (new(), new());
                for _ in 0..u.int_in_range(1..=20)? {
                    step(u, (&mut tile, &mut plain), side)?;
                    assert_eq!(Plain::of(&tile), plain, "{side} x {side} samples");
                    step(u, (&mut layer, &mut plain_layer), side)?;
                }
                let used = |surface| plain.0.iter().flatten().any(|shown| *shown == surface);
                let mut seen = vec![false; 4096];
                tile.each_surface(|surface| seen[usize::from(surface)] = true);
                let missed = (0..4096).find(|surface| used(*surface) && !seen[usize::from(*surface)]);
                assert_eq!(missed, None, "every surface in use is seen");
                for y in RECT.y.start..RECT.y.end {
                    let runs = || tile.found_runs(y).map(|(run, _)| run);
                    split.set(split.get() + runs().filter(|run| *run == Run::Split).count());
                    shared.set(shared.get() + runs().filter(|run| *run == Run::TwoSurfacePixels).count());
                }
                tile.composite(&layer, &mut Sums);
                for (below, above) in plain.0.iter_mut().flatten().zip(plain_layer.0.iter().flatten()) {
                    *below = Sums.composited(*below, *above);
                }
                assert_eq!(Plain::of(&tile), plain, "a layer over {side} x {side} samples");
                Ok(())
            },
        );
        let (split, shared) = (split.get(), shared.get());
        assert!(split > 0 && shared > 0, "{split} split and {shared} shared runs");
    }
}
