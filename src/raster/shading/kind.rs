//! What every kind of paint answers. Only the colours of samples must be told; a paint that knows a shorter way to whole
//! pixels or to sums of samples tells that too.

use crate::color::{Premultiplied16, Resolver, Rgba, SampleMean, SumBounds};
use crate::geometry::clip::ClipVertex;
use crate::geometry::subpixel::GridPoint;
use crate::raster::shading::context::{
    BoundedPixels, MaskedPixels, PixelRun, Pixels, PlacedParts, PlacedPixels, ShadeContext, ShadedSample, Wanted,
};
use crate::raster::shading::interpolated::{Attributes, TextureUse};
use crate::raster::shading::sources::PaintSources;
use crate::rules::Rules;
use crate::texture::SampleGrid;

/// Samples that a mask has bits for.
const MASK_BITS: usize = 64;

/// A kind of paint as a display list holds it.
pub(super) trait PaintKind: Copy {
    /// What gives its colours on one triangle.
    type Shader<'a>: Shade;

    /// The one colour that it has everywhere, if there is one.
    fn constant(&self) -> Option<Rgba> {
        None
    }

    /// Whether every fragment hides what is below it.
    fn is_opaque(&self, sources: &PaintSources<'_>) -> bool;

    /// Whether [`Shade::pixel_sums`] and [`Shade::masked_sums`] are sums of the rounded colours of [`Shade::points`], and not
    /// rounded once at the end.
    fn rounds_each_sample(&self) -> bool {
        false
    }

    /// Whether all samples of a line from left to right get the same colour, for certain.
    fn is_level(&self, _: &ShadeContext<'_>) -> bool {
        false
    }

    /// The same paint on a part of its triangle.
    fn clipped(&self, corners: &[ClipVertex; 3]) -> Self;

    /// Prepares it for the triangle with these corners.
    fn shader<'a>(&self, context: &ShadeContext<'a>, corners: &[GridPoint; 3]) -> Self::Shader<'a>;
}

/// A paint prepared for one triangle. A sample's colour must depend on its own position only.
pub(super) trait Shade {
    /// The one colour that every sample gets, if there is one.
    fn constant(&self) -> Option<Premultiplied16> {
        None
    }

    /// Whether all samples of a line from left to right get the same colour.
    fn is_level(&self) -> bool {
        false
    }

    /// The colours of samples, counted from the first sample of the grid's origin.
    fn points(&self, grid: SampleGrid, points: &[[u16; 2]], colors: &mut [Premultiplied16]);

    /// The values of opaque pixels with one sample each.
    fn pixels(&self, pixels: Pixels<'_>, rules: Rules, values: &mut [u32]) {
        pixels_by_points(self, pixels, rules, values);
    }

    /// The pixels of runs, one after the other, where there is a way that is shorter than their sums; whether there is one. The
    /// triangle must be opaque.
    fn runs(&self, _: &[PixelRun], _: SampleGrid, _: &Resolver, _: &mut [u32]) -> bool {
        false
    }

    /// The pixels that all of their samples make with what is painted over them, where there is a way that is shorter than
    /// [`Shade::points`] of each; whether there is one. The triangle must be opaque.
    fn placed_pixels(&self, _: PlacedPixels<'_>, _: &SampleMean, _: &mut [u32]) -> bool {
        false
    }

    /// What red, green and blue of those samples of each pixel that its mask names add up to, stored or of [`SampleMean::byte_light`],
    /// where there is a way that is shorter than [`Shade::points`] of each; whether there is one. The triangle must be opaque.
    fn placed_sums(&self, _: PlacedPixels<'_>, _: &[u64], _: &SampleMean, _: &mut [[u64; 3]]) -> bool {
        false
    }

    /// Those of the pixels, with what is painted over them, for which it does not matter where exactly their samples lie; the numbers of
    /// all others are added to `open`. `false` where there is no way to know. The triangle must be opaque.
    fn bounded_pixels(&self, _: BoundedPixels<'_>, _: &SampleMean, _: &mut [u32], _: &mut Vec<usize>) -> bool {
        false
    }

    /// Between what the samples of parts of pixels add up to with what is painted over them, where that is told apart by little more
    /// than rounding; whether it is. Only then their samples have to be placed. The triangle must be opaque.
    fn part_bounds<'p>(&self, _: impl FnOnce() -> PlacedParts<'p>, _: &SampleMean, _: &mut [SumBounds]) -> bool
    where
        Self: Sized,
    {
        false
    }

    /// For each of the pixels the sum of all its samples.
    fn pixel_sums(&self, pixels: Pixels<'_>, sums: &mut [[u32; 4]]) {
        sums.fill([0; 4]);
        let count = (pixels.grid.side * pixels.grid.side) as usize;
        let mut part = vec![[0; 4]; sums.len()];
        for first in (0..count).step_by(MASK_BITS) {
            let masks = vec![u64::MAX >> MASK_BITS.saturating_sub(count - first); sums.len()];
            self.masked_sums(pixels.masked(&masks, u32::try_from(first).unwrap_or(0)), &mut part);
            for (sum, part) in sums.iter_mut().zip(&part) {
                *sum = std::array::from_fn(|channel| sum[channel] + part[channel]);
            }
        }
    }

    /// For each of the pixels the sum of some of its samples.
    fn masked_sums(&self, pixels: MaskedPixels<'_>, sums: &mut [[u32; 4]]) {
        masked_sums_by_points(self, pixels, sums);
    }

    /// [`Shade::pixel_sums`] and [`Shade::masked_sums`], where both are wanted. Where there is a shorter way to the means of the
    /// former, these are found instead of their sums; whether they are.
    fn sums_or_means(&self, pixels: Pixels<'_>, parts: MaskedPixels<'_>, wanted: Wanted<'_>) -> bool {
        sums_of_both(self, pixels, parts, wanted)
    }

    /// What is interpolated at a sample, for whoever explains its colour.
    fn interpolated(&self, _: ShadedSample) -> Attributes {
        Attributes::None
    }

    /// How a texture is read, if one is.
    fn texture_use(&self, _: &ShadeContext<'_>) -> Option<TextureUse> {
        None
    }
}

/// [`Shade::pixels`] sample by sample.
pub(super) fn pixels_by_points(shade: &(impl Shade + ?Sized), pixels: Pixels<'_>, rules: Rules, values: &mut [u32]) {
    let mut colors = vec![Premultiplied16::TRANSPARENT; pixels.places.len()];
    shade.points(pixels.grid, pixels.places, &mut colors);
    for (value, color) in values.iter_mut().zip(colors) {
        *value = color.to_pixel(rules);
    }
}

/// [`Shade::sums_or_means`] one after the other.
pub(super) fn sums_of_both(
    shade: &(impl Shade + ?Sized),
    pixels: Pixels<'_>,
    parts: MaskedPixels<'_>,
    Wanted { sums, .. }: Wanted<'_>,
) -> bool {
    let [of_pixels, of_parts] = sums;
    if !pixels.places.is_empty() {
        shade.pixel_sums(pixels, of_pixels);
    }
    if !parts.pixels.places.is_empty() {
        shade.masked_sums(parts, of_parts);
    }
    false
}

/// [`Shade::masked_sums`] sample by sample.
pub(super) fn masked_sums_by_points(shade: &(impl Shade + ?Sized), pixels: MaskedPixels<'_>, sums: &mut [[u32; 4]]) {
    let MaskedPixels { pixels, masks, first } = pixels;
    let side = pixels.grid.side;
    let mut points = Vec::with_capacity(MASK_BITS);
    let mut colors = [Premultiplied16::TRANSPARENT; MASK_BITS];
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
        shade.points(pixels.grid, &points, colors);
        *sum = [0; 4];
        for color in colors {
            for (sum, channel) in sum.iter_mut().zip(color.0) {
                *sum += u32::from(channel);
            }
        }
    }
}

/// A value at a corner of a part of a triangle, from those at the corners of the whole: mixed in 64 bits.
#[expect(clippy::cast_possible_truncation, reason = "attributes are 32-bit floats")]
pub(super) fn at_corner(corner: &ClipVertex, values: [f32; 3]) -> f32 {
    // Relative to the first corner, so that equal values stay equal.
    let first = f64::from(values[0]);
    let [_, second, third] = corner.weights;
    (first + second * (f64::from(values[1]) - first) + third * (f64::from(values[2]) - first)) as f32
}
