//! Tiles of opaque primitives at one sample per pixel: painted straight into the frame.

use crate::geometry::subpixel::GridPoint;
use crate::raster::binning::tile_command::{TileCommand, Work};
use crate::raster::coverage::covered::Covered;
use crate::raster::coverage::shape::Shape;
use crate::raster::coverage::shape_coverage::ShapeCoverage;
use crate::raster::frame::block::PixelBlock;
use crate::raster::list::chunk::Chunk;
use crate::raster::shading::context::{Pixels, ShadeContext};
use crate::raster::shading::{Paint, Shader};
use crate::raster::span::SpanRect;

/// Paints opaque primitives at one sample per pixel.
#[derive(Debug)]
pub(crate) struct DirectPainter<'a> {
    context: ShadeContext<'a>,
    /// The pixels of one primitive, counted from the tile's first, and their values.
    places: Vec<[u16; 2]>,
    shaded: Vec<u32>,
    /// Samples whose colours were computed.
    pub(crate) samples_shaded: u64,
}

impl<'a> DirectPainter<'a> {
    /// A painter for one drawing.
    pub(crate) fn new(context: ShadeContext<'a>) -> Self {
        Self {
            context,
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
                    let mut places = std::mem::take(&mut self.places);
                    places.clear();
                    let SpanRect { x: left, y: top } = block.rect;
                    let inside = |from: i32, to: i32| u16::try_from(to - from).unwrap_or(u16::MAX);
                    shape_coverage.each(shape, block.rect, |y, covered| {
                        if let Covered::Whole(xs) = covered {
                            let row = inside(top.start, y);
                            let columns = inside(left.start, xs.start)..inside(left.start, xs.end);
                            places.extend(columns.map(|column| [column, row]));
                        }
                    });
                    self.shaded(corners, paint, &places, block);
                    self.places = places;
                }
                // This painter is chosen where there are no layers.
                Work::BeginLayer | Work::EndLayer(_) => {}
            }
        }
    }

    /// Shades pixels, counted from the tile's first.
    fn shaded(&mut self, corners: &[GridPoint; 3], paint: &Paint, places: &[[u16; 2]], block: &mut PixelBlock<'_>) {
        if places.is_empty() {
            return;
        }
        self.samples_shaded += places.len() as u64;
        self.shaded.resize(self.shaded.len().max(places.len()), 0);
        let values = &mut self.shaded[..places.len()];
        let SpanRect { x, y } = block.rect;
        let pixels = Pixels {
            grid: self.context.samples_from([x.start, y.start]),
            places,
        };
        Shader::new(&self.context, corners, paint).pixels(pixels, values);
        for (place, value) in places.iter().zip(values) {
            block.put(*place, *value);
        }
    }
}
