//! How much of each pixel a shape covers: the one door through which painters get areas.

use crate::geometry::edge::doubled_area;
use crate::geometry::subpixel::{GridPoint, SubpixelGrid};
use crate::raster::coverage::area::edge::{AreaEdge, PIXEL};
use crate::raster::coverage::area::outline::OutlineAreas;
use crate::raster::coverage::area::row::{Area, AreaRow, CoveredArea};
use crate::raster::coverage::outline_cache::OutlineCache;
use crate::raster::coverage::shape::{MAX_SPANS, NumberedOutline, Shape};
use crate::raster::span::{Span, SpanRect, to_index};

/// Finds areas, and remembers those of outlines in the row of tiles at work.
#[derive(Debug)]
pub(crate) struct ShapeArea {
    grid: SubpixelGrid,
    /// Columns of pixels that are painted.
    columns: i32,
    row: AreaRow,
    areas: OutlineAreas,
    /// Of each outline the first of its rows among `rows`.
    found: OutlineCache<usize>,
    /// Where the runs of each row of pixels end, one row after the other; the first of an outline says where they begin.
    rows: Vec<usize>,
    runs: Vec<CoveredArea>,
}

impl ShapeArea {
    /// For a drawing of `outlines` outlines in a frame of `columns` columns of pixels; `grid` has one sample in a pixel.
    pub(crate) fn new(grid: SubpixelGrid, columns: i32, outlines: usize) -> Self {
        Self {
            grid,
            columns,
            row: AreaRow::default(),
            areas: OutlineAreas::default(),
            found: OutlineCache::new(outlines),
            rows: Vec::new(),
            runs: Vec::new(),
        }
    }

    /// Calls `visit` with what the shape covers in the tile `rect`, from top to bottom, each time with the row of pixels: each
    /// pixel at most once.
    pub(crate) fn each(&mut self, shape: Shape<'_>, rect: SpanRect, mut visit: impl FnMut(i32, CoveredArea)) {
        let area = Area::WHOLE;
        match shape {
            Shape::Tile => (rect.y.start..rect.y.end).for_each(|y| visit(y, CoveredArea { xs: rect.x, area })),
            // One sample is a pixel.
            Shape::Pixels(pixels) | Shape::Samples(pixels) => pixels
                .moved(rect.x.start, rect.y.start)
                .each_run(|y, xs| visit(y, CoveredArea { xs, area })),
            Shape::Triangle(corners) => self.triangle(*corners, rect, visit),
            Shape::Outline(outline) => self.outline(outline, rect, visit),
            // First drafts know samples only.
            Shape::Float(_) => {}
        }
    }

    fn triangle(&mut self, corners: [GridPoint; 3], rect: SpanRect, mut visit: impl FnMut(i32, CoveredArea)) {
        let way = doubled_area(corners).signum();
        let pixels = SpanRect::of_touched(corners, self.grid).intersection(rect);
        let first = i64::from(pixels.y.start) * PIXEL;
        // Each with how far down it was added.
        let mut edges = [[0, 1], [1, 2], [2, 0]].map(|ends| {
            let [from, to] = ends.map(|end| corners[end]);
            // Clockwise on the screen a left edge runs up.
            let (ends, winding) = if from.y < to.y {
                ([from, to], -1)
            } else {
                ([to, from], 1)
            };
            let edge = AreaEdge::new(self.grid, ends, winding);
            (edge, edge.at(edge.top[1].max(first)), way * i64::from(winding))
        });
        self.row.go_to(pixels.x);
        for y in pixels.y.start..pixels.y.end {
            let bottom = (i64::from(y) + 1) * PIXEL;
            for (edge, from, sign) in &mut edges {
                if from[1] < bottom && from[1] < edge.bottom[1] {
                    let to = edge.at(edge.bottom[1].min(bottom));
                    self.row.add(edge, [*from, to], *sign);
                    *from = to;
                }
            }
            self.row.take(|covered| visit(y, covered));
        }
    }

    fn outline(&mut self, of: NumberedOutline<'_>, rect: SpanRect, mut visit: impl FnMut(i32, CoveredArea)) {
        let Self {
            grid,
            columns,
            areas,
            found,
            rows,
            runs,
            ..
        } = self;
        if found.go_to(rect.y, runs.len() > MAX_SPANS) {
            runs.clear();
            rows.clear();
        }
        let first = found.get_or(of.number, || {
            let first = rows.len();
            rows.push(runs.len());
            let frame = Span {
                start: 0,
                end: *columns,
            };
            let end = |y: i32| first + 1 + to_index(y - rect.y.start);
            areas.each(of.outline, *grid, [frame, rect.y], |y, covered| {
                // Rows in which nothing is covered end where the one before does.
                rows.resize(end(y).max(rows.len()), runs.len());
                runs.push(covered);
            });
            rows.resize(end(rect.y.end), runs.len());
            first
        });
        for (y, ends) in (rect.y.start..rect.y.end).zip(rows[first..].windows(2)) {
            let of_row = &runs[ends[0]..ends[1]];
            let skipped = of_row.partition_point(|run| run.xs.end <= rect.x.start);
            for run in of_row[skipped..].iter().take_while(|run| run.xs.start < rect.x.end) {
                let xs = run.xs.intersection(rect.x);
                visit(y, CoveredArea { xs, ..*run });
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use arbtest::arbitrary::{Result, Unstructured};
    use glam::DVec2;

    use super::*;
    use crate::geometry::{FillRule, area_in_pixel, cut_to_window};
    use crate::raster::coverage::polygon::OutlineBuilder;

    const SIZE: [i32; 2] = [9, 6];
    const RECT: SpanRect = SpanRect {
        x: Span { start: 0, end: SIZE[0] },
        y: Span { start: 0, end: SIZE[1] },
    };

    /// The area of each pixel, row by row; none twice.
    fn areas(shape: Shape<'_>, rect: SpanRect) -> Vec<f64> {
        let mut found = vec![0.0; RECT.x.length() * RECT.y.length()];
        let mut area = ShapeArea::new(SubpixelGrid::new(1), SIZE[0], 1);
        area.each(shape, rect, |y, CoveredArea { xs, area }| {
            for x in xs.start..xs.end {
                let pixel = &mut found[to_index(y * SIZE[0] + x)];
                assert!(*pixel <= 0.0, "pixel {x}, {y} once");
                *pixel = f64::from(area.parts()) / f64::from(Area::WHOLE.parts());
            }
        });
        found
    }

    /// A place on the grid in or around the frame, often where several meet.
    fn place(u: &mut Unstructured<'_>) -> Result<DVec2> {
        let step = *u.choose(&[1.0, 0.25, 1.0 / 16_384.0])?;
        let mut at = |pixels: i32| {
            let most = (f64::from(pixels) + 4.0) / step;
            let part: u32 = u.arbitrary()?;
            Ok((f64::from(part) / f64::from(u32::MAX) * most).floor() * step - 2.0)
        };
        Ok(DVec2::new(at(SIZE[0])?, at(SIZE[1])?))
    }

    #[test]
    fn triangles_cover_what_clipping_leaves_of_them() {
        arbtest::arbtest(|u| {
            let corners = [place(u)?, place(u)?, place(u)?];
            let snapped = corners.map(|corner| SubpixelGrid::new(1).snap(corner));
            let found = areas(Shape::Triangle(&snapped), RECT);
            for (x, y) in (0..SIZE[1]).flat_map(|y| (0..SIZE[0]).map(move |x| (x, y))) {
                let expected = area_in_pixel(corners, [x, y].map(i32::cast_unsigned));
                let found = found[to_index(y * SIZE[0] + x)];
                assert!(
                    (found - expected).abs() < 2e-5,
                    "{corners:?} in {x}, {y}: {found}, not {expected}"
                );
            }
            let part = SpanRect {
                x: Span { start: 3, end: 5 },
                y: Span { start: 2, end: 4 },
            };
            for (i, alone) in areas(Shape::Triangle(&snapped), part).into_iter().enumerate() {
                assert!(
                    alone <= 0.0 || (alone - found[i]).abs() <= 0.0,
                    "the same in a smaller tile"
                );
            }
            Ok(())
        })
        .budget_ms(300);
    }

    #[test]
    fn outlines_cover_what_clipping_leaves_of_them_by_either_rule() {
        let grid = SubpixelGrid::new(1);
        arbtest::arbtest(|u| {
            let mut contour = || {
                let corners = u.int_in_range(3..=6)?;
                (0..corners).map(|_| place(u)).collect::<Result<Vec<_>>>()
            };
            let contours = [contour()?, contour()?];
            for rule in [FillRule::NonZero, FillRule::EvenOdd] {
                let mut edges = Vec::new();
                let mut builder = OutlineBuilder::new(grid, RECT, &mut edges).touched();
                for contour in &contours {
                    builder.contour(contour.iter().copied());
                }
                let found = builder.finish(rule).map_or(vec![0.0; 54], |outline| {
                    let outline = outline.with_edges(&edges);
                    areas(Shape::Outline(NumberedOutline { outline, number: 0 }), RECT)
                });
                for (x, y) in (0..SIZE[1]).flat_map(|y| (0..SIZE[0]).map(move |x| (x, y))) {
                    let low = DVec2::new(x.into(), y.into());
                    let cut = contours.iter().map(|contour| contour.iter().copied());
                    let cut = cut_to_window(cut, rule, [low, low + 1.0]);
                    let expected = cut.area().expect("few crossings");
                    let found = found[to_index(y * SIZE[0] + x)];
                    assert!(
                        (found - expected).abs() < 4e-5,
                        "{contours:?} by {rule:?} in {x}, {y}: {found}, not {expected}"
                    );
                }
            }
            Ok(())
        })
        .budget_ms(700);
    }

    #[test]
    fn a_star_has_a_hole_by_one_rule_and_none_by_the_other() {
        // Five points around a pixel's middle, every second one joined.
        let points: Vec<DVec2> = (0..5)
            .map(|i| {
                let angle = f64::from(i * 2) * std::f64::consts::TAU / 5.0;
                DVec2::new(4.5, 2.5) + 0.48 * DVec2::from_angle(angle)
            })
            .collect();
        let area = |rule| {
            let mut edges = Vec::new();
            let mut builder = OutlineBuilder::new(SubpixelGrid::new(1), RECT, &mut edges).touched();
            builder.contour(points.iter().copied());
            let outline = builder.finish(rule).expect("it touches a pixel");
            let outline = outline.with_edges(&edges);
            areas(Shape::Outline(NumberedOutline { outline, number: 0 }), RECT)[2 * 9 + 4]
        };
        // By the golden ratio: of a pentagram 1.12257 square radii are filled, 0.34690 of them in the middle.
        let [filled, middle] = [1.122_57, 0.346_90].map(|area| area * 0.48 * 0.48);
        let [nonzero, evenodd] = [FillRule::NonZero, FillRule::EvenOdd].map(area);
        assert!((nonzero - filled).abs() < 1e-4, "{nonzero}, not {filled}");
        assert!((nonzero - evenodd - middle).abs() < 1e-4, "{evenodd} is {middle} less");
    }
}
