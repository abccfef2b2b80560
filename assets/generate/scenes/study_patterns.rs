//! `svg/study`, part three: what the place of samples inside their pixels does to edges and lines.
//!
//! Canvas 512: at the default view of a 1024 x 1024 picture one pixel is exactly 0.6 units.

use glam::{DVec2, dvec2};

use super::super::SceneFile;
use super::super::document::{Document, Style};
use super::super::palette::{BRICK, INK, NIGHT, PAPER, PLUM, SAND, TEAL};
use super::super::steady::{TAU, polar};

pub(super) const SCENES: &[SceneFile] = &[
    SceneFile {
        path: "svg/study/13_thin_rays.svg",
        make: thin_rays,
    },
    SceneFile {
        path: "svg/study/14_one_edge.svg",
        make: one_edge,
    },
    SceneFile {
        path: "svg/study/15_upright_bars.svg",
        make: upright_bars,
    },
];

const SIDE: f64 = 512.0;
/// One pixel at the default view of a 1024 x 1024 picture.
const PIXEL: f64 = 0.6;
const MIDDLE: DVec2 = dvec2(256.0, 256.0);

fn thin_rays() -> String {
    let mut doc = Document::new(
        SIDE,
        SIDE,
        &[
            "Rays a quarter of a pixel wide (1024 x 1024, default view), almost level or almost upright. On the grid they break into",
            "dashes: for a long way a ray falls between the rows of samples, then for a while each pixel hits it.",
            "Press A for jittered: each pixel looks elsewhere, so dashes become grain, and a step back every ray is evenly grey.",
            "With blue-noise that grain is the finest: what one pixel has too much, its neighbours have too little.",
            "Press = : all get better. From 4 samples on, the rotated grid is better still: it has a row for every sample.",
        ],
    );
    doc.rect(DVec2::ZERO, dvec2(SIDE, SIDE), Style::fill(PAPER));
    doc.decimals(3);
    for (bundle, k) in (0..4).flat_map(|bundle| (0..17).map(move |k| (bundle, k))) {
        // No ray is quite level or upright.
        let degrees = f64::from(bundle * 90) + (f64::from(k) - 8.0 + 0.37) * 0.4;
        let angle = TAU * degrees / 360.0;
        let (along, across) = (polar(1.0, angle), polar(0.125 * PIXEL, angle + TAU / 4.0));
        let (from, to) = (MIDDLE + along * 90.0, MIDDLE + along * 248.0);
        let ray = [from - across, to - across, to + across, from + across];
        doc.polygon(&ray, Style::fill(if k % 4 == 0 { BRICK } else { INK }));
    }
    doc.finish()
}

fn one_edge() -> String {
    let mut doc = Document::new(
        SIDE,
        SIDE,
        &[
            "One edge that leans by a little more than a pixel over its height (1024 x 1024, default view). It is made of stairs: every",
            "six pixels one of 1/128 of a pixel. At 4 samples the grid has 3 shades for it, at 16 it has 5: its samples stand in columns,",
            "and the edge passes n of them at a time. Press A: the rotated grid, halton and r2 have a column for every sample, which",
            "makes 5 shades at 4 and 17 at 16. Z on the edge counts the colours shown. For a level edge the same holds of rows.",
        ],
    );
    doc.rect(DVec2::ZERO, dvec2(SIDE, SIDE), Style::fill(NIGHT));
    doc.decimals(4);
    let stairs = 132;
    let mut edge = vec![dvec2(0.0, 16.0)];
    for stair in 0..=stairs {
        let x = 256.0 + PIXEL * (f64::from(stairs / 2 - stair) + 0.37) / 128.0;
        let top = 256.0 + PIXEL * f64::from(6 * (stair - stairs / 2));
        edge.extend([dvec2(x, top), dvec2(x, top + 6.0 * PIXEL)]);
    }
    edge.extend([dvec2(0.0, 496.0)]);
    // The outermost stairs reach as far as the sides.
    edge[1].y = 16.0;
    let last = edge.len() - 2;
    edge[last].y = 496.0;
    doc.polygon(&edge, Style::fill(SAND));
    doc.finish()
}

fn upright_bars() -> String {
    let mut doc = Document::new(
        SIDE,
        SIDE,
        &[
            "Bars that stand upright or lie level, a plan or a window frame. Along such an edge every pixel of the grid sees the same,",
            "so edges are straight lines of one shade at every rate.",
            "Press A for jittered: every edge turns ragged, at rate 1 by a whole pixel; blue-noise only frays it more evenly. From 4 samples",
            "on the numbers no longer mind, but the eye does. With jittered-same edges are straight again.",
        ],
    );
    doc.rect(DVec2::ZERO, dvec2(SIDE, SIDE), Style::fill(PAPER));
    doc.decimals(3);
    for k in 0..24 {
        let k = f64::from(k);
        // No two edges stand at the same place inside their pixels.
        let at = 24.0 + 19.37 * k;
        doc.rect(dvec2(at, 24.0), dvec2(3.1 * PIXEL, 220.0), Style::fill(TEAL));
        doc.rect(
            dvec2(24.0, 268.0 + 9.13 * k),
            dvec2(464.0, 3.1 * PIXEL),
            Style::fill(PLUM),
        );
    }
    doc.finish()
}
