//! What was found of outlines in the row of tiles at work: its tiles ask for the same again and again.

use crate::raster::span::Span;

/// For each outline of a drawing what was found in some rows of pixels.
#[derive(Debug)]
pub(in crate::raster) struct OutlineCache<T> {
    rows: Span,
    /// When each outline was found last, and what.
    found: Vec<(u32, T)>,
    /// Counts how often everything was forgotten.
    age: u32,
}

impl<T: Copy + Default> OutlineCache<T> {
    /// An empty cache for a number of outlines.
    pub(in crate::raster) fn new(outlines: usize) -> Self {
        Self {
            rows: Span::EMPTY,
            found: vec![(0, T::default()); outlines],
            age: 0,
        }
    }

    /// Goes to some rows of pixels. Forgets everything, and says so, where these are others, or where what was found takes
    /// too much memory.
    #[inline]
    pub(in crate::raster) fn go_to(&mut self, rows: Span, is_too_large: bool) -> bool {
        let forgets = self.rows != rows || self.age == 0 || is_too_large;
        if forgets {
            self.rows = rows;
            self.age += 1;
        }
        forgets
    }

    /// What was found of an outline; what `find` finds where that was nothing yet.
    #[inline]
    pub(in crate::raster) fn get_or(&mut self, outline: usize, find: impl FnOnce() -> T) -> T {
        let (age, found) = &mut self.found[outline];
        if *age != self.age {
            *age = self.age;
            *found = find();
        }
        *found
    }

    /// What was found of an outline last.
    pub(in crate::raster) fn get(&self, outline: usize) -> T {
        self.found[outline].1
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_was_found_is_kept_for_its_rows() {
        let mut cache = OutlineCache::new(2);
        let rows = |start| Span { start, end: start + 32 };
        assert!(cache.go_to(rows(0), false), "nothing was found yet");
        assert_eq!(cache.get_or(1, || 7), 7);
        assert!(!cache.go_to(rows(0), false), "the same rows");
        assert_eq!(cache.get_or(1, || unreachable!("it is known")), 7);
        assert_eq!(cache.get_or(0, || 8), 8, "another outline");
        assert!(cache.go_to(rows(32), false), "other rows");
        assert_eq!(cache.get_or(1, || 9), 9);
        assert!(cache.go_to(rows(32), true), "too much memory");
        assert_eq!((cache.get_or(1, || 10), cache.get(1)), (10, 10));
    }
}
