//! Transforms as CSS writes them, in the words of SVG's attribute: units of lengths and angles, and functions for one axis.

use std::fmt::Write as _;

use glam::{DAffine2, DVec2};
use svgtypes::{Length, LengthUnit};

use super::values;

/// A list of transforms as an attribute has it, in user units and degrees; `None` where it is not understood.
///
/// What SVG's own grammar understands stays as it is (CSS Transforms 1, section 8: a unit may be missing there).
pub(super) fn plain(css: &str) -> Option<String> {
    let css = css.trim();
    if css == "none" {
        return Some("translate(0)".to_owned());
    }
    if values::transform(css).is_some() {
        return Some(css.to_owned());
    }
    let mut plain = String::new();
    let mut rest = css;
    while !rest.is_empty() {
        let (name, after) = rest.split_once('(')?;
        let (arguments, after) = after.split_once(')')?;
        let arguments: Vec<&str> = arguments.split(',').map(str::trim).collect();
        let name = name.trim();
        let separator = if plain.is_empty() { "" } else { " " };
        let write = |plain: &mut String, function: &str, numbers: &[f64]| {
            let numbers: Vec<String> = numbers.iter().map(f64::to_string).collect();
            write!(plain, "{separator}{function}({})", numbers.join(" ")).ok()
        };
        match (name, arguments.as_slice()) {
            ("translate" | "translateX", [x]) => write(&mut plain, "translate", &[length(x)?])?,
            ("translate", [x, y]) => write(&mut plain, "translate", &[length(x)?, length(y)?])?,
            ("translateY", [y]) => write(&mut plain, "translate", &[0.0, length(y)?])?,
            ("scale", [both]) => write(&mut plain, "scale", &[number(both)?])?,
            ("scale", [x, y]) => write(&mut plain, "scale", &[number(x)?, number(y)?])?,
            ("scaleX", [x]) => write(&mut plain, "scale", &[number(x)?, 1.0])?,
            ("scaleY", [y]) => write(&mut plain, "scale", &[1.0, number(y)?])?,
            ("rotate" | "rotateZ", [angle]) => write(&mut plain, "rotate", &[degrees(angle)?])?,
            ("skewX" | "skew", [angle]) => write(&mut plain, "skewX", &[degrees(angle)?])?,
            ("skewY", [angle]) => write(&mut plain, "skewY", &[degrees(angle)?])?,
            ("matrix", numbers) if numbers.len() == 6 => {
                let numbers: Option<Vec<f64>> = numbers.iter().map(|text| number(text)).collect();
                write(&mut plain, "matrix", &numbers?)?;
            }
            _ => return None,
        }
        rest = after.trim_start();
    }
    values::transform(&plain).map(|_| plain)
}

fn number(text: &str) -> Option<f64> {
    let number = match text.strip_suffix('%') {
        Some(percent) => percent.parse::<f64>().ok()? / 100.0,
        None => text.parse().ok()?,
    };
    Some(number).filter(|number: &f64| number.is_finite())
}

/// A length that needs nothing else to be known, in user units.
fn length(text: &str) -> Option<f64> {
    let Length { number, unit } = text.parse().ok()?;
    let units = match unit {
        LengthUnit::None | LengthUnit::Px => 1.0,
        LengthUnit::In => 96.0,
        LengthUnit::Cm => 96.0 / 2.54,
        LengthUnit::Mm => 96.0 / 25.4,
        LengthUnit::Pt => 96.0 / 72.0,
        LengthUnit::Pc => 16.0,
        LengthUnit::Em | LengthUnit::Ex | LengthUnit::Percent => return None,
    };
    Some(number * units)
}

fn degrees(text: &str) -> Option<f64> {
    let units = [
        ("deg", 1.0),
        ("grad", 0.9),
        ("turn", 360.0),
        ("rad", 180.0 / std::f64::consts::PI),
    ];
    let unit = units
        .into_iter()
        .find_map(|(unit, degrees)| Some((text.strip_suffix(unit)?, degrees)));
    let (text, degrees) = unit.unwrap_or((text, 1.0));
    number(text.trim()).map(|number| number * degrees)
}

/// Whether no coordinate up to `reach` is moved beyond the range of 32-bit floats.
pub(super) fn is_within_floats(to_root: DAffine2, reach: f64) -> bool {
    let [x, y] = [to_root.matrix2.x_axis.abs(), to_root.matrix2.y_axis.abs()];
    let furthest = (x + y) * reach + to_root.translation.abs();
    // What is not a number is beyond it, too.
    furthest.cmple(DVec2::splat(f64::from(f32::MAX))).all()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn transforms_of_styles_are_those_of_attributes() {
        for (css, expected) in [
            ("translate(10,20)", "translate(10,20)"),
            ("translate(50px, 5mm)", "translate(50 18.897637795275593)"),
            ("translateX(2in) translateY(-3px)", "translate(192) translate(0 -3)"),
            ("rotate(45deg) scaleX(2)", "rotate(45) scale(2 1)"),
            ("rotate(0.25turn)", "rotate(90)"),
            ("rotate(100grad) scale(50%, 2)", "rotate(90) scale(0.5 2)"),
            ("skew(10deg) skewY(0)", "skewX(10) skewY(0)"),
            (
                "matrix(1, 0, 0, 1, 5, 6) translate(1px)",
                "matrix(1 0 0 1 5 6) translate(1)",
            ),
            ("none", "translate(0)"),
        ] {
            assert_eq!(plain(css).as_deref(), Some(expected), "{css}");
        }
        for css in [
            "translate(50%)",
            "translate(1em)",
            "rotate3d(1,1,1,45deg)",
            "scale()",
            "rotate(",
            "x",
            "rotate(1e999deg)",
        ] {
            assert_eq!(plain(css), None, "{css}");
        }
    }
}
