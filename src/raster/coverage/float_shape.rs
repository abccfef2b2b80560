//! A triangle by the rules of first drafts: which samples it covers, by edge functions in 32-bit floats.
//!
//! Spans of rows and the reach into tiles come from the order that rounding keeps, see [`crate::geometry::float_edge`]; so
//! every painter of spans paints it, and a frame holds just what the test of each sample alone says.

use glam::{DVec2, Vec2};

use crate::geometry::float_edge::{FloatTriangle, first};
use crate::geometry::subpixel::SubpixelGrid;
use crate::raster::span::{Reach, Span, SpanRect};

/// A triangle in a chunk.
#[derive(Clone, Copy, Debug)]
pub(crate) struct FloatShape {
    triangle: FloatTriangle,
    /// The samples that are painted in the box around it; never empty.
    pub(crate) samples: SpanRect,
    /// Where the frame's first sample is in what is painted: floats round by their place in the frame.
    origin: i32,
}

impl FloatShape {
    /// Its corners in the frame, around which `margin` pixels are painted on each side, `painted` in all; `None` where it has no
    /// area, or none of these samples lies in its box.
    pub(crate) fn new(points: [DVec2; 3], grid: SubpixelGrid, painted: SpanRect, margin: u32) -> Option<Self> {
        let origin = margin.cast_signed() * grid.side();
        let place = |index: i32| place(grid, index - origin);
        let triangle = FloatTriangle::new(points)?;
        let [low, high] = triangle.bounds();
        let span = |low, high, Span { start, end }: Span| Span {
            start: first(start, end, |index| place(index) >= low),
            end: first(start, end, |index| place(index) > high),
        };
        let samples = SpanRect {
            x: span(low.x, high.x, painted.x),
            y: span(low.y, high.y, painted.y),
        };
        (!samples.is_empty()).then_some(Self {
            triangle,
            samples,
            origin,
        })
    }

    /// The covered columns of a sample row, of those in `columns`.
    pub(crate) fn span(&self, grid: SubpixelGrid, row: i32, columns: Span) -> Span {
        let columns = columns.intersection(self.samples.x);
        if columns.is_empty() {
            return Span::EMPTY;
        }
        let ends = [columns.start, columns.end];
        let [start, end] = self
            .triangle
            .columns(self.place(grid, row), ends, |column| self.place(grid, column));
        if start < end { Span { start, end } } else { Span::EMPTY }
    }

    /// How much of some samples it covers; `None` where it is nothing for certain.
    pub(crate) fn reach(&self, grid: SubpixelGrid, samples: SpanRect) -> Option<Reach> {
        let inside = samples.intersection(self.samples);
        if inside.is_empty() {
            return None;
        }
        let SpanRect { x: columns, y: rows } = samples;
        let corner = |column, row| self.point(grid, [column, row]);
        let corners = [
            corner(columns.start, rows.start),
            corner(columns.end - 1, rows.start),
            corner(columns.start, rows.end - 1),
            corner(columns.end - 1, rows.end - 1),
        ];
        if corners.iter().all(|corner| self.triangle.covers(*corner)) {
            return Some(Reach::All);
        }
        let edges = corners.map(|corner| self.triangle.edges(corner));
        let kept_out = (0..3).any(|i| edges.iter().all(|edges| edges[i] <= 0.0));
        (!kept_out).then_some(Reach::Part)
    }

    /// The edge functions at a sample.
    pub(crate) fn edges(&self, grid: SubpixelGrid, sample: [i32; 2]) -> [f32; 3] {
        self.triangle.edges(self.point(grid, sample))
    }

    /// Whether a sample is covered.
    pub(crate) fn covers(&self, grid: SubpixelGrid, sample: [i32; 2]) -> bool {
        self.triangle.covers(self.point(grid, sample))
    }

    /// A sample's place in the frame, in pixels.
    fn point(&self, grid: SubpixelGrid, [column, row]: [i32; 2]) -> Vec2 {
        Vec2::new(self.place(grid, column), self.place(grid, row))
    }

    /// Where a sample row or column that is painted lies in the frame, in pixels.
    fn place(&self, grid: SubpixelGrid, index: i32) -> f32 {
        place(grid, index - self.origin)
    }
}

/// Where a sample row or column lies, in pixels.
#[expect(clippy::cast_possible_truncation, reason = "a first draft has 32 bits for it")]
fn place(grid: SubpixelGrid, index: i32) -> f32 {
    grid.sample_position(index) as f32
}
