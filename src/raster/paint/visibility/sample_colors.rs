//! What the samples of a tile show, one by one, where all of it is flat: for those who weigh samples of neighbouring pixels, too.

use fearless_simd::{Simd, dispatch};

use crate::color::Premultiplied16;
use crate::raster::paint::sample_colors::SampleColors;
use crate::raster::paint::visibility::buffer::Run;
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
            for y in tile.rect.y.start..tile.rect.y.end {
                let row_of_two = tile.two_surfaces(y);
                for (run, range) in tile.runs(y) {
                    match run {
                        Run::Whole(surface) => colors.put(y, range, surfaces.get(surface).flat),
                        Run::TwoSurfacePixels => {
                            for x in range {
                                let two = row_of_two.get(x);
                                let [first, second] = [two.first, two.second].map(|surface| surfaces.get(surface).flat);
                                choose(two.mask, [first, second], colors.samples_to_put(y, x));
                            }
                        }
                        Run::Split => {
                            for x in range {
                                let shown = tile.samples(x, y).map(|surface| surfaces.get(surface).flat);
                                for (sample, color) in colors.samples_to_put(y, x).iter_mut().zip(shown) {
                                    *sample = color;
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
    for (sample, bit) in samples.iter_mut().zip(0_u32..) {
        *sample = if mask >> (bit % 64) & 1 == 1 { second } else { first };
    }
}
