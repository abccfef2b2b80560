//! Sums of stored samples to pixels, with what all pixels share prepared.

use fearless_simd::{Simd, dispatch};

use super::Premultiplied16;
use crate::rules::Rules;
use crate::simd;

/// Resolves the sums of a fixed number of samples; as [`Premultiplied16::resolve`], with the division prepared.
#[derive(Clone, Copy, Debug)]
pub struct Resolver {
    count: u32,
    rules: Rules,
    /// What opaque samples sum up to.
    opaque: u32,
    half: u32,
    /// Where the number of samples is a power of two, dividing is shifting.
    shift: Option<u32>,
}

impl Resolver {
    /// For `count` samples per pixel.
    pub fn new(count: u32, rules: Rules) -> Self {
        let full = u32::from(Premultiplied16::PER_BYTE) * count;
        Self {
            count,
            rules,
            opaque: u32::from(Premultiplied16::ONE) * count,
            half: match rules {
                Rules::Standard | Rules::Float => full / 2,
                Rules::Course => 0,
            },
            shift: full.is_power_of_two().then(|| full.trailing_zeros()),
        }
    }

    /// Samples per pixel.
    pub fn count(&self) -> u32 {
        self.count
    }

    /// What is added to the sums of opaque samples before they are shifted.
    pub fn half(&self) -> u32 {
        self.half
    }

    /// By how much sums of opaque samples are shifted to become bytes, where their number allows that.
    pub fn shift(&self) -> Option<u32> {
        self.shift
    }

    /// As [`Resolver::pixel`] for sums in pairs: red and green, blue and alpha, the former in the lower 32 bits of each.
    #[inline(always)]
    #[expect(clippy::inline_always, reason = "a dozen instructions for every pixel on an edge")]
    #[expect(clippy::cast_possible_truncation, reason = "halves of numbers")]
    pub fn pixel_of_halves(&self, [red_green, blue_alpha]: [u64; 2]) -> u32 {
        match self.shift {
            Some(shift) if (blue_alpha >> 32) == u64::from(self.opaque) => {
                // Neither half of a number overflows, and no mean exceeds 255.
                let half = u64::from(self.half);
                let red_green = (red_green + (half | half << 32)) >> shift;
                let blue = (blue_alpha + half) >> shift & 0xFF;
                let green_red = (red_green & 0xFF) << 16 | red_green >> 32 << 8 & 0xFF00;
                0xFF00_0000 | (green_red | blue) as u32
            }
            _ => {
                let [low, high] = [red_green, blue_alpha].map(|sums| sums as u32);
                self.pixel([low, (red_green >> 32) as u32, high, (blue_alpha >> 32) as u32])
            }
        }
    }

    /// [`Resolver::pixel`] of as many sums as there are pixels.
    pub fn pixels(&self, sums: &[[u32; 4]], pixels: &mut [u32]) {
        dispatch!(simd::level(), simd => self.pixels_with(simd, sums, pixels));
    }

    #[inline(always)]
    #[expect(clippy::inline_always, reason = "vector instructions reach inlined code only")]
    fn pixels_with<S: Simd>(&self, _: S, sums: &[[u32; 4]], pixels: &mut [u32]) {
        let mut differ = 0;
        for [_, _, _, alpha] in sums {
            differ |= alpha ^ self.opaque;
        }
        if let Some(shift) = self.shift
            && differ == 0
        {
            // Without a branch, so that it becomes vector code.
            for (pixel, [r, g, b, _]) in pixels.iter_mut().zip(sums) {
                let byte = |sum: u32| ((sum + self.half) >> shift).min(255);
                *pixel = 0xFF00_0000 | byte(*r) << 16 | byte(*g) << 8 | byte(*b);
            }
            return;
        }
        for (pixel, sum) in pixels.iter_mut().zip(sums) {
            *pixel = self.pixel(*sum);
        }
    }

    /// The straight 8-bit pixel `0xAARRGGBB` that is the mean of samples with these channel sums.
    #[inline]
    pub fn pixel(&self, sums: [u32; 4]) -> u32 {
        let [r, g, b, a] = sums;
        match self.shift {
            Some(shift) if a == self.opaque => {
                // No sum exceeds that of opaque white, so that no mean exceeds 255.
                let byte = |sum: u32| ((sum + self.half) >> shift).min(255);
                0xFF00_0000 | byte(r) << 16 | byte(g) << 8 | byte(b)
            }
            _ => Premultiplied16::resolve(sums, self.count, self.rules),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pixels_side_by_side_are_those_of_one_by_one() {
        arbtest::arbtest(|u| {
            let rules = *u.choose(&Rules::ALL)?;
            let count = *u.choose(&[1_u32, 4, 9, 16, 64, 256])?;
            let opaque: bool = u.arbitrary()?;
            let mut channel = |most| u.int_in_range(0..=most);
            let full = count * u32::from(Premultiplied16::ONE);
            let sums: Vec<[u32; 4]> = (0..37)
                .map(|_| {
                    let alpha = if opaque { full } else { channel(full)? };
                    Ok([channel(alpha)?, channel(alpha)?, channel(alpha)?, alpha])
                })
                .collect::<arbtest::arbitrary::Result<_>>()?;
            let resolver = Resolver::new(count, rules);
            let expected: Vec<u32> = sums.iter().map(|sum| resolver.pixel(*sum)).collect();
            for (name, level) in simd::tested() {
                let mut found = vec![0; sums.len()];
                dispatch!(level, simd => resolver.pixels_with(simd, &sums, &mut found));
                assert_eq!(found, expected, "{name}: {count} samples, {rules:?}");
            }
            Ok(())
        })
        .budget_ms(100);
    }

    #[test]
    fn resolver_resolves_as_the_plain_division() {
        arbtest::arbtest(|u| {
            let side = u.int_in_range(1..=16_u32)?;
            let count = side * side;
            let opaque = u32::from(Premultiplied16::ONE) * count;
            let alpha = if u.arbitrary()? {
                opaque
            } else {
                u.int_in_range(0..=opaque)?
            };
            let mut channel = || u.int_in_range(0..=alpha);
            let sums = [channel()?, channel()?, channel()?, alpha];
            for rules in Rules::ALL {
                assert_eq!(
                    Resolver::new(count, rules).pixel(sums),
                    Premultiplied16::resolve(sums, count, rules),
                    "{sums:?} of {count} samples, {rules:?}"
                );
            }
            Ok(())
        })
        .budget_ms(100);
    }
}
