//! What newer CSS writes where SVG has a plain value: `light-dark()`, `var()` and custom properties, percentages of opacity in
//! `rgb()`, colours of other spaces, functions inside functions.
//!
//! Drawing programs write them (draw.io, Figma, Mermaid), and the reader of styles stops at the first that it does not know,
//! with all that follows in the same style. So plain values take their places, filled up with blanks: every place in the
//! document stays where it is.

use std::borrow::Cow;
use std::collections::HashMap;
use std::ops::Range;

use super::css::{block_end, block_start};
use super::css_colors;
use super::edits::Edits;

/// Most bytes of one function; a longer one stays as it is.
const MAX_LENGTH: usize = 400;
/// Most functions that are looked into.
const MAX_FUNCTIONS: usize = 1_000_000;
/// Functions inside each other, at most.
const MAX_DEPTH: usize = 8;
/// The functions that have a plain value, besides those of colours.
const FUNCTIONS: [&str; 4] = ["light-dark", "var", "rgb", "rgba"];
/// Whose custom properties hold for the whole document.
const ROOTS: [&str; 3] = [":root", "svg", "*"];

/// What there is something to do for, besides custom properties and functions inside others.
const SIGNS: [&str; 9] = [
    "var(",
    "light-dark(",
    "%)",
    "lab(",
    "lch(",
    "color(",
    "(none ",
    "currentcolor",
    "rebeccapurple",
];

/// The custom properties that hold somewhere: those of the document, and of the elements around, with where each ends.
#[derive(Debug, Default)]
struct Properties<'t> {
    everywhere: HashMap<&'t str, String>,
    around: Vec<(usize, HashMap<&'t str, String>)>,
}

impl<'t> Properties<'t> {
    fn get(&self, name: &str) -> Option<&String> {
        let nearest = self.around.iter().rev().find_map(|(_, own)| own.get(name));
        nearest.or_else(|| self.everywhere.get(name))
    }

    /// Forgets those of elements that end before `at`.
    fn leave(&mut self, at: usize) {
        while self.around.pop_if(|(end, _)| *end <= at).is_some() {}
    }

    /// Takes those of an element over.
    fn enter(&mut self, text: &'t str, scope: &Scope) {
        self.around.push((scope.end, HashMap::new()));
        for (name, value) in declared(&text[scope.style.clone()]) {
            let value = plain(value, self, 0);
            if let Some((_, own)) = self.around.last_mut() {
                own.extend(value.map(|value| (name, value)));
            }
        }
    }
}

/// An element whose style has custom properties.
#[derive(Debug)]
struct Scope {
    start: usize,
    end: usize,
    style: Range<usize>,
}

/// The document with plain values, as long as before.
pub(super) fn substituted(text: &str) -> Cow<'_, str> {
    let has = |sign: &str| text.contains(sign);
    if !SIGNS.into_iter().any(has) && !has_custom_properties(text) && !is_nested(text) {
        return Cow::Borrowed(text);
    }
    let markup = Markup::of(text);
    let mut properties = markup.properties(text);
    let mut edits = Edits::default();
    let mut left = MAX_FUNCTIONS;
    for sheet in &markup.sheets {
        substitute(text, sheet.clone(), (&properties, &mut left), &mut edits);
    }
    let mut scopes = markup.scopes.iter().peekable();
    for tag in &markup.tags {
        properties.leave(tag.start);
        while let Some(scope) = scopes.next_if(|scope| scope.start <= tag.start) {
            properties.enter(text, scope);
        }
        substitute(text, tag.clone(), (&properties, &mut left), &mut edits);
    }
    let mut text = edits.apply_to(Cow::Borrowed(text));
    let mut edits = Edits::default();
    for part in markup.tags.iter().chain(&markup.sheets) {
        words(&text, part.clone(), &mut edits);
    }
    text = edits.apply_to(text);
    let mut edits = Edits::default();
    for style in &markup.styles {
        unnest(&text, style.clone(), 1, &mut edits);
    }
    for sheet in &markup.sheets {
        unnest(&text, sheet.clone(), 0, &mut edits);
    }
    text = edits.apply_to(text);
    text
}

/// Puts plain values in the places of functions in a part of the document.
fn substitute(text: &str, part: Range<usize>, (properties, left): (&Properties<'_>, &mut usize), edits: &mut Edits) {
    for (span, value) in functions(text, part, left) {
        let width = span.len();
        let stands_for = plain(value, properties, 0).filter(|plain| plain != value);
        let stands_for = stands_for.and_then(|plain| {
            if plain.len() <= width {
                Some(plain)
            } else {
                css_colors::shortest(&plain).filter(|plain| plain.len() <= width)
            }
        });
        if let Some(plain) = stands_for {
            let blanks = width - plain.len();
            edits.replace(span, plain + &" ".repeat(blanks));
        }
    }
}

/// Whether there may be a name that begins as those of custom properties do.
fn has_custom_properties(text: &str) -> bool {
    text.match_indices("--").any(|(at, dashes)| {
        let begins_comment = text[..at].ends_with("<!");
        !begins_comment && text[at + dashes.len()..].starts_with(|c: char| c.is_ascii_alphabetic())
    })
}

/// Whether a parenthesis opens inside another.
fn is_nested(text: &str) -> bool {
    let mut parentheses = text.bytes().filter(|byte| matches!(byte, b'(' | b')'));
    let mut last = b')';
    parentheses.any(|byte| std::mem::replace(&mut last, byte) == b'(' && byte == b'(')
}

/// Where in a document styles stand.
#[derive(Debug, Default)]
pub(super) struct Markup {
    /// Start tags, the root's first.
    tags: Vec<Range<usize>>,
    /// Values of attributes `style`.
    pub(super) styles: Vec<Range<usize>>,
    /// Contents of elements `style`.
    pub(super) sheets: Vec<Range<usize>>,
    /// Elements whose style may have custom properties.
    scopes: Vec<Scope>,
}

impl Markup {
    pub(super) fn of(text: &str) -> Self {
        let mut found = Self::default();
        let mut at = 0;
        // Which scope each open element is, if it is one.
        let mut open: Vec<Option<usize>> = Vec::new();
        while let Some(start) = text[at..].find('<').map(|start| at + start) {
            let rest = &text[start..];
            let (skipped, end) = match rest.as_bytes() {
                [b'<', b'!', b'-', b'-', ..] => (true, rest.find("-->")),
                [b'<', b'!', b'[', ..] => (true, rest.find("]]>")),
                [b'<', b'!' | b'?' | b'/', ..] => (true, Some(1)),
                tag => (false, tag_end(tag)),
            };
            let Some(end) = end.map(|end| start + end) else {
                break;
            };
            at = end.max(start + 1);
            if rest.starts_with("</")
                && let Some(scope) = open.pop().flatten()
            {
                found.scopes[scope].end = start;
            }
            if !skipped {
                let scope = found.tag(text, start..end);
                if text[..end].ends_with('/') {
                    // Nothing is inside.
                    if let Some(scope) = scope {
                        found.scopes[scope].end = end;
                    }
                } else {
                    open.push(scope);
                }
                if is_sheet(&text[start..end]) {
                    let begin = end + 1;
                    at = text[begin..].find("</").map_or(text.len(), |length| begin + length);
                    found.sheets.push(begin..at);
                }
            }
        }
        found
    }

    /// Notes a tag; which scope it begins, if it does.
    fn tag(&mut self, text: &str, range: Range<usize>) -> Option<usize> {
        let tag = &text[range.clone()];
        self.tags.push(range.clone());
        let style = tag.match_indices("style").find_map(|(at, name)| {
            let is_start = tag[..at].ends_with(|c: char| c.is_ascii_whitespace());
            let value = tag[at + name.len()..].trim_start().strip_prefix('=')?.trim_start();
            let quote = value.chars().next().filter(|c| is_start && matches!(c, '"' | '\''))?;
            let begin = range.end - value.len() + 1;
            Some(begin..begin + value[1..].find(quote)?)
        });
        self.styles.extend(style.clone());
        let style = style.filter(|style| text[style.clone()].contains("--"))?;
        self.scopes.push(Scope {
            start: range.start,
            end: text.len(),
            style,
        });
        Some(self.scopes.len() - 1)
    }

    /// The custom properties that style sheets give the root element.
    fn properties<'t>(&self, text: &'t str) -> Properties<'t> {
        let mut properties = Properties::default();
        for sheet in &self.sheets {
            let mut rest = &text[sheet.clone()];
            while let Some(open) = block_start(rest) {
                let (selector, block) = (&rest[..open], &rest[open + 1..]);
                let selector = ["*/", "CDATA["]
                    .into_iter()
                    .fold(selector, |rest, mark| rest.rsplit(mark).next().unwrap_or(""));
                let (body, after) = block.split_at(block_end(block));
                if selector.split(',').any(|selector| ROOTS.contains(&selector.trim())) {
                    for (name, value) in declared(body) {
                        let value = plain(value, &properties, 0);
                        properties.everywhere.extend(value.map(|value| (name, value)));
                    }
                }
                rest = after.strip_prefix('}').unwrap_or("");
            }
        }
        // Its own style counts for style sheets, too.
        let root_end = self.tags.first().map_or(0, |tag| tag.end);
        if let Some(style) = self.styles.first().filter(|style| style.end <= root_end) {
            for (name, value) in declared(&text[style.clone()]) {
                let value = plain(value, &properties, 0);
                properties.everywhere.extend(value.map(|value| (name, value)));
            }
        }
        properties
    }
}

/// The length of a tag at the start of `markup`, without the bracket that ends it.
fn tag_end(markup: &[u8]) -> Option<usize> {
    let mut quote = None;
    markup.iter().position(|&byte| {
        match (quote, byte) {
            (None, b'"' | b'\'') => quote = Some(byte),
            (Some(open), close) if open == close => quote = None,
            _ => {}
        }
        quote.is_none() && byte == b'>'
    })
}

/// Whether a tag, without its last bracket, opens a style sheet.
fn is_sheet(tag: &str) -> bool {
    let name = tag[1..].split([' ', '\t', '\r', '\n', '/']).next().unwrap_or("");
    (name == "style" || name.ends_with(":style")) && !tag.ends_with('/')
}

/// The custom properties of a style.
fn declared(style: &str) -> impl Iterator<Item = (&str, &str)> {
    style.split(';').filter_map(|declaration| {
        let (name, value) = declaration.split_once(':')?;
        let name = name.rsplit("*/").next().unwrap_or("").trim();
        let is_one = name.starts_with("--") && value.len() <= MAX_LENGTH;
        is_one.then_some((name, value.trim()))
    })
}

/// The outermost functions in a part of a text that may have a plain value; `left` is how many more there may be.
fn functions<'t>(text: &'t str, part: Range<usize>, left: &mut usize) -> Vec<(Range<usize>, &'t str)> {
    let mut found = Vec::new();
    let mut at = part.start;
    while let Some(open) = text[at..part.end].find('(').map(|open| at + open) {
        at = open + 1;
        let before = &text[part.start..open];
        let names = FUNCTIONS.into_iter().chain(css_colors::FUNCTIONS);
        let is_ours = names.into_iter().find(|name| is_call(before, name));
        let Some(name) = is_ours.filter(|_| *left > 0) else {
            continue;
        };
        *left -= 1;
        if let Some(close) = closing(&text[at..part.end]) {
            at += close + 1;
            let span = open - name.len()..at;
            found.push((span.clone(), &text[span]));
        }
    }
    found
}

/// Whether what stands before a parenthesis is this name, whole.
fn is_call(before: &str, name: &str) -> bool {
    let rest = before.strip_suffix(name);
    rest.is_some_and(|rest| !rest.ends_with(|c: char| c.is_ascii_alphanumeric() || matches!(c, '-' | '_')))
}

/// How far the parenthesis is that closes one before `text`.
fn closing(text: &str) -> Option<usize> {
    let mut depth = 1;
    text.bytes().take(MAX_LENGTH).position(|byte| {
        match byte {
            b'(' => depth += 1,
            b')' => depth -= 1,
            _ => {}
        }
        depth == 0
    })
}

/// A value with what its functions stand for; `None` where that is not known.
fn plain(value: &str, properties: &Properties<'_>, depth: usize) -> Option<String> {
    if depth > MAX_DEPTH {
        return None;
    }
    let mut left = MAX_LENGTH;
    let mut edits = Edits::default();
    for (span, function) in functions(value, 0..value.len(), &mut left) {
        let (name, rest) = function.split_once('(')?;
        let arguments = rest.strip_suffix(')')?;
        let (first, second) = split(arguments);
        let stands_for = match name {
            "light-dark" => plain(first, properties, depth + 1)?,
            "var" => match (properties.get(first.trim()), second) {
                (Some(value), _) => value.clone(),
                (None, second) => plain(second?, properties, depth + 1)?,
            },
            _ => {
                let arguments = plain(arguments, properties, depth + 1)?;
                let color = match name {
                    "rgb" | "rgba" => translucent(&arguments),
                    _ => css_colors::plain(name, &arguments),
                };
                color.unwrap_or_else(|| format!("{name}({arguments})"))
            }
        };
        edits.replace(span, stands_for.trim().to_owned());
    }
    let plain = edits.apply_to(Cow::Borrowed(value)).into_owned();
    // Properties that name others several times would grow without end.
    Some(plain).filter(|plain| !plain.trim().is_empty() && plain.len() <= MAX_LENGTH)
}

/// The first argument, and all that follow.
fn split(arguments: &str) -> (&str, Option<&str>) {
    let mut depth = 0;
    let comma = arguments.bytes().position(|byte| {
        match byte {
            b'(' => depth += 1,
            b')' => depth -= 1,
            _ => {}
        }
        depth == 0 && byte == b','
    });
    match comma {
        Some(at) => (&arguments[..at], Some(&arguments[at + 1..])),
        None => (arguments, None),
    }
}

/// A colour by its channels, with opacity in percent.
fn translucent(arguments: &str) -> Option<String> {
    let (channels, opacity) = arguments.rsplit_once(['/', ','])?;
    let opacity: f64 = opacity.trim().strip_suffix('%')?.parse().ok()?;
    let channels: Vec<&str> = channels
        .split([' ', ','])
        .filter(|channel| !channel.is_empty())
        .collect();
    let [red, green, blue] = channels.as_slice() else {
        return None;
    };
    let opacity = (opacity / 100.0).clamp(0.0, 1.0);
    // Three digits, without the zero before them.
    let opacity = format!("{opacity:.3}");
    Some(format!(
        "rgba({red},{green},{blue},{})",
        opacity.trim_start_matches('0')
    ))
}

/// Puts words for colours in the places of those that SVG's readers do not know.
fn words(text: &str, part: Range<usize>, edits: &mut Edits) {
    let here = &text[part.clone()];
    for (word, plain) in css_colors::WORDS {
        for (at, _) in here.match_indices(word) {
            let ends =
                !here[at + word.len()..].starts_with(|c: char| c.is_ascii_alphanumeric() || matches!(c, '-' | '_'));
            if ends && is_value(here[..at].trim_end()) {
                let blanks = " ".repeat(word.len() - plain.len());
                edits.replace(
                    part.start + at..part.start + at + word.len(),
                    format!("{plain}{blanks}"),
                );
            }
        }
    }
}

/// Whether a colour may follow: behind the name of such a property in a style or of such an attribute.
fn is_value(before: &str) -> bool {
    let name = before.strip_suffix(':').or_else(|| {
        let attribute = before.strip_suffix(['"', '\''])?;
        attribute.trim_end().strip_suffix('=')
    });
    let name = name.unwrap_or("").trim_end();
    ["fill", "stroke", "color"]
        .into_iter()
        .any(|property| name.ends_with(property))
}

/// Takes the parentheses of functions inside functions away, and the names of custom properties. `braces` is how many are open
/// where declarations stand.
fn unnest(text: &str, part: Range<usize>, braces: usize, edits: &mut Edits) {
    let mut quote = None;
    let [mut depth, mut braces] = [0, braces];
    let mut last = b';';
    for (at, &byte) in text.as_bytes()[part.clone()].iter().enumerate() {
        let here = part.start + at;
        match (quote, byte) {
            (Some(open), close) if open == close => quote = None,
            (None, b'"' | b'\'') => quote = Some(byte),
            (None, b'{' | b'}' | b';') => {
                depth = 0;
                braces = match byte {
                    b'{' => braces + 1,
                    b'}' => braces.saturating_sub(1),
                    _ => braces,
                };
            }
            (None, b'(') if braces > 0 => {
                depth += 1;
                if depth > 1 {
                    edits.replace(here..here + 1, " ".to_owned());
                }
            }
            (None, b')') if depth > 0 => {
                if depth > 1 {
                    edits.replace(here..here + 1, " ".to_owned());
                }
                depth -= 1;
            }
            (None, b'-') if matches!(last, b';' | b'{' | b'/') && text[here..].starts_with("--") && braces > 0 => {
                edits.replace(here..here + 1, "x".to_owned());
            }
            _ => {}
        }
        if !byte.is_ascii_whitespace() {
            last = byte;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[track_caller]
    fn assert_becomes(text: &str, expected: &str) {
        let plain = substituted(text);
        assert_eq!(plain.len(), text.len(), "every place stays: {plain}");
        let words = |text: &str| text.split_whitespace().collect::<Vec<_>>().join(" ");
        assert_eq!(words(&plain), expected, "{text}");
    }

    #[test]
    fn functions_become_what_they_stand_for() {
        for (text, expected) in [
            (
                "<svg><rect fill='light-dark(rgb(0, 0, 0), #fff)'/></svg>",
                "<svg><rect fill='rgb(0, 0, 0) '/></svg>",
            ),
            (
                "<svg><rect style='fill: light-dark(#ffcc99, var(--x, #663600)); stroke: red'/></svg>",
                "<svg><rect style='fill: #ffcc99 ; stroke: red'/></svg>",
            ),
            (
                "<svg><rect fill='var(--fill-0, #D9D9D9)' stroke='var(--a, var(--b, red))'/></svg>",
                "<svg><rect fill='#D9D9D9 ' stroke='red '/></svg>",
            ),
            (
                "<svg><rect fill='rgb(255 0 0 / 50%)' stroke='rgba(1, 2, 3, 100%)'/></svg>",
                "<svg><rect fill='rgba(255,0,0,.500)' stroke='rgba(1,2,3,1.000) '/></svg>",
            ),
            (
                "<svg><rect fill='oklch(51.975% 0.17686 142.495)' style='stroke:color(srgb 1 var(--x, 0.5) 0 / 50%);fill:red'/></svg>",
                "<svg><rect fill='#008000 ' style='stroke:#ff800080 ;fill:red'/></svg>",
            ),
            (
                "<svg id='rebeccapurple'><style>a{fill:currentcolor}</style><rect fill='rebeccapurple' stroke='currentcolor'/></svg>",
                "<svg id='rebeccapurple'><style>a{fill:currentColor}</style><rect fill='#663399 ' stroke='currentColor'/></svg>",
            ),
        ] {
            assert_becomes(text, expected);
        }
    }

    #[test]
    fn custom_properties_of_the_root_hold_everywhere() {
        assert_becomes(
            "<svg style='--b: blue'><style>:root { --c: red; } @media print { :root { --c: none; } } rect { --d: 1; fill: \
             var(--c) }</style><rect stroke='var(--b)'/></svg>",
            "<svg style='x-b: blue'><style>:root { x-c: red; } @media print { :root { x-c: none; } } rect { x-d: 1; fill: \
             red }</style><rect stroke='blue '/></svg>",
        );
    }

    #[test]
    fn custom_properties_of_an_element_hold_inside_it() {
        assert_becomes(
            "<svg><g style='--c: red'><rect fill='var(--c, blue)'/><g style='--c: lime; --d: var(--c)'><br/><rect \
             fill='var(--c)' stroke='var(--d)'/></g><rect fill='var(--c)'/></g><rect fill='var(--c, blue)'/>\
             <rect style='--c: rgb(255, 0, 0); fill: var(--c)'/></svg>",
            "<svg><g style='x-c: red'><rect fill='red '/><g style='x-c: lime; x-d: lime '><br/><rect \
             fill='lime ' stroke='lime '/></g><rect fill='red '/></g><rect fill='blue '/>\
             <rect style='x-c: rgb(255, 0, 0); fill: #f00 '/></svg>",
        );
    }

    #[test]
    fn properties_that_multiply_have_no_value() {
        let twenty = |i: i32| format!("--a{i}: {};", format!("var(--a{}) ", i - 1).repeat(20));
        let chain: String = (1..30).map(twenty).collect();
        let text = format!("<svg style='--a0: lime; {chain}'><rect fill='var(--a29, red)' stroke='var(--a1)'/></svg>");
        let plain = substituted(&text);
        assert!(
            plain.contains("fill='red ") && plain.len() == text.len(),
            "the fallback"
        );
    }

    #[test]
    fn functions_inside_others_end_no_style() {
        assert_becomes(
            "<svg><g style='filter: drop-shadow(0 0 2px rgb(0,0,0)); fill: url(\"a(b)\")'/></svg>",
            "<svg><g style='filter: drop-shadow(0 0 2px rgb 0,0,0 ); fill: url(\"a(b)\")'/></svg>",
        );
    }

    #[test]
    fn what_is_no_style_stays() {
        for text in [
            "<svg><text>var(--a, b) -- (())</text><!-- <g fill='var(--a, b)'/> --></svg>",
            "<svg><rect fill='var(--a)' id='myvar(1,2)'/></svg>",
            "<svg><rect fill='color(xyz 1 0 0)' stroke='lab(from red l a b)' class='currentcolor'/></svg>",
            "<svg><rect fill='var(--a, var(--b))' transform='rotate(3)'/></svg>",
            "<svg><style>g:not(:nth-child(2)) { fill: red }</style></svg>",
            "<svg style='fill:var(",
            "<svg><style>:root{",
        ] {
            assert_eq!(substituted(text), text);
        }
    }
}
