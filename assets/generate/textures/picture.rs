//! A picture to wave: an island evening in flat tones and fine hatching.

use glam::{DVec2, dvec2};

use super::super::canvas::Canvas;
use super::super::chance::{Chance, noise};
use super::super::palette::{AMBER, BRICK, CORAL, Color, INK, NIGHT, PAPER, PLUM, SAND, SLATE, TEAL, gradient};

const SUN: DVec2 = dvec2(650.0, 330.0);

/// 960 x 640.
pub(super) fn picture() -> Canvas {
    let mut canvas = Canvas::from_fn(960, 640, sky_and_sea);
    for (k, base) in [320.0, 352.0, 388.0].into_iter().enumerate() {
        let tone = [PLUM.mix(CORAL, 0.45), PLUM, NIGHT][k];
        hills(&mut canvas, base, k, tone);
    }
    boat(&mut canvas, dvec2(610.0, 500.0), 1.0);
    boat(&mut canvas, dvec2(800.0, 452.0), 0.5);
    let mut chance = Chance::new(11);
    for _ in 0..14 {
        let at = dvec2(chance.range(90.0, 620.0), chance.range(60.0, 190.0));
        let size = chance.range(6.0, 13.0);
        let wing = [dvec2(-size, -size * 0.4), DVec2::ZERO, dvec2(size, -size * 0.5)];
        canvas.stroke(&wing.map(|p| at + p), 1.8, INK);
    }
    frame(&mut canvas);
    canvas
}

fn sky_and_sea(x: f64, y: f64) -> Color {
    let p = dvec2(x + 0.5, y + 0.5);
    if y < 400.0 {
        let distance = (p - SUN).length();
        let band = (y / 25.0).floor() / 16.0;
        let sky = gradient(&[TEAL.mix(NIGHT, 0.4), TEAL.mix(PAPER, 0.35), SAND, AMBER, CORAL], band);
        return if distance < 92.0 {
            // Slits widen towards the horizon.
            let slit = (y - 300.0).max(0.0) * 0.1;
            if y > 300.0 && (y / 14.0).fract() * 14.0 < slit {
                sky
            } else {
                PAPER.mix(AMBER, 0.25)
            }
        } else if distance < 150.0 && (distance / 6.0).floor() % 2.0 == 0.0 {
            sky.mix(PAPER, 0.22)
        } else {
            sky
        };
    }
    let depth = (y - 400.0) / 240.0;
    let sea = gradient(&[TEAL.mix(AMBER, 0.25), TEAL, NIGHT, INK], depth);
    let ripple = noise(3, x / (30.0 + 160.0 * depth), y / (1.6 + 9.0 * depth));
    let path = (x - SUN.x).abs() < 40.0 + 150.0 * depth;
    if path && ripple > 0.52 {
        sea.mix(AMBER, 0.85)
    } else if ripple > 0.7 {
        sea.mix(PAPER, 0.25)
    } else {
        sea
    }
}

fn hills(canvas: &mut Canvas, base: f64, layer: usize, tone: Color) {
    let reach = [560.0, 430.0, 300.0][layer];
    let height = |x: f64| {
        let fade = (1.0 - x / reach).max(0.0);
        base - fade * (40.0 + 150.0 * noise(20 + layer as u64, x / 90.0, 0.5)) + 40.0 * (1.0 - fade)
    };
    let mut x = 0.0;
    while x < reach {
        let (left, right) = (height(x), height(x + 3.0));
        if left.min(right) < 402.0 {
            let corners = [(x - 0.6, left), (x + 3.6, right), (x + 3.6, 402.0), (x - 0.6, 402.0)];
            canvas.convex(&corners.map(|(x, y)| dvec2(x, f64::min(y, 402.0))), tone);
        }
        // Hatching on the sunny side: one line in four steps, as long as the slope is steep.
        if right > left + 0.6 && (x / 3.0) % 3.0 == 0.0 {
            canvas.stroke(
                &[dvec2(x, left + 4.0), dvec2(x - 14.0, (left + 44.0).min(398.0))],
                1.0,
                tone.mix(AMBER, 0.55),
            );
        }
        x += 3.0;
    }
}

fn boat(canvas: &mut Canvas, at: DVec2, scale: f64) {
    let place =
        |points: &[(f64, f64)]| -> Vec<DVec2> { points.iter().map(|&(x, y)| at + dvec2(x, y) * scale).collect() };
    canvas.convex(&place(&[(-60.0, 0.0), (66.0, 0.0), (46.0, 24.0), (-46.0, 24.0)]), INK);
    canvas.convex(&place(&[(-58.0, 3.0), (64.0, 3.0), (62.0, 7.0), (-56.0, 7.0)]), BRICK);
    canvas.convex(&place(&[(4.0, -4.0), (4.0, -140.0), (58.0, -12.0)]), PAPER);
    canvas.convex(&place(&[(-2.0, -4.0), (-2.0, -120.0), (-44.0, -12.0)]), SAND);
    for k in 1..6 {
        let t = f64::from(k) / 6.0;
        canvas.stroke(
            &place(&[(4.0, -140.0 + 136.0 * t), (4.0 + 54.0 * t, -140.0 + 128.0 * t)]),
            1.0,
            SLATE,
        );
    }
    canvas.stroke(&place(&[(1.0, 0.0), (1.0, -146.0)]), 2.6 * scale, INK);
    for k in 0..5 {
        let y = 30.0 + 8.0 * f64::from(k);
        canvas.stroke(
            &place(&[(-40.0 + 7.0 * f64::from(k), y), (44.0 - 8.0 * f64::from(k), y)]),
            2.0,
            NIGHT.mix(PAPER, 0.25),
        );
    }
}

/// A border with beads, so that a wave shows how it bends straight lines.
fn frame(canvas: &mut Canvas) {
    let edge = |inset: f64| {
        [
            dvec2(inset, inset),
            dvec2(960.0 - inset, inset),
            dvec2(960.0 - inset, 640.0 - inset),
            dvec2(inset, 640.0 - inset),
            dvec2(inset, inset),
        ]
    };
    canvas.stroke(&edge(12.0), 26.0, INK);
    canvas.stroke(&edge(25.0), 2.0, AMBER);
    for k in 0..80 {
        let t = 12.0 * f64::from(k) + 6.0;
        for at in [dvec2(t, 12.0), dvec2(t, 628.0), dvec2(12.0, t), dvec2(948.0, t)] {
            canvas.disc(at, 2.6, AMBER);
        }
    }
}
