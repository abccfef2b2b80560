//! Coordinates and weights of textures as whole numbers.
//!
//! A coordinate is rounded to [`FRACTION_BITS`] fractional bits of a texel. From there on everything is exact integer
//! arithmetic, so that no compiler, processor or vector width can change a byte.

use super::PixelSampling;

/// Adding this to a number rounds it to a whole one, which stands in the lowest bits.
pub(super) const WHOLE: f64 = 1.5 * (1_u64 << 52) as f64;
/// Fractional bits of a texel coordinate.
pub(super) const FRACTION_BITS: u32 = 15;
/// The sum of the weights of one sample. Fits a signed 16-bit number.
pub(super) const MASS: i32 = 1 << MASS_BITS;
pub(super) const MASS_BITS: u32 = 14;
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
pub(super) fn signed(texels: f64, least: f64, most: f64) -> i32 {
    // One half more, so that negative numbers stand below it in two's complement.
    (texels.max(least).min(most) + 1.5 * TO_FIXED).to_bits() as i32
}

/// `a b`, where `b` is a fraction of [`FRACTION_BITS`] bits, rounded to nearest.
#[inline]
pub(super) fn share(a: i32, b: i32) -> i32 {
    (a * b + (1 << (FRACTION_BITS - 1))) >> FRACTION_BITS
}
