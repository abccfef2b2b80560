//! Changes to a text, gathered in any order and made at once.

use std::borrow::Cow;
use std::ops::Range;

/// Pieces of a text that are to be replaced; what lies inside of one that is stays away with it.
#[derive(Debug, Default)]
pub(super) struct Edits(Vec<(Range<usize>, String)>);

impl Edits {
    /// Puts `piece` before the byte `at`.
    pub(super) fn insert(&mut self, at: usize, piece: String) {
        self.0.push((at..at, piece));
    }

    /// Puts `piece` in the place of what is there.
    pub(super) fn replace(&mut self, there: Range<usize>, piece: String) {
        self.0.push((there, piece));
    }

    /// The text with all changes; where there are none, the text itself.
    pub(super) fn apply_to(self, text: Cow<'_, str>) -> Cow<'_, str> {
        if self.0.is_empty() {
            return text;
        }
        Cow::Owned(self.apply(&text))
    }

    /// The text with all changes.
    pub(super) fn apply(mut self, text: &str) -> String {
        // In the order in which they were gathered where two stand at one place.
        self.0.sort_by_key(|(there, _)| there.start);
        let more: usize = self.0.iter().map(|(_, piece)| piece.len()).sum();
        let mut changed = String::with_capacity(text.len() + more);
        let (mut begun, mut copied) = (0, 0);
        for (there, piece) in self.0 {
            if begun < there.start && there.start < copied {
                continue;
            }
            changed.push_str(text.get(copied..there.start).unwrap_or(""));
            changed.push_str(&piece);
            if there.end > copied {
                (begun, copied) = (there.start, there.end);
            }
        }
        changed.push_str(text.get(copied..).unwrap_or(""));
        changed
    }
}

/// A value as it stands in an attribute in double or single quotes.
pub(super) fn escaped(value: &str) -> String {
    let mut escaped = String::with_capacity(value.len());
    for c in value.chars() {
        match c {
            '&' => escaped.push_str("&amp;"),
            '<' => escaped.push_str("&lt;"),
            '"' => escaped.push_str("&quot;"),
            '\'' => escaped.push_str("&apos;"),
            c => escaped.push(c),
        }
    }
    escaped
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn edits_are_made_in_the_order_of_the_text() {
        let mut edits = Edits::default();
        edits.replace(4..7, "<g>".to_owned());
        edits.insert(0, "[".to_owned());
        edits.insert(4, "\u{e9}".to_owned());
        assert_eq!(
            edits.apply("abc def"),
            "[abc <g>\u{e9}",
            "a change where another begins comes first"
        );
        let mut edits = Edits::default();
        edits.replace(0..4, "x".to_owned());
        edits.insert(2, "y".to_owned());
        edits.insert(4, "z".to_owned());
        assert_eq!(edits.apply("abcdef"), "xzef", "nothing inside of what is gone");
        assert_eq!(Edits::default().apply("abc"), "abc", "nothing to do");
    }
}
