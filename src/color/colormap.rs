//! Numbers to colours that people with any kind of colour vision tell apart.

/// A map from numbers to colours.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Colormap {
    /// From 0, nearly black, to 1, nearly white, ever lighter: matplotlib's "magma" by N. J. Smith and S. van der Walt
    /// (2015, CC0), every 16th of its colours.
    Sequential,
    /// From -1, dark blue, over 0, nearly white, to 1, dark orange, ever darker on both sides: C. Brewer's schemes
    /// "`RdBu`" for the lower half and "`PuOr`" for the upper (colorbrewer2.org), both of them meant for colour-blind
    /// readers, while the red and green halves that these lose are left out.
    Diverging,
}

const SEQUENTIAL: [[u8; 3]; 17] = [
    [0, 0, 4],
    [10, 8, 34],
    [29, 17, 71],
    [54, 16, 107],
    [81, 18, 124],
    [106, 28, 129],
    [131, 38, 129],
    [156, 46, 127],
    [183, 55, 121],
    [207, 64, 112],
    [229, 80, 100],
    [244, 105, 92],
    [251, 135, 97],
    [254, 165, 113],
    [254, 194, 135],
    [253, 224, 161],
    [252, 253, 191],
];

const DIVERGING: [[u8; 3]; 11] = [
    [5, 48, 97],
    [33, 102, 172],
    [67, 147, 195],
    [146, 197, 222],
    [209, 229, 240],
    [247, 247, 247],
    [254, 224, 182],
    [253, 184, 99],
    [224, 130, 20],
    [179, 88, 6],
    [127, 59, 8],
];

impl Colormap {
    /// The colour of `value` as opaque `0xAARRGGBB`; values beyond the ends take the colour of the end. The colours
    /// that the map is made of are mixed linearly in stored values.
    pub fn color(self, value: f32) -> u32 {
        let (colors, position): (&[[u8; 3]], f32) = match self {
            Self::Sequential => (&SEQUENTIAL, value),
            Self::Diverging => (&DIVERGING, value.midpoint(1.0)),
        };
        let last = colors.len() - 1;
        let position = position.clamp(0.0, 1.0) * last as f32;
        let index = (0..last).rev().find(|index| *index as f32 <= position).unwrap_or(0);
        let fraction = position - index as f32;
        let mixed: [u8; 3] = std::array::from_fn(|i| {
            let (from, to) = (f32::from(colors[index][i]), f32::from(colors[index + 1][i]));
            super::unit_to_byte((from + (to - from) * fraction) / 255.0, crate::rules::Rules::Standard)
        });
        u32::from_be_bytes([0xFF, mixed[0], mixed[1], mixed[2]])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Linear sRGB of what people without one kind of cone see: G. M. Machado, M. M. Oliveira, L. A. F. Fernandes,
    /// "A Physiologically-based Model for Simulation of Color Vision Deficiency", 2009, severity 1.
    const PROTANOPIA: [[f32; 3]; 3] = [
        [0.152_286, 1.052_583, -0.204_868],
        [0.114_503, 0.786_281, 0.099_216],
        [-0.003_882, -0.048_116, 1.051_998],
    ];
    const DEUTERANOPIA: [[f32; 3]; 3] = [
        [0.367_322, 0.860_646, -0.227_968],
        [0.280_085, 0.672_501, 0.047_413],
        [-0.011_820, 0.042_940, 0.968_881],
    ];
    const TRITANOPIA: [[f32; 3]; 3] = [
        [1.255_528, -0.076_749, -0.178_779],
        [-0.078_411, 0.930_809, 0.147_602],
        [0.004_733, 0.691_367, 0.303_900],
    ];
    const NORMAL: [[f32; 3]; 3] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];

    /// Lightness and two opponent colours of a pixel, after B. Ottosson's "Oklab", 2020, as `matrix` lets them be seen.
    fn seen(pixel: u32, matrix: &[[f32; 3]; 3]) -> [f32; 3] {
        let [_, r, g, b] = pixel.to_be_bytes();
        let linear = [r, g, b].map(|byte| {
            let stored = f32::from(byte) / 255.0;
            if stored <= 0.04045 {
                stored / 12.92
            } else {
                ((stored + 0.055) / 1.055).powf(2.4)
            }
        });
        let times =
            |matrix: &[[f32; 3]; 3], v: [f32; 3]| matrix.map(|row| row.iter().zip(v).map(|(m, v)| m * v).sum::<f32>());
        let seen = times(matrix, linear).map(|v| v.clamp(0.0, 1.0));
        let cones = [
            [0.412_221_46, 0.536_332_55, 0.051_445_995],
            [0.211_903_5, 0.680_699_5, 0.107_396_96],
            [0.088_302_46, 0.281_718_85, 0.629_978_7],
        ];
        let lab = [
            [0.210_454_26, 0.793_617_8, -0.004_072_047],
            [1.977_998_5, -2.428_592_2, 0.450_593_7],
            [0.025_904_037, 0.782_771_77, -0.808_675_77],
        ];
        times(&lab, times(&cones, seen).map(f32::cbrt))
    }

    #[test]
    fn colormap_ends_and_centre() {
        assert_eq!(Colormap::Sequential.color(0.0), 0xFF00_0004, "zero");
        assert_eq!(Colormap::Sequential.color(1.0), 0xFFFC_FDBF, "one");
        assert_eq!(Colormap::Sequential.color(7.0), 0xFFFC_FDBF, "beyond");
        assert_eq!(Colormap::Diverging.color(0.0), 0xFFF7_F7F7, "neutral");
        assert_eq!(Colormap::Diverging.color(-1.0), 0xFF05_3061, "the lower end");
        assert_eq!(Colormap::Diverging.color(1.0), 0xFF7F_3B08, "the upper end");
        assert_eq!(Colormap::Diverging.color(f32::INFINITY), 0xFF7F_3B08, "infinite");
        // Half-way between (0, 0, 4) and (10, 8, 34).
        assert_eq!(Colormap::Sequential.color(1.0 / 32.0), 0xFF05_0413, "mixed");
    }

    #[test]
    fn colormap_orders_by_lightness_for_every_eye() {
        for matrix in [&NORMAL, &PROTANOPIA, &DEUTERANOPIA, &TRITANOPIA] {
            let lightness = |map: Colormap, value| seen(map.color(value), matrix)[0];
            for step in 0..64_u8 {
                let (near, far) = (f32::from(step) / 64.0, f32::from(step + 1) / 64.0);
                assert!(
                    lightness(Colormap::Sequential, far) > lightness(Colormap::Sequential, near),
                    "lighter from {near} to {far} as seen by {matrix:?}"
                );
                for sign in [-1.0, 1.0] {
                    assert!(
                        lightness(Colormap::Diverging, sign * far) < lightness(Colormap::Diverging, sign * near),
                        "darker from {near} to {far} on side {sign} as seen by {matrix:?}"
                    );
                }
            }
        }
    }

    #[test]
    fn colormap_tells_signs_apart_for_every_eye() {
        for matrix in [&NORMAL, &PROTANOPIA, &DEUTERANOPIA, &TRITANOPIA] {
            for step in 1..=10_u8 {
                let value = f32::from(step) / 10.0;
                let [below, above] = [-value, value].map(|value| seen(Colormap::Diverging.color(value), matrix));
                let apart = below
                    .iter()
                    .zip(above)
                    .map(|(a, b)| (a - b).powi(2))
                    .sum::<f32>()
                    .sqrt();
                assert!(apart > 0.025, "+-{value} are {apart} apart as seen by {matrix:?}");
            }
        }
    }
}
