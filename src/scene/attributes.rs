//! What both dialects ask of an element: whether it can show at all, and what it links to.

use roxmltree::Node;

/// The namespace of SVG.
const SVG: &str = "http://www.w3.org/2000/svg";
/// The namespace of linked addresses in SVG 1.1.
const XLINK: &str = "http://www.w3.org/1999/xlink";

/// Whether an element never shows in a picture, so that its absence is not worth a word: descriptions, and what
/// drawing programs store for themselves in namespaces of their own.
pub(super) fn is_silent(node: Node<'_, '_>) -> bool {
    let namespace = node.tag_name().namespace();
    let root = node.document().root_element().tag_name().namespace();
    matches!(node.tag_name().name(), "title" | "desc" | "metadata")
        || namespace.is_some_and(|uri| uri != SVG && Some(uri) != root)
}

/// The address an element links to, by SVG 2's `href` or SVG 1.1's `xlink:href`.
pub(super) fn href<'doc>(node: Node<'doc, 'doc>) -> Option<&'doc str> {
    node.attribute("href").or_else(|| node.attribute((XLINK, "href")))
}
