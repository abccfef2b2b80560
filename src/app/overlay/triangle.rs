//! One triangle of egui's meshes onto the canvas: exact coverage by rows, colours and texels along each row.
//!
//! As on a GPU, corners are snapped to 1/256 pixel, a pixel belongs to the triangle that holds its centre, and a
//! centre on an edge belongs to the triangle on its right or below (the top-left rule). Instead of testing pixels,
//! each row's first and last pixel are followed down the edges with integers only, so a row is one loop over its
//! pixels. egui draws the soft edges of its shapes as strips of triangles one pixel wide: rows are short, and what
//! counts is how little is done per row.

use egui::epaint::Vertex;

use super::canvas::{Canvas, CanvasRect};
use super::pixel;
use super::texture::Bitmap;

/// Sub-pixel steps per pixel.
const STEPS: i64 = 256;
/// Farthest corner, in sub-pixel steps: a million pixels out. Products of two stay far inside `i64`.
const FARTHEST: f32 = (1_u32 << 28) as f32;

/// A mesh's corner in pixels.
#[derive(Clone, Copy, Debug)]
pub(super) struct Corner {
    /// Position in 1/256 pixels.
    pub(super) x: i64,
    /// Position in 1/256 pixels.
    pub(super) y: i64,
    /// Position in the texture in texels.
    pub(super) uv: [f32; 2],
    /// Premultiplied colour.
    pub(super) color: u32,
}

impl Corner {
    /// Snaps a vertex, whose position is in points.
    pub(super) fn new(vertex: &Vertex, pixels_per_point: f32, texture: &Bitmap) -> Self {
        Self {
            x: snap(vertex.pos.x * pixels_per_point),
            y: snap(vertex.pos.y * pixels_per_point),
            uv: [
                vertex.uv.x * texture.width() as f32,
                vertex.uv.y * texture.height() as f32,
            ],
            color: pixel::from_color(vertex.color),
        }
    }
}

/// A position in pixels as 1/256 pixels; what is no number lands in the origin.
#[expect(clippy::cast_possible_truncation, reason = "clamped to +-2^28 first; NaN becomes 0")]
fn snap(position: f32) -> i64 {
    (position * STEPS as f32).round().clamp(-FARTHEST, FARTHEST) as i64
}

/// The first pixel whose centre is not before `position`.
pub(super) fn pixel_from(position: i64) -> i64 {
    (position - STEPS / 2 + STEPS - 1).div_euclid(STEPS)
}

/// As [`pixel_from`], kept inside `low..=high`.
pub(super) fn first_pixel(position: i64, low: u32, high: u32) -> u32 {
    let first = pixel_from(position);
    u32::try_from(first.clamp(i64::from(low), i64::from(high))).unwrap_or(low)
}

/// Paints one triangle. `texture` is what the corners' `uv` refer to.
pub(super) fn paint(canvas: &mut Canvas, clip: CanvasRect, corners: [Corner; 3], texture: &Bitmap) {
    let [mut a, mut b, mut c] = corners;
    // From the top down; the middle corner decides on which side the long edge lies.
    if b.y < a.y {
        std::mem::swap(&mut a, &mut b);
    }
    if c.y < a.y {
        std::mem::swap(&mut a, &mut c);
    }
    if c.y < b.y {
        std::mem::swap(&mut b, &mut c);
    }
    let area = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
    if area == 0 {
        return;
    }
    let rows = [a.y, b.y, c.y].map(|y| first_pixel(y, clip.top, clip.bottom));
    let mut shade = Shade::new([a, b, c], area, texture);
    for (from, to, top, bottom) in [(a, b, rows[0], rows[1]), (b, c, rows[1], rows[2])] {
        if top == bottom {
            continue;
        }
        let (mut long, mut short) = (Edge::new(a, c, top), Edge::new(from, to, top));
        for y in top..bottom {
            // The long edge is the left one when the middle corner lies to its right.
            let (left, right) = if area > 0 { (long.x, short.x) } else { (short.x, long.x) };
            let first = first_pixel(left, clip.left, clip.right);
            let end = first_pixel(right, clip.left, clip.right);
            if first < end {
                shade.row(canvas.span_mut(y, first, end), [pixel_from(left), first.into()], y);
            }
            long.step();
            short.step();
        }
    }
}

/// Where an edge crosses the centres of rows, going down: `x` is rounded up to whole 1/256 pixels, exactly.
#[derive(Debug)]
struct Edge {
    x: i64,
    /// What `x` was rounded up by, times `height`.
    excess: i64,
    height: i64,
    step: i64,
    step_excess: i64,
}

impl Edge {
    /// The edge from `from` down to `to`, at the centre of row `y`. The two differ in height.
    fn new(from: Corner, to: Corner, y: u32) -> Self {
        let (width, height) = (to.x - from.x, (to.y - from.y).max(1));
        let down = i64::from(y) * STEPS + STEPS / 2 - from.y;
        let ceil = |n: i64| -(-n).div_euclid(height);
        let (x, step) = (ceil(width * down), ceil(width * STEPS));
        Self {
            x: from.x + x,
            excess: x * height - width * down,
            height,
            step,
            step_excess: step * height - width * STEPS,
        }
    }

    fn step(&mut self) {
        self.x += self.step;
        self.excess += self.step_excess;
        if self.excess >= self.height {
            self.x -= 1;
            self.excess -= self.height;
        }
    }
}

/// A value that changes evenly over the plane.
#[derive(Clone, Copy, Debug)]
struct Plane {
    at_first: f64,
    per_x: f64,
    per_y: f64,
}

impl Plane {
    /// Takes `values` at the corners; positions count from the first corner, in 1/256 pixels.
    fn new(corners: &[Corner; 3], area: i64, values: [f32; 3]) -> Self {
        let [a, b, c] = corners;
        let (to_b, to_c) = (f64::from(values[1] - values[0]), f64::from(values[2] - values[0]));
        let area = area as f64;
        Self {
            at_first: f64::from(values[0]),
            per_x: (to_b * (c.y - a.y) as f64 - to_c * (b.y - a.y) as f64) / area,
            per_y: (to_c * (b.x - a.x) as f64 - to_b * (c.x - a.x) as f64) / area,
        }
    }

    /// The value at the centre of pixel `(x, y)` and its step to the right, both times `unit` and rounded.
    fn along(&self, first: &Corner, [x, y]: [i64; 2], unit: f64) -> (i64, i64) {
        let dx = (x * STEPS + STEPS / 2 - first.x) as f64;
        let dy = (y * STEPS + STEPS / 2 - first.y) as f64;
        let at = self.at_first + self.per_x * dx + self.per_y * dy;
        (to_integer(at * unit), to_integer(self.per_x * STEPS as f64 * unit))
    }
}

/// Rounded; far values stop at +-2^40, so that a row of steps cannot overflow.
#[expect(clippy::cast_possible_truncation, reason = "clamped to +-2^40 first; NaN becomes 0")]
fn to_integer(value: f64) -> i64 {
    const LIMIT: f64 = 1_099_511_627_776.0;
    value.round().clamp(-LIMIT, LIMIT) as i64
}

/// How the pixels of a triangle get their colour.
#[derive(Debug)]
struct Shade<'a> {
    first: Corner,
    /// Premultiplied alpha, red, green, blue; `None` when one colour does for all.
    colors: Option<[Plane; 4]>,
    /// Texture coordinates in texels; `None` when one texel does for all.
    uv: Option<[Plane; 2]>,
    /// The texel for all, where `uv` is `None`.
    texel: u32,
    texture: &'a Bitmap,
    sources: Vec<u32>,
}

impl<'a> Shade<'a> {
    fn new(corners: [Corner; 3], area: i64, texture: &'a Bitmap) -> Self {
        let [a, b, c] = &corners;
        let one_color = a.color == b.color && a.color == c.color;
        let one_texel = bits(a.uv) == bits(b.uv) && bits(a.uv) == bits(c.uv);
        let channel = |shift: u32| {
            Plane::new(
                &corners,
                area,
                [a, b, c].map(|corner| ((corner.color >> shift) & 255) as f32),
            )
        };
        let coordinate = |axis: usize| Plane::new(&corners, area, [a, b, c].map(|corner| corner.uv[axis]));
        Self {
            first: *a,
            colors: (!one_color).then(|| [24, 16, 8, 0].map(channel)),
            uv: (!one_texel).then(|| [0, 1].map(coordinate)),
            texel: texture.sample(
                to_integer(f64::from(a.uv[0]) * 65536.0),
                to_integer(f64::from(a.uv[1]) * 65536.0),
            ),
            texture,
            sources: Vec::new(),
        }
    }

    /// Paints the pixels of `row`, the first of which is pixel `(x, y)`. Values run from pixel `start`, where the
    /// triangle's row begins: what a clip cuts off does not change the rest by a bit.
    fn row(&mut self, row: &mut [u32], [start, x]: [i64; 2], y: u32) {
        if self.colors.is_none() && self.uv.is_none() {
            pixel::fill(row, pixel::modulate(self.first.color, self.texel));
            return;
        }
        self.sources.clear();
        self.sources.resize(row.len(), self.first.color);
        if let Some(planes) = &self.colors {
            gradient(
                &mut self.sources,
                planes.map(|plane| plane.along(&self.first, [start, y.into()], 65536.0)),
                x - start,
            );
        }
        match &self.uv {
            Some(planes) => {
                let [(mut u, du), (mut v, dv)] =
                    planes.map(|plane| plane.along(&self.first, [start, y.into()], 65536.0));
                (u, v) = (u + du * (x - start), v + dv * (x - start));
                for source in &mut self.sources {
                    *source = pixel::modulate(*source, self.texture.sample(u, v));
                    u += du;
                    v += dv;
                }
            }
            None if self.texel != u32::MAX => {
                for source in &mut self.sources {
                    *source = pixel::modulate(*source, self.texel);
                }
            }
            None => {}
        }
        pixel::fill_from(row, &self.sources);
    }
}

/// The exact bits, for a comparison that means "the very same".
fn bits(uv: [f32; 2]) -> [u32; 2] {
    uv.map(f32::to_bits)
}

/// Fills `sources` with colours whose channels (alpha, red, green, blue, each value and step in 1/65536) run evenly,
/// after the first `skipped` of them.
fn gradient(sources: &mut [u32], channels: [(i64, i64); 4], skipped: i64) {
    const HALF: i64 = 1 << 15;
    const MOST: i64 = 255 << 16;
    // Inside the triangle every value lies in 0..=255, so steps beyond that belong to rows of a single pixel.
    let [mut a, mut r, mut g, mut b] = channels.map(|(value, _)| clamp_to_i32(value, MOST) + clamp_to_i32(HALF, HALF));
    let [da, dr, dg, db] = channels.map(|(_, step)| clamp_to_i32(step, MOST));
    let skipped = i32::try_from(skipped).unwrap_or_default();
    let past = |value: i32, step: i32| value.wrapping_add(step.wrapping_mul(skipped));
    (a, r, g, b) = (past(a, da), past(r, dr), past(g, dg), past(b, db));
    let byte = |value: i32| u32::from_ne_bytes((value >> 16).clamp(0, 255).to_ne_bytes());
    for source in sources {
        *source = (byte(a) << 24) | (byte(r) << 16) | (byte(g) << 8) | byte(b);
        a = a.wrapping_add(da);
        r = r.wrapping_add(dr);
        g = g.wrapping_add(dg);
        b = b.wrapping_add(db);
    }
}

fn clamp_to_i32(value: i64, most: i64) -> i32 {
    i32::try_from(value.clamp(-most, most)).unwrap_or_default()
}
