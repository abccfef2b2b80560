//! Leaves over leaves, seen from above: dense detail at every size, no straight line.

use glam::{DVec2, dvec2};

use super::super::canvas::Canvas;
use super::super::chance::{Chance, fractal};
use super::super::palette::{AMBER, CORAL, Color, LEAF, PINE, gradient, hex};
use super::super::steady::{TAU, polar};

const SIDE: u32 = 1024;

/// 1024 x 1024.
pub(super) fn foliage() -> Canvas {
    let mut canvas = Canvas::from_fn(SIDE, SIDE, |x, y| {
        PINE.mix(hex(0x0E1F1B), 0.55 + 0.4 * fractal(5, 4, x / 60.0, y / 60.0))
    });
    let mut chance = Chance::new(2);
    let count = 5200;
    for k in 0..count {
        let height = f64::from(k) / f64::from(count);
        let at = dvec2(chance.unit(), chance.unit()) * f64::from(SIDE);
        let grove = fractal(9, 3, at.x / 260.0, at.y / 260.0);
        let autumn = chance.unit() < 0.035 + 0.5 * (grove - 0.62).max(0.0);
        let base = if autumn {
            AMBER.mix(CORAL, chance.unit())
        } else {
            gradient(&[PINE, LEAF, hex(0xB9CC6A)], grove * 1.5 - 0.35 + 0.25 * chance.unit())
        };
        // Deep leaves lie in the shade of the high ones.
        let color = base.shade(-0.55 * (1.0 - height));
        let length = chance.range(20.0, 40.0);
        leaf(&mut canvas, at, polar(length, TAU * chance.unit()), color);
    }
    canvas
}

/// Two halves, one in the light, and a midrib.
fn leaf(canvas: &mut Canvas, at: DVec2, axis: DVec2, color: Color) {
    let side = axis.perp() * 0.24;
    let half = |sign: f64| {
        [
            at,
            at + axis * 0.22 + side * (0.75 * sign),
            at + axis * 0.5 + side * sign,
            at + axis * 0.78 + side * (0.6 * sign),
            at + axis,
        ]
    };
    let lit = if side.y < 0.0 { 1.0 } else { -1.0 };
    canvas.convex(&half(lit), color.shade(0.14));
    canvas.convex(&half(-lit), color.shade(-0.16));
    canvas.stroke(&[at - axis * 0.12, at + axis * 0.9], 1.1, color.shade(0.3));
}
