//! Colours as CSS Color 4 writes them, in the notations that SVG's own grammar of colours lacks.

use crate::color::{ColorSpace, Rgba};
use crate::rules::Rules;

/// Names of functions that [`plain`] knows.
pub(super) const FUNCTIONS: [&str; 8] = ["oklch", "oklab", "lch", "lab", "color", "hsl", "hsla", "hwb"];

/// Words that mean a colour, and what SVG's readers know in their place.
pub(super) const WORDS: [(&str, &str); 2] = [("currentcolor", "currentColor"), ("rebeccapurple", "#663399")];

/// A colour function as SVG's readers know it; `None` where they know it themselves, and where it is none.
pub(super) fn plain(name: &str, arguments: &str) -> Option<String> {
    let (channels, opacity) = match arguments.split_once('/') {
        Some((channels, opacity)) => (channels, number(opacity.trim(), 1.0)?),
        None => (arguments, 1.0),
    };
    let parts: Vec<&str> = channels.split_ascii_whitespace().collect();
    if matches!(name, "hsl" | "hsla" | "hwb") {
        return without_none(name, &parts, opacity);
    }
    let color = match (name, parts.as_slice()) {
        ("lab", [l, a, b]) => ColorSpace::Lab.color([number(l, 100.0)?, number(a, 125.0)?, number(b, 125.0)?]),
        ("oklab", [l, a, b]) => ColorSpace::Oklab.color([number(l, 1.0)?, number(a, 0.4)?, number(b, 0.4)?]),
        ("lch", [l, chroma, hue]) => {
            let [a, b] = polar(number(chroma, 150.0)?, degrees(hue)?);
            ColorSpace::Lab.color([number(l, 100.0)?, a, b])
        }
        ("oklch", [l, chroma, hue]) => {
            let [a, b] = polar(number(chroma, 0.4)?, degrees(hue)?);
            ColorSpace::Oklab.color([number(l, 1.0)?, a, b])
        }
        ("color", [space, channels @ ..]) => {
            let [r, g, b] = channels.first_chunk().filter(|all| all.len() == channels.len())?;
            space_named(space)?.color([number(r, 1.0)?, number(g, 1.0)?, number(b, 1.0)?])
        }
        _ => return None,
    };
    Some(hexadecimal(color, opacity))
}

/// A colour as SVG writes it, in as few characters as it can be.
pub(super) fn shortest(color: &str) -> Option<String> {
    let color: svgtypes::Color = color.trim().parse().ok()?;
    let [r, g, b, a] = [color.red, color.green, color.blue, color.alpha].map(|byte| format!("{byte:02x}"));
    let all = if a == "ff" { vec![r, g, b] } else { vec![r, g, b, a] };
    let is_short = all.iter().all(|byte| byte[..1] == byte[1..]);
    let digits = all
        .into_iter()
        .map(|byte| if is_short { byte[1..].to_owned() } else { byte });
    Some(digits.fold("#".to_owned(), |hex, digits| hex + &digits))
}

/// In any case: among words of SVG, the first one stands as `sRGB`.
fn space_named(name: &str) -> Option<ColorSpace> {
    match name.to_ascii_lowercase().as_str() {
        "srgb" => Some(ColorSpace::Srgb),
        "srgb-linear" => Some(ColorSpace::SrgbLinear),
        "display-p3" => Some(ColorSpace::DisplayP3),
        _ => None,
    }
}

/// Components that are `none` count as zero.
fn without_none(name: &str, parts: &[&str], opacity: f64) -> Option<String> {
    let [hue, second, third] = parts else {
        return None;
    };
    if ![hue, second, third].into_iter().any(|part| *part == "none") {
        return None;
    }
    let hue = degrees(hue)?;
    let [second, third] = [number(second, 100.0)?, number(third, 100.0)?];
    let name = name.trim_end_matches('a');
    // As short as it can be: it takes the place of what is there.
    let all = format!("{name}({hue} {second}% {third}%");
    Some(if opacity < 1.0 {
        format!("{all}/{opacity})")
    } else {
        all + ")"
    })
}

/// A number or a percentage of `whole`; `none` is zero.
fn number(text: &str, whole: f64) -> Option<f64> {
    let value = match text.strip_suffix('%') {
        Some(percents) => percents.parse::<f64>().ok()? / 100.0 * whole,
        None if text == "none" => 0.0,
        None => text.parse().ok()?,
    };
    Some(value).filter(|value| value.is_finite())
}

/// An angle in degrees.
fn degrees(text: &str) -> Option<f64> {
    // `grad` before `rad`, which ends it.
    let units = [
        ("deg", 1.0),
        ("grad", 0.9),
        ("rad", 180.0 / std::f64::consts::PI),
        ("turn", 360.0),
    ];
    let unit = units
        .into_iter()
        .find_map(|(unit, degrees)| Some((text.strip_suffix(unit)?, degrees)));
    let (value, degrees) = unit.unwrap_or((text, 1.0));
    Some(number(value, f64::NAN)? * degrees)
}

fn polar(chroma: f64, degrees: f64) -> [f64; 2] {
    let (sine, cosine) = degrees.to_radians().sin_cos();
    [chroma.max(0.0) * cosine, chroma.max(0.0) * sine]
}

/// `#rrggbb`, or `#rrggbbaa` where it is translucent.
#[expect(clippy::cast_possible_truncation, reason = "opacity, to single floats")]
fn hexadecimal(color: Rgba, opacity: f64) -> String {
    let [r, g, b, a] = color.faded(opacity.clamp(0.0, 1.0) as f32).to_bytes(Rules::Standard);
    let opaque = format!("#{r:02x}{g:02x}{b:02x}");
    if a == u8::MAX {
        opaque
    } else {
        format!("{opaque}{a:02x}")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn colors_are_written_short() {
        for (color, expected) in [
            ("rgb(255, 0, 0)", Some("#f00")),
            (" Red ", Some("#f00")),
            ("rgba(1, 2, 3, 0.5)", Some("#01020380")),
            ("hsl(0 100% 50% / 0)", Some("#f000")),
            ("url(#a)", None),
        ] {
            assert_eq!(shortest(color).as_deref(), expected, "{color}");
        }
    }

    #[test]
    fn functions_become_bytes() {
        for (name, arguments, expected) in [
            ("oklch", "51.975% 0.17686 142.495", Some("#008000")),
            ("oklch", "0.51975 .17686 142.495deg / 50%", Some("#00800080")),
            ("oklab", "0 none none", Some("#000000")),
            ("lab", "46.277% -47.552 48.586", Some("#008000")),
            ("lch", "46.277 67.982 134.378", Some("#008000")),
            ("lch", "46.277 67.982 0.373272turn", Some("#008000")),
            ("color", "srgb 1 0.5 0", Some("#ff8000")),
            ("color", "srgb 100% 50% 0% / .5", Some("#ff800080")),
            ("color", "display-p3 1 1 1", Some("#ffffff")),
            ("color", "rec2020 1 1 1", None),
            ("color", "srgb 1 1", None),
            ("color", "srgb 1 1 1 1", None),
            ("lab", "from red l a b", None),
            ("lab", "inf 0 0", None),
            ("hsl", "120 50% 50%", None),
            ("hsl", "none 50% 50%", Some("hsl(0 50% 50%)")),
            ("hwb", "120deg none 20% / 0.5", Some("hwb(120 0% 20%/0.5)")),
        ] {
            assert_eq!(plain(name, arguments).as_deref(), expected, "{name}({arguments})");
        }
    }
}
