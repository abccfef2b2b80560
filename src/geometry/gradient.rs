//! Where on its ramp a gradient is at a point: linear ones, and radial ones between two circles.
//!
//! ```text
//!     linear:   from ----------+----------> to         t is how far along the point's foot lies
//!     radial:   the circle at t has its middle at focus + t (center - focus)
//!               and the radius focal_radius + t (radius - focal_radius);
//!               of all circles through the point the one with the largest t counts
//! ```
//!
//! SVG 2, sections 14.2.2 and 14.2.3; the canvas element's `createRadialGradient` for circles that are not inside each other.

use glam::DVec2;

/// The geometry of a gradient, in its own coordinates.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum GradientShape {
    /// Along a line.
    Linear {
        /// Where the ramp begins.
        from: DVec2,
        /// Where it ends.
        to: DVec2,
    },
    /// Between two circles.
    Radial {
        /// The middle of the circle on which the ramp ends.
        center: DVec2,
        /// Its radius.
        radius: f64,
        /// The middle of the circle on which the ramp begins.
        focus: DVec2,
        /// Its radius, mostly zero.
        focal_radius: f64,
    },
}

impl GradientShape {
    /// Whether every point has a place on the ramp.
    pub fn is_everywhere(&self) -> bool {
        match *self {
            Self::Linear { .. } => true,
            Self::Radial {
                center,
                radius,
                focus,
                focal_radius,
            } => center.distance(focus) + focal_radius < radius,
        }
    }

    /// The place on the ramp, before spreading; `None` where no circle of the gradient goes through the point.
    #[inline]
    pub fn at(&self, point: DVec2) -> Option<f64> {
        match *self {
            Self::Linear { from, to } => {
                let along = to - from;
                let length = along.length_squared();
                // A line without length shows its last stop.
                Some(if length > 0.0 {
                    (point - from).dot(along) / length
                } else {
                    1.0
                })
            }
            Self::Radial {
                center,
                radius,
                focus,
                focal_radius,
            } => circle_through(point - focus, center - focus, [focal_radius, radius]),
        }
    }
}

/// The largest `t` for which the circle around `t` times `center` goes through `point`, whose radius is mixed from both and
/// must not be negative.
#[inline]
fn circle_through(point: DVec2, center: DVec2, [first, last]: [f64; 2]) -> Option<f64> {
    // |point - t center|^2 = (first + t growth)^2, as a t^2 - 2 b t + c = 0.
    let growth = last - first;
    let a = center.length_squared() - growth * growth;
    let b = point.dot(center) + first * growth;
    let c = point.length_squared() - first * first;
    let has_radius = |t: &f64| first + t * growth >= 0.0;
    // Where both circles touch from inside, one of the two solutions goes to infinity.
    if a.abs() <= 1e-12 * (growth * growth).max(f64::MIN_POSITIVE) {
        return Some(c / (2.0 * b)).filter(|t| t.is_finite()).filter(has_radius);
    }
    let discriminant = b * b - a * c;
    if discriminant < 0.0 {
        return None;
    }
    let root = discriminant.sqrt();
    let (one, other) = ((b + root) / a, (b - root) / a);
    Some(one.max(other))
        .filter(has_radius)
        .or(Some(one.min(other)).filter(has_radius))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn linear_gradients_measure_along_their_line() {
        let shape = GradientShape::Linear {
            from: DVec2::new(10.0, 0.0),
            to: DVec2::new(20.0, 0.0),
        };
        for (x, t) in [(10.0, 0.0), (15.0, 0.5), (20.0, 1.0), (0.0, -1.0)] {
            assert_eq!(shape.at(DVec2::new(x, 77.0)), Some(t), "at {x}");
        }
        let point = GradientShape::Linear {
            from: DVec2::ONE,
            to: DVec2::ONE,
        };
        assert_eq!(point.at(DVec2::ZERO), Some(1.0), "without length: the last stop");
    }

    #[test]
    fn radial_gradients_grow_from_the_focus() {
        let around = |focus: DVec2, focal_radius: f64| GradientShape::Radial {
            center: DVec2::ZERO,
            radius: 10.0,
            focus,
            focal_radius,
        };
        let near = |t: Option<f64>, expected: f64| assert!((t.expect("a circle") - expected).abs() < 1e-12);
        near(around(DVec2::ZERO, 0.0).at(DVec2::new(3.0, 4.0)), 0.5);
        near(around(DVec2::ZERO, 5.0).at(DVec2::new(0.0, 7.5)), 0.5);
        // Half way the circle has its middle half way to the centre, at (-3, 0), and the radius 5.
        near(around(DVec2::new(-6.0, 0.0), 0.0).at(DVec2::new(2.0, 0.0)), 0.5);
        near(around(DVec2::new(-6.0, 0.0), 0.0).at(DVec2::new(-8.0, 0.0)), 0.5);
        near(around(DVec2::new(-10.0, 0.0), 0.0).at(DVec2::new(0.0, 0.0)), 0.5);
        assert_eq!(
            around(DVec2::new(-10.0, 0.0), 0.0).at(DVec2::new(-11.0, 0.0)),
            None,
            "behind a focus on the circle there is nothing"
        );
        assert_eq!(
            around(DVec2::new(-20.0, 0.0), 0.0).at(DVec2::new(-30.0, 0.0)),
            None,
            "nor behind a cone's tip"
        );
    }

    #[test]
    fn what_is_found_lies_on_its_circle() {
        arbtest::arbtest(|u| {
            let mut at = || -> arbtest::arbitrary::Result<f64> { Ok(f64::from(u.int_in_range(-400..=400)?) / 8.0) };
            let (center, focus, point) = (
                DVec2::new(at()?, at()?),
                DVec2::new(at()?, at()?),
                DVec2::new(at()?, at()?),
            );
            let (radius, focal_radius) = (at()?.abs() + 1.0, at()?.abs());
            let shape = GradientShape::Radial {
                center,
                radius,
                focus,
                focal_radius,
            };
            if let Some(t) = shape.at(point) {
                let middle = focus + (center - focus) * t;
                let expected = focal_radius + (radius - focal_radius) * t;
                let error = (point.distance(middle) - expected).abs();
                assert!(error <= 1e-6 * (1.0 + expected), "{shape:?} at {point}: off by {error}");
            }
            Ok(())
        })
        .budget_ms(200);
    }
}
