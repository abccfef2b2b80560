//! Colours and transforms in the course's grammar, which takes almost anything for one.

use glam::{DAffine2, DMat2, DVec2};

use super::report::quote;
use super::{Problem, numbers};
use crate::color::Rgba;

/// A colour as the course's reader understands it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct CourseColor {
    /// `0xRRGGBB`.
    pub(super) rgb: u32,
    /// Whether nothing is to be drawn.
    pub(super) none: bool,
    /// Whether SVG reads the same colour.
    pub(super) as_svg: bool,
}

/// Optional `#`, then hexadecimal digits as far as they go, as one number; or `none`.
pub(super) fn color(text: &str) -> CourseColor {
    let text = text.trim();
    let digits = text.strip_prefix('#').unwrap_or(text);
    let value = digits.chars().map_while(|c| c.to_digit(16));
    let rgb = value.fold(0_u64, |sum, digit| {
        (sum * 16 + u64::from(digit)).min(u64::from(u32::MAX))
    });
    let none = text == "none";
    CourseColor {
        rgb: u32::try_from(rgb).unwrap_or(u32::MAX) & 0x00ff_ffff,
        none,
        as_svg: none || digits.len() == 6 && digits.chars().all(|c| c.is_ascii_hexdigit()),
    }
}

impl CourseColor {
    /// Opaque.
    pub(super) fn to_rgba(self) -> Rgba {
        let [_, r, g, b] = self.rgb.to_be_bytes();
        Rgba::from_bytes([r, g, b, 255])
    }
}

/// A list of transforms, the first outermost, and what is to be said of the first one that is not as it should be.
///
/// Arguments are separated by anything and are 32-bit floats; a missing second one of `scale` is 1.
pub(super) fn transform(text: &str) -> Result<(DAffine2, Option<String>), Problem> {
    let mut product = DAffine2::IDENTITY;
    let mut trouble = None;
    let mut rest = text;
    while let Some((before, after)) = rest.split_once('(') {
        let name = before.trim_matches(|c: char| c == ',' || c.is_whitespace());
        let closed = after.split_once(')');
        let (arguments, after) = closed.unwrap_or((after, ""));
        let arguments = numbers::all("transform", arguments)?;
        if let Some(own) = function(name, &arguments) {
            product *= own;
            let is_open = closed.is_none();
            trouble = trouble.or_else(|| miswritten(name, arguments.len(), is_open));
        } else {
            trouble = trouble.or_else(|| {
                Some(format!(
                    "the transform \"{}\" is unknown and has no effect",
                    quote(name)
                ))
            });
        }
        rest = after;
    }
    if trouble.is_none() && rest.contains(char::is_alphanumeric) {
        let rest = quote(rest.trim());
        trouble = Some(format!("\"{rest}\" in transform has no effect; write NAME(NUMBERS)"));
    }
    Ok((product, trouble))
}

/// What is to be said of a function that is read although it is not written as it should be.
fn miswritten(name: &str, count: usize, is_open: bool) -> Option<String> {
    let (counts, wanted): (&[usize], &str) = match name {
        "matrix" => (&[6], "6"),
        "translate" | "scale" => (&[1, 2], "1 or 2"),
        "rotate" => (&[1, 3], "1 or 3"),
        _ => (&[1], "1"),
    };
    if !counts.contains(&count) {
        return Some(format!(
            "the transform \"{name}\" holds {count} numbers, not {wanted}; it is read as far as it goes"
        ));
    }
    is_open.then(|| format!("the transform \"{name}\" is read to the end of the attribute; close its parenthesis"))
}

fn function(name: &str, arguments: &[f32]) -> Option<DAffine2> {
    let argument = |i: usize| arguments.get(i).map(|number| f64::from(*number));
    let [first, second, third] = [0, 1, 2].map(argument);
    Some(match name {
        "matrix" => {
            let [a, b, c, d, e, f] = std::array::from_fn(|i| argument(i).unwrap_or(0.0));
            DAffine2::from_cols(DVec2::new(a, b), DVec2::new(c, d), DVec2::new(e, f))
        }
        "translate" => DAffine2::from_translation(DVec2::new(first.unwrap_or(0.0), second.unwrap_or(0.0))),
        "scale" => DAffine2::from_scale(DVec2::new(first.unwrap_or(1.0), second.unwrap_or(1.0))),
        "rotate" => {
            let center = DAffine2::from_translation(DVec2::new(second.unwrap_or(0.0), third.unwrap_or(0.0)));
            center * DAffine2::from_angle(first.unwrap_or(0.0).to_radians()) * center.inverse()
        }
        "skewX" => skew(DVec2::new(first.unwrap_or(0.0).to_radians().tan(), 0.0)),
        "skewY" => skew(DVec2::new(0.0, first.unwrap_or(0.0).to_radians().tan())),
        _ => return None,
    })
}

/// `x += shear.x * y`, `y += shear.y * x`.
fn skew(shear: DVec2) -> DAffine2 {
    DAffine2::from_mat2(DMat2::from_cols(DVec2::new(1.0, shear.y), DVec2::new(shear.x, 1.0)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn color_takes_hex_as_far_as_it_goes() {
        for (text, rgb, as_svg) in [
            ("#1865ED", 0x0018_65ed, true),
            ("1b1f8a", 0x001b_1f8a, true),
            ("#fff", 0x0fff, false),
            ("red", 0, false),
            ("blue", 0xb, false),
            ("#12345678", 0x0034_5678, false),
            ("#123456789", 0x00ff_ffff, false),
            ("", 0, false),
        ] {
            let color = color(text);
            assert_eq!((color.rgb, color.none, color.as_svg), (rgb, false, as_svg), "{text:?}");
        }
        assert!(color("none").none, "nothing");
        assert_eq!(
            color("#ff8000").to_rgba().to_bytes(crate::rules::Rules::Standard),
            [255, 128, 0, 255],
            "channels"
        );
    }

    #[test]
    fn transform_every_function() {
        let at = |text: &str, x: f64, y: f64| {
            let (transform, unknown) = transform(text).expect("finite");
            assert_eq!(unknown, None, "{text}");
            transform.transform_point2(DVec2::new(x, y))
        };
        for (text, expected) in [
            ("matrix(1 2 3 4 5 6)", [12.0, 16.0]),
            ("matrix(1,2,3,4,5,6)", [12.0, 16.0]),
            ("translate(10 20)", [11.0, 22.0]),
            ("translate(10,20)", [11.0, 22.0]),
            ("translate(10)", [11.0, 2.0]),
            ("scale(.5 2)", [0.5, 4.0]),
            ("scale(3)", [3.0, 2.0]),
            ("rotate(90)", [-2.0, 1.0]),
            ("rotate(90 1 1)", [0.0, 1.0]),
            ("skewX(45)", [3.0, 2.0]),
            ("skewY(45)", [1.0, 3.0]),
            ("translate(10 0) scale(2 2)", [12.0, 4.0]),
            ("", [1.0, 2.0]),
        ] {
            let found = at(text, 1.0, 2.0);
            assert!(found.abs_diff_eq(DVec2::from(expected), 1e-12), "{text}: {found}");
        }
    }

    #[test]
    fn transform_tells_what_is_miswritten() {
        for (text, told) in [
            ("translate(10", "read to the end of the attribute"),
            ("matrix(1 0 0 1 5)", "holds 5 numbers, not 6"),
            ("scale(2) rotate(1 2)", "holds 2 numbers, not 1 or 3"),
            ("translate()", "holds 0 numbers, not 1 or 2"),
            ("skewX(1 2", "holds 2 numbers, not 1"),
            ("scale(2) rotate 45", "\"rotate 45\" in transform has no effect"),
        ] {
            let line = transform(text).expect("finite").1.unwrap_or_default();
            assert!(line.contains(told), "{text}: {line}");
        }
        assert_eq!(transform(" , scale(2) ;").expect("finite").1, None, "nothing is amiss");
    }

    #[test]
    fn transform_survives_nonsense() {
        assert_eq!(
            transform("spin(3) scale(2 2)").expect("finite").1.as_deref(),
            Some("the transform \"spin\" is unknown and has no effect"),
            "named"
        );
        assert!(transform("scale(").is_ok() && transform("((()").is_ok(), "unfinished");
        assert!(transform("scale(nan)").is_err(), "refused");
    }
}
