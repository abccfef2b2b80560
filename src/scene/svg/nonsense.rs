//! Colours that nobody understands. By CSS they have no effect, and what an attribute, another rule or the element around says
//! counts; usvg takes black. So their names are changed in the text that usvg reads.

use roxmltree::{Attribute, Node};
use simplecss::{Declaration, DeclarationTokenizer, StyleSheet};

use super::values;
use crate::scene::report::quote;

/// Put before a name to make it one of nothing.
pub(super) const UNREAD: &str = "unread-";

/// Properties that are colours.
const PAINTS: [&str; 4] = ["fill", "stroke", "color", "stop-color"];

/// Where in `text` the names stand that `node` gives such colours to, as attributes or in its style.
pub(super) fn names(text: &str, node: Node<'_, '_>) -> Vec<usize> {
    let attributes = node.attributes().filter(|attribute| attribute.namespace().is_none());
    attributes.flat_map(|attribute| of_attribute(text, attribute)).collect()
}

fn of_attribute(text: &str, attribute: Attribute<'_, '_>) -> Vec<usize> {
    let (name, value) = (attribute.name(), attribute.value());
    let there = attribute.range_value();
    if is_nonsense(name, value.trim()) {
        vec![attribute.range_qname().start]
    } else if name == "style" && text.get(there.clone()) == Some(value) {
        let declarations = DeclarationTokenizer::from(value).filter(is_in_vain);
        declarations
            .map(|declaration| there.start + offset(value, declaration.name))
            .collect()
    } else {
        Vec::new()
    }
}

/// Where in `text` the names stand that a style sheet gives such colours to, and what is to be said of them.
pub(super) fn names_in_sheet(text: &str, sheet: Node<'_, '_>) -> Vec<(usize, String)> {
    let mut found = Vec::new();
    for part in sheet.children().filter(Node::is_text) {
        let css = part.text().unwrap_or("");
        // Where references to entities stand in it, places cannot be told.
        let Some(start) = text
            .get(part.range())
            .and_then(|raw| raw.find(css))
            .map(|at| part.range().start + at)
        else {
            continue;
        };
        let rules = StyleSheet::parse(css).rules.into_iter();
        let declarations = rules.flat_map(|rule| rule.declarations).filter(is_in_vain);
        found.extend(declarations.map(|declaration| {
            let message = without_effect(declaration.name, declaration.value);
            (start + offset(css, declaration.name), message)
        }));
    }
    // Each selector of a rule has its declarations.
    found.sort();
    found.dedup();
    found
}

/// What is said of a value without a meaning.
pub(super) fn without_effect(name: &str, value: &str) -> String {
    format!("{name}=\"{}\" is not understood and has no effect", quote(value))
}

fn is_in_vain(declaration: &Declaration<'_>) -> bool {
    is_nonsense(declaration.name, declaration.value)
}

fn is_nonsense(name: &str, value: &str) -> bool {
    PAINTS.contains(&name) && !values::is_understood(name, value)
}

/// How far `part` is from the start of the text that it is of.
fn offset(text: &str, part: &str) -> usize {
    part.as_ptr().addr().saturating_sub(text.as_ptr().addr())
}
