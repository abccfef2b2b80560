//! Attribute values in SVG's grammar: lengths, colours, paints, opacities, transforms.
//!
//! `None` means that the text is no such value; whether that is a mere mistake or a number without end is decided by
//! the caller, in one place.

use glam::{DAffine2, DMat2, DVec2};
use svgtypes::{Length, LengthUnit, Paint, PaintFallback, TransformListParser, TransformListToken};

use crate::color::Rgba;

/// What lengths are relative to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Units {
    /// Size of the nearest viewport in user units.
    pub(super) viewport: DVec2,
    /// In user units.
    pub(super) font_size: f64,
}

/// Along what a percentage is taken.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Along {
    /// Of the viewport's width.
    X,
    /// Of the viewport's height.
    Y,
    /// Of the viewport's diagonal divided by the root of two.
    Diagonal,
}

/// What fills or strokes a shape.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum SvgPaint {
    /// Nothing.
    None,
    /// The `color` property.
    CurrentColor,
    /// This.
    Color(Rgba),
}

impl Units {
    /// A length in user units.
    pub(super) fn resolve(self, length: Length, along: Along) -> f64 {
        const PIXELS_PER_INCH: f64 = 96.0;
        let n = length.number;
        match length.unit {
            LengthUnit::None | LengthUnit::Px => n,
            LengthUnit::Em => n * self.font_size,
            LengthUnit::Ex => n * self.font_size / 2.0,
            LengthUnit::In => n * PIXELS_PER_INCH,
            LengthUnit::Cm => n * PIXELS_PER_INCH / 2.54,
            LengthUnit::Mm => n * PIXELS_PER_INCH / 25.4,
            LengthUnit::Pt => n * PIXELS_PER_INCH / 72.0,
            LengthUnit::Pc => n * PIXELS_PER_INCH / 6.0,
            LengthUnit::Percent => {
                n / 100.0
                    * match along {
                        Along::X => self.viewport.x,
                        Along::Y => self.viewport.y,
                        Along::Diagonal => self.viewport.length() / std::f64::consts::SQRT_2,
                    }
            }
        }
    }

    /// A length as text in user units.
    pub(super) fn length(self, text: &str, along: Along) -> Option<f64> {
        let length: Length = text.trim().parse().ok()?;
        Some(self.resolve(length, along)).filter(|length| length.abs() <= f64::from(f32::MAX))
    }
}

/// An opacity as number or percentage, clamped to `0.0..=1.0`.
pub(super) fn opacity(text: &str) -> Option<f32> {
    let text = text.trim();
    let (number, scale) = match text.strip_suffix('%') {
        Some(percent) => (percent, 0.01),
        None => (text, 1.0),
    };
    let number: svgtypes::Number = number.parse().ok()?;
    #[expect(clippy::cast_possible_truncation, reason = "clamped to 0..=1 first")]
    Some((number.0 * scale).clamp(0.0, 1.0) as f32)
}

/// A colour with its own opacity.
pub(super) fn color(text: &str) -> Option<Rgba> {
    text.trim().parse().ok().map(rgba)
}

fn rgba(color: svgtypes::Color) -> Rgba {
    Rgba::from_bytes([color.red, color.green, color.blue, color.alpha])
}

/// A paint, and whether it points to a gradient or pattern whose fallback is taken instead.
pub(super) fn paint(text: &str) -> Option<(SvgPaint, bool)> {
    let paint = match Paint::from_str(text).ok()? {
        Paint::None => SvgPaint::None,
        Paint::CurrentColor => SvgPaint::CurrentColor,
        Paint::Color(color) => SvgPaint::Color(rgba(color)),
        Paint::FuncIRI(_, fallback) => {
            let fallback = match fallback {
                None | Some(PaintFallback::None) => SvgPaint::None,
                Some(PaintFallback::CurrentColor) => SvgPaint::CurrentColor,
                Some(PaintFallback::Color(color)) => SvgPaint::Color(rgba(color)),
            };
            return Some((fallback, true));
        }
        Paint::ContextFill | Paint::ContextStroke => return Some((SvgPaint::None, true)),
        Paint::Inherit => return None,
    };
    Some((paint, false))
}

/// A list of transforms, the first outermost.
pub(super) fn transform(text: &str) -> Option<DAffine2> {
    let mut product = DAffine2::IDENTITY;
    for token in TransformListParser::from(text) {
        product *= match token.ok()? {
            TransformListToken::Matrix { a, b, c, d, e, f } => {
                DAffine2::from_cols(DVec2::new(a, b), DVec2::new(c, d), DVec2::new(e, f))
            }
            TransformListToken::Translate { tx, ty } => DAffine2::from_translation(DVec2::new(tx, ty)),
            TransformListToken::Scale { sx, sy } => DAffine2::from_scale(DVec2::new(sx, sy)),
            TransformListToken::Rotate { angle } => DAffine2::from_angle(angle.to_radians()),
            TransformListToken::SkewX { angle } => skew(DVec2::new(angle.to_radians().tan(), 0.0)),
            TransformListToken::SkewY { angle } => skew(DVec2::new(0.0, angle.to_radians().tan())),
        };
    }
    Some(product).filter(DAffine2::is_finite)
}

/// `x += shear.x * y`, `y += shear.y * x`.
fn skew(shear: DVec2) -> DAffine2 {
    DAffine2::from_mat2(DMat2::from_cols(DVec2::new(1.0, shear.y), DVec2::new(shear.x, 1.0)))
}

#[cfg(test)]
mod tests {
    use super::*;

    const UNITS: Units = Units {
        viewport: DVec2::new(300.0, 400.0),
        font_size: 10.0,
    };

    #[test]
    fn length_every_unit() {
        for (text, expected) in [
            ("7", 7.0),
            (" 7px ", 7.0),
            ("1in", 96.0),
            ("2.54cm", 96.0),
            ("25.4mm", 96.0),
            ("72pt", 96.0),
            ("6pc", 96.0),
            ("3em", 30.0),
            ("3ex", 15.0),
            ("-50%", -150.0),
        ] {
            let found = UNITS.length(text, Along::X).expect(text);
            assert!((found - expected).abs() < 1e-9, "{text}: {found}");
        }
        assert_eq!(UNITS.length("50%", Along::Y), Some(200.0), "of the height");
        let diagonal = UNITS.length("100%", Along::Diagonal).expect("a length");
        assert!(
            (diagonal - 500.0 / 2.0_f64.sqrt()).abs() < 1e-9,
            "of the diagonal: {diagonal}"
        );
        for text in ["", "px", "1e400", "1e39", "nan", "7 7", "7furlong"] {
            assert_eq!(UNITS.length(text, Along::X), None, "{text:?}");
        }
    }

    #[test]
    fn paint_every_form() {
        let red = SvgPaint::Color(Rgba::opaque(1.0, 0.0, 0.0));
        for text in [
            "red",
            "#f00",
            "#ff0000",
            "rgb(255,0,0)",
            "rgb(100%, 0%, 0%)",
            "hsl(0, 100%, 50%)",
            "RED",
        ] {
            assert_eq!(paint(text), Some((red, false)), "{text}");
        }
        assert_eq!(paint("none"), Some((SvgPaint::None, false)), "none");
        assert_eq!(
            paint("currentColor"),
            Some((SvgPaint::CurrentColor, false)),
            "currentColor"
        );
        assert_eq!(paint("url(#a)"), Some((SvgPaint::None, true)), "a gradient");
        assert_eq!(paint("url(#a) red"), Some((red, true)), "a gradient with fallback");
        assert_eq!(paint("no colour"), None, "nonsense");
    }

    #[test]
    fn opacity_clamped() {
        for (text, expected) in [("0.5", 0.5), ("50%", 0.5), ("2", 1.0), ("-1", 0.0), (" 1 ", 1.0)] {
            assert_eq!(opacity(text), Some(expected), "{text}");
        }
        assert_eq!(opacity("half"), None, "nonsense");
    }

    #[test]
    fn transform_first_is_outermost() {
        for (text, expected) in [
            ("translate(10 0) scale(2)", [12.0, 4.0]),
            ("scale(2),translate(10,0)", [22.0, 4.0]),
            ("rotate(90)", [-2.0, 1.0]),
            ("rotate(90, 1, 1)", [0.0, 1.0]),
            ("matrix(1 2 3 4 5 6)", [12.0, 16.0]),
            ("skewX(45)", [3.0, 2.0]),
            ("skewY(45)", [1.0, 3.0]),
        ] {
            let found = transform(text).expect(text).transform_point2(DVec2::new(1.0, 2.0));
            assert!(found.abs_diff_eq(DVec2::from(expected), 1e-12), "{text}: {found}");
        }
        assert_eq!(transform("spin(3)"), None, "unknown");
        assert_eq!(transform("scale(1e400)"), None, "not finite");
    }
}
