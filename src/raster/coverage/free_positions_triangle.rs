//! What a triangle covers in one tile where samples lie anywhere in their pixels.
//!
//! Pixel by pixel: where no edge crosses a pixel, its corners decide at once; elsewhere its samples are asked, all at once by
//! [`SampleLanes`], or one after the other where there are too many of them.

#![expect(
    clippy::inline_always,
    reason = "a function that is not inlined into its dispatch loses the vector instructions"
)]

use fearless_simd::Simd;
use fearless_simd::prelude::*;

use crate::geometry::edge::{SampleEdge, doubled_area};
use crate::geometry::subpixel::{GridPoint, SubpixelGrid};
use crate::raster::coverage::edge_bounds::TileRows;
use crate::raster::coverage::sample_lanes::{EdgeSteps, SampleLanes};
use crate::raster::sampling::positions::Position;
use crate::raster::span::{Span, SpanRect};
use crate::rules::Rules;

/// A triangle and the pixels of a tile that it may touch.
#[derive(Debug)]
pub(super) struct TriangleScan {
    grid: SubpixelGrid,
    edges: [LatticeEdge; 3],
    /// What bounds the columns of rows of pixels; `None` where there are so few columns that looking at each pixel costs less.
    lines: Option<TileRows>,
    columns: Span,
    pub(super) rows: Span,
    /// Rows of samples between the highest and the lowest corner.
    sample_rows: Span,
}

/// Pixels side by side of which the same samples are covered.
#[derive(Clone, Copy, Debug)]
pub(super) struct FoundRun {
    pub(super) y: i32,
    pub(super) xs: Span,
    /// A bit for each sample.
    pub(super) bits: u64,
}

/// A [`SampleEdge`], whose samples are all points of the lattice.
#[derive(Clone, Copy, Debug)]
struct LatticeEdge {
    /// At the first point of the frame's first pixel.
    value: i64,
    steps: EdgeSteps,
    /// What it gains from a pixel to the one on its right.
    right_pixel: i64,
    /// What it gains from a pixel's first point to the point where it is least and greatest.
    least: i64,
    most: i64,
}

/// How much of a pixel a triangle covers by the values of its edges at the corners.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum PixelReach {
    Nothing,
    All,
    /// The values of the edges at the pixel's first point; those that do not cross the pixel have one that keeps nothing out.
    Part([i64; 3]),
}

/// The value of an edge that keeps nothing out.
const INSIDE: i64 = i64::MAX / 2;

impl TriangleScan {
    /// Prepares a triangle; `None` where it touches nothing of the tile `rect`.
    pub(super) fn new(corners: [GridPoint; 3], rect: SpanRect, grid: SubpixelGrid, rules: Rules) -> Option<Self> {
        let area = doubled_area(corners);
        if area == 0 {
            return None;
        }
        let side = grid.side();
        let samples = SpanRect::of_samples(corners, grid, rules);
        if samples.is_empty() {
            return None;
        }
        let pixels = |span: Span, within: Span| {
            Span {
                start: span.start.div_euclid(side),
                end: (span.end - 1).div_euclid(side) + 1,
            }
            .intersection(within)
        };
        let (columns, rows) = (pixels(samples.x, rect.x), pixels(samples.y, rect.y));
        if columns.is_empty() || rows.is_empty() {
            return None;
        }
        let first = grid.sample_coordinate(0);
        let first = GridPoint { x: first, y: first };
        let edges = SampleEdge::of_triangle(corners, area, first, grid, rules);
        Some(Self {
            grid,
            edges: edges.map(|edge| LatticeEdge::new(edge, side)),
            lines: (columns.end - columns.start > 2).then(|| TileRows::new(corners)),
            columns,
            rows,
            sample_rows: samples.y,
        })
    }

    /// The pixels of row `y` that it may touch, and those of them that it covers for certain.
    #[inline(always)]
    #[expect(clippy::cast_possible_truncation, reason = "clamped to columns of a frame")]
    pub(super) fn row(&self, y: i32) -> (Span, Span) {
        let Some(lines) = &self.lines else {
            return (self.columns, Span::EMPTY);
        };
        let (columns, side) = (self.columns, self.grid.side());
        let all = Span {
            start: y * side,
            end: (y + 1) * side,
        };
        let inside = all.intersection(self.sample_rows);
        let at = |row| self.grid.sample_coordinate(row);
        let bounds = lines.between(at(inside.start), at(inside.end - 1));
        let (least, most) = (f64::from(columns.start), f64::from(columns.end));
        let per_unit = 1.0 / self.grid.units_per_pixel();
        // No column of a frame is negative.
        let floor = |units: f64| (units * per_unit).clamp(least, most) as i32;
        let touched = Span {
            start: floor(bounds.touched[0]),
            end: floor(bounds.touched[1]).saturating_add(1).min(columns.end),
        };
        if inside != all || bounds.covered[0] > bounds.covered[1] {
            return (touched, Span::EMPTY);
        }
        let covered = Span {
            start: (bounds.covered[0] * per_unit).clamp(least, most).ceil() as i32,
            end: floor(bounds.covered[1]),
        };
        (touched, covered)
    }

    /// The parts of row `y` that are to be looked at pixel by pixel, and what is covered between them.
    #[inline(always)]
    pub(super) fn parts(&self, y: i32) -> (Span, Span, Span) {
        let (touched, inside) = self.row(y);
        if inside.is_empty() {
            return (touched, Span::EMPTY, Span::EMPTY);
        }
        let before = Span {
            start: touched.start,
            end: inside.start,
        };
        let after = Span {
            start: inside.end,
            end: touched.end,
        };
        (before, inside, after)
    }

    /// The values of its edges at a pixel's first point.
    #[inline(always)]
    pub(super) fn values(&self, x: i32, y: i32) -> [i64; 3] {
        let side = i64::from(self.grid.side());
        let (column, row) = (i64::from(x) * side, i64::from(y) * side);
        self.edges.map(|LatticeEdge { value, steps, .. }| {
            value + i64::from(steps.right) * column + i64::from(steps.down) * row
        })
    }

    /// What its edges say of a pixel by their [`TriangleScan::values`] there.
    #[inline(always)]
    pub(super) fn reach(&self, here: [i64; 3]) -> PixelReach {
        let (mut values, mut crossed) = ([INSIDE; 3], false);
        for ((value, here), LatticeEdge { least, most, .. }) in values.iter_mut().zip(here).zip(&self.edges) {
            if here + most < 0 {
                return PixelReach::Nothing;
            }
            if here + least < 0 {
                *value = here;
                crossed = true;
            }
        }
        if crossed {
            PixelReach::Part(values)
        } else {
            PixelReach::All
        }
    }

    /// What each edge gains from a pixel's first point to another.
    #[inline]
    pub(super) fn gains(&self, [column, row]: Position) -> [i64; 3] {
        self.edges.map(|LatticeEdge { steps, .. }| {
            i64::from(steps.right) * i64::from(column) + i64::from(steps.down) * i64::from(row)
        })
    }

    /// Finds all that is covered, row by row.
    #[inline(always)]
    pub(super) fn find<S: Simd>(&self, simd: S, lanes: &mut SampleLanes, found: &mut Vec<FoundRun>) {
        for y in self.rows.start..self.rows.end {
            let (before, inside, after) = self.parts(y);
            for xs in [before, after] {
                if xs.is_empty() {
                    continue;
                }
                let mut values = self.values(xs.start, y);
                for x in xs.start..xs.end {
                    let bits = self.bits(simd, lanes, [x, y], values);
                    if bits != 0 {
                        let xs = Span { start: x, end: x + 1 };
                        found.push(FoundRun { y, xs, bits });
                    }
                    for (value, edge) in values.iter_mut().zip(&self.edges) {
                        *value += edge.right_pixel;
                    }
                }
            }
            if !inside.is_empty() {
                let bits = lanes.all();
                found.push(FoundRun { y, xs: inside, bits });
            }
        }
    }

    /// The samples of a pixel that are covered, by the values of the edges there.
    #[inline(always)]
    fn bits<S: Simd>(&self, simd: S, lanes: &mut SampleLanes, pixel: [i32; 2], values: [i64; 3]) -> u64 {
        let values = match self.reach(values) {
            PixelReach::Nothing => return 0,
            PixelReach::All => return lanes.all(),
            PixelReach::Part(values) => values,
        };
        lanes.go_to(pixel);
        let mut bits = 0;
        for (first, samples) in lanes.blocks(simd) {
            let mut inside = u64::MAX;
            for (value, LatticeEdge { steps, .. }) in values.into_iter().zip(&self.edges) {
                if value != INSIDE {
                    inside &= samples.inside(value, *steps).to_bitmask();
                }
            }
            bits |= inside << first;
        }
        bits & lanes.all()
    }
}

impl LatticeEdge {
    fn new(edge: SampleEdge, side: i32) -> Self {
        let SampleEdge { value, right, down } = edge;
        let last = i64::from(side - 1);
        let (all_right, all_down) = (i64::from(right) * last, i64::from(down) * last);
        Self {
            value,
            steps: EdgeSteps::new(right, down),
            right_pixel: i64::from(right) * i64::from(side),
            least: all_right.min(0) + all_down.min(0),
            most: all_right.max(0) + all_down.max(0),
        }
    }
}
