//! Places of a document, quoted: the line that an element stands on, or a piece of one that is long.

use super::document::LineIndex;
use super::error::Fault;
use super::{Scene, SourceLocation};
use crate::plain;

/// Most characters of a quotation, without the dots where it is cut.
const MOST: usize = 200;
/// Characters before the element in a quotation of a long line.
const BEFORE: usize = 20;

/// Quotes places of one document.
#[derive(Debug)]
pub struct Quotes<'doc> {
    lines: LineIndex<'doc>,
}

impl Scene {
    /// The document, to be quoted; `None` where it was not kept. It is looked through once for all quotations.
    pub fn quotes(&self) -> Option<Quotes<'_>> {
        self.document.as_deref().map(Quotes::of)
    }
}

impl<'doc> Quotes<'doc> {
    /// Quotes `document`.
    pub(super) fn of(document: &'doc str) -> Self {
        Self {
            lines: LineIndex::new(document),
        }
    }

    /// A fault with its line.
    pub(super) fn with_line(&self, fault: Fault) -> Fault {
        let line = fault.location.and_then(|location| self.excerpt(location));
        Fault {
            line: line.filter(|line| !line.is_empty()).map(plain::into_line),
            ..fault
        }
    }

    /// The line of a place without spaces around it; of one longer than 200 characters as many around the place, with
    /// `...` where it is cut.
    pub fn excerpt(&self, place: SourceLocation) -> Option<String> {
        let (head, tail) = self.lines.text().split_at(self.lines.offset(place)?);
        // Lines may be as long as documents: no more is looked at than may be quoted.
        let head: Vec<char> = head.chars().rev().take_while(|c| *c != '\n').take(MOST + 1).collect();
        let tail: Vec<char> = tail.chars().take_while(|c| *c != '\n').take(MOST + 1).collect();
        let (mut before, mut after) = (head.len(), tail.len());
        if before + after > MOST {
            before = before.min(BEFORE.max(MOST.saturating_sub(after)));
            after = after.min(MOST - before);
        }
        let piece: String = head[..before].iter().rev().chain(&tail[..after]).collect();
        let dots = |cut: bool| if cut { "..." } else { "" };
        let (start, end) = (dots(before < head.len()), dots(after < tail.len()));
        Some(format!("{start}{}{end}", piece.trim()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn excerpt(text: &str, line: u32, column: u32) -> Option<String> {
        Quotes::of(text).excerpt(SourceLocation { line, column })
    }

    #[test]
    fn errors_quote_the_line_that_they_name() {
        let read = |text: &str| {
            let options = crate::scene::ReadOptions::default();
            crate::scene::read(text.as_bytes(), "a.svg", options, &crate::scene::NoResources).map(|_| ())
        };
        let error = read("<svg width='9' height='9'>\n  <rect id='a'>\n</svg>").expect_err("a tag that is not closed");
        assert_eq!(error.location.map(|place| place.line), Some(3), "{error}");
        assert_eq!(error.line.as_deref(), Some("</svg>"), "{error}");
        let long = format!("<svg width='9' height='9'>{}<rect></svg>", "<g></g>".repeat(9000));
        let line = read(&long).expect_err("on one line").line.expect("a piece of it");
        assert!(line.contains("<rect></svg>") && line.chars().count() < 250, "{line}");
        assert_eq!(read("").expect_err("nothing").line, None, "of no place");
    }

    #[test]
    fn excerpt_is_the_line_or_a_piece_around_the_element() {
        let short = "<svg>\n  <g><rect/></g> \r\n</svg>";
        assert_eq!(excerpt(short, 2, 6).as_deref(), Some("<g><rect/></g>"), "a short line");
        assert_eq!(excerpt(short, 9, 1), None, "no such line");
        let long = "\u{e9}".repeat(5000) + "<rect/>" + &"\u{4e2d}".repeat(5000);
        let found = excerpt(&long, 1, 5001).expect("a place");
        assert!(
            found.starts_with("...\u{e9}") && found.ends_with("\u{4e2d}..."),
            "{found}"
        );
        assert!(found.contains("<rect/>"), "{found}");
        assert_eq!(found.chars().count(), MOST + 6, "so many characters and the dots");
        let last = excerpt(&("x".repeat(5000) + "<rect/>"), 1, 5001).expect("a place");
        assert!(last.starts_with("...x") && last.ends_with("<rect/>"), "{last}");
        assert_eq!(last.chars().count(), MOST + 3, "as much before where nothing follows");
    }
}
