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

use fearless_simd::prelude::*;
use fearless_simd::{Simd, dispatch, f64x8, mask64x8};
use glam::{DAffine2, DVec2};

use crate::simd;

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

    /// The place on the ramp, before spreading; `None` where no circle of the gradient goes through the point. The simple form of
    /// [`PlacedShape::places`], which may differ by rounding.
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

    /// The same gradient asked in other coordinates, which `to_own` takes to its own.
    pub fn placed(&self, to_own: DAffine2) -> PlacedShape {
        match *self {
            Self::Linear { from, to } => {
                let along = to - from;
                let length = along.length_squared();
                // A line without length shows its last stop.
                let [right, down, start] = if length > 0.0 {
                    let [x, y, start] = [to_own.matrix2.x_axis, to_own.matrix2.y_axis, to_own.translation - from];
                    [x, y, start].map(|vector| vector.dot(along) / length)
                } else {
                    [0.0, 0.0, 1.0]
                };
                PlacedShape::Linear { right, down, start }
            }
            Self::Radial {
                center,
                radius,
                focus,
                focal_radius,
            } => {
                let to_focus = DAffine2::from_translation(-focus) * to_own;
                PlacedShape::Radial(Circles::new(to_focus, center - focus, [focal_radius, radius]))
            }
        }
    }
}

/// A gradient's shape as it lies in other coordinates than its own.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum PlacedShape {
    /// Along a line: the place on the ramp is an affine function.
    Linear {
        /// Change of the place along `x`.
        right: f64,
        /// And along `y`.
        down: f64,
        /// The place at the origin.
        start: f64,
    },
    /// Between two circles.
    Radial(Circles),
}

/// The circles of a radial gradient, around its focus.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Circles {
    /// To coordinates of the gradient whose origin is the focus.
    to_focus: DAffine2,
    /// The middle of the last circle there.
    center: DVec2,
    /// The radius of the first one, and what the last one has more.
    first: f64,
    growth: f64,
    /// Of `a t^2 - 2 b t + c = 0`, and one over it.
    a: f64,
    inverse: f64,
    /// Whether `a` vanishes: both circles touch from inside, and one of the two solutions goes to infinity.
    touch: bool,
}

#[expect(
    clippy::inline_always,
    reason = "only what is inlined into a dispatched function is compiled for its vector instructions"
)]
impl PlacedShape {
    /// The places on the ramp, before spreading, of eight points; no number where no circle of the gradient goes through one.
    /// Each depends on its own point only, to the last bit, whichever vector instructions compute it.
    #[inline(always)]
    pub fn places<S: Simd>(&self, simd: S, [x, y]: [f64x8<S>; 2]) -> f64x8<S> {
        match self {
            Self::Linear { right, down, start } => x * *right + y * *down + *start,
            Self::Radial(circles) => circles.places(simd, [x, y]),
        }
    }

    /// Whether the place is the same for all points of a line from left to right.
    pub fn is_level(&self) -> bool {
        matches!(self, Self::Linear { right, .. } if *right == 0.0)
    }

    /// The place on the ramp of one point, before spreading; no number where no circle of the gradient goes through it.
    pub fn place(&self, point: DVec2) -> f64 {
        dispatch!(simd::level(), simd => {
            let point = [f64x8::splat(simd, point.x), f64x8::splat(simd, point.y)];
            <[f64; 8]>::from(self.places(simd, point))[0]
        })
    }
}

// The circle around `t` times `center` goes through a point: |point - t center|^2 = (first + t growth)^2, which is
// a t^2 - 2 b t + c = 0. Its radius must not be negative.
#[expect(
    clippy::inline_always,
    reason = "only what is inlined into a dispatched function is compiled for its vector instructions"
)]
impl Circles {
    fn new(to_focus: DAffine2, center: DVec2, [first, last]: [f64; 2]) -> Self {
        let growth = last - first;
        let a = center.length_squared() - growth * growth;
        Self {
            to_focus,
            center,
            first,
            growth,
            a,
            inverse: a.recip(),
            touch: a.abs() <= 1e-12 * (growth * growth).max(f64::MIN_POSITIVE),
        }
    }

    #[inline(always)]
    fn places<S: Simd>(&self, simd: S, [x, y]: [f64x8<S>; 2]) -> f64x8<S> {
        let none = f64x8::splat(simd, f64::NAN);
        let DAffine2 { matrix2, translation } = self.to_focus;
        let right = x * matrix2.x_axis.x + y * matrix2.y_axis.x + translation.x;
        let down = x * matrix2.x_axis.y + y * matrix2.y_axis.y + translation.y;
        let b = right * self.center.x + down * self.center.y + self.first * self.growth;
        let c = right * right + down * down - self.first * self.first;
        if self.touch {
            let t = c / (b + b);
            let finite = t.abs().simd_lt(f64x8::splat(simd, f64::INFINITY));
            return (self.has_radius(simd, t) & finite).select(t, none);
        }
        // Where there is no solution, the root is no number, nor is what follows from it.
        let root = (b * b - c * self.a).sqrt();
        let (one, other) = ((b + root) * self.inverse, (b - root) * self.inverse);
        let larger = one.simd_gt(other).select(one, other);
        let smaller = one.simd_gt(other).select(other, one);
        let smaller_or_none = self.has_radius(simd, smaller).select(smaller, none);
        self.has_radius(simd, larger).select(larger, smaller_or_none)
    }

    /// Whether the circles at these places on the ramp have one.
    #[inline(always)]
    fn has_radius<S: Simd>(&self, simd: S, t: f64x8<S>) -> mask64x8<S> {
        (t * self.growth + self.first).simd_ge(f64x8::splat(simd, 0.0))
    }
}

/// The largest `t` for which the circle around `t` times `center` goes through `point`, whose radius is mixed from both and
/// must not be negative.
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

    /// The place of a point of the gradient's own coordinates.
    fn place(shape: GradientShape, point: [f64; 2]) -> Option<f64> {
        let place = shape.placed(DAffine2::IDENTITY).place(DVec2::from(point));
        (!place.is_nan()).then_some(place)
    }

    #[test]
    fn linear_gradients_measure_along_their_line() {
        let shape = GradientShape::Linear {
            from: DVec2::new(10.0, 0.0),
            to: DVec2::new(20.0, 0.0),
        };
        for (x, t) in [(10.0, 0.0), (15.0, 0.5), (20.0, 1.0), (0.0, -1.0)] {
            assert_eq!(place(shape, [x, 77.0]), Some(t), "at {x}");
        }
        let point = GradientShape::Linear {
            from: DVec2::ONE,
            to: DVec2::ONE,
        };
        assert_eq!(place(point, [0.0; 2]), Some(1.0), "without length: the last stop");
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
        near(place(around(DVec2::ZERO, 0.0), [3.0, 4.0]), 0.5);
        near(place(around(DVec2::ZERO, 5.0), [0.0, 7.5]), 0.5);
        // Half way the circle has its middle half way to the centre, at (-3, 0), and the radius 5.
        near(place(around(DVec2::new(-6.0, 0.0), 0.0), [2.0, 0.0]), 0.5);
        near(place(around(DVec2::new(-6.0, 0.0), 0.0), [-8.0, 0.0]), 0.5);
        near(place(around(DVec2::new(-10.0, 0.0), 0.0), [0.0, 0.0]), 0.5);
        assert_eq!(
            place(around(DVec2::new(-10.0, 0.0), 0.0), [-11.0, 0.0]),
            None,
            "behind a focus on the circle there is nothing"
        );
        assert_eq!(
            place(around(DVec2::new(-20.0, 0.0), 0.0), [-30.0, 0.0]),
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
            let found = place(shape, point.to_array());
            // Close to a cone's edge rounding decides whether there is a circle at all.
            if let (Some(one), Some(other)) = (found, shape.at(point)) {
                assert!(
                    (one - other).abs() <= 1e-6 * (1.0 + one.abs()),
                    "{shape:?} at {point}: {one} and {other}"
                );
            }
            if let Some(t) = found {
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
