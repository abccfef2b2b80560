//! The discrete Fourier transform of rows and columns of numbers, and the window that fades them out at their borders.

use rayon::prelude::*;
use rustfft::FftPlanner;
use rustfft::num_complex::Complex;

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
