//! A rose window: panes between dark leads, twelve-fold.

use glam::{DVec2, dvec2};

use super::outline::regular;
use super::palette::{AMBER, BRICK, CORAL, Color, INK, NIGHT, PAPER, PLUM, SEA, SKY, TEAL, hex};
use super::steady::{TAU, polar, sin};
use super::{Document, Style, cell};

const MIDDLE: DVec2 = dvec2(500.0, 500.0);

/// The document.
pub(super) fn rosette() -> String {
    let mut doc = Document::new(
        1000.0,
        1000.0,
        &[
            "A rose window of several hundred panes; the leads between them are ground that shows through.",
            "The thinnest leads are about a pixel: at rate 1 they break where the window turns away from the pixel grid.",
            "Press = to mend them. [ and ] turn the window: at rate 1 each angle breaks others.",
        ],
    );
    doc.rect(DVec2::ZERO, dvec2(1000.0, 1000.0), Style::fill(hex(0x1A1522)));
    doc.polygon(&regular(MIDDLE, 484.0, 120, 0.0), Style::fill(hex(0x5A5566)));
    doc.polygon(&regular(MIDDLE, 468.0, 120, 0.0), Style::fill(hex(0x15111C)));
    // Rings of panes: radii, panes, colours.
    band(&mut doc, [438.0, 462.0], 96, &[NIGHT, TEAL, NIGHT, BRICK]);
    petals(&mut doc, [286.0, 432.0], 24, &[BRICK, TEAL, PLUM, AMBER]);
    band(&mut doc, [262.0, 281.0], 72, &[AMBER, CORAL, AMBER, SKY]);
    petals(&mut doc, [120.0, 256.0], 12, &[NIGHT.mix(SKY, 0.25), CORAL]);
    band(&mut doc, [94.0, 114.0], 36, &[AMBER, BRICK, SEA]);
    petals(&mut doc, [24.0, 90.0], 12, &[TEAL, PLUM]);
    doc.polygon(&regular(MIDDLE, 21.0, 12, 0.0), Style::fill(AMBER.mix(PAPER, 0.4)));
    doc.finish()
}

/// A pane; its colour is uneven, as old glass is.
fn pane(doc: &mut Document, points: &[DVec2], color: Color, dice: f64) {
    let middle = points.iter().sum::<DVec2>() / points.len() as f64;
    // Light comes from above left.
    let light = 0.12 - (middle - MIDDLE).dot(dvec2(0.7, 0.7)) / 2600.0 + (dice - 0.5) * 0.3;
    doc.polygon(points, Style::fill(color.shade(light)));
}

fn band(doc: &mut Document, [inner, outer]: [f64; 2], count: u32, colors: &[Color]) {
    for k in 0..count {
        let angle = |t: f64| TAU * (f64::from(k) + t) / f64::from(count);
        let gap = 1.5 / outer;
        let (from, to) = (angle(0.0) + gap, angle(1.0) - gap);
        let middle = f64::midpoint(from, to);
        let points = [
            MIDDLE + polar(inner, from),
            MIDDLE + polar(outer, from),
            MIDDLE + polar(outer + 1.0, middle),
            MIDDLE + polar(outer, to),
            MIDDLE + polar(inner, to),
        ];
        pane(
            doc,
            &points,
            colors[k as usize % colors.len()],
            cell(1, i64::from(k), inner as i64),
        );
    }
}

/// Pointed petals with an eye in each, and the spandrels between them.
fn petals(doc: &mut Document, [inner, outer]: [f64; 2], count: u32, colors: &[Color]) {
    let step = TAU / f64::from(count);
    let reach = outer - inner;
    // Half the angle of a petal at `t` from its foot to its tip.
    let half = |t: f64| {
        step * 0.5 * (0.30 + 0.66 * sin(TAU / 2.0 * (0.12 + 0.88 * t)).max(0.0)) * if t > 0.97 { 0.0 } else { 1.0 }
    };
    for k in 0..count {
        let axis = step * f64::from(k) - TAU / 4.0;
        let color = colors[k as usize % colors.len()];
        let at = |t: f64, side: f64| {
            MIDDLE
                + polar(
                    inner + reach * t,
                    axis + side * (half(t) - 1.6 / (inner + reach * t)).max(0.0),
                )
        };
        let cuts = [0.0, 0.2, 0.38, 0.6, 0.8, 1.0];
        for (n, cut) in cuts.windows(2).enumerate() {
            for side in [-1.0, 1.0] {
                // Each storey has a left and a right pane, with a lead on the axis.
                let lead = 1.3;
                let foot = |t: f64| MIDDLE + polar(inner + reach * t, axis) + polar(lead, axis + side * TAU / 4.0);
                let (from, to) = (cut[0] + 1.4 / reach, cut[1] - 1.4 / reach);
                let mut points = vec![foot(from)];
                points.extend((0..=6).map(|i| at(from + (to - from) * f64::from(i) / 6.0, side)));
                points.push(foot(to));
                let tone = if n % 2 == 0 {
                    color
                } else {
                    color.mix(AMBER, 0.22).shade(0.12)
                };
                pane(
                    doc,
                    &points,
                    tone,
                    cell(2, i64::from(k) * 16 + n as i64, (side * 3.0 + inner) as i64),
                );
            }
        }
        let eye = MIDDLE + polar(inner + reach * 0.6, axis);
        let size = reach * 0.12;
        doc.polygon(&regular(eye, size + 2.6, 20, axis), Style::fill(hex(0x15111C)));
        pane(
            doc,
            &regular(eye, size, 20, axis),
            colors[(k as usize + 1) % colors.len()].mix(PAPER, 0.35),
            0.6,
        );
        // The spandrel: what two petals leave at the rim.
        let between = axis + step / 2.0;
        let wide = step * 0.5;
        let tip = MIDDLE + polar(inner + reach * 0.66, between);
        let mut points = vec![tip];
        for i in 0..=6 {
            let s = f64::from(i) / 6.0 * 2.0 - 1.0;
            points.push(MIDDLE + polar(outer - 2.0, between + s * (wide - half(0.93) + 0.02)));
        }
        pane(
            doc,
            &points,
            colors[(k as usize + 1) % colors.len()].mix(INK, 0.25),
            cell(4, i64::from(k), inner as i64),
        );
    }
}
