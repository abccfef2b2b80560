//! Selectors that the reader of styles does not know, in forms that it does: the root, and attributes that begin, end or hold
//! something. Each is as long as before, so that every place in the document stays where it is.
//!
//! `:root` becomes an attribute that only the root has; `[class^="a"]` asks for an attribute `class_`, the sign in whose name says
//! how to compare.

use std::borrow::Cow;
use std::ops::Range;

use super::css::{MOST_COMPARISONS, block_end, block_start};
use super::edits::Edits;
use super::substitutes::Markup;

/// The attribute that stands for `:root`.
pub(super) const ROOT: &str = "_r_";
const ROOT_SELECTOR: [&str; 2] = [":root", "[_r_]"];

/// How a part of an attribute is compared: as CSS signs it, and the end of the attribute's name in its place.
const SIGNS: [(Part, &str, &str); 3] = [
    (Part::Start, "^=", "_="),
    (Part::End, "$=", "-="),
    (Part::Any, "*=", "Q="),
];

/// Which part of an attribute a selector looks at.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Part {
    Start,
    End,
    Any,
}

impl Part {
    /// What the name of an attribute in a selector stands for.
    pub(super) fn of(name: &str) -> Option<(&str, Self)> {
        SIGNS.iter().find_map(|(part, _, sign)| {
            let name = name.strip_suffix(sign.strip_suffix('=')?)?;
            Some((name, *part))
        })
    }

    /// Whether a value has `wanted` there; nothing is no part (Selectors 4, section 6.2).
    pub(super) fn is_in(self, value: &str, wanted: &str) -> bool {
        !wanted.is_empty()
            && match self {
                Self::Start => value.starts_with(wanted),
                Self::End => value.ends_with(wanted),
                Self::Any => value.contains(wanted),
            }
    }
}

/// The document with such selectors in their other forms.
pub(super) fn rewritten(text: Cow<'_, str>) -> Cow<'_, str> {
    let signs = SIGNS.iter().map(|(_, sign, _)| *sign);
    if !text.contains("style") || !signs.chain([ROOT_SELECTOR[0]]).any(|sign| text.contains(sign)) {
        return text;
    }
    let markup = Markup::of(&text);
    let mut edits = Edits::default();
    let mut left = MOST_COMPARISONS;
    for head in markup.sheets.iter().flat_map(|sheet| heads(&text, sheet.clone())) {
        let selectors = &text[head.clone()];
        let [root, plain] = ROOT_SELECTOR;
        let (mut seen, mut depth) = (0, 0_i64);
        for (at, _) in selectors.match_indices(root) {
            let [before, after] = [&selectors[..at], &selectors[at + root.len()..]];
            let is_whole = !before.ends_with(':') && !after.starts_with(is_in_name);
            depth += opened(&selectors[seen..at]);
            seen = at;
            if is_whole && depth == 0 {
                edits.replace(head.start + at..head.start + at + root.len(), plain.to_owned());
            }
        }
        for bracket in brackets(selectors) {
            let inner = &selectors[bracket.clone()];
            let Some((name, rest)) = inner.split_once(|c: char| !is_in_name(c)) else {
                continue;
            };
            let sign = &inner[name.len()..];
            let found = SIGNS.iter().find(|(_, css, _)| sign.starts_with(css));
            let is_value = rest.strip_prefix('=').is_some_and(is_value);
            if let Some((_, css, plain)) = found.filter(|_| left > 0 && is_value && !name.is_empty()) {
                left -= 1;
                let at = head.start + bracket.start + name.len();
                edits.replace(at..at + css.len(), (*plain).to_owned());
            }
        }
    }
    edits.apply_to(text)
}

/// A comparison with a part of an attribute, and where it stands with its brackets.
#[derive(Debug)]
pub(super) struct Comparison<'t> {
    pub(super) place: Range<usize>,
    pub(super) name: &'t str,
    pub(super) part: Part,
    pub(super) wanted: &'t str,
}

/// The comparisons with parts of attributes in a rewritten document.
pub(super) fn comparisons(text: &str) -> Vec<Comparison<'_>> {
    let mut found = Vec::new();
    if !text.contains("style") || !SIGNS.iter().any(|(_, _, sign)| text.contains(sign)) {
        return found;
    }
    let markup = Markup::of(text);
    for head in markup.sheets.iter().flat_map(|sheet| heads(text, sheet.clone())) {
        let selectors = &text[head.clone()];
        for bracket in brackets(selectors) {
            let inner = &selectors[bracket.clone()];
            if let Some((name, wanted)) = inner.split_once('=')
                && let Some((name, part)) = Part::of(name)
                && is_value(wanted)
            {
                found.push(Comparison {
                    place: head.start + bracket.start - 1..head.start + bracket.end + 1,
                    name,
                    part,
                    wanted: wanted.trim_matches(['"', '\'']),
                });
            }
        }
    }
    found.truncate(MOST_COMPARISONS);
    found
}

/// Where the names of elements stand in the selectors of a document's style sheets.
pub(super) fn names(text: &str) -> Vec<Range<usize>> {
    let mut found = Vec::new();
    if !text.contains("style") {
        return found;
    }
    let markup = Markup::of(text);
    for head in markup.sheets.iter().flat_map(|sheet| heads(text, sheet.clone())) {
        let selectors = &text[head.clone()];
        let (mut depth, mut at, mut before) = (0, 0, ' ');
        while let Some(c) = selectors[at..].chars().next() {
            let rest = &selectors[at..];
            let length = rest.find(|c| !is_in_name(c)).unwrap_or(rest.len()).max(c.len_utf8());
            if depth == 0 && is_in_name(c) && !matches!(before, '.' | '#' | ':' | '|' | '\\') {
                found.push(head.start + at..head.start + at + length);
            }
            depth += opened(&rest[..length]);
            (before, at) = (c, at + length);
        }
    }
    found
}

/// What stands before the blocks of a sheet's rules, but for those with an `@`.
fn heads(text: &str, sheet: Range<usize>) -> Vec<Range<usize>> {
    let css = &text[sheet.clone()];
    let mut found = Vec::new();
    let mut at = 0;
    while let Some(open) = block_start(&css[at..]).map(|open| at + open) {
        // What stands before the selectors.
        let before = ["*/", "CDATA[", ";"];
        let starts = before
            .into_iter()
            .filter_map(|mark| Some(css[at..open].rfind(mark)? + mark.len()));
        let start = at + starts.max().unwrap_or(0);
        if !css[start..open].trim_start().starts_with('@') {
            found.push(sheet.start + start..sheet.start + open);
        }
        at = (open + 1 + block_end(&css[open + 1..]) + 1).min(css.len());
    }
    found
}

/// The insides of the brackets of selectors.
fn brackets(selectors: &str) -> Vec<Range<usize>> {
    let mut found = Vec::new();
    let mut at = 0;
    while let Some(start) = selectors[at..].find('[').map(|open| at + open + 1) {
        let mut quote = None;
        let end = selectors[start..].char_indices().find(|(_, c)| {
            match (quote, *c) {
                (Some(open), c) if open == c => quote = None,
                (None, '"' | '\'') => quote = Some(*c),
                _ => {}
            }
            quote.is_none() && *c == ']'
        });
        let Some((length, _)) = end else { break };
        found.push(start..start + length);
        at = start + length;
    }
    found
}

/// How many brackets and parentheses more are opened than closed; no selector of the rule itself stands inside of them.
fn opened(selectors: &str) -> i64 {
    let of_one = |byte: u8| match byte {
        b'[' | b'(' => 1,
        b']' | b')' => -1,
        _ => 0,
    };
    selectors.bytes().map(of_one).sum()
}

fn is_in_name(c: char) -> bool {
    c.is_alphanumeric() || matches!(c, '-' | '_')
}

/// Whether the reader of styles takes this as the value of an attribute.
fn is_value(value: &str) -> bool {
    let quoted = |quote| {
        let inner: Option<&str> = value.strip_prefix(quote).and_then(|rest| rest.strip_suffix(quote));
        inner.is_some_and(|inner| !inner.contains(['"', '\'', '\\', '&', '<']))
    };
    let is_name = value.starts_with(|c: char| c.is_ascii_alphabetic()) && value.chars().all(is_in_name);
    quoted('"') || quoted('\'') || is_name
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn selectors_become_others_of_the_same_length() {
        for (css, expected) in [
            (
                "/* x */ :root, svg:root > a, :rooted, a::root, a:not(:root) { x: ':root' } :root{}",
                "/* x */ [_r_], svg[_r_] > a, :rooted, a::root, a:not(:root) { x: ':root' } [_r_]{}",
            ),
            (
                "a[b^='c^='][d$=e] [f*=\"]\"] { g: [h^=i] } [j^=] {} [k ^= l] {} [m$='\\'']{}",
                "a[b_='c^='][d-=e] [fQ=\"]\"] { g: [h^=i] } [j^=] {} [k ^= l] {} [m$='\\'']{}",
            ),
            (
                "@font-face { a: b } [c^=d] { e: f } g[h=':root']{}",
                "@font-face { a: b } [c_=d] { e: f } g[h=':root']{}",
            ),
        ] {
            let [text, expected] = [css, expected].map(|css| format!("<svg><style>{css}</style></svg>"));
            let plain = rewritten(Cow::Borrowed(&text));
            assert_eq!(plain, expected);
        }
        for stays in ["<svg><a b='[c^=d]'>:root{}</a><style/></svg>", "<svg>[a^=b]{}</svg>"] {
            assert_eq!(rewritten(Cow::Borrowed(stays)), stays);
        }
    }

    #[test]
    fn names_of_elements_are_found_beside_all_else() {
        let text = "<svg><style>/* x */ a, b.c>d#e[f=g]:first-child + h:not(i) { j: k } @media l { m {} } .n o{}</style>\
                    <style><![CDATA[p{}]]></style><text>q{}</text></svg>";
        let found: Vec<&str> = names(text).into_iter().map(|name| &text[name]).collect();
        assert_eq!(found, ["a", "b", "d", "h", "o", "p"]);
    }

    #[test]
    fn comparisons_are_found_where_they_were_written() {
        let text = rewritten(Cow::Borrowed(
            "<svg><style>a[b^='c d'] {} [e*=f] {} [g=h] {}</style></svg>",
        ));
        let found = comparisons(&text);
        let told: Vec<_> = found
            .iter()
            .map(|found| (&text[found.place.clone()], found.name, found.part, found.wanted))
            .collect();
        assert_eq!(
            told,
            [("[b_='c d']", "b", Part::Start, "c d"), ("[eQ=f]", "e", Part::Any, "f")]
        );
        for (part, is) in [
            (Part::Start, [true, false, true]),
            (Part::End, [false, true, true]),
            (Part::Any, [true; 3]),
        ] {
            assert_eq!(["ab", "ca", "a"].map(|value| part.is_in(value, "a")), is);
            assert!(!part.is_in("a", ""));
        }
        assert_eq!(Part::of("b"), None);
    }
}
