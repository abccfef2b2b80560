//! How bright a colour counts: the luma of ITU-R BT.601, `0.299 R + 0.587 G + 0.114 B` of stored values.

use super::gaussian::single;

/// What red, green and blue count.
const WEIGHTS: [f64; 3] = [0.299, 0.587, 0.114];
/// The same as floats of 32 bits.
const SINGLE: [f32; 3] = [single(WEIGHTS[0]), single(WEIGHTS[1]), single(WEIGHTS[2])];

/// The luma of an opaque colour, in levels of 0 to 255.
#[inline]
pub(super) fn luma(color: [u8; 3]) -> f64 {
    let [r, g, b] = color.map(f64::from);
    WEIGHTS[0] * r + WEIGHTS[1] * g + WEIGHTS[2] * b
}

/// The same in floats of 32 bits.
#[inline]
pub fn single_luma(color: [u8; 3]) -> f32 {
    let [r, g, b] = color.map(f32::from);
    SINGLE[0] * r + SINGLE[1] * g + SINGLE[2] * b
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn luma_is_that_of_the_recommendation() {
        for (color, expected) in [
            ([0, 0, 0], 0.0),
            ([255, 0, 0], 76.245),
            ([0, 255, 0], 149.685),
            ([0, 0, 255], 29.07),
            ([255, 255, 255], 255.0),
        ] {
            assert!((luma(color) - expected).abs() < 1e-9, "{color:?}");
            assert!((f64::from(single_luma(color)) - expected).abs() < 1e-4, "{color:?}");
        }
        // Marks are black or white by it: their bytes hang on the last bit.
        let bits = |weights: [f32; 3]| weights.map(f32::to_bits);
        assert_eq!(bits(SINGLE), bits([0.299, 0.587, 0.114]), "rounded once");
    }
}
