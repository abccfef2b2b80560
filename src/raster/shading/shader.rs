//! Fragments to colours: attributes interpolated over a triangle, textures read at them.

use crate::raster::attributes::{Planes, course_uv, uv_map};

use crate::color::{Premultiplied16, ResolveSpace, unit_to_16};
use crate::geometry::subpixel::SubpixelGrid;
use crate::raster::SampleRate;
use crate::raster::list::chunk::{Paint, ScreenTriangle};
use crate::raster::shading::vertex::VertexColors;
use crate::rules::Rules;
use crate::simd;
use crate::texture::{Filter, PixelList, SampleGrid, Sampler, SamplingSettings, Texture};

/// Turns the fragments of one triangle into colours.
#[derive(Debug)]
pub(crate) struct Shader<'a> {
    pub(crate) kind: ShaderKind<'a>,
    /// Whether every fragment hides what is below it.
    pub(crate) opaque: bool,
    rules: Rules,
}

/// Where a fragment's colour comes from.
#[derive(Debug)]
pub(crate) enum ShaderKind<'a> {
    /// One colour.
    Solid(Premultiplied16),
    /// Colours at the corners.
    Vertex(VertexColors),
    /// A texture under the standard rules, multiplied by an opacity.
    Texture { filter: Filter<'a>, opacity: f32 },
    /// A texture under the course's rules: `(u, v)`, read through a sampler and multiplied by an opacity.
    CourseTexture {
        uv: Planes<2>,
        sampler: Sampler<'a>,
        opacity: f32,
    },
}

/// Some pixels of a tile, counted from the first pixel of the grid.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Pixels<'p> {
    pub(crate) grid: SampleGrid,
    pub(crate) places: &'p [[u16; 2]],
}

/// What shading needs to know besides the triangle.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ShadeContext<'a> {
    pub(crate) grid: SubpixelGrid,
    /// Samples per pixel.
    pub(crate) rate: SampleRate,
    /// In which values they are averaged.
    pub(crate) space: ResolveSpace,
    pub(crate) sampling: SamplingSettings,
    pub(crate) textures: &'a [&'a Texture],
}

impl ShadeContext<'_> {
    /// The samples of a tile whose first pixel is `origin`.
    pub(crate) fn samples_from(&self, origin: [i32; 2]) -> SampleGrid {
        SampleGrid {
            side: self.grid.side().cast_unsigned(),
            origin,
        }
    }
}

impl<'a> Shader<'a> {
    /// One colour, everywhere.
    pub(crate) fn flat(color: Premultiplied16) -> Self {
        Self {
            kind: ShaderKind::Solid(color),
            opaque: color.is_opaque(),
            rules: Rules::Standard,
        }
    }

    /// Prepares the shading of one triangle.
    pub(crate) fn new(context: &ShadeContext<'a>, triangle: &ScreenTriangle, paint: &Paint) -> Self {
        let opaque = Self::is_opaque(paint, context.textures);
        let rules = context.sampling.rules;
        let kind = match *paint {
            Paint::Solid(color) => ShaderKind::Solid(color),
            Paint::Vertex(colors) => ShaderKind::Vertex(VertexColors::new(
                Planes::new(context.grid, &triangle.corners, colors),
                opaque,
            )),
            Paint::Texture { texture, uv, opacity } => {
                let pyramid = &context.textures[texture as usize].pyramid;
                let uv = Planes::new(context.grid, &triangle.corners, uv);
                let map = uv_map(context.grid, &uv);
                let sampling = context.sampling;
                match rules {
                    Rules::Standard | Rules::Float => ShaderKind::Texture {
                        filter: Filter::new(pyramid, &map, &sampling),
                        opacity,
                    },
                    Rules::Course => ShaderKind::CourseTexture {
                        uv,
                        sampler: Sampler::new(pyramid, &map.footprint(), &sampling),
                        opacity,
                    },
                }
            }
        };
        Self { kind, opaque, rules }
    }

    /// The colours of samples, counted from the first sample of the grid's origin.
    pub(crate) fn points(&self, grid: SampleGrid, points: &[[u16; 2]], colors: &mut [Premultiplied16]) {
        match &self.kind {
            ShaderKind::Solid(color) => colors.fill(*color),
            ShaderKind::Vertex(vertex) => vertex.points(grid, self.rules, points, colors),
            ShaderKind::Texture { filter, opacity } => {
                filter.points(simd::level(), grid, points, colors);
                if *opacity < 1.0 {
                    let opacity = unit_to_16(opacity.max(0.0));
                    for color in colors {
                        *color = color.faded(opacity);
                    }
                }
            }
            ShaderKind::CourseTexture { uv, sampler, opacity } => {
                let side = grid.side.cast_signed();
                for ([x, y], color) in points.iter().zip(colors) {
                    let sample = [
                        grid.origin[0] * side + i32::from(*x),
                        grid.origin[1] * side + i32::from(*y),
                    ];
                    *color = course_texel(sampler, course_uv(uv, side, sample), *opacity);
                }
            }
        }
    }

    /// The values of pixels that show nothing but this triangle, at one sample each; it must be opaque.
    pub(crate) fn pixels(&self, pixels: Pixels<'_>, values: &mut [u32]) {
        let Pixels { grid, places } = pixels;
        match &self.kind {
            ShaderKind::Solid(color) => values.fill(color.to_pixel(self.rules)),
            ShaderKind::Vertex(vertex) if self.rules != Rules::Course => {
                vertex.pixels(simd::level(), grid, places, values);
            }
            ShaderKind::Texture { filter, .. } => filter.pixels(simd::level(), grid, places, values),
            ShaderKind::Vertex(_) | ShaderKind::CourseTexture { .. } => {
                let mut colors = vec![Premultiplied16::TRANSPARENT; places.len()];
                self.points(grid, places, &mut colors);
                for (value, color) in values.iter_mut().zip(colors) {
                    *value = color.to_pixel(self.rules);
                }
            }
        }
    }

    /// For each of the pixels the sum of all its samples. The triangle must be opaque and the rules the standard ones.
    pub(crate) fn pixel_sums(&self, pixels: Pixels<'_>, sums: &mut [[u32; 4]]) {
        let Pixels { grid, places } = pixels;
        match &self.kind {
            ShaderKind::Vertex(vertex) => vertex.sums(simd::level(), grid, places, sums),
            ShaderKind::Texture { filter, .. } => {
                let list = PixelList {
                    pixels: places,
                    masks: None,
                };
                filter.sums(simd::level(), grid, list, sums);
            }
            ShaderKind::Solid(_) | ShaderKind::CourseTexture { .. } => {
                debug_assert!(false, "flat and course's primitives are not summed");
            }
        }
    }

    /// For each of the pixels the sum of some of its samples, under the same conditions: a mask each of the 64 samples
    /// from `first` on.
    pub(crate) fn masked_sums(&self, pixels: Pixels<'_>, (masks, first): (&[u64], u32), sums: &mut [[u32; 4]]) {
        let Pixels { grid, places } = pixels;
        match &self.kind {
            ShaderKind::Vertex(vertex) => vertex.masked_sums(grid, (places, masks, first), sums),
            ShaderKind::Texture { filter, .. } if grid.side <= 8 => {
                let list = PixelList {
                    pixels: places,
                    masks: Some(masks),
                };
                filter.sums(simd::level(), grid, list, sums);
            }
            _ => self.sums_of_points(pixels, (masks, first), sums),
        }
    }

    /// As [`Shader::masked_sums`], sample by sample.
    fn sums_of_points(&self, pixels: Pixels<'_>, (masks, first): (&[u64], u32), sums: &mut [[u32; 4]]) {
        let side = pixels.grid.side;
        let mut points = Vec::with_capacity(64);
        let mut colors = [Premultiplied16::TRANSPARENT; 64];
        for ((place, mask), sum) in pixels.places.iter().zip(masks).zip(sums) {
            points.clear();
            points.extend(
                (first..)
                    .zip(0..64)
                    .filter(|(_, bit)| mask & 1_u64 << bit != 0)
                    .map(|(sample, _)| {
                        let inside = [sample % side, sample / side];
                        [0, 1].map(|i| u16::try_from(u32::from(place[i]) * side + inside[i]).unwrap_or(u16::MAX))
                    }),
            );
            let colors = &mut colors[..points.len()];
            self.points(pixels.grid, &points, colors);
            *sum = [0; 4];
            for color in colors {
                for (sum, channel) in sum.iter_mut().zip(color.0) {
                    *sum += u32::from(channel);
                }
            }
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

/// A texture read by the course's rules.
fn course_texel(sampler: &Sampler<'_>, [u, v]: [f32; 2], opacity: f32) -> Premultiplied16 {
    let color = sampler.sample(u, v);
    if opacity >= 1.0 {
        return Premultiplied16::from_byte_range(color, Rules::Course);
    }
    // Truncation comes after blending: half of a texel is no byte.
    Premultiplied16::from_byte_range(color.map(|channel| channel * opacity), Rules::Standard)
}
