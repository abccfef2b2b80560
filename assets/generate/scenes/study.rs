//! `svg/study`, part one: what sampling does to edges, lines and patterns.
//!
//! Canvas 512 where pixels count: at the default view of a 1024 x 1024 picture one pixel is exactly 0.6 units.

use glam::{DVec2, dvec2};

use super::super::SceneFile;
use super::super::chance::cell;
use super::super::document::{Document, Style};
use super::super::palette::{
    AMBER, BRICK, CORAL, Color, INK, NIGHT, PAPER, PLUM, SAND, SEA, SKY, SLATE, TEAL, gradient,
};
use super::super::steady::{TAU, polar};
use super::outline::{rectangle, regular};

pub(super) const SCENES: &[SceneFile] = &[
    SceneFile {
        path: "svg/study/01_zone_plate.svg",
        make: zone_plate,
    },
    SceneFile {
        path: "svg/study/02_siemens_star.svg",
        make: siemens_star,
    },
    SceneFile {
        path: "svg/study/03_edge_fan.svg",
        make: edge_fan,
    },
    SceneFile {
        path: "svg/study/04_picket_fence.svg",
        make: picket_fence,
    },
    SceneFile {
        path: "svg/study/05_seams.svg",
        make: seams,
    },
    SceneFile {
        path: "svg/study/10_pixel_centres.svg",
        make: pixel_centres,
    },
];

const SIDE: f64 = 512.0;
/// One pixel at the default view of a 1024 x 1024 picture.
const PIXEL: f64 = 0.6;
const MIDDLE: DVec2 = dvec2(256.0, 256.0);

fn zone_plate() -> String {
    let mut doc = Document::new(
        SIDE,
        SIDE,
        &[
            "A zone plate of 300 rings: the farther out, the finer. True are only the rings around the centre; all others",
            "are aliases, frequencies that one sample per pixel can't tell from lower ones.",
            "Press = : at 4 samples the ghosts move outwards and pale, at 16 little is left of them. Zoom: ghosts swim, true rings grow.",
        ],
    );
    doc.rect(DVec2::ZERO, dvec2(SIDE, SIDE), Style::fill(PAPER));
    let rings = 300;
    for k in (1..=rings).rev() {
        let share = f64::from(k) / f64::from(rings);
        let color = if k % 2 == 0 {
            gradient(&[NIGHT, NIGHT, TEAL], share)
        } else {
            PAPER
        };
        doc.polygon(&regular(MIDDLE, 250.0 * share.sqrt(), 60, 0.0), Style::fill(color));
    }
    doc.finish()
}

fn siemens_star() -> String {
    let mut doc = Document::new(
        SIDE,
        SIDE,
        &[
            "A Siemens star: 144 spokes that get as thin as you like towards the centre.",
            "Where two spokes share a pixel, rate 1 makes flowers that aren't there; press = and they shrink towards a grey disc.",
            "[ and ] turn the star: the flowers jump, the grey disc stays. Z on the axes shows the pixel grid at work.",
        ],
    );
    doc.rect(DVec2::ZERO, dvec2(SIDE, SIDE), Style::fill(PAPER));
    for k in 0..144 {
        let angle = |k: f64| TAU * (k + 0.3) / 288.0;
        let (from, to) = (angle(2.0 * f64::from(k)), angle(2.0 * f64::from(k) + 1.0));
        let color = if k % 12 == 0 { CORAL } else { INK };
        doc.polygon(
            &[MIDDLE, MIDDLE + polar(246.0, from), MIDDLE + polar(246.0, to)],
            Style::fill(color),
        );
    }
    doc.finish()
}

fn edge_fan() -> String {
    let mut doc = Document::new(
        SIDE,
        SIDE,
        &[
            "Edges that are almost level and almost upright: each bar climbs half a pixel more than the one before it.",
            "At rate 1 each climb is a few hard steps far apart. Press = : at 4 samples each step splits in two, at 16 in four.",
            "Z on a step: between both colours most pixels of the grid of n x n samples have one of n - 1: it is passed row by row.",
        ],
    );
    doc.rect(DVec2::ZERO, dvec2(SIDE, SIDE), Style::fill(NIGHT));
    let bars = 20;
    for k in 0..bars {
        let t = f64::from(k) / f64::from(bars - 1);
        let rise = PIXEL * 0.5 * f64::from(k + 1);
        let color = gradient(&[AMBER, CORAL, PLUM.mix(SKY, 0.35)], t);
        let y = 26.3 + 12.1 * f64::from(k);
        let (left, right) = (20.0, 492.0);
        doc.polygon(
            &[
                dvec2(left, y),
                dvec2(right, y - rise),
                dvec2(right, y + 6.0 - rise),
                dvec2(left, y + 6.0),
            ],
            Style::fill(color),
        );
    }
    for k in 0..38 {
        let t = f64::from(k) / 37.0;
        let lean = PIXEL * 0.5 * f64::from(k + 1);
        let x = 20.3 + 12.1 * f64::from(k);
        let color = gradient(&[SEA, TEAL.mix(SKY, 0.3), SKY], t);
        doc.polygon(
            &[
                dvec2(x + lean, 276.0),
                dvec2(x + 6.0 + lean, 276.0),
                dvec2(x + 6.0, 492.0),
                dvec2(x, 492.0),
            ],
            Style::fill(color),
        );
    }
    doc.finish()
}

fn picket_fence() -> String {
    let mut doc = Document::new(
        SIDE,
        SIDE,
        &[
            "Picket fences. Above, one that runs away to the right. Below, rows with a picket every 1.5, 1.25, 1.1, 1, 0.9 and 0.75",
            "pixels (1024 x 1024, default view). At rate 1 the rows show fences far too coarse, or one flat colour: that is aliasing.",
            "Press = up to 16: each row gets its true mean. The wheel changes the beat: the false fences breathe, the true one grows.",
        ],
    );
    doc.rect(DVec2::ZERO, dvec2(SIDE, SIDE), Style::fill(SKY.mix(PAPER, 0.4)));
    doc.rect(dvec2(0.0, 212.0), dvec2(SIDE, 300.0), Style::fill(SEA.mix(SAND, 0.5)));
    doc.polygon(&regular(dvec2(396.0, 70.0), 30.0, 40, 0.0), Style::fill(AMBER));
    // Depth grows by the same step from picket to picket; the fence leaves the eye towards the right.
    let screen = |depth: f64| 470.0 - 460.0 / depth;
    for rail in [0.30, 0.75] {
        let at = |depth: f64, up: f64| dvec2(screen(depth), 150.0 + (80.0 - 165.0 * up) / depth);
        doc.polygon(
            &[
                at(1.0, rail),
                at(200.0, rail),
                at(200.0, rail + 0.09),
                at(1.0, rail + 0.09),
            ],
            Style::fill(SAND),
        );
    }
    for k in 0..420 {
        let depth = 1.0 + 0.045 * f64::from(k);
        let at = |along: f64, up: f64| dvec2(screen(depth + along), 150.0 + (80.0 - 165.0 * up) / (depth + along));
        let picket = [
            at(0.0, 0.0),
            at(0.0, 0.92),
            at(0.012, 1.06),
            at(0.024, 0.92),
            at(0.024, 0.0),
        ];
        doc.polygon(&picket, Style::fill(PAPER.mix(SKY, f64::from(k) / 700.0)));
    }
    for (row, period) in [1.5, 1.25, 1.1, 1.0, 0.9, 0.75].iter().enumerate() {
        let top = 250.0 + 42.0 * row as f64;
        doc.rect(dvec2(16.0, top), dvec2(480.0, 32.0), Style::fill(PAPER));
        let step = period * PIXEL;
        let count = (480.0 / step) as usize;
        // Forty pickets to a polygon, joined by a rail.
        for first in (0..count).step_by(40) {
            let last = (first + 40).min(count);
            let mut comb = vec![dvec2(16.0 + first as f64 * step, top + 32.0)];
            for k in first..last {
                let x = 16.0 + k as f64 * step;
                comb.extend([
                    dvec2(x, top),
                    dvec2(x + step * 0.5, top),
                    dvec2(x + step * 0.5, top + 30.0),
                    dvec2(x + step, top + 30.0),
                ]);
            }
            comb.push(dvec2(16.0 + last as f64 * step, top + 32.0));
            doc.decimals(3);
            doc.polygon(&comb, Style::fill(if row % 2 == 0 { BRICK } else { NIGHT }));
            doc.decimals(2);
        }
    }
    doc.finish()
}

fn seams() -> String {
    let mut doc = Document::new(
        1000.0,
        560.0,
        &[
            "Abutting triangles. Left, one colour on a glowing ground: a gap would glow. Right, half transparent: a sample that two",
            "triangles claim would be darker, one that none claims lighter. Both must be perfectly even, at every rate, zoom and angle.",
            "Then switch the rules to course: diagonals through samples show on the right. Pin one (right click) and read why.",
        ],
    );
    doc.rect(DVec2::ZERO, dvec2(1000.0, 560.0), Style::fill(INK));
    doc.rect(dvec2(504.0, 24.0), dvec2(472.0, 512.0), Style::fill(PAPER));
    shaken_disc(&mut doc, dvec2(260.0, 280.0));
    lattice(&mut doc);
    doc.finish()
}

/// Rings of jittered points; each ring is joined to the next by a strip of triangles.
fn shaken_disc(doc: &mut Document, middle: DVec2) {
    let rim: Vec<DVec2> = regular(middle, 212.0, 64, 0.0);
    doc.polygon(&rim, Style::fill(AMBER.mix(PAPER, 0.3)));
    let point = |ring: i64, k: i64| {
        let (count, reach) = (32, 26.75);
        let k = k.rem_euclid(count);
        let shake = if ring == 8 { 0.0 } else { (2.4 * ring as f64).min(9.0) };
        let jitter = dvec2(cell(1, ring, k), cell(2, ring, k)) - 0.5;
        let turn = TAU * (k as f64 + 0.5 * ring as f64) / count as f64;
        middle + polar(reach * ring as f64, turn) + jitter * shake
    };
    for ring in 0..8 {
        for k in 0..32 {
            let [a, b] = [point(ring, k), point(ring, k + 1)];
            let [c, d] = [point(ring + 1, k), point(ring + 1, k + 1)];
            doc.polygon(&[a, c, d], Style::fill(TEAL));
            if ring > 0 {
                doc.polygon(&[a, d, b], Style::fill(TEAL));
            }
        }
    }
}

/// Squares of four triangles. Their diagonals run through the middles of pixels in the default view of 1024 x 1024 and of
/// 1280 x 800 pixels and at one unit per pixel: differences of x and y are then 220, sums 780, and multiples of 75 besides.
fn lattice(doc: &mut Document) {
    const SIDE: f64 = 75.0;
    let style = Style::fill(PLUM).opacity(0.5);
    for (row, column) in (0..6).flat_map(|row| (0..5).map(move |column| (row, column))) {
        let corner = |x: i32, y: i32| dvec2(f64::from(column + x), f64::from(row + y)) * SIDE + dvec2(575.0, 55.0);
        let middle = (corner(0, 0) + corner(1, 1)) / 2.0;
        let corners = [corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)];
        for (i, from) in corners.into_iter().enumerate() {
            doc.polygon(&[from, corners[(i + 1) % 4], middle], style);
        }
    }
}

fn pixel_centres() -> String {
    let mut doc = Document::new(
        SIDE,
        SIDE,
        &[
            "Every corner lies exactly on a pixel centre, at 1024 x 1024 in the default view and at one unit per pixel (Ctrl+0).",
            "A centre on an edge belongs to the triangle for which the edge is a top or a left one: squares 75 pixels wide (1024) own",
            "75 x 75 pixels, not 76 x 76, and neighbours neither overlap nor leave a gap. Z on any corner; then change the rules to course.",
        ],
    );
    doc.rect(DVec2::ZERO, dvec2(SIDE, SIDE), Style::fill(PAPER));
    // Pixel centres shared by both views lie at 2.5 + 3 k.
    let at = |i: i32, j: i32| dvec2(2.5 + 3.0 * f64::from(i), 2.5 + 3.0 * f64::from(j));
    let tints = [TEAL, CORAL, AMBER, PLUM, SEA, NIGHT];
    // Squares that touch.
    for row in 0..4 {
        for column in 0..10 {
            let (i, j) = (10 + 15 * column, 10 + 15 * row);
            let color = tints[((column + 2 * row) % 6) as usize];
            doc.polygon(&rectangle(at(i, j), at(i + 15, j + 15)), Style::fill(color));
        }
    }
    // Squares of two triangles each, cut along either diagonal.
    for column in 0..10 {
        let (i, j) = (10 + 15 * column, 76);
        let [a, b, c, d] = [at(i, j), at(i + 15, j), at(i + 15, j + 15), at(i, j + 15)];
        let (first, second) = if column % 2 == 0 {
            ([a, b, c], [a, c, d])
        } else {
            ([a, b, d], [b, c, d])
        };
        doc.polygon(&first, Style::fill(SKY));
        doc.polygon(&second, Style::fill(SLATE));
    }
    // Pinwheels: eight triangles that meet in one pixel centre.
    for (k, i) in [35, 85, 135].iter().enumerate() {
        let (i, j) = (*i, 128);
        let rim = [
            (0, -25),
            (25, -25),
            (25, 0),
            (25, 25),
            (0, 25),
            (-25, 25),
            (-25, 0),
            (-25, -25),
        ];
        for n in 0..8 {
            let [p, q] = [rim[n], rim[(n + 1) % 8]];
            let pair: [Color; 2] = [[CORAL, AMBER], [TEAL, SEA], [PLUM, SAND]][k];
            doc.polygon(
                &[at(i, j), at(i + p.0, j + p.1), at(i + q.0, j + q.1)],
                Style::fill(pair[n % 2]),
            );
        }
    }
    doc.finish()
}
