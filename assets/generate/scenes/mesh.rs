//! Textured meshes: a square of texture bent to any shape by thousands of small triangles.

use glam::{DVec2, dvec2};

use super::super::document::Document;

/// A texture cut into `columns` by `rows` cells, each corner `(u, v)` moved to `place(u, v)`.
pub(super) fn bent(doc: &mut Document, id: &str, [columns, rows]: [u32; 2], place: impl Fn(DVec2) -> DVec2) {
    let corner = |i: u32, j: u32| dvec2(f64::from(i) / f64::from(columns), f64::from(j) / f64::from(rows));
    for j in 0..rows {
        for i in 0..columns {
            let uv = [corner(i, j), corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1)];
            doc.texture_quad(id, uv.map(&place), uv);
        }
    }
}

/// A disc of texture, cut like a cake with rings; `place` moves points of the unit disc.
pub(super) fn round(doc: &mut Document, id: &str, [sectors, rings]: [u32; 2], place: impl Fn(DVec2) -> DVec2) {
    use super::super::steady::{TAU, polar};
    let at = |ring: u32, sector: u32| {
        polar(
            f64::from(ring) / f64::from(rings),
            TAU * f64::from(sector % sectors) / f64::from(sectors),
        )
    };
    // A hair inside the texture's border, so that the rim shows no corner of the square.
    let uv = |p: DVec2| p * 0.492 + 0.5;
    for sector in 0..sectors {
        let first = [DVec2::ZERO, at(1, sector), at(1, sector + 1)];
        doc.texture_triangle(id, first.map(&place), first.map(uv));
        for ring in 1..rings {
            let quad = [
                at(ring, sector),
                at(ring + 1, sector),
                at(ring + 1, sector + 1),
                at(ring, sector + 1),
            ];
            doc.texture_quad(id, quad.map(&place), quad.map(uv));
        }
    }
}
