//! A paint of one colour.

use crate::color::{Premultiplied16, Rgba};
use crate::geometry::clip::ClipVertex;
use crate::geometry::subpixel::GridPoint;
use crate::raster::shading::context::{Pixels, ShadeContext};
use crate::raster::shading::kind::{PaintKind, Shade};
use crate::raster::shading::sources::PaintSources;
use crate::rules::Rules;
use crate::texture::SampleGrid;

/// One straight colour.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct SolidPaint(Rgba);

/// The colour as samples store it.
#[derive(Debug)]
pub(super) struct SolidShader(pub(super) Premultiplied16);

impl SolidPaint {
    pub(super) fn new(color: Rgba) -> Self {
        Self(color)
    }
}

impl PaintKind for SolidPaint {
    type Shader<'a> = SolidShader;

    fn constant(&self) -> Option<Rgba> {
        Some(self.0)
    }

    fn is_opaque(&self, _: &PaintSources<'_>) -> bool {
        self.0.a >= 1.0
    }

    fn clipped(&self, _: &[ClipVertex; 3]) -> Self {
        *self
    }

    fn shader(&self, context: &ShadeContext<'_>, _: &[GridPoint; 3]) -> SolidShader {
        SolidShader(Premultiplied16::from_straight(self.0, context.sampling.rules))
    }
}

impl Shade for SolidShader {
    fn constant(&self) -> Option<Premultiplied16> {
        Some(self.0)
    }

    fn points(&self, _: SampleGrid, _: &[[u16; 2]], colors: &mut [Premultiplied16]) {
        colors.fill(self.0);
    }

    fn pixels(&self, _: Pixels<'_>, rules: Rules, values: &mut [u32]) {
        values.fill(self.0.to_pixel(rules));
    }
}
