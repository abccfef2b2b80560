//! Which samples of a vector of pixels are covered, as vectors of bits.

#![expect(
    clippy::inline_always,
    reason = "a function that is not inlined into its dispatch loses the vector instructions"
)]

use fearless_simd::Simd;
use fearless_simd::prelude::*;

use super::simd_channels::halves;
use super::texel_coordinates::MAX_LANES;

/// Which samples of a vector of pixels take part.
#[derive(Clone, Copy)]
pub(super) enum Covered<S: Simd> {
    All,
    /// Bit by bit, the lower and the upper 32.
    Some(S::u32s, S::u32s),
}

impl<S: Simd> Covered<S> {
    /// Of pixels with so many samples each, and how many of each take part; masks are of the first 64.
    #[inline(always)]
    pub(super) fn new(simd: S, count: u32, masks: Option<&[u64]>) -> (Self, S::i32s) {
        let Some(masks) = masks else {
            return (Self::All, S::i32s::splat(simd, count.cast_signed()));
        };
        let possible = if count < 64 { (1 << count) - 1 } else { u64::MAX };
        let (mut low, mut high, mut counts) = ([0; MAX_LANES], [0; MAX_LANES], [0; MAX_LANES]);
        for (i, mask) in masks.iter().enumerate().take(MAX_LANES) {
            let mask = mask & possible;
            [low[i], high[i]] = halves(mask);
            counts[i] = mask.count_ones();
        }
        let vector = |numbers: &[u32; MAX_LANES]| S::u32s::from_slice(simd, &numbers[..S::u32s::LEN]);
        (Self::Some(vector(&low), vector(&high)), vector(&counts).bitcast())
    }
}
