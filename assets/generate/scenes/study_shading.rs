//! `svg/study`, part five: what computing one colour for all samples of a pixel saves, and what it costs.
//!
//! Canvas 512: at the default view of a 1024 x 1024 picture one pixel is exactly 0.6 units.

use glam::{DVec2, dvec2};

use super::super::SceneFile;
use super::super::document::{Document, Style};
use super::super::palette::{AMBER, CORAL, INK, NIGHT, PAPER, SEA, hue};
use super::super::steady::{TAU, polar};

pub(super) const SCENES: &[SceneFile] = &[
    SceneFile {
        path: "svg/study/23_one_colour_a_pixel.svg",
        make: one_colour_a_pixel,
    },
    SceneFile {
        path: "svg/study/24_what_one_colour_misses.svg",
        make: what_one_colour_misses,
    },
];

const SIDE: f64 = 512.0;
/// One pixel at the default view of a 1024 x 1024 picture.
const PIXEL: f64 = 0.6;

fn one_colour_a_pixel() -> String {
    let mut doc = Document::new(
        SIDE,
        SIDE,
        &[
            "Petals whose colours change slowly: all that aliases are their edges (1024 x 1024, default view, 16 samples: = three times).",
            "Set Shading to centre: each petal has one colour per pixel instead of sixteen, and hardly a pixel changes. This is",
            "multisampling. Coverage is still decided at all samples, so edges stay smooth; only what is inside costs less.",
            "centroid differs at the edges alone. A pin on one tells where its petal is shaded, and which samples that is for.",
        ],
    );
    doc.rect(DVec2::ZERO, dvec2(SIDE, SIDE), Style::fill(NIGHT));
    let middle = dvec2(256.0, 256.0);
    let petals = 28;
    for (ring, radius) in [(0, 236.0), (1, 168.0), (2, 100.0)] {
        for k in 0..petals {
            let turn = (f64::from(k) + 0.5 * f64::from(ring) + 0.21) / f64::from(petals);
            let (along, across) = (polar(radius, TAU * turn), polar(radius * 0.075, TAU * (turn + 0.25)));
            let (root, tip, widest) = (middle + along * 0.3, middle + along, middle + along * 0.72);
            let color = hue(turn + 0.12 * f64::from(ring));
            let [dark, light] = [color.shade(-0.45), color.shade(0.35)];
            doc.color_triangle([root, widest + across, widest - across], [dark, color, color]);
            doc.color_triangle([tip, widest - across, widest + across], [light, color, color]);
        }
    }
    doc.finish()
}

fn what_one_colour_misses() -> String {
    let mut doc = Document::new(
        SIDE,
        SIDE,
        &[
            "What one colour per pixel misses (1024 x 1024, default view, 16 samples: = three times; then Shading centre in the panel).",
            "Sails: their edges stay smooth, and the squares inside tangle as with one sample per pixel. Only more colours help, or a",
            "mip level (L), which averages before.",
            "Slats: a pixel wide, dark on one side. Where the centre of a pixel lies beside a slat its colour is extrapolated, too bright",
            "or too dark, and the edges get beads. centroid shades inside the slat, and they go.",
        ],
    );
    doc.rect(DVec2::ZERO, dvec2(SIDE, SIDE), Style::fill(INK));
    doc.texture("checker", "checker.png");
    for k in 0..4 {
        let left = 22.0 + 120.0 * f64::from(k);
        let lean = 7.0 * f64::from(k);
        let [foot, heel] = [dvec2(left, 262.0), dvec2(left + 108.0, 250.0 - lean)];
        let top = dvec2(left + 86.0 - lean, 20.0);
        let uv = |point: DVec2| (point - dvec2(left, 20.0)) / 250.0;
        doc.texture_triangle("checker", [foot, heel, top], [foot, heel, top].map(uv));
    }
    doc.decimals(3);
    for k in 0..24 {
        let (below, lean) = (290.0 + 8.6 * f64::from(k), 1.1 * (f64::from(k) - 11.5) + 0.37);
        let (from, to) = (dvec2(24.0, below - lean), dvec2(488.0, below + lean));
        let side = (to - from).normalize().perp() * PIXEL;
        let [dark, bright] = [INK, [AMBER, CORAL, SEA, PAPER][k as usize % 4]];
        doc.color_quad([from, to, to + side, from + side], [bright, bright, dark, dark]);
    }
    doc.finish()
}
