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

/// Points of which a spectrum is the mean, about: so many make it smooth, and more take longer than a hand waits.
const POINTS: u32 = 1024;

/// What there is to measure of the points of one pixel, and of a pattern as a whole.
#[derive(Clone, Debug)]
pub struct PatternStatistics {
    /// The points, right and down from the pixel's corner, `0.0..1.0`, in the order of samples.
    pub points: Vec<Point>,
    /// Where they lie, and how many in each place: more than one where a custom pattern weighs it so.
    pub places: Vec<(Point, usize)>,
    /// How much the part of them that lies in a box from the pixel's corner differs from its area at most.
    pub star_discrepancy: f64,
    /// The least distance between two of them in pixels, those of the pixels around included, as if these had the same.
    pub least_distance: f64,
    /// How many different columns and rows they lie in: how many places a vertical, or a level, edge tells apart.
    pub projections: [usize; 2],
    /// How strong each frequency is in them.
    pub spectrum: PowerSpectrum,
}

impl PatternStatistics {
    /// Of the pixel in this column and row; the spectrum is the mean of many.
    pub fn new(pattern: SamplePattern, rate: SampleRate, seed: Seed, pixel: [i32; 2]) -> Self {
        let points = pattern.points(rate, seed, pixel);
        let places = places(&points);
        let different = |axis: usize| {
            let mut places: Vec<f64> = points.iter().map(|point| point[axis]).collect();
            places.sort_by(f64::total_cmp);
            places.dedup();
            places.len()
        };
        Self {
            star_discrepancy: star_discrepancy(&points),
            least_distance: match pattern {
                // A sample of a weight above one is repeated, which is not near to another.
                SamplePattern::Custom(_) => {
                    let different: Vec<Point> = places.iter().map(|(at, _)| *at).collect();
                    least_distance(&different)
                }
                _ => least_distance(&points),
            },
            projections: [different(0), different(1)],
            spectrum: pattern.spectrum(rate, seed),
            places,
            points,
        }
    }
}

impl SamplePattern {
    /// Where the samples of the pixel in this column and row lie.
    fn points(self, rate: SampleRate, seed: Seed, pixel: [i32; 2]) -> Vec<Point> {
        let side = f64::from(lattice(self, rate).side());
        let positions = SamplePositions::new(self, rate, seed);
        let mut memory = Vec::new();
        let places = positions.of_pixel(pixel, &mut memory);
        places
            .iter()
            .map(|[x, y]| [(f64::from(*x) + 0.5) / side, (f64::from(*y) + 0.5) / side])
            .collect()
    }

    /// The power spectrum of its points: the mean of many pixels where each has points of its own.
    fn spectrum(self, rate: SampleRate, seed: Seed) -> PowerSpectrum {
        let pixels = if self.differs_by_pixel() {
            POINTS / rate.samples()
        } else {
            1
        };
        let mut spectrum = PowerSpectrum::empty(rate);
        // A strip as wide as eight pixels: what neighbours have in common belongs to a pattern.
        for pixel in (0..).take(pixels.max(1) as usize) {
            spectrum.add(&self.points(rate, seed, [pixel % 8, pixel / 8]));
        }
        spectrum
    }
}

/// The star discrepancy of points: how much the part of them that lies in a box from the corner `[0, 0]` differs from its area
/// at most. Exact, in time that grows with the square of their number: the worst box ends at points, or at the far sides.
fn star_discrepancy(points: &[Point]) -> f64 {
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

/// Where points lie, and how many of them in each place.
fn places(points: &[Point]) -> Vec<(Point, usize)> {
    let mut sorted = points.to_vec();
    sorted.sort_by(|a, b| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])));
    sorted
        .chunk_by(|a, b| a.map(f64::to_bits) == b.map(f64::to_bits))
        .filter_map(|same| Some((*same.first()?, same.len())))
        .collect()
}

/// The least distance between two points, in pixels, where the same points lie in each pixel around.
fn least_distance(points: &[Point]) -> f64 {
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
    distances.fold(1.0, f64::min)
}

/// How strong each frequency is in points: whole numbers of cycles per pixel, between which a pixel's own square would show.
#[derive(Clone, Debug)]
pub struct PowerSpectrum {
    /// The highest frequency along each axis, in cycles per pixel.
    reach: usize,
    /// Row by row, from the highest frequency up to zero; those further down are the same upside down and mirrored, because points
    /// are real.
    power: Vec<f64>,
    /// Pixels that were added.
    pixels: u32,
}

impl PowerSpectrum {
    /// Of no pixels: for as many points as `rate` says it reaches four times as far as their mean frequency.
    fn empty(rate: SampleRate) -> Self {
        let mean = (1..rate.samples())
            .find(|side| side * side >= rate.samples())
            .unwrap_or(1);
        let reach = 4 * mean as usize;
        Self {
            reach,
            power: vec![0.0; (2 * reach + 1) * (reach + 1)],
            pixels: 0,
        }
    }

    /// Adds the points of a pixel.
    fn add(&mut self, points: &[Point]) {
        let count = points.len() as f64;
        let side = self.side();
        // One wave's phases along an axis, for each point.
        let waves = |axis: usize| -> Vec<Vec<[f64; 2]>> {
            let of_frequency = |index: usize| {
                let frequency = index as f64 - self.reach as f64;
                let phase = |point: &Point| {
                    let (sin, cos) = (TAU * frequency * point[axis]).sin_cos();
                    [cos, sin]
                };
                points.iter().map(phase).collect()
            };
            (0..side).map(of_frequency).collect()
        };
        let (across, down) = (waves(0), waves(1));
        for (row, down) in self.power.chunks_mut(side).zip(&down) {
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

    /// The highest frequency along each axis, in cycles per pixel.
    pub fn reach(&self) -> usize {
        self.reach
    }

    /// Columns, and rows: one for each frequency from the highest below zero to the highest above.
    pub fn side(&self) -> usize {
        2 * self.reach + 1
    }

    /// The mean power of a column and row, counted from the upper left; frequency zero is that of the middle.
    pub fn at(&self, [column, row]: [usize; 2]) -> f64 {
        let last = self.side() - 1;
        let [column, row] = if row > self.reach {
            [last - column, last - row]
        } else {
            [column, row]
        };
        self.power[row * self.side() + column] / f64::from(self.pixels.max(1))
    }

    /// The mean of [`Self::radial`] up to half of the points' mean frequency, but for zero: the noise that eyes see.
    pub fn low_power(&self) -> f64 {
        // The mean frequency is a quarter of the reach.
        let low = (self.reach / 8).max(1);
        self.radial()[1..=low].iter().sum::<f64>() / low as f64
    }

    /// The mean power around frequency zero by distance, from zero on in cycles per pixel.
    pub fn radial(&self) -> Vec<f64> {
        let mut rings = vec![(0.0, 0_u32); self.reach + 1];
        for row in 0..self.side() {
            for column in 0..self.side() {
                let [right, down] = [column.abs_diff(self.reach), row.abs_diff(self.reach)];
                let distance = (right as f64).hypot(down as f64);
                // The ring that is nearest, in whole numbers.
                let ring = (0..=self.reach).find(|ring| distance < *ring as f64 + 0.5);
                if let Some((sum, count)) = ring.and_then(|ring| rings.get_mut(ring)) {
                    *sum += self.at([column, row]);
                    *count += 1;
                }
            }
        }
        rings
            .into_iter()
            .map(|(sum, count)| sum / f64::from(count.max(1)))
            .collect()
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
        // Halton and Zaremba, "The Extreme and L2 Discrepancies of Some Plane Sets" (1969), from four points on.
        for m in 2..=8 {
            let count = 1_u32 << m;
            let points: Vec<Point> = (0..count)
                .map(|i| [f64::from(i) / f64::from(count), mirrored(i)])
                .collect();
            let sign = if m % 2 == 0 { 1.0 } else { -1.0 };
            let expected = f64::from(m) / 3.0 + 13.0 / 9.0 - sign * 4.0 / (9.0 * f64::from(count));
            let found = star_discrepancy(&points) * f64::from(count);
            assert!(
                (found - expected).abs() < 1e-9,
                "2^{m} points: {found}, published {expected}"
            );
        }
    }

    #[test]
    fn discrepancy_is_that_of_the_worst_of_all_boxes() {
        assert!(
            (star_discrepancy(&[[0.5, 0.5]]) - 0.75).abs() < 1e-12,
            "one point in the middle"
        );
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
                    let inside = points
                        .iter()
                        .filter(|point| point[0] < *right && point[1] < *below)
                        .count();
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
        let near = least_distance(&[[0.02, 0.5], [0.99, 0.5], [0.5, 0.5]]);
        assert!((near - 0.03).abs() < 1e-12, "around the side: {near}");
        let grid = SamplePattern::Grid.points(rate(16), Seed::default(), [0, 0]);
        assert!((least_distance(&grid) - 0.25).abs() < 1e-12, "as far as a cell is wide");
    }

    #[test]
    fn spectrum_of_random_points_is_even_and_of_a_grid_sharp() {
        let random = SamplePattern::Random.spectrum(rate(16), Seed::default());
        let middle = [random.reach(); 2];
        assert!(
            (random.at(middle) - 16.0).abs() < 1e-6,
            "all points are in phase at frequency zero"
        );
        let rings = random.radial();
        let mean = rings[1..].iter().sum::<f64>() / random.reach() as f64;
        assert!((mean - 1.0).abs() < 0.1, "white noise: {mean}");
        let grid = SamplePattern::Grid.spectrum(rate(16), Seed::default());
        let of = |cycles: usize| grid.at([grid.reach() + cycles, grid.reach()]);
        assert!((of(4) - 16.0).abs() < 1e-6, "four columns of samples in a pixel");
        for between in [1, 2, 3, 5] {
            assert!(of(between) < 1e-6, "nothing at {between} cycles per pixel");
        }
    }

    #[test]
    fn projections_count_the_places_that_an_edge_tells_apart() {
        let of = |pattern| PatternStatistics::new(pattern, rate(16), Seed::default(), [0, 0]).projections;
        assert_eq!(
            of(SamplePattern::Grid),
            [4, 4],
            "a grid wastes most of its samples on level edges"
        );
        assert_eq!(of(SamplePattern::Rotated), [16, 16]);
    }

    #[test]
    fn spectrum_is_the_sum_of_all_waves() {
        let points = [[0.1, 0.7], [0.35, 0.2], [0.8, 0.4]];
        let mut spectrum = PowerSpectrum::empty(rate(3));
        spectrum.add(&points);
        for place in [[3, 1], [8, 8], [10, 8], [2, 15], [16, 9], [16, 0]] {
            let [x, y] = place.map(|at: usize| at as f64 - 8.0);
            let phases = points.map(|point| TAU * (x * point[0] + y * point[1]));
            let [real, imaginary] = [phases.map(f64::cos), phases.map(f64::sin)].map(|parts| parts.iter().sum::<f64>());
            let expected = real.mul_add(real, imaginary * imaginary) / 3.0;
            assert!(
                (spectrum.at(place) - expected).abs() < 1e-9,
                "{place:?}: {}",
                spectrum.at(place)
            );
        }
    }

    #[test]
    fn patterns_that_keep_their_distance_have_few_low_frequencies() {
        let low = |pattern: SamplePattern| pattern.spectrum(rate(16), Seed::default()).low_power();
        let random = low(SamplePattern::Random);
        for even in [
            SamplePattern::Jittered,
            SamplePattern::MultiJittered,
            SamplePattern::Sobol,
        ] {
            assert!(low(even) < 0.6 * random, "{even:?}: {}, random {random}", low(even));
        }
    }
}
