//! Pixels of the sums that [`super::near_sums`] finds, and which of them are certain.
//!
//! Samples are summed up by how much more they hold than half of what they can: so numbers are half as large, and what rounding
//! takes from them too. Each addition and multiplication moves a sum by at most a part of `2^-24` of what all samples add up to
//! without the signs of their weights.

#![expect(
    clippy::inline_always,
    reason = "only what is inlined into a dispatched function is compiled for its vector instructions"
)]

use fearless_simd::prelude::*;
use fearless_simd::{Simd, f32x16, i32x16, mask32x16, u32x16};

use crate::color::{Premultiplied16, ResolveSpace, certain_bytes, certain_bytes_of_light};
use crate::raster::paint::wide::free::WeighedPositions;
use crate::raster::resolve::axis_weights::AxisWeights;
use crate::rules::Rules;

/// Pixels that are made together.
pub(super) const FILLED: usize = 16;

/// Half of all light, as it is summed up, and half of a channel.
const HALF_LIGHT: f32 = 8_388_608.0;
const HALF: f32 = Premultiplied16::ONE as f32 / 2.0;

/// What one rounding of a number is off, in parts of it, and then some.
const ROUNDED: f32 = 6.3e-8;
/// What light is off because sums of light are rounded to whole numbers before they become bytes, and these begin at whole ones.
const WHOLE_LIGHT_OFF: f32 = 1.5e-7;
/// What bytes lose by the last few roundings.
const LAST_OFF: f32 = 8e-5;
/// What bytes of light are off is known up to here.
const MOST_OFF: f32 = 1e-4;

/// What makes pixels of sums.
#[derive(Debug)]
pub(super) struct NearMeans {
    space: ResolveSpace,
    light: &'static [i32],
    /// From which part of a byte on it is rounded up, and that much less.
    rounded: f32,
    /// Where sums come without weights: what to divide them by; else 1.
    total: f32,
    /// What sums may be off, over what all samples weigh: in parts of all that a channel can hold.
    off: f32,
    /// The same where no weight is below zero.
    off_of_weight: f32,
    /// What is more than too little a weight.
    least: f32,
}

impl NearMeans {
    /// Where samples at the same places in every pixel weigh so much (see [`super::free::FreeSums::same`]), and sums are of so many
    /// terms in a row in a pixel.
    pub(super) fn new(
        space: ResolveSpace,
        samples: &WeighedPositions,
        (same, in_a_row): (&[(i64, Vec<i64>)], usize),
        rules: Rules,
    ) -> Self {
        let WeighedPositions { positions, weights } = samples;
        let margin = weights.margin();
        let around = (2 * margin + 1).pow(2).cast_unsigned() as usize;
        // The product of the weights, that with the value, all sums, and the division.
        let roundings = (in_a_row + around + 6) as f32;
        let total: i64 = same.iter().map(|(all, _)| all).sum();
        let each = same.iter().flat_map(|(_, each)| each);
        let unsigned: i64 = each.map(|weight| weight.abs()).sum();
        let of_axis = || (-margin..=margin).map(|beside| weights.of_pixel(beside));
        let is_signed = of_axis().flatten().any(|weight| *weight < 0);
        let most: i32 = of_axis()
            .map(|columns| columns.iter().map(|weight| weight.abs()).max().unwrap_or(0))
            .sum();
        let count = positions.count();
        let off = roundings * ROUNDED;
        let even = AxisWeights::ONE * AxisWeights::ONE * count as f64;
        let (most, of_weight) = match (same.is_empty(), is_signed) {
            (false, _) => (unsigned as f32 / total as f32, 0.0),
            (true, true) => ((most as f32).powi(2) * count as f32, 0.0),
            (true, false) => (0.0, off),
        };
        Self {
            space,
            light: ResolveSpace::light(),
            rounded: match rules {
                Rules::Standard | Rules::Float => 0.5,
                Rules::Course => 0.0,
            },
            total: if same.is_empty() { 1.0 } else { total as f32 },
            off: off * most,
            off_of_weight: of_weight,
            least: if same.is_empty() { near(even * 0.13) } else { 0.0 },
        }
    }

    /// What of the samples of a pixel that show one opaque colour is summed up.
    #[inline(always)]
    pub(super) fn value(&self, color: Premultiplied16) -> [f32; 4] {
        match self.space {
            ResolveSpace::Stored => Self::stored(color),
            ResolveSpace::Linear => self.light(color),
        }
    }

    /// The same of stored values.
    #[inline(always)]
    pub(super) fn stored(Premultiplied16([r, g, b, _]): Premultiplied16) -> [f32; 4] {
        [f32::from(r) - HALF, f32::from(g) - HALF, f32::from(b) - HALF, 0.0]
    }

    /// The same of light.
    #[inline(always)]
    pub(super) fn light(&self, Premultiplied16([r, g, b, _]): Premultiplied16) -> [f32; 4] {
        let last = self.light.len() - 1;
        let of = |channel: u16| self.light[usize::from(channel).min(last)] as f32 - HALF_LIGHT;
        [of(r), of(g), of(b), 0.0]
    }

    /// The pixels `0xAARRGGBB` of such sums, of samples that weigh so much together, or 1 where they are at the same places in every
    /// pixel; and a bit for each pixel that is certain.
    #[inline(always)]
    pub(super) fn pixels<S: Simd>(
        &self,
        simd: S,
        [red, green, blue]: [f32x16<S>; 3],
        weight: f32x16<S>,
    ) -> (u32x16<S>, u64) {
        let off = f32x16::splat(simd, self.off) / weight + self.off_of_weight;
        let enough = weight.simd_ge(f32x16::splat(simd, self.least));
        let weight = weight * self.total;
        let (red, is_red) = self.bytes(simd, red / weight, off);
        let (green, is_green) = self.bytes(simd, green / weight, off);
        let (blue, is_blue) = self.bytes(simd, blue / weight, off);
        let pixels = i32x16::splat(simd, 0xFF << 24) | red << 16 | green << 8 | blue;
        let certain = is_red & is_green & is_blue & enough;
        (pixels.bitcast(), certain.to_bitmask())
    }

    /// The bytes of such means, which may be off by so much in parts of all that there is, and which are certain.
    #[inline(always)]
    fn bytes<S: Simd>(&self, simd: S, mean: f32x16<S>, off: f32x16<S>) -> (i32x16<S>, mask32x16<S>) {
        match self.space {
            ResolveSpace::Stored => {
                let per_byte = 1.0 / f32::from(Premultiplied16::PER_BYTE);
                let bytes = mean.mul_add(f32x16::splat(simd, per_byte), f32x16::splat(simd, HALF * per_byte));
                let bytes = bytes.max(f32x16::splat(simd, 0.0)).min(f32x16::splat(simd, 255.0));
                certain_bytes(simd, bytes + self.rounded, off * 255.0 + LAST_OFF)
            }
            ResolveSpace::Linear => {
                let light = mean.mul_add(f32x16::splat(simd, 0.5 / HALF_LIGHT), f32x16::splat(simd, 0.5));
                let light = light.max(f32x16::splat(simd, 0.0)).min(f32x16::splat(simd, 1.0));
                let is_known = off.simd_le(f32x16::splat(simd, MOST_OFF));
                // The curve is steeper by a few hundredths where light is less by what it is off.
                let off = (off + WHOLE_LIGHT_OFF) * 1.05;
                let (bytes, certain) = certain_bytes_of_light(simd, light, off, self.rounded);
                (bytes, certain & is_known)
            }
        }
    }
}

/// In 32 bits.
#[expect(clippy::cast_possible_truncation, reason = "it needs not be exact")]
fn near(number: f64) -> f32 {
    number as f32
}
