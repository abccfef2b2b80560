//! The outline of a polygon: its edges on the sub-pixel grid, and which samples they enclose.
//!
//! In each sample row the edges that cross it are sorted by the first sample column at or right of the crossing; between
//! two of them all samples are wound around equally often. An edge crosses the rows from the first at or below its top
//! up to, but not including, its bottom. That is the top-left rule: shapes that share an edge share no sample of it, and
//! leave none out, whether they are triangles or polygons.

use std::ops::Range;

use glam::DVec2;

use crate::geometry::FillRule;
use crate::geometry::clip::{clip_edge, in_guard};
use crate::geometry::edge::EdgeWalker;
use crate::geometry::subpixel::{GridPoint, SubpixelGrid};
use crate::raster::coverage::mask8x8::{SMALL, SampleBox, SmallCoverage};
use crate::raster::coverage::simple_polygon_rows::{Crossings, PlainRows};
use crate::raster::coverage::triangle::Span;

/// Most crossings of edges and rows that are held at once, where a row has no more: 16 MB.
const MAX_CROSSINGS: usize = 1 << 22;

/// A polygon in a chunk.
#[derive(Clone, Debug)]
pub(crate) struct Outline {
    /// Its edges among those of the chunk, by their first rows.
    edges: Range<usize>,
    /// The box of its samples, in the frame; never empty.
    pub(crate) samples: SampleBox,
    pub(crate) rule: FillRule,
    /// The most rows that an edge crosses.
    tallest: i32,
}

/// An edge of a polygon that crosses any sample row of the frame.
#[derive(Clone, Copy, Debug)]
pub(crate) struct OutlineEdge {
    pub(crate) top: GridPoint,
    pub(crate) bottom: GridPoint,
    /// The sample rows that it crosses, in the frame.
    pub(crate) rows: Span,
    /// 1 where it runs downwards, -1 where it runs upwards.
    pub(crate) winding: i32,
}

/// Gathers the edges of one polygon.
#[derive(Debug)]
pub(crate) struct OutlineBuilder<'a> {
    grid: SubpixelGrid,
    frame: SampleBox,
    edges: &'a mut Vec<OutlineEdge>,
    start: usize,
    low: GridPoint,
    high: GridPoint,
    /// Whether all points so far are finite.
    finite: bool,
}

/// The samples that an outline encloses in some rows.
#[derive(Clone, Copy, Debug)]
pub(crate) struct RowSpans<'a> {
    /// The rows.
    pub(crate) rows: Span,
    /// Where the spans of each row begin, and one more; of no account where they are single.
    starts: &'a [u32],
    spans: &'a [Span],
    /// Whether each row has one, empty or not.
    pub(crate) single: bool,
}

/// Finds [`RowSpans`], reusing its memory.
#[derive(Debug, Default)]
pub(crate) struct RowScanner {
    numbers: Crossings,
    plain: PlainRows,
    /// Where the crossings of each row begin.
    next: Vec<u32>,
    /// Crossings row by row: the column, doubled, and one more where the edge runs downwards.
    crossings: Vec<i32>,
}

/// Where a [`RowScanner`] puts what it finds.
#[derive(Debug, Default)]
pub(crate) struct SpanStore {
    starts: Vec<u32>,
    spans: Vec<Span>,
}

/// What was put there for one outline.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Stored {
    rows: Span,
    /// Its first span, and its first number in `starts`.
    span: usize,
    first: usize,
    single: bool,
}

impl<'a> OutlineBuilder<'a> {
    /// Adds edges that touch the samples of `frame` to `edges`.
    pub(crate) fn new(grid: SubpixelGrid, frame: SampleBox, edges: &'a mut Vec<OutlineEdge>) -> Self {
        let everywhere = |at: i32| GridPoint { x: at, y: at };
        Self {
            grid,
            frame,
            start: edges.len(),
            edges,
            low: everywhere(i32::MAX),
            high: everywhere(i32::MIN),
            finite: true,
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
            for ends in clip_edge([from.point, to.point]) {
                let [from, to] = ends.map(|end| self.grid.snap(end));
                self.snapped(from, to);
            }
        }
    }

    #[inline]
    fn snapped(&mut self, from: GridPoint, to: GridPoint) {
        for end in [from, to] {
            self.low.x = self.low.x.min(end.x);
            self.low.y = self.low.y.min(end.y);
            self.high.x = self.high.x.max(end.x);
            self.high.y = self.high.y.max(end.y);
        }
        let (top, bottom, winding) = if from.y < to.y { (from, to, 1) } else { (to, from, -1) };
        let rows = Span {
            start: self.grid.sample_at_or_after(top.y),
            end: self.grid.sample_at_or_after(bottom.y),
        };
        let rows = rows.intersection(self.frame.rows);
        // What crosses right of the frame winds around nothing in it.
        if rows.is_empty() || self.grid.sample_at_or_after(from.x.min(to.x)) >= self.frame.columns.end {
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
        let span = |low: i32, high: i32| Span {
            start: self.grid.sample_at_or_after(low),
            end: self.grid.sample_at_or_after(high),
        };
        let edges = &mut self.edges[self.start..];
        if edges.is_empty() {
            return None;
        }
        let samples = SampleBox {
            columns: span(self.low.x, self.high.x),
            rows: span(self.low.y, self.high.y),
        }
        .intersection(self.frame);
        if !self.finite || samples.columns.is_empty() || samples.rows.is_empty() {
            self.edges.truncate(self.start);
            return None;
        }
        edges.sort_unstable_by_key(|edge| edge.rows.start);
        let tallest = edges.iter().map(|edge| edge.rows.end - edge.rows.start).max();
        Some(Outline {
            edges: self.start..self.edges.len(),
            samples,
            rule,
            tallest: tallest.unwrap_or(0),
        })
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

impl Outline {
    /// The edges that may cross any of `rows`; `all` are those of the chunk.
    #[inline]
    pub(crate) fn edges_in<'c>(
        &self,
        all: &'c [OutlineEdge],
        rows: Span,
    ) -> impl Iterator<Item = (&'c OutlineEdge, Span)> + Clone + use<'c> {
        let edges = &all[self.edges.clone()];
        // Few are looked at faster than searched.
        let edges = if edges.len() > 16 {
            let first = edges.partition_point(|edge| edge.rows.start + self.tallest <= rows.start);
            let last = edges.partition_point(|edge| edge.rows.start < rows.end);
            &edges[first..last.max(first)]
        } else {
            edges
        };
        edges.iter().filter_map(move |edge| {
            let inside = edge.rows.intersection(rows);
            (!inside.is_empty()).then_some((edge, inside))
        })
    }

    /// Removes the edges of an outline that nobody needs, the newest one of the chunk.
    pub(crate) fn drop_edges(self, all: &mut Vec<OutlineEdge>) {
        all.truncate(self.edges.start);
    }

    /// What an outline of a few samples covers, if those of each row lie side by side; `None` for any other.
    pub(crate) fn small_coverage(
        &self,
        all: &[OutlineEdge],
        grid: SubpixelGrid,
        scanner: &mut (RowScanner, SpanStore),
    ) -> Option<SmallCoverage> {
        if !self.samples.is_small() {
            return None;
        }
        let (scanner, store) = scanner;
        store.clear();
        let SampleBox { columns, rows } = self.samples;
        let stored = scanner.scan(self, (all, grid), (rows, columns.end), store);
        let found = store.get(stored);
        if !found.single {
            return None;
        }
        let mut mask = 0;
        for row in rows.start..rows.end {
            for span in found.of_row(row) {
                let inside = span.intersection(columns);
                if !inside.is_empty() {
                    let bits = (1_u64 << (inside.end - inside.start)) - 1;
                    mask |= bits << (SMALL * (row - rows.start) + inside.start - columns.start);
                }
            }
        }
        Some(SmallCoverage {
            column: columns.start,
            row: rows.start,
            mask,
        })
    }
}

impl RowScanner {
    /// Finds the samples that an outline encloses in those of `rows` that its box has, left of the frame's end at column
    /// `end`; `all` are the edges of its chunk.
    pub(crate) fn scan(
        &mut self,
        outline: &Outline,
        (all, grid): (&[OutlineEdge], SubpixelGrid),
        (rows, end): (Span, i32),
        store: &mut SpanStore,
    ) -> Stored {
        let rows = rows.intersection(outline.samples.rows);
        let (span, first) = (store.spans.len(), store.starts.len());
        let mut single = true;
        // All rows at once, unless so many edges might cross them that nobody would want to hold it.
        let step = i32::try_from(MAX_CROSSINGS / outline.edges.len().max(1));
        let step = step.unwrap_or(i32::MAX).max(1);
        let mut start = rows.start;
        while start < rows.end {
            let some = Span {
                start,
                end: rows.end.min(start.saturating_add(step)),
            };
            let edges = outline.edges_in(all, some);
            self.numbers.count(edges.clone(), some);
            if some == rows && self.numbers.are_plain() {
                self.plain.scan(edges, grid, (rows, end), &mut store.spans);
                break;
            }
            self.sort_crossings(edges, grid, some, end);
            single &= self.spans_of_rows(outline.rule, end, store);
            start = some.end;
        }
        store.starts.push(index(store.spans.len()));
        Stored {
            rows,
            span,
            first,
            single,
        }
    }

    /// Adds the spans of the rows whose crossings were found; whether no row has more than one.
    fn spans_of_rows(&mut self, rule: FillRule, end: i32, store: &mut SpanStore) -> bool {
        let mut single = true;
        let mut from = 0;
        for to in &self.next {
            let before = store.spans.len();
            store.starts.push(index(before));
            let to = *to as usize;
            let crossings = &mut self.crossings[from..to];
            from = to;
            if let [a, b] = crossings {
                // Of two that cross a row, one runs up and one down; or else both wind around what is between.
                let span = Span {
                    start: (*a).min(*b) >> 1,
                    end: (*a).max(*b) >> 1,
                };
                if (*a ^ *b) & 1 != 0 {
                    store.spans.push(if span.is_empty() { Span::EMPTY } else { span });
                    continue;
                }
            }
            crossings.sort_unstable();
            enclosed(crossings, rule, end, &mut store.spans);
            match store.spans.len() - before {
                0 => store.spans.push(Span::EMPTY),
                found => single &= found == 1,
            }
        }
        single
    }

    /// Finds where edges cross `rows`: after that `next` holds where the crossings of each row end.
    fn sort_crossings<'c>(
        &mut self,
        edges: impl Iterator<Item = (&'c OutlineEdge, Span)> + Clone,
        grid: SubpixelGrid,
        rows: Span,
        end: i32,
    ) {
        self.next.clear();
        let mut total = 0;
        self.next.extend(self.numbers.numbers().map(|number| {
            let first = total;
            total += number;
            first
        }));
        self.crossings.clear();
        self.crossings.resize(total as usize, 0);
        for (edge, inside) in edges {
            let mut walker = EdgeWalker::new(grid, edge.top, edge.bottom, inside.start);
            let down = i32::from(edge.winding > 0);
            let (first, last) = (place(inside.start - rows.start), place(inside.end - rows.start));
            for next in &mut self.next[first..last] {
                self.crossings[*next as usize] = walker.at_or_after().clamp(0, end) << 1 | down;
                *next += 1;
                walker.step();
            }
        }
    }
}

/// Adds the spans between sorted crossings that a rule calls inside.
fn enclosed(crossings: &[i32], rule: FillRule, end: i32, spans: &mut Vec<Span>) {
    let (mut winding, mut start) = (0, 0);
    let first = spans.len();
    let mut add = |span: Span| match spans.get_mut(first..).and_then(<[Span]>::last_mut) {
        Some(last) if last.end == span.start => last.end = span.end,
        _ if span.is_empty() => {}
        _ => spans.push(span),
    };
    for crossing in crossings {
        let column = crossing >> 1;
        if rule.encloses(winding) {
            add(Span { start, end: column });
        }
        winding += (crossing & 1) * 2 - 1;
        start = column;
    }
    if rule.encloses(winding) {
        add(Span { start, end });
    }
}

impl SpanStore {
    /// Forgets everything.
    pub(crate) fn clear(&mut self) {
        self.starts.clear();
        self.spans.clear();
    }

    /// Stores spans that are known, those of each of some rows.
    #[cfg(test)]
    pub(crate) fn put(&mut self, rows: Span, spans: &[Vec<Span>]) -> Stored {
        let (span, first) = (self.spans.len(), self.starts.len());
        for spans in spans {
            self.starts.push(index(self.spans.len()));
            self.spans.extend(spans);
        }
        self.starts.push(index(self.spans.len()));
        Stored {
            rows,
            span,
            first,
            single: spans.iter().all(|spans| spans.len() == 1),
        }
    }

    /// Stores one span for each of some rows, empty or not.
    pub(crate) fn put_single(&mut self, rows: Span, of_row: impl FnMut(i32) -> Span) -> Stored {
        let span = self.spans.len();
        self.spans.extend((rows.start..rows.end).map(of_row));
        Stored {
            rows,
            span,
            first: 0,
            single: true,
        }
    }

    /// How many spans there are.
    pub(crate) fn len(&self) -> usize {
        self.spans.len()
    }

    /// What was stored.
    #[inline]
    pub(crate) fn get(&self, stored: Stored) -> RowSpans<'_> {
        let count = place(stored.rows.end - stored.rows.start);
        let (starts, spans): (&[u32], &[Span]) = if stored.single {
            (&[], &self.spans[stored.span..stored.span + count])
        } else {
            (&self.starts[stored.first..=stored.first + count], &self.spans)
        };
        RowSpans {
            rows: stored.rows,
            starts,
            spans,
            single: stored.single,
        }
    }
}

impl<'a> RowSpans<'a> {
    /// The spans of some of the rows, row by row.
    #[inline]
    pub(crate) fn of_rows(&self, start: i32, end: i32) -> &'a [Span] {
        let [start, end] = [start, end].map(|row| place(row - self.rows.start));
        if self.single {
            return &self.spans[start..end];
        }
        &self.spans[self.starts[start] as usize..self.starts[end] as usize]
    }

    /// The spans of one of the rows, from left to right; a single empty one where there are none.
    #[inline]
    pub(crate) fn of_row(&self, row: i32) -> &'a [Span] {
        self.of_rows(row, row + 1)
    }
}

/// A distance that is never negative.
#[inline]
fn place(distance: i32) -> usize {
    distance.max(0).cast_unsigned() as usize
}

/// Far fewer than `2^32`: stores are cleared long before.
#[inline]
fn index(value: usize) -> u32 {
    u32::try_from(value).unwrap_or(u32::MAX)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn plain_rows_hold_what_sorting_finds() {
        let (mut plain, mut sorted) = (0, 0);
        arbtest::arbtest(|u| {
            let grid = SubpixelGrid::new(u.int_in_range(1..=4)?);
            let extent = |end| Span { start: 0, end };
            let frame = SampleBox {
                columns: extent(40),
                rows: extent(60),
            };
            let mut edges = Vec::new();
            let mut builder = OutlineBuilder::new(grid, frame, &mut edges);
            for _ in 0..u.int_in_range(1..=2)? {
                let mut point = || {
                    let mut eighths = |most: i32| Ok(f64::from(u.int_in_range(-20..=most)?) / 8.0);
                    Ok(DVec2::new(eighths(400)?, eighths(600)?))
                };
                let points = (0..4)
                    .map(|_| point())
                    .collect::<arbtest::arbitrary::Result<Vec<_>>>()?;
                builder.contour(points.into_iter());
            }
            let rule = *u.choose(&[FillRule::NonZero, FillRule::EvenOdd])?;
            let Some(outline) = builder.finish(rule) else {
                return Ok(());
            };
            let start = u.int_in_range(0..=59)?;
            let rows = Span {
                start,
                end: u.int_in_range(start + 1..=60)?,
            }
            .intersection(outline.samples.rows);
            if rows.is_empty() {
                return Ok(());
            }
            let (mut scanner, mut store) = (RowScanner::default(), SpanStore::default());
            let end = frame.columns.end;
            let found = scanner.scan(&outline, (&edges, grid), (rows, end), &mut store);
            scanner.numbers.count(outline.edges_in(&edges, rows), rows);
            if scanner.numbers.are_plain() {
                plain += 1;
            } else {
                sorted += 1;
            }
            let mut oracle = SpanStore::default();
            scanner.sort_crossings(outline.edges_in(&edges, rows), grid, rows, end);
            let single = scanner.spans_of_rows(rule, end, &mut oracle);
            oracle.starts.push(index(oracle.spans.len()));
            assert_eq!(found.single, single, "whether rows have one span: {edges:?}");
            let expected = Stored {
                rows,
                single,
                ..Stored::default()
            };
            for row in rows.start..rows.end {
                let (found, expected) = (store.get(found).of_row(row), oracle.get(expected).of_row(row));
                assert_eq!(found, expected, "row {row} of {edges:?}");
            }
            Ok(())
        })
        .budget_ms(500);
        assert!(
            plain > 20 && sorted > 20,
            "both kinds were looked at: {plain} and {sorted}"
        );
    }
}
