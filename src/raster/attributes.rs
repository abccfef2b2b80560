//! Attributes of a triangle as affine functions of the sample position.
//!
//! They are evaluated in 64 bits at absolute positions relative to a corner of the triangle. So a sample's value depends
//! on its own position only, never on the tile or the list it is shaded with, and moving a triangle by whole pixels
//! moves its colours with it, to the last bit.

use glam::DVec2;

use crate::geometry::edge::doubled_area;
use crate::geometry::subpixel::{GridPoint, SubpixelGrid};

/// `K` attributes as affine functions of sample column and row.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Planes<const K: usize> {
    /// The first corner, in samples: sample `i` lies at `i + 1/2`.
    pub(crate) pivot: [f64; 2],
    pub(crate) at_pivot: [f64; K],
    /// Change from one sample to the next on its right, and to the one below.
    pub(crate) dx: [f64; K],
    pub(crate) dy: [f64; K],
}

impl<const K: usize> Planes<K> {
    /// The planes through a triangle's corners, whose area must not be zero.
    pub(crate) fn new(grid: SubpixelGrid, corners: &[GridPoint; 3], values: [[f32; K]; 3]) -> Self {
        // A power of two, so that dividing by it is exact.
        let units = f64::from(1_u32 << grid.bits());
        let side = |from: usize, to: usize| {
            let dx = i64::from(corners[to].x) - i64::from(corners[from].x);
            let dy = i64::from(corners[to].y) - i64::from(corners[from].y);
            DVec2::new(dx as f64, dy as f64) / units
        };
        let (b, c) = (side(0, 1), side(0, 2));
        let area = doubled_area(*corners) as f64 / (units * units);
        let mut planes = Self {
            pivot: [f64::from(corners[0].x) / units, f64::from(corners[0].y) / units],
            at_pivot: [0.0; K],
            dx: [0.0; K],
            dy: [0.0; K],
        };
        for (i, first) in values[0].into_iter().enumerate() {
            let first = f64::from(first);
            let (to_b, to_c) = (f64::from(values[1][i]) - first, f64::from(values[2][i]) - first);
            planes.at_pivot[i] = first;
            planes.dx[i] = (to_b * c.y - to_c * b.y) / area;
            planes.dy[i] = (to_c * b.x - to_b * c.x) / area;
        }
        planes
    }

    /// The same attributes times `factor`.
    pub(crate) fn scaled(mut self, factor: f64) -> Self {
        for values in [&mut self.at_pivot, &mut self.dx, &mut self.dy] {
            for value in values {
                *value *= factor;
            }
        }
        self
    }

    /// The attributes at a place given in samples.
    #[inline]
    pub(crate) fn at(&self, x: f64, y: f64) -> [f64; K] {
        let (right, down) = (x - self.pivot[0], y - self.pivot[1]);
        let mut values = [0.0; K];
        for (k, value) in values.iter_mut().enumerate() {
            *value = self.at_pivot[k] + self.dy[k] * down + self.dx[k] * right;
        }
        values
    }
}
