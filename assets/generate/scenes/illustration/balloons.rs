//! A regatta of balloons over rolling hills.

use glam::{DVec2, dvec2};

use super::palette::{
    AMBER, BRICK, CORAL, Color, INK, LEAF, NIGHT, PAPER, PINE, PLUM, SAND, SEA, SKY, SLATE, TEAL, WHITE,
};
use super::steady::{TAU, cos, sin};
use super::{Document, Style, noise, sky};

/// The document.
pub(super) fn balloons() -> String {
    let mut doc = Document::new(
        1000.0,
        1000.0,
        &[
            "A regatta of balloons. The gores of each one are polygons that share their curved edges; ropes are hairlines.",
            "Zoom far out: ropes stay one pixel wide and the baskets drown in them. Zoom in: the curves are chains of straight edges.",
            "Press = at the far balloons: at rate 1 their outer gores, less than a pixel wide, come and go.",
        ],
    );
    sky(
        &mut doc,
        1000.0,
        [0.0, 760.0],
        &[
            SKY.mix(TEAL, 0.25),
            SKY,
            SKY.mix(PAPER, 0.5),
            SAND,
            AMBER.mix(SAND, 0.5),
        ],
    );
    for (x, y, size) in [
        (170.0, 150.0, 1.0),
        (850.0, 250.0, 0.85),
        (560.0, 92.0, 0.6),
        (100.0, 470.0, 0.7),
        (925.0, 520.0, 0.55),
    ] {
        cloud(&mut doc, dvec2(x, y), size);
    }
    let small = [
        (610.0, 262.0, 0.2, [TEAL, PAPER]),
        (704.0, 350.0, 0.13, [CORAL, SAND]),
        (420.0, 190.0, 0.15, [PLUM, AMBER]),
        (880.0, 420.0, 0.24, [AMBER, BRICK]),
        (130.0, 330.0, 0.19, [BRICK, PAPER]),
        (520.0, 440.0, 0.10, [NIGHT, SEA]),
    ];
    for (x, y, scale, colors) in small {
        balloon(&mut doc, dvec2(x, y), scale, colors);
    }
    hills(&mut doc);
    balloon(&mut doc, dvec2(318.0, 420.0), 1.0, [CORAL, PAPER]);
    balloon(&mut doc, dvec2(724.0, 560.0), 0.62, [TEAL, AMBER]);
    doc.finish()
}

fn cloud(doc: &mut Document, at: DVec2, size: f64) {
    for (dx, dy, radius) in [
        (-78.0, 6.0, 30.0),
        (-36.0, -12.0, 44.0),
        (18.0, -20.0, 52.0),
        (66.0, -2.0, 38.0),
        (104.0, 8.0, 24.0),
    ] {
        // Round above, flat below.
        let arc: Vec<DVec2> = (0..=24)
            .map(|k| {
                let angle = TAU / 2.0 + TAU / 2.0 * f64::from(k) / 24.0;
                at + dvec2(dx + radius * cos(angle), (dy + radius * sin(angle)).min(18.0)) * size
            })
            .chain([
                at + dvec2(dx + radius, 18.0) * size,
                at + dvec2(dx - radius, 18.0) * size,
            ])
            .collect();
        doc.polygon(&arc, Style::fill(WHITE.mix(SKY, 0.22)));
    }
}

/// Half width of the envelope at `t` from 0, its top, to 1, its mouth.
fn half_width(t: f64) -> f64 {
    if t < 0.46 {
        190.0 * sin(t / 0.46 * TAU / 4.0).sqrt().max(sin(t / 0.46 * TAU / 4.0))
    } else {
        30.0 + 160.0 * (1.0 + cos((t - 0.46) / 0.54 * TAU / 2.0)) / 2.0
    }
}

/// A balloon; `at` is the middle of its envelope, which is 380 units wide at scale 1.
fn balloon(doc: &mut Document, at: DVec2, scale: f64, colors: [Color; 2]) {
    let top = -240.0;
    let height = 460.0;
    let gores = 12;
    let point = |k: i32, t: f64| {
        // Gores are even round the balloon, so they are narrow at its sides.
        let across = -cos(TAU / 2.0 * f64::from(k) / f64::from(gores));
        at + dvec2(across * half_width(t), top + height * t) * scale
    };
    let steps = if scale > 0.5 { 30 } else { 14 };
    for k in 0..gores {
        let mut gore: Vec<DVec2> = (0..=steps).map(|i| point(k, f64::from(i) / f64::from(steps))).collect();
        gore.extend((0..=steps).rev().map(|i| point(k + 1, f64::from(i) / f64::from(steps))));
        let light = 0.16 - 0.46 * f64::from(k) / f64::from(gores) + if k < 2 { -0.1 } else { 0.0 };
        doc.polygon(&gore, Style::fill(colors[(k % 2) as usize].shade(light)));
    }
    for (from, to, color) in [
        (0.40, 0.44, colors[1].shade(-0.2)),
        (0.46, 0.56, INK.mix(colors[0], 0.35)),
        (0.58, 0.60, colors[1].shade(-0.1)),
    ] {
        let edge =
            |t: f64, k: i32| point(k, t) + dvec2(0.0, 14.0 * scale * sin(TAU / 2.0 * f64::from(k) / f64::from(gores)));
        let mut band: Vec<DVec2> = (0..=gores).map(|k| edge(from, k)).collect();
        band.extend((0..=gores).rev().map(|k| edge(to, k)));
        doc.polygon(&band, Style::fill(color));
    }
    let mouth = top + height;
    for x in [-28.0, -10.0, 10.0, 28.0] {
        doc.line(
            [at + dvec2(x, mouth) * scale, at + dvec2(x * 0.9, mouth + 62.0) * scale],
            Style::stroke(INK),
        );
    }
    let basket = [(-28.0, 60.0), (28.0, 60.0), (23.0, 104.0), (-23.0, 104.0)];
    doc.polygon(
        &basket.map(|(x, y)| at + dvec2(x, mouth + y) * scale),
        Style::fill(BRICK.mix(INK, 0.35)),
    );
    let rim = [(-31.0, 58.0), (31.0, 58.0), (31.0, 67.0), (-31.0, 67.0)];
    doc.polygon(
        &rim.map(|(x, y)| at + dvec2(x, mouth + y) * scale),
        Style::fill(AMBER.mix(BRICK, 0.4)),
    );
    let flame = [(-7.0, 26.0), (0.0, -8.0), (7.0, 26.0), (0.0, 34.0)];
    doc.polygon(
        &flame.map(|(x, y)| at + dvec2(x, mouth + y) * scale),
        Style::fill(AMBER),
    );
}

fn hills(doc: &mut Document) {
    let layers = [
        (690.0, SLATE.mix(SKY, 0.45), 70.0),
        (745.0, SEA.mix(SLATE, 0.3), 80.0),
        (800.0, LEAF.mix(SEA, 0.45), 70.0),
        (862.0, LEAF, 64.0),
        (930.0, PINE.mix(LEAF, 0.3), 50.0),
    ];
    for (k, (base, color, swing)) in layers.into_iter().enumerate() {
        let height = |x: f64| {
            base - swing * (noise(60 + k as u64, x / 210.0, 0.3) - 0.4) - 0.2 * swing * sin(x / 77.0 + k as f64)
        };
        let mut points: Vec<DVec2> = (0..=60)
            .map(|i| f64::from(i) * 1000.0 / 60.0)
            .map(|x| dvec2(x, height(x)))
            .collect();
        points.extend([dvec2(1000.0, 1000.0), dvec2(0.0, 1000.0)]);
        doc.polygon(&points, Style::fill(color));
        // Ploughed fields: hairlines that follow the slope.
        if k >= 2 {
            for row in 1..5 {
                let drop = 9.0 * f64::from(row);
                let (left, right) = (120.0 * k as f64, 120.0 * k as f64 + 330.0);
                let line: Vec<DVec2> = (0..=22)
                    .map(|i| left + (right - left) * f64::from(i) / 22.0)
                    .map(|x| dvec2(x, height(x) + drop))
                    .collect();
                doc.polyline(&line, Style::stroke(PINE).stroke_opacity(0.4));
            }
        }
    }
    for (x, y, size) in [
        (60.0, 905.0, 1.2),
        (96.0, 916.0, 0.9),
        (930.0, 880.0, 1.0),
        (900.0, 900.0, 1.3),
        (560.0, 935.0, 0.8),
    ] {
        let at = |dx: f64, dy: f64| dvec2(x + dx * size, y + dy * size);
        doc.polygon(&[at(-15.0, 0.0), at(0.0, -58.0), at(0.0, 6.0)], Style::fill(PINE));
        doc.polygon(
            &[at(0.0, -58.0), at(15.0, 0.0), at(0.0, 6.0)],
            Style::fill(PINE.mix(INK, 0.45)),
        );
    }
}
