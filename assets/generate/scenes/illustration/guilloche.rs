//! Guilloche: rosettes of hairlines as on banknotes.

use glam::{DVec2, dvec2};

use super::palette::{BRICK, CORAL, Color, INK, PAPER, PLUM, SAND, SEA, SKY, TEAL};
use super::steady::{TAU, cos, polar, sin};
use super::{Document, Style};

const MIDDLE: DVec2 = dvec2(500.0, 500.0);

/// One family of curves.
struct Family {
    radius: f64,
    swing: f64,
    waves: f64,
    curves: u32,
    color: Color,
}

/// The document.
pub(super) fn guilloche() -> String {
    let mut doc = Document::new(
        1000.0,
        1000.0,
        &[
            "Guilloche, the line work of banknotes: 84 closed curves of hairlines, half transparent, so that crossings darken.",
            "A hairline is one pixel wide at every zoom: zoom out and the lace closes up to solid bands, zoom in and it opens.",
            "The rate changes nothing here: a hairline fills all samples of its pixels. Z shows the stairs, and twice-mixed crossings.",
        ],
    );
    doc.rect(DVec2::ZERO, dvec2(1000.0, 1000.0), Style::fill(PAPER));
    doc.decimals(1);
    let families = [
        Family {
            radius: 432.0,
            swing: 34.0,
            waves: 36.0,
            curves: 8,
            color: TEAL,
        },
        Family {
            radius: 352.0,
            swing: 62.0,
            waves: 12.0,
            curves: 24,
            color: INK,
        },
        Family {
            radius: 250.0,
            swing: 52.0,
            waves: 9.0,
            curves: 18,
            color: BRICK,
        },
        Family {
            radius: 250.0,
            swing: 30.0,
            waves: 18.0,
            curves: 8,
            color: CORAL,
        },
        Family {
            radius: 142.0,
            swing: 58.0,
            waves: 6.0,
            curves: 18,
            color: PLUM,
        },
        Family {
            radius: 66.0,
            swing: 22.0,
            waves: 8.0,
            curves: 8,
            color: TEAL,
        },
    ];
    for family in &families {
        for k in 0..family.curves {
            let phase = TAU * f64::from(k) / f64::from(family.curves);
            let curve = |j: u32, steps: u32| {
                let angle = TAU * f64::from(j) / f64::from(steps);
                let beat = cos(family.waves * angle + phase) + 0.22 * sin(3.0 * family.waves * angle - phase);
                MIDDLE + polar(family.radius + family.swing * beat * 0.82, angle)
            };
            let steps = (family.waves as u32 * 12).max(160);
            let points: Vec<DVec2> = (0..=steps).map(|j| curve(j, steps)).collect();
            doc.polyline(&points, Style::stroke(family.color).stroke_opacity(0.6));
        }
    }
    corners(&mut doc);
    doc.finish()
}

/// Fans of lines in the corners, and a frame.
fn corners(doc: &mut Document) {
    // Lines between two sides, whose envelope is a curve.
    for (x, y, color) in [(0.0, 0.0, SEA), (1.0, 0.0, SKY), (1.0, 1.0, SEA), (0.0, 1.0, SKY)] {
        let corner = dvec2(x, y) * 960.0 + 20.0;
        let inward = dvec2(1.0 - 2.0 * x, 1.0 - 2.0 * y);
        for k in 0..=30 {
            let t = f64::from(k) / 30.0;
            let ends = [
                corner + dvec2(inward.x * 190.0 * t, 0.0),
                corner + dvec2(0.0, inward.y * 190.0 * (1.0 - t)),
            ];
            doc.line(ends, Style::stroke(color.mix(INK, 0.25)));
        }
    }
    for inset in [12.0, 17.0] {
        let frame = [
            (inset, inset),
            (1000.0 - inset, inset),
            (1000.0 - inset, 1000.0 - inset),
            (inset, 1000.0 - inset),
        ];
        doc.polygon(&frame.map(|(x, y)| dvec2(x, y)), Style::stroke(INK.mix(SAND, 0.2)));
    }
}
