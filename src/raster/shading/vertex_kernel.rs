//! Interpolated opaque colours of [`LANES`] samples or pixels at once.

#![expect(
    clippy::inline_always,
    reason = "only what is inlined into a dispatched function is compiled for its vector instructions"
)]

use fearless_simd::prelude::*;
use fearless_simd::{Simd, f64x8, u64x8};

use crate::color::Premultiplied16;
use crate::raster::attributes::Planes;
use crate::raster::shading::kernel::{LANES, ONE, low_word, places_of, whole};
use crate::texture::SampleGrid;

/// Where up to [`LANES`] pixels lie: the middles of their samples, in samples.
#[inline(always)]
fn middles(grid: SampleGrid, pixels: &[[u16; 2]]) -> [[f64; LANES]; 2] {
    let side = f64::from(grid.side);
    let mut middles = [[0.0; LANES]; 2];
    for (i, [x, y]) in pixels.iter().enumerate() {
        middles[0][i] = (f64::from(grid.origin[0]) + f64::from(*x) + 0.5) * side;
        middles[1][i] = (f64::from(grid.origin[1]) + f64::from(*y) + 0.5) * side;
    }
    middles
}

/// Red, green and blue of [`LANES`] places, times `count`.
#[inline(always)]
fn channels<S: Simd>(simd: S, planes: &Planes<3>, [x, y]: [[f64; LANES]; 2], count: f64) -> [u64x8<S>; 3] {
    let number = |value| f64x8::splat(simd, value);
    let right = f64x8::simd_from(simd, x) - planes.pivot[0];
    let down = f64x8::simd_from(simd, y) - planes.pivot[1];
    let mut channels = [u64x8::splat(simd, 0); 3];
    for (k, channel) in channels.iter_mut().enumerate() {
        // In the order of `Planes::at`.
        let value = number(planes.at_pivot[k]) + down * planes.dy[k] + right * planes.dx[k];
        *channel = whole(simd, value * count, ONE * count);
    }
    channels
}

/// Opaque colours at samples.
#[inline(always)]
pub(super) fn point_kernel<S: Simd>(
    simd: S,
    planes: &Planes<3>,
    grid: SampleGrid,
    points: &[[u16; 2]],
    colors: &mut [Premultiplied16],
) {
    for (points, colors) in points.chunks(LANES).zip(colors.chunks_mut(LANES)) {
        let [r, g, b] = channels(simd, planes, places_of(grid, points), 1.0);
        let words = r | g << 16 | b << 32 | u64::from(Premultiplied16::ONE) << 48;
        for (color, word) in colors.iter_mut().zip(words.to_array()) {
            *color = Premultiplied16::from_word(word);
        }
    }
}

/// The values of opaque pixels with one sample each.
#[inline(always)]
pub(super) fn pixel_kernel<S: Simd>(
    simd: S,
    planes: &Planes<3>,
    grid: SampleGrid,
    pixels: &[[u16; 2]],
    values: &mut [u32],
) {
    let half = u64::from(Premultiplied16::PER_BYTE) / 2;
    for (pixels, values) in pixels.chunks(LANES).zip(values.chunks_mut(LANES)) {
        let [r, g, b] = channels(simd, planes, middles(grid, pixels), 1.0);
        let byte = |channel: u64x8<S>| (channel + half) >> 8;
        let shaded = byte(r) << 16 | byte(g) << 8 | byte(b) | 0xFF00_0000;
        for (value, shaded) in values.iter_mut().zip(shaded.to_array()) {
            *value = low_word(shaded);
        }
    }
}

/// The sums of all samples of pixels of a grid: of the plane at their middle.
#[inline(always)]
pub(super) fn sum_kernel<S: Simd>(
    simd: S,
    planes: &Planes<3>,
    grid: SampleGrid,
    pixels: &[[u16; 2]],
    sums: &mut [[u32; 4]],
) {
    let samples = grid.side * grid.side;
    let alpha = samples * u32::from(Premultiplied16::ONE);
    for (pixels, sums) in pixels.chunks(LANES).zip(sums.chunks_mut(LANES)) {
        let [r, g, b] = channels(simd, planes, middles(grid, pixels), f64::from(samples));
        let (red_green, blue) = ((r | g << 32).to_array(), b.to_array());
        for (i, sum) in sums.iter_mut().enumerate() {
            *sum = [
                low_word(red_green[i]),
                low_word(red_green[i] >> 32),
                low_word(blue[i]),
                alpha,
            ];
        }
    }
}
