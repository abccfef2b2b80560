//! How many samples of a pixel lie in each of four neighbouring texels, where these are all that the pixel reads.
//!
//! Where a pixel's samples are spread over less than a texel, they lie in at most four. Then it is enough to count how many
//! lie in each, and a pixel takes four texels instead of one for every sample:
//!
//! ```text
//!        o  o | o  o
//!        o  o | o  o        left of one edge: 8
//!      -------+-------      above the other: 8
//!        o  o | o  o        both: 4
//!        o  o | o  o
//! ```

#![expect(
    clippy::inline_always,
    reason = "a function that is not inlined into its dispatch loses the vector instructions"
)]

use fearless_simd::Simd;
use fearless_simd::prelude::*;

use super::covered::Covered;
use super::fixed_point::FRACTION_BITS;
use super::nearest_samples::{NearestSamples, Uncertain};
use super::simd_channels::in_columns;
use super::texel_coordinates::MAX_LANES;

/// One texel in fixed point.
const ONE: i32 = 1 << FRACTION_BITS;

/// Where all samples of any pixel lie in four texels at most.
#[derive(Clone, Copy, Debug)]
pub(super) struct FourTexels {
    /// The least of the samples' distances from the centre of the pixel, on each axis.
    least: [i32; 2],
}

/// Which texels a vector of pixels reads, and how many samples lie in each.
pub(super) struct Counts {
    /// The upper left one of the four texels of each pixel.
    pub(super) firsts: [u32; MAX_LANES],
    /// 16 bits each from the lowest: at the upper left, at the lower left, at the upper right, at the lower right.
    pub(super) in_texels: [u64; MAX_LANES],
    pub(super) uncertain: Uncertain,
}

impl FourTexels {
    /// `None` where samples may lie in more texels, or a level has not two in both directions; nor of textures that go on for
    /// ever, whose texels have no order.
    pub(super) fn of<const N: usize>(samples: &NearestSamples<'_, N>) -> Option<Self> {
        let mut least = [0; 2];
        for (least, axis) in least.iter_mut().zip([&samples.x, &samples.y]) {
            // Most levels are told by their steps alone.
            if axis.spread() > 1.25 {
                return None;
            }
            let offsets = || axis.of_samples[..samples.count].iter().copied();
            *least = offsets().min()?;
            if offsets().max()? - *least >= ONE {
                return None;
            }
        }
        let level = samples.level.level;
        let has_two = level.width() > 1 && level.height() > 1;
        (has_two && samples.endless.is_none()).then_some(Self { least })
    }
}

impl Counts {
    pub(super) const NONE: Self = Self {
        firsts: [0; MAX_LANES],
        in_texels: [0; MAX_LANES],
        uncertain: Uncertain::NONE,
    };

    /// Counts those samples of pixels that are covered, and how many these are; the pixels' centres lie there, in fixed point.
    #[inline(always)]
    pub(super) fn count<S: Simd, const N: usize>(
        &mut self,
        simd: S,
        (samples, four): (&NearestSamples<'_, N>, FourTexels),
        [x, y]: [S::i32s; 2],
        (covered, all): (Covered<S>, S::i32s),
    ) {
        let number = |value: i32| S::i32s::splat(simd, value);
        let level = samples.level.level;
        // The last but one column and row at most: what lies at the border or beyond it is then right of the edge.
        let first = |at: S::i32s, least: i32, size: u32| {
            let last = number(size.cast_signed() - 2);
            ((at + number(least)) >> FRACTION_BITS).max(number(0)).min(last)
        };
        let column = first(x, four.least[0], level.width());
        let row = first(y, four.least[1], level.height());
        // From the edges behind these.
        let right = x - ((column + number(1)) << FRACTION_BITS);
        let down = y - ((row + number(1)) << FRACTION_BITS);
        let fraction: S::i16s = number(ONE - 1).bitcast();
        let mut distance = S::i16s::splat(simd, i16::MAX);
        let (mut before, mut above, mut both) = (number(0), number(0), number(0));
        let offsets = samples.x.of_samples.iter().zip(&samples.y.of_samples);
        for ((x, y), bit) in offsets.zip(0..).take(samples.count) {
            let (x, y) = (right + number(*x), down + number(*y));
            // The upper halves are no distances, and nobody looks at them.
            distance = distance
                .min(x.bitcast::<S::i16s>() & fraction)
                .min(y.bitcast::<S::i16s>() & fraction);
            // What lies before an edge is below zero: one less for each.
            let (x, y) = match covered {
                Covered::All => (x, y),
                Covered::Some(low, high) => {
                    // A sample's bit, in the highest place.
                    let bits = if bit < 32 { low } else { high };
                    let covered: S::i32s = (bits << (31 - bit % 32)).bitcast();
                    (x & covered, y & covered)
                }
            };
            before += x >> 31;
            above += y >> 31;
            both += (x & y) >> 31;
        }
        // None of these is negative, so that nothing is borrowed from the upper half.
        let left = (number(0) - both) | (both - before) << 16;
        let right = (both - above) | (all + before + above - both) << 16;
        let stride = number(level.stride().cast_signed());
        let at: S::u32s = (row * stride + column).bitcast();
        at.store_slice(&mut self.firsts[..S::u32s::LEN]);
        let (low, high) = self.in_texels[..S::u32s::LEN].split_at_mut(S::u32s::LEN / 2);
        let counts = in_columns::<S>(left, right);
        counts[0].store_slice(low);
        counts[1].store_slice(high);
        self.uncertain = Uncertain::new(simd, distance);
    }
}
