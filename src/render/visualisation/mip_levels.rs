//! Which mip levels are read: the picture with a tint for each level.

use crate::color::Rgba;
use crate::render::visualisation::colors::{NO_TEXTURE, mix, pixel, shade_of};
use crate::render::visualisation::show::{Show, Source, Target};
use crate::render::{Legend, LegendKey};
use crate::scene::{Paint, PrimitiveKind, Scene};
use crate::texture::Reading;

/// How opaque the tint is.
const TINT: f32 = 0.7;

/// Mip levels from 0 on: the colours of Okabe and Ito.
const LEVELS: [u32; 8] = [
    0xFF00_72B2,
    0xFF56_B4E9,
    0xFF00_9E73,
    0xFFF0_E442,
    0xFFE6_9F00,
    0xFFD5_5E00,
    0xFFCC_79A7,
    0xFF00_0000,
];

pub(super) struct MipLevels;

impl Show for MipLevels {
    fn meaning(&self) -> &'static str {
        "the mip levels that are read: a tint for each over the picture, mixed where levels are"
    }

    fn legend(&self, scene: &Scene) -> Option<Legend> {
        Some(Legend {
            title: "mip levels that are read",
            key: LegendKey::Swatches(swatches(scene)),
            others: vec![NO_TEXTURE],
        })
    }

    fn add(&self, source: &Source<'_>, target: Target<'_, '_>, index: usize) {
        source.each_textured(target, index, |builder, triangle| {
            builder.triangle(triangle.points, &triangle.paint);
            builder.untold(|builder| {
                builder.measured_triangle(triangle.points, triangle.uv, &|footprint| {
                    let levels = Reading::new(footprint, triangle.pyramid, &source.sampling).levels;
                    let (finer, coarser) = (color(levels.level), color(levels.level + 1));
                    let a = TINT;
                    Rgba {
                        a,
                        ..mix(finer, coarser, levels.next_weight)
                    }
                });
            });
        });
    }
}

/// The colour of a mip level.
fn color(level: usize) -> Rgba {
    shade_of(&LEVELS, level)
}

/// The levels that the scene's textures have.
fn swatches(scene: &Scene) -> Vec<(u32, String)> {
    let used = scene.primitives.iter().filter_map(|primitive| match primitive.kind {
        PrimitiveKind::Triangle {
            paint: Paint::Texture { texture, .. },
            ..
        } => Some(texture.0 as usize),
        _ => None,
    });
    let last = used.map(|texture| scene.textures[texture].pyramid.last_level()).max();
    let levels = last.map_or(0..0, |last| 0..last + 1);
    levels.map(|level| (pixel(color(level)), level.to_string())).collect()
}
