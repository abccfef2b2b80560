//! `svg/study`, part four: what a picture does not show of how it was made.

use glam::dvec2;

use super::super::SceneFile;
use super::super::document::{Document, Style};
use super::super::palette::{AMBER, BRICK, CORAL, Color, INK, PAPER, PLUM, SEA, TEAL, WHITE, hex};
use super::super::steady::{TAU, polar};
use super::floor::Floor;
use super::outline::regular;

pub(super) const SCENES: &[SceneFile] = &[
    SceneFile {
        path: "svg/study/16_what_is_painted.svg",
        make: what_is_painted,
    },
    SceneFile {
        path: "svg/study/17_half_the_light.svg",
        make: half_the_light,
    },
];

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

fn half_the_light() -> String {
    const BLACK: Color = hex(0x00_0000);
    let mut doc = Document::new(
        512.0,
        512.0,
        &[
            "What the mean of black and white is: choose Resolve stored or linear, at 4 samples or more (1024 x 1024, default view).",
            "Every pixel of the striped square is half black, half white. Stored, it becomes 128 and matches the square on its left;",
            "in linear light it becomes 188 and matches the one on its right, as the stripes themselves do from afar.",
            "Above, rays as wide as a pixel: in linear light white ones grow bolder and black ones paler: right as light, not always even.",
        ],
    );
    doc.rect(dvec2(0.0, 0.0), dvec2(256.0, 300.0), Style::fill(BLACK));
    doc.rect(dvec2(256.0, 0.0), dvec2(256.0, 512.0), Style::fill(WHITE));
    doc.rect(dvec2(0.0, 300.0), dvec2(256.0, 212.0), Style::fill(WHITE));
    doc.decimals(3);
    for (side, color) in [(0.0, WHITE), (256.0, BLACK)] {
        let hub = dvec2(side + 128.0, 150.0);
        for k in 0..30 {
            let angle = TAU * (f64::from(k) + 0.37) / 30.0;
            let (along, across) = (polar(1.0, angle), polar(0.3, angle + TAU / 4.0));
            let (from, to) = (hub + along * 24.0, hub + along * 116.0);
            doc.polygon(
                &[from - across, to - across, to + across, from + across],
                Style::fill(color),
            );
        }
    }
    // Pixels begin at multiples of 0.6 from the middle.
    let (top, side) = (346.0, 120.0);
    doc.rect(dvec2(76.0, top), dvec2(side, side), Style::fill(hex(0x80_8080)));
    doc.rect(dvec2(316.0, top), dvec2(side, side), Style::fill(hex(0xBC_BCBC)));
    for k in 0..200 {
        let y = top + 0.6 * f64::from(k);
        doc.rect(dvec2(196.0, y), dvec2(side, 0.3), Style::fill(BLACK));
    }
    doc.finish()
}
