//! The commands of a tile that may be seen: those from the last opaque shape on that covers it wholly.

use std::sync::Arc;

use crate::raster::binning::bins::Bins;
use crate::raster::binning::tile_command::TileCommand;

/// The chunk and the entry in it that painting a tile may start with: the last opaque shape that covers it wholly.
pub(in crate::raster) fn first_visible(bins: &[Arc<Bins>], tile: usize) -> (usize, usize) {
    for (chunk, bins) in bins.iter().enumerate().rev() {
        if let Some(entry) = bins.of_tile(tile).iter().rposition(|entry| entry.hides_tile()) {
            return (chunk, entry);
        }
    }
    (0, 0)
}

/// The entries of a tile from `first` on, chunk by chunk.
pub(in crate::raster) fn visible(
    bins: &[Arc<Bins>],
    tile: usize,
    (chunk, entry): (usize, usize),
) -> impl Iterator<Item = (usize, &[TileCommand])> + Clone {
    bins.iter().enumerate().skip(chunk).map(move |(i, bins)| {
        let skip = if i == chunk { entry } else { 0 };
        (i, &bins.of_tile(tile)[skip..])
    })
}
