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
//! The spectrum of single pixels does not tell how points of neighbours go together, which is what blue noise arranges where a pixel has
//! one sample; that of several pixels together does.
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
/// Columns, and rows, of pixels whose points are looked at together.
const BLOCK: u16 = 8;
/// Points of which the spectrum of such blocks is the mean, about: fewer frequencies are looked at.
const POINTS_OF_BLOCKS: u32 = 16 * POINTS;
/// The highest of these frequencies along each axis, in cycles per pixel.
const REACH_OF_BLOCKS: usize = 2;

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
    /// How strong each frequency is in the points of 8 x 8 pixels together.
    pub together: PowerSpectrum,
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
            together: pattern.spectrum_of_blocks(rate, seed),
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
        let mut spectrum = PowerSpectrum::of_pixels(rate);
        // A strip as wide as eight pixels: what neighbours have in common belongs to a pattern.
        for pixel in (0..).take(pixels.max(1) as usize) {
            spectrum.add(&self.points(rate, seed, [pixel % 8, pixel / 8]));
        }
        spectrum
    }

    /// The power spectrum of the points of 8 x 8 pixels together: the mean of many such blocks where each pixel has points of its own.
    fn spectrum_of_blocks(self, rate: SampleRate, seed: Seed) -> PowerSpectrum {
        let of_block = u32::from(BLOCK * BLOCK) * rate.samples();
        let blocks = if self.differs_by_pixel() {
            (POINTS_OF_BLOCKS / of_block).max(1)
        } else {
            1
        };
        let mut spectrum = PowerSpectrum::of_blocks();
        // Four blocks beside each other, and as many below as it takes.
        for block in (0..).take(blocks as usize) {
            let [left, top] = [block % 4, block / 4].map(|at: i32| at * i32::from(BLOCK));
            let mut points = Vec::with_capacity(of_block as usize);
            for [right, down] in (0..BLOCK).flat_map(|down| (0..BLOCK).map(move |right| [right, down])) {
                let of_pixel = self.points(rate, seed, [left + i32::from(right), top + i32::from(down)]);
                points.extend(
                    of_pixel
                        .into_iter()
                        .map(|[x, y]| [x + f64::from(right), y + f64::from(down)]),
                );
            }
            spectrum.add(&points);
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

/// How strong each frequency is in points: of single pixels whole numbers of cycles per pixel, between which a pixel's own square would
/// show; of 8 x 8 pixels eighths of these.
#[derive(Clone, Debug)]
pub struct PowerSpectrum {
    /// The highest frequency along each axis, in cycles per pixel.
    reach: usize,
    /// Frequencies in a cycle per pixel.
    parts: usize,
    /// Row by row, from the highest frequency up to zero; those further down are the same upside down and mirrored, because points
    /// are real.
    power: Vec<f64>,
    /// Pixels, or blocks of these, that were added.
    added: u32,
}

impl PowerSpectrum {
    /// Of no pixels: for as many points as `rate` says it reaches four times as far as their mean frequency.
    fn of_pixels(rate: SampleRate) -> Self {
        let mean = (1..rate.samples())
            .find(|side| side * side >= rate.samples())
            .unwrap_or(1);
        Self::empty(4 * mean as usize, 1)
    }

    /// Of no blocks.
    fn of_blocks() -> Self {
        Self::empty(REACH_OF_BLOCKS, BLOCK.into())
    }

    fn empty(reach: usize, parts: usize) -> Self {
        let steps = reach * parts;
        Self {
            reach,
            parts,
            power: vec![0.0; (2 * steps + 1) * (steps + 1)],
            added: 0,
        }
    }

    /// Frequencies from zero to the highest.
    fn steps(&self) -> usize {
        self.reach * self.parts
    }

    /// Adds the points of a pixel, or of a block, in pixels.
    fn add(&mut self, points: &[Point]) {
        let count = points.len() as f64;
        let side = self.side();
        // One wave's phases along an axis, for each point.
        let waves = |axis: usize| -> Vec<Vec<[f64; 2]>> {
            let of_frequency = |index: usize| {
                let frequency = (index as f64 - self.steps() as f64) / self.parts as f64;
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
        self.added += 1;
    }

    /// The highest frequency along each axis, in cycles per pixel.
    pub fn reach(&self) -> usize {
        self.reach
    }

    /// Columns, and rows: one for each frequency from the highest below zero to the highest above.
    pub fn side(&self) -> usize {
        2 * self.steps() + 1
    }

    /// The mean power of a column and row, counted from the upper left; frequency zero is that of the middle.
    pub fn at(&self, [column, row]: [usize; 2]) -> f64 {
        let last = self.side() - 1;
        let [column, row] = if row > self.steps() {
            [last - column, last - row]
        } else {
            [column, row]
        };
        self.power[row * self.side() + column] / f64::from(self.added.max(1))
    }

    /// The mean of [`Self::radial`] up to half of the mean frequency of a pixel's points, but for zero: the noise that eyes see. Of single
    /// pixels.
    pub fn low_power(&self) -> f64 {
        // The mean frequency is a quarter of the reach.
        let low = (self.reach / 8).max(1);
        self.radial()[1..=low].iter().sum::<f64>() / low as f64
    }

    /// The mean power around frequency zero by distance, from zero on in cycles per pixel, or in eighths of these.
    pub fn radial(&self) -> Vec<f64> {
        let steps = self.steps();
        let mut rings = vec![(0.0, 0_u32); steps + 1];
        for row in 0..self.side() {
            for column in 0..self.side() {
                let [right, down] = [column.abs_diff(steps), row.abs_diff(steps)];
                let distance = (right as f64).hypot(down as f64);
                // The ring that is nearest, in whole numbers.
                let ring = (0..=steps).find(|ring| distance < *ring as f64 + 0.5);
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
        let mut spectrum = PowerSpectrum::of_pixels(rate(3));
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

    #[test]
    fn spectrum_of_blocks_is_the_sum_of_all_waves_of_their_pixels() {
        let (pattern, rate, seed) = (SamplePattern::Jittered, rate(256), Seed::default());
        let spectrum = pattern.spectrum_of_blocks(rate, seed);
        // 16 * 1024 points are one block of 8 x 8 pixels.
        for place in [[0, 0], [16, 12], [20, 16], [31, 2], [3, 30]] {
            let [x, y] = place.map(|at: usize| (at as f64 - 16.0) / 8.0);
            let (mut real, mut imaginary) = (0.0, 0.0);
            for pixel in (0..8).flat_map(|down| (0..8).map(move |right| [right, down])) {
                for point in pattern.points(rate, seed, pixel) {
                    let [across, down] = [0, 1].map(|axis| f64::from(pixel[axis]) + point[axis]);
                    let (sin, cos) = (TAU * (x * across + y * down)).sin_cos();
                    real += cos;
                    imaginary += sin;
                }
            }
            let expected = (real * real + imaginary * imaginary) / 16384.0;
            let found = spectrum.at(place);
            assert!(
                (found - expected).abs() < 1e-6,
                "{place:?}: {found}, by the sum {expected}"
            );
        }
    }

    #[test]
    fn blue_noise_arranges_what_neighbours_have_at_one_sample() {
        // Up to a quarter of a cycle per pixel, and from there to half of one.
        let bands = |pattern: SamplePattern| {
            let radial = pattern.spectrum_of_blocks(rate(1), Seed::default()).radial();
            [radial[1] + radial[2], radial[3] + radial[4]]
        };
        let ([low, high], [random_low, random_high]) = (bands(SamplePattern::BlueNoise), bands(SamplePattern::Random));
        assert!(low < 0.5 * random_low, "{low}, random {random_low}");
        assert!(high > 1.2 * random_high, "{high}, random {random_high}");
        let [low, high] = bands(SamplePattern::Grid);
        assert!(low + high < 1e-6, "a grid repeats itself");
    }
}
