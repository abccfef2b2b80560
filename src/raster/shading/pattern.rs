//! A paint that is a picture, over and over.

use glam::DVec2;

use crate::color::{Premultiplied16, unit_to_16};
use crate::geometry::clip::ClipVertex;
use crate::geometry::subpixel::GridPoint;
use crate::raster::shading::context::{ShadeContext, ShadedSample};
use crate::raster::shading::interpolated::Attributes;
use crate::raster::shading::kind::{PaintKind, Shade};
use crate::raster::shading::sources::{PaintSources, PlacedPattern};
use crate::texture::{PixelSampling, SampleGrid};

/// The number of a pattern of the drawing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct PatternPaint(u32);

/// A pattern, ready to be asked.
#[derive(Debug)]
pub(super) struct PatternShader<'a> {
    pattern: &'a PlacedPattern,
    sampling: PixelSampling,
    /// Of [`Premultiplied16::ONE`].
    opacity: u16,
}

impl PatternPaint {
    pub(super) fn new(pattern: u32) -> Self {
        Self(pattern)
    }
}

impl PaintKind for PatternPaint {
    type Shader<'a> = PatternShader<'a>;

    /// What a tile shows is known only once it is drawn, and how pixels are painted must not depend on that.
    fn is_opaque(&self, _: &PaintSources<'_>) -> bool {
        false
    }

    fn clipped(&self, _: &[ClipVertex; 3]) -> Self {
        *self
    }

    fn shader<'a>(&self, context: &ShadeContext<'a>, _: &[GridPoint; 3]) -> PatternShader<'a> {
        let pattern = &context.sources.patterns[self.0 as usize];
        PatternShader {
            pattern,
            sampling: context.sampling.pixel,
            opacity: unit_to_16(pattern.opacity.clamp(0.0, 1.0)),
        }
    }
}

impl PatternShader<'_> {
    #[inline]
    fn color(&self, pixel: DVec2) -> Premultiplied16 {
        let Some(tile) = &self.pattern.tile else {
            return Premultiplied16::TRANSPARENT;
        };
        let color = tile.color(self.pattern.from_pixels.transform_point2(pixel), self.sampling);
        if self.opacity == Premultiplied16::ONE {
            color
        } else {
            color.faded(self.opacity)
        }
    }
}

impl Shade for PatternShader<'_> {
    fn points(&self, grid: SampleGrid, points: &[[u16; 2]], colors: &mut [Premultiplied16]) {
        let side = f64::from(grid.side);
        let origin = DVec2::from(grid.origin.map(f64::from)) * side + 0.5;
        for (point, color) in points.iter().zip(colors) {
            // Halves add up without rounding, so that a sample on the edge of a texel reads the same one from every origin.
            let sample = origin + DVec2::from(point.map(f64::from));
            *color = self.color(sample / side);
        }
    }

    fn interpolated(&self, sample: ShadedSample) -> Attributes {
        let Some(tile) = &self.pattern.tile else {
            return Attributes::None;
        };
        let pixel = DVec2::from(sample.position()) / f64::from(sample.grid.side);
        let read = tile.read(self.pattern.from_pixels.transform_point2(pixel), self.sampling);
        Attributes::Pattern {
            size: tile.size(),
            read,
        }
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use glam::DAffine2;

    use super::*;
    use crate::texture::Tile;

    #[test]
    fn samples_on_the_edge_of_a_texel_read_the_same_from_every_origin() {
        let tile = Tile::new([2, 1], &[0xFFFF_0000, 0xFF00_00FF]).expect("two texels");
        for side in [3, 5, 6, 7] {
            let units = f64::from(side);
            let pattern = PlacedPattern {
                tile: Some(Arc::new(tile.clone())),
                // Every second sample begins a copy, as exactly as numbers can say it.
                from_pixels: DAffine2::from_scale_angle_translation(
                    DVec2::new(units / 2.0, 1.0),
                    0.0,
                    DVec2::new(-0.25, 0.0),
                ),
                opacity: 1.0,
            };
            let shader = PatternShader {
                pattern: &pattern,
                sampling: PixelSampling::Nearest,
                opacity: Premultiplied16::ONE,
            };
            let colors = |origin: i32| {
                let grid = SampleGrid {
                    origin: [origin, 0],
                    side,
                };
                let first = u16::try_from((100 - origin).unsigned_abs() * side).expect("to the right");
                let points: Vec<[u16; 2]> = (first..first + 90).map(|x| [x, 0]).collect();
                let mut colors = vec![Premultiplied16::TRANSPARENT; points.len()];
                shader.points(grid, &points, &mut colors);
                colors
            };
            for origin in [0, 30, 62, 97] {
                assert!(colors(origin) == colors(64), "{side} samples from {origin}");
            }
        }
    }

    #[test]
    fn every_sample_reads_the_tile_where_it_lies() {
        let tile = Tile::new([2, 1], &[0xFFFF_0000, 0xFF00_00FF]).expect("two texels");
        let pattern = PlacedPattern {
            tile: Some(Arc::new(tile)),
            // A copy is four pixels wide.
            from_pixels: DAffine2::from_scale(DVec2::new(0.25, 1.0)),
            opacity: 0.5,
        };
        let shader = PatternShader {
            pattern: &pattern,
            sampling: PixelSampling::Nearest,
            opacity: 32_640,
        };
        let grid = SampleGrid {
            side: 2,
            origin: [4, 0],
        };
        let mut colors = [Premultiplied16::TRANSPARENT; 2];
        shader.points(grid, &[[3, 0], [4, 0]], &mut colors);
        assert_eq!(
            colors[0].0,
            [32_640, 0, 0, 32_640],
            "pixel 5.75 lies in the first half of the second copy"
        );
        assert_eq!(colors[1].0, [0, 0, 32_640, 32_640], "pixel 6.25 in the second one");
    }
}
