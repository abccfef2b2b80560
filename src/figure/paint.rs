//! Colour into a frame: rectangles, and pixels blended.

use super::PixelRect;
use crate::color::unit_to_byte;
use crate::raster::Framebuffer;
use crate::rules::Rules;

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

/// Copies `source` to where its upper left corner is at `place`; what lies outside `picture` is left out.
pub(super) fn copy(source: &Framebuffer, picture: &mut Framebuffer, [x, y]: [i64; 2]) {
    let place = PixelRect {
        x,
        y,
        width: source.width(),
        height: source.height(),
    };
    let shown = place.intersection(&PixelRect::of_size([picture.width(), picture.height()]));
    let index = |at: i64, from: i64| usize::try_from(at - from).unwrap_or(0);
    let (from, to) = (source.width() as usize, picture.width() as usize);
    for row in shown.y..shown.bottom() {
        let start = index(row, y) * from + index(shown.x, x);
        let target = index(row, 0) * to + index(shown.x, 0);
        let length = shown.width as usize;
        picture.pixels_mut()[target..target + length].copy_from_slice(&source.pixels()[start..start + length]);
    }
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

/// A straight colour at a part of its opacity, `0.0..=1.0`, over a straight pixel (Porter and Duff's source-over).
pub(super) fn blend(below: u32, above: u32, part: f32) -> u32 {
    let [above_alpha, above @ ..] = above.to_be_bytes();
    let [below_alpha, below @ ..] = below.to_be_bytes();
    let cover = f32::from(above_alpha) / 255.0 * part;
    let rest = f32::from(below_alpha) / 255.0 * (1.0 - cover);
    let alpha = cover + rest;
    if alpha <= 0.0 {
        return 0;
    }
    let mix = |i: usize| (f32::from(above[i]) * cover + f32::from(below[i]) * rest) / alpha / 255.0;
    let byte = |unit: f32| unit_to_byte(unit, Rules::Standard);
    u32::from_be_bytes([byte(alpha), byte(mix(0)), byte(mix(1)), byte(mix(2))])
}
