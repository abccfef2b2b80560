//! Texture coordinates: a texture whose texel at `(u, v)` is the colour of `(u, v)`.

use std::sync::LazyLock;

use crate::color::unit_to_byte;
use crate::raster::{self, RasterSettings};
use crate::render::visualisation::colors::{NO_TEXTURE, rgba};
use crate::render::visualisation::show::{Show, Source, Target};
use crate::render::{Legend, LegendKey};
use crate::rules::Rules;
use crate::scene::Scene;
use crate::texture::{Anisotropy, LevelOfDetail, LevelSampling, MipLevel, MipPyramid, PixelSampling, Texture};

/// The colour at `u = 1` and that at `v = 1`; together they are white.
const AXES: [u32; 2] = [0xFFFF_9900, 0xFF00_66FF];

static RAMP: LazyLock<Texture> = LazyLock::new(|| {
    const SIDE: u32 = 256;
    let texels = (0..SIDE * SIDE).map(|i| {
        let part = |index: u32| index as f32 / (SIDE - 1) as f32;
        color(part(i % SIDE), part(i / SIDE))
    });
    let base = MipLevel::new(SIDE, SIDE, texels.collect());
    Texture::new("(u, v)", MipPyramid::build(base))
});

pub(super) struct Uv;

impl Show for Uv {
    fn meaning(&self) -> &'static str {
        "texture coordinates: orange grows with u, blue with v"
    }

    fn legend(&self, _: &Scene) -> Option<Legend> {
        Some(Legend {
            title: "texture coordinates",
            key: LegendKey::Square([(AXES[0], "u = 1"), (AXES[1], "v = 1")]),
            others: vec![NO_TEXTURE],
        })
    }

    fn change(&self, settings: &mut RasterSettings) {
        settings.sampling.pixel = PixelSampling::Nearest;
        settings.sampling.level = LevelSampling::Zero;
        settings.sampling.anisotropy = Anisotropy::OFF;
        settings.sampling.detail = LevelOfDetail::default();
    }

    fn texture(&self) -> Option<&'static Texture> {
        Some(&RAMP)
    }

    fn add(&self, source: &Source<'_>, target: Target<'_, '_>, index: usize) {
        source.each_textured(target, index, |builder, triangle| {
            builder.triangle(triangle.points, &raster::Paint::texture(0, triangle.uv, 1.0));
        });
    }
}

/// The colour of texture coordinates: that of `u` and that of `v` added up.
fn color(u: f32, v: f32) -> [u8; 4] {
    let [along_u, along_v] = AXES.map(rgba);
    let channel = |a: f32, b: f32| unit_to_byte(u * a + v * b, Rules::Standard);
    [
        channel(along_u.r, along_v.r),
        channel(along_u.g, along_v.g),
        channel(along_u.b, along_v.b),
        255,
    ]
}
