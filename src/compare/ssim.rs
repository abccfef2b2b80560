//! Structural similarity: Z. Wang, A. C. Bovik, H. R. Sheikh, E. P. Simoncelli, "Image Quality Assessment: From Error
//! Visibility to Structural Similarity", IEEE Transactions on Image Processing 13(4), 2004.
//!
//! Own code, because the paper's numbers are what people compare with: the crates that were looked at are under the AGPL
//! (`dssim-core`), measure something else (`ssimulacra2`), or leave the paper: `image-compare` 0.5 cuts the picture into
//! blocks and does not divide its variances by their number of pixels.

use super::gaussian::{gaussian, normalized};
use super::luma::single_luma;
use super::plane::Plane;
use super::tiles::sum;
use super::{Pair, tiles};
use crate::raster::{Framebuffer, Region};
use crate::render::CancelToken;

/// Half of the window's side less one: it has 11 x 11 pixels.
const RADIUS: u32 = 5;
/// Standard deviation of the window's Gaussian weights, in pixels.
const SIGMA: f64 = 1.5;
/// `(K1 L)^2` and `(K2 L)^2` with the paper's K1 = 0.01 and K2 = 0.03, and L = 255.
const C: [f32; 2] = [2.55 * 2.55, 7.65 * 7.65];

impl Pair<'_> {
    /// The mean structural similarity of both pictures' luma `0.299 R + 0.587 G + 0.114 B` on white paper: 1 for equal
    /// pictures, less for others, below 0 where structures are opposed. The mean is over the windows that lie wholly in
    /// the picture, as in the authors' code; along a side of less than 11 pixels the window is as long as fits. `None`
    /// once `cancel` says so.
    pub fn ssim(self, cancel: &CancelToken) -> Option<f64> {
        let [width, height] = self.size();
        if width == 0 || height == 0 {
            return Some(1.0);
        }
        let radius = [width, height].map(|side| RADIUS.min((side - 1) / 2));
        let centres = Region {
            x: radius[0],
            y: radius[1],
            width: width - 2 * radius[0],
            height: height - 2 * radius[1],
        };
        let windows = f64::from(centres.width) * f64::from(centres.height);
        let kernels = radius.map(window);
        let total = sum(centres, cancel, |tile| {
            self.sum_where_unlike(tile, RADIUS, 1.0, &|part| {
                let [a, b] = [self.a, self.b].map(|frame| luma(frame, part));
                similarity(&a, &b, (part.width + 2 * RADIUS) as usize, &kernels)
            })
        });
        Some(total? / windows)
    }
}

/// The weights of a window along an axis.
fn window(radius: u32) -> Vec<f32> {
    normalized(&gaussian(SIGMA, radius))
}

fn luma(frame: &Framebuffer, tile: Region) -> Vec<f32> {
    tiles::with_margin(frame, tile, RADIUS)
        .into_iter()
        .map(single_luma)
        .collect()
}

/// The sum of the similarities of all windows in a tile; `a` and `b` are its lumas with their margin.
fn similarity(a: &[f32], b: &[f32], width: usize, kernels: &[Vec<f32>; 2]) -> f64 {
    // Variances do not change when all numbers are shifted; near zero fewer bits are lost. Sums here and below are the same to the
    // last bit when the pictures are swapped.
    let [a_sum, b_sum] = [a, b].map(|values| values.iter().sum::<f32>());
    let shift = (a_sum + b_sum) / (a.len() + b.len()) as f32;
    let mean = |values: Vec<f32>| {
        let [across, down] = kernels;
        Plane::new(width, values)
            .across(across, RADIUS as usize)
            .down(down, RADIUS as usize)
    };
    let pairs = || a.iter().zip(b).map(|(a, b)| (a - shift, b - shift));
    let a_mean = mean(pairs().map(|(a, _)| a).collect());
    let b_mean = mean(pairs().map(|(_, b)| b).collect());
    let squares = mean(pairs().map(|(a, b)| a * a + b * b).collect());
    let products = mean(pairs().map(|(a, b)| a * b).collect());
    let means = a_mean.values().iter().zip(b_mean.values());
    means
        .zip(squares.values().iter().zip(products.values()))
        .map(|((a, b), (squares, products))| {
            let variances = squares - (a * a + b * b);
            let covariance = products - a * b;
            let (a, b) = (a + shift, b + shift);
            let luminance = (2.0 * a * b + C[0]) / (a * a + b * b + C[0]);
            let structure = (2.0 * covariance + C[1]) / (variances + C[1]);
            f64::from(luminance * structure)
        })
        .sum()
}

#[cfg(test)]
mod tests {
    use super::super::flip::test_pictures::{dimmed, flat, hatch, line, shifted, waves};
    use super::*;

    fn ssim(a: &Framebuffer, b: &Framebuffer) -> f64 {
        let pair = Pair::new(a, b).expect("one size");
        pair.ssim(&CancelToken::default()).expect("not cancelled")
    }

    #[test]
    fn ssim_of_flat_pictures_is_the_luminance_term() {
        let (a, b) = (flat([20, 15], 100), flat([20, 15], 120));
        let expected = (2.0 * 100.0 * 120.0 + 6.5025) / (100.0_f64.powi(2) + 120.0_f64.powi(2) + 6.5025);
        assert!((ssim(&a, &b) - expected).abs() < 1e-5, "{} is {expected}", ssim(&a, &b));
        let tiny = (flat([1, 2], 100), flat([1, 2], 120));
        assert!(
            (ssim(&tiny.0, &tiny.1) - expected).abs() < 1e-5,
            "smaller than the window"
        );
        let none = Framebuffer::new(0, 0);
        assert!((ssim(&none, &none) - 1.0).abs() < 1e-12, "nothing is equal to nothing");
    }

    /// What scikit-image 0.26 says: `structural_similarity` of both lumas in 64 bits with `gaussian_weights=True,
    /// sigma=1.5, use_sample_covariance=False, data_range=255`, which follow the paper.
    #[test]
    fn ssim_is_what_others_compute() {
        const SIZE: [u32; 2] = [300, 150];
        let (waves, hatch, white) = (waves(SIZE), hatch(SIZE), flat(SIZE, 255));
        for (name, a, b, expected) in [
            ("waves, dimmed", &waves, &dimmed(&waves), 0.921_849_476_5),
            ("waves, moved", &waves, &shifted(&waves, 1), 0.655_155_221_2),
            ("hatch, moved", &hatch, &shifted(&hatch, 2), -0.322_041_216_7),
            ("a line on white", &white, &line(SIZE), 0.966_312_567_2),
            ("black and white", &flat(SIZE, 0), &white, 0.000_099_990_0),
            ("hatch and waves", &hatch, &waves, 0.006_022_791_2),
        ] {
            assert!(
                (ssim(a, b) - expected).abs() < 1e-5,
                "{name}: {} instead of {expected}",
                ssim(a, b)
            );
            assert_eq!(ssim(a, b).to_bits(), ssim(b, a).to_bits(), "{name}: the same both ways");
            assert!((ssim(a, a) - 1.0).abs() < 1e-12, "{name}: equal to itself");
        }
        let cancel = CancelToken::default();
        cancel.cancel();
        assert_eq!(
            Pair::new(&waves, &hatch).expect("one size").ssim(&cancel),
            None,
            "cancelled"
        );
    }

    #[test]
    fn ssim_of_equal_tiles_needs_no_short_cut() {
        let waves = waves([60, 40]);
        let tile = Region {
            x: 10,
            y: 10,
            width: 30,
            height: 20,
        };
        let luma = luma(&waves, tile);
        let found = similarity(&luma, &luma, 40, &[window(RADIUS), window(RADIUS)]);
        assert!((found - 600.0).abs() < 1e-4, "one for each window: {found}");
    }
}
