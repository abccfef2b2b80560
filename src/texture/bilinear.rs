//! The texels around a point and their weights, in integers: the arithmetic of texture filtering, one point at a time. The
//! kernels do the same for many points at once.
//!
//! A coordinate is rounded to [`FRACTION_BITS`] fractional bits of a texel. From there on everything is exact integer
//! arithmetic, so that no compiler, processor or vector width can change a byte. The weights of all texels of a sample
//! sum to [`MASS`] exactly: what is left over goes to the last one. So a constant texture stays constant.

use super::cubic::CubicWeights;
use super::{MipLevel, PixelSampling};

/// Fractional bits of a texel coordinate.
pub(super) const FRACTION_BITS: u32 = 15;
/// The sum of the weights of one sample. Fits a signed 16-bit number.
pub(super) const MASS: i32 = 1 << MASS_BITS;
pub(super) const MASS_BITS: u32 = 14;
/// From a sum of bytes times weights to the 16 bits of a stored channel, which are 256 per byte.
pub(super) const SUM_SHIFT: u32 = MASS_BITS - 8;
/// A 64-bit float of this size has [`FRACTION_BITS`] bits left for fractions: adding it to a coordinate rounds the
/// coordinate to them, and they stand in the lower bits of the sum.
pub(super) const TO_FIXED: f64 = (1_u64 << (52 - FRACTION_BITS)) as f64;
/// How many texels beyond a level positions of samples count, and how many long the way to a tap: as many as the largest
/// level has, so that a sum of three fits 32 bits.
pub(super) const REACH: f64 = 16_384.0;

/// Where the first texel's centre lies from the corner, in texels, for whole coordinates to be what `pixel` looks for:
/// corners of texels, or centres.
pub(super) fn first_centre(pixel: PixelSampling) -> f64 {
    match pixel {
        PixelSampling::Nearest => 0.0,
        PixelSampling::Bilinear | PixelSampling::CatmullRom | PixelSampling::BSpline | PixelSampling::Mitchell => 0.5,
    }
}

/// A coordinate in texels, clamped to `0..=last` and rounded to fixed point. A coordinate that is no number is 0.
#[inline]
#[expect(
    clippy::cast_possible_truncation,
    reason = "the fixed-point number is in the lower half"
)]
pub(super) fn to_fixed(texels: f64, last: f64) -> u32 {
    (texels.max(0.0).min(last) + TO_FIXED).to_bits() as u32
}

/// Where a tap lies that is `offset` texels from a sample at `texels`: both are rounded, then added and clamped.
///
/// Neither counts as more than [`REACH`] texels beyond the level: from there on taps read its border.
#[inline]
pub(super) fn tap(texels: f64, offset: f64, last: f64) -> u32 {
    let at = signed(texels, -REACH, last + REACH) + tap_offset(offset);
    at.clamp(0, to_fixed(last, last).cast_signed()).cast_unsigned()
}

/// The distance of a tap from its sample in fixed point.
#[inline]
pub(super) fn tap_offset(texels: f64) -> i32 {
    signed(texels, -REACH, REACH)
}

/// A coordinate, clamped to `least..=most` and rounded to fixed point.
#[inline]
#[expect(
    clippy::cast_possible_truncation,
    reason = "the fixed-point number is in the lower half"
)]
fn signed(texels: f64, least: f64, most: f64) -> i32 {
    // One half more, so that negative numbers stand below it in two's complement.
    (texels.max(least).min(most) + 1.5 * TO_FIXED).to_bits() as i32
}

/// The stored channel of `count` taps, from the sum of what each adds.
#[inline]
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "a weighted mean of bytes is a byte, which is 16 bits when stored"
)]
pub(super) fn mean(sum: i32, count: u32) -> u16 {
    (sum as f32 * per_tap(count)).round_ties_even() as u16
}

/// From the sum over `count` taps to the 16 bits of a stored channel.
#[inline]
pub(super) fn per_tap(count: u32) -> f32 {
    1.0 / (count << SUM_SHIFT) as f32
}

/// `a b`, where `b` is a fraction of [`FRACTION_BITS`] bits, rounded to nearest.
#[inline]
pub(super) fn share(a: i32, b: i32) -> i32 {
    (a * b + (1 << (FRACTION_BITS - 1))) >> FRACTION_BITS
}

/// Weights `[upper left, upper right, lower left, lower right]` that sum to `mass`, for the fractions of a point.
#[inline]
pub(super) fn weights(x: i32, y: i32, mass: i32) -> [i32; 4] {
    let lower = share(mass, y);
    let upper = mass - lower;
    let (upper_right, lower_right) = (share(upper, x), share(lower, x));
    [upper - upper_right, upper_right, lower - lower_right, lower_right]
}

/// Adds the texels around the point `(x, y)`, in fixed point, to `sums`, with weights that sum to `mass`.
#[inline]
pub(super) fn add(level: &MipLevel, pixel: PixelSampling, at: [u32; 2], mass: i32, sums: &mut [i32; 4]) {
    each(pixel, at, mass, |x, y, weight| {
        for (sum, channel) in sums.iter_mut().zip(level.texel(x, y)) {
            *sum += i32::from(channel) * weight;
        }
    });
}

/// Sums of `count` taps as what a premultiplied colour can be: alpha at most all of it, and no channel above alpha. Only weights
/// below zero take them elsewhere.
#[inline]
pub(super) fn clamped([r, g, b, alpha]: [i32; 4], count: u32) -> [i32; 4] {
    let alpha = alpha.clamp(0, i32::from(u8::MAX) * MASS * count.cast_signed());
    [r.clamp(0, alpha), g.clamp(0, alpha), b.clamp(0, alpha), alpha]
}

/// Calls `read` with column, row and weight of each texel around the point `(x, y)`, in fixed point; the weights sum to
/// `mass`. Texels beyond the level may be among them: the nearest one of the level stands in.
#[inline]
pub(super) fn each(pixel: PixelSampling, [x, y]: [u32; 2], mass: i32, mut read: impl FnMut(i32, i32, i32)) {
    const FRACTION: u32 = (1 << FRACTION_BITS) - 1;
    let (column, row) = ((x >> FRACTION_BITS).cast_signed(), (y >> FRACTION_BITS).cast_signed());
    match pixel {
        PixelSampling::Nearest => read(column, row, mass),
        PixelSampling::Bilinear => {
            let weights = weights((x & FRACTION).cast_signed(), (y & FRACTION).cast_signed(), mass);
            read(column, row, weights[0]);
            read(column + 1, row, weights[1]);
            read(column, row + 1, weights[2]);
            read(column + 1, row + 1, weights[3]);
        }
        PixelSampling::CatmullRom | PixelSampling::BSpline | PixelSampling::Mitchell => {
            let Some(weights) = pixel.cubic().map(CubicWeights::new) else {
                return;
            };
            let rows = weights.shares((y & FRACTION).cast_signed(), mass);
            for (row, share) in (row - 1..).zip(rows) {
                let columns = weights.shares((x & FRACTION).cast_signed(), share);
                for (column, weight) in (column - 1..).zip(columns) {
                    read(column, row, weight);
                }
            }
        }
    }
}

/// A stored channel from the weighted sum of bytes, rounded to nearest.
#[inline]
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "a weighted mean of bytes is a byte, which is 16 bits when stored"
)]
pub(super) fn to_channel(sum: i32) -> u16 {
    ((sum + (1 << (SUM_SHIFT - 1))) >> SUM_SHIFT) as u16
}

/// The weight of the next level as a part of [`MASS`].
#[expect(clippy::cast_possible_truncation, reason = "a weight in 0..=1 becomes 0..=MASS")]
pub(super) fn mass(weight: f32) -> i32 {
    (weight * MASS as f32).round() as i32
}
