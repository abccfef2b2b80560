//! A textured floor that runs to the horizon, as a mesh: `textri` mixes its coordinates without perspective, so the
//! perspective has to be in the mesh.

use glam::{DVec2, dvec2};

use super::super::document::Document;

/// How the floor lies in the picture.
#[derive(Clone, Copy, Debug)]
pub(super) struct Floor {
    /// The picture's left and right edge; the floor ends there.
    pub(super) sides: [f64; 2],
    /// Height of the horizon in the picture.
    pub(super) horizon: f64,
    /// The picture's lower edge, where depth is 1.
    pub(super) bottom: f64,
    /// Width of one copy of the texture at depth 1.
    pub(super) tile: f64,
    /// Moves the floor to the right, in copies.
    pub(super) shift: f64,
    /// Where the floor ends, in depths of copies beyond depth 1.
    pub(super) copies: u32,
    /// How much depth one copy takes.
    pub(super) depth: f64,
    /// Cells across one copy; more bends less.
    pub(super) cells: u32,
}

impl Floor {
    /// Draws the floor, farthest row first; copies lie mirrored side by side, so that their borders match.
    pub(super) fn draw(self, doc: &mut Document, id: &str) {
        for copy in (0..self.copies).rev() {
            let start = 1.0 + self.depth * f64::from(copy);
            // Rows of about equal height in the picture.
            let height = (self.bottom - self.horizon) * (1.0 / start - 1.0 / (start + self.depth));
            let rows = (height / 14.0).ceil().clamp(1.0, 40.0) as u32;
            for row in (0..rows).rev() {
                let along = |k: u32| f64::from(copy) + self.share(start, f64::from(k) / f64::from(rows));
                self.row(doc, id, [along(row), along(row + 1)]);
            }
        }
    }

    /// How far into a copy that starts at depth `start` a line lies that divides its picture at `t`.
    fn share(self, start: f64, t: f64) -> f64 {
        let (near, far) = (1.0 / start, 1.0 / (start + self.depth));
        (1.0 / (near + (far - near) * t) - start) / self.depth
    }

    fn row(self, doc: &mut Document, id: &str, along: [f64; 2]) {
        let middle = (self.sides[0] + self.sides[1]) * 0.5;
        let half = self.sides[1] - middle;
        let depth = along.map(|v| 1.0 + self.depth * v);
        let reach = half * depth[1] / self.tile + self.shift.abs();
        let cell = 1.0 / f64::from(self.cells);
        // Far rows are thin: wide cells will do.
        let cell = if depth[0] > 6.0 {
            cell * (f64::from(self.cells) / 2.0).min(4.0)
        } else {
            cell
        };
        let last = (reach / cell).ceil() as i64;
        for k in -last..last {
            let (left, right) = (k as f64 * cell, (k + 1) as f64 * cell);
            let corner = |u: f64, end: usize| {
                let limit = half * depth[end] / self.tile;
                dvec2((u + self.shift).clamp(-limit, limit) - self.shift, along[end])
            };
            let quad = [corner(left, 1), corner(right, 1), corner(right, 0), corner(left, 0)];
            if quad[1].x - quad[0].x < 1e-9 && quad[2].x - quad[3].x < 1e-9 {
                continue;
            }
            let base = dvec2((left + cell * 0.5).floor(), ((along[0] + along[1]) * 0.5).floor());
            doc.texture_quad(
                id,
                quad.map(|p| self.project(p, middle)),
                quad.map(|p| mirrored(p - base, base)),
            );
        }
    }

    fn project(self, p: DVec2, middle: f64) -> DVec2 {
        let depth = 1.0 + self.depth * p.y;
        dvec2(
            middle + (p.x + self.shift) * self.tile / depth,
            self.horizon + (self.bottom - self.horizon) / depth,
        )
    }
}

/// Coordinates inside the copy `base`; every other copy is turned over.
fn mirrored(inside: DVec2, base: DVec2) -> DVec2 {
    let flip = |t: f64, copy: f64| if copy.rem_euclid(2.0) < 0.5 { t } else { 1.0 - t };
    dvec2(flip(inside.x, base.x), flip(1.0 - inside.y, base.y))
}
