//! Bytes to an XML tree, with the guards that keep hostile documents small, and places as line and column.
//!
//! The XML library itself neither recurses nor runs away, but it reserves memory by counting brackets, compares the
//! attributes of an element pairwise and expands entities; so a quick look at the text comes first.

use std::borrow::Cow;
use std::collections::HashSet;
use std::io::Read as _;

use roxmltree::{Document, Error, ParsingOptions};

use super::declarations::mended;
use super::edits::Edits;
use super::error::Fault;
use super::places::Places;
use super::plain_styles::PlainStyles;
use super::report::shorten;
use super::selectors::rewritten;
use super::substitutes::substituted;
use super::{MAX_DOCUMENT_BYTES, Problem, ResourceError, SourceLocation, css, entities};

/// Most elements, texts and comments in a document.
const MAX_NODES: u32 = 4_000_000;
/// Most tags, opening and closing, and comments.
const MAX_TAGS: usize = 8_000_000;
/// Most attributes in a document.
const MAX_ATTRIBUTES: usize = 8_000_000;
/// Most attributes of one element, which the XML library compares pairwise.
const MAX_ATTRIBUTES_OF_ONE: usize = 1_000;
/// Most different prefixes of namespaces, all of which the XML library looks through for a name.
const MAX_PREFIXES: usize = 256;
/// Most steps in which the XML library hands on namespaces: for each declaration it may compare all prefixes with all.
const MAX_HANDING_ON: usize = 64_000_000;
/// Most characters of the XML library's own message.
const MAX_MESSAGE: usize = 200;
/// Text between two marks of a [`LineIndex`], in bytes.
const MARK_SPACING: usize = 1024;

/// Finds line and column of a byte, and back: O(log n), however long the lines are or many.
#[derive(Debug)]
pub(super) struct LineIndex<'text> {
    text: &'text str,
    /// Known places, at equal distances.
    marks: Vec<(usize, SourceLocation)>,
}

impl<'text> LineIndex<'text> {
    pub(super) fn new(text: &'text str) -> Self {
        let mut mark = (0, SourceLocation { line: 1, column: 1 });
        let mut marks = vec![mark];
        while let Some((between, _)) = split_at_character(&text[mark.0..], MARK_SPACING) {
            mark = (mark.0 + between.len(), behind(mark.1, between));
            marks.push(mark);
        }
        Self { text, marks }
    }

    /// The text that places are of.
    pub(super) fn text(&self) -> &'text str {
        self.text
    }

    /// The place of the character that starts at byte `offset`.
    pub(super) fn locate(&self, offset: usize) -> SourceLocation {
        let (start, place) = self.mark(|(start, _)| *start <= offset);
        let between = self.text.get(start..offset.min(self.text.len())).unwrap_or("");
        behind(place, between)
    }

    /// The byte where the character at a place starts; `None` where the text has no such place.
    pub(super) fn offset(&self, wanted: SourceLocation) -> Option<usize> {
        let (start, mut here) = self.mark(|(_, place)| *place <= wanted);
        for (i, c) in self.text.get(start..)?.char_indices() {
            if here >= wanted {
                return (here == wanted).then_some(start + i);
            }
            here = after(here, c);
        }
        None
    }

    /// The last mark that is not beyond what is looked for.
    fn mark(&self, before: impl Fn(&(usize, SourceLocation)) -> bool) -> (usize, SourceLocation) {
        let after = self.marks.partition_point(before);
        self.marks[after.saturating_sub(1)]
    }
}

/// A text up to the first character that starts at this byte or behind it, and the rest; `None` where there is none.
fn split_at_character(text: &str, at: usize) -> Option<(&str, &str)> {
    let at = (at..text.len()).find(|at| text.is_char_boundary(*at))?;
    text.split_at_checked(at)
}

/// The place behind a text that starts at a place.
fn behind(place: SourceLocation, text: &str) -> SourceLocation {
    let count = |count: usize| u32::try_from(count).unwrap_or(u32::MAX);
    let lines = text.matches('\n').count();
    let (first, last) = text
        .rsplit_once('\n')
        .map_or((place.column, text), |(_, last)| (1, last));
    SourceLocation {
        line: place.line.saturating_add(count(lines)),
        column: first.saturating_add(count(last.chars().count())),
    }
}

/// The place behind the character `c`.
fn after(place: SourceLocation, c: char) -> SourceLocation {
    if c == '\n' {
        return SourceLocation {
            line: place.line.saturating_add(1),
            column: 1,
        };
    }
    SourceLocation {
        column: place.column.saturating_add(1),
        ..place
    }
}

/// What every compressed document begins with.
const GZIP: [u8; 2] = [0x1f, 0x8b];

/// The document's bytes, unpacked where they are compressed (`.svgz`).
pub(super) fn unpacked(bytes: &[u8]) -> Result<Cow<'_, [u8]>, Fault> {
    if !bytes.starts_with(&GZIP) {
        return Ok(Cow::Borrowed(bytes));
    }
    let mut document = Vec::new();
    let unpacking = flate2::read::MultiGzDecoder::new(bytes)
        .take(MAX_DOCUMENT_BYTES + 1)
        .read_to_end(&mut document);
    match unpacking {
        Ok(_) if document.len() as u64 > MAX_DOCUMENT_BYTES => {
            let limit = MAX_DOCUMENT_BYTES;
            Err(Problem::from(ResourceError::TooLarge { limit }).nowhere())
        }
        Ok(_) => Ok(Cow::Owned(document)),
        Err(_) => Err(Problem::Packed.nowhere()),
    }
}

/// How pictures begin, and what they are.
const PICTURES: [(&[u8], &str); 2] = [(b"\x89PNG", "a PNG"), (b"\xff\xd8\xff", "a JPEG")];

/// The document as text, whatever its encoding; a byte order mark is gone.
pub(super) fn decode(document: &[u8]) -> Result<Cow<'_, str>, Fault> {
    let text = match document {
        [0xef, 0xbb, 0xbf, rest @ ..] => from_utf8(rest)?,
        [0xff, 0xfe, rest @ ..] | rest @ [b'<', 0, ..] => from_utf16(rest, u16::from_le_bytes)?,
        [0xfe, 0xff, rest @ ..] | rest @ [0, b'<', ..] => from_utf16(rest, u16::from_be_bytes)?,
        bytes => from_utf8(bytes)?,
    };
    if text.trim().is_empty() {
        return Err(Problem::Empty.nowhere());
    }
    Ok(text)
}

/// What the bytes from 0x80 on are in Windows-1252, as far as they are not those of Latin-1; Windows reads the five that mean
/// nothing as Latin-1 does, and browsers read documents in Latin-1 so.
const WINDOWS: [char; 32] = [
    '\u{20ac}', '\u{81}', '\u{201a}', '\u{192}', '\u{201e}', '\u{2026}', '\u{2020}', '\u{2021}', '\u{2c6}', '\u{2030}',
    '\u{160}', '\u{2039}', '\u{152}', '\u{8d}', '\u{17d}', '\u{8f}', '\u{90}', '\u{2018}', '\u{2019}', '\u{201c}',
    '\u{201d}', '\u{2022}', '\u{2013}', '\u{2014}', '\u{2dc}', '\u{2122}', '\u{161}', '\u{203a}', '\u{153}', '\u{9d}',
    '\u{17e}', '\u{178}',
];

/// UTF-8, or Windows-1252 where the XML declaration says so, or Latin-1, which differs from it in control characters only.
fn from_utf8(bytes: &[u8]) -> Result<Cow<'_, str>, Fault> {
    const DECLARATION: usize = 200;
    let error = match std::str::from_utf8(bytes) {
        Ok(text) => return Ok(Cow::Borrowed(text)),
        Err(error) => error,
    };
    let head = String::from_utf8_lossy(&bytes[..bytes.len().min(DECLARATION)]);
    let written = head.split("?>").next().unwrap_or("");
    let declaration = written.to_ascii_lowercase();
    if declaration.contains("iso-8859-1") || declaration.contains("windows-1252") {
        let letter = |&byte: &u8| {
            let windows = usize::from(byte).checked_sub(0x80).and_then(|at| WINDOWS.get(at));
            windows.copied().unwrap_or_else(|| char::from(byte))
        };
        return Ok(Cow::Owned(bytes.iter().map(letter).collect()));
    }
    if let Some((_, what)) = PICTURES.iter().find(|(start, _)| bytes.starts_with(start)) {
        return Err(Problem::Picture(what).nowhere());
    }
    let valid = String::from_utf8_lossy(&bytes[..error.valid_up_to()]);
    let problem = declared_encoding(written).map_or(Problem::Encoding, Problem::OtherEncoding);
    Err(problem.at(LineIndex::new(&valid).locate(valid.len())))
}

/// The encoding that an XML declaration names, where that is none of those that are read.
fn declared_encoding(declaration: &str) -> Option<String> {
    let (_, after) = declaration.strip_prefix("<?xml")?.split_once("encoding")?;
    let value = after.trim_start().strip_prefix('=')?.trim_start();
    let name = value.strip_prefix(['"', '\''])?.split(['"', '\'']).next()?;
    let is_read = name.is_empty() || name.to_ascii_lowercase().starts_with("utf");
    (!is_read).then(|| name.to_owned())
}

fn from_utf16(bytes: &[u8], unit: impl Fn([u8; 2]) -> u16) -> Result<Cow<'static, str>, Fault> {
    let (pairs, rest) = bytes.as_chunks::<2>();
    if !rest.is_empty() {
        return Err(Problem::Encoding.nowhere());
    }
    let text: Result<String, _> = char::decode_utf16(pairs.iter().map(|&pair| unit(pair))).collect();
    text.map(Cow::Owned).map_err(|_| Problem::Encoding.nowhere())
}

/// A document's text, ready for the XML library.
#[derive(Debug)]
pub(super) struct Source<'doc> {
    original: &'doc str,
    /// The text to parse: the original, or one with [`XLINK`] put in, styles in their plain form and plain values where newer CSS
    /// stands.
    text: Cow<'doc, str>,
    /// Where in the original its parts come from.
    places: Places,
    /// What of its style sheets has no effect, and where in the original that stands.
    told: Vec<(usize, String)>,
}

/// Put into the root element of documents that use `xlink:` and forget to say what it means, as many do.
const XLINK: &str = " xmlns:xlink=\"http://www.w3.org/1999/xlink\"";

/// A text that is not the one it was made of.
fn changed(text: Cow<'_, str>) -> Option<String> {
    match text {
        Cow::Owned(text) => Some(text),
        Cow::Borrowed(_) => None,
    }
}

impl<'doc> Source<'doc> {
    /// Looks at the text before the XML library does.
    pub(super) fn new(original: &'doc str) -> Result<Self, Fault> {
        let mut survey = Survey::new(original);
        if is_misleading(original) {
            survey.count_all(original);
        }
        let limits = [
            (survey.tags, MAX_TAGS, "tags"),
            (survey.attributes, MAX_ATTRIBUTES, "attributes"),
            (survey.prefixes.len(), MAX_PREFIXES, "prefixes of namespaces"),
            (
                survey.declarations,
                MAX_HANDING_ON / survey.prefixes.len().max(1).pow(2),
                "namespace declarations with so many prefixes",
            ),
        ];
        for (count, limit, what) in limits {
            if count > limit {
                return Err(Problem::TooMany { what, limit }.nowhere());
            }
        }
        if survey.most_attributes > MAX_ATTRIBUTES_OF_ONE {
            let problem = Problem::TooMuch {
                what: "attributes of one element",
                limit: MAX_ATTRIBUTES_OF_ONE,
                cure: "leave out those that SVG does not know",
            };
            return Err(problem.at(LineIndex::new(original).locate(survey.fullest_tag)));
        }
        entities::check(original)?;
        let is_forgotten = || original.contains(" xlink:") && !original.contains("xmlns:xlink");
        let inserted = survey.root_name_end.filter(|_| is_forgotten()).map(|at| (at, XLINK));
        let PlainStyles { text, places, told } = PlainStyles::of(original, inserted);
        let plain = changed(rewritten(mended(substituted(&text))));
        let text = plain.map_or(text, Cow::Owned);
        Ok(Self {
            original,
            text,
            places,
            told,
        })
    }

    /// The byte of the original document that byte `offset` of the parsed text stands for.
    pub(super) fn original_offset(&self, offset: usize) -> usize {
        self.places.origin(offset).min(self.original.len())
    }

    /// What of its style sheets has no effect, and where in the original that stands.
    pub(super) fn told(&self) -> &[(usize, String)] {
        &self.told
    }

    /// The text that is parsed, which places of its elements are of.
    pub(super) fn text(&self) -> &str {
        &self.text
    }

    /// Parses the text.
    pub(super) fn parse(&self) -> Result<Document<'_>, Fault> {
        let options = ParsingOptions {
            allow_dtd: true,
            nodes_limit: MAX_NODES,
            ..ParsingOptions::default()
        };
        Document::parse_with_options(&self.text, options).map_err(|error| self.explain(&error))
    }

    /// The original document with the values of its attributes in the usual case, as long as before, if any is in another: CSS takes
    /// them in any, and the course's reader does not.
    pub(super) fn in_usual_case(&self, tree: &Document<'_>) -> Option<String> {
        let mut edits = Edits::default();
        let attributes = tree.descendants().flat_map(|node| node.attributes());
        for attribute in attributes.filter(|attribute| attribute.namespace().is_none()) {
            let value = attribute.value();
            let start = self.original_offset(attribute.range_value().start);
            for (place, usual) in css::other_case(attribute.name(), value) {
                // References to entities move what stands behind them.
                if self.original.get(start..start + value.len()) == Some(value) {
                    edits.replace(start + place.start..start + place.end, usual);
                }
            }
        }
        changed(edits.apply_to(Cow::Borrowed(self.original)))
    }

    /// The XML library's error, with its place in the original document.
    fn explain(&self, error: &Error) -> Fault {
        let lines = LineIndex::new(self.original);
        let place = error.pos();
        let parsed = SourceLocation {
            line: place.row,
            column: place.col,
        };
        let location = match error {
            Error::UnclosedRootNode | Error::UnexpectedEndOfStream | Error::NoRootNode => {
                lines.locate(self.original.trim_end().len())
            }
            _ if self.places.are_same() => parsed,
            _ => {
                let at = LineIndex::new(&self.text).offset(parsed);
                at.map_or(parsed, |at| lines.locate(self.original_offset(at)))
            }
        };
        let before = self.original.get(..lines.offset(location).unwrap_or(0)).unwrap_or("");
        let is_first = before
            .trim_matches(|c: char| c.is_whitespace() || c == '\u{feff}')
            .is_empty();
        if let Some(at) = unended_value(before) {
            let message = "no quotation mark stands at the end of this value".to_owned();
            return Problem::Xml(message).at(lines.locate(at));
        }
        let message = match error {
            Error::UnexpectedDeclaration(_) if is_first => {
                let message = "blanks stand before the XML declaration; delete what stands before <?xml";
                return Problem::Repair(message.to_owned()).at(location);
            }
            Error::UnknownEntityReference(name, _) => {
                return Problem::Repair(entities::unknown(name, self.original)).at(location);
            }
            Error::UnknownToken(_) if is_first => "text stands before the first tag".to_owned(),
            error => error.to_string().replace(&format!(" at {place}"), ""),
        };
        Problem::Xml(shorten(&message, MAX_MESSAGE)).at(location)
    }
}

/// Where the attribute of the last tag in `text` begins whose value runs on into the next attribute: it ends with `name=`.
fn unended_value(text: &str) -> Option<usize> {
    let tag = text.rfind('<')?;
    let mut at = tag;
    while let Some(open) = text[at..].find(['"', '\'']).map(|open| at + open) {
        let close = open + 1 + text[open + 1..].find(char::from(text.as_bytes()[open]))?;
        let value = &text[open + 1..close];
        let last = value.rsplit(|c: char| c.is_ascii_whitespace()).next().unwrap_or("");
        let is_name = |name: &str| !name.is_empty() && name.chars().all(|c| c.is_alphanumeric() || "-_:".contains(c));
        if last.len() < value.len() && last.strip_suffix('=').is_some_and(is_name) {
            let name = text[tag..open].trim_end().strip_suffix('=')?.trim_end();
            return Some(tag + name.rfind(|c: char| c.is_ascii_whitespace())? + 1);
        }
        at = close + 1;
    }
    None
}

/// What a quick look at the markup finds; never too little.
#[derive(Debug, Default, PartialEq, Eq)]
struct Survey<'text> {
    tags: usize,
    attributes: usize,
    most_attributes: usize,
    /// Where the tag begins that has the most.
    fullest_tag: usize,
    /// Declarations of namespaces, and their different prefixes; the default one has an empty prefix.
    declarations: usize,
    prefixes: HashSet<&'text [u8]>,
    /// Where the name of the first element ends.
    root_name_end: Option<usize>,
}

impl<'text> Survey<'text> {
    fn new(text: &'text str) -> Self {
        let mut survey = Self {
            // As the XML library counts when it reserves memory: even in comments and values.
            tags: text.bytes().filter(|byte| *byte == b'<').count(),
            attributes: text.bytes().filter(|byte| *byte == b'=').count(),
            ..Self::default()
        };
        let mut rest = text;
        while let Some(start) = rest.find('<') {
            let markup = &rest[start..];
            let offset = text.len() - markup.len();
            let length = match markup.as_bytes() {
                [b'<', b'!', b'-', b'-', ..] => markup.find("-->"),
                [b'<', b'!', b'[', ..] => markup.find("]]>"),
                [b'<', b'?', ..] => markup.find("?>"),
                [b'<', b'!', b'E' | b'A' | b'N', ..] => markup.find('>'),
                [b'<', b'!', ..] => Some(1),
                tag => Some(survey.tag(tag, offset)),
            };
            rest = &markup[length.unwrap_or(markup.len()).clamp(1, markup.len())..];
        }
        survey
    }

    /// Counts all words for namespaces, whatever they are, each as one with a prefix of its own.
    fn count_all(&mut self, text: &'text str) {
        let words = text.match_indices("xmlns").map(|(at, _)| &text.as_bytes()[..at]);
        self.prefixes = words.take(MAX_PREFIXES + 1).collect();
        self.declarations = self.prefixes.len();
    }

    /// Counts the attributes of the tag at the start of `markup` and answers with its length.
    fn tag(&mut self, markup: &'text [u8], offset: usize) -> usize {
        let mut quote = None;
        let mut attributes = 0;
        let mut length = markup.len();
        for (i, &byte) in markup.iter().enumerate() {
            match (quote, byte) {
                (None, b'"' | b'\'') => quote = Some(byte),
                (None, b'=') => {
                    attributes += 1;
                    self.declaration(&markup[..i]);
                }
                (None, b'>') => {
                    length = i;
                    break;
                }
                (Some(open), close) if open == close => quote = None,
                _ => {}
            }
        }
        if attributes > self.most_attributes {
            (self.most_attributes, self.fullest_tag) = (attributes, offset);
        }
        let name = markup.iter().skip(1).take_while(|b| !b" \t\r\n/>".contains(b)).count();
        self.root_name_end.get_or_insert(offset + 1 + name);
        length
    }

    /// Counts the attribute whose name `tag` ends with, if it declares a namespace.
    fn declaration(&mut self, tag: &'text [u8]) {
        let is_between = |byte: &u8| b" \t\r\n\"'=<".contains(byte);
        let name = tag.trim_ascii_end().rsplit(is_between).next().unwrap_or(tag);
        let prefix = match name.strip_prefix(b"xmlns") {
            Some([]) => &[],
            Some([b':', prefix @ ..]) => prefix,
            _ => return,
        };
        self.declarations += 1;
        if self.prefixes.len() <= MAX_PREFIXES {
            self.prefixes.insert(prefix);
        }
    }
}

/// Whether a document type has brackets where a quick look would take them for tags: in an address, or in a parameter's value.
fn is_misleading(text: &str) -> bool {
    let Some((_, doctype)) = text.split_once("<!DOCTYPE") else {
        return false;
    };
    let address = doctype.split(['[', '>']).next().unwrap_or("");
    let mut entities = doctype.split("<!ENTITY").skip(1);
    address.contains('<') || entities.any(|entity| entity.trim_start().starts_with('%'))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn place(line: u32, column: u32) -> SourceLocation {
        SourceLocation { line, column }
    }

    #[test]
    fn encodings_that_are_not_read_are_named() {
        let told = |declaration: &str| {
            let bytes = [declaration.as_bytes(), b"<svg>\x82\xa0</svg>"].concat();
            decode(&bytes).map(drop).map_err(|fault| fault.problem.to_string())
        };
        let line = told("<?xml version='1.0' encoding='Shift_JIS'?>").expect_err("another encoding");
        assert!(line.starts_with("the document is in Shift_JIS, and UTF-8"), "{line}");
        for other in ["", "<?xml version='1.0'?>", "<?xml version='1.0' encoding=\"UTF-8\"?>"] {
            let line = told(other).expect_err("no text");
            assert!(line.starts_with("this is not text in UTF-8"), "{other}: {line}");
        }
        assert!(
            told("<?xml version='1.0' encoding='ISO-8859-1'?>").is_ok(),
            "one that is read"
        );
    }

    #[test]
    fn values_that_run_on_are_found() {
        for (text, expected) in [
            ("<a><b c='1' d=\"1 2 e=\"3", Some("d=")),
            ("<b c = '1 2\ne='3 f='4'", Some("c =")),
            ("<b c='1 2' d='3=' e='f(x) = 1'", None),
            ("<b c='1 d='2'/><b e='", None),
            ("<b c='", None),
            ("", None),
        ] {
            let found = unended_value(text).map(|at| &text[at..]);
            assert_eq!(found.is_some(), expected.is_some(), "{text}");
            assert!(
                found.is_none_or(|found| found.starts_with(expected.unwrap_or(""))),
                "{text}: {found:?}"
            );
        }
    }

    #[test]
    fn line_index_counts_characters() {
        let text = "ab\n\u{e9}\u{4e2d}x\n";
        let lines = LineIndex::new(text);
        assert_eq!(lines.locate(0), place(1, 1), "start");
        assert_eq!(lines.locate(2), place(1, 3), "the line break belongs to its line");
        assert_eq!(lines.locate(3), place(2, 1), "second line");
        assert_eq!(
            lines.locate(text.find('x').expect("x")),
            place(2, 3),
            "characters, not bytes"
        );
        assert_eq!(lines.locate(text.len()), place(3, 1), "end");
    }

    #[test]
    fn line_index_agrees_with_counting_on_long_lines() {
        let text = format!("{}\n{}", "\u{e9}".repeat(5000), "x".repeat(5000));
        let lines = LineIndex::new(&text);
        for (count, (offset, _)) in text.char_indices().enumerate().step_by(97) {
            let count = u32::try_from(count).expect("short");
            let expected = if count <= 5000 {
                place(1, count + 1)
            } else {
                place(2, count - 5000)
            };
            assert_eq!(lines.locate(offset), expected, "at {offset}");
            assert_eq!(lines.offset(expected), Some(offset), "back from {expected}");
        }
    }

    #[test]
    fn line_index_is_small_for_many_lines() {
        let text = "\n".repeat(100_000);
        let lines = LineIndex::new(&text);
        assert!(lines.marks.len() < 200, "{} marks for 100 kB", lines.marks.len());
        assert_eq!(lines.locate(99_999), place(100_000, 1), "counted from the mark");
        assert_eq!(lines.offset(place(99_000, 1)), Some(98_999), "and back");
        assert_eq!(lines.offset(place(99_000, 2)), None, "lines end");
    }

    #[test]
    fn decode_every_encoding() {
        let text = "<svg>\u{e9}</svg>";
        let utf16: Vec<u16> = text.encode_utf16().collect();
        let little: Vec<u8> = utf16.iter().flat_map(|u| u.to_le_bytes()).collect();
        let big: Vec<u8> = utf16.iter().flat_map(|u| u.to_be_bytes()).collect();
        let with_mark = |mark: &[u8], body: &[u8]| [mark, body].concat();
        for bytes in [
            text.as_bytes().to_vec(),
            with_mark(&[0xef, 0xbb, 0xbf], text.as_bytes()),
            with_mark(&[0xff, 0xfe], &little),
            with_mark(&[0xfe, 0xff], &big),
            little,
            big,
        ] {
            assert_eq!(decode(&bytes).expect("text"), text, "{bytes:?}");
        }
        let latin = b"<?xml version='1.0' encoding='ISO-8859-1'?><svg>\xe9</svg>";
        assert!(decode(latin).expect("latin").ends_with(text), "declared Latin-1");
        let windows = b"<?xml version='1.0' encoding='windows-1252'?>\x96\xe9\x80";
        assert!(
            decode(windows).expect("windows").ends_with("\u{2013}\u{e9}\u{20ac}"),
            "a dash and the euro"
        );
    }

    #[test]
    fn decode_names_the_first_bad_byte() {
        let fault = decode(b"<svg>\n  \xff</svg>").expect_err("no UTF-8");
        assert_eq!(fault.location, Some(place(2, 3)), "second line");
        let picture = decode(b"\x89PNG\r\n\x1a\n").expect_err("no text").problem.to_string();
        assert!(picture.starts_with("this is a PNG, not an SVG file"), "{picture}");
        assert!(decode(b" \n").is_err(), "blank");
        assert!(decode(b"").is_err(), "empty");
        assert!(decode(b"<\0s").is_err(), "half a UTF-16 unit");
    }

    #[test]
    fn survey_counts_outside_quotes_and_comments() {
        let survey = Survey::new("<?xml a='1'?><!-- <x a='' b=''> --><svg a='=>' b=\"'\"><g c=''/></svg>");
        let expected = Survey {
            tags: 6,
            attributes: 7,
            most_attributes: 2,
            fullest_tag: 35,
            declarations: 0,
            prefixes: HashSet::new(),
            root_name_end: Some(39),
        };
        assert_eq!(
            survey, expected,
            "brackets and equal signs everywhere, attributes of one element only in tags"
        );
    }

    #[test]
    fn source_forgives_a_missing_xlink() {
        let text = "<svg>\n<image xlink:href='a'/></svg>";
        let source = Source::new(text).expect("small");
        let tree = source.parse().expect("repaired");
        let image = tree.root_element().first_element_child().expect("image");
        assert_eq!(
            source.original_offset(image.range().start),
            6,
            "places are the original's"
        );
    }

    #[test]
    fn what_stands_before_the_document_is_named() {
        let said = |text: &str| {
            let source = Source::new(text).expect("small");
            let fault = source.parse().expect_err("no XML");
            (fault.location, fault.problem.to_string())
        };
        let declared = "<?xml version='1.0'?><svg/>";
        for before in ["\n", " \t", "\u{feff}\n"] {
            let (_, line) = said(&format!("{before}{declared}"));
            assert!(
                line.starts_with("blanks stand before the XML declaration"),
                "{before:?}: {line}"
            );
        }
        assert_eq!(said(&format!("\n {declared}")).0, Some(place(2, 2)), "where it is");
        assert!(
            said("HTTP/1.1 200 OK\n<svg/>").1.starts_with("text stands before"),
            "no markup"
        );
        assert!(said("<svg>&</svg>").1.starts_with("malformed"), "any other fault");
    }

    #[test]
    fn source_refuses_what_runs_away() {
        let attributes = " a=''".repeat(MAX_ATTRIBUTES_OF_ONE + 1);
        let fault = Source::new(&format!("<svg>\n<g{attributes}/></svg>")).map(|_| ());
        let fault = fault.expect_err("attributes of one element");
        assert_eq!(fault.location, Some(place(2, 1)), "where it is");
        assert!(
            fault
                .problem
                .to_string()
                .ends_with("leave out those that SVG does not know"),
            "a cure"
        );
        let declared = |count: usize, prefixes: usize| {
            let one = |i: usize| format!("<g xmlns:p{}=''/>", i % prefixes);
            let groups: String = (0..count).map(one).collect();
            Source::new(&format!("<svg>{groups}</svg>")).map(|_| ())
        };
        assert!(declared(MAX_PREFIXES + 1, MAX_PREFIXES + 1).is_err(), "prefixes");
        assert!(declared(20_000, 100).is_err(), "declarations of many prefixes");
        assert!(declared(20_000, 10).is_ok(), "as exporters write them");
    }

    #[test]
    fn namespaces_count_where_they_are_declared() {
        let found = |text: &str| {
            let survey = Survey::new(text);
            (survey.declarations, survey.prefixes.len())
        };
        assert_eq!(found("<svg xmlns = 'a' xmlns:b=\"c\"><g\nxmlns='a'/></svg>"), (3, 2));
        assert_eq!(found("<g><g x=''xmlns='a'/></g>"), (1, 1), "without a blank");
        for without in [
            "<!-- <g xmlns='a'> -->",
            "<g a=' xmlns='/>",
            "<g> xmlns='a'</g>",
            "<![CDATA[<g xmlns='a'/>]]>",
            "<g xmlnsx='a' b:xmlns='c'/>",
            "<?b <g xmlns='a'/> ?>",
        ] {
            assert_eq!(found(without), (0, 0), "{without}");
        }
        let hidden = "<!DOCTYPE svg [<!ENTITY % a \"<b '\">]><svg xmlns='a'/>";
        assert!(is_misleading(hidden) && is_misleading("<!DOCTYPE a '<b \"'><svg/>"));
        assert!(
            !is_misleading("<!DOCTYPE svg [<!ENTITY a 'b'>]><svg/>"),
            "as exporters write them"
        );
        assert_eq!(
            found("<?b \" ?><g xmlns='a'/>"),
            (1, 1),
            "an instruction's quotes are its own"
        );
    }
}
