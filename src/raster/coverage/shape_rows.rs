//! What shapes cover in one row of tiles; for outlines it is found once for all its tiles.

use fearless_simd::Simd;

use crate::geometry::subpixel::{GridPoint, SubpixelGrid};
use crate::raster::coverage::float_shape::FloatShape;
use crate::raster::coverage::outline_cache::OutlineCache;
use crate::raster::coverage::pixel_rows::{PixelRow, each_pixel_row, each_pixel_row_of_spans};
use crate::raster::coverage::pixel_rows_4x4::{self, TileRow};
use crate::raster::coverage::polygon::{Outline, OutlineEdge};
use crate::raster::coverage::polygon_rows::{RowScanner, RowSpans, SpanStore, Stored};
use crate::raster::span::{PixelRect, Span, scaled};
use crate::rules::Rules;

/// Spans that are remembered at most, about 8 MB.
pub(in crate::raster) const MAX_SPANS: usize = 1 << 20;

/// What covers samples.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Shape<'c> {
    /// The corners of a triangle.
    Triangle(&'c [GridPoint; 3]),
    /// A polygon.
    Outline(OutlineOf<'c>),
    /// A triangle by the rules of first drafts.
    Float(&'c FloatShape),
}

/// An outline and what it needs to be looked at.
#[derive(Clone, Copy, Debug)]
pub(crate) struct OutlineOf<'c> {
    pub(crate) outline: &'c Outline,
    /// The edges that it points into.
    pub(crate) edges: &'c [OutlineEdge],
    /// Its number among all outlines of the drawing.
    pub(crate) number: usize,
}

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
}

impl ShapeRows {
    /// For a drawing of `outlines` outlines in a frame with `columns` columns of samples.
    pub(crate) fn new(settings: (SubpixelGrid, Rules), columns: i32, outlines: usize) -> Self {
        Self {
            settings,
            columns,
            found: OutlineCache::new(outlines),
            scanner: RowScanner::default(),
            store: SpanStore::default(),
            single: SpanStore::default(),
        }
    }

    /// Calls `paint` for every row of pixels of the tile `rect` of which the shape covers any sample, from top to bottom;
    /// a row may come several times, with other samples each time.
    #[inline]
    pub(crate) fn each_pixel_row(&mut self, shape: Shape<'_>, rect: PixelRect, paint: impl FnMut(&PixelRow<'_>)) {
        match shape {
            Shape::Triangle(corners) => each_pixel_row(*corners, self.settings, rect, paint),
            Shape::Outline(outline) => {
                let side = self.settings.0.side();
                each_pixel_row_of_spans(self.of_outline(outline, rect.y), side, rect, paint);
            }
            Shape::Float(float) => {
                let side = self.settings.0.side();
                each_pixel_row_of_spans(self.of_float(float, rect), side, rect, paint);
            }
        }
    }

    /// As [`ShapeRows::each_pixel_row`] where a pixel has 4 x 4 samples, without a call for each row.
    #[inline(always)]
    #[expect(clippy::inline_always, reason = "what paints is to be seen by the compiler")]
    pub(crate) fn each_row_of_four<S: Simd>(
        &mut self,
        simd: S,
        (shape, rect): (Shape<'_>, PixelRect),
        paint: impl FnMut(&TileRow<'_>),
    ) {
        match shape {
            Shape::Triangle(corners) => {
                pixel_rows_4x4::each_row_of_triangle(simd, *corners, self.settings, rect, paint);
            }
            Shape::Outline(outline) => {
                pixel_rows_4x4::each_row_of_spans(simd, self.of_outline(outline, rect.y), rect, paint);
            }
            Shape::Float(float) => pixel_rows_4x4::each_row_of_spans(simd, self.of_float(float, rect), rect, paint),
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
