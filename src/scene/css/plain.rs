//! A style in its plain form, with the places that it comes from.

/// A part of a plain text, and where in the style it was made from its beginning stands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::scene) struct Place {
    pub(in crate::scene) at: usize,
    pub(in crate::scene) from: usize,
}

/// A style in its plain form.
#[derive(Debug, Default)]
pub(in crate::scene) struct Plain {
    pub(in crate::scene) text: String,
    /// Where its parts come from, in the order of the text.
    pub(in crate::scene) places: Vec<Place>,
    /// What has no effect, and where that stands in the style that was read.
    pub(in crate::scene) told: Vec<(usize, String)>,
}

impl Plain {
    /// Notes that what is written next comes from `from`.
    pub(super) fn come_from(&mut self, from: usize) {
        let at = self.text.len();
        self.places.push(Place { at, from });
    }

    /// Puts what was written apart behind.
    pub(super) fn append(&mut self, other: Self) {
        let moved = other.places.into_iter().map(|place| Place {
            at: self.text.len() + place.at,
            ..place
        });
        self.places.extend(moved);
        self.text.push_str(&other.text);
        self.told.extend(other.told);
    }
}
