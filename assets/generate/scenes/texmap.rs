//! `svg/texmap`: textures under magnification, minification and everything between.

use glam::{DVec2, dvec2};

use super::super::SceneFile;
use super::super::chance::Chance;
use super::super::document::{Document, Style};
use super::super::palette::{
    AMBER, CORAL, INK, LEAF, MIST, NIGHT, PAPER, PINE, PLUM, SAND, SEA, SKY, SLATE, TEAL, WHITE, gradient,
};
use super::super::steady::{TAU, cos, exp, polar, sin, sin_cos, turned};
use super::floor::Floor;
use super::mesh::{bent, round};
use super::outline::regular;

pub(super) const SCENES: &[SceneFile] = &[
    SceneFile {
        path: "svg/texmap/test1.svg",
        make: vortex,
    },
    SceneFile {
        path: "svg/texmap/test2.svg",
        make: sheet,
    },
    SceneFile {
        path: "svg/texmap/test3.svg",
        make: flag,
    },
    SceneFile {
        path: "svg/texmap/test4.svg",
        make: coins,
    },
    SceneFile {
        path: "svg/texmap/test5.svg",
        make: meadow,
    },
    SceneFile {
        path: "svg/texmap/test6.svg",
        make: planet,
    },
];

/// A tenth of a unit is below a tenth of a pixel at the default view, and corners that meet stay one.
const MESH_DECIMALS: usize = 1;

fn vortex() -> String {
    let mut doc = Document::new(
        1000.0,
        560.0,
        &[
            "A finely labelled map, drawn into a vortex: in the eye the texture is stretched one way and squeezed the other.",
            "P: nearest shows torn letters where the map is magnified, bilinear smooths them. L: zero sparkles where it is",
            "squeezed, nearest and linear calm it. Turn the wheel on a town in the eye and read its name; = helps as well.",
        ],
    );
    doc.rect(DVec2::ZERO, dvec2(1000.0, 560.0), Style::fill(SAND.mix(PAPER, 0.4)));
    doc.texture("map", "map.png");
    doc.decimals(MESH_DECIMALS);
    let eye = dvec2(520.0, 270.0);
    bent(&mut doc, "map", [60, 32], |uv| {
        let p = dvec2(30.0, 40.0) + uv * dvec2(940.0, 480.0);
        let arm = (p - eye) * dvec2(1.0, 1.25);
        let calm = (uv * (1.0 - uv) * 4.0).min(DVec2::ONE);
        let turn = 3.1 * exp(-arm.length_squared() / 26000.0) * (calm.x * calm.y).sqrt();
        eye + turned(arm, turn) * dvec2(1.0, 0.8)
    });
    doc.finish()
}

fn sheet() -> String {
    let mut doc = Document::new(
        1000.0,
        640.0,
        &[
            "The same map, gently warped: a sheet that lies not quite flat. Its names are about as large as pixels can carry.",
            "Compare at this zoom: P and L step through six ways to read a texture. Which keeps the small names readable?",
            "Then press = up to 16 with nearest and level zero: many samples can do what filters do, at a price.",
        ],
    );
    doc.rect(DVec2::ZERO, dvec2(1000.0, 640.0), Style::fill(SLATE.mix(INK, 0.35)));
    doc.texture("map", "map.png");
    doc.decimals(MESH_DECIMALS);
    let place = |uv: DVec2| {
        let p = dvec2(60.0, 105.0) + uv * dvec2(880.0, 430.0);
        let lift = dvec2(
            14.0 * sin(TAU * (uv.y * 0.8 + 0.1)),
            26.0 * sin(TAU * (uv.x * 1.1 + 0.05)) + 10.0 * sin(TAU * uv.x * 2.3),
        );
        p + lift
    };
    let mut shadow: Vec<DVec2> = Vec::new();
    for k in 0..=40 {
        shadow.push(place(dvec2(f64::from(k) / 40.0, 1.0)));
    }
    for k in (0..=40).rev() {
        shadow.push(place(dvec2(f64::from(k) / 40.0, 0.0)));
    }
    let shadow: Vec<DVec2> = shadow.iter().map(|&p| p + dvec2(9.0, 14.0)).collect();
    doc.polygon(&shadow, Style::fill(INK).opacity(0.5));
    bent(&mut doc, "map", [40, 20], place);
    doc.finish()
}

fn flag() -> String {
    let mut doc = Document::new(
        1000.0,
        800.0,
        &[
            "A picture on a flag in the wind. Where the cloth turns away the texture is squeezed across, where it faces us",
            "it has about a texel a pixel. Watch the sun's rings and the hatched hills: level zero breaks them up.",
            "L smooths them (nearest: in steps; linear: without steps). Z on a fold shows the step between two levels.",
        ],
    );
    doc.rect(DVec2::ZERO, dvec2(1000.0, 800.0), Style::fill(SKY.mix(PAPER, 0.5)));
    for (x, y, size) in [(700.0, 120.0, 1.0), (330.0, 745.0, 0.8), (860.0, 720.0, 1.1)] {
        for (dx, dy, r) in [
            (-60.0, 8.0, 34.0),
            (-18.0, -12.0, 46.0),
            (34.0, 2.0, 38.0),
            (74.0, 14.0, 24.0),
        ] {
            doc.polygon(
                &regular(dvec2(x + dx * size, y + dy * size), r * size, 28, 0.0),
                Style::fill(WHITE).opacity(0.55),
            );
        }
    }
    doc.rect(dvec2(86.0, 60.0), dvec2(20.0, 740.0), Style::fill(NIGHT));
    doc.rect(dvec2(86.0, 60.0), dvec2(6.0, 740.0), Style::fill(SLATE));
    doc.polygon(&regular(dvec2(96.0, 50.0), 19.0, 24, 0.0), Style::fill(AMBER));
    doc.texture("picture", "picture.png");
    doc.decimals(MESH_DECIMALS);
    bent(&mut doc, "picture", [40, 24], |uv| {
        let loose = uv.x * (0.4 + 0.6 * uv.x);
        let phase = TAU * (1.65 * uv.x - 0.12 + 0.16 * uv.y);
        let x = 106.0 + 790.0 * uv.x - 34.0 * loose * (1.0 - cos(2.0 * phase)) * 0.6;
        let y = 120.0 + 520.0 * uv.y + 62.0 * loose * sin(phase) + 40.0 * uv.x * uv.x;
        dvec2(x + 22.0 * loose * sin(TAU * uv.y * 0.5), y)
    });
    doc.finish()
}

fn coins() -> String {
    let mut doc = Document::new(
        1000.0,
        1000.0,
        &[
            "One seal, smaller and smaller: each coin has about a fifth less across than the one before it.",
            "With level zero the small ones lose letters and sparkle: most texels fall between the samples. Press L:",
            "nearest and linear read a level that fits, and the smallest coin still has its true colours. Wheel: read the rim.",
        ],
    );
    doc.rect(DVec2::ZERO, dvec2(1000.0, 1000.0), Style::fill(TEAL.mix(INK, 0.55)));
    doc.texture("seal", "seal.png");
    doc.decimals(MESH_DECIMALS);
    let count = 22;
    for k in 0..count {
        let shrink = exp(-0.205 * f64::from(k));
        let center = dvec2(634.0, 372.0) + polar(396.0 * shrink, -0.72 * f64::from(k) + 2.75);
        let radius = 190.0 * shrink;
        doc.polygon(
            &regular(center + radius * 0.06, radius, 40, 0.0),
            Style::fill(INK).opacity(0.45),
        );
        let tilt = 0.35 * f64::from(k);
        // A little dome: the rim is squeezed more than the middle.
        let sectors = if k < 6 { 36 } else { 20 };
        round(&mut doc, "seal", [sectors, if k < 6 { 3 } else { 2 }], |p| {
            let bulge = 1.0 + 0.12 * (1.0 - p.length_squared());
            center + turned(p * bulge, tilt) * radius
        });
    }
    doc.finish()
}

fn meadow() -> String {
    let mut doc = Document::new(
        1000.0,
        700.0,
        &[
            "Foliage that recedes like a floor: near us a texel is large, at the horizon a pixel holds thousands.",
            "Level zero boils at the horizon; L: nearest shows where one level ends and the next begins, linear hides it.",
            "P: bilinear smooths the near leaves. Far off, both blur more along the view than across: the footprint is long.",
        ],
    );
    let horizon = 262.0;
    let sky = |t: f64| gradient(&[NIGHT.mix(TEAL, 0.4), SEA, SAND, AMBER, CORAL], t);
    for k in 0..4 {
        let (from, to) = (f64::from(k) / 4.0, f64::from(k + 1) / 4.0);
        let corner = |x: f64, t: f64| dvec2(x, horizon * t);
        doc.color_quad(
            [
                corner(0.0, from),
                corner(1000.0, from),
                corner(1000.0, to),
                corner(0.0, to),
            ],
            [sky(from), sky(from), sky(to), sky(to)],
        );
    }
    doc.polygon(
        &regular(dvec2(690.0, horizon - 6.0), 74.0, 48, 0.0),
        Style::fill(PAPER.mix(AMBER, 0.35)),
    );
    let ridges = [(PLUM.mix(CORAL, 0.5), 62.0, 0.3), (PLUM.mix(NIGHT, 0.3), 38.0, 1.9)];
    for (color, height, shift) in ridges {
        let mut ridge: Vec<DVec2> = (0..=50)
            .map(|k| {
                let x = 20.0 * f64::from(k);
                let wave = sin(x / 131.0 + shift) + 0.6 * sin(x / 57.0 + 2.0 * shift) + 0.3 * sin(x / 23.0);
                dvec2(x, horizon - height * (0.6 + 0.3 * wave))
            })
            .collect();
        ridge.extend([dvec2(1000.0, horizon + 2.0), dvec2(0.0, horizon + 2.0)]);
        doc.polygon(&ridge, Style::fill(color));
    }
    let haze = [PINE.mix(PLUM, 0.35), LEAF.mix(PINE, 0.55)];
    let band = [
        (0.0, horizon - 1.0),
        (1000.0, horizon - 1.0),
        (1000.0, horizon + 16.0),
        (0.0, horizon + 16.0),
    ];
    doc.color_quad(band.map(|(x, y)| dvec2(x, y)), [haze[0], haze[0], haze[1], haze[1]]);
    doc.texture("leaves", "foliage.jpg");
    doc.decimals(MESH_DECIMALS);
    Floor {
        sides: [0.0, 1000.0],
        horizon: horizon - 8.0,
        bottom: 700.0,
        tile: 760.0,
        shift: 0.31,
        copies: 22,
        depth: 0.8,
        cells: 5,
    }
    .draw(&mut doc, "leaves");
    doc.finish()
}

fn planet() -> String {
    let mut doc = Document::new(
        1000.0,
        1000.0,
        &[
            "The plan of a city, 3840 x 2160 texels, on a small planet: a pixel in the middle holds some seven texels,",
            "one at the rim many more. Level zero sparkles all over; L: linear calms it; = does it too, by brute force.",
            "Turn the wheel until the street names can be read, and watch the level of detail fall to zero.",
        ],
    );
    doc.rect(DVec2::ZERO, dvec2(1000.0, 1000.0), Style::fill(INK));
    let mut chance = Chance::new(19);
    for _ in 0..260 {
        let at = dvec2(chance.range(6.0, 994.0), chance.range(6.0, 994.0));
        doc.rect(at, DVec2::ZERO, Style::fill(SLATE.mix(PAPER, chance.unit())));
    }
    let middle = dvec2(500.0, 500.0);
    for (radius, opacity) in [(432.0, 0.10), (420.0, 0.16), (410.0, 0.25)] {
        doc.polygon(&regular(middle, radius, 120, 0.0), Style::fill(SKY).opacity(opacity));
    }
    doc.polygon(&regular(middle, 401.0, 160, 0.0), Style::fill(SEA.mix(PAPER, 0.4)));
    doc.texture("plan", "plan.png");
    doc.decimals(MESH_DECIMALS);
    bent(&mut doc, "plan", [54, 34], |uv| {
        let (sin_lon, _) = sin_cos((uv.x - 0.5) * TAU / 2.0);
        let (sin_lat, cos_lat) = sin_cos((uv.y - 0.5) * TAU / 2.0);
        middle + turned(dvec2(sin_lon * cos_lat, sin_lat) * 400.0, -0.35)
    });
    // A moon to compare sizes by.
    doc.polygon(&regular(dvec2(872.0, 142.0), 46.0, 40, 0.0), Style::fill(MIST));
    doc.polygon(
        &regular(dvec2(858.0, 132.0), 10.0, 20, 0.0),
        Style::fill(SLATE).opacity(0.6),
    );
    doc.polygon(
        &regular(dvec2(886.0, 156.0), 14.0, 20, 0.0),
        Style::fill(SLATE).opacity(0.5),
    );
    doc.finish()
}
