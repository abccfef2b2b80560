//! A style sheet in its plain form: rules for a screen, and typefaces; all others are passed over, and told where they could matter.

use std::collections::HashSet;
use std::ops::Range;

use super::classes::Fate;
use super::plain::Plain;
use super::selectors::{Namespaces, Selector};
use super::tokens::{Brackets, Kind, Token, Tokens, unescaped};
use super::{declarations, selectors};
use crate::scene::media;
use crate::scene::report::quote;

/// Rules for media inside each other, at most: those further inside are not looked at.
const MAX_DEPTH: usize = 10;

/// A style sheet in its plain form.
pub(in crate::scene) fn sheet(css: &str) -> Plain {
    let mut reading = Reading {
        css,
        rules: Plain::default(),
        faces: Plain::default(),
        namespaces: Namespaces::default(),
    };
    reading.statements(0..css.len(), 0);
    let Reading { mut rules, faces, .. } = reading;
    rules.append(faces);
    let mut told = HashSet::new();
    rules.told.retain(|(_, message)| told.insert(message.clone()));
    rules
}

/// A style sheet that is being read.
struct Reading<'css> {
    css: &'css str,
    rules: Plain,
    /// The typefaces, which stand behind all rules: names of theirs may have braces.
    faces: Plain,
    namespaces: Namespaces,
}

/// A rule of any kind: what stands before its block, and the block.
struct Statement {
    head: Range<usize>,
    body: Option<Range<usize>>,
    end: usize,
}

impl Reading<'_> {
    /// Reads the rules in a part of the sheet, which stands in so many others.
    fn statements(&mut self, part: Range<usize>, depth: usize) {
        let mut at = part.start;
        loop {
            let mut tokens = Tokens::of(self.css, at..part.end);
            let first = loop {
                match tokens.next() {
                    None => return,
                    Some(token) if token.kind == Kind::Comment => self.cut_off(&token, part.end),
                    Some(token) if token.kind == Kind::Blank || depth == 0 && token.kind == Kind::Html => {}
                    Some(token) => break token,
                }
            };
            let is_at = first.kind == Kind::At;
            let statement = self.statement(first.place.start..part.end, is_at);
            at = statement.end;
            if is_at {
                self.at_rule(first.place, &statement, depth);
            } else if let Some(body) = statement.body {
                self.rule(statement.head, body);
            }
        }
    }

    /// The statement at the start of a part of the sheet.
    fn statement(&mut self, part: Range<usize>, is_at: bool) -> Statement {
        let mut brackets = Brackets::default();
        let mut body = None;
        let mut has_swallowed = false;
        for token in Tokens::of(self.css, part.clone()) {
            let text = &self.css[token.place.clone()];
            let was_closed = brackets.are_closed();
            let has_closed = brackets.pass(self.css, &token);
            if token.kind == Kind::Semicolon && was_closed && is_at {
                return Statement {
                    head: part.start..token.place.start,
                    body: None,
                    end: token.place.end,
                };
            }
            if token.kind == Kind::Open && was_closed && text == "{" {
                body = Some(token.place.clone());
            }
            match &body {
                Some(open) if has_closed && text == "}" && brackets.are_closed() => {
                    return Statement {
                        head: part.start..open.start,
                        body: Some(open.end..token.place.start),
                        end: token.place.end,
                    };
                }
                _ => {}
            }
            has_swallowed |= token.kind == Kind::Close && text == "}" && !has_closed;
            self.cut_off(&token, part.end);
        }
        let is_headless = |at: usize| body.is_none() && self.css[at..part.end].contains('{');
        if let Some((_, at)) = brackets.last().filter(|(_, at)| has_swallowed || is_headless(*at)) {
            self.swallows(at, &self.css[at..=at]);
        }
        let head = part.start..body.as_ref().map_or(part.end, |open| open.start);
        Statement {
            head,
            body: body.map(|open| open.end..part.end),
            end: part.end,
        }
    }

    /// Tells of a string or comment with rules in it that only the end closes.
    fn cut_off(&mut self, token: &Token, end: usize) {
        let text = &self.css[token.place.clone()];
        let (sign, close) = match token.kind {
            Kind::Comment => ("/*", "*/"),
            Kind::Quoted => (&text[..1], &text[..1]),
            _ => return,
        };
        let is_closed = text[sign.len()..].ends_with(close);
        if token.place.end == end && !is_closed && text.contains('}') {
            self.swallows(token.place.start, sign);
        }
    }

    /// Tells of something that is not closed.
    fn swallows(&mut self, at: usize, sign: &str) {
        let message = format!("{sign} is not closed: nothing behind it in this style sheet has an effect");
        self.tell(at, message);
    }

    /// Tells something of a place.
    fn tell(&mut self, at: usize, message: String) {
        self.rules.told.push((at, message));
    }

    /// Reads a rule with an `@`, the name of which stands at `name`.
    fn at_rule(&mut self, name: Range<usize>, statement: &Statement, depth: usize) {
        let Statement { head, body, .. } = statement;
        let whole = quote(self.css[head.clone()].trim());
        let words = &self.css[name.end..head.end];
        let rule = unescaped(&self.css[name.clone()]).to_ascii_lowercase();
        let start = name.start;
        match (rule.as_str(), body) {
            ("@media", Some(body)) => match media::applies(&without_comments(words)) {
                Some(true) if depth < MAX_DEPTH => self.statements(body.clone(), depth + 1),
                Some(_) => {}
                None => {
                    let why = "whether such conditions hold is not looked at";
                    self.tell(start, format!("the rules inside \"{whole}\" have no effect; {why}"));
                }
            },
            ("@import", _) => {
                self.tell(
                    start,
                    format!("\"{whole}\" has no effect; other style sheets are not fetched"),
                );
            }
            ("@supports" | "@layer" | "@scope" | "@container", Some(_)) => {
                self.tell(
                    start,
                    format!("the rules inside \"{whole}\" have no effect; take them out of it"),
                );
            }
            ("@layer", None) => self.tell(start, format!("\"{whole}\" has no effect; layers are not told apart")),
            ("@namespace", None) => self.namespaces.declare(words),
            ("@font-face", Some(body)) => {
                self.faces.come_from(start);
                self.faces.text += "@font-face{";
                declarations::write(self.css, body.clone(), &mut self.faces);
                self.faces.text += "}\n";
            }
            _ => {}
        }
    }

    /// Reads a rule with selectors.
    fn rule(&mut self, head: Range<usize>, body: Range<usize>) {
        let mut declared = Plain::default();
        let nested = declarations::write(self.css, body, &mut declared);
        let whole = self.css[head.clone()].trim();
        for at in nested {
            let outer = quote(whole);
            self.tell(
                at,
                format!("the rules inside \"{outer}\" have no effect; write them behind it, with whole selectors"),
            );
        }
        // Custom properties of the root are read.
        let is_missed = !declared
            .text
            .split(';')
            .all(|part| part.is_empty() || part.starts_with("--"));
        let selectors = match selectors::list(self.css, head.clone(), &mut self.namespaces) {
            Ok(selectors) => selectors,
            Err(why) => {
                if is_missed {
                    let whole = quote(whole);
                    self.tell(
                        head.start,
                        format!("\"{whole}\" is no selector ({why}); its rule has no effect"),
                    );
                }
                return;
            }
        };
        for Selector { place, fate, .. } in &selectors {
            if let (Fate::Unread(sign), true) = (fate, is_missed) {
                let whole = quote(&self.css[place.clone()]);
                let loss = if selectors.len() == 1 {
                    "its rule has no effect"
                } else {
                    "it selects nothing"
                };
                let message = format!("the selector \"{whole}\" is not understood ({sign}); {loss}");
                self.tell(place.start, message);
            }
        }
        let mut read = selectors
            .iter()
            .filter(|selector| selector.fate == Fate::Read)
            .peekable();
        if read.peek().is_none() || declared.text.is_empty() {
            return;
        }
        while let Some(selector) = read.next() {
            self.rules.come_from(selector.place.start);
            self.rules.text += &selector.text;
            self.rules.text += if read.peek().is_some() { "," } else { "{" };
        }
        self.rules.append(declared);
        self.rules.text += "}\n";
    }
}

/// A text without its comments.
fn without_comments(css: &str) -> String {
    let tokens = Tokens::of(css, 0..css.len()).filter(|token| token.kind != Kind::Comment);
    tokens.map(|token| &css[token.place]).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[track_caller]
    fn assert_becomes(css: &str, expected: &str) -> Vec<String> {
        let plain = sheet(css);
        assert_eq!(plain.text.replace('\n', ""), expected, "{css}");
        let told = plain.told.into_iter();
        told.map(|(at, message)| format!("{}: {message}", &css[at..].chars().take(3).collect::<String>()))
            .collect()
    }

    #[test]
    fn sheets_are_written_plainly() {
        for (css, expected) in [
            ("<!-- a{x:y} -->b{z:1}", "a{x:y;}b{z:1;}"),
            ("a{x:\"}\"}b{y:'{'}/*}*/c{}d{z:1", "a{x:\"}\";}b{y:'{';}d{z:1;}"),
            (
                "@media screen,\nprint{a{x:1}@media all{b{x:2}}}@media print{c{x:3}}d{x:4}",
                "a{x:1;}b{x:2;}d{x:4;}",
            ),
            (
                "@charset 'a;b';@keyframes k{from{x:y}}@font-face{src:url(a})}a,b{x:1}",
                "a,b{x:1;}@font-face{src:url(a});}",
            ),
            (
                "@namespace s 'http://www.w3.org/2000/svg';s|a{x:1}:root{--b:c}",
                "a{x:1;}:root{--b:c;}",
            ),
            ("a::before{content:'}'}b,c:target{x:1}", "b{x:1;}"),
        ] {
            assert_eq!(assert_becomes(css, expected), [""; 0], "{css}");
        }
    }

    #[test]
    fn what_has_no_effect_is_told_where_it_stands() {
        for (css, expected, told) in [
            (
                "@import 'a;b.css'; a{x:1}",
                "a{x:1;}",
                "@im: \"@import 'a;b.css'\" has no effect",
            ),
            (
                "@import url(a;b);a{x:1}",
                "a{x:1;}",
                "@im: \"@import url(a;b)\" has no effect",
            ),
            ("@layer a,b;c{x:1}", "c{x:1;}", "@la: \"@layer a,b\" has no effect"),
            (
                "@layer a{b{x:1}}c{x:1}",
                "c{x:1;}",
                "@la: the rules inside \"@layer a\" have no effect",
            ),
            (
                "@media (x){b{x:1}}c{x:1}",
                "c{x:1;}",
                "@me: the rules inside \"@media (x)\" have no effect",
            ),
            (
                "a,,b{x:1}c{x:1}",
                "c{x:1;}",
                "a,,: \"a,,b\" is no selector (a selector is missing",
            ),
            ("a,b:foo{x:1}", "", "a,b: \"a,b:foo\" is no selector (:foo is unknown)"),
            (
                "a:not(b){x:1}",
                "",
                "a:n: the selector \"a:not(b)\" is not understood (:not); its rule has no effect",
            ),
            (
                "a,b:empty{x:1}",
                "a{x:1;}",
                "b:e: the selector \"b:empty\" is not understood (:empty); it selects",
            ),
            (
                "a{x:1;b{y:2}z:3}",
                "a{x:1;z:3;}",
                "b{y: the rules inside \"a\" have no effect",
            ),
            ("a{x:1}b[c{x:1}", "a{x:1;}", "[c{: [ is not closed"),
            ("a{x:f(1}b{y:1}", "", "(1}: ( is not closed"),
            ("a{x:\"}b{y:1}", "a{x:\"}b{y:1}\";}", "\"}b: \" is not closed"),
            ("a{x:1}/* b{y:1}", "a{x:1;}", "/* : /* is not closed"),
        ] {
            let found = assert_becomes(css, expected);
            assert!(found.len() == 1 && found[0].starts_with(told), "{css}: {found:?}");
        }
        for css in [
            "a:not(b){}",
            "a,,b{}",
            ":root:not(b){--c:d}",
            "a{x:f(1",
            "a{x:'b",
            "a{x:1}/* b",
            "a",
            "@media x;",
        ] {
            assert!(sheet(css).told.is_empty(), "{css}");
        }
    }

    #[test]
    fn hostile_sheets_take_time_that_grows_with_their_length() {
        for piece in [
            "{",
            "a{",
            "(",
            "\"",
            "'\n",
            "/*",
            "@media all{",
            "url( ",
            "a[",
            "a,",
            "\\",
            "}",
            ";",
            "a{b:c;d{e:f}}",
            "@import '",
        ] {
            let css = piece.repeat(100_000 / piece.len());
            let plain = sheet(&css);
            assert!(plain.text.len() <= 3 * css.len(), "{piece}");
        }
    }
}
