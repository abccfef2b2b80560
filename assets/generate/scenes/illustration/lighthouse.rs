//! A lighthouse at dusk: smooth colours from `colortri`, a translucent beam.

use glam::{DVec2, dvec2};

use super::outline::{arc, regular};
use super::palette::{AMBER, BRICK, CORAL, Color, INK, MIST, NIGHT, PAPER, PLUM, SAND, SLATE, TEAL, WHITE, hex};
use super::steady::TAU;
use super::{Chance, Document, Style, noise, sky};

const HORIZON: f64 = 640.0;
const LAMP: DVec2 = dvec2(398.0, 262.0);

/// The document.
pub(super) fn lighthouse() -> String {
    let mut doc = Document::new(
        1000.0,
        1000.0,
        &[
            "A lighthouse at dusk. Sky, sea and tower are colours given at corners and mixed in between (colortri);",
            "the beam is five translucent triangles on top of each other. Z reads how they mix, sample by sample.",
            "Press - and = : the stairs of the beam and of the rails come and go; the stars are points and stay as they are.",
        ],
    );
    sky(
        &mut doc,
        1000.0,
        [0.0, HORIZON],
        &[
            hex(0x14263B),
            NIGHT.mix(PLUM, 0.35),
            PLUM.mix(CORAL, 0.25),
            CORAL,
            AMBER,
            SAND,
        ],
    );
    stars(&mut doc);
    clouds(&mut doc);
    sky(
        &mut doc,
        1000.0,
        [HORIZON, 1000.0],
        &[TEAL.mix(AMBER, 0.45), TEAL.mix(NIGHT, 0.35), NIGHT, hex(0x14263B)],
    );
    glitter(&mut doc);
    for k in 0..5 {
        let spread = 78.0 - 15.0 * f64::from(k);
        let tip = [dvec2(1000.0, 140.0 - spread), dvec2(1000.0, 140.0 + spread)];
        doc.polygon(&[LAMP, tip[0], tip[1]], Style::fill(SAND.mix(AMBER, 0.3)).opacity(0.11));
        let tip = [dvec2(0.0, 352.0 - spread * 0.62), dvec2(0.0, 352.0 + spread * 0.62)];
        doc.polygon(&[LAMP, tip[0], tip[1]], Style::fill(SAND.mix(AMBER, 0.3)).opacity(0.07));
    }
    rock(&mut doc);
    tower(&mut doc);
    house(&mut doc);
    doc.finish()
}

fn stars(doc: &mut Document) {
    let mut chance = Chance::new(4);
    for _ in 0..240 {
        let (x, y) = (chance.range(4.0, 996.0), 400.0 * chance.unit() * chance.unit());
        doc.rect(dvec2(x, y), DVec2::ZERO, Style::fill(MIST.mix(WHITE, chance.unit())));
    }
    doc.polygon(&regular(dvec2(812.0, 322.0), 40.0, 40, 0.0), Style::fill(SAND));
    doc.polygon(
        &regular(dvec2(802.0, 314.0), 8.0, 14, 0.0),
        Style::fill(AMBER).opacity(0.35),
    );
    doc.polygon(
        &regular(dvec2(824.0, 334.0), 12.0, 18, 0.0),
        Style::fill(AMBER).opacity(0.3),
    );
}

/// Long flat bands, lit from below.
fn clouds(doc: &mut Document) {
    for (y, left, right, tone) in [
        (455.0, 520.0, 960.0, PLUM),
        (492.0, 620.0, 1000.0, PLUM),
        (528.0, 40.0, 300.0, PLUM),
        (566.0, 560.0, 880.0, BRICK),
        (590.0, 0.0, 240.0, BRICK),
    ] {
        let point = |t: f64, side: f64| {
            let x = left + (right - left) * t;
            let body = (t * (1.0 - t) * 4.0).max(0.0).sqrt();
            dvec2(x, y + side * body * (5.0 + 9.0 * noise(8, x / 46.0, y)))
        };
        let mut points: Vec<DVec2> = (0..=24).map(|k| point(f64::from(k) / 24.0, -1.0)).collect();
        points.extend((0..=24).rev().map(|k| point(f64::from(k) / 24.0, 0.45)));
        doc.polygon(&points, Style::fill(tone).opacity(0.5));
    }
}

fn glitter(doc: &mut Document) {
    let mut chance = Chance::new(9);
    for k in 0..90 {
        let t = f64::from(k) / 90.0;
        let y = HORIZON + 4.0 + 330.0 * t * t;
        let half = (10.0 + 60.0 * t) * chance.range(0.3, 1.0);
        let x = 812.0 + chance.range(-1.0, 1.0) * (30.0 + 100.0 * t);
        let thick = 1.2 + 4.0 * t;
        doc.polygon(
            &[
                dvec2(x - half, y),
                dvec2(x, y - thick),
                dvec2(x + half, y),
                dvec2(x, y + thick),
            ],
            Style::fill(AMBER.mix(SAND, chance.unit())).opacity(0.75 - 0.4 * t),
        );
    }
    for _ in 0..70 {
        let t = chance.unit();
        let (x, y, half) = (chance.range(0.0, 1000.0), HORIZON + 10.0 + 340.0 * t, 12.0 + 36.0 * t);
        let left = (x - half).max(0.0);
        doc.line(
            [dvec2(left, y), dvec2((x + half).min(1000.0), y)],
            Style::stroke(MIST).stroke_opacity(0.3),
        );
    }
}

fn rock(doc: &mut Document) {
    let tones = [
        hex(0x3A3550),
        hex(0x2A2B44),
        hex(0x57435C),
        hex(0x1D2136),
        hex(0x6E4B5C),
        hex(0x33304C),
    ];
    let top = [
        (96.0, 752.0),
        (180.0, 706.0),
        (262.0, 668.0),
        (330.0, 640.0),
        (470.0, 636.0),
        (540.0, 662.0),
        (640.0, 690.0),
        (716.0, 742.0),
    ];
    let middle = [
        (60.0, 800.0),
        (160.0, 776.0),
        (250.0, 748.0),
        (350.0, 722.0),
        (440.0, 730.0),
        (560.0, 738.0),
        (660.0, 764.0),
        (772.0, 806.0),
    ];
    let foot = [
        (20.0, 838.0),
        (130.0, 846.0),
        (240.0, 838.0),
        (340.0, 852.0),
        (450.0, 840.0),
        (570.0, 850.0),
        (690.0, 840.0),
        (820.0, 836.0),
    ];
    for (k, (upper, lower)) in [(top, middle), (middle, foot)].iter().enumerate() {
        for i in 0..7 {
            let [a, b, c, d] = [upper[i], upper[i + 1], lower[i + 1], lower[i]].map(|(x, y)| dvec2(x, y));
            let (first, second) = if (i + k) % 2 == 0 {
                ([a, b, c], [a, c, d])
            } else {
                ([a, b, d], [b, c, d])
            };
            doc.polygon(&first, Style::fill(tones[(i * 2 + k * 3) % 6]));
            doc.polygon(&second, Style::fill(tones[(i * 2 + k + 1) % 6]));
        }
    }
    for (y, left, right) in [(838.0, 30.0, 800.0), (852.0, 80.0, 700.0), (870.0, 150.0, 620.0)] {
        let zigzag: Vec<DVec2> = (0..=40)
            .map(|k| {
                dvec2(
                    left + (right - left) * f64::from(k) / 40.0,
                    y + if k % 2 == 0 { 0.0 } else { 4.0 },
                )
            })
            .collect();
        doc.polyline(&zigzag, Style::stroke(SAND).stroke_opacity(0.6));
    }
}

/// A slice of the tower between two heights: lit from the left.
fn slice(doc: &mut Document, [from, to]: [f64; 2], color: Color) {
    let half = |y: f64| 34.0 + 24.0 * (y - 300.0) / 340.0;
    let at = |y: f64, t: f64| dvec2(398.0 + half(y) * t, y);
    for (left, right, light) in [
        (-1.0, -0.35, [-0.12, 0.22]),
        (-0.35, 0.35, [0.22, -0.1]),
        (0.35, 1.0, [-0.1, -0.52]),
    ] {
        let [a, b] = light.map(|amount| color.shade(amount));
        doc.color_quad(
            [at(from, left), at(from, right), at(to, right), at(to, left)],
            [a, b, b, a],
        );
    }
}

fn tower(doc: &mut Document) {
    for k in 0..7 {
        let color = if k % 2 == 0 { PAPER } else { CORAL.mix(BRICK, 0.4) };
        slice(doc, [300.0 + 49.0 * f64::from(k), 349.0 + 49.0 * f64::from(k)], color);
    }
    for y in [372.0, 470.0, 568.0] {
        doc.polygon(
            &[
                dvec2(390.0, y + 22.0),
                dvec2(390.0, y + 6.0),
                dvec2(398.0, y - 4.0),
                dvec2(406.0, y + 6.0),
                dvec2(406.0, y + 22.0),
            ],
            Style::fill(INK),
        );
    }
    // Gallery, lantern, dome.
    doc.polygon(
        &[(340.0, 288.0), (456.0, 288.0), (440.0, 304.0), (356.0, 304.0)].map(|(x, y)| dvec2(x, y)),
        Style::fill(INK),
    );
    doc.polygon(
        &[(372.0, 232.0), (424.0, 232.0), (428.0, 288.0), (368.0, 288.0)].map(|(x, y)| dvec2(x, y)),
        Style::fill(AMBER),
    );
    doc.polygon(&regular(LAMP, 17.0, 20, 0.0), Style::fill(WHITE));
    for x in [-18.0, 0.0, 18.0] {
        doc.line(
            [dvec2(398.0 + x, 232.0), dvec2(398.0 + x * 1.1, 288.0)],
            Style::stroke(INK),
        );
    }
    let mut dome = arc(dvec2(398.0, 234.0), 34.0, [TAU / 2.0, TAU], 16);
    dome.push(dvec2(398.0 + 34.0, 236.0));
    doc.polygon(&dome, Style::fill(BRICK));
    doc.polygon(
        &[dvec2(394.0, 204.0), dvec2(398.0, 168.0), dvec2(402.0, 204.0)],
        Style::fill(INK),
    );
    for k in 0..=12 {
        let x = 342.0 + 112.0 * f64::from(k) / 12.0;
        doc.line([dvec2(x, 268.0), dvec2(x, 288.0)], Style::stroke(INK));
    }
    doc.line([dvec2(342.0, 268.0), dvec2(454.0, 268.0)], Style::stroke(INK));
}

fn house(doc: &mut Document) {
    doc.color_quad(
        [(452.0, 596.0), (560.0, 596.0), (560.0, 668.0), (452.0, 668.0)].map(|(x, y)| dvec2(x, y)),
        [PAPER, MIST, SLATE, MIST],
    );
    doc.polygon(
        &[(440.0, 600.0), (470.0, 556.0), (545.0, 556.0), (574.0, 600.0)].map(|(x, y)| dvec2(x, y)),
        Style::fill(BRICK.shade(-0.2)),
    );
    for x in [470.0, 522.0] {
        doc.rect(dvec2(x, 616.0), dvec2(22.0, 24.0), Style::fill(AMBER));
        doc.line([dvec2(x + 11.0, 616.0), dvec2(x + 11.0, 640.0)], Style::stroke(INK));
    }
    doc.rect(dvec2(500.0, 536.0), dvec2(12.0, 30.0), Style::fill(INK));
}
