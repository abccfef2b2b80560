//! What the samples of a tile show, one by one, where all of it is flat: for those who weigh samples of neighbouring pixels, too.

use fearless_simd::{Simd, dispatch};

use crate::color::Premultiplied16;
use crate::raster::paint::sample_colors::SampleColors;
use crate::raster::paint::visibility::buffer::Run;
use crate::raster::paint::visibility::packed::{PER_WORD, lanes};
use crate::raster::paint::visibility::painter::VisibilityPainter;
use crate::simd;

impl VisibilityPainter<'_> {
    /// Puts the colours of all samples of the finished tile, in which nothing is to be shaded, into one of the same rectangle.
    pub(crate) fn put_colors(&self, colors: &mut SampleColors) {
        debug_assert!(!self.surfaces.any_shaded, "nothing is to be shaded");
        dispatch!(simd::level(), simd => put_colors(simd, self, colors));
    }
}

#[inline(always)]
#[expect(clippy::inline_always, reason = "vector instructions reach inlined code only")]
fn put_colors<S: Simd>(simd: S, painter: &VisibilityPainter<'_>, colors: &mut SampleColors) {
    simd.vectorize(
        #[inline(always)]
        || {
            let (tile, surfaces) = (painter.layers.base(), &painter.surfaces);
            let per_pixel = colors.per_pixel();
            for y in tile.rect.y.start..tile.rect.y.end {
                let (whole, split, samples) = colors.row_to_put(y);
                let row_of_two = tile.two_surfaces(y);
                for (run, range) in tile.runs(y) {
                    split[range.clone()].fill(!matches!(run, Run::Whole(_)));
                    let samples = samples[range.start * per_pixel..range.end * per_pixel].chunks_exact_mut(per_pixel);
                    match run {
                        Run::Whole(surface) => whole[range].fill(surfaces.get(surface).flat),
                        Run::TwoSurfacePixels => {
                            for (x, samples) in range.zip(samples) {
                                let two = row_of_two.get(x);
                                let both = [two.first, two.second].map(|surface| surfaces.get(surface).flat);
                                choose(two.mask, both, samples);
                            }
                        }
                        Run::Split => {
                            for (x, samples) in range.zip(samples) {
                                let shown = samples.chunks_mut(tile.side()).zip(tile.rows_of_words(x, y));
                                for (samples, words) in shown {
                                    for (samples, word) in samples.chunks_mut(PER_WORD).zip(words) {
                                        for (sample, surface) in samples.iter_mut().zip(lanes(*word)) {
                                            *sample = surfaces.get(surface).flat;
                                        }
                                    }
                                }
                            }
                        }
                    }
                }
            }
        },
    );
}

/// Lets samples show the second colour where the bit of their number is set, and else the first.
#[inline(always)]
#[expect(clippy::inline_always, reason = "vector instructions reach inlined code only")]
fn choose(mask: u64, [first, second]: [Premultiplied16; 2], samples: &mut [Premultiplied16]) {
    let color = |bits: u64| if bits & 1 == 1 { second } else { first };
    let (eights, rest) = samples.as_chunks_mut::<8>();
    let mut bits = mask;
    // Written out eight at a time, which compilers make vectors of.
    for [a, b, c, d, e, f, g, h] in eights {
        (*a, *b, *c, *d) = (color(bits), color(bits >> 1), color(bits >> 2), color(bits >> 3));
        (*e, *f, *g, *h) = (color(bits >> 4), color(bits >> 5), color(bits >> 6), color(bits >> 7));
        bits >>= 8;
    }
    for sample in rest {
        *sample = color(bits);
        bits >>= 1;
    }
}
