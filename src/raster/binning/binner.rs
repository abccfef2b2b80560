//! Meets the commands of a chunk in the tiles that they touch, in painter's order.
//!
//! A stamp goes to the tiles of its bits, cut to each. A triangle or outline is followed row of tiles by row of tiles: a
//! tile that it covers is marked, so that painting it needs no coverage at all. An opaque one that covers a tile hides
//! everything painted there before.

use crate::geometry::subpixel::GridPoint;
use crate::raster::binning::polygon_tiles::{OutlineTiles, TileStrip};
use crate::raster::binning::tile_command::TileCommand;
use crate::raster::coverage::edge_bounds::TileRows;
use crate::raster::coverage::float_shape::FloatShape;
use crate::raster::coverage::mask8x8::CoverageMask;
use crate::raster::list::chunk::{Chunk, DrawCommand, LayerMark};
use crate::raster::list::context::ListContext;
use crate::raster::shading::sources::PaintSources;
use crate::raster::span::{Reach, Span, SpanRect, to_index};
use crate::raster::tile_layout::TileLayout;

/// Walks over the commands of a chunk.
pub(crate) struct Binner<'a> {
    chunk: &'a Chunk,
    pub(super) context: &'a ListContext,
    /// Tile rows to look at.
    pub(super) rows: Span,
    pub(super) samples: Sides,
    pixels: Sides,
    /// The samples that are painted.
    pub(super) frame: SpanRect,
}

/// The sides of a tile, in samples or in pixels, and how to divide by them.
#[derive(Clone, Copy)]
pub(super) struct Sides {
    pub(super) width: u32,
    pub(super) height: u32,
    inverse: [u64; 2],
    /// By how much what is painted for a tile reaches into the next.
    pub(super) overlap: i32,
    /// The last column and row of tiles.
    last: [i32; 2],
}

impl Sides {
    const SHIFT: u32 = 40;

    /// `unit` of them make a pixel.
    fn new(tiles: TileLayout, unit: u32) -> Self {
        let [width_log2, height_log2] = tiles.sides_log2();
        let (width, height) = (unit << width_log2, unit << height_log2);
        // Rounded up, it is too large by less than one in `2^SHIFT`; no coordinate that is painted exceeds `2^23`, and no side
        // `2^14`. So the error of a quotient stays below `2^-16`, too little to carry it over a whole number.
        let inverse = |side: u32| (1_u64 << Self::SHIFT).div_ceil(u64::from(side));
        Self {
            width,
            height,
            inverse: [inverse(width), inverse(height)],
            overlap: tiles.overlap() * unit.cast_signed(),
            last: [tiles.columns, tiles.rows].map(|count| count.cast_signed() - 1),
        }
    }

    /// The first and the last tile column for which any of some columns is painted.
    #[inline]
    pub(super) fn columns(&self, span: Span) -> (i32, i32) {
        self.tiles(span, 0)
    }

    /// The first and the last tile row for which any of some rows is painted.
    #[inline]
    pub(super) fn rows(&self, span: Span) -> (i32, i32) {
        self.tiles(span, 1)
    }

    #[inline]
    fn tiles(&self, span: Span, axis: usize) -> (i32, i32) {
        let tile = |at: i32| quotient(at, self.inverse[axis]);
        (
            tile((span.start - self.overlap).max(0)),
            tile(span.end - 1).min(self.last[axis]),
        )
    }

    /// What is painted for a tile column or row, which are `side` long.
    #[inline]
    pub(super) fn painted(&self, tile: i32, side: u32) -> Span {
        let side = side.cast_signed();
        Span {
            start: tile * side,
            end: (tile + 1) * side + self.overlap,
        }
    }
}

#[inline]
fn quotient(coordinate: i32, inverse: u64) -> i32 {
    debug_assert!((0..=1 << 23).contains(&coordinate), "{coordinate} lies in the frame");
    ((u64::from(coordinate.cast_unsigned()) * inverse) >> Sides::SHIFT) as i32
}

impl<'a> Binner<'a> {
    pub(crate) fn new(chunk: &'a Chunk, context: &'a ListContext, rows: Span) -> Self {
        let side = context.grid.side().cast_unsigned();
        Self {
            chunk,
            context,
            rows,
            samples: Sides::new(context.tiles, side),
            pixels: Sides::new(context.tiles, 1),
            frame: context.samples(),
        }
    }

    /// Calls `visit` with every entry of the chunk and the number of its tile, counted from the first row's first.
    #[inline]
    pub(crate) fn each(&self, sources: &PaintSources<'_>, mut visit: impl FnMut(usize, TileCommand)) {
        if !self.chunk.is_limited() {
            return self.everywhere(sources, visit);
        }
        let (limits, columns) = (self.limits(), self.context.tiles.columns as usize);
        self.everywhere(sources, |tile, entry| {
            let SpanRect { x, y } = limits[entry.command()];
            let (column, row) = (tile % columns, tile / columns + to_index(self.rows.start));
            let holds = |span: Span, at: usize| i32::try_from(at).is_ok_and(|at| (span.start..span.end).contains(&at));
            if holds(x, column) && holds(y, row) {
                visit(tile, entry);
            }
        });
    }

    /// For each command the tiles in which it counts: those that the masks around it may change. What a mask holds elsewhere
    /// would cost time there, though it takes away from nothing.
    fn limits(&self) -> Vec<SpanRect> {
        let tiles = self.context.tiles;
        let all = SpanRect {
            x: Span {
                start: 0,
                end: tiles.columns.cast_signed(),
            },
            y: Span {
                start: 0,
                end: tiles.rows.cast_signed(),
            },
        };
        let inside = |around: SpanRect, layer: &LayerMark| {
            if !layer.limits {
                around
            } else if layer.area.is_empty() {
                SpanRect::EMPTY
            } else {
                tiles.tiles_of(layer.area).intersection(around)
            }
        };
        let mut around = vec![all];
        for layer in &self.chunk.layers_open {
            around.extend(around.last().map(|last| inside(*last, layer)));
        }
        let of_command = |command: &DrawCommand| {
            match command {
                DrawCommand::EndLayer(_) if around.len() > 1 => drop(around.pop()),
                _ => {}
            }
            let limit = around.last().copied().unwrap_or(all);
            if let DrawCommand::BeginLayer(index) = command {
                around.push(inside(limit, &self.chunk.layers[*index as usize]));
            }
            limit
        };
        self.chunk.commands.iter().map(of_command).collect()
    }

    /// As [`Binner::each`], as if nothing lay in a mask.
    fn everywhere(&self, sources: &PaintSources<'_>, mut visit: impl FnMut(usize, TileCommand)) {
        let mut depth = self.chunk.layers_open.len();
        let mut tiles = OutlineTiles::default();
        // Each lies in one tile.
        let whole_blocks = self.pixels.overlap == 0 && self.context.tiles.sides_log2().iter().all(|side| *side >= 3);
        for (i, command) in self.chunk.commands.iter().enumerate() {
            match *command {
                DrawCommand::Samples(index) => {
                    let stamp = &self.chunk.stamps[index as usize];
                    let entry = TileCommand::samples(i, stamp.color);
                    self.stamp(self.samples, stamp.coverage, entry, &mut visit);
                }
                DrawCommand::Pixels(index) => {
                    let stamp = &self.chunk.stamps[index as usize];
                    let entry = TileCommand::pixels(i, stamp.color);
                    self.stamp(self.pixels, stamp.coverage, entry, &mut visit);
                }
                DrawCommand::Hairline(index) => {
                    let line = &self.chunk.hairlines[index as usize];
                    let entry = TileCommand::pixels(i, line.color);
                    let size = self.context.size;
                    if whole_blocks {
                        line.blocks(size, |block| self.block(block, entry, &mut visit));
                    } else {
                        line.blocks(size, |pixels| self.stamp(self.pixels, pixels, entry, &mut visit));
                    }
                }
                DrawCommand::Triangle(index) => {
                    let triangle = &self.chunk.triangles[index as usize];
                    let paint = &self.chunk.paints[triangle.paint as usize];
                    let opaque = paint.is_opaque(sources);
                    if let Some(float) = self.chunk.floats.get(index as usize) {
                        let entry = TileCommand::triangle(i, index, None, opaque);
                        self.float(float, entry, depth == 0, &mut visit);
                        continue;
                    }
                    let entry = TileCommand::triangle(i, index, paint.constant, opaque);
                    if self.context.coverage.is_exact() {
                        self.touched_triangle(triangle.corners, entry, depth == 0, &mut visit);
                        continue;
                    }
                    self.triangle(triangle.corners, entry, depth == 0, &mut visit);
                }
                DrawCommand::Outline(index) => {
                    let paint = self.chunk.outline_paint(index);
                    let opaque = paint.is_opaque(sources);
                    let entry = TileCommand::outline(i, index, paint.constant, opaque);
                    self.outline(&mut tiles, entry, depth == 0, &mut visit);
                }
                DrawCommand::BeginLayer(index) | DrawCommand::EndLayer(index) => {
                    depth = match command {
                        DrawCommand::BeginLayer(_) => depth + 1,
                        _ => depth.saturating_sub(1),
                    };
                    self.rect(
                        self.chunk.layers[index as usize].area,
                        TileCommand::layer(i),
                        &mut visit,
                    );
                }
            }
        }
    }

    /// The number of a tile.
    #[inline]
    pub(super) fn tile(&self, column: i32, row: i32) -> usize {
        to_index(row - self.rows.start) * self.context.tiles.columns as usize + to_index(column)
    }

    /// A stamp of pixels whose column and row are multiples of eight, where tiles are of such blocks.
    #[inline]
    fn block(&self, block: CoverageMask, entry: TileCommand, visit: &mut impl FnMut(usize, TileCommand)) {
        let [width, height] = self.context.tiles.sides_log2();
        let row = block.row >> height;
        if self.rows.start <= row && row < self.rows.end {
            let inside = |at: i32, side: u32| u16::try_from(at & ((1 << side) - 1)).unwrap_or(0);
            let at = [inside(block.column, width), inside(block.row, height)];
            visit(self.tile(block.column >> width, row), entry.with_bits(at, block.mask));
        }
    }

    /// A stamp in each tile that holds any of its bits.
    #[inline]
    fn stamp(&self, sides: Sides, stamp: CoverageMask, entry: TileCommand, visit: &mut impl FnMut(usize, TileCommand)) {
        let (columns, rows) = (stamp.columns(), stamp.rows());
        let ((left, right), (top, bottom)) = (sides.columns(columns), sides.rows(rows));
        let (width, height) = (sides.width.cast_signed(), sides.height.cast_signed());
        if left == right && top == bottom {
            if self.rows.start <= top && top < self.rows.end {
                let entry = in_tile(stamp, entry, [left * width, top * height]);
                visit(self.tile(left, top), entry);
            }
            return;
        }
        for row in top.max(self.rows.start)..=bottom.min(self.rows.end - 1) {
            for column in left..=right {
                let (columns, rows) = (sides.painted(column, sides.width), sides.painted(row, sides.height));
                let part = stamp.within(columns, rows);
                if part.mask != 0 {
                    let entry = in_tile(part, entry, [column * width, row * height]);
                    visit(self.tile(column, row), entry);
                }
            }
        }
    }

    /// An outline in each tile it touches; `base` says that it is in no layer.
    fn outline(
        &self,
        tiles: &mut OutlineTiles,
        entry: TileCommand,
        base: bool,
        visit: &mut impl FnMut(usize, TileCommand),
    ) {
        let (grid, sides) = (self.context.grid, self.samples);
        let outline = self.chunk.outlines[entry.primitive()].with_edges(&self.chunk.outline_edges);
        let SpanRect { x: columns, y: rows } = outline.outline.samples;
        let ((left, right), (top, bottom)) = (sides.columns(columns), sides.rows(rows));
        let in_row = Span {
            start: left,
            end: right + 1,
        };
        let tile_rows = top.max(self.rows.start)..=bottom.min(self.rows.end - 1);
        let (width, height) = (sides.width.cast_signed(), sides.height.cast_signed());
        let few = (in_row.end - in_row.start) * (bottom - top + 1) <= 2;
        if few && (self.covers_no_tile(columns, width, 0) || self.covers_no_tile(rows, height, 1)) {
            for row in tile_rows {
                (in_row.start..in_row.end).for_each(|column| visit(self.tile(column, row), entry));
            }
            return;
        }
        let units = |samples: i32| f64::from(samples << grid.bits());
        for row in tile_rows {
            let strip = TileStrip {
                rows: sides.painted(row, sides.height).intersection(self.frame.y),
                tiles: in_row,
                width: units(width),
                overlap: units(sides.overlap),
            };
            let visit = |column: i32, reach: Reach| {
                let entry = match reach {
                    Reach::Part => entry,
                    Reach::All => entry.covering(base && entry.is_opaque()),
                };
                visit(self.tile(column, row), entry);
            };
            if self.context.coverage.is_exact() {
                tiles.each_touched(outline, grid, strip, visit);
            } else {
                tiles.each(outline, grid, strip, visit);
            }
        }
    }

    /// Whether samples of that many columns or rows, `axis` 0 or 1, are too few to cover a tile.
    #[inline]
    fn covers_no_tile(&self, span: Span, side: i32, axis: usize) -> bool {
        let frame = [self.frame.x, self.frame.y][axis];
        span.end - span.start < side.min(frame.end)
    }

    /// A triangle in each tile it touches; `base` says that it is in no layer.
    fn triangle(
        &self,
        corners: [GridPoint; 3],
        entry: TileCommand,
        base: bool,
        visit: &mut impl FnMut(usize, TileCommand),
    ) {
        let (grid, sides) = (self.context.grid, self.samples);
        let samples = SpanRect::of_samples(corners, grid, self.context.rules).intersection(self.frame);
        if samples.is_empty() {
            return;
        }
        let ((left, right), (top, bottom)) = (sides.columns(samples.x), sides.rows(samples.y));
        let tile_rows = top.max(self.rows.start)..=bottom.min(self.rows.end - 1);
        let height = sides.height.cast_signed();
        if (right - left + 1) * (bottom - top + 1) <= 2
            && (self.covers_no_tile(samples.x, sides.width.cast_signed(), 0)
                || self.covers_no_tile(samples.y, height, 1))
        {
            for row in tile_rows {
                (left..=right).for_each(|column| visit(self.tile(column, row), entry));
            }
            return;
        }
        // Most triangles of a chunk, where the rows of a single pixel are asked for.
        if tile_rows.is_empty() {
            return;
        }
        let edges = TileRows::new(corners);
        for row in tile_rows {
            let in_tile = sides.painted(row, sides.height).intersection(self.frame.y);
            let inside = in_tile.intersection(samples.y);
            let bounds = edges.between(
                grid.sample_coordinate(inside.start),
                grid.sample_coordinate(inside.end - 1),
            );
            let touched = self.touched(bounds.touched, left, right);
            let covered = if inside == in_tile {
                self.covered(bounds.covered)
            } else {
                Span::EMPTY
            };
            for (column, entry) in entry.along_row([touched, covered], base) {
                visit(self.tile(column, row), entry);
            }
        }
    }

    /// A triangle by the rules of first drafts in each tile it touches. Kept out of the loop over commands, which is hot.
    #[cold]
    #[inline(never)]
    fn float(&self, float: &FloatShape, entry: TileCommand, base: bool, visit: &mut impl FnMut(usize, TileCommand)) {
        let (grid, sides) = (self.context.grid, self.samples);
        let SpanRect { x: columns, y: rows } = float.samples;
        let ((left, right), (top, bottom)) = (sides.columns(columns), sides.rows(rows));
        for row in top.max(self.rows.start)..=bottom.min(self.rows.end - 1) {
            for column in left..=right {
                let samples = SpanRect {
                    x: sides.painted(column, sides.width).intersection(self.frame.x),
                    y: sides.painted(row, sides.height).intersection(self.frame.y),
                };
                let entry = match float.reach(grid, samples) {
                    None => continue,
                    Some(Reach::Part) => entry,
                    Some(Reach::All) => entry.covering(base && entry.is_opaque()),
                };
                visit(self.tile(column, row), entry);
            }
        }
    }

    /// The tile columns from `left` to `right` that hold coordinates between the two of `columns`.
    #[inline]
    #[expect(
        clippy::cast_possible_truncation,
        reason = "clamped to the tiles of a frame; just before the first, truncation names the first"
    )]
    pub(super) fn touched(&self, columns: [f64; 2], left: i32, right: i32) -> Span {
        let bits = self.context.grid.bits();
        let (width, overlap) = (
            f64::from(self.samples.width << bits),
            f64::from(self.samples.overlap << bits),
        );
        // Far more than the error of the quotients lies between a tile's side and the nearest sample.
        let tile = |x: f64| (x / width).clamp(f64::from(left) - 1.0, f64::from(right) + 1.0) as i32;
        Span {
            start: tile(columns[0] - overlap).max(left),
            end: tile(columns[1]).min(right) + 1,
        }
    }

    /// The tile columns all samples of which lie between the two coordinates.
    #[inline]
    #[expect(
        clippy::cast_possible_truncation,
        reason = "clamped to the tiles of a frame; truncation rounds down there"
    )]
    fn covered(&self, [first, last]: [f64; 2]) -> Span {
        if first > last {
            return Span::EMPTY;
        }
        let grid = self.context.grid;
        let width = f64::from(self.samples.width << grid.bits());
        let half = f64::from(1 << (grid.bits() - 1));
        let columns = self.context.tiles.columns.cast_signed();
        let whole = |tiles: f64| tiles.clamp(0.0, f64::from(columns)) as i32;
        let start = (first - half) / width;
        let start = whole(start) + i32::from(f64::from(whole(start)) < start);
        let overlap = f64::from(self.samples.overlap << grid.bits());
        let mut end = whole((last + half - overlap) / width);
        // The frame may cut the last tile short.
        if end == columns - 1 && f64::from(grid.sample_coordinate(self.frame.x.end - 1)) <= last {
            end = columns;
        }
        Span { start, end }
    }

    /// An command in every tile of a rectangle of pixels.
    fn rect(&self, area: SpanRect, entry: TileCommand, visit: &mut impl FnMut(usize, TileCommand)) {
        if area.is_empty() {
            return;
        }
        let mut tiles = self.context.tiles.tiles_of(area);
        tiles.y = tiles.y.intersection(self.rows);
        for row in tiles.y.start..tiles.y.end {
            (tiles.x.start..tiles.x.end).for_each(|column| visit(self.tile(column, row), entry));
        }
    }
}

/// The entry of a stamp all bits of which lie in the tile that begins at `[x, y]`.
#[inline]
fn in_tile(stamp: CoverageMask, entry: TileCommand, [x, y]: [i32; 2]) -> TileCommand {
    let (column, row) = (stamp.columns().start, stamp.rows().start);
    let shift = 8 * (row - stamp.row) + column - stamp.column;
    let near = |distance: i32| u16::try_from(distance).unwrap_or(0);
    entry.with_bits([near(column - x), near(row - y)], stamp.mask >> shift)
}

#[cfg(test)]
mod tests {
    use arbtest::arbitrary::{Result, Unstructured};
    use glam::DVec2;

    use super::*;
    use crate::color::Rgba;
    use crate::geometry::{FillRule, Polygon};
    use crate::raster::binning::tile_command::Work;
    use crate::raster::coverage::shape::Shape;
    use crate::raster::coverage::shape_coverage::ShapeCoverage;
    use crate::raster::layers::Compositing;
    use crate::raster::list::builder::ChunkBuilder;
    use crate::raster::list::chunk::measure_layers;
    use crate::raster::random::{any_filter, fill, noise};
    use crate::raster::shading::Paint;
    use crate::raster::tile_layout::TileLayout;
    use crate::raster::{RasterSettings, SampleRate};
    use crate::rules::Rules;
    use crate::texture::SamplingSettings;

    const SIZE: [u32; 2] = [70, 50];

    /// A chunk of random primitives, and tiles of several sizes.
    fn chunk(u: &mut Unstructured<'_>) -> Result<(Chunk, ListContext)> {
        let side: u32 = u.int_in_range(1..=5)?;
        let settings = RasterSettings {
            rate: SampleRate::new(side * side).expect("a square number"),
            sampling: SamplingSettings {
                rules: *u.choose(&Rules::ALL)?,
                ..SamplingSettings::default()
            },
            filter: any_filter(u)?,
            ..RasterSettings::default()
        };
        let tiles = TileLayout::new([u.int_in_range(2..=6)?, u.int_in_range(2..=5)?], SIZE);
        let context = ListContext::with_tiles(SIZE, &settings, tiles);
        let mut builder = ChunkBuilder::new(&context, 12);
        fill(&mut builder, u)?;
        for _ in 0..u.int_in_range(0..=5)? {
            let mut at = |side: u32| Ok(f64::from(u.int_in_range(0..=8 * side)?) / 8.0);
            let corner = DVec2::new(at(SIZE[0])?, at(SIZE[1])?);
            builder.point(corner, Rgba::BLACK);
            let tiny = [corner, corner + DVec2::new(1.0, 0.2), corner + DVec2::new(0.3, 1.1)];
            builder.triangle(tiny, &Paint::solid(Rgba::BLACK));
        }
        Ok((builder.finish(), context))
    }

    /// How many samples a triangle or outline covers in a rectangle of pixels.
    fn covered(command: TileCommand, chunk: &Chunk, context: &ListContext, rect: SpanRect) -> usize {
        let side = context.grid.side();
        let mut rows = ShapeCoverage::new(
            context.grid,
            context.rules,
            context.samples().x.end,
            chunk.outlines.len(),
        );
        let mut count = 0;
        if let Work::Flat(shape, _) | Work::Shaded(shape, ..) = command.uncovered().work(chunk)
            && !matches!(shape, Shape::Samples(_) | Shape::Pixels(_))
        {
            let per_pixel = to_index(side * side);
            rows.each(shape, rect, |_, covered| count += covered.count(per_pixel));
        }
        count
    }

    #[test]
    fn masks_are_only_in_the_tiles_that_they_may_change() {
        let settings = RasterSettings::default();
        let context = ListContext::new([1000, 1000], &settings);
        let square = |from: f64, to: f64| {
            let corner = |x: f64, y: f64| DVec2::new(x, y);
            Polygon::new(
                [[corner(from, from), corner(to, from), corner(to, to), corner(from, to)]],
                FillRule::NonZero,
            )
        };
        let black = Paint::solid(Rgba::BLACK);
        // A small square, clipped to nearly all of the frame; the clip's layer begins in one chunk and ends in the next.
        let mut first = ChunkBuilder::new(&context, 9);
        first.begin_layer();
        first.polygon(&square(5.0, 15.0), |point| point, &black);
        first.begin_layer();
        let mut second = ChunkBuilder::new(&context, 9);
        second.polygon(&square(1.0, 999.0), |point| point, &black);
        second.end_layer(Compositing::mask(false));
        second.end_layer(Compositing::with_opacity(1.0));
        second.polygon(&square(1.0, 999.0), |point| point, &black);
        let mut chunks = [first.finish(), second.finish()];
        measure_layers(&mut chunks, &context);
        let rows = Span {
            start: 0,
            end: context.tiles.rows.cast_signed(),
        };
        let tiles = (context.tiles.columns * context.tiles.rows) as usize;
        let counts = chunks.map(|chunk| {
            let mut counts = vec![0; tiles];
            Binner::new(&chunk, &context, rows).each(&Vec::new().into(), |tile, _| counts[tile] += 1);
            counts
        });
        assert!(tiles > 9, "many tiles");
        assert_eq!([counts[0][0], counts[1][0]], [3, 4], "where the small square is");
        for (tile, (first, second)) in counts[0].iter().zip(&counts[1]).enumerate().skip(1) {
            assert_eq!([*first, *second], [0, 1], "tile {tile} has what is painted last");
        }
    }

    /// A square on all of the frame of which a small clip path leaves little.
    #[test]
    fn what_is_clipped_is_only_in_the_tiles_that_its_clip_path_leaves() {
        let settings = RasterSettings::default();
        let context = ListContext::new([1000, 1000], &settings);
        let black = Paint::solid(Rgba::BLACK);
        let square = |from: f64, to: f64| {
            let corners = [[from, from], [to, from], [to, to], [from, to]];
            Polygon::new([corners.map(DVec2::from)], FillRule::NonZero)
        };
        let rows = Span {
            start: 0,
            end: context.tiles.rows.cast_signed(),
        };
        for is_told in [false, true] {
            let mut builder = ChunkBuilder::new(&context, 9);
            if is_told {
                builder = builder.with_hidden();
            }
            builder.begin_layer();
            builder.polygon(&square(1.0, 999.0), |point| point, &black);
            builder.begin_layer();
            builder.polygon(&square(5.0, 15.0), |point| point, &black);
            builder.end_layer(Compositing::mask(false));
            builder.end_layer(Compositing::with_opacity(1.0));
            let mut chunks = [builder.finish()];
            measure_layers(&mut chunks, &context);
            let mut counts = vec![0; (context.tiles.columns * context.tiles.rows) as usize];
            Binner::new(&chunks[0], &context, rows).each(&Vec::new().into(), |tile, _| counts[tile] += 1);
            assert_eq!(counts[0], 6, "both squares, and two layers");
            let others = counts[1..].iter().filter(|count| **count > 0).count();
            // Who asks what was painted is told of what was clipped, too.
            assert_eq!(others > 0, is_told, "{others} other tiles");
        }
    }

    #[test]
    fn tiles_get_the_commands_that_cover_samples_in_them() {
        let texture = noise();
        let (mut covering, mut stamped) = (0, 0);
        arbtest::arbtest(|u| {
            let (chunk, context) = chunk(u)?;
            let rows = Span {
                start: 0,
                end: context.tiles.rows.cast_signed(),
            };
            let mut tiles = vec![Vec::new(); (context.tiles.columns * context.tiles.rows) as usize];
            Binner::new(&chunk, &context, rows).each(&vec![&texture].into(), |tile, command| tiles[tile].push(command));
            let all: Vec<TileCommand> = tiles.concat();
            let mut bits = vec![0; chunk.commands.len()];
            for (tile, commands) in (0..).zip(&tiles) {
                assert!(
                    commands.is_sorted_by_key(|command| command.command()),
                    "in painter's order"
                );
                let tiles = context.tiles;
                let rect = tiles.painted(tiles.pixels(tile % tiles.columns, tile / tiles.columns, SIZE));
                let side = to_index(context.grid.side());
                let whole = rect.x.length() * rect.y.length() * side * side;
                for shape in &all {
                    let own = commands.iter().find(|command| command.command() == shape.command());
                    let count = covered(*shape, &chunk, &context, rect);
                    assert!(
                        count == 0 || own.is_some(),
                        "tile {tile} knows command {}",
                        shape.command()
                    );
                    if own.is_some_and(|command| command.covers_tile()) {
                        assert_eq!(count, whole, "command {} covers tile {tile}", shape.command());
                        covering += 1;
                    }
                }
                for command in commands {
                    if let Work::Flat(Shape::Samples(mask) | Shape::Pixels(mask), _) = command.work(&chunk) {
                        bits[command.command()] += mask.mask.count_ones();
                    }
                }
            }
            for (command, bits) in chunk.commands.iter().zip(bits) {
                if let DrawCommand::Samples(index) | DrawCommand::Pixels(index) = command {
                    let stamp = chunk.stamps[*index as usize].coverage;
                    // What is painted for a tile reaches into the next where there is a margin.
                    let once = stamp.mask.count_ones();
                    assert!(bits >= once, "each bit of {stamp:?} is in a tile");
                    assert!(
                        bits == once || context.margin > 0,
                        "each bit of {stamp:?} is in one tile"
                    );
                    stamped += 1;
                }
            }
            Ok(())
        })
        .budget_ms(800);
        assert!(covering > 0 && stamped > 0, "{covering} covering, {stamped} stamps");
    }
}
