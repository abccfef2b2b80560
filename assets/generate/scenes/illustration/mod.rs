//! `svg/illustration`: pictures to enjoy, each with a lesson.

mod balloons;
mod city;
mod fox;
mod guilloche;
mod lighthouse;
mod poster;
mod rosette;
mod veils;
mod wave;

use super::super::SceneFile;
use super::super::chance::{Chance, cell, noise};
use super::super::document::{Document, Style};
use super::super::palette;
use super::super::steady;
use super::outline;

pub(super) const SCENES: &[SceneFile] = &[
    SceneFile {
        path: "svg/illustration/01_lighthouse.svg",
        make: lighthouse::lighthouse,
    },
    SceneFile {
        path: "svg/illustration/02_fox.svg",
        make: fox::fox,
    },
    SceneFile {
        path: "svg/illustration/03_night_city.svg",
        make: city::night_city,
    },
    SceneFile {
        path: "svg/illustration/04_balloons.svg",
        make: balloons::balloons,
    },
    SceneFile {
        path: "svg/illustration/05_swell.svg",
        make: wave::swell,
    },
    SceneFile {
        path: "svg/illustration/06_rosette.svg",
        make: rosette::rosette,
    },
    SceneFile {
        path: "svg/illustration/07_guilloche.svg",
        make: guilloche::guilloche,
    },
    SceneFile {
        path: "svg/illustration/08_veils.svg",
        make: veils::veils,
    },
    SceneFile {
        path: "svg/illustration/09_poster.svg",
        make: poster::poster,
    },
];

/// A sky of colours from `top` to `bottom`, mixed in between, over the whole width.
fn sky(doc: &mut Document, width: f64, [top, bottom]: [f64; 2], stops: &[palette::Color]) {
    use glam::dvec2;
    let count = stops.len() - 1;
    for k in 0..count {
        let y = |k: usize| top + (bottom - top) * k as f64 / count as f64;
        let corners = [
            dvec2(0.0, y(k)),
            dvec2(width, y(k)),
            dvec2(width, y(k + 1)),
            dvec2(0.0, y(k + 1)),
        ];
        doc.color_quad(corners, [stops[k], stops[k], stops[k + 1], stops[k + 1]]);
    }
}
