//! How much of a texture one pixel sees, and which mip level has texels of that size.

use glam::DVec2;

use super::FootprintExtent;

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

    /// Level of detail `log2(extent)`, where the base level has `size` texels and the longer extent is
    /// `max(|d(uv size)/dx|, |d(uv size)/dy|)`.
    ///
    /// Not clamped: below zero under magnification, minus infinity for a constant `(u, v)`. See OpenGL 4.6, section
    /// 8.14. A footprint that is not finite counts as infinitely large.
    pub fn level_of_detail(&self, size: DVec2, extent: FootprintExtent) -> f64 {
        let (dx, dy) = (self.dx * size, self.dy * size);
        let (right, down) = (dx.length_squared(), dy.length_squared());
        let both = right + down;
        // The sum rather than the maximum, which would hide a NaN.
        if !both.is_finite() {
            return f64::INFINITY;
        }
        let area = dx.perp_dot(dy).abs();
        match extent {
            FootprintExtent::Longer => 0.5 * right.max(down).log2(),
            FootprintExtent::Area => 0.5 * area.log2(),
            FootprintExtent::Shorter => {
                // The product of the ellipse's axes is the area, the sum of their squares that of both steps.
                let major = f64::midpoint(both, (both * both - 4.0 * area * area).max(0.0).sqrt()).sqrt();
                if major > 0.0 {
                    (area / major).log2()
                } else {
                    f64::NEG_INFINITY
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn level_of_detail_is_log2_of_the_longer_step() {
        let longer = FootprintExtent::Longer;
        let size = DVec2::new(64.0, 32.0);
        let footprint = |dx, dy| Footprint { dx, dy };
        let four = footprint(DVec2::new(4.0 / 64.0, 0.0), DVec2::new(0.0, 1.0 / 32.0));
        assert!(
            (four.level_of_detail(size, longer) - 2.0).abs() < 1e-12,
            "four texels per pixel to the right"
        );
        let half = footprint(DVec2::new(0.25 / 64.0, 0.0), DVec2::new(0.0, 0.5 / 32.0));
        assert!(
            (half.level_of_detail(size, longer) + 1.0).abs() < 1e-12,
            "magnified twice"
        );
        let nothing = footprint(DVec2::ZERO, DVec2::ZERO);
        assert!(nothing.level_of_detail(size, longer) < -1e300, "a constant");
        let broken = footprint(DVec2::NAN, DVec2::ZERO);
        assert!(broken.level_of_detail(size, longer) > 1e300, "no number");
    }

    #[test]
    fn extents_of_a_slanted_footprint_are_those_of_its_ellipse() {
        let size = DVec2::splat(64.0);
        let of = |footprint: Footprint| FootprintExtent::ALL.map(|extent| footprint.level_of_detail(size, extent));
        let upright = Footprint {
            dx: DVec2::new(16.0, 0.0) / 64.0,
            dy: DVec2::new(0.0, 4.0) / 64.0,
        };
        for (level, expected) in of(upright).into_iter().zip([4.0, 3.0, 2.0]) {
            assert!((level - expected).abs() < 1e-9, "16 by 4 texels: {level}");
        }
        // Both steps are as long, and lie nearly along each other: the same ellipse, seen from another side.
        let turned = Footprint {
            dx: DVec2::new(16.0, 4.0) / 64.0 / 2.0_f64.sqrt(),
            dy: DVec2::new(16.0, -4.0) / 64.0 / 2.0_f64.sqrt(),
        };
        let [longer, area, shorter] = of(turned);
        assert!(
            (area - 3.0).abs() < 1e-9 && (shorter - 2.0).abs() < 1e-9,
            "{area} {shorter}"
        );
        assert!((longer - 136.0_f64.sqrt().log2()).abs() < 1e-9, "one step: {longer}");
        // The minor axis is the least step in any direction.
        let least = (0..20_000).map(|i| {
            let (sin, cos) = (f64::from(i) * 1e-4 * std::f64::consts::PI).sin_cos();
            ((turned.dx * cos + turned.dy * sin) * size).length()
        });
        assert!(
            (least.fold(f64::MAX, f64::min) - shorter.exp2()).abs() < 1e-3,
            "{shorter}"
        );
        let line = Footprint {
            dx: DVec2::new(0.5, 0.25),
            dy: DVec2::new(1.0, 0.5),
        };
        assert!(of(line)[1] < -1e300 && of(line)[2] < -1e300, "it has no width");
        for extent in FootprintExtent::ALL {
            let nothing = Footprint {
                dx: DVec2::ZERO,
                dy: DVec2::ZERO,
            };
            assert!(
                nothing.level_of_detail(size, extent) < -1e300,
                "a constant, by {extent:?}"
            );
            let broken = Footprint {
                dx: DVec2::NAN,
                ..nothing
            };
            assert!(broken.level_of_detail(size, extent) > 1e300, "no number, by {extent:?}");
        }
    }
}
