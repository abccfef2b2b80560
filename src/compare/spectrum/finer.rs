//! The scene, drawn so finely that waves far too fine for pixels are still told from those that they could be taken for.
//!
//! Points that lie `r` to a pixel cannot tell a wave of `f` cycles per pixel from one of `r - f`: whatever is finer than half of
//! `r` comes back as a ghost that the scene does not have. So the scene is drawn twice, by one point in each of many small
//! squares, and a wave counts as much as both drawings have of it: in each of them a ghost lies elsewhere.
//!
//! That holds as long as nothing ties the two numbers of squares to each other or to what repeats in the region. A region of 500
//! pixels with 250 bars has waves of 250, 750, 1250, ... periods. Of 4375 squares, which are 35 times 125, they all come back at
//! multiples of 125 periods, and so they do of 2625, which are 21 times 125. Of numbers that share no factor with the region's
//! pixels or each other (4199 and 2553), ghosts are strewn over all frequencies. Where by chance two still meet, they are of
//! different waves, and so rarely in step.

use glam::{DAffine2, DVec2};
use rayon::prelude::*;
use rustfft::num_complex::Complex;

use super::fourier::transform_low;
use super::from_corner;
use super::luma::luma;
use super::waves::Spectrum;
use crate::geometry::ViewTransform;
use crate::raster::{Framebuffer, Region, ResolveFilter, SamplePattern, SampleRate};
use crate::render::{CancelToken, RenderSettings, Subject, draw_regions};

/// How many times as many frequencies are kept along an axis as pixels can show: up to two and a half cycles per pixel.
pub(super) const FINENESS: u32 = 5;
/// Squares along a pixel's side in the two drawings, at least; some 100 in a pixel together. The first has no ghost of what is
/// coarser than 5.8 cycles per pixel.
const RATES: [f64; 2] = [8.3, 5.1];

/// Prime factors of numbers of squares: small, for a quick transform, and odd, since what people draw repeats in even numbers of
/// pixels. With fewer of them, some sides are half as many squares again away from the next number that shares no factor.
const FACTORS: [u32; 17] = [3, 5, 7, 11, 13, 17, 19, 23, 29, 31, 37, 41, 43, 47, 53, 59, 61];

/// The part of a wave of the first drawing that the second has at least, unless it is a ghost.
const OWN: f32 = 0.5;

/// The scene's spectrum in a region of the picture. What is as thin as a pixel by definition, such as the course's lines, is as
/// thin as a square there.
pub(super) fn scene(subject: &Subject<'_>, region: Region) -> Option<Spectrum> {
    let size = [region.width, region.height];
    let [across, down] = size.map(squares);
    let [first, second] = [0, 1].map(|drawing: usize| {
        let frame = drawn(subject, region, [across[drawing], down[drawing]])?;
        let waves = transform_low(&frame, size.map(|side| (side * FINENESS) as usize));
        Some((constant(&frame), waves))
    });
    let ((constant, mut waves), (_, others)) = (first?, second?);
    if constant.is_some() {
        // What rounding made of its mean.
        waves.fill(Complex::default());
        return Some(Spectrum::of_finer(waves, size, FINENESS).with_constant(constant));
    }
    let ghosts = strongest_ghost(&waves, &others, size);
    let both = waves.par_iter_mut().with_min_len(4096).zip(&others);
    both.for_each(|(wave, other)| *wave *= shared(*wave, *other));
    Some(Spectrum::of_finer(waves, size, FINENESS).with_ghosts(ghosts))
}

/// The luma of all pixels, where they are of one colour.
fn constant(frame: &Framebuffer) -> Option<f32> {
    let (first, rest) = frame.pixels().split_first()?;
    rest.iter().all(|pixel| pixel == first).then(|| luma(*first))
}

/// The part of the first wave that the second has in step with it, `0.0..=1.0`.
fn shared(wave: Complex<f32>, other: Complex<f32>) -> f32 {
    let in_step = wave.re * other.re + wave.im * other.im;
    (in_step / wave.norm_sqr().max(f32::MIN_POSITIVE)).clamp(0.0, 1.0)
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
            if power > most && shared(*wave, *other) < OWN {
                most = power;
            }
        }
        most
    });
    ghosts.reduce(|| 0.0, f32::max).sqrt()
}

/// As many squares as a side of so many pixels is cut into at least, in each of the drawings: without a factor in common with each
/// other or the pixels.
fn squares(side: u32) -> [u32; 2] {
    let [first, second] = RATES;
    let first = squares_without(side, first, 1);
    [first, squares_without(side, second, first)]
}

/// So many for one drawing, without a factor in common with the side and another number.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "some thousands at most"
)]
fn squares_without(side: u32, rate: f64, other: u32) -> u32 {
    let least = (f64::from(side) * rate).ceil() as u32;
    let is_free = |count: &u32| {
        let mut rest = *count;
        for factor in FACTORS {
            let is_taken = side.is_multiple_of(factor) || other.is_multiple_of(factor);
            while !is_taken && rest > 1 && rest.is_multiple_of(factor) {
                rest /= factor;
            }
        }
        rest == 1
    };
    (least..=least.saturating_mul(2)).find(is_free).unwrap_or(least)
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
    fn squares_are_enough_and_share_no_factor() {
        fn common(a: u32, b: u32) -> u32 {
            if b == 0 { a } else { common(b, a % b) }
        }
        for side in 1..=512 {
            let [first, second] = squares(side);
            assert_eq!(common(first, side), 1, "{first} squares of {side}");
            assert_eq!(common(second, side), 1, "{second} squares of {side}");
            assert_eq!(common(first, second), 1, "{first} and {second} of {side}");
            for (count, rate) in [(first, RATES[0]), (second, RATES[1])] {
                let found = f64::from(count) / f64::from(side);
                assert!(found >= rate, "{side}: {found}");
                assert!(side < 64 || found < 1.1 * rate, "{side}: no more than needed, {found}");
            }
        }
        assert_eq!(squares(500), [4199, 2553], "13 x 17 x 19 and 3 x 23 x 37");
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
        // One that the second has as much of, but elsewhere in its period: two ghosts that meet.
        (waves[14], others[14]) = (wave(12.0), Complex::new(12.0, 0.0));
        let found = strongest_ghost(&waves, &others, [2, 1]);
        assert!((found - 12.0).abs() < 1e-6, "{found}");
    }

    #[test]
    fn what_both_have_is_in_step() {
        let part = |first: [f32; 2], second: [f32; 2]| {
            let [first, second] = [first, second].map(|[re, im]| Complex::new(re, im));
            shared(first, second)
        };
        let near = |found: f32, expected: f32| assert!((found - expected).abs() < 1e-6, "{found} for {expected}");
        near(part([3.0, 4.0], [0.6, 0.8]), 0.2);
        near(part([0.6, 0.8], [3.0, 4.0]), 1.0);
        near(part([3.0, 4.0], [-4.0, 3.0]), 0.0);
        near(part([3.0, 4.0], [-3.0, -4.0]), 0.0);
        near(part([0.0, 0.0], [1.0, 0.0]), 0.0);
    }
}
