//! `svg/study`, part two: what reading a texture can do wrong, and the setting that cures it.

use glam::{DVec2, dvec2};

use super::super::SceneFile;
use super::super::document::{Document, Style};
use super::super::palette::{AMBER, CORAL, INK, NIGHT, PAPER, SAND, SEA, SKY, TEAL};
use super::super::steady::{TAU, turned};
use super::floor::Floor;
use super::outline::regular;

pub(super) const SCENES: &[SceneFile] = &[
    SceneFile {
        path: "svg/study/06_zone_texture.svg",
        make: zone_texture,
    },
    SceneFile {
        path: "svg/study/07_checker_floor.svg",
        make: checker_floor,
    },
    SceneFile {
        path: "svg/study/08_checker_fan.svg",
        make: checker_fan,
    },
    SceneFile {
        path: "svg/study/32_checker_fan_turned.svg",
        make: checker_fan_turned,
    },
    SceneFile {
        path: "svg/study/09_mip_lanes.svg",
        make: mip_lanes,
    },
    SceneFile {
        path: "svg/study/11_city_floor.svg",
        make: city_floor,
    },
    SceneFile {
        path: "svg/study/12_sharp_or_still.svg",
        make: sharp_or_still,
    },
];

const WHOLE: [DVec2; 4] = [dvec2(0.0, 0.0), dvec2(1.0, 0.0), dvec2(1.0, 1.0), dvec2(0.0, 1.0)];

fn square(corner: DVec2, side: f64) -> [DVec2; 4] {
    WHOLE.map(|uv| corner + uv * side)
}

fn zone_texture() -> String {
    let mut doc = Document::new(
        640.0,
        640.0,
        &[
            "A zone plate as a texture: every frequency up to the finest that 512 texels can hold, at five sizes.",
            "Rings around points that are not the centre are false: aliases. With level zero they fill the small plates;",
            "L: linear removes them, and P: bilinear those of the large plate. Drag: aliases swim, true rings move along.",
        ],
    );
    doc.rect(DVec2::ZERO, dvec2(640.0, 640.0), Style::fill(NIGHT));
    doc.texture("zone", "zone.png");
    // At the default view of a 1024 x 1024 picture a pixel is 0.75 units: plates of 528, 240,
    // 123, 64 and 32 pixels, so 1 to 16 texels a pixel.
    for (x, y, side) in [
        (24.0, 24.0, 396.0),
        (436.0, 24.0, 180.0),
        (436.0, 220.0, 92.0),
        (436.0, 328.0, 48.0),
        (436.0, 392.0, 24.0),
    ] {
        doc.texture_quad("zone", square(dvec2(x, y), side), WHOLE);
    }
    // A band that is squeezed one way only.
    let band = [
        dvec2(24.0, 444.0),
        dvec2(616.0, 444.0),
        dvec2(616.0, 616.0),
        dvec2(24.0, 616.0),
    ];
    doc.texture_quad("zone", band, WHOLE);
    doc.finish()
}

fn checker_floor() -> String {
    let mut doc = Document::new(
        1000.0,
        640.0,
        &[
            "A checkered floor to the horizon, the oldest test of texture filters.",
            "Level zero, rate 1: far squares tangle into moire. L: nearest cuts the floor into bands, linear turns the far",
            "squares into an even tone, too early: the footprint is long and thin. = keeps them longer. [ ] turns the floor.",
        ],
    );
    doc.rect(DVec2::ZERO, dvec2(1000.0, 640.0), Style::fill(SKY.mix(PAPER, 0.45)));
    doc.polygon(&regular(dvec2(770.0, 132.0), 66.0, 48, 0.0), Style::fill(AMBER));
    let horizon = 216.0;
    doc.polygon(
        &[dvec2(0.0, horizon), dvec2(150.0, 160.0), dvec2(320.0, horizon)],
        Style::fill(SEA),
    );
    doc.polygon(
        &[dvec2(180.0, horizon), dvec2(330.0, 120.0), dvec2(520.0, horizon)],
        Style::fill(SEA.mix(TEAL, 0.5)),
    );
    doc.rect(
        dvec2(0.0, horizon),
        dvec2(1000.0, 12.0),
        Style::fill(TEAL.mix(PAPER, 0.42)),
    );
    doc.texture("checker", "checker.png");
    Floor {
        sides: [0.0, 1000.0],
        horizon: horizon - 2.0,
        bottom: 640.0,
        tile: 2400.0,
        shift: 0.0,
        copies: 14,
        depth: 3.2,
        cells: 16,
    }
    .draw(&mut doc, "checker");
    for (x, depth, color) in [
        (330.0, 1.5, CORAL),
        (610.0, 2.6, AMBER),
        (480.0, 5.0, TEAL),
        (540.0, 11.0, INK),
    ] {
        obelisk(&mut doc, x, horizon, depth, color);
    }
    doc.finish()
}

/// A stone on the floor: a scale for the eye.
fn obelisk(doc: &mut Document, x: f64, horizon: f64, depth: f64, color: super::super::palette::Color) {
    let (foot, size) = (horizon + 424.0 / depth, 200.0 / depth);
    let at = |dx: f64, dy: f64| dvec2(x + dx * size, foot - dy * size);
    doc.polygon(
        &[at(-0.2, 0.0), at(0.06, -0.06), at(0.03, 1.25), at(-0.12, 1.3)],
        Style::fill(color),
    );
    doc.polygon(
        &[at(0.06, -0.06), at(0.24, 0.02), at(0.13, 1.27), at(0.03, 1.25)],
        Style::fill(color.mix(INK, 0.4)),
    );
    doc.polygon(
        &[at(-0.12, 1.3), at(0.03, 1.25), at(0.13, 1.27), at(0.01, 1.5)],
        Style::fill(color.mix(PAPER, 0.4)),
    );
}

fn checker_fan() -> String {
    let mut doc = Document::new(
        1000.0,
        1000.0,
        &[
            "A fan of checkered blades. From the right, counter-clockwise, each blade squeezes the checker more along its length:",
            "1, 1.5, 2 ... 16 times more than across. Level zero sparkles on the squeezed ones; L: linear makes them grey,",
            "though across the blade the squares are wide enough to be seen: one square footprint can't fit both. = restores them.",
            "Level by area (lod-by area in the palette) keeps squares longer than linear alone, and they sparkle at one sample.",
        ],
    );
    blades(&mut doc, |_, along, across| {
        [
            dvec2(0.0, 0.0),
            dvec2(along, 0.0),
            dvec2(along, across),
            dvec2(0.0, across),
        ]
    });
    doc.finish()
}

fn checker_fan_turned() -> String {
    let mut doc = Document::new(
        1000.0,
        1000.0,
        &[
            "The fan of 08_checker_fan with the checker turned by 45 degrees on each blade (Ctrl+0): a pixel's footprint is a long",
            "strip that lies askew in the texture. L: summed-area averages the whole upright box around that strip, and a ripmap, too,",
            "can only halve rows and columns: both turn grey far too early. L: ewa averages the strip itself, and what is left of the",
            "squares, stripes along each blade, stays. On 08_checker_fan, where strips lie along rows, the ripmap is nearly as good,",
            "for less time.",
        ],
    );
    blades(&mut doc, |piece, along, across| {
        let corner = |x: f64, y: f64| dvec2(0.5, 0.5) + turned(dvec2(x * along, y * across) / 2.0, TAU / 8.0);
        // Every other piece runs back, so that they join.
        let from = if piece % 2 == 0 { -1.0 } else { 1.0 };
        [
            corner(from, -1.0),
            corner(-from, -1.0),
            corner(-from, 1.0),
            corner(from, 1.0),
        ]
    });
    doc.finish()
}

/// A fan of blades which squeeze the checker along their length more and more. `corners` tells where in the texture the corners
/// of a piece lie, from its number and its length along the blade and across it.
fn blades(doc: &mut Document, corners: impl Fn(u32, f64, f64) -> [DVec2; 4]) {
    doc.rect(DVec2::ZERO, dvec2(1000.0, 1000.0), Style::fill(PAPER));
    doc.texture("checker", "checker.png");
    let middle = dvec2(500.0, 500.0);
    let ratios = [1.0, 1.5, 2.0, 3.0, 4.0, 5.0, 6.0, 8.0, 10.0, 12.0, 14.0, 16.0];
    for (k, ratio) in ratios.iter().enumerate() {
        let angle = -TAU * k as f64 / 12.0;
        let place = |x: f64, y: f64| middle + turned(dvec2(x, y), angle);
        let (from, to, half) = (122.0, 470.0, 30.0);
        doc.polygon(
            &[
                place(from - 5.0, -half - 5.0),
                place(to + 5.0, -half - 5.0),
                place(to + 5.0, half + 5.0),
                place(from - 5.0, half + 5.0),
            ],
            Style::fill(NIGHT),
        );
        // Across: one texel a unit, four squares. Along: `ratio` texels a unit, in pieces that fit the texture.
        let pieces = (348.0 * ratio / 1024.0_f64).ceil();
        let length = (to - from) / pieces;
        // Whole pairs of squares, so that the pieces join.
        let along = ((length * ratio / 32.0).round() * 32.0 / 1024.0).clamp(0.03125, 1.0);
        let across = 2.0 * half / 1024.0 * 16.0 / 15.0;
        for piece in 0..pieces as u32 {
            let x = from + length * f64::from(piece);
            let quad = [
                place(x, -half),
                place(x + length, -half),
                place(x + length, half),
                place(x, half),
            ];
            doc.texture_quad("checker", quad, corners(piece, along, across));
        }
    }
    doc.polygon(&regular(middle, 92.0, 48, 0.0), Style::fill(NIGHT));
    doc.polygon(&regular(middle, 60.0, 48, 0.0), Style::fill(AMBER));
}

fn mip_lanes() -> String {
    let mut doc = Document::new(
        1000.0,
        800.0,
        &[
            "Which mip level is in use? The texture has eight lanes with stripes of 1, 2, 4 ... 128 texels, each pair of colours",
            "with the same grey mean: a lane is grey where the level is too coarse for it. Count grey lanes, and you know the level.",
            "L: zero shows false colours and moire, nearest steps from lane to lane, linear fades. Wheel: lanes wake up one by one.",
        ],
    );
    doc.rect(DVec2::ZERO, dvec2(1000.0, 800.0), Style::fill(NIGHT));
    doc.texture("lanes", "lanes.png");
    // Above: squares, each half as large as the one before.
    let (mut x, mut side) = (40.0, 300.0);
    while side > 4.0 {
        doc.rect(
            dvec2(x - 4.0, 336.0 - side),
            dvec2(side + 8.0, side + 8.0),
            Style::fill(SAND),
        );
        doc.texture_quad("lanes", square(dvec2(x, 340.0 - side), side), WHOLE);
        x += side + 26.0 + side * 0.16;
        side *= 0.5;
    }
    // Below: lanes to the horizon, stripes across.
    Floor {
        sides: [0.0, 1000.0],
        horizon: 380.0,
        bottom: 800.0,
        tile: 1000.0,
        shift: 0.5,
        copies: 12,
        depth: 1.6,
        cells: 8,
    }
    .draw(&mut doc, "lanes");
    doc.finish()
}

fn city_floor() -> String {
    let mut doc = Document::new(
        1000.0,
        640.0,
        &[
            "A city plan on the ground, to the horizon: a pixel sees a piece of it that is up to 50 times as long as wide.",
            "P, then L twice: far streets melt, because the mip level has to fit the length. T: 2, 4, 8, 16 taps along it, at",
            "the level that fits its width. Street by street the plan comes back, and still nothing shimmers when it is dragged.",
            "Level by area (lod-by area in the palette) keeps streets further away with one tap, at the price of some shimmer.",
        ],
    );
    doc.rect(DVec2::ZERO, dvec2(1000.0, 640.0), Style::fill(SKY.mix(PAPER, 0.3)));
    let horizon = 150.0;
    doc.polygon(&regular(dvec2(240.0, 84.0), 44.0, 48, 0.0), Style::fill(CORAL));
    doc.rect(
        dvec2(0.0, horizon - 6.0),
        dvec2(1000.0, 30.0),
        Style::fill(SAND.mix(PAPER, 0.3)),
    );
    doc.texture("plan", "plan.png");
    // A copy takes as much depth as keeps texels square for an eye 700 units before the picture.
    let tile = 2400.0;
    Floor {
        sides: [0.0, 1000.0],
        horizon,
        bottom: 640.0,
        tile,
        shift: -0.16,
        copies: 12,
        depth: tile / 700.0 * 2160.0 / 3840.0,
        cells: 8,
    }
    .draw(&mut doc, "plan");
    doc.finish()
}

fn sharp_or_still() -> String {
    let mut doc = Document::new(
        1000.0,
        520.0,
        &[
            "The title of a city plan at a half, 1, 1.5, 2, 3, 4, 6 and 8 texels a pixel (1024 x 1024, default view).",
            "P, then L twice: the level whose texels are a pixel wide. Comma lowers it by a half: sharper, until letters and lines",
            "shimmer when dragged; full stop raises it: soft. M fixes one level: it is right for one piece, too coarse or fine for others.",
        ],
    );
    doc.rect(DVec2::ZERO, dvec2(1000.0, 520.0), Style::fill(NIGHT));
    doc.texture("plan", "plan.png");
    let (side, gap) = (220.0, 24.0);
    for (k, texels) in [0.5, 1.0, 1.5, 2.0, 3.0, 4.0, 6.0, 8.0].iter().enumerate() {
        let corner = dvec2((k % 4) as f64, (k / 4) as f64) * (side + gap) + gap;
        // At the default view a pixel is 1200 / 1024 units.
        let half = dvec2(1.0 / 3840.0, 1.0 / 2160.0) * (side * 1024.0 / 1200.0 * texels / 2.0);
        // The title, or as near to it as the plan reaches.
        let middle = dvec2(0.15, 0.886).clamp(half, 1.0 - half);
        let uv = WHOLE.map(|at| middle + (at * 2.0 - 1.0) * half);
        doc.texture_quad("plan", square(corner, side), uv);
    }
    doc.finish()
}
