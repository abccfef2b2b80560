//! Parts of a picture: some rectangles of a frame, or all tiles in the order of their distance from a pixel.

use std::sync::{Mutex, PoisonError};
use std::time::Instant;

use super::smoothed::{self, Cells};
use super::{CancelToken, FrameStats, RenderSettings, display_list};
use crate::geometry::ViewTransform;
use crate::raster::{Framebuffer, Region};
use crate::scene::Scene;

/// What decides a picture's pixels, but for its size.
#[derive(Clone, Copy, Debug)]
pub struct Subject<'a> {
    /// What is drawn.
    pub scene: &'a Scene,
    /// From where.
    pub view: &'a ViewTransform,
    /// How.
    pub settings: &'a RenderSettings,
}

/// Draws the pixels of `regions` and leaves the rest of `frame` as it is; they are the bytes of [`super::draw`] of the
/// whole frame. `None` once `cancel` says so: then the regions are unfinished.
pub fn draw_regions(
    subject: &Subject<'_>,
    frame: &mut Framebuffer,
    regions: &[Region],
    cancel: &CancelToken,
) -> Option<FrameStats> {
    if let Some(values) = smoothed::of_frame(subject.settings) {
        return smoothed::regions(frame, regions, values, |resolved, around| {
            draw_resolved(subject, resolved, around, cancel)
        });
    }
    draw_resolved(subject, frame, regions, cancel)
}

/// A part of a frame of `size` pixels, its pixels as the resolve made them, whatever the settings do to them after that. It
/// takes memory for the part alone.
pub fn resolved_part(subject: &Subject<'_>, size: [u32; 2], part: Region) -> Framebuffer {
    let part = part.intersection(Region::of_size(size));
    let drawn = Mutex::new(Framebuffer::new(part.width, part.height));
    let publish = |tile: Region, pixels: &[u32]| {
        let mut drawn = drawn.lock().unwrap_or_else(PoisonError::into_inner);
        drawn.copy_part([part.x, part.y], tile, pixels);
    };
    let order = TileOrder {
        wanted: &[part],
        from: [0, 0],
    };
    tiles(subject, size, order, &CancelToken::default(), &publish);
    drawn.into_inner().unwrap_or_else(PoisonError::into_inner)
}

/// As [`draw_regions`], but leaves pixels as the resolve made them.
fn draw_resolved(
    subject: &Subject<'_>,
    frame: &mut Framebuffer,
    regions: &[Region],
    cancel: &CancelToken,
) -> Option<FrameStats> {
    let size = [frame.width(), frame.height()];
    let frame = Mutex::new(frame);
    let publish = |tile: Region, pixels: &[u32]| {
        let mut frame = frame.lock().unwrap_or_else(PoisonError::into_inner);
        for region in regions {
            frame.copy_from(tile, pixels, *region);
        }
    };
    let order = TileOrder {
        wanted: regions,
        from: [0, 0],
    };
    tiles(subject, size, order, cancel, &publish)
}

/// Draws a frame of `size` pixels tile by tile, those nearest to the pixel `from` first, and hands each to `publish`:
/// its place and its pixels `0xAARRGGBB`, row by row. Calls come from many threads at once; each pixel comes once, and
/// all of them are the bytes of [`super::draw`]. `None` once `cancel` says so: then tiles are missing.
pub fn refine(
    subject: &Subject<'_>,
    size: [u32; 2],
    from: [u32; 2],
    cancel: &CancelToken,
    publish: impl Fn(Region, &[u32]) + Sync,
) -> Option<FrameStats> {
    let wanted = &[Region::of_size(size)];
    let order = TileOrder { wanted, from };
    if let Some(values) = smoothed::of_frame(subject.settings) {
        let cells = Cells::new(size, values);
        return tiles(subject, size, order, cancel, &|tile, pixels| {
            cells.take(tile, pixels, &publish);
        });
    }
    tiles(subject, size, order, cancel, &publish)
}

/// Which regions are drawn, and the pixel that tiles are nearest to which come first.
#[derive(Clone, Copy)]
struct TileOrder<'a> {
    wanted: &'a [Region],
    from: [u32; 2],
}

fn tiles<F: Fn(Region, &[u32]) + Sync>(
    subject: &Subject<'_>,
    size: [u32; 2],
    order: TileOrder<'_>,
    cancel: &CancelToken,
    publish: &F,
) -> Option<FrameStats> {
    let start = Instant::now();
    let list = display_list(subject, size);
    let transform = start.elapsed();
    if cancel.is_cancelled() {
        return None;
    }
    let times = list.rasterize_tiles(order.wanted, order.from, &cancel.0, publish)?;
    Some(FrameStats {
        transform,
        bin: times.bin,
        raster: times.raster,
        resolve: times.resolve,
        triangles: list.triangles(),
        counters: times.counters,
    })
}
