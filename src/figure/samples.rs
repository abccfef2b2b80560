//! The samples of a magnified pixel, as marks on its block.

use super::PixelRect;
use super::paint::{for_each_index, over_white};
use crate::compare::single_luma;
use crate::raster::Framebuffer;

/// Part of the distance between samples that a mark takes to each side.
const RADIUS: f64 = 0.32;
/// Largest mark, in pixels to each side.
const MAX_RADIUS: f64 = 9.0;

/// One sample of a pixel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SampleMark {
    /// Where in the pixel, each coordinate in `0.0..=1.0`.
    pub at: [f64; 2],
    /// The sample's colour, straight `[r, g, b, a]`.
    pub color: [u8; 4],
    /// Whether a primitive covers it.
    pub covered: bool,
}

/// Marks `samples` on the pixel's `block`; marks that would run into each other are left out.
pub(super) fn draw_samples(block: &PixelRect, samples: &[SampleMark], picture: &mut Framebuffer) {
    let per_side = (samples.len() as f64).sqrt().ceil();
    let radius = (f64::from(block.width) / per_side * RADIUS).min(MAX_RADIUS);
    if radius < 1.0 {
        return;
    }
    for sample in samples {
        draw_sample(block, sample, radius, picture);
    }
}

/// A disc of the sample's colour where a primitive covers it, a square where none does, ringed so that it stands out.
fn draw_sample(block: &PixelRect, sample: &SampleMark, radius: f64, picture: &mut Framebuffer) {
    let [x, y] = sample.at.map(|part| part * f64::from(block.width));
    let ring = if is_dark(sample.color) {
        0xffff_ffff
    } else {
        0xff00_0000
    };
    let width = picture.width() as usize;
    // Farther away nothing of it is drawn.
    let near = |at: f64| (at - radius).floor();
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "a few pixels around a place in the block"
    )]
    let around = PixelRect {
        x: block.x + near(x) as i64,
        y: block.y + near(y) as i64,
        width: (2.0 * radius).ceil() as u32 + 2,
        height: (2.0 * radius).ceil() as u32 + 2,
    };
    for_each_index(&around.intersection(block), width, |index| {
        let column = (index % width) as f64 - block.x as f64 + 0.5;
        let row = (index / width) as f64 - block.y as f64 + 0.5;
        let (dx, dy) = ((column - x).abs(), (row - y).abs());
        let distance = if sample.covered { dx.hypot(dy) } else { dx.max(dy) };
        if distance <= radius - 1.0 {
            picture.pixels_mut()[index] = over_white(sample.color);
        } else if distance <= radius {
            picture.pixels_mut()[index] = ring;
        }
    });
}

/// Whether white reads better than black on this straight colour over white.
pub fn is_dark([r, g, b, a]: [u8; 4]) -> bool {
    let luma = single_luma([r, g, b]);
    let opacity = f32::from(a) / 255.0;
    luma * opacity + 255.0 * (1.0 - opacity) < 140.0
}
