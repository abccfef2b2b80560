//! Letters that are left out, so that the rest is drawn: along no path, and in texts that usvg would take too long for, as its time grows
//! with the square of their length.

use roxmltree::Node;

use super::elements::Elements;
use super::text_paths;

/// Most bytes of one text, and how many an element inside counts for.
const MAX_TEXT: usize = 20_000;
const SPAN: usize = 8;

/// Why an element's letters are left out, if they are, and what stands there instead.
pub(super) fn letters(node: Node<'_, '_>, elements: &Elements<'_>) -> Option<(String, &'static str)> {
    if node.tag_name().name() == "textPath" {
        let why = text_paths::in_vain(node, elements)?;
        // What follows stands where it would without this.
        return Some((why.to_owned(), ""));
    }
    // Something stands there, as what a `switch` shows.
    too_long(node).map(|why| (why, "<g/>"))
}

/// What is to be said of an element that is too long a text.
fn too_long(node: Node<'_, '_>) -> Option<String> {
    if node.tag_name().name() != "text" {
        return None;
    }
    let length = |node: Node<'_, '_>| {
        if node.is_element() {
            SPAN
        } else {
            node.text().map_or(0, str::len)
        }
    };
    let mut left = MAX_TEXT;
    let is_short = node.descendants().all(|inside| {
        let rest = left.checked_sub(length(inside));
        left = rest.unwrap_or(0);
        rest.is_some()
    });
    (!is_short).then(|| {
        format!("not drawn: more than {MAX_TEXT} characters in one text, where each element inside counts as {SPAN}; split the text")
    })
}
