//! A document in which every style stands in its plain form: the text of a style sheet is joined of all its parts, whatever
//! comments, instructions and sections stand between them, and written anew as one. Sheets for other media are empty then.

use std::borrow::Cow;
use std::ops::Range;

use super::css::{self, Place, Plain};
use super::edits::escaped;
use super::media;
use super::places::{Changed, Places};
use super::report::quote;

/// A document with plain styles.
#[derive(Debug)]
pub(super) struct PlainStyles<'doc> {
    pub(super) text: Cow<'doc, str>,
    pub(super) places: Places,
    /// What of its style sheets has no effect, and where in the document that stands.
    pub(super) told: Vec<(usize, String)>,
}

impl<'doc> PlainStyles<'doc> {
    /// Those of `document`, into which something may be `inserted`.
    pub(super) fn of(document: &'doc str, mut inserted: Option<(usize, &str)>) -> Self {
        let mut changed = Changed::new(document);
        let mut told = Vec::new();
        let has_styles = document.contains("style");
        let mut insert = |changed: &mut Changed<'_>, before: usize| {
            if let Some((at, piece)) = inserted.take_if(|(at, _)| *at <= before) {
                changed.replace(at..at, piece, []);
            }
        };
        let mut at = 0;
        while let Some(start) = document[at..].find('<').map(|start| at + start).filter(|_| has_styles) {
            let Some(markup) = Markup::at(document, start) else {
                break;
            };
            at = markup.end(document.len());
            let Markup::Tag(tag) = markup else { continue };
            let style = attribute(&document[tag.clone()], "style").map(|value| moved(value, tag.start));
            if let Some(style) = style.filter(|style| is_odd(&document[style.clone()])) {
                insert(&mut changed, style.start);
                plain_attribute(document, style, &mut changed);
            } else if is_sheet(&document[tag.clone()]) {
                let Some(joined) = Joined::of(document, at) else {
                    continue;
                };
                insert(&mut changed, tag.start);
                at = joined.part.end;
                plain_sheet(document, tag, &joined, (&mut changed, &mut told));
            }
        }
        insert(&mut changed, document.len());
        let (text, places) = changed.done();
        Self { text, places, told }
    }
}

/// How a section begins whose characters are all themselves, and how it ends.
const SECTION: [&str; 2] = ["<![CDATA[", "]]>"];

fn moved(range: Range<usize>, by: usize) -> Range<usize> {
    range.start + by..range.end + by
}

/// A piece of a document's markup.
enum Markup {
    /// A start tag, without its last bracket.
    Tag(Range<usize>),
    /// Anything else, up to its end.
    Other(usize),
}

impl Markup {
    /// The one that begins at `start`; `None` where it does not end.
    fn at(document: &str, start: usize) -> Option<Self> {
        let rest = &document[start..];
        let ended = |end: &str| Some(Self::Other(start + rest.find(end)? + end.len()));
        if rest.starts_with("<!--") {
            ended("-->")
        } else if rest.starts_with("<![CDATA[") {
            ended("]]>")
        } else if rest.starts_with("<?") {
            ended("?>")
        } else if rest.starts_with("<!") {
            Some(Self::Other(start + doctype_end(rest)?))
        } else if rest.starts_with("</") {
            ended(">")
        } else {
            Some(Self::Tag(start..start + tag_end(rest)?))
        }
    }

    fn end(&self, most: usize) -> usize {
        match self {
            Self::Tag(tag) => (tag.end + 1).min(most),
            Self::Other(end) => *end,
        }
    }
}

/// The length of a tag, without its last bracket.
fn tag_end(tag: &str) -> Option<usize> {
    let mut quote = None;
    tag.bytes().position(|byte| {
        match (quote, byte) {
            (None, b'"' | b'\'') => quote = Some(byte),
            (Some(open), close) if open == close => quote = None,
            _ => {}
        }
        quote.is_none() && byte == b'>'
    })
}

/// The length of a declaration of a document's type, with all that stands in its brackets.
fn doctype_end(doctype: &str) -> Option<usize> {
    let mut at = 1;
    let mut depth = 1;
    loop {
        let rest = &doctype[at..];
        let sign = rest.find(['<', '>', '"', '\''])?;
        let rest = &rest[sign..];
        at += sign;
        at += match rest.as_bytes() {
            [b'<', b'!', b'-', b'-', ..] => rest.find("-->")?,
            [b'<', b'?', ..] => rest.find("?>")? + 1,
            [quote @ (b'"' | b'\''), ..] => 2 + rest[1..].find(char::from(*quote))?,
            [b'<', ..] => {
                depth += 1;
                1
            }
            _ => {
                depth -= 1;
                1
            }
        };
        // A comment is passed up to its last bracket.
        if rest.starts_with("<!--") {
            at += 3;
        } else if rest.starts_with("<?") {
            at += 1;
        }
        if depth == 0 {
            return Some(at);
        }
    }
}

/// Whether a tag, without its last bracket, opens a style sheet.
fn is_sheet(tag: &str) -> bool {
    let name = tag[1..].split([' ', '\t', '\r', '\n', '/']).next().unwrap_or("");
    (name == "style" || name.ends_with(":style")) && !tag.ends_with('/')
}

/// Where the value of an attribute of a tag stands.
fn attribute(tag: &str, name: &str) -> Option<Range<usize>> {
    tag.match_indices(name).find_map(|(at, _)| {
        let starts = tag[..at].ends_with(|c: char| c.is_ascii_whitespace());
        let value = tag[at + name.len()..].trim_start().strip_prefix('=')?.trim_start();
        let quote = value.chars().next().filter(|c| starts && matches!(c, '"' | '\''))?;
        let begin = tag.len() - value.len() + 1;
        Some(begin..begin + value[1..].find(quote)?)
    })
}

/// The text of an element or an attribute, joined of its parts.
#[derive(Debug, Default)]
struct Joined {
    text: String,
    places: Vec<Place>,
    /// Where it stands in the document.
    part: Range<usize>,
}

impl Joined {
    /// That of an element whose content begins at `start`; `None` where it has other elements or entities of the document.
    fn of(document: &str, start: usize) -> Option<Self> {
        let mut joined = Self::default();
        let mut at = start;
        loop {
            let open = at + document[at..].find('<')?;
            joined.references(document, at..open)?;
            let rest = &document[open..];
            if rest.starts_with("</") {
                joined.part = start..open;
                return Some(joined);
            }
            let Markup::Other(end) = Markup::at(document, open)? else {
                return None;
            };
            if rest.starts_with(SECTION[0]) {
                joined.take(document, open + SECTION[0].len()..end - SECTION[1].len());
            }
            at = end;
        }
    }

    /// Takes a part as it is.
    fn take(&mut self, document: &str, part: Range<usize>) {
        self.places.push(Place {
            at: self.text.len(),
            from: part.start,
        });
        self.text.push_str(&document[part]);
    }

    /// Takes a part with the characters that references in it stand for.
    fn references(&mut self, document: &str, part: Range<usize>) -> Option<()> {
        let mut at = part.start;
        while let Some(sign) = document[at..part.end].find('&').map(|sign| at + sign) {
            self.take(document, at..sign);
            let end = sign + document[sign..part.end].find(';')?;
            self.places.push(Place {
                at: self.text.len(),
                from: sign,
            });
            self.text.push(character(&document[sign + 1..end])?);
            at = end + 1;
        }
        self.take(document, at..part.end);
        Some(())
    }

    /// Where in the document a byte of the text comes from.
    fn origin(&self, at: usize) -> usize {
        let next = self.places.partition_point(|place| place.at <= at);
        let known = next.checked_sub(1).and_then(|known| self.places.get(known));
        known.map_or(at, |place| place.from + (at - place.at))
    }

    /// The places of a plain form of the text, by the document's.
    fn places_of<'p>(&'p self, plain: &'p Plain, behind: usize) -> impl Iterator<Item = Place> + use<'p> {
        plain.places.iter().map(move |place| Place {
            at: place.at + behind,
            from: self.origin(place.from),
        })
    }
}

/// The character that a reference stands for.
fn character(name: &str) -> Option<char> {
    let code = |code: Result<u32, _>| code.ok().and_then(char::from_u32);
    match name {
        "lt" => Some('<'),
        "gt" => Some('>'),
        "amp" => Some('&'),
        "quot" => Some('"'),
        "apos" => Some('\''),
        _ => match name.strip_prefix('#')?.strip_prefix('x') {
            Some(digits) => code(u32::from_str_radix(digits, 16)),
            None => code(name[1..].parse()),
        },
    }
}

/// Writes a style sheet, whose tag is given, in its plain form.
fn plain_sheet(
    document: &str,
    tag: Range<usize>,
    joined: &Joined,
    (changed, told): (&mut Changed<'_>, &mut Vec<(usize, String)>),
) {
    const CSS: &str = "text/css";
    let value = |name| attribute(&document[tag.clone()], name).map(|value| moved(value, tag.start));
    let medium = value("media").map_or("", |medium| &document[medium]);
    let mut is_read = media::applies(medium) == Some(true);
    if let Some(kind) = value("type") {
        let written = &document[kind.clone()];
        let plain = written.split(';').next().unwrap_or("").trim().to_ascii_lowercase();
        if !plain.is_empty() && plain != CSS {
            is_read = false;
            let message = format!(
                "the style sheet has no effect: its type \"{}\" is not {CSS}",
                quote(written)
            );
            told.extend((!joined.text.trim().is_empty()).then_some((tag.start, message)));
        } else if written != CSS {
            changed.replace(kind, CSS, []);
        }
    }
    let plain = if is_read {
        css::sheet(&joined.text)
    } else {
        Plain::default()
    };
    let part = joined.part.clone();
    if !plain.text.contains(['<', '&']) {
        changed.replace(part, &plain.text, joined.places_of(&plain, 0));
    } else if plain.text.contains(SECTION[1]) {
        changed.replace(part, &escaped(&plain.text).replace('>', "&gt;"), []);
    } else {
        let text = [SECTION[0], &plain.text, SECTION[1]].concat();
        changed.replace(part, &text, joined.places_of(&plain, SECTION[0].len()));
    }
    told.extend(plain.told.into_iter().map(|(at, message)| (joined.origin(at), message)));
}

/// Writes an attribute `style` in its plain form.
fn plain_attribute(document: &str, value: Range<usize>, changed: &mut Changed<'_>) {
    let mut joined = Joined::default();
    if joined.references(document, value.clone()).is_some() {
        let plain = css::style(&joined.text);
        changed.replace(value, &escaped(&plain.text), joined.places_of(&plain, 0));
    }
}

/// Whether a style has something that the readers behind do not understand.
fn is_odd(style: &str) -> bool {
    let is_between = |c: char| c.is_ascii_whitespace() || matches!(c, ':' | ';' | '!');
    let is_marked = |after: &str| !after.trim_start().starts_with("important");
    let is_odd_word = |word: &str| css::plain_word("", word).is_some_and(|plain| plain != word);
    style.contains('\\')
        || style.split('!').skip(1).any(is_marked)
        || style.split(is_between).any(is_odd_word)
        || css::is_in_other_case(style)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn plain(document: &str) -> (String, Vec<String>) {
        let plain = PlainStyles::of(document, None);
        let told = plain.told.into_iter();
        let told =
            told.map(|(at, message)| format!("{}: {message}", &document[at..].chars().take(5).collect::<String>()));
        (plain.text.replace('\n', ""), told.collect())
    }

    #[test]
    fn the_parts_of_a_sheet_are_one() {
        for (sheet, expected) in [
            ("a{x:1}<!-- c -->b{x:2}", "a{x:1;}b{x:2;}"),
            ("a{x:1}<?y z?>b{x:2}", "a{x:1;}b{x:2;}"),
            ("a{y:1; <!-- off: x:0; --> x:1}", "a{y:1;x:1;}"),
            ("a{x:1}<!-- a > b { -->b{x:2}", "a{x:1;}b{x:2;}"),
            ("a{x:1<![CDATA[}]]>", "a{x:1;}"),
            ("a{x:gre<![CDATA[en}]]>", "a{x:green;}"),
            ("<![CDATA[a{x:]]>1}", "a{x:1;}"),
            ("&lt;!-- a{x:1} --&gt;", "a{x:1;}"),
            ("<![CDATA[ <!-- a>b{x:1} --> ]]>", "a > b{x:1;}"),
            ("a[b='&lt;&#38;&#x26;']{x:1}", "<![CDATA[a[b=\"<&&\"]{x:1;}]]>"),
            (
                "a[b=']]&gt;']{x:'&amp;'}",
                "a[b=&quot;]]&gt;&quot;]{x:&apos;&amp;&apos;;}",
            ),
        ] {
            let document = format!("<svg><style>{sheet}</style><style/></svg>");
            let (text, told) = plain(&document);
            assert_eq!(text, format!("<svg><style>{expected}</style><style/></svg>"));
            assert_eq!(told, [""; 0], "{sheet}");
        }
        for document in [
            "<svg><style>a{x:&own;}</style></svg>",
            "<svg><style>a{<b/>}</style></svg>",
            "<svg><style>a{<!-- }</style></svg>",
            "<!DOCTYPE svg [<!-- ' --><!ENTITY a \"<style>b{}</style>\">]><svg><style",
            "<svg><!-- <style>a {}</style> --><text>style</text><g style='fill: inherit'/></svg>",
        ] {
            assert_eq!(plain(document).0, document);
        }
    }

    #[test]
    fn sheets_of_another_kind_are_empty() {
        let named = |attributes: &str| plain(&format!("<svg><style {attributes}>a{{x:1}}</style></svg>"));
        for css in [
            "type=''",
            "type=\"TEXT/CSS\"",
            "type='text/css; charset=utf-8'",
            "media='screen'",
            "type='text/css'",
        ] {
            let (text, told) = named(css);
            assert!(text.contains(">a{x:1;}<") && told.is_empty(), "{text}");
            assert!(
                !css.contains("type") || text.contains("text/css'") || text.contains("text/css\""),
                "{text}"
            );
        }
        let (text, told) = named("type='text/less'");
        assert!(text.contains("'></style>"), "{text}");
        assert_eq!(
            told,
            ["<styl: the style sheet has no effect: its type \"text/less\" is not text/css"]
        );
        assert!(named("media='print'").0.contains("'></style>"));
    }

    #[test]
    fn styles_of_elements_are_plain_where_they_have_to_be() {
        assert_eq!(
            plain(
                "<svg style='fill:red!IMPORTANT'><g a='&lt;' style=\"f\\69ll:green;x:&quot;a\\&quot;b&quot;\"/></svg>"
            )
            .0,
            "<svg style='fill:red!important;'><g a='&lt;' style=\"fill:green;x:&apos;a&quot;b&apos;;\"/></svg>"
        );
        for stays in [
            "fill : red !important",
            "font-family:'a}b'",
            "fill:inherit",
            "x:initial",
        ] {
            assert!(!is_odd(stays), "{stays}");
        }
        for odd in [
            "fill:unset",
            "fill:INHERIT",
            "x:Revert",
            "fill:red ! Important",
            "Fill:red",
            "fill:None",
        ] {
            assert!(is_odd(odd), "{odd}");
        }
    }

    #[test]
    fn places_are_those_of_the_document() {
        let document = "<svg xlink:a=''><style>a{x:1}<!-- c --> b { y : 2 }</style><g/></svg>";
        let plain = PlainStyles::of(document, Some((4, " xmlns:xlink=''")));
        assert!(
            plain.text.starts_with("<svg xmlns:xlink='' xlink:a=''"),
            "{}",
            plain.text
        );
        for part in ["xlink:a", "a{", "b", "y", "2", "<g/>"] {
            let at = plain.text.rfind(part).expect("there");
            let sought = if part == "a{" { "a{x" } else { part };
            assert_eq!(plain.places.origin(at), document.rfind(sought).unwrap_or(0), "{part}");
        }
    }
}
