//! Straight lines and frames on pictures, with a light halo so that they stand out from any colour.

use glam::DVec2;

use super::PixelRect;
use super::paint::blend;
use crate::raster::Framebuffer;

/// How a line looks.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Stroke {
    /// Straight `0xAARRGGBB` of its core.
    pub(super) color: u32,
    /// The same of its halo, which is as wide as the core on either side.
    pub(super) halo: u32,
    /// Width of the core in pixels.
    pub(super) width: f32,
}

/// A line between two points in pixels, clipped to the picture.
pub(super) fn draw_line(picture: &mut Framebuffer, from: DVec2, to: DVec2, stroke: Stroke) {
    for (color, width) in [(stroke.halo, stroke.width * 3.0), (stroke.color, stroke.width)] {
        let reach = f64::from(width) / 2.0;
        along(picture, from, to, reach, |distance| {
            // The part of a pixel across the line, as for a straight edge through it.
            #[expect(clippy::cast_possible_truncation, reason = "a part from 0 to 1")]
            let part = (reach + 0.5 - distance).clamp(0.0, 1.0) as f32;
            (color, part)
        });
    }
}

/// Blends the pixels near a line: `paint` tells colour and part by the distance of the pixel's centre.
fn along(picture: &mut Framebuffer, from: DVec2, to: DVec2, reach: f64, paint: impl Fn(f64) -> (u32, f32)) {
    let by = to - from;
    let steep = by.y.abs() > by.x.abs();
    let flip = |point: DVec2| if steep { DVec2::new(point.y, point.x) } else { point };
    let (start, end) = (flip(from), flip(to));
    let (start, end) = if start.x <= end.x { (start, end) } else { (end, start) };
    let length = end - start;
    if length.x <= 0.0 {
        return;
    }
    let (slope, cosine) = (length.y / length.x, length.x / length.length());
    let [columns, rows] = [picture.width(), picture.height()].map(i64::from);
    let (major, minor) = if steep { (rows, columns) } else { (columns, rows) };
    let spread = (reach + 1.0) / cosine;
    for step in whole(start.x.floor()).max(0)..whole(end.x.ceil()).min(major) {
        let middle = start.y + (step as f64 + 0.5 - start.x) * slope;
        for across in whole(middle - spread).max(0)..whole(middle + spread + 1.0).min(minor) {
            let distance = (across as f64 + 0.5 - middle).abs() * cosine;
            let (color, part) = paint(distance);
            let [x, y] = if steep { [across, step] } else { [step, across] };
            let at = usize::try_from(y * columns + x).ok();
            if part > 0.0
                && let Some(pixel) = at.and_then(|at| picture.pixels_mut().get_mut(at))
            {
                *pixel = blend(*pixel, color, part);
            }
        }
    }
}

#[expect(
    clippy::cast_possible_truncation,
    reason = "`as` saturates; both ends are clamped to the picture"
)]
fn whole(length: f64) -> i64 {
    length as i64
}

/// A frame around a region, outside of it, clipped to the picture.
pub(super) fn draw_frame(picture: &mut Framebuffer, region: &PixelRect, stroke: Stroke) {
    #[expect(clippy::cast_possible_truncation, reason = "a few pixels")]
    let width = stroke.width.round() as i64;
    for (color, near, far) in [(stroke.halo, width, 2 * width), (stroke.color, 0, width)] {
        for y in region.y - far..region.bottom() + far {
            for x in region.x - far..region.right() + far {
                let beyond = [
                    region.x - x,
                    x + 1 - region.right(),
                    region.y - y,
                    y + 1 - region.bottom(),
                ];
                let distance = beyond.into_iter().max().unwrap_or(0);
                let inside = PixelRect::of_size([picture.width(), picture.height()]).contains([x, y]);
                let at = usize::try_from(y * i64::from(picture.width()) + x)
                    .ok()
                    .filter(|_| inside);
                if distance > near
                    && distance <= far
                    && let Some(pixel) = at.and_then(|at| picture.pixels_mut().get_mut(at))
                {
                    *pixel = blend(*pixel, color, 1.0);
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const STROKE: Stroke = Stroke {
        color: 0xff00_0000,
        halo: 0xffff_ffff,
        width: 1.0,
    };

    fn gray(width: u32, height: u32) -> Framebuffer {
        let mut picture = Framebuffer::new(width, height);
        picture.pixels_mut().fill(0xff80_8080);
        picture
    }

    /// The picture in signs: `#` core, `.` halo, ` ` untouched, `?` between.
    fn signs(picture: &Framebuffer) -> Vec<String> {
        let sign = |pixel: &u32| match pixel {
            0xff00_0000 => '#',
            0xffff_ffff => '.',
            0xff80_8080 => ' ',
            _ => '?',
        };
        let rows = picture.pixels().chunks(picture.width() as usize);
        rows.map(|row| row.iter().map(sign).collect()).collect()
    }

    #[test]
    fn frames_lie_around_their_region() {
        let mut picture = gray(8, 6);
        let region = PixelRect {
            x: 3,
            y: 2,
            width: 2,
            height: 1,
        };
        draw_frame(&mut picture, &region, STROKE);
        let expected = [" ...... ", " .####. ", " .#  #. ", " .####. ", " ...... ", "        "];
        assert_eq!(signs(&picture), expected, "core next to it, halo around");
    }

    #[test]
    fn lines_have_a_core_and_a_halo() {
        let mut picture = gray(5, 5);
        draw_line(&mut picture, DVec2::new(1.0, 2.5), DVec2::new(4.0, 2.5), STROKE);
        assert_eq!(signs(&picture), ["     ", " ... ", " ### ", " ... ", "     "], "level");
        let mut picture = gray(5, 5);
        draw_line(&mut picture, DVec2::new(2.5, 4.0), DVec2::new(2.5, -9.0), STROKE);
        assert_eq!(
            signs(&picture),
            [" .#. ", " .#. ", " .#. ", " .#. ", "     "],
            "upright and clipped"
        );
    }
}
