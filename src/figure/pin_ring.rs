//! The ring around a pinned pixel, so that the eye finds it in the picture: the same in the window and on slides.

use super::PixelRect;
use super::inset::CENTER_COLOR;
use super::paint::blend;
use crate::raster::Framebuffer;

/// How the ring around a pinned pixel looks, in points of a window.
#[derive(Clone, Copy, Debug)]
pub struct PinRing;

impl PinRing {
    /// Its radius around a pixel of no extent.
    pub const RADIUS: f32 = 8.0;
    /// Widths and opaque `0xAARRGGBB` of its lines, to be seen on any ground: the widest first, the last in the colour that
    /// marks the pixel in the inspector.
    pub const LINES: [(f32, u32); 2] = [(4.5, 0xffff_ffff), (2.0, CENTER_COLOR)];

    /// Its radius around a pixel that has this size in the picture, where a point has `unit` pixels.
    pub fn radius(size: [f32; 2], unit: f32) -> f32 {
        Self::RADIUS * unit + size[0].hypot(size[1]) / 2.0
    }

    /// Draws it around `pixel`, where a point has `unit` pixels. The pixel and its neighbours stay as they are.
    pub fn draw(picture: &mut Framebuffer, pixel: &PixelRect, unit: f32) {
        let size = [pixel.width as f32, pixel.height as f32];
        let radius = Self::radius(size, unit);
        let [(widest, _), _] = Self::LINES;
        #[expect(clippy::cast_possible_truncation, reason = "`as` saturates; clipped to the picture")]
        let reach = (radius + widest * unit).ceil() as i64;
        let around = PixelRect {
            x: pixel.x - reach,
            y: pixel.y - reach,
            width: pixel.width.saturating_add(u32::try_from(2 * reach).unwrap_or(0)),
            height: pixel.height.saturating_add(u32::try_from(2 * reach).unwrap_or(0)),
        };
        let width = i64::from(picture.width());
        let seen = around.intersection(&PixelRect::of_size([picture.width(), picture.height()]));
        for y in seen.y..seen.bottom() {
            for x in seen.x..seen.right() {
                // From the middle of one pixel to that of the other.
                let across = (x - pixel.x) as f32 + 0.5 - size[0] / 2.0;
                let down = (y - pixel.y) as f32 + 0.5 - size[1] / 2.0;
                let distance = (across.hypot(down) - radius).abs();
                let index = usize::try_from(y * width + x).ok();
                let Some(below) = index.and_then(|index| picture.pixels_mut().get_mut(index)) else {
                    continue;
                };
                for (line, color) in Self::LINES {
                    *below = blend(*below, color, (line * unit / 2.0 + 0.5 - distance).clamp(0.0, 1.0));
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const GROUND: u32 = 0xff20_4060;

    #[test]
    fn ring_leaves_its_pixel_and_neighbours() {
        let mut picture = Framebuffer::new(41, 41);
        picture.pixels_mut().fill(GROUND);
        let pixel = PixelRect {
            x: 20,
            y: 20,
            width: 1,
            height: 1,
        };
        PinRing::draw(&mut picture, &pixel, 1.0);
        let row: Vec<u32> = picture.pixels()[20 * 41..21 * 41].to_vec();
        assert!(row[15..26].iter().all(|color| *color == GROUND), "inside: {row:x?}");
        let mirrored: Vec<u32> = row.iter().rev().copied().collect();
        assert_eq!(row, mirrored, "about its pixel");
        assert!(row.contains(&CENTER_COLOR), "the core: {row:x?}");
        assert_eq!([row[0], row[40]], [GROUND; 2], "outside");
    }

    #[test]
    fn ring_is_clipped_to_the_picture() {
        let mut picture = Framebuffer::new(6, 4);
        for (x, y) in [(-100, 2), (0, 0), (5, 3), (i64::from(u32::MAX), 1)] {
            let pixel = PixelRect {
                x,
                y,
                width: 3,
                height: 3,
            };
            PinRing::draw(&mut picture, &pixel, 2.0);
        }
    }
}
