//! A frame on the window's pixels: magnified by the pixel zoom, transparency over a checker.

use super::PixelZoom;
use crate::figure::PixelRect;
use crate::raster::Framebuffer;

/// Side of the checker's squares, in window pixels.
const SQUARE: usize = 8;
/// The checker below transparent pixels.
const CHECKER: [u32; 2] = [0x00ff_ffff, 0x00dd_dddd];
/// Where the frame does not reach, before a resized window has its new frame.
const BEYOND: u32 = 0xff80_8080;

/// Writes `frame` into the whole of `window`, each frame pixel as an exact square of `zoom` window pixels. The result
/// is opaque. Where the window is larger than the frame it is grey: a picture is never stretched.
pub fn show(frame: &Framebuffer, zoom: PixelZoom, window: &mut Framebuffer) {
    let (width, factor) = (window.width() as usize, zoom.factor() as usize);
    let frame_width = frame.width() as usize;
    if width == 0 {
        return;
    }
    let sources = frame.pixels().chunks_exact(frame_width.max(1));
    let mut rows = window.pixels_mut().chunks_exact_mut(width).enumerate();
    for source in sources {
        for (y, row) in rows.by_ref().take(factor) {
            show_row(source, factor, y, row);
        }
    }
    for (_, row) in rows {
        row.fill(BEYOND);
    }
}

/// One row of the window: `y` counts the rows within a row of the frame.
fn show_row(source: &[u32], factor: usize, y: usize, row: &mut [u32]) {
    let reached = (source.len() * factor).min(row.len());
    let (shown, beyond) = row.split_at_mut(reached);
    beyond.fill(BEYOND);
    let is_opaque = source.iter().fold(u32::MAX, |all, pixel| all & pixel) >> 24 == 0xff;
    if is_opaque && factor == 1 {
        shown.copy_from_slice(&source[..reached]);
        return;
    }
    for (index, (block, pixel)) in shown.chunks_mut(factor).zip(source).enumerate() {
        if pixel >> 24 == 0xff {
            block.fill(*pixel);
        } else {
            for (column, target) in block.iter_mut().enumerate() {
                let square = ((index * factor + column) / SQUARE + y / SQUARE) % 2;
                *target = over(*pixel, CHECKER[square]);
            }
        }
    }
}

/// Copies `source` to `at` in `target`; what does not fit is cut off.
pub fn paste(source: &Framebuffer, at: [i64; 2], target: &mut Framebuffer) {
    let place = PixelRect {
        x: at[0],
        y: at[1],
        width: source.width(),
        height: source.height(),
    };
    let target_width = target.width() as usize;
    let shown = place.intersection(&PixelRect::of_size([target.width(), target.height()]));
    if shown.width == 0 || shown.height == 0 {
        return;
    }
    let offset = |from: i64, to: i64| usize::try_from(to - from).unwrap_or(0);
    let (left, top) = (offset(at[0], shown.x), offset(at[1], shown.y));
    let width = shown.width as usize;
    let rows = source.pixels().chunks_exact((source.width() as usize).max(1)).skip(top);
    let start = offset(0, shown.y) * target_width;
    let target_rows = target.pixels_mut().get_mut(start..).unwrap_or_default();
    for (row, target_row) in rows
        .zip(target_rows.chunks_exact_mut(target_width.max(1)))
        .take(shown.height as usize)
    {
        let x = offset(0, shown.x);
        target_row[x..x + width].copy_from_slice(&row[left..left + width]);
    }
}

/// A straight `0xAARRGGBB` over an opaque `0xRRGGBB`.
fn over(pixel: u32, below: u32) -> u32 {
    let [alpha, r, g, b] = pixel.to_be_bytes().map(u32::from);
    let [_, below_r, below_g, below_b] = below.to_be_bytes().map(u32::from);
    let mix = |top: u32, bottom: u32| (top * alpha + bottom * (255 - alpha) + 127) / 255;
    0xff00_0000 | mix(r, below_r) << 16 | mix(g, below_g) << 8 | mix(b, below_b)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn present_magnifies_exactly() {
        let mut frame = Framebuffer::new(3, 2);
        let colors = [1, 2, 3, 4, 5, 6].map(|n| 0xff00_0000 | n);
        frame.pixels_mut().copy_from_slice(&colors);
        for zoom in PixelZoom::ALL {
            let k = zoom.factor();
            // One window pixel less than the frame would cover: the last ones are cut off.
            let mut window = Framebuffer::new(3 * k - 1, 2 * k);
            show(&frame, zoom, &mut window);
            for y in 0..window.height() {
                for x in 0..window.width() {
                    let expected = frame.rgba(x / k, y / k);
                    assert_eq!(window.rgba(x, y), expected, "{x},{y} at zoom {k}");
                }
            }
        }
    }

    #[test]
    fn present_any_sizes() {
        for [fw, fh, ww, wh] in [[0, 0, 4, 4], [4, 4, 0, 0], [0, 3, 2, 2], [2, 2, 5, 5], [9, 9, 2, 2]] {
            let mut window = Framebuffer::new(ww, wh);
            show(&Framebuffer::new(fw, fh), PixelZoom::ONE, &mut window);
            assert!(window.pixels().iter().all(|p| p >> 24 == 0xff), "opaque everywhere");
        }
    }

    #[test]
    fn paste_cuts_off() {
        for (at, expected) in [
            ([-1, 3], vec![12, 13]),
            ([2, 2], vec![10, 11, 14, 15]),
            ([-3, 0], vec![]),
            ([9, 0], vec![]),
            ([0, -9], vec![]),
            ([0, 9], vec![]),
            ([-2, -2], vec![0]),
        ] {
            let mut target = Framebuffer::new(4, 4);
            let mut source = Framebuffer::new(3, 3);
            source.pixels_mut().fill(7);
            paste(&source, at, &mut target);
            let set: Vec<usize> = (0..16).filter(|i| target.pixels()[*i] == 7).collect();
            assert_eq!(set, expected, "the part inside for {at:?}");
        }
        paste(&Framebuffer::new(0, 3), [0, 0], &mut Framebuffer::new(3, 3));
        paste(&Framebuffer::new(3, 3), [0, 0], &mut Framebuffer::new(0, 3));
    }
}
