//! `svg/study`, part six: how textures are continued between their texels, and beyond their borders.
//!
//! Canvas 512: at the default view of a 1024 x 1024 picture one pixel is exactly 0.6 units.

use glam::{DVec2, dvec2};

use super::super::SceneFile;
use super::super::document::{Document, Style};
use super::super::palette::{INK, NIGHT};

pub(super) const SCENES: &[SceneFile] = &[
    SceneFile {
        path: "svg/study/25_few_texels.svg",
        make: few_texels,
    },
    SceneFile {
        path: "svg/study/26_hard_texels.svg",
        make: hard_texels,
    },
    SceneFile {
        path: "svg/study/27_beyond_the_border.svg",
        make: beyond_the_border,
    },
];

const SIDE: f64 = 512.0;

/// The corners of a box.
fn corners(from: DVec2, to: DVec2) -> [DVec2; 4] {
    [from, dvec2(to.x, from.y), to, dvec2(from.x, to.y)]
}

fn few_texels() -> String {
    let mut doc = Document::new(
        SIDE,
        SIDE,
        &[
            "Leaves, and rings of every width, of which few texels are left (16 samples: = three times; M three times: level 2).",
            "What lies between them is a guess. P: nearest guesses squares, bilinear a tent with creases, catmull-rom comes nearest to",
            "what was there: it goes through the texels and bends between them. mitchell lies between, b-spline is softest.",
            "A pin tells the sixteen texels with their weights, some below zero, and by how much the kernel brings it nearer to the truth.",
        ],
    );
    doc.rect(DVec2::ZERO, dvec2(SIDE, SIDE), Style::fill(NIGHT));
    doc.texture("foliage", "foliage.jpg");
    doc.texture("zone", "zone.png");
    doc.texture_quad(
        "foliage",
        corners(dvec2(16.0, 16.0), dvec2(496.0, 256.0)),
        corners(dvec2(0.1, 0.3), dvec2(0.9, 0.7)),
    );
    doc.texture_quad(
        "zone",
        corners(dvec2(16.0, 272.0), dvec2(496.0, 496.0)),
        // Around the centre, where four texels are less than half a ring.
        corners(dvec2(0.41, 0.416), dvec2(0.59, 0.5)),
    );
    doc.finish()
}

fn hard_texels() -> String {
    let mut doc = Document::new(
        SIDE,
        SIDE,
        &[
            "Squares and stripes of two colours, enlarged twenty times: edges as sharp as texels are (16 samples: = three times).",
            "P: nearest is right here, to the last pixel. catmull-rom rings: beside each edge a line is lighter than the light colour and",
            "one darker than the dark one. b-spline never rings; it blurs edges over four texels, and stripes of one texel turn grey.",
            "Not every picture is made of samples of something smooth: signs, tables, pixel art and maps of heights are none.",
        ],
    );
    doc.rect(DVec2::ZERO, dvec2(SIDE, SIDE), Style::fill(INK));
    doc.texture("checker", "checker.png");
    doc.texture("lanes", "lanes.png");
    // 40 x 20 texels of squares of 16.
    let texels = |size: f64, from: DVec2, count: DVec2| corners(from / size, (from + count) / size);
    doc.texture_quad(
        "checker",
        corners(dvec2(16.0, 16.0), dvec2(496.0, 256.0)),
        texels(1024.0, dvec2(488.0, 502.0), dvec2(40.0, 20.0)),
    );
    // Lanes are 64 texels wide, their stripes 1, 2, 4 and 8 texels.
    for lane in 0..4 {
        let left = 16.0 + 122.0 * f64::from(lane);
        doc.texture_quad(
            "lanes",
            corners(dvec2(left, 272.0), dvec2(left + 114.0, 496.0)),
            texels(512.0, dvec2(64.0 * f64::from(lane) + 24.0, 256.0), dvec2(10.0, 20.0)),
        );
    }
    doc.finish()
}

fn beyond_the_border() -> String {
    let mut doc = Document::new(
        SIDE,
        SIDE,
        &[
            "Texture coordinates below 0 and above 1: set Texture wrap, the list beside Pixel in the panel, to clamp, repeat or mirror.",
            "Above, the corner where four copies of a checker meet: repeat goes on with it, mirror makes its squares twice as wide, clamp",
            "draws its outermost texels out to stripes. Below on the left, leaves: repeat shows where copies end, mirror does not.",
            "Below on the right no coordinate lies beyond. With repeat and P: bilinear its outermost texels still take on the colour of",
            "the opposite border: half a texel of what was never there. That is why pictures that do not tile are clamped.",
        ],
    );
    doc.rect(DVec2::ZERO, dvec2(SIDE, SIDE), Style::fill(NIGHT));
    doc.texture("checker", "checker.png");
    doc.texture("foliage", "foliage.jpg");
    doc.texture("lanes", "lanes.png");
    // Half of 77 x 38 texels, so that a pair of squares is 200 units wide.
    let half = dvec2(0.0375, 0.0188);
    doc.texture_quad(
        "checker",
        corners(dvec2(16.0, 16.0), dvec2(496.0, 256.0)),
        corners(dvec2(1.0, 1.0) - half, dvec2(1.0, 1.0) + half),
    );
    doc.texture_quad(
        "foliage",
        corners(dvec2(16.0, 272.0), dvec2(250.0, 496.0)),
        corners(dvec2(-0.5, -0.45), dvec2(1.5, 1.4645)),
    );
    // Eight texels, 28 units each.
    doc.texture_quad(
        "lanes",
        corners(dvec2(272.0, 272.0), dvec2(496.0, 496.0)),
        corners(DVec2::ZERO, DVec2::splat(8.0 / 512.0)),
    );
    doc.finish()
}
