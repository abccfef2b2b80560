//! Rows of pixels with 4 x 4 samples, the commonest rate above one: as in `pixel_row`, but with few instructions.
//!
//! Spans are not cut to the tile; only the pixels are. The masks of four neighbouring pixels are made as one word, so
//! that nothing is clamped pixel by pixel.

use fearless_simd::prelude::*;
use fearless_simd::{Simd, i8x16, i8x64, i32x4};

use super::outline::RowSpans;
use super::pixel_row::{PixelRow, scaled};
use super::rows::{SortedTriangle, Span};
use super::tile::PixelRect;
use super::visibility::Slot;
use crate::geometry::subpixel::{GridPoint, SubpixelGrid};
use crate::rules::Rules;

/// Samples along one side of a pixel.
pub(crate) const SIDE: i32 = 4;

/// The same, as the number of sample rows.
const ROWS: usize = SIDE as usize;

/// Rows of pixels that a triangle is walked at once, and their sample rows.
const BATCH: i32 = 32;
const LINES: usize = BATCH as usize * ROWS;

/// Pixels in a row of most tiles.
const ROW: usize = 64;

/// Pixels whose masks fit one word, and their sample columns.
const WINDOW: i32 = 4;
const COLUMNS: i32 = WINDOW * SIDE;

/// The sample column of each bit of such a word.
const SAMPLE_COLUMNS: [i8; 64] = {
    let mut columns = [0; 64];
    let mut bit = 0;
    while bit < 64_u8 {
        columns[bit as usize] = (bit / 16 * 4 + bit % 4).cast_signed();
        bit += 1;
    }
    columns
};

/// Which ends of spans may lie in pixels.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Ends {
    Left,
    Right,
    Both,
}

/// Calls `paint` for every row of pixels in `rect` of which the triangle covers any sample, from top to bottom.
#[inline(always)]
#[expect(clippy::inline_always, reason = "what paints is to be seen by the compiler")]
pub(crate) fn each_row_of_triangle(
    corners: [GridPoint; 3],
    (grid, rules): (SubpixelGrid, Rules),
    rect: PixelRect,
    mut paint: impl FnMut(&PixelRow<'_>),
) {
    let Some(sorted) = SortedTriangle::new(corners, rules) else {
        return;
    };
    let rows = sorted.rows(grid).intersection(scaled(rect.y, SIDE));
    if rows.is_empty() {
        return;
    }
    let mut walker = sorted.walk_from(grid, rows.start);
    let mut lines = [Span::EMPTY; LINES];
    let mut line = rows.start;
    while line < rows.end {
        // Rows of a frame are never negative.
        let first = line >> 2;
        let top = first * SIDE;
        let end = rows.end.min(top + BATCH * SIDE);
        let inside = |line: i32| ((line - top).cast_unsigned() as usize).min(LINES);
        lines[..ROWS].fill(Span::EMPTY);
        walker.next_spans(&mut lines[inside(line)..inside(end)]);
        let last = inside(end).next_multiple_of(ROWS).min(LINES);
        lines[inside(end)..last].fill(Span::EMPTY);
        for (spans, y) in lines[..last].as_chunks::<ROWS>().0.iter().zip(first..) {
            each(y, spans, rect.x, &mut paint);
        }
        line = end;
    }
}

/// As [`each_row_of_triangle`] for an outline; a row of pixels in which a sample row has several spans comes several
/// times, each time with one of them.
#[inline(always)]
#[expect(clippy::inline_always, reason = "what paints is to be seen by the compiler")]
pub(crate) fn each_row_of_spans(spans: RowSpans<'_>, rect: PixelRect, mut paint: impl FnMut(&PixelRow<'_>)) {
    let rows = spans.rows.intersection(scaled(rect.y, SIDE));
    let columns = scaled(rect.x, SIDE);
    let mut line = rows.start;
    while line < rows.end {
        let y = line >> 2;
        let end = rows.end.min((y + 1) * SIDE);
        let all = spans.of_rows(line, end);
        let mut left: [&[Span]; ROWS] = [&[]; ROWS];
        let (mut four, most) = match <&[Span; ROWS]>::try_from(all) {
            Ok(four) if end - line == SIDE => (*four, 1),
            _ => {
                // Of each sample row the spans that reach into the rectangle.
                for line in line..end {
                    left[(line & 3).cast_unsigned() as usize] = reaching(spans.of_row(line), columns);
                }
                let [a, b, c, d] = left.map(<[Span]>::len);
                (of_each(left, 0), a.max(b).max(c.max(d)))
            }
        };
        for i in 1..=most {
            each(y, &four, rect.x, &mut paint);
            four = if i < most { of_each(left, i) } else { four };
        }
        line = end;
    }
}

/// Of each sample row the span number `i`.
#[inline]
fn of_each(rows: [&[Span]; ROWS], i: usize) -> [Span; ROWS] {
    rows.map(|spans| spans.get(i).copied().unwrap_or(Span::EMPTY))
}

/// Those of some spans that reach into `columns`, and perhaps a few others.
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

/// Calls `paint` with the row `y` of pixels that has these spans, if any of its pixels in `columns` is touched.
#[inline(always)]
#[expect(clippy::inline_always, reason = "a few instructions for every row of pixels")]
fn each(y: i32, spans: &[Span; ROWS], columns: Span, paint: &mut impl FnMut(&PixelRow<'_>)) {
    // The least and the greatest start and end, four numbers at a time.
    let [a, b, c, d] = *spans;
    let (ab, cd) = ([a.start, a.end, b.start, b.end], [c.start, c.end, d.start, d.end]);
    let (mut least, mut most) = ([0; ROWS], [0; ROWS]);
    for i in 0..ROWS {
        least[i] = ab[i].min(cd[i]);
        most[i] = ab[i].max(cd[i]);
    }
    let outer = Span {
        start: least[0].min(least[2]) >> 2,
        end: (most[1].max(most[3]) + 3) >> 2,
    };
    let touched = outer.intersection(columns);
    if touched.is_empty() {
        return;
    }
    let inner = Span {
        start: (most[0].max(most[2]) + 3) >> 2,
        end: least[1].min(least[3]) >> 2,
    };
    let full = inner.intersection(columns);
    let full = if full.is_empty() {
        Span {
            start: touched.end,
            end: touched.end,
        }
    } else {
        full
    };
    paint(&PixelRow::of_parts(y, spans, touched, full));
}

/// Some samples of four pixels side by side.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Window {
    /// The first pixel.
    pub(crate) x: i32,
    /// All bits of the pixels that are meant, sixteen each, those of the first pixel lowest.
    pub(crate) live: u64,
    /// The samples of these that are covered.
    pub(crate) masks: u64,
}

/// Calls `visit` with windows that hold each pixel from `xs.start` to `xs.end` once, and what the spans of a row of pixels
/// cover there. No window begins beyond `last`. `ends` says which ends of spans may lie in these pixels.
#[inline(always)]
#[expect(clippy::inline_always, reason = "faster where `ends` is known")]
pub(crate) fn each_window<S: Simd>(
    simd: S,
    spans: &[Span],
    (xs, last): (Span, i32),
    ends: Ends,
    mut visit: impl FnMut(Window),
) {
    let Some([a, b, c, d]) = spans.first_chunk::<ROWS>() else {
        return;
    };
    let starts = i32x4::simd_from(simd, [a.start, b.start, c.start, d.start]);
    let endings = i32x4::simd_from(simd, [a.end, b.end, c.end, d.end]);
    let mut from = xs.start;
    while from < xs.end {
        let x = from.min(last);
        let end = xs.end.min(x + WINDOW);
        let live = u64::MAX >> (16 * (WINDOW - (end - from))) << (16 * (from - x));
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

/// The samples of a window of pixels from pixel `x` on that lie before a column of the frame, one for each sample row:
/// from the lowest bits on the masks of the pixels.
#[inline(always)]
#[expect(clippy::inline_always, reason = "vector instructions reach inlined code only")]
fn before<S: Simd>(simd: S, columns: i32x4<S>, x: i32) -> u64 {
    let number = |number: i32| i32x4::splat(simd, number);
    let inside = (columns - number(x * SIDE)).max(number(0)).min(number(COLUMNS));
    // A byte for each sample of a pixel: four times the number of its row.
    let twice = inside | inside << 8;
    let rows: i8x16<S> = (twice | twice << 16).bitcast();
    let samples = i8x64::simd_from(simd, SAMPLE_COLUMNS);
    samples.simd_lt(i8x64::block_splat(rows)).to_bitmask()
}

/// Lets the slots from number `start` to `end` be the same one.
#[inline(always)]
#[expect(clippy::inline_always, reason = "a few instructions for every row of pixels")]
#[expect(clippy::cast_possible_truncation, reason = "places in a row of 64")]
pub(crate) fn fill(slots: &mut [Slot], start: usize, end: usize, slot: Slot) {
    let Ok(row) = <&mut [Slot; ROW]>::try_from(&mut *slots) else {
        return slots[start..end].fill(slot);
    };
    // All of them anew: how many there are nobody can foresee, and vectors hold so few.
    let (start, length) = (start as Slot, (end - start) as Slot);
    for (at, shown) in (0..).zip(row) {
        let inside = Slot::wrapping_sub(at, start) < length;
        *shown = if inside { slot } else { *shown };
    }
}

#[cfg(test)]
mod tests {
    use arbtest::arbitrary::{Result, Unstructured};

    use super::*;

    /// Columns around those of a tile of some pixels, more than fit a window.
    fn span(u: &mut Unstructured<'_>) -> Result<Span> {
        if u.ratio(1, 8)? {
            return Ok(Span::EMPTY);
        }
        let start = u.int_in_range(-20..=180)?;
        Ok(Span {
            start,
            end: start + u.int_in_range(0..=200)?,
        })
    }

    #[test]
    fn rows_of_pixels_hold_the_samples_of_their_spans() {
        arbtest::arbtest(|u| {
            let spans = [span(u)?, span(u)?, span(u)?, span(u)?];
            let start = u.int_in_range(0..=9)?;
            let columns = Span {
                start,
                end: start + u.int_in_range(1..=33)?,
            };
            let mut found = vec![0_u64; 64];
            let place = |x: i32| usize::try_from(x).expect("in the tile");
            each(7, &spans, columns, &mut |row: &PixelRow<'_>| {
                assert_eq!(row.y, 7, "the row that was asked for");
                assert_eq!(row.touched.intersection(columns), row.touched, "in the tile");
                let mut add = |x: i32, mask| found[place(x)] |= mask;
                (row.full.start..row.full.end).for_each(|x| add(x, 0xFFFF));
                if row.full.is_empty() {
                    each_mask(row.spans(), row.touched, Ends::Both, &mut add);
                } else {
                    let (before, after) = row.beside_full();
                    each_mask(row.spans(), before, Ends::Left, |x, mask| {
                        assert!(mask != 0 && mask != 0xFFFF, "covered in part");
                        add(x, mask);
                    });
                    each_mask(row.spans(), after, Ends::Right, |x, mask| {
                        assert!(mask != 0 && mask != 0xFFFF, "covered in part");
                        add(x, mask);
                    });
                }
            });
            for (x, found) in (0..).zip(&found) {
                let bit = |i: i32| {
                    let Span { start, end } = spans[place(i / SIDE)];
                    let inside = (start..end).contains(&(x * SIDE + i % SIDE));
                    u64::from(inside && (columns.start..columns.end).contains(&x)) << i
                };
                let expected = (0..16).map(bit).sum::<u64>();
                assert_eq!(*found, expected, "pixel {x} in {columns:?} of {spans:?}");
            }
            Ok(())
        })
        .budget_ms(300);
    }

    #[test]
    fn slots_are_filled_from_start_to_end() {
        for length in [ROW, 40] {
            for start in 0..=length {
                for end in start..=length {
                    let mut slots: Vec<Slot> = (100..).take(length).collect();
                    let mut expected = slots.clone();
                    expected[start..end].fill(9);
                    fill(&mut slots, start, end, 9);
                    assert_eq!(slots, expected, "{start} to {end} of {length}");
                }
            }
        }
    }
}
