//! Screen-space primitives to the commands of a chunk: clipped, snapped, and left out where no sample is covered.

mod crisp;
mod triangle;

use glam::DVec2;

use crate::color::{Premultiplied16, Rgba};
use crate::geometry::clip::in_guard;
use crate::geometry::subpixel::{GridPoint, floor_to_i32};
use crate::geometry::{FillRule, Polygon};
use crate::raster::coverage::mask8x8::CoverageMask;
use crate::raster::coverage::mask8x8_simd::{LANES, TriangleBatch};
use crate::raster::coverage::polygon::OutlineBuilder;
use crate::raster::coverage::polygon_rows::{RowScanner, SpanStore};
use crate::raster::layers::Compositing;
use crate::raster::list::chunk::{Chunk, ChunkPaint, DrawCommand, LayerMark, Stamp};
use crate::raster::list::context::ListContext;
use crate::raster::list::hairline::Hairline;
use crate::raster::list::hidden::{Hidden, MOST_CORNERS, covers, drop_hidden, is_large};
use crate::raster::shading::Paint;
use crate::raster::span::SpanRect;
use crate::rules::Rules;

/// Fills one chunk.
#[derive(Debug)]
pub struct ChunkBuilder<'a> {
    context: &'a ListContext,
    /// From places in the frame to where they are painted.
    shift: DVec2,
    /// The samples that are painted.
    frame: SpanRect,
    chunk: Chunk,
    source: u32,
    /// The colour used last, as given and as stored.
    color: (Rgba, Premultiplied16),
    /// Memory for the spans of small polygons.
    scanner: RowScanner,
    spans: SpanStore,
    /// Whether small shapes become stamps.
    stamps: bool,
    /// Whether fragments are counted rather than painted.
    counts: bool,
    hidden: Hidden,
    /// Triangles that came last, yet to be added.
    waiting: Waiting,
}

/// Triangles of one colour each that are looked at together.
#[derive(Debug)]
struct Waiting {
    count: usize,
    /// How many triangles to come are not worth waiting for.
    hopeless: u32,
    triangles: TriangleBatch,
    colors: [Rgba; LANES],
    sources: [u32; LANES],
}

impl<'a> ChunkBuilder<'a> {
    /// An empty chunk with room for some primitives.
    pub fn new(context: &'a ListContext, primitives: usize) -> Self {
        let stored = Premultiplied16::from_straight(Rgba::BLACK, context.rules);
        Self {
            context,
            shift: context.shift(),
            frame: context.samples(),
            chunk: Chunk {
                commands: Vec::with_capacity(primitives),
                sources: Vec::with_capacity(primitives),
                ..Chunk::default()
            },
            source: 0,
            color: (Rgba::BLACK, stored),
            scanner: RowScanner::default(),
            spans: SpanStore::default(),
            // A few points of a finer lattice need not be samples, and stamps are exact.
            stamps: context.is_grid() && context.rules != Rules::Float && !context.coverage.is_exact(),
            counts: false,
            // What is drawn over a pixel's area does not hide what lies there.
            hidden: if context.coverage.is_exact() {
                Hidden::Kept
            } else {
                Hidden::Dropped
            },
            waiting: Waiting {
                count: 0,
                hopeless: 0,
                triangles: TriangleBatch::default(),
                colors: [Rgba::BLACK; LANES],
                sources: [0; LANES],
            },
        }
    }

    /// Whatever its fill, every fragment adds [`Premultiplied16::FRAGMENT`] to its sample.
    #[must_use]
    pub fn with_counts(mut self) -> Self {
        self.counts = true;
        self.color = (Rgba::TRANSPARENT, Premultiplied16::FRAGMENT);
        self.chunk.translucent = true;
        self
    }

    /// What `add` adds is told of nowhere: it lies over something of the scene that was added before.
    pub fn untold(&mut self, add: impl FnOnce(&mut Self)) {
        self.add_waiting();
        let told = self.chunk.triangle_count;
        add(self);
        self.add_waiting();
        self.chunk.triangle_count = told;
    }

    /// What `add` adds is painted, though fragments are counted otherwise.
    pub fn uncounted(&mut self, add: impl FnOnce(&mut Self)) {
        self.add_waiting();
        let counting = (std::mem::take(&mut self.counts), self.color);
        self.color = (
            Rgba::BLACK,
            Premultiplied16::from_straight(Rgba::BLACK, self.context.rules),
        );
        add(self);
        self.add_waiting();
        (self.counts, self.color) = counting;
    }

    /// Keeps small triangles and polygons as they are, rather than reduced to the samples that they cover.
    #[must_use]
    pub fn with_all_shapes(mut self) -> Self {
        self.stamps = false;
        self.with_hidden()
    }

    /// Keeps what lies below opaque shapes, for those who ask what was painted.
    #[must_use]
    pub fn with_hidden(mut self) -> Self {
        self.hidden = Hidden::Kept;
        self.chunk.keeps_hidden = true;
        self
    }

    /// Everything added from here on comes from the caller's primitive number `source`.
    pub fn set_source(&mut self, source: u32) {
        self.source = source;
    }

    /// The finished chunk.
    pub fn finish(mut self) -> Chunk {
        self.add_waiting();
        self.chunk
    }

    /// Adds a polygon, its points brought to screen space by `place`; nothing where any of them is not finite there. Its
    /// paint must be one that needs no corners to interpolate between.
    pub fn polygon(&mut self, polygon: &Polygon, place: impl Fn(DVec2) -> DVec2, paint: &Paint) {
        let shift = self.shift;
        let place = &|point| place(point) + shift;
        let contours = polygon.contours();
        let contours = contours.map(|contour| contour.iter().map(|point| place(*point)));
        let hidden = self.outline(contours, polygon.rule(), paint);
        if let Some(samples) = hidden.filter(|_| polygon.points().len() <= MOST_CORNERS) {
            // So few are one contour.
            let points = polygon.points().iter().map(|point| place(*point));
            self.drop_below_polygon(points, samples);
        }
    }

    /// Adds closed contours in screen space. The box of the samples that they hide from what lies below, if their paint is opaque
    /// and they are not small.
    fn outline(
        &mut self,
        contours: impl Iterator<Item = impl Iterator<Item = DVec2>>,
        rule: FillRule,
        paint: &Paint,
    ) -> Option<SpanRect> {
        self.add_waiting();
        let (grid, frame) = (self.context.grid, self.frame);
        let mut builder = OutlineBuilder::new(grid, frame, &mut self.chunk.outline_edges);
        if self.context.coverage.is_exact() {
            builder = builder.touched();
        }
        for contour in contours {
            builder.contour(contour);
        }
        let outline = builder.finish(rule)?;
        if self.stamps
            && let Some(color) = paint.constant()
            && let Some(coverage) =
                outline
                    .with_edges(&self.chunk.outline_edges)
                    .coverage_mask(grid, &mut self.scanner, &mut self.spans)
        {
            outline.drop_edges(&mut self.chunk.outline_edges);
            if coverage.mask != 0 {
                self.stamp(coverage, color, DrawCommand::Samples);
                self.chunk.triangle_count += 1;
            }
            return None;
        }
        let index = index(self.chunk.outlines.len());
        let (paint, samples) = (self.paint(paint), outline.samples);
        let hides = self.chunk.paints[paint as usize]
            .constant
            .is_some_and(Premultiplied16::is_opaque);
        self.chunk.outlines.push(outline);
        self.chunk.outline_paints.push(paint);
        self.push(DrawCommand::Outline(index));
        self.chunk.triangle_count += 1;
        hides.then_some(samples)
    }

    /// Drops what a polygon of few corners hides that came last and holds `samples`.
    fn drop_below_polygon(&mut self, points: impl Iterator<Item = DVec2>, samples: SpanRect) {
        if self.hidden == Hidden::Kept || !is_large(samples, self.context) {
            return;
        }
        let grid = self.context.grid;
        let snapped: Option<Vec<GridPoint>> = points.map(|point| in_guard(point).then(|| grid.snap(point))).collect();
        // Outlines are exact whatever the rules.
        if snapped.is_some_and(|corners| covers(&corners, samples, grid, Rules::Standard)) {
            drop_hidden(&mut self.chunk, self.context, samples, 1);
        }
    }

    /// Adds a line one pixel wide; any finite coordinates.
    pub fn hairline(&mut self, ends: [DVec2; 2], color: Rgba) {
        self.add_waiting();
        let color = self.color(color);
        if let Some(line) = Hairline::new(ends, self.context.size, self.context.margin, color) {
            let index = index(self.chunk.hairlines.len());
            self.chunk.hairlines.push(line);
            self.push(DrawCommand::Hairline(index));
        }
    }

    /// Adds a single pixel.
    pub fn point(&mut self, at: DVec2, color: Rgba) {
        self.add_waiting();
        let (x, y) = (at.x.floor() + self.shift.x, at.y.floor() + self.shift.y);
        let [width, height] = self.context.size.map(f64::from);
        if x >= 0.0 && x < width && y >= 0.0 && y < height {
            let coverage = CoverageMask {
                column: floor_to_i32(x),
                row: floor_to_i32(y),
                mask: 1,
            };
            self.stamp(coverage, color, DrawCommand::Pixels);
        }
    }

    /// Starts a transparent layer.
    pub fn begin_layer(&mut self) {
        self.layer(None, DrawCommand::BeginLayer);
    }

    /// Composites the layer with what is below it.
    pub fn end_layer(&mut self, compositing: Compositing) {
        self.layer(Some(compositing), DrawCommand::EndLayer);
    }

    fn layer(&mut self, compositing: Option<Compositing>, command: fn(u32) -> DrawCommand) {
        self.add_waiting();
        let index = index(self.chunk.layers.len());
        let area = SpanRect::EMPTY;
        self.chunk.layers.push(LayerMark {
            area,
            limits: false,
            compositing,
        });
        self.push(command(index));
    }

    #[inline]
    fn push(&mut self, command: DrawCommand) {
        self.chunk.commands.push(command);
        self.chunk.sources.push(self.source);
    }

    #[inline]
    fn stamp(&mut self, coverage: CoverageMask, color: Rgba, command: fn(u32) -> DrawCommand) {
        let color = self.color(color);
        let stamps = &mut self.chunk.stamps;
        if stamps.is_empty() {
            // What begins with one small primitive mostly goes on like that.
            stamps.reserve(self.chunk.commands.capacity());
        }
        let index = index(stamps.len());
        stamps.push(Stamp { coverage, color });
        self.push(command(index));
    }

    /// A colour as it is stored; the same one twice costs nothing.
    #[inline]
    fn color(&mut self, color: Rgba) -> Premultiplied16 {
        if color != self.color.0 && !self.counts {
            self.color = (color, Premultiplied16::from_straight(color, self.context.rules));
            self.chunk.translucent |= !self.color.1.is_opaque();
        }
        self.color.1
    }

    /// The index of a paint; runs of the same one share it.
    fn paint(&mut self, paint: &Paint) -> u32 {
        let constant = match paint.constant() {
            Some(color) => Some(self.color(color)),
            None => self.counts.then_some(Premultiplied16::FRAGMENT),
        };
        let paint = ChunkPaint {
            paint: *paint,
            constant,
        };
        if !self.chunk.paints.last().is_some_and(|last| last.is_like(&paint)) {
            self.chunk.paints.push(paint);
        }
        index(self.chunk.paints.len() - 1)
    }
}

/// A chunk holds far fewer than `2^32` of anything: its input is a slice of at most 65 536 primitives, each of which
/// adds at most five triangles.
fn index(value: usize) -> u32 {
    u32::try_from(value).unwrap_or(u32::MAX)
}

#[cfg(test)]
mod tests {
    use arbtest::arbitrary::{Result, Unstructured};

    use super::*;
    use crate::raster::{RasterSettings, SampleRate};
    use crate::rules::Rules;
    use crate::texture::SamplingSettings;

    const SIZE: [u32; 2] = [40, 30];

    fn settings(u: &mut Unstructured<'_>) -> Result<RasterSettings> {
        let side: u32 = u.int_in_range(1..=4)?;
        Ok(RasterSettings {
            rate: SampleRate::new(side * side).expect("a square number"),
            sampling: SamplingSettings {
                rules: *u.choose(&Rules::ALL)?,
                ..SamplingSettings::default()
            },
            ..RasterSettings::default()
        })
    }

    /// Adds anything, mostly tiny triangles.
    fn add(u: &mut Unstructured<'_>, builders: &mut [ChunkBuilder<'_>; 2]) -> Result<()> {
        let color = *u.choose(&[Rgba::BLACK, Rgba::WHITE, Rgba { a: 0.5, ..Rgba::BLACK }])?;
        let paint = if u.ratio(1, 8)? {
            Paint::vertex([color, Rgba::BLACK, color])
        } else {
            Paint::solid(color)
        };
        let reach = *u.choose(&[2.0, 2.0, 2.0, 2.0, 9.0, 1e5])?;
        let mut at = |from: f64, to: f64| Ok(from + (to - from) * f64::from(u.int_in_range(0..=64_u32)?) / 64.0);
        let corner = DVec2::new(at(-2.0, 40.0)?, at(-2.0, 30.0)?);
        let mut point = || Ok(corner + DVec2::new(at(0.0, reach)?, at(0.0, reach)?));
        let points = [point()?, point()?, point()?];
        let kind = u.int_in_range(0..=20)?;
        let layers = u.arbitrary()?;
        for builder in builders {
            match kind {
                0 => builder.point(points[0], color),
                1 => builder.hairline([points[0], points[1]], color),
                2 if layers => builder.begin_layer(),
                2 => builder.end_layer(Compositing::with_opacity(0.5)),
                _ => builder.triangle(points, &paint),
            }
        }
        Ok(())
    }

    #[test]
    fn chunks_are_the_same_whether_triangles_wait_or_not() {
        let mut stamps = 0;
        arbtest::arbtest(|u| {
            let settings = settings(u)?;
            let context = ListContext::new(SIZE, &settings);
            let mut builders = [ChunkBuilder::new(&context, 9), ChunkBuilder::new(&context, 9)];
            for source in 0..u.int_in_range(1..=60)? {
                builders[1].waiting.hopeless = u32::MAX;
                for builder in &mut builders {
                    builder.set_source(source);
                }
                add(u, &mut builders)?;
            }
            let [waited, alone] = builders.map(ChunkBuilder::finish);
            stamps += waited.stamps.len();
            assert!(waited.sources.is_sorted(), "in painter's order: {:?}", waited.sources);
            assert_eq!(format!("{waited:?}"), format!("{alone:?}"), "{settings:?}");
            Ok(())
        })
        .budget_ms(400);
        assert!(stamps > 100, "{stamps} stamps");
    }
}
