//! A triangle as one span of sample columns per sample row: its exact coverage.
//!
//! The top-left rule in this form: a row belongs to the triangle from the first sample at or below its top up to, but
//! not including, its bottom; a column from the first sample at or right of its left edge up to, but not including,
//! its right edge. Under the course's rules both ends are included.

use crate::geometry::edge::{EdgeWalker, doubled_area};
use crate::geometry::subpixel::{GridPoint, SubpixelGrid};
use crate::raster::span::{Span, end_of};
use crate::rules::Rules;

/// A triangle whose corners are sorted from top to bottom.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SortedTriangle {
    corners: [GridPoint; 3],
    /// The edge from top to bottom corner is the right one.
    long_is_right: bool,
    rules: Rules,
}

/// Walks a triangle's sample rows from top to bottom.
#[derive(Clone, Debug)]
pub(crate) struct RowWalker {
    left: EdgeWalker,
    right: EdgeWalker,
    /// The short edge that takes over at `switch`, and that row.
    lower: [GridPoint; 2],
    switch: i32,
    row: i32,
    grid: SubpixelGrid,
    long_is_right: bool,
    rules: Rules,
}

impl SortedTriangle {
    /// `None` when the triangle has no area: then it draws nothing.
    pub(crate) fn new(mut corners: [GridPoint; 3], rules: Rules) -> Option<Self> {
        if corners[0].y > corners[1].y {
            corners.swap(0, 1);
        }
        if corners[1].y > corners[2].y {
            corners.swap(1, 2);
        }
        if corners[0].y > corners[1].y {
            corners.swap(0, 1);
        }
        let area = doubled_area(corners);
        // Clockwise on the screen from the top corner: the middle corner lies left of the long edge when negative.
        (area != 0).then_some(Self {
            corners,
            long_is_right: area < 0,
            rules,
        })
    }

    /// The sample rows it may cover.
    pub(crate) fn rows(&self, grid: SubpixelGrid) -> Span {
        let [top, _, bottom] = self.corners;
        Span {
            start: grid.sample_at_or_after(top.y),
            end: end_of(grid, bottom.y, self.rules),
        }
    }

    /// A walker that stands at sample row `row`, which must be one of [`SortedTriangle::rows`].
    #[inline(always)]
    #[expect(clippy::inline_always, reason = "the walker is too large to be moved")]
    pub(crate) fn walk_from(&self, grid: SubpixelGrid, row: i32) -> RowWalker {
        let [top, middle, bottom] = self.corners;
        let switch = if middle.y == bottom.y {
            i32::MAX
        } else {
            grid.sample_at_or_after(middle.y)
        };
        let upper = if row >= switch || top.y == middle.y {
            [middle, bottom]
        } else {
            [top, middle]
        };
        let long = EdgeWalker::new(grid, top, bottom, row);
        let short = EdgeWalker::new(grid, upper[0], upper[1], row);
        let (left, right) = if self.long_is_right {
            (short, long)
        } else {
            (long, short)
        };
        RowWalker {
            left,
            right,
            lower: [middle, bottom],
            switch: if row >= switch { i32::MAX } else { switch },
            row,
            grid,
            long_is_right: self.long_is_right,
            rules: self.rules,
        }
    }
}

impl RowWalker {
    /// The covered columns of as many rows as there is room in `spans`, within a frame or beyond; then stands below them.
    /// `by_four` says that they are found by four rows at once, which pays where there are many.
    #[inline(always)]
    #[expect(clippy::inline_always, reason = "vector instructions reach inlined code only")]
    pub(crate) fn next_spans(&mut self, spans: &mut [Span], by_four: bool) {
        if self.rules == Rules::Course {
            for span in spans {
                *span = self.next_span(Span::EVERYTHING);
            }
            return;
        }
        let end = self.row + i32::try_from(spans.len()).unwrap_or(i32::MAX);
        let mut rest = spans;
        if (self.row..end).contains(&self.switch) {
            let (above, below) = rest.split_at_mut((self.switch - self.row).cast_unsigned() as usize);
            self.run(above, by_four);
            self.take_lower_edge();
            rest = below;
        }
        self.run(rest, by_four);
    }

    /// As [`RowWalker::next_spans`] where no edge takes over.
    #[inline(always)]
    #[expect(clippy::inline_always, reason = "vector instructions reach inlined code only")]
    fn run(&mut self, spans: &mut [Span], by_four: bool) {
        let (fours, rest) = if by_four {
            spans.as_chunks_mut::<4>()
        } else {
            (&mut [][..], &mut *spans)
        };
        if !fours.is_empty() {
            let (mut left, mut right) = (self.left.four_rows(), self.right.four_rows());
            for four in fours {
                let (starts, ends) = (left.at_or_after(), right.at_or_after());
                for (i, span) in four.iter_mut().enumerate() {
                    *span = Span {
                        start: starts[i],
                        end: ends[i],
                    };
                }
                left.step();
                right.step();
            }
            self.left.go_to(&left);
            self.right.go_to(&right);
        }
        let (mut left, mut right) = (self.left, self.right);
        for span in rest {
            *span = Span {
                start: left.at_or_after(),
                end: right.at_or_after(),
            };
            left.step();
            right.step();
        }
        (self.left, self.right) = (left, right);
        self.row += i32::try_from(spans.len()).unwrap_or(i32::MAX);
    }

    /// The covered columns of the current row, clipped to `columns`; then goes down one row.
    #[inline]
    pub(crate) fn next_span(&mut self, columns: Span) -> Span {
        if self.row == self.switch {
            self.take_lower_edge();
        }
        let end = match self.rules {
            Rules::Standard | Rules::Float => self.right.at_or_after(),
            Rules::Course => self.right.after(),
        };
        let span = Span {
            start: self.left.at_or_after().max(columns.start),
            end: end.min(columns.end),
        };
        self.left.step();
        self.right.step();
        self.row += 1;
        span
    }

    #[cold]
    fn take_lower_edge(&mut self) {
        let lower = EdgeWalker::new(self.grid, self.lower[0], self.lower[1], self.row);
        if self.long_is_right {
            self.left = lower;
        } else {
            self.right = lower;
        }
    }
}

#[cfg(test)]
mod tests {
    use arbtest::arbitrary;

    use super::*;
    use crate::geometry::edge::EdgeTest;

    /// Coverage by definition: Pineda's edge functions, ties by the kind of edge.
    fn covers(corners: [GridPoint; 3], sample: GridPoint, rules: Rules) -> bool {
        let tests = EdgeTest::of_triangle(corners, sample);
        doubled_area(corners) != 0 && tests.iter().all(|test| test.is_inside(rules))
    }

    #[test]
    fn rows_agree_with_edge_functions_on_a_lattice_full_of_ties() {
        arbtest::arbtest(|u| {
            let grid = SubpixelGrid::new(u.int_in_range(1..=5)?);
            let mut point = || -> arbitrary::Result<GridPoint> {
                let mut half_samples = || Ok(u.int_in_range(-2..=18)? << (grid.bits() - 1));
                Ok(GridPoint {
                    x: half_samples()?,
                    y: half_samples()?,
                })
            };
            let corners = [point()?, point()?, point()?];
            for rules in Rules::ALL {
                let triangle = SortedTriangle::new(corners, rules);
                let rows = triangle.map_or(Span::EMPTY, |triangle| triangle.rows(grid));
                let all = Span { start: -2, end: 12 };
                for (start, by_four) in [(rows.start, true), ((rows.start + 2).min(rows.end), false)] {
                    let mut walker = triangle.filter(|_| !rows.is_empty()).map(|t| t.walk_from(grid, start));
                    let mut at_once = vec![Span::EMPTY; (rows.end - start).max(0).unsigned_abs() as usize];
                    if let Some(mut walker) = walker.clone() {
                        let third = at_once.len() / 3;
                        let (first, second) = at_once.split_at_mut(third);
                        walker.next_spans(first, by_four);
                        walker.next_spans(second, by_four);
                    }
                    for row in start.max(-2)..12 {
                        let inside = row < rows.end && row >= start;
                        let span = walker
                            .as_mut()
                            .filter(|_| inside)
                            .map(|w| w.next_span(all))
                            .unwrap_or_default();
                        if walker.is_some() && inside {
                            let at_once = at_once[(row - start).unsigned_abs() as usize].intersection(all);
                            assert!(at_once == span || at_once.is_empty() && span.is_empty(), "row {row}");
                        }
                        for column in all.start..all.end {
                            let sample = GridPoint {
                                x: grid.sample_coordinate(column),
                                y: grid.sample_coordinate(row),
                            };
                            let expected = covers(corners, sample, rules);
                            let found = (span.start..span.end).contains(&column);
                            assert_eq!(found, expected, "{corners:?} {rules:?} column {column} row {row}");
                        }
                    }
                }
            }
            Ok(())
        })
        .budget_ms(600);
    }
}
