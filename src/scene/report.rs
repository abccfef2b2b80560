//! What a document asks for and the picture lacks: skipped elements and attributes, textures that could not be read.
//!
//! A report is bounded however hostile the document is: beyond [`MAX_ENTRIES`] it only counts.

use std::fmt;

use super::SourceLocation;
use crate::plain;

/// Entries of each kind that a report keeps.
const MAX_ENTRIES: usize = 100;
/// Characters of a foreign name or value that a message quotes.
const MAX_QUOTE: usize = 60;

/// Everything that the reader could not, or would not, turn into primitives.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Report {
    /// Elements and attributes without effect, in the order of their first appearance.
    pub skipped: Vec<Skipped>,
    /// What was read differently from what the document says, in document order.
    pub warnings: Vec<Warning>,
    /// Skipped names and warnings beyond those listed.
    pub unlisted: u32,
}

/// An element or attribute that the dialect in force does not draw.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Skipped {
    /// What kind of thing.
    pub kind: SkippedKind,
    /// Its name, such as `circle` or `clip-path`.
    pub name: Box<str>,
    /// How often.
    pub count: u32,
    /// Where it appears first.
    pub first: SourceLocation,
}

/// What was skipped.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum SkippedKind {
    /// An element with all that it holds.
    Element,
    /// An attribute or style property of an element that is otherwise drawn.
    Attribute,
}

/// One thing that was read differently from what the document says.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Warning {
    /// The element concerned; the first of several.
    pub location: SourceLocation,
    /// What happened and what was done instead, in one line.
    pub message: String,
    /// How often.
    pub count: u32,
}

impl Report {
    /// Whether the picture lacks nothing.
    pub fn is_empty(&self) -> bool {
        self.skipped.is_empty() && self.warnings.is_empty()
    }

    /// One line per entry, for the interface and for stderr.
    pub fn lines(&self) -> impl Iterator<Item = String> + '_ {
        let skipped = self.skipped.iter().map(ToString::to_string);
        let warnings = self.warnings.iter().map(ToString::to_string);
        let rest = (self.unlisted > 0).then(|| format!("and {} more", self.unlisted));
        skipped.chain(warnings).chain(rest)
    }

    /// The same lines as they stand behind the name of a file: the place, if there is one, follows its colon.
    pub fn lines_in<'a>(&'a self, file: &'a str) -> impl Iterator<Item = String> + 'a {
        let listed = self.skipped.len() + self.warnings.len();
        let named = move |(i, line): (usize, String)| {
            let blank = if i < listed { "" } else { " " };
            format!("{file}:{blank}{line}")
        };
        self.lines().enumerate().map(named)
    }

    /// How many entries there are, with those that are only counted.
    pub fn count(&self) -> usize {
        let unlisted = usize::try_from(self.unlisted).unwrap_or(usize::MAX);
        unlisted.saturating_add(self.skipped.len() + self.warnings.len())
    }

    /// Counts one skipped element or attribute.
    pub(super) fn skip(&mut self, kind: SkippedKind, name: &str, location: SourceLocation) {
        let name = quote(name);
        let known = self.skipped.iter_mut().find(|s| s.kind == kind && *s.name == *name);
        if let Some(skipped) = known {
            skipped.count = skipped.count.saturating_add(1);
        } else if self.skipped.len() < MAX_ENTRIES {
            self.skipped.push(Skipped {
                kind,
                name: name.into(),
                count: 1,
                first: location,
            });
        } else {
            self.unlisted = self.unlisted.saturating_add(1);
        }
    }

    /// Adds a warning; one that says the same is counted.
    pub(super) fn warn(&mut self, location: SourceLocation, message: String) {
        if let Some(known) = self.warnings.iter_mut().find(|known| known.message == message) {
            known.count = known.count.saturating_add(1);
        } else if self.warnings.len() < MAX_ENTRIES {
            self.warnings.push(Warning {
                location,
                message,
                count: 1,
            });
        } else {
            self.unlisted = self.unlisted.saturating_add(1);
        }
    }

    /// Adds a warning that is told of the first place alone.
    pub(super) fn warn_once(&mut self, location: SourceLocation, message: &str) {
        if !self.warnings.iter().any(|warning| warning.message == message) {
            self.warn(location, message.to_owned());
        }
    }
}

impl fmt::Display for Skipped {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { name, count, first, .. } = self;
        match self.kind {
            SkippedKind::Element => write!(f, "{first}: <{name}> is not drawn")?,
            SkippedKind::Attribute => write!(f, "{first}: {name} has no effect")?,
        }
        if *count > 1 {
            write!(f, " ({count} times in all)")?;
        }
        Ok(())
    }
}

impl fmt::Display for Warning {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}", self.location, self.message)?;
        if self.count > 1 {
            write!(f, " ({} times in all)", self.count)?;
        }
        Ok(())
    }
}

/// A foreign string fit to be quoted in a message.
pub(super) fn quote(text: &str) -> String {
    shorten(text, MAX_QUOTE)
}

/// At most `limit` characters of a foreign string, in one line.
pub(super) fn shorten(text: &str, limit: usize) -> String {
    // Blanks of a document may be line breaks and tabs.
    let clean = |c: char| if c.is_ascii_whitespace() { ' ' } else { c };
    let short: String = text.chars().take(limit).map(clean).collect();
    let mut short = plain::line(&short).into_owned();
    if text.chars().nth(limit).is_some() {
        short.push_str("...");
    }
    short
}

#[cfg(test)]
mod tests {
    use super::*;

    const FIRST: SourceLocation = SourceLocation { line: 3, column: 7 };

    #[test]
    fn report_counts_and_keeps_the_first_place() {
        let mut report = Report::default();
        report.skip(SkippedKind::Element, "circle", FIRST);
        report.skip(SkippedKind::Element, "circle", SourceLocation { line: 9, column: 1 });
        report.skip(SkippedKind::Attribute, "mask", FIRST);
        report.warn(FIRST, "fill is read as black".into());
        report.warn(SourceLocation { line: 9, column: 1 }, "fill is read as black".into());
        let lines: Vec<String> = report.lines().collect();
        assert_eq!(
            lines,
            [
                "3:7: <circle> is not drawn (2 times in all)",
                "3:7: mask has no effect",
                "3:7: fill is read as black (2 times in all)"
            ],
            "one line each"
        );
    }

    #[test]
    fn report_stays_small() {
        let mut report = Report::default();
        for i in 0..10_000 {
            report.skip(SkippedKind::Element, &format!("e{i}"), FIRST);
            report.warn(FIRST, format!("w{i}"));
        }
        assert_eq!(
            report.lines().count(),
            2 * MAX_ENTRIES + 1,
            "two full lists and the rest"
        );
        assert_eq!(report.unlisted, 19_800, "the rest is counted");
        assert_eq!(report.count(), 20_000, "all of them");
        let named: Vec<String> = report.lines_in("a.svg").collect();
        assert_eq!(named[100], "a.svg:3:7: w0", "with its place");
        assert_eq!(named[200], "a.svg: and 19800 more", "without one");
    }

    #[test]
    fn quote_makes_one_short_line() {
        assert_eq!(quote("a\nb"), "a b", "no line break");
        assert_eq!(quote("a\u{1b}\u{202e}b"), "a\\u{1b}\\u{202e}b", "nothing that steers");
        assert_eq!(quote(&"x".repeat(1000)).len(), MAX_QUOTE + 3, "shortened");
    }
}
