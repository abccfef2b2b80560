//! Frames whose finished pixels are smoothed: of all of them, of some rectangles, or cell by cell as tiles come.
//!
//! A pixel depends on others around it, so rectangles are drawn with a margin, and a cell is finished when all tiles around it
//! have come. Either way the bytes are those of the whole frame.

use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};

use super::{FrameStats, RenderSettings, Visualisation};
use crate::post::{self, REACH, Values};
use crate::raster::{Framebuffer, Region};

/// Side of a cell in pixels: large beside the margin around it, and small beside a frame.
const CELL: u32 = 128;

/// In which values the pixels of a frame are blended, where they are: those of anything else than colours are not.
pub(super) fn of_frame(settings: &RenderSettings) -> Option<Values> {
    let shows_picture = settings.visualisation == Visualisation::Color;
    settings.smoothing().filter(|_| shows_picture)
}

/// Smooths a frame where the settings say so, and tells how long that took.
pub(super) fn whole(settings: &RenderSettings, frame: &mut Framebuffer) -> Duration {
    let Some(values) = of_frame(settings) else {
        return Duration::ZERO;
    };
    let start = Instant::now();
    let size = [frame.width(), frame.height()];
    post::smaa(frame.pixels_mut(), size, values);
    start.elapsed()
}

/// Smooths the pixels of some regions; `draw` draws those around, too.
pub(super) fn regions(
    frame: &mut Framebuffer,
    regions: &[Region],
    values: Values,
    draw: impl FnOnce(&mut Framebuffer, &[Region]) -> Option<FrameStats>,
) -> Option<FrameStats> {
    let size = [frame.width(), frame.height()];
    let around: Vec<Region> = regions.iter().map(|region| widened(*region, size)).collect();
    let mut resolved = Framebuffer::new(size[0], size[1]);
    let mut stats = draw(&mut resolved, &around)?;
    let start = Instant::now();
    if let Some(all) = around.iter().copied().filter(|region| !region.is_empty()).reduce(hull) {
        let mut part = resolved.cut(all);
        post::smaa(part.pixels_mut(), [all.width, all.height], values);
        for region in regions {
            frame.copy_from(all, part.pixels(), *region);
        }
    }
    stats.resolve += start.elapsed();
    Some(stats)
}

/// Smooths one pixel of a frame of `size` pixels; `draw` draws a region by tiles, each of which it hands over. `None` outside
/// the frame.
pub(super) fn pixel(
    size: [u32; 2],
    [x, y]: [u32; 2],
    values: Values,
    draw: impl FnOnce(Region, &(dyn Fn(Region, &[u32]) + Sync)),
) -> Option<u32> {
    let own = Region::of_pixel([x, y]);
    let around = widened(own, size);
    let part = Mutex::new(Framebuffer::new(around.width, around.height));
    draw(around, &|tile, pixels| {
        let mut part = part.lock().unwrap_or_else(PoisonError::into_inner);
        part.copy_part([around.x, around.y], tile, pixels);
    });
    let mut part = part.into_inner().unwrap_or_else(PoisonError::into_inner);
    post::smaa(part.pixels_mut(), [around.width, around.height], values);
    let inner = Region {
        x: x.checked_sub(around.x)?,
        y: y.checked_sub(around.y)?,
        ..own
    };
    part.cut(inner).pixels().first().copied()
}

/// The pixels of a frame of `size` pixels that decide about the smoothed ones of a region.
pub fn widened(region: Region, size: [u32; 2]) -> Region {
    let inside = region.intersection(Region::of_size(size));
    if inside.is_empty() {
        return Region::default();
    }
    let (x, y) = (inside.x.saturating_sub(REACH), inside.y.saturating_sub(REACH));
    let all = Region {
        x,
        y,
        width: inside.right() + REACH - x,
        height: inside.bottom() + REACH - y,
    };
    all.intersection(Region::of_size(size))
}

/// The least region that holds two others.
fn hull(a: Region, b: Region) -> Region {
    let (x, y) = (a.x.min(b.x), a.y.min(b.y));
    Region {
        x,
        y,
        width: a.right().max(b.right()) - x,
        height: a.bottom().max(b.bottom()) - y,
    }
}

/// The cells of a frame, which are smoothed one by one.
#[derive(Debug)]
pub(super) struct Cells {
    size: [u32; 2],
    values: Values,
    drawn: Mutex<Drawn>,
}

/// What came so far.
#[derive(Debug)]
struct Drawn {
    resolved: Framebuffer,
    /// Pixels that each cell still waits for, row by row.
    missing: Vec<u64>,
}

impl Cells {
    /// Of a frame of which nothing is drawn.
    pub(super) fn new(size: [u32; 2], values: Values) -> Self {
        let [columns, rows] = size.map(|side| side.div_ceil(CELL));
        let cells = (0..rows).flat_map(|row| (0..columns).map(move |column| [column, row]));
        Self {
            size,
            values,
            drawn: Mutex::new(Drawn {
                resolved: Framebuffer::new(size[0], size[1]),
                missing: cells.map(|cell| area(widened(region_of(cell, size), size))).collect(),
            }),
        }
    }

    /// Takes a tile in, and hands the cells to `publish` that waited for nothing else.
    pub(super) fn take(&self, tile: Region, pixels: &[u32], publish: impl Fn(Region, &[u32])) {
        for (cell, all) in self.finished(tile, pixels) {
            let around = widened(cell, self.size);
            let mut part = all;
            post::smaa(part.pixels_mut(), [around.width, around.height], self.values);
            let inner = Region {
                x: cell.x - around.x,
                y: cell.y - around.y,
                ..cell
            };
            publish(cell, part.cut(inner).pixels());
        }
    }

    /// The cells that now have all, with the pixels around them.
    fn finished(&self, tile: Region, pixels: &[u32]) -> Vec<(Region, Framebuffer)> {
        let mut drawn = self.drawn.lock().unwrap_or_else(PoisonError::into_inner);
        let Drawn { resolved, missing } = &mut *drawn;
        resolved.copy_from(tile, pixels, tile);
        let columns = self.size[0].div_ceil(CELL);
        let near = widened(tile, self.size);
        let rows = near.y / CELL..near.bottom().div_ceil(CELL);
        let cells = rows.flat_map(|row| (near.x / CELL..near.right().div_ceil(CELL)).map(move |column| [column, row]));
        let mut finished = Vec::new();
        for cell in cells {
            let region = region_of(cell, self.size);
            let around = widened(region, self.size);
            let came = area(around.intersection(tile));
            let missing = &mut missing[(cell[1] * columns + cell[0]) as usize];
            *missing -= came;
            if came > 0 && *missing == 0 {
                finished.push((region, resolved.cut(around)));
            }
        }
        finished
    }
}

/// A cell's pixels.
fn region_of([column, row]: [u32; 2], size: [u32; 2]) -> Region {
    let cell = Region {
        x: column * CELL,
        y: row * CELL,
        width: CELL,
        height: CELL,
    };
    cell.intersection(Region::of_size(size))
}

fn area(region: Region) -> u64 {
    u64::from(region.width) * u64::from(region.height)
}
