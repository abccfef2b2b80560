//! A seal with lettering all round, down to a line that only the finest level shows.

use glam::{DVec2, dvec2};

use super::super::canvas::Canvas;
use super::super::lettering::{Baseline, Pen, length, write};
use super::super::palette::{AMBER, BRICK, CORAL, INK, NIGHT, PAPER, SAND, TEAL};
use super::super::steady::{TAU, cos, polar};

const CENTER: DVec2 = dvec2(320.0, 320.0);

/// 640 x 640.
pub(super) fn seal() -> Canvas {
    let mut canvas = Canvas::plain(640, 640, PAPER);
    // A scalloped rim.
    for k in 0..72 {
        canvas.disc(CENTER + polar(300.0, TAU * f64::from(k) / 72.0), 13.0, BRICK);
    }
    for (radius, color) in [
        (301.0, BRICK),
        (292.0, PAPER),
        (286.0, NIGHT),
        (222.0, AMBER),
        (216.0, PAPER),
        (172.0, NIGHT),
        (166.0, SAND),
    ] {
        canvas.disc(CENTER, radius, color);
    }
    let ring = |canvas: &mut Canvas, text: &str, radius: f64, angle: f64, pen: Pen| {
        // Blanks so wide that the text just closes the circle.
        let gap = (TAU * radius - length(text, pen)) / (text.chars().count() as f64 * pen.height / 6.0);
        let pen = pen.spaced(pen.tracking + gap);
        write(
            canvas,
            text,
            Baseline::Circle {
                center: CENTER,
                radius,
                angle,
            },
            pen,
        );
    };
    ring(
        &mut canvas,
        "RASTERSCOPE SOCIETY * FOR THE CLOSE READING OF PIXELS * ",
        240.0,
        -TAU / 4.0,
        Pen::new(30.0, PAPER),
    );
    let small =
        "A PIXEL IS NOT A LITTLE SQUARE + A SAMPLE IS A POINT + A TEXEL HAS A CENTRE + AN EDGE HAS ONE OWNER + ";
    ring(&mut canvas, small, 190.0, -TAU / 4.0, Pen::new(12.0, BRICK));
    let tiny = "NEAREST BILINEAR TRILINEAR - LEVEL ZERO ONE TWO THREE FOUR FIVE SIX SEVEN EIGHT NINE - HALF A TEXEL TO THE LEFT HALF A TEXEL UP - ";
    ring(&mut canvas, tiny, 176.5, -TAU / 4.0, Pen::new(7.0, INK));
    guilloche(&mut canvas);
    emblem(&mut canvas);
    canvas
}

/// Rosettes of fine lines, as on banknotes.
fn guilloche(canvas: &mut Canvas) {
    for k in 0..12 {
        let shift = TAU * f64::from(k) / 12.0;
        let curve: Vec<DVec2> = (0..=720)
            .map(|j| {
                let angle = TAU * f64::from(j) / 720.0;
                CENTER + polar(138.0 + 22.0 * cos(9.0 * angle + shift), angle)
            })
            .collect();
        let color = if k % 2 == 0 { TEAL } else { CORAL };
        canvas.stroke(&curve, 1.0, color);
    }
}

/// A magnifying glass over pixels.
fn emblem(canvas: &mut Canvas) {
    canvas.disc(CENTER, 106.0, NIGHT);
    canvas.stroke(&[CENTER + dvec2(30.0, 34.0), CENTER + dvec2(68.0, 72.0)], 20.0, AMBER);
    let lens = CENTER + dvec2(-14.0, -14.0);
    canvas.disc(lens, 70.0, AMBER);
    canvas.disc(lens, 60.0, PAPER);
    let side = 17.0;
    for row in -3..=3_i32 {
        for column in -3..=3_i32 {
            let middle = lens + dvec2(f64::from(column), f64::from(row)) * side;
            if (middle - lens).length() > 50.0 {
                continue;
            }
            // Below a slanted edge, a stair of pixels; the one on the edge half way.
            let color = match column + 2 * row {
                ..=-1 => SAND,
                0 => CORAL.mix(SAND, 0.5),
                _ => CORAL,
            };
            let half = side / 2.0 - 1.0;
            canvas.convex(
                &[
                    middle + dvec2(-half, -half),
                    middle + dvec2(half, -half),
                    middle + dvec2(half, half),
                    middle + dvec2(-half, half),
                ],
                color,
            );
        }
    }
    canvas.stroke(&[lens + dvec2(-52.0, 34.0), lens + dvec2(52.0, -18.0)], 2.2, INK);
}
