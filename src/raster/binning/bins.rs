//! Which commands touch which tile, in painter's order.
//!
//! Two walks over the commands of a chunk: the first counts the entries of each tile, the second writes them where they
//! belong; where the first meets few entries, it keeps them, and there is no second. Nothing is allocated per command or per
//! tile.

use std::sync::Arc;

use rayon::prelude::*;

use crate::raster::binning::binner::Binner;
use crate::raster::binning::tile_command::TileCommand;
use crate::raster::list::chunk::Chunk;
use crate::raster::list::context::ListContext;
use crate::raster::shading::sources::PaintSources;
use crate::raster::span::{Span, to_index};

/// Most entries that are held at once; more are made and painted in several passes over groups of tile rows.
const MAX_ENTRIES: u64 = 1 << 22;

/// Most entries of a chunk that are kept when they are counted, half a megabyte; and of how many commands at most: where
/// there are more, most are tiny, and sooner met again than written and read.
const MAX_KEPT: usize = 1 << 14;
const MAX_KEPT_COMMANDS: usize = 1 << 12;

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
    entries: Vec<TileCommand>,
    /// Where each tile's entries begin, and one more.
    starts: Vec<u32>,
}

impl Plan {
    /// Counts the entries of all chunks.
    pub(crate) fn new(chunks: &[Chunk], context: &ListContext, sources: &PaintSources<'_>) -> Self {
        let tiles = context.tiles;
        let all = Span {
            start: 0,
            end: tiles.rows.cast_signed(),
        };
        let of_chunk = |chunk: &Chunk| {
            let mut counts = vec![0; tiles.columns as usize * tiles.rows as usize];
            let mut few = chunk.commands.len() <= MAX_KEPT_COMMANDS;
            let mut kept = Vec::with_capacity(if few { FEW } else { 0 });
            Binner::new(chunk, context, all).each(sources, |tile, entry| {
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
            let tiles = to_index(row) * self.columns..(to_index(row) + 1) * self.columns;
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

    /// Sorts the commands of every chunk into the tiles of `rows`, a range of tile rows.
    pub(crate) fn bins(
        &self,
        chunks: &[Chunk],
        context: &ListContext,
        sources: &PaintSources<'_>,
        rows: Span,
    ) -> Vec<Arc<Bins>> {
        let tiles = to_index(rows.start) * self.columns..to_index(rows.end) * self.columns;
        let are_all = rows.start == 0 && rows.end == self.rows;
        let ready = |plan: &ChunkPlan| plan.bins.clone().filter(|_| are_all);
        // No other thread is woken up where all bins are ready.
        if let Some(bins) = self.chunks.iter().map(ready).collect() {
            return bins;
        }
        let of_chunk = |(chunk, plan): (&Chunk, &ChunkPlan)| {
            ready(plan).unwrap_or_else(|| {
                let mut sorter = Sorter::new(&plan.counts[tiles.clone()]);
                Binner::new(chunk, context, rows).each(sources, |tile, entry| sorter.add(tile, entry));
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
                entries: vec![TileCommand::default(); total as usize],
                starts,
            },
        }
    }

    #[inline]
    fn add(&mut self, tile: usize, entry: TileCommand) {
        let place = &mut self.next[tile];
        self.bins.entries[*place as usize] = entry;
        *place += 1;
    }
}

impl Bins {
    /// All entries of a single tile.
    pub(crate) fn of_one_tile(entries: Vec<TileCommand>) -> Self {
        let end = u32::try_from(entries.len()).unwrap_or(u32::MAX);
        Self {
            entries,
            starts: vec![0, end],
        }
    }

    /// The entries of a tile, counted row by row from the first tile row that was asked for.
    pub(crate) fn of_tile(&self, tile: usize) -> &[TileCommand] {
        &self.entries[self.starts[tile] as usize..self.starts[tile + 1] as usize]
    }
}

/// The entries of a chunk in the tile in column `column` of row `row`, without those of any other.
pub(crate) fn entries_of_tile(
    chunk: &Chunk,
    context: &ListContext,
    sources: &PaintSources<'_>,
    [column, row]: [i32; 2],
) -> Vec<TileCommand> {
    let mut entries = Vec::new();
    let rows = Span {
        start: row,
        end: row + 1,
    };
    Binner::new(chunk, context, rows).each(sources, |tile, entry| {
        if tile == to_index(column) {
            entries.push(entry);
        }
    });
    entries
}

#[cfg(test)]
mod tests {
    use arbtest::arbitrary::{Result, Unstructured};
    use glam::DVec2;

    use super::*;
    use crate::color::Rgba;
    use crate::raster::binning::tile_command::Work;
    use crate::raster::coverage::shape::Shape;
    use crate::raster::coverage::triangle::SortedTriangle;
    use crate::raster::list::builder::ChunkBuilder;
    use crate::raster::shading::Paint;
    use crate::raster::span::SpanRect;
    use crate::raster::tile_layout::TileLayout;
    use crate::raster::{RasterSettings, SampleRate};
    use crate::rules::Rules;
    use crate::texture::SamplingSettings;

    const SIZE: [u32; 2] = [150, 90];

    fn settings(side: u32, rules: Rules) -> RasterSettings {
        RasterSettings {
            rate: SampleRate::new(side * side).expect("a square number"),
            sampling: SamplingSettings {
                rules,
                ..SamplingSettings::default()
            },
            ..RasterSettings::default()
        }
    }

    /// Bins of entries that were kept when they were counted; those of a second walk are the same, also row by row.
    fn binned(context: &ListContext, triangles: &[[DVec2; 3]]) -> (Chunk, Arc<Bins>) {
        let mut builder = ChunkBuilder::new(context, triangles.len());
        for triangle in triangles {
            builder.triangle(*triangle, &Paint::solid(Rgba::BLACK));
        }
        let chunk = builder.finish();
        let chunks = [chunk];
        let mut plan = Plan::new(&chunks, context, &PaintSources::default());
        let groups = plan.groups();
        assert_eq!(groups.len(), 1, "few entries are one group");
        let bins = |plan: &Plan, rows| {
            plan.bins(&chunks, context, &PaintSources::default(), rows)
                .pop()
                .expect("one chunk")
        };
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
                let tile = to_index(row) * columns + column;
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
    fn covered(chunk: &Chunk, context: &ListContext, rect: SpanRect) -> Vec<(i32, i32)> {
        let side = context.grid.side();
        let scaled = |span: Span| Span {
            start: span.start * side,
            end: span.end * side,
        };
        let (columns, rows) = (scaled(rect.x), scaled(rect.y));
        let mut samples = Vec::new();
        for float in &chunk.floats {
            for row in rows.start..rows.end {
                let inside = (columns.start..columns.end).filter(|column| float.covers(context.grid, [*column, row]));
                samples.extend(inside.map(|column| (column - columns.start, row - rows.start)));
            }
        }
        for triangle in chunk.triangles.iter().filter(|_| chunk.floats.is_empty()) {
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
            let sides = *u.choose(&[[3, 3], [6, 5], [2, 4], [0, 1]])?;
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
                            assert_eq!(found.len(), to_index(all), "tile {column}, {row} is open: {chunk:?}");
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
            // First drafts know no stamps.
            let settings = settings(u.int_in_range(1..=4)?, *u.choose(&[Rules::Standard, Rules::Course])?);
            let sides = *u.choose(&[[3, 3], [6, 5], [1, 2], [0, 0]])?;
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
                .push(crate::raster::list::chunk::ScreenTriangle { corners, paint: 0 });
            assert!(chunk.triangles.is_empty(), "{points:?} is small");
            for row in 0..context.tiles.rows {
                for column in 0..context.tiles.columns {
                    let mut found = Vec::new();
                    for entry in bins.of_tile((row * context.tiles.columns + column) as usize) {
                        let Work::Flat(Shape::Samples(coverage), _) = entry.work(&chunk) else {
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
        let context = ListContext::with_tiles(size, &settings, TileLayout::new([5, 5], size));
        let far = |x: f64, y: f64| DVec2::new(x, y);
        let (_, bins) = binned(&context, &[[DVec2::ZERO, far(1023.0, 1024.0), far(1024.0, 1023.0)]]);
        let entries = bins.entries.len();
        assert!(
            (32..=3 * 32).contains(&entries),
            "{entries} entries along a diagonal of 32 tiles"
        );
    }
}
