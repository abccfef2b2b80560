//! [`BlendMode::blend`] of many samples, sixteen at a time, to the last bit.

#![expect(
    clippy::inline_always,
    reason = "only what is inlined into a dispatched function is compiled for its vector instructions"
)]

use fearless_simd::prelude::*;
use fearless_simd::{Level, Simd, dispatch, f32x16, u32x16, u64x8};

use super::{BlendMode, Premultiplied16};
use crate::rules::Rules;
use crate::simd;

/// Samples that are blended together.
const LANES: usize = 16;

/// The largest level of a channel.
const ONE: f32 = Premultiplied16::ONE as f32;

/// Three channels of sixteen colours, or four.
type Colors<S, const CHANNELS: usize> = [f32x16<S>; CHANNELS];

impl BlendMode {
    /// Blends colours of a layer with those below; as [`BlendMode::blend`] for each.
    pub fn blend_all(self, above: &[Premultiplied16], below: &mut [Premultiplied16], rules: Rules) {
        self.blend_at(simd::level(), above, below, rules);
    }

    fn blend_at(self, level: Level, above: &[Premultiplied16], below: &mut [Premultiplied16], rules: Rules) {
        if self == Self::Normal || rules == Rules::Course {
            for (below, above) in below.iter_mut().zip(above) {
                *below = self.blend(*above, *below, rules);
            }
        } else {
            dispatch!(level, simd => kernel(simd, self, above, below));
        }
    }
}

#[inline(always)]
fn kernel<S: Simd>(simd: S, mode: BlendMode, above: &[Premultiplied16], below: &mut [Premultiplied16]) {
    for (above, below) in above.chunks(LANES).zip(below.chunks_mut(LANES)) {
        let (upper, lower) = (Sixteen::load(simd, above), Sixteen::load(simd, below));
        let (upper_levels, lower_levels) = (upper.levels(), lower.levels());
        let (zero, one) = (f32x16::splat(simd, 0.0), f32x16::splat(simd, ONE));
        if (upper_levels[3].simd_eq(one) & lower_levels[3].simd_eq(one)).all_true() {
            Sixteen::rounded(blended_opaque(mode, upper_levels, lower_levels)).store(below);
            continue;
        }
        let blended = Sixteen::rounded(blended(mode, upper_levels, lower_levels));
        // Where one of the two is transparent, the other one stays.
        let nothing_above = upper_levels[3].simd_eq(zero);
        let nothing_below = lower_levels[3].simd_eq(zero);
        let select = |kept: u32x16<S>, other: u32x16<S>, blended: u32x16<S>| {
            nothing_above.select(kept, nothing_below.select(other, blended))
        };
        let result = Sixteen {
            red_green: select(lower.red_green, upper.red_green, blended.red_green),
            blue_alpha: select(lower.blue_alpha, upper.blue_alpha, blended.blue_alpha),
        };
        result.store(below);
    }
}

/// The levels of [`BlendMode::blend`] where neither colour is transparent.
#[inline(always)]
fn blended<S: Simd>(mode: BlendMode, upper: Colors<S, 4>, lower: Colors<S, 4>) -> Colors<S, 4> {
    let mixed = mixed(mode, straight(lower), straight(upper));
    let simd = upper[3].simd;
    let one = f32x16::splat(simd, 1.0);
    let (upper_alpha, lower_alpha) = (upper[3] / ONE, lower[3] / ONE);
    let (above_alone, below_alone) = (one - lower_alpha, one - upper_alpha);
    let both = upper_alpha * lower_alpha;
    let alpha = upper_alpha + lower_alpha - both;
    let mut levels = upper;
    for i in 0..3 {
        let sum = upper[i] / ONE * above_alone + lower[i] / ONE * below_alone + both * mixed[i];
        levels[i] = sum.max(f32x16::splat(simd, 0.0)).min(alpha) * 255.0;
    }
    levels[3] = alpha.max(f32x16::splat(simd, 0.0)).min(one) * 255.0;
    levels
}

/// The same where both colours are opaque: nothing is left of either alone.
#[inline(always)]
fn blended_opaque<S: Simd>(mode: BlendMode, upper: Colors<S, 4>, lower: Colors<S, 4>) -> Colors<S, 4> {
    let simd = upper[3].simd;
    let (zero, one) = (f32x16::splat(simd, 0.0), f32x16::splat(simd, 1.0));
    let mixed = mixed(mode, straight(lower), straight(upper));
    let mut levels = [one * 255.0; 4];
    for i in 0..3 {
        levels[i] = mixed[i].max(zero).min(one) * 255.0;
    }
    levels
}

/// Straight red, green and blue of colours that are not transparent.
#[inline(always)]
fn straight<S: Simd>([r, g, b, a]: Colors<S, 4>) -> Colors<S, 3> {
    [r / a, g / a, b / a]
}

/// `B(below, above)`, as [`BlendMode::mixed`].
#[inline(always)]
fn mixed<S: Simd>(mode: BlendMode, below: Colors<S, 3>, above: Colors<S, 3>) -> Colors<S, 3> {
    match mode {
        BlendMode::Hue => with_luminosity(with_saturation(above, saturation(below)), luminosity(below)),
        BlendMode::Saturation => with_luminosity(with_saturation(below, saturation(above)), luminosity(below)),
        BlendMode::Color => with_luminosity(above, luminosity(below)),
        BlendMode::Luminosity => with_luminosity(below, luminosity(above)),
        _ => {
            let mut mixed = above;
            for i in 0..3 {
                mixed[i] = channel(mode, below[i], above[i]);
            }
            mixed
        }
    }
}

#[inline(always)]
fn channel<S: Simd>(mode: BlendMode, below: f32x16<S>, above: f32x16<S>) -> f32x16<S> {
    let (zero, one) = (f32x16::splat(below.simd, 0.0), f32x16::splat(below.simd, 1.0));
    match mode {
        BlendMode::Multiply => below * above,
        BlendMode::Screen => screen(below, above),
        BlendMode::Overlay => hard_light(above, below),
        BlendMode::Darken => below.min(above),
        BlendMode::Lighten => below.max(above),
        BlendMode::ColorDodge => {
            let dodged = (below / (one - above)).min(one);
            let dodged = above.simd_ge(one).select(one, dodged);
            below.simd_le(zero).select(zero, dodged)
        }
        BlendMode::ColorBurn => {
            let burnt = one - ((one - below) / above).min(one);
            let burnt = above.simd_le(zero).select(zero, burnt);
            below.simd_ge(one).select(one, burnt)
        }
        BlendMode::HardLight => hard_light(below, above),
        BlendMode::SoftLight => soft_light(below, above),
        BlendMode::Difference => (below - above).abs(),
        BlendMode::Exclusion => below + above - below * 2.0 * above,
        BlendMode::Normal | BlendMode::Hue | BlendMode::Saturation | BlendMode::Color | BlendMode::Luminosity => above,
    }
}

#[inline(always)]
fn screen<S: Simd>(below: f32x16<S>, above: f32x16<S>) -> f32x16<S> {
    below + above - below * above
}

#[inline(always)]
fn hard_light<S: Simd>(below: f32x16<S>, above: f32x16<S>) -> f32x16<S> {
    let darker = below * 2.0 * above;
    let half = f32x16::splat(above.simd, 0.5);
    above.simd_le(half).select(darker, screen(below, above * 2.0 - 1.0))
}

#[inline(always)]
fn soft_light<S: Simd>(below: f32x16<S>, above: f32x16<S>) -> f32x16<S> {
    let splat = |value: f32| f32x16::splat(above.simd, value);
    let twice = above * 2.0;
    let darker = below - (splat(1.0) - twice) * below * (splat(1.0) - below);
    let cubic = ((below * 16.0 - 12.0) * below + 4.0) * below;
    let towards = below.simd_le(splat(0.25)).select(cubic, below.sqrt());
    let lighter = below + (twice - 1.0) * (towards - below);
    above.simd_le(splat(0.5)).select(darker, lighter)
}

#[inline(always)]
fn luminosity<S: Simd>([r, g, b]: Colors<S, 3>) -> f32x16<S> {
    r * 0.3 + g * 0.59 + b * 0.11
}

#[inline(always)]
fn lowest<S: Simd>([r, g, b]: Colors<S, 3>) -> f32x16<S> {
    r.min(g).min(b)
}

#[inline(always)]
fn highest<S: Simd>([r, g, b]: Colors<S, 3>) -> f32x16<S> {
    r.max(g).max(b)
}

#[inline(always)]
fn saturation<S: Simd>(color: Colors<S, 3>) -> f32x16<S> {
    highest(color) - lowest(color)
}

#[inline(always)]
fn with_luminosity<S: Simd>(color: Colors<S, 3>, wanted: f32x16<S>) -> Colors<S, 3> {
    let (zero, one) = (f32x16::splat(wanted.simd, 0.0), f32x16::splat(wanted.simd, 1.0));
    let change = wanted - luminosity(color);
    let mut moved = color;
    for channel in &mut moved {
        *channel += change;
    }
    let lightness = luminosity(moved);
    let (lowest, highest) = (lowest(moved), highest(moved));
    for channel in &mut moved {
        let raised = lightness + (*channel - lightness) * lightness / (lightness - lowest);
        *channel = lowest.simd_lt(zero).select(raised, *channel);
        let lowered = lightness + (*channel - lightness) * (one - lightness) / (highest - lightness);
        *channel = highest.simd_gt(one).select(lowered, *channel);
    }
    moved
}

#[inline(always)]
fn with_saturation<S: Simd>(color: Colors<S, 3>, wanted: f32x16<S>) -> Colors<S, 3> {
    let zero = f32x16::splat(wanted.simd, 0.0);
    let (lowest, range) = (lowest(color), saturation(color));
    let mut spread = color;
    for channel in &mut spread {
        *channel = range.simd_le(zero).select(zero, (*channel - lowest) * wanted / range);
    }
    spread
}

/// Sixteen colours: red and green, blue and alpha, the former of the two in the lower half of each number.
#[derive(Clone, Copy)]
struct Sixteen<S: Simd> {
    red_green: u32x16<S>,
    blue_alpha: u32x16<S>,
}

impl<S: Simd> Sixteen<S> {
    /// Up to sixteen colours; the lanes that are left are transparent.
    #[inline(always)]
    fn load(simd: S, colors: &[Premultiplied16]) -> Self {
        let mut words = [0; LANES];
        for (word, color) in words.iter_mut().zip(colors) {
            *word = color.to_word();
        }
        let [first, second] = halves(&words);
        let (first, second) = (u64x8::simd_from(simd, first), u64x8::simd_from(simd, second));
        Self {
            red_green: first.narrow(second),
            blue_alpha: (first >> 32).narrow(second >> 32),
        }
    }

    #[inline(always)]
    fn store(self, colors: &mut [Premultiplied16]) {
        let (first, second) = self.red_green.widen();
        let (first_rest, second_rest) = self.blue_alpha.widen();
        let words = [first | first_rest << 32, second | second_rest << 32];
        for (colors, words) in colors.chunks_mut(LANES / 2).zip(words) {
            for (color, word) in colors.iter_mut().zip(<[u64; LANES / 2]>::from(words)) {
                *color = Premultiplied16::from_word(word);
            }
        }
    }

    /// The four channels, `0.0..=65280.0`.
    #[inline(always)]
    fn levels(self) -> Colors<S, 4> {
        [
            level(self.red_green & 0xFFFF),
            level(self.red_green >> 16),
            level(self.blue_alpha & 0xFFFF),
            level(self.blue_alpha >> 16),
        ]
    }

    /// From channels of `0.0..=255.0`; as [`Premultiplied16::from_byte_range`].
    #[inline(always)]
    fn rounded([r, g, b, a]: Colors<S, 4>) -> Self {
        Self {
            red_green: whole(r) | whole(g) << 16,
            blue_alpha: whole(b) | whole(a) << 16,
        }
    }
}

/// The first and the last eight of sixteen.
#[inline(always)]
fn halves(words: &[u64; LANES]) -> [[u64; LANES / 2]; 2] {
    let mut halves = [[0; LANES / 2]; 2];
    halves.as_flattened_mut().copy_from_slice(words);
    halves
}

/// Numbers below `2^16` as floats.
#[inline(always)]
fn level<S: Simd>(channel: u32x16<S>) -> f32x16<S> {
    channel.to_float()
}

/// The nearest levels of channels of `0.0..=255.0`.
#[inline(always)]
fn whole<S: Simd>(channel: f32x16<S>) -> u32x16<S> {
    /// `2^23`: at this size a float holds whole numbers only, which then stand in its lower bits.
    const WHOLE: f32 = 8_388_608.0;
    let level = channel * f32::from(Premultiplied16::PER_BYTE) + WHOLE;
    level.bitcast::<u32x16<S>>() & 0xFFFF
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn many_are_blended_as_each_alone() {
        arbtest::arbtest(|u| {
            let mut channel = || -> arbtest::arbitrary::Result<u16> {
                Ok(match u.int_in_range(0..=3)? {
                    0 => 0,
                    1 => Premultiplied16::ONE,
                    _ => u.int_in_range(0..=Premultiplied16::ONE)?,
                })
            };
            let all_opaque = channel()? == 0;
            let mut color = || -> arbtest::arbitrary::Result<Premultiplied16> {
                let alpha = if all_opaque { Premultiplied16::ONE } else { channel()? };
                Ok(Premultiplied16([
                    channel()?.min(alpha),
                    channel()?.min(alpha),
                    channel()?.min(alpha),
                    alpha,
                ]))
            };
            let above = (0..37).map(|_| color()).collect::<Result<Vec<_>, _>>()?;
            let below = (0..37).map(|_| color()).collect::<Result<Vec<_>, _>>()?;
            for rules in [Rules::Standard, Rules::Course] {
                for mode in BlendMode::ALL {
                    let each: Vec<_> = (above.iter().zip(&below))
                        .map(|(above, below)| mode.blend(*above, *below, rules))
                        .collect();
                    for (name, level) in simd::tested() {
                        let mut all = below.clone();
                        mode.blend_at(level, &above, &mut all, rules);
                        assert_eq!(all, each, "{mode:?} at level {name}");
                    }
                }
            }
            Ok(())
        })
        .budget_ms(600);
    }
}
