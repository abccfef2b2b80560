//! The coverage of rows of pixels, with any number of samples: whole pixels, and a mask for each of the others.
//!
//! ```text
//!      . . . | . # # | # # # | # # .
//!      . . # | # # # | # # # | # . .      pixels touched: 0 to 3, full: 2
//!      . # # | # # # | # # # | . . .
//! ```

use crate::raster::coverage::covered::Covered;
use crate::raster::coverage::span_rows::{Batch, MAX_SIDE, SpanRows};
use crate::raster::sampling::mask::SampleMask;
use crate::raster::span::Span;

/// Most samples along the side of a pixel whose bits fit one word.
const NARROW: usize = 8;

/// Which ends of spans may lie in a pixel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Sides {
    Left,
    Right,
    Both,
}

/// Calls `visit` with what `rows` cover of the pixels `columns`, of `side` x `side` samples each: from top to bottom, each
/// time with the row of pixels. A pixel may come several times, with other samples each time.
#[inline]
pub(in crate::raster) fn each_covered(
    rows: &mut impl SpanRows,
    side: i32,
    columns: Span,
    visit: impl FnMut(i32, Covered),
) {
    match side {
        2 => each_of_side::<2>(rows, side, columns, visit),
        3 => each_of_side::<3>(rows, side, columns, visit),
        _ => each_of_side::<ANY>(rows, side, columns, visit),
    }
}

/// Any number of samples along the side of a pixel.
const ANY: usize = 0;

/// As [`each_covered`] where the compiler knows the side, if it is not [`ANY`]: the rows of a pixel are no loops then.
#[inline(always)]
#[expect(clippy::inline_always, reason = "what paints is to be seen by the compiler")]
fn each_of_side<const SIDE: usize>(
    rows: &mut impl SpanRows,
    side: i32,
    columns: Span,
    mut visit: impl FnMut(i32, Covered),
) {
    let (mut lines, mut ys) = ([Span::EMPTY; MAX_SIDE], [0; MAX_SIDE]);
    let in_pixel = if SIDE == ANY {
        side.cast_unsigned() as usize
    } else {
        SIDE
    };
    let room = MAX_SIDE / in_pixel;
    let divisor = Divisor::new(side.cast_unsigned());
    loop {
        let count = rows.take(Batch {
            side,
            lines: &mut lines[..room * in_pixel],
            ys: &mut ys[..room],
        });
        for (spans, y) in lines.chunks_exact(in_pixel).zip(&ys[..count]) {
            pixel_row::<SIDE>(
                spans,
                divisor,
                columns,
                #[inline(always)]
                |covered| visit(*y, covered),
            );
        }
        if count < room {
            return;
        }
        lines.fill(Span::EMPTY);
    }
}

/// Divides by the same number over and over. With plain divisions, rates 25 and 64 take 2 % longer, and what surrounds them
/// grows so much that it is inlined no more: jitter then costs 12 to 16 % more instructions.
///
/// After Granlund and Montgomery, "Division by Invariant Integers using Multiplication" (1994), section 4.
#[derive(Clone, Copy, Debug)]
struct Divisor {
    by: u32,
    /// `2^32 / by`, rounded up.
    reciprocal: u64,
}

impl Divisor {
    /// By a number of samples along the side of a pixel, 1 to 16.
    fn new(by: u32) -> Self {
        let by = by.max(1);
        Self {
            by,
            reciprocal: (1_u64 << 32).div_ceil(by.into()),
        }
    }

    /// The quotient, rounded down. Exact below `2^28`, since what the reciprocal is too large by stays under a sixteenth.
    #[inline]
    fn quotient(self, of: u32) -> u32 {
        ((u64::from(of) * self.reciprocal) >> 32) as u32
    }
}

/// Calls `visit` with what spans, one for each sample row, cover of the pixels `columns` in a row.
#[inline]
fn pixel_row<const SIDE: usize>(spans: &[Span], divisor: Divisor, columns: Span, mut visit: impl FnMut(Covered)) {
    let spans = if SIDE == ANY { spans } else { &spans[..SIDE] };
    if let [only] = *spans {
        let whole = only.intersection(columns);
        if !whole.is_empty() {
            visit(Covered::Whole(whole));
        }
        return;
    }
    let (mut outer, mut inner) = (spans[0], spans[0]);
    for span in &spans[1..] {
        outer = outer.union(*span);
        inner = inner.intersection(*span);
    }
    // Columns of a frame are never negative, so that division rounds down.
    let side = divisor.by;
    let (first, last) = (columns.start * side.cast_signed(), columns.end * side.cast_signed());
    let inside = |column: i32| column.clamp(first, last).cast_unsigned();
    let down = |column: i32| divisor.quotient(inside(column)).cast_signed();
    let up = |column: i32| divisor.quotient(inside(column) + (side - 1)).cast_signed();
    let (start, end) = (down(outer.start), up(outer.end));
    if start >= end {
        return;
    }
    let full = Span {
        start: up(inner.start),
        end: down(inner.end),
    };
    if inner.is_empty() || full.is_empty() {
        for x in start..end {
            let mask = mask(x, spans, Sides::Both);
            // The first word tells nearly always, and is at hand: reading all of them as one vector right after they were
            // written one by one would wait for memory.
            if mask.low() != 0 || (spans.len() > NARROW && !mask.is_empty()) {
                visit(Covered::Part(x, mask));
            }
        }
        return;
    }
    // Beside pixels that are full, each holds some covered samples, and none holds all.
    for x in start..full.start {
        visit(Covered::Part(x, mask(x, spans, Sides::Left)));
    }
    for x in full.end..end {
        visit(Covered::Part(x, mask(x, spans, Sides::Right)));
    }
    visit(Covered::Whole(full));
}

/// The samples that spans, one for each sample row, cover in the pixel of column `x`.
#[inline(always)]
#[expect(
    clippy::inline_always,
    reason = "a few instructions for every row of samples on an edge"
)]
fn mask(x: i32, spans: &[Span], sides: Sides) -> SampleMask {
    let side = spans.len();
    let width = i32::try_from(side).unwrap_or(1);
    let left = x * width;
    let all = (1_u64 << width) - 1;
    let up_to = |column: i32| (1_u64 << (column - left).clamp(0, width)) - 1;
    let of_row = |span: &Span| match sides {
        Sides::Left => all & !up_to(span.start),
        Sides::Right => up_to(span.end),
        Sides::Both => up_to(span.end) & !up_to(span.start),
    };
    if side <= NARROW {
        let bits = spans.iter().rev().fold(0, |bits, span| bits << width | of_row(span));
        return SampleMask::of_bits(bits);
    }
    let mut mask = SampleMask::default();
    for (span, first) in spans.iter().zip((0..).step_by(side)) {
        mask.add(first, of_row(span));
    }
    mask
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn divisors_divide_every_column_of_a_frame() {
        for by in 1..=16 {
            let divisor = Divisor::new(by);
            let last = 65_536 * by + by;
            let steps = (0..last).step_by(977).chain(last - 1000..last).chain(0..1000);
            for of in steps.chain([(1 << 28) - 1]) {
                assert_eq!(divisor.quotient(of), of / by, "{of} / {by}");
            }
        }
    }
}
