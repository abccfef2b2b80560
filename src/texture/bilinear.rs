//! The texels around a point and their weights, in integers: the arithmetic of texture filtering, one point at a time. The
//! kernels do the same for many points at once.
//!
//! The weights of all texels of a sample sum to [`MASS`] exactly: what is left over goes to one of them. So a constant texture
//! stays constant.

use super::cubic::TexelWeights;
use super::fixed_point::{FRACTION_BITS, MASS, MASS_BITS, share};
use super::{MipLevel, PixelSampling, Wrap};

/// From a sum of bytes times weights to the 16 bits of a stored channel, which are 256 per byte.
pub(super) const SUM_SHIFT: u32 = MASS_BITS - 8;

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
pub(super) fn add(
    level: &MipLevel,
    (pixel, wrap): (PixelSampling, Wrap),
    at: [i32; 2],
    mass: i32,
    sums: &mut [i32; 4],
) {
    each(pixel, at, mass, |x, y, weight| {
        for (sum, channel) in sums.iter_mut().zip(level.wrapped(wrap, [x, y])) {
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
/// `mass`. Texels beyond the level may be among them; [`Wrap`] says what stands there.
#[inline]
pub(super) fn each(pixel: PixelSampling, [x, y]: [i32; 2], mass: i32, mut read: impl FnMut(i32, i32, i32)) {
    const FRACTION: i32 = (1 << FRACTION_BITS) - 1;
    let (column, row) = (x >> FRACTION_BITS, y >> FRACTION_BITS);
    match pixel {
        PixelSampling::Nearest => read(column, row, mass),
        PixelSampling::Bilinear => {
            let weights = weights(x & FRACTION, y & FRACTION, mass);
            read(column, row, weights[0]);
            read(column + 1, row, weights[1]);
            read(column, row + 1, weights[2]);
            read(column + 1, row + 1, weights[3]);
        }
        PixelSampling::CatmullRom | PixelSampling::BSpline | PixelSampling::Mitchell => {
            let weights = TexelWeights::new(pixel);
            let rows = weights.shares(y & FRACTION, mass);
            for (row, share) in (row - 1..).zip(rows) {
                let columns = weights.shares(x & FRACTION, share);
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
