//! Barycentric weights: a triangle's three corners in three colours.

use crate::raster;
use crate::render::visualisation::colors::{NONE, rgba};
use crate::render::visualisation::show::{Show, Source, Target, repaint};
use crate::render::{Legend, LegendKey};
use crate::scene::{PrimitiveKind, Scene};

/// Corners of a triangle, first to third (M. Okabe, K. Ito, "Color Universal Design", 2008).
const CORNERS: [u32; 3] = [0xFFD5_5E00, 0xFF00_72B2, 0xFFF0_E442];

pub(super) struct Barycentric;

impl Show for Barycentric {
    fn meaning(&self) -> &'static str {
        "the weights of a triangle's three corners, mixed from three colours"
    }

    fn legend(&self, _: &Scene) -> Option<Legend> {
        let [a, b, c] = CORNERS;
        Some(Legend {
            title: "barycentric weights",
            key: LegendKey::Triangle([(a, "first corner"), (b, "second corner"), (c, "third corner")]),
            others: vec![(NONE, "no triangle")],
        })
    }

    fn add(&self, source: &Source<'_>, (builder, screen): Target<'_, '_>, index: usize) {
        match source.kind(index) {
            PrimitiveKind::Triangle { points, .. } => {
                let points = points.map(|point| screen.place(point));
                builder.triangle(points, &raster::Paint::vertex(CORNERS.map(rgba)));
            }
            kind => repaint((builder, screen), kind, rgba(NONE)),
        }
    }
}
