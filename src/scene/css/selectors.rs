//! Selectors as the reader of styles takes them. Of a list each one is told apart: one that is no CSS takes its whole rule with it
//! (Selectors 4, section 3.9), one that is not understood here only itself.

use std::collections::HashMap;
use std::ops::Range;

use super::classes::{self, Fate};
use super::tokens::{Brackets, Kind, Token, Tokens, inside, unescaped};
use crate::scene::report::quote;

/// The namespace of SVG.
const SVG: &str = "http://www.w3.org/2000/svg";

/// Longest list of selectors that is read, in bytes.
const MAX_LENGTH: usize = 1 << 20;

/// Most comparisons with a part of an attribute in one document.
pub(in crate::scene) const MOST_COMPARISONS: usize = 100;

/// The namespaces that a style sheet names.
#[derive(Debug, Default)]
pub(super) struct Namespaces {
    /// Whether each prefix stands for that of SVG.
    prefixes: HashMap<String, bool>,
    /// Whether elements without a prefix are of another.
    is_other: bool,
    /// How many comparisons with parts of attributes there were.
    comparisons: usize,
}

impl Namespaces {
    /// Takes over a rule `@namespace`, of which `head` is what stands behind the name.
    pub(super) fn declare(&mut self, head: &str) {
        let mut prefix = None;
        for Token { kind, place } in Tokens::of(head, 0..head.len()) {
            let text = &head[place];
            let address = match kind {
                Kind::Name => {
                    prefix = Some(unescaped(text).into_owned());
                    continue;
                }
                Kind::Quoted => inside(text),
                Kind::Url => unescaped(text[4..].trim_end_matches(')').trim()),
                _ => continue,
            };
            let is_svg = address == SVG;
            match prefix {
                Some(prefix) => _ = self.prefixes.insert(prefix, is_svg),
                None => self.is_other = !is_svg,
            }
            return;
        }
    }
}

/// A selector of a list.
#[derive(Debug, PartialEq, Eq)]
pub(super) struct Selector {
    /// Where it stands.
    pub(super) place: Range<usize>,
    pub(super) text: String,
    pub(super) fate: Fate,
}

/// The selectors of a list in a part of `css`, or why they are none.
pub(super) fn list(css: &str, part: Range<usize>, namespaces: &mut Namespaces) -> Result<Vec<Selector>, String> {
    if part.len() > MAX_LENGTH {
        return Err(format!("longer than {} MiB", MAX_LENGTH >> 20));
    }
    let tokens: Vec<Token> = Tokens::of(css, part.clone()).collect();
    let mut found = Vec::new();
    let mut start = 0;
    let mut brackets = Brackets::default();
    for (at, token) in tokens.iter().enumerate() {
        brackets.pass(css, token);
        if token.kind == Kind::Comma && brackets.are_closed() {
            found.push(Reading::of(css, &tokens[start..at], namespaces).selector()?);
            start = at + 1;
        }
    }
    found.push(Reading::of(css, &tokens[start..], namespaces).selector()?);
    Ok(found)
}

/// A selector that is being read.
struct Reading<'r> {
    css: &'r str,
    tokens: &'r [Token],
    at: usize,
    namespaces: &'r mut Namespaces,
    text: String,
    fate: Fate,
    /// Whether something stands since the last combinator.
    is_begun: bool,
}

impl<'r> Reading<'r> {
    fn of(css: &'r str, tokens: &'r [Token], namespaces: &'r mut Namespaces) -> Self {
        let is_void = |token: &Token| matches!(token.kind, Kind::Blank | Kind::Comment);
        let start = tokens.iter().take_while(|token| is_void(token)).count();
        let end = tokens.iter().rev().take_while(|token| is_void(token)).count();
        Self {
            css,
            tokens: tokens.get(start..tokens.len() - end).unwrap_or(&[]),
            at: 0,
            namespaces,
            text: String::new(),
            fate: Fate::Read,
            is_begun: false,
        }
    }

    /// The text of the token so many places on.
    fn ahead(&self, by: usize) -> (Option<Kind>, &'r str) {
        let token = self.tokens.get(self.at + by);
        token.map_or((None, ""), |token| (Some(token.kind), &self.css[token.place.clone()]))
    }

    /// What of it is not understood, or selects nothing; the first counts.
    fn becomes(&mut self, fate: Fate) {
        if self.fate == Fate::Read {
            self.fate = fate;
        }
    }

    fn selector(mut self) -> Result<Selector, String> {
        let (Some(first), Some(last)) = (self.tokens.first(), self.tokens.last()) else {
            return Err("a selector is missing at a comma".to_owned());
        };
        let place = first.place.start..last.place.end;
        while self.at < self.tokens.len() {
            self.step()?;
        }
        if !self.is_begun {
            return Err(format!(
                "nothing follows {}",
                self.text.trim_end().chars().next_back().unwrap_or(' ')
            ));
        }
        let Self { text, fate, .. } = self;
        Ok(Selector { place, text, fate })
    }

    /// Reads one part.
    fn step(&mut self) -> Result<(), String> {
        let (kind, text) = self.ahead(0);
        match (kind, text) {
            (Some(Kind::Comment), _) => self.at += 1,
            (Some(Kind::Blank), _) => {
                self.at += 1;
                // Another combinator behind it counts instead.
                let is_sign = matches!(self.ahead(0).1, ">" | "+" | "~") || self.ahead(0).0 == Some(Kind::Comment);
                if self.is_begun && !is_sign {
                    self.text.push(' ');
                    self.is_begun = false;
                }
            }
            (Some(Kind::Sign), ">" | "+" | "~") => {
                if !self.is_begun {
                    return Err(format!("nothing stands before {text}"));
                }
                if text == "~" {
                    self.becomes(Fate::Unread("~".to_owned()));
                }
                self.text.extend([" ", text, " "]);
                self.at += 1;
                self.is_begun = false;
                while self.ahead(0).0 == Some(Kind::Blank) {
                    self.at += 1;
                }
            }
            (Some(Kind::Sign), "*" | "|") | (Some(Kind::Name), _) => self.element()?,
            _ => {
                if self.namespaces.is_other && !self.is_begun {
                    self.becomes(Fate::Nothing);
                }
                match (kind, text) {
                    (Some(Kind::Hash), name) => self.name('#', &name[1..])?,
                    (Some(Kind::Sign), ".") => {
                        self.at += 1;
                        let (Some(Kind::Name), name) = self.ahead(0) else {
                            return Err("no name follows .".to_owned());
                        };
                        self.name('.', name)?;
                    }
                    (Some(Kind::Open), "[") => self.attribute()?,
                    (Some(Kind::Colon), _) => self.class()?,
                    (Some(Kind::Sign), "&") => {
                        self.becomes(Fate::Unread("&".to_owned()));
                        self.at += 1;
                    }
                    (Some(Kind::Sign), "#") => return Err("no name follows #".to_owned()),
                    (_, other) => return Err(format!("{} is out of place", quote(other))),
                }
                self.is_begun = true;
            }
        }
        Ok(())
    }

    /// Reads the name of an element, with its namespace.
    fn element(&mut self) -> Result<(), String> {
        if self.is_begun {
            return Err(format!("{} is out of place", quote(self.ahead(0).1)));
        }
        let is_name = |(kind, text): (Option<Kind>, &str)| kind == Some(Kind::Name) || text == "*";
        if self.ahead(0).1 == "|" && is_name(self.ahead(1)) {
            // Without a namespace.
            self.becomes(Fate::Nothing);
            self.at += 1;
        } else if self.ahead(1).1 == "|" && is_name(self.ahead(2)) {
            let prefix = self.ahead(0).1;
            let is_svg = self.namespaces.prefixes.get(&*unescaped(prefix)).copied();
            match is_svg.or((prefix == "*").then_some(true)) {
                Some(true) => {}
                Some(false) => self.becomes(Fate::Nothing),
                None => return Err(format!("no @namespace declares {}", quote(prefix))),
            }
            self.at += 2;
        } else if self.namespaces.is_other {
            self.becomes(Fate::Nothing);
        }
        let (_, text) = self.ahead(0);
        let name = unescaped(text);
        if text == "|" {
            return Err("no name follows |".to_owned());
        }
        if text != "*" && !is_plain(&name) {
            self.becomes(Fate::Nothing);
        }
        self.text += &name;
        self.at += 1;
        self.is_begun = true;
        Ok(())
    }

    /// Reads the name of a class or an id.
    fn name(&mut self, sign: char, name: &str) -> Result<(), String> {
        let is_id = sign == '#';
        if is_id && name.starts_with(|c: char| c.is_ascii_digit()) {
            return Err(format!("#{} begins with a digit", quote(name)));
        }
        let name = unescaped(name);
        self.at += 1;
        if is_plain(&name) {
            self.text.push(sign);
            self.text += &name;
        } else {
            let comparison = if is_id { "id=" } else { "class~=" };
            match quoted(&name) {
                Some(name) => self.text.extend(["[", comparison, &name, "]"]),
                None => self.becomes(Fate::Unread("\\".to_owned())),
            }
        }
        Ok(())
    }

    /// Passes blanks and comments.
    fn pass(&mut self) {
        while matches!(self.ahead(0).0, Some(Kind::Blank | Kind::Comment)) {
            self.at += 1;
        }
    }

    /// Reads what is asked of an attribute.
    fn attribute(&mut self) -> Result<(), String> {
        const WRONG: &str = "what stands in [] is no comparison";
        self.at += 1;
        self.pass();
        if self.ahead(0).1 == "|" {
            self.at += 1;
        } else if self.ahead(1).1 == "|" && self.ahead(2).0 == Some(Kind::Name) {
            let prefix = self.ahead(0).1;
            self.becomes(Fate::Unread(format!("{prefix}|")));
            self.at += 2;
        }
        let (Some(Kind::Name), name) = self.ahead(0) else {
            return Err(WRONG.to_owned());
        };
        let name = unescaped(name);
        if !is_plain(&name) {
            // With a colon it would have a namespace.
            self.becomes(Fate::Nothing);
        }
        self.at += 1;
        self.pass();
        if self.ahead(0).1 == "]" {
            self.text.extend(["[", &name, "]"]);
            self.at += 1;
            return Ok(());
        }
        let operator = match (self.ahead(0).1, self.ahead(1).1) {
            ("=", _) => "=".to_owned(),
            (sign @ ("~" | "|" | "^" | "$" | "*"), "=") => format!("{sign}="),
            _ => return Err(WRONG.to_owned()),
        };
        self.at += operator.len();
        self.pass();
        let value = match self.ahead(0) {
            (Some(Kind::Quoted), text) => inside(text),
            (Some(Kind::Name), text) => unescaped(text),
            _ => return Err(WRONG.to_owned()),
        };
        self.at += 1;
        self.pass();
        if let (Some(Kind::Name), flag) = self.ahead(0) {
            match flag {
                "s" | "S" => {}
                "i" | "I" => self.becomes(Fate::Unread(flag.to_owned())),
                _ => return Err(WRONG.to_owned()),
            }
            self.at += 1;
            self.pass();
        }
        if self.ahead(0).1 != "]" {
            return Err(WRONG.to_owned());
        }
        self.at += 1;
        self.compare(&name, &operator, &value);
        Ok(())
    }

    /// Writes a comparison with an attribute's value.
    fn compare(&mut self, name: &str, operator: &str, value: &str) {
        let is_of_part = matches!(operator, "^=" | "$=" | "*=");
        if is_of_part {
            self.namespaces.comparisons += 1;
        }
        let is_too_much = self.namespaces.comparisons > MOST_COMPARISONS || value.contains(['"', '\'', '\\', '&', '<']);
        match quoted(value).filter(|_| !is_of_part || !is_too_much) {
            Some(value) => self.text.extend(["[", name, operator, &value, "]"]),
            None => self.becomes(Fate::Unread(operator.to_owned())),
        }
    }

    /// Reads a class of elements, or a part of one.
    fn class(&mut self) -> Result<(), String> {
        let colons = if self.ahead(1).0 == Some(Kind::Colon) { 2 } else { 1 };
        let (kind, text) = self.ahead(colons);
        if !matches!(kind, Some(Kind::Name | Kind::Function)) {
            return Err("no name follows :".to_owned());
        }
        let name = unescaped(text.trim_end_matches('(')).to_ascii_lowercase();
        self.at += colons;
        let start = self.at;
        self.skip();
        let whole = self.css[self.tokens[start].place.start..self.tokens[self.at - 1].place.end].to_owned();
        let fate = match (colons, kind) {
            (2, _) => classes::part(&name),
            (_, Some(Kind::Function)) => classes::function(&name),
            _ => classes::class(&name),
        };
        match fate {
            Some(Fate::Read) if name == "scope" => self.text += ":root",
            Some(Fate::Read) if kind == Some(Kind::Function) => self.text.extend([":", &whole]),
            Some(Fate::Read) => self.text.extend([":", &name]),
            Some(fate) => self.becomes(fate),
            None => return Err(format!("{}{} is unknown", &"::"[..colons], quote(&name))),
        }
        Ok(())
    }

    /// Passes a name, or a function with all that is inside.
    fn skip(&mut self) {
        let mut brackets = Brackets::default();
        while let Some(token) = self.tokens.get(self.at) {
            self.at += 1;
            brackets.pass(self.css, token);
            if brackets.are_closed() {
                return;
            }
        }
    }
}

/// Whether the reader of styles takes it as a name.
pub(super) fn is_plain(name: &str) -> bool {
    // It takes those beyond Latin-1's letters only.
    let is_letter = |c: char| c.is_ascii_alphabetic() || c == '_' || u32::from(c) > 237;
    let inner = name.strip_prefix('-').unwrap_or(name);
    inner.starts_with(is_letter) && inner.chars().all(|c| is_letter(c) || c.is_ascii_digit() || c == '-')
}

/// A string as the reader of styles takes it, which knows no escapes.
pub(super) fn quoted(value: &str) -> Option<String> {
    let mark = ['"', '\''].into_iter().find(|mark| !value.contains(*mark))?;
    (!value.ends_with('\\')).then(|| format!("{mark}{value}{mark}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(css: &str) -> Result<Vec<Selector>, String> {
        let mut namespaces = Namespaces::default();
        namespaces.declare(" svg url(http://www.w3.org/2000/svg)");
        namespaces.declare(" html 'http://www.w3.org/1999/xhtml'");
        list(css, 0..css.len(), &mut namespaces)
    }

    #[test]
    fn selectors_are_written_plainly() {
        for (css, expected) in [
            ("a>b+ c  d/**/ .e#f", "a > b + c d .e#f"),
            ("*|a *|* svg|b svg|*", "a * b *"),
            (".\\31 0#\\61 .a\\:b", "[class~=\"10\"]#a[class~=\"a:b\"]"),
            ("#x\\.y.é", "[id=\"x.y\"][class~=\"é\"]"),
            (
                "[ a = b ][c~='d\"'][e|=\"f}\" s][g]",
                "[a=\"b\"][c~='d\"'][e|=\"f}\"][g]",
            ),
            (":ROOT:First-Child:lang(en)", ":root:first-child:lang(en)"),
            ("a /* b */ > /* c */ d", "a > d"),
        ] {
            let found = read(css).expect(css);
            assert_eq!(found.len(), 1, "{css}");
            assert_eq!(
                (found[0].text.as_str(), &found[0].fate),
                (expected, &Fate::Read),
                "{css}"
            );
        }
    }

    #[test]
    fn lists_with_one_that_is_none_are_none() {
        for css in [
            "",
            "a,",
            ",a",
            "a,,b",
            "a>",
            "a > + b",
            "> a",
            "a,.b>",
            "a,#",
            "a,.",
            "a:foo",
            "a,b[x",
            "a,b[x=]",
            "a,c::nonsense",
            "a,b:",
            "ab|c",
            "a|",
            "#1",
            ".5a",
            "a!b",
            "a*",
            "[b]c",
            "} a",
            ";a",
            "a,b:-x-y",
            "a b,{",
            "50%",
            "a / b",
        ] {
            assert!(read(css).is_err(), "{css}: {:?}", read(css));
        }
    }

    #[test]
    fn selectors_that_are_not_understood_leave_the_others() {
        let found =
            read("a, b:not(.c, d), e ~ f, g::before, h:before, html|i, j:target, k[l|m], [n=o i], :NTH-CHILD(2n + 1)");
        let fates: Vec<Fate> = found.expect("a list").into_iter().map(|found| found.fate).collect();
        let unread = |sign: &str| Fate::Unread(sign.to_owned());
        let expected = [
            Fate::Read,
            unread(":not"),
            unread("~"),
            Fate::Nothing,
            Fate::Nothing,
            Fate::Nothing,
            Fate::Nothing,
            unread("l|"),
            unread("i"),
            unread(":nth-child"),
        ];
        assert_eq!(fates, expected);
    }
}
