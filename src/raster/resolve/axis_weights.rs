//! A filter on a lattice: what each column of samples around a pixel weighs, or each row, in whole numbers.
//!
//! ```text
//!      one pixel beside    the pixel         one beside        4 x 4 samples, margin 1
//!    |  .  .  :  :  |  |  |  |  |  |  |  :  :  .  .  |
//! ```
//!
//! A sample weighs the product of its column's and its row's weight. These are rounded to parts of [`AxisWeights::ONE`], once;
//! sums of whole numbers do not depend on their order, so that a frame's threads and tiles, and the explanation of a pixel, find
//! the same bytes. What the weights of all samples add up to is the 1 by which their sum is divided, so that they are one
//! together exactly.

use crate::raster::resolve::SizedFilter;

/// What columns or rows of samples weigh.
#[derive(Clone, Debug)]
pub(crate) struct AxisWeights {
    /// Pixels on each side of the middle one that weigh anything.
    margin: i32,
    /// Columns in a pixel.
    side: i32,
    /// Those of the leftmost pixel first.
    weights: Vec<i32>,
}

impl AxisWeights {
    /// About what a column weighs in the middle: fine enough that rounding is far below a level of a byte, and so coarse that
    /// the sum of 256 samples in each of so many pixels is a whole number that 64-bit floats hold, which is tested.
    pub(crate) const ONE: f64 = 8192.0;

    /// Where a pixel has columns of samples in `side` places.
    pub(crate) fn new(filter: SizedFilter, side: i32) -> Self {
        let margin = filter.margin().cast_signed();
        let columns = (2 * margin + 1) * side;
        let middle = f64::from(columns) / 2.0;
        // A stretched filter is as much lower, so that the sums stay as they are.
        let one = Self::ONE / filter.stretch();
        let weight = |column: i32| {
            let distance = (f64::from(column) + 0.5 - middle).abs() / f64::from(side);
            to_whole(filter.weight(distance) * one)
        };
        Self {
            margin,
            side,
            weights: (0..columns).map(weight).collect(),
        }
    }

    /// Pixels on each side of the middle one that weigh anything.
    pub(crate) fn margin(&self) -> i32 {
        self.margin
    }

    /// What the weights of all samples add up to without their signs, in parts of what they do with these; `None` where that is too
    /// little to mean anything.
    pub(crate) fn unsigned(&self) -> Option<f64> {
        let sum: i64 = self.weights.iter().map(|weight| i64::from(*weight)).sum();
        let unsigned: i64 = self.weights.iter().map(|weight| i64::from(weight.abs())).sum();
        let parts = (unsigned as f64 / sum as f64).powi(2);
        (sum > 0 && parts < 8.0).then_some(parts)
    }

    /// What the columns of the pixel weigh that lies so many beside the middle one.
    #[inline]
    pub(crate) fn of_pixel(&self, beside: i32) -> &[i32] {
        let first = (beside + self.margin) * self.side;
        &self.weights[first.cast_unsigned() as usize..][..self.side.cast_unsigned() as usize]
    }

    /// What the samples of a pixel weigh that lies so many columns and rows beside the middle one, by their columns and rows in
    /// it.
    pub(crate) fn of_samples<'s>(
        &'s self,
        [right, below]: [i32; 2],
        places: &'s [[u8; 2]],
    ) -> impl Iterator<Item = i64> + 's {
        let (columns, rows) = (self.of_pixel(right), self.of_pixel(below));
        places
            .iter()
            .map(|[x, y]| i64::from(columns[usize::from(*x)]) * i64::from(rows[usize::from(*y)]))
    }
}

/// To nearest.
#[expect(clippy::cast_possible_truncation, reason = "a weight is about one at most")]
fn to_whole(weight: f64) -> i32 {
    weight.round() as i32
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::raster::resolve::{FilterRadius, ResolveFilter};

    fn all() -> impl Iterator<Item = SizedFilter> {
        let radii = [None, Some(0.5), Some(1.25), Some(FilterRadius::MAX)];
        ResolveFilter::ALL
            .into_iter()
            .flat_map(move |filter| radii.map(|radius| filter.sized(radius.and_then(FilterRadius::new))))
    }

    #[test]
    fn weights_are_those_of_the_filter_and_nothing_beyond_the_radius() {
        for filter in all() {
            for side in [1, 2, 3, 16, 256] {
                let weights = AxisWeights::new(filter, side);
                let margin = weights.margin();
                for beside in -margin..=margin {
                    let mirrored: Vec<i32> = weights.of_pixel(-beside).iter().rev().copied().collect();
                    assert_eq!(weights.of_pixel(beside), mirrored, "{filter:?} is even");
                    for (column, weight) in (0..).zip(weights.of_pixel(beside)) {
                        let at = f64::from(beside) - 0.5 + (f64::from(column) + 0.5) / f64::from(side);
                        let exact = filter.weight(at.abs()) * AxisWeights::ONE / filter.stretch();
                        assert!((f64::from(*weight) - exact).abs() <= 0.5, "{filter:?} at {at}");
                        assert!(at.abs() < filter.radius || *weight == 0, "{filter:?} ends before {at}");
                    }
                }
            }
        }
    }

    #[test]
    fn sums_of_stored_values_fit_the_whole_numbers_of_64_bit_floats() {
        for filter in all() {
            let weights = AxisWeights::new(filter, 16);
            let all: f64 = weights.weights.iter().map(|weight| f64::from(weight.abs())).sum();
            assert!(all * all * 65_280.0 < (1_u64 << 53) as f64, "{filter:?}: {all}");
            // Light has 24 bits, and alpha 16.
            assert!(all * all * f64::from(1 << 24) < i64::MAX as f64, "{filter:?}: {all}");
        }
    }

    #[test]
    fn more_columns_come_nearer_to_the_integral() {
        use std::f64::consts::PI;
        // By the formulas of the papers; of the sines by the sine integral, of the bell by the error function.
        let (bell, erf_of_3) = (0.5 * (2.0 * PI).sqrt(), 0.997_300_203_936_740);
        let closed = [
            (ResolveFilter::Box, 1.0),
            (ResolveFilter::Tent, 1.0),
            (ResolveFilter::Gaussian, bell * erf_of_3 - 3.0 * (-4.5_f64).exp()),
            (ResolveFilter::BSpline, 1.0),
            (ResolveFilter::CatmullRom, 1.0),
            (ResolveFilter::Mitchell, 1.0),
            (ResolveFilter::Lanczos2, 1.009_79),
            (ResolveFilter::Lanczos3, 0.997_06),
            (ResolveFilter::BlackmanHarris, 0.35875 * 3.0),
        ];
        assert_eq!(closed.map(|(filter, _)| filter), ResolveFilter::ALL, "each of them");
        for (filter, integral) in closed {
            for radius in [None, FilterRadius::new(2.5)] {
                let weights = AxisWeights::new(filter.sized(radius), 256);
                let sum: f64 = weights.weights.iter().map(|weight| f64::from(*weight)).sum();
                let found = sum / 256.0 / AxisWeights::ONE;
                assert!(
                    (found - integral).abs() < 2e-3,
                    "{filter:?} {radius:?}: {found} for {integral}"
                );
            }
        }
    }
}
