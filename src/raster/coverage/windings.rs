//! How often edges wind around each of some rows, where they change it for runs of rows only.

use crate::raster::span::{Span, to_index};

/// Windings of rows, kept as what changes from each row to the next: so an edge changes two numbers, however many rows
/// it crosses, and whether all rows are wound around alike is known at once.
#[derive(Debug, Default)]
pub(in crate::raster) struct RowWindings {
    /// How each row differs from the one above, the first from nothing; one more than there are rows. All zero between
    /// [`RowWindings::forget`] and the next edge.
    steps: Vec<i32>,
    /// How many rows differ from the one above.
    uneven: u32,
}

impl RowWindings {
    /// Nothing winds around so many rows.
    #[inline]
    pub(in crate::raster) fn begin(&mut self, rows: i32) {
        self.steps.resize(to_index(rows) + 1, 0);
        self.uneven = 0;
    }

    /// An edge winds around some rows, counted from the first.
    #[inline]
    pub(in crate::raster) fn add(&mut self, rows: Span, winding: i32) {
        let last = self.steps.len() - 1;
        for (row, change) in [(to_index(rows.start), winding), (to_index(rows.end), -winding)] {
            let step = &mut self.steps[row];
            let before = u32::from(*step != 0);
            *step += change;
            // The first row has none above, and the last none below.
            if row > 0 && row < last {
                self.uneven = self.uneven + u32::from(*step != 0) - before;
            }
        }
    }

    /// The winding that all rows share; `None` where they differ.
    #[inline]
    pub(in crate::raster) fn even(&self) -> Option<i32> {
        (self.uneven == 0).then_some(self.steps[0])
    }

    /// The winding of the first row.
    #[inline]
    pub(in crate::raster) fn of_first(&self) -> i32 {
        self.steps[0]
    }

    /// Puts the rows that are wound around otherwise than the one above into `changes`, each with how much more.
    pub(in crate::raster) fn changes(&self, changes: &mut Vec<(i32, i32)>) {
        /// Most rows are as the one above: these are skipped together.
        const TOGETHER: usize = 16;
        changes.clear();
        if self.uneven == 0 {
            return;
        }
        let (_, [steps @ .., _]) = self.steps.split_at(1) else {
            return;
        };
        for (steps, first) in steps.chunks(TOGETHER).zip((1..).step_by(TOGETHER)) {
            if steps.iter().fold(0, |all, step| all | step) != 0 {
                let changed = (first..).zip(steps).filter(|(_, step)| **step != 0);
                changes.extend(changed.map(|(row, step)| (row, *step)));
            }
        }
    }

    /// Puts the windings of all rows, and one more, into `rows`.
    pub(in crate::raster) fn of_rows(&self, rows: &mut Vec<i32>) {
        rows.clear();
        rows.extend(self.steps.iter().scan(0, |winding, step| {
            *winding += step;
            Some(*winding)
        }));
    }

    /// Takes back what was added; `rows` are those of every edge.
    #[inline]
    pub(in crate::raster) fn forget(&mut self, rows: impl Iterator<Item = Span>) {
        for rows in rows {
            self.steps[to_index(rows.start)] = 0;
            self.steps[to_index(rows.end)] = 0;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn windings_are_those_of_a_counter_per_row() {
        let mut windings = RowWindings::default();
        arbtest::arbtest(|u| {
            let count: i32 = u.int_in_range(1..=40)?;
            let mut rows = vec![0; usize::try_from(count).expect("a few")];
            let mut added = Vec::new();
            windings.begin(count);
            assert_eq!(windings.even(), Some(0), "nothing yet");
            for _ in 0..u.int_in_range(0..=9)? {
                let start = u.int_in_range(0..=count - 1)?;
                let end = u.int_in_range(start + 1..=count)?;
                let winding = *u.choose(&[-1, 1])?;
                windings.add(Span { start, end }, winding);
                added.push(Span { start, end });
                for row in &mut rows[usize::try_from(start).expect("a row")..usize::try_from(end).expect("a row")] {
                    *row += winding;
                }
                let even = rows.iter().all(|row| *row == rows[0]).then_some(rows[0]);
                assert_eq!(windings.even(), even, "{rows:?}");
                let mut found = Vec::new();
                windings.of_rows(&mut found);
                assert_eq!(found[..rows.len()], rows, "row by row");
                let mut changes = Vec::new();
                windings.changes(&mut changes);
                let expected: Vec<(i32, i32)> = (1..)
                    .zip(rows.windows(2))
                    .map(|(row, pair)| (row, pair[1] - pair[0]))
                    .filter(|(_, change)| *change != 0)
                    .collect();
                assert_eq!(
                    (windings.of_first(), changes),
                    (rows[0], expected),
                    "changes of {rows:?}"
                );
            }
            windings.forget(added.into_iter());
            Ok(())
        })
        .budget_ms(100);
    }
}
