//! The edges of all primitives over the paled picture.

use glam::DVec2;

use crate::color::Rgba;
use crate::raster::{self, ChunkBuilder};
use crate::render::visualisation::colors::rgba;
use crate::render::visualisation::show::{Show, Source, Target, repaint, triangles_of};
use crate::render::{Legend, LegendKey, Screen, add};
use crate::scene::{PrimitiveKind, Scene};

/// Edges of triangles, outlines of polygons, hairlines and points.
const EDGES: [u32; 3] = [0xFF00_72B2, 0xFFD5_5E00, 0xFF00_0000];

/// How much of the picture below is gone.
const PALE: f32 = 0.8;

pub(super) struct Wireframe;

impl Show for Wireframe {
    fn meaning(&self) -> &'static str {
        "edges of triangles, outlines of polygons, hairlines and points over the paled picture"
    }

    fn legend(&self, _: &Scene) -> Option<Legend> {
        let labels = ["edges of triangles", "outlines of polygons", "hairlines and points"];
        Some(Legend {
            title: "wireframe",
            key: LegendKey::Swatches(EDGES.into_iter().zip(labels.map(str::to_owned)).collect()),
            others: Vec::new(),
        })
    }

    fn add(&self, source: &Source<'_>, (builder, screen): Target<'_, '_>, index: usize) {
        add(builder, screen, source.kind(index));
    }

    fn keeps_layers(&self) -> bool {
        true
    }

    fn has_overlay(&self) -> bool {
        true
    }

    fn add_overlay(&self, source: &Source<'_>, (builder, screen): Target<'_, '_>, index: usize) {
        let [triangle, polygon, other] = EDGES.map(rgba);
        match source.kind(index) {
            PrimitiveKind::Triangle { points, .. } => closed(builder, screen, points, triangle),
            PrimitiveKind::Polygon { polygon: shape, .. } => {
                screen.with_edges(shape, |shape| match triangles_of(shape, screen) {
                    Some(triangles) => {
                        for points in triangles {
                            closed(builder, screen, points, triangle);
                        }
                    }
                    None => {
                        for contour in shape.contours() {
                            closed(builder, screen, contour, polygon);
                        }
                    }
                });
            }
            kind @ (PrimitiveKind::Hairline { .. } | PrimitiveKind::Point { .. }) => {
                repaint((builder, screen), kind, other);
            }
            PrimitiveKind::BeginLayer | PrimitiveKind::EndLayer { .. } => {}
        }
    }
}

/// Pales what was painted so far.
pub(super) fn add_veil(builder: &mut ChunkBuilder<'_>, size: [u32; 2], background: Rgba) {
    let [width, height] = size.map(f64::from);
    let corner = |x, y| DVec2::new(x, y);
    let (low, high) = (corner(0.0, 0.0), corner(width, height));
    // A transparent ground lets nothing shine through that a veil could pale: it is white then, as paper.
    let ground = if background.a > 0.0 { background } else { Rgba::WHITE };
    let veil = raster::Paint::solid(Rgba { a: PALE, ..ground });
    builder.triangle([low, corner(width, 0.0), high], &veil);
    builder.triangle([low, high, corner(0.0, height)], &veil);
}

/// A closed line.
fn closed(builder: &mut ChunkBuilder<'_>, screen: &Screen<'_>, points: &[DVec2], color: Rgba) {
    let mut last = points.last();
    for point in points {
        if let Some(last) = last.replace(point) {
            builder.hairline([*last, *point].map(|end| screen.place(end)), color);
        }
    }
}
