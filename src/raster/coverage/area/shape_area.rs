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
        let edges = [[0, 1], [1, 2], [2, 0]].map(|ends| {
            let [from, to] = ends.map(|end| corners[end]);
            // Clockwise on the screen a left edge runs up.
            let (ends, winding) = if from.y < to.y { ([from, to], -1) } else { ([to, from], 1) };
            (AreaEdge::new(self.grid, ends, winding), way * i64::from(winding))
        });
        let pixels = SpanRect::of_touched(corners, self.grid).intersection(rect);
        self.row.go_to(pixels.x);
        for y in pixels.y.start..pixels.y.end {
            let top = i64::from(y) * PIXEL;
            for (edge, sign) in &edges {
                let inside = [edge.top[1].max(top), edge.bottom[1].min(top + PIXEL)];
                self.row.add(edge, inside, *sign);
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
