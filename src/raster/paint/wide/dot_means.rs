//! Pixels of the sums that [`super::dot_sums`] finds: divided by what all samples weigh, and rounded as bytes are.
//!
//! A sum comes in halves of 32 bits, times 1 and times `2^16`. Numbers of 32 bits tell nearly always which byte it is:
//!
//! ```text
//!     byte 118         byte 119        byte 120
//!   |- - - - - - - -|- - - -+- - - -|- - - - - - -+|-     so near to a border 64-bit floats decide, which hold any sum
//! ```

#![expect(
    clippy::inline_always,
    reason = "only what is inlined into a dispatched function is compiled for its vector instructions"
)]

use fearless_simd::prelude::*;
use fearless_simd::{Simd, f32x16, f64x8, i32x4, i32x8, i32x16, u8x64, u32x8, u64x2};

use crate::color::{Premultiplied16, ResolveSpace, WeightedSum};
use crate::rules::Rules;

/// By how much stored values, and the lower halves of sums of rows, are moved, so that they fit 16 bits with a sign.
pub(super) const MOVED: u16 = 1 << 15;
/// Pixels that are made together.
pub(super) const TOGETHER: usize = 4;

/// What makes a pixel of a sum.
#[derive(Clone, Copy, Debug)]
pub(super) struct Mean {
    rules: Rules,
    /// What all samples weigh together.
    total: i64,
    /// What was taken from the sum because numbers were moved.
    moved: f64,
    /// The sum of opaque samples' alpha.
    one: f64,
    /// What rounds, in parts of a sum: half a level or nothing, and half of what is between two sums.
    rounding: f64,
    /// Levels in a part of a sum.
    levels: f64,
    near: Near,
}

/// The same in 32-bit floats, in levels.
#[derive(Clone, Copy, Debug)]
struct Near {
    /// What to multiply the two halves of a sum by.
    low: f32,
    high: f32,
    /// What was taken from it, and what rounds.
    moved: f32,
    /// How far from what it is it may be found.
    off: f32,
    /// What the halves of opaque samples' alpha, as they were moved, add up to, modulo 2^32; and its level with what rounds.
    one: u32,
    full: f32,
}

impl Mean {
    /// Where columns, or rows, weigh so much together, and so much without their signs.
    pub(super) fn new([axis, unsigned]: [i64; 2], rules: Rules) -> Self {
        let total = axis.pow(2);
        let total_weight = total as f64;
        let per_level = f64::from(Premultiplied16::PER_BYTE) * total_weight;
        let half = match rules {
            Rules::Standard | Rules::Float => per_level / 2.0,
            Rules::Course => 0.0,
        };
        let one = f64::from(Premultiplied16::ONE) * total_weight;
        // Of stored values, and of the lower halves of the sums of rows.
        let moved = f64::from(MOVED) * (total_weight + axis as f64);
        Self {
            rules,
            total,
            moved,
            one,
            // Sums are whole, and levels far apart: a level's least sum is found in it whatever the division rounds.
            rounding: half + 0.5,
            levels: per_level.recip(),
            near: Near::new([per_level, half], [moved, one], (unsigned as f64).powi(2)),
        }
    }

    /// What all samples around a pixel weigh together; pixels can be made only where that is above zero.
    pub(super) fn total(&self) -> i64 {
        self.total
    }

    /// The first pixels of these, each for the sums of its rows: two by two, first of the lower halves, which were moved.
    #[inline(always)]
    pub(super) fn put<S: Simd>(&self, simd: S, sums: [i32x16<S>; TOGETHER], pixels: &mut [u32]) {
        let [a, b, c, d] = [joined(sums[0]), joined(sums[1]), joined(sums[2]), joined(sums[3])];
        let low = [a[0].combine(b[0]), c[0].combine(d[0])];
        let high = [a[1].combine(b[1]), c[1].combine(d[1])];
        let halves = [low[0].combine(low[1]), high[0].combine(high[1])];
        if !self.near.put(simd, halves, pixels) {
            self.put_exact(simd, halves, pixels);
        }
    }

    /// The same in 64-bit floats.
    #[cold]
    #[inline(never)]
    fn put_exact<S: Simd>(&self, simd: S, halves: [i32x16<S>; 2], pixels: &mut [u32]) {
        simd.vectorize(
            #[inline(always)]
            || self.put_exact_with(simd, halves, pixels),
        );
    }

    #[inline(always)]
    fn put_exact_with<S: Simd>(&self, simd: S, [low, high]: [i32x16<S>; 2], pixels: &mut [u32]) {
        const NONE: f64 = f64::NEG_INFINITY;
        let ((first_low, second_low), (first_high, second_high)) = (low.split(), high.split());
        let sums = [
            floats(simd, first_high) * f64::from(1 << 16) + floats(simd, first_low) + self.moved,
            floats(simd, second_high) * f64::from(1 << 16) + floats(simd, second_low) + self.moved,
        ];
        let [first, second] = [self.in_places(simd, sums[0]), self.in_places(simd, sums[1])];
        let [even, odd] = [both_words(first.zip_low(second)), both_words(first.zip_high(second))];
        let found = [even[0], odd[0], even[1], odd[1]];
        for (pixel, found) in pixels.iter_mut().zip(found) {
            *pixel = 0xFF00_0000 | lowest(found);
        }
        let opaque = [NONE, NONE, NONE, self.one, NONE, NONE, NONE, self.one];
        let opaque = f64x8::simd_from(simd, opaque);
        if (sums[0].simd_lt(opaque) | sums[1].simd_lt(opaque)).any_true() {
            let sums = [sums[0].to_array(), sums[1].to_array()];
            for (pixel, sum) in pixels.iter_mut().zip(sums.as_flattened().as_chunks().0) {
                if sum[3] < self.one {
                    *pixel = self.translucent(*sum);
                }
            }
        }
    }

    /// The levels of two pixels, each in its place of a pixel's word; alpha has none.
    #[inline(always)]
    fn in_places<S: Simd>(&self, simd: S, sums: f64x8<S>) -> f64x8<S> {
        let full = f64x8::splat(simd, self.one);
        let places = f64x8::simd_from(simd, [65536.0, 256.0, 1.0, 0.0, 65536.0, 256.0, 1.0, 0.0]);
        let levels = (sums.max(0.0).min(full) + self.rounding) * self.levels;
        levels.floor() * places
    }

    /// The same of what is not opaque.
    #[inline(never)]
    #[expect(clippy::cast_possible_truncation, reason = "whole numbers below 2^53")]
    fn translucent(&self, sum: [f64; 4]) -> u32 {
        let sum = WeightedSum {
            channels: sum.map(|channel| channel as i64),
            weight: self.total,
        };
        ResolveSpace::Stored.weighted_pixel(sum, self.rules)
    }
}

impl Near {
    /// Of levels so far apart, what rounds, what was taken from a sum, that of opaque samples' alpha, and the weights of all samples
    /// without their signs.
    fn new([per_level, half]: [f64; 2], [moved, one]: [f64; 2], unsigned: f64) -> Self {
        /// Half of what 32-bit floats of one and more are apart, of one.
        const ROUNDED: f64 = 0.5 * f32::EPSILON as f64;
        let level = |sum: f64| sum / per_level;
        // The halves as they are at most, and what is added to them: each is rounded three times, and twice more with the others.
        let most = [
            level(unsigned * f64::from(MOVED)),
            level(f64::from(MOVED).powi(2) * 2.0),
        ];
        let most = most[0] + most[1] + level(moved + half);
        Self {
            low: narrow(level(1.0)),
            high: narrow(level(65536.0)),
            moved: narrow(level(moved + half)),
            off: narrow(5.0 * ROUNDED * most),
            one: low_word(one - moved),
            full: narrow(level(one + half)),
        }
    }

    /// Puts four pixels, or the first of them, by the lower and the higher halves of their sums; `false` where not all of them are
    /// certain and opaque.
    #[inline(always)]
    fn put<S: Simd>(&self, simd: S, [low, high]: [i32x16<S>; 2], pixels: &mut [u32]) -> bool {
        /// Alpha, which is the last channel of each pixel.
        const ALPHA: u64 = 0x8888;
        /// Whole numbers below it are the lowest bits of what they make with it.
        const WHOLE: f32 = (1_u32 << 23) as f32;
        /// The lowest bytes of blue, green and red, in this order.
        const CHANNELS: [u8; 64] = {
            let mut at = [0; 64];
            let mut pixel = 0;
            while pixel < 4 {
                (at[16 * pixel], at[16 * pixel + 1]) = (8, 4);
                at[16 * pixel + 2] = 0;
                pixel += 1;
            }
            at
        };
        let levels = high.to_float::<f32x16<S>>() * self.high + low.to_float::<f32x16<S>>() * self.low + self.moved;
        let below = levels.floor();
        let beyond = levels - below;
        let certain =
            beyond.simd_gt(f32x16::splat(simd, self.off)) & beyond.simd_lt(f32x16::splat(simd, 1.0 - self.off));
        // So near to that level no other sum is the same modulo 2^32.
        let is_one = ((high << 16) + low).simd_eq(i32x16::splat(simd, self.one.cast_signed()))
            & (levels - self.full).abs().simd_lt(f32x16::splat(simd, 2.0 * self.off));
        let certain = certain.to_bitmask() & !ALPHA | is_one.to_bitmask() & ALPHA;
        // Beyond the pixels that are asked for there is anything.
        let needed = u64::from(u16::MAX) >> (16 - 4 * pixels.len().clamp(1, TOGETHER));
        if !certain & needed != 0 {
            return false;
        }
        let bytes = below.max(0.0).min(255.0) + WHOLE;
        let words = bytes
            .bitcast::<u8x64<S>>()
            .swizzle_dyn_within_blocks(u8x64::simd_from(simd, CHANNELS));
        let words = words.bitcast::<i32x16<S>>().to_array();
        for (pixel, word) in pixels.iter_mut().zip(words.iter().step_by(4)) {
            *pixel = 0xFF00_0000 | word.cast_unsigned();
        }
        true
    }
}

/// Modulo 2^32.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "that is what it is for, of whole numbers below 2^53"
)]
fn low_word(number: f64) -> u32 {
    number as i64 as u32
}

#[expect(clippy::cast_possible_truncation, reason = "what that rounds is reckoned with")]
fn narrow(number: f64) -> f32 {
    number as f32
}

/// The sums of even and odd rows together: the lower halves, and the higher ones.
#[inline(always)]
fn joined<S: Simd>(sums: i32x16<S>) -> [i32x4<S>; 2] {
    let (low, high) = sums.split();
    let ((even_low, odd_low), (even_high, odd_high)) = (low.split(), high.split());
    [even_low + odd_low, even_high + odd_high]
}

/// The sums of two numbers' channels, which lie next to each other channel by channel, below 2^52.
#[inline(always)]
fn both_words<S: Simd>(channels: f64x8<S>) -> [u64; 2] {
    // Whole numbers below it are the lowest bits of what they make with it.
    const WHOLE: f64 = (1_u64 << 52) as f64;
    let (left, right) = channels.split();
    let (left, right) = (left + right).split();
    (left + right + WHOLE).bitcast::<u64x2<S>>().to_array()
}

/// Whole numbers as floats.
#[inline(always)]
fn floats<S: Simd>(simd: S, numbers: i32x8<S>) -> f64x8<S> {
    // Numbers without a sign are the lowest bits of what they make with 2^52.
    const WHOLE: f64 = (1_u64 << 52) as f64;
    const SIGN: u32 = 1 << 31;
    let high = u32x8::splat(simd, 0x4330_0000);
    let numbers = numbers.bitcast::<u32x8<S>>() ^ u32x8::splat(simd, SIGN);
    let words = numbers.zip_low(high).combine(numbers.zip_high(high));
    words.bitcast::<f64x8<S>>() - (WHOLE + f64::from(SIGN))
}

/// The lowest 24 bits.
#[inline(always)]
#[expect(clippy::cast_possible_truncation, reason = "that is what it is for")]
fn lowest(word: u64) -> u32 {
    word as u32 & 0x00FF_FFFF
}

#[cfg(test)]
mod tests {
    use fearless_simd::dispatch;

    use super::*;
    use crate::simd;

    const AXIS: i64 = 41_231;

    /// The sum of alike rows whose halves add up to this.
    fn in_halves(sum: i64) -> [i32; 4] {
        let [low, high] = [sum & 0xFFFF, sum >> 16].map(|half| i32::try_from(half).expect("32 bits"));
        // Of even and of odd rows anything that adds up to them.
        [low - 77, 77, high - 12_345, 12_345]
    }

    #[test]
    fn levels_are_those_of_an_exact_division() {
        let total = AXIS.pow(2);
        let per_level = i64::from(Premultiplied16::PER_BYTE) * total;
        let mut near = 0;
        for rules in Rules::ALL {
            let mean = Mean::new([AXIS, AXIS * 5 / 4], rules);
            let moved = i64::from(MOVED) * (total + AXIS);
            // The sums on both sides of where a level starts, at and about the ends of what is told by 32-bit floats, and far away.
            let besides = [0, per_level / 5000, per_level / 2000, per_level / 900, per_level / 3];
            let besides = besides.into_iter().flat_map(|far| [-far - 1, -far, far, far + 1]);
            for (level, beside) in (0..=255).flat_map(|level| besides.clone().map(move |beside| (level, beside))) {
                let half = if rules == Rules::Course { 0 } else { per_level / 2 };
                let sum = (level * per_level - half + beside).clamp(0, 255 * per_level);
                for alpha in [255 * per_level, 255 * per_level - 1, 254 * per_level] {
                    let exact = WeightedSum {
                        channels: [sum.min(alpha), sum / 2, 0, alpha],
                        weight: total,
                    };
                    let halves = exact.channels.map(|channel| in_halves(channel - moved));
                    let numbers: [i32; 16] = std::array::from_fn(|i| halves[i % 4][i / 4]);
                    for (name, level) in simd::tested() {
                        let mut found = [0; 3];
                        dispatch!(level, simd => {
                            let numbers = i32x16::simd_from(simd, numbers);
                            mean.put(simd, [numbers; TOGETHER], &mut found);
                            let [low, high] = joined(numbers).map(|half| half.combine(half));
                            near += u32::from(mean.near.put(simd, [low.combine(low), high.combine(high)], &mut [0; 4]));
                        });
                        assert_eq!(
                            found,
                            [ResolveSpace::Stored.weighted_pixel(exact, rules); 3],
                            "{name}: {sum}, {beside} beside a level, {alpha}, {rules:?}"
                        );
                    }
                }
            }
        }
        assert!(near > 1000, "32-bit floats told {near} of them");
    }

    #[test]
    fn what_32_bits_tell_are_the_levels_of_any_sum() {
        arbtest::arbtest(|u| {
            let axis = u.int_in_range(8_000..=65_000)?;
            let unsigned = u.int_in_range(axis..=65_535.max(axis))?;
            let rules = *u.choose(&Rules::ALL)?;
            let mean = Mean::new([axis, unsigned], rules);
            let per_level = i64::from(Premultiplied16::PER_BYTE) * axis.pow(2);
            let moved = i64::from(MOVED) * (axis.pow(2) + axis);
            let mut pixel = || -> arbtest::arbitrary::Result<[i64; 4]> {
                // Weights below zero carry sums beyond what there can be.
                let most = unsigned.pow(2) * i64::from(MOVED) / 100 * 99;
                let mut sum = || {
                    Ok::<_, arbtest::arbitrary::Error>(u.int_in_range(-most..=most)? + i64::from(MOVED) * axis.pow(2))
                };
                Ok([sum()?, sum()?, sum()?, 255 * per_level])
            };
            let sums = pixel()?;
            let halves = sums.map(|sum| in_halves(sum - moved));
            let numbers: [i32; 16] = std::array::from_fn(|i| halves[i % 4][i / 4]);
            let exact = WeightedSum {
                channels: sums,
                weight: axis.pow(2),
            };
            for (name, level) in simd::tested() {
                let mut found = [0];
                dispatch!(level, simd => {
                    mean.put(simd, [i32x16::simd_from(simd, numbers); TOGETHER], &mut found);
                });
                assert_eq!(
                    found,
                    [ResolveSpace::Stored.weighted_pixel(exact, rules)],
                    "{name}: {sums:?}, {axis}"
                );
            }
            Ok(())
        })
        .budget_ms(300);
    }
}
