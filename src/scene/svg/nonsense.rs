//! Colours and dashes that nobody understands, and numbers that are too large. By CSS they have no effect, and what an attribute,
//! another rule or the element around says counts; usvg takes black, the dashes before what it does not understand, or an infinite
//! number. So their names are changed in the text that usvg reads, and outlines end there.

use std::ops::Range;

use roxmltree::{Attribute, Node};
use simplecss::{Declaration, DeclarationTokenizer, StyleSheet};

use super::{own_triangles, sheets, values};
use crate::scene::css;
use crate::scene::edits::{Edits, escaped};
use crate::scene::report::quote;

/// Put before the name of a declaration to make it one of nothing.
pub(super) const UNREAD: &str = "unread-";

/// Properties of which usvg makes something else where it does not understand them.
const MISTAKEN: [&str; 5] = ["fill", "stroke", "color", "stop-color", "stroke-dasharray"];

/// Takes such values that `node` has, as attributes or in its style, out of `text`. Lengths that it
/// has from styles instead stay.
pub(super) fn hide(text: &str, node: Node<'_, '_>, is_from_styles: impl Fn(&str) -> bool, edits: &mut Edits) {
    for attribute in node.attributes().filter(|attribute| attribute.namespace().is_none()) {
        let (name, value) = (attribute.name(), attribute.value());
        // Outlines of the course's triangles are written anew.
        let is_written = is_from_styles(name) || own_triangles::is_one(node) && matches!(name, "d" | "points");
        if is_written {
            continue;
        }
        let word = css::plain_word(name, value.trim()).filter(|_| values::is_known(name) || css::is_inherited(name));
        if let Some(word) = word {
            if word != value {
                edits.replace(attribute.range(), format!("{name}=\"{word}\""));
            }
        } else if is_nonsense(name, value.trim()) {
            if values::drawn_up_to(name, value).is_some() {
                let drawn = values::before_too_large(name, value);
                edits.replace(attribute.range_value(), escaped(drawn));
            } else {
                // With another name it might be there twice.
                edits.replace(attribute.range(), String::new());
            }
        } else if MISTAKEN.contains(&attribute.name()) || attribute.name() == "style" {
            hide_profiles(text, attribute.range_value(), edits);
        }
        for at in in_style(text, attribute) {
            edits.insert(at, UNREAD.to_owned());
        }
    }
}

/// Puts blanks in the place of colours of profiles in a part of `text`: usvg makes black of what has one.
pub(super) fn hide_profiles(text: &str, part: Range<usize>, edits: &mut Edits) {
    let value = text.get(part.clone()).unwrap_or("");
    for (at, _) in value.match_indices(values::OF_PROFILE) {
        let length = value[at..].find(')').map_or(value.len() - at, |close| close + 1);
        edits.replace(part.start + at..part.start + at + length, " ".repeat(length));
    }
}

/// Where in `text` the names of declarations in vain stand, if the attribute is a style.
fn in_style(text: &str, attribute: Attribute<'_, '_>) -> Vec<usize> {
    let (name, value) = (attribute.name(), attribute.value());
    let there = attribute.range_value();
    if name == "style" && text.get(there.clone()) == Some(value) {
        let declarations = DeclarationTokenizer::from(value).filter(is_in_vain);
        declarations
            .map(|declaration| there.start + offset(value, declaration.name))
            .collect()
    } else {
        Vec::new()
    }
}

/// The texts of a style sheet, and where in `text` each begins; where references to entities stand in it, places cannot be told.
fn parts<'s>(text: &str, sheet: Node<'s, '_>) -> impl Iterator<Item = (&'s str, Option<usize>)> {
    sheet.children().filter(Node::is_text).map(|part| {
        let css = part.text().unwrap_or("");
        let raw = text.get(part.range());
        let start = raw.and_then(|raw| raw.find(css)).map(|at| part.range().start + at);
        (css, start)
    })
}

/// Where in `text` the names stand that a style sheet gives such values to, and what is to be said of them.
pub(super) fn names_in_sheet(text: &str, sheet: Node<'_, '_>) -> Vec<(usize, String)> {
    let mut found = Vec::new();
    for (css, start) in parts(text, sheet) {
        let Some(start) = start else {
            continue;
        };
        let mut sheet = StyleSheet::new();
        sheets::parse(&mut sheet, css);
        let rules = sheet.rules.into_iter();
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

/// Whether a property has such a value.
pub(super) fn is_nonsense(name: &str, value: &str) -> bool {
    MISTAKEN.contains(&name) && !values::is_understood(name, value) || values::is_too_large(name, value)
}

/// How far `part` is from the start of the text that it is of.
fn offset(text: &str, part: &str) -> usize {
    part.as_ptr().addr().saturating_sub(text.as_ptr().addr())
}
