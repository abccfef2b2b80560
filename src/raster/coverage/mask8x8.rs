//! The coverage of a triangle smaller than a few samples, as a bit for each: no walkers, no division, no loop over rows.
//!
//! Three additions of small numbers decide a sample, exactly: see [`SampleEdge`] (Pineda, "A parallel algorithm for
//! polygon rasterization", 1988).

use crate::geometry::edge::{SampleEdge, doubled_area};
use crate::geometry::subpixel::{GridPoint, SubpixelGrid};
use crate::raster::span::{SMALL, Span, SpanRect};
use crate::rules::Rules;

/// The samples that a small triangle covers, or any other few samples or pixels.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct CoverageMask {
    /// Sample column and row of the lowest bit.
    pub(crate) column: i32,
    pub(crate) row: i32,
    /// Bit `8 j + i` stands for the sample `i` columns to the right and `j` rows down; none are set where the triangle
    /// covers nothing.
    pub(crate) mask: u64,
}

/// A [`SampleEdge`] whose values fit 32 bits.
#[derive(Clone, Copy, Default)]
struct SmallEdge {
    /// At the first sample.
    value: i32,
    /// What it gains one sample to the right, and down.
    right: i32,
    down: i32,
}

impl CoverageMask {
    /// What a triangle covers whose box is `samples`, which must be small.
    #[inline]
    pub(crate) fn new(corners: [GridPoint; 3], samples: SpanRect, grid: SubpixelGrid, rules: Rules) -> Self {
        let (column, row) = (samples.x.start, samples.y.start);
        let mut coverage = Self { column, row, mask: 0 };
        if samples.is_empty() {
            return coverage;
        }
        let area = doubled_area(corners);
        if area == 0 {
            return coverage;
        }
        let first = GridPoint {
            x: grid.sample_coordinate(column),
            y: grid.sample_coordinate(row),
        };
        let edges = SampleEdge::of_triangle(corners, area, first, grid, rules).map(SmallEdge::new);
        let wide = samples.x.end - column > 4;
        for j in 0..samples.y.end - row {
            let mut bits = group_of_four(&edges, 0, j);
            if wide {
                bits |= group_of_four(&edges, 4, j) << 4;
            }
            coverage.mask |= u64::from(bits) << (SMALL * j);
        }
        coverage
    }

    /// The rows from the first to the last that hold a covered sample; the mask must not be zero.
    #[inline]
    pub(crate) fn rows(self) -> Span {
        let bit = |index: u32| self.row + (index / 8).cast_signed();
        Span {
            start: bit(self.mask.trailing_zeros()),
            end: bit(self.mask.ilog2()) + 1,
        }
    }

    /// The columns from the first to the last that hold a covered sample; the mask must not be zero.
    #[inline]
    pub(crate) fn columns(self) -> Span {
        let halves = self.mask | self.mask >> 32;
        let quarters = halves | halves >> 16;
        let [bits, ..] = (quarters | quarters >> 8).to_le_bytes();
        Span {
            start: self.column + bits.trailing_zeros().cast_signed(),
            end: self.column + 8 - bits.leading_zeros().cast_signed(),
        }
    }

    /// The same bits `columns` to the right and `rows` down.
    #[inline]
    pub(crate) fn moved(self, columns: i32, rows: i32) -> Self {
        Self {
            column: self.column + columns,
            row: self.row + rows,
            mask: self.mask,
        }
    }

    /// What of it lies in a rectangle, standing at or after the rectangle's first column and row.
    pub(crate) fn within(self, columns: Span, rows: Span) -> Self {
        let clip = |first: i32, span: Span| {
            let start = (span.start - first).clamp(0, SMALL);
            (start, (span.end - first).clamp(start, SMALL))
        };
        let ((left, right), (top, bottom)) = (clip(self.column, columns), clip(self.row, rows));
        // `bits` ones from bit 0 on; a shift by all 64 would overflow.
        let ones = |bits: i32| if bits == 64 { u64::MAX } else { (1 << bits) - 1 };
        let in_columns = (ones(right) & !ones(left)) * 0x0101_0101_0101_0101;
        let in_rows = ones(SMALL * bottom) & !ones(SMALL * top);
        // Where nothing is left, the shift may be by all bits.
        let shift = (SMALL * top + left).cast_unsigned();
        Self {
            column: self.column + left,
            row: self.row + top,
            mask: (self.mask & in_columns & in_rows).checked_shr(shift).unwrap_or(0),
        }
    }

    /// Calls `visit` with every row that holds a bit and each run of bits side by side in it.
    #[inline]
    pub(crate) fn each_run(self, mut visit: impl FnMut(i32, Span)) {
        let mut bits = self.mask;
        while bits != 0 {
            let first = bits.trailing_zeros();
            let start = (first % 8).cast_signed();
            // A run ends with its row.
            let length = (bits >> first).trailing_ones().cast_signed().min(SMALL - start);
            let column = self.column + start;
            let columns = Span {
                start: column,
                end: column + length,
            };
            visit(self.row + (first / 8).cast_signed(), columns);
            bits &= !(((1 << length) - 1) << first);
        }
    }

    /// The covered columns of one of [`CoverageMask::rows`]: they lie side by side.
    pub(crate) fn span(self, row: i32) -> Span {
        let [bits, ..] = (self.mask >> (SMALL * (row - self.row))).to_le_bytes();
        let start = self.column + bits.trailing_zeros().cast_signed();
        Span {
            start,
            end: start + bits.count_ones().cast_signed(),
        }
    }
}

impl SmallEdge {
    #[inline]
    #[expect(
        clippy::cast_possible_truncation,
        reason = "within nine samples of each other, all corners and samples keep the quotient below 2^22"
    )]
    fn new(edge: SampleEdge) -> Self {
        Self {
            value: edge.value as i32,
            right: edge.right,
            down: edge.down,
        }
    }
}

/// The bits of four samples side by side, from column `i` of row `j` on.
#[inline]
fn group_of_four(edges: &[SmallEdge; 3], i: i32, j: i32) -> u32 {
    let start = edges.map(|edge| edge.value + edge.right * i + edge.down * j);
    let mut inside = 0;
    for i in 0..4 {
        let value = |k: usize| start[k] + edges[k].right * i;
        // The sign is clear where none of the three is below zero.
        let outside = (value(0) | value(1) | value(2)).cast_unsigned() >> 31;
        inside |= (1 - outside) << i;
    }
    inside
}

#[cfg(test)]
mod tests {
    use arbtest::arbitrary::{Result, Unstructured};

    /// The coverage of a triangle whose box holds at most [`SMALL`] columns and rows of samples; `None` for a larger one.
    fn coverage_mask(corners: [GridPoint; 3], grid: SubpixelGrid, rules: Rules) -> Option<CoverageMask> {
        let samples = SpanRect::of_samples(corners, grid, rules);
        samples
            .is_small()
            .then(|| CoverageMask::new(corners, samples, grid, rules))
    }

    use super::*;
    use crate::geometry::subpixel::GUARD;
    use crate::raster::coverage::triangle::SortedTriangle;

    /// The same from the row walker; empty where the triangle covers nothing.
    fn walked(corners: [GridPoint; 3], grid: SubpixelGrid, rules: Rules) -> Vec<(i32, Span)> {
        let everything = Span {
            start: i32::MIN / 2,
            end: i32::MAX / 2,
        };
        let Some(sorted) = SortedTriangle::new(corners, rules) else {
            return Vec::new();
        };
        let rows = sorted.rows(grid);
        if rows.is_empty() {
            return Vec::new();
        }
        let mut walker = sorted.walk_from(grid, rows.start);
        (rows.start..rows.end)
            .map(|row| (row, walker.next_span(everything)))
            .filter(|(_, span)| !span.is_empty())
            .collect()
    }

    fn check(corners: [GridPoint; 3], grid: SubpixelGrid) -> bool {
        for rules in Rules::ALL {
            let Some(found) = coverage_mask(corners, grid, rules) else {
                return false;
            };
            let mut expected = 0_u64;
            let mut spans = Vec::new();
            if found.mask != 0 {
                let rows = found.rows();
                spans.extend((rows.start..rows.end).map(|row| (row, found.span(row))));
            }
            spans.retain(|(_, span)| !span.is_empty());
            assert_eq!(spans, walked(corners, grid, rules), "{corners:?} {rules:?} as spans");
            for (row, span) in walked(corners, grid, rules) {
                for column in span.start..span.end {
                    let (i, j) = (column - found.column, row - found.row);
                    assert!(
                        (0..SMALL).contains(&i) && (0..SMALL).contains(&j),
                        "{corners:?} {rules:?} covers column {column}, row {row} outside its box at {found:?}"
                    );
                    expected |= 1 << (SMALL * j + i);
                }
            }
            assert_eq!(found.mask, expected, "{corners:?} {rules:?} {grid:?}: {found:?}");
        }
        true
    }

    fn corners(u: &mut Unstructured<'_>, center: GridPoint, reach: i32, shift: u32) -> Result<[GridPoint; 3]> {
        let mut near = |center: i32| Ok(center + (u.int_in_range(-reach..=reach)? << shift));
        let mut point = || {
            Ok(GridPoint {
                x: near(center.x)?,
                y: near(center.y)?,
            })
        };
        Ok([point()?, point()?, point()?])
    }

    #[test]
    fn small_triangles_are_covered_as_rows_say() {
        let mut small = 0_u32;
        arbtest::arbtest(|u| {
            let grid = SubpixelGrid::new(u.int_in_range(1..=16)?);
            // The far corners of the guard band, where edge values are largest, and the frame's origin.
            let place = *u.choose(&[0.0, 3.5, 1919.0, GUARD.0 + 20.0, GUARD.1 - 20.0])?;
            let center = grid.snap(
                glam::DVec2::new(place, *u.choose(&[0.0, place, -place])?)
                    .clamp(glam::DVec2::splat(GUARD.0 + 20.0), glam::DVec2::splat(GUARD.1 - 20.0)),
            );
            // On a lattice of half samples full of ties, or anywhere.
            let corners = if u.arbitrary()? {
                corners(u, center, 9, grid.bits() - 1)?
            } else {
                corners(u, center, 5 << grid.bits(), 0)?
            };
            small += u32::from(check(corners, grid));
            Ok(())
        })
        .budget_ms(600);
        assert!(small > 1000, "only {small} small triangles were compared");
    }

    #[test]
    fn bits_are_cut_as_if_one_by_one() {
        arbtest::arbtest(|u| {
            let coverage = CoverageMask {
                column: u.int_in_range(-9..=3)?,
                row: u.int_in_range(-9..=3)?,
                mask: u.arbitrary()?,
            };
            let mut span = || -> Result<Span> {
                let start = u.int_in_range(-12..=14)?;
                Ok(Span {
                    start,
                    end: start + u.int_in_range(0..=20)?,
                })
            };
            let (columns, rows) = (span()?, span()?);
            let cut = coverage.within(columns, rows);
            let has = |coverage: CoverageMask, column: i32, row: i32| {
                let (i, j) = (column - coverage.column, row - coverage.row);
                (0..SMALL).contains(&i) && (0..SMALL).contains(&j) && coverage.mask >> (SMALL * j + i) & 1 == 1
            };
            let (mut across, mut down) = (Vec::new(), Vec::new());
            for row in -30..40 {
                for column in -30..40 {
                    let inside =
                        (columns.start..columns.end).contains(&column) && (rows.start..rows.end).contains(&row);
                    let expected = inside && has(coverage, column, row);
                    assert_eq!(
                        has(cut, column, row),
                        expected,
                        "{coverage:?} in {columns:?} {rows:?}: {cut:?}"
                    );
                    if expected {
                        across.push(column);
                        down.push(row);
                    }
                }
            }
            let mut in_runs = Vec::new();
            cut.each_run(|row, span| in_runs.extend((span.start..span.end).map(|column| (row, column))));
            let one_by_one: Vec<_> = down.iter().copied().zip(across.iter().copied()).collect();
            assert_eq!(in_runs, one_by_one, "runs of {cut:?}");
            if cut.mask != 0 {
                let ends = |found: &[i32]| (found.iter().min().copied(), found.iter().max().map(|last| last + 1));
                let (columns, rows) = (cut.columns(), cut.rows());
                assert_eq!(
                    ends(&across),
                    (Some(columns.start), Some(columns.end)),
                    "columns of {cut:?}"
                );
                assert_eq!(ends(&down), (Some(rows.start), Some(rows.end)), "rows of {cut:?}");
            }
            Ok(())
        })
        .budget_ms(200);
    }

    #[test]
    fn large_triangles_are_left_to_rows() {
        let grid = SubpixelGrid::new(1);
        let point = |x: f64, y: f64| grid.snap(glam::DVec2::new(x, y));
        let corners = |width: f64, height: f64| [point(0.0, 0.0), point(width, 0.0), point(0.0, height)];
        assert!(
            coverage_mask(corners(8.4, 8.4), grid, Rules::Standard).is_some(),
            "8 by 8 samples"
        );
        assert!(
            coverage_mask(corners(9.0, 1.0), grid, Rules::Standard).is_none(),
            "9 columns"
        );
        assert!(
            coverage_mask(corners(1.0, 9.0), grid, Rules::Standard).is_none(),
            "9 rows"
        );
        let guard = [
            point(GUARD.0, GUARD.0),
            point(GUARD.1, GUARD.0),
            point(GUARD.0, GUARD.1),
        ];
        assert!(
            coverage_mask(guard, grid, Rules::Course).is_none(),
            "the whole guard band"
        );
    }
}
