//! Letters along a path that usvg would leave out in silence: those without a path are told, and a path that the element has itself
//! stands elsewhere for usvg, which follows references only.

use roxmltree::Node;
use svgtypes::PathParser;

use super::elements::Elements;
use crate::scene::attributes;
use crate::scene::edits::Edits;

/// Elements that letters can follow.
const OUTLINES: [&str; 7] = ["path", "rect", "circle", "ellipse", "line", "polyline", "polygon"];

/// Why no letters are drawn along the path of an element, if that is so.
pub(super) fn in_vain(node: Node<'_, '_>, elements: &Elements<'_>) -> Option<&'static str> {
    if own(node).is_some() {
        return None;
    }
    let Some(address) = attributes::href(node) else {
        return Some("not drawn: it has no href");
    };
    match elements.target(node) {
        Some(target) if OUTLINES.contains(&target.tag_name().name()) => None,
        Some(_) => Some("not drawn: what it refers to has no outline"),
        None if address.trim().starts_with('#') => Some("not drawn: no element has the id that it refers to"),
        None => Some("not drawn: other documents are not looked into"),
    }
}

/// The path that an element has itself, which counts before one that it refers to (SVG 2, section 11.8.1).
fn own<'doc>(node: Node<'doc, '_>) -> Option<&'doc str> {
    let path = node.attribute("path")?;
    let is_drawn = PathParser::from(path).next().is_some_and(|segment| segment.is_ok());
    (is_drawn && !path.contains(['"', '&', '<'])).then_some(path)
}

/// Puts the path that an element has itself at the end of the document, with this id; `name_end` is where the name in the element's
/// tag ends.
pub(super) fn move_own(text: &str, node: Node<'_, '_>, (id, name_end): (&str, usize), edits: &mut Edits) {
    let root = node.document().root_element().range();
    let tag = text.get(root.start + 1..root.end).unwrap_or("");
    let end = tag.rfind("</");
    let (Some(path), Some(end)) = (own(node), end) else {
        return;
    };
    // The namespace of SVG may have a prefix.
    let prefix = tag[end + 2..].split_once(':').map_or("", |(prefix, _)| prefix);
    let colon = if prefix.is_empty() { "" } else { ":" };
    let moved = format!("<{prefix}{colon}defs><{prefix}{colon}path id=\"{id}\" d=\"{path}\"/></{prefix}{colon}defs>");
    edits.insert(root.start + 1 + end, moved);
    for href in node.attributes().filter(|attribute| attribute.name() == "href") {
        edits.replace(href.range(), String::new());
    }
    edits.insert(name_end, format!(" href=\"#{id}\""));
}
