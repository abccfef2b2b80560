//! A paint that reads a texture through the footprint of a pixel or of a sample.

use glam::DVec2;

use crate::color::{Premultiplied16, SampleMean, unit_to_16};
use crate::geometry::clip::ClipVertex;
use crate::geometry::subpixel::{GridPoint, SubpixelGrid};
use crate::raster::attributes::Planes;
use crate::raster::shading::context::{MaskedPixels, Pixels, PlacedPixels, ShadeContext, ShadedSample, Wanted};
use crate::raster::shading::interpolated::{Attributes, TextureUse};
use crate::raster::shading::kind::{
    PaintKind, Shade, at_corner, masked_sums_by_points, pixels_by_points, sums_of_both,
};
use crate::raster::shading::sources::PaintSources;
use crate::rules::Rules;
use crate::simd;
use crate::texture::{
    AreaFilter, ByteValues, Filter, Footprint, PixelList, PixelWork, Reading, SampleGrid, Sampler, SamplingSettings,
    Texture, UvMap, ValueList,
};

/// Most samples along the side of a pixel of which a filter takes sums by masks.
const MAX_MASKED_SIDE: u32 = 8;

/// Texture coordinates at a triangle's corners.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::raster) struct TexturePaint {
    /// Index into the textures of the drawing.
    texture: u32,
    /// `(u, v)` at the corners.
    uv: [[f32; 2]; 3],
    /// Multiplies the texture's own, `0.0..=1.0`.
    opacity: f32,
}

/// A texture on one triangle.
#[derive(Debug)]
pub(super) struct TextureShader<'a> {
    texture: u32,
    uv: Planes<2>,
    opacity: f32,
    reader: Reader<'a>,
}

/// By whose rules the texture is read.
#[derive(Debug)]
enum Reader<'a> {
    Standard(Filter<'a>),
    Course(Sampler<'a>),
    /// By the standard rules, whatever the settings say: an area.
    Area(Box<AreaFilter<'a>>),
}

impl TexturePaint {
    pub(in crate::raster) fn new(texture: u32, uv: [[f32; 2]; 3], opacity: f32) -> Self {
        Self { texture, uv, opacity }
    }

    /// The change of `(u, v)` per pixel on the triangle with these corners.
    pub(in crate::raster) fn footprint(&self, grid: SubpixelGrid, corners: &[GridPoint; 3]) -> Footprint {
        uv_map(grid, &Planes::new(grid, corners, self.uv)).footprint()
    }

    /// The same coordinates on a part of the triangle.
    pub(in crate::raster) fn on_part(&self, corners: &[ClipVertex; 3]) -> Self {
        let uv = |corner: &ClipVertex| [0, 1].map(|i| at_corner(corner, self.uv.map(|uv| uv[i])));
        Self {
            uv: corners.each_ref().map(uv),
            ..*self
        }
    }
}

impl PaintKind for TexturePaint {
    type Shader<'a> = TextureShader<'a>;

    fn is_opaque(&self, sources: &PaintSources<'_>) -> bool {
        self.opacity >= 1.0 && sources.textures[self.texture as usize].pyramid.is_opaque()
    }

    fn clipped(&self, corners: &[ClipVertex; 3]) -> Self {
        self.on_part(corners)
    }

    fn shader<'a>(&self, context: &ShadeContext<'a>, corners: &[GridPoint; 3]) -> TextureShader<'a> {
        let texture = context.sources.textures[self.texture as usize];
        let uv = Planes::new(context.grid, corners, self.uv);
        let map = uv_map(context.grid, &uv);
        let own = texture.own_sampling(&context.sampling);
        let sampling = own.as_ref().unwrap_or(&context.sampling);
        TextureShader {
            texture: self.texture,
            uv,
            opacity: self.opacity,
            reader: Reader::new(texture, &map, sampling),
        }
    }
}

impl<'a> Reader<'a> {
    fn new(texture: &'a Texture, map: &UvMap, sampling: &SamplingSettings) -> Self {
        if sampling.level.weighs_area()
            && let Some(filter) = AreaFilter::new(texture, map, sampling)
        {
            return Self::Area(Box::new(filter));
        }
        let pyramid = texture.pyramid_in(sampling.pyramid, sampling.pyramid_filter);
        match sampling.rules {
            Rules::Standard | Rules::Float => Self::Standard(Filter::new(pyramid, map, sampling)),
            Rules::Course => Self::Course(Sampler::new(pyramid, &map.footprint(), sampling)),
        }
    }
}

impl Shade for TextureShader<'_> {
    fn points(&self, grid: SampleGrid, points: &[[u16; 2]], colors: &mut [Premultiplied16]) {
        match &self.reader {
            Reader::Standard(filter) => {
                filter.points(simd::level(), grid, points, colors);
                self.fade(colors);
            }
            Reader::Area(filter) => {
                filter.points(simd::level(), grid, points, colors);
                self.fade(colors);
            }
            Reader::Course(sampler) => {
                for (place, color) in points.iter().zip(colors) {
                    let sample = ShadedSample { grid, place: *place };
                    *color = course_texel(sampler, course_uv(&self.uv, sample), self.opacity);
                }
            }
        }
    }

    fn pixels(&self, pixels: Pixels<'_>, rules: Rules, values: &mut [u32]) {
        match &self.reader {
            Reader::Standard(filter) => filter.pixels(simd::level(), pixels.grid, pixels.places, values),
            Reader::Area(filter) if rules != Rules::Course => {
                filter.pixels(simd::level(), pixels.grid, pixels.places, values);
            }
            Reader::Course(_) | Reader::Area(_) => pixels_by_points(self, pixels, rules, values),
        }
    }

    fn placed_pixels(&self, placed: PlacedPixels<'_>, mean: &SampleMean, values: &mut [u32]) -> bool {
        if let SampleMean::Linear(resolver) = mean
            && let Some((filter, list)) = self.value_list((placed, None), mean)
            && filter.light_pixels(simd::level(), placed.pixels.grid, (list, resolver), values)
        {
            return true;
        }
        let mut sums = vec![[0; 3]; values.len()];
        let is_summed = self.value_sums((placed, None), mean, &mut sums);
        if is_summed {
            for (value, sum) in values.iter_mut().zip(&sums) {
                *value = mean.pixel_of_values(*sum);
            }
        }
        is_summed
    }

    fn placed_sums(&self, placed: PlacedPixels<'_>, masks: &[u64], mean: &SampleMean, sums: &mut [[u64; 3]]) -> bool {
        self.value_sums((placed, Some(masks)), mean, sums)
    }

    fn pixel_sums(&self, pixels: Pixels<'_>, sums: &mut [[u32; 4]]) {
        self.filtered_sums(pixels, None, sums);
    }

    fn sums_or_means(&self, pixels: Pixels<'_>, parts: MaskedPixels<'_>, wanted: Wanted<'_>) -> bool {
        match &self.reader {
            Reader::Standard(filter) if pixels.grid.side <= MAX_MASKED_SIDE => {
                let list = |pixels, masks| PixelList { pixels, masks };
                let work = PixelWork {
                    lists: [list(pixels.places, None), list(parts.pixels.places, Some(parts.masks))],
                    sums: wanted.sums,
                    means: wanted.means,
                };
                filter.sums_or_means(simd::level(), pixels.grid, work)
            }
            _ => sums_of_both(self, pixels, parts, wanted),
        }
    }

    fn masked_sums(&self, pixels: MaskedPixels<'_>, sums: &mut [[u32; 4]]) {
        if pixels.pixels.grid.side <= MAX_MASKED_SIDE {
            self.filtered_sums(pixels.pixels, Some(pixels.masks), sums);
        } else {
            masked_sums_by_points(self, pixels, sums);
        }
    }

    fn interpolated(&self, sample: ShadedSample) -> Attributes {
        let [x, y] = sample.position();
        match &self.reader {
            Reader::Standard(filter) => Attributes::Texture {
                uv: self.uv.at(x, y),
                reads: filter.reads(sample.grid, sample.place),
            },
            Reader::Area(filter) => Attributes::Texture {
                uv: self.uv.at(x, y),
                reads: filter.reads(sample.grid, sample.place),
            },
            Reader::Course(sampler) => {
                let [u, v] = course_uv(&self.uv, sample);
                Attributes::Texture {
                    uv: [u.into(), v.into()],
                    reads: sampler.course_reads(u, v),
                }
            }
        }
    }

    fn texture_use(&self, context: &ShadeContext<'_>) -> Option<TextureUse> {
        let texture = context.sources.textures[self.texture as usize];
        let own = texture.own_sampling(&context.sampling);
        let sampling = own.as_ref().unwrap_or(&context.sampling);
        let footprint = uv_map(context.grid, &self.uv).footprint();
        Some(TextureUse {
            texture: self.texture,
            reading: Reading::new(&footprint, &texture.pyramid, sampling),
            opacity: self.opacity,
        })
    }
}

impl TextureShader<'_> {
    /// What red, green and blue of all samples of pixels add up to, or of those that masks name, stored or their light; whether it is
    /// known without shading them one by one.
    fn value_sums(
        &self,
        (placed, masks): (PlacedPixels<'_>, Option<&[u64]>),
        mean: &SampleMean,
        sums: &mut [[u64; 3]],
    ) -> bool {
        let list = self.value_list((placed, masks), mean);
        list.is_some_and(|(filter, list)| filter.value_sums(simd::level(), placed.pixels.grid, list, sums))
    }

    /// What reads the texels of pixels, if nothing is painted over them.
    fn value_list<'l>(
        &self,
        (placed, masks): (PlacedPixels<'l>, Option<&'l [u64]>),
        mean: &SampleMean,
    ) -> Option<(&Filter<'_>, ValueList<'l>)> {
        let Reader::Standard(filter) = &self.reader else {
            return None;
        };
        let list = ValueList {
            pixels: placed.pixels.places,
            count: placed.count,
            inside: placed.inside,
            masks,
            values: mean.byte_light().map_or(ByteValues::Stored, ByteValues::Table),
        };
        placed.tints.is_empty().then_some((filter, list))
    }

    /// Sums over the samples of pixels, of which each must be opaque, under the standard rules.
    fn filtered_sums(&self, pixels: Pixels<'_>, masks: Option<&[u64]>, sums: &mut [[u32; 4]]) {
        let list = PixelList {
            pixels: pixels.places,
            masks,
        };
        match &self.reader {
            Reader::Standard(filter) => filter.sums(simd::level(), pixels.grid, list, sums),
            Reader::Area(filter) => filter.sums(simd::level(), pixels.grid, list, sums),
            Reader::Course(_) => debug_assert!(false, "the course truncates every sample: nothing is summed before"),
        }
    }

    /// What shines through.
    fn fade(&self, colors: &mut [Premultiplied16]) {
        if self.opacity < 1.0 {
            let opacity = unit_to_16(self.opacity.max(0.0));
            for color in colors {
                *color = color.faded(opacity);
            }
        }
    }
}

/// The planes of `(u, v)` in pixels.
fn uv_map(grid: SubpixelGrid, uv: &Planes<2>) -> UvMap {
    let side = f64::from(grid.side());
    UvMap {
        pivot: DVec2::from_array(uv.pivot) / side,
        uv: DVec2::from_array(uv.at_pivot),
        dx: DVec2::from_array(uv.dx) * side,
        dy: DVec2::from_array(uv.dy) * side,
    }
}

/// `(u, v)` at a sample as the course's 32-bit arithmetic has it: in 64 bits at an anchor every eight pixels of a row, in
/// 32 bits from there on. Where a sample lies on the border of two texels, the last bit decides.
#[expect(
    clippy::cast_possible_truncation,
    reason = "the course reads textures at 32-bit floats"
)]
fn course_uv(uv: &Planes<2>, sample: ShadedSample) -> [f32; 2] {
    let side = sample.grid.side.cast_signed();
    let [column, row] = sample.in_frame();
    let anchor = column.div_euclid(8 * side) * 8 * side;
    let at_anchor = uv.at(f64::from(anchor), f64::from(row) + 0.5);
    let pixels = ((column - anchor) as f32 + 0.5) * (1.0 / side as f32);
    [0, 1].map(|i| at_anchor[i] as f32 + pixels * (uv.dx[i] * f64::from(side)) as f32)
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
