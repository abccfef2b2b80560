//! Source-over of many colours, eight at a time, to the last bit.

#![expect(
    clippy::inline_always,
    reason = "only what is inlined into a dispatched function is compiled for its vector instructions"
)]

use fearless_simd::prelude::*;
use fearless_simd::{Level, Simd, dispatch, u32x16, u64x8};

use super::Premultiplied16;
use crate::rules::Rules;
use crate::simd;

/// Colours that are painted together.
const LANES: usize = 8;

impl Premultiplied16 {
    /// Source-over: this colour painted over `below` (Porter and Duff, "Compositing digital images", 1984). Under the
    /// course's rules the result is truncated to bytes, as its 8-bit store does after every write.
    #[inline]
    #[must_use]
    pub fn over(self, below: Self, rules: Rules) -> Self {
        let rest = u32::from(Self::ONE - self.0[3]);
        let mixed = std::array::from_fn(|i| {
            let sum = u32::from(self.0[i]) + super::div_one(u32::from(below.0[i]) * rest);
            u16::try_from(sum).unwrap_or(Self::ONE).min(Self::ONE)
        });
        match rules {
            Rules::Standard | Rules::Float => Self(mixed),
            Rules::Course => Self(mixed).truncated(),
        }
    }

    /// Paints this colour over many; as [`Premultiplied16::over`] for each.
    #[inline]
    pub fn over_all(self, below: &mut [Self], rules: Rules) {
        if below.len() < LANES {
            for color in below {
                *color = self.over(*color, rules);
            }
        } else {
            self.over_all_at(simd::level(), below, rules);
        }
    }

    fn over_all_at(self, level: Level, below: &mut [Self], rules: Rules) {
        dispatch!(level, simd => one_over_all(simd, self, below, rules));
    }

    /// Paints colours over others, each over one; as [`Premultiplied16::over`] for each, but for opaque ones, which stay as they are.
    #[inline]
    pub fn each_over(above: &[Self], below: &mut [Self], rules: Rules) {
        if below.len() < LANES {
            for (color, above) in below.iter_mut().zip(above) {
                *color = if above.is_opaque() {
                    *above
                } else {
                    above.over(*color, rules)
                };
            }
        } else {
            Self::each_over_at(simd::level(), above, below, rules);
        }
    }

    /// Paints colours over others, each over one, as if each were of `opacity`, of [`Premultiplied16::ONE`]; as
    /// [`Premultiplied16::faded`] and [`Premultiplied16::over`] for each, where nothing is truncated.
    #[inline]
    pub fn each_faded_over(opacity: u16, above: &[Self], below: &mut [Self]) {
        if below.len() < LANES {
            for (color, above) in below.iter_mut().zip(above) {
                *color = above.faded(opacity).over(*color, Rules::Standard);
            }
        } else {
            Self::each_faded_over_at(simd::level(), opacity, above, below);
        }
    }

    fn each_faded_over_at(level: Level, opacity: u16, above: &[Self], below: &mut [Self]) {
        dispatch!(level, simd => each_faded_over_each(simd, opacity, above, below));
    }

    fn each_over_at(level: Level, above: &[Self], below: &mut [Self], rules: Rules) {
        dispatch!(level, simd => each_over_each(simd, above, below, rules));
    }
}

#[inline(always)]
fn one_over_all<S: Simd>(simd: S, above: Premultiplied16, below: &mut [Premultiplied16], rules: Rules) {
    let above = u64x8::splat(simd, above.to_word()).bitcast();
    let (rest, kept) = (rest_of(above), kept(simd, rules));
    let (eights, few) = below.as_chunks_mut();
    for below in eights {
        *below = colors(mixed(above, rest, channels(simd, below), kept));
    }
    if !few.is_empty() {
        let mixed = mixed(above, rest, channels(simd, &eight(few)), kept);
        few.copy_from_slice(&colors(mixed)[..few.len()]);
    }
}

#[inline(always)]
fn each_over_each<S: Simd>(simd: S, above: &[Premultiplied16], below: &mut [Premultiplied16], rules: Rules) {
    let kept = kept(simd, rules);
    let (eights, few) = below.as_chunks_mut();
    let (above, few_above) = above.as_chunks();
    for (above, below) in above.iter().zip(eights) {
        *below = colors(over_each(channels(simd, above), channels(simd, below), kept));
    }
    if !few.is_empty() {
        let above = channels(simd, &eight(few_above));
        let mixed = over_each(above, channels(simd, &eight(few)), kept);
        few.copy_from_slice(&colors(mixed)[..few.len()]);
    }
}

/// Colours over others, opaque ones as they are.
#[inline(always)]
fn over_each<S: Simd>(above: u32x16<S>, below: u32x16<S>, kept: u32x16<S>) -> u32x16<S> {
    let rest = rest_of(above);
    rest.simd_eq(0).select(above, mixed(above, rest, below, kept))
}

#[inline(always)]
fn each_faded_over_each<S: Simd>(simd: S, opacity: u16, above: &[Premultiplied16], below: &mut [Premultiplied16]) {
    let opacity = u32x16::splat(simd, opacity.into());
    let (eights, few) = below.as_chunks_mut();
    let (above, few_above) = above.as_chunks();
    for (above, below) in above.iter().zip(eights) {
        *below = colors(faded_over(opacity, channels(simd, above), channels(simd, below)));
    }
    if !few.is_empty() {
        let above = channels(simd, &eight(few_above));
        let mixed = faded_over(opacity, above, channels(simd, &eight(few)));
        few.copy_from_slice(&colors(mixed)[..few.len()]);
    }
}

/// Colours of this opacity over others.
#[inline(always)]
fn faded_over<S: Simd>(opacity: u32x16<S>, above: u32x16<S>, below: u32x16<S>) -> u32x16<S> {
    let faded = parts(above & 0xFFFF, opacity) | parts(above >> 16, opacity) << 16;
    mixed(faded, rest_of(faded), below, kept(above.simd, Rules::Standard))
}

/// Fewer colours than fit, with transparent ones behind them.
#[inline(always)]
fn eight(few: &[Premultiplied16]) -> [Premultiplied16; LANES] {
    let mut eight = [Premultiplied16::TRANSPARENT; LANES];
    for (one, color) in eight.iter_mut().zip(few) {
        *one = *color;
    }
    eight
}

/// The channels of colours, two in each number, the former of the two in its lower half.
#[inline(always)]
fn channels<S: Simd>(simd: S, colors: &[Premultiplied16; LANES]) -> u32x16<S> {
    let mut words = [0; LANES];
    for (word, color) in words.iter_mut().zip(colors) {
        *word = color.to_word();
    }
    u64x8::simd_from(simd, words).bitcast()
}

/// The colours of such channels.
#[inline(always)]
fn colors<S: Simd>(channels: u32x16<S>) -> [Premultiplied16; LANES] {
    let words = <[u64; LANES]>::from(channels.bitcast::<u64x8<S>>());
    let mut colors = [Premultiplied16::TRANSPARENT; LANES];
    for (color, word) in colors.iter_mut().zip(words) {
        *color = Premultiplied16::from_word(word);
    }
    colors
}

/// How much of what is below shines through each colour, of [`Premultiplied16::ONE`], for both of its pairs of channels.
#[inline(always)]
fn rest_of<S: Simd>(above: u32x16<S>) -> u32x16<S> {
    let alphas = above.bitcast::<u64x8<S>>() >> 48;
    u32x16::splat(above.simd, Premultiplied16::ONE.into()) - (alphas | alphas << 32).bitcast::<u32x16<S>>()
}

/// The bits of a pair of channels that `rules` keep: bytes, where they truncate.
#[inline(always)]
fn kept<S: Simd>(simd: S, rules: Rules) -> u32x16<S> {
    const _: () = assert!(
        Premultiplied16::PER_BYTE == 1 << 8,
        "bytes are the upper halves of channels"
    );
    let bits = match rules {
        Rules::Standard | Rules::Float => u32::MAX,
        Rules::Course => 0xFF00_FF00,
    };
    u32x16::splat(simd, bits)
}

/// Pairs of channels over others.
#[inline(always)]
fn mixed<S: Simd>(above: u32x16<S>, rest: u32x16<S>, below: u32x16<S>, kept: u32x16<S>) -> u32x16<S> {
    let one = u32::from(Premultiplied16::ONE);
    let lower = (above & 0xFFFF) + parts(below & 0xFFFF, rest);
    let upper = (above >> 16) + parts(below >> 16, rest);
    let clamped = |sum: u32x16<S>| sum.min(u32x16::splat(sum.simd, one));
    (clamped(lower) | clamped(upper) << 16) & kept
}

/// Parts `rest` of channels, rounded to nearest: `(channel * rest + ONE / 2) / ONE`, where [`Premultiplied16::ONE`] is 255 times
/// 256.
///
/// Of `256 a + b`, which is `255 a + (a + b)`, the 255th part is `a` and that of `a + b`; which is at most 65 280 here, and of
/// numbers `n` below 65 535 that part is `(n + 1 + n / 256) / 256`.
#[inline(always)]
fn parts<S: Simd>(channel: u32x16<S>, rest: u32x16<S>) -> u32x16<S> {
    let product = (channel * rest + u32::from(Premultiplied16::ONE / 2)) >> 8;
    let high = product >> 8;
    let few = high + (product & 0xFF);
    high + ((few + 1 + (few >> 8)) >> 8)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn many_are_painted_as_each_alone() {
        arbtest::arbtest(|u| {
            let mut color = || -> arbtest::arbitrary::Result<Premultiplied16> {
                let any = u.int_in_range(0..=Premultiplied16::ONE)?;
                let alpha = *u.choose(&[any, any, Premultiplied16::ONE, 0])?;
                let mut channel = || u.int_in_range(0..=alpha);
                Ok(Premultiplied16([channel()?, channel()?, channel()?, alpha]))
            };
            let mut colors = |count: usize| {
                (0..count)
                    .map(|_| color())
                    .collect::<arbtest::arbitrary::Result<Vec<_>>>()
            };
            let (above, below) = (colors(19)?, colors(19)?);
            let opacity = u.int_in_range(0..=Premultiplied16::ONE)?;
            let faded = |(above, below): (&Premultiplied16, &Premultiplied16)| {
                above.faded(opacity).over(*below, Rules::Standard)
            };
            let of_faded: Vec<_> = above.iter().zip(&below).map(faded).collect();
            for rules in Rules::ALL {
                let one = above[0];
                let expected: Vec<_> = below.iter().map(|below| one.over(*below, rules)).collect();
                let each = |(above, below): (&Premultiplied16, &Premultiplied16)| {
                    if above.is_opaque() {
                        *above
                    } else {
                        above.over(*below, rules)
                    }
                };
                let of_each: Vec<_> = above.iter().zip(&below).map(each).collect();
                for (name, level) in simd::tested() {
                    let mut painted = below.clone();
                    one.over_all_at(level, &mut painted, rules);
                    assert_eq!(painted, expected, "{name}: {one:?} over {below:?}, {rules:?}");
                    let mut painted = below.clone();
                    Premultiplied16::each_over_at(level, &above, &mut painted, rules);
                    assert_eq!(painted, of_each, "{name}: {above:?} over {below:?}, {rules:?}");
                    let mut painted = below.clone();
                    Premultiplied16::each_faded_over_at(level, opacity, &above, &mut painted);
                    assert_eq!(painted, of_faded, "{name}: {above:?} at {opacity} over {below:?}");
                }
                for count in [3, 11] {
                    let mut painted = below[..count].to_vec();
                    Premultiplied16::each_faded_over(opacity, &above[..count], &mut painted);
                    assert_eq!(painted, of_faded[..count], "{count} at {opacity}");
                    let mut painted = below[..count].to_vec();
                    one.over_all(&mut painted, rules);
                    assert_eq!(painted, expected[..count], "{count} under one, {rules:?}");
                    let mut painted = below[..count].to_vec();
                    Premultiplied16::each_over(&above[..count], &mut painted, rules);
                    assert_eq!(painted, of_each[..count], "{count} under each, {rules:?}");
                }
            }
            Ok(())
        })
        .budget_ms(300);
    }

    #[test]
    fn parts_are_rounded_as_divisions_round_them() {
        let one = u32::from(Premultiplied16::ONE);
        let channels = [
            0,
            1,
            127,
            128,
            255,
            256,
            257,
            32_639,
            32_640,
            32_641,
            one - 256,
            one - 255,
            one - 1,
            one,
        ];
        let numbers = channels
            .iter()
            .flat_map(|channel| (0..=one).map(move |rest| (*channel, rest)));
        let numbers: Vec<(u32, u32)> = numbers.collect();
        for (name, level) in simd::tested() {
            for sixteen in numbers.as_chunks::<16>().0 {
                let found: [u32; 16] = dispatch!(level, simd => parts(
                    u32x16::simd_from(simd, sixteen.map(|(channel, _)| channel)),
                    u32x16::simd_from(simd, sixteen.map(|(_, rest)| rest)),
                ).into());
                let expected = sixteen.map(|(channel, rest)| super::super::div_one(channel * rest));
                assert_eq!(found, expected, "{name}: {sixteen:?}");
            }
        }
    }
}
