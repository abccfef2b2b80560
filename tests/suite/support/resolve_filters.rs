//! Resolve filters, written anew from their papers for the oracle: what a sample weighs, and how far.

use std::f64::consts::{PI, TAU};

use rasterscope::raster::{FilterRadius, ResolveFilter};
use rasterscope::render::RenderSettings;

/// Along one axis, weights are multiples of one over this: that is part of their definition.
const STEPS: f64 = 8192.0;

/// How far a filter reaches by itself, in pixels.
fn own_radius(filter: ResolveFilter) -> f64 {
    match filter {
        ResolveFilter::Box => 0.5,
        ResolveFilter::Tent => 1.0,
        ResolveFilter::Gaussian | ResolveFilter::BlackmanHarris => 1.5,
        ResolveFilter::BSpline | ResolveFilter::CatmullRom | ResolveFilter::Mitchell | ResolveFilter::Lanczos2 => 2.0,
        ResolveFilter::Lanczos3 => 3.0,
    }
}

/// The radius that settings ask for, in pixels.
pub(crate) fn radius(settings: &RenderSettings) -> f64 {
    settings
        .filter_radius
        .map_or(own_radius(settings.resolve_filter), FilterRadius::pixels)
}

/// Pixels on each side of a pixel in which samples may weigh anything.
pub(crate) fn margin(settings: &RenderSettings) -> i64 {
    // None reaches farther than four pixels.
    (0..4)
        .find(|pixels| *pixels as f64 >= radius(settings) - 0.5)
        .unwrap_or(4)
}

/// What a filter is at a distance from the middle, where it is as wide as by itself.
fn unscaled(filter: ResolveFilter, x: f64) -> f64 {
    let sinc = |x: f64| if x == 0.0 { 1.0 } else { (PI * x).sin() / (PI * x) };
    match filter {
        ResolveFilter::Box => 1.0,
        ResolveFilter::Tent => 1.0 - x,
        ResolveFilter::Gaussian => (-2.0 * x * x).exp() - (-4.5_f64).exp(),
        // As each is printed in books, not by two parameters.
        ResolveFilter::BSpline if x < 1.0 => 2.0 / 3.0 - x * x + x.powi(3) / 2.0,
        ResolveFilter::BSpline => (2.0 - x).powi(3) / 6.0,
        ResolveFilter::CatmullRom if x < 1.0 => 1.5 * x.powi(3) - 2.5 * x * x + 1.0,
        ResolveFilter::CatmullRom => -0.5 * x.powi(3) + 2.5 * x * x - 4.0 * x + 2.0,
        ResolveFilter::Mitchell if x < 1.0 => (21.0 * x.powi(3) - 36.0 * x * x + 16.0) / 18.0,
        ResolveFilter::Mitchell => (-7.0 * x.powi(3) + 36.0 * x * x - 60.0 * x + 32.0) / 18.0,
        ResolveFilter::Lanczos2 => sinc(x) * sinc(x / 2.0),
        ResolveFilter::Lanczos3 => sinc(x) * sinc(x / 3.0),
        ResolveFilter::BlackmanHarris => {
            // From one end of the window to the other.
            let turn = TAU * (x + 1.5) / 3.0;
            0.35875 - 0.48829 * turn.cos() + 0.14128 * (2.0 * turn).cos() - 0.01168 * (3.0 * turn).cos()
        }
    }
}

/// What a sample weighs by its offset from the middle of a pixel, in pixels.
pub(crate) fn weight(settings: &RenderSettings, offset: [f64; 2]) -> f64 {
    let (filter, radius) = (settings.resolve_filter, radius(settings));
    let stretch = radius / own_radius(filter);
    let along = |x: f64| {
        if x.abs() < radius {
            (unscaled(filter, x.abs() / stretch) / stretch * STEPS).round() / STEPS
        } else {
            0.0
        }
    };
    along(offset[0]) * along(offset[1])
}
