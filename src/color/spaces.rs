//! Colours of other spaces as sRGB, by the conversions of CSS Color 4. What sRGB lacks is cut off channel by channel, as browsers
//! do.

use super::{Rgba, linear_to_srgb};

/// A space in which a colour may be given by three numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ColorSpace {
    /// sRGB, encoded.
    Srgb,
    /// Linear light of sRGB's primaries.
    SrgbLinear,
    /// Display P3, encoded as sRGB is.
    DisplayP3,
    /// CIE L\*a\*b\* under D50: lightness up to 100.
    Lab,
    /// Oklab: lightness up to 1.
    Oklab,
}

/// Linear light of sRGB from that of Display P3.
const FROM_P3: [[f64; 3]; 3] = [
    [1.224_940_2, -0.224_940_2, 0.0],
    [-0.042_057_0, 1.042_057_0, 0.0],
    [-0.019_637_6, -0.078_636_1, 1.098_273_5],
];
/// Linear light of sRGB from CIE XYZ under D50.
const FROM_XYZ: [[f64; 3]; 3] = [
    [3.134_135_96, -1.617_386_33, -0.490_661_95],
    [-0.978_795_50, 1.916_254_57, 0.033_442_73],
    [0.071_955_38, -0.228_976_83, 1.405_386_06],
];
/// The white of D50 in XYZ.
const WHITE: [f64; 3] = [0.964_295_68, 1.0, 0.825_104_6];
/// Cube roots of Oklab's cones, and linear light of sRGB from them (Ottosson, 2020).
const ROOTS: [[f64; 3]; 3] = [
    [1.0, 0.396_337_777_4, 0.215_803_757_3],
    [1.0, -0.105_561_345_8, -0.063_854_172_8],
    [1.0, -0.089_484_177_5, -1.291_485_548_0],
];
const FROM_CONES: [[f64; 3]; 3] = [
    [4.076_741_662_1, -3.307_711_591_3, 0.230_969_929_2],
    [-1.268_438_004_6, 2.609_757_401_1, -0.341_319_396_5],
    [-0.004_196_086_3, -0.703_418_614_7, 1.707_614_701_0],
];

impl ColorSpace {
    /// The colour at a place of the space.
    #[expect(clippy::cast_possible_truncation, reason = "channels of a colour, to single floats")]
    pub fn color(self, at: [f64; 3]) -> Rgba {
        let light = match self {
            Self::Srgb => {
                let [r, g, b] = at.map(|channel| channel.clamp(0.0, 1.0) as f32);
                return Rgba::opaque(r, g, b);
            }
            Self::SrgbLinear => at,
            // The transfer function is sRGB's own.
            Self::DisplayP3 => times(FROM_P3, at.map(decoded)),
            Self::Lab => {
                let y = (at[0] + 16.0) / 116.0;
                let [x, y, z] = [y + at[1] / 500.0, y, y - at[2] / 200.0].map(from_root);
                times(FROM_XYZ, [x * WHITE[0], y * WHITE[1], z * WHITE[2]])
            }
            Self::Oklab => times(FROM_CONES, times(ROOTS, at).map(|root| root.powi(3))),
        };
        let [r, g, b] = light.map(|channel| linear_to_srgb(channel.clamp(0.0, 1.0) as f32).clamp(0.0, 1.0));
        Rgba::opaque(r, g, b)
    }
}

/// Linear light of an encoded channel, in which differences below a byte count.
fn decoded(stored: f64) -> f64 {
    if stored <= 0.040_45 {
        stored / 12.92
    } else {
        ((stored + 0.055) / 1.055).powf(2.4)
    }
}

/// What L\*a\*b\* takes about the cube root of.
fn from_root(root: f64) -> f64 {
    let cube = root.powi(3);
    if cube > 216.0 / 24_389.0 {
        cube
    } else {
        (116.0 * root - 16.0) * 27.0 / 24_389.0
    }
}

fn times(matrix: [[f64; 3]; 3], [x, y, z]: [f64; 3]) -> [f64; 3] {
    matrix.map(|[a, b, c]| a * x + b * y + c * z)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rules::Rules;

    #[test]
    fn colors_are_those_of_css_color_4() {
        use ColorSpace::{DisplayP3, Lab, Oklab, Srgb, SrgbLinear};
        for (space, at, expected) in [
            (Srgb, [1.0, 0.5, 2.0], [255, 128, 255]),
            (SrgbLinear, [0.0, 0.214_041_14, 1.0], [0, 128, 255]),
            (DisplayP3, [1.0, 1.0, 1.0], [255, 255, 255]),
            (DisplayP3, [0.4, 0.4, 0.4], [102, 102, 102]),
            // The green of sRGB.
            (DisplayP3, [0.216_04, 0.494_18, 0.131_51], [0, 128, 0]),
            (Lab, [46.277, -47.552, 48.586], [0, 128, 0]),
            (Lab, [100.0, 0.0, 0.0], [255, 255, 255]),
            (Lab, [0.0, 0.0, 0.0], [0, 0, 0]),
            (Oklab, [0.519_75, -0.140_3, 0.107_68], [0, 128, 0]),
            (Oklab, [0.627_96, 0.224_86, 0.125_85], [255, 0, 0]),
            (Oklab, [1.0, 0.0, 0.0], [255, 255, 255]),
        ] {
            let [r, g, b, _] = space.color(at).to_bytes(Rules::Standard);
            assert_eq!([r, g, b], expected, "{space:?} {at:?}");
        }
    }
}
