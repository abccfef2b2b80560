//! What a pattern's points are like, as the sampling literature measures them.
//!
//! ```text
//!    star discrepancy          least distance          power spectrum
//!   .-----------.             .-----------.
//!   |     o     |             |     o     |            P(f) = |sum of e^(-2 pi i f x)|^2 / N
//!   |-----.  o  |             |   /    o  |
//!   | o   |     |             | o         |            1 for random points, at all frequencies;
//!   |   o |  o  |             |   o    o  |            0 where they lie evenly
//!   '-----'-----'             '-----------'
//!    |points in the box / N    to the nearest point,
//!     - its area|, the most    also of the pixels around
//! ```
//!
//! Niederreiter, "Random Number Generation and Quasi-Monte Carlo Methods" (1992), chapter 2; Lagae and Dutré, "A Comparison of
//! Methods for Generating Poisson Disk Distributions" (2008).

use std::f64::consts::TAU;

use crate::raster::sampling::pattern::{SamplePattern, Seed};
use crate::raster::sampling::positions::{SamplePositions, lattice};
use crate::raster::sampling::rate::SampleRate;

/// A point of a pixel, right and down from its corner, `0.0..1.0`.
type Point = [f64; 2];

/// Pixels along each side of the block of which spectra are means.
const BLOCK: i32 = 6;

impl SamplePattern {
    /// Where the samples of the pixel in this column and row lie.
    pub fn points(self, rate: SampleRate, seed: Seed, pixel: [i32; 2]) -> Vec<Point> {
        let side = f64::from(lattice(self, rate).side());
        let positions = SamplePositions::new(self, rate, seed);
        let mut memory = Vec::new();
        let places = positions.of_pixel(pixel, &mut memory);
        places
            .iter()
            .map(|place| place.map(|at| (f64::from(at) + 0.5) / side))
            .collect()
    }

    /// The power spectrum of its points: the mean of many pixels where each has points of its own.
    pub fn spectrum(self, rate: SampleRate, seed: Seed) -> PowerSpectrum {
        let pixels = if self.differs_by_pixel() { BLOCK } else { 1 };
        let mut spectrum = PowerSpectrum::empty(rate);
        for y in 0..pixels {
            for x in 0..pixels {
                spectrum.add(&self.points(rate, seed, [x, y]));
            }
        }
        spectrum
    }
}

/// The star discrepancy of points: how much the part of them that lies in a box from the corner `[0, 0]` differs from its area
/// at most. Exact, in time that grows with the square of their number: the worst box ends at points, or at the far sides.
pub fn star_discrepancy(points: &[Point]) -> f64 {
    let count = points.len() as f64;
    let mut columns: Vec<f64> = points.iter().map(|point| point[0]).chain([1.0]).collect();
    columns.sort_by(f64::total_cmp);
    columns.dedup();
    let mut by_row: Vec<Point> = points.to_vec();
    by_row.sort_by(|a, b| a[1].total_cmp(&b[1]));
    let mut worst = 0.0_f64;
    for right in columns {
        // Points of the rows so far: left of the box's right side, and on it as well.
        let (mut inside, mut with_edge) = (0.0, 0.0);
        let mut rows = by_row.iter().peekable();
        while let Some(first) = rows.peek() {
            let below = first[1];
            let area = right * below;
            // The box without its edges holds as few points as it can.
            worst = worst.max(area - inside / count);
            while let Some(point) = rows.next_if(|point| point[1] <= below) {
                inside += f64::from(u8::from(point[0] < right));
                with_edge += f64::from(u8::from(point[0] <= right));
            }
            // And with them as many.
            worst = worst.max(with_edge / count - area);
        }
        worst = worst.max(right - inside / count).max(with_edge / count - right);
    }
    worst
}

/// The least distance between two points, in pixels, where the same points lie in each pixel around; `None` of no points.
pub fn least_distance(points: &[Point]) -> Option<f64> {
    let around = |distance: f64| {
        let distance = distance.abs();
        distance.min(1.0 - distance)
    };
    let pairs = points
        .iter()
        .enumerate()
        .flat_map(|(i, a)| points[i + 1..].iter().map(move |b| (a, b)));
    let distances = pairs.map(|(a, b)| around(a[0] - b[0]).hypot(around(a[1] - b[1])));
    // A single point is one pixel away from itself.
    (!points.is_empty()).then(|| distances.fold(1.0, f64::min))
}

/// How strong each frequency is in points.
#[derive(Clone, Debug)]
pub struct PowerSpectrum {
    /// Cycles per pixel from one column, or row, to the next.
    step: f64,
    /// Row by row; the middle is frequency zero.
    power: Vec<f64>,
    /// Pixels that were added.
    pixels: u32,
}

impl PowerSpectrum {
    /// Frequencies on each side of zero.
    const REACH: usize = 64;
    /// Columns, and rows.
    pub const SIDE: usize = 2 * Self::REACH + 1;

    /// Of no pixels: for as many points as `rate` says it reaches four times as far as their mean frequency.
    fn empty(rate: SampleRate) -> Self {
        let mean = f64::from(rate.samples()).sqrt();
        Self {
            step: 4.0 * mean / Self::REACH as f64,
            power: vec![0.0; Self::SIDE * Self::SIDE],
            pixels: 0,
        }
    }

    /// Adds the points of a pixel.
    fn add(&mut self, points: &[Point]) {
        let count = points.len() as f64;
        // One wave's phases along an axis, for each point.
        let waves = |axis: usize| -> Vec<Vec<[f64; 2]>> {
            let of_frequency = |index: usize| {
                let frequency = (index as f64 - Self::REACH as f64) * self.step;
                let phase = |point: &Point| {
                    let (sin, cos) = (TAU * frequency * point[axis]).sin_cos();
                    [cos, sin]
                };
                points.iter().map(phase).collect()
            };
            (0..Self::SIDE).map(of_frequency).collect()
        };
        let (across, down) = (waves(0), waves(1));
        for (row, down) in self.power.chunks_mut(Self::SIDE).zip(&down) {
            for (power, across) in row.iter_mut().zip(&across) {
                let (mut real, mut imaginary) = (0.0, 0.0);
                for ([a, b], [c, d]) in across.iter().zip(down) {
                    real += a * c - b * d;
                    imaginary += a * d + b * c;
                }
                *power += (real * real + imaginary * imaginary) / count;
            }
        }
        self.pixels += 1;
    }

    /// The highest frequency that it shows, in cycles per pixel.
    pub fn reach(&self) -> f64 {
        self.step * Self::REACH as f64
    }

    /// The mean power of a column and row, counted from the upper left; frequency zero is that of the middle.
    pub fn at(&self, [column, row]: [usize; 2]) -> f64 {
        self.power[row * Self::SIDE + column] / f64::from(self.pixels.max(1))
    }

    /// The mean power around frequency zero by distance, from zero on in steps of a column.
    pub fn radial(&self) -> Vec<f64> {
        let mut rings = vec![(0.0, 0_u32); Self::REACH + 1];
        for row in 0..Self::SIDE {
            for column in 0..Self::SIDE {
                let from_middle = [column, row].map(|at| at.abs_diff(Self::REACH) as f64);
                let distance = from_middle[0].hypot(from_middle[1]).round();
                let ring = rings.iter_mut().zip(0..).find(|(_, at)| f64::from(*at) >= distance);
                if let Some((ring, _)) = ring.filter(|(_, at)| f64::from(*at) <= distance) {
                    *ring = (ring.0 + self.at([column, row]), ring.1 + 1);
                }
            }
        }
        rings.into_iter().map(|(sum, count)| sum / f64::from(count.max(1))).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rate(samples: u32) -> SampleRate {
        SampleRate::new(samples).expect("a rate")
    }

    /// The radical inverse in base 2.
    fn mirrored(number: u32) -> f64 {
        f64::from(number.reverse_bits()) / 4_294_967_296.0
    }

    #[test]
    fn discrepancy_of_hammersleys_points_is_as_published() {
        // Halton and Zaremba, "The Extreme and L2 Discrepancies of Some Plane Sets" (1969).
        for m in 1..=8 {
            let count = 1_u32 << m;
            let points: Vec<Point> = (0..count)
                .map(|i| [f64::from(i) / f64::from(count), mirrored(i)])
                .collect();
            let sign = if m % 2 == 0 { 1.0 } else { -1.0 };
            let expected = f64::from(m) / 3.0 + 13.0 / 9.0 - sign * 4.0 / (9.0 * f64::from(count));
            let found = star_discrepancy(&points) * f64::from(count);
            assert!((found - expected).abs() < 1e-9, "2^{m} points: {found}, published {expected}");
        }
    }

    #[test]
    fn discrepancy_is_that_of_the_worst_of_all_boxes() {
        assert!((star_discrepancy(&[[0.5, 0.5]]) - 0.75).abs() < 1e-12, "one point in the middle");
        arbtest::arbtest(|u| {
            let mut at = || Ok::<_, arbtest::arbitrary::Error>(f64::from(u.int_in_range(0..=15_u8)?) / 16.0);
            let points = (0..6).map(|_| Ok([at()?, at()?])).collect::<Result<Vec<Point>, _>>()?;
            let found = star_discrepancy(&points);
            // Boxes that end just before and just behind each line of the lattice.
            let ends: Vec<f64> = (0..=16)
                .flat_map(|line| [-1e-9, 1e-9].map(|beside| (f64::from(line) / 16.0 + beside).clamp(0.0, 1.0)))
                .collect();
            let mut worst = 0.0_f64;
            for right in &ends {
                for below in &ends {
                    let inside = points.iter().filter(|point| point[0] < *right && point[1] < *below).count();
                    worst = worst.max((inside as f64 / 6.0 - right * below).abs());
                }
            }
            assert!((found - worst).abs() < 1e-6, "{points:?}: {found}, by trying {worst}");
            Ok(())
        })
        .budget_ms(300);
    }

    #[test]
    fn the_nearest_point_may_lie_in_the_next_pixel() {
        let near = least_distance(&[[0.02, 0.5], [0.99, 0.5], [0.5, 0.5]]).expect("points");
        assert!((near - 0.03).abs() < 1e-12, "around the side: {near}");
        let grid = SamplePattern::Grid.points(rate(16), Seed::default(), [0, 0]);
        assert_eq!(least_distance(&grid), Some(0.25), "as far as a cell is wide");
        assert_eq!(least_distance(&[]), None, "there is none");
    }

    #[test]
    fn spectrum_of_random_points_is_even_and_of_a_grid_sharp() {
        let middle = [PowerSpectrum::REACH; 2];
        let random = SamplePattern::Random.spectrum(rate(16), Seed::default());
        assert!((random.at(middle) - 16.0).abs() < 1e-6, "all points are in phase at frequency zero");
        let rings = random.radial();
        let beyond = &rings[16..];
        let mean = beyond.iter().sum::<f64>() / beyond.len() as f64;
        assert!((mean - 1.0).abs() < 0.1, "white noise: {mean}");
        let grid = SamplePattern::Grid.spectrum(rate(16), Seed::default());
        let of = |cycles: f64| {
            let column = (cycles / grid.step).round() + PowerSpectrum::REACH as f64;
            let columns = (0..PowerSpectrum::SIDE).find(|at| *at as f64 >= column).expect("inside");
            grid.at([columns, PowerSpectrum::REACH])
        };
        assert!((of(4.0) - 16.0).abs() < 1e-6, "four columns of samples in a pixel");
        for between in [1.0, 2.0, 3.0] {
            assert!(of(between) < 1e-6, "nothing at {between} cycles per pixel");
        }
    }

    #[test]
    fn patterns_that_keep_their_distance_have_few_low_frequencies() {
        let low = |pattern: SamplePattern| {
            let spectrum = pattern.spectrum(rate(16), Seed::default());
            // Below half of the mean frequency.
            spectrum.radial()[2..8].iter().sum::<f64>()
        };
        let random = low(SamplePattern::Random);
        for even in [SamplePattern::Jittered, SamplePattern::MultiJittered, SamplePattern::Sobol] {
            assert!(low(even) < 0.6 * random, "{even:?}: {}, random {random}", low(even));
        }
    }
}
