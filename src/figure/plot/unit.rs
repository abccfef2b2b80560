//! Lengths of a chart's letters and lines, which are parts of its size.

use crate::raster::Framebuffer;

/// The height of letters of legend and notes, in units.
pub(super) const LETTERS: f64 = 1.1;
/// Straight `0xAARRGGBB` of words.
pub(super) const INK: u32 = 0xff20_2428;

/// Pixels of units of letters, which keep their part of the picture.
#[derive(Clone, Copy, Debug)]
pub(super) struct Unit(pub(super) f64);

impl Unit {
    pub(super) fn of_picture([width, height]: [u32; 2]) -> Self {
        let [width, height] = [width, height].map(|side| f64::from(side.min(Framebuffer::MAX_SIDE)));
        Self((width.min(height * 1.5) / 60.0).max(8.0))
    }

    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "at most a picture's side"
    )]
    pub(super) fn px(self, units: f64) -> u32 {
        (self.0 * units).round().max(0.0) as u32
    }

    /// The size of letters whose line is so many units high.
    #[expect(clippy::cast_possible_truncation, reason = "a part of a picture's side")]
    pub(super) fn letters(self, units: f64) -> f32 {
        // Heights are told from ascent to descent.
        (self.0 * units / 1.12) as f32
    }

    /// Pixels across a line.
    pub(super) fn line(self) -> f64 {
        (self.0 * 0.12).max(1.0)
    }

    /// Pixels from the middle of a point to its edge.
    pub(super) fn mark(self) -> f64 {
        self.0 * 0.34
    }

    /// About how wide a text of this height is: a letter is about half as wide as high.
    pub(super) fn width(self, text: &str, height: f64) -> f64 {
        self.0 * height * 0.55 * text.chars().count() as f64
    }
}
