//! A frame on the window's pixels: magnified by the pixel zoom, transparency over a checker.

use super::PixelZoom;
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

fn show_row(source: &[u32], factor: usize, y: usize, row: &mut [u32]) {
    let reached = (source.len() * factor).min(row.len());
    let (shown, beyond) = row.split_at_mut(reached);
    beyond.fill(BEYOND);
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
}
