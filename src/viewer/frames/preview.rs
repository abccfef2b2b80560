//! Pixels that stand in for a frame: another frame moved by whole pixels, or a smaller one magnified.

use glam::{DAffine2, DVec2};

use crate::geometry::ViewTransform;
use crate::raster::{Framebuffer, Region};
use crate::viewer::frames::frame::{Frame, Picture};

/// How far from whole pixels a motion may be to count as whole: rounding of the view's numbers, far below what an eye
/// or a sample pattern can tell.
const TOLERANCE: f64 = 1.0 / 256.0;

/// By how many whole pixels `frame` must move to show `picture`, if that is all that differs and some of it stays on
/// the screen.
pub(in crate::viewer) fn whole_pixels(frame: &Frame, picture: &Picture) -> Option<[i64; 2]> {
    let before = &frame.picture;
    let alike = std::sync::Arc::ptr_eq(&before.scene, &picture.scene)
        && before.settings == picture.settings
        && before.size == picture.size;
    let (from, to) = (before.view.scene_to_pixels, picture.view.scene_to_pixels);
    if !alike || from.matrix2 != to.matrix2 {
        return None;
    }
    let by = to.translation - from.translation;
    let whole = by.round();
    let inside = whole.x.abs() < f64::from(picture.size[0]) && whole.y.abs() < f64::from(picture.size[1]);
    if !inside || !by.abs_diff_eq(whole, TOLERANCE) {
        return None;
    }
    #[expect(clippy::cast_possible_truncation, reason = "smaller than a frame")]
    let whole = [whole.x as i64, whole.y as i64];
    Some(whole)
}

/// Writes `from`, moved by `by` pixels, into `to` of the same size, and returns the strips that it does not reach.
pub(in crate::viewer) fn shift(from: &Framebuffer, [dx, dy]: [i64; 2], to: &mut Framebuffer) -> Vec<Region> {
    let size = [from.width(), from.height()];
    let along = |by: i64, side: u32| {
        let by_pixels = u32::try_from(by.unsigned_abs()).unwrap_or(side).min(side);
        // The first pixel in the target, the first in the source, and how many there are.
        let length = side - by_pixels;
        if by >= 0 {
            (by_pixels, 0, length)
        } else {
            (0, by_pixels, length)
        }
    };
    let ((x, source_x, columns), (y, source_y, rows)) = (along(dx, size[0]), along(dy, size[1]));
    let width = size[0].max(1) as usize;
    let sources = from.pixels().chunks_exact(width).skip(source_y as usize);
    let targets = to.pixels_mut().chunks_exact_mut(width).skip(y as usize);
    for (target, source) in targets.zip(sources).take(rows as usize) {
        let length = columns as usize;
        target[x as usize..][..length].copy_from_slice(&source[source_x as usize..][..length]);
    }
    let beside = Region {
        x: if x > 0 { 0 } else { columns },
        y,
        width: size[0] - columns,
        height: rows,
    };
    let above_or_below = Region {
        x: 0,
        y: if y > 0 { 0 } else { rows },
        width: size[0],
        height: size[1] - rows,
    };
    [above_or_below, beside]
        .into_iter()
        .filter(|region| !region.is_empty())
        .collect()
}

/// The view of a frame whose pixels are `side` times as large.
pub(in crate::viewer) fn coarse_view(view: &ViewTransform, side: u32) -> ViewTransform {
    ViewTransform {
        scene_to_pixels: DAffine2::from_scale(DVec2::splat(1.0 / f64::from(side))) * view.scene_to_pixels,
    }
}

/// The view of a part of the frame, from this pixel on.
pub(in crate::viewer) fn view_of_part(view: &ViewTransform, corner: [u32; 2]) -> ViewTransform {
    let corner = DVec2::from(corner.map(f64::from));
    ViewTransform {
        scene_to_pixels: DAffine2::from_translation(-corner) * view.scene_to_pixels,
    }
}

/// Writes every pixel of `small` as a square of `side` pixels; those beyond the frame are cut off.
pub(in crate::viewer) fn magnify(small: &Framebuffer, side: u32, frame: &mut Framebuffer) {
    let (width, side) = (frame.width().max(1) as usize, side as usize);
    let sources = small.pixels().chunks_exact(small.width().max(1) as usize);
    for (rows, source) in frame.pixels_mut().chunks_mut(width * side).zip(sources) {
        let (first, others) = rows.split_at_mut(width);
        for (block, pixel) in first.chunks_mut(side).zip(source) {
            block.fill(*pixel);
        }
        for row in others.chunks_exact_mut(width) {
            row.copy_from_slice(first);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn numbered(width: u32, height: u32) -> Framebuffer {
        let mut frame = Framebuffer::new(width, height);
        for (number, pixel) in (1..).zip(frame.pixels_mut()) {
            *pixel = number;
        }
        frame
    }

    #[test]
    fn shift_moves_or_leaves_every_pixel() {
        let (width, height) = (7_i64, 5_i64);
        let from = numbered(7, 5);
        for dx in -8..=8 {
            for dy in -6..=6 {
                let mut to = Framebuffer::new(7, 5);
                let strips = shift(&from, [dx, dy], &mut to);
                for y in 0..height {
                    for x in 0..width {
                        let index = |x: i64, y: i64| usize::try_from(y * width + x).expect("inside");
                        let source = [x - dx, y - dy];
                        let has_source = (0..width).contains(&source[0]) && (0..height).contains(&source[1]);
                        let expected = if has_source {
                            from.pixels()[index(source[0], source[1])]
                        } else {
                            0
                        };
                        assert_eq!(to.pixels()[index(x, y)], expected, "{x}, {y} by {dx}, {dy}");
                        let within = |strip: &&Region| {
                            (i64::from(strip.x)..i64::from(strip.right())).contains(&x)
                                && (i64::from(strip.y)..i64::from(strip.bottom())).contains(&y)
                        };
                        let times = strips.iter().filter(within).count();
                        assert_eq!(times, usize::from(!has_source), "{x}, {y} by {dx}, {dy}: {strips:?}");
                    }
                }
            }
        }
    }

    #[test]
    fn magnify_makes_squares() {
        for (width, height, side) in [(7_u32, 5_u32, 2_u32), (8, 4, 4), (1, 1, 4), (9, 9, 4)] {
            let small = numbered(width.div_ceil(side), height.div_ceil(side));
            let mut frame = Framebuffer::new(width, height);
            magnify(&small, side, &mut frame);
            for y in 0..height {
                for x in 0..width {
                    assert_eq!(frame.rgba(x, y), small.rgba(x / side, y / side), "{x}, {y} at {side}");
                }
            }
        }
        magnify(&Framebuffer::new(0, 0), 2, &mut Framebuffer::new(0, 0));
    }
}
