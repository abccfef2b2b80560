//! `svg/hardcore`: legal documents that break careless rasterizers.
//!
//! Canvas 512 where pixels count: at the default view of a 1024 x 1024 picture one pixel is exactly 0.6 units.

use std::fmt::Write as _;

use glam::{DVec2, dvec2};

use super::super::SceneFile;
use super::super::document::{Document, Style};
use super::super::palette::{AMBER, BRICK, CORAL, Color, INK, NIGHT, PAPER, PLUM, SAND, SEA, SLATE, TEAL, gradient};
use super::super::steady::{TAU, polar};
use super::outline::{arc, rectangle, regular, star};

pub(super) const SCENES: &[SceneFile] = &[
    SceneFile {
        path: "svg/hardcore/01_degenerate_square1.svg",
        make: slices_of_a_pixel,
    },
    SceneFile {
        path: "svg/hardcore/02_degenerate_square2.svg",
        make: slices_of_a_tenth,
    },
    SceneFile {
        path: "svg/hardcore/03_concave.svg",
        make: concave,
    },
    SceneFile {
        path: "svg/hardcore/04_repeated_points.svg",
        make: repeated_points,
    },
    SceneFile {
        path: "svg/hardcore/05_far_away.svg",
        make: far_away,
    },
    SceneFile {
        path: "svg/hardcore/06_t_junctions.svg",
        make: t_junctions,
    },
    SceneFile {
        path: "svg/hardcore/07_needles.svg",
        make: needles,
    },
];

const SIDE: f64 = 512.0;
/// One pixel at the default view of a 1024 x 1024 picture.
const PIXEL: f64 = 0.6;

fn slices_of_a_pixel() -> String {
    let mut doc = Document::new(
        SIDE,
        SIDE,
        &[
            "1708 triangles from one corner; where they reach the far sides each is one pixel wide (1024 x 1024, default view).",
            "Towards the corner they get ever thinner, and at rate 1 chance decides which one a pixel centre hits: moire.",
            "Press = : the wings calm down to the mean of both colours. Space, wheel, Z: look at the corner itself.",
        ],
    );
    let count = (SIDE / PIXEL).ceil();
    let mut k = 0.0;
    while k < count {
        let (from, to) = (k * PIXEL, ((k + 1.0) * PIXEL).min(SIDE));
        let light = gradient(&[CORAL, AMBER, SAND], k / count);
        let dark = gradient(&[PLUM, NIGHT, INK], k / count);
        let (first, second) = if k % 2.0 == 0.0 { (light, dark) } else { (dark, light) };
        doc.polygon(&[DVec2::ZERO, dvec2(SIDE, from), dvec2(SIDE, to)], Style::fill(first));
        doc.polygon(&[DVec2::ZERO, dvec2(from, SIDE), dvec2(to, SIDE)], Style::fill(second));
        k += 1.0;
    }
    doc.finish()
}

fn slices_of_a_tenth() -> String {
    let mut doc = Document::new(
        SIDE,
        SIDE,
        &[
            "8534 triangles from one corner, a tenth of a pixel wide at the far side (1024 x 1024, default view), over",
            "a flat triangle in the mean of their two colours. At rate 1 the upper half is a carpet of moire; the more samples",
            "(press =), the more it looks like the lower half. Together they fill the square: no white pixel may show.",
        ],
    );
    let colors = [TEAL, SAND];
    doc.polygon(
        &[DVec2::ZERO, dvec2(SIDE, SIDE), dvec2(0.0, SIDE)],
        Style::fill(colors[0].mix(colors[1], 0.5)),
    );
    let step = PIXEL / 10.0;
    let count = (SIDE / step).ceil() as usize;
    for k in 0..count {
        let (from, to) = (k as f64 * step, ((k + 1) as f64 * step).min(SIDE));
        doc.polygon(
            &[DVec2::ZERO, dvec2(SIDE, from), dvec2(SIDE, to)],
            Style::fill(colors[k % 2]),
        );
    }
    doc.finish()
}

fn concave() -> String {
    let mut doc = Document::new(
        900.0,
        600.0,
        &[
            "Polygons that are hard to cut into triangles: a spiral, a comb, a ring closed by a slit, triangles that touch in",
            "a point, a star that crosses itself, a stair with every corner on one line. No hole, no hair, no seam may show;",
            "the slit of the ring is two edges on top of each other. Wheel and Z: look at the touching points.",
        ],
    );
    let tiles = [SAND, PAPER, SAND, PAPER, SAND, PAPER];
    for (k, color) in tiles.iter().enumerate() {
        let corner = dvec2(300.0 * (k % 3) as f64, 300.0 * (k / 3) as f64);
        doc.rect(corner, dvec2(300.0, 300.0), Style::fill(*color));
    }
    let spiral = |turn: f64, width: f64| dvec2(150.0, 150.0) + polar(12.0 + 16.5 * turn + width, TAU * turn);
    let mut points: Vec<DVec2> = (0..=180).map(|k| spiral(f64::from(k) / 26.0, 0.0)).collect();
    points.extend((0..=180).rev().map(|k| spiral(f64::from(k) / 26.0, 9.5)));
    doc.polygon(&points, Style::fill(TEAL));
    doc.open("transform=\"translate(300 0)\"");
    let mut comb = vec![dvec2(30.0, 262.0), dvec2(30.0, 205.0)];
    for k in 0..12 {
        let x = 30.0 + 20.0 * f64::from(k);
        comb.extend([
            dvec2(x + 1.0, 205.0),
            dvec2(x + 10.0, 34.0 + 9.0 * f64::from(k % 3)),
            dvec2(x + 19.0, 205.0),
        ]);
    }
    comb.extend([dvec2(270.0, 205.0), dvec2(270.0, 262.0)]);
    doc.polygon(&comb, Style::fill(PLUM));
    doc.close();
    doc.open("transform=\"translate(600 0)\"");
    let mut ring = arc(dvec2(150.0, 150.0), 120.0, [0.0, TAU], 64);
    ring.extend(arc(dvec2(150.0, 150.0), 66.0, [TAU, 0.0], 32));
    doc.polygon(&ring, Style::fill(CORAL));
    doc.close();
    doc.open("transform=\"translate(0 300)\"");
    let touching = [
        (30.0, 40.0),
        (150.0, 150.0),
        (270.0, 40.0),
        (270.0, 150.0),
        (150.0, 150.0),
        (270.0, 260.0),
        (150.0, 260.0),
        (150.0, 150.0),
        (30.0, 260.0),
        (30.0, 150.0),
        (150.0, 150.0),
        (30.0, 150.0),
    ];
    doc.polygon(&touching.map(|(x, y)| dvec2(x, y)), Style::fill(AMBER));
    doc.close();
    doc.open("transform=\"translate(300 300)\"");
    let tips = regular(dvec2(150.0, 150.0), 125.0, 7, -TAU / 4.0);
    let crossing: Vec<DVec2> = (0..7).map(|k| tips[k * 3 % 7]).collect();
    doc.polygon(&crossing, Style::fill(BRICK));
    doc.close();
    doc.open("transform=\"translate(600 300)\"");
    let mut stair = vec![dvec2(30.0, 270.0)];
    for k in 0..12 {
        let t = 20.0 * f64::from(k);
        stair.extend([dvec2(30.0 + t, 250.0 - t), dvec2(50.0 + t, 250.0 - t)]);
    }
    stair.push(dvec2(270.0, 270.0));
    doc.polygon(&stair, Style::fill(SLATE));
    doc.close();
    doc.finish()
}

fn repeated_points() -> String {
    let mut doc = Document::new(
        800.0,
        800.0,
        &[
            "Above, clean polygons. Below, the same with points repeated, with points in the middle of straight edges, and",
            "with whiskers that run out and back on one line. Both rows must look alike: put Z on a tip and on its twin below.",
            "Between the rows stand polygons without area: of one point, of two, of many on a line. They draw nothing.",
        ],
    );
    doc.rect(DVec2::ZERO, dvec2(800.0, 800.0), Style::fill(NIGHT));
    let shapes: [(Vec<DVec2>, Color); 3] = [
        (star(dvec2(150.0, 200.0), [118.0, 50.0], 6), AMBER),
        (regular(dvec2(400.0, 200.0), 112.0, 5, -TAU / 4.0), CORAL),
        (star(dvec2(650.0, 200.0), [118.0, 82.0], 12), SEA),
    ];
    for (points, color) in &shapes {
        doc.polygon(points, Style::fill(*color));
    }
    doc.open("transform=\"translate(0 400)\"");
    for (points, color) in &shapes {
        let mut cruel = Vec::new();
        for (k, &from) in points.iter().enumerate() {
            let to = points[(k + 1) % points.len()];
            let middle = (from + to) * 0.5;
            cruel.extend(vec![from; 1 + k % 4]);
            cruel.extend([from, (from + middle) * 0.5, middle, middle]);
            // A whisker: back along the edge and out again.
            cruel.extend([(from + middle) * 0.5, middle]);
        }
        doc.polygon(&cruel, Style::fill(*color));
    }
    doc.close();
    doc.polygon(&[dvec2(400.0, 400.0)], Style::fill(PAPER));
    doc.polygon(&[dvec2(100.0, 395.0), dvec2(700.0, 405.0)], Style::fill(PAPER));
    let line: Vec<DVec2> = (0..40).map(|k| dvec2(f64::from(k * 17 % 40) * 20.0, 400.0)).collect();
    doc.polygon(&line, Style::fill(PAPER));
    doc.finish()
}

fn far_away() -> String {
    let mut doc = Document::new(
        1000.0,
        1000.0,
        &[
            "A sunset whose rays end at 1e30: far beyond the window, yet each has to be clipped, not wrapped and not dropped.",
            "The sea is a rect of 2e30 by 1e30, and the hairlines cross all of it. It must draw at once.",
            "Turn with [ and ], zoom out with the wheel: the rays go on for ever, up to any zoom.",
        ],
    );
    let rays = 32;
    let sun = "500,610";
    for k in 0..rays {
        // A ray as wide as its gap; corners as the document would have them, in exponents.
        let corner = |k: f64| {
            let v = polar(1.0, TAU * (k + 0.5) / f64::from(rays));
            format!("{:.6}e30,{:.6}e30", v.x, v.y)
        };
        let [r, g, b] = [AMBER.mix(SAND, 0.55), CORAL.mix(AMBER, 0.45)][k as usize % 2].bytes();
        let (from, to) = (corner(f64::from(k)), corner(f64::from(k) + 1.0));
        doc.raw(&format!(
            "<polygon points=\"{sun} {from} {to}\" fill=\"#{r:02X}{g:02X}{b:02X}\"/>"
        ));
    }
    doc.polygon(
        &regular(dvec2(500.0, 610.0), 170.0, 72, 0.0),
        Style::fill(BRICK.mix(CORAL, 0.5)),
    );
    doc.raw("<rect x=\"-1e30\" y=\"640\" width=\"2e30\" height=\"1e30\" fill=\"#22405A\"/>");
    for k in 0..9 {
        let y = 648 + 6 * k + 4 * k * k;
        let mut line = String::new();
        let _ = write!(
            line,
            "<line x1=\"-1e30\" y1=\"{y}\" x2=\"1e30\" y2=\"{y}\" stroke=\"#F2A541\"/>"
        );
        doc.raw(&line);
    }
    doc.raw("<polygon points=\"500,640 410,1e30 590,1e30\" fill=\"#E8634A\" fill-opacity=\"0.35\"/>");
    doc.polygon(
        &[(300.0, 655.0), (372.0, 655.0), (356.0, 676.0), (316.0, 676.0)].map(|(x, y)| dvec2(x, y)),
        Style::fill(INK),
    );
    doc.polygon(
        &[(330.0, 650.0), (330.0, 540.0), (388.0, 642.0)].map(|(x, y)| dvec2(x, y)),
        Style::fill(PAPER),
    );
    doc.polygon(
        &[(324.0, 650.0), (324.0, 562.0), (292.0, 642.0)].map(|(x, y)| dvec2(x, y)),
        Style::fill(SAND),
    );
    doc.finish()
}

fn t_junctions() -> String {
    let mut doc = Document::new(
        1000.0,
        560.0,
        &[
            "Two walls of bricks in a single colour, laid on a glowing ground: wherever bricks part, the ground shines through.",
            "Left, edges are level and upright, and corners of one course stand on edges of the next: no spark at any rate or zoom.",
            "Right, the wall is turned: a corner can't lie exactly on a slanted edge, so a rare spark at high rates is honest. Z finds it.",
        ],
    );
    doc.rect(DVec2::ZERO, dvec2(1000.0, 560.0), Style::fill(INK));
    for (place, turn) in [(260.0, 0.0), (740.0, 17.0)] {
        doc.open(&format!("transform=\"translate({place} 280) rotate({turn})\""));
        for (half, color) in [(196.0, SLATE), (188.0, INK), (169.0, hot())] {
            doc.rect(DVec2::splat(-half), DVec2::splat(2.0 * half), Style::fill(color));
        }
        let mut y = -171.3;
        let mut row = 0;
        while y < 171.0 {
            let height = 6.7 + 4.1 * f64::from(row % 3);
            let mut x = -171.0 - 7.3 * f64::from(row % 5);
            let mut column = 0;
            while x < 171.0 {
                let width = 17.1 + 5.9 * f64::from((column * 7 + row * 3) % 4);
                let inside = |x: f64, y: f64| dvec2(x, y).clamp(DVec2::splat(-170.0), DVec2::splat(170.0));
                let (from, to) = (inside(x, y), inside(x + width, y + height));
                doc.polygon(&rectangle(from, to), Style::fill(TEAL));
                x += width;
                column += 1;
            }
            y += height;
            row += 1;
        }
        doc.close();
    }
    doc.finish()
}

fn hot() -> Color {
    AMBER.mix(PAPER, 0.3)
}

fn needles() -> String {
    let mut doc = Document::new(
        1000.0,
        1000.0,
        &[
            "One polygon of 2400 corners: 1200 needles, each a pixel wide at the foot and nothing at the tip.",
            "At rate 1 the tips dissolve into dust and rings; press = up to 64 and the dust becomes a soft halo.",
            "A star inside it has 600 corners more. Both must be cut into triangles at once, without delay.",
        ],
    );
    let middle = dvec2(500.0, 500.0);
    doc.rect(DVec2::ZERO, dvec2(1000.0, 1000.0), Style::fill(INK));
    doc.polygon(&star(middle, [485.0, 215.0], 1200), Style::fill(AMBER));
    doc.polygon(&star(middle, [300.0, 120.0], 300), Style::fill(CORAL));
    doc.polygon(&star(middle, [180.0, 60.0], 48), Style::fill(PAPER));
    doc.polygon(&star(middle, [70.0, 20.0], 12), Style::fill(PLUM));
    doc.finish()
}
