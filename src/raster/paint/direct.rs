//! Tiles of opaque primitives at one sample per pixel: painted straight into the frame.

use crate::color::Resolver;
use crate::geometry::subpixel::GridPoint;
use crate::raster::binning::tile_command::{TileCommand, Work};
use crate::raster::coverage::covered::Covered;
use crate::raster::coverage::shape::Shape;
use crate::raster::coverage::shape_coverage::ShapeCoverage;
use crate::raster::frame::block::PixelBlock;
use crate::raster::list::chunk::Chunk;
use crate::raster::paint::put_runs::put_runs;
use crate::raster::shading::context::{PixelRun, Pixels, ShadeContext};
use crate::raster::shading::{Paint, Shader};
use crate::raster::span::SpanRect;

/// Paints opaque primitives at one sample per pixel.
#[derive(Debug)]
pub(crate) struct DirectPainter<'a> {
    context: ShadeContext<'a>,
    resolver: Resolver,
    /// The pixels of one primitive, counted from the tile's first, and their values.
    runs: Vec<PixelRun>,
    places: Vec<[u16; 2]>,
    shaded: Vec<u32>,
    /// Samples whose colours were computed.
    pub(crate) samples_shaded: u64,
}

impl<'a> DirectPainter<'a> {
    /// A painter for one drawing.
    pub(crate) fn new(context: ShadeContext<'a>) -> Self {
        Self {
            resolver: Resolver::new(1, context.sampling.rules),
            context,
            runs: Vec::new(),
            places: Vec::new(),
            shaded: Vec::new(),
            samples_shaded: 0,
        }
    }

    /// Paints the commands of one chunk that touch the tile; all must be opaque.
    pub(crate) fn paint(
        &mut self,
        chunk: &Chunk,
        entries: &[TileCommand],
        shape_coverage: &mut ShapeCoverage,
        block: &mut PixelBlock<'_>,
    ) {
        let rules = self.context.sampling.rules;
        for entry in entries {
            match entry.work(chunk) {
                // With one sample per pixel these are the same.
                Work::Flat(Shape::Samples(stamp) | Shape::Pixels(stamp), color) => {
                    block.stamp(stamp, color.to_pixel(rules));
                }
                Work::Flat(shape, color) => {
                    let pixel = color.to_pixel(rules);
                    shape_coverage.each(shape, block.rect, |y, covered| {
                        if let Covered::Whole(xs) = covered {
                            block.span(y, xs).fill(pixel);
                        }
                    });
                }
                Work::Shaded(shape, corners, paint) => {
                    self.runs.clear();
                    let SpanRect { x: left, y: top } = block.rect;
                    let inside = |from: i32, to: i32| u16::try_from(to - from).unwrap_or(u16::MAX);
                    let runs = &mut self.runs;
                    shape_coverage.each(shape, block.rect, |y, covered| {
                        if let Covered::Whole(xs) = covered {
                            runs.push(PixelRun {
                                row: inside(top.start, y),
                                start: inside(left.start, xs.start),
                                end: inside(left.start, xs.end),
                            });
                        }
                    });
                    self.shade(corners, paint, block);
                }
                // This painter is chosen where there are no layers.
                Work::BeginLayer | Work::EndLayer(_) => {}
            }
        }
    }

    /// Shades the pixels of the runs.
    fn shade(&mut self, corners: &[GridPoint; 3], paint: &Paint, block: &mut PixelBlock<'_>) {
        let Self {
            context,
            resolver,
            runs,
            places,
            shaded,
            samples_shaded,
        } = self;
        if runs.is_empty() {
            return;
        }
        let pixels: usize = runs.iter().map(|run| run.len()).sum();
        *samples_shaded += pixels as u64;
        let SpanRect { x, y } = block.rect;
        let grid = context.samples_from([x.start, y.start]);
        let shader = Shader::new(context, corners, paint);
        shaded.resize(shaded.len().max(pixels), 0);
        let values = &mut shaded[..pixels];
        if !shader.runs(runs, grid, resolver, values) {
            places.clear();
            for run in &*runs {
                places.extend(run.places());
            }
            shader.pixels(Pixels { grid, places }, values);
        }
        put_runs(runs, false, values, block);
    }
}
