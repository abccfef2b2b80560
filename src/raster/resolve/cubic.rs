//! Two pieces of cubic polynomials on each side, by two parameters `(B, C)`: Mitchell and Netravali, "Reconstruction filters
//! in computer graphics" (SIGGRAPH 1988), equation 8.
//!
//! | filter | B | C | |
//! |---|---|---|---|
//! | B-spline | 1 | 0 | never below zero, the softest |
//! | Mitchell-Netravali | 1/3 | 1/3 | what viewers of the paper liked best: a little blur, a little ringing |
//! | Catmull-Rom | 0 | 1/2 | goes through the samples: sharp, and rings |

use crate::raster::resolve::weigh::Weigh;

pub(super) struct Cubic {
    b: f64,
    c: f64,
}

impl Cubic {
    pub(super) const B_SPLINE: Self = Self { b: 1.0, c: 0.0 };
    pub(super) const CATMULL_ROM: Self = Self { b: 0.0, c: 0.5 };
    pub(super) const MITCHELL: Self = Self {
        b: 1.0 / 3.0,
        c: 1.0 / 3.0,
    };
}

impl Weigh for Cubic {
    fn radius(&self) -> f64 {
        2.0
    }

    fn weight(&self, distance: f64) -> f64 {
        let (Self { b, c }, x) = (self, distance);
        let [cubic, square, linear, constant] = if x < 1.0 {
            [12.0 - 9.0 * b - 6.0 * c, -18.0 + 12.0 * b + 6.0 * c, 0.0, 6.0 - 2.0 * b]
        } else {
            [
                -b - 6.0 * c,
                6.0 * b + 30.0 * c,
                -12.0 * b - 48.0 * c,
                8.0 * b + 24.0 * c,
            ]
        };
        (((cubic * x + square) * x + linear) * x + constant) / 6.0
    }
}
