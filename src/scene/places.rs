//! A text in which pieces of another are replaced, and where in the other each place of it comes from.

use std::borrow::Cow;
use std::ops::Range;

use super::css::Place;

/// Where each part of a text begins, and where in another it comes from, in order. Without one both are the same.
#[derive(Debug, Default)]
pub(super) struct Places(Vec<Place>);

impl Places {
    /// Where the byte `at` comes from.
    pub(super) fn origin(&self, at: usize) -> usize {
        let next = self.0.partition_point(|place| place.at <= at);
        let Some(place) = next.checked_sub(1).and_then(|known| self.0.get(known)) else {
            return at;
        };
        place.from + (at - place.at)
    }

    pub(super) fn are_same(&self) -> bool {
        self.0.is_empty()
    }
}

/// A text of which pieces are replaced from its beginning to its end.
#[derive(Debug)]
pub(super) struct Changed<'t> {
    before: &'t str,
    text: String,
    copied: usize,
    places: Vec<Place>,
}

impl<'t> Changed<'t> {
    pub(super) fn new(before: &'t str) -> Self {
        Self {
            before,
            text: String::new(),
            copied: 0,
            places: Vec::new(),
        }
    }

    /// Puts `piece` in the place of what is there, which is behind all that was replaced before. `places` are those of the piece that
    /// come from another place than its beginning.
    pub(super) fn replace(&mut self, there: Range<usize>, piece: &str, places: impl IntoIterator<Item = Place>) {
        self.copy(there.start);
        let at = self.text.len();
        self.note(there.start);
        let moved = places.into_iter().map(|place| Place {
            at: at + place.at,
            ..place
        });
        self.places.extend(moved);
        self.text.push_str(piece);
        self.copied = there.end;
        self.note(there.end);
    }

    fn copy(&mut self, end: usize) {
        self.text.push_str(self.before.get(self.copied..end).unwrap_or(""));
        self.copied = end;
    }

    fn note(&mut self, from: usize) {
        let at = self.text.len();
        self.places.push(Place { at, from });
    }

    /// The text with all changes.
    pub(super) fn done(mut self) -> (Cow<'t, str>, Places) {
        if self.places.is_empty() {
            return (Cow::Borrowed(self.before), Places::default());
        }
        self.copy(self.before.len());
        (Cow::Owned(self.text), Places(self.places))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_of_what_is_replaced_come_from_where_it_was() {
        let mut changed = Changed::new("abcdef");
        changed.replace(1..1, "--", []);
        changed.replace(2..4, "+xyz", [Place { at: 2, from: 3 }]);
        let (text, places) = changed.done();
        assert_eq!(text, "a--b+xyzef");
        for (sought, origin) in [
            ('a', 0),
            ('-', 1),
            ('b', 1),
            ('+', 2),
            ('y', 3),
            ('z', 4),
            ('e', 4),
            ('f', 5),
        ] {
            let at = text.find(sought).expect("there");
            assert_eq!(places.origin(at), origin, "{sought}");
        }
        assert!(!places.are_same());
        let (text, places) = Changed::new("abc").done();
        assert!(text == "abc" && places.are_same() && places.origin(2) == 2);
    }
}
