//! A row of pixels in which the areas of a shape are summed up.

use crate::raster::coverage::area::edge::{AreaEdge, BITS, PIXEL, ordered};
use crate::raster::span::{Span, SpanRect, to_index};

/// A part of a pixel's area, in parts of [`Area::WHOLE`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct Area(u32);

/// Pixels side by side that are covered alike.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct CoveredArea {
    pub(crate) xs: Span,
    /// How much of each; more than nothing.
    pub(crate) area: Area,
}

impl Area {
    /// All of a pixel.
    pub(crate) const WHOLE: Self = Self(1 << 16);

    /// In parts of `2^16`.
    pub(crate) fn parts(self) -> u32 {
        self.0
    }

    /// Twice the area in units of a row: rounded to nearest.
    #[inline]
    fn of_doubled(doubled: i64) -> Self {
        /// Bits beyond the 16 that are kept.
        const MORE: u32 = 2 * BITS + 1 - 16;
        let rounded = (doubled + (1 << (MORE - 1))) >> MORE;
        Self(u32::try_from(rounded.max(0)).map_or(1 << 16, |parts| parts.min(1 << 16)))
    }
}

impl CoveredArea {
    /// The pixels, in row `y`.
    pub(crate) fn pixels(self, y: i32) -> SpanRect {
        SpanRect {
            x: self.xs,
            y: Span { start: y, end: y + 1 },
        }
    }
}

/// What edges add to one pixel.
#[derive(Clone, Copy, Debug, Default)]
struct Cell {
    /// The height that they have in it; what counts for the pixels right of it.
    height: i64,
    /// Twice the area between them and the pixel's left side.
    left: i64,
}

/// Sums up what edges add to the pixels of one row.
#[derive(Debug, Default)]
pub(super) struct AreaRow {
    columns: Span,
    cells: Vec<Cell>,
    /// A bit for each pixel to which something was added.
    touched: Vec<u64>,
    /// The height of edges left of all pixels.
    before: i64,
}

impl AreaRow {
    /// Goes to other columns of pixels; nothing may have been added and not been taken.
    pub(super) fn go_to(&mut self, columns: Span) {
        self.columns = columns;
        let count = columns.length();
        if self.cells.len() < count {
            self.cells.resize(count, Cell::default());
            self.touched.resize(count.div_ceil(64), 0);
        }
    }

    /// Adds an edge between two places on it, the upper one first, which lie in the row; `sign` is 1 where a shape begins at it
    /// and -1 where it ends.
    #[inline]
    pub(super) fn add(&mut self, edge: &AreaEdge, [from, to]: [[i64; 2]; 2], sign: i64) {
        let column = from[0] >> BITS;
        if column == to[0] >> BITS {
            return self.part(column, from, to, sign);
        }
        self.long(edge, [from, to], sign);
    }

    /// An edge through more than one column of pixels.
    #[inline(never)]
    fn long(&mut self, edge: &AreaEdge, [mut from, mut to]: [[i64; 2]; 2], sign: i64) {
        let [low, high] = [self.columns.start, self.columns.end].map(|column| i64::from(column) << BITS);
        let within = |x: i64| edge.y_at(x).clamp(from[1], to[1]);
        // What lies beside all columns is looked at once.
        let [least, greatest] = ordered(from[0], to[0]);
        let cut = |x: i64| (least < x && x < greatest).then(|| [x, within(x)]);
        let (cut_low, cut_high) = (cut(low), cut(high));
        let is_rightwards = from[0] < to[0];
        if greatest <= low {
            self.before += sign * (to[1] - from[1]);
            return;
        }
        if least >= high {
            return;
        }
        if let Some(cut) = cut_low {
            let end = if is_rightwards { &mut from } else { &mut to };
            self.before += sign * (cut[1] - end[1]).abs();
            *end = cut;
        }
        if let Some(cut) = cut_high {
            *(if is_rightwards { &mut to } else { &mut from }) = cut;
        }
        let bottom = to[1];
        // The sides of pixels that it crosses, in the order in which it does.
        let (mut side, step) = if is_rightwards {
            ((from[0] >> BITS) + 1, 1)
        } else {
            ((from[0] - 1) >> BITS, -1)
        };
        let is_left = |side: i64| {
            if is_rightwards {
                side << BITS < to[0]
            } else {
                side << BITS > to[0]
            }
        };
        while is_left(side) {
            let x = side << BITS;
            let next = [x, edge.y_at(x).clamp(from[1], bottom)];
            self.part(if is_rightwards { side - 1 } else { side }, from, next, sign);
            (from, side) = (next, side + step);
        }
        self.part(if is_rightwards { side - 1 } else { side }, from, to, sign);
    }

    /// The part of an edge that lies in one column.
    #[inline]
    fn part(&mut self, column: i64, from: [i64; 2], to: [i64; 2], sign: i64) {
        let height = sign * (to[1] - from[1]);
        if column < i64::from(self.columns.start) {
            self.before += height;
            return;
        }
        let index = usize::try_from(column - i64::from(self.columns.start)).unwrap_or(usize::MAX);
        if index >= self.columns.length() {
            return;
        }
        let left = column << BITS;
        let cell = &mut self.cells[index];
        cell.height += height;
        cell.left += height * (from[0] + to[0] - 2 * left);
        self.touched[index / 64] |= 1 << (index % 64);
    }

    /// Calls `visit` with what is covered, from left to right, and forgets it.
    #[inline]
    pub(super) fn take(&mut self, mut visit: impl FnMut(CoveredArea)) {
        let mut height = std::mem::take(&mut self.before);
        let mut start = self.columns.start;
        let mut run = |xs: Span, doubled: i64| {
            let area = Area::of_doubled(doubled);
            if area > Area(0) && !xs.is_empty() {
                visit(CoveredArea { xs, area });
            }
        };
        for (word, first) in self.touched[..self.columns.length().div_ceil(64)]
            .iter_mut()
            .zip((self.columns.start..).step_by(64))
        {
            let mut rest = std::mem::take(word);
            while rest != 0 {
                let column = first + rest.trailing_zeros().cast_signed();
                rest &= rest - 1;
                let cell = std::mem::take(&mut self.cells[to_index(column - self.columns.start)]);
                let before = Span { start, end: column };
                run(before, height * (2 * PIXEL));
                height += cell.height;
                let one = Span {
                    start: column,
                    end: column + 1,
                };
                run(one, height * (2 * PIXEL) - cell.left);
                start = column + 1;
            }
        }
        let end = self.columns.end;
        run(Span { start, end }, height * (2 * PIXEL));
    }
}
