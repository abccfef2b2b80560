//! Colours and dashes that nobody understands, and numbers that are too large. By CSS they have no effect, and what an attribute,
//! another rule or the element around says counts; usvg takes black, the dashes before what it does not understand, or an infinite
//! number. So their names are changed in the text that usvg reads, and outlines end there. Selectors that simplecss passes over are
//! told.

use std::collections::HashSet;
use std::ops::Range;

use roxmltree::{Attribute, Node};
use simplecss::{Declaration, DeclarationTokenizer, StyleSheet};

use super::{own_triangles, sheets, values};
use crate::scene::declarations::NESTED;
use crate::scene::edits::{Edits, escaped};
use crate::scene::media;
use crate::scene::report::quote;
use crate::scene::selectors::written;
use crate::scene::substitutes::block_end;

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
        if is_nonsense(name, value.trim()) {
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

/// What is to be said of rules of a sheet that are passed over, and where in `text` each stands, if that can be told.
pub(super) fn rules_in_vain(text: &str, sheet: Node<'_, '_>) -> Vec<(Option<usize>, String)> {
    let told = parts(text, sheet).flat_map(|(css, start)| {
        let told = at_rules_in_vain(css).into_iter().chain(selectors_in_vain(css));
        told.map(move |(at, message)| (start.map(|start| start + at), message))
    });
    told.collect()
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

/// What select elements of a drawing that does not change, and are passed over with their rules.
const SELECTORS: [&str; 14] = [
    "not",
    "is",
    "where",
    "has",
    "empty",
    "last-child",
    "only-child",
    "nth-child",
    "nth-last-child",
    "first-of-type",
    "last-of-type",
    "only-of-type",
    "nth-of-type",
    "nth-last-of-type",
];

/// What is to be said of rules of a style sheet that are passed over because of their selectors, or because they stand inside of
/// others; and where.
fn selectors_in_vain(css: &str) -> Vec<(usize, String)> {
    let css = without_comments(css);
    let mut found = Vec::new();
    let mut at = 0;
    while let Some(open) = css[at..].find('{').map(|open| at + open) {
        let end = open + 1 + block_end(&css[open + 1..]);
        let body = &css[open + 1..end];
        let start = css[at..open].rfind([';', '}']).map_or(at, |mark| at + mark + 1);
        at = (end + 1).min(css.len());
        let selectors = css[start..open].trim_start();
        let start = open - selectors.len();
        // Custom properties of the root are read, and then have other names.
        let is_empty = body
            .split(';')
            .all(|part| part.trim().is_empty() || part.trim().starts_with("x-"));
        if !selectors.starts_with('@') && !is_empty {
            found.extend(unread_selector(selectors).map(|message| (start, message)));
        }
        if let Some(nested) = body.find(NESTED).filter(|_| !selectors.starts_with('@')) {
            let outer = quote(written(selectors).trim());
            let message =
                format!("the rules inside \"{outer}\" have no effect; write them behind it, with whole selectors");
            found.push((open + 1 + nested, message));
        }
    }
    each_once(found)
}

/// Each message where it is true first.
fn each_once(mut found: Vec<(usize, String)>) -> Vec<(usize, String)> {
    found.sort();
    let mut told = HashSet::new();
    found.retain(|(_, message)| told.insert(message.clone()));
    found
}

/// Rules with an `@` that hold others, or fetch them.
const AT_RULES: [&str; 6] = ["@import", "@media", "@supports", "@layer", "@scope", "@container"];
/// What is to be said of rules that hold others, all of which are passed over, and where.
fn at_rules_in_vain(css: &str) -> Vec<(usize, String)> {
    let css = without_comments(css);
    let heads = AT_RULES.into_iter().flat_map(|name| css.match_indices(name));
    let found = heads
        .filter_map(|(at, name)| {
            let head = css[at..].split(['{', ';']).next().unwrap_or("").trim();
            let is_whole = !head[name.len()..].starts_with(|c: char| c.is_ascii_alphanumeric() || c == '-');
            // Those for a screen are plain rules, and those for other media are not meant.
            let is_meant = name != "@media" || media::applies(&head[name.len()..]).is_none();
            (is_whole && is_meant).then(|| {
                let head = quote(head);
                let message = match name {
                    "@import" => format!("\"{head}\" has no effect; other style sheets are not fetched"),
                    "@media" => format!(
                        "the rules inside \"{head}\" have no effect; whether such conditions hold is not looked at"
                    ),
                    _ => format!("the rules inside \"{head}\" have no effect; take them out of it"),
                };
                (at, message)
            })
        })
        .collect();
    each_once(found)
}

/// What is said of the first selector of a list that is passed over.
fn unread_selector(selectors: &str) -> Option<String> {
    let mut depth = 0;
    let sign = selectors.char_indices().find_map(|(at, sign)| {
        match sign {
            '[' | '(' => depth += 1,
            ']' | ')' => depth -= 1,
            _ => {}
        }
        let rest = &selectors[at + sign.len_utf8()..];
        if let Some(part) = ["^=", "$=", "*="]
            .into_iter()
            .find(|part| selectors[at..].starts_with(part))
        {
            return Some(part);
        }
        match sign {
            '~' if depth == 0 => Some("~"),
            '\\' if depth == 0 => Some("\\"),
            ':' if depth == 0 => {
                let end = rest.find(|c: char| !c.is_ascii_alphanumeric() && c != '-');
                let name = &rest[..end.unwrap_or(rest.len())];
                SELECTORS.contains(&name).then(|| &selectors[at..=at + name.len()])
            }
            _ => None,
        }
    })?;
    Some(format!(
        "the selector \"{}\" is not understood ({sign}); its rule has no effect",
        quote(written(selectors).trim())
    ))
}

/// A style sheet with blanks in the place of its comments.
fn without_comments(css: &str) -> String {
    let mut pieces = css.split("/*");
    let first = pieces.next().unwrap_or("").to_owned();
    pieces.fold(first, |all, piece| {
        let after = piece.split_once("*/").map_or("", |(_, after)| after);
        let blanks = "/*".len() + piece.len() - after.len();
        all + &" ".repeat(blanks) + after
    })
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn selectors_that_are_passed_over_are_told_once() {
        let css = "/* a:not(b) { */ a:not(.b) { fill: red } g > :last-child, b { x: 1 } a ~ b { y: 2 } a:not(.b) { fill: red } \
                   .w-1\\/2 { z: 3 }";
        let told = selectors_in_vain(css);
        assert_eq!(told.len(), 4, "{told:?}");
        assert!(told[0].1.contains("\"a:not(.b)\" is not understood (:not)"), "{told:?}");
        assert_eq!(
            told[0].0,
            css.find(" a:not(.b)").map_or(0, |at| at + 1),
            "where it stands"
        );
        let told = selectors_in_vain(".n{ x--:1;   } .m{}");
        assert_eq!(told.len(), 1, "{told:?}");
        assert!(
            told[0].0 == 4 && told[0].1.starts_with("the rules inside \".n\""),
            "{told:?}"
        );
    }

    #[test]
    fn rules_inside_others_are_told_where_they_would_hold() {
        let css = "@import url(a.css); /* @layer x {} */ @media screen { a { fill: red } } @media print { a { fill: red } }
            @media (prefers-color-scheme: dark) {} @font-face { src: url(x) } @keyframes x { from { y: 1 } } a { fill: red }";
        let told = at_rules_in_vain(css);
        assert_eq!(told.len(), 2, "{told:?}");
        assert!(
            told[0].1.contains("\"@import url(a.css)\"")
                && told[1].1.contains("\"@media (prefers-color-scheme: dark)\""),
            "{told:?}"
        );
        assert_eq!(
            [told[0].0, told[1].0],
            [0, css.find("@media (").unwrap_or(0)],
            "where they stand"
        );
        assert!(at_rules_in_vain("@important @layer").len() == 1, "only whole words");
    }

    #[test]
    fn selectors_that_are_read_or_select_nothing_are_not_told() {
        for css in [
            "a:hover, b:first-child, :lang(en) { fill: red }",
            "[a~=b] { fill: red } [href='x:not(y)'] { fill: red }",
            ":root { x-c: red; }",
            "@media (hover) { a:not(b) { fill: red } } text::selection { fill: red }",
            "a:not(b) {}",
            "a:not(b",
            "{ }}{",
        ] {
            assert_eq!(selectors_in_vain(css), [], "{css}");
        }
    }
}
