//! The part of a pixel's samples that any primitive covers: white on black, as a scale of colours.

use std::sync::LazyLock;

use crate::color::{Colormap, ResolveSpace, Rgba};
use crate::raster::{RasterSettings, Recolor};
use crate::render::Legend;
use crate::render::visualisation::colors::scale;
use crate::render::visualisation::show::{Show, Source, Target, repaint};
use crate::scene::Scene;

/// Covered parts of a pixel.
static PALETTE: LazyLock<[u32; 256]> =
    LazyLock::new(|| std::array::from_fn(|byte| Colormap::Sequential.color(byte as f32 / 255.0)));

pub(super) struct Coverage;

impl Show for Coverage {
    fn meaning(&self) -> &'static str {
        "the part of its samples that any primitive covers, however transparent"
    }

    fn legend(&self, _: &Scene) -> Option<Legend> {
        let labels = ["0", "1/4", "1/2", "3/4", "1"];
        let ticks = (0_u8..)
            .zip(labels)
            .map(|(i, label)| (f32::from(i) / 4.0, label.to_owned()));
        Some(Legend {
            title: "coverage: part of the pixel's samples",
            key: scale(|part| Colormap::Sequential.color(part), ticks),
            others: Vec::new(),
        })
    }

    fn has_outline(&self) -> bool {
        false
    }

    fn change(&self, settings: &mut RasterSettings) {
        count(settings, &PALETTE);
    }

    fn add(&self, source: &Source<'_>, target: Target<'_, '_>, index: usize) {
        repaint(target, source.kind(index), Rgba::WHITE);
    }
}

/// Resolved pixels are numbers on a black ground, each of which a palette gives a colour.
pub(super) fn count(settings: &mut RasterSettings, palette: &'static [u32; 256]) {
    settings.recolor = Some(Recolor::Palette(palette));
    settings.background = Rgba::BLACK;
    settings.space = ResolveSpace::Stored;
}
