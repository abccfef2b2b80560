//! Sine, cosine and exponential from `+ - * /` alone.
//!
//! The standard library's versions come from the platform and may differ in the last bit; these give the same bits
//! everywhere, so that the scenes and textures can be compared byte for byte.

use std::f64::consts::{FRAC_PI_2, LN_2};

use glam::{DVec2, dvec2};

pub(crate) use std::f64::consts::TAU;

/// Low part of pi/2, for a reduction that stays exact over many turns.
const FRAC_PI_2_LOW: f64 = 6.123_233_995_736_766e-17;

/// Sine and cosine of an angle in radians.
pub(crate) fn sin_cos(angle: f64) -> (f64, f64) {
    let quarter = (angle / FRAC_PI_2).round();
    let rest = (angle - quarter * FRAC_PI_2) - quarter * FRAC_PI_2_LOW;
    let square = rest * rest;
    let (mut sine, mut cosine) = (0.0, 0.0);
    // Horner's scheme on the Taylor series; the remainder at pi/4 is below the last bit.
    for k in (0..9).rev() {
        let k = f64::from(k);
        sine = 1.0 - square / ((2.0 * k + 2.0) * (2.0 * k + 3.0)) * sine;
        cosine = 1.0 - square / ((2.0 * k + 1.0) * (2.0 * k + 2.0)) * cosine;
    }
    sine *= rest;
    match quarter.rem_euclid(4.0) {
        q if q < 0.5 => (sine, cosine),
        q if q < 1.5 => (cosine, -sine),
        q if q < 2.5 => (-sine, -cosine),
        _ => (-cosine, sine),
    }
}

/// Sine of an angle in radians.
pub(crate) fn sin(angle: f64) -> f64 {
    sin_cos(angle).0
}

/// Cosine of an angle in radians.
pub(crate) fn cos(angle: f64) -> f64 {
    sin_cos(angle).1
}

/// The point at `radius` from the origin, `angle` radians from the x axis towards the y axis.
pub(crate) fn polar(radius: f64, angle: f64) -> DVec2 {
    let (sine, cosine) = sin_cos(angle);
    dvec2(radius * cosine, radius * sine)
}

/// `v` turned by `angle` radians from the x axis towards the y axis.
pub(crate) fn turned(v: DVec2, angle: f64) -> DVec2 {
    let (sine, cosine) = sin_cos(angle);
    dvec2(v.x * cosine - v.y * sine, v.x * sine + v.y * cosine)
}

/// `e` to the power `x`, for moderate `x`.
pub(crate) fn exp(x: f64) -> f64 {
    let halvings = (x / LN_2).round();
    let rest = x - halvings * LN_2;
    let mut sum = 1.0;
    for k in (1..18).rev() {
        sum = 1.0 + rest / f64::from(k) * sum;
    }
    let factor = if halvings < 0.0 { 0.5 } else { 2.0 };
    let mut steps = halvings.abs();
    while steps > 0.5 {
        sum *= factor;
        steps -= 1.0;
    }
    sum
}
