//! What shapes cover in one row of tiles: the one door through which painters get coverage.

use fearless_simd::Simd;

use crate::geometry::subpixel::SubpixelGrid;
use crate::raster::coverage::area::row::CoveredArea;
use crate::raster::coverage::area::shape_area::ShapeArea;
use crate::raster::coverage::covered::Covered;
use crate::raster::coverage::float_shape::FloatShape;
use crate::raster::coverage::free_positions::FreePositions;
use crate::raster::coverage::narrow_rows::{TileRow, each_row};
use crate::raster::coverage::outline_cache::OutlineCache;
use crate::raster::coverage::pixel_rows::each_covered;
use crate::raster::coverage::polygon_rows::{RowScanner, RowSpans, SpanStore, Stored};
use crate::raster::coverage::shape::{MAX_SPANS, NumberedOutline, Shape};
use crate::raster::coverage::span_rows::{MAX_SIDE, MaskRows, StoredRows, TriangleRows};
use crate::raster::span::{Span, SpanRect, scaled, to_index};
use crate::rules::Rules;

/// Remembers the spans of outlines in the tile row at work.
#[derive(Debug)]
pub(crate) struct ShapeCoverage {
    grid: SubpixelGrid,
    /// By which triangles cover samples.
    rules: Rules,
    /// Columns of samples in the frame.
    columns: i32,
    found: OutlineCache<Stored>,
    scanner: RowScanner,
    store: SpanStore,
    /// Memory for the spans of a single triangle.
    single: SpanStore,
    /// Finds what is covered where samples are not those of the grid.
    free_positions: Option<Box<FreePositions>>,
    /// Finds areas where those count.
    area: Option<Box<ShapeArea>>,
}

impl ShapeCoverage {
    /// For a drawing of `outlines` outlines in a frame with `columns` columns of samples, which are those of the grid.
    pub(crate) fn new(grid: SubpixelGrid, rules: Rules, columns: i32, outlines: usize) -> Self {
        Self {
            grid,
            rules,
            columns,
            found: OutlineCache::new(outlines),
            scanner: RowScanner::default(),
            store: SpanStore::default(),
            single: SpanStore::default(),
            free_positions: None,
            area: None,
        }
    }

    /// The same for samples that are not those of the grid.
    pub(crate) fn with(self, free_positions: FreePositions) -> Self {
        Self {
            free_positions: Some(Box::new(free_positions)),
            ..self
        }
    }

    /// The same where areas count.
    pub(crate) fn with_area(self, area: ShapeArea) -> Self {
        Self {
            area: Some(Box::new(area)),
            ..self
        }
    }

    /// Whether areas count.
    #[inline]
    pub(crate) fn has_areas(&self) -> bool {
        self.area.is_some()
    }

    /// As [`ShapeCoverage::each`] with areas instead of samples: each pixel at most once.
    pub(crate) fn each_area(&mut self, shape: Shape<'_>, rect: SpanRect, visit: impl FnMut(i32, CoveredArea)) {
        if let Some(area) = &mut self.area {
            area.each(shape, rect, visit);
        }
    }

    /// Calls `visit` with what the shape covers in the tile `rect`, from top to bottom, each time with the row of pixels: each
    /// sample once, and a pixel as often as a sample row has spans in it.
    #[inline]
    pub(crate) fn each(&mut self, shape: Shape<'_>, rect: SpanRect, mut visit: impl FnMut(i32, Covered)) {
        let side = self.grid.side();
        match shape {
            Shape::Tile => (rect.y.start..rect.y.end).for_each(|y| visit(y, Covered::Whole(rect.x))),
            Shape::Pixels(pixels) => pixels
                .moved(rect.x.start, rect.y.start)
                .each_run(|y, xs| visit(y, Covered::Whole(xs))),
            Shape::Samples(samples) => {
                let samples = samples.moved(rect.x.start * side, rect.y.start * side);
                each_covered(&mut MaskRows::new(samples), side, rect.x, visit);
            }
            _ if let Some(free_positions) = &mut self.free_positions => free_positions.each(shape, rect, visit),
            Shape::Triangle(corners) => TriangleRows::of(*corners, self.grid, self.rules, rect, |rows| {
                each_covered(rows, side, rect.x, visit);
            }),
            Shape::Outline(_) | Shape::Float(_) => {
                let mut rows = StoredRows::<MAX_SIDE>::new(self.stored(shape, rect), side, rect);
                each_covered(&mut rows, side, rect.x, visit);
            }
        }
    }

    /// As [`ShapeCoverage::each`] for a triangle or polygon on the grid where a pixel has 2 x 2 or 4 x 4 samples, by rows of
    /// pixels, without a call for each.
    #[inline(always)]
    #[expect(clippy::inline_always, reason = "what paints is to be seen by the compiler")]
    pub(crate) fn each_narrow_row<S: Simd, const SIDE: usize>(
        &mut self,
        simd: S,
        shape: Shape<'_>,
        rect: SpanRect,
        paint: impl FnMut(&TileRow<'_, SIDE>),
    ) {
        let side = self.grid.side();
        debug_assert_eq!(to_index(side), SIDE, "samples along a side");
        if let Shape::Triangle(corners) = shape {
            return TriangleRows::of(
                *corners,
                self.grid,
                self.rules,
                rect,
                #[inline(always)]
                |rows| each_row(simd, rows, rect, paint),
            );
        }
        let mut rows = StoredRows::<SIDE>::new(self.stored(shape, rect), side, rect);
        each_row(simd, &mut rows, rect, paint);
    }

    /// The spans of an outline, or of a triangle by the rules of first drafts.
    #[inline]
    fn stored(&mut self, shape: Shape<'_>, rect: SpanRect) -> RowSpans<'_> {
        match shape {
            Shape::Outline(outline) => self.of_outline(outline, rect.y),
            Shape::Float(float) => self.of_float(float, rect),
            _ => RowSpans::EMPTY,
        }
    }

    /// The spans in one tile.
    fn of_float(&mut self, float: &FloatShape, rect: SpanRect) -> RowSpans<'_> {
        let grid = self.grid;
        let (columns, rows) = (scaled(rect.x, grid.side()), scaled(rect.y, grid.side()));
        let rows = rows.intersection(float.samples.y);
        self.single.clear();
        let stored = self.single.put_single(rows, |row| float.span(grid, row, columns));
        self.single.get(stored)
    }

    fn of_outline(&mut self, of: NumberedOutline<'_>, rows: Span) -> RowSpans<'_> {
        if self.found.go_to(rows, self.store.len() > MAX_SPANS) {
            self.store.clear();
        }
        let stored = self.found.get_or(of.number, || {
            let within = SpanRect {
                x: Span {
                    start: 0,
                    end: self.columns,
                },
                y: scaled(rows, self.grid.side()),
            };
            self.scanner.scan(of.outline, self.grid, within, &mut self.store)
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
    use crate::raster::span::to_index;
    use crate::raster::{SamplePattern, SampleRate};

    /// Pixels of the frame, and the tile that is looked at.
    const FRAME: [i32; 2] = [14, 11];
    const RECT: SpanRect = SpanRect {
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

    /// A drawing of one shape.
    struct Drawing {
        grid: SubpixelGrid,
        rules: Rules,
        positions: SamplePositions,
        rows: ShapeCoverage,
        frame: SpanRect,
        /// A contour, and the same on the grid.
        points: Vec<DVec2>,
        snapped: Vec<GridPoint>,
    }

    impl Drawing {
        fn new(u: &mut Unstructured<'_>, corners: usize) -> Result<Self> {
            let pattern = *u.choose(&SamplePattern::ALL)?;
            let rates: &[u32] = if pattern.needs_square() {
                &[1, 4, 9, 16, 25, 49, 64, 81, 144, 256]
            } else {
                &[1, 2, 7, 16, 63, 64, 65, 130, 256]
            };
            let rate = SampleRate::new(*u.choose(rates)?).expect("a rate");
            let (grid, rules) = (lattice(pattern, rate), *u.choose(&Rules::ALL)?);
            let pixels = |end: i32| Span { start: 0, end };
            let frame = SpanRect {
                x: scaled(pixels(FRAME[0]), grid.side()),
                y: scaled(pixels(FRAME[1]), grid.side()),
            };
            let positions = SamplePositions::new(pattern, rate, crate::raster::Seed::default());
            let mut rows = ShapeCoverage::new(grid, rules, frame.x.end, 1);
            if pattern != SamplePattern::Grid {
                let places = positions.clone();
                rows = rows.with(FreePositions::new(grid, rules, places, 1, pixels(FRAME[0])));
            }
            let points = contour(u, corners, grid)?;
            let snapped = points.iter().map(|point| grid.snap(*point)).collect();
            Ok(Self {
                grid,
                rules,
                positions,
                rows,
                frame,
                points,
                snapped,
            })
        }

        fn sample(&self, at: [i32; 2]) -> GridPoint {
            let [x, y] = at.map(|at| self.grid.sample_coordinate(at));
            GridPoint { x, y }
        }

        fn triangle(&mut self) {
            let corners = [self.snapped[0], self.snapped[1], self.snapped[2]];
            self.check(Shape::Triangle(&corners), |drawing, at| {
                let tests = EdgeTest::of_triangle(corners, drawing.sample(at));
                doubled_area(corners) != 0 && tests.iter().all(|test| test.is_inside(drawing.rules))
            });
        }

        fn outline(&mut self, rule: FillRule) {
            let mut edges = Vec::new();
            let mut builder = OutlineBuilder::new(self.grid, self.frame, &mut edges);
            builder.contour(self.points.iter().copied());
            if let Some(outline) = builder.finish(rule) {
                let of = NumberedOutline {
                    outline: outline.with_edges(&edges),
                    number: 0,
                };
                self.check(Shape::Outline(of), |drawing, at| {
                    rule.encloses(winding(&drawing.snapped, drawing.sample(at)))
                });
            }
        }

        fn float(&mut self) {
            let points = [self.points[0], self.points[1], self.points[2]];
            if let Some(float) = FloatShape::new(points, self.grid, self.frame, 0) {
                self.check(Shape::Float(&float), |drawing, at| float.covers(drawing.grid, at));
            }
        }

        /// A few samples of a grid, side by side in each row, all in the tile.
        fn stamp(&mut self, u: &mut Unstructured<'_>) -> Result<()> {
            let side = self.grid.side();
            let (columns, rows) = (scaled(RECT.x, side), scaled(RECT.y, side));
            let mut mask = 0;
            for row in 0..8 {
                let bits = u64::MAX >> u.int_in_range(57..=63)? << u.int_in_range(0..=1)?;
                let is_kept = row == 0 || u.ratio(2, 3)?;
                mask |= if is_kept { bits << (8 * row) } else { 0 };
            }
            let stamp = CoverageMask {
                column: u.int_in_range(columns.start..=columns.end - 1)?,
                row: u.int_in_range(rows.start..=rows.end - 1)?,
                mask,
            };
            let stamp = stamp.within(columns, rows);
            let in_tile = stamp.moved(-columns.start, -rows.start);
            self.check(Shape::Samples(in_tile), |_, [column, row]| {
                let (i, j) = (column - stamp.column, row - stamp.row);
                (0..8).contains(&i) && (0..8).contains(&j) && stamp.mask >> (8 * j + i) & 1 == 1
            });
            Ok(())
        }

        /// Looks at every sample of the tile, which must be covered once where `inside` says so, by its column and row.
        fn check(&mut self, shape: Shape<'_>, inside: impl Fn(&Self, [i32; 2]) -> bool) {
            let (width, count) = (RECT.x.length(), self.positions.count());
            let mut found = vec![vec![0; count]; width * RECT.y.length()];
            let index = |x: i32, y: i32| to_index(y - RECT.y.start) * width + to_index(x - RECT.x.start);
            self.rows.each(shape, RECT, |y, covered| match covered {
                Covered::Whole(xs) => {
                    assert!(!xs.is_empty(), "a run has pixels: {shape:?}");
                    let pixels = (xs.start..xs.end).map(|x| index(x, y));
                    pixels.for_each(|pixel| found[pixel].iter_mut().for_each(|sample| *sample += 1));
                }
                Covered::Part(x, mask) => {
                    let some = !mask.is_empty() && mask.count() < count;
                    assert!(some, "neither none nor all of a pixel: {shape:?}");
                    mask.each(|sample| found[index(x, y)][sample] += 1);
                }
            });
            let side = self.grid.side();
            for y in RECT.y.start..RECT.y.end {
                for x in RECT.x.start..RECT.x.end {
                    let place = |[column, row]: Position| [x * side + i32::from(column), y * side + i32::from(row)];
                    let mut memory = Vec::new();
                    let places = self.positions.of_pixel([x, y], &mut memory).iter();
                    let expected: Vec<i32> = places.map(|at| i32::from(inside(self, place(*at)))).collect();
                    let what = (side, self.rules, &self.points, shape);
                    assert_eq!(found[index(x, y)], expected, "pixel {x}, {y} of {what:?}");
                }
            }
        }
    }

    #[test]
    fn every_shape_covers_the_samples_inside_it_at_any_rate_in_any_pattern() {
        let mut kinds = [0; 4];
        arbtest::arbtest(|u| {
            let kind = u.int_in_range(0..=3)?;
            let corners = if kind == 1 { u.int_in_range(3..=9)? } else { 3 };
            let mut drawing = Drawing::new(u, corners)?;
            match kind {
                0 => drawing.triangle(),
                1 => drawing.outline(*u.choose(&[FillRule::NonZero, FillRule::EvenOdd])?),
                2 => drawing.float(),
                _ if drawing.rows.free_positions.is_some() => return Ok(()),
                _ => drawing.stamp(u)?,
            }
            kinds[to_index(kind)] += 1;
            Ok(())
        })
        .budget_ms(2000);
        assert!(kinds.iter().all(|found| *found > 20), "each kind of shape: {kinds:?}");
    }
}
