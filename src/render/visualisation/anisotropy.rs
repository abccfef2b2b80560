//! How many times as long as wide a pixel's footprint is, as anisotropic filtering measures it.

use glam::DVec2;

use crate::color::Colormap;
use crate::render::Legend;
use crate::render::visualisation::colors::{NO_TEXTURE, logarithmic, rgba, scale, single};
use crate::render::visualisation::show::{Show, Source, Target};
use crate::scene::Scene;
use crate::texture::{Anisotropy, Footprint, MipPyramid, Taps};

pub(super) struct Lengths;

impl Show for Lengths {
    fn meaning(&self) -> &'static str {
        "how many times as long as wide the pixel's footprint is, on a logarithmic scale up to 64"
    }

    fn legend(&self, _: &Scene) -> Option<Legend> {
        let most = Anisotropy::MAX as f32;
        let color = |part: f32| color((part * most.log2()).exp2());
        let ticks = [1_u8, 2, 4, 8, 16, 32, 64].map(|ratio| {
            let more = if u32::from(ratio) == Anisotropy::MAX { "+" } else { "" };
            (logarithmic(f32::from(ratio), most), format!("{ratio}{more}"))
        });
        Some(Legend {
            title: "anisotropy: length of the footprint over its width",
            key: scale(color, ticks),
            others: vec![NO_TEXTURE],
        })
    }

    fn add(&self, source: &Source<'_>, target: Target<'_, '_>, index: usize) {
        source.each_textured(target, index, |builder, triangle| {
            builder.measured_triangle(triangle.points, triangle.uv, &|footprint| {
                rgba(color(single(ratio(footprint, triangle.pyramid))))
            });
        });
    }
}

/// The colour of a footprint that is `ratio` times as long as wide.
fn color(ratio: f32) -> u32 {
    Colormap::Sequential.color(logarithmic(ratio, Anisotropy::MAX as f32))
}

/// The ratio of a footprint's sides in texels, at most [`Anisotropy::MAX`].
fn ratio(footprint: &Footprint, pyramid: &MipPyramid) -> f64 {
    let base = &pyramid.levels()[0];
    let size = DVec2::new(f64::from(base.width()), f64::from(base.height()));
    let most = Anisotropy::STEPS[Anisotropy::STEPS.len() - 1];
    Taps::new(footprint, size, most).ratio
}
