//! A paint whose colours are interpolated between the corners of a triangle.

#![expect(
    clippy::inline_always,
    reason = "only what is inlined into a dispatched function is compiled for its vector instructions"
)]

use fearless_simd::{Level, dispatch};

use crate::color::{Premultiplied16, Rgba, SampleMean};
use crate::geometry::clip::ClipVertex;
use crate::geometry::subpixel::GridPoint;
use crate::raster::attributes::Planes;
use crate::raster::shading::context::{MaskedPixels, Pixels, PlacedPixels, ShadeContext, ShadedSample};
use crate::raster::shading::interpolated::Attributes;
use crate::raster::shading::kernel::{ONE, first_sample, rounded};
use crate::raster::shading::kind::{PaintKind, Shade, at_corner, pixels_by_points};
use crate::raster::shading::sources::PaintSources;
use crate::raster::shading::vertex_kernel::{pixel_kernel, point_kernel, sum_kernel};
use crate::raster::shading::vertex_means;
use crate::rules::Rules;
use crate::simd;
use crate::texture::SampleGrid;

/// Straight red, green, blue and alpha at a triangle's corners, `0.0..=1.0`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct VertexPaint([[f32; 4]; 3]);

/// The colours of one triangle.
#[derive(Clone, Copy, Debug)]
pub(super) struct VertexShader {
    /// Straight red, green, blue, alpha in `0.0..=1.0`.
    straight: Planes<4>,
    /// Red, green and blue in units of [`Premultiplied16`].
    opaque: Planes<3>,
    /// Whether all corners are opaque.
    is_opaque: bool,
    rules: Rules,
}

impl VertexPaint {
    pub(super) fn new(colors: [Rgba; 3]) -> Self {
        Self(colors.map(|color| [color.r, color.g, color.b, color.a]))
    }

    fn are_opaque(&self) -> bool {
        self.0.iter().all(|color| color[3] >= 1.0)
    }
}

impl PaintKind for VertexPaint {
    type Shader<'a> = VertexShader;

    fn is_opaque(&self, _: &PaintSources<'_>) -> bool {
        self.are_opaque()
    }

    fn clipped(&self, corners: &[ClipVertex; 3]) -> Self {
        let color = |corner: &ClipVertex| [0, 1, 2, 3].map(|i| at_corner(corner, self.0.map(|color| color[i])));
        Self(corners.each_ref().map(color))
    }

    fn shader(&self, context: &ShadeContext<'_>, corners: &[GridPoint; 3]) -> VertexShader {
        let planes = Planes::new(context.grid, corners, self.0);
        VertexShader::new(planes, self.are_opaque(), context.sampling.rules)
    }
}

impl VertexShader {
    /// From planes through straight colours.
    fn new(straight: Planes<4>, is_opaque: bool, rules: Rules) -> Self {
        let first = |[r, g, b, _]: [f64; 4]| [r, g, b];
        let opaque = Planes {
            pivot: straight.pivot,
            at_pivot: first(straight.at_pivot),
            dx: first(straight.dx),
            dy: first(straight.dy),
        };
        Self {
            straight,
            opaque: opaque.scaled(ONE),
            is_opaque,
            rules,
        }
    }

    /// [`Shade::pixels`] of opaque corners under the standard rules.
    fn opaque_pixels(&self, simd: Level, Pixels { grid, places }: Pixels<'_>, values: &mut [u32]) {
        dispatch!(simd, simd => pixel_kernel(simd, &self.opaque, grid, places, values));
    }

    /// [`Shade::pixel_sums`]; under the same conditions.
    fn opaque_sums(&self, simd: Level, Pixels { grid, places }: Pixels<'_>, sums: &mut [[u32; 4]]) {
        dispatch!(simd, simd => sum_kernel(simd, &self.opaque, grid, places, sums));
    }
}

impl Shade for VertexShader {
    fn points(&self, grid: SampleGrid, points: &[[u16; 2]], colors: &mut [Premultiplied16]) {
        if self.is_opaque && self.rules != Rules::Course {
            return dispatch!(simd::level(), simd => point_kernel(simd, &self.opaque, grid, points, colors));
        }
        let first = first_sample(grid);
        for ([x, y], color) in points.iter().zip(colors) {
            let (x, y) = (first[0] + f64::from(*x), first[1] + f64::from(*y));
            *color = straight_color(self.straight.at(x, y), self.rules);
        }
    }

    fn pixels(&self, pixels: Pixels<'_>, rules: Rules, values: &mut [u32]) {
        if rules == Rules::Course {
            pixels_by_points(self, pixels, rules, values);
        } else {
            self.opaque_pixels(simd::level(), pixels, values);
        }
    }

    fn placed_pixels(&self, pixels: PlacedPixels<'_>, mean: &SampleMean, values: &mut [u32]) -> bool {
        self.is_opaque && self.rules != Rules::Course && vertex_means::means(&self.opaque, pixels, mean, values)
    }

    fn pixel_sums(&self, pixels: Pixels<'_>, sums: &mut [[u32; 4]]) {
        self.opaque_sums(simd::level(), pixels, sums);
    }

    fn masked_sums(&self, pixels: MaskedPixels<'_>, sums: &mut [[u32; 4]]) {
        let MaskedPixels {
            pixels: Pixels { grid, places },
            masks,
            first,
        } = pixels;
        let origin = first_sample(grid);
        let side = f64::from(grid.side);
        for (([x, y], mask), sum) in places.iter().zip(masks).zip(sums) {
            let count = mask.count_ones();
            let (mut right, mut down, mut rest) = (0, 0, *mask);
            while rest != 0 {
                let sample = first + rest.trailing_zeros();
                right += sample % grid.side;
                down += sample / grid.side;
                rest &= rest - 1;
            }
            let mean = |total: u32| f64::from(total) / f64::from(count.max(1));
            let x = origin[0] + f64::from(*x) * side + mean(right);
            let y = origin[1] + f64::from(*y) * side + mean(down);
            *sum = rounded_sum(self.opaque.at(x, y), f64::from(count));
        }
    }

    fn interpolated(&self, sample: ShadedSample) -> Attributes {
        let [x, y] = sample.position();
        Attributes::Color(self.straight.at(x, y))
    }
}

/// An interpolated straight colour as samples store it.
#[inline]
#[expect(clippy::cast_possible_truncation, reason = "colours are 32-bit floats")]
fn straight_color(color: [f64; 4], rules: Rules) -> Premultiplied16 {
    // Rounding may carry an attribute a little beyond the colours at the corners.
    let [r, g, b, a] = color.map(|channel| (channel as f32).clamp(0.0, 1.0));
    Premultiplied16::from_byte_range([r * a * 255.0, g * a * 255.0, b * a * 255.0, a * 255.0], rules)
}

/// `count` times a colour.
#[inline(always)]
fn rounded_sum(color: [f64; 3], count: f64) -> [u32; 4] {
    let limit = ONE * count;
    let [r, g, b] = color;
    [
        rounded(r * count, limit),
        rounded(g * count, limit),
        rounded(b * count, limit),
        rounded(limit, limit),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::subpixel::{GridPoint, SubpixelGrid};

    /// The colours of all samples of a pixel, one by one.
    fn samples(colors: &VertexShader, grid: SampleGrid, [x, y]: [u16; 2]) -> Vec<Premultiplied16> {
        let side = u16::try_from(grid.side).expect("at most 16");
        let points: Vec<[u16; 2]> = (0..side * side)
            .map(|i| [x * side + i % side, y * side + i / side])
            .collect();
        let mut found = vec![Premultiplied16::TRANSPARENT; points.len()];
        colors.points(grid, &points, &mut found);
        found
    }

    #[test]
    fn sums_are_those_of_the_samples() {
        arbtest::arbtest(|u| {
            let side = u.int_in_range(1..=16)?;
            let subpixels = SubpixelGrid::new(side);
            let mut corner = || -> arbtest::arbitrary::Result<GridPoint> {
                let mut at = || u.int_in_range(-2_000_000..=2_000_000);
                Ok(GridPoint { x: at()?, y: at()? })
            };
            let corners = [corner()?, corner()?, corner()?];
            if crate::geometry::edge::doubled_area(corners) == 0 {
                return Ok(());
            }
            let mut unit = || -> arbtest::arbitrary::Result<f32> { Ok(f32::from(u.arbitrary::<u8>()?) / 255.0) };
            let values = [
                [unit()?, unit()?, unit()?, 1.0],
                [unit()?, unit()?, unit()?, 1.0],
                [unit()?, unit()?, unit()?, 1.0],
            ];
            let colors = VertexShader::new(Planes::new(subpixels, &corners, values), true, Rules::Standard);
            let grid = SampleGrid { side, origin: [3, -2] };
            let pixels: Vec<[u16; 2]> = (0..11).map(|i| [i * 3, i % 4]).collect();
            let pixels_of = |places| Pixels { grid, places };
            let count = side * side;
            let mut of_scalar = Vec::new();
            for (name, level) in simd::tested() {
                let (mut sums, mut values) = (vec![[0; 4]; 11], vec![0; 11]);
                colors.opaque_sums(level, pixels_of(&pixels), &mut sums);
                colors.opaque_pixels(level, pixels_of(&pixels), &mut values);
                if of_scalar.is_empty() {
                    of_scalar = vec![(sums.clone(), values.clone())];
                }
                assert_eq!(
                    (sums, values),
                    of_scalar[0],
                    "{name} gives the bytes of every other level"
                );
            }
            let (sums, values) = &of_scalar[0];
            for (i, pixel) in pixels.iter().enumerate() {
                let samples = samples(&colors, grid, *pixel);
                if side == 1 {
                    assert_eq!(
                        values[i],
                        samples[0].to_pixel(Rules::Standard),
                        "one sample is the pixel"
                    );
                }
                let masks = [u64::MAX >> 64_u32.saturating_sub(count)];
                let mut masked = [[0; 4]];
                let pixels = pixels_of(std::slice::from_ref(pixel));
                colors.masked_sums(pixels.masked(&masks, 0), &mut masked);
                for k in 0..4 {
                    let exact: u32 = samples.iter().map(|sample| u32::from(sample.0[k])).sum();
                    // Where the plane leaves the range of colours the mean is clamped, not the samples.
                    let inside = samples.iter().all(|sample| (1..65_280).contains(&sample.0[k])) || k == 3;
                    assert!(
                        !inside || sums[i][k].abs_diff(exact) <= count,
                        "{corners:?} channel {k}"
                    );
                    assert!(
                        count > 64 || masked[0][k].abs_diff(sums[i][k]) <= 1,
                        "all bits are the whole pixel: {masked:?} and {:?}",
                        sums[i]
                    );
                }
            }
            Ok(())
        })
        .budget_ms(300);
    }
}
