//! Words, functions and units in the case in which the readers behind know them: CSS takes all of them in any (CSS Values 4, section 2.1).
//! Ids, addresses, strings and the names of typefaces stay as they are.

use std::ops::Range;

use super::inherited::is_inherited;
use super::tokens::{Kind, Token, Tokens};

/// Words that are not all in small letters.
const WITH_CAPITALS: [&str; 18] = [
    "currentColor",
    "geometricPrecision",
    "crispEdges",
    "optimizeSpeed",
    "optimizeQuality",
    "optimizeLegibility",
    "sRGB",
    "linearRGB",
    "visiblePainted",
    "visibleFill",
    "visibleStroke",
    "translateX",
    "translateY",
    "scaleX",
    "scaleY",
    "skewX",
    "skewY",
    "rotateZ",
];

/// Properties whose words may be anybody's names.
const NAMES: [&str; 8] = [
    "animation",
    "animation-name",
    "cursor",
    "font",
    "font-family",
    "src",
    "transition",
    "unicode-range",
];

/// Attributes with values of CSS that an element does not have of the one around it.
const NOT_INHERITED: [&str; 41] = [
    "alignment-baseline",
    "baseline-shift",
    "clip-path",
    "cx",
    "cy",
    "display",
    "dx",
    "dy",
    "filter",
    "flood-color",
    "flood-opacity",
    "fr",
    "fx",
    "fy",
    "height",
    "isolation",
    "lighting-color",
    "markerHeight",
    "markerWidth",
    "mask",
    "mask-type",
    "mix-blend-mode",
    "opacity",
    "overflow",
    "r",
    "refX",
    "refY",
    "rx",
    "ry",
    "stop-color",
    "stop-opacity",
    "text-decoration",
    "transform-origin",
    "vector-effect",
    "width",
    "x",
    "x1",
    "x2",
    "y",
    "y1",
    "y2",
];

/// Whether the words of a property or attribute of this name may be anybody's.
pub(super) fn has_names(property: &str) -> bool {
    property.starts_with('-') || NAMES.contains(&property)
}

/// A token in the usual case, where it is in another one.
pub(super) fn usual(kind: Kind, text: &str) -> Option<String> {
    const URL: &str = "url";
    let usual = match kind {
        Kind::Name | Kind::Function => {
            let word = text.trim_end_matches('(');
            let known = WITH_CAPITALS.iter().find(|known| known.eq_ignore_ascii_case(word));
            let word = known.map_or_else(|| word.to_ascii_lowercase(), |known| (*known).to_owned());
            word + if kind == Kind::Function { "(" } else { "" }
        }
        Kind::Number => text.to_ascii_lowercase(),
        Kind::Url => URL.to_owned() + text.get(URL.len()..)?,
        _ => return None,
    };
    (usual != text).then_some(usual)
}

/// The parts of an attribute's value that are in another case, and what they usually are, as long as that.
pub(in crate::scene) fn other_case(name: &str, value: &str) -> Vec<(Range<usize>, String)> {
    let is_of_css = (is_inherited(name) || NOT_INHERITED.contains(&name)) && !has_names(name);
    let may_have = is_of_css && value.bytes().any(|byte| byte.is_ascii_alphabetic());
    in_value(if may_have { value } else { "" }).collect()
}

fn in_value(value: &str) -> impl Iterator<Item = (Range<usize>, String)> {
    Tokens::of(value, 0..value.len()).filter_map(|Token { kind, place }| {
        let usual = usual(kind, &value[place.clone()])?;
        Some((place, usual))
    })
}

/// Whether an attribute `style` has a name, a word or a unit in another case.
pub(in crate::scene) fn is_in_other_case(style: &str) -> bool {
    let is_other = |declaration: &str| {
        let (name, value) = declaration.split_once(':')?;
        let name = name.trim();
        let is_shouted = name.bytes().any(|byte| byte.is_ascii_uppercase()) && !name.starts_with("--");
        Some(is_shouted || !has_names(name) && in_value(value).next().is_some())
    };
    style.split(';').any(|declaration| is_other(declaration) == Some(true))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_of_attributes_are_in_the_usual_case() {
        let usual = |name: &str, value: &str| {
            let mut text = value.to_owned();
            for (place, usual) in other_case(name, value) {
                text.replace_range(place, &usual);
            }
            text
        };
        for (name, value, expected) in [
            ("fill", "NONE", "none"),
            ("fill", "URL(#Ab) CURRENTCOLOR", "url(#Ab) currentColor"),
            ("fill", "Url('#Ab')", "url('#Ab')"),
            ("stroke", "RGB(1,2,3)", "rgb(1,2,3)"),
            ("color", "#ABC", "#ABC"),
            ("width", "20PX", "20px"),
            ("x", "1E2 2Em", "1e2 2em"),
            ("shape-rendering", "crispedges", "crispEdges"),
            ("font-family", "Arial", "Arial"),
            ("id", "None", "None"),
            ("gradientUnits", "userSpaceOnUse", "userSpaceOnUse"),
        ] {
            assert_eq!(usual(name, value), expected, "{name}={value}");
        }
    }

    #[test]
    fn styles_in_another_case_are_found() {
        for other in ["display:None", "a:b;FILL:red", "width:2PX", "mask:URL(#a)"] {
            assert!(is_in_other_case(other), "{other}");
        }
        for usual in [
            "fill:url(#Ab);stroke:#ABC",
            "font-family:Arial;font:2px Arial",
            "-inkscape-font-specification:Sans",
            "--A:B",
            "stroke:currentColor",
            "content:'A'",
        ] {
            assert!(!is_in_other_case(usual), "{usual}");
        }
    }
}
