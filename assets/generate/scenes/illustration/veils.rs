//! Hills in mist, in the svg dialect: groups with an opacity of their own.

use glam::{DVec2, dvec2};

use super::outline::regular;
use super::palette::{AMBER, CORAL, Color, INK, NIGHT, PAPER, PINE, PLUM, SAND, TEAL, hex};
use super::steady::sin;
use super::{Chance, Document, Style, noise};

/// The document.
pub(super) fn veils() -> String {
    let mut doc = Document::new(
        1200.0,
        800.0,
        &[
            "Hills in mist, in the dialect svg: each row of trees is a group with an opacity, so overlapping trees don't show",
            "through each other; the bands of mist have a fill-opacity each, so they do. Compare Z on two overlapping trees",
            "with Z where two bands of mist overlap. Set the dialect to course: groups lose their opacity, strokes their width.",
        ],
    );
    doc.raw("<svg width=\"1200\" height=\"800\" overflow=\"visible\">");
    doc.rect(DVec2::ZERO, dvec2(1200.0, 800.0), Style::fill(hex(0xF3D9B8)));
    for k in 0..9 {
        let t = f64::from(k) / 9.0;
        let tone = hex(0x8FB5BF).mix(hex(0xF7E3C4), t);
        doc.rect(dvec2(0.0, 44.0 * f64::from(k)), dvec2(1200.0, 46.0), Style::fill(tone));
    }
    for (radius, opacity) in [(150.0, 0.22), (120.0, 0.3), (92.0, 1.0)] {
        doc.polygon(
            &regular(dvec2(840.0, 286.0), radius, 72, 0.0),
            Style::fill(AMBER.mix(PAPER, 0.45)).opacity(opacity),
        );
    }
    hills(&mut doc);
    for (x, y, size) in [
        (300.0, 170.0, 1.0),
        (352.0, 140.0, 0.8),
        (410.0, 186.0, 0.7),
        (262.0, 214.0, 0.6),
    ] {
        let wing = [(-26.0, -8.0), (-10.0, -12.0), (0.0, 0.0), (10.0, -12.0), (26.0, -8.0)];
        let points = wing.map(|(dx, dy)| dvec2(x + dx * size, y + dy * size));
        doc.polyline(
            &points,
            Style::stroke(INK).with("stroke-width=\"3\" stroke-linejoin=\"round\" stroke-linecap=\"round\""),
        );
    }
    doc.raw("</svg>");
    doc.finish()
}

/// A fir: three triangles on top of each other.
fn tree(doc: &mut Document, foot: DVec2, size: DVec2, color: Color) {
    for storey in 0..3 {
        let t = f64::from(storey) / 3.0;
        let wide = size.x * (1.0 - 0.25 * f64::from(storey));
        let low = foot.y - size.y * t * 0.8;
        let high = low - size.y * 0.52;
        doc.polygon(
            &[
                dvec2(foot.x - wide, low),
                dvec2(foot.x, high),
                dvec2(foot.x + wide, low),
            ],
            Style::fill(color),
        );
    }
}

fn mist(doc: &mut Document, y: f64, seed: usize) {
    let edge = |x: f64, side: f64| {
        let thick = 26.0 * noise(90 + seed as u64, x / 190.0, 0.2);
        dvec2(x, y + side * thick + 10.0 * sin(x / 160.0 + seed as f64))
    };
    let mut band: Vec<DVec2> = (0..=40).map(|i| edge(30.0 * f64::from(i), -1.0)).collect();
    band.extend((0..=40).rev().map(|i| edge(30.0 * f64::from(i), 1.0)));
    doc.polygon(&band, Style::fill(PAPER).opacity(0.17));
}

/// Five ridges with their trees, and mist between them.
fn hills(doc: &mut Document) {
    let mut chance = Chance::new(31);
    let layers: [(f64, f64, Color); 5] = [
        (396.0, 130.0, PLUM.mix(CORAL, 0.35).mix(SAND, 0.45)),
        (458.0, 110.0, PLUM.mix(TEAL, 0.35).mix(SAND, 0.25)),
        (530.0, 100.0, TEAL.mix(NIGHT, 0.25)),
        (612.0, 90.0, PINE.mix(NIGHT, 0.4)),
        (706.0, 80.0, INK),
    ];
    for (k, (base, swing, color)) in layers.into_iter().enumerate() {
        let height = |x: f64| {
            base - swing * (noise(70 + k as u64, x / 260.0, 0.7) - 0.45) * 1.5 - 9.0 * sin(x / 47.0 + 2.0 * k as f64)
        };
        let mut ridge: Vec<DVec2> = (0..=80)
            .map(|i| f64::from(i) * 15.0)
            .map(|x| dvec2(x, height(x)))
            .collect();
        ridge.extend([dvec2(1200.0, 800.0), dvec2(0.0, 800.0)]);
        doc.polygon(&ridge, Style::fill(color));
        if k >= 1 {
            doc.open(
                [
                    "",
                    "opacity=\"0.55\"",
                    "opacity=\"0.7\"",
                    "opacity=\"0.85\"",
                    "opacity=\"1\"",
                ][k],
            );
            let size = 10.0 + 9.0 * k as f64;
            for _ in 0..(70 - 11 * k) {
                let x = chance.range(30.0, 1170.0);
                let tall = size * chance.range(1.6, 3.2);
                tree(
                    doc,
                    dvec2(x, height(x) + 6.0),
                    dvec2(size * 0.5, tall),
                    color.shade(-0.12),
                );
            }
            doc.close();
        }
        for band in 0..3 {
            mist(doc, base + 40.0 + 16.0 * f64::from(band), k * 3 + band as usize);
        }
    }
}
