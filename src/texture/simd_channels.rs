//! Texels and weights as vectors of channels, and colours from their products.

#![expect(
    clippy::inline_always,
    reason = "a function that is not inlined into its dispatch loses the vector instructions"
)]

use fearless_simd::prelude::*;
use fearless_simd::{Simd, f32x8, i16x16, i32x8, u8x16, u8x32, u16x16, u32x4, u32x8, u64x4};

use super::bilinear::SUM_SHIFT;
use crate::color::Premultiplied16;

/// How to spread the weights of two columns over channels: each half of a 64-bit number four times, the lower half first.
///
/// The order of bytes is hidden from the compiler, which would replace one shuffle by two that it knows.
#[derive(Clone, Copy)]
pub(super) struct Spread<S: Simd>(u8x32<S>);

/// What becomes of four colours, channels as in [`Premultiplied16`].
pub(super) trait FromColors: Sized {
    fn four<S: Simd>(simd: S, colors: u16x16<S>) -> [Self; 4];
}

/// The weights of 2 x 2 texels for a vector of samples as [`Spread::columns`] takes them, for the first and the second
/// half of the lanes; in the lower 16 bits of `left` and `right` the upper texels' ones.
#[inline(always)]
pub(super) fn in_columns<S: Simd>(left: S::i32s, right: S::i32s) -> [S::u64s; 2] {
    [left.zip_low(right).bitcast(), left.zip_high(right).bitcast()]
}

impl<S: Simd> Spread<S> {
    #[inline(always)]
    pub(super) fn new(simd: S) -> Self {
        const ORDER: [u8; 32] = [
            0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3, 4, 5, 6, 7, 4, 5, 6, 7, 4, 5, 6, 7, 4, 5, 6, 7,
        ];
        let order = if Self::BY_ORDER {
            std::hint::black_box(ORDER)
        } else {
            ORDER
        };
        Self(u8x32::simd_from(simd, order))
    }

    /// Two columns of two texels with their weights: red, green, blue, alpha of the left column, then of the right one.
    ///
    /// `texels` holds the left column's upper and lower red, upper and lower green and so on, then the right column's;
    /// `weights` 16 bits each from the lowest: upper left, lower left, upper right, lower right.
    #[inline(always)]
    pub(super) fn columns(self, simd: S, texels: u8x16<S>, weights: u64) -> i32x8<S> {
        let weights: i16x16<S> = if Self::BY_ORDER {
            let both: u8x32<S> = u64x4::splat(simd, weights).bitcast();
            both.swizzle_dyn_within_blocks(self.0).bitcast()
        } else {
            let [left, right] = halves(weights);
            u32x4::splat(simd, left).combine(u32x4::splat(simd, right)).bitcast()
        };
        widen(texels).pairwise_dot_product(weights)
    }

    /// Whether vectors of 256 bits have an instruction that brings bytes into any order.
    const BY_ORDER: bool = S::u32s::LEN >= 8;
}

/// The lower and the upper 32 bits.
#[expect(clippy::cast_possible_truncation, reason = "one half after the other")]
#[inline(always)]
pub(super) fn halves(bits: u64) -> [u32; 2] {
    [bits as u32, (bits >> 32) as u32]
}

/// Bytes as 16-bit numbers.
#[inline(always)]
pub(super) fn widen<S: Simd>(bytes: u8x16<S>) -> i16x16<S> {
    // Of twice as many bytes, because for them there is one instruction.
    bytes.combine(bytes).widen().0.bitcast()
}

/// The sums of the left and right columns of two samples.
#[inline(always)]
pub(super) fn both_columns<S: Simd>(first: i32x8<S>, second: i32x8<S>) -> i32x8<S> {
    let (first, second) = (first.split(), second.split());
    first.0.combine(second.0) + first.1.combine(second.1)
}

/// Rounds the sums of four samples to the bits that are stored; see `bilinear::to_channel`.
#[inline(always)]
pub(super) fn round<S: Simd>(simd: S, low: i32x8<S>, high: i32x8<S>) -> u16x16<S> {
    let half = i32x8::splat(simd, 1 << (SUM_SHIFT - 1));
    let low: u32x8<S> = ((low + half) >> SUM_SHIFT).bitcast();
    let high: u32x8<S> = ((high + half) >> SUM_SHIFT).bitcast();
    low.relaxed_narrow(high)
}

/// Scales the sums of four samples to the bits that are stored, rounding to nearest; see `bilinear::mean`.
#[inline(always)]
pub(super) fn mean<S: Simd>(simd: S, low: i32x8<S>, high: i32x8<S>, scale: f32) -> u16x16<S> {
    scaled(simd, low, scale).relaxed_narrow(scaled(simd, high, scale))
}

/// The same of two samples.
#[inline(always)]
fn scaled<S: Simd>(simd: S, sums: i32x8<S>, scale: f32) -> u32x8<S> {
    /// Adding this to a 32-bit float rounds it to a whole number, which then stands in the lower bits.
    const WHOLE: f32 = 8_388_608.0;
    let whole = f32x8::float_from(sums) * f32x8::splat(simd, scale) + f32x8::splat(simd, WHOLE);
    whole.bitcast::<u32x8<S>>() & u32x8::splat(simd, 0xFFFF)
}

impl FromColors for Premultiplied16 {
    #[inline(always)]
    fn four<S: Simd>(_: S, colors: u16x16<S>) -> [Self; 4] {
        let channels = colors.to_array();
        let [r0, g0, b0, a0, r1, g1, b1, a1, r2, g2, b2, a2, r3, g3, b3, a3] = channels;
        [
            Self([r0, g0, b0, a0]),
            Self([r1, g1, b1, a1]),
            Self([r2, g2, b2, a2]),
            Self([r3, g3, b3, a3]),
        ]
    }
}

/// Opaque colours as pixels; see [`Premultiplied16::to_pixel`].
impl FromColors for u32 {
    #[inline(always)]
    fn four<S: Simd>(simd: S, colors: u16x16<S>) -> [Self; 4] {
        /// From red, green, blue, alpha to the bytes of `0xAARRGGBB` from the lowest.
        const ORDER: [u8; 16] = [2, 1, 0, 3, 6, 5, 4, 7, 10, 9, 8, 11, 14, 13, 12, 15];
        let bytes = (colors + u16x16::splat(simd, Premultiplied16::PER_BYTE / 2)) >> 8;
        let (low, high) = bytes.split();
        let bytes = low
            .relaxed_narrow(high)
            .swizzle_dyn_within_blocks(u8x16::simd_from(simd, ORDER));
        bytes.bitcast::<u32x4<S>>().to_array()
    }
}
