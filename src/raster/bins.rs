//! Which ops touch which tile, in painter's order.
//!
//! A small triangle goes to the tiles of its box. For a larger one the edge functions at each tile's corner samples
//! decide: a tile wholly outside an edge is left out, a tile inside all three is marked as covered, so that painting it
//! needs no coverage at all. An opaque triangle that covers a tile hides everything painted there before.

use rayon::prelude::*;

use super::display_list::{Chunk, ListContext, Op};
use super::rows::Span;
use super::shade::Shader;
use super::tile::PixelRect;
use crate::geometry::edge::{doubled_area, edge_value};
use crate::geometry::subpixel::GridPoint;
use crate::texture::Texture;

/// Most entries that are held at once; more are made and painted in several passes over groups of tile rows.
const MAX_ENTRIES: u64 = 1 << 24;

/// One op in one tile.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Entry(u32);

/// The entries of one chunk, tile by tile.
#[derive(Debug, Default)]
pub(crate) struct Bins {
    entries: Vec<Entry>,
    /// Where each tile's entries begin, and one more.
    starts: Vec<u32>,
}

/// How a triangle lies to a tile.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Relation {
    Outside,
    Crossing,
    Covering,
}

impl Entry {
    const COVERS: u32 = 1 << 31;
    const HIDES: u32 = 1 << 30;

    /// An op that touches a tile, or a part of it.
    pub(crate) fn crossing(op: usize) -> Self {
        debug_assert!(op < Self::HIDES as usize, "op {op} fits 30 bits");
        Self(u32::try_from(op).unwrap_or(0))
    }

    /// Index of the op in its chunk.
    pub(crate) fn op(self) -> usize {
        (self.0 & !(Self::COVERS | Self::HIDES)) as usize
    }

    /// Whether the op is a triangle that covers every sample of the tile.
    pub(crate) fn covers_tile(self) -> bool {
        self.0 & Self::COVERS != 0
    }

    /// Whether nothing painted in the tile before this op can be seen.
    pub(crate) fn hides_tile(self) -> bool {
        self.0 & Self::HIDES != 0
    }
}

impl Bins {
    /// Sorts the ops of a chunk into the tiles of `rows`, a range of tile rows.
    pub(crate) fn new(chunk: &Chunk, context: &ListContext, textures: &[&Texture], rows: Span) -> Self {
        let columns = context.tiles.columns as usize;
        let tile = |x: i32, y: i32| place(y - rows.start) * columns + place(x);
        let mut found: Vec<(u32, Entry)> = Vec::with_capacity(chunk.ops.len());
        let mut depth = chunk.layers_open;
        for (i, op) in chunk.ops.iter().enumerate() {
            let Some(area) = chunk.area(op, context) else {
                continue;
            };
            let mut tiles = context.tiles.tiles_of(area);
            tiles.y = tiles.y.intersection(rows);
            match op {
                Op::BeginLayer { .. } => depth += 1,
                Op::EndLayer { .. } => depth = depth.saturating_sub(1),
                Op::Triangle(_) | Op::Pixels { .. } => {}
            }
            let triangle = match op {
                Op::Triangle(index) => Some(&chunk.triangles[*index as usize]),
                _ => None,
            };
            let hides = depth == 0
                && triangle.is_some_and(|triangle| Shader::is_opaque(&chunk.paints[triangle.paint as usize], textures));
            let large = (tiles.x.end - tiles.x.start) * (tiles.y.end - tiles.y.start) > 2;
            for y in tiles.y.start..tiles.y.end {
                for x in tiles.x.start..tiles.x.end {
                    let mut entry = Entry::crossing(i);
                    if let Some(triangle) = triangle.filter(|_| large) {
                        match relation(context, triangle.corners, [x, y]) {
                            Relation::Outside => continue,
                            Relation::Crossing => {}
                            Relation::Covering => entry.0 |= Entry::COVERS | if hides { Entry::HIDES } else { 0 },
                        }
                    }
                    found.push((u32::try_from(tile(x, y)).unwrap_or(0), entry));
                }
            }
        }
        Self::sorted(&found, columns * place(rows.end - rows.start))
    }

    /// A counting sort by tile, which keeps the order of ops inside a tile.
    fn sorted(found: &[(u32, Entry)], tiles: usize) -> Self {
        let mut starts = vec![0_u32; tiles + 1];
        for (tile, _) in found {
            starts[*tile as usize + 1] += 1;
        }
        for tile in 0..tiles {
            starts[tile + 1] += starts[tile];
        }
        let mut next = starts.clone();
        let mut entries = vec![Entry(0); found.len()];
        for (tile, entry) in found {
            let slot = &mut next[*tile as usize];
            entries[*slot as usize] = *entry;
            *slot += 1;
        }
        Self { entries, starts }
    }

    /// The entries of a tile, counted row by row from the first tile row that was asked for.
    pub(crate) fn of_tile(&self, tile: usize) -> &[Entry] {
        &self.entries[self.starts[tile] as usize..self.starts[tile + 1] as usize]
    }
}

/// Cuts the tile rows of a frame into groups whose entries fit in memory together; mostly a single group.
pub(crate) fn groups(chunks: &[Chunk], context: &ListContext) -> Vec<Span> {
    let rows = context.tiles.rows as usize;
    let counts = chunks
        .par_iter()
        .map(|chunk| {
            let mut changes = vec![0_i64; rows + 1];
            for op in &chunk.ops {
                if let Some(area) = chunk.area(op, context) {
                    let tiles = context.tiles.tiles_of(area);
                    let width = i64::from(tiles.x.end - tiles.x.start);
                    changes[place(tiles.y.start)] += width;
                    changes[place(tiles.y.end)] -= width;
                }
            }
            changes
        })
        .reduce(
            || vec![0; rows + 1],
            |a, b| a.iter().zip(&b).map(|(a, b)| a + b).collect(),
        );
    let (mut groups, mut start, mut in_row, mut in_group) = (Vec::new(), 0, 0_i64, 0_u64);
    for (row, change) in (0_i32..).zip(&counts[..rows]) {
        in_row += change;
        in_group += in_row.cast_unsigned();
        if in_group > MAX_ENTRIES && row > start {
            groups.push(Span { start, end: row });
            start = row;
            in_group = in_row.cast_unsigned();
        }
    }
    groups.push(Span {
        start,
        end: i32::try_from(rows).unwrap_or(i32::MAX),
    });
    groups
}

/// A tile coordinate, which is never negative.
fn place(coordinate: i32) -> usize {
    coordinate.max(0).cast_unsigned() as usize
}

/// How a triangle lies to the samples of a tile.
fn relation(context: &ListContext, [a, b, c]: [GridPoint; 3], [column, row]: [i32; 2]) -> Relation {
    let grid = context.grid;
    let PixelRect { x, y } = context
        .tiles
        .pixels(column.cast_unsigned(), row.cast_unsigned(), context.size);
    let first_and_last = |pixels: Span| {
        [pixels.start * grid.side(), pixels.end * grid.side() - 1].map(|sample| grid.sample_coordinate(sample))
    };
    let (xs, ys) = (first_and_last(x), first_and_last(y));
    let corners = if doubled_area([a, b, c]) < 0 {
        [a, c, b]
    } else {
        [a, b, c]
    };
    let mut covered = true;
    for i in 0..3 {
        let at = |x: usize, y: usize| edge_value(corners[i], corners[(i + 1) % 3], GridPoint { x: xs[x], y: ys[y] });
        let values = [at(0, 0), at(1, 0), at(0, 1), at(1, 1)];
        if values.iter().all(|value| *value < 0) {
            return Relation::Outside;
        }
        covered &= values.iter().all(|value| *value > 0);
    }
    if covered {
        Relation::Covering
    } else {
        Relation::Crossing
    }
}
