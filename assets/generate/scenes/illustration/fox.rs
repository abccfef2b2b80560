//! A fox of triangles: one half drawn by hand, each triangle cut into sixteen, the other half mirrored.

use glam::{DVec2, dvec2};

use super::palette::{AMBER, CORAL, Color, INK, NIGHT, PAPER, SAND, SEA, TEAL, hex};
use super::{Document, Style, cell};

/// Corners of the right half; the head is about 200 units wide, the axis is x = 0.
const POINTS: [(f64, f64); 27] = [
    (0.0, -44.0),   // 0 forehead
    (24.0, -56.0),  // 1 ear, inner foot
    (66.0, -122.0), // 2 ear, tip
    (78.0, -30.0),  // 3 ear, outer foot
    (56.0, -62.0),  // 4 ear, inside
    (0.0, -8.0),    // 5 bridge
    (17.0, -22.0),  // 6 brow
    (21.0, -3.0),   // 7 eye, inner corner
    (48.0, -17.0),  // 8 eye, outer corner
    (36.0, 3.0),    // 9 eye, below
    (90.0, 2.0),    // 10 cheek, top
    (108.0, 38.0),  // 11 cheek, tuft
    (74.0, 48.0),   // 12 cheek, below
    (62.0, 74.0),   // 13 lower tuft
    (36.0, 70.0),   // 14 jaw
    (22.0, 40.0),   // 15 muzzle
    (12.0, 74.0),   // 16 nose, side
    (0.0, 66.0),    // 17 nose, top
    (0.0, 92.0),    // 18 nose, foot
    (16.0, 98.0),   // 19 chin
    (0.0, 106.0),   // 20 chin, middle
    (92.0, 100.0),  // 21 shoulder
    (132.0, 200.0), // 22 side
    (0.0, 200.0),   // 23 foot of the breast
    (52.0, 112.0),  // 24 breast
    (30.0, 200.0),  // 25 breast, below
    (0.0, 128.0),   // 26 throat
];

const FUR: Color = hex(0xE9752F);
const DEEP: Color = hex(0xB94A22);
const SNOW: Color = PAPER;
const DARK: Color = hex(0x33222B);

/// Corners, colour, light.
const FACES: [([usize; 3], Color, f64); 36] = [
    ([24, 21, 22], FUR, -0.32),
    ([24, 22, 25], FUR, -0.18),
    ([20, 24, 26], SNOW, -0.24),
    ([26, 24, 25], SNOW, -0.06),
    ([26, 25, 23], SNOW, 0.0),
    ([14, 13, 24], FUR, -0.4),
    ([13, 21, 24], FUR, -0.26),
    ([19, 14, 24], DARK, 0.0),
    ([20, 19, 24], DARK, -0.2),
    ([1, 2, 4], FUR, 0.06),
    ([4, 2, 3], DEEP, -0.2),
    ([1, 4, 3], DARK, 0.05),
    ([0, 1, 6], FUR, 0.12),
    ([0, 6, 5], FUR, 0.26),
    ([1, 3, 8], FUR, -0.02),
    ([1, 8, 6], FUR, 0.06),
    ([3, 10, 8], DEEP, 0.1),
    ([6, 8, 7], DEEP, 0.0),
    ([5, 6, 7], FUR, 0.14),
    ([7, 8, 9], INK, -0.2),
    ([5, 7, 15], FUR, 0.02),
    ([5, 15, 17], FUR, 0.22),
    ([15, 16, 17], FUR, 0.1),
    ([7, 9, 15], FUR, -0.06),
    ([9, 8, 10], FUR, -0.12),
    ([9, 10, 12], SNOW, 0.0),
    ([9, 12, 15], SNOW, -0.04),
    ([10, 11, 12], SNOW, -0.14),
    ([15, 12, 14], SNOW, -0.08),
    ([12, 13, 14], SNOW, -0.2),
    ([15, 14, 16], SNOW, 0.02),
    ([16, 14, 19], SNOW, -0.16),
    ([16, 19, 18], SNOW, -0.24),
    ([18, 19, 20], SNOW, -0.34),
    ([17, 16, 18], INK, 0.0),
    ([3, 11, 10], FUR, -0.3),
];

/// The document.
pub(super) fn fox() -> String {
    let mut doc = Document::new(
        1000.0,
        1000.0,
        &[
            "A fox of a thousand flat triangles. Neighbours share their edges exactly: turn, zoom, change the rate,",
            "no line of ground may show between them. Z on an edge: each sample has one owner.",
            "Press = : only the outline and the edges between colours change, the inside stays as it is.",
        ],
    );
    ground(&mut doc);
    for side in [-1.0, 1.0] {
        for (index, (corners, color, light)) in FACES.iter().enumerate() {
            let points = corners.map(|k| dvec2(POINTS[k].0 * side, POINTS[k].1));
            // Light falls from the left.
            let light = light + if side < 0.0 { 0.07 } else { -0.07 };
            facets(
                &mut doc,
                points,
                color.shade(light),
                (index as i64 * 2 + i64::from(side > 0.0)) * 16,
            );
        }
        // Glints in the eyes.
        let eye = dvec2(33.0 * side, -7.0);
        doc.polygon(
            &[eye, eye + dvec2(6.0 * side, -2.6), eye + dvec2(3.0, 3.2)].map(place),
            Style::fill(AMBER),
        );
        let glint = eye + dvec2(1.0, -1.0);
        doc.polygon(
            &[glint, glint + dvec2(2.4, -0.6), glint + dvec2(1.0, 1.6)].map(place),
            Style::fill(PAPER),
        );
    }
    doc.finish()
}

fn place(p: DVec2) -> DVec2 {
    dvec2(500.0, 470.0) + p * 2.66
}

/// A triangle as sixteen, each a little lighter or darker than the whole.
fn facets(doc: &mut Document, [a, b, c]: [DVec2; 3], color: Color, seed: i64) {
    let at = |i: i32, j: i32| place(a + (b - a) * (f64::from(i) / 4.0) + (c - a) * (f64::from(j) / 4.0));
    let mut count = 0;
    for i in 0..4 {
        for j in 0..4 - i {
            let mut facet = |points: [DVec2; 3]| {
                let light = (cell(3, seed, count) - 0.5) * 0.16;
                doc.polygon(&points, Style::fill(color.shade(light)));
                count += 1;
            };
            facet([at(i, j), at(i + 1, j), at(i, j + 1)]);
            if i + j < 3 {
                facet([at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)]);
            }
        }
    }
}

/// A ground of large triangles, light behind the head.
fn ground(doc: &mut Document) {
    let point = |i: i64, j: i64| {
        let inner = i > 0 && i < 10 && j > 0 && j < 10;
        let shake = if inner {
            dvec2(cell(1, i, j), cell(2, i, j)) - 0.5
        } else {
            DVec2::ZERO
        };
        (dvec2(i as f64, j as f64) + shake * 0.7) * 100.0
    };
    for j in 0..10 {
        for i in 0..10 {
            let [a, b, c, d] = [point(i, j), point(i + 1, j), point(i + 1, j + 1), point(i, j + 1)];
            let pair = if (i + j) % 2 == 0 {
                [[a, b, c], [a, c, d]]
            } else {
                [[a, b, d], [b, c, d]]
            };
            for (k, triangle) in pair.into_iter().enumerate() {
                let middle = (triangle[0] + triangle[1] + triangle[2]) / 3.0;
                let glow = (1.0 - middle.distance(dvec2(430.0, 380.0)) / 720.0).clamp(0.0, 1.0);
                let base = TEAL.mix(NIGHT, 0.45).mix(SEA.mix(SAND, 0.45), glow * glow * 1.1);
                let light = (cell(6 + k as u64, i, j) - 0.5) * 0.14;
                doc.polygon(&triangle, Style::fill(base.mix(CORAL, 0.03).shade(light)));
            }
        }
    }
}
