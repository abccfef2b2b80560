//! An outline in a row of tiles: the tiles it touches and those it covers, without looking at any sample.
//!
//! An edge lies in the tiles between the columns where it crosses the first sample row and the last, widened as in
//! `coverage::edge_bounds`. The tiles right of it are wound around once more in the rows it crosses. So a tile in which no
//! edge lies is wound around alike everywhere, once each row counts the same edges left of it.

use crate::geometry::FillRule;
use crate::geometry::subpixel::SubpixelGrid;
use crate::raster::coverage::edge_bounds::{Line, MARGIN};
use crate::raster::coverage::polygon::{OutlineEdge, OutlineWithEdges};
use crate::raster::coverage::windings::RowWindings;
use crate::raster::span::{Reach, Span, to_index};

/// Looks at rows of tiles, reusing its memory.
#[derive(Debug, Default)]
pub(crate) struct OutlineTiles {
    columns: Vec<Column>,
    /// Edges that cross only some of the rows: the first tile column to their right, those rows, and the winding.
    partial: Vec<(i32, Span, i32)>,
    /// Memory to sort them by these columns.
    sorted: Vec<(i32, Span, i32)>,
    /// Where those of each column belong.
    next: Vec<usize>,
    /// How often each row winds around the tile at work, beyond what all rows do.
    rows: RowWindings,
}

/// A row of tiles, of which some may be touched.
#[derive(Clone, Copy, Debug)]
pub(crate) struct TileStrip {
    /// The sample rows that are painted for it.
    pub(crate) rows: Span,
    /// The columns of the tiles that may be touched.
    pub(crate) tiles: Span,
    /// How wide a tile is, in units of the grid, and by how much what is painted for it reaches into the next.
    pub(crate) width: f64,
    pub(crate) overlap: f64,
}

/// What changes at a tile.
#[derive(Clone, Copy, Debug, Default)]
struct Column {
    /// Edges that begin to lie in tiles here, less those that end to.
    lying: i32,
    /// The windings of the edges that lie left of this tile, and of no tile before, and cross all rows.
    winding: i32,
}

impl OutlineTiles {
    /// Calls `visit` with the column of each tile of a strip that the outline may touch.
    pub(crate) fn each(
        &mut self,
        outline: OutlineWithEdges<'_>,
        grid: SubpixelGrid,
        strip: TileStrip,
        visit: impl FnMut(i32, Reach),
    ) {
        let crossing = |edge: &OutlineEdge, inside: Span| {
            let line = Line::new(edge.top, edge.bottom);
            let at = |row| line.at(f64::from(grid.sample_coordinate(row)));
            ([at(inside.start), at(inside.end - 1)], inside)
        };
        self.walk(outline, strip, crossing, visit);
    }

    /// The same for an outline of what it touches, in a strip of rows of pixels: tiles in which no edge lies are wound around as
    /// the middles of their pixels are.
    pub(crate) fn each_touched(
        &mut self,
        outline: OutlineWithEdges<'_>,
        grid: SubpixelGrid,
        strip: TileStrip,
        visit: impl FnMut(i32, Reach),
    ) {
        let [top, bottom] = [strip.rows.start, strip.rows.end].map(|row| row << grid.bits());
        let crossing = |edge: &OutlineEdge, _| {
            let ends = if edge.top.y == edge.bottom.y {
                [edge.top.x, edge.bottom.x].map(f64::from)
            } else {
                let line = Line::new(edge.top, edge.bottom);
                [edge.top.y.max(top), edge.bottom.y.min(bottom)].map(|y| line.at(f64::from(y)))
            };
            (ends, edge.sample_rows(grid).intersection(strip.rows))
        };
        self.walk(outline, strip, crossing, visit);
    }

    /// Finds the tiles by what `crossing` tells of an edge and the rows that it has in the strip: the columns where it enters and
    /// leaves them, and the rows in which tiles to its right are wound around.
    #[inline]
    fn walk(
        &mut self,
        outline: OutlineWithEdges<'_>,
        strip: TileStrip,
        crossing: impl Fn(&OutlineEdge, Span) -> ([f64; 2], Span),
        visit: impl FnMut(i32, Reach),
    ) {
        let TileStrip {
            rows: all_rows,
            tiles,
            width,
            overlap,
        } = strip;
        self.columns.clear();
        let count = (tiles.end - tiles.start).max(0).cast_unsigned() as usize;
        self.columns.resize(count + 1, Column::default());
        self.partial.clear();
        for (edge, inside) in outline.edges_in(all_rows) {
            let ([first, last], inside) = crossing(edge, inside);
            let from = tile(first.min(last) - MARGIN - overlap, width, tiles);
            let to = tile(first.max(last) + MARGIN, width, tiles);
            if from >= tiles.end {
                continue;
            }
            let right = (to + 1).clamp(tiles.start, tiles.end);
            self.columns[to_index(from - tiles.start)].lying += 1;
            self.columns[to_index(right - tiles.start)].lying -= 1;
            if inside == all_rows {
                self.columns[to_index(right - tiles.start)].winding += edge.winding;
            } else if !inside.is_empty() {
                self.partial.push((right, inside, edge.winding));
            }
        }
        self.sweep(outline.outline.rule, all_rows, tiles, visit);
    }

    fn sweep(&mut self, rule: FillRule, all_rows: Span, tiles: Span, mut visit: impl FnMut(i32, Reach)) {
        let (mut lying, mut winding) = (0, 0);
        self.sort_partial(tiles.start);
        let mut partial = self.partial.as_slice();
        self.rows.begin(all_rows.end - all_rows.start);
        let from_first = |rows: Span| Span {
            start: rows.start - all_rows.start,
            end: rows.end - all_rows.start,
        };
        for (column, tile) in self.columns.iter().zip(tiles.start..tiles.end) {
            lying += column.lying;
            winding += column.winding;
            while let Some(((at, inside, around), rest)) = partial.split_first()
                && *at <= tile
            {
                self.rows.add(from_first(*inside), *around);
                partial = rest;
            }
            // What the partial edges add where they add the same to all rows.
            match self.rows.even() {
                _ if lying > 0 => visit(tile, Reach::Part),
                None => visit(tile, Reach::Part),
                Some(even) if rule.encloses(winding + even) => visit(tile, Reach::All),
                Some(_) => {}
            }
        }
        let passed = self.partial.len() - partial.len();
        self.rows
            .forget(self.partial[..passed].iter().map(|(_, rows, _)| from_first(*rows)));
    }

    /// Sorts the edges that cross only some of the rows by the first tile column to their right; columns begin at `first`.
    fn sort_partial(&mut self, first: i32) {
        /// So many are counted faster than compared.
        const MANY: usize = 32;
        if self.partial.len() < MANY {
            return self.partial.sort_unstable_by_key(|(column, ..)| *column);
        }
        let place = |(column, ..): &(i32, Span, i32)| to_index(column - first);
        self.next.clear();
        self.next.resize(self.columns.len(), 0);
        for edge in &self.partial {
            self.next[place(edge)] += 1;
        }
        let mut sum = 0;
        for next in &mut self.next {
            sum += std::mem::replace(next, sum);
        }
        self.sorted.clone_from(&self.partial);
        for edge in &self.partial {
            let next = &mut self.next[place(edge)];
            self.sorted[*next] = *edge;
            *next += 1;
        }
        std::mem::swap(&mut self.partial, &mut self.sorted);
    }
}

/// The tile that holds a column, in units of the grid; just before the first of `tiles` or just after the last at most.
#[inline]
#[expect(clippy::cast_possible_truncation, reason = "clamped to the tiles of a frame")]
fn tile(column: f64, width: f64, tiles: Span) -> i32 {
    let tile = (column / width).clamp(f64::from(tiles.start) - 1.0, f64::from(tiles.end));
    // Rounded down: `floor` is not a single instruction on every machine.
    (tile + 1.0) as i32 - 1
}
