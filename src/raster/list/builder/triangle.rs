//! Triangles to commands of a chunk: clipped, snapped, and reduced to the samples that they cover where these are few.

use glam::DVec2;

use crate::color::Rgba;
use crate::geometry::clip::{ClippedTriangle, in_guard};
use crate::geometry::edge::doubled_area;
use crate::geometry::subpixel::GridPoint;
use crate::raster::coverage::float_shape::FloatShape;
use crate::raster::coverage::mask8x8::CoverageMask;
use crate::raster::coverage::mask8x8_simd::LANES;
use crate::raster::list::builder::{ChunkBuilder, index};
use crate::raster::list::chunk::{DrawCommand, ScreenTriangle};
use crate::raster::list::hidden::{Hidden, covers, drop_hidden, is_large, joined};
use crate::raster::shading::{Paint, TexturePaint};
use crate::raster::span::SpanRect;
use crate::rules::Rules;
use crate::texture::Footprint;

/// Where triangles are mostly too large to be looked at together, so many after them are not.
const LARGE_RUN: u32 = 100;

impl ChunkBuilder<'_> {
    /// Adds a triangle in screen space; any finite coordinates.
    #[inline]
    pub fn triangle(&mut self, points: [DVec2; 3], paint: &Paint) {
        let points = points.map(|point| point + self.shift);
        if self.stamps
            && self.waiting.hopeless == 0
            && let Some(color) = paint.constant()
        {
            self.wait(points, color);
        } else {
            self.add_waiting();
            self.waiting.hopeless = self.waiting.hopeless.saturating_sub(1);
            self.alone(points, paint);
        }
    }

    /// Keeps a triangle of one colour until there are some.
    #[inline]
    fn wait(&mut self, points: [DVec2; 3], color: Rgba) {
        let waiting = &mut self.waiting;
        waiting.triangles.set(waiting.count, points);
        waiting.colors[waiting.count] = color;
        waiting.sources[waiting.count] = self.source;
        waiting.count += 1;
        if waiting.count == LANES {
            self.add_waiting();
        }
    }

    /// Adds the triangles that wait.
    pub(super) fn add_waiting(&mut self) {
        let count = std::mem::take(&mut self.waiting.count);
        if count == 0 {
            return;
        }
        let source = self.source;
        let coverage = self
            .waiting
            .triangles
            .coverage(self.frame, self.context.grid, self.context.rules);
        if coverage.decided() * 2 < LANES {
            self.waiting.hopeless = LARGE_RUN;
        }
        for lane in 0..count {
            self.source = self.waiting.sources[lane];
            let color = self.waiting.colors[lane];
            match coverage.get(lane) {
                Some(coverage) if coverage.mask == 0 => {}
                Some(coverage) => {
                    self.stamp(coverage, color, DrawCommand::Samples);
                    self.chunk.triangle_count += 1;
                }
                None => self.alone(self.waiting.triangles.get(lane), &Paint::solid(color)),
            }
        }
        self.source = source;
    }

    /// Adds a single triangle.
    #[inline]
    fn alone(&mut self, points: [DVec2; 3], paint: &Paint) {
        if points.iter().all(|point| in_guard(*point)) {
            self.snapped(points, paint);
        } else {
            self.clipped(points, paint);
        }
    }

    /// Adds a triangle in the one colour that `color` gives to the change of `(u, v)` per pixel with which a texture
    /// would be read there.
    pub fn measured_triangle(&mut self, points: [DVec2; 3], uv: [[f32; 2]; 3], color: &dyn Fn(&Footprint) -> Rgba) {
        self.add_waiting();
        let points = points.map(|point| point + self.shift);
        let texture = TexturePaint::new(0, uv, 1.0);
        if points.iter().all(|point| in_guard(*point)) {
            self.measured(points, &texture, color);
        } else if self.may_show(points) {
            for corners in ClippedTriangle::new(points).triangles() {
                self.measured(corners.map(|corner| corner.point), &texture.on_part(&corners), color);
            }
        }
    }

    fn measured(&mut self, points: [DVec2; 3], texture: &TexturePaint, color: &dyn Fn(&Footprint) -> Rgba) {
        let grid = self.context.grid;
        let corners = points.map(|point| grid.snap(point));
        if doubled_area(corners) != 0 {
            let footprint = texture.footprint(grid, &corners);
            self.snapped(points, &Paint::solid(color(&footprint)));
        }
    }

    /// Adds a triangle that reaches beyond the guard band.
    #[cold]
    fn clipped(&mut self, points: [DVec2; 3], paint: &Paint) {
        if self.may_show(points) {
            for corners in ClippedTriangle::new(points).triangles() {
                self.snapped(corners.map(|corner| corner.point), &paint.clipped(&corners));
            }
        }
    }

    /// Adds a triangle inside the guard band, unless it covers no sample of the frame.
    #[inline]
    fn snapped(&mut self, points: [DVec2; 3], paint: &Paint) {
        let (grid, rules) = (self.context.grid, self.context.rules);
        if self.context.coverage.is_exact() {
            return self.by_area(points, paint);
        }
        if rules == Rules::Float {
            return self.float(points, paint);
        }
        let corners = points.map(|point| grid.snap(point));
        let samples = SpanRect::of_samples(corners, grid, rules);
        let inside = samples.intersection(self.frame);
        if inside.is_empty() {
            return;
        }
        if samples.is_small() {
            let mut coverage = CoverageMask::new(corners, samples, grid, rules);
            if inside != samples {
                coverage = coverage.within(self.frame.x, self.frame.y);
            }
            if coverage.mask == 0 {
                return;
            }
            if self.stamps
                && let Some(color) = paint.constant()
            {
                self.stamp(coverage, color, DrawCommand::Samples);
                self.chunk.triangle_count += 1;
                return;
            }
        } else if doubled_area(corners) == 0 {
            return;
        }
        let paint = self.paint(paint);
        let index = index(self.chunk.triangles.len());
        self.chunk.triangles.push(ScreenTriangle { corners, paint });
        self.push(DrawCommand::Triangle(index));
        self.chunk.triangle_count += 1;
        if let Some(color) = self.chunk.paints[paint as usize].constant
            && color.is_opaque()
            && self.hidden == Hidden::Dropped
        {
            self.drop_below_triangle(corners);
        }
    }

    /// Adds a triangle inside the guard band that covers areas of pixels, unless it touches none of the frame.
    #[cold]
    fn by_area(&mut self, points: [DVec2; 3], paint: &Paint) {
        let corners = points.map(|point| self.context.grid.snap(point));
        let pixels = self.context.samples_of(corners).intersection(self.frame);
        if pixels.is_empty() || doubled_area(corners) == 0 {
            return;
        }
        let paint = self.paint(paint);
        let index = index(self.chunk.triangles.len());
        self.chunk.triangles.push(ScreenTriangle { corners, paint });
        self.push(DrawCommand::Triangle(index));
        self.chunk.triangle_count += 1;
    }

    /// Adds a triangle inside the guard band by the rules of first drafts. Colours and coordinates are interpolated as
    /// everywhere, between its corners on the grid.
    #[cold]
    fn float(&mut self, points: [DVec2; 3], paint: &Paint) {
        let grid = self.context.grid;
        let corners = points.map(|point| grid.snap(point));
        // Exact: they have 32 bits.
        let in_frame = points.map(|point| point - self.shift);
        let float = FloatShape::new(in_frame, grid, self.frame, self.context.margin);
        let Some(float) = float.filter(|_| doubled_area(corners) != 0) else {
            return;
        };
        let paint = self.paint(paint);
        let index = index(self.chunk.triangles.len());
        self.chunk.triangles.push(ScreenTriangle { corners, paint });
        self.chunk.floats.push(float);
        self.push(DrawCommand::Triangle(index));
        self.chunk.triangle_count += 1;
    }

    /// Whether a triangle is finite and its box touches the frame at all.
    fn may_show(&self, [a, b, c]: [DVec2; 3]) -> bool {
        if ![a, b, c].iter().all(|point| point.is_finite()) {
            return false;
        }
        let (low, high) = (a.min(b).min(c), a.max(b).max(c));
        let frame = DVec2::new(f64::from(self.context.size[0]), f64::from(self.context.size[1]));
        high.cmpge(DVec2::ZERO).all() && low.cmple(frame).all()
    }

    /// Drops what a triangle of one colour hides that came last, alone or with the one before.
    fn drop_below_triangle(&mut self, corners: [GridPoint; 3]) {
        let (grid, rules) = (self.context.grid, self.context.rules);
        let samples = SpanRect::of_samples(corners, grid, rules);
        let inside = samples.intersection(self.frame);
        // The halves of a large rectangle have its box, so that one look is enough for nearly all triangles.
        if !is_large(inside, self.context) {
            return;
        }
        // The corners of its own box are not all inside a triangle.
        if inside != samples && covers(&corners, inside, grid, rules) {
            drop_hidden(&mut self.chunk, self.context, inside, 1);
        }
        let [.., DrawCommand::Triangle(before), DrawCommand::Triangle(_)] = *self.chunk.commands else {
            return;
        };
        let before = self.chunk.triangles[before as usize];
        if self
            .chunk
            .triangles
            .last()
            .is_some_and(|last| last.paint == before.paint)
            && let Some(group) = joined(before.corners, corners)
        {
            let [a, b] = [before.corners, corners].map(|corners| SpanRect::of_samples(corners, grid, rules));
            let inside = a.union(b).intersection(self.frame);
            if is_large(inside, self.context) && covers(&group, inside, grid, rules) {
                drop_hidden(&mut self.chunk, self.context, inside, 2);
            }
        }
    }
}
