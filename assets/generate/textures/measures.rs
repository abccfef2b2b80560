//! Textures to measure by: labelled cells, checkers, lanes of stripes, a zone plate.

use glam::dvec2;

use super::super::canvas::Canvas;
use super::super::lettering::{Baseline, Pen, write};
use super::super::palette::{AMBER, CORAL, Color, INK, PAPER, PLUM, SEA, TEAL, WHITE, gradient, hex};
use super::super::steady::{TAU, cos};

/// 512 x 512: eight by eight cells named A1 to H8, tinted by their place, with a fine ruling.
pub(super) fn grid() -> Canvas {
    const CELL: f64 = 64.0;
    let tint = |column: f64, row: f64| {
        let above = gradient(&[AMBER, CORAL, PLUM], column / 7.0);
        let below = gradient(&[SEA, TEAL, INK], column / 7.0);
        above.mix(below, row / 7.0)
    };
    let mut canvas = Canvas::from_fn(512, 512, |x, y| {
        let (column, row) = ((x / CELL).floor(), (y / CELL).floor());
        let pale = if (column + row) % 2.0 == 0.0 { 0.62 } else { 0.12 };
        let color = tint(column, row).mix(PAPER, pale);
        let rule = |spacing: f64| x % spacing == 0.0 || y % spacing == 0.0;
        if rule(CELL) {
            color.mix(INK, 0.55)
        } else if rule(8.0) {
            color.mix(INK, 0.13)
        } else {
            color
        }
    });
    for row in 0..8_u8 {
        for column in 0..8_u8 {
            let name = format!("{}{}", char::from(b'A' + column), row + 1);
            let pale = (row + column) % 2 == 0;
            let at = dvec2(f64::from(column), f64::from(row)) * CELL + dvec2(32.0, 43.0);
            let ink = if pale { INK } else { WHITE };
            write(
                &mut canvas,
                &name,
                Baseline::Straight { at, angle: 0.0 },
                Pen::new(22.0, ink),
            );
        }
    }
    canvas
}

/// 1024 x 1024: 64 x 64 squares of 16 texels.
pub(super) fn checker() -> Canvas {
    Canvas::from_fn(1024, 1024, |x, y| {
        if ((x / 16.0).floor() + (y / 16.0).floor()) % 2.0 == 0.0 {
            PAPER
        } else {
            TEAL.mix(INK, 0.45)
        }
    })
}

/// How many lanes [`lanes`] has.
pub(crate) const LANES: usize = 8;

/// 512 x 512: eight upright lanes, striped across: stripes of 1, 2, 4 ... 128 texels from left to right.
///
/// The two colours of a lane have the same neutral mean in every lane. A mip level that averages a lane's stripes away
/// turns it grey, so the number of grey lanes is the number of the level.
pub(super) fn lanes() -> Canvas {
    let tints: [Color; LANES] = [
        hex(0xC23B3B),
        CORAL,
        AMBER,
        hex(0xA9B23C),
        hex(0x4FA86A),
        TEAL,
        hex(0x3F74B5),
        PLUM,
    ];
    Canvas::from_fn(512, 512, |x, y| {
        let lane = (x / 64.0).floor();
        let tint = tints[lane as usize];
        let stripe = f64::from(1_u32 << lane as u32);
        let other = Color(tint.0.map(|c| 1.0 - c));
        if (y / stripe).floor() % 2.0 == 0.0 { tint } else { other }
    })
}

/// 512 x 512: rings whose frequency grows with the radius, up to half a cycle per texel at the sides' middles.
pub(super) fn zone_plate() -> Canvas {
    Canvas::from_fn(512, 512, |x, y| {
        let p = dvec2(x + 0.5, y + 0.5) - 256.0;
        // Phase in turns is r^2 / (4 R), so its slope at r = R is 1/2.
        let wave = 0.5 + 0.5 * cos(TAU * p.length_squared() / 1024.0);
        hex(0x101010).mix(hex(0xF4F4F4), wave)
    })
}
