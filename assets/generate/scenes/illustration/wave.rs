//! A swell at sea: a height field in perspective, each triangle lit by its slope.

use glam::{DVec2, DVec3, dvec2, dvec3};

use super::outline::regular;
use super::palette::{AMBER, CORAL, Color, INK, NIGHT, PAPER, SAND, SEA, TEAL, gradient, hex};
use super::steady::{cos, exp, sin};
use super::{Document, Style, cell, sky};

const COLUMNS: i64 = 44;
const ROWS: i64 = 34;

/// The document.
pub(super) fn swell() -> String {
    let mut doc = Document::new(
        1000.0,
        1000.0,
        &[
            "A swell of some 2700 triangles, painted from the horizon to us; nearer ones cover what lies behind.",
            "Far away, triangles are smaller than a pixel: rate 1 picks one of them, = mixes them. Turn with [ and ] and watch",
            "the horizon flicker. Z on the boat: painter's order decides which triangle a sample shows.",
        ],
    );
    sky(
        &mut doc,
        1000.0,
        [0.0, 552.0],
        &[
            hex(0x2B4A6B),
            TEAL.mix(SAND, 0.3),
            SAND,
            AMBER.mix(SAND, 0.2),
            CORAL.mix(AMBER, 0.35),
        ],
    );
    air(&mut doc);
    doc.rect(
        dvec2(0.0, 548.0),
        dvec2(1000.0, 452.0),
        Style::fill(NIGHT.mix(TEAL, 0.4)),
    );
    doc.decimals(1);
    for row in (0..ROWS).rev() {
        for column in 0..COLUMNS {
            let corner = |i: i64, j: i64| surface(column + i, row + j);
            let [a, b, c, d] = [corner(0, 1), corner(1, 1), corner(1, 0), corner(0, 0)];
            let pair = if (row + column) % 2 == 0 {
                [[a, b, c], [a, c, d]]
            } else {
                [[a, b, d], [b, c, d]]
            };
            for triangle in pair {
                let color = lit(triangle, cell(8, column, row));
                let points = inside(triangle.map(project));
                if points.len() > 2 {
                    doc.polygon(&points, Style::fill(color));
                }
            }
        }
        if row == 9 {
            boat(&mut doc, project(surface(13, 9)) + dvec2(0.0, 6.0));
        }
    }
    doc.finish()
}

/// A point of the sea, x to the right, y up, z away; the eye is 3 units above calm water.
fn surface(column: i64, row: i64) -> DVec3 {
    // Rows lie closer together near the eye, and points shake, so that no pattern shows.
    let depth = 2.7 + 0.2 * row as f64 + 0.011 * (row * row) as f64;
    let depth = depth * exp(0.028 * row as f64);
    let spread = 0.62 * depth / COLUMNS as f64 * 2.0;
    let shake = dvec2(cell(1, column, row), cell(2, column, row)) - 0.5;
    let x = (column as f64 - COLUMNS as f64 / 2.0 + 0.75 * shake.x) * spread;
    let z = depth + 0.16 * shake.y * (depth / 3.2);
    let long = 0.34 * sin(0.62 * x + 0.95 * z + 3.4) + 0.2 * sin(1.3 * z - 0.55 * x + 4.4);
    let short = 0.12 * sin(2.6 * x + 1.9 * z) + 0.09 * cos(3.9 * x - 2.2 * z);
    let fade = exp(-(depth - 2.7) * 0.018);
    dvec3(x, (long + short) * fade, z)
}

fn project(p: DVec3) -> DVec2 {
    dvec2(500.0 + 905.0 * p.x / p.z, 520.0 + 905.0 * (1.85 - p.y) / p.z * 0.86)
}

fn lit(triangle: [DVec3; 3], dice: f64) -> Color {
    let normal = (triangle[1] - triangle[0])
        .cross(triangle[2] - triangle[0])
        .normalize_or_zero();
    let normal = if normal.y < 0.0 { -normal } else { normal };
    let light = normal.dot(dvec3(0.35, 0.62, 0.7).normalize_or_zero());
    let height = (triangle[0].y + triangle[1].y + triangle[2].y) / 3.0;
    let far = ((triangle[0].z - 4.0) / 22.0).clamp(0.0, 1.0);
    let water = gradient(
        &[
            hex(0x10263A),
            NIGHT,
            TEAL.mix(NIGHT, 0.3),
            TEAL,
            SEA,
            SEA.mix(PAPER, 0.55),
        ],
        (light - 0.1) * 1.0 + 0.4 * height,
    );
    let crest = ((height - 0.24) / 0.3).clamp(0.0, 1.0) * if dice < 0.55 { 0.85 } else { 0.45 };
    let color = water.shade((dice - 0.5) * 0.12).mix(PAPER.mix(SEA, 0.25), crest);
    // The sun's path, and haze towards the horizon.
    let middle = project((triangle[0] + triangle[1] + triangle[2]) / 3.0);
    let path = exp(-((middle.x - 640.0) / (40.0 + 0.28 * (middle.y - 520.0).max(0.0)))
        * ((middle.x - 640.0) / (40.0 + 0.28 * (middle.y - 520.0).max(0.0))));
    color
        .mix(AMBER.mix(PAPER, 0.35), 0.5 * path * light.max(0.0))
        .mix(CORAL.mix(SAND, 0.5), 0.42 * far)
}

/// A folded paper boat.
fn boat(doc: &mut Document, at: DVec2) {
    let turn = -0.14;
    let place = |points: &[(f64, f64)]| -> Vec<DVec2> {
        points
            .iter()
            .map(|&(x, y)| at + dvec2(x * cos(turn) - y * sin(turn), x * sin(turn) + y * cos(turn)) * 1.15)
            .collect()
    };
    doc.polygon(
        &place(&[(0.0, -92.0), (-40.0, -22.0), (0.0, -22.0)]),
        Style::fill(PAPER),
    );
    doc.polygon(&place(&[(0.0, -92.0), (40.0, -22.0), (0.0, -22.0)]), Style::fill(SAND));
    doc.polygon(
        &place(&[(-84.0, -40.0), (0.0, -18.0), (-46.0, 14.0)]),
        Style::fill(PAPER),
    );
    doc.polygon(
        &place(&[(84.0, -40.0), (0.0, -18.0), (46.0, 14.0)]),
        Style::fill(SAND.shade(-0.12)),
    );
    doc.polygon(
        &place(&[(-46.0, 14.0), (0.0, -18.0), (46.0, 14.0)]),
        Style::fill(SAND.shade(-0.04)),
    );
}

/// The sun and some gulls.
fn air(doc: &mut Document) {
    let sun = dvec2(640.0, 330.0);
    for (radius, opacity) in [(190.0, 0.12), (158.0, 0.16), (130.0, 0.22)] {
        doc.polygon(&regular(sun, radius, 72, 0.0), Style::fill(PAPER).opacity(opacity));
    }
    doc.polygon(&regular(sun, 104.0, 72, 0.0), Style::fill(PAPER.mix(AMBER, 0.25)));
    for (x, y, size) in [
        (200.0, 210.0, 1.0),
        (262.0, 176.0, 0.7),
        (316.0, 236.0, 0.8),
        (150.0, 160.0, 0.5),
    ] {
        let wing = [
            (-34.0, -12.0),
            (-14.0, -17.0),
            (0.0, 0.0),
            (15.0, -18.0),
            (36.0, -10.0),
            (14.0, -11.0),
            (0.0, 8.0),
            (-13.0, -10.0),
        ];
        doc.polygon(
            &wing.map(|(dx, dy)| dvec2(x + dx * size, y + dy * size)),
            Style::fill(INK),
        );
    }
}

/// The part of a triangle inside the canvas, after Sutherland and Hodgman (1974).
fn inside(triangle: [DVec2; 3]) -> Vec<DVec2> {
    let mut points = triangle.to_vec();
    for (normal, bound) in [
        (DVec2::X, 0.0),
        (DVec2::Y, 0.0),
        (-DVec2::X, -1000.0),
        (-DVec2::Y, -1000.0),
    ] {
        let depth = |p: DVec2| normal.dot(p) - bound;
        let mut kept = Vec::new();
        for (k, &from) in points.iter().enumerate() {
            let to = points[(k + 1) % points.len()];
            if depth(from) >= 0.0 {
                kept.push(from);
            }
            if (depth(from) >= 0.0) != (depth(to) >= 0.0) {
                kept.push(from + (to - from) * (depth(from) / (depth(from) - depth(to))));
            }
        }
        points = kept;
    }
    points
}
