//! The commands of a tile that may be seen: those from the last opaque shape on that covers it wholly.

use std::sync::Arc;

use crate::raster::binning::bins::Bins;
use crate::raster::binning::tile_command::TileCommand;

/// An entry of a tile: the number of its chunk, and its own among the tile's entries of that chunk.
#[derive(Clone, Copy, Debug)]
pub(in crate::raster) struct EntryIndex {
    pub(in crate::raster) chunk: usize,
    pub(in crate::raster) entry: usize,
}

/// What painting a tile may start with: the last opaque shape that covers it wholly.
pub(in crate::raster) fn first_visible(bins: &[Arc<Bins>], tile: usize) -> EntryIndex {
    for (chunk, bins) in bins.iter().enumerate().rev() {
        if let Some(entry) = bins.of_tile(tile).iter().rposition(|entry| entry.hides_tile()) {
            return EntryIndex { chunk, entry };
        }
    }
    EntryIndex { chunk: 0, entry: 0 }
}

/// The entries of a tile from `first` on, chunk by chunk.
pub(in crate::raster) fn visible(
    bins: &[Arc<Bins>],
    tile: usize,
    first: EntryIndex,
) -> impl Iterator<Item = (usize, &[TileCommand])> + Clone {
    bins.iter().enumerate().skip(first.chunk).map(move |(i, bins)| {
        let skip = if i == first.chunk { first.entry } else { 0 };
        (i, &bins.of_tile(tile)[skip..])
    })
}
