//! An edge in fine fixed-point numbers, and where it crosses rows and columns of pixels.

use crate::geometry::subpixel::{GridPoint, SubpixelGrid, WHOLE};

/// Fractional bits of the coordinates in which areas are measured.
pub(super) const BITS: u32 = 20;

/// A pixel's side.
pub(super) const PIXEL: i64 = 1 << BITS;

/// An edge from its top to its bottom; coordinates in units of [`PIXEL`].
#[derive(Clone, Copy, Debug)]
pub(in crate::raster) struct AreaEdge {
    pub(super) top: [i64; 2],
    pub(super) bottom: [i64; 2],
    /// How often the contour winds around what lies right of it, more than around what lies left.
    pub(super) winding: i32,
    /// How far it moves to the right while it goes down by one.
    slope: f64,
}

impl AreaEdge {
    /// From two corners on the grid, of which the first lies above the other or beside it.
    pub(super) fn new(grid: SubpixelGrid, [top, bottom]: [GridPoint; 2], winding: i32) -> Self {
        let unit = PIXEL / i64::from(grid.side() << grid.bits());
        let [top, bottom] = [top, bottom].map(|at| [at.x, at.y].map(|at| i64::from(at) * unit));
        let [right, down] = [0, 1].map(|axis| (bottom[axis] - top[axis]) as f64);
        Self {
            top,
            bottom,
            winding,
            slope: if down > 0.0 { right / down } else { 0.0 },
        }
    }

    /// Where it crosses row `y`: at an end of it for rows beyond.
    #[inline]
    pub(super) fn x_at(&self, y: i64) -> i64 {
        if y <= self.top[1] {
            return self.top[0];
        }
        if y >= self.bottom[1] {
            return self.bottom[0];
        }
        let [low, high] = ordered(self.top[0], self.bottom[0]);
        (self.top[0] + rounded((y - self.top[1]) as f64 * self.slope)).clamp(low, high)
    }

    /// The place on it in row `y`.
    #[inline]
    pub(super) fn at(&self, y: i64) -> [i64; 2] {
        [self.x_at(y), y]
    }

    /// Where it crosses column `x`, which must lie between its ends, and these not above each other.
    #[inline]
    pub(super) fn y_at(&self, x: i64) -> i64 {
        let down = rounded((x - self.top[0]) as f64 / self.slope);
        (self.top[1] + down).clamp(self.top[1], self.bottom[1])
    }
}

/// The lesser one first.
#[inline]
pub(super) fn ordered(a: i64, b: i64) -> [i64; 2] {
    [a.min(b), a.max(b)]
}

/// To the nearest whole number, for values far below `2^51`.
#[inline]
pub(super) fn rounded(value: f64) -> i64 {
    (value + WHOLE).to_bits().cast_signed() - WHOLE.to_bits().cast_signed()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn edges_cross_rows_and_columns_where_lines_do() {
        let grid = SubpixelGrid::new(1);
        let at = |x: i32, y: i32| GridPoint { x: x << 14, y: y << 14 };
        let edge = AreaEdge::new(grid, [at(2, 1), at(6, 3)], 1);
        assert_eq!(edge.x_at(2 * PIXEL), 4 * PIXEL, "half way");
        assert_eq!(edge.y_at(5 * PIXEL), 2 * PIXEL + PIXEL / 2, "three quarters of the way");
        let ends = [edge.x_at(0), edge.x_at(9 * PIXEL)];
        assert_eq!(ends, [2 * PIXEL, 6 * PIXEL], "beyond its ends");
        for (value, expected) in [(0.2, 0), (0.7, 1), (-0.7, -1), (-1e9, -1_000_000_000)] {
            assert_eq!(rounded(value), expected, "{value}");
        }
    }
}
