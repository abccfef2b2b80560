//! Viewports: what the percentages of a `use` are of, and elements that nothing is drawn of because their box or their `viewBox` has
//! no area.
//!
//! A symbol is drawn in the box of the `use` that shows it, and percentages of that box are of what is around it. usvg takes
//! those of its size twice, and those of its place of the size that it has found then; so they are written as numbers.

use glam::DVec2;
use roxmltree::Node;
use svgtypes::{Length, LengthUnit, NumberListParser};

use super::cascade::Styled;
use super::elements::Elements;
use super::values;
use crate::scene::report::quote;

/// The sides of a box, and whether each is along x.
const SIDES: [(&str, bool); 4] = [("x", true), ("y", false), ("width", true), ("height", false)];

/// Changes what `styled` gives an element so that usvg draws it as its viewport wants it. `around` is that of what it lies in.
pub(super) fn resolve<'doc>(
    node: Node<'doc, 'doc>,
    styled: &mut Styled<'doc>,
    elements: &Elements<'doc>,
    around: Option<DVec2>,
) {
    match node.tag_name().name() {
        "svg" if hides(node) || is_flat(node, styled) => styled.hide(),
        // What is 0 wide or high is not drawn, either.
        "marker" if hides(node) => styled.set_length("markerWidth", "0".to_owned()),
        "pattern" if hides(node) => styled.set_length("width", "0".to_owned()),
        "use" => match elements.target(node) {
            Some(shown) if !matches!(shown.tag_name().name(), "svg" | "symbol") => {}
            Some(shown) if hides(shown) || is_flat(node, styled) => styled.hide(),
            Some(shown) if shown.tag_name().name() == "symbol" => symbol_in_numbers(node, styled, around),
            _ => {}
        },
        _ => {}
    }
}

/// Whether nothing of a nested document, or of what a `use` shows in such a box, is drawn because its width or height is zero (SVG 2,
/// section 8.2).
pub(super) fn is_flat(node: Node<'_, '_>, styled: &Styled<'_>) -> bool {
    let is_zero = |name| {
        let side = styled.length(node, name).map(|side| side.trim().parse::<Length>());
        matches!(side, Some(Ok(side)) if side.number == 0.0)
    };
    node.parent_element().is_some() && (is_zero("width") || is_zero("height"))
}

/// Whether nothing of an element is drawn because its `viewBox` has no area (SVG 2, section 8.6). A root is drawn, as most
/// readers draw it.
pub(super) fn hides(node: Node<'_, '_>) -> bool {
    node.parent_element().is_some()
        && matches!(node.tag_name().name(), "svg" | "symbol" | "marker" | "pattern")
        && node.attribute("viewBox").is_some_and(is_without_area)
}

/// Whether a `viewBox` is well-formed and has no area.
pub(super) fn is_without_area(view_box: &str) -> bool {
    let numbers: Result<Vec<f64>, _> = NumberListParser::from(view_box).collect();
    matches!(numbers.as_deref(), Ok([_, _, width, height]) if width.min(*height) == 0.0)
        && !values::is_too_large("viewBox", view_box)
}

/// What is said of such a `viewBox`.
pub(super) fn without_area(node: Node<'_, '_>, view_box: &str) -> String {
    let (name, view_box) = (node.tag_name().name(), quote(view_box));
    if hides(node) {
        format!("viewBox=\"{view_box}\" has no area: nothing of this {name} is drawn")
    } else if node.parent_element().is_none() {
        format!("viewBox=\"{view_box}\" has no area, and by SVG nothing would be shown; it is drawn as without viewBox")
    } else {
        format!("viewBox=\"{view_box}\" has no area and no effect")
    }
}

/// Width and height of what percentages inside an element are of; `None` where its document does not say.
pub(super) fn inside<'doc>(node: Node<'doc, 'doc>, styled: &Styled<'doc>, around: Option<DVec2>) -> Option<DVec2> {
    match node.tag_name().name() {
        "svg" => view_box(node).or_else(|| {
            let side = |name, around: Option<f64>| {
                let whole = around.filter(|_| node.parent_element().is_some());
                match styled.length(node, name) {
                    Some(length) => units(length, whole),
                    None => whole,
                }
            };
            let [width, height] = [around.map(|size| size.x), around.map(|size| size.y)];
            Some(DVec2::new(side("width", width)?, side("height", height)?))
        }),
        // Without one they are as large as whatever shows them.
        "symbol" | "marker" | "pattern" => view_box(node),
        _ => around,
    }
}

/// Width and height of an element's `viewBox`.
fn view_box(node: Node<'_, '_>) -> Option<DVec2> {
    let view_box = node.attribute("viewBox")?.trim();
    let view_box: svgtypes::ViewBox = view_box
        .parse()
        .ok()
        .filter(|_| !values::is_too_large("viewBox", view_box))?;
    Some(DVec2::new(view_box.w, view_box.h))
}

/// Writes the box of a `use` that shows a symbol in numbers, where usvg would take it for another one.
fn symbol_in_numbers<'doc>(node: Node<'doc, 'doc>, styled: &mut Styled<'doc>, around: Option<DVec2>) {
    let given = |name| styled.length(node, name).map(str::trim);
    // What is as large as all around it is so twice as well.
    let is_whole = |name| given(name).is_none_or(|side| side == "100%" || side == "auto");
    let Some(around) = around.filter(|_| !is_whole("width") || !is_whole("height")) else {
        return;
    };
    let found = SIDES.map(|(name, is_along_x)| {
        let length = given(name).filter(|length| length.ends_with('%'))?;
        units(length, Some(if is_along_x { around.x } else { around.y }))
    });
    for ((name, _), number) in SIDES.into_iter().zip(found) {
        if let Some(number) = number {
            styled.set_length(name, number.to_string());
        }
    }
}

/// A length in user units; `None` where it is one of letters.
fn units(length: &str, whole: Option<f64>) -> Option<f64> {
    const PER_INCH: f64 = 96.0;
    let length: Length = length.trim().parse().ok()?;
    let unit = match length.unit {
        LengthUnit::None | LengthUnit::Px => 1.0,
        LengthUnit::In => PER_INCH,
        LengthUnit::Cm => PER_INCH / 2.54,
        LengthUnit::Mm => PER_INCH / 25.4,
        LengthUnit::Pt => PER_INCH / 72.0,
        LengthUnit::Pc => PER_INCH / 6.0,
        LengthUnit::Percent => whole? / 100.0,
        LengthUnit::Em | LengthUnit::Ex => return None,
    };
    Some(length.number * unit).filter(|number| number.abs() <= f64::from(f32::MAX))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn view_boxes_without_area_are_told_from_broken_ones() {
        for empty in ["0 0 0 10", " 0,0,10,0 ", "0 0 0 0", "-5 -5 0 1e3"] {
            assert!(is_without_area(empty), "{empty}");
        }
        for other in ["0 0 1 1", "0 0 -5 0", "0 0 0", "0 0 0 0 0", "0 0 1e39 0", "a", ""] {
            assert!(!is_without_area(other), "{other}");
        }
    }

    #[test]
    fn lengths_become_units() {
        for (length, expected) in [
            ("25%", Some(50.0)),
            ("1in", Some(96.0)),
            (" 3px ", Some(3.0)),
            ("2em", None),
            ("x", None),
        ] {
            assert_eq!(units(length, Some(200.0)), expected, "{length}");
        }
        assert_eq!(units("25%", None), None, "of nothing");
        assert_eq!(units("1e39", None), None, "too large");
    }
}
