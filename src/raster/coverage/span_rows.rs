//! The spans of a shape on a grid of samples, gathered by rows of pixels, whatever the shape is.
//!
//! ```text
//!      row of pixels, 3 x 3 samples      its spans, one for each sample row
//!      . . . | . # # | # # .
//!      . . # | # # # | # . .             columns 4 to 8, 2 to 7 and 1 to 5
//!      . # # | # # . | . . .
//! ```
//!
//! Where a sample row has several spans, the row of pixels comes several times, each time with one of them.

use std::ops::Range;

use crate::geometry::subpixel::{GridPoint, SubpixelGrid};
use crate::raster::coverage::mask8x8::CoverageMask;
use crate::raster::coverage::polygon_rows::RowSpans;
use crate::raster::coverage::triangle::{RowWalker, SortedTriangle};
use crate::raster::sampling::rate::SampleRate;
use crate::raster::span::{Span, SpanRect, scaled, to_index};
use crate::rules::Rules;

/// Most samples along one side of a pixel.
pub(in crate::raster) const MAX_SIDE: usize = SampleRate::MAX_SIDE as usize;

/// Room for the spans of some rows of pixels.
#[derive(Debug)]
pub(in crate::raster) struct Batch<'b> {
    /// Samples along one side of a pixel.
    pub(in crate::raster) side: i32,
    /// As many spans for each row of pixels; all are empty before.
    pub(in crate::raster) lines: &'b mut [Span],
    /// The rows' numbers in the frame.
    pub(in crate::raster) ys: &'b mut [i32],
}

/// Where the spans of a shape in a tile come from, from top to bottom.
pub(in crate::raster) trait SpanRows {
    /// Puts spans of as many rows of pixels as there is room for into a batch; how many rows, fewer than there is room for at
    /// the end. Spans may be empty, and reach beyond the tile.
    fn take(&mut self, batch: Batch<'_>) -> usize;
}

/// The spans of a triangle.
pub(in crate::raster) struct TriangleRows {
    walker: RowWalker,
    /// The sample rows to come.
    rows: Span,
}

/// The spans of a few samples of the frame, which lie side by side in each row.
pub(in crate::raster) struct MaskRows {
    mask: CoverageMask,
    rows: Span,
}

/// Spans that were found before, several or none in some rows, where a pixel has up to `SIDE` sample rows.
pub(in crate::raster) struct StoredRows<'a, const SIDE: usize> {
    spans: RowSpans<'a>,
    rows: Span,
    /// The columns of samples of the tile.
    columns: Span,
    /// The row of pixels at work, where a sample row of it has several spans or none.
    several: Option<Several<'a, SIDE>>,
}

/// A row of pixels of which a sample row has several spans, or not all have any.
struct Several<'a, const SIDE: usize> {
    y: i32,
    /// Those spans of each sample row that reach into the tile.
    left: [&'a [Span]; SIDE],
    /// Which of them comes next, and how many there are.
    next: usize,
    most: usize,
}

impl TriangleRows {
    /// Hands out those of a triangle that has samples in the rows of the tile `rect`; it is too large to be moved.
    #[inline(always)]
    #[expect(clippy::inline_always, reason = "a few instructions for every triangle")]
    pub(in crate::raster) fn of(
        corners: [GridPoint; 3],
        grid: SubpixelGrid,
        rules: Rules,
        rect: SpanRect,
        each: impl FnOnce(&mut Self),
    ) {
        if let Some(sorted) = SortedTriangle::new(corners, rules) {
            let rows = sorted.rows(grid).intersection(scaled(rect.y, grid.side()));
            if !rows.is_empty() {
                let walker = sorted.walk_from(grid, rows.start);
                each(&mut Self { walker, rows });
            }
        }
    }
}

impl MaskRows {
    #[inline]
    pub(in crate::raster) fn new(mask: CoverageMask) -> Self {
        let rows = if mask.mask == 0 { Span::EMPTY } else { mask.rows() };
        Self { mask, rows }
    }
}

impl<'a, const SIDE: usize> StoredRows<'a, SIDE> {
    /// Those in the tile `rect`.
    #[inline]
    pub(in crate::raster) fn new(spans: RowSpans<'a>, side: i32, rect: SpanRect) -> Self {
        Self {
            spans,
            rows: spans.rows.intersection(scaled(rect.y, side)),
            columns: scaled(rect.x, side),
            several: None,
        }
    }

    /// Row `y` of pixels; `lines` are those of its sample rows that the tile has, of which `top` would be the first.
    fn several(&self, y: i32, lines: Range<i32>, top: i32) -> Several<'a, SIDE> {
        let mut found = Several {
            y,
            left: [&[]; SIDE],
            next: 0,
            most: 0,
        };
        for line in lines {
            let spans = reaching(self.spans.of_row(line), self.columns);
            found.left[to_index(line - top)] = spans;
            found.most = found.most.max(spans.len());
        }
        found
    }
}

impl SpanRows for TriangleRows {
    #[inline(always)]
    #[expect(clippy::inline_always, reason = "vector instructions reach inlined code only")]
    fn take(&mut self, batch: Batch<'_>) -> usize {
        let Self { walker, rows } = self;
        let by_four = matches!(batch.side, 2 | 4);
        take_single(
            rows,
            batch,
            #[inline(always)]
            |_, spans| walker.next_spans(spans, by_four),
        )
    }
}

impl SpanRows for MaskRows {
    #[inline(always)]
    #[expect(clippy::inline_always, reason = "vector instructions reach inlined code only")]
    fn take(&mut self, batch: Batch<'_>) -> usize {
        let Self { mask, rows } = self;
        take_single(
            rows,
            batch,
            #[inline(always)]
            |first, spans| {
                for (span, row) in spans.iter_mut().zip(first..) {
                    *span = mask.span(row);
                }
            },
        )
    }
}

/// As [`SpanRows::take`] where each of `rows` has one span; `next` is asked for those of some rows, from its first on.
#[inline(always)]
#[expect(clippy::inline_always, reason = "vector instructions reach inlined code only")]
fn take_single(rows: &mut Span, batch: Batch<'_>, next: impl FnOnce(i32, &mut [Span])) -> usize {
    let Batch { side, lines, ys } = batch;
    if rows.is_empty() {
        return 0;
    }
    let in_pixel = side.cast_unsigned() as usize;
    let first = pixel(rows.start, side);
    let top = first * side;
    let start = to_index(rows.start - top);
    let end = to_index(rows.end - top).min(lines.len());
    let used = end.next_multiple_of(in_pixel);
    next(rows.start, &mut lines[start..end]);
    let count = used / in_pixel;
    for (y, number) in ys[..count].iter_mut().zip(first..) {
        *y = number;
    }
    rows.start = top + i32::try_from(used).unwrap_or(i32::MAX);
    count
}

impl<const SIDE: usize> SpanRows for StoredRows<'_, SIDE> {
    fn take(&mut self, batch: Batch<'_>) -> usize {
        let Batch { side, lines, ys } = batch;
        let in_pixel = side.cast_unsigned() as usize;
        let mut count = 0;
        while count < ys.len() {
            let to = &mut lines[count * in_pixel..];
            if let Some(several) = &mut self.several {
                if several.take(&mut to[..in_pixel]) {
                    ys[count] = several.y;
                    count += 1;
                    continue;
                }
                self.several = None;
            }
            let line = self.rows.start;
            if line >= self.rows.end {
                break;
            }
            let y = pixel(line, side);
            // As many rows of pixels as have one span in each of their sample rows.
            let room = if self.spans.single { ys.len() - count } else { 1 };
            let whole = if line == y * side {
                (to_index(self.rows.end - line) / in_pixel).min(room)
            } else {
                0
            };
            let end = line + i32::try_from(whole).unwrap_or(0) * side;
            let found = self.spans.of_rows(line, end);
            if whole > 0 && found.len() == whole * in_pixel {
                to[..found.len()].copy_from_slice(found);
                for (y, number) in ys[count..count + whole].iter_mut().zip(y..) {
                    *y = number;
                }
                self.rows.start = end;
                count += whole;
            } else {
                let end = self.rows.end.min((y + 1) * side);
                self.rows.start = end;
                self.several = Some(self.several(y, line..end, y * side));
            }
        }
        count
    }
}

/// The pixel that a sample row or column of a frame lies in.
#[inline]
fn pixel(line: i32, side: i32) -> i32 {
    // None is negative.
    (line.cast_unsigned() / side.cast_unsigned()).cast_signed()
}

impl<const SIDE: usize> Several<'_, SIDE> {
    /// Takes the next span of each sample row; false where there is none left.
    #[inline]
    fn take(&mut self, lines: &mut [Span]) -> bool {
        if self.next == self.most {
            return false;
        }
        for (line, left) in lines.iter_mut().zip(self.left) {
            *line = left.get(self.next).copied().unwrap_or(Span::EMPTY);
        }
        self.next += 1;
        true
    }
}

/// Those of some spans that reach into `columns`; there may be a few others among them.
#[inline]
fn reaching(spans: &[Span], columns: Span) -> &[Span] {
    const FEW: usize = 3;
    if spans.len() <= FEW {
        return spans;
    }
    let first = spans.partition_point(|span| span.end <= columns.start);
    let end = first + spans[first..].partition_point(|span| span.start < columns.end);
    &spans[first..end]
}
