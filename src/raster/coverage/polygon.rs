//! The outline of a polygon: its edges on the sub-pixel grid. `polygon_rows` finds the samples that they enclose.
//!
//! In each sample row the edges that cross it are sorted by the first sample column at or right of the crossing; between
//! two of them all samples are wound around equally often. An edge crosses the rows from the first at or below its top
//! up to, but not including, its bottom. That is the top-left rule: shapes that share an edge share no sample of it, and
//! leave none out, whether they are triangles or polygons.

use std::ops::Range;

use glam::DVec2;

use crate::geometry::FillRule;
use crate::geometry::clip::{clip_edge, in_guard};
use crate::geometry::subpixel::{GUARD, GridPoint, SubpixelGrid};
use crate::raster::span::{Span, SpanRect, to_index};

/// A polygon in a chunk.
#[derive(Clone, Debug)]
pub(crate) struct Outline {
    /// Its edges among those of the chunk: if there are more than [`FEW`], by the [blocks](block()) of their first rows; inside a
    /// block as they come along the contours.
    pub(in crate::raster) edges: Range<usize>,
    /// The box of its samples, in the frame; never empty.
    pub(crate) samples: SpanRect,
    pub(crate) rule: FillRule,
    /// The most rows that an edge crosses.
    tallest: i32,
}

/// An outline and the edges of its chunk, into which it points.
#[derive(Clone, Copy, Debug)]
pub(crate) struct OutlineWithEdges<'c> {
    pub(crate) outline: &'c Outline,
    pub(crate) edges: &'c [OutlineEdge],
}

/// An edge of a polygon that crosses any sample row of the frame.
#[derive(Clone, Copy, Debug)]
pub(crate) struct OutlineEdge {
    pub(crate) top: GridPoint,
    pub(crate) bottom: GridPoint,
    /// The sample rows that it crosses, in the frame; those that it touches, where the outline holds what it touches.
    pub(crate) rows: Span,
    /// 1 where it runs downwards, -1 where it runs upwards.
    pub(crate) winding: i32,
}

impl OutlineEdge {
    /// The sample rows that it crosses, in the frame or beyond it.
    pub(crate) fn sample_rows(&self, grid: SubpixelGrid) -> Span {
        Span {
            start: grid.sample_at_or_after(self.top.y),
            end: grid.sample_at_or_after(self.bottom.y),
        }
    }
}

/// Gathers the edges of one polygon.
#[derive(Debug)]
pub(crate) struct OutlineBuilder<'a> {
    grid: SubpixelGrid,
    frame: SpanRect,
    edges: &'a mut Vec<OutlineEdge>,
    start: usize,
    low: GridPoint,
    high: GridPoint,
    /// Whether all points so far are finite.
    finite: bool,
    /// What brings a coordinate to the first row or column of samples at or after it, and to the one beyond the last before it,
    /// when it is added and the bits between two samples are dropped.
    to_rows: [i32; 2],
}

impl<'a> OutlineBuilder<'a> {
    /// Adds edges that touch the samples of `frame` to `edges`.
    pub(crate) fn new(grid: SubpixelGrid, frame: SpanRect, edges: &'a mut Vec<OutlineEdge>) -> Self {
        let everywhere = |at: i32| GridPoint { x: at, y: at };
        Self {
            grid,
            frame,
            start: edges.len(),
            edges,
            low: everywhere(i32::MAX),
            high: everywhere(i32::MIN),
            finite: true,
            to_rows: [(1 << (grid.bits() - 1)) - 1; 2],
        }
    }

    /// The outline holds the edges and samples that touch anything of what lies around the samples: with one sample per pixel,
    /// anything of the pixels.
    pub(crate) fn touched(mut self) -> Self {
        self.to_rows = [0, (1 << self.grid.bits()) - 1];
        self
    }

    /// The samples between two coordinates.
    #[inline]
    fn span(&self, low: i32, high: i32) -> Span {
        let [first, end] = self.to_rows;
        Span {
            start: (low + first) >> self.grid.bits(),
            end: (high + end) >> self.grid.bits(),
        }
    }

    /// Adds a closed contour of points in screen space.
    pub(crate) fn contour(&mut self, mut points: impl Iterator<Item = DVec2>) {
        let Some(first) = points.next() else {
            return;
        };
        let start = Corner::new(self.grid, first);
        let mut from = start;
        for point in points {
            let to = Corner::new(self.grid, point);
            self.edge(from, to);
            from = to;
        }
        self.edge(from, start);
    }

    #[inline]
    fn edge(&mut self, from: Corner, to: Corner) {
        if let (Some(from), Some(to)) = (from.snapped, to.snapped) {
            self.snapped(from, to);
        } else if !(from.point.is_finite() && to.point.is_finite()) {
            self.finite = false;
        } else {
            // What is cut away winds around nothing, and yet the outline may reach that far: the sides of one around all of the
            // guard band are cut to an upright line left of it.
            let (low, high) = (DVec2::splat(GUARD.0), DVec2::splat(GUARD.1));
            for end in [from.point, to.point] {
                self.reach(self.grid.snap(end.clamp(low, high)));
            }
            for ends in clip_edge([from.point, to.point]) {
                let [from, to] = ends.map(|end| self.grid.snap(end));
                self.snapped(from, to);
            }
        }
    }

    #[inline]
    fn reach(&mut self, end: GridPoint) {
        self.low.x = self.low.x.min(end.x);
        self.low.y = self.low.y.min(end.y);
        self.high.x = self.high.x.max(end.x);
        self.high.y = self.high.y.max(end.y);
    }

    #[inline]
    fn snapped(&mut self, from: GridPoint, to: GridPoint) {
        self.reach(from);
        self.reach(to);
        let (top, bottom, winding) = if from.y < to.y { (from, to, 1) } else { (to, from, -1) };
        let rows = self.span(top.y, bottom.y).intersection(self.frame.y);
        // What crosses right of the frame winds around nothing in it.
        if rows.is_empty() || self.span(from.x.min(to.x), 0).start >= self.frame.x.end {
            return;
        }
        self.edges.push(OutlineEdge {
            top,
            bottom,
            rows,
            winding,
        });
    }

    /// The outline of all contours; `None`, and no edges, where it holds no sample of the frame or a point is not finite.
    pub(crate) fn finish(self, rule: FillRule) -> Option<Outline> {
        let (low, high) = (self.low, self.high);
        if self.edges.len() == self.start {
            return None;
        }
        let samples = SpanRect {
            x: self.span(low.x, high.x),
            y: self.span(low.y, high.y),
        }
        .intersection(self.frame);
        if !self.finite || samples.is_empty() {
            self.edges.truncate(self.start);
            return None;
        }
        let edges = &mut self.edges[self.start..];
        sort_by_blocks(edges, samples.y);
        let tallest = edges.iter().map(|edge| edge.rows.end - edge.rows.start).max();
        Some(Outline {
            edges: self.start..self.edges.len(),
            samples,
            rule,
            tallest: tallest.unwrap_or(0),
        })
    }
}

/// So few edges are looked at faster than searched, in any order.
const FEW: usize = 16;

/// The block of sample rows that a row lies in: about a row of tiles.
///
/// Edges are not sorted any finer. Contours mostly lie side by side, as letters do, and so the crossings of a row are nearly
/// sorted as they come.
#[inline]
fn block(row: i32) -> i32 {
    row >> 8
}

/// Sorts edges, whose first rows lie in `rows`, by the blocks of these; those of a block keep their order.
fn sort_by_blocks(edges: &mut [OutlineEdge], rows: Span) {
    let first = block(rows.start);
    let count = to_index(block(rows.end - 1) - first) + 1;
    let place = |edge: &OutlineEdge| to_index(block(edge.rows.start) - first);
    if count == 1 || edges.len() <= FEW || edges.is_sorted_by_key(place) {
        return;
    }
    let mut next = vec![0; count];
    for edge in &*edges {
        next[place(edge)] += 1;
    }
    let mut sum = 0;
    for next in &mut next {
        sum += std::mem::replace(next, sum);
    }
    let unsorted = edges.to_vec();
    for edge in unsorted {
        let next = &mut next[place(&edge)];
        edges[*next] = edge;
        *next += 1;
    }
}

/// A corner of a contour.
#[derive(Clone, Copy)]
struct Corner {
    point: DVec2,
    /// On the grid, where it lies in the guard band.
    snapped: Option<GridPoint>,
}

impl Corner {
    #[inline]
    fn new(grid: SubpixelGrid, point: DVec2) -> Self {
        Self {
            point,
            snapped: in_guard(point).then(|| grid.snap(point)),
        }
    }
}

impl<'c> OutlineWithEdges<'c> {
    /// The edges that may cross any of `rows`, each with those of them that it crosses.
    #[inline]
    pub(crate) fn edges_in(self, rows: Span) -> impl Iterator<Item = (&'c OutlineEdge, Span)> + Clone + use<'c> {
        self.outline.edges_in(self.edges, rows)
    }
}

impl Outline {
    /// The outline with the edges of its chunk.
    #[inline]
    pub(crate) fn with_edges<'c>(&'c self, edges: &'c [OutlineEdge]) -> OutlineWithEdges<'c> {
        OutlineWithEdges { outline: self, edges }
    }

    /// The edges that may cross any of `rows`; `all` are those of the chunk.
    #[inline]
    pub(crate) fn edges_in<'c>(
        &self,
        all: &'c [OutlineEdge],
        rows: Span,
    ) -> impl Iterator<Item = (&'c OutlineEdge, Span)> + Clone + use<'c> {
        let edges = &all[self.edges.clone()];
        let edges = if edges.len() > FEW {
            let (lowest, highest) = (block(rows.start - self.tallest + 1), block(rows.end - 1));
            let first = edges.partition_point(|edge| block(edge.rows.start) < lowest);
            let last = edges.partition_point(|edge| block(edge.rows.start) <= highest);
            &edges[first..last.max(first)]
        } else {
            edges
        };
        edges.iter().filter_map(move |edge| {
            let inside = edge.rows.intersection(rows);
            (!inside.is_empty()).then_some((edge, inside))
        })
    }

    /// Removes the edges of the chunk's newest outline, once they are no longer needed.
    pub(crate) fn drop_edges(self, all: &mut Vec<OutlineEdge>) {
        all.truncate(self.edges.start);
    }
}
