//! Parts of pixels of colours that lie in planes: between what their samples add up to, without shading any of them.
//!
//! ```text
//!   +-------------+
//!   | o    o    / |    the samples `o` of a part lie around a middle `#`, and so do their colours; `x` belong to another part
//!   |   o  #  /   |
//!   | o   o / x x |
//!   |   o /  x    |
//!   +-------------+
//! ```
//!
//! As in `plane_means` the colour at the middle, and how far the samples are spread around it, say the mean but for rounding.

#![expect(
    clippy::inline_always,
    reason = "only what is inlined into a dispatched function is compiled for its vector instructions"
)]

use fearless_simd::{Simd, dispatch};

use crate::color::{PIXELS, SampleMean, SumBounds, sums_between};
use crate::raster::attributes::Planes;
use crate::raster::sampling::place_sums::PlaceSums;
use crate::raster::shading::context::PlacedParts;
use crate::raster::shading::near_planes::{PlaceSpreads, TintedPlanes, blocks};
use crate::raster::shading::plane_means::PlaneColors;
use crate::simd;

impl PlaneColors<'_> {
    /// Between what the samples of each part add up to.
    pub(super) fn part_bounds(self, parts: PlacedParts<'_>, mean: &SampleMean, bounds: &mut [SumBounds]) {
        let planes = self.planes;
        match mean {
            SampleMean::Stored(_) => {
                dispatch!(simd::level(), simd => bounds_with::<_, false>(simd, planes, parts, mean, bounds));
            }
            SampleMean::Linear(_) => {
                dispatch!(simd::level(), simd => bounds_with::<_, true>(simd, planes, parts, mean, bounds));
            }
        }
    }
}

#[inline(always)]
fn bounds_with<S: Simd, const IS_LINEAR: bool>(
    simd: S,
    planes: &Planes<3>,
    parts: PlacedParts<'_>,
    mean: &SampleMean,
    bounds: &mut [SumBounds],
) {
    let reach = f64::from(parts.pixels.grid.side - 1);
    let near = TintedPlanes::new(planes, parts.tints).near(parts.pixels, [0.0; 2], reach);
    for (range, _) in blocks(bounds.len()) {
        let (of_block, bounds) = (&parts.sums[range.clone()], &mut bounds[range.clone()]);
        let mut few = [PlaceSums::default(); PIXELS];
        let sums = if let Some(sums) = of_block.first_chunk() {
            sums
        } else {
            for (few, sums) in few.iter_mut().zip(of_block) {
                *few = *sums;
            }
            &few
        };
        let spread = PlaceSpreads::new(simd, sums);
        let at = near.columns_and_rows(simd, &parts.pixels.places[range]);
        let (mut ends, mut certain) = ([[[0; PIXELS]; 2]; 3], u64::MAX);
        for (k, ends) in ends.iter_mut().enumerate() {
            let values = near.spread(k, at, Some(spread.means));
            let (found, of_channel) = if IS_LINEAR {
                values.ends_of_light(simd, [spread.squares_along(near.dx[k], near.dy[k]); 2])
            } else {
                values.ends(simd)
            };
            certain &= of_channel;
            *ends = sums_between(simd, found, spread.counts, mean);
        }
        for (i, (bounds, PlaceSums { count, .. })) in bounds.iter_mut().zip(sums).enumerate() {
            let [r, g, b] = &ends;
            *bounds = if certain >> i & 1 == 1 {
                SumBounds {
                    least: [r[0][i], g[0][i], b[0][i]],
                    // Rounded down.
                    most: [r[1][i] + 1, g[1][i] + 1, b[1][i] + 1],
                    count: *count,
                }
            } else {
                SumBounds::unknown(*count, mean)
            };
        }
    }
}
