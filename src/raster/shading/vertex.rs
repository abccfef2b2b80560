//! A paint whose colours are interpolated between the corners of a triangle.

use fearless_simd::{Level, dispatch};

use crate::color::{Premultiplied16, Resolver, Rgba, SampleMean, SumBounds};
use crate::geometry::clip::ClipVertex;
use crate::geometry::subpixel::GridPoint;
use crate::raster::attributes::Planes;
use crate::raster::shading::context::{
    BoundedPixels, MaskedPixels, PixelRun, Pixels, PlacedParts, PlacedPixels, ShadeContext, ShadedSample,
};
use crate::raster::shading::interpolated::Attributes;
use crate::raster::shading::kernel::{ONE, first_sample};
use crate::raster::shading::kind::{PaintKind, Shade, at_corner};
use crate::raster::shading::plane_means::PlaneColors;
use crate::raster::shading::sources::PaintSources;
use crate::raster::shading::vertex_kernel::{Bytes, masked_kernel, point_kernel, run_kernel, sum_kernel};
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

    /// Its colours, where they are opaque and rounded to nearest.
    fn plane_colors(&self) -> Option<PlaneColors<'_>> {
        (self.is_opaque && self.rules != Rules::Course).then_some(PlaneColors {
            planes: &self.opaque,
            shade: self,
        })
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

    fn runs(&self, runs: &[PixelRun], grid: SampleGrid, resolver: &Resolver, values: &mut [u32]) -> bool {
        if self.rules == Rules::Course {
            return false;
        }
        let Some(bytes) = Bytes::of(resolver) else {
            return false;
        };
        dispatch!(simd::level(), simd => run_kernel(simd, &self.opaque, grid, bytes, (runs, values)));
        true
    }

    fn placed_pixels(&self, pixels: PlacedPixels<'_>, mean: &SampleMean, values: &mut [u32]) -> bool {
        let colors = self.plane_colors();
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
        self.plane_colors()
            .is_some_and(|colors| colors.bounded(pixels, mean, values, open))
    }

    fn part_bounds<'p>(
        &self,
        parts: impl FnOnce() -> PlacedParts<'p>,
        mean: &SampleMean,
        bounds: &mut [SumBounds],
    ) -> bool {
        let colors = self.plane_colors();
        if let Some(colors) = colors {
            colors.part_bounds(parts(), mean, bounds);
        }
        colors.is_some()
    }

    fn pixel_sums(&self, pixels: Pixels<'_>, sums: &mut [[u32; 4]]) {
        self.opaque_sums(simd::level(), pixels, sums);
    }

    fn masked_sums(&self, pixels: MaskedPixels<'_>, sums: &mut [[u32; 4]]) {
        dispatch!(simd::level(), simd => masked_kernel(simd, &self.opaque, pixels, sums));
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

#[cfg(test)]
mod tests {
    use arbtest::arbitrary::{Result, Unstructured};

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

    /// A random triangle with random opaque colours at its corners, if it has an area.
    fn any_colors(u: &mut Unstructured<'_>, side: u32) -> Result<Option<VertexShader>> {
        let mut corner = || -> Result<GridPoint> {
            let mut at = || u.int_in_range(-2_000_000..=2_000_000);
            Ok(GridPoint { x: at()?, y: at()? })
        };
        let corners = [corner()?, corner()?, corner()?];
        if crate::geometry::edge::doubled_area(corners) == 0 {
            return Ok(None);
        }
        let mut unit = || -> Result<f32> { Ok(f32::from(u.arbitrary::<u8>()?) / 255.0) };
        let mut color = || Ok([unit()?, unit()?, unit()?, 1.0]);
        let planes = Planes::new(SubpixelGrid::new(side), &corners, [color()?, color()?, color()?]);
        Ok(Some(VertexShader::new(planes, true, Rules::Standard)))
    }

    #[test]
    fn runs_are_the_resolved_sums_of_their_pixels() {
        const WIDTH: u16 = 40;
        let mut met = 0;
        arbtest::arbtest(|u| {
            let side = u.int_in_range(1..=16_u8)?;
            let Some(colors) = any_colors(u, side.into())? else {
                return Ok(());
            };
            let grid = SampleGrid {
                side: side.into(),
                origin: [u.int_in_range(-5..=70)?, u.int_in_range(-5..=70)?],
            };
            let resolver = Resolver::new(grid.side * grid.side, Rules::Standard);
            let Some(bytes) = Bytes::of(&resolver) else {
                assert!(
                    !side.is_power_of_two(),
                    "{side} x {side} samples are divided by shifting"
                );
                return Ok(());
            };
            let runs = (0..5)
                .map(|row| {
                    let start = u.int_in_range(0..=WIDTH - 1)?;
                    let end = u.int_in_range(start + 1..=WIDTH)?;
                    Ok(PixelRun { row, start, end })
                })
                .collect::<Result<Vec<_>>>()?;
            let mut expected = Vec::new();
            for place in runs.iter().flat_map(|run| run.places()) {
                let mut sums = [[0; 4]];
                let places = &[place];
                colors.opaque_sums(simd::level(), Pixels { grid, places }, &mut sums);
                expected.push(resolver.pixel(sums[0]));
            }
            met += expected.len();
            for (name, level) in simd::tested() {
                let mut found = vec![7; expected.len()];
                dispatch!(level, simd => run_kernel(simd, &colors.opaque, grid, bytes, (&runs, &mut found)));
                assert_eq!(found, expected, "{name}: {grid:?}, {runs:?}");
            }
            Ok(())
        })
        .budget_ms(300);
        assert!(met > 0, "something was compared");
    }

    #[test]
    fn parts_are_the_plane_at_the_middle_of_their_samples() {
        let mut met = 0;
        arbtest::arbtest(|u| {
            let side = u.int_in_range(1..=16_u8)?;
            let Some(colors) = any_colors(u, side.into())? else {
                return Ok(());
            };
            let grid = SampleGrid {
                side: side.into(),
                origin: [3, -2],
            };
            let count = grid.side * grid.side;
            let first = u.int_in_range(0..=count.saturating_sub(1) / 64)? * 64;
            let bits = u64::MAX >> 64_u32.saturating_sub(count - first);
            let places: Vec<[u16; 2]> = (0..11).map(|i| [i * 3, i % 4]).collect();
            let masks = (0..11)
                .map(|_| Ok(u.arbitrary::<u64>()? & bits))
                .collect::<Result<Vec<_>>>()?;
            let expected: Vec<[u32; 4]> = places
                .iter()
                .zip(&masks)
                .map(|(place, mask)| {
                    let samples: Vec<u32> = (0..64)
                        .filter(|bit| mask >> bit & 1 == 1)
                        .map(|bit| first + bit)
                        .collect();
                    let samples_in = f64::from(u32::try_from(samples.len()).expect("at most 64"));
                    let mean = |of: fn(u32, u32) -> u32| {
                        let total: u32 = samples.iter().map(|sample| of(*sample, grid.side)).sum();
                        f64::from(total) / samples_in.max(1.0)
                    };
                    let inside = [mean(|sample, side| sample % side), mean(|sample, side| sample / side)];
                    let [x, y] = [0, 1]
                        .map(|axis| first_sample(grid)[axis] + f64::from(place[axis]) * f64::from(side) + inside[axis]);
                    let sum = |value: f64| rounded(value * samples_in, ONE * samples_in);
                    let [r, g, b] = colors.opaque.at(x, y).map(sum);
                    [r, g, b, rounded(ONE * samples_in, f64::MAX)]
                })
                .collect();
            for (name, level) in simd::tested() {
                let mut found = vec![[0; 4]; expected.len()];
                let places = &places;
                let pixels = Pixels { grid, places }.masked(&masks, first);
                dispatch!(level, simd => masked_kernel(simd, &colors.opaque, pixels, &mut found));
                assert_eq!(found, expected, "{name}: {grid:?}, {masks:x?} from {first} on");
                met += found.len();
            }
            Ok(())
        })
        .budget_ms(300);
        assert!(met > 0, "something was compared");
    }

    /// A number of `0.0..=limit` (clamped) rounded to a whole one, ties to even.
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "clamped")]
    fn rounded(value: f64, limit: f64) -> u32 {
        value.clamp(0.0, limit).round_ties_even() as u32
    }

    #[test]
    fn sums_are_those_of_the_samples() {
        arbtest::arbtest(|u| {
            let side = u.int_in_range(1..=16_u8)?;
            let Some(colors) = any_colors(u, side.into())? else {
                return Ok(());
            };
            let side = u32::from(side);
            let grid = SampleGrid { side, origin: [3, -2] };
            let pixels: Vec<[u16; 2]> = (0..11).map(|i| [i * 3, i % 4]).collect();
            let pixels_of = |places| Pixels { grid, places };
            let count = side * side;
            let mut of_scalar = Vec::new();
            for (name, level) in simd::tested() {
                let mut sums = vec![[0; 4]; 11];
                colors.opaque_sums(level, pixels_of(&pixels), &mut sums);
                if of_scalar.is_empty() {
                    of_scalar = vec![sums.clone()];
                }
                assert_eq!(sums, of_scalar[0], "{name} gives the bytes of every other level");
            }
            let sums = &of_scalar[0];
            let resolver = Resolver::new(count, Rules::Standard);
            let values: Vec<u32> = sums.iter().map(|sum| resolver.pixel(*sum)).collect();
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
                    assert!(!inside || sums[i][k].abs_diff(exact) <= count, "{colors:?} channel {k}");
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
