//! Rows of pixels with 2 x 2 or 4 x 4 samples, the commonest rates above one: as in [`super::pixel_rows`], but with few
//! instructions.
//!
//! Spans are not cut to the tile; only the pixels are. The masks of four neighbouring pixels are made as one word, so
//! that nothing is clamped pixel by pixel. Where a pixel has two sample rows, they are looked at as rows 0, 1, 0 and 1 of
//! four: whatever is found of four rows is found of two.

use std::ops::Range;

use fearless_simd::prelude::*;
use fearless_simd::{Simd, i8x16, i8x64, i32x4, mask32x4, u32x4, u64x2};

use crate::raster::coverage::span_rows::{Batch, SpanRows};
use crate::raster::span::{Span, SpanRect, to_index};
use crate::raster::surface_id::{GROUP, LAST_GROUP};

/// Bits that a mask has in a word: room for 4 x 4 samples.
const MASK_BITS: usize = 16;
const _: () = assert!(GROUP * MASK_BITS == 64, "the masks of a window fit one word");

/// Rows of pixels that are looked at together: as many as tiles have.
const BATCH: usize = 32;

/// Some samples of a row of a tile's pixels, of `SIDE` x `SIDE` samples each: two or four along a side.
#[derive(Clone, Debug)]
pub(crate) struct TileRow<'a, const SIDE: usize> {
    /// The row, counted from the tile's first.
    pub(crate) y: usize,
    /// Covered sample columns of the frame; spans may reach beyond the tile.
    pub(crate) spans: &'a [Span; SIDE],
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

/// The samples of a pixel with `SIDE` of them along a side.
struct Samples<const SIDE: usize>;

impl<const SIDE: usize> Samples<SIDE> {
    /// As a number of sample columns.
    const ALONG: i32 = match SIDE {
        2 => 2,
        4 => 4,
        _ => panic!("a row of pixels is looked at as four sample rows"),
    };

    /// A shift to the right divides by it.
    const SHIFT: u32 = SIDE.trailing_zeros();

    /// The bits of a window's masks that stand for samples.
    const BITS: u64 = if SIDE == 2 { 0x000F_000F_000F_000F } else { u64::MAX };
}

/// The sample column of each bit of the masks of four pixels of 4 x 4 samples.
const COLUMNS_OF_FOUR: [i8; 64] = {
    let mut columns = [0; 64];
    let mut bit = 0;
    while bit < 64_u8 {
        columns[bit as usize] = (bit / 16 * 4 + bit % 4).cast_signed();
        bit += 1;
    }
    columns
};

/// Of 2 x 2 samples.
const COLUMNS_OF_TWO: [i8; 16] = [0, 1, 0, 1, 2, 3, 2, 3, 4, 5, 4, 5, 6, 7, 6, 7];

/// The spans of two sample rows twice, or of four.
#[inline(always)]
#[expect(clippy::inline_always, reason = "a few instructions for every row of pixels")]
fn four<const SIDE: usize>(spans: &[Span; SIDE]) -> [Span; 4] {
    [spans[0], spans[1], spans[2 % SIDE], spans[3 % SIDE]]
}

/// Calls `paint` for every row of pixels of the tile `rect` of which the shape with these rows covers any sample, from top to
/// bottom. A row in which a sample row has several spans comes several times, each time with one of them.
#[inline(always)]
#[expect(clippy::inline_always, reason = "what paints is to be seen by the compiler")]
pub(in crate::raster) fn each_row<S: Simd, const SIDE: usize>(
    simd: S,
    rows: &mut impl SpanRows,
    rect: SpanRect,
    mut paint: impl FnMut(&TileRow<'_, SIDE>),
) {
    let (mut lines, mut ys) = ([[Span::EMPTY; SIDE]; BATCH], [0; BATCH]);
    loop {
        let count = rows.take(Batch {
            side: Samples::<SIDE>::ALONG,
            lines: lines.as_flattened_mut(),
            ys: &mut ys,
        });
        let rows = &lines[..count.next_multiple_of(2)];
        let y = |i: usize| to_index(ys[i % BATCH] - rect.y.start);
        each(simd, rows, rect.x, y, &mut paint);
        if count < BATCH {
            return;
        }
        lines.fill([Span::EMPTY; SIDE]);
    }
}

/// Calls `paint` for each of an even number of rows of pixels of which any pixel in `columns` is touched; `y_of` tells
/// the numbers of rows.
#[inline(always)]
#[expect(clippy::inline_always, reason = "a few instructions for every row of pixels")]
fn each<S: Simd, const SIDE: usize>(
    simd: S,
    rows: &[[Span; SIDE]],
    columns: Span,
    y_of: impl Fn(usize) -> usize,
    paint: &mut impl FnMut(&TileRow<'_, SIDE>),
) {
    // The outer and the inner ends of two rows at a time.
    let (mut outer, mut inner) = ([[0; 4]; BATCH / 2], [[0; 4]; BATCH / 2]);
    for ((two, outer), inner) in rows.as_chunks::<2>().0.iter().zip(&mut outer).zip(&mut inner) {
        [*outer, *inner] = ends(simd, two, columns);
    }
    let (outer, inner) = (outer.as_flattened().as_chunks().0, inner.as_flattened().as_chunks().0);
    for (i, ((spans, outer), inner)) in rows.iter().zip(outer).zip(inner).enumerate() {
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
fn ends<S: Simd, const SIDE: usize>(simd: S, rows: &[[Span; SIDE]; 2], columns: Span) -> [[u32; 4]; 2] {
    let vector = |numbers: [i32; 4]| i32x4::simd_from(simd, numbers);
    let (upper, lower) = (least_and_most(simd, &rows[0]), least_and_most(simd, &rows[1]));
    let narrow = |vector: u64x2<S>| vector.bitcast::<i32x4<S>>();
    let least = narrow(upper.0.zip_low(lower.0)).min(narrow(upper.0.zip_high(lower.0)));
    let most = narrow(upper.1.zip_low(lower.1)).max(narrow(upper.1.zip_high(lower.1)));
    let starts = mask32x4::from_bitmask(simd, 0b0101);
    let left = columns.start * Samples::<SIDE>::ALONG;
    let width = i32x4::splat(simd, columns.end - columns.start);
    let pixels = |samples: i32x4<S>, [start, end]: [i32; 2]| {
        let pixels = (samples + vector([start - left, end - left, start - left, end - left])) >> Samples::<SIDE>::SHIFT;
        let inside = pixels.max(i32x4::splat(simd, 0)).min(width);
        inside.bitcast::<u32x4<S>>().to_array()
    };
    [
        pixels(starts.select(least, most), [0, Samples::<SIDE>::ALONG - 1]),
        pixels(starts.select(most, least), [Samples::<SIDE>::ALONG - 1, 0]),
    ]
}

/// The least and the greatest starts and ends of two sample rows each, which alternate; then, of both, those of all four.
#[inline(always)]
#[expect(clippy::inline_always, reason = "vector instructions reach inlined code only")]
fn least_and_most<S: Simd, const SIDE: usize>(simd: S, spans: &[Span; SIDE]) -> (u64x2<S>, u64x2<S>) {
    let [a, b, c, d] = four(spans);
    let first = i32x4::simd_from(simd, [a.start, a.end, b.start, b.end]);
    let second = i32x4::simd_from(simd, [c.start, c.end, d.start, d.end]);
    (first.min(second).bitcast(), first.max(second).bitcast())
}

impl<const SIDE: usize> TileRow<'_, SIDE> {
    /// The pixels that are covered in part beside those that are full, of which there must be some.
    #[inline(always)]
    #[expect(clippy::inline_always, reason = "a few instructions for every row of pixels")]
    pub(crate) fn beside_full(&self) -> (Range<usize>, Range<usize>) {
        (self.touched.start..self.full.start, self.full.end..self.touched.end)
    }
}

/// Calls `visit` with windows that hold each of the pixels `xs` of a row once; `ends` says which ends of spans may lie in
/// these pixels.
#[inline(always)]
#[expect(clippy::inline_always, reason = "faster where `ends` is known")]
pub(crate) fn each_window<S: Simd, const SIDE: usize>(
    simd: S,
    row: &TileRow<'_, SIDE>,
    xs: Range<usize>,
    ends: Ends,
    mut visit: impl FnMut(Window),
) {
    let [a, b, c, d] = four(row.spans);
    let vector = |numbers: [i32; 4]| i32x4::simd_from(simd, numbers);
    let (upper, lower) = (
        vector([a.start, a.end, b.start, b.end]),
        vector([c.start, c.end, d.start, d.end]),
    );
    let left = i32x4::splat(simd, row.left * Samples::<SIDE>::ALONG);
    let (starts, endings) = (upper.unzip_low(lower) - left, upper.unzip_high(lower) - left);
    let mut from = xs.start;
    while from < xs.end {
        let x = from.min(LAST_GROUP);
        let end = xs.end.min(x + GROUP);
        // At least one pixel and at most four.
        let live = u64::MAX >> (MASK_BITS * (GROUP - (end - from)) % 64) << (MASK_BITS * (from - x) % 64);
        let masks = match ends {
            Ends::Left => !before::<S, SIDE>(simd, starts, x),
            Ends::Right => before::<S, SIDE>(simd, endings, x),
            Ends::Both => before::<S, SIDE>(simd, endings, x) & !before::<S, SIDE>(simd, starts, x),
        };
        visit(Window {
            x,
            live,
            masks: masks & Samples::<SIDE>::BITS & live,
        });
        from = end;
    }
}

/// The samples of a window of pixels from pixel `x` on that lie before a column, one for each sample row: from the lowest
/// bits on the masks of the pixels, of which only [`Samples::BITS`] count.
#[inline(always)]
#[expect(clippy::inline_always, reason = "vector instructions reach inlined code only")]
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_possible_wrap,
    reason = "a place in a row of 64"
)]
fn before<S: Simd, const SIDE: usize>(simd: S, columns: i32x4<S>, x: usize) -> u64 {
    let number = |number: i32| i32x4::splat(simd, number);
    let inside = (columns - number((x * SIDE) as i32))
        .max(number(0))
        .min(number((GROUP * SIDE) as i32));
    let twice = inside | inside << 8;
    if SIDE == 2 {
        // A byte for each sample of a pixel: twice the number of its row.
        let first: u64x2<S> = twice.bitcast();
        let both = (first | first >> 16) & u64::from(u32::MAX);
        let rows: i8x16<S> = (both | both << 32).bitcast();
        let bits = i8x16::simd_from(simd, COLUMNS_OF_TWO).simd_lt(rows).to_bitmask();
        // From four bits for each pixel to sixteen.
        return (bits | bits << 12 | bits << 24 | bits << 36) & Samples::<SIDE>::BITS;
    }
    // Four times the number of its row.
    let rows: i8x16<S> = (twice | twice << 16).bitcast();
    let samples = i8x64::simd_from(simd, COLUMNS_OF_FOUR);
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
    fn masks<S: Simd, const SIDE: usize>(simd: S, rows: &[[Span; SIDE]; 2], columns: Span) -> [[u64; ROW]; 2] {
        let all = u64::MAX >> (64 - SIDE * SIDE);
        let mut found = [[0; ROW]; 2];
        each(simd, rows, columns, |i| i, &mut |row: &TileRow<'_, SIDE>| {
            assert_eq!(row.spans, &rows[row.y], "its spans");
            let mut times = [0; ROW];
            let mut add = |window: Window, partial: bool| {
                assert!(window.x <= LAST_GROUP, "in the row");
                for i in 0..GROUP {
                    let bits = |word: u64| word >> (16 * i) & 0xFFFF;
                    let (live, mask) = (bits(window.live), bits(window.masks));
                    assert!(live == 0 || live == 0xFFFF, "all of a pixel or nothing");
                    assert_eq!(mask & !live, 0, "what is not meant is not covered");
                    assert!(!partial || live == 0 || mask != 0 && mask != all, "covered in part");
                    times[window.x + i] += live / 0xFFFF;
                    found[row.y][window.x + i] |= mask;
                }
            };
            if row.full.is_empty() {
                each_window(simd, row, row.touched.clone(), Ends::Both, |window| {
                    add(window, false);
                });
            } else {
                let (before, after) = row.beside_full();
                each_window(simd, row, before, Ends::Left, |window| add(window, true));
                each_window(simd, row, after, Ends::Right, |window| add(window, true));
                for x in row.full.clone() {
                    times[x] += 1;
                    found[row.y][x] = all;
                }
            }
            for (x, times) in times.iter().enumerate() {
                assert_eq!(*times, u64::from(row.touched.contains(&x)), "how often pixel {x} comes");
            }
        });
        found
    }

    /// Looks at two rows of pixels with any spans.
    fn check<const SIDE: usize>(u: &mut Unstructured<'_>) -> Result<()> {
        let mut rows = [[Span::EMPTY; SIDE]; 2];
        for line in rows.as_flattened_mut() {
            *line = span(u)?;
        }
        let start = u.int_in_range(0..=9)?;
        let columns = Span {
            start,
            end: start + u.int_in_range(1..=64)?,
        };
        let side = Samples::<SIDE>::ALONG;
        let expected = rows.map(|spans| {
            std::array::from_fn(|x| {
                let x = columns.start + i32::try_from(x).expect("in the row");
                let bit = |i: i32| {
                    let Span { start, end } = spans[to_index(i / side)];
                    let inside = (start..end).contains(&(x * side + i % side));
                    u64::from(inside && x < columns.end) << i
                };
                (0..side * side).map(bit).sum::<u64>()
            })
        });
        for (name, level) in simd::tested() {
            let mut found = dispatch!(level, simd => masks(simd, &rows, columns));
            // Windows may look beyond the tile's right side, where nobody looks.
            for row in &mut found {
                row[to_index(columns.end - columns.start)..].fill(0);
            }
            assert_eq!(found, expected, "{name}: {columns:?} of {rows:?}");
        }
        Ok(())
    }

    #[test]
    fn rows_of_pixels_hold_the_samples_of_their_spans_on_every_level() {
        arbtest::arbtest(|u| {
            check::<2>(u)?;
            check::<4>(u)
        })
        .budget_ms(900);
    }
}
