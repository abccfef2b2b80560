//! The coverage of a rectangle of pixels, one row of pixels at a time.

use crate::geometry::subpixel::{GridPoint, SubpixelGrid};
use crate::raster::coverage::mask8x8::CoverageMask;
use crate::raster::coverage::polygon_rows::RowSpans;
use crate::raster::coverage::triangle::SortedTriangle;
use crate::raster::sampling::rate::SampleRate;
use crate::raster::span::{PixelRect, Span, scaled};
use crate::rules::Rules;

/// Most samples along one side of a pixel.
const MAX_SIDE: usize = SampleRate::MAX_SIDE as usize;

/// The samples of one row of pixels that a shape covers, or some of them.
#[derive(Debug)]
pub(crate) struct PixelRow<'a> {
    /// The row of pixels.
    pub(crate) y: i32,
    /// Covered sample columns per sample row.
    spans: &'a [Span],
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
    paint: impl FnMut(&PixelRow<'_>),
) {
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
            |_, columns, spans| walker.next_spans_within(spans, columns),
            paint,
        );
    }
}

/// As [`each_pixel_row`] for samples that are known.
#[inline]
pub(crate) fn each_pixel_row_of_few(
    coverage: CoverageMask,
    side: i32,
    rect: PixelRect,
    paint: impl FnMut(&PixelRow<'_>),
) {
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
    mut paint: impl FnMut(&PixelRow<'_>),
) {
    if spans.single {
        let next = |first: i32, columns: Span, of_rows: &mut [Span]| {
            for (span, line) in of_rows.iter_mut().zip(first..) {
                *span = spans
                    .of_row(line)
                    .first()
                    .map_or(Span::EMPTY, |span| span.intersection(columns));
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
                        .map_or(Span::EMPTY, |span| span.intersection(columns));
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
    mut paint: impl FnMut(&PixelRow<'_>),
) {
    let columns = scaled(rect.x, side);
    let rows = rows.intersection(scaled(rect.y, side));
    let mut lines = [Span::EMPTY; MAX_SIDE];
    let in_pixel = side.cast_unsigned() as usize;
    // Sample rows of as many pixels as there is room for.
    let batch = i32::try_from(MAX_SIDE / in_pixel * in_pixel).unwrap_or(side);
    let mut line = rows.start;
    while line < rows.end {
        // Rows of a frame are never negative.
        let first = (line.cast_unsigned() / side.cast_unsigned()).cast_signed();
        let top = first * side;
        let end = rows.end.min(top + batch);
        let inside = |line: i32| (line - top).cast_unsigned() as usize;
        lines[..inside(line)].fill(Span::EMPTY);
        next_spans(line, columns, &mut lines[inside(line)..inside(end)]);
        let last = inside(end).next_multiple_of(in_pixel);
        lines[inside(end)..last].fill(Span::EMPTY);
        for (spans, y) in lines[..last].chunks_exact(in_pixel).zip(first..) {
            let row = PixelRow::new(y, spans);
            if !row.touched.is_empty() {
                paint(&row);
            }
        }
        line = end;
    }
}

impl<'a> PixelRow<'a> {
    /// The row `y` of pixels with these spans, one for each sample row.
    #[inline]
    fn new(y: i32, spans: &'a [Span]) -> Self {
        let nothing = Span::EMPTY;
        if let [only] = *spans {
            let touched = if only.is_empty() { nothing } else { only };
            return Self {
                y,
                spans,
                touched,
                full: touched,
            };
        }
        let first = spans[0];
        let (mut outer, mut inner, mut any_empty) = (first, first, first.is_empty());
        for span in &spans[1..] {
            any_empty |= span.is_empty();
            inner = inner.intersection(*span);
            outer = outer.union(*span);
        }
        if any_empty {
            // A sample row without samples leaves no pixel full.
            inner = Span::EMPTY;
            outer = spans
                .iter()
                .filter(|span| !span.is_empty())
                .fold(Span::EMPTY, |outer, span| outer.union(*span));
        }
        let mut row = Self {
            y,
            spans,
            touched: nothing,
            full: nothing,
        };
        if outer.is_empty() {
            return row;
        }
        // Columns of a frame are never negative, so that division rounds down.
        let side = u32::try_from(spans.len()).unwrap_or(1);
        let down = |column: i32| (column.cast_unsigned() / side).cast_signed();
        let up = |column: i32| (column.cast_unsigned().saturating_add(side - 1) / side).cast_signed();
        row.touched = Span {
            start: down(outer.start),
            end: up(outer.end),
        };
        if !inner.is_empty() {
            row.full = Span {
                start: up(inner.start),
                end: down(inner.end),
            };
        }
        if row.full.is_empty() {
            row.full = Span {
                start: row.touched.end,
                end: row.touched.end,
            };
        }
        row
    }

    /// Covered sample columns for each sample row of the row of pixels; spans may reach beyond the rectangle.
    #[inline]
    pub(crate) fn spans(&self) -> &'a [Span] {
        self.spans
    }

    /// The pixels that are covered in part.
    #[inline]
    pub(crate) fn partial(&self) -> impl Iterator<Item = i32> + use<> {
        (self.touched.start..self.full.start).chain(self.full.end..self.touched.end)
    }
}
