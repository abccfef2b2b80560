//! Which rules of style sheets are for a picture on a screen (Media Queries 4). The reader of styles takes none inside of `@media`
//! and all of a sheet with `media`, so blanks take the places of what does not hold, and of the braces around what does: every
//! place in the document stays where it is.

use std::borrow::Cow;
use std::ops::Range;

use super::edits::Edits;
use super::substitutes::{Markup, block_end};

/// Rules for media inside each other, at most: those further inside are not looked at.
const MAX_DEPTH: usize = 10;

/// The start of a rule that asks for a medium.
const RULE: &str = "@media";

/// The document in which rules for screens are plain ones, and sheets for other media empty.
pub(super) fn on_screen(text: Cow<'_, str>) -> Cow<'_, str> {
    if !text.contains("media") {
        return text;
    }
    let markup = Markup::of(&text);
    let mut edits = Edits::default();
    for sheet in &markup.sheets {
        let medium = markup.tag_of(sheet).and_then(|tag| attribute(&text[tag], "media"));
        if medium.is_some_and(|medium| applies(medium) != Some(true)) {
            edits.replace(sheet.clone(), emptied(&text[sheet.clone()]));
        } else {
            unwrap(&text, sheet.clone(), &mut edits);
        }
    }
    edits.apply_to(text)
}

/// Whether a list of media holds a picture on a screen; `None` where that depends on a condition, such as the width of a window.
pub(super) fn applies(list: &str) -> Option<bool> {
    let mut is_open = false;
    let lower = list.trim().to_ascii_lowercase();
    if lower.is_empty() {
        return Some(true);
    }
    for query in outside_parentheses(&lower) {
        match query_applies(query) {
            Some(true) => return Some(true),
            Some(false) => {}
            None => is_open = true,
        }
    }
    (!is_open).then_some(false)
}

/// The queries of a list: commas inside of parentheses divide none.
fn outside_parentheses(list: &str) -> impl Iterator<Item = &str> {
    let mut depth = 0_usize;
    list.split(move |c| {
        match c {
            '(' => depth += 1,
            ')' => depth = depth.saturating_sub(1),
            _ => {}
        }
        c == ',' && depth == 0
    })
}

fn query_applies(query: &str) -> Option<bool> {
    let query = query.trim();
    let end = |word: &str| word.find(|c: char| c.is_ascii_whitespace() || c == '(');
    let first = |text: &str| end(text).unwrap_or(text.len());
    let (word, rest) = query.split_at(first(query));
    let (is_not, medium) = match word {
        "not" => (true, rest.trim_start()),
        "only" => (false, rest.trim_start()),
        _ => (false, query),
    };
    if medium.starts_with('(') {
        return None;
    }
    let (medium, conditions) = medium.split_at(first(medium));
    let is_shown = matches!(medium, "all" | "screen");
    // Without the medium no condition matters.
    let holds = match (is_shown, conditions.trim().is_empty()) {
        (true, false) => None,
        (is_shown, _) => Some(is_shown),
    };
    holds.map(|holds| holds != is_not)
}

/// The value of an attribute of a tag.
fn attribute<'t>(tag: &'t str, name: &str) -> Option<&'t str> {
    tag.match_indices(name).find_map(|(at, _)| {
        let starts = tag[..at].ends_with(|c: char| c.is_ascii_whitespace());
        let value = tag[at + name.len()..].trim_start().strip_prefix('=')?.trim_start();
        let quote = value.chars().next().filter(|c| starts && matches!(c, '"' | '\''))?;
        value[1..].split_once(quote).map(|(value, _)| value)
    })
}

/// A sheet's text with blanks in place of its rules.
fn emptied(sheet: &str) -> String {
    let inner = sheet.find("<![CDATA[").map_or(0, |at| at + 9);
    let end = sheet.rfind("]]>").filter(|end| *end >= inner).unwrap_or(sheet.len());
    // Other markup inside stays whole.
    if sheet[inner..end].contains('<') {
        return sheet.to_owned();
    }
    let blanks = blanks(&sheet[inner..end]);
    format!("{}{blanks}{}", &sheet[..inner], &sheet[end..])
}

/// As many blanks, on as many lines.
fn blanks(text: &str) -> String {
    let bytes = text.bytes();
    bytes.map(|byte| if byte == b'\n' { '\n' } else { ' ' }).collect()
}

/// Takes `@media … {` and its closing brace from around rules that hold.
fn unwrap(text: &str, sheet: Range<usize>, edits: &mut Edits) {
    let css = &text[sheet.clone()];
    let mut at = 0;
    let mut around: Vec<usize> = Vec::new();
    while let Some(start) = next_rule(css, at) {
        around.retain(|end| *end > start);
        let rest = &css[start..];
        at = start + RULE.len();
        let Some(open) = rest.find(['{', ';']).filter(|open| rest[*open..].starts_with('{')) else {
            continue;
        };
        let body = start + open + 1;
        let end = body + block_end(&css[body..]);
        if around.len() < MAX_DEPTH && applies(&rest[RULE.len()..open]) == Some(true) {
            around.push(end);
            for range in [start..body, end..(end + 1).min(css.len())] {
                let range = sheet.start + range.start..sheet.start + range.end;
                edits.replace(range.clone(), blanks(&text[range]));
            }
            at = body;
        } else {
            at = end;
        }
    }
}

/// Where the next `@media` begins from `from` on, outside of comments and strings.
fn next_rule(css: &str, from: usize) -> Option<usize> {
    let mut at = from;
    loop {
        let rest = css.get(at..)?;
        at += rest.find(['@', '/', '"', '\''])?;
        let rest = &css[at..];
        if let Some(after) = rest.strip_prefix(RULE)
            && !after.starts_with(|c: char| c.is_ascii_alphanumeric() || c == '-')
        {
            return Some(at);
        }
        at += match rest.as_bytes() {
            [b'/', b'*', ..] => 2 + rest[2..].find("*/")? + 2,
            // A string ends with its line at the latest.
            [quote @ (b'"' | b'\''), ..] => 2 + rest[1..].find([char::from(*quote), '\n'])?,
            _ => 1,
        };
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lists_of_media_hold_a_screen_or_not() {
        for list in [
            "",
            "all",
            "screen",
            " Only SCREEN",
            "print, screen",
            "not print",
            "not print and (color)",
        ] {
            assert_eq!(applies(list), Some(true), "{list}");
        }
        for list in [
            "print",
            "not all",
            "not screen",
            "speech, print and (width)",
            "only",
            "x(y)",
        ] {
            assert_eq!(applies(list), Some(false), "{list}");
        }
        for list in [
            "(min-width: 10px)",
            "screen and (color)",
            "print, (a, b)",
            "not screen and (color)",
            "not (hover)",
            "screen and(color)",
        ] {
            assert_eq!(applies(list), None, "{list}");
        }
    }

    #[track_caller]
    fn assert_becomes(text: &str, expected: &str) {
        let plain = on_screen(Cow::Borrowed(text));
        assert_eq!(plain.len(), text.len(), "every place stays: {plain}");
        assert_eq!(
            plain.matches('\n').count(),
            text.matches('\n').count(),
            "and every line"
        );
        let words = |text: &str| text.split_whitespace().collect::<Vec<_>>().join(" ");
        assert_eq!(words(&plain), words(expected), "{text}");
    }

    #[test]
    fn rules_for_screens_are_plain_and_others_stay_apart() {
        assert_becomes(
            "<svg><style>a{x:1} @media screen,\nprint { b{x:2} @media all{c{x:3}} } d{x:4}</style></svg>",
            "<svg><style>a{x:1} b{x:2} c{x:3} d{x:4}</style></svg>",
        );
        for stays in [
            "<svg><style>@media print{@media screen{a{x:1}}} @media (width){b{x:2}}</style></svg>",
            "<svg><style>/* @media screen{a{x:1}} */ a[b='@media all{']{x:1} @media-x all{} @media;{}</style></svg>",
            "<svg><style media='screen'>a{x:1}</style><text>@media all{a{}}</text></svg>",
        ] {
            assert_becomes(stays, stays);
        }
        assert_becomes("<svg><style>@media all{a{x:1}", "<svg><style> a{x:1}");
    }

    #[test]
    fn sheets_for_other_media_are_empty() {
        assert_becomes(
            "<svg><style type='text/css' media='print'>a{x:1}\n</style><style media = \"(width)\"><![CDATA[a{}]]></style></svg>",
            "<svg><style type='text/css' media='print'> </style><style media = \"(width)\"><![CDATA[ ]]></style></svg>",
        );
    }
}
