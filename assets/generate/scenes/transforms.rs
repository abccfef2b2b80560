//! `svg/transforms`: figures of groups of groups. A joint is a group; what hangs on it moves with it.

use glam::{DVec2, dvec2};

use super::super::SceneFile;
use super::super::document::{Document, Style};
use super::super::palette::{AMBER, BRICK, CORAL, Color, INK, MIST, NIGHT, PAPER, SAND, SEA, SKY, SLATE, TEAL, WHITE};
use super::super::steady::TAU;
use super::outline::{limb, rectangle, regular};

pub(super) const SCENES: &[SceneFile] = &[
    SceneFile {
        path: "svg/transforms/robot.svg",
        make: robot,
    },
    SceneFile {
        path: "svg/transforms/runner.svg",
        make: runner,
    },
];

/// A box of this size with its centre at the origin.
fn block(doc: &mut Document, width: f64, height: f64, color: Color) {
    let corner = dvec2(width, height) * 0.5;
    doc.polygon(&rectangle(-corner, corner), Style::fill(color));
}

fn disc(doc: &mut Document, radius: f64, color: Color) {
    doc.polygon(&regular(DVec2::ZERO, radius, 20, TAU / 40.0), Style::fill(color));
}

fn robot() -> String {
    let mut doc = Document::new(
        800.0,
        800.0,
        &[
            "A robot of groups within groups: shoulder, upper arm, elbow, forearm, hand. Change one number of one transform",
            "in a copy of this file and everything that hangs on that joint follows.",
            "[ and ] turn the picture, the wheel zooms, Space goes back. The feet are skewed, the face is scaled.",
        ],
    );
    doc.rect(DVec2::ZERO, dvec2(800.0, 800.0), Style::fill(SEA.mix(PAPER, 0.62)));
    doc.rect(dvec2(0.0, 690.0), dvec2(800.0, 110.0), Style::fill(SAND));
    doc.open("transform=\"translate(400 400)\"");
    doc.open("transform=\"translate(0 296) scale(1 0.12)\"");
    disc(&mut doc, 210.0, SAND.mix(SLATE, 0.4));
    doc.close();
    for (side, color) in [(-1.0, TEAL), (1.0, TEAL.mix(INK, 0.2))] {
        leg(&mut doc, side, color);
    }
    // The left arm hangs, the right one waves.
    arm(&mut doc, -1.0, -24.0, 18.0);
    arm(&mut doc, 1.0, -128.0, -38.0);
    torso(&mut doc);
    head(&mut doc);
    doc.close();
    doc.finish()
}

fn torso(doc: &mut Document) {
    doc.open("transform=\"translate(0 10)\"");
    block(doc, 190.0, 200.0, TEAL);
    doc.open("transform=\"translate(0 -86)\"");
    block(doc, 190.0, 28.0, TEAL.mix(WHITE, 0.3));
    doc.close();
    doc.open("transform=\"translate(0 4)\"");
    block(doc, 128.0, 92.0, NIGHT);
    for k in 0..5 {
        doc.open(&format!(
            "transform=\"translate({} 24) scale(1 {})\"",
            -44 + 22 * k,
            [0.5, 0.9, 0.65, 1.3, 1.0][k as usize]
        ));
        doc.polygon(
            &rectangle(dvec2(-7.0, -44.0), dvec2(7.0, 0.0)),
            Style::fill([SEA, AMBER, CORAL, AMBER, SEA][k as usize]),
        );
        doc.close();
    }
    doc.close();
    for x in [-60.0, -20.0, 20.0, 60.0] {
        doc.open(&format!("transform=\"translate({x} 76)\""));
        disc(doc, 8.0, PAPER);
        doc.close();
    }
    doc.close();
}

fn head(doc: &mut Document) {
    doc.open("transform=\"translate(0 -108)\"");
    block(doc, 54.0, 36.0, SLATE);
    doc.open("transform=\"translate(0 -82) rotate(-7)\"");
    doc.line([dvec2(0.0, -60.0), dvec2(0.0, -112.0)], Style::stroke(INK));
    doc.open("transform=\"translate(0 -118) rotate(22.5)\"");
    disc(doc, 13.0, CORAL);
    doc.close();
    block(doc, 176.0, 132.0, AMBER);
    for side in [-1.0, 1.0] {
        doc.open(&format!("transform=\"translate({} 0)\"", 98.0 * side));
        block(doc, 22.0, 56.0, BRICK);
        doc.close();
        doc.open(&format!("transform=\"translate({} -16)\"", 42.0 * side));
        disc(doc, 29.0, WHITE);
        doc.open("transform=\"translate(6 -4) scale(0.5)\"");
        disc(doc, 29.0, INK);
        doc.open("transform=\"translate(9 -9) scale(0.3)\"");
        disc(doc, 29.0, WHITE);
        doc.close();
        doc.close();
        doc.close();
    }
    doc.open("transform=\"translate(0 40) scale(1.1 0.8)\"");
    doc.polygon(
        &[(-44.0, -8.0), (44.0, -8.0), (26.0, 14.0), (-26.0, 14.0)].map(|(x, y)| dvec2(x, y)),
        Style::fill(BRICK),
    );
    doc.polygon(&rectangle(dvec2(-34.0, -8.0), dvec2(34.0, 0.0)), Style::fill(WHITE));
    doc.close();
    doc.close();
    doc.close();
}

fn arm(doc: &mut Document, side: f64, shoulder: f64, elbow: f64) {
    doc.open(&format!(
        "transform=\"translate({} -62) scale({side} 1) rotate({shoulder})\"",
        108.0 * side
    ));
    doc.polygon(&limb(92.0, 25.0, 17.0), Style::fill(TEAL.mix(INK, 0.18)));
    disc(doc, 20.0, AMBER);
    doc.open(&format!("transform=\"translate(0 96) rotate({elbow})\""));
    doc.polygon(&limb(82.0, 15.0, 20.0), Style::fill(MIST));
    disc(doc, 15.0, CORAL);
    doc.open("transform=\"translate(0 92)\"");
    for turn in [-48, -6, 40] {
        doc.open(&format!("transform=\"rotate({turn})\""));
        doc.polygon(&limb(38.0, 12.0, 7.0), Style::fill(AMBER));
        doc.close();
    }
    disc(doc, 21.0, BRICK);
    doc.close();
    doc.close();
    doc.close();
}

fn leg(doc: &mut Document, side: f64, color: Color) {
    doc.open(&format!(
        "transform=\"translate({} 106) rotate({})\"",
        52.0 * side,
        -3.0 * side
    ));
    doc.polygon(&limb(74.0, 28.0, 20.0), Style::fill(color));
    doc.open("transform=\"translate(0 82)\"");
    doc.polygon(&limb(70.0, 20.0, 24.0), Style::fill(MIST));
    disc(doc, 17.0, CORAL);
    doc.open(&format!(
        "transform=\"translate({} 88) skewX({})\"",
        14.0 * side,
        -24.0 * side
    ));
    block(doc, 104.0, 40.0, BRICK);
    doc.close();
    doc.close();
    doc.close();
}

/// The angles of a stride in degrees; positive turns a hanging limb towards the left.
struct Stride {
    lean: f64,
    thighs: [f64; 2],
    knees: [f64; 2],
    shoulders: [f64; 2],
    elbows: [f64; 2],
}

fn runner() -> String {
    let mut doc = Document::new(
        1000.0,
        700.0,
        &[
            "A runner: each limb hangs on the one above it, and the same figure is placed four times, three of them fainter.",
            "The faint ones are translucent: where their limbs overlap, colours mix in painter's order. Z reads the mixtures.",
            "[ and ] turn the track; at rate 1 the limbs have stairs, = smooths them.",
        ],
    );
    doc.rect(DVec2::ZERO, dvec2(1000.0, 700.0), Style::fill(PAPER));
    doc.polygon(
        &regular(dvec2(735.0, 265.0), 205.0, 72, 0.0),
        Style::fill(AMBER).opacity(0.85),
    );
    doc.polygon(
        &rectangle(dvec2(0.0, 560.0), dvec2(1000.0, 700.0)),
        Style::fill(CORAL.mix(SAND, 0.35)),
    );
    for k in 0..4 {
        let y = 572.0 + 11.0 * f64::from(k * k) + 12.0 * f64::from(k);
        doc.line([dvec2(0.0, y), dvec2(1000.0, y)], Style::stroke(PAPER));
    }
    for (k, opacity) in [(0, 0.16), (1, 0.28), (2, 0.45), (3, 1.0)] {
        let t = f64::from(k) / 3.0;
        let stride = Stride {
            lean: 8.0 + 6.0 * t,
            thighs: [28.0 - 100.0 * t, -40.0 + 85.0 * t],
            knees: [95.0 - 25.0 * t, 30.0 + 32.0 * t],
            shoulders: [-45.0 + 100.0 * t, 50.0 - 95.0 * t],
            elbows: [-85.0 - 10.0 * t, -60.0 - 45.0 * t],
        };
        let rise = 24.0 * t * (1.0 - t) + if k == 3 { 30.0 } else { 0.0 };
        doc.open(&format!("transform=\"translate({} {})\"", 170 + 172 * k, 385.0 - rise));
        figure(&mut doc, &stride, opacity);
        doc.close();
    }
    doc.finish()
}

fn figure(doc: &mut Document, stride: &Stride, opacity: f64) {
    let paint = |color: Color| Style::fill(color).opacity(opacity);
    let leg = |doc: &mut Document, k: usize, skin: Color, shoe: Color| {
        doc.open(&format!("transform=\"rotate({:.1})\"", stride.thighs[k]));
        doc.polygon(&limb(84.0, 27.0, 17.0), paint(skin));
        doc.open(&format!("transform=\"translate(0 86) rotate({:.1})\"", stride.knees[k]));
        doc.polygon(&limb(84.0, 16.0, 10.0), paint(skin));
        doc.open("transform=\"translate(0 90) rotate(-84)\"");
        doc.polygon(&limb(44.0, 13.0, 9.0), paint(shoe));
        doc.close();
        doc.close();
        doc.close();
    };
    let arm = |doc: &mut Document, k: usize, skin: Color| {
        doc.open(&format!(
            "transform=\"translate(0 -108) rotate({:.1})\"",
            stride.shoulders[k]
        ));
        doc.polygon(&limb(58.0, 16.0, 11.0), paint(skin));
        doc.open(&format!(
            "transform=\"translate(0 60) rotate({:.1})\"",
            stride.elbows[k]
        ));
        doc.polygon(&limb(58.0, 11.0, 8.0), paint(skin));
        doc.close();
        doc.close();
    };
    let (near, far) = (NIGHT, SLATE);
    doc.open(&format!("transform=\"rotate({:.1})\"", stride.lean));
    arm(doc, 1, far);
    doc.close();
    leg(doc, 1, far, BRICK);
    leg(doc, 0, near, CORAL);
    doc.open(&format!("transform=\"rotate({:.1})\"", stride.lean));
    doc.polygon(
        &[
            (-24.0, 10.0),
            (24.0, 10.0),
            (34.0, -118.0),
            (12.0, -132.0),
            (-22.0, -126.0),
            (-34.0, -104.0),
        ]
        .map(|(x, y)| dvec2(x, y)),
        paint(TEAL),
    );
    doc.polygon(
        &[(-28.0, -40.0), (29.0, -46.0), (31.0, -66.0), (-30.0, -58.0)].map(|(x, y)| dvec2(x, y)),
        paint(SKY),
    );
    doc.open("transform=\"translate(10 -136) rotate(4)\"");
    doc.polygon(&rectangle(dvec2(-11.0, -20.0), dvec2(11.0, 14.0)), paint(near));
    doc.open("transform=\"translate(6 -46)\"");
    doc.polygon(&regular(DVec2::ZERO, 35.0, 24, 0.0), paint(near));
    doc.polygon(
        &[
            (-36.0, -14.0),
            (33.0, -20.0),
            (34.0, -8.0),
            (-36.0, -2.0),
            (-66.0, 10.0),
            (-60.0, -8.0),
        ]
        .map(|(x, y)| dvec2(x, y)),
        paint(CORAL),
    );
    doc.close();
    doc.close();
    arm(doc, 0, near);
    doc.close();
}
