//! A picture that textures are painted on: smooth-edged strokes, discs and polygons on 8-bit sRGB.

use glam::{DVec2, dvec2};

use super::palette::Color;

/// Rows of RGB texels.
#[derive(Debug)]
pub(crate) struct Canvas {
    pub(crate) width: u32,
    pub(crate) height: u32,
    texels: Vec<[u8; 3]>,
}

impl Canvas {
    /// A picture whose texel at `(x, y)`, counted from the top left, is `paint(x, y)`.
    pub(crate) fn from_fn(width: u32, height: u32, paint: impl Fn(f64, f64) -> Color) -> Self {
        let texels = (0..height)
            .flat_map(|y| (0..width).map(move |x| (x, y)))
            .map(|(x, y)| paint(f64::from(x), f64::from(y)).bytes())
            .collect();
        Self { width, height, texels }
    }

    /// A picture of one colour.
    pub(crate) fn plain(width: u32, height: u32, color: Color) -> Self {
        let texels = vec![color.bytes(); width as usize * height as usize];
        Self { width, height, texels }
    }

    /// All bytes, row by row.
    pub(crate) fn bytes(&self) -> Vec<u8> {
        self.texels.as_flattened().to_vec()
    }

    /// A line of this width through `points`, with round ends.
    pub(crate) fn stroke(&mut self, points: &[DVec2], width: f64, color: Color) {
        for pair in points.windows(2) {
            let (from, to) = (pair[0], pair[1]);
            let along = to - from;
            let length_squared = along.length_squared().max(1e-12);
            let reach = width * 0.5 + 1.0;
            self.cover([from.min(to) - reach, from.max(to) + reach], color, |p| {
                let t = ((p - from).dot(along) / length_squared).clamp(0.0, 1.0);
                width * 0.5 + 0.5 - (p - from - along * t).length()
            });
        }
    }

    /// A filled disc.
    pub(crate) fn disc(&mut self, center: DVec2, radius: f64, color: Color) {
        let reach = DVec2::splat(radius + 1.0);
        self.cover([center - reach, center + reach], color, |p| {
            radius + 0.5 - (p - center).length()
        });
    }

    /// A circle of this line width.
    pub(crate) fn circle(&mut self, center: DVec2, radius: f64, width: f64, color: Color) {
        let reach = DVec2::splat(radius + width);
        self.cover([center - reach, center + reach], color, |p| {
            width * 0.5 + 0.5 - ((p - center).length() - radius).abs()
        });
    }

    /// A filled convex polygon, corners in either order.
    pub(crate) fn convex(&mut self, points: &[DVec2], color: Color) {
        let lowest = points.iter().fold(DVec2::INFINITY, |a, &b| a.min(b));
        let highest = points.iter().fold(DVec2::NEG_INFINITY, |a, &b| a.max(b));
        let count = points.len();
        let area: f64 = (0..count).map(|k| points[k].perp_dot(points[(k + 1) % count])).sum();
        let turn = if area < 0.0 { -1.0 } else { 1.0 };
        self.cover([lowest - 1.0, highest + 1.0], color, |p| {
            let inside = |k: usize| {
                let (from, to) = (points[k], points[(k + 1) % count]);
                turn * (to - from).normalize_or_zero().perp_dot(p - from)
            };
            0.5 + (0..count).map(inside).fold(f64::INFINITY, f64::min)
        });
    }

    /// Lays `color` over a box as densely as `coverage`, clamped to `0.0..=1.0`, says for each texel's centre.
    fn cover(&mut self, [from, to]: [DVec2; 2], color: Color, coverage: impl Fn(DVec2) -> f64) {
        let last = dvec2(f64::from(self.width), f64::from(self.height));
        let from = from.floor().clamp(DVec2::ZERO, last);
        let to = to.ceil().clamp(DVec2::ZERO, last);
        let ink = color.bytes();
        for y in from.y as u32..to.y as u32 {
            for x in from.x as u32..to.x as u32 {
                let amount = coverage(dvec2(f64::from(x) + 0.5, f64::from(y) + 0.5));
                if amount <= 0.0 {
                    continue;
                }
                let texel = &mut self.texels[(y * self.width + x) as usize];
                for (channel, &target) in texel.iter_mut().zip(&ink) {
                    let old = f64::from(*channel);
                    *channel = (old + (f64::from(target) - old) * amount.min(1.0)).round() as u8;
                }
            }
        }
    }
}
