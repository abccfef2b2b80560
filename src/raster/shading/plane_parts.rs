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

use fearless_simd::prelude::*;
use fearless_simd::{Simd, dispatch, f64x8};

use crate::color::{SampleMean, SumBounds, sums_at};
use crate::raster::sampling::place_sums::PlaceSums;
use crate::raster::shading::context::PlacedParts;
use crate::raster::shading::kernel::{LANES, columns_and_rows, first_sample};
use crate::raster::shading::plane_means::{PlaceSpreads, PlaneColors, TintedPlanes};
use crate::simd;

impl PlaneColors<'_> {
    /// Between what the samples of each part add up to.
    pub(super) fn part_bounds(self, parts: PlacedParts<'_>, mean: &SampleMean, bounds: &mut [SumBounds]) {
        let shown = TintedPlanes::new(self.planes, parts.tints);
        dispatch!(simd::level(), simd => bounds_with(simd, &shown, parts, mean, bounds));
    }
}

#[inline(always)]
fn bounds_with<S: Simd>(
    simd: S,
    shown: &TintedPlanes,
    parts: PlacedParts<'_>,
    mean: &SampleMean,
    bounds: &mut [SumBounds],
) {
    let grid = parts.pixels.grid;
    let (first, side) = (first_sample(grid), f64::from(grid.side));
    let (pivot, limits) = (shown.planes.pivot, shown.spread_limits(side));
    let is_linear = matches!(mean, SampleMean::Linear(_));
    let mut spread = PlaceSpreads::NONE;
    for (block, bounds) in bounds.chunks_mut(LANES).enumerate() {
        let at = block * LANES;
        let sums = &parts.sums[at..at + bounds.len()];
        let mut counts = [0.0; LANES];
        for (i, sums) in sums.iter().enumerate() {
            spread.set(i, sums);
            counts[i] = f64::from(sums.count);
        }
        let counts = f64x8::simd_from(simd, counts);
        let [columns, rows] = columns_and_rows(simd, &parts.pixels.places[at..at + bounds.len()]);
        let right = columns * side + (first[0] - pivot[0]) + f64x8::simd_from(simd, spread.mean[0]);
        let down = rows * side + (first[1] - pivot[1]) + f64x8::simd_from(simd, spread.mean[1]);
        let (mut ends, mut certain) = ([[[0; LANES]; 2]; 3], u64::MAX);
        for (k, ends) in ends.iter_mut().enumerate() {
            let values = shown.spread(k, [right, down], &limits);
            let ([least, most], of_channel) = if is_linear {
                let squares = spread.squares_along(simd, [shown.planes.dx[k], shown.planes.dy[k]]);
                values.ends_of_light(simd, [squares; 2])
            } else {
                values.ends(simd)
            };
            certain &= of_channel;
            *ends = [sums_at(simd, least, counts, mean), sums_at(simd, most, counts, mean)];
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
