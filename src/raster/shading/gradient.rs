//! A paint whose colour is found on a ramp, at every sample.
//!
//! There is no table: each sample asks the gradient's geometry for its place and mixes the two stops around it.

use glam::DVec2;

use crate::color::Premultiplied16;
use crate::geometry::clip::ClipVertex;
use crate::geometry::subpixel::GridPoint;
use crate::raster::shading::context::{ShadeContext, ShadedSample};
use crate::raster::shading::interpolated::Attributes;
use crate::raster::shading::kind::{PaintKind, Shade};
use crate::raster::shading::sources::{PaintSources, PlacedGradient};
use crate::rules::Rules;
use crate::texture::SampleGrid;

/// The number of a gradient of the drawing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct GradientPaint(u32);

/// A gradient, ready to be asked.
#[derive(Debug)]
pub(super) struct GradientShader<'a> {
    gradient: &'a PlacedGradient<'a>,
    rules: Rules,
}

impl GradientPaint {
    pub(super) fn new(gradient: u32) -> Self {
        Self(gradient)
    }
}

impl PaintKind for GradientPaint {
    type Shader<'a> = GradientShader<'a>;

    fn is_opaque(&self, sources: &PaintSources<'_>) -> bool {
        sources.gradients[self.0 as usize].is_opaque()
    }

    fn clipped(&self, _: &[ClipVertex; 3]) -> Self {
        *self
    }

    fn shader<'a>(&self, context: &ShadeContext<'a>, _: &[GridPoint; 3]) -> GradientShader<'a> {
        GradientShader {
            gradient: &context.sources.gradients[self.0 as usize],
            rules: context.sampling.rules,
        }
    }
}

impl GradientShader<'_> {
    #[inline]
    fn color(&self, pixel: DVec2) -> Premultiplied16 {
        let Some(t) = self.gradient.at(pixel) else {
            return Premultiplied16::TRANSPARENT;
        };
        let color = self.gradient.ramp.color(t);
        let alpha = color.a * 255.0;
        Premultiplied16::from_byte_range([color.r * alpha, color.g * alpha, color.b * alpha, alpha], self.rules)
    }
}

impl Shade for GradientShader<'_> {
    fn points(&self, grid: SampleGrid, points: &[[u16; 2]], colors: &mut [Premultiplied16]) {
        let origin = DVec2::from(grid.origin.map(f64::from));
        let side = f64::from(grid.side);
        for (point, color) in points.iter().zip(colors) {
            let inside = DVec2::from(point.map(f64::from)) + 0.5;
            *color = self.color(origin + inside / side);
        }
    }

    fn interpolated(&self, sample: ShadedSample) -> Attributes {
        let pixel = DVec2::from(sample.position()) / f64::from(sample.grid.side);
        match self.gradient.mix(pixel) {
            Some((place, mix)) => Attributes::Gradient { place, mix },
            None => Attributes::None,
        }
    }
}

#[cfg(test)]
mod tests {
    use glam::DAffine2;

    use super::*;
    use crate::color::{Ramp, Rgba, Spread, Stop};
    use crate::geometry::GradientShape;

    #[test]
    fn every_sample_has_the_colour_of_its_own_place() {
        let stop = |offset, color| Stop { offset, color };
        let ramp = Ramp::new(vec![stop(0.0, Rgba::BLACK), stop(1.0, Rgba::WHITE)], Spread::Pad).expect("two stops");
        let shader = GradientShader {
            gradient: &PlacedGradient {
                geometry: GradientShape::Linear {
                    from: DVec2::ZERO,
                    to: DVec2::X,
                },
                ramp: &ramp,
                // Sixteen pixels are the whole ramp.
                from_pixels: DAffine2::from_scale(DVec2::splat(1.0 / 16.0)),
            },
            rules: Rules::Standard,
        };
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
        let shader = GradientShader {
            gradient: &cone,
            rules: Rules::Standard,
        };
        assert_eq!(
            shader.color(DVec2::new(-9.0, 0.0)),
            Premultiplied16::TRANSPARENT,
            "behind its tip"
        );
        assert!(shader.color(DVec2::new(20.0, 0.0)).is_opaque(), "inside");
    }
}
