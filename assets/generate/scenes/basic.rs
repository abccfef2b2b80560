//! `svg/basic`: one kind of primitive at a time.

use glam::{DVec2, dvec2};

use super::super::SceneFile;
use super::super::chance::{Chance, cell};
use super::super::document::{Document, Style};
use super::super::palette::{
    AMBER, BRICK, CORAL, Color, INK, NIGHT, PAPER, PLUM, SAND, SEA, SKY, TEAL, WHITE, gradient, hue,
};
use super::super::steady::{TAU, exp, polar, turned};
use super::outline::{arc, regular};

pub(super) const SCENES: &[SceneFile] = &[
    SceneFile {
        path: "svg/basic/test1.svg",
        make: points,
    },
    SceneFile {
        path: "svg/basic/test2.svg",
        make: fan,
    },
    SceneFile {
        path: "svg/basic/test3.svg",
        make: leaf,
    },
    SceneFile {
        path: "svg/basic/test4.svg",
        make: compass,
    },
    SceneFile {
        path: "svg/basic/test5.svg",
        make: cube,
    },
    SceneFile {
        path: "svg/basic/test6.svg",
        make: super::locomotive::locomotive,
    },
    SceneFile {
        path: "svg/basic/test7.svg",
        make: wheel,
    },
    SceneFile {
        path: "svg/basic/test8.svg",
        make: diagonal,
    },
];

const MIDDLE: DVec2 = dvec2(500.0, 500.0);

fn points() -> String {
    let mut doc = Document::new(
        1000.0,
        1000.0,
        &[
            "A galaxy of points. A rect without width and height is a point: it fills the pixel it falls in, whatever the zoom.",
            "Turn the wheel: the cloud spreads, no point grows. Press = for more samples: a point fills all samples of its",
            "pixel, so nothing changes. Z puts single points under the magnifier.",
        ],
    );
    doc.decimals(1);
    doc.rect(DVec2::ZERO, dvec2(1000.0, 1000.0), Style::fill(INK));
    let mut chance = Chance::new(7);
    let mut dot = |at: DVec2, color: Color| {
        if at.min_element() > 4.0 && at.max_element() < 996.0 {
            doc.rect(at, DVec2::ZERO, Style::fill(color));
        }
    };
    for _ in 0..420 {
        let at = dvec2(chance.range(0.0, 1000.0), chance.range(0.0, 1000.0));
        let glow = chance.unit();
        dot(at, NIGHT.mix(SKY, glow * glow));
    }
    let tilt = |v: DVec2| MIDDLE + turned(v * dvec2(1.0, 0.7), -0.5);
    for k in 0..4400 {
        let along = 1.0 - 1.0 / (1.0 + 1.6 * chance.unit());
        let sweep = along / 0.615 * 7.4;
        let radius = 62.0 * exp(0.28 * sweep) * (1.0 + 0.075 * chance.normal());
        let angle = sweep + 0.13 * chance.normal() + if k % 2 == 0 { 0.0 } else { TAU / 2.0 };
        let color = gradient(&[PAPER, AMBER, CORAL, SKY, SKY], along / 0.615);
        dot(tilt(polar(radius, angle)), color.mix(NIGHT, 0.35 * chance.unit()));
    }
    for _ in 0..1000 {
        let bulge = dvec2(chance.normal(), chance.normal()) * 44.0;
        dot(
            tilt(bulge * dvec2(1.0, 1.25)),
            gradient(&[WHITE, AMBER], bulge.length() / 120.0),
        );
    }
    doc.finish()
}

fn fan() -> String {
    let mut doc = Document::new(
        1000.0,
        1000.0,
        &[
            "A folding fan of hairlines: each is one pixel wide at every zoom and every sample rate.",
            "Turn the wheel over the pivot and see the lines stay thin; press Z to see the steps: a line that is flatter than",
            "45 degrees has one pixel per column, a steeper one has one per row.",
        ],
    );
    let pivot = dvec2(500.0, 735.0);
    let span = [TAU * 0.545, TAU * 0.955];
    let ribs = 140;
    let mut rim = Vec::new();
    for k in 0..=ribs {
        let t = f64::from(k) / f64::from(ribs);
        let angle = span[0] + (span[1] - span[0]) * t;
        let color = gradient(&[TEAL, INK, PLUM, BRICK, CORAL], t);
        let tip = if k % 4 == 2 {
            478.0
        } else {
            494.0 - 8.0 * f64::from(k % 2)
        };
        let root = if k % 4 == 0 { 40.0 } else { 190.0 };
        doc.line(
            [pivot + polar(root, angle), pivot + polar(tip, angle)],
            Style::stroke(color),
        );
        rim.push(pivot + polar(tip, angle));
    }
    doc.polyline(&rim, Style::stroke(INK));
    for (radius, color) in [
        (190.0, INK),
        (200.0, BRICK),
        (330.0, TEAL),
        (340.0, TEAL),
        (440.0, PLUM),
    ] {
        doc.polyline(&arc(pivot, radius, span, 60), Style::stroke(color));
    }
    doc.polygon(&regular(pivot, 26.0, 24, 0.0), Style::stroke(INK));
    doc.finish()
}

fn leaf() -> String {
    let mut doc = Document::new(
        1000.0,
        1000.0,
        &[
            "One big concave polygon with an outline: it is cut into triangles, and no seam of theirs may show.",
            "Press - and = and watch the edge of the fill go from stairs to smooth, while the outline, a hairline, stays as it is.",
            "Zoom into the notches with the wheel: outline and fill must keep together.",
        ],
    );
    let half = [
        (0.0, 104.0),
        (13.0, 73.0),
        (33.0, 84.0),
        (25.0, 33.0),
        (38.0, 40.0),
        (52.0, 63.0),
        (60.0, 45.0),
        (92.0, 51.0),
        (79.0, 22.0),
        (97.0, 8.0),
        (52.0, -19.0),
        (60.0, -38.0),
        (6.0, -27.0),
        (9.0, -92.0),
    ];
    let right = half.iter().map(|&(x, y)| dvec2(x, y));
    let left = half.iter().rev().map(|&(x, y)| dvec2(-x, y)).filter(|p| p.x < 0.0);
    let place = |p: DVec2| MIDDLE + turned(dvec2(p.x, 8.0 - p.y) * 4.1, 0.16);
    let outline: Vec<DVec2> = right.chain(left).map(place).collect();
    doc.polygon(&outline, Style::fill(CORAL).outlined(INK));
    doc.finish()
}

fn compass() -> String {
    let mut doc = Document::new(
        1000.0,
        1000.0,
        &[
            "Flat triangles, fat ones and slivers. At rate 1 the tips of the slivers break into loose pixels, because no",
            "pixel centre falls inside; press = up to 16 and they come back as ever fainter, unbroken needles.",
            "Z shows the pixels of a tip; turn the picture with [ and ] to see other tips break.",
        ],
    );
    doc.rect(DVec2::ZERO, dvec2(1000.0, 1000.0), Style::fill(PAPER));
    let mut spike = |angle: f64, reach: f64, waist: f64, colors: [Color; 2]| {
        let at = |radius: f64, side: f64| MIDDLE + turned(dvec2(radius, side), angle);
        for (side, color) in [(-1.0, colors[0]), (1.0, colors[1])] {
            doc.polygon(&[MIDDLE, at(waist, side * waist), at(reach, 0.0)], Style::fill(color));
        }
    };
    for k in 0..8 {
        let between = TAU * (f64::from(k) + 0.5) / 8.0;
        spike(between, 300.0, 26.0, [SEA, TEAL]);
    }
    for k in 0..4 {
        spike(TAU * (f64::from(k) + 0.5) / 4.0, 350.0, 58.0, [AMBER, CORAL]);
    }
    for k in 0..4 {
        spike(TAU * f64::from(k) / 4.0, 455.0, 84.0, [NIGHT, INK]);
    }
    // Needles: three units wide at the foot, twenty degrees off the axes so that no tip meets the pixel grid squarely.
    for k in 0..48 {
        let angle = TAU * (f64::from(k) + 0.5) / 48.0;
        let at = |radius: f64, side: f64| MIDDLE + turned(dvec2(radius, side), angle);
        let foot = if k % 3 == 1 { 345.0 } else { 372.0 };
        let color = if k % 3 == 1 { BRICK } else { PLUM };
        doc.polygon(&[at(foot, -2.2), at(foot, 2.2), at(480.0, 0.0)], Style::fill(color));
    }
    doc.finish()
}

fn cube() -> String {
    let mut doc = Document::new(
        1000.0,
        1000.0,
        &[
            "A cube of 75 quads that share their edges. Every pixel on a shared edge belongs to exactly one of them:",
            "no gap shows the dark ground, no edge is drawn twice. Z, then walk along an edge.",
            "Press = to smooth the outside; inside, each pixel of an edge becomes a mixture of its two quads alone.",
        ],
    );
    doc.rect(DVec2::ZERO, dvec2(1000.0, 1000.0), Style::fill(INK));
    let center = dvec2(500.0, 500.0);
    let axes = [
        polar(400.0, TAU / 12.0),
        polar(400.0, TAU * 5.0 / 12.0),
        dvec2(0.0, 400.0),
    ];
    let top = center - dvec2(0.0, 400.0);
    let faces = [
        (top, axes[0], axes[1], AMBER, 0_i64),
        (top + axes[1], axes[0], axes[2], CORAL, 1),
        (top + axes[0], axes[1], axes[2], PLUM, 2),
    ];
    for (corner, a, b, color, face) in faces {
        for i in 0..5_i64 {
            for j in 0..5_i64 {
                let at = |i: i64, j: i64| corner + a * (i as f64 / 5.0) + b * (j as f64 / 5.0);
                let quad = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
                let light = 0.34 * cell(5 + face as u64, i, j) - 0.1 + if (i + j) % 2 == 0 { 0.1 } else { 0.0 };
                doc.polygon(&quad, Style::fill(color.shade(light)));
            }
        }
    }
    doc.finish()
}

fn wheel() -> String {
    let mut doc = Document::new(
        1000.0,
        1000.0,
        &[
            "A colour wheel: colours are given at corners only, barycentric weights mix them in between.",
            "All inner triangles meet in the centre; Z shows that no pixel is missing and none is painted twice.",
            "At rate 1 the rim has stairs; press = to smooth it.",
        ],
    );
    let spokes = 60;
    let at = |k: i32, radius: f64| MIDDLE + polar(radius, TAU * f64::from(k) / f64::from(spokes));
    let tone = |k: i32| hue(f64::from(k) / f64::from(spokes)).mix(SAND, 0.06);
    for k in 0..spokes {
        doc.color_triangle([MIDDLE, at(k, 330.0), at(k + 1, 330.0)], [WHITE, tone(k), tone(k + 1)]);
    }
    for k in 0..spokes {
        let corners = [at(k, 330.0), at(k + 1, 330.0), at(k + 1, 470.0), at(k, 470.0)];
        let dark = |k: i32| tone(k).mix(INK, 0.92);
        doc.color_quad(corners, [tone(k), tone(k + 1), dark(k + 1), dark(k)]);
    }
    doc.finish()
}

fn diagonal() -> String {
    let mut doc = Document::new(
        1000.0,
        1000.0,
        &[
            "Two textured triangles that share a diagonal. Along it the texture must run on without a seam: each cell's name",
            "can be read across. P switches pixel sampling: nearest shows whole texels, bilinear mixes the four around.",
            "Turn the wheel on a label to see the difference; Z reads the colours.",
        ],
    );
    doc.texture("cells", "grid.png");
    let corners = [
        dvec2(210.0, 130.0),
        dvec2(900.0, 250.0),
        dvec2(780.0, 870.0),
        dvec2(100.0, 740.0),
    ];
    let uv = [dvec2(0.0, 0.0), dvec2(1.0, 0.0), dvec2(1.0, 1.0), dvec2(0.0, 1.0)];
    doc.texture_quad("cells", corners, uv);
    doc.finish()
}
