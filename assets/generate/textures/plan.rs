//! The plan of a city, 3840 x 2160: districts with streets of their own, a river, parks, roofs, hundreds of names.

use glam::{DVec2, dvec2};

use super::super::canvas::Canvas;
use super::super::chance::{Chance, cell, noise};
use super::super::lettering::{Baseline, Pen, write};
use super::super::names;
use super::super::palette::{AMBER, BRICK, CORAL, Color, INK, LEAF, NIGHT, PAPER, PINE, SAND, SKY, SLATE, TEAL};
use super::super::steady::{cos, sin, turned};

const SIZE: DVec2 = dvec2(3840.0, 2160.0);
/// Half width of a street between two blocks, in texels.
const STREET: f64 = 5.5;

/// A part of the city with a street grid of its own.
struct District {
    middle: DVec2,
    angle: f64,
    /// Distance of its streets, both ways.
    pitch: DVec2,
    seed: u64,
    roofs: [Color; 4],
}

/// 3840 x 2160.
pub(super) fn plan() -> Canvas {
    let districts = districts();
    let mut canvas = Canvas::from_fn(3840, 2160, |x, y| ground(&districts, dvec2(x + 0.5, y + 0.5)));
    lettering(&mut canvas, &districts);
    cartouche(&mut canvas);
    canvas
}

fn districts() -> Vec<District> {
    let mut chance = Chance::new(41);
    let palettes = [
        [CORAL, BRICK, AMBER, CORAL.mix(SAND, 0.4)],
        [SAND, AMBER.mix(SAND, 0.5), PAPER.mix(SLATE, 0.2), CORAL.mix(SAND, 0.6)],
        [SLATE, SLATE.mix(SKY, 0.4), TEAL.mix(SAND, 0.4), SAND],
        [BRICK, BRICK.mix(SAND, 0.3), CORAL.mix(INK, 0.2), AMBER],
    ];
    (0..28_u32)
        .map(|k| {
            // A jittered lattice of seven by four.
            let lattice = dvec2(f64::from(k % 7) + 0.5, f64::from(k / 7) + 0.5);
            let jitter = dvec2(chance.range(-0.38, 0.38), chance.range(-0.38, 0.38));
            District {
                middle: (lattice + jitter) * dvec2(SIZE.x / 7.0, SIZE.y / 4.0),
                angle: chance.range(-0.8, 0.8),
                pitch: dvec2(chance.range(110.0, 170.0), chance.range(74.0, 104.0)),
                seed: u64::from(100 + k),
                roofs: chance.pick(&palettes),
            }
        })
        .collect()
}

/// Bends the plan, so that no street is quite straight.
fn bend(p: DVec2) -> DVec2 {
    p + (dvec2(noise(1, p.x / 640.0, p.y / 640.0), noise(2, p.x / 640.0, p.y / 640.0)) - 0.5) * 170.0
}

/// Distance to the middle of the river, in texels.
fn river(p: DVec2) -> f64 {
    let middle = 1120.0 + 360.0 * sin(p.x / 640.0 + 0.4) + 120.0 * sin(p.x / 233.0);
    let slope = 360.0 / 640.0 * cos(p.x / 640.0 + 0.4) + 120.0 / 233.0 * cos(p.x / 233.0);
    (p.y - middle).abs() / (1.0 + slope * slope).sqrt()
}

fn ground(districts: &[District], at: DVec2) -> Color {
    let p = bend(at);
    let mut nearest = [(f64::INFINITY, 0), (f64::INFINITY, 0)];
    for (k, district) in districts.iter().enumerate() {
        let distance = p.distance_squared(district.middle);
        if distance < nearest[0].0 {
            nearest = [(distance, k), nearest[0]];
        } else if distance < nearest[1].0 {
            nearest[1] = (distance, k);
        }
    }
    let [(first, own), (second, other)] = nearest;
    let (own, other) = (&districts[own], &districts[other]);
    let to_avenue = (second - first) / (2.0 * own.middle.distance(other.middle));
    let to_river = river(p);
    if to_avenue < 15.0 && to_river < 96.0 {
        return if to_avenue < 13.0 { PAPER } else { INK.mix(SLATE, 0.6) };
    }
    if to_river < 78.0 {
        let wave = (to_river / 13.0).floor() % 2.0 == 0.0;
        return if wave { SKY.mix(TEAL, 0.35) } else { SKY.mix(TEAL, 0.28) };
    }
    if to_river < 96.0 {
        return if to_river < 82.0 { SLATE } else { SAND.mix(PAPER, 0.5) };
    }
    if to_avenue < 15.0 {
        // Trees along both sides, a line in the middle.
        let tree = (p.x / 16.0).fract() < 0.4 && (p.y / 16.0).fract() < 0.4 && to_avenue > 8.0;
        return if tree {
            LEAF
        } else if to_avenue < 1.0 {
            AMBER
        } else {
            PAPER
        };
    }
    block(own, turned(p - own.middle, own.angle))
}

/// Inside a district; `q` in its own frame.
fn block(district: &District, q: DVec2) -> Color {
    let place = (q / district.pitch).floor();
    let (column, row) = (place.x as i64, place.y as i64);
    let local = q - place * district.pitch;
    let rest = local.min(district.pitch - local).min_element();
    if rest < STREET {
        return PAPER;
    }
    let dice = cell(district.seed, column, row);
    if dice < 0.13 {
        return park(district.seed, q, rest);
    }
    if rest < STREET + 1.3 {
        return SLATE.mix(PAPER, 0.3);
    }
    if dice > 0.985 {
        return if (local - district.pitch * 0.5).length() < 24.0 {
            NIGHT
        } else {
            SAND
        };
    }
    // Houses in two rows, with yards between them.
    let lots = 3.0 + (dice * 997.0).fract() * 3.9;
    let width = district.pitch.x / lots.floor();
    let lot = (local.x / width).floor();
    let front = local.y < district.pitch.y / 2.0;
    let depth = (local.y - district.pitch.y / 2.0).abs();
    let house = cell(district.seed + 7, column * 16 + lot as i64, row * 2 + i64::from(front));
    if depth < 9.0 + 12.0 * house {
        return if house < 0.5 { LEAF.mix(SAND, 0.45) } else { SAND };
    }
    if local.x - lot * width < 1.4 {
        return SLATE.mix(BRICK, 0.3);
    }
    let roof = district.roofs[(house * 4.0) as usize];
    // Ridge: the half towards the street lies in the light.
    if rest < 19.0 { roof.shade(0.14) } else { roof }
}

fn park(seed: u64, q: DVec2, rest: f64) -> Color {
    if rest < STREET + 7.0 {
        return SAND;
    }
    let grid = (q / 13.0).floor();
    let (i, j) = (grid.x as i64, grid.y as i64);
    let tree = (grid + 0.5) * 13.0 + (dvec2(cell(seed + 1, i, j), cell(seed + 2, i, j)) - 0.5) * 5.0;
    let distance = q.distance(tree);
    if distance < 3.0 {
        LEAF.mix(PAPER, 0.2)
    } else if distance < 5.6 {
        PINE.mix(LEAF, 0.45)
    } else {
        LEAF.mix(SAND, 0.3)
    }
}

fn lettering(canvas: &mut Canvas, districts: &[District]) {
    let mut chance = Chance::new(5);
    for district in districts {
        for row in -5..=5_i32 {
            for column in [-3.0, 0.0, 3.0] {
                let name = format!("{} ST", names::place(&mut chance));
                let q = dvec2(column + 0.5, f64::from(row)) * district.pitch;
                let p = district.middle + turned(q, -district.angle);
                let own = districts
                    .iter()
                    .all(|d| d.middle.distance(p) > district.middle.distance(p) - 60.0);
                if own && river(p) > 140.0 {
                    let at = unbend(p);
                    let baseline = Baseline::Straight {
                        at: at + turned(dvec2(0.0, 3.0), -district.angle),
                        angle: -district.angle,
                    };
                    write(canvas, &name, baseline, Pen::new(6.5, NIGHT));
                }
            }
        }
    }
    for district in districts {
        let name = names::place(&mut chance);
        if river(district.middle) < 130.0 {
            continue;
        }
        let baseline = Baseline::Straight {
            at: unbend(district.middle),
            angle: 0.0,
        };
        let pen = Pen::new(34.0, INK).spaced(2.6);
        write(
            canvas,
            &name,
            baseline,
            Pen {
                width: 15.0,
                color: PAPER,
                ..pen
            },
        );
        write(canvas, &name, baseline, Pen { width: 5.5, ..pen });
    }
}

/// The point that [`bend`] moves to `p`, to a fraction of a texel.
fn unbend(p: DVec2) -> DVec2 {
    (0..12).fold(p, |guess, _| guess + p - bend(guess))
}

fn cartouche(canvas: &mut Canvas) {
    let middle = dvec2(620.0, 1950.0);
    let half = dvec2(500.0, 130.0);
    for (grow, color) in [(16.0, INK), (10.0, AMBER), (5.0, PAPER)] {
        let h = half + grow;
        let corners = [dvec2(-h.x, -h.y), dvec2(h.x, -h.y), h, dvec2(-h.x, h.y)];
        canvas.convex(&corners.map(|c| middle + c), color);
    }
    let line = |canvas: &mut Canvas, text: &str, drop: f64, pen: Pen| {
        write(
            canvas,
            text,
            Baseline::Straight {
                at: middle + dvec2(0.0, drop),
                angle: 0.0,
            },
            pen,
        );
    };
    line(canvas, "THE CITY OF ALIAS", -30.0, Pen::new(70.0, INK).spaced(1.7));
    line(
        canvas,
        "AND ITS SUBURBS - DRAWN BY ARITHMETIC AT 3840 BY 2160 TEXELS",
        14.0,
        Pen::new(17.0, BRICK),
    );
    let pen = Pen::new(11.0, NIGHT);
    line(
        canvas,
        "IF YOU CAN READ THE NAMES OF THE STREETS YOU ARE NEAR ENOUGH - IF THEY SPARKLE, CHANGE THE LEVEL",
        46.0,
        pen,
    );
    for k in 0..10 {
        let x = -400.0 + 80.0 * f64::from(k);
        let bar = [
            dvec2(x, 76.0),
            dvec2(x + 80.0, 76.0),
            dvec2(x + 80.0, 92.0),
            dvec2(x, 92.0),
        ];
        canvas.convex(&bar.map(|c| middle + c), if k % 2 == 0 { INK } else { CORAL });
    }
}
