//! The discrete Fourier transform of rows and columns of numbers, and the window that fades them out at their borders.

use rayon::prelude::*;
use rustfft::FftPlanner;
use rustfft::num_complex::Complex;

use super::luma::luma;
use crate::raster::Framebuffer;

/// Hann's window of `count` numbers, `sin^2(pi (n + 1/2) / count)`: it falls to nothing at both ends, so that a picture's left
/// border does not meet its right one as an edge (F. J. Harris, "On the use of windows for harmonic analysis with the discrete
/// Fourier transform", 1978). Its mean is a half, but for a single number.
#[expect(clippy::cast_possible_truncation, reason = "from 0 to 1")]
pub(super) fn hann(count: usize) -> Vec<f32> {
    let value = |n: usize| (std::f64::consts::PI * (n as f64 + 0.5) / count as f64).sin().powi(2);
    (0..count).map(|n| value(n) as f32).collect()
}

/// The transform of rows of `width` numbers, `sum of x[r][c] exp(-2 pi i (u c / width + v r / height))`, column by column: all
/// v of the first u, then of the next. On the current rayon pool; any size is fast (J. W. Cooley and J. W. Tukey, 1965;
/// L. I. Bluestein, 1970, for prime ones).
pub(super) fn transform(values: &[f32], width: usize) -> Vec<Complex<f32>> {
    if width == 0 || values.is_empty() {
        return Vec::new();
    }
    let height = values.len() / width;
    let mut planner = FftPlanner::new();
    let (along, down) = (planner.plan_fft_forward(width), planner.plan_fft_forward(height));
    let mut rows: Vec<Complex<f32>> = values.iter().map(|value| Complex::new(*value, 0.0)).collect();
    rows.par_chunks_exact_mut(width).for_each(|row| along.process(row));
    let mut columns = vec![Complex::default(); rows.len()];
    columns
        .par_chunks_exact_mut(height)
        .enumerate()
        .for_each(|(x, column)| {
            for (out, row) in column.iter_mut().zip(rows.chunks_exact(width)) {
                *out = row[x];
            }
            down.process(column);
        });
    columns
}

/// The waves of the lumas of a frame under Hann's window, without their mean, of the lowest `kept` frequencies along each axis:
/// as [`transform`] would have them of a frame of `kept` pixels, but with phases that count from the frame's corner, and as
/// amplitudes.
pub(super) fn transform_low(frame: &Framebuffer, kept: [usize; 2]) -> Vec<Complex<f32>> {
    /// Columns whose numbers lie in one line of a cache.
    const TOGETHER: usize = 8;
    let [width, height] = [frame.width() as usize, frame.height() as usize];
    let mut planner = FftPlanner::new();
    let (along, down) = (planner.plan_fft_forward(width), planner.plan_fft_forward(height));
    // The other half is their mirror image.
    let half = kept[0] / 2 + 1;
    let windows = [weights(width), weights(height)];
    let turns = [turns(half, kept[0], width), turns(kept[1], kept[1], height)];
    let mut rows = vec![Complex::default(); half * height];
    let pairs = rows.par_chunks_mut(2 * half).zip(frame.pixels().par_chunks(2 * width));
    pairs.zip(windows[1].par_chunks(2)).for_each_init(
        || vec![Complex::default(); width],
        |both, ((out, pixels), weights)| {
            // Of two rows of real numbers one transform makes both spectra.
            let (first, second) = pixels.split_at(width);
            fill(both, [first, second], &windows[0], weights);
            along.process(both);
            let (first, second) = out.split_at_mut(half);
            for (u, wave) in first.iter_mut().enumerate() {
                *wave = (both[u] + both[(width - u) % width].conj()) * 0.5;
            }
            for (u, wave) in second.iter_mut().enumerate() {
                *wave = (both[u] - both[(width - u) % width].conj()) * Complex::new(0.0, -0.5);
            }
        },
    );
    let mut columns = vec![Complex::default(); half * kept[1]];
    let outs = columns
        .par_chunks_mut(TOGETHER * kept[1])
        .zip(turns[0].par_chunks(TOGETHER));
    outs.enumerate().for_each_init(
        || vec![Complex::default(); TOGETHER * height],
        |memory, (group, (outs, turns_across))| {
            let first = group * TOGETHER;
            for (y, row) in rows.chunks_exact(half).enumerate() {
                for (column, value) in memory.chunks_exact_mut(height).zip(&row[first..]) {
                    column[y] = *value;
                }
            }
            let outs = outs.chunks_exact_mut(kept[1]).zip(turns_across);
            for (column, (out, turn)) in memory.chunks_exact_mut(height).zip(outs) {
                down.process(column);
                let (lower, higher) = out.split_at_mut(kept[1].div_ceil(2));
                let below_zero = column.len() - higher.len();
                let (lower, higher) = (
                    lower.iter_mut().zip(&*column),
                    higher.iter_mut().zip(&column[below_zero..]),
                );
                for ((wave, value), own) in lower.chain(higher).zip(&turns[1]) {
                    *wave = value * turn * own;
                }
            }
        },
    );
    without_mean(&mut columns, kept[1]);
    mirrored(&columns, kept)
}

/// The lumas of two rows of pixels, or of one, as real and imaginary numbers under a window.
fn fill(both: &mut [Complex<f32>], [first, second]: [&[u32]; 2], across: &[f32], down: &[f32]) {
    for ((value, pixel), weight) in both.iter_mut().zip(first).zip(across) {
        *value = Complex::new(luma(*pixel) * (down[0] * weight), 0.0);
    }
    if let Some(down) = down.get(1) {
        for ((value, pixel), weight) in both.iter_mut().zip(second).zip(across) {
            value.im = luma(*pixel) * (down * weight);
        }
    }
}

/// Hann's window, of which all numbers together are the root of two: what makes amplitudes of sums in both directions.
fn weights(count: usize) -> Vec<f32> {
    let window = hann(count);
    let scale = std::f32::consts::SQRT_2 / window.iter().sum::<f32>();
    window.iter().map(|weight| weight * scale).collect()
}

/// By what the first `count` of `kept` frequencies are turned, so that phases count from the border of the first of `all`
/// numbers, not from its middle.
fn turns(count: usize, kept: usize, all: usize) -> Vec<Complex<f32>> {
    let frequency = |index: usize| {
        if index < kept.div_ceil(2) {
            index as f64
        } else {
            index as f64 - kept as f64
        }
    };
    let turn = |index: usize| Complex::from_polar(1.0, -std::f64::consts::PI * frequency(index) / all as f64);
    #[expect(clippy::cast_possible_truncation, reason = "from -1 to 1")]
    let turns = (0..count)
        .map(turn)
        .map(|turn| Complex::new(turn.re as f32, turn.im as f32));
    turns.collect()
}

/// Takes the mean out of the columns of waves: of Hann's window it has the lowest frequency and half as much of its neighbours.
fn without_mean(columns: &mut [Complex<f32>], height: usize) {
    let mean = columns.first().copied().unwrap_or_default();
    for (u, across) in [(0, 1.0), (1, -0.5)] {
        for (v, down) in [(0, 1.0), (1, -0.5), (height - 1, -0.5)] {
            if let Some(wave) = columns.get_mut(u * height + v) {
                *wave -= mean * across * down;
            }
        }
    }
}

/// All columns of waves, of those that run to the right.
fn mirrored(right: &[Complex<f32>], [width, height]: [usize; 2]) -> Vec<Complex<f32>> {
    let mut all = vec![Complex::default(); width * height];
    all.par_chunks_exact_mut(height).enumerate().for_each(|(u, column)| {
        let own = &right[u.min(width - u) * height..][..height];
        if u <= width / 2 {
            column.copy_from_slice(own);
        } else {
            for (v, wave) in column.iter_mut().enumerate() {
                *wave = own[(height - v) % height].conj();
            }
        }
    });
    all
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Its definition.
    fn by_sums(values: &[f32], width: usize) -> Vec<Complex<f64>> {
        let height = values.len() / width;
        let frequency = |u: usize, v: usize| {
            let term = |i: usize| {
                let turns = (u * (i % width)) as f64 / width as f64 + (v * (i / width)) as f64 / height as f64;
                Complex::from_polar(f64::from(values[i]), -std::f64::consts::TAU * turns)
            };
            (0..values.len()).map(term).sum()
        };
        let all = (0..width).flat_map(|u| (0..height).map(move |v| (u, v)));
        all.map(|(u, v)| frequency(u, v)).collect()
    }

    #[test]
    fn transform_is_its_definition_in_any_size() {
        for (width, height) in [(1, 1), (4, 2), (5, 3), (12, 7), (13, 16)] {
            let numbers = (0..width * height).map(|i| f32::from(u8::try_from(i * i % 251).unwrap_or(0)));
            let values: Vec<f32> = numbers.collect();
            let found = transform(&values, width);
            for (found, expected) in found.iter().zip(by_sums(&values, width)) {
                let found = Complex::new(f64::from(found.re), f64::from(found.im));
                let off = (found - expected).norm();
                assert!(off < 1e-2, "{width} x {height}: {found} for {expected}");
            }
            let energy: f64 = values.iter().map(|value| f64::from(*value).powi(2)).sum();
            let power: f64 = found.iter().map(|wave| f64::from(wave.norm_sqr())).sum();
            let power = power / values.len() as f64;
            assert!(
                (power - energy).abs() <= energy * 1e-5,
                "Parseval: {power} for {energy}"
            );
        }
        assert!(transform(&[], 0).is_empty(), "nothing of nothing");
    }

    /// Waves of a few frequencies on a mean.
    fn waves(size: [u32; 2]) -> Framebuffer {
        let mut frame = Framebuffer::new(size[0], size[1]);
        for (place, pixel) in (0_u32..).zip(frame.pixels_mut()) {
            let byte = (place * place / 7 + place) % 199 + 40;
            *pixel = 0xff00_0000 | (byte * 0x0001_0101);
        }
        frame
    }

    #[test]
    fn low_frequencies_are_those_of_all() {
        for (size, kept) in [([27, 20], [12, 6]), ([40, 25], [18, 12]), ([12, 8], [6, 6])] {
            let frame = waves(size);
            let [width, height] = size.map(|side| side as usize);
            let [across, down] = [hann(width), hann(height)];
            let gain: f32 = across.iter().sum::<f32>() * down.iter().sum::<f32>();
            let weight = |i: usize| across[i % width] * down[i / width];
            let lumas = || frame.pixels().iter().map(|pixel| luma(*pixel)).enumerate();
            let mean = lumas().map(|(i, luma)| luma * weight(i)).sum::<f32>() / gain;
            let values: Vec<f32> = lumas().map(|(i, luma)| (luma - mean) * weight(i)).collect();
            let all = by_sums(&values, width);
            let found = transform_low(&frame, kept);
            let orders = |axis: usize| {
                1 - i64::try_from(kept[axis]).unwrap_or(0) / 2..i64::try_from(kept[axis]).unwrap_or(0) / 2
            };
            for [u, v] in orders(0).flat_map(|u| orders(1).map(move |v| [u, v])) {
                let at = |counts: [usize; 2]| {
                    let place = |order: i64, count: usize| order.rem_euclid(i64::try_from(count).unwrap_or(1));
                    usize::try_from(place(u, counts[0])).unwrap_or(0) * counts[1]
                        + usize::try_from(place(v, counts[1])).unwrap_or(0)
                };
                let half = (u as f64 / width as f64).midpoint(v as f64 / height as f64);
                let turn = Complex::from_polar(2.0 / f64::from(gain), -std::f64::consts::TAU * half);
                let (expected, found) = (all[at([width, height])] * turn, found[at(kept)]);
                let off = (Complex::new(f64::from(found.re), f64::from(found.im)) - expected).norm();
                assert!(off < 1e-3, "{size:?} at {u}, {v}: {found} for {expected}");
            }
        }
    }

    #[test]
    fn hann_is_half_of_one_on_average_and_symmetrical() {
        for count in [2, 3, 8, 101] {
            let window = hann(count);
            let mean = window.iter().sum::<f32>() / count as f32;
            assert!((mean - 0.5).abs() < 1e-6, "{count}: {mean}");
            assert!((window[0] - window[count - 1]).abs() < 1e-6, "{count}: {window:?}");
        }
        assert!(hann(64)[0] < 0.001 && hann(65)[32] > 0.999, "from nothing to all");
        assert_eq!(hann(1), [1.0], "a single number stays");
    }
}
