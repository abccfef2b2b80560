//! Declarations that the reader of styles cannot read: it stops at the first, and what follows in the same block is lost. By CSS
//! only that one has no effect (CSS Syntax 3, section 5.5.5), so blanks take its place: every place in the document stays where
//! it is.

use std::borrow::Cow;
use std::ops::Range;

use simplecss::DeclarationTokenizer;

use super::css::{block_end, block_start};
use super::css_colors;
use super::edits::Edits;
use super::substitutes::Markup;

/// The document without such declarations, without comments in styles, and without the height of lines in `font`.
pub(super) fn mended(text: Cow<'_, str>) -> Cow<'_, str> {
    if !text.contains("style") {
        return text;
    }
    let markup = Markup::of(&text);
    let mut blocks = markup.styles;
    let mut comments = Edits::default();
    for sheet in markup.sheets {
        blocks.extend(blocks_of_sheet(&text, sheet));
    }
    for block in &blocks {
        for comment in comments_in(&text[block.clone()]) {
            blank(&text, moved(comment, block.start), &mut comments);
        }
    }
    let text = comments.apply_to(text);
    let mut edits = Edits::default();
    for block in blocks {
        mend(&text, block, &mut edits);
    }
    edits.apply_to(text)
}

fn moved(range: Range<usize>, by: usize) -> Range<usize> {
    range.start + by..range.end + by
}

/// Puts blanks in the place of a part of `text`; its lines stay.
fn blank(text: &str, range: Range<usize>, edits: &mut Edits) {
    let blanks = text.as_bytes()[range.clone()]
        .iter()
        .map(|byte| if *byte == b'\n' { '\n' } else { ' ' });
    edits.replace(range, blanks.collect());
}

/// The insides of a style sheet's rules, but for those with an `@`, which are read elsewhere or not at all.
fn blocks_of_sheet(text: &str, sheet: Range<usize>) -> Vec<Range<usize>> {
    let css = &text[sheet.clone()];
    let mut found = Vec::new();
    let mut at = 0;
    while let Some(open) = block_start(&css[at..]).map(|open| at + open) {
        let head = &css[at..open];
        let end = open + 1 + block_end(&css[open + 1..]);
        // What stands before the selectors.
        let selectors = ["*/", "CDATA[", ";"]
            .into_iter()
            .fold(head, |rest, mark| rest.rsplit(mark).next().unwrap_or(""));
        if !selectors.trim_start().starts_with('@') {
            found.push(moved(open + 1..end, sheet.start));
        }
        at = (end + 1).min(css.len());
    }
    found
}

/// The comments of a block, outside of strings.
fn comments_in(block: &str) -> Vec<Range<usize>> {
    let mut found = Vec::new();
    if !block.contains("/*") {
        return found;
    }
    let bytes = block.as_bytes();
    let mut at = 0;
    while let Some(&byte) = bytes.get(at) {
        let end = match byte {
            b'"' | b'\'' => block[at + 1..].find(char::from(byte)).map(|end| at + 1 + end + 1),
            b'/' if bytes.get(at + 1) == Some(&b'*') => {
                let end = block[at + 2..].find("*/").map(|end| at + 2 + end + 2);
                found.push(at..end.unwrap_or(block.len()));
                end
            }
            _ => Some(at + 1),
        };
        let Some(end) = end else { break };
        at = end;
    }
    found
}

/// Blanks what cannot be read of a block.
fn mend(text: &str, block: Range<usize>, edits: &mut Edits) {
    let mut is_first = true;
    for piece in pieces(&text[block.clone()]) {
        let piece = moved(piece, block.start);
        let declaration = text[piece.clone()].trim_end_matches(';');
        let named = declaration.trim();
        if named.is_empty() {
            // Only at the start of a block it does harm.
            if is_first {
                blank(text, piece, edits);
            }
            continue;
        }
        // What entities stand for is not known here.
        if !is_rule(named) && (is_plain(named) || named.contains('&') || is_read(named)) {
            is_first = false;
            lower_name(text, piece.start, declaration, edits);
            continue;
        }
        let closed = unclosed_color(declaration).filter(|_| piece.end == block.end);
        if let Some((range, color)) = closed {
            is_first = false;
            lower_name(text, piece.start, declaration, edits);
            edits.replace(moved(range, piece.start), color);
            continue;
        }
        let without = line_height(declaration).map(|height| moved(height, piece.start));
        if let Some(height) = without {
            is_first = false;
            blank(text, height, edits);
        } else {
            blank(text, piece, edits);
        }
    }
}

/// Whether this is a rule.
fn is_rule(piece: &str) -> bool {
    !piece.starts_with("--") && piece.contains('{') && piece.ends_with('}')
}

/// Writes the name of a declaration at `start` in small letters, which mean the same (CSS Syntax 3, section 1).
fn lower_name(text: &str, start: usize, declaration: &str, edits: &mut Edits) {
    let name = declaration.split_once(':').map_or("", |(name, _)| name);
    let range = start..start + name.len();
    let is_name = |byte: u8| byte.is_ascii_alphanumeric() || byte == b'-' || byte.is_ascii_whitespace();
    if name.bytes().all(is_name) && name.contains(|c: char| c.is_ascii_uppercase()) {
        edits.replace(range.clone(), text[range].to_ascii_lowercase());
    }
}

/// A colour whose parenthesis the end of the style closes (CSS Syntax 3, section 5.4.9), where it stands, and how it is written
/// in as many characters.
fn unclosed_color(declaration: &str) -> Option<(Range<usize>, String)> {
    let open = declaration
        .rfind('(')
        .filter(|open| !declaration[*open..].contains(')'))?;
    let before = &declaration[..open];
    let start = before
        .rfind(|c: char| !c.is_ascii_alphanumeric())
        .map_or(0, |at| at + 1);
    let color = css_colors::shortest(&format!("{})", &declaration[start..]))?;
    let range = start..declaration.len();
    // Lines stay.
    let range = Some(range).filter(|range| !declaration[range.clone()].contains('\n'))?;
    let blanks = range.len().checked_sub(color.len())?;
    Some((range, color + &" ".repeat(blanks)))
}

/// The declarations of a block, each with the semicolon that ends it.
pub(super) fn pieces(block: &str) -> Vec<Range<usize>> {
    let bytes = block.as_bytes();
    let mut found = Vec::new();
    let [mut start, mut depth] = [0, 0_usize];
    let mut quote = None;
    for (at, &byte) in bytes.iter().enumerate() {
        let ends = match (quote, byte) {
            (Some(open), close) => {
                quote = Some(open).filter(|open| *open != close);
                false
            }
            (None, b'"' | b'\'') => {
                quote = Some(byte);
                false
            }
            (None, b'(' | b'{' | b'[') => {
                depth += 1;
                false
            }
            (None, b')' | b']' | b'}') => {
                depth = depth.saturating_sub(1);
                // A rule inside another ends without a semicolon.
                byte == b'}' && depth == 0
            }
            (None, b';') => depth == 0 && !ends_entity(&block[start..at]),
            _ => false,
        };
        if ends {
            found.push(start..at + 1);
            start = at + 1;
        }
    }
    if start < block.len() {
        found.push(start..block.len());
    }
    found
}

/// Whether a semicolon after `before` belongs to a reference to an entity of XML.
fn ends_entity(before: &str) -> bool {
    before.rsplit_once('&').is_some_and(|(_, name)| {
        !name.is_empty() && name.len() < 12 && name.bytes().all(|byte| byte.is_ascii_alphanumeric() || byte == b'#')
    })
}

/// Whether a declaration has nothing that needs a closer look; most have not.
fn is_plain(declaration: &str) -> bool {
    let Some((name, value)) = declaration.split_once(':') else {
        return false;
    };
    let letters = |byte: u8| byte.is_ascii_alphanumeric() || byte == b'-';
    let starts = name.starts_with(|c: char| c.is_ascii_alphabetic());
    let is_value = |byte: u8| letters(byte) || matches!(byte, b' ' | b'.' | b',' | b'%');
    let value = value.trim();
    let value = value.strip_prefix('#').unwrap_or(value);
    starts && name.trim_end().bytes().all(letters) && !value.is_empty() && value.bytes().all(is_value)
}

/// Whether the reader of styles takes all of a declaration.
fn is_read(declaration: &str) -> bool {
    let Some(read) = DeclarationTokenizer::from(declaration).next() else {
        return false;
    };
    let start = read.value.as_ptr().addr() - declaration.as_ptr().addr();
    let rest = declaration[start + read.value.len()..].trim();
    rest.is_empty() || read.important && rest.strip_prefix('!').is_some_and(|mark| mark.trim() == "important")
}

/// Where in a declaration of `font` the height of lines stands with its slash: no text of a drawing has use for it.
fn line_height(declaration: &str) -> Option<Range<usize>> {
    let (name, value) = declaration.split_once(':')?;
    let slash = name.len() + 1 + value.find('/')?;
    let after = &declaration[slash + 1..];
    let height = after.trim_start();
    let blanks = after.len() - height.len();
    let end = height.find(|c: char| c.is_ascii_whitespace())?;
    let height = slash..slash + 1 + blanks + end;
    let mut without = declaration.to_owned();
    without.replace_range(height.clone(), " ");
    (name.trim() == "font" && is_read(without.trim())).then_some(height)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[track_caller]
    fn assert_becomes(text: &str, expected: &str) {
        let plain = mended(Cow::Borrowed(text));
        assert_eq!(plain.len(), text.len(), "every place stays: {plain}");
        let lines = |text: &str| text.matches('\n').count();
        assert_eq!(lines(&plain), lines(text), "and every line: {plain}");
        let words = |text: &str| text.split_whitespace().collect::<Vec<_>>().join(" ");
        // What ends with a brace leaves the semicolon after it.
        let tidy = |text: &str| words(text).replace("; ;", ";").replace("; }", ";}");
        assert_eq!(tidy(&plain), tidy(expected), "{text}");
    }

    #[test]
    fn declarations_that_nobody_reads_go_alone() {
        for unread in [
            "stroke:",
            "undefined",
            "null",
            "12px",
            "--x:{a:b}",
            "color:red !ie",
            "x:1px\\9",
            "$x:1",
            "aspect-ratio:1/1",
            "background:url(a) center / cover",
            "/* c */",
            "a:b:c",
        ] {
            assert_becomes(
                &format!("<svg><rect style='{unread};\nfill:red'/></svg>"),
                "<svg><rect style=' fill:red'/></svg>",
            );
            assert_becomes(
                &format!("<svg><style>.a{{fill:red;{unread};}} b{{{unread}}}</style></svg>"),
                "<svg><style>.a{fill:red; } b{ }</style></svg>",
            );
        }
        assert_becomes("<svg style=';;fill:red'/>", "<svg style=' fill:red'/>");
    }

    #[test]
    fn rules_inside_others_go() {
        for rule in [
            "rect{fill:red}",
            "a:hover { fill:lime; x:y }",
            "&amp; > b{c:d}",
            "@media x{e:f}",
            "b{}",
        ] {
            assert_becomes(
                &format!("<svg><style>.a{{ stroke:red; {rule} fill:red}}</style></svg>"),
                "<svg><style>.a{ stroke:red; fill:red}</style></svg>",
            );
        }
    }

    #[test]
    fn heights_of_lines_go_from_fonts() {
        assert_becomes(
            "<svg style='font:bold 40px/1.2 sans-serif;fill:red'/>",
            "<svg style='font:bold 40px sans-serif;fill:red'/>",
        );
        assert_becomes(
            "<svg><style>text{font:40px / 2em 'A B', serif}</style></svg>",
            "<svg><style>text{font:40px 'A B', serif}</style></svg>",
        );
    }

    #[test]
    fn names_are_small_and_colours_end_with_their_style() {
        assert_becomes(
            "<svg style='FILL:Red;Stroke : RED'/>",
            "<svg style='fill:Red;stroke : RED'/>",
        );
        assert_becomes(
            "<svg style='Fill:rgb(0,200,0'><style>a{x:1;fill:rgba(0, 0, 0, 0</style></svg>",
            "<svg style='fill:#00c800 '><style>a{x:1;fill:#0000 </style></svg>",
        );
        assert_becomes("<svg style='a:1;fill:rgb(0,0;b:1'/>", "<svg style='a:1; '/>");
    }

    #[test]
    fn what_is_read_stays() {
        for text in [
            "<svg style='fill:url(#a) red;font-family:&quot;A;B&quot;;stroke:rgb(1 2 3 / 50%)!important; x-a: 1'/>",
            "<svg><style>@media print { a { b } } @import url(x/y); .a, b &gt; c { fill: #fff ; stroke : none !  important }</style></svg>",
            "<svg><style><![CDATA[ .a { font-family: 'a;b:c/d' } ]]></style><text>style='a;b'</text></svg>",
            "<svg style='-inkscape-font-specification:sans-serif;transform:translate(1px,2px) rotate(-45deg);stroke-dasharray:.5,1 2'/>",
            "<svg><style>",
            "<svg style='",
            "<style>{",
            "<style>}{",
            "<style>a{/*",
            "<style>a{'",
            "<svg style='/*'/>",
        ] {
            let found = mended(Cow::Borrowed(text));
            if text.ends_with(['*', '\'']) || text.contains("/*") {
                assert_eq!(found.len(), text.len(), "{text}");
            } else {
                assert_eq!(found, text);
            }
        }
    }
}
