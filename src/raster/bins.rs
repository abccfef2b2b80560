//! Which ops touch which tile, in painter's order.
//!
//! Two walks over the ops of a chunk: the first counts the entries of each tile, the second writes them where they
//! belong; where the first meets few entries, it keeps them, and there is no second. Nothing is allocated per op or per
//! tile. A stamp goes to the tiles of its bits, cut to each. A triangle or
//! outline is followed row of tiles by row of tiles: a tile that it covers is marked, so that painting it needs no
//! coverage at all. An opaque one that covers a tile hides everything painted there before.

use std::sync::Arc;

use rayon::prelude::*;

use super::display_list::{Chunk, ListContext, Op, Paint};
use super::entry::Entry;
use super::outline_tiles::{OutlineTiles, Reach};
use super::rows::Span;
use super::shade::Shader;
use super::small::{SampleBox, SmallCoverage};
use super::tile::PixelRect;
use super::tile_rows::TileRows;
use crate::geometry::subpixel::GridPoint;
use crate::texture::Texture;

/// Most entries that are held at once; more are made and painted in several passes over groups of tile rows.
const MAX_ENTRIES: u64 = 1 << 22;

/// Most entries of a chunk that are kept when they are counted, half a megabyte; and of how many ops at most: where
/// there are more, most are tiny, and sooner met again than written and read.
const MAX_KEPT: usize = 1 << 14;
const MAX_KEPT_OPS: usize = 1 << 12;

/// Room for entries to begin with.
const FEW: usize = 1 << 10;

/// How many entries there will be.
#[derive(Debug)]
pub(crate) struct Plan {
    chunks: Vec<ChunkPlan>,
    /// Tiles in a row, rows of tiles.
    columns: usize,
    rows: i32,
}

/// The entries of one chunk, as they will be.
#[derive(Debug)]
struct ChunkPlan {
    /// How many there are in each tile of the frame.
    counts: Vec<u32>,
    /// All of them, if they are few.
    bins: Option<Arc<Bins>>,
}

/// The entries of one chunk, tile by tile.
#[derive(Debug, Default)]
pub(crate) struct Bins {
    entries: Vec<Entry>,
    /// Where each tile's entries begin, and one more.
    starts: Vec<u32>,
}

/// Walks over the ops of a chunk.
struct Walk<'a> {
    chunk: &'a Chunk,
    context: &'a ListContext,
    /// Tile rows to look at.
    rows: Span,
    samples: Sides,
    pixels: Sides,
    /// The samples of the frame.
    frame: SampleBox,
}

/// The sides of a tile, in samples or in pixels, and how to divide by them.
#[derive(Clone, Copy)]
struct Sides {
    width: u32,
    height: u32,
    inverse: [u64; 2],
}

impl Sides {
    const SHIFT: u32 = 40;

    fn new(width: u32, height: u32) -> Self {
        // Rounded up, it is too large by less than one in `2^SHIFT`; no coordinate of a frame exceeds `2^22`, and no side
        // `2^14`. So the error of a quotient stays below `2^-17`, too little to carry it over a whole number.
        let inverse = |side: u32| (1_u64 << Self::SHIFT).div_ceil(u64::from(side));
        Self {
            width,
            height,
            inverse: [inverse(width), inverse(height)],
        }
    }

    /// The tile column that holds a column of the frame.
    #[inline]
    fn column(&self, x: i32) -> i32 {
        quotient(x, self.inverse[0])
    }

    /// The tile row that holds a row of the frame.
    #[inline]
    fn row(&self, y: i32) -> i32 {
        quotient(y, self.inverse[1])
    }
}

#[inline]
fn quotient(coordinate: i32, inverse: u64) -> i32 {
    debug_assert!((0..=1 << 22).contains(&coordinate), "{coordinate} lies in the frame");
    ((u64::from(coordinate.cast_unsigned()) * inverse) >> Sides::SHIFT) as i32
}

impl Plan {
    /// Counts the entries of all chunks.
    pub(crate) fn new(chunks: &[Chunk], context: &ListContext, textures: &[&Texture]) -> Self {
        let tiles = context.tiles;
        let all = Span {
            start: 0,
            end: tiles.rows.cast_signed(),
        };
        let of_chunk = |chunk: &Chunk| {
            let mut counts = vec![0; tiles.columns as usize * tiles.rows as usize];
            let mut few = chunk.ops.len() <= MAX_KEPT_OPS;
            let mut kept = Vec::with_capacity(if few { FEW } else { 0 });
            Walk::new(chunk, context, all).each(textures, |tile, entry| {
                counts[tile] += 1;
                few &= kept.len() < MAX_KEPT;
                if few {
                    kept.push((u32::try_from(tile).unwrap_or(u32::MAX), entry));
                }
            });
            let bins = few.then(|| {
                let mut sorter = Sorter::new(&counts);
                for (tile, entry) in kept {
                    sorter.add(tile as usize, entry);
                }
                Arc::new(sorter.bins)
            });
            ChunkPlan { counts, bins }
        };
        Self {
            chunks: chunks.par_iter().map(of_chunk).collect(),
            columns: tiles.columns as usize,
            rows: tiles.rows.cast_signed(),
        }
    }

    /// The tile rows of the frame in groups whose entries fit in memory together; mostly a single group.
    pub(crate) fn groups(&self) -> Vec<Span> {
        let (mut groups, mut start, mut in_group) = (Vec::new(), 0, 0_u64);
        for row in 0..self.rows {
            let tiles = place(row) * self.columns..(place(row) + 1) * self.columns;
            let of_chunk = |plan: &ChunkPlan| -> u64 { plan.counts[tiles.clone()].iter().map(|n| u64::from(*n)).sum() };
            let in_row: u64 = self.chunks.iter().map(of_chunk).sum();
            in_group += in_row;
            if in_group > MAX_ENTRIES && row > start {
                groups.push(Span { start, end: row });
                start = row;
                in_group = in_row;
            }
        }
        groups.push(Span { start, end: self.rows });
        groups
    }

    /// Sorts the ops of every chunk into the tiles of `rows`, a range of tile rows.
    pub(crate) fn bins(
        &self,
        chunks: &[Chunk],
        context: &ListContext,
        textures: &[&Texture],
        rows: Span,
    ) -> Vec<Arc<Bins>> {
        let tiles = place(rows.start) * self.columns..place(rows.end) * self.columns;
        let are_all = rows.start == 0 && rows.end == self.rows;
        let ready = |plan: &ChunkPlan| plan.bins.clone().filter(|_| are_all);
        // Nobody is woken up for nothing.
        if let Some(bins) = self.chunks.iter().map(ready).collect() {
            return bins;
        }
        let of_chunk = |(chunk, plan): (&Chunk, &ChunkPlan)| {
            ready(plan).unwrap_or_else(|| {
                let mut sorter = Sorter::new(&plan.counts[tiles.clone()]);
                Walk::new(chunk, context, rows).each(textures, |tile, entry| sorter.add(tile, entry));
                Arc::new(sorter.bins)
            })
        };
        chunks.par_iter().zip(&self.chunks).map(of_chunk).collect()
    }
}

/// Sorts entries into tiles.
struct Sorter {
    bins: Bins,
    /// Where the next entry of each tile belongs.
    next: Vec<u32>,
}

impl Sorter {
    /// For tiles with `counts` entries each.
    fn new(counts: &[u32]) -> Self {
        let mut starts = Vec::with_capacity(counts.len() + 1);
        let mut total = 0;
        starts.push(0);
        starts.extend(counts.iter().map(|count| {
            total += count;
            total
        }));
        Self {
            next: starts.clone(),
            bins: Bins {
                entries: vec![Entry::default(); total as usize],
                starts,
            },
        }
    }

    #[inline]
    fn add(&mut self, tile: usize, entry: Entry) {
        let place = &mut self.next[tile];
        self.bins.entries[*place as usize] = entry;
        *place += 1;
    }
}

impl Bins {
    /// All entries of a single tile.
    pub(crate) fn of_one_tile(entries: Vec<Entry>) -> Self {
        let end = u32::try_from(entries.len()).unwrap_or(u32::MAX);
        Self {
            entries,
            starts: vec![0, end],
        }
    }

    /// The entries of a tile, counted row by row from the first tile row that was asked for.
    pub(crate) fn of_tile(&self, tile: usize) -> &[Entry] {
        &self.entries[self.starts[tile] as usize..self.starts[tile + 1] as usize]
    }
}

/// The entries of a chunk in the tile in column `column` of row `row`, without those of any other.
pub(crate) fn entries_of_tile(
    chunk: &Chunk,
    context: &ListContext,
    textures: &[&Texture],
    [column, row]: [i32; 2],
) -> Vec<Entry> {
    let mut entries = Vec::new();
    let rows = Span {
        start: row,
        end: row + 1,
    };
    Walk::new(chunk, context, rows).each(textures, |tile, entry| {
        if tile == place(column) {
            entries.push(entry);
        }
    });
    entries
}

impl<'a> Walk<'a> {
    fn new(chunk: &'a Chunk, context: &'a ListContext, rows: Span) -> Self {
        let (width_log2, height_log2) = context.tiles.sides_log2();
        let side = context.grid.side().cast_unsigned();
        Self {
            chunk,
            context,
            rows,
            samples: Sides::new(side << width_log2, side << height_log2),
            pixels: Sides::new(1 << width_log2, 1 << height_log2),
            frame: context.samples(),
        }
    }

    /// Calls `visit` with every entry of the chunk and the number of its tile, counted from the first row's first.
    fn each(&self, textures: &[&Texture], mut visit: impl FnMut(usize, Entry)) {
        let mut depth = self.chunk.layers_open;
        let mut tiles = OutlineTiles::default();
        for (i, op) in self.chunk.ops.iter().enumerate() {
            match *op {
                Op::Samples(index) => {
                    let stamp = &self.chunk.stamps[index as usize];
                    let entry = Entry::samples(i, stamp.color);
                    self.stamp(self.samples, stamp.coverage, entry, &mut visit);
                }
                Op::Pixels(index) => {
                    let stamp = &self.chunk.stamps[index as usize];
                    let entry = Entry::pixels(i, stamp.color);
                    self.stamp(self.pixels, stamp.coverage, entry, &mut visit);
                }
                Op::Hairline(index) => {
                    let line = &self.chunk.hairlines[index as usize];
                    let entry = Entry::pixels(i, line.color);
                    line.blocks(self.context.size, |pixels| {
                        self.stamp(self.pixels, pixels, entry, &mut visit);
                    });
                }
                Op::Triangle(index) => {
                    let triangle = &self.chunk.triangles[index as usize];
                    let paint = &self.chunk.paints[triangle.paint as usize];
                    let flat = match paint {
                        Paint::Solid(color) => Some(*color),
                        Paint::Vertex(_) | Paint::Texture { .. } => None,
                    };
                    let opaque = Shader::is_opaque(paint, textures);
                    let entry = Entry::triangle(i, index, flat, opaque);
                    self.triangle(triangle.corners, entry, depth == 0, &mut visit);
                }
                Op::Outline(index) => {
                    let entry = Entry::outline(i, index, self.chunk.outline_colors[index as usize]);
                    self.outline(&mut tiles, (index, entry), depth == 0, &mut visit);
                }
                Op::BeginLayer(index) | Op::EndLayer(index) => {
                    depth = match op {
                        Op::BeginLayer(_) => depth + 1,
                        _ => depth.saturating_sub(1),
                    };
                    self.rect(self.chunk.layers[index as usize].area, Entry::layer(i), &mut visit);
                }
            }
        }
    }

    /// The number of a tile.
    #[inline]
    fn tile(&self, column: i32, row: i32) -> usize {
        place(row - self.rows.start) * self.context.tiles.columns as usize + place(column)
    }

    /// A stamp in each tile that holds any of its bits.
    #[inline]
    fn stamp(&self, sides: Sides, stamp: SmallCoverage, entry: Entry, visit: &mut impl FnMut(usize, Entry)) {
        let (columns, rows) = (stamp.columns(), stamp.rows());
        let (left, right) = (sides.column(columns.start), sides.column(columns.end - 1));
        let (top, bottom) = (sides.row(rows.start), sides.row(rows.end - 1));
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
                let of_tile = |tile: i32, side: i32| Span {
                    start: tile * side,
                    end: (tile + 1) * side,
                };
                let part = stamp.within(of_tile(column, width), of_tile(row, height));
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
        (index, entry): (u32, Entry),
        base: bool,
        visit: &mut impl FnMut(usize, Entry),
    ) {
        let (grid, sides) = (self.context.grid, self.samples);
        let outline = &self.chunk.outlines[index as usize];
        let SampleBox { columns, rows } = outline.samples;
        let in_row = Span {
            start: sides.column(columns.start),
            end: sides.column(columns.end - 1) + 1,
        };
        let (top, bottom) = (sides.row(rows.start), sides.row(rows.end - 1));
        let bands = top.max(self.rows.start)..=bottom.min(self.rows.end - 1);
        let (width, height) = (sides.width.cast_signed(), sides.height.cast_signed());
        let few = (in_row.end - in_row.start) * (bottom - top + 1) <= 2;
        if few && (self.covers_no_tile(columns, width, 0) || self.covers_no_tile(rows, height, 1)) {
            for row in bands {
                (in_row.start..in_row.end).for_each(|column| visit(self.tile(column, row), entry));
            }
            return;
        }
        let unit_width = f64::from(width << grid.bits());
        for row in bands {
            let band = Span {
                start: row * height,
                end: ((row + 1) * height).min(self.frame.rows.end),
            };
            let outline = (outline, self.chunk.outline_edges.as_slice());
            tiles.each(outline, grid, (band, in_row, unit_width), |column, reach| {
                let entry = match reach {
                    Reach::Part => entry,
                    Reach::All => entry.covering(base && entry.is_opaque()),
                };
                visit(self.tile(column, row), entry);
            });
        }
    }

    /// Whether samples of that many columns or rows, `axis` 0 or 1, are too few to cover a tile.
    #[inline]
    fn covers_no_tile(&self, span: Span, side: i32, axis: usize) -> bool {
        let frame = [self.frame.columns, self.frame.rows][axis];
        span.end - span.start < side.min(frame.end)
    }

    /// A triangle in each tile it touches; `base` says that it is in no layer.
    fn triangle(&self, corners: [GridPoint; 3], entry: Entry, base: bool, visit: &mut impl FnMut(usize, Entry)) {
        let (grid, sides) = (self.context.grid, self.samples);
        let samples = SampleBox::new(corners, grid, self.context.rules).intersection(self.frame);
        if samples.columns.is_empty() || samples.rows.is_empty() {
            return;
        }
        let (left, right) = (
            sides.column(samples.columns.start),
            sides.column(samples.columns.end - 1),
        );
        let (top, bottom) = (sides.row(samples.rows.start), sides.row(samples.rows.end - 1));
        let band_rows = top.max(self.rows.start)..=bottom.min(self.rows.end - 1);
        let height = sides.height.cast_signed();
        if (right - left + 1) * (bottom - top + 1) <= 2
            && (self.covers_no_tile(samples.columns, sides.width.cast_signed(), 0)
                || self.covers_no_tile(samples.rows, height, 1))
        {
            for row in band_rows {
                (left..=right).for_each(|column| visit(self.tile(column, row), entry));
            }
            return;
        }
        let edges = TileRows::new(corners);
        for row in band_rows {
            let in_tile = Span {
                start: row * height,
                end: ((row + 1) * height).min(self.frame.rows.end),
            };
            let inside = in_tile.intersection(samples.rows);
            let band = edges.band(
                grid.sample_coordinate(inside.start),
                grid.sample_coordinate(inside.end - 1),
            );
            let touched = self.touched(band.touched, left, right);
            let covered = if inside == in_tile {
                self.covered(band.covered)
            } else {
                Span::default()
            };
            for column in touched.start..touched.end {
                let covers = covered.start <= column && column < covered.end;
                let entry = if covers {
                    entry.covering(base && entry.is_opaque())
                } else {
                    entry
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
    fn touched(&self, columns: [f64; 2], left: i32, right: i32) -> Span {
        let width = f64::from(self.samples.width << self.context.grid.bits());
        // Far more than the error of the quotients lies between a tile's side and the nearest sample.
        let tile = |x: f64| (x / width).clamp(f64::from(left) - 1.0, f64::from(right) + 1.0) as i32;
        Span {
            start: tile(columns[0]).max(left),
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
            return Span::default();
        }
        let grid = self.context.grid;
        let width = f64::from(self.samples.width << grid.bits());
        let half = f64::from(1 << (grid.bits() - 1));
        let columns = self.context.tiles.columns.cast_signed();
        let whole = |tiles: f64| tiles.clamp(0.0, f64::from(columns)) as i32;
        let start = (first - half) / width;
        let start = whole(start) + i32::from(f64::from(whole(start)) < start);
        let mut end = whole((last + half) / width);
        // The frame may cut the last tile short.
        if end == columns - 1 && f64::from(grid.sample_coordinate(self.frame.columns.end - 1)) <= last {
            end = columns;
        }
        Span { start, end }
    }

    /// An op in every tile of a rectangle of pixels.
    fn rect(&self, area: PixelRect, entry: Entry, visit: &mut impl FnMut(usize, Entry)) {
        if area.x.is_empty() || area.y.is_empty() {
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
fn in_tile(stamp: SmallCoverage, entry: Entry, [x, y]: [i32; 2]) -> Entry {
    let (column, row) = (stamp.columns().start, stamp.rows().start);
    let shift = 8 * (row - stamp.row) + column - stamp.column;
    let near = |distance: i32| u16::try_from(distance).unwrap_or(0);
    entry.with_bits([near(column - x), near(row - y)], stamp.mask >> shift)
}

/// A tile coordinate, which is never negative.
#[inline]
fn place(coordinate: i32) -> usize {
    coordinate.max(0).cast_unsigned() as usize
}

#[cfg(test)]
mod tests {
    use arbtest::arbitrary::{Result, Unstructured};
    use glam::DVec2;

    use super::super::chunk_builder::ChunkBuilder;
    use super::super::display_list::Fill;
    use super::super::entry::Work;
    use super::super::rows::SortedTriangle;
    use super::super::tile::TileLayout;
    use super::super::{RasterSettings, SamplePattern, SampleRate};
    use super::*;
    use crate::color::{ResolveSpace, Rgba};
    use crate::rules::Rules;
    use crate::texture::SamplingSettings;

    const SIZE: [u32; 2] = [150, 90];

    fn settings(side: u32, rules: Rules) -> RasterSettings {
        RasterSettings {
            rate: SampleRate::new(side * side).expect("a square number"),
            pattern: SamplePattern::Grid,
            sampling: SamplingSettings {
                rules,
                ..SamplingSettings::default()
            },
            space: ResolveSpace::Stored,
            background: Rgba::WHITE,
            palette: None,
        }
    }

    /// Bins of entries that were kept when they were counted; those of a second walk are the same, also row by row.
    fn binned(context: &ListContext, triangles: &[[DVec2; 3]]) -> (Chunk, Arc<Bins>) {
        let mut builder = ChunkBuilder::new(context, triangles.len());
        for triangle in triangles {
            builder.triangle(*triangle, &Fill::Solid(Rgba::BLACK));
        }
        let chunk = builder.finish();
        let chunks = [chunk];
        let mut plan = Plan::new(&chunks, context, &[]);
        let groups = plan.groups();
        assert_eq!(groups.len(), 1, "few entries are one group");
        let bins = |plan: &Plan, rows| plan.bins(&chunks, context, &[], rows).pop().expect("one chunk");
        let kept = bins(&plan, groups[0]);
        assert!(plan.chunks[0].bins.take().is_some(), "few entries are kept");
        let walked = bins(&plan, groups[0]);
        assert_eq!(
            (&walked.entries, &walked.starts),
            (&kept.entries, &kept.starts),
            "by a second walk"
        );
        let columns = context.tiles.columns as usize;
        for row in 0..context.tiles.rows.cast_signed() {
            let of_row = bins(
                &plan,
                Span {
                    start: row,
                    end: row + 1,
                },
            );
            for column in 0..columns {
                let tile = place(row) * columns + column;
                assert_eq!(
                    of_row.of_tile(column),
                    kept.of_tile(tile),
                    "tile {column} of row {row} alone"
                );
            }
        }
        let (bins, [chunk]) = (kept, chunks);
        (chunk, bins)
    }

    /// The samples that a chunk's triangles cover in a rectangle of pixels, counted from its first, by the row walker.
    fn covered(chunk: &Chunk, context: &ListContext, rect: PixelRect) -> Vec<(i32, i32)> {
        let side = context.grid.side();
        let scaled = |span: Span| Span {
            start: span.start * side,
            end: span.end * side,
        };
        let (columns, rows) = (scaled(rect.x), scaled(rect.y));
        let mut samples = Vec::new();
        for triangle in &chunk.triangles {
            let Some(sorted) = SortedTriangle::new(triangle.corners, context.rules) else {
                continue;
            };
            let inside = sorted.rows(context.grid).intersection(rows);
            if inside.is_empty() {
                continue;
            }
            let mut walker = sorted.walk_from(context.grid, inside.start);
            for row in inside.start..inside.end {
                let span = walker.next_span(columns);
                samples.extend((span.start..span.end).map(|column| (column - columns.start, row - rows.start)));
            }
        }
        samples
    }

    fn triangle(u: &mut Unstructured<'_>) -> Result<[DVec2; 3]> {
        // Around the frame, on a lattice full of ties, far beyond it, or at the ends of the guard band.
        let scale = *u.choose(&[0.25, 1.0, 1.0, 7.3, 300.0, 40_960.0 / 200.0, 1e6, 1e28])?;
        let mut point = || -> Result<DVec2> {
            let mut at = || Ok(f64::from(u.int_in_range(-200..=200)?) * 0.5);
            Ok(DVec2::new(at()?, at()?) * scale + DVec2::new(70.0, 40.0))
        };
        Ok([point()?, point()?, point()?])
    }

    #[test]
    fn bins_hold_every_tile_that_a_triangle_touches_and_mark_none_it_leaves_open() {
        let (mut covering, mut crossing) = (0_u32, 0_u32);
        arbtest::arbtest(|u| {
            let settings = settings(u.int_in_range(1..=5)?, *u.choose(&Rules::ALL)?);
            let sides = *u.choose(&[(3, 3), (6, 5), (2, 4), (0, 1)])?;
            let context = ListContext::with_tiles(SIZE, &settings, TileLayout::new(sides, SIZE));
            let (chunk, bins) = binned(&context, &[triangle(u)?]);
            for row in 0..context.tiles.rows {
                for column in 0..context.tiles.columns {
                    let entries = bins.of_tile((row * context.tiles.columns + column) as usize);
                    let rect = context.tiles.pixels(column, row, SIZE);
                    let found = covered(&chunk, &context, rect);
                    let touches = entries.iter().any(|entry| matches!(entry.work(&chunk), Work::Flat(..)));
                    assert!(
                        touches || found.is_empty(),
                        "tile {column}, {row} is missing: {chunk:?}"
                    );
                    let side = context.grid.side();
                    let all = (rect.x.end - rect.x.start) * side * (rect.y.end - rect.y.start) * side;
                    for entry in entries {
                        assert!(entry.is_opaque(), "black is opaque");
                        assert_eq!(entry.covers_tile(), entry.hides_tile(), "what covers, hides");
                        if entry.covers_tile() {
                            assert_eq!(found.len(), place(all), "tile {column}, {row} is open: {chunk:?}");
                        }
                        covering += u32::from(entry.covers_tile());
                        crossing += u32::from(!entry.covers_tile());
                    }
                }
            }
            Ok(())
        })
        .budget_ms(700);
        assert!(
            covering > 100 && crossing > 100,
            "{covering} covering, {crossing} crossing entries"
        );
    }

    #[test]
    fn stamps_in_tiles_are_the_samples_of_their_triangle() {
        arbtest::arbtest(|u| {
            let settings = settings(u.int_in_range(1..=4)?, *u.choose(&Rules::ALL)?);
            let sides = *u.choose(&[(3, 3), (6, 5), (1, 2), (0, 0)])?;
            let context = ListContext::with_tiles(SIZE, &settings, TileLayout::new(sides, SIZE));
            let side = f64::from(context.grid.side());
            let corner = DVec2::new(
                f64::from(u.int_in_range(-40..=1500)?),
                f64::from(u.int_in_range(-40..=900)?),
            ) / 10.0;
            let mut point = || -> Result<DVec2> {
                let mut at = || Ok(f64::from(u.int_in_range(0..=28)?) / 4.0);
                Ok(corner + DVec2::new(at()?, at()?) / side)
            };
            let points = [point()?, point()?, point()?];
            let (chunk, bins) = binned(&context, &[points]);
            // The same triangle, kept as one.
            let corners = points.map(|point| context.grid.snap(point));
            let mut kept = Chunk::default();
            kept.triangles
                .push(super::super::display_list::ScreenTriangle { corners, paint: 0 });
            assert!(chunk.triangles.is_empty(), "{points:?} is small");
            for row in 0..context.tiles.rows {
                for column in 0..context.tiles.columns {
                    let mut found = Vec::new();
                    for entry in bins.of_tile((row * context.tiles.columns + column) as usize) {
                        let Work::Samples(coverage, _) = entry.work(&chunk) else {
                            panic!("{entry:?} is a stamp of samples");
                        };
                        coverage.each_run(|row, span| found.extend((span.start..span.end).map(|column| (column, row))));
                    }
                    let expected = covered(&kept, &context, context.tiles.pixels(column, row, SIZE));
                    assert_eq!(found, expected, "{points:?} in tile {column}, {row}");
                }
            }
            Ok(())
        })
        .budget_ms(500);
    }

    #[test]
    fn slivers_cost_the_tiles_they_touch() {
        let settings = settings(1, Rules::Standard);
        let size = [1024, 1024];
        let context = ListContext::with_tiles(size, &settings, TileLayout::new((5, 5), size));
        let far = |x: f64, y: f64| DVec2::new(x, y);
        let (_, bins) = binned(&context, &[[DVec2::ZERO, far(1023.0, 1024.0), far(1024.0, 1023.0)]]);
        let entries = bins.entries.len();
        assert!(
            (32..=3 * 32).contains(&entries),
            "{entries} entries along a diagonal of 32 tiles"
        );
    }
}
