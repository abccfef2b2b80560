//! `svg/basic/test6.svg`: a locomotive of mixed shapes in groups within groups.

use glam::{DVec2, dvec2};

use super::super::document::{Document, Style};
use super::super::palette::{AMBER, BRICK, CORAL, Color, INK, MIST, PAPER, PINE, SAND, SEA, SKY, SLATE, TEAL, WHITE};
use super::super::steady::{TAU, polar};
use super::outline::regular;

/// The document.
pub(super) fn locomotive() -> String {
    let mut doc = Document::new(
        1000.0,
        750.0,
        &[
            "Every kind of shape, in groups within groups: rect, polygon, polyline and line, moved, scaled and turned.",
            "A wheel is one group, placed five times; the engine is a group of groups. Space, wheel and [ ] move the whole.",
            "Press = and see which edges get smoother: fills do, hairlines such as spokes and rails don't.",
        ],
    );
    doc.rect(DVec2::ZERO, dvec2(1000.0, 750.0), Style::fill(SKY.mix(PAPER, 0.55)));
    scenery(&mut doc);
    doc.open("transform=\"translate(500 612)\"");
    engine(&mut doc);
    doc.close();
    doc.finish()
}

fn scenery(doc: &mut Document) {
    doc.polygon(&regular(dvec2(800.0, 170.0), 62.0, 40, 0.0), Style::fill(AMBER));
    let hills = [
        (
            SEA.mix(PAPER, 0.35),
            [470.0, 400.0, 330.0, 390.0, 350.0, 300.0, 380.0, 420.0, 360.0],
        ),
        (
            SEA.mix(PINE, 0.35),
            [520.0, 480.0, 500.0, 430.0, 470.0, 500.0, 450.0, 470.0, 520.0],
        ),
    ];
    for (color, heights) in hills {
        let mut points: Vec<DVec2> = heights
            .iter()
            .enumerate()
            .map(|(k, &y)| dvec2(125.0 * k as f64, y))
            .collect();
        points.extend([dvec2(1000.0, 660.0), dvec2(0.0, 660.0)]);
        doc.polygon(&points, Style::fill(color));
    }
    doc.rect(dvec2(0.0, 618.0), dvec2(1000.0, 132.0), Style::fill(SAND));
    for k in 0..25 {
        let x = 40.0 * f64::from(k);
        doc.rect(dvec2(x, 636.0), dvec2(22.0, 12.0), Style::fill(SLATE.mix(SAND, 0.3)));
    }
    doc.rect(dvec2(0.0, 628.0), dvec2(1000.0, 8.0), Style::fill(INK));
    for y in [690.0, 702.0, 720.0] {
        doc.line([dvec2(0.0, y), dvec2(1000.0, y)], Style::stroke(SLATE));
    }
}

fn engine(doc: &mut Document) {
    smoke(doc);
    // Boiler, chimney, dome, lamp.
    doc.open("transform=\"translate(60 -150)\"");
    doc.rect(dvec2(-180.0, -62.0), dvec2(370.0, 124.0), Style::fill(TEAL));
    doc.rect(
        dvec2(-180.0, -62.0),
        dvec2(370.0, 26.0),
        Style::fill(TEAL.mix(WHITE, 0.28)),
    );
    doc.rect(dvec2(-180.0, 36.0), dvec2(370.0, 26.0), Style::fill(TEAL.mix(INK, 0.3)));
    for x in [-110.0, -20.0, 70.0] {
        doc.rect(dvec2(x, -62.0), dvec2(10.0, 124.0), Style::fill(AMBER));
    }
    doc.rect(dvec2(160.0, -70.0), dvec2(40.0, 140.0), Style::fill(INK));
    doc.open("transform=\"translate(132 -62)\"");
    let chimney = [
        (-24.0, 0.0),
        (24.0, 0.0),
        (30.0, -84.0),
        (46.0, -98.0),
        (-46.0, -98.0),
        (-30.0, -84.0),
    ];
    doc.polygon(&chimney.map(|(x, y)| dvec2(x, y)), Style::fill(INK));
    doc.rect(dvec2(-50.0, -110.0), dvec2(100.0, 14.0), Style::fill(CORAL));
    doc.close();
    doc.open("transform=\"translate(10 -62) scale(0.8)\"");
    let dome: Vec<DVec2> = (0..=14)
        .map(|k| polar(48.0, TAU / 2.0 + TAU / 28.0 * f64::from(k)))
        .collect();
    doc.polygon(&dome, Style::fill(AMBER));
    doc.close();
    doc.polygon(
        &regular(dvec2(200.0, -84.0), 17.0, 16, 0.0),
        Style::fill(AMBER.mix(WHITE, 0.5)).outlined(INK),
    );
    doc.close();
    cab(doc);
    // Frame, buffer, cow catcher.
    doc.rect(dvec2(-300.0, -92.0), dvec2(600.0, 26.0), Style::fill(BRICK));
    doc.polygon(
        &[(268.0, -70.0), (300.0, -70.0), (370.0, 8.0), (268.0, 8.0)].map(|(x, y)| dvec2(x, y)),
        Style::fill(BRICK),
    );
    for k in 1..6 {
        let x = 268.0 + 17.0 * f64::from(k);
        doc.line(
            [dvec2(280.0 + 3.0 * f64::from(k), -70.0), dvec2(x, 8.0)],
            Style::stroke(PAPER),
        );
    }
    for (place, scale) in [(-215.0, 1.0), (-75.0, 1.0), (65.0, 1.0)] {
        wheel(doc, dvec2(place, -56.0), scale);
    }
    for place in [172.0, 244.0] {
        wheel(doc, dvec2(place, -24.0), 0.55);
    }
    rod(doc);
}

fn cab(doc: &mut Document) {
    doc.open("transform=\"translate(-222 -90)\"");
    doc.rect(dvec2(-92.0, -190.0), dvec2(184.0, 190.0), Style::fill(CORAL));
    doc.rect(
        dvec2(-92.0, -40.0),
        dvec2(184.0, 40.0),
        Style::fill(CORAL.mix(INK, 0.25)),
    );
    doc.polygon(
        &[(-116.0, -190.0), (116.0, -190.0), (96.0, -216.0), (-96.0, -216.0)].map(|(x, y)| dvec2(x, y)),
        Style::fill(INK),
    );
    for x in [-70.0, 10.0] {
        doc.open(&format!("transform=\"translate({x} -165)\""));
        doc.rect(DVec2::ZERO, dvec2(60.0, 74.0), Style::fill(SKY).outlined(INK));
        doc.polygon(
            &[(0.0, 50.0), (42.0, 0.0), (58.0, 0.0), (0.0, 70.0)].map(|(x, y)| dvec2(x, y)),
            Style::fill(WHITE).opacity(0.5),
        );
        doc.close();
    }
    doc.close();
}

fn smoke(doc: &mut Document) {
    doc.open("transform=\"translate(192 -340)\"");
    for (k, (x, y, scale)) in [
        (0.0, 0.0, 0.8),
        (-62.0, -50.0, 1.1),
        (-150.0, -88.0, 1.5),
        (-262.0, -108.0, 1.9),
    ]
    .iter()
    .enumerate()
    {
        doc.open(&format!(
            "transform=\"translate({x} {y}) scale({scale}) rotate({})\"",
            11 * k
        ));
        doc.polygon(
            &regular(DVec2::ZERO, 34.0, 9, 0.0),
            Style::fill(WHITE).opacity(0.9 - 0.14 * k as f64),
        );
        doc.close();
    }
    doc.close();
}

fn wheel(doc: &mut Document, at: DVec2, scale: f64) {
    doc.open(&format!("transform=\"translate({} {}) scale({scale})\"", at.x, at.y));
    let disc =
        |radius: f64, corners: u32, color: Color| (regular(DVec2::ZERO, radius, corners, 0.0), Style::fill(color));
    for (radius, color) in [(68.0, INK), (58.0, MIST), (52.0, INK.mix(SLATE, 0.4))] {
        let (points, style) = disc(radius, 32, color);
        doc.polygon(&points, style);
    }
    for k in 0..6 {
        doc.open(&format!("transform=\"rotate({})\"", 60 * k + 12));
        doc.polygon(
            &[(-4.0, 0.0), (4.0, 0.0), (6.0, 53.0), (-6.0, 53.0)].map(|(x, y)| dvec2(x, y)),
            Style::fill(MIST),
        );
        doc.line([DVec2::ZERO, dvec2(0.0, 58.0)], Style::stroke(INK));
        doc.close();
    }
    let (points, style) = disc(15.0, 16, CORAL);
    doc.polygon(&points, style);
    doc.close();
}

fn rod(doc: &mut Document) {
    doc.open("transform=\"translate(-75 -30)\"");
    doc.rect(
        dvec2(-150.0, -7.0),
        dvec2(300.0, 14.0),
        Style::fill(PAPER).outlined(INK),
    );
    for x in [-140.0, 0.0, 140.0] {
        doc.polygon(&regular(dvec2(x, 0.0), 13.0, 16, 0.0), Style::fill(AMBER).outlined(INK));
    }
    doc.polyline(
        &[(140.0, 0.0), (250.0, -46.0), (300.0, -46.0)].map(|(x, y)| dvec2(x, y)),
        Style::stroke(PAPER),
    );
    doc.close();
}
