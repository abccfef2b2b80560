//! The fast way for upright rectangles of one colour, above all glyphs: most of an interface's triangles are theirs.

use super::canvas::{Canvas, CanvasRect};
use super::pixel;
use super::texture::Bitmap;
use super::triangle::{Corner, first_pixel, pixel_from};

/// An upright rectangle of one colour, with the part of the texture that it shows.
#[derive(Clone, Copy, Debug)]
pub(super) struct Quad {
    left_top: Corner,
    right_bottom: Corner,
}

impl Quad {
    /// Recognises what egui makes of a rectangle: corners `a b c d`, row by row, in triangles `a b c` and `c b d`.
    pub(super) fn recognise([a, b, c, d]: [Corner; 4]) -> Option<Self> {
        let same_bits = |p: f32, q: f32| p.to_bits() == q.to_bits();
        let upright = a.y == b.y && c.y == d.y && a.x == c.x && b.x == d.x && a.x <= d.x && a.y <= d.y;
        let one_color = [b, c, d].iter().all(|corner| corner.color == a.color);
        let straight_uv = same_bits(a.uv[1], b.uv[1])
            && same_bits(c.uv[1], d.uv[1])
            && same_bits(a.uv[0], c.uv[0])
            && same_bits(b.uv[0], d.uv[0]);
        (upright && one_color && straight_uv).then_some(Self {
            left_top: a,
            right_bottom: d,
        })
    }

    /// Paints it, by the same coverage rule as triangles.
    pub(super) fn paint(&self, canvas: &mut Canvas, clip: CanvasRect, texture: &Bitmap) {
        let (a, d) = (&self.left_top, &self.right_bottom);
        let (left, right) = (
            first_pixel(a.x, clip.left, clip.right),
            first_pixel(d.x, clip.left, clip.right),
        );
        let (top, bottom) = (
            first_pixel(a.y, clip.top, clip.bottom),
            first_pixel(d.y, clip.top, clip.bottom),
        );
        if left >= right || top >= bottom {
            return;
        }
        let u = Axis::new([a.x, d.x], [a.uv[0], d.uv[0]]);
        let v = Axis::new([a.y, d.y], [a.uv[1], d.uv[1]]);
        if u.is_constant() && v.is_constant() {
            let color = pixel::modulate(a.color, texture.sample(u.start, v.start));
            for y in top..bottom {
                pixel::fill(canvas.span_mut(y, left, right), color);
            }
            return;
        }
        let texel_per_pixel = u.is_texel_per_pixel() && v.is_texel_per_pixel();
        let mut v_at = v.at(top);
        for y in top..bottom {
            let row = canvas.span_mut(y, left, right);
            let texels = texel_per_pixel
                .then(|| texture.row(u.texel(left), v_at >> 16, row.len()))
                .flatten();
            if let Some(texels) = texels {
                copy(row, texels, a.color);
            } else {
                let mut u_at = u.at(left);
                for pixel in row {
                    let source = pixel::modulate(a.color, texture.sample(u_at, v_at));
                    *pixel = pixel::over(source, *pixel);
                    u_at += u.step;
                }
            }
            v_at += v.step;
        }
    }
}

/// Texels under a colour, one for each pixel of `row`.
fn copy(row: &mut [u32], texels: &[u32], color: u32) {
    if color == u32::MAX {
        pixel::fill_from(row, texels);
        return;
    }
    for (pixel, texel) in row.iter_mut().zip(texels) {
        *pixel = pixel::over(pixel::modulate(color, *texel), *pixel);
    }
}

/// A texture coordinate along one axis of the rectangle, in 1/65536 texels. It runs from the rectangle's own first
/// pixel: what a clip cuts off does not change the rest by a bit.
#[derive(Clone, Copy, Debug)]
struct Axis {
    first: i64,
    /// At the centre of the first pixel.
    start: i64,
    /// Per pixel.
    step: i64,
}

impl Axis {
    /// How far a coordinate may be off a texel's centre, and a step off one texel, for a texel to stand for itself:
    /// 1/256 texel changes no channel by more than one.
    const TOLERANCE: i64 = 256;

    fn new([from, to]: [i64; 2], [uv_from, uv_to]: [f32; 2]) -> Self {
        let first = pixel_from(from);
        let per_step = f64::from(uv_to - uv_from) / (to - from).max(1) as f64;
        let inside = (first * 256 + 128 - from) as f64;
        Self {
            first,
            start: fixed(f64::from(uv_from) + per_step * inside),
            step: fixed(per_step * 256.0),
        }
    }

    fn is_constant(self) -> bool {
        self.step == 0
    }

    fn is_texel_per_pixel(self) -> bool {
        // Steps add up over the rectangle's pixels: a step must be nearer to one than its start to a centre.
        (self.step - 65536).abs() <= Self::TOLERANCE / 64 && ((self.start & 0xffff) - 32768).abs() <= Self::TOLERANCE
    }

    /// At the centre of `pixel`.
    fn at(self, pixel: u32) -> i64 {
        self.start + self.step * (i64::from(pixel) - self.first)
    }

    /// The texel of `pixel`, where each pixel has one of its own.
    fn texel(self, pixel: u32) -> i64 {
        (self.start >> 16) + i64::from(pixel) - self.first
    }
}

#[expect(clippy::cast_possible_truncation, reason = "clamped to +-2^40 first; NaN becomes 0")]
fn fixed(texels: f64) -> i64 {
    const LIMIT: f64 = 1_099_511_627_776.0;
    (texels * 65536.0).round().clamp(-LIMIT, LIMIT) as i64
}
