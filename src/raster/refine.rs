//! Parts of a frame: chosen tiles in a chosen order, each handed out as soon as it is painted.
//!
//! Tiles are painted by the same code as whole frames, each into a buffer of its own, so any set of tiles in any order
//! holds the bytes of the whole frame.

use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::time::Instant;

use crate::raster::display_list::{DisplayList, Pass};
use crate::raster::frame::block::PixelBlock;
use crate::raster::frame::region::Region;
use crate::raster::span::Span;
use crate::raster::stats::RasterTimes;

/// A tile on its way: where it stands, and its pixels.
#[derive(Clone, Copy, Debug)]
struct WantedTile {
    tile: [u32; 2],
    region: Region,
}

impl DisplayList<'_> {
    /// Paints every tile that shares a pixel with `wanted`, those nearest to the pixel `from` first, and hands each to
    /// `publish`: its place in the frame and its pixels, row by row. Calls come from many threads at once; no pixel
    /// comes twice. `None` when `cancelled` was set meanwhile and tiles are missing.
    pub fn rasterize_tiles<F: Fn(Region, &[u32]) + Sync>(
        &self,
        wanted: &[Region],
        from: [u32; 2],
        cancelled: &AtomicBool,
        publish: &F,
    ) -> Option<RasterTimes> {
        let mut times = RasterTimes::default();
        if self.context.frame_size.contains(&0) {
            return Some(times);
        }
        let tiles_in_order = self.tiles_in_order(wanted, from);
        let start = Instant::now();
        let plan = self.plan();
        times.bin += start.elapsed();
        let mut passes: Vec<(Span, Vec<WantedTile>)> = plan
            .groups()
            .into_iter()
            .map(|rows| {
                let inside = |tile: &&WantedTile| (rows.start..rows.end).contains(&tile.tile[1].cast_signed());
                (rows, tiles_in_order.iter().filter(inside).copied().collect())
            })
            .filter(|(_, tiles_in_order): &(_, Vec<WantedTile>)| !tiles_in_order.is_empty())
            .collect();
        passes.sort_by_key(|(_, tiles_in_order)| tiles_in_order.first().map(|tile| distance(tile.region, from)));
        for (rows, tiles_in_order) in passes {
            let start = Instant::now();
            let pass = self.pass(&plan, rows, cancelled);
            times.bin += start.elapsed();
            let start = Instant::now();
            self.paint_in_order(&pass, &tiles_in_order, publish);
            times.painted(start.elapsed(), &pass.tally.total());
            if cancelled.load(Ordering::Relaxed) {
                return None;
            }
        }
        Some(times)
    }

    /// The tiles that share a pixel with `wanted`, in the order of their distance from a pixel.
    fn tiles_in_order(&self, wanted: &[Region], from: [u32; 2]) -> Vec<WantedTile> {
        let tiles = self.context.tiles;
        let all = (0..tiles.rows).flat_map(|row| (0..tiles.columns).map(move |column| [column, row]));
        let mut tiles_in_order: Vec<WantedTile> = all
            .map(|tile| WantedTile {
                tile,
                region: Region::of_tile(tiles.pixels(tile[0], tile[1], self.context.frame_size)),
            })
            .filter(|tile| wanted.iter().any(|region| !region.intersection(tile.region).is_empty()))
            .collect();
        tiles_in_order.sort_by_key(|tile| distance(tile.region, from));
        tiles_in_order
    }

    /// Each thread takes the next tile that no other has: a parallel iterator would start in the middle too.
    fn paint_in_order<F: Fn(Region, &[u32]) + Sync>(
        &self,
        pass: &Pass<'_>,
        tiles_in_order: &[WantedTile],
        publish: &F,
    ) {
        let next = AtomicUsize::new(0);
        let work = || {
            let mut painters = self.painters();
            let mut pixels = Vec::new();
            while let Some(tile) = tiles_in_order.get(next.fetch_add(1, Ordering::Relaxed))
                && !pass.cancelled.load(Ordering::Relaxed)
            {
                let Region { width, height, .. } = tile.region;
                pixels.resize(width as usize * height as usize, 0);
                let [column, row] = tile.tile;
                let rect = self.context.tiles.pixels(column, row, self.context.frame_size);
                let mut block = PixelBlock::new(rect, &mut pixels, width as usize);
                self.tile(pass, &mut painters, tile.tile, &mut block);
                if !pass.cancelled.load(Ordering::Relaxed) {
                    publish(tile.region, &pixels);
                }
            }
            pass.tally.take(&mut painters.tally);
        };
        rayon::scope(|scope| {
            for _ in 0..rayon::current_num_threads().min(tiles_in_order.len()) {
                scope.spawn(|_| work());
            }
        });
    }
}

/// Between a region's middle and a pixel, squared, in half pixels.
fn distance(region: Region, [x, y]: [u32; 2]) -> u64 {
    let along = |start: u32, length: u32, at: u32| {
        (2 * i64::from(start) + i64::from(length) - 2 * i64::from(at) - 1).unsigned_abs()
    };
    let (dx, dy) = (along(region.x, region.width, x), along(region.y, region.height, y));
    dx * dx + dy * dy
}
