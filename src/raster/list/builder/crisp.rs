//! Polygons with crisp edges: they cover whole pixels, those whose middles they hold.
//!
//! ```text
//!      +-----+-----+-----+        the edge passes      +-----+-----+-----+
//!      |   __|--.  |     |        right of the middle  |#####|#####|     |
//!      |--'  |  .  |  .  |        of the second pixel  |#####|#####|     |
//!      +-----+-----+-----+                             +-----+-----+-----+
//! ```
//!
//! The polygon is scanned as with one sample per pixel; the runs of pixels that are found are an outline again, so that
//! everything behind this file sees a polygon like any other.

use glam::DVec2;

use crate::geometry::subpixel::SubpixelGrid;
use crate::geometry::{FillRule, Polygon};
use crate::raster::coverage::polygon::OutlineBuilder;
use crate::raster::list::builder::ChunkBuilder;
use crate::raster::shading::Paint;
use crate::raster::span::{Span, SpanRect};

impl ChunkBuilder<'_> {
    /// As [`ChunkBuilder::polygon`], but each pixel is covered with all its samples if its middle is inside, and not at all
    /// otherwise.
    pub fn crisp_polygon(&mut self, polygon: &Polygon, place: impl Fn(DVec2) -> DVec2, paint: &Paint) {
        let shift = self.shift;
        let runs = self.runs_of_pixels(polygon, |point| place(point) + shift);
        let corner = |x: i32, y: i32| DVec2::new(x.into(), y.into());
        let contours = runs.iter().map(|SpanRect { x, y }| {
            [
                corner(x.start, y.start),
                corner(x.end, y.start),
                corner(x.end, y.end),
                corner(x.start, y.end),
            ]
            .into_iter()
        });
        self.outline(contours, FillRule::NonZero, paint);
    }

    /// The pixels whose middles a polygon holds, as rectangles that do not overlap; `place` brings points to where they are
    /// painted.
    fn runs_of_pixels(&mut self, polygon: &Polygon, place: impl Fn(DVec2) -> DVec2) -> Vec<SpanRect> {
        let grid = SubpixelGrid::new(1);
        let [columns, rows] = self.context.size.map(|pixels| Span {
            start: 0,
            end: pixels.cast_signed(),
        });
        let mut edges = Vec::new();
        let mut builder = OutlineBuilder::new(grid, SpanRect { x: columns, y: rows }, &mut edges);
        for contour in polygon.contours() {
            builder.contour(contour.iter().map(|point| place(*point)));
        }
        let Some(outline) = builder.finish(polygon.rule()) else {
            return Vec::new();
        };
        self.spans.clear();
        let outline = outline.with_edges(&edges);
        let stored = self
            .scanner
            .scan(outline, grid, SpanRect { x: columns, y: rows }, &mut self.spans);
        let found = self.spans.get(stored);
        let mut runs: Vec<SpanRect> = Vec::new();
        // Where the runs of the row before begin: rows with the same ones share their rectangles.
        let mut before = 0;
        for row in found.rows.start..found.rows.end {
            let spans = found.of_row(row).iter().filter(|span| !span.is_empty());
            let last = &mut runs[before..];
            if spans.clone().eq(last.iter().map(|run| &run.x)) {
                for run in last {
                    run.y.end = row + 1;
                }
                continue;
            }
            before = runs.len();
            runs.extend(spans.map(|span| SpanRect {
                x: *span,
                y: Span {
                    start: row,
                    end: row + 1,
                },
            }));
        }
        runs
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::raster::list::context::ListContext;
    use crate::raster::span::to_index;
    use crate::raster::{RasterSettings, SampleRate};

    #[test]
    fn pixels_are_covered_whose_middles_are_inside() {
        let settings = RasterSettings {
            rate: SampleRate::new(16).expect("a square number"),
            ..RasterSettings::default()
        };
        let size = [20, 16];
        let context = ListContext::new(size, &settings);
        arbtest::arbtest(|u| {
            // Sixteenths, so that no edge passes so close to a middle that its snapping decides.
            let mut at = |most: i32| Ok(f64::from(u.int_in_range(-32..=most * 16)?) / 16.0 + 1.0 / 64.0);
            let mut point = || -> arbtest::arbitrary::Result<DVec2> { Ok(DVec2::new(at(22)?, at(18)?)) };
            let contours = [
                vec![point()?, point()?, point()?, point()?],
                vec![point()?, point()?, point()?],
            ];
            let rule = *u.choose(&[FillRule::NonZero, FillRule::EvenOdd])?;
            let polygon = Polygon::new(contours.clone(), rule);
            let mut builder = ChunkBuilder::new(&context, 1);
            let runs = builder.runs_of_pixels(&polygon, |point| point);
            let mut covered = vec![0; (size[0] * size[1]) as usize];
            for run in &runs {
                for y in run.y.start..run.y.end {
                    for x in run.x.start..run.x.end {
                        covered[to_index(y) * size[0] as usize + to_index(x)] += 1;
                    }
                }
            }
            for (i, times) in (0..).zip(covered) {
                let middle = DVec2::new(f64::from(i % size[0]) + 0.5, f64::from(i / size[0]) + 0.5);
                let mut winding = 0;
                let mut near = false;
                for contour in &contours {
                    for (from, to) in contour.iter().zip(contour.iter().cycle().skip(1)) {
                        let side = (*to - *from).perp_dot(middle - *from);
                        near |= side.abs() < 0.02 * (1.0 + from.distance(*to));
                        if (from.y <= middle.y) != (to.y <= middle.y) && (side > 0.0) == (to.y > from.y) {
                            winding += if to.y > from.y { 1 } else { -1 };
                        }
                    }
                }
                let expected = i32::from(rule.encloses(winding));
                assert!(near || times == expected, "{middle} in {contours:?}: {times} times");
                assert!(times <= 1, "no pixel twice");
            }
            Ok(())
        })
        .budget_ms(300);
    }
}
