//! Tiles in two steps: first what each sample shows, then the colours of what is seen.
//!
//! Nothing hidden is ever shaded, and a primitive's part of a pixel is shaded as one, whatever the number of samples:
//! its sum over the samples is taken before anything is rounded. Translucent flat colours are mixed once for all
//! samples that show the same. The second step is in `resolve`; in `resolve_by_samples` where each sample is shaded and rounded for
//! itself, because samples do not lie on the grid or their light is averaged.

use fearless_simd::{Simd, dispatch};

use crate::color::{Premultiplied16, Resolver};
use crate::raster::binning::tile_command::{TileCommand, Work};
use crate::raster::coverage::shape::Shape;
use crate::raster::coverage::shape_coverage::ShapeCoverage;
use crate::raster::layers::Compositing;
use crate::raster::layers::stack::LayerStack;
use crate::raster::list::chunk::Chunk;
use crate::raster::paint::method::Rounding;
use crate::raster::paint::visibility::buffer::VisibilityBuffer;
use crate::raster::paint::visibility::by_samples::BySamples;
use crate::raster::paint::visibility::fragments::FragmentSums;
use crate::raster::paint::visibility::layer_end::LayerEnd;
use crate::raster::paint::visibility::paint_stack::{Primitive, Translucent};
use crate::raster::paint::visibility::shading_queue::ShadingQueue;
use crate::raster::paint::visibility::surfaces::SurfaceTable;
use crate::raster::sampling::positions::SamplePositions;
use crate::raster::shading::context::ShadeContext;
use crate::raster::span::SpanRect;
use crate::raster::surface_id::{MAX_SURFACES, SurfaceId};
use crate::simd;

/// What becomes of a tile in which so many surfaces are made, by translucent paints over each other, that they do not pay.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Crowds {
    /// Samples are better blended one by one.
    GivenUp,
    /// It is painted: no other method gives the same bytes.
    Painted,
}

/// So many surfaces in use, a fair part of a tile's samples, are more than one for each pixel.
const CROWD: usize = MAX_SURFACES / 8;

/// Surfaces mixed of others, in a tile and by each of its commands, beyond which they do not pay: one takes as long to mix as some
/// ten samples to blend, and then hardly any two samples share it.
const MIXED: usize = 1 << 12;
const MIXED_BY_COMMAND: usize = 8;

/// Paints tiles, one after the other, reusing its memory. Where sums of samples are shaded, only opaque primitives are.
#[derive(Debug)]
pub(crate) struct VisibilityPainter<'a> {
    pub(super) context: ShadeContext<'a>,
    pub(super) resolver: Resolver,
    pub(super) layers: LayerStack<VisibilityBuffer>,
    pub(super) surfaces: SurfaceTable<'a>,
    pub(super) unresolved: ShadingQueue,
    pub(super) fragments: FragmentSums,
    /// Memory for the values of pixels, and for the ends of the runs of each row.
    pub(super) values: Vec<u32>,
    pub(super) run_ends: Vec<u64>,
    pub(super) by_samples: BySamples,
    pub(super) rounding: Rounding,
    crowds: Crowds,
    /// How many were painted in the tile.
    commands: usize,
    /// Samples whose colours were computed.
    pub(crate) samples_shaded: u64,
}

impl<'a> VisibilityPainter<'a> {
    /// A painter for one drawing.
    pub(crate) fn new(context: ShadeContext<'a>, positions: SamplePositions) -> Self {
        let side = context.rate.side();
        let resolver = Resolver::new(side * side, context.sampling.rules);
        Self {
            context,
            resolver,
            layers: LayerStack::new(buffer(&context)),
            surfaces: SurfaceTable::new(context.sampling.rules, resolver),
            unresolved: ShadingQueue::default(),
            fragments: FragmentSums::default(),
            values: Vec::new(),
            run_ends: Vec::new(),
            by_samples: BySamples::new(&context, positions),
            rounding: Rounding::Sums,
            crowds: Crowds::GivenUp,
            commands: 0,
            samples_shaded: 0,
        }
    }

    /// Starts a tile, for which `rounding` says what is rounded of what is shaded, and `crowds` what becomes of it where surfaces do
    /// not pay.
    pub(crate) fn begin(
        &mut self,
        rect: SpanRect,
        background: Premultiplied16,
        (rounding, crowds): (Rounding, Crowds),
    ) {
        self.rounding = rounding;
        self.crowds = crowds;
        self.commands = 0;
        self.surfaces.clear(rounding);
        let surface = self.surfaces.flat(background);
        self.layers.restart().reset(rect, surface);
    }

    /// Paints the commands of one chunk that touch the tile; false, and the tile is of no use, where there are too many surfaces, or
    /// translucent paints on top of each other.
    #[must_use]
    pub(crate) fn paint(
        &mut self,
        chunk: &'a Chunk,
        entries: &[TileCommand],
        shape_coverage: &mut ShapeCoverage,
    ) -> bool {
        for entry in entries {
            self.commands += 1;
            let is_crowded = self.surfaces.mixed > MIXED + MIXED_BY_COMMAND * self.commands;
            if is_crowded && self.crowds == Crowds::GivenUp {
                return false;
            }
            if self.surfaces.is_full() {
                self.make_room();
                if self.crowds == Crowds::GivenUp && self.surfaces.len() > CROWD {
                    return false;
                }
            }
            if self.surfaces.has_too_many_paints() {
                return false;
            }
            match entry.work(chunk) {
                Work::Flat(shape, color) if color.is_opaque() => {
                    let surface = self.surfaces.flat(color);
                    self.opaque(shape, surface, shape_coverage);
                }
                Work::Flat(shape, color) => self.translucent(shape, Translucent::Flat(color), shape_coverage),
                Work::Shaded(shape, corners, paint) => {
                    let primitive = Primitive { corners, paint };
                    if entry.is_opaque() {
                        let surface = self.surfaces.shaded(primitive);
                        self.opaque(shape, surface, shape_coverage);
                    } else {
                        self.translucent(shape, Translucent::Shaded(primitive), shape_coverage);
                    }
                }
                Work::BeginLayer => self.begin_layer(),
                Work::EndLayer(compositing) => self.end_layer(compositing),
            }
        }
        true
    }

    #[inline]
    fn opaque(&mut self, shape: Shape<'_>, surface: SurfaceId, shape_coverage: &mut ShapeCoverage) {
        let narrow_side = self.narrow_side(shape);
        let tile = self.layers.top();
        match (shape, narrow_side) {
            (Shape::Tile, _) => tile.cover(surface),
            (_, Some(NarrowSide::Two)) => {
                dispatch!(simd::level(), simd => opaque_rows::<_, 2>(simd, shape, shape_coverage, tile, surface));
            }
            (_, Some(NarrowSide::Four)) => {
                dispatch!(simd::level(), simd => opaque_rows::<_, 4>(simd, shape, shape_coverage, tile, surface));
            }
            (_, None) => shape_coverage.each(
                shape,
                tile.rect,
                #[inline(always)]
                |y, covered| tile.paint(y, covered, surface),
            ),
        }
    }

    fn translucent(&mut self, shape: Shape<'_>, above: Translucent<'a>, shape_coverage: &mut ShapeCoverage) {
        let narrow_side = self.narrow_side(shape);
        let (tile, surfaces) = (self.layers.top(), &mut self.surfaces);
        surfaces.next_paint();
        let tint = Tint { surfaces, above };
        match narrow_side {
            Some(NarrowSide::Two) => {
                dispatch!(simd::level(), simd => translucent_rows::<_, 2>(simd, shape, shape_coverage, tile, tint));
            }
            Some(NarrowSide::Four) => {
                dispatch!(simd::level(), simd => translucent_rows::<_, 4>(simd, shape, shape_coverage, tile, tint));
            }
            None => shape_coverage.each(
                shape,
                tile.rect,
                #[inline(always)]
                |y, covered| tile.change(y, covered, |surface| tint.surfaces.under(surface, tint.above)),
            ),
        }
    }

    fn begin_layer(&mut self) {
        let rect = self.layers.base().rect;
        let surface = self.surfaces.flat(Premultiplied16::TRANSPARENT);
        let layer = self.layers.push(|| buffer(&self.context));
        layer.reset(rect, surface);
    }

    fn end_layer(&mut self, compositing: Compositing) {
        if let Some((below, layer)) = self.layers.pop() {
            below.composite(layer, &mut LayerEnd::new(&mut self.surfaces, compositing));
        }
    }

    /// Whether a pixel has 2 x 2 or 4 x 4 samples of the grid and a shape may have many rows of them, so that it pays to look
    /// at several at once.
    #[inline]
    fn narrow_side(&self, shape: Shape<'_>) -> Option<NarrowSide> {
        // The lattice of other positions is far finer.
        match (self.context.grid.side(), shape) {
            (_, Shape::Tile | Shape::Samples(_) | Shape::Pixels(_)) => None,
            (2, _) => Some(NarrowSide::Two),
            (4, _) => Some(NarrowSide::Four),
            _ => None,
        }
    }

    /// Makes sure that every surface may be mixed with the next paint. There are twice as many numbers as samples in a
    /// tile and its layers, so that some are out of use when all are given away.
    fn make_room(&mut self) {
        let mut used = vec![false; MAX_SURFACES];
        let layers = self.layers.in_use();
        for layer in &*layers {
            layer.each_surface(|surface| used[usize::from(surface)] = true);
        }
        let numbers = self.surfaces.keep(&used);
        for layer in layers {
            layer.renumber(|surface| numbers[usize::from(surface)]);
        }
    }
}

/// How many samples lie along a side of a pixel where several rows of pixels are looked at at once.
#[derive(Clone, Copy, Debug)]
enum NarrowSide {
    Two,
    Four,
}

/// A translucent paint, and the surfaces that it makes of those below it.
struct Tint<'t, 'a> {
    surfaces: &'t mut SurfaceTable<'a>,
    above: Translucent<'a>,
}

/// A buffer of no pixels.
fn buffer(context: &ShadeContext<'_>) -> VisibilityBuffer {
    VisibilityBuffer::new(context.rate.side().cast_signed())
}

/// Lets the samples of a shape show `surface`, where a pixel has `SIDE` x `SIDE` samples.
#[inline(always)]
#[expect(clippy::inline_always, reason = "vector instructions reach inlined code only")]
fn opaque_rows<S: Simd, const SIDE: usize>(
    simd: S,
    shape: Shape<'_>,
    shape_coverage: &mut ShapeCoverage,
    tile: &mut VisibilityBuffer,
    surface: SurfaceId,
) {
    simd.vectorize(
        #[inline(always)]
        || {
            shape_coverage.each_narrow_row::<_, SIDE>(
                simd,
                shape,
                tile.rect,
                #[inline(always)]
                |row| tile.paint_row(simd, row, surface),
            );
        },
    );
}

/// Paints a translucent colour over the samples of a shape, where a pixel has `SIDE` x `SIDE` samples.
#[inline(always)]
#[expect(clippy::inline_always, reason = "vector instructions reach inlined code only")]
fn translucent_rows<S: Simd, const SIDE: usize>(
    simd: S,
    shape: Shape<'_>,
    shape_coverage: &mut ShapeCoverage,
    tile: &mut VisibilityBuffer,
    Tint { surfaces, above }: Tint<'_, '_>,
) {
    simd.vectorize(
        #[inline(always)]
        || {
            shape_coverage.each_narrow_row::<_, SIDE>(
                simd,
                shape,
                tile.rect,
                #[inline(always)]
                |row| tile.change_row(simd, row, |surface| surfaces.under(surface, above)),
            );
        },
    );
}

#[cfg(test)]
mod tests {
    use std::sync::atomic::AtomicBool;

    use glam::DVec2;

    use super::*;
    use crate::color::{ResolveSpace, Rgba};
    use crate::raster::frame::block::PixelBlock;
    use crate::raster::frame::framebuffer::Framebuffer;
    use crate::raster::list::builder::ChunkBuilder;
    use crate::raster::list::context::ListContext;
    use crate::raster::paint::sample_colors::SampleColors;
    use crate::raster::paint::visibility::paint_stack::MOST;
    use crate::raster::paint::wide::flat::PixelBits;
    use crate::raster::random::{fill, noise};
    use crate::raster::shading::Paint;
    use crate::raster::span::Span;
    use crate::raster::tiles::Painters;
    use crate::raster::{DisplayList, RasterSettings, SamplePattern, SampleRate, ShadingRate};
    use crate::rules::Rules;
    use crate::texture::SamplingSettings;

    const SIZE: [u32; 2] = [70, 50];

    fn settings() -> RasterSettings {
        RasterSettings {
            rate: SampleRate::new(4).expect("a square number"),
            pattern: SamplePattern::Jittered,
            ..RasterSettings::default()
        }
    }

    /// The pixels of a tile that are blended sample by sample, row by row.
    fn blended<'a>(
        painters: &mut Painters<'a>,
        list: &DisplayList<'_>,
        (chunk, commands): (&'a Chunk, &[TileCommand]),
        rect: SpanRect,
    ) -> Vec<u32> {
        painters.per_sample.begin(rect, list.background());
        painters.per_sample.paint(chunk, commands, &mut painters.shape_coverage);
        let width = rect.x.length();
        let mut pixels = vec![0; width * rect.y.length()];
        for (row, y) in pixels.chunks_exact_mut(width).zip(rect.y.start..) {
            painters.per_sample.resolve(y, row);
        }
        pixels
    }

    #[test]
    fn tiles_are_those_of_the_painter_that_blends_each_sample() {
        let texture = noise();
        let (mut flat, mut shaded) = (0, 0);
        arbtest::arbtest(|u| {
            let settings = RasterSettings {
                rate: SampleRate::new(*u.choose(&[1, 4, 9, 16, 25, 64, 100])?).expect("a square number"),
                pattern: *u.choose(&SamplePattern::ALL)?,
                shading: *u.choose(&[ShadingRate::Sample, ShadingRate::Centre])?,
                sampling: SamplingSettings {
                    rules: *u.choose(&Rules::ALL)?,
                    ..SamplingSettings::default()
                },
                space: *u.choose(&ResolveSpace::ALL)?,
                background: *u.choose(&[Rgba::WHITE, Rgba::TRANSPARENT])?,
                ..settings()
            };
            let context = ListContext::new(SIZE, &settings);
            let mut builder = ChunkBuilder::new(&context, 12);
            fill(&mut builder, u)?;
            let list = DisplayList::new(context, settings, vec![builder.finish()], vec![&texture].into());
            let cancelled = AtomicBool::new(false);
            let tiles = context.tiles;
            let rows = Span {
                start: 0,
                end: tiles.rows.cast_signed(),
            };
            let pass = list.pass(&list.plan(), rows, &cancelled);
            let mut painters = list.painters();
            for tile in 0..tiles.columns * tiles.rows {
                let commands = pass.bins[0].of_tile(tile as usize);
                let chunk = &list.chunks[0];
                let any = |is: fn(Work<'_>) -> bool| commands.iter().any(|command| is(command.work(chunk)));
                let rounding = if !any(|work| matches!(work, Work::Shaded(..))) {
                    flat += 1;
                    Rounding::Sums
                } else if list.background().is_opaque() && !any(|work| matches!(work, Work::BeginLayer)) {
                    shaded += 1;
                    Rounding::Samples
                } else {
                    continue;
                };
                let rect = tiles.pixels(tile % tiles.columns, tile / tiles.columns, SIZE);
                let (width, height) = (rect.x.length(), rect.y.length());
                let mut found = vec![0x1234_5678; width * height];
                painters
                    .visibility
                    .begin(rect, list.background(), (rounding, Crowds::GivenUp));
                let is_painted = painters.visibility.paint(chunk, commands, &mut painters.shape_coverage);
                assert!(is_painted, "not so many");
                painters
                    .visibility
                    .resolve(&mut PixelBlock::new(rect, &mut found, width), false);
                let expected = blended(&mut painters, &list, (chunk, commands), rect);
                assert_eq!(found, expected, "tile {tile}, {settings:?}");
                if rounding == Rounding::Sums {
                    let mut colors = SampleColors::new(settings.rate, settings.sampling.rules, settings.space);
                    colors.reset(rect, Premultiplied16::TRANSPARENT);
                    painters.visibility.put_colors(&mut colors, |_| PixelBits::ALL);
                    for (row, y) in found.chunks_exact_mut(width).zip(rect.y.start..) {
                        colors.resolve(y, row);
                    }
                    assert_eq!(found, expected, "tile {tile} by its samples, {settings:?}");
                }
            }
            Ok(())
        })
        .budget_ms(2000);
        assert!(flat > 0 && shaded > 0, "{flat} flat tiles, {shaded} others");
    }

    #[test]
    fn a_tile_under_too_many_veils_is_painted_without_surfaces() {
        let size = [5, 3];
        let settings = settings();
        let context = ListContext::new(size, &settings);
        for (veils, fits) in [(MOST - 1, true), (MOST + 1, false)] {
            let mut builder = ChunkBuilder::new(&context, 2 + veils);
            let all = [DVec2::new(-9.0, -9.0), DVec2::new(30.0, 0.0), DVec2::new(0.0, 30.0)];
            builder.triangle(
                all,
                &Paint::vertex([Rgba::WHITE, Rgba::BLACK, Rgba::opaque(1.0, 0.5, 0.0)]),
            );
            for i in 0..veils {
                let veil = Rgba {
                    a: 0.01,
                    ..Rgba::opaque((i % 7) as f32 / 6.0, 0.3, 0.9)
                };
                builder.triangle(all, &Paint::solid(veil));
            }
            let list = DisplayList::new(context, settings, vec![builder.finish()], Vec::new().into());
            let cancelled = AtomicBool::new(false);
            let pass = list.pass(&list.plan(), Span { start: 0, end: 1 }, &cancelled);
            let (commands, chunk) = (pass.bins[0].of_tile(0), &list.chunks[0]);
            let rect = context.tiles.pixels(0, 0, size);
            let mut painters = list.painters();
            painters
                .visibility
                .begin(rect, list.background(), (Rounding::Samples, Crowds::GivenUp));
            let is_painted = painters.visibility.paint(chunk, commands, &mut painters.shape_coverage);
            assert_eq!(is_painted, fits, "{veils} veils");
            let expected = blended(&mut painters, &list, (chunk, commands), rect);
            let mut frame = Framebuffer::new(size[0], size[1]);
            list.rasterize(&mut frame, &cancelled).expect("not cancelled");
            assert_eq!(frame.pixels(), expected, "{veils} veils");
        }
    }

    #[test]
    fn a_crowd_of_surfaces_is_given_up_where_bytes_allow() {
        let settings = RasterSettings {
            rate: SampleRate::new(16).expect("a square number"),
            ..settings()
        };
        let (white, colors) = (
            Paint::solid(Rgba::WHITE),
            Paint::vertex([Rgba::WHITE, Rgba::BLACK, Rgba::WHITE]),
        );
        for (pattern, ground, veils, is_crowd) in [
            (SamplePattern::Grid, white, 6, false),
            (SamplePattern::Grid, white, 60, true),
            (SamplePattern::Grid, white, 399, true),
            (SamplePattern::Jittered, white, 399, true),
            (SamplePattern::Grid, colors, 399, true),
        ] {
            let settings = RasterSettings { pattern, ..settings };
            let context = ListContext::new(SIZE, &settings);
            let mut random =
                (1_u32..).map(|i| f32::from(u16::try_from(i.wrapping_mul(0x9E37_79B9) >> 16).unwrap_or(0)) / 65536.0);
            let mut builder = ChunkBuilder::new(&context, 1 + veils);
            let all = [DVec2::new(-9.0, -9.0), DVec2::new(300.0, 0.0), DVec2::new(0.0, 300.0)];
            builder.triangle(all, &ground);
            for _ in 0..veils {
                let corners = [(); 3].map(|()| {
                    let [x, y] = [(); 2].map(|()| f64::from(random.next().unwrap_or(0.0)));
                    DVec2::new(x * 120.0 - 30.0, y * 100.0 - 30.0)
                });
                let veil = Rgba {
                    a: 0.1,
                    ..Rgba::opaque(0.2, random.next().unwrap_or(0.0), 0.9)
                };
                builder.triangle(corners, &Paint::solid(veil));
            }
            let list = DisplayList::new(context, settings, vec![builder.finish()], Vec::new().into());
            let cancelled = AtomicBool::new(false);
            let pass = list.pass(&list.plan(), Span { start: 0, end: 1 }, &cancelled);
            let (commands, chunk) = (pass.bins[0].of_tile(0), &list.chunks[0]);
            let rect = context.tiles.pixels(0, 0, SIZE);
            let mut painters = list.painters();
            let mut paint = |crowds| {
                let Painters {
                    visibility,
                    shape_coverage,
                    ..
                } = &mut painters;
                visibility.begin(rect, list.background(), (Rounding::Sums, crowds));
                visibility.paint(chunk, commands, shape_coverage)
            };
            assert_eq!(!paint(Crowds::GivenUp), is_crowd, "{pattern:?} under {veils} veils");
            assert!(paint(Crowds::Painted), "{pattern:?}");
            let width = rect.x.length();
            let mut of_surfaces = vec![0; width * rect.y.length()];
            painters
                .visibility
                .resolve(&mut PixelBlock::new(rect, &mut of_surfaces, width), false);
            let mut found = vec![0; width * rect.y.length()];
            let block = &mut PixelBlock::new(rect, &mut found, width);
            list.numbered_tile(&pass, &mut painters, 0, block);
            assert_eq!(found, of_surfaces, "{pattern:?}");
            if ground.constant().is_some() {
                let blended = blended(&mut painters, &list, (chunk, commands), rect);
                assert_eq!(found, blended, "{pattern:?}");
            }
        }
    }
}
