//! How much of a texture one pixel sees, and which mip level has texels of that size.

use glam::DVec2;

/// The change of `(u, v)` from one pixel to the next; constant over a triangle, because its map is affine.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Footprint {
    /// `(du/dx, dv/dx)`: one pixel to the right.
    pub dx: DVec2,
    /// `(du/dy, dv/dy)`: one pixel down.
    pub dy: DVec2,
}

impl Footprint {
    /// That of steps which are `factor` times as long.
    #[must_use]
    pub fn scaled(&self, factor: f64) -> Self {
        Self {
            dx: self.dx * factor,
            dy: self.dy * factor,
        }
    }

    /// Level of detail `log2(max(|d(uv size)/dx|, |d(uv size)/dy|))`, where `size` is the base level's in texels.
    ///
    /// Not clamped: below zero under magnification, minus infinity for a constant `(u, v)`. See OpenGL 4.6, section
    /// 8.14. A footprint that is not finite counts as infinitely large.
    pub fn level_of_detail(&self, size: DVec2) -> f64 {
        let (right, down) = ((self.dx * size).length_squared(), (self.dy * size).length_squared());
        // The sum rather than the maximum, which would hide a NaN.
        if (right + down).is_finite() {
            0.5 * right.max(down).log2()
        } else {
            f64::INFINITY
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn level_of_detail_is_log2_of_the_longer_step() {
        let size = DVec2::new(64.0, 32.0);
        let footprint = |dx, dy| Footprint { dx, dy };
        let four = footprint(DVec2::new(4.0 / 64.0, 0.0), DVec2::new(0.0, 1.0 / 32.0));
        assert!(
            (four.level_of_detail(size) - 2.0).abs() < 1e-12,
            "four texels per pixel to the right"
        );
        let half = footprint(DVec2::new(0.25 / 64.0, 0.0), DVec2::new(0.0, 0.5 / 32.0));
        assert!((half.level_of_detail(size) + 1.0).abs() < 1e-12, "magnified twice");
        let nothing = footprint(DVec2::ZERO, DVec2::ZERO);
        assert!(nothing.level_of_detail(size) < -1e300, "a constant");
        let broken = footprint(DVec2::NAN, DVec2::ZERO);
        assert!(broken.level_of_detail(size) > 1e300, "no number");
    }
}
