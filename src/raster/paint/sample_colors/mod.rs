//! A tile: the samples of a small rectangle of pixels, small enough to stay in a core's cache.
//!
//! # Compressed samples
//!
//! A pixel whose samples all hold the same colour stores that colour once. The first edge that crosses it splits it
//! into one colour per sample; an opaque primitive that covers it wholly makes it one colour again. So flat areas cost
//! one store per pixel at every sample rate, and memory is touched only where samples differ.

mod area;
mod composite;
mod resolve;

use std::ops::Range;

use crate::color::{Premultiplied16, ResolveSpace, Resolver};
use crate::raster::SampleRate;
use crate::raster::sampling::mask::SampleMask;
use crate::raster::shading::context::PixelRun;
use crate::raster::span::{Span, SpanRect};
use crate::rules::Rules;

/// What a pixel holds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::raster) enum PixelColors<'s> {
    /// One colour in all its samples.
    Whole(Premultiplied16),
    /// A colour for each.
    Split(&'s [Premultiplied16]),
}

/// Colours of samples that were shaded together.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ShadedColors<'c> {
    pub(crate) colors: &'c [Premultiplied16],
    /// Whether all of them are opaque for certain.
    pub(crate) opaque: bool,
}

/// The samples of a rectangle of pixels.
#[derive(Debug)]
pub(crate) struct SampleColors {
    pub(crate) rect: SpanRect,
    /// Pixels outside of it are as they were at the start.
    painted: SpanRect,
    width: usize,
    /// Samples per pixel.
    per_pixel: usize,
    rules: Rules,
    /// For means of stored values.
    resolver: Resolver,
    space: ResolveSpace,
    /// One colour per pixel; valid where the pixel is not split.
    whole: Vec<Premultiplied16>,
    split: Vec<bool>,
    /// Whether every sample is opaque: so it stays once the tile starts on an opaque background.
    opaque: bool,
    /// All samples of a pixel side by side, valid where the pixel is split. Allocated with the first split.
    samples: Vec<Premultiplied16>,
}

impl SampleColors {
    /// A tile of no pixels.
    pub(crate) fn new(rate: SampleRate, rules: Rules, space: ResolveSpace) -> Self {
        Self {
            rect: SpanRect::EMPTY,
            painted: SpanRect::EMPTY,
            width: 0,
            per_pixel: rate.samples() as usize,
            rules,
            resolver: Resolver::new(rate.samples(), rules),
            space,
            whole: Vec::new(),
            split: Vec::new(),
            opaque: false,
            samples: Vec::new(),
        }
    }

    /// Makes it the tile of `rect` with every sample in `color`.
    // Inlined where the colour is known it fills by `rep stosb`, which is slow to start and dear where instructions are counted.
    #[inline(never)]
    pub(crate) fn reset(&mut self, rect: SpanRect, color: Premultiplied16) {
        self.rect = rect;
        self.painted = if color == Premultiplied16::TRANSPARENT {
            SpanRect::EMPTY
        } else {
            rect
        };
        self.opaque = color.is_opaque();
        self.width = rect.x.length();
        let pixels = self.width * rect.y.length();
        self.whole.clear();
        self.whole.resize(pixels, color);
        self.split.clear();
        self.split.resize(pixels, false);
    }

    /// Makes it the tile of `rect`, whose pixels show anything until they are replaced: see [`SampleColors::row_to_put`].
    pub(in crate::raster) fn reset_to_put(&mut self, rect: SpanRect) {
        self.rect = rect;
        self.painted = SpanRect::EMPTY;
        self.opaque = false;
        self.width = rect.x.length();
        let pixels = self.width * rect.y.length();
        self.whole.resize(pixels, Premultiplied16::TRANSPARENT);
        self.split.resize(pixels, false);
    }

    /// Row `y` of the frame, to be replaced: the colours of pixels that show one, which pixels show several, and the samples of all.
    pub(in crate::raster) fn row_to_put(
        &mut self,
        y: i32,
    ) -> (&mut [Premultiplied16], &mut [bool], &mut [Premultiplied16]) {
        self.ensure_samples();
        let first = self.index(self.rect.x.start, y);
        let pixels = first..first + self.width;
        let samples = pixels.start * self.per_pixel..pixels.end * self.per_pixel;
        (
            &mut self.whole[pixels.clone()],
            &mut self.split[pixels],
            &mut self.samples[samples],
        )
    }

    /// Lets all samples of a run of pixels be replaced, whose columns and row are counted from the tile's first pixel: opaque colours, a
    /// pixel's side by side.
    pub(in crate::raster) fn put_samples(&mut self, run: PixelRun, put: impl FnOnce(&mut [Premultiplied16])) {
        let row = usize::from(run.row) * self.width;
        let pixels = row + usize::from(run.start)..row + usize::from(run.end);
        if self.per_pixel == 1 {
            put(&mut self.whole[pixels]);
            return;
        }
        put(self.split_pixels(pixels.clone(), true));
        if self.space == ResolveSpace::Stored {
            self.join(pixels);
        }
    }

    /// The samples of a pixel that is split, by its column and row from the tile's first pixel.
    pub(in crate::raster) fn split_samples(&mut self, [x, y]: [u16; 2]) -> &mut [Premultiplied16] {
        let pixel = usize::from(y) * self.width + usize::from(x);
        debug_assert!(self.split[pixel], "each sample has its colour");
        &mut self.samples[pixel * self.per_pixel..][..self.per_pixel]
    }

    /// Index of the pixel in column `x` of row `y` of the frame, which must lie in the tile.
    #[inline]
    fn index(&self, x: i32, y: i32) -> usize {
        debug_assert!(
            (self.rect.x.start..self.rect.x.end).contains(&x),
            "column {x} lies in {:?}",
            self.rect
        );
        debug_assert!(
            (self.rect.y.start..self.rect.y.end).contains(&y),
            "row {y} lies in {:?}",
            self.rect
        );
        offset(y - self.rect.y.start) * self.width + offset(x - self.rect.x.start)
    }

    /// Notes that pixels of this rectangle are painted.
    pub(crate) fn note_painted(&mut self, pixels: SpanRect) {
        self.painted = self.painted.union(pixels);
    }

    /// Paints all samples of the pixels `xs` of row `y` with one colour.
    #[inline]
    pub(crate) fn fill(&mut self, xs: Span, y: i32, color: Premultiplied16) {
        if xs.is_empty() {
            return;
        }
        let first = self.index(xs.start, y);
        let last = first + offset(xs.end - xs.start);
        if color.is_opaque() {
            self.whole[first..last].fill(color);
            self.split[first..last].fill(false);
            return;
        }
        if !self.split[first..last].contains(&true) {
            color.over_all(&mut self.whole[first..last], self.rules);
            return;
        }
        for pixel in first..last {
            let colors = if self.split[pixel] {
                &mut self.samples[pixel * self.per_pixel..][..self.per_pixel]
            } else {
                &mut self.whole[pixel..=pixel]
            };
            color.over_all(colors, self.rules);
        }
    }

    /// Paints each of the pixels `xs` of row `y` with its own colour.
    pub(crate) fn fill_each(&mut self, xs: Span, y: i32, shaded: ShadedColors<'_>) {
        if shaded.opaque && !xs.is_empty() {
            let first = self.index(xs.start, y);
            let last = first + offset(xs.end - xs.start);
            self.whole[first..last].copy_from_slice(shaded.colors);
            self.split[first..last].fill(false);
            return;
        }
        for (start, color) in (xs.start..xs.end).zip(shaded.colors) {
            self.fill(Span { start, end: start + 1 }, y, *color);
        }
    }

    /// Paints all samples of the pixels `xs` of row `y` with a colour each, pixel by pixel.
    #[inline]
    pub(crate) fn write(&mut self, xs: Span, y: i32, shaded: ShadedColors<'_>) {
        let (first, rules) = (self.index(xs.start, y), self.rules);
        let last = first + offset(xs.end - xs.start);
        if self.per_pixel == 1 {
            paint(&mut self.whole[first..last], shaded, rules);
        } else {
            paint(self.split_pixels(first..last, shaded.opaque), shaded, rules);
            if shaded.opaque && self.space == ResolveSpace::Stored {
                self.join(first..last);
            }
        }
    }

    /// Gives split pixels one colour again where all their samples show the same, as inside a magnified texel.
    fn join(&mut self, pixels: Range<usize>) {
        let samples = &self.samples[pixels.start * self.per_pixel..pixels.end * self.per_pixel];
        let pixels = self.whole[pixels.clone()].iter_mut().zip(&mut self.split[pixels]);
        for ((whole, split), samples) in pixels.zip(samples.chunks_exact(self.per_pixel)) {
            // Most of those that differ do so at the ends.
            if let [first, .., last] = samples
                && first == last
                && samples.iter().all(|sample| sample == first)
            {
                (*whole, *split) = (*first, false);
            }
        }
    }

    /// Paints all samples of each of the pixels `xs` of row `y` with the same colours.
    pub(crate) fn repeat(&mut self, xs: Span, y: i32, shaded: ShadedColors<'_>) {
        let (first, rules) = (self.index(xs.start, y), self.rules);
        let last = first + offset(xs.end - xs.start);
        let samples = if self.per_pixel == 1 {
            &mut self.whole[first..last]
        } else {
            self.split_pixels(first..last, shaded.opaque)
        };
        for samples in samples.chunks_exact_mut(shaded.colors.len().max(1)) {
            paint(samples, shaded, rules);
        }
    }

    /// The samples of pixels, which are split; undefined where all of them are about to be `replaced`.
    fn split_pixels(&mut self, pixels: Range<usize>, replaced: bool) -> &mut [Premultiplied16] {
        if replaced {
            self.ensure_samples();
            self.split[pixels.clone()].fill(true);
        } else {
            pixels.clone().for_each(|pixel| self.ensure_split(pixel));
        }
        &mut self.samples[pixels.start * self.per_pixel..pixels.end * self.per_pixel]
    }

    /// Paints some samples of pixel `x` in row `y` with one colour.
    #[inline]
    pub(crate) fn fill_mask(&mut self, x: i32, y: i32, mask: SampleMask, color: Premultiplied16) {
        let rules = self.rules;
        let samples = self.samples_of(x, y);
        if color.is_opaque() {
            mask.each_run(|run| samples[run].fill(color));
        } else {
            mask.each_run(|run| color.over_all(&mut samples[run], rules));
        }
    }

    /// Paints some samples of pixel `x` in row `y` with a colour each.
    #[inline]
    pub(crate) fn write_mask(&mut self, x: i32, y: i32, mask: SampleMask, shaded: ShadedColors<'_>) {
        let rules = self.rules;
        let samples = self.samples_of(x, y);
        let mut rest = shaded.colors;
        mask.each_run(|run| {
            let (colors, others) = rest.split_at(run.len());
            paint(&mut samples[run], ShadedColors { colors, ..shaded }, rules);
            rest = others;
        });
    }

    /// All samples of a pixel, which is split unless it has just one.
    #[inline]
    fn samples_of(&mut self, x: i32, y: i32) -> &mut [Premultiplied16] {
        let pixel = self.index(x, y);
        if self.per_pixel == 1 {
            return &mut self.whole[pixel..=pixel];
        }
        self.ensure_split(pixel);
        &mut self.samples[pixel * self.per_pixel..][..self.per_pixel]
    }

    /// Makes room for the samples of every pixel.
    #[inline]
    fn ensure_samples(&mut self) {
        let count = self.whole.len() * self.per_pixel;
        if self.samples.len() < count {
            self.samples.resize(count, Premultiplied16::TRANSPARENT);
        }
    }

    /// Gives a pixel one colour per sample.
    #[inline]
    fn ensure_split(&mut self, pixel: usize) {
        if self.split[pixel] {
            return;
        }
        self.ensure_samples();
        self.split[pixel] = true;
        self.samples[pixel * self.per_pixel..][..self.per_pixel].fill(self.whole[pixel]);
    }

    /// The colour of one sample of a pixel.
    pub(crate) fn sample(&self, x: i32, y: i32, sample: usize) -> Premultiplied16 {
        let pixel = self.index(x, y);
        if self.split[pixel] {
            self.samples[pixel * self.per_pixel + sample]
        } else {
            self.whole[pixel]
        }
    }

    /// Samples of a pixel.
    pub(in crate::raster) fn per_pixel(&self) -> usize {
        self.per_pixel
    }

    /// Pixels in a row.
    pub(in crate::raster) fn width(&self) -> usize {
        self.width
    }

    /// A row of pixels, counted from the first: the colours of those that show one, and which show several.
    pub(in crate::raster) fn row(&self, y: usize) -> (&[Premultiplied16], &[bool]) {
        let pixels = y * self.width..(y + 1) * self.width;
        (&self.whole[pixels.clone()], &self.split[pixels])
    }

    /// The pixel with this index, counted row by row.
    #[inline]
    pub(in crate::raster) fn pixel(&self, index: usize) -> PixelColors<'_> {
        if self.split[index] {
            PixelColors::Split(&self.samples[index * self.per_pixel..][..self.per_pixel])
        } else {
            PixelColors::Whole(self.whole[index])
        }
    }
}

/// Paints colours over samples.
#[inline]
fn paint(samples: &mut [Premultiplied16], shaded: ShadedColors<'_>, rules: Rules) {
    let ShadedColors { colors, opaque } = shaded;
    if opaque {
        samples.copy_from_slice(colors);
        return;
    }
    Premultiplied16::each_over(colors, samples, rules);
}

/// A distance inside a tile, which is never negative.
#[inline]
fn offset(distance: i32) -> usize {
    debug_assert!(distance >= 0, "distance {distance} inside a tile");
    distance.cast_unsigned() as usize
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::color::BlendMode;
    use crate::raster::layers::Compositing;

    type Found<T> = arbtest::arbitrary::Result<T>;

    const COUNT: usize = 4;
    const SIDE: i32 = 6;

    fn span(u: &mut arbtest::arbitrary::Unstructured<'_>) -> Found<Span> {
        let start = u.int_in_range(0..=SIDE - 1)?;
        Ok(Span {
            start,
            end: u.int_in_range(start + 1..=SIDE)?,
        })
    }

    fn color(u: &mut arbtest::arbitrary::Unstructured<'_>) -> Found<Premultiplied16> {
        let [r, g, b, a]: [u8; 4] = u.arbitrary()?;
        let alpha = *u.choose(&[255, 255, 0, a])?;
        Ok(Premultiplied16::from_bytes([r, g, b, 255]).faded(u16::from(alpha) * Premultiplied16::PER_BYTE))
    }

    /// Paints something, and notes where.
    fn paint_any(u: &mut arbtest::arbitrary::Unstructured<'_>, tile: &mut SampleColors) -> Found<()> {
        for _ in 0..u.int_in_range(0..=4)? {
            let (x, y) = (span(u)?, span(u)?);
            let colors = (0..COUNT).map(|_| color(u)).collect::<Found<Vec<_>>>()?;
            let even = u.arbitrary()?;
            for y in y.start..y.end {
                if even {
                    tile.fill(x, y, colors[0]);
                } else {
                    tile.repeat(
                        x,
                        y,
                        ShadedColors {
                            colors: &colors,
                            opaque: false,
                        },
                    );
                }
            }
            tile.note_painted(SpanRect { x, y });
        }
        Ok(())
    }

    #[test]
    fn opaque_pixels_are_split_only_where_their_samples_differ() {
        let gray = |level: u8| Premultiplied16::from_bytes([level, level, level, 255]);
        let xs = Span { start: 1, end: 4 };
        let y = Span { start: 0, end: 1 };
        let colors: Vec<_> = [[7, 7, 7, 7], [7, 8, 8, 7], [8, 8, 8, 8]]
            .concat()
            .into_iter()
            .map(gray)
            .collect();
        for opaque in [false, true] {
            let mut tile = SampleColors::new(
                SampleRate::new(4).expect("a rate"),
                Rules::Standard,
                ResolveSpace::Stored,
            );
            tile.reset(
                SpanRect {
                    x: Span { start: 0, end: 5 },
                    y,
                },
                gray(0),
            );
            tile.write(
                xs,
                0,
                ShadedColors {
                    colors: &colors,
                    opaque,
                },
            );
            let shown = (1..4).flat_map(|x| (0..COUNT).map(move |sample| (x, sample)));
            let shown: Vec<_> = shown.map(|(x, sample)| tile.sample(x, 0, sample)).collect();
            assert_eq!(shown, colors, "each sample keeps its colour, opaque: {opaque}");
            let (_, split) = tile.row(0);
            assert_eq!(split, [false, !opaque, true, !opaque, false], "opaque: {opaque}");
        }
    }

    #[test]
    fn layers_are_composited_as_each_sample_alone() {
        let rect = SpanRect {
            x: Span { start: 0, end: SIDE },
            y: Span { start: 0, end: SIDE },
        };
        arbtest::arbtest(|u| {
            let rules = *u.choose(&[Rules::Standard, Rules::Standard, Rules::Course])?;
            let rate = SampleRate::new(4).expect("a rate");
            let mut tiles = [(); 2].map(|()| SampleColors::new(rate, rules, ResolveSpace::Stored));
            let ground = *u.choose(&[Premultiplied16::TRANSPARENT, Premultiplied16([Premultiplied16::ONE; 4])])?;
            tiles[0].reset(rect, ground);
            tiles[1].reset(rect, Premultiplied16::TRANSPARENT);
            for tile in &mut tiles {
                paint_any(u, tile)?;
            }
            let compositing = *u.choose(&[
                Compositing::with_opacity(1.0),
                Compositing::with_opacity(0.4),
                Compositing::blended(BlendMode::Multiply, 1.0),
                Compositing::blended(BlendMode::Luminosity, 0.7),
                Compositing::mask(false),
                Compositing::mask(true),
            ])?;
            let [mut below, layer] = tiles;
            let samples = |tile: &SampleColors| -> Vec<_> {
                let of_row = |y| (0..SIDE).flat_map(move |x| (0..COUNT).map(move |sample| tile.sample(x, y, sample)));
                (0..SIDE).flat_map(of_row).collect()
            };
            let (above, before) = (samples(&layer), samples(&below));
            below.composite(&layer, compositing);
            let alone = above
                .iter()
                .zip(before)
                .map(|(above, below)| compositing.composited(*above, below, rules));
            let alone: Vec<_> = alone.collect();
            assert_eq!(samples(&below), alone, "{compositing:?}, {rules:?}");
            Ok(())
        })
        .budget_ms(600);
    }
}
