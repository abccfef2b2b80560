//! A frame on the window's pixels: magnified by the pixel zoom, transparency over a checker.

use crate::figure::PixelRect;
use crate::raster::Framebuffer;
use crate::viewer::frames::composite::{BEYOND, Composite};
use crate::viewer::settings::PixelZoom;

/// Side of the checker's squares, in window pixels.
const SQUARE: usize = 8;

/// The checker below transparent pixels.
const CHECKER: [u32; 2] = [0x00ff_ffff, 0x00dd_dddd];

/// A window's pixels, rows from the top.
#[derive(Debug)]
pub struct WindowPixels<'a> {
    /// Pixels in a row, rows.
    pub size: [u32; 2],
    /// `0xRRGGBB`, row by row; the top byte is of no interest.
    pub pixels: &'a mut [u32],
}

impl<'a> WindowPixels<'a> {
    /// All pixels of a picture.
    pub fn of(picture: &'a mut Framebuffer) -> Self {
        Self {
            size: [picture.width(), picture.height()],
            pixels: picture.pixels_mut(),
        }
    }

    /// The pixels of `part`, row by row, each with its row in the window. `part` is cut to the window first.
    fn rows(&mut self, part: &PixelRect) -> impl Iterator<Item = (usize, &mut [u32])> {
        let part = part.intersection(&PixelRect::of_size(self.size));
        let at = |position: i64| usize::try_from(position).unwrap_or(0);
        let (left, top, length) = (at(part.x), at(part.y), part.width as usize);
        let width = (self.size[0] as usize).max(1);
        let rows = self.pixels.chunks_exact_mut(width).enumerate();
        let rows = rows.skip(top).take(part.height as usize);
        rows.map(move |(y, row)| (y, &mut row[left.min(width - length)..][..length]))
    }
}

/// Writes `frame` into a `part` of the window, each frame pixel as an exact square of `zoom` window pixels. The result
/// is opaque. Where the window is larger than the frame it is grey: a picture is never stretched.
pub(in crate::viewer) fn show(
    picture: &Composite<'_>,
    zoom: PixelZoom,
    window: &mut WindowPixels<'_>,
    part: &PixelRect,
) {
    match picture.plain() {
        Some(frame) => show_frame(frame, zoom, window, part),
        None => show_rows(picture, zoom, window, part),
    }
}

/// What is put together row by row.
fn show_rows(picture: &Composite<'_>, zoom: PixelZoom, window: &mut WindowPixels<'_>, part: &PixelRect) {
    let factor = zoom.factor() as usize;
    let mut line = vec![BEYOND; (window.size[0] as usize).div_ceil(factor)];
    let left = usize::try_from(part.x.max(0)).unwrap_or(0);
    let mut last = None;
    for (y, row) in window.rows(part) {
        if row.is_empty() {
            continue;
        }
        let columns = left / factor..(left + row.len()).div_ceil(factor);
        // The rows of a magnified pixel are alike.
        if last.replace(y / factor) != Some(y / factor) {
            picture.row(y / factor, columns.clone(), &mut line[columns]);
        }
        show_row(&line, factor, [left, y], row);
    }
}

/// One frame that fills the window.
pub(in crate::viewer) fn show_frame(
    frame: &Framebuffer,
    zoom: PixelZoom,
    window: &mut WindowPixels<'_>,
    part: &PixelRect,
) {
    let factor = zoom.factor() as usize;
    let frame_width = frame.width() as usize;
    let left = usize::try_from(part.x.max(0)).unwrap_or(0);
    for (y, row) in window.rows(part) {
        let start = (y / factor) * frame_width;
        let source = frame.pixels().get(start..start + frame_width).unwrap_or_default();
        show_row(source, factor, [left, y], row);
    }
}

/// A part of one row of the window, from the window pixel `[x, y]` on.
fn show_row(source: &[u32], factor: usize, [x, y]: [usize; 2], row: &mut [u32]) {
    let reached = (source.len() * factor).saturating_sub(x).min(row.len());
    let (shown, beyond) = row.split_at_mut(reached);
    beyond.fill(BEYOND);
    if shown.is_empty() {
        return;
    }
    let source = &source[x / factor..=(x + reached - 1) / factor];
    let is_opaque = source.iter().fold(u32::MAX, |all, pixel| all & pixel) >> 24 == 0xff;
    if is_opaque && factor == 1 {
        shown.copy_from_slice(source);
        return;
    }
    // The first block may be cut off on the left.
    let (first, rest) = shown.split_at_mut((factor - x % factor).min(reached));
    let blocks = std::iter::once(first).chain(rest.chunks_mut(factor));
    let mut column = x;
    for (block, pixel) in blocks.zip(source) {
        if pixel >> 24 == 0xff {
            block.fill(*pixel);
            column += block.len();
            continue;
        }
        for target in block {
            let square = (column / SQUARE + y / SQUARE) % 2;
            *target = over(*pixel, CHECKER[square]);
            column += 1;
        }
    }
}

/// Copies `source` to `at` in the window, as far as it lies in `part`.
pub(in crate::viewer) fn paste(source: &Framebuffer, at: [i64; 2], window: &mut WindowPixels<'_>, part: &PixelRect) {
    let place = PixelRect {
        x: at[0],
        y: at[1],
        width: source.width(),
        height: source.height(),
    };
    let shown = place.intersection(part).intersection(&PixelRect::of_size(window.size));
    if shown.width == 0 || shown.height == 0 {
        return;
    }
    let offset = |from: i64, to: i64| usize::try_from(to - from).unwrap_or(0);
    let (left, top) = (offset(at[0], shown.x), offset(at[1], shown.y));
    let rows = source.pixels().chunks_exact((source.width() as usize).max(1)).skip(top);
    for (row, (_, target)) in rows.zip(window.rows(&shown)) {
        target.copy_from_slice(&row[left..left + target.len()]);
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

    /// The whole of a window of this size.
    fn shown(frame: &Framebuffer, zoom: PixelZoom, [width, height]: [u32; 2]) -> Framebuffer {
        let mut window = Framebuffer::new(width, height);
        show_frame(
            frame,
            zoom,
            &mut WindowPixels::of(&mut window),
            &PixelRect::of_size([width, height]),
        );
        window
    }

    #[test]
    fn present_magnifies_exactly() {
        let mut frame = Framebuffer::new(3, 2);
        let colors = [1, 2, 3, 4, 5, 6].map(|n| 0xff00_0000 | n);
        frame.pixels_mut().copy_from_slice(&colors);
        for zoom in PixelZoom::ALL {
            let k = zoom.factor();
            // One window pixel less than the frame would cover: the last ones are cut off.
            let window = shown(&frame, zoom, [3 * k - 1, 2 * k]);
            for y in 0..window.height() {
                for x in 0..window.width() {
                    let expected = frame.rgba(x / k, y / k);
                    assert_eq!(window.rgba(x, y), expected, "{x},{y} at zoom {k}");
                }
            }
        }
    }

    #[test]
    fn present_shows_the_checker_below() {
        let mut frame = Framebuffer::new(16, 16);
        frame.pixels_mut()[0] = 0xff12_3456;
        let window = shown(&frame, PixelZoom::new(2).expect("a zoom"), [32, 32]);
        assert_eq!(window.rgba(1, 1), Some([0x12, 0x34, 0x56, 0xff]), "opaque");
        for (x, y) in [(2, 2), (7, 7), (9, 7), (7, 9), (9, 9), (31, 0)] {
            let gray = if (x / 8 + y / 8) % 2 == 0 { 0xff } else { 0xdd };
            assert_eq!(window.rgba(x, y), Some([gray, gray, gray, 0xff]), "{x}, {y}");
        }
    }

    #[test]
    fn present_any_sizes() {
        for [fw, fh, ww, wh] in [[0, 0, 4, 4], [4, 4, 0, 0], [0, 3, 2, 2], [2, 2, 5, 5], [9, 9, 2, 2]] {
            let window = shown(&Framebuffer::new(fw, fh), PixelZoom::ONE, [ww, wh]);
            assert!(window.pixels().iter().all(|p| p >> 24 == 0xff), "opaque everywhere");
        }
    }

    #[test]
    fn present_parts_make_the_whole() {
        arbtest::arbtest(|u| {
            let mut frame = Framebuffer::new(u.int_in_range(0..=20)?, u.int_in_range(0..=20)?);
            for pixel in frame.pixels_mut() {
                *pixel = u.arbitrary::<u32>()? | if u.ratio(1, 2)? { 0xff00_0000 } else { 0 };
            }
            let zoom = *u.choose(&PixelZoom::ALL)?;
            let size = [u.int_in_range(1..=60)?, u.int_in_range(1..=60)?];
            let part = PixelRect {
                x: u.int_in_range(-10..=70)?,
                y: u.int_in_range(-10..=70)?,
                width: u.int_in_range(0..=60)?,
                height: u.int_in_range(0..=60)?,
            };
            let whole = shown(&frame, zoom, size);
            let mut window = Framebuffer::new(size[0], size[1]);
            show_frame(&frame, zoom, &mut WindowPixels::of(&mut window), &part);
            for (y, row) in (0..).zip(window.pixels().chunks(size[0] as usize)) {
                for (x, pixel) in (0..).zip(row) {
                    let expected = if part.contains([i64::from(x), i64::from(y)]) {
                        whole.rgba(x, y)
                    } else {
                        Some([0; 4])
                    };
                    assert_eq!(window.rgba(x, y), expected, "{x}, {y} of {part:?}, {pixel:08x}");
                }
            }
            Ok(())
        })
        .budget_ms(300);
    }

    #[test]
    fn paste_cuts_off() {
        let whole = PixelRect::of_size([4, 4]);
        let corner = PixelRect::of_size([3, 3]);
        for (at, part, expected) in [
            ([-1, 3], whole, vec![12, 13]),
            ([2, 2], whole, vec![10, 11, 14, 15]),
            ([2, 2], corner, vec![10]),
            ([-3, 0], whole, vec![]),
            ([9, 0], whole, vec![]),
            ([0, -9], whole, vec![]),
            ([0, 9], whole, vec![]),
            ([-2, -2], whole, vec![0]),
        ] {
            let mut target = Framebuffer::new(4, 4);
            let mut source = Framebuffer::new(3, 3);
            source.pixels_mut().fill(7);
            paste(&source, at, &mut WindowPixels::of(&mut target), &part);
            let set: Vec<usize> = (0..16).filter(|i| target.pixels()[*i] == 7).collect();
            assert_eq!(set, expected, "the part inside for {at:?} and {part:?}");
        }
        let all = PixelRect::of_size([3, 3]);
        let mut target = Framebuffer::new(3, 3);
        paste(
            &Framebuffer::new(0, 3),
            [0, 0],
            &mut WindowPixels::of(&mut target),
            &all,
        );
        let mut empty = Framebuffer::new(0, 3);
        paste(&Framebuffer::new(3, 3), [0, 0], &mut WindowPixels::of(&mut empty), &all);
    }
}
