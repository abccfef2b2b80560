//! The blocks of 4 x 4 texels that all samples of a pixel lie in, and what sixteen samples at once read out of such a block.
//!
//! ```text
//!     +----+----+----+----+     A block fills one vector. Where a sample lies says which four of its texels it reads, and one
//!     |    |    |    |    |     instruction brings the reds of these to the lane of every sample:
//!     +----+----+----+----+
//!     |    | a    b  |    |         lane 5: red of a, b, c, d
//!     +----+--  * ---+----+
//!     |    | c    d  |    |     so that no sample looks anything up in memory. Only processors whose vectors hold a whole block
//!     +----+----+----+----+     have that instruction.
//!     |    |    |    |    |
//!     +----+----+----+----+
//! ```
//!
//! Where samples lie is found with twice as many fractional bits as it is rounded to, so that it is known where rounding is in doubt.

#![expect(
    clippy::inline_always,
    reason = "a function that is not inlined into its dispatch loses the vector instructions"
)]

use fearless_simd::prelude::*;
use fearless_simd::{Simd, f32x16, f64x8, i16x32, i32x16, u8x16, u8x32, u8x64, u16x16, u16x32, u32x16, u64x8};

use super::filter_plan::{Axis, GridLevel};
use super::fixed_point::{FRACTION_BITS, WHOLE};

/// Samples that are found together, and pixels.
pub(super) const LANES: usize = 16;
/// Texels along a side of a block; samples that read no others lie less than so many away from the first one.
const SIDE: usize = 4;
const CELLS: f64 = 3.0;

/// Fractional bits of where samples lie in their block, and those that rounding takes away.
const BLOCK_BITS: u32 = 30;
const MORE_BITS: u32 = BLOCK_BITS - FRACTION_BITS;
/// Adding this to a coordinate rounds it to [`BLOCK_BITS`], which then stand in the lower half.
const TO_BLOCK: f64 = 1.5 * (1_u64 << (52 - BLOCK_BITS)) as f64;
/// How far rounding may have moved a coordinate on its way, in units of these bits, and then some.
const INEXACT: u32 = 3;
/// Beyond this, in texels, numbers have too few bits for that.
const FARTHEST: f64 = (1 << 20) as f64;
/// More than that, in texels.
const SLACK: f64 = 1.0 / 4096.0;
/// The second factor of a pair that rounds a product to nearest before its fraction is cut off; its partner is 1.
const ROUND: i32 = 1 << (FRACTION_BITS - 1 + 16);

/// Where the samples of [`LANES`] pixels lie in a level.
pub(super) struct Blocks<'a> {
    pub(super) level: &'a GridLevel<'a>,
    pub(super) x: BlockAxis,
    pub(super) y: BlockAxis,
}

/// The same along an axis.
pub(super) struct BlockAxis {
    /// The first texel of the block of each pixel.
    first: [i32; LANES],
    /// How far from there the first point of the pixel lies, in parts of [`BLOCK_BITS`] bits.
    corner: [u32; LANES],
    /// A bit for each pixel whose samples lie in its block.
    pub(super) fits: u64,
}

/// Where samples lie in their pixels: column and row, of the first and of the second half of a vector.
#[derive(Clone, Copy)]
pub(super) struct Inside<S: Simd> {
    columns: [f64x8<S>; 2],
    rows: [f64x8<S>; 2],
}

/// How far a vector of samples lies from the first point of its pixel, in parts of [`BLOCK_BITS`] bits of a texel.
#[derive(Clone, Copy)]
pub(super) struct Steps<S: Simd> {
    x: u32x16<S>,
    y: u32x16<S>,
}

/// Where a vector of samples lies on an axis, in fixed point from the first texel of its block on.
#[derive(Clone, Copy)]
struct Rounded<S: Simd> {
    at: i32x16<S>,
    /// How near rounding was to doubt: less than twice [`INEXACT`] is.
    doubt: u32x16<S>,
}

/// Whether numbers have enough bits where no sample is farther from the pivot than that, in samples.
pub(super) fn is_near(axis: &Axis, farthest: f64) -> bool {
    let reach = axis.right.abs().max(axis.down.abs()) * farthest;
    reach.max(axis.at_pivot.abs()) < FARTHEST
}

/// Whether it is in doubt how any of some samples are rounded.
#[inline(always)]
pub(super) fn is_in_doubt<S: Simd>(simd: S, doubt: u32x16<S>) -> bool {
    doubt.simd_le(u32x16::splat(simd, 2 * INEXACT)).to_bitmask() != 0
}

impl BlockAxis {
    /// Of pixels whose first points are there, and whose samples lie in this range of columns and rows from them on.
    #[inline(always)]
    pub(super) fn new<S: Simd>(
        simd: S,
        [columns, rows]: [[f64x8<S>; 2]; 2],
        axis: &Axis,
        [least, most]: [[f64; 2]; 2],
    ) -> Self {
        let mut found = Self {
            first: [0; LANES],
            corner: [0; LANES],
            fits: 0,
        };
        let ends = |k: usize, step: f64| (least[k] * step, most[k] * step);
        let (along, across) = (ends(0, axis.right), ends(1, axis.down));
        let least = along.0.min(along.1) + across.0.min(across.1) - SLACK;
        let most = along.0.max(along.1) + across.0.max(across.1) + SLACK;
        let (right, down) = (f64x8::splat(simd, axis.right), f64x8::splat(simd, axis.down));
        for half in [0, 1] {
            let at = columns[half].mul_add(right, f64x8::splat(simd, axis.at_pivot));
            let at = rows[half].mul_add(down, at);
            let (low, high) = (at + least, at + most);
            let first = low.floor();
            let is_inside = low.simd_ge(f64x8::splat(simd, 0.0)) & high.simd_le(f64x8::splat(simd, axis.last));
            let fits = is_inside & (high - first).simd_lt(f64x8::splat(simd, CELLS));
            let range = half * LANES / 2..(half + 1) * LANES / 2;
            let first_number: u64x8<S> = (first + WHOLE).bitcast();
            let corner: u64x8<S> = (at - first + TO_BLOCK).bitcast();
            found.fits |= fits.to_bitmask() << range.start;
            for (i, (first, corner)) in range.zip(first_number.to_array().into_iter().zip(corner.to_array())) {
                found.first[i] = low_half(first).cast_signed();
                found.corner[i] = low_half(corner);
            }
        }
        found
    }

    /// Where samples of a pixel lie.
    #[inline(always)]
    fn round<S: Simd>(&self, steps: u32x16<S>, pixel: usize) -> Rounded<S> {
        let at = steps + self.corner[pixel];
        Rounded {
            at: ((at + (1 << (MORE_BITS - 1))) >> MORE_BITS).bitcast(),
            doubt: (at + ((1 << (MORE_BITS - 1)) + INEXACT)) & ((1 << MORE_BITS) - 1),
        }
    }
}

impl<S: Simd> Inside<S> {
    /// Of the first [`LANES`] of some samples; any where there are fewer.
    #[inline(always)]
    pub(super) fn new(simd: S, inside: &[[u8; 2]]) -> Self {
        let both = if let Some(inside) = inside.first_chunk::<LANES>() {
            u8x32::from_slice(simd, inside.as_flattened())
        } else {
            let mut padded = [[0; 2]; LANES];
            for (padded, inside) in padded.iter_mut().zip(inside) {
                *padded = *inside;
            }
            u8x32::from_slice(simd, padded.as_flattened())
        };
        let both: u16x16<S> = both.bitcast();
        let (low, high) = both.widen();
        let both: u32x16<S> = low.combine(high);
        Self {
            columns: halves(number(both & 0xFF), 0.0),
            rows: halves(number(both >> 8), 0.0),
        }
    }
}

impl<S: Simd> Inside<S> {
    /// How far the samples lie from the first point of their pixel in a level.
    #[inline(always)]
    pub(super) fn steps(&self, simd: S, level: &GridLevel<'_>) -> Steps<S> {
        Steps {
            x: self.along(simd, &level.x, 0).narrow(self.along(simd, &level.x, 1)),
            y: self.along(simd, &level.y, 0).narrow(self.along(simd, &level.y, 1)),
        }
    }

    /// The same of half of them along an axis, in the lower half of each number.
    #[inline(always)]
    fn along(&self, simd: S, axis: &Axis, half: usize) -> u64x8<S> {
        let (right, down) = (f64x8::splat(simd, axis.right), f64x8::splat(simd, axis.down));
        let at = self.columns[half].mul_add(right, f64x8::splat(simd, TO_BLOCK));
        self.rows[half].mul_add(down, at).bitcast()
    }
}

impl Blocks<'_> {
    /// The block of a pixel.
    #[inline(always)]
    fn texels<S: Simd>(&self, simd: S, pixel: usize) -> u8x64<S> {
        let (texels, stride) = (self.level.level.texels(), self.level.level.stride() as usize);
        let count = texels.len() - (SIDE - 1) * stride;
        let [x, y] = [self.x.first[pixel], self.y.first[pixel]].map(|first| first.cast_unsigned() as usize);
        let first = y * stride + x;
        let mut rows = [u8x16::splat(simd, 0); SIDE];
        for (y, row) in rows.iter_mut().enumerate() {
            let texels = &texels[y * stride..][..count];
            *row = u8x16::from_slice(simd, texels[first..first + SIDE].as_flattened());
        }
        rows[0].combine(rows[1]).combine(rows[2].combine(rows[3]))
    }

    /// What samples of a pixel read of this level, times its part, and how near that is to doubt.
    #[inline(always)]
    pub(super) fn read<S: Simd>(&self, simd: S, steps: Steps<S>, pixel: usize) -> ([i32x16<S>; 3], u32x16<S>) {
        /// The bytes of red of the upper left, the upper right, the lower left and the lower right texel.
        const ORDER: u32 = 0x1410_0400;
        const NEXT_CHANNEL: u32 = 0x0101_0101;
        let x = self.x.round(steps.x, pixel);
        let y = self.y.round(steps.y, pixel);
        let texels = self.texels(simd, pixel);
        let first: u32x16<S> = ((y.at >> FRACTION_BITS) << 4 | (x.at >> FRACTION_BITS) << 2).bitcast();
        let first = first | first << 8;
        let red = (first | first << 16) + ORDER;
        let (green, blue) = (red + NEXT_CHANNEL, red + 2 * NEXT_CHANNEL);
        let weights = weights(simd, [x.at, y.at], self.level.mass);
        let values = [
            weighed(texels, red, weights),
            weighed(texels, green, weights),
            weighed(texels, blue, weights),
        ];
        (values, x.doubt.min(y.doubt))
    }
}

/// Small whole numbers as floats.
#[inline(always)]
pub(super) fn number<S: Simd>(numbers: u32x16<S>) -> f32x16<S> {
    numbers.bitcast::<i32x16<S>>().to_float()
}

/// So much more than these, as longer floats.
#[inline(always)]
pub(super) fn halves<S: Simd>(numbers: f32x16<S>, more: f64) -> [f64x8<S>; 2] {
    let (low, high) = numbers.widen();
    [low + more, high + more]
}

#[inline(always)]
#[expect(clippy::cast_possible_truncation, reason = "the lower half is meant")]
fn low_half(bits: u64) -> u32 {
    bits as u32
}

/// What the four bytes that `order` names in each lane add up to with such weights of the left and of the right ones.
#[inline(always)]
fn weighed<S: Simd>(texels: u8x64<S>, order: u32x16<S>, [left, right]: [i16x32<S>; 2]) -> i32x16<S> {
    let four: u16x32<S> = texels.swizzle_dyn(order.bitcast::<u8x64<S>>()).bitcast();
    let (of_left, of_right): (i16x32<S>, i16x32<S>) = ((four & 0xFF).bitcast(), (four >> 8).bitcast());
    of_left.pairwise_dot_product(left) + of_right.pairwise_dot_product(right)
}

/// The weights of the left and the right texels at such places, the upper one's in the lower 16 bits: see `bilinear::weights`.
#[inline(always)]
fn weights<S: Simd>(simd: S, [x, y]: [i32x16<S>; 2], mass: i32) -> [i16x32<S>; 2] {
    let fraction = (1 << FRACTION_BITS) - 1;
    let (x, y) = ((x & fraction | ROUND).bitcast(), (y & fraction | ROUND).bitcast());
    let mass = i32x16::splat(simd, mass);
    let lower = share(mass, y);
    let upper = mass - lower;
    // No part of a difference is negative, so that nothing is borrowed from the upper half.
    let right = share(upper, x) | share(lower, x) << 16;
    let left = (upper | lower << 16) - right;
    [left.bitcast(), right.bitcast()]
}

/// That part of a weight, rounded: see `fixed_point::share`.
#[inline(always)]
fn share<S: Simd>(weight: i32x16<S>, part: i16x32<S>) -> i32x16<S> {
    let product: i32x16<S> = (weight | 1 << 16).bitcast::<i16x32<S>>().pairwise_dot_product(part);
    product >> FRACTION_BITS
}
