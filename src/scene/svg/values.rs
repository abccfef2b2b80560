//! Which values of attributes and properties have a meaning, by SVG's grammar.

use glam::{DAffine2, DMat2, DVec2};
use svgtypes::{Length, NumberListParser, Paint, PathParser, PointsParser, TransformListParser, TransformListToken};

use crate::scene::{css, numbers};

/// What kind of value belongs to a name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    /// A length, or a list of them.
    Lengths,
    /// A number, or a percentage.
    Number,
    /// A colour, a reference, or nothing.
    Paint,
    Color,
    /// Another element, or nothing.
    Reference,
    Transform,
    Points,
    ViewBox,
    Aspect,
    /// Path data, of which as much is drawn as is understood.
    Path,
    /// One of these words.
    Words(&'static [&'static str]),
}

/// The numbers of a colour matrix that makes everything white and keeps its opacity.
pub(super) const WHITENS: [f32; 20] = [
    0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0,
];

/// Words that stand for a length, or for what the parent has.
const KEYWORDS: [&str; 16] = [
    "auto", "inherit", "initial", "unset", "none", "normal", "xx-small", "x-small", "small", "medium", "large",
    "x-large", "xx-large", "smaller", "larger", "thin",
];

/// The ways to blend that are drawn.
const BLEND_MODES: [&str; 16] = [
    "normal",
    "multiply",
    "screen",
    "overlay",
    "darken",
    "lighten",
    "color-dodge",
    "color-burn",
    "hard-light",
    "soft-light",
    "difference",
    "exclusion",
    "hue",
    "saturation",
    "color",
    "luminosity",
];

/// Properties that are read and not drawn, with the values that make no difference.
const WITHOUT_EFFECT: [(&str, &[&str]); 25] = [
    ("all", &[]),
    ("animation", &["none"]),
    ("animation-name", &["none"]),
    ("backdrop-filter", &["none"]),
    ("clip", &["auto"]),
    ("color-interpolation", &["auto", "sRGB", "srgb"]),
    // As a property: the attribute holds no function.
    ("d", &["none"]),
    ("direction", &["ltr"]),
    ("filter", &["none"]),
    ("font-variant", &["normal"]),
    ("glyph-orientation-vertical", &["auto"]),
    ("image-orientation", &["none", "from-image"]),
    ("inline-size", &["auto", "0", "0px"]),
    ("mask-image", &["none"]),
    ("rotate", &["none", "0", "0deg"]),
    ("scale", &["none", "1"]),
    ("shape-inside", &["auto"]),
    // Others are drawn as the first of these.
    ("stroke-linejoin", &["miter", "round", "bevel"]),
    ("text-orientation", &["mixed"]),
    ("text-shadow", &["none"]),
    ("text-transform", &["none"]),
    ("transform-box", &["view-box"]),
    ("translate", &["none", "0", "0px"]),
    ("vector-effect", &["none", "non-scaling-stroke"]),
    ("white-space", &["normal", "nowrap", "pre", "pre-wrap", "break-spaces"]),
];

fn kind(name: &str) -> Option<Kind> {
    Some(match name {
        "x" | "y" | "width" | "height" | "rx" | "ry" | "cx" | "cy" | "r" | "x1" | "y1" | "x2" | "y2" | "fx" | "fy"
        | "fr" | "dx" | "dy" | "stroke-width" | "stroke-dasharray" | "stroke-dashoffset" | "font-size"
        | "letter-spacing" | "word-spacing" | "markerWidth" | "markerHeight" | "refX" | "refY" => Kind::Lengths,
        "opacity" | "fill-opacity" | "stroke-opacity" | "stop-opacity" | "stroke-miterlimit" | "offset" => Kind::Number,
        "fill" | "stroke" => Kind::Paint,
        "color" | "stop-color" => Kind::Color,
        "clip-path" | "mask" => Kind::Reference,
        "transform" | "gradientTransform" | "patternTransform" => Kind::Transform,
        "points" => Kind::Points,
        "viewBox" => Kind::ViewBox,
        "preserveAspectRatio" => Kind::Aspect,
        "d" | "path" => Kind::Path,
        "stroke-linecap" => Kind::Words(&["butt", "round", "square"]),
        "stroke-linejoin" => Kind::Words(&["miter", "miter-clip", "arcs", "round", "bevel"]),
        "fill-rule" | "clip-rule" => Kind::Words(&["nonzero", "evenodd"]),
        "visibility" => Kind::Words(&["visible", "hidden", "collapse"]),
        "color-interpolation"
        | "image-orientation"
        | "filter"
        | "vector-effect"
        | "font-variant"
        | "direction"
        | "glyph-orientation-vertical"
        | "text-orientation"
        | "clip"
        | "white-space" => Kind::Words(&[]),
        "mix-blend-mode" => Kind::Words(&BLEND_MODES),
        "shape-rendering" => Kind::Words(&["auto", "geometricPrecision", "crispEdges", "optimizeSpeed"]),
        "image-rendering" => Kind::Words(&[
            "auto",
            "optimizeQuality",
            "smooth",
            "high-quality",
            "optimizeSpeed",
            "crisp-edges",
            "pixelated",
        ]),
        _ => return None,
    })
}

/// The id of the element of this document to which a value refers, as `url(#id)` does, with or without quotes; what follows is
/// not looked at.
pub(super) fn reference(value: &str) -> Option<&str> {
    let (address, _) = value.trim().strip_prefix("url(")?.split_once(')')?;
    address.trim().trim_matches(['"', '\'']).strip_prefix('#')
}

/// Whether a property is read and not drawn, and this value would make a difference.
pub(super) fn is_without_effect(name: &str, value: &str) -> bool {
    let Some((_, harmless)) = WITHOUT_EFFECT.iter().find(|(property, _)| *property == name) else {
        return false;
    };
    if name == "d" && !value.starts_with("path(") {
        return false;
    }
    // Exporters of web pages write all that an animation could have, and no name.
    let is_named = name != "animation" || value.split_whitespace().all(|word| word != "none");
    let is_harmless = harmless.contains(&value) || matches!(value, "inherit" | "initial");
    is_named && (name == "all" || !is_harmless)
}

/// What a colour of a profile begins with.
pub(super) const OF_PROFILE: &str = "icc-color(";

/// A colour without that of a profile behind it, in whose place it is shown (SVG 1.1, section 12.3).
pub(super) fn without_profile(value: &str) -> &str {
    let color = value.split_once(OF_PROFILE).map(|(color, _)| color.trim_end());
    color.filter(|color| !color.is_empty()).unwrap_or(value)
}

/// Whether it is known what values belong to the name.
pub(super) fn is_known(name: &str) -> bool {
    kind(name).is_some()
}

/// Whether its values hold numbers.
pub(super) fn is_numeric(name: &str) -> bool {
    !matches!(
        kind(name),
        None | Some(Kind::Words(_) | Kind::Paint | Kind::Color | Kind::Reference | Kind::Aspect)
    )
}

/// Where in a value the first number stands that is too large; a name without numbers has none.
fn too_large_at(name: &str, value: &str) -> Option<usize> {
    numbers::too_large_at(value).filter(|_| is_numeric(name))
}

/// Whether a value of this name holds a number that usvg reads and cannot count with.
pub(super) fn is_too_large(name: &str, value: &str) -> bool {
    too_large_at(name, value).is_some()
}

/// Whether the value is a word that has a meaning anywhere.
pub(super) fn is_keyword(value: &str) -> bool {
    let value = value.trim();
    KEYWORDS.contains(&value) || css::plain_word("", value).is_some()
}

/// What `xml:space` says where a text's `white-space` is this.
pub(super) fn space(white_space: &str) -> Option<&'static str> {
    match white_space.trim() {
        "pre" | "pre-wrap" | "break-spaces" => Some("preserve"),
        "normal" | "nowrap" | "pre-line" | "initial" => Some("default"),
        _ => None,
    }
}

/// Whether the value has a meaning; that of an unknown name is not asked after.
pub(super) fn is_understood(name: &str, value: &str) -> bool {
    let Some(kind) = kind(name) else {
        return true;
    };
    if is_keyword(value) || value.is_empty() {
        return true;
    }
    if is_too_large(name, value) {
        return false;
    }
    match kind {
        Kind::Lengths => value
            .split([',', ' ', '\t', '\n', '\r'])
            .filter(|part| !part.is_empty())
            .all(is_length),
        Kind::Number => value
            .strip_suffix('%')
            .unwrap_or(value)
            .parse::<svgtypes::Number>()
            .is_ok(),
        Kind::Paint => Paint::from_str(without_profile(value)).is_ok(),
        Kind::Color => value == "currentColor" || without_profile(value).parse::<svgtypes::Color>().is_ok(),
        Kind::Reference => value.starts_with("url("),
        Kind::Transform => transform(value).is_some(),
        Kind::Points => {
            let numbers: Result<Vec<f64>, _> = NumberListParser::from(value).collect();
            numbers.is_ok_and(|numbers| numbers.len() % 2 == 0)
        }
        Kind::ViewBox => value.parse::<svgtypes::ViewBox>().is_ok(),
        Kind::Aspect => value.parse::<svgtypes::AspectRatio>().is_ok(),
        Kind::Words(words) => words.is_empty() || words.contains(&value),
        Kind::Path => PathParser::from(value).all(|segment| segment.is_ok()),
    }
}

/// What of a value stands before the first number that is too large.
pub(super) fn before_too_large<'v>(name: &str, value: &'v str) -> &'v str {
    too_large_at(name, value).map_or(value, |at| &value[..at])
}

/// Up to where an outline is drawn that is understood in part: so many points of a polygon, or segments of a path.
pub(super) fn drawn_up_to(name: &str, value: &str) -> Option<(usize, &'static str)> {
    let value = before_too_large(name, value);
    let (count, what) = match name {
        "points" => (PointsParser::from(value).count(), "points"),
        "d" => (PathParser::from(value).take_while(Result::is_ok).count(), "segments"),
        _ => return None,
    };
    (count > 1).then_some((count, what))
}

/// Whether these are numbers, and one too many.
pub(super) fn is_odd(points: &str) -> bool {
    let numbers: Result<Vec<f64>, _> = NumberListParser::from(points).collect();
    numbers.is_ok_and(|numbers| numbers.len() % 2 == 1) && !is_too_large("points", points)
}

fn is_length(text: &str) -> bool {
    text.parse::<Length>().is_ok() || is_keyword(text)
}

/// A list of transforms, the first outermost.
pub(super) fn transform(text: &str) -> Option<DAffine2> {
    if numbers::too_large_at(text).is_some() {
        return None;
    }
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
