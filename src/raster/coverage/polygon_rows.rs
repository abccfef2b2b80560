//! The samples that a polygon encloses, row by row: as spans, which are kept for all tiles of a row of tiles.

use crate::geometry::FillRule;
use crate::geometry::edge::EdgeWalker;
use crate::geometry::subpixel::SubpixelGrid;
use crate::raster::coverage::column_windings::{ColumnWindings, step};
use crate::raster::coverage::mask8x8::CoverageMask;
use crate::raster::coverage::polygon::{OutlineEdge, OutlineWithEdges};
use crate::raster::coverage::simple_polygon_rows::{Crossings, SimplePolygonRows};
use crate::raster::span::{SMALL, Span, SpanRect, to_index};

/// Most crossings of edges and rows that are held at once, where a row has no more: 16 MB.
const MAX_CROSSINGS: usize = 1 << 22;

/// So few crossings of a row are sorted in any order as fast as in a good one.
const FEW: usize = 20;

/// Edges that cross so many rows on average are sorted before they are walked down.
const LONG: usize = 16;

/// The samples that an outline encloses in some rows.
#[derive(Clone, Copy, Debug)]
pub(crate) struct RowSpans<'a> {
    /// The rows.
    pub(crate) rows: Span,
    /// Where the spans of each row begin, and one more; unused where they are single.
    starts: &'a [u32],
    spans: &'a [Span],
    /// Whether each row has one, empty or not.
    pub(crate) single: bool,
}

/// Finds [`RowSpans`], reusing its memory.
#[derive(Debug, Default)]
pub(crate) struct RowScanner {
    numbers: Crossings,
    plain: SimplePolygonRows,
    /// Where the crossings of each row begin.
    next: Vec<u32>,
    /// Crossings row by row, each as [`step()`] has them.
    crossings: Vec<i32>,
    columns: ColumnWindings,
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

impl OutlineWithEdges<'_> {
    /// What an outline of a few samples covers, if those of each row lie side by side; `None` for any other.
    pub(crate) fn coverage_mask(
        self,
        grid: SubpixelGrid,
        scanner: &mut RowScanner,
        store: &mut SpanStore,
    ) -> Option<CoverageMask> {
        let samples = self.outline.samples;
        if !samples.is_small() {
            return None;
        }
        store.clear();
        let SpanRect { x: columns, y: rows } = samples;
        let stored = scanner.scan(self, grid, samples, store);
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
        Some(CoverageMask {
            column: columns.start,
            row: rows.start,
            mask,
        })
    }
}

impl RowScanner {
    /// Finds the samples that an outline encloses in those rows of `within` that its box has, from the frame's left side to
    /// the end of the columns of `within`.
    pub(crate) fn scan(
        &mut self,
        outline: OutlineWithEdges<'_>,
        grid: SubpixelGrid,
        within: SpanRect,
        store: &mut SpanStore,
    ) -> Stored {
        let OutlineWithEdges { outline, edges: all } = outline;
        let (rows, end) = (within.y.intersection(outline.samples.y), within.x.end);
        let (span, first) = (store.spans.len(), store.starts.len());
        let mut single = true;
        let mut rest = rows;
        while !rest.is_empty() {
            let edges = outline.edges_in(all, rest);
            self.numbers.count(edges.clone(), rest);
            if rest == rows && self.numbers.are_plain() {
                self.plain
                    .scan(edges, grid, SpanRect { y: rows, ..within }, &mut store.spans);
                break;
            }
            // All rows at once, unless their crossings take too much memory.
            let some = Span {
                end: rest.start + self.rows_at_once(),
                ..rest
            };
            if some == rest {
                self.sort_crossings(edges, grid, rest, end);
            } else {
                let edges = outline.edges_in(all, some);
                self.numbers.count(edges.clone(), some);
                self.sort_crossings(edges, grid, some, end);
            }
            single &= self.spans_of_rows(outline.rule, end, store);
            rest.start = some.end;
        }
        store.starts.push(index(store.spans.len()));
        Stored {
            rows,
            span,
            first,
            single,
        }
    }

    /// So many of the rows that were counted have no more crossings together than are held at once; one at least.
    fn rows_at_once(&self) -> i32 {
        let mut room = MAX_CROSSINGS;
        let fits = |number: &u32| match room.checked_sub(*number as usize) {
            Some(left) => {
                room = left;
                true
            }
            None => false,
        };
        let count = self.numbers.numbers().take_while(fits).count();
        i32::try_from(count.max(1)).unwrap_or(i32::MAX)
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
            if sort_nearly_sorted(crossings) {
                enclosed(steps(crossings), rule, end, &mut store.spans);
            } else if ColumnWindings::suit(crossings.len(), end) {
                self.columns.add(crossings, end);
                enclosed(self.columns.take(), rule, end, &mut store.spans);
            } else {
                crossings.sort_unstable();
                enclosed(steps(crossings), rule, end, &mut store.spans);
            }
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
        let count = edges.clone().count();
        if count > FEW && total as usize / LONG >= count {
            let column = |(edge, inside): &(&OutlineEdge, Span)| {
                let middle = i32::midpoint(inside.start, inside.end - 1);
                EdgeWalker::new(grid, edge.top, edge.bottom, middle).at_or_after()
            };
            // Long edges that do not cross each other cross all rows in this order, and others nearly do.
            let mut sorted: Vec<_> = edges.map(|edge| (column(&edge), edge)).collect();
            sorted.sort_unstable_by_key(|(column, _)| *column);
            self.cross(sorted.into_iter().map(|(_, edge)| edge), grid, rows, end);
        } else {
            self.cross(edges, grid, rows, end);
        }
    }

    /// Notes the crossings of edges with `rows`, in the order of the edges.
    fn cross<'c>(
        &mut self,
        edges: impl Iterator<Item = (&'c OutlineEdge, Span)>,
        grid: SubpixelGrid,
        rows: Span,
        end: i32,
    ) {
        for (edge, inside) in edges {
            let mut walker = EdgeWalker::new(grid, edge.top, edge.bottom, inside.start);
            let down = i32::from(edge.winding > 0);
            let (first, last) = (to_index(inside.start - rows.start), to_index(inside.end - rows.start));
            for next in &mut self.next[first..last] {
                self.crossings[*next as usize] = walker.at_or_after().clamp(0, end) << 1 | down;
                *next += 1;
                walker.step();
            }
        }
    }
}

/// Sorts crossings that mostly are where they belong, or nearly there: they come contour by contour, and those of letters and
/// the like lie side by side. Whether that was so; else they are left in any order.
fn sort_nearly_sorted(crossings: &mut [i32]) -> bool {
    /// How far each may have to go, on average, and how far all in the beginning.
    const NEAR: usize = 4;
    const FAR: usize = 64;
    if crossings.len() <= FEW {
        crossings.sort_unstable();
        return true;
    }
    let mut steps = FAR;
    for i in 1..crossings.len() {
        let crossing = crossings[i];
        let mut at = i;
        while at > 0 && crossings[at - 1] > crossing {
            crossings[at] = crossings[at - 1];
            at -= 1;
        }
        crossings[at] = crossing;
        steps = match (steps + NEAR).checked_sub(i - at) {
            Some(steps) => steps,
            None => return false,
        };
    }
    true
}

/// The column of each crossing, and what it adds to the winding number.
fn steps(crossings: &[i32]) -> impl Iterator<Item = (i32, i32)> {
    crossings.iter().map(|crossing| step(*crossing))
}

/// Adds the spans that a rule calls inside; `steps` come column by column, with what each adds to the winding number.
fn enclosed(steps: impl Iterator<Item = (i32, i32)>, rule: FillRule, end: i32, spans: &mut Vec<Span>) {
    let (mut winding, mut start) = (0, 0);
    let first = spans.len();
    let mut add = |span: Span| match spans.get_mut(first..).and_then(<[Span]>::last_mut) {
        Some(last) if last.end == span.start => last.end = span.end,
        _ if span.is_empty() => {}
        _ => spans.push(span),
    };
    for (column, around) in steps {
        if rule.encloses(winding) {
            add(Span { start, end: column });
        }
        winding += around;
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
        let count = stored.rows.length();
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
    /// Nothing, in no rows.
    pub(crate) const EMPTY: Self = Self {
        rows: Span::EMPTY,
        starts: &[],
        spans: &[],
        single: true,
    };

    /// The spans of some of the rows, row by row.
    #[inline]
    pub(crate) fn of_rows(&self, start: i32, end: i32) -> &'a [Span] {
        let [start, end] = [start, end].map(|row| to_index(row - self.rows.start));
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

/// Far fewer than `2^32`: stores are cleared long before.
#[inline]
fn index(value: usize) -> u32 {
    u32::try_from(value).unwrap_or(u32::MAX)
}

#[cfg(test)]
mod tests {
    use glam::DVec2;

    use super::*;
    use crate::raster::coverage::polygon::OutlineBuilder;

    #[test]
    fn plain_rows_hold_what_sorting_finds() {
        let (mut plain, mut sorted) = (0, 0);
        arbtest::arbtest(|u| {
            let grid = SubpixelGrid::new(u.int_in_range(1..=4)?);
            let extent = |end| Span { start: 0, end };
            let frame = SpanRect {
                x: extent(40),
                y: extent(60),
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
            .intersection(outline.samples.y);
            if rows.is_empty() {
                return Ok(());
            }
            let (mut scanner, mut store) = (RowScanner::default(), SpanStore::default());
            let end = frame.x.end;
            let outline = outline.with_edges(&edges);
            let found = scanner.scan(outline, grid, SpanRect { y: rows, ..frame }, &mut store);
            scanner.numbers.count(outline.edges_in(rows), rows);
            if scanner.numbers.are_plain() {
                plain += 1;
            } else {
                sorted += 1;
            }
            let mut oracle = SpanStore::default();
            scanner.sort_crossings(outline.edges_in(rows), grid, rows, end);
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

    #[test]
    fn rows_of_too_many_crossings_are_found_a_few_at_a_time() {
        let grid = SubpixelGrid::new(1);
        let extent = |end| Span { start: 0, end };
        let (frame, edges) = (
            SpanRect {
                x: extent(90),
                y: extent(60),
            },
            80_000,
        );
        let points = (0..edges).map(|i| {
            let x = f64::from(i * 7919 % 9001) / 100.0;
            DVec2::new(x, if i % 2 == 0 { -1.0 } else { 61.0 })
        });
        let mut all = Vec::new();
        let mut builder = OutlineBuilder::new(grid, frame, &mut all);
        builder.contour(points);
        let outline = builder.finish(FillRule::EvenOdd).expect("it covers something");
        let outline = outline.with_edges(&all);
        let (mut scanner, mut store) = (RowScanner::default(), SpanStore::default());
        let found = scanner.scan(outline, grid, frame, &mut store);
        assert!(
            scanner.crossings.len() < MAX_CROSSINGS,
            "not all of them were held at once"
        );
        let mut several = 0;
        for row in frame.y.start..frame.y.end {
            let y = Span {
                start: row,
                end: row + 1,
            };
            let (mut alone, mut of_row) = (RowScanner::default(), SpanStore::default());
            let stored = alone.scan(outline, grid, SpanRect { y, ..frame }, &mut of_row);
            let expected = of_row.get(stored).of_row(row);
            several += usize::from(expected.len() > 1);
            assert_eq!(store.get(found).of_row(row), expected, "row {row}");
        }
        assert!(several > 20, "{several} rows have more than one span");
    }

    /// Contours like letters and like needles, side by side or anywhere.
    fn contour(u: &mut arbtest::arbitrary::Unstructured<'_>, number: u32) -> arbtest::arbitrary::Result<Vec<DVec2>> {
        let mut within = |from: i32, to: i32| Ok(f64::from(u.int_in_range(8 * from..=8 * to)?) / 8.0);
        let (is_letter, is_beside) = (within(0, 1)? < 0.5, within(0, 1)? < 0.8);
        let left = if is_beside {
            f64::from(number) * 9.0
        } else {
            within(-10, 190)?
        };
        let top = if is_letter { within(0, 800)? } else { within(-20, 40)? };
        let height = if is_letter { 12 } else { 900 };
        let corners = if is_letter { 9 } else { 3 };
        (0..corners)
            .map(|_| Ok(DVec2::new(left + within(0, 7)?, top + within(0, height)?)))
            .collect()
    }

    #[test]
    fn edges_in_any_order_enclose_what_their_crossings_say() {
        let (mut blocks, mut long, mut unsorted) = (0, 0, 0);
        arbtest::arbtest(|u| {
            let grid = SubpixelGrid::new(u.int_in_range(1..=2)?);
            let extent = |end| Span { start: 0, end };
            let frame = SpanRect {
                x: extent(200),
                y: extent(900),
            };
            let mut edges = Vec::new();
            let mut builder = OutlineBuilder::new(grid, frame, &mut edges);
            for number in 0..u.int_in_range(1..=24)? {
                builder.contour(contour(u, number)?.into_iter());
            }
            let rule = *u.choose(&[FillRule::NonZero, FillRule::EvenOdd])?;
            let Some(outline) = builder.finish(rule) else {
                return Ok(());
            };
            let start = u.int_in_range(0..=899)?;
            let end = u.int_in_range(start + 1..=900)?;
            let rows = Span { start, end }.intersection(outline.samples.y);
            if rows.is_empty() {
                return Ok(());
            }
            let (mut scanner, mut store) = (RowScanner::default(), SpanStore::default());
            let of_outline = outline.with_edges(&edges);
            let found = scanner.scan(of_outline, grid, SpanRect { y: rows, ..frame }, &mut store);
            let right = frame.x.end;
            for row in rows.start..rows.end {
                let crosses = |edge: &&OutlineEdge| (edge.rows.start..edge.rows.end).contains(&row);
                let crossing = |edge: &OutlineEdge| {
                    let column = EdgeWalker::new(grid, edge.top, edge.bottom, row).at_or_after();
                    column.clamp(0, right) << 1 | i32::from(edge.winding > 0)
                };
                let mut crossings: Vec<i32> = edges.iter().filter(crosses).map(crossing).collect();
                unsorted += usize::from(crossings.len() > FEW && !crossings.is_sorted());
                crossings.sort_unstable();
                let mut expected = Vec::new();
                enclosed(steps(&crossings), rule, right, &mut expected);
                if expected.is_empty() {
                    expected.push(Span::EMPTY);
                }
                assert_eq!(store.get(found).of_row(row), expected, "row {row} of {edges:?}");
            }
            let count = of_outline.edges_in(rows).count();
            let total: u32 = {
                scanner.numbers.count(of_outline.edges_in(rows), rows);
                scanner.numbers.numbers().sum()
            };
            long += usize::from(count > FEW && total as usize / LONG >= count);
            blocks += usize::from(outline.samples.y.length() > 512 && edges.len() > FEW);
            Ok(())
        })
        .budget_ms(1500);
        assert!(
            blocks > 20 && long > 20 && unsorted > 20,
            "all kinds were looked at: {blocks}, {long}, {unsorted}"
        );
    }
}
