//! A picture as a sum of waves: how strong each frequency is, and where its crests lie.
//!
//! A wave of a whole number of periods across the picture reads its own amplitude (and its neighbours a half of it, which is
//! Hann's window); one between two such frequencies reads up to 1.4 dB less along each axis. So does half a cycle per pixel where
//! the number of pixels is odd; its mirror image then lies in the frequency beside it, and adds up to as much again.

use std::f64::consts::TAU;

use rustfft::num_complex::Complex;

use super::fourier::{hann, transform};
use super::luma::LumaPlane;

/// The amplitude that counts as 0 dB: a wave from black to white.
const FULL: f64 = 127.5;
/// Less is nothing, in dB.
const NOTHING: f64 = -160.0;
/// Periods across the picture up to which it is shading rather than a wave.
const SLOW: i64 = 2;
/// How much weaker than the strongest a peak may be, in dB.
const WEAKER: f64 = 50.0;
/// The weakest peak, in dB: what rounding to 256 levels makes of nothing is weaker.
const WEAKEST: f64 = -80.0;
/// How far apart two peaks are at least, in steps of frequency: half the width of a peak by Hann's window, and one more.
const APART: i64 = 3;

/// One wave: stripes of lighter and darker.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wave {
    /// How many of its periods fit into a pixel to the right and down; of a texture into a texel.
    pub frequency: [f64; 2],
    /// Half of what lies between its darkest and its lightest value, in levels of 255.
    pub amplitude: f64,
    /// Where in its period it is at the corner of what was transformed, in radians; it is lightest at 0.
    pub(super) phase: f64,
}

impl Wave {
    /// From crest to crest, in pixels; infinite for frequency zero.
    pub fn wavelength(&self) -> f64 {
        1.0 / self.frequency[0].hypot(self.frequency[1])
    }

    /// The direction from stripe to stripe, in degrees clockwise from right, above -90 up to 90.
    pub fn angle(&self) -> f64 {
        let [x, y] = self.frequency;
        let angle = y.atan2(x).to_degrees();
        // A wave is the same backwards.
        if angle > 90.0 {
            angle - 180.0
        } else if angle <= -90.0 {
            angle + 180.0
        } else {
            angle
        }
    }

    /// `20 log10` of its amplitude, 0 for a wave from black to white.
    pub fn decibels(&self) -> f64 {
        decibels(self.amplitude)
    }

    /// Whether it is so weak that there is none.
    pub fn is_nothing(&self) -> bool {
        self.decibels() <= NOTHING
    }

    /// Its value at a place in pixels from the corner of what was transformed, in levels of 255.
    pub fn value_at(&self, [x, y]: [f64; 2]) -> f64 {
        self.amplitude * (TAU * (self.frequency[0] * x + self.frequency[1] * y) + self.phase).cos()
    }
}

/// An amplitude in levels of 255 as `20 log10`, 0 for a wave from black to white.
pub(super) fn decibels(amplitude: f64) -> f64 {
    (20.0 * (amplitude / FULL).log10()).max(NOTHING)
}

/// The waves that a plane of numbers is the sum of.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Spectrum {
    /// Columns and rows in pixels.
    size: [u32; 2],
    /// How many times as many frequencies it has along each axis as pixels can show.
    fineness: u32,
    /// The same of those that are shown.
    shown: u32,
    /// As strong a wave may be a ghost: its amplitude.
    ghosts: f64,
    /// The number that all pixels have, in levels of 255: then there are no waves.
    constant: Option<f64>,
    /// Where the place lies from which phases count, in pixels from the corner along each axis.
    origin: f64,
    /// Amplitude and phase of each frequency, in the order of [`transform`].
    waves: Vec<Complex<f32>>,
}

impl Spectrum {
    /// That of a plane with one number in a pixel, without its mean.
    pub(super) fn of(mut plane: LumaPlane) -> Self {
        let counts = plane.size.map(|side| side as usize);
        let [across, down] = counts.map(hann);
        let weights = || {
            down.iter()
                .flat_map(|down| across.iter().map(move |across| down * across))
        };
        let gain: f64 = weights().map(f64::from).sum();
        let weighed = plane.values.iter().zip(weights());
        let sum: f64 = weighed
            .map(|(value, weight)| f64::from(*value) * f64::from(weight))
            .sum();
        let constant = plane.constant();
        #[expect(clippy::cast_possible_truncation, reason = "levels of 255")]
        // A rounded mean would leave waves of its own.
        let mean = constant.unwrap_or((sum / gain.max(f64::MIN_POSITIVE)) as f32);
        for (value, weight) in plane.values.iter_mut().zip(weights()) {
            *value = (*value - mean) * weight;
        }
        let waves = transform(&plane.values, counts[0]);
        #[expect(clippy::cast_possible_truncation, reason = "of sums")]
        let scale = (2.0 / gain.max(f64::MIN_POSITIVE)) as f32;
        Self {
            size: plane.size,
            fineness: 1,
            shown: 1,
            ghosts: 0.0,
            constant: constant.map(f64::from),
            origin: 0.5,
            waves: waves.into_iter().map(|wave| wave * scale).collect(),
        }
    }

    /// That of so many pixels, of amplitudes and phases of `fineness` times as many frequencies along each axis.
    pub(super) fn of_finer(waves: Vec<Complex<f32>>, size: [u32; 2], fineness: u32) -> Self {
        Self {
            size,
            fineness,
            shown: 3,
            ghosts: 0.0,
            constant: None,
            origin: 0.0,
            waves,
        }
    }

    /// The same where waves of so small an amplitude may be ghosts.
    pub(super) fn with_ghosts(self, amplitude: f32) -> Self {
        Self {
            ghosts: f64::from(amplitude),
            ..self
        }
    }

    /// The same of a plane whose numbers all are `constant`, if they are.
    pub(super) fn with_constant(self, constant: Option<f32>) -> Self {
        Self {
            constant: constant.map(f64::from),
            ..self
        }
    }

    /// The number that all pixels have, in levels of 255; `None` where they differ.
    pub(super) fn constant(&self) -> Option<f64> {
        self.constant
    }

    /// Whether the wave with so many periods across the picture may be a ghost of one that is finer than all of these.
    pub(super) fn may_be_ghost(&self, order: [i64; 2]) -> bool {
        self.ghosts > 0.0 && self.power(order) <= self.ghosts * self.ghosts
    }

    /// Columns and rows that were transformed, in pixels.
    pub(super) fn size(&self) -> [u32; 2] {
        self.size
    }

    /// The highest frequency that is shown along an axis, in cycles per pixel.
    pub(super) fn reach(&self) -> f64 {
        f64::from(self.shown) / 2.0
    }

    /// How many frequencies it has along an axis, shown or not.
    fn count(&self, axis: usize) -> i64 {
        i64::from(self.size[axis] * self.fineness)
    }

    /// Numbers of periods across the picture along an axis, from the lowest that is shown.
    pub(super) fn orders(&self, axis: usize) -> std::ops::Range<i64> {
        let count = i64::from(self.size[axis] * self.shown);
        -(count / 2)..count - count / 2
    }

    /// So many periods across the picture in cycles per pixel.
    pub(super) fn frequency(&self, order: [i64; 2]) -> [f64; 2] {
        [0, 1].map(|axis| order[axis] as f64 / f64::from(self.size[axis].max(1)))
    }

    /// The nearest number of periods, as long as it is shown.
    #[expect(
        clippy::cast_possible_truncation,
        reason = "`as` saturates, and the range is checked"
    )]
    pub(super) fn order(&self, frequency: [f64; 2]) -> Option<[i64; 2]> {
        let order = [0, 1].map(|axis| (frequency[axis] * f64::from(self.size[axis])).round() as i64);
        (self.is_shown(order) && !self.waves.is_empty()).then_some(order)
    }

    /// Whether a number of periods is shown, by itself or, at the limit, by that which is the same wave.
    pub(super) fn is_shown(&self, order: [i64; 2]) -> bool {
        let known = |axis: usize| order[axis].abs() <= i64::from(self.size[axis] * self.shown) / 2;
        known(0) && known(1)
    }

    /// The place of a number of periods in `waves`, and of its mirror image; frequencies repeat beyond the highest.
    fn indices(&self, order: [i64; 2]) -> [usize; 2] {
        let index = |sign: i64| {
            let at = |axis: usize| (sign * order[axis]).rem_euclid(self.count(axis).max(1));
            usize::try_from(at(0) * self.count(1) + at(1)).unwrap_or_default()
        };
        [1, -1].map(index)
    }

    /// The square of the amplitude of the wave with so many periods across the picture. One that is its own mirror image, such as
    /// every other column, is there once, and not as two halves.
    pub(super) fn power(&self, order: [i64; 2]) -> f64 {
        let [index, mirror] = self.indices(order);
        let halves = if index == mirror { 2.0 } else { 1.0 };
        self.height(order) / (halves * halves)
    }

    /// The same by which it stands out from the frequencies beside it, in which Hann's window leaves half of both halves.
    pub(super) fn height(&self, order: [i64; 2]) -> f64 {
        let [index, _] = self.indices(order);
        self.waves.get(index).map_or(0.0, |wave| f64::from(wave.norm_sqr()))
    }

    /// The wave with so many periods across the picture.
    pub(super) fn wave(&self, order: [i64; 2]) -> Wave {
        let frequency = self.frequency(order);
        let [index, _] = self.indices(order);
        let phase = self.waves.get(index).map_or(0.0, |wave| f64::from(wave.arg()));
        let turns = (frequency[0] + frequency[1]) * self.origin;
        Wave {
            frequency,
            amplitude: self.power(order).sqrt(),
            phase: phase - TAU * turns,
        }
    }

    /// The strongest waves, at most `count`, the strongest first, of each and its mirror image one; slow shading is none, nor
    /// is what may be a ghost.
    pub(super) fn peaks(&self, count: usize) -> Vec<[i64; 2]> {
        let places = || {
            let rows = self.orders(1);
            rows.flat_map(|y| self.orders(0).map(move |x| [x, y]))
        };
        let is_wave = |order: &[i64; 2]| {
            let [index, mirror] = self.indices(*order);
            index <= mirror && order.iter().any(|order| order.abs() > SLOW)
        };
        let powers = places().filter(is_wave).map(|order| (self.power(order), order));
        let most = powers.clone().fold(0.0, |most: f64, (power, _)| most.max(power));
        let least = (decibels(most.sqrt()) - WEAKER).max(WEAKEST);
        let mut found: Vec<(f64, [i64; 2])> = powers
            .filter(|(power, order)| {
                decibels(power.sqrt()) >= least && !self.may_be_ghost(*order) && self.is_peak(*order)
            })
            .collect();
        found.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
        let mut peaks: Vec<[i64; 2]> = Vec::new();
        for (_, order) in found {
            if peaks.len() == count {
                break;
            }
            if peaks.iter().all(|other| !self.is_near(order, *other)) {
                peaks.push(order);
            }
        }
        peaks.into_iter().map(to_right).collect()
    }

    /// Whether no wave beside it stands out more.
    fn is_peak(&self, [x, y]: [i64; 2]) -> bool {
        let height = self.height([x, y]);
        let beside = (-1..=1).flat_map(|dy| (-1..=1).map(move |dx| [x + dx, y + dy]));
        beside.map(|order| self.height(order)).all(|other| other <= height)
    }

    /// Whether both are one peak, or mirror images of one.
    fn is_near(&self, a: [i64; 2], b: [i64; 2]) -> bool {
        let near = |sign: i64| {
            (0..2).all(|axis| {
                let count = self.count(axis).max(1);
                let apart = (a[axis] - sign * b[axis]).rem_euclid(count);
                apart.min(count - apart) < APART
            })
        };
        near(1) || near(-1)
    }
}

/// Of a wave and its mirror image the one that runs to the right, or straight down.
fn to_right([x, y]: [i64; 2]) -> [i64; 2] {
    if x < 0 || (x == 0 && y < 0) { [-x, -y] } else { [x, y] }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use super::*;

    /// A wave of `frequency` in cycles per pixel, read in the middles of pixels.
    fn grating(size: [u32; 2], frequency: [f64; 2], amplitude: f64, phase: f64) -> LumaPlane {
        let places = (0..size[1]).flat_map(|y| (0..size[0]).map(move |x| [x, y].map(|at| f64::from(at) + 0.5)));
        let value = |[x, y]: [f64; 2]| {
            let turns = frequency[0] * x + frequency[1] * y;
            100.0 + amplitude * (TAU * turns + phase).cos()
        };
        #[expect(clippy::cast_possible_truncation, reason = "levels of 255")]
        let values = places.map(|at| value(at) as f32).collect();
        LumaPlane { size, values }
    }

    fn strongest(plane: LumaPlane) -> Wave {
        let spectrum = Spectrum::of(plane);
        let peaks = spectrum.peaks(5);
        assert_eq!(peaks.len(), 1, "one wave: {peaks:?}");
        spectrum.wave(peaks[0])
    }

    fn assert_near(found: f64, expected: f64, what: &str) {
        assert!((found - expected).abs() < 1e-3, "{what}: {found} for {expected}");
    }

    #[test]
    fn grating_peaks_at_its_frequency_with_its_amplitude() {
        for (size, frequency) in [
            ([64, 48], [0.25, 0.125]),
            ([40, 40], [0.3, -0.2]),
            ([45, 50], [0.0, 0.42]),
        ] {
            let found = strongest(grating(size, frequency, 50.0, 0.7));
            assert_near(found.frequency[0], frequency[0], "across");
            assert_near(found.frequency[1], frequency[1], "down");
            assert_near(found.amplitude, 50.0, "its amplitude");
            assert_near(found.decibels(), 20.0 * (50.0_f64 / 127.5).log10(), "in decibels");
            assert_near(
                found.wavelength(),
                1.0 / frequency[0].hypot(frequency[1]),
                "its wavelength",
            );
            for at in [[0.5, 0.5], [3.0, 7.5]] {
                let turns = frequency[0] * at[0] + frequency[1] * at[1];
                assert_near(
                    found.value_at(at),
                    50.0 * (TAU * turns + 0.7).cos(),
                    "its crests lie there",
                );
            }
        }
    }

    #[test]
    fn grating_that_is_too_fine_peaks_where_it_is_folded_to() {
        let found = strongest(grating([80, 60], [0.7, 0.0], 30.0, 0.0));
        assert_near(found.frequency[0], 0.3, "0.7 - 1, mirrored");
        assert_near(found.amplitude, 30.0, "as strong");
        let checker = strongest(grating([32, 32], [0.5, 0.5], 30.0, PI));
        assert_near(checker.amplitude, 30.0, "every other pixel: its own mirror image");
    }

    #[test]
    fn waves_at_the_limit_of_pixels_are_found_there() {
        // Leaks of both halves are as strong as the wave itself, and ties went to the frequency beside it.
        for size in [[100, 100], [64, 100], [500, 20], [36, 64]] {
            for frequency in [[0.5, 0.0], [0.0, 0.5], [0.5, 0.5]] {
                let found = strongest(grating(size, frequency, 127.5, PI * (frequency[0] + frequency[1])));
                assert_near(found.frequency[0], frequency[0], "across");
                assert_near(found.frequency[1], frequency[1], "down");
                assert_near(found.decibels(), 0.0, "from black to white");
            }
        }
    }

    #[test]
    fn constant_has_no_waves() {
        let spectrum = Spectrum::of(grating([33, 20], [0.0, 0.0], 70.0, 0.0));
        let all = spectrum.orders(1).flat_map(|y| spectrum.orders(0).map(move |x| [x, y]));
        let most = all.map(|order| spectrum.power(order)).fold(0.0, f64::max);
        assert!(most <= 0.0, "{most}");
        assert_eq!(spectrum.constant(), Some(170.0), "of one value");
        assert!(spectrum.wave([3, 2]).is_nothing(), "no wave");
        assert!(spectrum.peaks(9).is_empty(), "no peak");
    }

    #[test]
    fn power_of_noise_is_its_variance_by_the_windows_gain() {
        let mut state = 1_u32;
        let mut noise = || {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            f32::from(u8::try_from(state >> 24).unwrap_or(0))
        };
        let size = [96, 64];
        let values: Vec<f32> = (0..size[0] * size[1]).map(|_| noise()).collect();
        let mean = values.iter().sum::<f32>() / values.len() as f32;
        let variance = values.iter().map(|value| f64::from(value - mean).powi(2)).sum::<f64>() / values.len() as f64;
        let spectrum = Spectrum::of(LumaPlane { size, values });
        let all = spectrum.orders(1).flat_map(|y| spectrum.orders(0).map(move |x| [x, y]));
        let power: f64 = all.map(|order| spectrum.power(order)).sum();
        // Half of a wave's squared amplitude is its power, in two halves; Hann's squares have a mean of 3/8, its own a quarter.
        let expected = variance * 4.0 * 2.25;
        assert!((power / expected - 1.0).abs() < 0.05, "{power} for {expected}");
    }

    #[test]
    fn spectrum_is_symmetrical_and_repeats() {
        let spectrum = Spectrum::of(grating([20, 15], [0.23, 0.11], 60.0, 1.0));
        for [x, y] in [[3, 2], [-7, 5], [9, -4]] {
            let power = spectrum.power([x, y]);
            assert!(
                (spectrum.power([-x, -y]) - power).abs() <= 1e-5 * power.max(1e-3),
                "mirrored at {x}, {y}"
            );
            assert!(
                (spectrum.power([x + 20, y - 15]) - power).abs() <= 1e-9,
                "repeated at {x}, {y}"
            );
        }
    }

    #[test]
    fn finer_waves_reach_farther_than_is_shown() {
        let (size, fineness) = ([20, 15], 6);
        let mut waves = vec![Complex::default(); 120 * 90];
        for (order, amplitude) in [([24, 0], 40.0), ([44, 3], 60.0)] {
            let [x, y]: [usize; 2] = order;
            waves[x * 90 + y] = Complex::from_polar(amplitude, 0.5);
            waves[(120 - x) * 90 + (90 - y) % 90] = Complex::from_polar(amplitude, -0.5);
        }
        let spectrum = Spectrum::of_finer(waves, size, fineness);
        assert_near(spectrum.reach(), 1.5, "in cycles per pixel");
        assert_eq!(spectrum.peaks(4), [[24, 0]], "what is shown");
        let found = spectrum.wave([24, 0]);
        assert_near(found.frequency[0], 1.2, "24 periods in 20 pixels");
        assert_near(found.value_at([0.0, 0.2]), 40.0 * 0.5_f64.cos(), "from the corner");
        assert_near(spectrum.wave([-44, -3]).amplitude, 60.0, "beyond, for those that ask");
        assert_eq!(spectrum.order([2.2, 0.2]), None, "which is not shown");
        let spectrum = spectrum.with_ghosts(50.0);
        assert!(spectrum.peaks(4).is_empty(), "it may be a ghost");
        assert!(!spectrum.may_be_ghost([44, 3]), "too strong for one");
    }

    #[test]
    fn angles_are_those_of_stripes() {
        let angle = |frequency| {
            let (amplitude, phase) = (1.0, 0.0);
            Wave {
                frequency,
                amplitude,
                phase,
            }
            .angle()
        };
        assert_near(angle([0.1, 0.1]), 45.0, "to the right and down");
        assert_near(angle([-0.1, -0.1]), 45.0, "the same backwards");
        assert_near(angle([0.1, -0.1]), -45.0, "to the right and up");
        assert_near(angle([0.0, -0.1]), 90.0, "up is down");
        assert_near(angle([-0.2, 0.0]), 0.0, "left is right");
    }
}
