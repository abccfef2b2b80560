//! Rows of pixels with 4 x 4 samples, the commonest rate above one: as in `pixel_row`, but with few instructions.
//!
//! Spans are not cut to the tile; only the pixels are. The masks of four neighbouring pixels are made as one word, so
//! that nothing is clamped pixel by pixel.

use std::ops::Range;

use fearless_simd::prelude::*;
use fearless_simd::{Simd, i8x16, i8x64, i32x4, mask32x4, u32x4, u64x2};

use crate::geometry::subpixel::{GridPoint, SubpixelGrid};
use crate::raster::coverage::polygon_rows::RowSpans;
use crate::raster::coverage::triangle::SortedTriangle;
use crate::raster::span::{PixelRect, Span, scaled, to_index};
use crate::raster::surface_id::{GROUP, LAST_GROUP};
use crate::rules::Rules;

/// Samples along one side of a pixel.
pub(crate) const SIDE: i32 = 4;

/// The same, as the number of sample rows.
const ROWS: usize = SIDE as usize;

/// Rows of pixels that are looked at together: as many as tiles have.
const BATCH: usize = BATCH_LINES as usize / ROWS;

/// Their sample rows.
const BATCH_LINES: i32 = 128;

/// The sample columns of a window.
const COLUMNS: i32 = SIDE * SIDE;
const _: () = assert!(GROUP == ROWS, "the masks of a window fit one word");

/// The sample column of each bit of a window's masks.
const SAMPLE_COLUMNS: [i8; 64] = {
    let mut columns = [0; 64];
    let mut bit = 0;
    while bit < 64_u8 {
        columns[bit as usize] = (bit / 16 * 4 + bit % 4).cast_signed();
        bit += 1;
    }
    columns
};

/// The spans of a row of pixels, one for each sample row.
type Four = [Span; ROWS];

/// A row of pixels without samples.
const EMPTY: Four = [Span::EMPTY; ROWS];

/// Some samples of a row of a tile's pixels.
#[derive(Clone, Debug)]
pub(crate) struct TileRow<'a> {
    /// The row, counted from the tile's first.
    pub(crate) y: usize,
    /// Covered sample columns of the frame; spans may reach beyond the tile.
    pub(crate) spans: &'a Four,
    /// The tile's first column of pixels.
    left: i32,
    /// Pixels of which any sample is covered, and among them those of which all are, counted from the tile's left side.
    pub(crate) touched: Range<usize>,
    pub(crate) full: Range<usize>,
}

/// Some samples of four pixels side by side.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Window {
    /// The first pixel, counted from the tile's left side.
    pub(crate) x: usize,
    /// All bits of the pixels that are meant, sixteen each, those of the first pixel lowest.
    pub(crate) live: u64,
    /// The samples of these that are covered.
    pub(crate) masks: u64,
}

/// Which ends of spans may lie in pixels.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Ends {
    Left,
    Right,
    Both,
}

/// Calls `paint` for every row of pixels of the tile `rect` of which the triangle covers any sample, from top to bottom.
#[inline(always)]
#[expect(clippy::inline_always, reason = "what paints is to be seen by the compiler")]
pub(crate) fn each_row_of_triangle<S: Simd>(
    simd: S,
    corners: [GridPoint; 3],
    (grid, rules): (SubpixelGrid, Rules),
    rect: PixelRect,
    mut paint: impl FnMut(&TileRow<'_>),
) {
    let Some(sorted) = SortedTriangle::new(corners, rules) else {
        return;
    };
    let rows = sorted.rows(grid).intersection(scaled(rect.y, SIDE));
    if rows.is_empty() {
        return;
    }
    let mut walker = sorted.walk_from(grid, rows.start);
    let mut fours = [EMPTY; BATCH];
    let mut line = rows.start;
    while line < rows.end {
        // Rows of a frame are never negative.
        let first = line >> 2;
        let lines = fours.as_flattened_mut();
        let count = lines.len();
        let inside = |line: i32| ((line - first * SIDE).cast_unsigned() as usize).min(count);
        let end = inside(rows.end);
        // Nothing above and below, up to an even number of rows of pixels.
        lines[..ROWS].fill(Span::EMPTY);
        walker.next_spans(&mut lines[inside(line)..end]);
        let used = end.next_multiple_of(2 * ROWS).min(count);
        lines[end..used].fill(Span::EMPTY);
        let y = to_index(first - rect.y.start);
        each(simd, (&fours[..used / ROWS], rect.x), |i| y + i, &mut paint);
        line = first * SIDE + BATCH_LINES;
    }
}

/// As [`each_row_of_triangle`] for an outline; a row of pixels in which a sample row has several spans comes several
/// times, each time with one of them.
#[inline(always)]
#[expect(clippy::inline_always, reason = "what paints is to be seen by the compiler")]
pub(crate) fn each_row_of_spans<S: Simd>(
    simd: S,
    spans: RowSpans<'_>,
    rect: PixelRect,
    mut paint: impl FnMut(&TileRow<'_>),
) {
    let mut rows = FourRows::new(spans, rect);
    let (mut fours, mut ys) = ([EMPTY; BATCH], [0; BATCH]);
    loop {
        let count = rows.take(&mut fours, &mut ys);
        if count == 0 {
            return;
        }
        let used = count.next_multiple_of(2);
        fours[count..used].fill(EMPTY);
        each(simd, (&fours[..used], rect.x), |i| ys[i % BATCH], &mut paint);
    }
}

/// The spans of an outline by rows of pixels.
struct FourRows<'a> {
    spans: RowSpans<'a>,
    /// The columns of samples of the tile, and its first row of pixels.
    columns: Span,
    top: i32,
    /// The sample rows to come.
    rows: Span,
    /// The spans of the row of pixels at work, which of them comes next, and how many there are.
    left: [&'a [Span]; ROWS],
    next: usize,
    most: usize,
    y: usize,
}

impl<'a> FourRows<'a> {
    #[inline]
    fn new(spans: RowSpans<'a>, rect: PixelRect) -> Self {
        Self {
            spans,
            columns: scaled(rect.x, SIDE),
            top: rect.y.start,
            rows: spans.rows.intersection(scaled(rect.y, SIDE)),
            left: [&[]; ROWS],
            next: 0,
            most: 0,
            y: 0,
        }
    }

    /// Puts spans of as many rows as there is room into `fours`, and the numbers of these rows into `ys`; how many.
    fn take(&mut self, fours: &mut [Four; BATCH], ys: &mut [usize; BATCH]) -> usize {
        let mut count = 0;
        while count < BATCH {
            if self.next < self.most {
                fours[count] = self
                    .left
                    .map(|spans| spans.get(self.next).copied().unwrap_or(Span::EMPTY));
                ys[count] = self.y;
                self.next += 1;
                count += 1;
                continue;
            }
            let line = self.rows.start;
            if line >= self.rows.end {
                break;
            }
            self.y = to_index((line >> 2) - self.top);
            // As many rows of pixels as have one span in each of their sample rows.
            let room = if self.spans.single { BATCH - count } else { 1 };
            let whole = if line % SIDE == 0 {
                (to_index(self.rows.end - line) / ROWS).min(room)
            } else {
                0
            };
            let end = line + i32::try_from(whole * ROWS).unwrap_or(0);
            let lines = self.spans.of_rows(line, end);
            if whole > 0 && lines.len() == whole * ROWS {
                fours[count..count + whole].as_flattened_mut().copy_from_slice(lines);
                for (y, number) in ys[count..count + whole].iter_mut().zip(self.y..) {
                    *y = number;
                }
                self.rows.start = end;
                count += whole;
            } else {
                self.rows.start = self.rows.end.min(((line >> 2) + 1) * SIDE);
                self.begin(line, self.rows.start);
            }
        }
        count
    }

    /// Begins a row of pixels of which a sample row has several spans, or not all have any.
    fn begin(&mut self, line: i32, end: i32) {
        self.left = [&[]; ROWS];
        for line in line..end {
            // Those spans that reach into the tile.
            self.left[to_index(line & 3)] = reaching(self.spans.of_row(line), self.columns);
        }
        let [a, b, c, d] = self.left.map(<[Span]>::len);
        (self.next, self.most) = (0, a.max(b).max(c.max(d)));
        if self.most == 0 {
            // One row without samples does no harm.
            self.most = 1;
        }
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

/// Calls `paint` for each of an even number of rows of pixels of which any pixel in `columns` is touched; `y_of` tells
/// the numbers of rows.
#[inline(always)]
#[expect(clippy::inline_always, reason = "a few instructions for every row of pixels")]
fn each<S: Simd>(
    simd: S,
    (fours, columns): (&[Four], Span),
    y_of: impl Fn(usize) -> usize,
    paint: &mut impl FnMut(&TileRow<'_>),
) {
    // The outer and the inner ends of two rows at a time.
    let (mut outer, mut inner) = ([[0; 4]; BATCH / 2], [[0; 4]; BATCH / 2]);
    for ((two, outer), inner) in fours.as_chunks::<2>().0.iter().zip(&mut outer).zip(&mut inner) {
        [*outer, *inner] = ends(simd, two, columns);
    }
    let (outer, inner) = (outer.as_flattened().as_chunks().0, inner.as_flattened().as_chunks().0);
    for (i, ((spans, outer), inner)) in fours.iter().zip(outer).zip(inner).enumerate() {
        let range = |[start, end]: [u32; 2]| start as usize..end as usize;
        let touched = range(*outer);
        if touched.is_empty() {
            continue;
        }
        paint(&TileRow {
            y: y_of(i),
            spans,
            left: columns.start,
            touched,
            full: range(*inner),
        });
    }
}

/// Where the pixels begin and end of which two rows touch any sample, and where those of which they cover all, counted from
/// the first of `columns` and cut to these.
#[inline(always)]
#[expect(clippy::inline_always, reason = "vector instructions reach inlined code only")]
fn ends<S: Simd>(simd: S, rows: &[Four; 2], columns: Span) -> [[u32; 4]; 2] {
    let vector = |numbers: [i32; 4]| i32x4::simd_from(simd, numbers);
    // Starts and ends alternate: the least and the greatest of two sample rows each, then of all four.
    let [upper, lower] = rows.each_ref().map(|[a, b, c, d]| {
        let (first, second) = (
            vector([a.start, a.end, b.start, b.end]),
            vector([c.start, c.end, d.start, d.end]),
        );
        let wide = |vector: i32x4<S>| vector.bitcast::<u64x2<S>>();
        (wide(first.min(second)), wide(first.max(second)))
    });
    let narrow = |vector: u64x2<S>| vector.bitcast::<i32x4<S>>();
    let least = narrow(upper.0.zip_low(lower.0)).min(narrow(upper.0.zip_high(lower.0)));
    let most = narrow(upper.1.zip_low(lower.1)).max(narrow(upper.1.zip_high(lower.1)));
    let starts = mask32x4::from_bitmask(simd, 0b0101);
    let left = columns.start * SIDE;
    let width = i32x4::splat(simd, columns.end - columns.start);
    let pixels = |samples: i32x4<S>, [start, end]: [i32; 2]| {
        let pixels = (samples + vector([start - left, end - left, start - left, end - left])) >> 2;
        let inside = pixels.max(i32x4::splat(simd, 0)).min(width);
        inside.bitcast::<u32x4<S>>().to_array()
    };
    [
        pixels(starts.select(least, most), [0, 3]),
        pixels(starts.select(most, least), [3, 0]),
    ]
}

impl TileRow<'_> {
    /// The pixels that are covered in part beside those that are full, of which there must be some.
    #[inline(always)]
    #[expect(clippy::inline_always, reason = "a few instructions for every row of pixels")]
    pub(crate) fn beside_full(&self) -> (Range<usize>, Range<usize>) {
        (self.touched.start..self.full.start, self.full.end..self.touched.end)
    }

    /// The column of the frame in which pixel `x` lies.
    #[inline]
    pub(crate) fn column(&self, x: usize) -> i32 {
        self.left + i32::try_from(x).unwrap_or(0)
    }
}

/// Calls `visit` with windows that hold each of the pixels `xs` of a row once; `ends` says which ends of spans may lie in
/// these pixels.
#[inline(always)]
#[expect(clippy::inline_always, reason = "faster where `ends` is known")]
pub(crate) fn each_window<S: Simd>(
    simd: S,
    row: &TileRow<'_>,
    (xs, ends): (Range<usize>, Ends),
    mut visit: impl FnMut(Window),
) {
    let [a, b, c, d] = row.spans;
    let vector = |numbers: [i32; 4]| i32x4::simd_from(simd, numbers);
    let (upper, lower) = (
        vector([a.start, a.end, b.start, b.end]),
        vector([c.start, c.end, d.start, d.end]),
    );
    let left = i32x4::splat(simd, row.left * SIDE);
    let (starts, endings) = (upper.unzip_low(lower) - left, upper.unzip_high(lower) - left);
    let mut from = xs.start;
    while from < xs.end {
        let x = from.min(LAST_GROUP);
        let end = xs.end.min(x + GROUP);
        // At least one pixel and at most four.
        let live = u64::MAX >> (16 * (GROUP - (end - from)) % 64) << (16 * (from - x) % 64);
        let masks = match ends {
            Ends::Left => !before(simd, starts, x),
            Ends::Right => before(simd, endings, x),
            Ends::Both => before(simd, endings, x) & !before(simd, starts, x),
        };
        visit(Window {
            x,
            live,
            masks: masks & live,
        });
        from = end;
    }
}

/// The samples of a window of pixels from pixel `x` on that lie before a column, one for each sample row: from the lowest
/// bits on the masks of the pixels.
#[inline(always)]
#[expect(clippy::inline_always, reason = "vector instructions reach inlined code only")]
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_possible_wrap,
    reason = "a place in a row of 64"
)]
fn before<S: Simd>(simd: S, columns: i32x4<S>, x: usize) -> u64 {
    let number = |number: i32| i32x4::splat(simd, number);
    let inside = (columns - number(x as i32 * SIDE)).max(number(0)).min(number(COLUMNS));
    // A byte for each sample of a pixel: four times the number of its row.
    let twice = inside | inside << 8;
    let rows: i8x16<S> = (twice | twice << 16).bitcast();
    let samples = i8x64::simd_from(simd, SAMPLE_COLUMNS);
    samples.simd_lt(i8x64::block_splat(rows)).to_bitmask()
}

#[cfg(test)]
mod tests {
    use arbtest::arbitrary::{Result, Unstructured};
    use fearless_simd::dispatch;

    use super::*;
    use crate::raster::surface_id::ROW;
    use crate::simd;

    /// Columns around those of a tile of some pixels, more than fit a window.
    fn span(u: &mut Unstructured<'_>) -> Result<Span> {
        if u.ratio(1, 8)? {
            return Ok(Span::EMPTY);
        }
        let start = u.int_in_range(-20..=300)?;
        Ok(Span {
            start,
            end: start + u.int_in_range(-2..=300)?,
        })
    }

    /// The masks of the pixels of two rows, as the windows say.
    fn masks<S: Simd>(simd: S, fours: &[Four; 2], columns: Span) -> [[u64; ROW]; 2] {
        let mut found = [[0; ROW]; 2];
        each(simd, (fours, columns), |i| i, &mut |row: &TileRow<'_>| {
            assert_eq!(row.column(0), columns.start, "the first column");
            assert_eq!(row.spans, &fours[row.y], "its spans");
            let mut times = [0; ROW];
            let mut add = |window: Window, partial: bool| {
                assert!(window.x <= LAST_GROUP, "in the row");
                for i in 0..GROUP {
                    let bits = |word: u64| word >> (16 * i) & 0xFFFF;
                    let (live, mask) = (bits(window.live), bits(window.masks));
                    assert!(live == 0 || live == 0xFFFF, "all of a pixel or nothing");
                    assert_eq!(mask & !live, 0, "what is not meant is not covered");
                    assert!(!partial || live == 0 || mask != 0 && mask != 0xFFFF, "covered in part");
                    times[window.x + i] += live / 0xFFFF;
                    found[row.y][window.x + i] |= mask;
                }
            };
            if row.full.is_empty() {
                each_window(simd, row, (row.touched.clone(), Ends::Both), |window| {
                    add(window, false);
                });
            } else {
                let (before, after) = row.beside_full();
                each_window(simd, row, (before, Ends::Left), |window| add(window, true));
                each_window(simd, row, (after, Ends::Right), |window| add(window, true));
                for x in row.full.clone() {
                    times[x] += 1;
                    found[row.y][x] = 0xFFFF;
                }
            }
            for (x, times) in times.iter().enumerate() {
                assert_eq!(*times, u64::from(row.touched.contains(&x)), "how often pixel {x} comes");
            }
        });
        found
    }

    #[test]
    fn rows_of_pixels_hold_the_samples_of_their_spans_on_every_level() {
        arbtest::arbtest(|u| {
            let mut four = || Ok([span(u)?, span(u)?, span(u)?, span(u)?]);
            let fours = [four()?, four()?];
            let start = u.int_in_range(0..=9)?;
            let columns = Span {
                start,
                end: start + u.int_in_range(1..=64)?,
            };
            let expected = fours.map(|spans| {
                std::array::from_fn(|x| {
                    let x = columns.start + i32::try_from(x).expect("in the row");
                    let bit = |i: i32| {
                        let Span { start, end } = spans[to_index(i / SIDE)];
                        let inside = (start..end).contains(&(x * SIDE + i % SIDE));
                        u64::from(inside && x < columns.end) << i
                    };
                    (0..16).map(bit).sum::<u64>()
                })
            });
            for (name, level) in simd::tested() {
                let mut found = dispatch!(level, simd => masks(simd, &fours, columns));
                // Windows may look beyond the tile's right side, where nobody looks.
                for row in &mut found {
                    row[to_index(columns.end - columns.start)..].fill(0);
                }
                assert_eq!(found, expected, "{name}: {columns:?} of {fours:?}");
            }
            Ok(())
        })
        .budget_ms(600);
    }
}
