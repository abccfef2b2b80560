//! `svg/study`, part four: what a picture does not show of how it was made.

use glam::dvec2;

use super::super::SceneFile;
use super::super::document::{Document, Style};
use super::super::palette::{AMBER, BRICK, CORAL, INK, PAPER, PLUM, SEA, TEAL};
use super::super::steady::{TAU, polar};
use super::floor::Floor;
use super::outline::regular;

pub(super) const SCENES: &[SceneFile] = &[SceneFile {
    path: "svg/study/16_what_is_painted.svg",
    make: what_is_painted,
}];

fn what_is_painted() -> String {
    let mut doc = Document::new(
        640.0,
        640.0,
        &[
            "Press V: the same shapes, painted with what lies behind their colours; the legend says how to read them.",
            "coverage shows how much of each pixel is painted, and which needles fall between samples: press = there. overdraw finds",
            "twelve discs below the card, which the picture hides, and the veils.",
            "wireframe and primitive tell polygons, which are painted whole, from the wheel's triangles; barycentric shows their corners.",
            "uv, lod, mip and anisotropy speak of the floor: L and T change what they show, and why the far end blurs.",
        ],
    );
    // What a card hides.
    for (column, row) in (0..3).flat_map(|row| (0..4).map(move |column| (column, row))) {
        let middle = dvec2(62.0 + 48.0 * f64::from(column), 60.0 + 48.0 * f64::from(row));
        let color = if (column + row) % 2 == 0 { BRICK } else { INK };
        doc.polygon(&regular(middle, 34.0, 24, 0.0), Style::fill(color));
    }
    doc.raw("<rect id=\"card\" x=\"24\" y=\"24\" width=\"224\" height=\"168\" fill=\"#f7f1e3\"/>");
    // What shines through.
    for (k, color) in [CORAL, AMBER, TEAL].into_iter().enumerate() {
        let middle = dvec2(334.0, 108.0) + polar(34.0, TAU * (k as f64) / 3.0);
        doc.polygon(&regular(middle, 52.0, 48, 0.0), Style::fill(color).opacity(0.5));
    }
    // What falls between samples.
    for k in 0..8 {
        let (tip, side) = (dvec2(616.0, 208.0 + 11.0 * f64::from(k)), dvec2(0.0, 0.8));
        let root = dvec2(24.0, 242.0 + 1.7 * f64::from(k));
        doc.polygon(&[root - side, tip, root + side], Style::fill(PLUM));
    }
    // Corners.
    let (hub, sectors) = (dvec2(520.0, 108.0), 10);
    for k in 0..sectors {
        let rim = |k: u32| hub + polar(92.0, TAU * f64::from(k) / f64::from(sectors));
        doc.color_triangle([hub, rim(k), rim(k + 1)], [PAPER, SEA, CORAL]);
    }
    doc.texture("plan", "plan.png");
    Floor {
        sides: [0.0, 640.0],
        horizon: 316.0,
        bottom: 640.0,
        tile: 1300.0,
        shift: 0.0,
        copies: 4,
        depth: 3.0,
        cells: 2,
    }
    .draw(&mut doc, "plan");
    doc.finish()
}
