//! Metrics whose windows overlap, tile by tile: memory does not grow with the picture, and tiles that are alike in both
//! pictures are not computed at all.

use rayon::prelude::*;

use crate::color::Rgba;
use crate::raster::{Framebuffer, Region};
use crate::render::CancelToken;

use super::Pair;

/// Width and height of a tile in pixels.
const TILE: [u32; 2] = [256, 128];

/// The sum over all tiles of `region` of what `measure` finds in one; added in a fixed order, so that the sum does not
/// depend on threads. `None` once `cancel` says so.
pub(super) fn sum(region: Region, cancel: &CancelToken, measure: impl Fn(Region) -> f64 + Sync) -> Option<f64> {
    let [columns, rows] = [region.width.div_ceil(TILE[0]), region.height.div_ceil(TILE[1])];
    let tiles = (0..columns * rows).into_par_iter().map(|index| {
        if cancel.is_cancelled() {
            return None;
        }
        let tile = Region {
            x: region.x + index % columns * TILE[0],
            y: region.y + index / columns * TILE[1],
            width: TILE[0],
            height: TILE[1],
        };
        Some(measure(tile.intersection(region)))
    });
    let sums: Option<Vec<f64>> = tiles.collect();
    Some(sums?.iter().sum())
}

/// The smallest side in pixels of a part of a tile that is looked at by itself.
const SMALLEST: u32 = 32;

/// The quarters of a tile, which may be of different sizes.
fn quarters(tile: Region) -> [Region; 4] {
    let (left, top) = (tile.width / 2, tile.height / 2);
    [(0, 0), (1, 0), (0, 1), (1, 1)].map(|(column, row)| Region {
        x: tile.x + column * left,
        y: tile.y + row * top,
        width: if column == 0 { left } else { tile.width - left },
        height: if row == 0 { top } else { tile.height - top },
    })
}

impl Pair<'_> {
    /// The sum over `tile` of what `measure` finds where the pictures differ within `margin` pixels, and of `alike` for each
    /// other pixel. A tile is measured in quarters where that spares more pixels than their margins cost.
    pub(super) fn sum_where_unlike(
        self,
        tile: Region,
        margin: u32,
        alike: f64,
        measure: &impl Fn(Region) -> f64,
    ) -> f64 {
        if self.alike(tile, margin) {
            return alike * f64::from(tile.width) * f64::from(tile.height);
        }
        if tile.width.min(tile.height) < 2 * SMALLEST {
            return measure(tile);
        }
        let cost = |part: Region| u64::from(part.width + 2 * margin) * u64::from(part.height + 2 * margin);
        let parts = quarters(tile);
        let unlike = parts.iter().filter(|part| !self.alike(**part, margin));
        if unlike.map(|part| cost(*part)).sum::<u64>() >= cost(tile) {
            return measure(tile);
        }
        let sums = parts.map(|part| self.sum_where_unlike(part, margin, alike, measure));
        sums.iter().sum()
    }

    /// Whether the pictures are alike in `tile` and `margin` pixels around it.
    pub(super) fn alike(self, tile: Region, margin: u32) -> bool {
        let width = self.a.width() as usize;
        let columns = tile.x.saturating_sub(margin)..(tile.right() + margin).min(self.a.width());
        let rows = tile.y.saturating_sub(margin)..(tile.bottom() + margin).min(self.a.height());
        rows.map(|row| row as usize * width).all(|start| {
            let row = start + columns.start as usize..start + columns.end as usize;
            self.a.pixels()[row.clone()] == self.b.pixels()[row]
        })
    }
}

/// The pixels of `tile` and of `margin` around it as opaque bytes red, green, blue over white paper; beyond the frame
/// its border repeats. Rows from the top, each `tile.width + 2 margin` long.
pub(super) fn with_margin(frame: &Framebuffer, tile: Region, margin: u32) -> Vec<[u8; 3]> {
    let clamp = |from: u32, length: u32, side: u32| {
        (from..from + length + 2 * margin).map(move |i| i.saturating_sub(margin).min(side.saturating_sub(1)) as usize)
    };
    let columns: Vec<usize> = clamp(tile.x, tile.width, frame.width()).collect();
    clamp(tile.y, tile.height, frame.height())
        .flat_map(|row| {
            let row = &frame.pixels()[row * frame.width() as usize..];
            columns.iter().map(|column| over_white(row[*column]))
        })
        .collect()
}

/// A straight pixel `0xAARRGGBB` as it looks on white paper, mixed in stored values.
pub(super) fn over_white(pixel: u32) -> [u8; 3] {
    let [a, r, g, b] = pixel.to_be_bytes();
    if a == 255 {
        return [r, g, b];
    }
    let white = Rgba::WHITE;
    let front = Rgba::from_bytes([r, g, b, a]);
    let mix = |front: f32, back: f32| back + (front - back) * f32::from(a) / 255.0;
    let mixed = Rgba::opaque(mix(front.r, white.r), mix(front.g, white.g), mix(front.b, white.b));
    let [r, g, b, _] = mixed.to_bytes(crate::rules::Rules::Standard);
    [r, g, b]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tiles_cover_a_region_once() {
        let region = Region {
            x: 5,
            y: 7,
            width: 600,
            height: 300,
        };
        let area = |tile: Region| f64::from(tile.width * tile.height);
        let cancel = CancelToken::default();
        assert_eq!(sum(region, &cancel, area), Some(180_000.0), "all pixels");
        assert_eq!(sum(Region::default(), &cancel, area), Some(0.0), "none");
        cancel.cancel();
        assert_eq!(sum(region, &cancel, area), None, "cancelled");
    }

    #[test]
    fn tiles_are_measured_where_the_pictures_differ() {
        let a = Framebuffer::new(256, 128);
        let mut b = a.clone();
        b.pixels_mut()[3 * 256 + 200] = 1;
        let pair = Pair::new(&a, &b).expect("one size");
        let measured = std::cell::RefCell::new(Vec::new());
        let measure = |part: Region| {
            measured.borrow_mut().push(part);
            1000.0
        };
        let tile = Region::of_size([256, 128]);
        let sum = pair.sum_where_unlike(tile, 5, 0.5, &measure);
        let part = Region {
            x: 192,
            y: 0,
            width: 64,
            height: 32,
        };
        assert_eq!(measured.take(), [part], "a quarter of a quarter");
        let others = f64::from(256 * 128 - 64 * 32) * 0.5;
        assert!((sum - (1000.0 + others)).abs() < 1e-9, "{sum}: the rest is alike");
        for place in [100 * 256, 3 * 256 + 10, 100 * 256 + 200] {
            b.pixels_mut()[place] = 1;
        }
        let pair = Pair::new(&a, &b).expect("one size");
        let _ = pair.sum_where_unlike(tile, 60, 0.5, &measure);
        assert_eq!(measured.take(), [tile], "margins would cost more");
    }

    #[test]
    fn tiles_repeat_the_border() {
        let mut frame = Framebuffer::new(2, 2);
        frame
            .pixels_mut()
            .copy_from_slice(&[0xFF00_0001, 0xFF00_0002, 0xFF00_0003, 0x0000_0000]);
        let blue: Vec<u8> = with_margin(&frame, Region::of_size([2, 2]), 1)
            .iter()
            .map(|pixel| pixel[2])
            .collect();
        assert_eq!(
            blue,
            [1, 1, 2, 2, 1, 1, 2, 2, 3, 3, 255, 255, 3, 3, 255, 255],
            "and paper below"
        );
        assert_eq!(over_white(0x80FF_0000), [255, 127, 127], "half of red");
    }

    #[test]
    fn tiles_are_alike_with_their_margin() {
        let a = Framebuffer::new(30, 30);
        let mut b = a.clone();
        b.pixels_mut()[12 * 30 + 20] = 1;
        let pair = Pair::new(&a, &b).expect("one size");
        let tile = Region::of_size([10, 10]);
        assert!(
            pair.alike(tile, 2) && pair.alike(tile, 10),
            "(20, 12) is one column beyond"
        );
        assert!(!pair.alike(tile, 11), "within the margin");
        assert!(pair.alike(Region { x: 21, ..tile }, 0), "beside it");
    }
}
