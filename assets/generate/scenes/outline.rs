//! Outlines that several scenes draw: discs, stars, limbs.

use glam::{DVec2, dvec2};

use super::super::steady::{TAU, polar};

/// A regular polygon; the first corner lies `turn` radians from the x axis.
pub(crate) fn regular(center: DVec2, radius: f64, corners: u32, turn: f64) -> Vec<DVec2> {
    let angle = |k: u32| turn + TAU * f64::from(k) / f64::from(corners);
    (0..corners).map(|k| center + polar(radius, angle(k))).collect()
}

/// Points of an arc, both ends included.
pub(crate) fn arc(center: DVec2, radius: f64, angles: [f64; 2], steps: u32) -> Vec<DVec2> {
    let angle = |k: u32| angles[0] + (angles[1] - angles[0]) * f64::from(k) / f64::from(steps);
    (0..=steps).map(|k| center + polar(radius, angle(k))).collect()
}

/// A star with `tips` tips; the first points up.
pub(crate) fn star(center: DVec2, radii: [f64; 2], tips: u32) -> Vec<DVec2> {
    let corner = |k: u32| {
        let radius = radii[usize::from(k % 2 == 1)];
        center + polar(radius, TAU * (f64::from(k) / f64::from(2 * tips) - 0.25))
    };
    (0..2 * tips).map(corner).collect()
}

/// A limb that hangs from the origin: `length` long, its half width going from `top` to `bottom`, rounded ends.
pub(crate) fn limb(length: f64, top: f64, bottom: f64) -> Vec<DVec2> {
    let mut points = arc(DVec2::ZERO, top, [TAU / 2.0, TAU], 8);
    points.extend(arc(dvec2(0.0, length), bottom, [0.0, TAU / 2.0], 8));
    points
}

/// The rectangle between two corners, in order.
pub(crate) fn rectangle(from: DVec2, to: DVec2) -> Vec<DVec2> {
    vec![from, dvec2(to.x, from.y), to, dvec2(from.x, to.y)]
}
