//! Resolving a tile: the mean of each pixel's samples.

use fearless_simd::{Simd, dispatch};

use super::SampleColors;
use crate::color::{LightResolver, Premultiplied16, ResolveSpace};
use crate::simd;

impl SampleColors {
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
