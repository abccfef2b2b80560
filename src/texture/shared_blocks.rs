//! Filtering samples of which many read the same block of texels, as where a texture is magnified: a vector of samples at a
//! time, once for each of the blocks that they read.
//!
//! ```text
//!      a a|b b        the samples of a pixel and the blocks that they read: four sums for all of them,
//!      a a|b b        and each sample keeps the one of its own block
//!      ---+---
//!      c c|d d
//! ```
//!
//! Each number is that of `bilinear::each`, as in `block_filter`.

#![expect(
    clippy::inline_always,
    reason = "a function that is not inlined into its dispatch loses the vector instructions"
)]

use fearless_simd::prelude::*;
use fearless_simd::{Simd, i32x8, u32x8};

use super::bilinear::SUM_SHIFT;
use super::block_weights::{Blocks, OneTap, SMALL, rows, rows_beyond};
use super::cubic::TexelWeights;
use super::filter_plan::{GridLevel, Plan};
use super::sample_filter::by_fours;
use super::simd_channels::{FromColors, widen};
use super::texel_coordinates::{MAX_LANES, Positions, columns_and_rows};

/// Steps from sample to sample within which those of a vector lie, on each axis: mostly those of a pixel.
const STEPS: f64 = 3.0;
/// So many blocks in a vector take as long as reading one for each sample.
const MANY: f64 = 3.0;
/// Two opaque texels' alphas.
const OPAQUE: i32 = 0x00FF_00FF;

/// A block of texels.
struct Texels {
    corner: i32,
    /// Red, green, blue and alpha of texels in pairs, the lower ones in the upper 16 bits; in the order of [`Blocks::weights`].
    pairs: [[i32; 4]; 8],
    is_opaque: bool,
}

/// Whether the samples of a vector read few blocks; of plans that read one block for each sample only.
pub(super) fn are_few(plan: &Plan<'_>) -> bool {
    let level = &plan.finer;
    let blocks = |right: f64, down: f64| 1.0 + STEPS * (right.abs() + down.abs());
    plan.coarser.is_none()
        && plan.line.taps.count == 1
        && blocks(level.x.right, level.x.down) * blocks(level.y.right, level.y.down) < MANY
}

/// Filters samples where [`are_few`]; see [`super::Filter::points`].
#[inline(always)]
pub(super) fn filter_with<S: Simd, C: FromColors, const SIDE: usize>(
    simd: S,
    plan: &Plan<'_>,
    weights: &TexelWeights,
    points: &[[u16; 2]],
    out: &mut [C],
) {
    let lanes = S::u32s::LEN;
    let level = &plan.finer;
    let one = OneTap::new(plan, weights, level);
    let mut texels = Texels::NONE;
    for (points, out) in points.chunks(lanes).zip(out.chunks_mut(lanes)) {
        let at = Positions::new(simd, columns_and_rows(simd, points), plan.first);
        let blocks = Blocks::new::<SIDE>(simd, one.tap, one.places(simd, &at));
        let sums = sums::<S, SIDE>(simd, (plan, level), &blocks, &mut texels);
        let words = colors(simd, sums, level.mass);
        by_fours!(simd, out, |i| {
            let four: u32x8<S> = u32x8::from_slice(simd, &words[2 * i % (2 * MAX_LANES)..][..8]);
            four.bitcast()
        });
    }
}

/// Red, green, blue and alpha of samples in the units of the weights.
#[inline(always)]
fn sums<S: Simd, const SIDE: usize>(
    simd: S,
    (plan, level): (&Plan<'_>, &GridLevel<'_>),
    blocks: &Blocks<S>,
    texels: &mut Texels,
) -> [S::i32s; 4] {
    let number = |value| S::i32s::splat(simd, value);
    let [left, top] = blocks.corners;
    // Both fit 16 bits.
    let corners = left & number(0xFFFF) | top << 16;
    let mut sums = [number(0); 4];
    let mut rest = u64::MAX >> (64 - S::u32s::LEN);
    while rest != 0 {
        let lane = rest.trailing_zeros() as usize;
        let corner = corners.as_slice()[lane];
        if corner != texels.corner {
            texels.read::<S, SIDE>(simd, (plan, level), corner);
        }
        let [red, green, blue, alpha] = texels.sums::<S, SIDE>(simd, &blocks.weights, level.mass);
        let same = corners.simd_eq(number(corner));
        sums = [
            same.select(red, sums[0]),
            same.select(green, sums[1]),
            same.select(blue, sums[2]),
            same.select(alpha, sums[3]),
        ];
        rest &= !same.to_bitmask();
    }
    sums
}

/// The colours of samples, channels as in [`crate::color::Premultiplied16`], two in each word; clamped as in `block_filter`.
#[inline(always)]
fn colors<S: Simd>(simd: S, [red, green, blue, alpha]: [S::i32s; 4], mass: i32) -> [u32; 2 * MAX_LANES] {
    let number = |value| S::i32s::splat(simd, value);
    let alpha = alpha.max(number(0)).min(number(i32::from(u8::MAX) * mass));
    let low = channel(simd, red, alpha) | channel(simd, green, alpha) << 16;
    let high = channel(simd, blue, alpha) | channel(simd, alpha, alpha) << 16;
    let [first, second]: [S::u32s; 2] = [low.zip_low(high).bitcast(), low.zip_high(high).bitcast()];
    let mut words = [0; 2 * MAX_LANES];
    first.store_slice(&mut words[..S::u32s::LEN]);
    second.store_slice(&mut words[S::u32s::LEN..2 * S::u32s::LEN]);
    words
}

/// See `bilinear::to_channel`.
#[inline(always)]
fn channel<S: Simd>(simd: S, sum: S::i32s, alpha: S::i32s) -> S::i32s {
    let number = |value| S::i32s::splat(simd, value);
    (sum.max(number(0)).min(alpha) + number(1 << (SUM_SHIFT - 1))) >> SUM_SHIFT
}

impl Texels {
    const NONE: Self = Self {
        // No block starts so far outside of a level.
        corner: i32::MIN,
        pairs: [[0; 4]; 8],
        is_opaque: false,
    };

    /// Reads the block with this corner.
    #[inline(always)]
    fn read<S: Simd, const SIDE: usize>(&mut self, simd: S, (plan, level): (&Plan<'_>, &GridLevel<'_>), corner: i32) {
        self.corner = corner;
        let level = level.level;
        let [left, top] = [corner << 16 >> 16, corner >> 16];
        let end = if SIDE == SMALL { 2 } else { 4 };
        let is_inside = left >= 0
            && top >= 0
            && left + end <= level.width().cast_signed()
            && top + end <= level.height().cast_signed();
        let [a, b, c, d] = if is_inside {
            let offset = top * level.stride().cast_signed() + left;
            rows::<S, SIDE>(simd, level, offset.cast_unsigned() as usize)
        } else {
            rows_beyond::<S, SIDE>(simd, level, plan.wrap, [left, top])
        };
        let pairs = self.pairs.as_flattened_mut();
        widen(a.zip_low(b)).bitcast::<i32x8<S>>().store_slice(&mut pairs[..8]);
        if SIDE != SMALL {
            widen(a.zip_high(b))
                .bitcast::<i32x8<S>>()
                .store_slice(&mut pairs[8..16]);
            widen(c.zip_low(d))
                .bitcast::<i32x8<S>>()
                .store_slice(&mut pairs[16..24]);
            widen(c.zip_high(d)).bitcast::<i32x8<S>>().store_slice(&mut pairs[24..]);
        }
        // Else the compiler keeps them in registers, and takes them out one by one, which is slower than to load them.
        std::hint::black_box(&mut self.pairs);
        let read = if SIDE == SMALL { 2 } else { 8 };
        self.is_opaque = self.pairs[..read].iter().fold(OPAQUE, |all, [.., alpha]| all & alpha) == OPAQUE;
    }

    /// The sums of a vector of samples, as if all read this block.
    #[inline(always)]
    fn sums<S: Simd, const SIDE: usize>(&self, simd: S, weights: &[S::i32s; 8], mass: i32) -> [S::i32s; 4] {
        // All weights together are as many as one knows.
        let alpha = if self.is_opaque {
            S::i32s::splat(simd, i32::from(u8::MAX) * mass)
        } else {
            self.sum::<S, SIDE>(simd, weights, 3)
        };
        [
            self.sum::<S, SIDE>(simd, weights, 0),
            self.sum::<S, SIDE>(simd, weights, 1),
            self.sum::<S, SIDE>(simd, weights, 2),
            alpha,
        ]
    }

    /// The same of one channel.
    #[inline(always)]
    fn sum<S: Simd, const SIDE: usize>(&self, simd: S, weights: &[S::i32s; 8], channel: usize) -> S::i32s {
        let read = if SIDE == SMALL { 2 } else { 8 };
        let mut sum = S::i32s::splat(simd, 0);
        for (weights, texels) in weights.iter().zip(&self.pairs).take(read) {
            let texels: S::i16s = S::i32s::splat(simd, texels[channel]).bitcast();
            sum += weights.bitcast::<S::i16s>().pairwise_dot_product(texels);
        }
        sum
    }
}

#[cfg(test)]
mod tests {
    use glam::DVec2;

    use super::super::{
        Filter, MipLevel, MipPyramid, PixelSampling, SampleGrid, SamplingSettings, UvMap, Wrap, oracle,
    };
    use super::*;
    use crate::color::Premultiplied16;
    use crate::simd;

    #[test]
    fn magnified_textures_are_read_as_sample_by_sample() {
        let texel = |i: u8| {
            let alpha = if i.is_multiple_of(4) { 130 } else { 255 };
            [(i * 7).min(alpha), i * 3, 90, alpha]
        };
        let pyramid = MipPyramid::build(MipLevel::new(5, 7, (0..5 * 7).map(texel).collect()));
        let grid = SampleGrid {
            side: 4,
            origin: [-2, 1],
        };
        // From inside to far beyond the border.
        let points: Vec<[u16; 2]> = (0..300).map(|i| [i * 13 % 256, i * 29 % 256]).collect();
        for (pixel, wrap) in PixelSampling::ALL
            .into_iter()
            .flat_map(|pixel| Wrap::ALL.map(|wrap| (pixel, wrap)))
        {
            let settings = SamplingSettings {
                pixel,
                wrap,
                ..SamplingSettings::default()
            };
            let map = |texels: f64| UvMap {
                pivot: DVec2::new(3.25, 4.5),
                uv: DVec2::new(0.1, 0.7),
                dx: DVec2::new(0.2, 0.1) * texels,
                dy: DVec2::new(-0.1, 0.15) * texels,
            };
            assert!(
                !are_few(&Filter::new(&pyramid, &map(4.0), &settings).plan(grid)),
                "{settings:?}"
            );
            let filter = Filter::new(&pyramid, &map(0.25), &settings);
            let plan = filter.plan(grid);
            assert!(are_few(&plan), "{settings:?}");
            let expected: Vec<_> = points
                .iter()
                .map(|at| oracle::point(&plan, at.map(u32::from)))
                .collect();
            for (name, level) in simd::tested() {
                let mut found = vec![Premultiplied16::TRANSPARENT; points.len()];
                filter.points(level, grid, &points, &mut found);
                assert_eq!(found, expected, "{name}: {settings:?}");
            }
        }
    }
}
