//! A tile: the samples of a small rectangle of pixels, small enough to stay in a core's cache.
//!
//! # Compressed samples
//!
//! A pixel whose samples all hold the same colour stores that colour once. The first edge that crosses it splits it
//! into one colour per sample; an opaque primitive that covers it wholly makes it one colour again. So flat areas cost
//! one store per pixel at every sample rate, and memory is touched only where samples differ.

use std::ops::Range;

use fearless_simd::{Simd, dispatch};

use crate::color::{LightResolver, Premultiplied16, ResolveSpace, Resolver};
use crate::raster::SampleRate;
use crate::raster::coverage::area::row::{Area, CoveredArea};
use crate::raster::layers::Compositing;
use crate::raster::sampling::mask::SampleMask;
use crate::raster::span::{Span, SpanRect};
use crate::rules::Rules;
use crate::simd;

/// Samples of one pixel with which one colour is composited together.
const ALIKE: usize = 16;

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

    /// Paints a part of some pixels of row `y`, which have one colour each, with one colour: each is the mean of what it showed
    /// and of what it shows where it is covered.
    #[inline]
    pub(crate) fn fill_area(&mut self, y: i32, covered: CoveredArea, color: Premultiplied16) {
        let CoveredArea { xs, area } = covered;
        if xs.is_empty() {
            return;
        }
        let first = self.index(xs.start, y);
        let pixels = &mut self.whole[first..first + xs.length()];
        if area == Area::WHOLE {
            if color.is_opaque() {
                pixels.fill(color);
            } else {
                color.over_all(pixels, self.rules);
            }
            return;
        }
        // Bytes are stored after every write: else what is painted with nothing later would truncate them, tile by tile.
        let truncates = self.rules == Rules::Course;
        for below in pixels {
            let above = if color.is_opaque() && !truncates {
                color
            } else {
                color.over(*below, self.rules)
            };
            let mixed = self.space.mix(*below, above, area.parts());
            *below = if truncates { mixed.truncated() } else { mixed };
        }
    }

    /// As [`SampleColors::fill_area`], with a colour for each of the pixels.
    pub(crate) fn fill_area_each(&mut self, y: i32, covered: CoveredArea, shaded: ShadedColors<'_>) {
        let CoveredArea { xs, area } = covered;
        if area == Area::WHOLE {
            return self.fill_each(xs, y, shaded);
        }
        for (start, color) in (xs.start..xs.end).zip(shaded.colors) {
            let xs = Span { start, end: start + 1 };
            self.fill_area(y, CoveredArea { xs, area }, *color);
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

    /// Composites another tile of the same rectangle with this one.
    pub(crate) fn composite(&mut self, layer: &Self, compositing: Compositing) {
        self.opaque &= compositing.keeps_below();
        let changed = if self.rules == Rules::Course {
            // Painting nothing truncates, too.
            self.rect
        } else if compositing.keeps_below() {
            layer.painted
        } else {
            // What is transparent stays so.
            self.painted
        };
        if changed.is_empty() {
            return;
        }
        self.note_painted(changed);
        for y in changed.y.start..changed.y.end {
            let first = self.index(changed.x.start, y);
            self.composite_pixels(first..first + changed.x.length(), layer, compositing);
        }
    }

    /// The same for some pixels side by side.
    fn composite_pixels(&mut self, pixels: Range<usize>, layer: &Self, compositing: Compositing) {
        let mut first = pixels.start;
        while first < pixels.end {
            // Pixels that are alike, so that their samples lie side by side.
            let kind = |pixel: usize| (layer.split[pixel], self.split[pixel]);
            let last = (first + 1..pixels.end)
                .find(|pixel| kind(*pixel) != kind(first))
                .unwrap_or(pixels.end);
            let whole = &layer.whole[first..last];
            match kind(first) {
                (true, true) => {
                    let samples = first * self.per_pixel..last * self.per_pixel;
                    compositing.composite(&layer.samples[samples.clone()], &mut self.samples[samples], self.rules);
                }
                (true, false) => self.composite_over_whole(first..last, layer, compositing),
                _ if whole.iter().all(|color| compositing.keeps_under(*color)) => {
                    // Nothing changes.
                }
                (false, true) => self.composite_whole(first..last, layer, compositing),
                (false, false) => compositing.composite(whole, &mut self.whole[first..last], self.rules),
            }
            first = last;
        }
    }

    /// The same for pixels that are not split, below pixels of the layer that are.
    fn composite_over_whole(&mut self, pixels: Range<usize>, layer: &Self, compositing: Compositing) {
        self.ensure_samples();
        let first = pixels.start;
        for pixel in pixels {
            self.split[pixel] = true;
            let start = pixel * self.per_pixel;
            let (before, samples) = self.samples.split_at_mut(start);
            let below = &mut samples[..self.per_pixel];
            let above = &layer.samples[start..start + self.per_pixel];
            let color = self.whole[pixel];
            if compositing.is_copied(above, color, self.rules) {
                below.copy_from_slice(above);
                continue;
            }
            // Along a level gradient pixels are as the ones before them.
            let last = start - self.per_pixel.min(start);
            if pixel > first && color == self.whole[pixel - 1] && *above == layer.samples[last..start] {
                below.copy_from_slice(&before[last..]);
                continue;
            }
            below.fill(color);
            compositing.composite(above, below, self.rules);
        }
    }

    /// The same for pixels that are split, below pixels of the layer that are not.
    fn composite_whole(&mut self, pixels: Range<usize>, layer: &Self, compositing: Compositing) {
        for pixel in pixels {
            let color = layer.whole[pixel];
            // The course truncates at each step: there samples go every one of them, apart, as they always did.
            if self.rules != Rules::Course && compositing.hides(compositing.fragment(color)) {
                self.split[pixel] = false;
                self.whole[pixel] = compositing.composited(color, Premultiplied16::TRANSPARENT, self.rules);
                continue;
            }
            let below = &mut self.samples[pixel * self.per_pixel..][..self.per_pixel];
            below.chunks_mut(ALIKE).for_each(|below| {
                compositing.composite(&[color; ALIKE][..below.len()], below, self.rules);
            });
        }
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

    /// Resolves row `y` of the tile into pixels `0xAARRGGBB`: each the mean of its samples.
    pub(crate) fn resolve(&self, y: i32, pixels: &mut [u32]) {
        let first = self.index(self.rect.x.start, y);
        let pixels = &mut pixels[..self.width];
        let whole = &self.whole[first..first + self.width];
        if self.opaque {
            Premultiplied16::opaque_to_pixels(whole, self.rules, pixels);
        } else {
            for (pixel, color) in pixels.iter_mut().zip(whole) {
                *pixel = color.to_pixel(self.rules);
            }
        }
        if self.samples.is_empty() {
            return;
        }
        match self.space {
            ResolveSpace::Stored => dispatch!(simd::level(), simd => self.resolve_stored(simd, first, pixels)),
            ResolveSpace::Linear => dispatch!(simd::level(), simd => self.resolve_linear(simd, first, pixels)),
        }
    }

    /// The split pixels from one on, counted from it, and their samples.
    #[inline(always)]
    #[expect(clippy::inline_always, reason = "vector instructions reach inlined code only")]
    fn split_from(&self, first: usize) -> impl Iterator<Item = (usize, &[Premultiplied16])> {
        // There may be room for the samples of some pixels only, as long as none of the others is split.
        let samples = self.samples.get(first * self.per_pixel..).unwrap_or_default();
        let samples = samples.chunks_exact(self.per_pixel);
        let all = self.split[first..].iter().zip(samples).enumerate();
        all.filter_map(|(i, (split, samples))| split.then_some((i, samples)))
    }

    /// Resolves split pixels into the mean of their samples' light.
    #[inline(always)]
    #[expect(clippy::inline_always, reason = "vector instructions reach inlined code only")]
    fn resolve_linear<S: Simd>(&self, simd: S, first: usize, pixels: &mut [u32]) {
        let resolver = LightResolver::new(u32::try_from(self.per_pixel).unwrap_or(u32::MAX), self.rules);
        simd.vectorize(
            #[inline(always)]
            || {
                for (i, samples) in self.split_from(first) {
                    let Some(pixel) = pixels.get_mut(i) else {
                        break;
                    };
                    *pixel = resolver.mean(samples);
                }
            },
        );
    }

    /// Resolves split pixels into the mean of what their samples store.
    #[inline(always)]
    #[expect(clippy::inline_always, reason = "vector instructions reach inlined code only")]
    fn resolve_stored<S: Simd>(&self, simd: S, first: usize, pixels: &mut [u32]) {
        simd.vectorize(
            #[inline(always)]
            || {
                for (i, samples) in self.split_from(first) {
                    let Some(pixel) = pixels.get_mut(i) else {
                        break;
                    };
                    *pixel = self.resolver.pixel(Premultiplied16::sums(samples));
                }
            },
        );
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
    for (sample, color) in samples.iter_mut().zip(colors) {
        *sample = if color.is_opaque() {
            *color
        } else {
            color.over(*sample, rules)
        };
    }
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
