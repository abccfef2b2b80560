//! Roots and powers of many numbers at once, to a few units in the last place of a float. The same bits on every machine: nothing
//! here depends on vectors' widths, and nothing is fused.

#![expect(
    clippy::inline_always,
    reason = "only what is inlined into a dispatched function is compiled for its vector instructions"
)]

use std::f32::consts::{FRAC_1_SQRT_2, LN_2};

use fearless_simd::prelude::*;
use fearless_simd::{Simd, f32x16, i32x16};

/// Bits of a float's fraction, below those of its exponent.
const FRACTION_BITS: u32 = 23;
/// What is added to an exponent.
const BIAS: i32 = 127;

/// The cube roots of normal numbers above zero: a guess from a third of the exponent (W. Kahan, "Computing a real cube root", 1991),
/// then Halley's method, which triples the digits that are right.
#[inline(always)]
pub(super) fn cube_root<S: Simd>(simd: S, numbers: f32x16<S>) -> f32x16<S> {
    /// Two thirds of the bias, less what makes the largest error of the guess least.
    const OFFSET: i32 = 0x2A51_4067;
    let bits: i32x16<S> = numbers.bitcast();
    let third = bits.to_float::<f32x16<S>>() * (1.0 / 3.0);
    let mut root: f32x16<S> = (third.to_int::<i32x16<S>>() + i32x16::splat(simd, OFFSET)).bitcast();
    for _ in 0..2 {
        let cube = root * root * root;
        root = root * (cube + numbers + numbers) / (cube + cube + numbers);
    }
    root
}

/// Numbers from zero on to the power of others, neither large: the logarithm as a series of the inverse hyperbolic tangent, the
/// exponential as its own. What comes out below the least normal number is that number; `0` to the power of `0` is 1.
#[inline(always)]
pub(super) fn power<S: Simd>(simd: S, numbers: f32x16<S>, exponents: f32x16<S>) -> f32x16<S> {
    exp2(simd, log2(simd, numbers) * exponents)
}

/// Logarithms to the base 2 of numbers from zero on; that of zero is -127.
#[inline(always)]
fn log2<S: Simd>(simd: S, numbers: f32x16<S>) -> f32x16<S> {
    let bits: i32x16<S> = numbers.bitcast();
    // The part that is no power of two lies around 1, from the root of a half on.
    let around = i32x16::splat(simd, FRAC_1_SQRT_2.to_bits().cast_signed());
    let exponent = (bits - around) >> FRACTION_BITS;
    let part: f32x16<S> = (bits - (exponent << FRACTION_BITS)).bitcast();
    let s = (part - 1.0) / (part + 1.0);
    let square = s * s;
    let mut sum = f32x16::splat(simd, 2.0 / (9.0 * LN_2));
    for degree in [7.0, 5.0, 3.0, 1.0] {
        sum = sum * square + 2.0 / (degree * LN_2);
    }
    exponent.to_float::<f32x16<S>>() + s * sum
}

/// Powers of 2, of normal numbers only.
#[inline(always)]
fn exp2<S: Simd>(simd: S, exponents: f32x16<S>) -> f32x16<S> {
    let least = f32x16::splat(simd, -126.0);
    let exponents = exponents.max(least).min(f32x16::splat(simd, 126.0));
    let whole = (exponents + 0.5).floor();
    let x = (exponents - whole) * LN_2;
    let mut sum = f32x16::splat(simd, 1.0);
    for divisor in [7.0, 6.0, 5.0, 4.0, 3.0, 2.0, 1.0] {
        sum = sum * x * (1.0 / divisor) + 1.0;
    }
    let scale: f32x16<S> = ((whole.to_int::<i32x16<S>>() + i32x16::splat(simd, BIAS)) << FRACTION_BITS).bitcast();
    sum * scale
}

#[cfg(test)]
mod tests {
    use fearless_simd::dispatch;

    use super::*;
    use crate::simd;

    /// Numbers from 1e-6 to 1e4, and 0.
    fn numbers() -> Vec<[f32; 16]> {
        let number = |i: u16| {
            if i == 0 {
                0.0
            } else {
                1e-6 * (f32::from(i) * 0.0231).exp()
            }
        };
        let numbers: Vec<f32> = (0..1008).map(number).collect();
        numbers.as_chunks().0.to_vec()
    }

    #[test]
    fn cube_roots_have_all_digits_of_a_float() {
        for numbers in &numbers()[1..] {
            for (name, level) in simd::tested() {
                let roots = dispatch!(level, simd => {
                    let mut roots = [0.0; 16];
                    cube_root(simd, f32x16::load_array_ref(simd, numbers)).store_array(&mut roots);
                    roots
                });
                for (number, root) in numbers.iter().zip(roots) {
                    let expected = f64::from(*number).cbrt();
                    let error = (f64::from(root) / expected - 1.0).abs();
                    assert!(error < 3e-7, "{name}: {root} is not the cube root of {number}");
                }
            }
        }
    }

    #[test]
    fn powers_are_right_to_a_few_units_in_the_last_place() {
        for numbers in numbers() {
            for exponent in [0.7_f32, 0.013, 0.5, 1.0, 0.0] {
                let mut first = None;
                for (name, level) in simd::tested() {
                    let powers = dispatch!(level, simd => {
                        let mut powers = [0.0; 16];
                        let exponents = f32x16::splat(simd, exponent);
                        power(simd, f32x16::load_array_ref(simd, &numbers), exponents).store_array(&mut powers);
                        powers
                    });
                    for (number, power) in numbers.iter().zip(powers) {
                        let expected = f64::from(*number).powf(f64::from(exponent));
                        let error = f64::from(power) - expected;
                        let near = error.abs() <= 2e-6 * expected || (*number == 0.0 && power < 1.0);
                        assert!(
                            near,
                            "{name}: {number} to the power of {exponent} is {expected}, not {power}"
                        );
                    }
                    let bits = powers.map(f32::to_bits);
                    assert_eq!(*first.get_or_insert(bits), bits, "{name}: the same on every level");
                }
            }
        }
    }
}
