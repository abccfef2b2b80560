//! A poster of broad strokes in the svg dialect: widths, joins, caps.

use glam::{DVec2, dvec2};

use super::outline::{arc, regular};
use super::palette::{AMBER, BRICK, CORAL, Color, INK, NIGHT, PAPER, SAND, SEA, TEAL};
use super::steady::{TAU, polar};
use super::{Document, Style};

const MITER: &str = "stroke-width=\"12\" stroke-linejoin=\"miter\"";
const ROUND: &str = "stroke-width=\"12\" stroke-linejoin=\"round\" stroke-linecap=\"round\"";
const BEVEL: &str = "stroke-width=\"12\" stroke-linejoin=\"bevel\"";
const FINE: &str = "stroke-width=\"4\"";

/// The document.
pub(super) fn poster() -> String {
    let mut doc = Document::new(
        800.0,
        1000.0,
        &[
            "A poster of broad strokes, in the dialect svg: mitred towers, bevelled steps, round waves.",
            "Turn the wheel on a corner to see its join; press = : here strokes are areas, so they get smooth like any fill.",
            "Set the dialect to course: every stroke becomes a hairline of one pixel, at every zoom.",
        ],
    );
    doc.raw("<svg width=\"800\" height=\"1000\" overflow=\"visible\">");
    doc.rect(DVec2::ZERO, dvec2(800.0, 1000.0), Style::fill(NIGHT.mix(INK, 0.4)));
    rays(&mut doc);
    towers(&mut doc);
    waves(&mut doc);
    for (inset, more) in [(22.0, MITER), (42.0, FINE)] {
        let frame = [
            (inset, inset),
            (800.0 - inset, inset),
            (800.0 - inset, 1000.0 - inset),
            (inset, 1000.0 - inset),
        ];
        doc.polygon(&frame.map(|(x, y)| dvec2(x, y)), Style::stroke(AMBER).with(more));
    }
    doc.raw("</svg>");
    doc.finish()
}

/// A rising sun: wedges, and rings of rays with round ends.
fn rays(doc: &mut Document) {
    let sun = dvec2(400.0, 548.0);
    for k in 0..24 {
        if k % 2 == 1 {
            continue;
        }
        let angle = |k: i32| TAU / 2.0 + TAU / 2.0 * f64::from(k) / 24.0;
        // As far as the inner frame.
        let end = |k: i32| {
            let way = polar(1.0, angle(k));
            let across = if way.x.abs() > 1e-9 {
                352.0 / way.x.abs()
            } else {
                f64::INFINITY
            };
            sun + way * across.min(500.0 / way.y.abs().max(1e-9))
        };
        doc.polygon(&[sun, end(k), end(k + 1)], Style::fill(TEAL).opacity(0.28));
    }
    for (radius, color, more) in [
        (278.0, SEA, FINE),
        (264.0, SEA, FINE),
        (242.0, AMBER, ROUND),
        (216.0, CORAL, ROUND),
    ] {
        doc.polyline(&arc(sun, radius, [TAU / 2.0, TAU], 72), Style::stroke(color).with(more));
    }
    for k in 1..16 {
        let angle = TAU / 2.0 + TAU / 2.0 * f64::from(k) / 16.0;
        let reach = if k % 2 == 0 { 334.0 } else { 316.0 };
        doc.line(
            [sun + polar(298.0, angle), sun + polar(reach, angle)],
            Style::stroke(AMBER).with(ROUND),
        );
    }
    doc.polygon(&arc(sun, 190.0, [TAU / 2.0, TAU], 60), Style::fill(AMBER));
}

/// Stepped towers in outline, darker ones behind.
fn towers(doc: &mut Document) {
    let stepped = |x: f64, half: f64, top: f64, steps: u32| {
        let mut left = Vec::new();
        for k in 0..=steps {
            let t = f64::from(k) / f64::from(steps);
            let wide = half * (0.34 + 0.66 * t);
            let y = top + (700.0 - top) * 0.42 * t * t;
            left.push(dvec2(x - wide, y));
            if k < steps {
                let next = top
                    + (700.0 - top)
                        * 0.42
                        * (f64::from(k + 1) / f64::from(steps))
                        * (f64::from(k + 1) / f64::from(steps));
                left.push(dvec2(x - wide, next));
            }
        }
        let right: Vec<DVec2> = left.iter().rev().map(|p| dvec2(2.0 * x - p.x, p.y)).collect();
        let mut all = vec![dvec2(x - half, 720.0)];
        all.extend(left.into_iter().rev());
        all.extend(right.into_iter().rev());
        all.push(dvec2(x + half, 720.0));
        all
    };
    let mut tower = |x: f64, half: f64, top: f64, colors: [Color; 2], more: &'static str| {
        doc.polygon(
            &stepped(x, half, top, 4),
            Style::fill(colors[0]).outlined(colors[1]).with(more),
        );
        let mut y = top + (700.0 - top) * 0.46;
        while y < 700.0 {
            for side in [-0.55, 0.0, 0.55] {
                doc.line(
                    [dvec2(x + side * half, y), dvec2(x + side * half, y + 16.0)],
                    Style::stroke(colors[1]).with(FINE),
                );
            }
            y += 30.0;
        }
    };
    tower(178.0, 74.0, 478.0, [NIGHT, SEA], BEVEL);
    tower(622.0, 74.0, 452.0, [NIGHT, SEA], BEVEL);
    tower(286.0, 70.0, 392.0, [BRICK, SAND], ROUND);
    tower(520.0, 66.0, 470.0, [BRICK, SAND], ROUND);
    tower(402.0, 84.0, 236.0, [INK, AMBER], MITER);
    doc.polyline(
        &[dvec2(384.0, 228.0), dvec2(402.0, 140.0), dvec2(420.0, 228.0)],
        Style::stroke(AMBER).with("stroke-width=\"12\" stroke-linejoin=\"miter\" stroke-miterlimit=\"12\""),
    );
    doc.polygon(&regular(dvec2(402.0, 112.0), 15.0, 32, 0.0), Style::fill(CORAL));
}

/// Scales of water, row over row.
fn waves(doc: &mut Document) {
    doc.rect(
        dvec2(48.0, 714.0),
        dvec2(704.0, 238.0),
        Style::fill(TEAL.mix(INK, 0.35)),
    );
    doc.line(
        [dvec2(48.0, 714.0), dvec2(752.0, 714.0)],
        Style::stroke(AMBER).with(MITER),
    );
    for row in 0..5 {
        let radius = 44.0;
        let shift = if row % 2 == 0 { 0.0 } else { radius };
        let mut x = 48.0 + radius - shift;
        while x < 752.0 + shift {
            let center = dvec2(x, 772.0 + 44.0 * f64::from(row));
            let tones = [SEA, TEAL.mix(SEA, 0.4), PAPER];
            for (k, color) in tones.into_iter().enumerate() {
                let angles = if x < 60.0 {
                    [-TAU / 4.0, 0.0]
                } else if x > 740.0 {
                    [TAU / 2.0, TAU * 0.75]
                } else {
                    [TAU / 2.0, TAU]
                };
                let curve = arc(center, radius - 6.0 - 12.0 * k as f64, angles, 20);
                doc.polyline(
                    &curve,
                    Style::stroke(color).with("stroke-width=\"5\" stroke-linecap=\"round\""),
                );
            }
            x += 2.0 * radius;
        }
    }
}
