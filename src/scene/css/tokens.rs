//! The tokens of CSS (CSS Syntax 3, section 4), as far apart as they have to be told here.

use std::borrow::Cow;
use std::ops::Range;

/// What a token is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    Blank,
    Comment,
    Quoted,
    /// A string that its line ends, or an address that is none.
    Bad,
    Name,
    /// A name with the parenthesis behind it.
    Function,
    /// A name behind an `@`.
    At,
    Hash,
    /// An address without quotation marks.
    Url,
    /// A number with its unit.
    Number,
    /// The marks of a comment of HTML.
    Html,
    Colon,
    Semicolon,
    Comma,
    /// An opening bracket.
    Open,
    /// A closing bracket.
    Close,
    /// Any other character.
    Sign,
}

/// A token, and where in the text it stands.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Token {
    pub(super) kind: Kind,
    pub(super) place: Range<usize>,
}

/// The tokens of a text.
#[derive(Clone, Debug)]
pub(super) struct Tokens<'t> {
    text: &'t str,
    at: usize,
}

impl<'t> Tokens<'t> {
    /// Those of a part of `text`.
    pub(super) fn of(text: &'t str, part: Range<usize>) -> Self {
        Self {
            text: &text[..part.end],
            at: part.start,
        }
    }
}

impl Iterator for Tokens<'_> {
    type Item = Token;

    fn next(&mut self) -> Option<Token> {
        let start = self.at;
        let (kind, end) = token(self.text.as_bytes(), start)?;
        // Signs of several bytes are parts of names, so every other token ends where a character does.
        self.at = end;
        Some(Token {
            kind,
            place: start..end,
        })
    }
}

/// The kind and the end of the token at `at`.
fn token(text: &[u8], at: usize) -> Option<(Kind, usize)> {
    let rest = text.get(at..)?;
    let one = |kind| (kind, at + 1);
    Some(match rest {
        [] => return None,
        [b'/', b'*', ..] => (
            Kind::Comment,
            find(text, at + 2, b"*/").map_or(text.len(), |end| end + 2),
        ),
        [byte, ..] if is_blank(*byte) => (Kind::Blank, run_end(text, at, is_blank)),
        [b'"' | b'\'', ..] => quoted(text, at),
        [b'<', b'!', b'-', b'-', ..] => (Kind::Html, at + 4),
        [b'-', b'-', b'>', ..] => (Kind::Html, at + 3),
        _ if starts_number(rest) => (Kind::Number, number_end(text, at)),
        _ if starts_name(rest) => named(text, at),
        [b'@', rest @ ..] if starts_name(rest) => (Kind::At, name_end(text, at + 1)),
        [b'#', rest @ ..] if rest.first().is_some_and(|byte| is_in_name(*byte)) || is_escape(rest) => {
            (Kind::Hash, name_end(text, at + 1))
        }
        [b':', ..] => one(Kind::Colon),
        [b';', ..] => one(Kind::Semicolon),
        [b',', ..] => one(Kind::Comma),
        [b'(' | b'[' | b'{', ..] => one(Kind::Open),
        [b')' | b']' | b'}', ..] => one(Kind::Close),
        _ => one(Kind::Sign),
    })
}

fn is_blank(byte: u8) -> bool {
    matches!(byte, b' ' | b'\t' | b'\n' | b'\r' | b'\x0c')
}

fn is_line_end(byte: u8) -> bool {
    matches!(byte, b'\n' | b'\r' | b'\x0c')
}

fn is_in_name(byte: u8) -> bool {
    byte.is_ascii_alphanumeric() || matches!(byte, b'-' | b'_') || !byte.is_ascii()
}

fn starts_in_name(byte: u8) -> bool {
    is_in_name(byte) && !byte.is_ascii_digit() && byte != b'-'
}

/// Whether an escape stands at the start of `rest`.
fn is_escape(rest: &[u8]) -> bool {
    matches!(rest, [b'\\', next, ..] if !is_line_end(*next))
}

fn starts_name(rest: &[u8]) -> bool {
    match rest {
        [b'-', b'-', ..] => true,
        [b'-', after @ ..] => after.first().is_some_and(|byte| starts_in_name(*byte)) || is_escape(after),
        [byte, ..] if starts_in_name(*byte) => true,
        _ => is_escape(rest),
    }
}

fn starts_number(rest: &[u8]) -> bool {
    let digits = rest.strip_prefix(b"+").or_else(|| rest.strip_prefix(b"-"));
    let digits = digits.unwrap_or(rest);
    match digits {
        [b'.', digit, ..] | [digit, ..] => digit.is_ascii_digit(),
        [] => false,
    }
}

/// Where the bytes from `at` on end that are `alike`.
fn run_end(text: &[u8], at: usize, alike: impl Fn(u8) -> bool) -> usize {
    let rest = text.get(at..).unwrap_or(&[]);
    at + rest.iter().take_while(|byte| alike(**byte)).count()
}

fn find(text: &[u8], at: usize, sought: &[u8]) -> Option<usize> {
    let rest = text.get(at..)?;
    rest.windows(sought.len())
        .position(|part| part == sought)
        .map(|found| at + found)
}

/// Where the escape at `at` ends: up to six digits with a blank behind them, or any character.
fn escape_end(text: &[u8], at: usize) -> usize {
    let digits = text.iter().skip(at + 1).take(6);
    let digits = digits.take_while(|byte| byte.is_ascii_hexdigit()).count();
    let end = at + 1 + digits;
    match text.get(end..).unwrap_or(&[]) {
        // The rest of a longer character is part of the same name or string.
        [_, ..] if digits == 0 => end + 1,
        [b'\r', b'\n', ..] => end + 2,
        [byte, ..] if is_blank(*byte) => end + 1,
        _ => end,
    }
}

fn name_end(text: &[u8], mut at: usize) -> usize {
    loop {
        at = run_end(text, at, is_in_name);
        if !is_escape(text.get(at..).unwrap_or(&[])) {
            return at;
        }
        at = escape_end(text, at);
    }
}

fn number_end(text: &[u8], at: usize) -> usize {
    let digits = |at| run_end(text, at, |byte| byte.is_ascii_digit());
    let mut end = digits(at + usize::from(matches!(text[at], b'+' | b'-')));
    if let Some([b'.', digit, ..]) = text.get(end..)
        && digit.is_ascii_digit()
    {
        end = digits(end + 1);
    }
    if let Some([b'e' | b'E', rest @ ..]) = text.get(end..)
        && starts_number(rest)
        && !rest.starts_with(b".")
    {
        end = digits(end + 2);
    }
    match text.get(end..).unwrap_or(&[]) {
        [b'%', ..] => end + 1,
        rest if starts_name(rest) => name_end(text, end),
        _ => end,
    }
}

/// A string: its own line ends it at the latest.
fn quoted(text: &[u8], start: usize) -> (Kind, usize) {
    let mut at = start + 1;
    while let Some(&byte) = text.get(at) {
        if byte == text[start] {
            return (Kind::Quoted, at + 1);
        }
        if is_line_end(byte) {
            return (Kind::Bad, at);
        }
        at += if byte == b'\\' { 2 } else { 1 };
    }
    (Kind::Quoted, text.len())
}

/// A name, or what begins with one.
fn named(text: &[u8], start: usize) -> (Kind, usize) {
    let end = name_end(text, start);
    if text.get(end) != Some(&b'(') {
        return (Kind::Name, end);
    }
    let inner = run_end(text, end + 1, is_blank);
    let is_url = text[start..end].eq_ignore_ascii_case(b"url");
    if !is_url || matches!(text.get(inner), Some(b'"' | b'\'')) {
        return (Kind::Function, end + 1);
    }
    let mut kind = Kind::Url;
    let mut at = inner;
    while let Some(&byte) = text.get(at) {
        at += match byte {
            b')' => return (kind, at + 1),
            b'\\' => 2,
            _ => 1,
        };
        if is_blank(byte) {
            at = run_end(text, at, is_blank);
            kind = if matches!(text.get(at), None | Some(b')')) {
                kind
            } else {
                Kind::Bad
            };
        } else if matches!(byte, b'"' | b'\'' | b'(') {
            kind = Kind::Bad;
        }
    }
    (kind, text.len())
}

/// A name or the inside of a string, with the characters that its escapes stand for.
pub(super) fn unescaped(text: &str) -> Cow<'_, str> {
    let Some(first) = text.find('\\') else {
        return Cow::Borrowed(text);
    };
    let mut plain = text[..first].to_owned();
    let mut at = first;
    while let Some(c) = text[at..].chars().next() {
        let after = &text[at + c.len_utf8()..];
        match after.chars().next() {
            Some(next) if c == '\\' && next.is_ascii_hexdigit() => {
                let end = escape_end(text.as_bytes(), at);
                let code = u32::from_str_radix(text[at + 1..end].trim_end(), 16);
                let named = code.ok().and_then(char::from_u32).filter(|c| *c != '\0');
                plain.push(named.unwrap_or(char::REPLACEMENT_CHARACTER));
                at = end;
            }
            Some(next) if c == '\\' => {
                // A line goes on behind an escaped end.
                let is_one = after.starts_with("\r\n");
                plain.extend(Some(next).filter(|next| !matches!(next, '\n' | '\r' | '\x0c')));
                at += 1 + next.len_utf8() + usize::from(is_one);
            }
            None if c == '\\' => at += 1,
            _ => {
                plain.push(c);
                at += c.len_utf8();
            }
        }
    }
    Cow::Owned(plain)
}

/// What a string holds, whose quotation marks may be missing at the end.
pub(super) fn inside(quoted: &str) -> Cow<'_, str> {
    let mark = quoted.chars().next().unwrap_or('"');
    let inner = &quoted[1..];
    let escapes = inner.strip_suffix(mark).unwrap_or(inner);
    let slashes = escapes.len() - escapes.trim_end_matches('\\').len();
    // The last mark may be an escaped one.
    unescaped(if slashes.is_multiple_of(2) { escapes } else { inner })
}

/// The bracket that closes one.
fn closing(open: u8) -> u8 {
    match open {
        b'{' => b'}',
        b'[' => b']',
        _ => b')',
    }
}

/// The brackets that are open, each with its place; one that closes none of them is passed over (CSS Syntax 3, section 5.5.9).
#[derive(Debug, Default)]
pub(super) struct Brackets(Vec<(u8, usize)>);

impl Brackets {
    /// Passes a token; whether it closed one.
    pub(super) fn pass(&mut self, css: &str, token: &Token) -> bool {
        let last = css.as_bytes()[token.place.end - 1];
        match token.kind {
            Kind::Open | Kind::Function => self.0.push((closing(last), token.place.end - 1)),
            Kind::Close => return self.0.pop_if(|(close, _)| *close == last).is_some(),
            _ => {}
        }
        false
    }

    pub(super) fn are_closed(&self) -> bool {
        self.0.is_empty()
    }

    /// Where the last one stands, and what closes it.
    pub(super) fn last(&self) -> Option<(u8, usize)> {
        self.0.last().copied()
    }

    /// What would close them all.
    pub(super) fn closers(&self) -> impl Iterator<Item = char> {
        self.0.iter().rev().map(|(close, _)| char::from(*close))
    }
}

/// Where the first block of a text opens.
pub(in crate::scene) fn block_start(css: &str) -> Option<usize> {
    let mut tokens = Tokens::of(css, 0..css.len());
    let open = tokens.find(|token| token.kind == Kind::Open && css.as_bytes()[token.place.start] == b'{')?;
    Some(open.place.start)
}

/// Where a block ends, whose opening brace is passed.
pub(in crate::scene) fn block_end(block: &str) -> usize {
    let mut depth = 1;
    for Token { kind, place } in Tokens::of(block, 0..block.len()) {
        match (kind, block.as_bytes()[place.start]) {
            (Kind::Open, b'{') => depth += 1,
            (Kind::Close, b'}') => depth -= 1,
            _ => {}
        }
        if depth == 0 {
            return place.start;
        }
    }
    block.len()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn texts_are_cut_as_css_cuts_them() {
        let css = "a.b \\41 c{x:'}\\'' \"\\\"{\";/*}*/y:url(a;{b) -1.5e+3px +.5 1e3 #fff @media--x -->é--z f(";
        let found: Vec<&str> = Tokens::of(css, 0..css.len())
            .filter(|token| token.kind != Kind::Blank)
            .map(|token| &css[token.place])
            .collect();
        let expected = [
            "a",
            ".",
            "b",
            "\\41 c",
            "{",
            "x",
            ":",
            "'}\\''",
            "\"\\\"{\"",
            ";",
            "/*}*/",
            "y",
            ":",
            "url(a;{b)",
            "-1.5e+3px",
            "+.5",
            "1e3",
            "#fff",
            "@media--x",
            "-->",
            "é--z",
            "f(",
        ];
        assert_eq!(found, expected);
        let kind = |css: &str| Tokens::of(css, 0..css.len()).next().map(|token| token.kind);
        for (css, expected) in [
            ("'a", Kind::Quoted),
            ("'a\nb", Kind::Bad),
            ("url( a )", Kind::Url),
            ("url(a b)", Kind::Bad),
            ("url( 'a')", Kind::Function),
            ("\\\n", Kind::Sign),
            ("/*", Kind::Comment),
            ("#.", Kind::Sign),
        ] {
            assert_eq!(kind(css), Some(expected), "{css:?}");
        }
    }

    #[test]
    fn every_text_is_cut_whole() {
        for css in [
            "",
            "\\",
            "'\\",
            "url(\\",
            "\\é",
            "'\\é'",
            "#\\",
            "-",
            "1e",
            "@",
            "/*/",
            "é\\",
            "a\\é b",
            "\\1234567",
        ] {
            let ends: Vec<usize> = Tokens::of(css, 0..css.len()).map(|token| token.place.end).collect();
            assert!(
                ends.is_sorted() && ends.iter().all(|end| css.is_char_boundary(*end)),
                "{css}"
            );
            assert_eq!(ends.last().copied().unwrap_or(0), css.len(), "{css}");
        }
    }

    #[test]
    fn escapes_stand_for_characters() {
        for (text, expected) in [
            ("gre\\65n", "green"),
            ("\\31 0", "10"),
            ("a\\:b", "a:b"),
            ("\\000061\r\nb", "ab"),
            ("\\0 \\d800 \\110000 ", "\u{fffd}\u{fffd}\u{fffd}"),
            ("a\\\nb\\é", "abé"),
            ("a\\", "a"),
        ] {
            assert_eq!(unescaped(text), expected);
        }
        for (text, expected) in [
            ("'a'", "a"),
            ("'a", "a"),
            ("'a\\'", "a'"),
            ("'a\\\\'", "a\\"),
            ("\"", ""),
        ] {
            assert_eq!(inside(text), expected, "{text}");
        }
    }

    #[test]
    fn blocks_end_outside_of_strings_and_comments() {
        for css in ["a'{'/*{*/{b", "url({){"] {
            assert_eq!(block_start(css), css.rfind('{'), "{css}");
        }
        for css in ["a:'}';/*}*/b:{c}d}e", "\\}}"] {
            assert_eq!(block_end(css), css.rfind('}').unwrap_or(0), "{css}");
        }
        assert_eq!((block_start("a"), block_end("a(}b")), (None, 2));
    }
}
