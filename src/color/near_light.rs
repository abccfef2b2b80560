//! The mean light of opaque samples in vectors: by a polynomial, so near that it tells nearly every pixel.
//!
//! Light is a power of stored values, and a look into a table for each channel of each sample takes longer than all else. A
//! polynomial of the sixth degree is never farther from it than [`LIGHT_OFF`], and another one of the fourth root of light leads
//! back to bytes. Only where that leaves open which byte the mean light is, somebody has to look into the table:
//!
//! ```text
//!     byte 118         byte 119        byte 120
//!   |- - - - - - - -|- -[==]- - - - -|- - - - - -[=|=]-    the mean light, but for what the polynomial is off
//!                     certain                 open
//! ```

#![expect(
    clippy::inline_always,
    reason = "a function that is not inlined into its dispatch loses the vector instructions"
)]

use fearless_simd::prelude::*;
use fearless_simd::{Simd, f32x16, i32x16, mask32x16, u16x16, u32x16};

use super::{LightResolver, Premultiplied16};
use crate::rules::Rules;

/// Pixels that are found together.
const LANES: usize = 16;

/// Where the straight part of the curve ends, in bytes.
const BEND: f32 = 0.040_45 * 255.0;
/// Light of the straight part, over bytes.
const STRAIGHT: f32 = 1.0 / (12.92 * 255.0);
/// Beyond, light by powers of bytes, the highest first: the polynomial of this degree that is nearest where it is farthest.
const POWERS: [f32; 7] = [
    -2.023_056_3e-16,
    2.132_164_6e-13,
    -1.037_350_5e-10,
    4.339_242e-8,
    7.853_628e-6,
    1.303_764_3e-4,
    9.095_838e-4,
];
/// Light is that near at least, in parts of all light.
pub(super) const LIGHT_OFF: f32 = 5.9e-6;
/// What a sum of 32-bit floats loses with each term, in parts of all light, and then some.
const SUM_OFF: f32 = 1.3e-7;

/// Beyond the straight part, bytes by powers of the fourth root of light, the highest first, and how near these are, in bytes.
const ROOTS: [f32; 7] = [
    17.393_177,
    -81.196_77,
    167.584_3,
    -217.505_34,
    348.310_46,
    35.598_915,
    -15.184_372,
];
const BYTES_OFF: f32 = 5e-4;
/// What bytes rise by with light is that times its power -7/12.
const SLOPE: f32 = 255.0 * 1.055 / 2.4;

/// [`POWERS`] of what is stored. Of a power of two no bit is lost: light is the same as from bytes.
const STORED_POWERS: [f32; 7] = {
    let (mut powers, mut scale, mut i) = (POWERS, 1.0, POWERS.len());
    while i > 0 {
        i -= 1;
        powers[i] *= scale;
        scale /= PER_BYTE;
    }
    powers
};
const PER_BYTE: f32 = Premultiplied16::PER_BYTE as f32;

/// The light of stored values, in parts of all light; `bytes` are `0.0..=255.0`.
#[inline(always)]
pub(crate) fn near_light<S: Simd>(simd: S, bytes: f32x16<S>) -> f32x16<S> {
    curve(simd, bytes, &POWERS, [BEND, STRAIGHT])
}

/// The same of values in the units of [`Premultiplied16`].
#[inline(always)]
pub(crate) fn near_light_of_stored<S: Simd>(simd: S, stored: f32x16<S>) -> f32x16<S> {
    curve(simd, stored, &STORED_POWERS, [BEND * PER_BYTE, STRAIGHT / PER_BYTE])
}

#[inline(always)]
fn curve<S: Simd>(simd: S, values: f32x16<S>, powers: &[f32; 7], [bend, straight]: [f32; 2]) -> f32x16<S> {
    let mut light = f32x16::splat(simd, powers[0]);
    for power in &powers[1..] {
        light = light.mul_add(values, f32x16::splat(simd, *power));
    }
    let is_straight = values.simd_le(f32x16::splat(simd, bend));
    is_straight.select(values * straight, light)
}

/// The stored values of such light, in bytes, and how far they may be off where light is `off` by so much.
#[inline(always)]
fn near_bytes<S: Simd>(simd: S, light: f32x16<S>, off: f32x16<S>) -> [f32x16<S>; 2] {
    let root = light.sqrt();
    let fourth = root.sqrt();
    let mut bytes = f32x16::splat(simd, ROOTS[0]);
    for factor in &ROOTS[1..] {
        bytes = bytes.mul_add(fourth, f32x16::splat(simd, *factor));
    }
    // The curve's slope is a power of light, -7/12: at most the weighted mean of the powers -1/2 and -3/4.
    let slope = (fourth * 2.0 + 1.0) * (SLOPE / 3.0) / (root * fourth);
    let is_straight = light.simd_le(f32x16::splat(simd, BEND * STRAIGHT));
    let straight = f32x16::splat(simd, 1.0 / STRAIGHT);
    [
        is_straight.select(light * straight, bytes),
        is_straight.select(straight, slope) * off + BYTES_OFF,
    ]
}

/// The bytes of light that may be off by so much, and which of them are certain; from this part on a byte is rounded up, and that much
/// less.
#[inline(always)]
pub(crate) fn certain_bytes_of_light<S: Simd>(
    simd: S,
    light: f32x16<S>,
    off: f32x16<S>,
    rounded: f32,
) -> (i32x16<S>, mask32x16<S>) {
    let [bytes, off] = near_bytes(simd, light, off);
    certain_bytes(simd, bytes + rounded, off)
}

/// The whole parts of bytes that may be off by so much, and which of them are certain.
#[inline(always)]
pub(crate) fn certain_bytes<S: Simd>(simd: S, bytes: f32x16<S>, off: f32x16<S>) -> (i32x16<S>, mask32x16<S>) {
    let (low, high) = (
        (bytes - off).max(f32x16::splat(simd, 0.0)).floor(),
        (bytes + off).floor(),
    );
    (low.to_int(), low.simd_eq(high))
}

/// Makes pixels of sums of [`near_light`].
#[derive(Clone, Copy, Debug)]
pub(crate) struct NearLight<'r> {
    resolver: &'r LightResolver,
    per_sample: f32,
    /// How far a mean may be off.
    off: f32,
    /// From which part of a byte on it is rounded up, and that much less.
    rounded: f32,
}

impl<'r> NearLight<'r> {
    /// For as many samples as the resolver takes.
    pub(crate) fn new(resolver: &'r LightResolver) -> Self {
        let count = resolver.count() as f32;
        Self {
            resolver,
            per_sample: 1.0 / count,
            off: LIGHT_OFF + SUM_OFF * count,
            rounded: match resolver.rules() {
                Rules::Standard | Rules::Float => 0.5,
                Rules::Course => 0.0,
            },
        }
    }

    /// The same of sums of light that is known but for how floats are rounded.
    pub(crate) fn of_exact(resolver: &'r LightResolver) -> Self {
        let near = Self::new(resolver);
        Self {
            off: near.off - LIGHT_OFF,
            ..near
        }
    }

    /// What tells pixels of such a light exactly.
    pub(crate) fn resolver(&self) -> &'r LightResolver {
        self.resolver
    }

    /// The bytes of such sums of light, and which of them are certain.
    #[inline(always)]
    fn bytes<S: Simd>(&self, simd: S, sums: f32x16<S>) -> (i32x16<S>, mask32x16<S>) {
        certain_bytes_of_light(
            simd,
            sums * self.per_sample,
            f32x16::splat(simd, self.off),
            self.rounded,
        )
    }

    /// The pixels `0xAARRGGBB` of so much red, green and blue light in all of their samples, and a bit for each pixel of which that is
    /// certain.
    #[inline(always)]
    pub(crate) fn pixels<S: Simd>(&self, simd: S, [red, green, blue]: [f32x16<S>; 3]) -> (u32x16<S>, u64) {
        let (red, is_red) = self.bytes(simd, red);
        let (green, is_green) = self.bytes(simd, green);
        let (blue, is_blue) = self.bytes(simd, blue);
        let opaque = i32x16::splat(simd, 0xFF << 24);
        let pixels = opaque | red << 16 | green << 8 | blue;
        (pixels.bitcast(), (is_red & is_green & is_blue).to_bitmask())
    }

    /// Finds pixels of opaque samples, of which each has as many as the resolver takes.
    #[inline(always)]
    pub(super) fn of_samples<S: Simd>(&self, simd: S, samples: &[Premultiplied16], pixels: &mut [u32]) {
        let count = self.resolver.count() as usize;
        for (samples, pixels) in samples.chunks(count * LANES).zip(pixels.chunks_mut(LANES)) {
            let mut sums = [[0.0; LANES]; 3];
            for (lane, samples) in samples.chunks_exact(count).enumerate() {
                let sum = Self::sum(simd, samples);
                for (sums, sum) in sums.iter_mut().zip(sum) {
                    sums[lane % LANES] = sum;
                }
            }
            let [red, green, blue] = sums;
            let sums = [
                f32x16::simd_from(simd, red),
                f32x16::simd_from(simd, green),
                f32x16::simd_from(simd, blue),
            ];
            let (found, certain) = self.pixels(simd, sums);
            let found = found.to_array();
            for (lane, (pixel, samples)) in pixels.iter_mut().zip(samples.chunks_exact(count)).enumerate() {
                *pixel = if certain >> lane & 1 == 1 {
                    found[lane % LANES]
                } else {
                    self.resolver.opaque_mean(samples)
                };
            }
        }
    }

    /// The light of each channel of some opaque samples, summed up.
    #[inline(always)]
    fn sum<S: Simd>(simd: S, samples: &[Premultiplied16]) -> [f32; 4] {
        let mut sum = f32x16::splat(simd, 0.0);
        let (fours, rest) = samples.as_chunks::<4>();
        for four in fours {
            sum += light_of_four(simd, *four);
        }
        if !rest.is_empty() {
            // Black adds nothing.
            let mut four = [Premultiplied16::TRANSPARENT; 4];
            four[..rest.len()].copy_from_slice(rest);
            sum += light_of_four(simd, four);
        }
        let (low, high) = sum.split();
        let (first, second) = (low + high).split();
        (first + second).to_array()
    }
}

/// The light of each channel of four opaque samples, side by side.
#[inline(always)]
fn light_of_four<S: Simd>(simd: S, samples: [Premultiplied16; 4]) -> f32x16<S> {
    let stored = samples.map(|sample| sample.0);
    let (low, high) = u16x16::from_slice(simd, stored.as_flattened()).widen();
    let stored: i32x16<S> = low.combine(high).bitcast();
    near_light_of_stored(simd, stored.to_float())
}

#[cfg(test)]
mod tests {
    use fearless_simd::dispatch;

    use super::super::Light;
    use super::super::light_scale::whole_light;
    use super::*;
    use crate::rules::Rules;
    use crate::simd;

    /// The pixel of some samples, and whether it is certain.
    #[inline(always)]
    fn first_pixel<S: Simd>(simd: S, near: &NearLight<'_>, samples: &[Premultiplied16]) -> (u32, bool) {
        let [red, green, blue, _] = NearLight::sum(simd, samples);
        let sums = [
            f32x16::splat(simd, red),
            f32x16::splat(simd, green),
            f32x16::splat(simd, blue),
        ];
        let (pixels, certain) = near.pixels(simd, sums);
        (pixels.to_array()[0], certain & 1 == 1)
    }

    #[test]
    fn bytes_are_as_near_as_they_say() {
        for (name, level) in simd::tested() {
            for value in (0..=255_000_u32).step_by(7) {
                let value = f64::from(value) / 1000.0;
                let exact = f64::from(whole_light::<31>(value * 256.0)) / f64::from(1_u32 << 31);
                for off in [-LIGHT_OFF, 0.0, LIGHT_OFF] {
                    let light = moved(exact, off);
                    let [bytes, most] = dispatch!(level, simd => {
                        let [bytes, off] = near_bytes(simd, f32x16::splat(simd, light), f32x16::splat(simd, LIGHT_OFF));
                        [bytes.to_array()[0], off.to_array()[0]]
                    });
                    let is_off = (f64::from(bytes) - value).abs();
                    assert!(is_off <= f64::from(most), "{name}: {value} is {bytes}, off by {is_off}");
                    assert!(most < 0.06, "{name}: {most} for {value}");
                }
            }
        }
    }

    #[expect(clippy::cast_possible_truncation, reason = "the rest is allowed for")]
    fn moved(light: f64, off: f32) -> f32 {
        (light + f64::from(off)).max(0.0) as f32
    }

    #[test]
    fn light_is_as_near_as_it_says() {
        for (name, level) in simd::tested() {
            let mut farthest: f64 = 0.0;
            for first in (0..=Premultiplied16::ONE).step_by(LANES) {
                let stored: [u16; LANES] =
                    std::array::from_fn(|i| (first + u16::try_from(i).expect("small")).min(Premultiplied16::ONE));
                let bytes = stored.map(|stored| f32::from(stored) / 256.0);
                let found = dispatch!(level, simd => near_light(simd, f32x16::simd_from(simd, bytes)).to_array());
                for (stored, found) in stored.into_iter().zip(found) {
                    let exact = f64::from(whole_light::<31>(stored.into())) / f64::from(1_u32 << 31);
                    farthest = farthest.max((f64::from(found) - exact).abs());
                }
            }
            assert!(farthest < f64::from(LIGHT_OFF), "{name}: {farthest}");
            assert!(farthest > f64::from(LIGHT_OFF) * 0.9, "{name}: {farthest} is far less");
        }
    }

    #[test]
    fn pixels_that_are_certain_are_those_of_the_table() {
        let (mut certain, mut all) = (0, 0);
        arbtest::arbtest(|u| {
            let rules = *u.choose(&Rules::ALL)?;
            let count = *u.choose(&[2_u32, 4, 5, 9, 16, 64, 256])?;
            let resolver = LightResolver::new(count, rules);
            // Dark ones, too, where bytes are closest.
            let shift = u.int_in_range(0..=9)?;
            let mut channel = || Ok(u.int_in_range(0..=Premultiplied16::ONE)? >> shift);
            let samples: Vec<_> = (0..count)
                .map(|_| {
                    Ok(Premultiplied16([
                        channel()?,
                        channel()?,
                        channel()?,
                        Premultiplied16::ONE,
                    ]))
                })
                .collect::<arbtest::arbitrary::Result<_>>()?;
            let expected = resolver.opaque_mean(&samples);
            for (name, level) in simd::tested() {
                let near = NearLight::new(&resolver);
                let (found, is_certain) = dispatch!(level, simd => first_pixel(simd, &near, &samples));
                assert!(
                    !is_certain || found == expected,
                    "{name}: {found:x}, not {expected:x} {samples:?}"
                );
                certain += u32::from(is_certain);
                all += 1;
            }
            Ok(())
        })
        .budget_ms(500);
        assert!(certain * 10 > all * 7, "{certain} of {all} were certain");
    }

    #[test]
    fn flat_colours_whose_light_is_exact_are_nearly_always_certain() {
        let (mut certain, mut all) = (0, 0);
        arbtest::arbtest(|u| {
            let rules = *u.choose(&Rules::ALL)?;
            let count = *u.choose(&[2_u32, 5, 16, 64, 256])?;
            let resolver = LightResolver::new(count, rules);
            let shift = u.int_in_range(0..=9)?;
            // Some samples of each colour, until all are taken.
            let (mut exact, mut sum, mut left) = (Light::default(), [0.0_f32; 4], count);
            while left > 0 {
                let mut channel = || Ok(u.int_in_range(0..=Premultiplied16::ONE)? >> shift);
                let color = Premultiplied16([channel()?, channel()?, channel()?, Premultiplied16::ONE]);
                let taken = u.int_in_range(1..=left)?;
                let light = Light::new(color);
                exact += light.times(taken);
                for (sum, light) in sum.iter_mut().zip(light.weighted()) {
                    *sum += light * taken as f32;
                }
                left -= taken;
            }
            let expected = resolver.pixel(exact);
            let near = NearLight::of_exact(&resolver);
            let [red, green, blue, _] = sum;
            for (name, level) in simd::tested() {
                let (found, is_certain) = dispatch!(level, simd => {
                    let sums = [red, green, blue].map(|sum| f32x16::splat(simd, sum));
                    let (pixels, certain) = near.pixels(simd, sums);
                    (pixels.to_array()[0], certain & 1 == 1)
                });
                assert!(!is_certain || found == expected, "{name}: {found:x}, not {expected:x}");
                certain += u32::from(is_certain);
                all += 1;
            }
            Ok(())
        })
        .budget_ms(500);
        assert!(certain * 10 > all * 8, "{certain} of {all} were certain");
    }

    #[test]
    fn samples_that_are_alike_are_certain_and_their_byte() {
        for byte in 0..=255_u8 {
            let sample = Premultiplied16::from_bytes([byte, 255 - byte, 0, 255]);
            for count in [2, 16, 64] {
                let resolver = LightResolver::new(count, Rules::Standard);
                let near = NearLight::new(&resolver);
                let samples = vec![sample; count as usize];
                for (name, level) in simd::tested() {
                    let found = dispatch!(level, simd => first_pixel(simd, &near, &samples));
                    assert_eq!(
                        found,
                        (sample.to_pixel(Rules::Standard), true),
                        "{name}: {count} times {byte}"
                    );
                }
            }
        }
    }
}
