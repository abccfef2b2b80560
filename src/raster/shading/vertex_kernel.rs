//! Interpolated opaque colours of [`LANES`] samples or pixels at once.

#![expect(
    clippy::inline_always,
    reason = "only what is inlined into a dispatched function is compiled for its vector instructions"
)]

use fearless_simd::prelude::*;
use fearless_simd::{Simd, f64x8, u32x8, u64x8};

use crate::color::{Premultiplied16, Resolver};
use crate::raster::attributes::Planes;
use crate::raster::shading::context::{MaskedPixels, PixelRun, Pixels};
use crate::raster::shading::kernel::{
    LANES, ONE, columns_and_rows, first_sample, low_word, places_of, whole, whole_up_to,
};
use crate::texture::SampleGrid;

/// Red, green and blue of [`LANES`] places, times `count`.
#[inline(always)]
fn channels<S: Simd>(simd: S, planes: &Planes<3>, [x, y]: [f64x8<S>; 2], count: f64x8<S>) -> [u64x8<S>; 3] {
    let right = x - planes.pivot[0];
    let down = y - planes.pivot[1];
    let mut channels = [u64x8::splat(simd, 0); 3];
    for (k, channel) in channels.iter_mut().enumerate() {
        // In the order of `Planes::at`.
        let value = down * planes.dy[k] + planes.at_pivot[k] + right * planes.dx[k];
        *channel = whole_up_to(simd, value * count, count * ONE);
    }
    channels
}

/// Where up to [`LANES`] pixels lie: the middles of their samples, in samples.
#[inline(always)]
fn middles_of<S: Simd>(simd: S, grid: SampleGrid, pixels: &[[u16; 2]]) -> [f64x8<S>; 2] {
    let [left, top] = grid.origin.map(|pixel| f64::from(pixel) + 0.5);
    let [columns, rows] = columns_and_rows(simd, pixels);
    let side = f64::from(grid.side);
    [(columns + left) * side, (rows + top) * side]
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
        let [r, g, b] = channels(simd, planes, places_of(simd, grid, points), f64x8::splat(simd, 1.0));
        let words = r | g << 16 | b << 32 | u64::from(Premultiplied16::ONE) << 48;
        for (color, word) in colors.iter_mut().zip(words.to_array()) {
            *color = Premultiplied16::from_word(word);
        }
    }
}

/// How sums of samples become bytes where dividing by their number is shifting.
#[derive(Clone, Copy, Debug)]
pub(super) struct Bytes {
    samples: f64,
    half: u64,
    shift: u32,
}

impl Bytes {
    /// As `resolver` does; `None` where it has to divide.
    pub(super) fn of(resolver: &Resolver) -> Option<Self> {
        Some(Self {
            samples: f64::from(resolver.count()),
            half: resolver.half().into(),
            shift: resolver.shift()?,
        })
    }
}

/// The opaque pixels of runs, one after the other, by the plane at the middle of each pixel: what [`sum_kernel`] finds, resolved.
#[inline(always)]
pub(super) fn run_kernel<S: Simd>(
    simd: S,
    planes: &Planes<3>,
    grid: SampleGrid,
    bytes: Bytes,
    (runs, values): (&[PixelRun], &mut [u32]),
) {
    let side = f64::from(grid.side);
    let middle =
        |axis: usize, pixel: u16| (f64::from(grid.origin[axis]) + f64::from(pixel) + 0.5) * side - planes.pivot[axis];
    let mut steps = [0.0; LANES];
    for (i, step) in steps.iter_mut().enumerate() {
        *step = i as f64 * side;
    }
    let steps = f64x8::simd_from(simd, steps);
    let next = LANES as f64 * side;
    let limit = ONE * bytes.samples;
    let mut first = 0;
    for run in runs {
        let down = middle(1, run.row);
        // From one pixel to the next there are whole samples: nothing is rounded.
        let mut right = steps + middle(0, run.start);
        let end = first + run.len();
        for at in (first..end).step_by(LANES) {
            let mut pixels = u64x8::splat(simd, 0xFF);
            for k in 0..3 {
                // In the order of `Planes::at`.
                let value = right * planes.dx[k] + (planes.at_pivot[k] + down * planes.dy[k]);
                let sum = whole(simd, value * bytes.samples, limit);
                pixels = pixels << 8 | (sum + bytes.half) >> bytes.shift;
            }
            let (low, high) = pixels.split();
            let pixels: u32x8<S> = low.narrow(high);
            if let Some(values) = values[at..].first_chunk_mut::<LANES>() {
                // What lies beyond the run is written over by the next one.
                pixels.store_array(values);
            } else {
                let left = end - at;
                values[at..end].copy_from_slice(&pixels.to_array()[..left]);
            }
            right += next;
        }
        first = end;
    }
}

/// The samples along the side of a pixel of which every one has a bit in a mask, at most.
const MASKED_SIDE: usize = 8;

/// For each bit of a sample's column and of its row the samples that have it, where a pixel has so many samples along its side.
static PLACE_BITS: [[[u64; 3]; 2]; MASKED_SIDE + 1] = place_bits();

const fn place_bits() -> [[[u64; 3]; 2]; MASKED_SIDE + 1] {
    let mut all = [[[0; 3]; 2]; MASKED_SIDE + 1];
    let mut side = 1;
    while side <= MASKED_SIDE {
        let mut sample = 0;
        while sample < side * side {
            let place = [sample % side, sample / side];
            let mut bit = 0;
            while bit < 3 {
                let mut axis = 0;
                while axis < 2 {
                    all[side][axis][bit] |= ((place[axis] >> bit & 1) as u64) << sample;
                    axis += 1;
                }
                bit += 1;
            }
            sample += 1;
        }
        side += 1;
    }
    all
}

/// The sums of columns and of rows of the samples of a mask, of the 64 from `first` on.
#[inline(always)]
fn place_sums(side: u32, first: u32, mask: u64) -> [u32; 2] {
    let mut sums = [0; 2];
    if let Some(of_side) = PLACE_BITS.get(side as usize) {
        for bit in 0..u32::BITS - (side - 1).leading_zeros() {
            for (sum, samples) in sums.iter_mut().zip(of_side) {
                *sum += (mask & samples[bit as usize]).count_ones() << bit;
            }
        }
        return sums;
    }
    let mut rest = mask;
    while rest != 0 {
        let sample = first + rest.trailing_zeros();
        sums[0] += sample % side;
        sums[1] += sample / side;
        rest &= rest - 1;
    }
    sums
}

/// The sums of some samples of pixels of a grid: of the plane at the middle of these.
#[inline(always)]
pub(super) fn masked_kernel<S: Simd>(
    simd: S,
    planes: &Planes<3>,
    MaskedPixels { pixels, masks, first }: MaskedPixels<'_>,
    sums: &mut [[u32; 4]],
) {
    let Pixels { grid, places } = pixels;
    let [left, top] = first_sample(grid);
    let side = f64::from(grid.side);
    for ((places, masks), sums) in places
        .chunks(LANES)
        .zip(masks.chunks(LANES))
        .zip(sums.chunks_mut(LANES))
    {
        let (mut totals, mut counts, mut alphas) = ([[0.0; LANES]; 2], [1.0; LANES], [0; LANES]);
        for (i, mask) in masks.iter().enumerate() {
            let [columns, rows] = place_sums(grid.side, first, *mask);
            totals[0][i] = f64::from(columns);
            totals[1][i] = f64::from(rows);
            counts[i] = f64::from(mask.count_ones());
            alphas[i] = mask.count_ones() * u32::from(Premultiplied16::ONE);
        }
        let count = f64x8::simd_from(simd, counts);
        let shared = count.max(f64x8::splat(simd, 1.0));
        let [columns, rows] = columns_and_rows(simd, places);
        let x = columns * side + left + f64x8::simd_from(simd, totals[0]) / shared;
        let y = rows * side + top + f64x8::simd_from(simd, totals[1]) / shared;
        put_sums(channels(simd, planes, [x, y], count), alphas, sums);
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
    let count = f64x8::splat(simd, f64::from(samples));
    for (pixels, sums) in pixels.chunks(LANES).zip(sums.chunks_mut(LANES)) {
        let found = channels(simd, planes, middles_of(simd, grid, pixels), count);
        put_sums(found, [alpha; LANES], sums);
    }
}

/// Writes down the sums of red, green, blue and alpha.
#[inline(always)]
fn put_sums<S: Simd>([r, g, b]: [u64x8<S>; 3], alphas: [u32; LANES], sums: &mut [[u32; 4]]) {
    let (red_green, blue) = ((r | g << 32).to_array(), b.to_array());
    for (i, sum) in sums.iter_mut().enumerate().take(LANES) {
        *sum = [
            low_word(red_green[i]),
            low_word(red_green[i] >> 32),
            low_word(blue[i]),
            alphas[i],
        ];
    }
}
