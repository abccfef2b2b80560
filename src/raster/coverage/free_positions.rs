//! The coverage of samples that lie anywhere in their pixels: pixel by pixel, exactly.
//!
//! Samples are points of a lattice so fine that a pixel has 256 x 256 of it, and the lattice is that of an ordinary
//! grid of samples: so everything that leads to a tile, and the rule for ties, is the grid's. What remains to be found
//! here is which of its lattice points a pixel's samples are. Where no edge crosses a pixel, its corners decide at once.

use crate::geometry::edge::{SampleEdge, doubled_area};
use crate::geometry::subpixel::{GridPoint, SubpixelGrid};
use crate::raster::SampleRate;
use crate::raster::coverage::covered::Covered;
use crate::raster::coverage::edge_bounds::TileRows;
use crate::raster::coverage::float_shape::FloatShape;
use crate::raster::coverage::free_positions_polygon::FreePositionsPolygon;
use crate::raster::coverage::shape::Shape;
use crate::raster::sampling::mask::SampleMask;
use crate::raster::sampling::positions::{Position, SamplePositions};
use crate::raster::span::{PixelRect, Reach, SampleBox, Span};
use crate::rules::Rules;

/// Finds the samples that shapes cover, for one drawing.
#[derive(Debug)]
pub(crate) struct FreePositions {
    grid: SubpixelGrid,
    rules: Rules,
    places: SamplePositions,
    /// All samples of a pixel.
    all: SampleMask,
    memory: Vec<Position>,
    /// For each sample what the edges of the triangle at work gain from a pixel's first point to it.
    gains: Vec<[i64; 3]>,
    outlines: FreePositionsPolygon,
}

/// A [`SampleEdge`], whose samples are all points of the lattice.
#[derive(Clone, Copy, Debug, Default)]
struct LatticeEdge {
    /// At the frame's first point.
    value: i64,
    /// What it gains one point to the right, and down.
    right: i64,
    down: i64,
}

impl FreePositions {
    /// For a drawing of `outlines` outlines; of these only the pixel columns `columns` are ever asked for.
    pub(crate) fn new(
        (grid, rules): (SubpixelGrid, Rules),
        places: SamplePositions,
        outlines: usize,
        columns: Span,
    ) -> Self {
        Self {
            grid,
            rules,
            all: SampleMask::all(places.count()),
            memory: Vec::with_capacity(SampleRate::MAX as usize),
            gains: Vec::with_capacity(SampleRate::MAX as usize),
            outlines: FreePositionsPolygon::new(outlines, columns, places.count()),
            places,
        }
    }

    /// Calls `visit` for every row of the tile `rect` with what the shape covers there, from top to bottom; no sample
    /// comes twice.
    pub(crate) fn each(&mut self, shape: Shape<'_>, rect: PixelRect, mut visit: impl FnMut(i32, Covered)) {
        match shape {
            Shape::Triangle(corners) => self.triangle(*corners, rect, visit),
            Shape::Float(float) => self.float(float, rect, visit),
            // These have no edges: `ShapeCoverage` knows them itself.
            Shape::Tile | Shape::Samples(_) | Shape::Pixels(_) => {}
            Shape::Outline(outline) => {
                self.outlines.find(outline, (self.grid, &self.places), rect.y);
                for y in rect.y.start..rect.y.end {
                    self.outlines
                        .each(outline.number, y, rect.x, |covered| visit(y, covered));
                }
            }
        }
    }

    fn float(&mut self, float: &FloatShape, rect: PixelRect, mut visit: impl FnMut(i32, Covered)) {
        let side = self.grid.side();
        let of_pixel = |at: i32| Span {
            start: at * side,
            end: (at + 1) * side,
        };
        for y in rect.y.start..rect.y.end {
            for x in rect.x.start..rect.x.end {
                let samples = SampleBox {
                    columns: of_pixel(x),
                    rows: of_pixel(y),
                };
                let covered = match float.reach(self.grid, samples) {
                    None => continue,
                    Some(Reach::All) => self.all,
                    Some(Reach::Part) => self.float_mask(float, [x, y]),
                };
                if covered == self.all {
                    visit(y, Covered::Whole(Span { start: x, end: x + 1 }));
                } else if !covered.is_empty() {
                    visit(y, Covered::Part(x, covered));
                }
            }
        }
    }

    /// The samples of a pixel that a triangle covers by the rules of first drafts.
    fn float_mask(&mut self, float: &FloatShape, pixel: [i32; 2]) -> SampleMask {
        let (grid, first) = (self.grid, pixel.map(|at| at * self.grid.side()));
        let places = self.places.of_pixel(pixel, &mut self.memory);
        let mut mask = SampleMask::default();
        mask.set_each(places.len(), |sample| {
            let [column, row] = places[sample].map(i32::from);
            float.covers(grid, [first[0] + column, first[1] + row])
        });
        mask
    }

    fn triangle(&mut self, corners: [GridPoint; 3], rect: PixelRect, mut visit: impl FnMut(i32, Covered)) {
        let area = doubled_area(corners);
        if area == 0 {
            return;
        }
        let side = self.grid.side();
        let samples = SampleBox::new(corners, self.grid, self.rules);
        let pixels = |span: Span, within: Span| {
            Span {
                start: span.start.div_euclid(side),
                end: (span.end - 1).div_euclid(side) + 1,
            }
            .intersection(within)
        };
        let (columns, rows) = (pixels(samples.columns, rect.x), pixels(samples.rows, rect.y));
        if columns.is_empty() || rows.is_empty() || samples.columns.is_empty() || samples.rows.is_empty() {
            return;
        }
        let first = self.grid.sample_coordinate(0);
        let first = GridPoint { x: first, y: first };
        let edges = SampleEdge::of_triangle((corners, area), first, (self.grid, self.rules)).map(LatticeEdge::new);
        self.gains.clear();
        // Where there are few columns, looking at each pixel costs less than finding out which to look at.
        let lines = (columns.end - columns.start > 2).then(|| TileRows::new(corners));
        for y in rows.start..rows.end {
            let (touched, inside) = match &lines {
                Some(lines) => self.row_of(lines, (columns, samples.rows), y),
                None => (columns, Span::EMPTY),
            };
            if inside.is_empty() {
                self.pixels(&edges, touched, y, &mut visit);
                continue;
            }
            let before = Span {
                start: touched.start,
                end: inside.start,
            };
            let after = Span {
                start: inside.end,
                end: touched.end,
            };
            self.pixels(&edges, before, y, &mut visit);
            visit(y, Covered::Whole(inside));
            self.pixels(&edges, after, y, &mut visit);
        }
    }

    /// The pixels of row `y` that a triangle may touch, and those of them that it covers for certain, of `columns`.
    #[expect(clippy::cast_possible_truncation, reason = "clamped to columns of a frame")]
    fn row_of(&self, lines: &TileRows, (columns, rows): (Span, Span), y: i32) -> (Span, Span) {
        let side = self.grid.side();
        let all = Span {
            start: y * side,
            end: (y + 1) * side,
        };
        let inside = all.intersection(rows);
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

    /// The pixels `xs` of row `y`, one by one.
    #[inline]
    fn pixels(&mut self, edges: &[LatticeEdge; 3], xs: Span, y: i32, visit: &mut impl FnMut(i32, Covered)) {
        for x in xs.start..xs.end {
            if let Some(covered) = self.pixel(edges, x, y) {
                visit(y, covered);
            }
        }
    }

    #[inline]
    fn pixel(&mut self, edges: &[LatticeEdge; 3], x: i32, y: i32) -> Option<Covered> {
        // What is never below zero keeps nothing out.
        let (mut values, mut crossed) = ([i64::MAX / 2; 3], false);
        for (value, edge) in values.iter_mut().zip(edges) {
            let edge = edge.at_pixel(self.grid.side(), x, y);
            let [least, most] = edge.range(self.grid.side());
            if most < 0 {
                return None;
            }
            if least < 0 {
                *value = edge.value;
                crossed = true;
            }
        }
        let whole = Covered::Whole(Span { start: x, end: x + 1 });
        if !crossed {
            return Some(whole);
        }
        if self.gains.is_empty() || !self.places.are_same() {
            let places = self.places.of_pixel([x, y], &mut self.memory);
            self.gains.clear();
            self.gains
                .extend(places.iter().map(|place| edges.map(|edge| edge.gain(*place))));
        }
        let mut mask = SampleMask::default();
        mask.set_each(self.gains.len(), |sample| {
            let [a, b, c] = self.gains[sample];
            (values[0] + a) | (values[1] + b) | (values[2] + c) >= 0
        });
        if mask == self.all {
            Some(whole)
        } else if mask.is_empty() {
            None
        } else {
            Some(Covered::Part(x, mask))
        }
    }
}

impl LatticeEdge {
    fn new(edge: SampleEdge) -> Self {
        Self {
            value: edge.value,
            right: edge.right.into(),
            down: edge.down.into(),
        }
    }

    /// The same, standing at a pixel's first point.
    #[inline]
    fn at_pixel(self, side: i32, x: i32, y: i32) -> Self {
        let (column, row) = (i64::from(x) * i64::from(side), i64::from(y) * i64::from(side));
        Self {
            value: self.value + self.right * column + self.down * row,
            ..self
        }
    }

    /// What it gains from a pixel's first point to another.
    #[inline]
    fn gain(&self, [column, row]: Position) -> i64 {
        self.right * i64::from(column) + self.down * i64::from(row)
    }

    /// The least and the greatest value in the pixel that it stands at.
    #[inline]
    fn range(&self, side: i32) -> [i64; 2] {
        let last = i64::from(side - 1);
        let (right, down) = (self.right * last, self.down * last);
        [
            self.value + right.min(0) + down.min(0),
            self.value + right.max(0) + down.max(0),
        ]
    }
}

#[cfg(test)]
mod tests {
    use std::sync::atomic::AtomicBool;

    use arbtest::arbitrary::{Result, Unstructured};

    use super::*;
    use crate::color::{Premultiplied16, ResolveSpace, Rgba};
    use crate::raster::list::builder::ChunkBuilder;
    use crate::raster::list::context::ListContext;
    use crate::raster::paint::per_sample::PerSamplePainter;
    use crate::raster::paint::recorder::PaintedCommand;
    use crate::raster::random::{fill, noise};
    use crate::raster::{DisplayList, Framebuffer, RasterSettings, SamplePattern, SizedFilter};
    use crate::texture::{PixelSampling, SamplingSettings, Texture};

    const SIZE: [u32; 2] = [70, 50];

    fn settings(pattern: SamplePattern, samples: u32, rules: Rules) -> RasterSettings {
        RasterSettings {
            rate: SampleRate::new(samples).expect("a rate"),
            pattern,
            sampling: SamplingSettings {
                pixel: PixelSampling::Bilinear,
                rules,
                ..SamplingSettings::default()
            },
            filter: SizedFilter::default(),
            space: ResolveSpace::Stored,
            background: Rgba::WHITE,
            palette: None,
        }
    }

    fn list<'t>(u: &mut Unstructured<'_>, settings: RasterSettings, texture: &'t Texture) -> Result<DisplayList<'t>> {
        let context = ListContext::new(SIZE, &settings);
        let mut builder = ChunkBuilder::new(&context, 12);
        fill(&mut builder, u)?;
        Ok(DisplayList::new(
            context,
            settings,
            vec![builder.finish()],
            vec![texture].into(),
        ))
    }

    /// What each command paints in a pixel, and what its samples hold then; `scattered` says that samples are looked at one by
    /// one, also those of the grid.
    fn painted(
        list: &DisplayList<'_>,
        [x, y]: [u32; 2],
        scattered: bool,
    ) -> (Vec<PaintedCommand>, Vec<Premultiplied16>) {
        let pixel = [x, y].map(u32::cast_signed);
        let column = Span {
            start: pixel[0],
            end: pixel[0] + 1,
        };
        let bins = list.bins_of_pixel(pixel, 0);
        let chunks: Vec<_> = list
            .chunks
            .iter()
            .zip(bins.iter().map(|bins| bins.of_tile(0)))
            .collect();
        let mut shape_coverage = list.shape_coverage(column);
        if scattered {
            shape_coverage = shape_coverage.with(list.free_positions(column));
        }
        let mut painter = PerSamplePainter::new(list.shade_context(), list.places());
        let (painted, samples) = painter.replay(&chunks, (pixel, list.background()), &mut shape_coverage);
        (painted, samples.into_iter().map(|(color, _)| color).collect())
    }

    #[test]
    fn samples_of_the_grid_are_covered_as_spans_say() {
        let texture = noise();
        arbtest::arbtest(|u| {
            let rules = *u.choose(&Rules::ALL)?;
            let side = u.int_in_range(1..=6)?;
            let list = list(u, settings(SamplePattern::Grid, side * side, rules), &texture)?;
            for _ in 0..40 {
                let (x, y) = (u.int_in_range(0..=SIZE[0] - 1)?, u.int_in_range(0..=SIZE[1] - 1)?);
                let (spans, one_by_one) = (painted(&list, [x, y], false), painted(&list, [x, y], true));
                assert_eq!(one_by_one, spans, "pixel {x}, {y}, {rules:?}, {side} x {side}");
            }
            Ok(())
        })
        .budget_ms(1000);
    }

    #[test]
    fn frames_hold_the_means_of_what_probes_find() {
        let texture = noise();
        arbtest::arbtest(|u| {
            let pattern = *u.choose(&SamplePattern::ALL[1..])?;
            let samples = *u.choose(if pattern.needs_square() {
                &[1, 4, 9, 16][..]
            } else {
                &[1, 2, 5, 16, 70]
            })?;
            let settings = settings(pattern, samples, *u.choose(&Rules::ALL)?);
            let list = list(u, settings, &texture)?;
            let mut frame = Framebuffer::new(SIZE[0], SIZE[1]);
            list.rasterize(&mut frame, &AtomicBool::new(false))
                .expect("not cancelled");
            for _ in 0..60 {
                let (x, y) = (u.int_in_range(0..=SIZE[0] - 1)?, u.int_in_range(0..=SIZE[1] - 1)?);
                let colors = painted(&list, [x, y], true).1;
                assert_eq!(colors.len(), samples as usize, "all samples");
                let sum = |k: usize| colors.iter().map(|color| u32::from(color.0[k])).sum::<u32>();
                let mean = Premultiplied16::resolve([sum(0), sum(1), sum(2), sum(3)], samples, settings.sampling.rules);
                let found = frame.pixels()[(y * SIZE[0] + x) as usize];
                assert_eq!(found, mean, "pixel {x}, {y} of {pattern:?} {samples}");
            }
            Ok(())
        })
        .budget_ms(1000);
    }
}
