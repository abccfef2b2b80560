//! The coverage of samples that lie anywhere in their pixels: pixel by pixel, exactly.
//!
//! Samples are points of a lattice so fine that a pixel has 256 x 256 of it, and the lattice is that of an ordinary
//! grid of samples: so everything that leads to a tile, and the rule for ties, is the grid's. What remains to be found
//! here is which of its lattice points a pixel's samples are. Where no edge crosses a pixel, its corners decide at once.

use fearless_simd::dispatch;

use crate::geometry::subpixel::{GridPoint, SubpixelGrid};
use crate::raster::SampleRate;
use crate::raster::coverage::covered::Covered;
use crate::raster::coverage::float_shape::FloatShape;
use crate::raster::coverage::free_positions_polygon::{FreePositionsPolygon, PixelSamples};
use crate::raster::coverage::free_positions_triangle::{FoundPixels, FoundRun, PixelReach, RowParts, TriangleScan};
use crate::raster::coverage::sample_lanes::SampleLanes;
use crate::raster::coverage::shape::Shape;
use crate::raster::sampling::mask::SampleMask;
use crate::raster::sampling::positions::{Position, SamplePositions};
use crate::raster::span::{Reach, Span, SpanRect};
use crate::rules::Rules;
use crate::simd;

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
    /// Where there are few enough samples to look at all of them at once, and what was found so.
    lanes: Option<SampleLanes>,
    found: FoundPixels,
}

impl FreePositions {
    /// For a drawing of `outlines` outlines; of these only the pixel columns `columns` are ever asked for.
    pub(crate) fn new(
        grid: SubpixelGrid,
        rules: Rules,
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
            outlines: FreePositionsPolygon::new(grid, outlines, columns, places.count()),
            lanes: SampleLanes::new(places.clone()),
            found: FoundPixels::default(),
            places,
        }
    }

    /// Calls `visit` for every row of the tile `rect` with what the shape covers there, from top to bottom; no sample
    /// comes twice.
    pub(crate) fn each(&mut self, shape: Shape<'_>, rect: SpanRect, mut visit: impl FnMut(i32, Covered)) {
        match shape {
            Shape::Triangle(corners) => self.triangle(*corners, rect, visit),
            Shape::Float(float) => self.float(float, rect, visit),
            // These have no edges: `ShapeCoverage` knows them itself.
            Shape::Tile | Shape::Samples(_) | Shape::Pixels(_) => {}
            Shape::Outline(outline) => {
                let samples = match &mut self.lanes {
                    Some(lanes) => PixelSamples::Few(lanes),
                    None => PixelSamples::Many(&self.places, &mut self.memory),
                };
                self.outlines.find(outline, samples, rect.y);
                for y in rect.y.start..rect.y.end {
                    self.outlines
                        .each(outline.number, y, rect.x, |covered| visit(y, covered));
                }
            }
        }
    }

    fn float(&mut self, float: &FloatShape, rect: SpanRect, mut visit: impl FnMut(i32, Covered)) {
        let side = self.grid.side();
        let of_pixel = |at: i32| Span {
            start: at * side,
            end: (at + 1) * side,
        };
        for y in rect.y.start..rect.y.end {
            for x in rect.x.start..rect.x.end {
                let samples = SpanRect {
                    x: of_pixel(x),
                    y: of_pixel(y),
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

    fn triangle(&mut self, corners: [GridPoint; 3], rect: SpanRect, mut visit: impl FnMut(i32, Covered)) {
        let Some(scan) = TriangleScan::new(corners, rect, self.grid, self.rules) else {
            return;
        };
        let Some(lanes) = &mut self.lanes else {
            return self.triangle_one_by_one(&scan, visit);
        };
        let (found, all) = (&mut self.found, lanes.all());
        dispatch!(simd::level(), simd => scan.find(simd, lanes, found));
        for FoundRun { y, xs, bits } in found.runs() {
            if *bits == 0 {
                continue;
            }
            visit(
                *y,
                if *bits == all {
                    Covered::Whole(*xs)
                } else {
                    Covered::Part(xs.start, SampleMask::of_bits(*bits))
                },
            );
        }
    }

    /// As [`FreePositions::triangle`] for any number of samples.
    fn triangle_one_by_one(&mut self, scan: &TriangleScan, mut visit: impl FnMut(i32, Covered)) {
        self.gains.clear();
        let mut rows = std::mem::take(&mut self.found.parts);
        dispatch!(simd::level(), simd => scan.find_parts(simd, &mut rows));
        for (y, parts) in (scan.rows.start..).zip(&rows) {
            let RowParts { before, inside, after } = *parts;
            for x in (before.start..before.end).chain(after.start..after.end) {
                if let Some(covered) = self.pixel(scan, x, y) {
                    visit(y, covered);
                }
            }
            if !inside.is_empty() {
                visit(y, Covered::Whole(inside));
            }
        }
        self.found.parts = rows;
    }

    fn pixel(&mut self, scan: &TriangleScan, x: i32, y: i32) -> Option<Covered> {
        let whole = Covered::Whole(Span { start: x, end: x + 1 });
        let values = match scan.reach(scan.values(x, y)) {
            PixelReach::Nothing => return None,
            PixelReach::All => return Some(whole),
            PixelReach::Part(values) => values,
        };
        if self.gains.is_empty() || !self.places.are_same() {
            let places = self.places.of_pixel([x, y], &mut self.memory);
            self.gains.clear();
            self.gains.extend(places.iter().map(|place| scan.gains(*place)));
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

#[cfg(test)]
mod tests {
    use std::sync::atomic::AtomicBool;

    use arbtest::arbitrary::{Result, Unstructured};

    use super::*;
    use crate::color::Premultiplied16;
    use crate::raster::list::builder::ChunkBuilder;
    use crate::raster::list::context::ListContext;
    use crate::raster::paint::per_sample::PerSamplePainter;
    use crate::raster::paint::recorder::PaintedCommand;
    use crate::raster::random::{fill, noise};
    use crate::raster::{DisplayList, Framebuffer, RasterSettings, SamplePattern};
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
            ..RasterSettings::default()
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
        let (painted, samples) = painter.replay(&chunks, pixel, list.background(), &mut shape_coverage);
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
