//! What shapes cover in one row of tiles: the one door through which painters get coverage.

use fearless_simd::Simd;

use crate::geometry::subpixel::SubpixelGrid;
use crate::raster::coverage::covered::Covered;
use crate::raster::coverage::float_shape::FloatShape;
use crate::raster::coverage::free_positions::FreePositions;
use crate::raster::coverage::outline_cache::OutlineCache;
use crate::raster::coverage::pixel_rows::each_covered;
use crate::raster::coverage::pixel_rows_4x4::{SIDE, TileRow, each_row};
use crate::raster::coverage::polygon_rows::{RowScanner, RowSpans, SpanStore, Stored};
use crate::raster::coverage::shape::{MAX_SPANS, OutlineOf, Shape};
use crate::raster::coverage::span_rows::{MAX_SIDE, MaskRows, StoredRows, TriangleRows};
use crate::raster::span::{PixelRect, Span, scaled};
use crate::rules::Rules;

/// Remembers the spans of outlines in the tile row at work.
#[derive(Debug)]
pub(crate) struct ShapeRows {
    /// By whose rules triangles cover samples.
    settings: (SubpixelGrid, Rules),
    /// Columns of samples in the frame.
    columns: i32,
    found: OutlineCache<Stored>,
    scanner: RowScanner,
    store: SpanStore,
    /// Memory for the spans of a single triangle.
    single: SpanStore,
    /// Finds what is covered where samples are not those of the grid.
    free_positions: Option<Box<FreePositions>>,
}

impl ShapeRows {
    /// For a drawing of `outlines` outlines in a frame with `columns` columns of samples, which are those of the grid.
    pub(crate) fn new(settings: (SubpixelGrid, Rules), columns: i32, outlines: usize) -> Self {
        Self {
            settings,
            columns,
            found: OutlineCache::new(outlines),
            scanner: RowScanner::default(),
            store: SpanStore::default(),
            single: SpanStore::default(),
            free_positions: None,
        }
    }

    /// The same for samples that are not those of the grid.
    pub(crate) fn with(self, free_positions: FreePositions) -> Self {
        Self {
            free_positions: Some(Box::new(free_positions)),
            ..self
        }
    }

    /// Calls `visit` with what the shape covers in the tile `rect`, from top to bottom, each time with the row of pixels: each
    /// sample once, and a pixel as often as a sample row has spans in it.
    #[inline]
    pub(crate) fn each(&mut self, shape: Shape<'_>, rect: PixelRect, mut visit: impl FnMut(i32, Covered)) {
        let side = self.settings.0.side();
        match shape {
            Shape::Tile => (rect.y.start..rect.y.end).for_each(|y| visit(y, Covered::Whole(rect.x))),
            Shape::Pixels(pixels) => pixels
                .moved(rect.x.start, rect.y.start)
                .each_run(|y, xs| visit(y, Covered::Whole(xs))),
            _ if let Some(free_positions) = &mut self.free_positions => free_positions.each(shape, rect, visit),
            Shape::Samples(samples) => {
                let samples = samples.moved(rect.x.start * side, rect.y.start * side);
                each_covered(&mut MaskRows::new(samples), side, rect.x, visit);
            }
            Shape::Triangle(corners) => TriangleRows::of(*corners, self.settings, rect, |rows| {
                each_covered(rows, side, rect.x, visit);
            }),
            Shape::Outline(_) | Shape::Float(_) => {
                let mut rows = StoredRows::<MAX_SIDE>::new(self.stored(shape, rect), side, rect);
                each_covered(&mut rows, side, rect.x, visit);
            }
        }
    }

    /// As [`ShapeRows::each`] for a triangle or polygon on the grid where a pixel has 4 x 4 samples, by rows of pixels, without
    /// a call for each.
    #[inline(always)]
    #[expect(clippy::inline_always, reason = "what paints is to be seen by the compiler")]
    pub(crate) fn each_row_of_four<S: Simd>(
        &mut self,
        simd: S,
        (shape, rect): (Shape<'_>, PixelRect),
        paint: impl FnMut(&TileRow<'_>),
    ) {
        debug_assert_eq!(self.settings.0.side(), SIDE, "4 x 4 samples");
        if let Shape::Triangle(corners) = shape {
            return TriangleRows::of(
                *corners,
                self.settings,
                rect,
                #[inline(always)]
                |rows| each_row(simd, rows, rect, paint),
            );
        }
        let mut rows = StoredRows::<4>::new(self.stored(shape, rect), SIDE, rect);
        each_row(simd, &mut rows, rect, paint);
    }

    /// The spans of an outline, or of a triangle by the rules of first drafts.
    #[inline]
    fn stored(&mut self, shape: Shape<'_>, rect: PixelRect) -> RowSpans<'_> {
        match shape {
            Shape::Outline(outline) => self.of_outline(outline, rect.y),
            Shape::Float(float) => self.of_float(float, rect),
            _ => RowSpans::EMPTY,
        }
    }

    /// The spans in one tile.
    fn of_float(&mut self, float: &FloatShape, rect: PixelRect) -> RowSpans<'_> {
        let grid = self.settings.0;
        let (columns, rows) = (scaled(rect.x, grid.side()), scaled(rect.y, grid.side()));
        let rows = rows.intersection(float.samples.rows);
        self.single.clear();
        let stored = self.single.put_single(rows, |row| float.span(grid, row, columns));
        self.single.get(stored)
    }

    fn of_outline(&mut self, of: OutlineOf<'_>, rows: Span) -> RowSpans<'_> {
        if self.found.go_to(rows, self.store.len() > MAX_SPANS) {
            self.store.clear();
        }
        let stored = self.found.get_or(of.number, || {
            let grid = self.settings.0;
            let rows = (scaled(rows, grid.side()), self.columns);
            self.scanner.scan(of.outline, (of.edges, grid), rows, &mut self.store)
        });
        self.store.get(stored)
    }
}

#[cfg(test)]
mod tests {
    use arbtest::arbitrary::{Result, Unstructured};
    use glam::DVec2;

    use super::*;
    use crate::geometry::FillRule;
    use crate::geometry::edge::{EdgeTest, doubled_area};
    use crate::geometry::subpixel::GridPoint;
    use crate::raster::coverage::mask8x8::CoverageMask;
    use crate::raster::coverage::polygon::OutlineBuilder;
    use crate::raster::sampling::positions::{Position, SamplePositions, lattice};
    use crate::raster::span::{SampleBox, to_index};
    use crate::raster::{SamplePattern, SampleRate};

    /// Pixels of the frame, and the tile that is looked at.
    const FRAME: [i32; 2] = [14, 11];
    const RECT: PixelRect = PixelRect {
        x: Span { start: 2, end: 11 },
        y: Span { start: 1, end: 10 },
    };

    /// A contour whose corners lie on a lattice full of ties, or anywhere.
    fn contour(u: &mut Unstructured<'_>, corners: usize, grid: SubpixelGrid) -> Result<Vec<DVec2>> {
        let step = 1.0 / f64::from(if u.arbitrary()? { 2 * grid.side() } else { 1 << 9 });
        let mut at = |pixels: i32| {
            let most = f64::from(pixels + 2) / step;
            let number: u32 = u.arbitrary()?;
            Ok((f64::from(number) / f64::from(u32::MAX) * most).floor() * step - 1.0)
        };
        (0..corners)
            .map(|_| Ok(DVec2::new(at(FRAME[0])?, at(FRAME[1])?)))
            .collect()
    }

    /// How often a contour winds around a sample: an edge counts that crosses the sample's row at or left of it.
    fn winding(contour: &[GridPoint], sample: GridPoint) -> i32 {
        let of = |[from, to]: [GridPoint; 2]| {
            let (top, bottom, winding) = if from.y < to.y { (from, to, 1) } else { (to, from, -1) };
            let wide = |a: i32, b: i32| i64::from(a) - i64::from(b);
            let crosses = top.y <= sample.y && sample.y < bottom.y;
            let is_left =
                wide(bottom.x, top.x) * wide(sample.y, top.y) <= wide(sample.x, top.x) * wide(bottom.y, top.y);
            if crosses && is_left { winding } else { 0 }
        };
        let next = contour.iter().cycle().skip(1);
        contour.iter().zip(next).map(|(from, to)| of([*from, *to])).sum()
    }

    /// Looks at every sample of the tile, which must be covered once where `inside` says so, by its lattice column and row.
    fn check(
        (rows, shape): (&mut ShapeRows, Shape<'_>),
        positions: &SamplePositions,
        inside: impl Fn([i32; 2]) -> bool,
        what: &dyn std::fmt::Debug,
    ) {
        let (width, count) = (RECT.x.length(), positions.count());
        let mut found = vec![vec![0; count]; width * RECT.y.length()];
        let at = |x: i32, y: i32| to_index(y - RECT.y.start) * width + to_index(x - RECT.x.start);
        rows.each(shape, RECT, |y, covered| match covered {
            Covered::Whole(xs) => {
                assert!(!xs.is_empty(), "a run has pixels: {what:?}");
                for x in xs.start..xs.end {
                    found[at(x, y)].iter_mut().for_each(|sample| *sample += 1);
                }
            }
            Covered::Part(x, mask) => {
                assert!(
                    !mask.is_empty() && mask.count() < count,
                    "neither none nor all: {what:?}"
                );
                mask.each(|sample| found[at(x, y)][sample] += 1);
            }
        });
        let side = rows.settings.0.side();
        for y in RECT.y.start..RECT.y.end {
            for x in RECT.x.start..RECT.x.end {
                let place = |[column, row]: Position| [x * side + i32::from(column), y * side + i32::from(row)];
                let places = positions.of_pixel([x, y], &mut Vec::new()).to_vec();
                let expected: Vec<i32> = places.iter().map(|at| i32::from(inside(place(*at)))).collect();
                assert_eq!(found[at(x, y)], expected, "pixel {x}, {y} of {what:?}");
            }
        }
    }

    #[test]
    fn every_shape_covers_the_samples_inside_it_at_any_rate_in_any_pattern() {
        let mut kinds = [0; 4];
        arbtest::arbtest(|u| {
            let pattern = *u.choose(&SamplePattern::ALL)?;
            let rate = if pattern.needs_square() {
                *u.choose(&[1, 4, 9, 16, 25, 49, 64, 81, 144, 256])?
            } else {
                *u.choose(&[1, 2, 7, 16, 63, 64, 65, 130, 256])?
            };
            let rate = SampleRate::new(rate).expect("a rate");
            let grid = lattice(pattern, rate);
            let frame = SampleBox {
                columns: Span {
                    start: 0,
                    end: FRAME[0] * grid.side(),
                },
                rows: Span {
                    start: 0,
                    end: FRAME[1] * grid.side(),
                },
            };
            let positions = SamplePositions::new(pattern, rate);
            let rules = *u.choose(&Rules::ALL)?;
            let mut rows = ShapeRows::new((grid, rules), frame.columns.end, 1);
            if pattern != SamplePattern::Grid {
                let columns = Span {
                    start: 0,
                    end: FRAME[0],
                };
                rows = rows.with(FreePositions::new((grid, rules), positions.clone(), 1, columns));
            }
            let sample = |at: [i32; 2]| {
                let [x, y] = at.map(|at| grid.sample_coordinate(at));
                GridPoint { x, y }
            };
            let kind = u.int_in_range(0..=3)?;
            let corners = if kind == 1 { u.int_in_range(3..=9)? } else { 3 };
            let points = contour(u, corners, grid)?;
            let snapped: Vec<GridPoint> = points.iter().map(|point| grid.snap(*point)).collect();
            let what = (pattern, rate, rules, &points);
            match kind {
                0 => {
                    let corners = [snapped[0], snapped[1], snapped[2]];
                    let inside = |at| {
                        let tests = EdgeTest::of_triangle(corners, sample(at));
                        doubled_area(corners) != 0 && tests.iter().all(|test| test.is_inside(rules))
                    };
                    check((&mut rows, Shape::Triangle(&corners)), &positions, inside, &what);
                }
                1 => {
                    let mut edges = Vec::new();
                    let mut builder = OutlineBuilder::new(grid, frame, &mut edges);
                    builder.contour(points.iter().copied());
                    let rule = *u.choose(&[FillRule::NonZero, FillRule::EvenOdd])?;
                    let Some(outline) = builder.finish(rule) else {
                        return Ok(());
                    };
                    let of = OutlineOf {
                        outline: &outline,
                        edges: &edges,
                        number: 0,
                    };
                    let inside = |at| rule.encloses(winding(&snapped, sample(at)));
                    check((&mut rows, Shape::Outline(of)), &positions, inside, &(what, rule));
                }
                2 => {
                    let Some(float) = FloatShape::new([points[0], points[1], points[2]], grid, frame) else {
                        return Ok(());
                    };
                    check(
                        (&mut rows, Shape::Float(&float)),
                        &positions,
                        |at| float.covers(grid, at),
                        &what,
                    );
                }
                _ => {
                    // Only on the grid, and all in the tile.
                    if pattern != SamplePattern::Grid {
                        return Ok(());
                    }
                    let small = SampleBox {
                        columns: scaled(RECT.x, grid.side()),
                        rows: scaled(RECT.y, grid.side()),
                    };
                    let (column, row) = (
                        u.int_in_range(small.columns.start..=small.columns.end - 1)?,
                        u.int_in_range(small.rows.start..=small.rows.end - 1)?,
                    );
                    let mut mask = 0;
                    for row in 0..8 {
                        let bits = u64::MAX >> u.int_in_range(57..=63)? << u.int_in_range(0..=1)?;
                        mask |= (if row == 0 || u.ratio(2, 3)? { bits & 0xFF } else { 0 }) << (8 * row);
                    }
                    let stamp = CoverageMask { column, row, mask }.within(small.columns, small.rows);
                    let inside = |[x, y]: [i32; 2]| {
                        let (x, y) = (x - stamp.column, y - stamp.row);
                        (0..8).contains(&x) && (0..8).contains(&y) && stamp.mask >> (8 * y + x) & 1 == 1
                    };
                    let in_tile = stamp.moved(-small.columns.start, -small.rows.start);
                    check((&mut rows, Shape::Samples(in_tile)), &positions, inside, &(what, stamp));
                }
            }
            kinds[to_index(kind)] += 1;
            Ok(())
        })
        .budget_ms(2000);
        assert!(kinds.iter().all(|found| *found > 20), "each kind of shape: {kinds:?}");
    }
}
