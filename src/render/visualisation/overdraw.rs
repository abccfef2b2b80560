//! How many fragments the samples of a pixel receive, on average.

use std::sync::LazyLock;

use crate::color::{Colormap, Premultiplied16, Rgba};
use crate::raster::{ChunkBuilder, RasterSettings};
use crate::render::Legend;
use crate::render::visualisation::colors::{logarithmic, scale};
use crate::render::visualisation::coverage::count;
use crate::render::visualisation::show::{Show, Source, Target, repaint};
use crate::scene::Scene;

/// The largest number of fragments that is counted.
const MOST: u16 = 255 / Premultiplied16::FRAGMENT_BYTES;

/// Counts of eighths of fragments, on a logarithmic scale: `log2(1 + fragments)`.
static PALETTE: LazyLock<[u32; 256]> =
    LazyLock::new(|| std::array::from_fn(|byte| color(byte as f32 / f32::from(Premultiplied16::FRAGMENT_BYTES))));

pub(super) struct Overdraw;

impl Show for Overdraw {
    fn meaning(&self) -> &'static str {
        "fragments per sample, hidden ones too, on a logarithmic scale up to 31: what painting costs; under `--rules course` samples on shared edges count twice, under `float` not at all"
    }

    fn legend(&self, _: &Scene) -> Option<Legend> {
        let most = f32::from(MOST);
        let color = |part: f32| color((part * (most + 1.0).log2()).exp2() - 1.0);
        let ticks = [0, 1, 2, 4, 8, 16, MOST].map(|count| {
            let at = logarithmic(f32::from(count) + 1.0, most + 1.0);
            let more = if count == MOST { "+" } else { "" };
            (at, format!("{count}{more}"))
        });
        Some(Legend {
            title: "overdraw: fragments per sample",
            key: scale(color, ticks),
            others: Vec::new(),
        })
    }

    fn has_outline(&self) -> bool {
        false
    }

    fn change(&self, settings: &mut RasterSettings) {
        count(settings, &PALETTE);
    }

    fn prepare<'b>(&self, builder: ChunkBuilder<'b>) -> ChunkBuilder<'b> {
        builder.with_counts()
    }

    fn add(&self, source: &Source<'_>, target: Target<'_, '_>, index: usize) {
        repaint(target, source.kind(index), Rgba::WHITE);
    }
}

/// The colour of a mean number of fragments, `0.0..=31.0`.
fn color(fragments: f32) -> u32 {
    Colormap::Sequential.color(logarithmic(fragments + 1.0, f32::from(MOST) + 1.0))
}
