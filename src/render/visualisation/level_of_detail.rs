//! The level of detail with which a texture is read, before it is clamped to the levels that exist.

use crate::color::Colormap;
use crate::render::Legend;
use crate::render::visualisation::colors::{NO_TEXTURE, rgba, scale, single};
use crate::render::visualisation::show::{Show, Source, Target};
use crate::scene::Scene;
use crate::texture::Reading;

/// The largest level of detail that has a colour of its own.
const MOST: f32 = 8.0;

pub(super) struct Lod;

impl Show for Lod {
    fn meaning(&self) -> &'static str {
        "the level of detail before it is clamped: blue is magnified, white is one texel per pixel, orange is minified"
    }

    fn legend(&self, _: &Scene) -> Option<Legend> {
        let color = |part: f32| color(MOST * (2.0 * part - 1.0));
        let ticks = [-8_i8, -4, 0, 4, 8].map(|level| {
            let at = (f32::from(level) / MOST).midpoint(1.0);
            (at, level.to_string())
        });
        Some(Legend {
            title: "level of detail: below 0 magnified, above 0 minified",
            key: scale(color, ticks),
            others: vec![NO_TEXTURE],
        })
    }

    fn add(&self, source: &Source<'_>, target: Target<'_, '_>, index: usize) {
        source.each_textured(target, index, |builder, triangle| {
            builder.measured_triangle(triangle.points, triangle.uv, &|footprint| {
                let reading = Reading::new(footprint, triangle.pyramid, &source.sampling);
                rgba(color(single(reading.lod)))
            });
        });
    }
}

/// The colour of a level of detail.
fn color(lod: f32) -> u32 {
    Colormap::Diverging.color(lod / MOST)
}
