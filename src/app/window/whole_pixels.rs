//! Sizes of a window that are whole pixels at a scale such as 1.5.
//!
//! Wayland knows a window's size in points. At a scale of 1.5 a window 101 points wide takes 151.5 pixels: its buffer has 152, and
//! the compositor squeezes them, so that no pixel is shown as it was drawn. Every other number of points is a whole number of
//! pixels:
//!
//! ```text
//!      points:   100      101      102
//!      pixels:   150     151.5     153
//! ```

use winit::dpi::PhysicalSize;
use winit::window::Window;

/// The parts in which compositors count scales (Wayland, fractional-scale-v1).
const PARTS: u32 = 120;

/// A scale as a fraction in lowest terms: so many pixels are so many points.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct WholePixels {
    pixels: u32,
    points: u32,
}

/// Makes a window on Wayland whole pixels wide and high, and keeps it so under a hand that resizes it; `smallest` is how small it
/// may become. Returns its size. Where the compositor alone says how large the window is, as in a tile, that stays.
pub(super) fn fit(window: &Window, smallest: PhysicalSize<u32>) -> PhysicalSize<u32> {
    let size = window.inner_size();
    let Some(whole) = WholePixels::at(window.scale_factor()) else {
        window.set_min_inner_size(Some(smallest));
        window.set_resize_increments(None::<PhysicalSize<u32>>);
        return size;
    };
    window.set_min_inner_size(Some(whole.at_least(smallest)));
    window.set_resize_increments(Some(whole.step()));
    window.request_inner_size(whole.nearest(size)).unwrap_or(size)
}

impl WholePixels {
    /// At `scale` pixels per point; `None` where every size is whole pixels.
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "a scale is a small number above zero"
    )]
    fn at(scale: f64) -> Option<Self> {
        let parts = (scale * f64::from(PARTS)).round().clamp(1.0, 1e6) as u32;
        let shared = greatest_common_divisor(parts, PARTS);
        let (pixels, points) = (parts / shared, PARTS / shared);
        (points > 1).then_some(Self { pixels, points })
    }

    /// The nearest size of whole points and whole pixels.
    fn nearest(self, size: PhysicalSize<u32>) -> PhysicalSize<u32> {
        let side = |side: u32| (side.saturating_add(self.pixels / 2) / self.pixels).max(1) * self.pixels;
        PhysicalSize::new(side(size.width), side(size.height))
    }

    /// The smallest size of whole points and pixels that is not below `size`.
    fn at_least(self, size: PhysicalSize<u32>) -> PhysicalSize<u32> {
        let side = |side: u32| side.div_ceil(self.pixels) * self.pixels;
        PhysicalSize::new(side(size.width), side(size.height))
    }

    /// By what a hand that resizes the window may change it.
    fn step(self) -> PhysicalSize<u32> {
        PhysicalSize::new(self.pixels, self.pixels)
    }
}

fn greatest_common_divisor(a: u32, b: u32) -> u32 {
    if b == 0 { a } else { greatest_common_divisor(b, a % b) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sizes_are_whole_points_and_whole_pixels() {
        for parts in 60..=480 {
            let scale = f64::from(parts) / f64::from(PARTS);
            let Some(whole) = WholePixels::at(scale) else {
                assert_eq!(parts % PARTS, 0, "only whole scales leave every size as it is: {scale}");
                continue;
            };
            for side in [1, 240, 799, 800, 1056, 1280, 1843] {
                let found = whole.nearest(PhysicalSize::new(side, side)).width;
                let points = f64::from(found) / scale;
                assert!(
                    (points - points.round()).abs() < 1e-6,
                    "{found} pixels at {scale} are {points} points"
                );
                let most = f64::from(whole.pixels) / 2.0;
                let is_near = (f64::from(found) - f64::from(side)).abs() <= most || found == whole.pixels;
                assert!(is_near, "{found} for {side} at {scale}");
                let least = whole.at_least(PhysicalSize::new(side, side)).width;
                assert!(
                    least >= side && least < side + whole.pixels,
                    "{least} for {side} at {scale}"
                );
                assert_eq!(least % whole.step().width, 0, "hands start there");
            }
        }
    }

    #[test]
    fn common_scales_have_small_steps() {
        let step = |scale| WholePixels::at(scale).map(|whole| (whole.pixels, whole.points));
        assert_eq!(step(1.0), None);
        assert_eq!(step(2.0), None);
        assert_eq!(step(1.5), Some((3, 2)));
        assert_eq!(step(1.25), Some((5, 4)));
        assert_eq!(step(1.75), Some((7, 4)));
        let size = PhysicalSize::new(1280, 800);
        assert_eq!(
            WholePixels::at(1.5).map(|whole| whole.nearest(size)),
            Some(PhysicalSize::new(1281, 801))
        );
    }
}
