//! The scene, drawn so finely that waves far too fine for pixels are still told from those that they could be taken for.
//!
//! Points that lie `r` to a pixel cannot tell a wave of `f` cycles per pixel from one of `r - f`: whatever is finer than half of
//! `r` comes back as a ghost that the scene does not have. So the scene is drawn twice, by one point in each of many small
//! squares, and a wave counts as much as the weaker of both drawings has of it: in each of them a ghost lies elsewhere.

use glam::{DAffine2, DVec2};
use rayon::prelude::*;
use rustfft::num_complex::Complex;

use super::fourier::transform_low;
use super::from_corner;
use super::waves::Spectrum;
use crate::geometry::ViewTransform;
use crate::raster::{Framebuffer, Region, ResolveFilter, SamplePattern, SampleRate};
use crate::render::{CancelToken, RenderSettings, Subject, draw_regions};

/// How many times as many frequencies are kept along an axis as pixels can show: up to two and a half cycles per pixel.
pub(super) const FINENESS: u32 = 5;
/// Squares along a pixel's side in the two drawings, at least; some 100 in a pixel together. The first has no ghost of what is
/// coarser than 5.8 cycles per pixel. They are far from the ratio of small numbers: only what is of single frequencies has its
/// ghosts in one place in both.
const RATES: [f64; 2] = [8.3, 5.1];

/// How many times the power in the second drawing that of a ghost in the first is at least.
const GHOST: f32 = 4.0;

/// The scene's spectrum in a region of the picture. What is as thin as a pixel by definition, such as the course's lines, is as
/// thin as a square there.
pub(super) fn scene(subject: &Subject<'_>, region: Region) -> Option<Spectrum> {
    let size = [region.width, region.height];
    let [waves, others] = RATES.map(|rate| {
        let frame = drawn(subject, region, size.map(|side| squares(side, rate)))?;
        Some(transform_low(&frame, size.map(|side| (side * FINENESS) as usize)))
    });
    let (mut waves, others) = (waves?, others?);
    let ghosts = strongest_ghost(&waves, &others, size);
    let both = waves.par_iter_mut().with_min_len(4096).zip(&others);
    both.for_each(|(wave, other)| *wave = weaker(*wave, *other));
    Some(Spectrum::of_finer(waves, size, FINENESS).with_ghosts(ghosts))
}

/// The first wave, as strong as the second at most.
fn weaker(wave: Complex<f32>, other: Complex<f32>) -> Complex<f32> {
    let (own, other) = (wave.norm_sqr(), other.norm_sqr());
    if other < own { wave * (other / own).sqrt() } else { wave }
}

/// The amplitude of the strongest wave of which the second drawing has less than half: as strong may be what by chance both
/// of them have of ghosts.
fn strongest_ghost(waves: &[Complex<f32>], others: &[Complex<f32>], size: [u32; 2]) -> f32 {
    let [width, height] = size.map(|side| (side * FINENESS) as usize);
    let columns = waves.par_chunks(height.max(1)).zip(others.par_chunks(height.max(1)));
    // Of mirror images one.
    let ghosts = columns.take(width / 2 + 1).map(|(waves, others)| {
        let mut most = 0.0_f32;
        for (wave, other) in waves.iter().zip(others) {
            let power = wave.norm_sqr();
            if power > most && power > GHOST * other.norm_sqr() {
                most = power;
            }
        }
        most
    });
    ghosts.reduce(|| 0.0, f32::max).sqrt()
}

/// As many squares as a side of so many pixels is cut into at least; of small factors, for a quick transform, and of odd ones, since
/// what people draw repeats in even numbers of pixels.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "some thousands at most"
)]
fn squares(side: u32, rate: f64) -> u32 {
    let least = (f64::from(side) * rate).ceil() as u32;
    let is_smooth = |count: &u32| {
        let mut rest = *count;
        for factor in [3, 5, 7] {
            while rest > 1 && rest.is_multiple_of(factor) {
                rest /= factor;
            }
        }
        rest == 1
    };
    (least..=least.saturating_mul(2)).find(is_smooth).unwrap_or(least)
}

/// The region in so many squares, each as the scene is in its middle.
fn drawn(subject: &Subject<'_>, region: Region, squares: [u32; 2]) -> Option<Framebuffer> {
    let rate = [(squares[0], region.width), (squares[1], region.height)];
    let rate = rate.map(|(squares, side)| f64::from(squares) / f64::from(side));
    let view = ViewTransform {
        scene_to_pixels: DAffine2::from_scale(DVec2::from(rate)) * from_corner(region) * subject.view.scene_to_pixels,
    };
    let settings = RenderSettings {
        sample_rate: SampleRate::ONE,
        pattern: SamplePattern::Grid,
        resolve_filter: ResolveFilter::Box,
        filter_radius: None,
        ..subject.settings.truth()
    };
    let finer = Subject {
        scene: subject.scene,
        view: &view,
        settings: &settings,
    };
    let mut frame = Framebuffer::new(squares[0], squares[1]);
    draw_regions(&finer, &mut frame, &[Region::of_size(squares)], &CancelToken::default())?;
    Some(frame)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn squares_are_enough_and_of_small_factors() {
        for side in [1, 2, 63, 64, 200, 509, 512] {
            let [first, second] = RATES.map(|rate| f64::from(squares(side, rate)) / f64::from(side));
            assert!(first >= RATES[0] && second >= RATES[1], "{side}: {first} and {second}");
            assert!(
                side < 63 || first < 1.08 * RATES[0],
                "{side}: no more than needed, {first}"
            );
        }
        assert_eq!(squares(512, RATES[0]), 4375, "625 x 7");
    }

    #[test]
    fn strongest_ghost_is_what_one_drawing_has() {
        let wave = |amplitude: f32| Complex::new(0.0, amplitude);
        let mut waves = vec![wave(0.1); 10 * 5];
        let mut others = waves.clone();
        // A wave of both, one that the second has less than half of, one that only the second has.
        (waves[7], others[7]) = (wave(90.0), wave(60.0));
        (waves[12], others[12]) = (wave(9.0), wave(4.0));
        others[13] = wave(30.0);
        let found = strongest_ghost(&waves, &others, [2, 1]);
        assert!((found - 9.0).abs() < 1e-6, "{found}");
    }

    #[test]
    fn weaker_wave_keeps_the_first_phase() {
        let [first, second] = [[3.0, 4.0], [0.0, -1.0]].map(|[re, im]| Complex::new(re, im));
        let off = (weaker(first, second) - first / 5.0).norm();
        assert!(off < 1e-6, "as strong as the second: {off}");
        assert_eq!(weaker(second, first), second, "weaker already");
        let none = Complex::new(0.0, 0.0);
        assert_eq!(weaker(none, none), none, "nothing");
    }
}
