//! A map of a world that does not exist: continents of noise, a graticule, hundreds of small names.

use glam::{DVec2, dvec2};

use super::super::canvas::Canvas;
use super::super::chance::{Chance, fractal};
use super::super::lettering::{Baseline, Pen, length, write};
use super::super::names;
use super::super::palette::{AMBER, BRICK, CORAL, Color, INK, LEAF, NIGHT, PAPER, PINE, SAND, SEA, SKY, SLATE, WHITE};
use super::super::steady::{TAU, polar};

const WIDTH: u32 = 2048;
const HEIGHT: u32 = 1024;

/// Middle, half axes and name of a continent, as shares of the map's width.
const CONTINENTS: [(f64, f64, f64, f64, &str); 7] = [
    (0.20, 0.15, 0.115, 0.090, "BOREALIA"),
    (0.27, 0.345, 0.062, 0.095, "MERIDIA"),
    (0.50, 0.205, 0.085, 0.070, "CENTRIA"),
    (0.545, 0.355, 0.060, 0.075, "AUSTRAL"),
    (0.76, 0.165, 0.130, 0.088, "ORIENTIA"),
    (0.84, 0.365, 0.060, 0.045, "INSULA"),
    (0.06, 0.37, 0.032, 0.035, "PARVA"),
];

const SEAS: [(f64, f64, f64, &str); 5] = [
    (0.385, 0.27, -0.5, "SEA OF MOIRE"),
    (0.66, 0.31, 0.3, "GULF OF GAMMA"),
    (0.12, 0.275, 0.2, "THE QUIET OCEAN"),
    (0.69, 0.43, -0.1, "SOUTHERN OCEAN"),
    (0.40, 0.075, 0.1, "NYQUIST STRAIT"),
];

/// 2048 x 1024.
pub(super) fn map() -> Canvas {
    let heights: Vec<f64> = (0..HEIGHT)
        .flat_map(|y| (0..WIDTH).map(move |x| height(f64::from(x), f64::from(y))))
        .collect();
    let at = |x: f64, y: f64| {
        let (x, y) = (x.clamp(0.0, f64::from(WIDTH - 1)), y.clamp(0.0, f64::from(HEIGHT - 1)));
        heights[(y as u32 * WIDTH + x as u32) as usize]
    };
    let mut canvas = Canvas::from_fn(WIDTH, HEIGHT, |x, y| {
        let here = at(x, y);
        let coast = [(1.0, 0.0), (0.0, 1.0)]
            .iter()
            .any(|(dx, dy)| (at(x + dx, y + dy) > 0.0) != (here > 0.0));
        if coast {
            NIGHT
        } else {
            tint(here, here - at(x + 2.0, y + 2.0))
        }
    });
    graticule(&mut canvas);
    let mut taken = large_names(&mut canvas);
    towns(&mut canvas, at, &mut taken);
    border(&mut canvas);
    canvas
}

/// Above zero is land.
fn height(x: f64, y: f64) -> f64 {
    let p = dvec2(x, y) / f64::from(WIDTH);
    let bend = dvec2(
        fractal(31, 4, p.x * 14.0, p.y * 14.0),
        fractal(47, 4, p.x * 14.0, p.y * 14.0),
    ) - 0.5;
    let q = p + bend * 0.075;
    let continent = CONTINENTS
        .iter()
        .map(|&(cx, cy, rx, ry, _)| 1.0 - ((q - dvec2(cx, cy)) / dvec2(rx, ry)).length())
        .fold(-1.0, f64::max);
    continent.max(-0.6) * 0.55 + (fractal(3, 6, p.x * 22.0, p.y * 22.0) - 0.5) * 0.75
}

fn tint(height: f64, slope: f64) -> Color {
    let flat = match height {
        ..-0.30 => SKY.mix(NIGHT, 0.30),
        ..-0.17 => SKY.mix(NIGHT, 0.16),
        ..-0.06 => SKY.mix(WHITE, 0.02),
        ..0.0 => SKY.mix(WHITE, 0.32),
        ..0.07 => SAND,
        ..0.17 => LEAF.mix(SAND, 0.55),
        ..0.29 => LEAF.mix(SAND, 0.12),
        ..0.40 => LEAF.mix(PINE, 0.45),
        ..0.47 => AMBER.mix(BRICK, 0.45).mix(SAND, 0.3),
        _ => PAPER,
    };
    if height < 0.0 {
        flat
    } else if slope > 0.012 {
        flat.mix(INK, 0.16)
    } else if slope < -0.012 {
        flat.mix(WHITE, 0.3)
    } else {
        flat
    }
}

fn graticule(canvas: &mut Canvas) {
    let pitch = f64::from(WIDTH) / 24.0;
    let (right, bottom) = (f64::from(WIDTH), f64::from(HEIGHT));
    for k in 1..24 {
        let x = (pitch * f64::from(k)).round() + 0.5;
        let color = if k == 12 { BRICK } else { SLATE };
        canvas.stroke(&[dvec2(x, 0.0), dvec2(x, bottom)], 1.0, color);
    }
    for k in 1..12 {
        let y = (pitch * f64::from(k)).round() + 0.5;
        let color = if k == 6 { BRICK } else { SLATE };
        canvas.stroke(&[dvec2(0.0, y), dvec2(right, y)], 1.0, color);
    }
    for k in 1..24_i32 {
        for row in 1..12_i32 {
            let degrees = if row % 3 == 0 {
                (k - 12).abs() * 15
            } else {
                (row - 6).abs() * 15
            };
            if row % 3 != 0 && k % 4 != 0 {
                continue;
            }
            let at = dvec2(pitch * f64::from(k) + 13.0, pitch * f64::from(row) - 4.0);
            write(
                canvas,
                &degrees.to_string(),
                Baseline::Straight { at, angle: 0.0 },
                Pen::new(6.5, NIGHT),
            );
        }
    }
}

/// A box that lettering occupies: middle and half size.
type Taken = Vec<(DVec2, DVec2)>;

fn large_names(canvas: &mut Canvas) -> Taken {
    let mut taken = Taken::new();
    for (x, y, rx, _, name) in CONTINENTS {
        let at = dvec2(x, y) * f64::from(WIDTH);
        let pen = Pen::new(if rx > 0.07 { 30.0 } else { 19.0 }, BRICK).spaced(3.4);
        write(canvas, name, Baseline::Straight { at, angle: 0.0 }, pen);
        taken.push((
            at - dvec2(0.0, pen.height / 2.0),
            dvec2(length(name, pen) / 2.0 + 6.0, pen.height / 2.0 + 7.0),
        ));
    }
    for (x, y, bend, name) in SEAS {
        let at = dvec2(x, y) * f64::from(WIDTH);
        // A shallow arc: the name of a sea follows the water.
        let radius = 420.0;
        let baseline = Baseline::Circle {
            center: at + polar(radius, bend * 0.4 + TAU / 4.0),
            radius,
            angle: bend * 0.4 - TAU / 4.0,
        };
        write(canvas, name, baseline, Pen::new(15.0, NIGHT).spaced(3.0));
    }
    taken
}

fn towns(canvas: &mut Canvas, height: impl Fn(f64, f64) -> f64, taken: &mut Taken) {
    let mut chance = Chance::new(77);
    let mut count = 0;
    for _ in 0..14_000 {
        let at = dvec2(
            chance.range(40.0, f64::from(WIDTH) - 60.0),
            chance.range(30.0, f64::from(HEIGHT) - 30.0),
        );
        let name = names::place(&mut chance);
        let capital = count % 12 == 0;
        let pen = Pen::new(if capital { 9.5 } else { 6.5 }, INK);
        let half = dvec2(length(&name, pen) / 2.0 + 5.0, pen.height / 2.0 + 3.5);
        let middle = at + dvec2(half.x + 3.0, 0.0);
        let free = taken.iter().all(|(other, size)| {
            let gap = (*other - middle).abs() - *size - half;
            gap.x > 0.0 || gap.y > 0.0
        });
        if !free || height(at.x, at.y) < 0.03 || middle.x + half.x > f64::from(WIDTH) - 24.0 {
            continue;
        }
        canvas.disc(at, if capital { 3.6 } else { 2.4 }, INK);
        canvas.disc(at, if capital { 2.0 } else { 1.2 }, if capital { CORAL } else { PAPER });
        let below = middle + dvec2(0.0, pen.height / 2.0);
        write(canvas, &name, Baseline::Straight { at: below, angle: 0.0 }, pen);
        taken.push((middle, half));
        count += 1;
    }
}

/// Bars of five degrees along the rim, and a compass rose.
fn border(canvas: &mut Canvas) {
    let (right, bottom) = (f64::from(WIDTH), f64::from(HEIGHT));
    let step = right / 72.0;
    let mut bar = |from: DVec2, to: DVec2, odd: bool| {
        canvas.convex(
            &[from, dvec2(to.x, from.y), to, dvec2(from.x, to.y)],
            if odd { INK } else { PAPER },
        );
    };
    for k in 0..72 {
        let x = step * f64::from(k);
        bar(dvec2(x, 0.0), dvec2(x + step, 9.0), k % 2 == 0);
        bar(dvec2(x, bottom - 9.0), dvec2(x + step, bottom), k % 2 == 1);
        if k < 36 {
            bar(dvec2(0.0, x), dvec2(9.0, x + step), k % 2 == 0);
            bar(dvec2(right - 9.0, x), dvec2(right, x + step), k % 2 == 1);
        }
    }
    let rose = dvec2(0.415, 0.42) * right;
    canvas.circle(rose, 56.0, 1.5, NIGHT);
    canvas.circle(rose, 50.0, 1.0, NIGHT);
    for k in 0..16 {
        let reach = [74.0, 34.0, 48.0, 34.0][k % 4];
        let (angle, half) = (TAU * k as f64 / 16.0, TAU / 16.0);
        for (side, color) in [(-half, PAPER), (half, if k % 4 == 0 { BRICK } else { NIGHT })] {
            canvas.convex(
                &[rose, rose + polar(13.0, angle + side), rose + polar(reach, angle)],
                color,
            );
        }
    }
    write(
        canvas,
        "N",
        Baseline::Straight {
            at: rose - dvec2(0.0, 79.0),
            angle: 0.0,
        },
        Pen::new(13.0, NIGHT),
    );
    canvas.disc(rose, 4.0, SEA);
}
