//! Paints: what gives a colour at a sample, for whole lists of samples at once.
//!
//! | paint | colour |
//! |---|---|
//! | [`solid`] | one everywhere |
//! | [`vertex`] | interpolated between a triangle's corners |
//! | [`texture`] | read from a texture through the footprint of a pixel or a sample |
//! | [`gradient`] | found on a ramp |
//! | [`pattern`] | read from a tile that is repeated |
//!
//! A paint is a [`PaintKind`] as a display list holds it, and a [`Shade`] once it is prepared for one triangle. To add one,
//! write both in a file of its own and add a line to the table below. Painters hold a [`Paint`] or a [`Shader`] and ask
//! it questions; only this folder knows which kind it is.

pub(in crate::raster) mod context;
mod gradient;
mod gradient_means;
pub(in crate::raster) mod interpolated;
mod kernel;
mod kind;
mod near_planes;
pub(in crate::raster) mod once;
mod pattern;
mod plane_means;
mod plane_parts;
mod solid;
pub(in crate::raster) mod sources;
mod texture;
mod vertex;
mod vertex_kernel;

use crate::color::{Premultiplied16, Resolver, Rgba, SampleMean, SumBounds};
use crate::geometry::clip::ClipVertex;
use crate::geometry::subpixel::GridPoint;
use crate::raster::shading::context::{
    BoundedPixels, MaskedPixels, PixelRun, Pixels, PlacedParts, PlacedPixels, ShadeContext, ShadedSample, Wanted,
};
use crate::raster::shading::gradient::GradientPaint;
use crate::raster::shading::interpolated::{Attributes, TextureUse};
use crate::raster::shading::kind::{PaintKind, Shade};
use crate::raster::shading::once::Centres;
use crate::raster::shading::pattern::PatternPaint;
use crate::raster::shading::solid::{SolidPaint, SolidShader};
use crate::raster::shading::sources::PaintSources;
use crate::raster::shading::vertex::VertexPaint;
use crate::rules::Rules;
use crate::texture::SampleGrid;

pub(in crate::raster) use texture::TexturePaint;

/// Makes the enums of all paints and of all shaders, and what hands a question to the one that is there.
macro_rules! paints {
    ($($(#[$doc:meta])* $make:ident($($part:ident: $of:ty),*) => $kind:ident($paint:ty),)+) => {
        #[derive(Clone, Copy, Debug, PartialEq)]
        enum AnyPaint {
            $($kind($paint),)+
        }

        #[derive(Debug)]
        enum AnyShader<'a> {
            $($kind(<$paint as PaintKind>::Shader<'a>),)+
        }

        impl AnyPaint {
            fn clipped(&self, corners: &[ClipVertex; 3]) -> Self {
                match self {
                    $(Self::$kind(paint) => Self::$kind(paint.clipped(corners)),)+
                }
            }

            fn shader<'a>(&self, context: &ShadeContext<'a>, corners: &[GridPoint; 3]) -> AnyShader<'a> {
                match self {
                    $(Self::$kind(paint) => AnyShader::$kind(paint.shader(context, corners)),)+
                }
            }
        }

        impl Paint {
            $(
                $(#[$doc])*
                pub fn $make($($part: $of),*) -> Self {
                    Self(AnyPaint::$kind(<$paint>::new($($part),*)))
                }
            )+
        }

        /// `ask!(this, AnyPaint, paint => paint.question())`, whichever kind it is.
        macro_rules! ask {
            ($any:expr, $table:ident, $one:ident => $answer:expr) => {
                match $any {
                    $($table::$kind($one) => $answer,)+
                }
            };
        }
    };
}

// The table of paints: a line for each kind.
paints! {
    /// One colour.
    solid(color: Rgba) => Solid(SolidPaint),
    /// Colours at the corners, and between them what is interpolated.
    vertex(colors: [Rgba; 3]) => Vertex(VertexPaint),
    /// The texture with an index in the drawing, read between the coordinates `(u, v)` at the corners; its own opacity is
    /// multiplied by another one, `0.0..=1.0`.
    texture(texture: u32, uv: [[f32; 2]; 3], opacity: f32) => Texture(TexturePaint),
    /// The gradient with an index in the drawing.
    gradient(gradient: u32) => Gradient(GradientPaint),
    /// The pattern with an index in the drawing.
    pattern(pattern: u32) => Pattern(PatternPaint),
}

/// What fills a triangle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Paint(AnyPaint);

/// A paint prepared for one triangle.
#[derive(Debug)]
pub(crate) struct Shader<'a> {
    any: AnyShader<'a>,
    /// Whether every fragment hides what is below it.
    pub(crate) opaque: bool,
    rules: Rules,
    /// Where each pixel is shaded for all of its samples, if it is.
    centres: Option<Centres>,
}

impl Paint {
    /// The one colour that it has everywhere, if there is one.
    #[inline]
    pub(crate) fn constant(&self) -> Option<Rgba> {
        ask!(&self.0, AnyPaint, paint => paint.constant())
    }

    /// Whether every fragment hides what is below it.
    pub(crate) fn is_opaque(&self, sources: &PaintSources<'_>) -> bool {
        ask!(&self.0, AnyPaint, paint => paint.is_opaque(sources))
    }

    /// Whether sums of its samples are those of their rounded colours, and not rounded once at the end.
    pub(crate) fn rounds_each_sample(&self) -> bool {
        ask!(&self.0, AnyPaint, paint => paint.rounds_each_sample())
    }

    /// Whether all samples of a line from left to right get the same colour, for certain.
    #[inline]
    pub(crate) fn is_level(&self, context: &ShadeContext<'_>) -> bool {
        ask!(&self.0, AnyPaint, paint => paint.is_level(context))
    }

    /// The same paint on a part of its triangle.
    pub(crate) fn clipped(&self, corners: &[ClipVertex; 3]) -> Self {
        Self(self.0.clipped(corners))
    }
}

impl<'a> Shader<'a> {
    /// Prepares a paint for the triangle with these corners. Where primitives are shaded once in a pixel, each sample gets the colour
    /// of its pixel's centre: who wants another place prepares the paint on the grid of that.
    pub(crate) fn new(context: &ShadeContext<'a>, corners: &[GridPoint; 3], paint: &Paint) -> Self {
        let centres = context.shading.is_once().then(|| Centres::new(context));
        let any = match centres {
            Some(centres) => paint.0.shader(&context.on(centres.grid()), corners),
            None => paint.0.shader(context, corners),
        };
        let constant = ask!(&any, AnyShader, shader => shader.constant());
        Self {
            opaque: constant.map_or_else(|| paint.is_opaque(context.sources), Premultiplied16::is_opaque),
            any,
            rules: context.sampling.rules,
            centres,
        }
    }

    /// One colour, everywhere.
    pub(crate) fn flat(color: Premultiplied16) -> Self {
        Self {
            any: AnyShader::Solid(SolidShader(color)),
            opaque: color.is_opaque(),
            rules: Rules::Standard,
            centres: None,
        }
    }

    /// How many colours are computed for so many samples of so many pixels.
    pub(crate) fn evaluations(&self, samples: u64, pixels: usize) -> u64 {
        if self.centres.is_some() { pixels as u64 } else { samples }
    }

    /// The one colour that every sample gets, if there is one.
    #[inline]
    pub(crate) fn constant(&self) -> Option<Premultiplied16> {
        ask!(&self.any, AnyShader, shader => shader.constant())
    }

    /// Whether all samples of a line from left to right get the same colour.
    pub(crate) fn is_level(&self) -> bool {
        ask!(&self.any, AnyShader, shader => shader.is_level())
    }

    /// The colours of samples, counted from the first sample of the grid's origin.
    pub(crate) fn points(&self, grid: SampleGrid, points: &[[u16; 2]], colors: &mut [Premultiplied16]) {
        match &self.centres {
            Some(centres) => centres.points(grid, points, colors, |grid, points, colors| {
                ask!(&self.any, AnyShader, shader => shader.points(grid, points, colors));
            }),
            None => ask!(&self.any, AnyShader, shader => shader.points(grid, points, colors)),
        }
    }

    /// The values of pixels that show nothing but this triangle, at one sample each; it must be opaque.
    pub(crate) fn pixels(&self, pixels: Pixels<'_>, values: &mut [u32]) {
        match &self.centres {
            Some(centres) => {
                let (grid, places) = &centres.of_pixels(pixels.grid, pixels.places);
                let centres = Pixels { grid: *grid, places };
                ask!(&self.any, AnyShader, shader => shader.pixels(centres, self.rules, values));
            }
            None => ask!(&self.any, AnyShader, shader => shader.pixels(pixels, self.rules, values)),
        }
    }

    /// The pixels of runs, one after the other, where there is a way that is shorter than [`Shader::pixel_sums`] and [`Resolver`];
    /// whether there is one. They show nothing but this triangle, which must be opaque, under the standard rules or at one sample
    /// each.
    pub(crate) fn runs(&self, runs: &[PixelRun], grid: SampleGrid, resolver: &Resolver, values: &mut [u32]) -> bool {
        let Some(centres) = &self.centres else {
            return ask!(&self.any, AnyShader, shader => shader.runs(runs, grid, resolver, values));
        };
        // Centres that are all of their grid's samples are those of a picture with one sample per pixel.
        if centres.grid().side() == 1 {
            let (grid, one) = (SampleGrid { side: 1, ..grid }, Resolver::new(1, self.rules));
            if ask!(&self.any, AnyShader, shader => shader.runs(runs, grid, &one, values)) {
                return true;
            }
        }
        let places = PixelRun::all_places(runs);
        let places = &places;
        self.pixels(Pixels { grid, places }, values);
        true
    }

    /// The pixels that all of their samples make with what is painted over them, where there is a way that is shorter than
    /// [`Shader::points`] of each; whether there is one. The triangle must be opaque.
    pub(crate) fn placed_pixels(&self, pixels: PlacedPixels<'_>, mean: &SampleMean, values: &mut [u32]) -> bool {
        if self.centres.is_none() {
            return ask!(&self.any, AnyShader, shader => shader.placed_pixels(pixels, mean, values));
        }
        if !pixels.tints.is_empty() {
            return false;
        }
        // Samples that are all alike are their pixel, whatever is averaged.
        self.pixels(pixels.pixels, values);
        true
    }

    /// What red, green and blue of those samples of each pixel that its mask names add up to, stored or of [`SampleMean::byte_light`],
    /// where there is a way that is shorter than [`Shader::points`] of each; whether there is one. The triangle must be opaque.
    pub(crate) fn placed_sums(
        &self,
        pixels: PlacedPixels<'_>,
        masks: &[u64],
        mean: &SampleMean,
        sums: &mut [[u64; 3]],
    ) -> bool {
        self.centres.is_none() && ask!(&self.any, AnyShader, shader => shader.placed_sums(pixels, masks, mean, sums))
    }

    /// Those of the pixels, with what is painted over them, for which it does not matter where exactly their samples lie; the numbers of
    /// all others are added to `open`. `false` where there is no way to know. The triangle must be opaque.
    pub(crate) fn bounded_pixels(
        &self,
        pixels: BoundedPixels<'_>,
        mean: &SampleMean,
        values: &mut [u32],
        open: &mut Vec<usize>,
    ) -> bool {
        self.centres.is_none()
            && ask!(&self.any, AnyShader, shader => shader.bounded_pixels(pixels, mean, values, open))
    }

    /// Between what the samples of parts of pixels add up to with what is painted over them, where that is told apart by little more
    /// than rounding; whether it is. Only then their samples have to be placed. The triangle must be opaque.
    pub(crate) fn part_bounds<'p>(
        &self,
        parts: impl FnOnce() -> PlacedParts<'p>,
        mean: &SampleMean,
        bounds: &mut [SumBounds],
    ) -> bool {
        self.centres.is_none() && ask!(&self.any, AnyShader, shader => shader.part_bounds(parts, mean, bounds))
    }

    /// For each of the pixels the sum of all its samples. The triangle must be opaque and the rules the standard ones.
    pub(crate) fn pixel_sums(&self, pixels: Pixels<'_>, sums: &mut [[u32; 4]]) {
        match self.of_centres(pixels) {
            Some(colors) => times_each(&colors, std::iter::repeat(pixels.grid.side * pixels.grid.side), sums),
            None => ask!(&self.any, AnyShader, shader => shader.pixel_sums(pixels, sums)),
        }
    }

    /// For each of the pixels the sum of some of its samples, under the same conditions.
    pub(crate) fn masked_sums(&self, pixels: MaskedPixels<'_>, sums: &mut [[u32; 4]]) {
        match self.of_centres(pixels.pixels) {
            Some(colors) => times_each(&colors, pixels.masks.iter().map(|mask| mask.count_ones()), sums),
            None => ask!(&self.any, AnyShader, shader => shader.masked_sums(pixels, sums)),
        }
    }

    /// [`Shader::pixel_sums`] and [`Shader::masked_sums`], where both are wanted; see [`Shade::sums_or_means`].
    pub(crate) fn sums_or_means(&self, pixels: Pixels<'_>, parts: MaskedPixels<'_>, wanted: Wanted<'_>) -> bool {
        if self.centres.is_some() {
            let [of_pixels, of_parts] = wanted.sums;
            self.pixel_sums(pixels, of_pixels);
            self.masked_sums(parts, of_parts);
            return false;
        }
        ask!(&self.any, AnyShader, shader => shader.sums_or_means(pixels, parts, wanted))
    }

    /// The colours in the centres of pixels, where those are all their samples'.
    fn of_centres(&self, Pixels { grid, places }: Pixels<'_>) -> Option<Vec<Premultiplied16>> {
        let centres = self.centres.as_ref()?;
        let mut colors = vec![Premultiplied16::TRANSPARENT; places.len()];
        let (grid, points) = centres.of_pixels(grid, places);
        ask!(&self.any, AnyShader, shader => shader.points(grid, &points, &mut colors));
        Some(colors)
    }

    /// What is interpolated at a sample, inside the triangle or not.
    pub(crate) fn interpolated(&self, sample: ShadedSample) -> Attributes {
        ask!(&self.any, AnyShader, shader => shader.interpolated(sample))
    }

    /// How a texture is read, if one is.
    pub(crate) fn texture_use(&self, context: &ShadeContext<'_>) -> Option<TextureUse> {
        ask!(&self.any, AnyShader, shader => shader.texture_use(context))
    }
}

/// Sums of colours, each so many times.
fn times_each(colors: &[Premultiplied16], counts: impl Iterator<Item = u32>, sums: &mut [[u32; 4]]) {
    for ((sum, color), count) in sums.iter_mut().zip(colors).zip(counts) {
        *sum = color.0.map(|channel| u32::from(channel) * count);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::color::ResolveSpace;
    use crate::geometry::subpixel::SubpixelGrid;
    use crate::raster::resolve::SizedFilter;
    use crate::raster::{SampleRate, ShadingRate};
    use crate::texture::SamplingSettings;

    /// A paint of which nothing but the colours of samples is known: column in red, row in green.
    #[derive(Clone, Copy, Debug)]
    struct Gradient;

    impl Shade for Gradient {
        fn points(&self, _: SampleGrid, points: &[[u16; 2]], colors: &mut [Premultiplied16]) {
            for ([x, y], color) in points.iter().zip(colors) {
                *color = Premultiplied16([*x, *y, 0, Premultiplied16::ONE]);
            }
        }
    }

    #[test]
    fn a_new_paint_needs_only_the_colours_of_samples() {
        let side = 12;
        let grid = SampleGrid { side, origin: [0, 0] };
        let places = [[0, 0], [2, 1]];
        let pixels = Pixels { grid, places: &places };
        let mut sums = [[0; 4]; 2];
        Gradient.pixel_sums(pixels, &mut sums);
        // The mean column of a pixel is that of its middle, less half a sample.
        let mean = |pixel: u32| pixel * side * 2 + side - 1;
        let of = |[x, y]: [u16; 2]| [mean(x.into()) * 72, mean(y.into()) * 72, 0, 144 * 65_280];
        assert_eq!(sums, places.map(of), "all samples, more than a mask has bits");
        let mut last = [[0; 4]];
        let masks = [1 << 15];
        let second = Pixels {
            places: &places[1..],
            ..pixels
        };
        Gradient.masked_sums(second.masked(&masks, 128), &mut last);
        assert_eq!(last, [[24 + 11, 12 + 11, 0, 65_280]], "the last sample of a pixel");
        let mut values = [0];
        let grid = SampleGrid { side: 1, ..grid };
        let pixels = Pixels {
            grid,
            places: &[[0x300, 0x200]],
        };
        Gradient.pixels(pixels, Rules::Standard, &mut values);
        assert_eq!(values, [0xFF03_0200], "one sample");
        assert_eq!(Gradient.constant(), None, "it varies");
    }

    #[test]
    fn a_constant_paint_is_known_as_one() {
        let sources = PaintSources::default();
        let context = ShadeContext {
            grid: SubpixelGrid::new(2),
            rate: SampleRate::ONE,
            filter: SizedFilter::default(),
            space: ResolveSpace::Stored,
            shading: ShadingRate::Sample,
            sampling: SamplingSettings::default(),
            clamped: None,
            sources: &sources,
        };
        let corners = [[0, 0], [999, 0], [0, 999]].map(|[x, y]| GridPoint { x, y });
        let [solid, vertex] = [Paint::solid(Rgba::WHITE), Paint::vertex([Rgba::WHITE; 3])];
        assert_eq!((solid.constant(), vertex.constant()), (Some(Rgba::WHITE), None));
        let shader = Shader::new(&context, &corners, &solid);
        assert_eq!(shader.constant(), Some(Premultiplied16([65_280; 4])));
        assert!(shader.opaque && vertex.is_opaque(context.sources), "white is opaque");
        assert!(!Paint::vertex([Rgba::WHITE, Rgba::WHITE, Rgba::TRANSPARENT]).is_opaque(context.sources));
    }
}
