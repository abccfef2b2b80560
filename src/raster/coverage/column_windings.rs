//! The crossings of one row, sorted by counting: what those of each column add to the winding number.
//!
//! A long measured series that is stroked crosses each row some thousand times, in no order. Then most columns are crossed,
//! several times each, and to count per column is several times as fast as to compare.

use crate::raster::span::to_index;

/// What the crossings of each column add, reusing its memory.
#[derive(Debug, Default)]
pub(crate) struct ColumnWindings {
    /// One number per column; all zero between rows.
    added: Vec<i32>,
    /// One bit per column that is crossed.
    crossed: Vec<u64>,
}

/// The column of a crossing, and what it adds to the winding number. A crossing is the column, doubled, and one more where
/// the edge runs downwards.
#[inline]
pub(crate) fn step(crossing: i32) -> (i32, i32) {
    (crossing >> 1, (crossing & 1) * 2 - 1)
}

impl ColumnWindings {
    /// Whether so many crossings of a row with columns `0..=end` are sorted faster here than by comparing them.
    pub(crate) fn suit(crossings: usize, end: i32) -> bool {
        crossings >= to_index(end) / 32
    }

    /// Adds the crossings of one row, at columns `0..=end`.
    pub(crate) fn add(&mut self, crossings: &[i32], end: i32) {
        let columns = to_index(end) + 1;
        if self.added.len() < columns {
            self.added.resize(columns, 0);
            self.crossed.resize(columns.div_ceil(64), 0);
        }
        for crossing in crossings {
            let (column, around) = step(*crossing);
            let column = to_index(column);
            self.added[column] += around;
            self.crossed[column / 64] |= 1 << (column % 64);
        }
    }

    /// The columns from left to right, each with what it adds; they are forgotten.
    pub(crate) fn take(&mut self) -> impl Iterator<Item = (i32, i32)> {
        let added = &mut self.added;
        (0..)
            .zip(&mut self.crossed)
            .flat_map(move |(word, crossed)| {
                let mut bits = std::mem::take(crossed);
                std::iter::from_fn(move || {
                    let bit = bits.trailing_zeros();
                    bits &= bits.checked_sub(1)?;
                    Some((word, bit))
                })
            })
            .map(move |(word, bit): (i32, u32)| {
                let column = word * 64 + bit.cast_signed();
                (column, std::mem::take(&mut added[to_index(column)]))
            })
    }
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeMap;

    use super::*;

    #[test]
    fn columns_are_those_of_sorted_crossings() {
        let mut columns = ColumnWindings::default();
        arbtest::arbtest(|u| {
            let end = u.int_in_range(1..=300)?;
            let mut crossings = Vec::new();
            for _ in 0..u.int_in_range(0..=200)? {
                crossings.push(u.int_in_range(0..=end)? << 1 | u.int_in_range(0..=1)?);
            }
            let mut expected = BTreeMap::new();
            for (column, around) in crossings.iter().map(|crossing| step(*crossing)) {
                *expected.entry(column).or_insert(0) += around;
            }
            columns.add(&crossings, end);
            let found: Vec<_> = columns.take().collect();
            assert_eq!(
                found,
                expected.into_iter().collect::<Vec<_>>(),
                "{crossings:?} up to {end}"
            );
            Ok(())
        })
        .budget_ms(200);
    }
}
