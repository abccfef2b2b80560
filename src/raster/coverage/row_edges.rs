//! The edges of an outline, one row of pixels after the other, where samples lie anywhere in their pixels.
//!
//! What an edge is like in a row follows from the row above by additions: an edge is set up once for all rows of a tile.
//!
//! ```text
//!      from      to
//!       |        |
//!     - - - - - / - -      a row of pixels: between these two the edge may have samples on both sides
//!     - - - / - - - -
//! ```

#![expect(
    clippy::inline_always,
    reason = "a function that is not inlined into its dispatch loses the vector instructions"
)]

use crate::geometry::edge::edge_value;
use crate::geometry::subpixel::{GridPoint, SubpixelGrid};
use crate::raster::coverage::edge_bounds::{Line, MARGIN};
use crate::raster::coverage::polygon::{OutlineEdge, OutlineWithEdges};
use crate::raster::coverage::sample_lanes::EdgeSteps;
use crate::raster::span::{Span, SpanRect};

/// The edges of one outline in the row at work, reusing its memory.
#[derive(Debug)]
pub(super) struct RowEdges {
    grid: SubpixelGrid,
    columns: Span,
    /// All edges of the rows that were begun with, by their first row, and how many of them were reached.
    all: Vec<LiveEdge>,
    reached: usize,
    /// Those of the rows above that go on below.
    live: Vec<LiveEdge>,
    here: Vec<RowEdge>,
}

/// An edge that crosses the next row of pixels.
#[derive(Clone, Copy, Debug)]
struct LiveEdge {
    line: Line,
    /// As in [`RowEdge`], in the next row.
    value: i64,
    steps: EdgeSteps,
    /// The rows of samples that it crosses, in the frame.
    rows: Span,
    winding: i32,
}

/// An edge in a row of pixels, the lattice rows that it crosses there, and the pixels that it may cross.
#[derive(Clone, Copy, Debug)]
pub(super) struct RowEdge {
    /// The edge function at the first point of the row's pixel in column 0, and its steps: not below zero where the edge does not
    /// lie right of a sample.
    value: i64,
    pub(super) steps: EdgeSteps,
    pub(super) rows: Span,
    pub(super) winding: i32,
    pub(super) from: i32,
    pub(super) to: i32,
}

impl RowEdges {
    pub(super) fn new(grid: SubpixelGrid) -> Self {
        Self {
            grid,
            columns: Span::EMPTY,
            all: Vec::new(),
            reached: 0,
            live: Vec::new(),
            here: Vec::new(),
        }
    }

    /// Begins with an outline in some rows of pixels, of which only some columns count.
    #[inline(always)]
    pub(super) fn begin(&mut self, outline: OutlineWithEdges<'_>, area: SpanRect) {
        let (grid, side) = (self.grid, self.grid.side());
        let rows = Span {
            start: area.y.start * side,
            end: area.y.end * side,
        };
        (self.columns, self.reached) = (area.x, 0);
        self.live.clear();
        self.all.clear();
        let edges = outline.edges_in(rows);
        self.all
            .extend(edges.map(|(edge, inside)| LiveEdge::new(grid, edge, inside)));
        if self.all.len() > 1 {
            self.all.sort_unstable_by_key(|edge| edge.rows.start);
        }
    }

    /// Goes to row `y` of pixels; rows follow each other from the first on that was begun with.
    #[inline(always)]
    pub(super) fn go_to(&mut self, y: i32) {
        let Self {
            grid,
            columns,
            all,
            reached,
            live,
            here,
        } = self;
        let rows = Span {
            start: y * grid.side(),
            end: (y + 1) * grid.side(),
        };
        here.clear();
        let mut next = 0;
        while let Some(edge) = live.get_mut(next) {
            here.push(edge.in_rows(*grid, rows, *columns));
            if edge.rows.end > rows.end {
                next += 1;
            } else {
                live.swap_remove(next);
            }
        }
        while let Some(edge) = all.get_mut(*reached)
            && edge.rows.start < rows.end
        {
            *reached += 1;
            here.push(edge.in_rows(*grid, rows, *columns));
            if edge.rows.end > rows.end {
                live.push(*edge);
            }
        }
        match &mut here[..] {
            [] | [_] => {}
            [first, second] => {
                if second.from < first.from {
                    std::mem::swap(first, second);
                }
            }
            more => more.sort_unstable_by_key(|edge| edge.from),
        }
    }

    /// The edges of the row, by the first pixel that each may cross.
    #[inline(always)]
    pub(super) fn here(&self) -> &[RowEdge] {
        &self.here
    }
}

impl LiveEdge {
    /// An edge that crosses these rows of samples.
    #[inline(always)]
    fn new(grid: SubpixelGrid, edge: &OutlineEdge, rows: Span) -> Self {
        let side = grid.side();
        let first = GridPoint {
            x: grid.sample_coordinate(0),
            y: grid.sample_coordinate(rows.start.div_euclid(side) * side),
        };
        Self {
            line: Line::new(edge.top, edge.bottom),
            // What the function gains from sample to sample are multiples of their distance: divided by that, and rounded
            // down, the side does not change. Downwards, the right of the edge on the screen is where it is negative.
            value: -edge_value(edge.top, edge.bottom, first) >> grid.bits(),
            steps: EdgeSteps::new(edge.bottom.y - edge.top.y, edge.top.x - edge.bottom.x),
            rows,
            winding: edge.winding,
        }
    }

    /// What it is like in a row of pixels, whose rows of samples those are, and on to the next.
    #[inline(always)]
    fn in_rows(&mut self, grid: SubpixelGrid, rows: Span, columns: Span) -> RowEdge {
        let Self {
            line,
            value,
            steps,
            rows: own,
            winding,
        } = *self;
        self.value += i64::from(steps.down) * i64::from(grid.side());
        let inside = own.intersection(rows);
        let at = |row| line.at(f64::from(grid.sample_coordinate(row)));
        let (first, last) = (at(inside.start), at(inside.end - 1));
        // Exact where pixels have as many units as a power of two, and else far less off than the margin.
        let per_unit = grid.units_per_pixel().recip();
        RowEdge {
            value,
            steps,
            rows: Span {
                start: inside.start - rows.start,
                end: inside.end - rows.start,
            },
            winding,
            from: pixel((first.min(last) - MARGIN) * per_unit, columns),
            to: pixel((first.max(last) + MARGIN) * per_unit, columns),
        }
    }
}

impl RowEdge {
    /// The edge function at the first point of the row's pixel in column `x`, where pixels have so many columns.
    #[inline(always)]
    pub(super) fn value_at(&self, x: i32, side: i32) -> i64 {
        self.value + i64::from(self.steps.right) * i64::from(x) * i64::from(side)
    }
}

/// The pixel that holds a column; just before the first of `columns` or just after the last at most.
#[inline]
#[expect(clippy::cast_possible_truncation, reason = "clamped to the pixels of a frame")]
fn pixel(column: f64, columns: Span) -> i32 {
    let pixel = column.clamp(f64::from(columns.start) - 1.0, f64::from(columns.end));
    // Rounded down: `floor` is not a single instruction on every machine.
    (pixel + 1.0) as i32 - 1
}
