//! The coverage of a rectangle of pixels, one row of pixels at a time.

use super::outline::RowSpans;
use super::rows::{SortedTriangle, Span};
use super::sample_rate::SampleRate;
use super::small::{SmallCoverage, small_coverage};
use super::tile::PixelRect;
use crate::geometry::subpixel::{GridPoint, SubpixelGrid};
use crate::rules::Rules;

/// Most samples along one side of a pixel.
const MAX_SIDE: usize = SampleRate::MAX_SIDE as usize;

/// The samples of one row of pixels that a shape covers, or some of them.
#[derive(Debug)]
pub(crate) struct PixelRow {
    /// The row of pixels.
    pub(crate) y: i32,
    /// Covered sample columns per sample row.
    spans: [Span; MAX_SIDE],
    /// Sample rows in use.
    side: usize,
    /// Pixels of which any sample is covered, and among them those of which all are; where these are none, they are an
    /// empty span at the end.
    pub(crate) touched: Span,
    pub(crate) full: Span,
}

/// Calls `paint` for every row of pixels in `rect` of which the triangle covers any sample, from top to bottom.
#[inline]
pub(crate) fn each_pixel_row(
    corners: [GridPoint; 3],
    (grid, rules): (SubpixelGrid, Rules),
    rect: PixelRect,
    paint: impl FnMut(&PixelRow),
) {
    if let Some(coverage) = small_coverage(corners, grid, rules) {
        return each_pixel_row_of_few(coverage, grid.side(), rect, paint);
    }
    let Some(sorted) = SortedTriangle::new(corners, rules) else {
        return;
    };
    let rows = sorted.rows(grid).intersection(scaled(rect.y, grid.side()));
    if !rows.is_empty() {
        let mut walker = sorted.walk_from(grid, rows.start);
        each_row(
            grid.side(),
            rect,
            rows,
            |_, columns, spans| walker.next_spans(spans, columns),
            paint,
        );
    }
}

/// As [`each_pixel_row`] for samples that are known.
#[inline]
pub(crate) fn each_pixel_row_of_few(coverage: SmallCoverage, side: i32, rect: PixelRect, paint: impl FnMut(&PixelRow)) {
    if coverage.mask != 0 {
        let next = |first: i32, columns: Span, spans: &mut [Span]| {
            for (span, line) in spans.iter_mut().zip(first..) {
                *span = coverage.span(line).intersection(columns);
            }
        };
        each_row(side, rect, coverage.rows(), next, paint);
    }
}

/// As [`each_pixel_row`] for an outline. A row of pixels in which a sample row has several spans comes several times, each
/// time with one of them.
#[inline]
pub(crate) fn each_pixel_row_of_spans(
    spans: RowSpans<'_>,
    side: i32,
    rect: PixelRect,
    mut paint: impl FnMut(&PixelRow),
) {
    if spans.single {
        let next = |first: i32, columns: Span, of_rows: &mut [Span]| {
            for (span, line) in of_rows.iter_mut().zip(first..) {
                *span = spans
                    .of_row(line)
                    .first()
                    .map_or(Span::default(), |span| span.intersection(columns));
            }
        };
        return each_row(side, rect, spans.rows, next, paint);
    }
    let columns = scaled(rect.x, side);
    let rows = spans.rows.intersection(scaled(rect.y, side));
    // For each sample row of a row of pixels, the spans that reach into the rectangle and have not come yet.
    let mut left: [&[Span]; MAX_SIDE] = [&[]; MAX_SIDE];
    let mut line = rows.start;
    while line < rows.end {
        let y = line.div_euclid(side);
        let lines = Span {
            start: y * side,
            end: (y + 1) * side,
        }
        .intersection(rows);
        for (left, line) in left.iter_mut().zip(lines.start..lines.end) {
            let all = spans.of_row(line);
            let first = all.partition_point(|span| span.end <= columns.start);
            let end = first + all[first..].partition_point(|span| span.start < columns.end);
            *left = &all[first..end];
        }
        let of_lines = &mut left[..(lines.end - lines.start).cast_unsigned() as usize];
        while of_lines.iter().any(|spans| !spans.is_empty()) {
            let next = |first: i32, columns: Span, of_rows: &mut [Span]| {
                let left = &mut of_lines[(first - lines.start).cast_unsigned() as usize..];
                for (span, left) in of_rows.iter_mut().zip(left) {
                    *span = left
                        .split_off_first()
                        .map_or(Span::default(), |span| span.intersection(columns));
                }
            };
            each_row(side, rect, lines, next, &mut paint);
        }
        line = lines.end;
    }
}

/// Gathers the spans of sample rows into rows of pixels; `next_spans` is asked for the parts of `rows` in `rect`, some
/// rows at a time from top to bottom: the first of them, the columns, and where to put the spans.
#[inline]
fn each_row(
    side: i32,
    rect: PixelRect,
    rows: Span,
    mut next_spans: impl FnMut(i32, Span, &mut [Span]),
    mut paint: impl FnMut(&PixelRow),
) {
    let columns = scaled(rect.x, side);
    let rows = rows.intersection(scaled(rect.y, side));
    let mut row = PixelRow {
        y: 0,
        spans: [Span::default(); MAX_SIDE],
        side: side.cast_unsigned() as usize,
        touched: Span::default(),
        full: Span::default(),
    };
    if side == 1 {
        for y in rows.start..rows.end {
            next_spans(y, columns, &mut row.spans[..1]);
            if !row.spans[0].is_empty() {
                (row.y, row.touched, row.full) = (y, row.spans[0], row.spans[0]);
                paint(&row);
            }
        }
        return;
    }
    match side {
        4 => gather_rows(
            4,
            rows,
            &mut row,
            |first, spans| next_spans(first, columns, spans),
            paint,
        ),
        _ => gather_rows(
            side,
            rows,
            &mut row,
            |first, spans| next_spans(first, columns, spans),
            paint,
        ),
    }
}

/// Calls `paint` with each row of pixels of which a sample row lies in `rows`. Inlined, so that the compiler knows the
/// commonest `side`.
#[inline(always)]
#[expect(clippy::inline_always, reason = "divisions by a known side are shifts")]
fn gather_rows(
    side: i32,
    rows: Span,
    row: &mut PixelRow,
    mut next_spans: impl FnMut(i32, &mut [Span]),
    mut paint: impl FnMut(&PixelRow),
) {
    let mut line = rows.start;
    while line < rows.end {
        // Rows of a frame are never negative.
        row.y = (line.cast_unsigned() / side.cast_unsigned()).cast_signed();
        let top = row.y * side;
        let spans = &mut row.spans[..side.cast_unsigned() as usize];
        if rows.start <= top && top + side <= rows.end {
            next_spans(top, spans);
        } else {
            spans.fill(Span::default());
            let inside = |line: i32| (line - top).cast_unsigned() as usize;
            next_spans(line, &mut spans[inside(line)..inside(rows.end.min(top + side))]);
        }
        row.measure(side);
        if !row.touched.is_empty() {
            paint(row);
        }
        line = top + side;
    }
}

/// A span of pixels as a span of samples.
pub(crate) fn scaled(pixels: Span, side: i32) -> Span {
    Span {
        start: pixels.start * side,
        end: pixels.end * side,
    }
}

impl PixelRow {
    /// Covered sample columns for each sample row of the row of pixels.
    #[inline]
    pub(crate) fn spans(&self) -> &[Span] {
        &self.spans[..self.side]
    }

    /// The pixels that are covered in part.
    #[inline]
    pub(crate) fn partial(&self) -> impl Iterator<Item = i32> + use<> {
        (self.touched.start..self.full.start).chain(self.full.end..self.touched.end)
    }

    /// Finds out which pixels are touched and which are full.
    #[inline(always)]
    #[expect(clippy::inline_always, reason = "divisions by a known side are shifts")]
    fn measure(&mut self, side: i32) {
        let spans = &self.spans[..side.cast_unsigned() as usize];
        let first = spans[0];
        let (mut outer, mut inner, mut any_empty) = (first, first, first.is_empty());
        for span in &spans[1..] {
            any_empty |= span.is_empty();
            inner = inner.intersection(*span);
            outer = outer.union(*span);
        }
        if any_empty {
            // A sample row without samples leaves no pixel full.
            inner = Span::default();
            outer = spans
                .iter()
                .filter(|span| !span.is_empty())
                .fold(Span::NOTHING, |outer, span| outer.union(*span));
        }
        if outer.is_empty() {
            (self.touched, self.full) = (Span::default(), Span::default());
            return;
        }
        // Columns of a frame are never negative, so that division rounds down.
        let side = side.cast_unsigned();
        let down = |column: i32| (column.cast_unsigned() / side).cast_signed();
        let up = |column: i32| (column.cast_unsigned().saturating_add(side - 1) / side).cast_signed();
        self.touched = Span {
            start: down(outer.start),
            end: up(outer.end),
        };
        self.full = if inner.is_empty() {
            Span::default()
        } else {
            Span {
                start: up(inner.start),
                end: down(inner.end),
            }
        };
        if self.full.is_empty() {
            self.full = Span {
                start: self.touched.end,
                end: self.touched.end,
            };
        }
    }
}
