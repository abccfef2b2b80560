//! Compositing the tile of a layer with the one below it.

use std::ops::Range;

use super::SampleColors;
use crate::color::Premultiplied16;
use crate::raster::layers::Compositing;
use crate::rules::Rules;

/// Samples of one pixel with which one colour is composited together.
const ALIKE: usize = 16;

impl SampleColors {
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
}
