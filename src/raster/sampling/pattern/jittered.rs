//! One point anywhere in each of `n x n` cells (Cook, "Stochastic sampling in computer graphics", ACM Transactions on Graphics
//! 5, 1986).

use std::sync::Arc;

use super::arrange::{Arrange, Place, Position};
use super::cells::{anywhere, cells};
use super::random_bits::{hash, low_quarter};
use crate::raster::sampling::rate::SampleRate;

/// Row by row.
pub(super) struct Jittered;

/// The cells of two samples at a time, since 64 random bits are enough for both: columns and rows in the order in which bits
/// are taken, where each begins and how long it is.
#[derive(Debug)]
struct Pairs {
    count: usize,
    cells: Vec<[[u16; 2]; 4]>,
}

impl Arrange for Jittered {
    fn prepare(&self, rate: SampleRate) -> Arc<dyn Place> {
        let cells = cells(rate.side());
        let narrow = |cell: [u32; 2]| cell.map(|at| u16::try_from(at).unwrap_or(u16::MAX));
        let all: Vec<[[u16; 2]; 2]> = cells
            .iter()
            .flat_map(|row| cells.iter().map(|column| [narrow(*column), narrow(*row)]))
            .collect();
        let pair = |pair: &[[[u16; 2]; 2]]| {
            let [first, second] = [pair[0], pair[pair.len() - 1]];
            [first[0], first[1], second[0], second[1]]
        };
        Arc::new(Pairs {
            count: all.len(),
            cells: all.chunks(2).map(pair).collect(),
        })
    }
}

impl Place for Pairs {
    fn place(&self, random: u64, places: &mut Vec<Position>) {
        let first = places.len();
        for (number, cells) in (0..).zip(&self.cells) {
            let random = hash(random, number);
            // Written out: `map` may stay a call here, which takes longer than what it does.
            let at = |i: usize| {
                let [start, length] = cells[i];
                anywhere([start.into(), length.into()], low_quarter(random >> (16 * i)))
            };
            places.extend_from_slice(&[[at(0), at(1)], [at(2), at(3)]]);
        }
        places.truncate(first + self.count);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn jitter_two_by_two_is_that_of_one_sample_after_the_other() {
        arbtest::arbtest(|u| {
            let side = u.int_in_range(1..=16)?;
            let rate = SampleRate::new(side * side).expect("a rate");
            let pixel: u64 = u.arbitrary()?;
            let mut found = Vec::new();
            Jittered.prepare(rate).place(pixel, &mut found);
            let cells = cells(side);
            let one = |sample: u32| {
                let random = hash(pixel, u64::from(sample / 2)) >> (sample % 2 * 32);
                let [column, row] = [sample % side, sample / side].map(|at| cells[at as usize]);
                [
                    anywhere(column, low_quarter(random)),
                    anywhere(row, low_quarter(random >> 16)),
                ]
            };
            let expected: Vec<Position> = (0..side * side).map(one).collect();
            assert_eq!(found, expected, "{side} x {side}");
            Ok(())
        })
        .budget_ms(200);
    }
}
