//! Edges walked row by row, exactly: which sample columns lie right of an edge, without a single rounding.
//!
//! In each sample row an edge is crossed at a rational x. Its first column at or after that point is kept as quotient
//! and remainder and stepped from row to row as in Bresenham's line algorithm (IBM Systems Journal 4, 1965), so two
//! triangles that share an edge compute the very same columns, and each sample between them belongs to one.

use super::subpixel::{GridPoint, SubpixelGrid};
use crate::rules::Rules;

/// The columns at which one edge crosses successive sample rows.
#[derive(Clone, Copy, Debug)]
pub struct EdgeWalker {
    /// The crossing in sample columns, rounded up; and by how much that was, `0..divisor`.
    column: i32,
    excess: i64,
    /// What a row down adds: whole columns, and what is to be taken from the excess.
    column_step: i32,
    excess_step: i64,
    divisor: i64,
}

/// Four successive sample rows of an edge, stepped together: one vector of numbers on machines that have them.
#[derive(Clone, Copy, Debug)]
pub struct FourRows {
    columns: [i32; 4],
    excesses: [i64; 4],
    /// What four rows down add.
    column_step: i32,
    excess_step: i64,
    divisor: i64,
}

impl FourRows {
    /// The first sample columns at or right of the edge in these rows.
    #[inline(always)]
    #[expect(clippy::inline_always, reason = "vector instructions reach inlined code only")]
    pub fn at_or_after(&self) -> [i32; 4] {
        self.columns
    }

    /// Goes down four sample rows; as [`EdgeWalker::step`].
    #[inline(always)]
    #[expect(clippy::inline_always, reason = "vector instructions reach inlined code only")]
    pub fn step(&mut self) {
        for (column, excess) in self.columns.iter_mut().zip(&mut self.excesses) {
            let rest = *excess - self.excess_step;
            let borrow = rest >> 63;
            *excess = rest + (self.divisor & borrow);
            *column = column.wrapping_add(self.column_step).wrapping_sub(low_half(borrow));
        }
    }
}

impl EdgeWalker {
    /// This row and the three below it.
    #[inline(always)]
    #[expect(clippy::inline_always, reason = "vector instructions reach inlined code only")]
    pub fn four_rows(&self) -> FourRows {
        let (mut columns, mut excesses, mut row) = ([0; 4], [0; 4], *self);
        for (column, excess) in columns.iter_mut().zip(&mut excesses) {
            (*column, *excess) = (row.column, row.excess);
            row.step();
        }
        // Four times a part of the divisor is less than four of it.
        let (mut column_step, mut excess_step) = (self.column_step.wrapping_mul(4), 4 * self.excess_step);
        for _ in 0..3 {
            let whole = excess_step >= self.divisor;
            column_step = column_step.wrapping_add(i32::from(whole));
            excess_step -= if whole { self.divisor } else { 0 };
        }
        FourRows {
            columns,
            excesses,
            column_step,
            excess_step,
            divisor: self.divisor,
        }
    }

    /// Goes to the first of four rows of the same edge.
    #[inline]
    pub fn go_to(&mut self, rows: &FourRows) {
        (self.column, self.excess) = (rows.columns[0], rows.excesses[0]);
    }

    /// The edge from `top` to `bottom` (`top.y < bottom.y`), standing at sample row `row`.
    ///
    /// Column `i` lies at `(i + 1/2) << bits`, so the crossing `x = x0 + (y - y0) dx / dy` is column
    /// `((x0 - half) dy + (y - y0) dx) / (dy << bits)`.
    pub fn new(grid: SubpixelGrid, top: GridPoint, bottom: GridPoint, row: i32) -> Self {
        let bits = grid.bits();
        let half = 1_i64 << (bits - 1);
        let dx = i64::from(bottom.x) - i64::from(top.x);
        let dy = i64::from(bottom.y) - i64::from(top.y);
        debug_assert!(dy > 0, "an edge runs downwards");
        let down = i64::from(grid.sample_coordinate(row)) - i64::from(top.y);
        let numerator = (i64::from(top.x) - half) * dy + down * dx;
        let divisor = dy << bits;
        let (column, remainder) = floor_division(numerator, divisor);
        let rounded_up = i64::from(remainder > 0);
        let (column_step, remainder_step) = floor_division(dx, dy);
        Self {
            column: low_half(column + rounded_up),
            excess: divisor * rounded_up - remainder,
            column_step: low_half(column_step),
            excess_step: remainder_step << bits,
            divisor,
        }
    }

    /// The first sample column at or right of the edge in this row.
    #[inline]
    pub fn at_or_after(&self) -> i32 {
        self.column
    }

    /// The first sample column strictly right of the edge in this row.
    #[inline]
    pub fn after(&self) -> i32 {
        self.column + i32::from(self.excess == 0)
    }

    /// Goes down one sample row.
    #[inline]
    pub fn step(&mut self) {
        // Beyond the end of the edge, where nobody looks any more, the column may wrap.
        let excess = self.excess - self.excess_step;
        // All ones where it fell below zero, which no branch can foresee.
        let borrow = excess >> 63;
        self.excess = excess + (self.divisor & borrow);
        self.column = self
            .column
            .wrapping_add(self.column_step)
            .wrapping_sub(low_half(borrow));
    }
}

/// A column of an edge within the guard band, which fits 32 bits: its ends do.
#[inline]
#[expect(clippy::cast_possible_truncation, reason = "what fits is kept")]
fn low_half(column: i64) -> i32 {
    column as i32
}

/// Quotient and remainder, rounded down, by a divisor above zero; one division for both.
#[inline]
fn floor_division(numerator: i64, divisor: i64) -> (i64, i64) {
    let (quotient, remainder) = (numerator / divisor, numerator % divisor);
    if remainder < 0 {
        (quotient - 1, remainder + divisor)
    } else {
        (quotient, remainder)
    }
}

/// Twice the signed area of a triangle in square units; above zero when it runs clockwise on the screen.
pub fn doubled_area([a, b, c]: [GridPoint; 3]) -> i64 {
    edge_value(a, b, c)
}

/// The edge function of `a -> b` at `point` (Pineda, "A parallel algorithm for polygon rasterization", 1988): above
/// zero to the right of the edge on the screen, zero on its line.
#[inline]
pub fn edge_value(a: GridPoint, b: GridPoint, point: GridPoint) -> i64 {
    let (abx, aby) = (i64::from(b.x) - i64::from(a.x), i64::from(b.y) - i64::from(a.y));
    let (apx, apy) = (i64::from(point.x) - i64::from(a.x), i64::from(point.y) - i64::from(a.y));
    abx * apy - aby * apx
}

/// What the top-left rule says of a triangle's edge: who owns the samples on its line.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum EdgeKind {
    /// Level, with the triangle below it: its samples belong to the triangle.
    Top,
    /// With the triangle on its right: its samples belong to the triangle.
    Left,
    /// A right or bottom edge: its samples belong to the neighbour.
    Other,
}

impl EdgeKind {
    /// Of an edge of a shape whose edges run clockwise on the screen: there a top edge runs right and a left edge runs up.
    #[inline]
    pub fn clockwise(from: GridPoint, to: GridPoint) -> Self {
        if to.y < from.y {
            Self::Left
        } else if to.y == from.y && to.x > from.x {
            Self::Top
        } else {
            Self::Other
        }
    }

    /// Whether the samples on its line belong to the triangle. By the course's rules every edge owns its line.
    #[inline]
    pub fn owns_line(self, rules: Rules) -> bool {
        rules == Rules::Course || self != Self::Other
    }
}

/// The edge function of a triangle's edge, in steps from sample to sample: below zero at the samples outside.
///
/// At samples the edge function is `e + column * right + row * down`, whose steps are multiples of the distance of two
/// samples, `1 << bits`. Whether such a sum is below zero does not change when everything is divided by that distance and
/// `e` rounded down. An edge that does not own its line first loses one unit.
#[derive(Clone, Copy, Debug)]
pub struct SampleEdge {
    /// At the first sample.
    pub value: i64,
    /// What it gains one sample to the right.
    pub right: i32,
    /// What it gains one sample down.
    pub down: i32,
}

impl SampleEdge {
    /// The edges of a triangle whose [`doubled_area`] is `area`, at the sample `first`.
    #[inline]
    pub fn of_triangle(
        [a, b, c]: [GridPoint; 3],
        area: i64,
        first: GridPoint,
        grid: SubpixelGrid,
        rules: Rules,
    ) -> [Self; 3] {
        let [b, c] = if area < 0 { [c, b] } else { [b, c] };
        [(a, b), (b, c), (c, a)].map(|(from, to)| {
            let owns_line = EdgeKind::clockwise(from, to).owns_line(rules);
            Self {
                value: (edge_value(from, to, first) - i64::from(!owns_line)) >> grid.bits(),
                right: from.y - to.y,
                down: to.x - from.x,
            }
        })
    }
}

/// One edge of a triangle tested at one point.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct EdgeTest {
    /// The edge function in square units of the grid: above zero on the triangle's side, zero on the edge's line.
    pub value: i64,
    /// Who owns the points on the line.
    pub kind: EdgeKind,
}

impl EdgeTest {
    /// The edges from the first corner to the second, from the second to the third and from the third to the first, at
    /// `point`; the triangle may have either winding.
    pub fn of_triangle(corners: [GridPoint; 3], point: GridPoint) -> [Self; 3] {
        let clockwise = doubled_area(corners) >= 0;
        [0, 1, 2].map(|i| {
            let (from, to) = (corners[i], corners[(i + 1) % 3]);
            let (from, to) = if clockwise { (from, to) } else { (to, from) };
            Self::clockwise(from, to, point)
        })
    }

    /// An edge of a shape whose edges run clockwise on the screen.
    pub fn clockwise(from: GridPoint, to: GridPoint, point: GridPoint) -> Self {
        Self {
            value: edge_value(from, to, point),
            kind: EdgeKind::clockwise(from, to),
        }
    }

    /// Whether the point lies on the triangle's side of the edge, or on its line and belongs to the triangle. By the
    /// course's rules every edge owns its line.
    pub fn is_inside(self, rules: Rules) -> bool {
        self.value > 0 || self.value == 0 && self.kind.owns_line(rules)
    }
}

#[cfg(test)]
mod tests {
    use arbtest::arbitrary;

    use super::*;

    #[test]
    fn walker_agrees_with_the_edge_function_in_every_row() {
        let grid = SubpixelGrid::new(4);
        arbtest::arbtest(|u| {
            let mut coordinate = || -> arbitrary::Result<i32> { Ok(u.int_in_range(-64..=64)? << (grid.bits() - 1)) };
            let (a, b) = (
                GridPoint {
                    x: coordinate()?,
                    y: coordinate()?,
                },
                GridPoint {
                    x: coordinate()?,
                    y: coordinate()?,
                },
            );
            if a.y == b.y {
                return Ok(());
            }
            let (top, bottom) = if a.y < b.y { (a, b) } else { (b, a) };
            let first = grid.sample_at_or_after(top.y);
            let mut walker = EdgeWalker::new(grid, top, bottom, first);
            for row in first..grid.sample_at_or_after(bottom.y) {
                let y = grid.sample_coordinate(row);
                let value = |column: i32| {
                    let x = grid.sample_coordinate(column);
                    edge_value(top, bottom, GridPoint { x, y })
                };
                // Downwards, the right of the edge on the screen is where the edge function is negative.
                let (at, after) = (walker.at_or_after(), walker.after());
                assert!(
                    value(at) <= 0 && value(at - 1) > 0,
                    "first column at or after the edge in row {row}"
                );
                assert!(
                    value(after) < 0 && value(after - 1) >= 0,
                    "first column after the edge in row {row}"
                );
                let (mut four, mut below) = (walker.four_rows(), walker);
                for _ in 0..2 {
                    let mut far = below;
                    far.go_to(&four);
                    assert_eq!(far.excess, below.excess, "the first of four rows from {row} on");
                    for column in four.at_or_after() {
                        assert_eq!(column, below.at_or_after(), "four rows at once from row {row} on");
                        below.step();
                    }
                    four.step();
                }
                walker.step();
            }
            Ok(())
        })
        .budget_ms(300);
    }
}
