//! `svg/subdiv`: a triangle that becomes a smooth curve in six steps.
//!
//! The four-point scheme of Dyn, Levin and Gregory (1987): every edge gets a new point from its two ends and the two
//! beyond. It keeps the old points, so each step adds one triangle to each edge.

use glam::{DVec2, dvec2};

use super::super::SceneFile;
use super::super::document::{Document, Style};
use super::super::palette::{AMBER, CORAL, INK, PAPER, PLUM, SEA, SKY, TEAL};

pub(super) const SCENES: &[SceneFile] = &[
    SceneFile {
        path: "svg/subdiv/triangle0.svg",
        make: || refined(0),
    },
    SceneFile {
        path: "svg/subdiv/triangle1.svg",
        make: || refined(1),
    },
    SceneFile {
        path: "svg/subdiv/triangle2.svg",
        make: || refined(2),
    },
    SceneFile {
        path: "svg/subdiv/triangle3.svg",
        make: || refined(3),
    },
    SceneFile {
        path: "svg/subdiv/triangle4.svg",
        make: || refined(4),
    },
    SceneFile {
        path: "svg/subdiv/triangle5.svg",
        make: || refined(5),
    },
    SceneFile {
        path: "svg/subdiv/triangle6.svg",
        make: || refined(6),
    },
];

/// Weight of the two points beyond an edge's ends; 1/16 gives the smoothest curve, more gives a fuller one.
const TENSION: f64 = 0.075;

fn refined(steps: usize) -> String {
    let mut doc = Document::new(
        1000.0,
        1000.0,
        &[
            &format!(
                "Step {steps} of 6 from a triangle to a smooth curve; each step's new triangles have a colour of their own."
            ),
            "PageUp and PageDown walk through the steps: the last ones add triangles thinner than a pixel. At rate 1 they are",
            "hit or missed; press = and the rim gets its true shape. No seam may show between steps; Z along the rim.",
        ],
    );
    let colors = [AMBER, CORAL, PLUM, TEAL, SEA, SKY, INK];
    doc.rect(DVec2::ZERO, dvec2(1000.0, 1000.0), Style::fill(PAPER));
    let mut points = vec![dvec2(300.0, 150.0), dvec2(830.0, 560.0), dvec2(270.0, 800.0)];
    doc.decimals(3);
    doc.polygon(&points, Style::fill(colors[0]));
    for color in colors.into_iter().skip(1).take(steps) {
        let count = points.len();
        let at = |k: usize| points[k % count];
        let mut finer = Vec::with_capacity(2 * count);
        for k in 0..count {
            let (before, from, to, after) = (at(k + count - 1), at(k), at(k + 1), at(k + 2));
            let middle = (from + to) * (0.5 + TENSION) - (before + after) * TENSION;
            doc.polygon(&[from, middle, to], Style::fill(color));
            finer.extend([from, middle]);
        }
        points = finer;
    }
    doc.finish()
}
