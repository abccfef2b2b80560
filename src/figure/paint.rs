//! Rectangles of colour in a frame.

use super::PixelRect;
use crate::raster::Framebuffer;

/// `rect` without `depth` pixels on every side.
pub(super) fn inner(rect: &PixelRect, depth: u32) -> PixelRect {
    PixelRect {
        x: rect.x + i64::from(depth),
        y: rect.y + i64::from(depth),
        width: rect.width.saturating_sub(2 * depth),
        height: rect.height.saturating_sub(2 * depth),
    }
}

/// `rect` with one pixel more on every side.
pub(super) fn outer(rect: &PixelRect) -> PixelRect {
    PixelRect {
        x: rect.x - 1,
        y: rect.y - 1,
        width: rect.width + 2,
        height: rect.height + 2,
    }
}

/// Fills `rect`, which lies inside `picture`.
pub(super) fn fill(picture: &mut Framebuffer, rect: &PixelRect, color: u32) {
    let width = picture.width() as usize;
    for_each_index(rect, width, |index| picture.pixels_mut()[index] = color);
}

/// Calls `visit` with the index of every pixel of `rect`, which lies inside a picture of this `width`.
pub(super) fn for_each_index(rect: &PixelRect, width: usize, mut visit: impl FnMut(usize)) {
    for y in rect.y..rect.bottom() {
        for x in rect.x..rect.right() {
            if let (Ok(x), Ok(y)) = (usize::try_from(x), usize::try_from(y)) {
                visit(y * width + x);
            }
        }
    }
}

/// A straight colour over white, as opaque `0xAARRGGBB`.
pub(super) fn over_white([r, g, b, a]: [u8; 4]) -> u32 {
    let alpha = u32::from(a);
    let mix = |channel: u8| (u32::from(channel) * alpha + 255 * (255 - alpha) + 127) / 255;
    0xff00_0000 | mix(r) << 16 | mix(g) << 8 | mix(b)
}
