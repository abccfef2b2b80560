//! A paint whose colour is found on a ramp, at every sample.
//!
//! There is no table: each sample asks the gradient's geometry for its place and mixes the two stops around it.

#![expect(
    clippy::inline_always,
    reason = "only what is inlined into a dispatched function is compiled for its vector instructions"
)]

use fearless_simd::prelude::*;
use fearless_simd::{Level, Simd, dispatch, f64x8, u64x8};
use glam::{DAffine2, DVec2};

use crate::color::{Premultiplied16, Ramp, Resolver, SampleMean, Stretch, SumBounds};
use crate::geometry::PlacedShape;
use crate::geometry::clip::ClipVertex;
use crate::geometry::subpixel::GridPoint;
use crate::raster::sampling::positions::Position;
use crate::raster::shading::context::{
    BoundedPixels, PixelRun, Pixels, PlacedParts, PlacedPixels, ShadeContext, ShadedSample,
};
use crate::raster::shading::gradient_means::LineColors;
use crate::raster::shading::interpolated::Attributes;
use crate::raster::shading::kernel::{LANES, ONE, WHOLE, first_sample, low_word, places_of};
use crate::raster::shading::kind::{PaintKind, Shade};
use crate::raster::shading::sources::{PaintSources, PlacedGradient};
use crate::rules::Rules;
use crate::simd;
use crate::texture::SampleGrid;

/// The number of a gradient of the drawing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct GradientPaint(u32);

/// A gradient, ready to be asked at samples.
#[derive(Debug)]
pub(super) struct GradientShader<'a> {
    shape: PlacedShape,
    ramp: &'a Ramp,
    /// Whether every sample has a place on the ramp.
    everywhere: bool,
    rules: Rules,
}

impl GradientPaint {
    pub(super) fn new(gradient: u32) -> Self {
        Self(gradient)
    }

    /// The gradient, which no triangle changes.
    fn in_frame<'a>(self, context: &ShadeContext<'a>) -> GradientShader<'a> {
        let gradient = &context.sources.gradients[self.0 as usize];
        GradientShader::new(gradient, context.grid.side(), context.sampling.rules)
    }
}

impl PaintKind for GradientPaint {
    type Shader<'a> = GradientShader<'a>;

    fn is_opaque(&self, sources: &PaintSources<'_>) -> bool {
        sources.gradients[self.0 as usize].is_opaque()
    }

    fn rounds_each_sample(&self) -> bool {
        true
    }

    fn is_level(&self, context: &ShadeContext<'_>) -> bool {
        self.in_frame(context).is_level()
    }

    fn clipped(&self, _: &[ClipVertex; 3]) -> Self {
        *self
    }

    fn shader<'a>(&self, context: &ShadeContext<'a>, _: &[GridPoint; 3]) -> GradientShader<'a> {
        self.in_frame(context)
    }
}

impl<'a> GradientShader<'a> {
    /// For frames with `side` samples along the side of a pixel.
    pub(super) fn new(gradient: &PlacedGradient<'a>, side: i32, rules: Rules) -> Self {
        let to_pixels = DAffine2::from_scale(DVec2::splat(f64::from(side).recip()));
        GradientShader {
            shape: gradient.geometry.placed(gradient.from_pixels * to_pixels),
            ramp: gradient.ramp,
            everywhere: gradient.geometry.is_everywhere(),
            rules,
        }
    }

    /// Its colours along a line, where they are opaque and rounded to nearest.
    pub(super) fn line_colors(&self) -> Option<LineColors<'_>> {
        match self.shape {
            PlacedShape::Linear { right, down, start } if self.rules != Rules::Course && self.ramp.is_opaque() => {
                Some(LineColors {
                    ramp: self.ramp,
                    place: [right, down, start],
                    shade: self,
                })
            }
            _ => None,
        }
    }

    fn colors(&self, simd: Level, grid: SampleGrid, points: &[[u16; 2]], colors: &mut [Premultiplied16]) {
        dispatch!(simd, simd => kernel(simd, self, grid, points, colors));
    }

    fn sums(&self, simd: Level, pixels: Pixels<'_>, sums: &mut [[u32; 4]]) {
        dispatch!(simd, simd => sums_kernel(simd, self, pixels, sums));
    }

    /// Colours from their levels, as they lie in memory.
    #[inline(always)]
    fn rounded<S: Simd>(&self, levels: [f64x8<S>; 4]) -> u64x8<S> {
        let [mut r, mut g, mut b, mut a] = levels;
        if self.rules == Rules::Course {
            r = truncated(r);
            g = truncated(g);
            b = truncated(b);
            a = truncated(a);
        }
        whole(r) | whole(g) << 16 | whole(b) << 32 | whole(a) << 48
    }

    /// The colours of eight samples, which all lie on one stretch of the ramp mostly; `stretch` is the one of those before.
    #[inline(always)]
    fn eight<S: Simd>(&self, simd: S, places: [f64x8<S>; 2], stretch: &mut Stretch) -> u64x8<S> {
        let places = self.shape.places(simd, places);
        let at = self.ramp.spread().fold(places);
        let mut done = stretch.holds(at);
        let mut colors = self.rounded(stretch.levels(at));
        if !done.all_true() {
            let each = <[f64; LANES]>::from(at);
            while !done.all_true() {
                let next = (!done).to_bitmask().trailing_zeros() as usize;
                *stretch = self.ramp.stretch(each[next]);
                let held = stretch.holds(at);
                colors = held.select(self.rounded(stretch.levels(at)), colors);
                done |= held;
            }
        }
        if self.everywhere {
            colors
        } else {
            places.simd_eq(places).select(colors, u64x8::splat(simd, 0))
        }
    }
}

/// Levels cut to bytes. Those of a stop are whole but for the rounding of 32-bit floats, which must not cost a byte.
#[inline(always)]
fn truncated<S: Simd>(levels: f64x8<S>) -> f64x8<S> {
    let per_byte = f64::from(Premultiplied16::PER_BYTE);
    ((levels + 1.0 / 64.0) * per_byte.recip()).floor() * per_byte
}

/// Whole numbers of `0..=65280` nearest to `levels`.
#[inline(always)]
fn whole<S: Simd>(levels: f64x8<S>) -> u64x8<S> {
    // Rounding may have carried a level a little beyond the ends.
    let inside = levels
        .max(f64x8::splat(levels.simd, 0.0))
        .min(f64x8::splat(levels.simd, ONE));
    (inside + WHOLE).bitcast::<u64x8<S>>() & 0xFFFF
}

/// The colours of samples.
#[inline(always)]
fn kernel<S: Simd>(
    simd: S,
    shader: &GradientShader<'_>,
    grid: SampleGrid,
    points: &[[u16; 2]],
    colors: &mut [Premultiplied16],
) {
    let mut stretch = shader.ramp.stretch(0.0);
    for (points, colors) in points.chunks(LANES).zip(colors.chunks_mut(LANES)) {
        let places = places_of(simd, grid, points);
        let found = <[u64; LANES]>::from(shader.eight(simd, places, &mut stretch));
        for (color, found) in colors.iter_mut().zip(found) {
            *color = Premultiplied16::from_word(found);
        }
    }
}

/// Eight samples: where they lie in their pixel, in samples, and all bits of those that count.
type Group<S> = ([f64x8<S>; 2], u64x8<S>);

/// The samples of a pixel in groups; if they are fewer than eight, one group of as many pixels as it holds.
#[inline(always)]
fn groups<S: Simd>(simd: S, side: u32) -> Vec<Group<S>> {
    let count = side * side;
    let group = |start: u32| {
        let (mut inside, mut counts) = ([[0.0; LANES]; 2], [0; LANES]);
        for (sample, lane) in (start..).zip(0..LANES) {
            inside[0][lane] = f64::from(sample % count % side);
            inside[1][lane] = f64::from(sample % count / side);
            counts[lane] = if start == 0 || sample < count { u64::MAX } else { 0 };
        }
        let inside = inside.map(|inside| f64x8::simd_from(simd, inside));
        (inside, u64x8::simd_from(simd, counts))
    };
    (0..count).step_by(LANES).map(group).collect()
}

/// For each lane one coordinate of the corner of its pixel, where so many lanes belong to one.
#[inline(always)]
fn corners<S: Simd>(simd: S, places: &[[u16; 2]], lanes: usize, corner: impl Fn(&[u16; 2]) -> f64) -> f64x8<S> {
    if let [place] = places {
        return f64x8::splat(simd, corner(place));
    }
    // What is left over repeats the last one.
    let mut corners = [corner(&places[places.len() - 1]); LANES];
    for (corners, place) in corners.chunks_mut(lanes).zip(places) {
        corners.fill(corner(place));
    }
    f64x8::simd_from(simd, corners)
}

/// The sums of all samples of pixels.
#[inline(always)]
fn sums_kernel<S: Simd>(simd: S, shader: &GradientShader<'_>, pixels: Pixels<'_>, sums: &mut [[u32; 4]]) {
    const EVERY_OTHER: u64 = 0x0000_FFFF_0000_FFFF;
    let side = pixels.grid.side;
    let first = first_sample(pixels.grid);
    let groups = groups(simd, side);
    // So many lanes of a group belong to one pixel.
    let lanes = ((side * side) as usize).min(LANES);
    let together = LANES / lanes;
    let mut stretch = shader.ramp.stretch(0.0);
    for (places, sums) in pixels.places.chunks(together).zip(sums.chunks_mut(together)) {
        // Written out: closures in `map` may stay calls here.
        let corner = [
            corners(simd, places, lanes, |place| {
                first[0] + f64::from(u32::from(place[0]) * side)
            }),
            corners(simd, places, lanes, |place| {
                first[1] + f64::from(u32::from(place[1]) * side)
            }),
        ];
        let (mut red_blue, mut green_alpha) = (u64x8::splat(simd, 0), u64x8::splat(simd, 0));
        for ([right, down], counts) in &groups {
            let found = shader.eight(simd, [corner[0] + *right, corner[1] + *down], &mut stretch) & *counts;
            red_blue += found & EVERY_OTHER;
            green_alpha += (found >> 16) & EVERY_OTHER;
        }
        let (red_blue, green_alpha) = (<[u64; LANES]>::from(red_blue), <[u64; LANES]>::from(green_alpha));
        for (i, sum) in sums.iter_mut().enumerate() {
            let of_pixel = i * lanes..(i + 1) * lanes;
            // Sums of a pixel's samples fit 32 bits, so that nothing carries over.
            let red_blue: u64 = red_blue[of_pixel.clone()].iter().sum();
            let green_alpha: u64 = green_alpha[of_pixel].iter().sum();
            *sum = [
                low_word(red_blue),
                low_word(green_alpha),
                low_word(red_blue >> 32),
                low_word(green_alpha >> 32),
            ];
        }
    }
}

impl Shade for GradientShader<'_> {
    fn points(&self, grid: SampleGrid, points: &[[u16; 2]], colors: &mut [Premultiplied16]) {
        self.colors(simd::level(), grid, points, colors);
    }

    fn is_level(&self) -> bool {
        self.shape.is_level()
    }

    fn runs(&self, runs: &[PixelRun], grid: SampleGrid, resolver: &Resolver, values: &mut [u32]) -> bool {
        // One pixel of a line is enough where they are all alike.
        let Some(colors) = self.line_colors().filter(|_| !self.is_level()) else {
            return false;
        };
        let places = PixelRun::all_places(runs);
        let at = |i: u32| u8::try_from(i).unwrap_or(u8::MAX);
        let rows = 0..grid.side;
        let inside: Vec<Position> = rows
            .flat_map(|row| (0..grid.side).map(move |column| [at(column), at(row)]))
            .collect();
        let placed = PlacedPixels {
            pixels: Pixels { grid, places: &places },
            count: inside.len(),
            inside: &inside,
            tints: &[],
        };
        colors.means(placed, &SampleMean::Stored(*resolver), values);
        true
    }

    fn placed_pixels(&self, pixels: PlacedPixels<'_>, mean: &SampleMean, values: &mut [u32]) -> bool {
        let colors = self.line_colors();
        if let Some(colors) = colors {
            colors.means(pixels, mean, values);
        }
        colors.is_some()
    }

    fn bounded_pixels(
        &self,
        pixels: BoundedPixels<'_>,
        mean: &SampleMean,
        values: &mut [u32],
        open: &mut Vec<usize>,
    ) -> bool {
        self.line_colors()
            .is_some_and(|colors| colors.bounded(pixels, mean, values, open))
    }

    fn part_bounds<'p>(
        &self,
        parts: impl FnOnce() -> PlacedParts<'p>,
        mean: &SampleMean,
        bounds: &mut [SumBounds],
    ) -> bool {
        let colors = self.line_colors();
        if let Some(colors) = colors {
            colors.part_bounds(parts(), mean, bounds);
        }
        colors.is_some()
    }

    fn pixel_sums(&self, pixels: Pixels<'_>, sums: &mut [[u32; 4]]) {
        self.sums(simd::level(), pixels, sums);
    }

    fn interpolated(&self, sample: ShadedSample) -> Attributes {
        let place = self.shape.place(DVec2::from(sample.position()));
        if place.is_nan() && !self.everywhere {
            return Attributes::OffRamp;
        }
        Attributes::Gradient {
            place,
            mix: self.ramp.mix(place),
        }
    }
}

#[cfg(test)]
mod tests {
    use glam::DAffine2;

    use super::*;
    use crate::color::{Ramp, Rgba, Spread, Stop};
    use crate::geometry::GradientShape;

    type Found<T> = arbtest::arbitrary::Result<T>;

    fn stop(offset: f32, color: Rgba) -> Stop {
        Stop { offset, color }
    }

    #[test]
    fn every_sample_has_the_colour_of_its_own_place() {
        let ramp = Ramp::new(vec![stop(0.0, Rgba::BLACK), stop(1.0, Rgba::WHITE)], Spread::Pad).expect("two stops");
        let gradient = PlacedGradient {
            geometry: GradientShape::Linear {
                from: DVec2::ZERO,
                to: DVec2::X,
            },
            ramp: &ramp,
            // Sixteen pixels are the whole ramp.
            from_pixels: DAffine2::from_scale(DVec2::splat(1.0 / 16.0)),
        };
        let shader = GradientShader::new(&gradient, 4, Rules::Standard);
        let grid = SampleGrid {
            side: 4,
            origin: [8, 3],
        };
        let mut colors = [Premultiplied16::TRANSPARENT; 2];
        shader.points(grid, &[[0, 0], [5, 3]], &mut colors);
        for (color, pixel) in colors.iter().zip([8.125, 9.375]) {
            let expected = (pixel / 16.0 * f64::from(Premultiplied16::ONE)).round();
            assert!((f64::from(color.0[0]) - expected).abs() <= 1.0, "{color:?} at {pixel}");
            assert!(color.is_opaque());
        }
    }

    #[test]
    fn sums_of_pixels_are_those_of_their_samples() {
        let ramp = Ramp::new(vec![stop(0.1, Rgba::BLACK), stop(0.8, Rgba::WHITE)], Spread::Reflect).expect("two stops");
        for (side, to, is_level) in [
            (4, DVec2::Y, true),
            (4, DVec2::new(1.0, 0.3), false),
            (16, DVec2::Y, true),
            (1, DVec2::new(1.0, 0.3), false),
            (2, DVec2::new(1.0, 0.3), false),
            (3, DVec2::new(1.0, 0.3), false),
        ] {
            let gradient = PlacedGradient {
                geometry: GradientShape::Linear { from: DVec2::ZERO, to },
                ramp: &ramp,
                from_pixels: DAffine2::from_scale(DVec2::splat(1.0 / 7.0)),
            };
            let shader = GradientShader::new(&gradient, side, Rules::Standard);
            assert_eq!(shader.is_level(), is_level, "{to}");
            let grid = SampleGrid {
                side: side.cast_unsigned(),
                origin: [8 * side, 3 * side],
            };
            let places: Vec<_> = (0..300_u16).map(|i| [i % 23, i / 46]).collect();
            let pixels = Pixels { grid, places: &places };
            let mut sums = vec![[0; 4]; places.len()];
            shader.pixel_sums(pixels, &mut sums);
            for (name, level) in simd::tested() {
                let mut found = vec![[0; 4]; places.len()];
                shader.sums(level, pixels, &mut found);
                assert_eq!(found, sums, "{name} gives the sums of every other level");
            }
            let count = usize::try_from(side * side).expect("a small number");
            for (place, sum) in places.iter().zip(sums) {
                let side = u16::try_from(side).expect("a small number");
                let sample = |i: u16| [place[0] * side + i % side, place[1] * side + i / side];
                let points: Vec<_> = (0..side * side).map(sample).collect();
                let mut colors = vec![Premultiplied16::TRANSPARENT; count];
                shader.points(grid, &points, &mut colors);
                let expected: [u32; 4] =
                    std::array::from_fn(|i| colors.iter().map(|color| u32::from(color.0[i])).sum());
                assert_eq!(sum, expected, "{place:?} along {to}, {side} x {side}");
            }
        }
    }

    #[test]
    fn a_cone_is_transparent_where_it_has_no_circle() {
        let white = Stop {
            offset: 0.0,
            color: Rgba::WHITE,
        };
        let ramp = Ramp::new(vec![white], Spread::Pad).expect("a stop");
        let cone = PlacedGradient {
            geometry: GradientShape::Radial {
                center: DVec2::new(20.0, 0.0),
                radius: 5.0,
                focus: DVec2::ZERO,
                focal_radius: 0.0,
            },
            ramp: &ramp,
            from_pixels: DAffine2::IDENTITY,
        };
        assert!(!cone.is_opaque(), "it lets something through somewhere");
        let shader = GradientShader::new(&cone, 1, Rules::Standard);
        let grid = SampleGrid {
            side: 1,
            origin: [-10, 0],
        };
        let mut colors = [Premultiplied16::TRANSPARENT; 2];
        shader.points(grid, &[[0, 0], [29, 0]], &mut colors);
        assert_eq!(colors[0], Premultiplied16::TRANSPARENT, "behind its tip");
        assert!(colors[1].is_opaque(), "inside");
    }
    /// Any gradient: circles in any position, hard edges, half-transparent stops, all spreads.
    fn any_gradient<'r>(u: &mut arbtest::arbitrary::Unstructured<'_>, ramp: &'r Ramp) -> Found<PlacedGradient<'r>> {
        let mut at = || -> Found<f64> { Ok(f64::from(u.int_in_range(-64..=64)?) / 2.0) };
        let mut point = || -> Found<DVec2> { Ok(DVec2::new(at()?, at()?)) };
        let (first, second, turned) = (point()?, point()?, point()? / 32.0);
        let [radius, focal_radius] = [at()?.abs(), at()?.abs().min(8.0)];
        let linear = u.ratio(1, 3)?;
        Ok(PlacedGradient {
            geometry: if linear {
                GradientShape::Linear {
                    from: first,
                    to: second,
                }
            } else {
                GradientShape::Radial {
                    center: first,
                    radius,
                    focus: second,
                    focal_radius,
                }
            },
            ramp,
            from_pixels: DAffine2::from_cols(turned, turned.perp(), DVec2::ONE),
        })
    }

    #[test]
    fn samples_have_the_colour_that_is_told_of_them_at_every_level() {
        arbtest::arbtest(|u| {
            let stops = (0..u.int_in_range(1..=5)?)
                .map(|_| {
                    let offset = f32::from(u.int_in_range(0..=4_u8)?) / 4.0;
                    let [r, g, b, a] = u.arbitrary()?;
                    let alpha = if u.ratio(1, 2)? { a } else { 255 };
                    Ok(stop(offset, Rgba::from_bytes([r, g, b, alpha])))
                })
                .collect::<Found<_>>()?;
            let spread = *u.choose(&[Spread::Pad, Spread::Reflect, Spread::Repeat])?;
            let ramp = Ramp::new(stops, spread).expect("a stop");
            let gradient = any_gradient(u, &ramp)?;
            let shader = GradientShader::new(&gradient, 4, Rules::Standard);
            let grid = SampleGrid {
                side: 4,
                origin: [-3, 5],
            };
            let points: Vec<[u16; 2]> = (0..21).map(|i| [i * 7 % 32, i]).collect();
            let mut first = None;
            for (name, level) in simd::tested() {
                let mut colors = vec![Premultiplied16::TRANSPARENT; points.len()];
                shader.colors(level, grid, &points, &mut colors);
                let first = first.get_or_insert_with(|| colors.clone());
                assert_eq!(*first, colors, "{name} gives the colours of every other level");
            }
            for (point, color) in points.iter().zip(first.expect("some level")) {
                let told = shader.interpolated(ShadedSample { grid, place: *point });
                let expected = match told {
                    Attributes::Gradient { mix, .. } => Premultiplied16::from_straight(mix.color, Rules::Standard),
                    _ => Premultiplied16::TRANSPARENT,
                };
                let near = color.0.iter().zip(expected.0).all(|(a, b)| a.abs_diff(b) <= 1);
                assert!(near, "{gradient:?} at {point:?}: {color:?}, told {told:?}");
                assert!(!gradient.is_opaque() || color.is_opaque(), "{gradient:?} at {point:?}");
            }
            Ok(())
        })
        .budget_ms(400);
    }
}
