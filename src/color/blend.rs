//! The blend modes of "Compositing and Blending Level 1" (W3C, 2024), sections 10 and 5.
//!
//! ```text
//!      result = above * (1 - alpha below) + below * (1 - alpha above) + alpha above * alpha below * B(below, above)
//! ```
//!
//! where `above` and `below` are premultiplied, and `B` gets straight colours.

use super::Premultiplied16;
use crate::rules::Rules;

/// How the colours of a layer and of what is below it are mixed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum BlendMode {
    /// The upper colour alone: source over.
    #[default]
    Normal,
    /// Their product: never lighter than either.
    Multiply,
    /// The product of their complements, complemented: never darker than either.
    Screen,
    /// Multiplied where the lower colour is dark, screened where it is light.
    Overlay,
    /// The darker one of each channel.
    Darken,
    /// The lighter one of each channel.
    Lighten,
    /// The lower colour brightened by the upper one.
    ColorDodge,
    /// The lower colour darkened by the upper one.
    ColorBurn,
    /// Multiplied where the upper colour is dark, screened where it is light.
    HardLight,
    /// Darkened or lightened softly, by the upper colour.
    SoftLight,
    /// How far they are apart.
    Difference,
    /// As difference, with less contrast.
    Exclusion,
    /// The hue of the upper colour, saturation and luminosity of the lower one.
    Hue,
    /// The saturation of the upper colour, hue and luminosity of the lower one.
    Saturation,
    /// Hue and saturation of the upper colour, luminosity of the lower one.
    Color,
    /// The luminosity of the upper colour, hue and saturation of the lower one.
    Luminosity,
}

impl BlendMode {
    /// All of them, in the order of the specification.
    pub const ALL: [Self; 16] = [
        Self::Normal,
        Self::Multiply,
        Self::Screen,
        Self::Overlay,
        Self::Darken,
        Self::Lighten,
        Self::ColorDodge,
        Self::ColorBurn,
        Self::HardLight,
        Self::SoftLight,
        Self::Difference,
        Self::Exclusion,
        Self::Hue,
        Self::Saturation,
        Self::Color,
        Self::Luminosity,
    ];

    /// The name that it has in CSS.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Normal => "normal",
            Self::Multiply => "multiply",
            Self::Screen => "screen",
            Self::Overlay => "overlay",
            Self::Darken => "darken",
            Self::Lighten => "lighten",
            Self::ColorDodge => "color-dodge",
            Self::ColorBurn => "color-burn",
            Self::HardLight => "hard-light",
            Self::SoftLight => "soft-light",
            Self::Difference => "difference",
            Self::Exclusion => "exclusion",
            Self::Hue => "hue",
            Self::Saturation => "saturation",
            Self::Color => "color",
            Self::Luminosity => "luminosity",
        }
    }

    /// What the mode makes of one channel of the lower and the upper colour, both straight, in words; of all three for the
    /// last four modes.
    pub const fn formula(self) -> &'static str {
        match self {
            Self::Normal => "above",
            Self::Multiply => "below * above",
            Self::Screen => "below + above - below * above",
            Self::Overlay => "2 * below * above, or screen of 2 * below - 1 and above where below > 1/2",
            Self::Darken => "min(below, above)",
            Self::Lighten => "max(below, above)",
            Self::ColorDodge => "min(1, below / (1 - above)); 0 where below is 0, else 1 where above is 1",
            Self::ColorBurn => "1 - min(1, (1 - below) / above); 1 where below is 1, else 0 where above is 0",
            Self::HardLight => "2 * below * above, or screen of below and 2 * above - 1 where above > 1/2",
            Self::SoftLight => {
                "below - (1 - 2 * above) * below * (1 - below), or below + (2 * above - 1) * (d - below) where above > 1/2, \
                 with d = sqrt(below), or ((16 * below - 12) * below + 4) * below where below <= 1/4"
            }
            Self::Difference => "|below - above|",
            Self::Exclusion => "below + above - 2 * below * above",
            Self::Hue => {
                "hue of above (a grey stays grey), saturation and luminosity of below; luminosity is 0.3 red + 0.59 green + \
                 0.11 blue, and what leaves 0 to 1 is drawn towards it"
            }
            Self::Saturation => {
                "saturation of above, hue (a grey stays grey) and luminosity of below; luminosity is 0.3 red + 0.59 green + \
                 0.11 blue, and what leaves 0 to 1 is drawn towards it"
            }
            Self::Color => {
                "hue and saturation of above, luminosity of below: 0.3 red + 0.59 green + 0.11 blue; what leaves 0 to 1 is drawn \
                 towards it"
            }
            Self::Luminosity => {
                "luminosity of above, 0.3 red + 0.59 green + 0.11 blue, hue and saturation of below; what leaves 0 to 1 is drawn \
                 towards it"
            }
        }
    }

    /// A colour of a layer blended with what is below it.
    #[must_use]
    pub fn blend(self, above: Premultiplied16, below: Premultiplied16, rules: Rules) -> Premultiplied16 {
        if self == Self::Normal || above.0[3] == 0 || below.0[3] == 0 {
            return above.over(below, rules);
        }
        let levels = [above, below].map(|color| color.0.map(f32::from));
        let [above, below] = levels.map(|[r, g, b, a]| [r / a, g / a, b / a]);
        let mixed = self.mixed(below, above);
        let one = f32::from(Premultiplied16::ONE);
        let [upper, lower] = levels.map(|color| color.map(|level| level / one));
        let (upper_alpha, lower_alpha) = (upper[3], lower[3]);
        let channel = |i: usize| {
            upper[i] * (1.0 - lower_alpha) + lower[i] * (1.0 - upper_alpha) + upper_alpha * lower_alpha * mixed[i]
        };
        let alpha = upper_alpha + lower_alpha - upper_alpha * lower_alpha;
        let [r, g, b] = [0, 1, 2].map(|i| channel(i).clamp(0.0, alpha) * 255.0);
        Premultiplied16::from_byte_range([r, g, b, alpha.clamp(0.0, 1.0) * 255.0], rules)
    }

    /// `B(below, above)` of straight colours.
    pub fn mixed(self, below: [f32; 3], above: [f32; 3]) -> [f32; 3] {
        match self {
            Self::Hue => with_luminosity(with_saturation(above, saturation(below)), luminosity(below)),
            Self::Saturation => with_luminosity(with_saturation(below, saturation(above)), luminosity(below)),
            Self::Color => with_luminosity(above, luminosity(below)),
            Self::Luminosity => with_luminosity(below, luminosity(above)),
            _ => [0, 1, 2].map(|i| self.channel(below[i], above[i])),
        }
    }

    fn channel(self, below: f32, above: f32) -> f32 {
        match self {
            Self::Multiply => below * above,
            Self::Screen => screen(below, above),
            Self::Overlay => hard_light(above, below),
            Self::Darken => below.min(above),
            Self::Lighten => below.max(above),
            Self::ColorDodge if below <= 0.0 => 0.0,
            Self::ColorDodge if above >= 1.0 => 1.0,
            Self::ColorDodge => (below / (1.0 - above)).min(1.0),
            Self::ColorBurn if below >= 1.0 => 1.0,
            Self::ColorBurn if above <= 0.0 => 0.0,
            Self::ColorBurn => 1.0 - ((1.0 - below) / above).min(1.0),
            Self::HardLight => hard_light(below, above),
            Self::SoftLight => soft_light(below, above),
            Self::Difference => (below - above).abs(),
            Self::Exclusion => below + above - 2.0 * below * above,
            Self::Normal | Self::Hue | Self::Saturation | Self::Color | Self::Luminosity => above,
        }
    }
}

fn screen(below: f32, above: f32) -> f32 {
    below + above - below * above
}

fn hard_light(below: f32, above: f32) -> f32 {
    if above <= 0.5 {
        below * 2.0 * above
    } else {
        screen(below, 2.0 * above - 1.0)
    }
}

fn soft_light(below: f32, above: f32) -> f32 {
    if above <= 0.5 {
        return below - (1.0 - 2.0 * above) * below * (1.0 - below);
    }
    let lighter = if below <= 0.25 {
        ((16.0 * below - 12.0) * below + 4.0) * below
    } else {
        below.sqrt()
    };
    below + (2.0 * above - 1.0) * (lighter - below)
}

/// `Lum` of the specification.
fn luminosity([r, g, b]: [f32; 3]) -> f32 {
    0.3 * r + 0.59 * g + 0.11 * b
}

/// `Sat` of the specification.
fn saturation([r, g, b]: [f32; 3]) -> f32 {
    r.max(g).max(b) - r.min(g).min(b)
}

/// `SetLum` and `ClipColor` of the specification.
fn with_luminosity(color: [f32; 3], wanted: f32) -> [f32; 3] {
    let change = wanted - luminosity(color);
    let moved = color.map(|channel| channel + change);
    let lightness = luminosity(moved);
    let lowest = moved[0].min(moved[1]).min(moved[2]);
    let highest = moved[0].max(moved[1]).max(moved[2]);
    let mut clipped = moved;
    if lowest < 0.0 {
        clipped = clipped.map(|channel| lightness + (channel - lightness) * lightness / (lightness - lowest));
    }
    if highest > 1.0 {
        clipped = clipped.map(|channel| lightness + (channel - lightness) * (1.0 - lightness) / (highest - lightness));
    }
    clipped
}

/// `SetSat` of the specification: the channels spread over `0.0..=wanted`, in their order.
fn with_saturation(color: [f32; 3], wanted: f32) -> [f32; 3] {
    let lowest = color[0].min(color[1]).min(color[2]);
    let range = saturation(color);
    if range <= 0.0 {
        return [0.0; 3];
    }
    color.map(|channel| (channel - lowest) * wanted / range)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn bytes(color: [u8; 4]) -> Premultiplied16 {
        Premultiplied16::from_bytes(color)
    }

    /// The worked values were computed by hand from the formulas of the specification.
    #[test]
    fn opaque_colours_blend_as_the_specification_says() {
        let (below, above) = ([0.8, 0.4, 0.2], [0.5, 1.0, 0.1]);
        for (mode, expected) in [
            (BlendMode::Normal, [0.5, 1.0, 0.1]),
            (BlendMode::Multiply, [0.4, 0.4, 0.02]),
            (BlendMode::Screen, [0.9, 1.0, 0.28]),
            (BlendMode::Overlay, [0.8, 0.8, 0.04]),
            (BlendMode::Darken, [0.5, 0.4, 0.1]),
            (BlendMode::Lighten, [0.8, 1.0, 0.2]),
            (BlendMode::ColorDodge, [1.0, 1.0, 0.222_222]),
            (BlendMode::ColorBurn, [0.6, 0.4, 0.0]),
            (BlendMode::HardLight, [0.8, 1.0, 0.04]),
            (BlendMode::SoftLight, [0.8, 0.632_456, 0.072]),
            (BlendMode::Difference, [0.3, 0.6, 0.1]),
            (BlendMode::Exclusion, [0.5, 0.6, 0.26]),
            // Lum below = 0.498, Lum above = 0.751; Sat below = 0.6, Sat above = 0.9.
            // Both are moved by the difference of Lum, 0.253, and clipped: towards Lum by 0.249 / 0.302 and 0.498 / 0.651.
            (BlendMode::Luminosity, [1.0, 0.670_199, 0.505_298]),
            (BlendMode::Color, [0.305_991, 0.688_479, 0.0]),
        ] {
            let mixed = mode.mixed(below, above);
            for i in 0..3 {
                let error = (mixed[i] - expected[i]).abs();
                assert!(error < 1e-4, "{mode:?}: {mixed:?}, not {expected:?}");
            }
        }
    }

    #[test]
    fn modes_of_hue_keep_what_they_promise() {
        let (below, above) = ([0.7, 0.4, 0.3], [0.2, 0.5, 0.6]);
        for mode in [BlendMode::Hue, BlendMode::Saturation, BlendMode::Color] {
            let mixed = mode.mixed(below, above);
            assert!(
                (luminosity(mixed) - luminosity(below)).abs() < 1e-5,
                "{mode:?} keeps the luminosity of what is below"
            );
        }
        let mixed = BlendMode::Luminosity.mixed(below, above);
        assert!(
            (luminosity(mixed) - luminosity(above)).abs() < 1e-5,
            "that of what is above"
        );
        let saturated = BlendMode::Saturation.mixed(below, above);
        assert!(
            (saturation(saturated) - saturation(above)).abs() < 1e-5,
            "its saturation"
        );
        assert!(
            with_saturation([0.3; 3], 0.5) <= [0.0; 3],
            "grey has no hue to saturate"
        );
    }

    #[test]
    fn where_only_one_is_there_it_stays() {
        let color = bytes([128, 64, 0, 128]);
        for mode in BlendMode::ALL {
            let nothing = Premultiplied16::TRANSPARENT;
            assert_eq!(
                mode.blend(color, nothing, Rules::Standard),
                color,
                "{mode:?} over nothing"
            );
            assert_eq!(
                mode.blend(nothing, color, Rules::Standard),
                color,
                "{mode:?} nothing over it"
            );
        }
    }

    #[test]
    fn half_a_layer_is_half_blended() {
        let white = bytes([255; 4]);
        let half_black = bytes([0, 0, 0, 128]);
        let product = BlendMode::Multiply.blend(half_black, white, Rules::Standard);
        assert_eq!(
            product,
            half_black.over(white, Rules::Standard),
            "black multiplies to black"
        );
        let black = bytes([0, 0, 0, 255]);
        let screened = BlendMode::Screen.blend(half_black, white, Rules::Standard);
        assert_eq!(screened, white, "black screens nothing");
        assert_eq!(BlendMode::Screen.blend(white, black, Rules::Standard), white);
    }
}
