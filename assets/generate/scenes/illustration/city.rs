//! A city at night and its reflection: thousands of little windows.

use glam::{DVec2, dvec2};

use super::outline::regular;
use super::palette::{AMBER, CORAL, Color, INK, MIST, NIGHT, PAPER, PLUM, SAND, SLATE, TEAL, hex};
use super::{Chance, Document, Style, sky};

const SHORE: f64 = 690.0;

/// The document.
pub(super) fn night_city() -> String {
    let mut doc = Document::new(
        1000.0,
        1000.0,
        &[
            "A city at night: some 1700 rectangles, most of them windows of a few pixels.",
            "At rate 1 windows of one size come out in different widths, because pixel centres decide; press = and they agree.",
            "Zoom out with the wheel: windows smaller than a pixel twinkle at rate 1 and melt into a glow at 16.",
        ],
    );
    sky(
        &mut doc,
        1000.0,
        [0.0, SHORE],
        &[
            hex(0x101B2D),
            hex(0x1B2A49),
            PLUM.mix(NIGHT, 0.4),
            PLUM.mix(CORAL, 0.45),
        ],
    );
    let mut chance = Chance::new(12);
    for _ in 0..200 {
        let at = dvec2(chance.range(4.0, 996.0), 430.0 * chance.unit());
        doc.rect(at, DVec2::ZERO, Style::fill(MIST.mix(PAPER, chance.unit())));
    }
    for (radius, opacity) in [(116.0, 0.06), (98.0, 0.09), (82.0, 0.14)] {
        doc.polygon(
            &regular(dvec2(240.0, 200.0), radius, 60, 0.0),
            Style::fill(SAND).opacity(opacity),
        );
    }
    doc.polygon(
        &regular(dvec2(240.0, 200.0), 66.0, 60, 0.0),
        Style::fill(PAPER.mix(SAND, 0.5)),
    );
    for (x, y, r) in [(222.0, 186.0, 14.0), (262.0, 214.0, 19.0), (250.0, 170.0, 8.0)] {
        doc.polygon(&regular(dvec2(x, y), r, 24, 0.0), Style::fill(SLATE).opacity(0.18));
    }
    let layers = [(0.30, hex(0x57466B)), (0.62, hex(0x2E3354)), (1.0, hex(0x16203A))];
    let mut towers = Vec::new();
    for (layer, (near, color)) in layers.iter().enumerate() {
        let mut x: f64 = -20.0;
        while x < 1000.0 {
            let width = chance.range(44.0, 92.0);
            let center = 1.0 - ((x - 560.0) / 620.0).abs();
            let height =
                (140.0 + 290.0 * chance.unit() * center + 90.0 * (1.0 - near)).max(90.0) * (1.15 - 0.35 * near);
            let (left, right) = (x.max(0.0), (x + width).min(1000.0));
            towers.push((layer, dvec2(left, SHORE - height), dvec2(right - left, height), *color));
            x += width * chance.range(0.8, 1.15);
        }
    }
    for &(layer, corner, size, color) in &towers {
        tower(&mut doc, &mut chance, layer, [corner, size], color);
    }
    water(&mut doc, &mut chance, &towers);
    bridge(&mut doc);
    doc.finish()
}

fn tower(doc: &mut Document, chance: &mut Chance, layer: usize, [corner, size]: [DVec2; 2], color: Color) {
    doc.rect(corner, size, Style::fill(color));
    doc.rect(
        dvec2(corner.x + size.x * 0.82, corner.y),
        dvec2(size.x * 0.18, size.y),
        Style::fill(color.shade(-0.25)),
    );
    let crown = chance.unit();
    if crown < 0.3 {
        let middle = corner.x + size.x / 2.0;
        doc.polygon(
            &[
                corner,
                dvec2(middle, corner.y - size.x * 0.5),
                dvec2(corner.x + size.x, corner.y),
            ],
            Style::fill(color),
        );
    } else if crown < 0.55 {
        doc.rect(
            corner + dvec2(size.x * 0.2, -16.0),
            dvec2(size.x * 0.6, 16.0),
            Style::fill(color),
        );
        let middle = corner.x + size.x / 2.0;
        doc.line(
            [dvec2(middle, corner.y - 16.0), dvec2(middle, corner.y - 62.0)],
            Style::stroke(color),
        );
        doc.rect(dvec2(middle, corner.y - 63.0), DVec2::ZERO, Style::fill(CORAL));
    }
    if layer == 0 {
        return;
    }
    let (pitch, window) = if layer == 1 {
        (dvec2(9.0, 12.0), dvec2(4.0, 6.0))
    } else {
        (dvec2(11.5, 16.0), dvec2(6.0, 9.0))
    };
    let columns = ((size.x - 8.0) / pitch.x).floor();
    let margin = (size.x - columns * pitch.x + pitch.x - window.x) / 2.0;
    let rows = ((size.y - 16.0) / pitch.y).floor();
    let busy = chance.range(0.18, 0.6);
    for row in 0..rows as u32 {
        for column in 0..columns as u32 {
            if chance.unit() > busy {
                continue;
            }
            let at = corner + dvec2(margin + f64::from(column) * pitch.x, 10.0 + f64::from(row) * pitch.y);
            let light = chance.pick(&[AMBER, AMBER, SAND, PAPER, CORAL.mix(AMBER, 0.5), TEAL.mix(PAPER, 0.5)]);
            doc.rect(
                at,
                window,
                Style::fill(light.mix(color, if layer == 1 { 0.35 } else { 0.05 })),
            );
        }
    }
}

/// The towers upside down, dimmed and cut into ripples.
fn water(doc: &mut Document, chance: &mut Chance, towers: &[(usize, DVec2, DVec2, Color)]) {
    sky(
        doc,
        1000.0,
        [SHORE, 1000.0],
        &[PLUM.mix(NIGHT, 0.25), hex(0x1B2A49), hex(0x101B2D)],
    );
    for &(layer, corner, size, color) in towers {
        let height = size.y * 0.62;
        doc.rect(
            dvec2(corner.x, SHORE),
            dvec2(size.x, height.min(305.0)),
            Style::fill(color).opacity(0.45 + 0.1 * layer as f64),
        );
    }
    for k in 0..330 {
        let t = f64::from(k) / 330.0;
        let y = SHORE + 8.0 + 296.0 * t * t.sqrt();
        let half = chance.range(4.0, 16.0) + 26.0 * t;
        let x = chance.range(0.0, 1000.0);
        let color = chance.pick(&[AMBER, SAND, CORAL, AMBER, PLUM, TEAL]);
        let (left, right) = ((x - half).max(0.0), (x + half).min(1000.0));
        doc.rect(
            dvec2(left, y),
            dvec2(right - left, 1.4 + 2.6 * t),
            Style::fill(color).opacity(0.5 - 0.3 * t),
        );
    }
    for k in 0..26 {
        let t = f64::from(k) / 26.0;
        let half = 60.0 * chance.range(0.35, 1.0);
        doc.rect(
            dvec2(240.0 - half, SHORE + 30.0 + 230.0 * t),
            dvec2(2.0 * half, 2.0 + 2.0 * t),
            Style::fill(PAPER).opacity(0.42 - 0.25 * t),
        );
    }
}

/// A suspension bridge in front of it all.
fn bridge(doc: &mut Document) {
    let deck = SHORE - 12.0;
    for (left, right) in [(-190.0, 210.0), (210.0, 790.0), (790.0, 1190.0)] {
        let cable = |x: f64| {
            let t = (x - left) / (right - left) * 2.0 - 1.0;
            deck - 30.0 - 190.0 * t * t
        };
        let mut points = Vec::new();
        for k in 0..=40 {
            let x = left + (right - left) * f64::from(k) / 40.0;
            if !(0.0..=1000.0).contains(&x) {
                continue;
            }
            points.push(dvec2(x, cable(x)));
            doc.line([dvec2(x, cable(x)), dvec2(x, deck)], Style::stroke(SLATE));
        }
        doc.polyline(&points, Style::stroke(SAND));
    }
    doc.rect(dvec2(0.0, deck), dvec2(1000.0, 12.0), Style::fill(INK));
    doc.rect(dvec2(0.0, deck), dvec2(1000.0, 3.0), Style::fill(CORAL));
    for x in [210.0, 790.0] {
        for dx in [-16.0, 8.0] {
            doc.rect(dvec2(x + dx, deck - 232.0), dvec2(8.0, 300.0), Style::fill(INK));
            doc.rect(dvec2(x + dx, deck - 232.0), dvec2(2.0, 300.0), Style::fill(CORAL));
        }
        for y in [-226.0, -160.0, -90.0] {
            doc.rect(dvec2(x - 16.0, deck + y), dvec2(32.0, 6.0), Style::fill(INK));
        }
        doc.rect(dvec2(x - 26.0, deck + 62.0), dvec2(52.0, 14.0), Style::fill(INK));
    }
}
