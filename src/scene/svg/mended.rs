//! What SVG reads and usvg does not: numbers between white space, and shapes whose filter is not there.

use roxmltree::Node;

use super::cascade::{Styled, is_missing};
use super::elements::Elements;
use super::{nonsense, own_triangles, values};
use crate::scene::edits::Edits;
use crate::scene::numbers;

/// White space as XML knows it.
const SPACE: [char; 4] = [' ', '\t', '\n', '\r'];

/// Takes the white space around the numbers of an element's attributes out of `text`: usvg takes other values for them, or none.
/// `styled` says which have others from styles.
pub(super) fn trim_numbers(text: &str, node: Node<'_, '_>, styled: &Styled<'_>, edits: &mut Edits) {
    let attributes = node.attributes().filter(|attribute| attribute.namespace().is_none());
    for attribute in attributes.filter(|attribute| !styled.has_length(attribute.name())) {
        let name = attribute.name();
        let range = attribute.range_value();
        let raw = text.get(range.clone()).unwrap_or("");
        // A path's data may have it, and is changed elsewhere.
        let is_framed = raw.starts_with(SPACE) | raw.ends_with(SPACE);
        let is_kept = || {
            !is_outline(node, name) && values::is_numeric(name) && !nonsense::is_nonsense(name, raw.trim_matches(SPACE))
        };
        if is_framed && is_kept() {
            edits.replace(range, raw.trim_matches(SPACE).to_owned());
        }
    }
}

/// Whether an attribute is the outline of a path or a triangle.
fn is_outline(node: Node<'_, '_>, name: &str) -> bool {
    name == "d" || name == "points" && own_triangles::is_one(node)
}

/// Takes an element's filter out of the text where no filter has the id that it refers to: such a filter is none, and usvg would
/// draw nothing. Quotes around an id go as well, for which usvg passes over filters. Styles are read elsewhere.
pub(super) fn mend_filter(node: Node<'_, '_>, elements: &Elements<'_>, edits: &mut Edits) {
    let Some(filter) = node.attributes().find(|attribute| attribute.name() == "filter") else {
        return;
    };
    let value = filter.value();
    if is_missing(value, elements) {
        edits.replace(filter.range(), String::new());
    } else if let Some(id) = values::reference(value).filter(|_| value.contains(['"', '\''])) {
        edits.replace(filter.range_value(), format!("url(#{id})"));
    }
}

/// Whether an element shows nothing because it has a filter without effects, as SVG wants it.
pub(super) fn is_filtered_away(node: Node<'_, '_>, elements: &Elements<'_>) -> bool {
    let id = node.attribute("filter").and_then(values::reference);
    let found = id.and_then(|id| elements.own(id));
    found.is_some_and(|filter| {
        filter.has_tag_name("filter")
            && !filter.has_attribute("href")
            && !filter.children().any(|effect| effect.is_element())
    })
}

/// What is to be said of a document that refers to a style sheet outside, as XML does.
pub(super) fn style_elsewhere(root: Node<'_, '_>) -> Option<&'static str> {
    let mut instructions = root.document().root().children().filter_map(|node| node.pi());
    let is_sheet = instructions.any(|instruction| instruction.target == "xml-stylesheet");
    is_sheet.then_some("<?xml-stylesheet?> has no effect; other style sheets are not fetched: put it into a <style>")
}

/// What is to be said of a root whose coordinates lie so far from 0 that 32-bit floats, in which usvg counts, tell neighbouring
/// pixels no longer apart.
pub(super) fn far_from_zero(root: Node<'_, '_>) -> Option<String> {
    /// Parts of the picture's longer side by which a corner may be off: a tenth of a pixel of most windows.
    const LITTLE: f64 = 1e-4;
    let numbers = numbers::all("viewBox", root.attribute("viewBox")?).ok()?;
    let [x, y, width, height] = numbers.first_chunk::<4>()?.map(f64::from);
    let farthest = (x.abs() + width).max(y.abs() + height);
    // Half of the distance of neighbouring floats, at most.
    let off = farthest * f64::from(f32::EPSILON) / 2.0;
    (off > width.max(height) * LITTLE).then(|| {
        format!(
            "coordinates this far from 0 are rounded, by up to {off:.2} of {} units: shapes are drawn in other places; move all of them nearer to 0, and viewBox with them",
            width.max(height)
        )
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn roots_far_from_zero_are_told() {
        let told = |view_box: &str| {
            let text = format!("<svg viewBox='{view_box}'/>");
            let document = roxmltree::Document::parse(&text).expect("a document");
            far_from_zero(document.root_element())
        };
        for plain in ["0 0 20 20", "-5000 3000 100 100", "1e9 0 1e9 1e9", "", "1 2 3"] {
            assert_eq!(told(plain), None, "{plain}");
        }
        for far in ["500000 5000000 20 20", "13387000 0 50 50", "0 -1e8 640 480"] {
            assert!(told(far).is_some_and(|line| line.contains("nearer to 0")), "{far}");
        }
    }
}
