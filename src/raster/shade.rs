//! Fragments to colours: attributes interpolated over a triangle, textures read at them.
//!
//! # Where the numbers come from
//!
//! An attribute is an affine function of the pixel position. It is evaluated in 64 bits at anchors every
//! [`ANCHOR_PIXELS`] pixels of a row, at absolute positions, and in 32 bits from there on. So a fragment's value depends
//! on its own position only, never on the tile or the run of fragments it is shaded with.

use glam::DVec2;

use super::display_list::{Paint, ScreenTriangle};
use crate::color::Premultiplied16;
use crate::geometry::edge::doubled_area;
use crate::geometry::subpixel::{GridPoint, SubpixelGrid};
use crate::rules::Rules;
use crate::texture::{Footprint, LANES, Sampler, SamplingSettings, Texture};

/// Distance between two anchors, in pixels.
const ANCHOR_PIXELS: i32 = 8;

/// `K` attributes as affine functions of the pixel position.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Planes<const K: usize> {
    origin: DVec2,
    at_origin: [f64; K],
    /// Change per pixel to the right, and down.
    pub(crate) dx: [f64; K],
    pub(crate) dy: [f64; K],
}

/// Turns the fragments of one triangle into colours.
#[derive(Debug)]
pub(crate) struct Shader<'a> {
    pub(crate) kind: ShaderKind<'a>,
    /// Whether every fragment hides what is below it.
    pub(crate) opaque: bool,
}

/// Where a fragment's colour comes from.
#[derive(Debug)]
pub(crate) enum ShaderKind<'a> {
    /// One colour.
    Solid(Premultiplied16),
    /// Straight red, green, blue, alpha in `0.0..=1.0`.
    Vertex(Planes<4>),
    /// `(u, v)`, read through a sampler and multiplied by an opacity.
    Texture {
        uv: Planes<2>,
        sampler: Sampler<'a>,
        opacity: f32,
    },
}

/// What shading needs to know besides the triangle.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ShadeContext<'a> {
    pub(crate) grid: SubpixelGrid,
    pub(crate) sampling: SamplingSettings,
    pub(crate) textures: &'a [&'a Texture],
}

impl<const K: usize> Planes<K> {
    /// The planes through a triangle's corners. `doubled_area` must not be zero.
    fn new(grid: SubpixelGrid, corners: &[GridPoint; 3], values: [[f32; K]; 3]) -> Self {
        let units = grid.units_per_pixel();
        let side = |from: usize, to: usize| {
            let dx = i64::from(corners[to].x) - i64::from(corners[from].x);
            let dy = i64::from(corners[to].y) - i64::from(corners[from].y);
            DVec2::new(dx as f64, dy as f64) / units
        };
        let (b, c) = (side(0, 1), side(0, 2));
        let area = doubled_area(*corners) as f64 / (units * units);
        let mut planes = Self {
            origin: DVec2::new(f64::from(corners[0].x), f64::from(corners[0].y)) / units,
            at_origin: [0.0; K],
            dx: [0.0; K],
            dy: [0.0; K],
        };
        for (i, first) in values[0].into_iter().enumerate() {
            let first = f64::from(first);
            let (to_b, to_c) = (f64::from(values[1][i]) - first, f64::from(values[2][i]) - first);
            planes.at_origin[i] = first;
            planes.dx[i] = (to_b * c.y - to_c * b.y) / area;
            planes.dy[i] = (to_c * b.x - to_b * c.x) / area;
        }
        planes
    }

    /// Shades the samples of sample row `row` from column `first` on, from left to right, one for each of `colors`;
    /// `shade` turns the attributes of [`LANES`] samples into their colours.
    #[inline]
    #[expect(
        clippy::cast_possible_truncation,
        reason = "fragments are interpolated in 32 bits from an anchor on"
    )]
    fn each(
        &self,
        grid: SubpixelGrid,
        (first, row): (i32, i32),
        mut colors: &mut [Premultiplied16],
        shade: impl Fn([[f32; LANES]; K]) -> [Premultiplied16; LANES],
    ) {
        let side = grid.side();
        let anchor_columns = ANCHOR_PIXELS * side;
        let step = 1.0 / side as f32;
        let slope = self.dx.map(|slope| slope as f32);
        let down = grid.sample_position(row) - self.origin.y;
        let mut column = first;
        while !colors.is_empty() {
            let group = column.div_euclid(anchor_columns);
            let right = f64::from(group * ANCHOR_PIXELS) - self.origin.x;
            let at_anchor: [f32; K] =
                std::array::from_fn(|i| (self.at_origin[i] + right * self.dx[i] + down * self.dy[i]) as f32);
            let inside = column - group * anchor_columns;
            let count = (anchor_columns - inside).cast_unsigned() as usize;
            let (run, rest) = colors.split_at_mut(count.min(colors.len()));
            let mut start = inside as f32 + 0.5;
            for colors in run.chunks_mut(LANES) {
                // Small whole numbers and a half: exact in 32 bits, however they are added up.
                let distance: [f32; LANES] = std::array::from_fn(|i| (start + i as f32) * step);
                let attributes = std::array::from_fn(|k| distance.map(|distance| at_anchor[k] + distance * slope[k]));
                let shaded = shade(attributes);
                colors.copy_from_slice(&shaded[..colors.len()]);
                start += LANES as f32;
            }
            column += anchor_columns - inside;
            colors = rest;
        }
    }
}

impl Planes<2> {
    /// The change of `(u, v)` per pixel.
    pub(crate) fn footprint(&self) -> Footprint {
        Footprint {
            dx: DVec2::from_array(self.dx),
            dy: DVec2::from_array(self.dy),
        }
    }
}

impl<'a> Shader<'a> {
    /// One colour, everywhere.
    pub(crate) fn flat(color: Premultiplied16) -> Self {
        Self {
            kind: ShaderKind::Solid(color),
            opaque: color.is_opaque(),
        }
    }

    /// Prepares the shading of one triangle.
    pub(crate) fn new(context: &ShadeContext<'a>, triangle: &ScreenTriangle, paint: &Paint) -> Self {
        let kind = match *paint {
            Paint::Solid(color) => ShaderKind::Solid(color),
            Paint::Vertex(colors) => ShaderKind::Vertex(Planes::new(context.grid, &triangle.corners, colors)),
            Paint::Texture { texture, uv, opacity } => {
                let uv = Planes::new(context.grid, &triangle.corners, uv);
                let pyramid = &context.textures[texture as usize].pyramid;
                let sampler = Sampler::new(pyramid, &uv.footprint(), context.sampling);
                ShaderKind::Texture { uv, sampler, opacity }
            }
        };
        Self {
            kind,
            opaque: Self::is_opaque(paint, context.textures),
        }
    }

    /// Shades the samples of sample row `row` from `first` column on, one for each of `colors`.
    pub(crate) fn shade(&self, context: &ShadeContext<'_>, first: i32, row: i32, colors: &mut [Premultiplied16]) {
        let rules = context.sampling.rules;
        let at = (first, row);
        match &self.kind {
            ShaderKind::Solid(color) => colors.fill(*color),
            ShaderKind::Vertex(planes) => planes.each(context.grid, at, colors, |[r, g, b, a]| {
                std::array::from_fn(|i| vertex_color([r[i], g[i], b[i], a[i]], rules))
            }),
            ShaderKind::Texture { uv, sampler, opacity } if *opacity >= 1.0 => {
                uv.each(context.grid, at, colors, |[u, v]| {
                    sampler
                        .sample_lanes(&u, &v)
                        .map(|color| Premultiplied16::from_byte_range(color, rules))
                });
            }
            ShaderKind::Texture { uv, sampler, opacity } => uv.each(context.grid, at, colors, |[u, v]| {
                // Truncation comes after blending: half of a texel is no byte.
                let faded = |color: [f32; 4]| color.map(|channel| channel * opacity);
                sampler
                    .sample_lanes(&u, &v)
                    .map(|color| Premultiplied16::from_byte_range(faded(color), Rules::Standard))
            }),
        }
    }

    /// Whether every fragment hides what is below it.
    pub(crate) fn is_opaque(paint: &Paint, textures: &[&Texture]) -> bool {
        match *paint {
            Paint::Solid(color) => color.is_opaque(),
            Paint::Vertex(colors) => colors.iter().all(|color| color[3] >= 1.0),
            Paint::Texture { texture, opacity, .. } => opacity >= 1.0 && textures[texture as usize].pyramid.is_opaque(),
        }
    }
}

/// An interpolated straight colour as samples store it.
#[inline]
fn vertex_color([r, g, b, a]: [f32; 4], rules: Rules) -> Premultiplied16 {
    // Rounding may carry an attribute a little beyond the colours at the corners.
    let alpha = a.clamp(0.0, 1.0);
    let channel = |value: f32| value.clamp(0.0, 1.0) * alpha * 255.0;
    Premultiplied16::from_byte_range([channel(r), channel(g), channel(b), alpha * 255.0], rules)
}
