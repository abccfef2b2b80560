//! Pictures made larger by whole numbers: every pixel a square, nothing smoothed.

use crate::raster::Framebuffer;

/// The picture with a square of `factor` x `factor` pixels for each of its own; a factor of 0 counts as 1.
///
/// # Panics
/// When a side then exceeds [`Framebuffer::MAX_SIDE`].
pub fn magnified(picture: &Framebuffer, factor: u32) -> Framebuffer {
    let factor = factor.max(1);
    let mut large = Framebuffer::new(
        picture.width().saturating_mul(factor),
        picture.height().saturating_mul(factor),
    );
    let (width, side) = (large.width() as usize, factor as usize);
    if large.pixels().is_empty() {
        return large;
    }
    let bands = large.pixels_mut().chunks_exact_mut(width * side);
    for (band, row) in bands.zip(picture.pixels().chunks_exact(picture.width() as usize)) {
        for line in band.chunks_exact_mut(width) {
            for (square, pixel) in line.chunks_exact_mut(side).zip(row) {
                square.fill(*pixel);
            }
        }
    }
    large
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pixels_become_squares() {
        let mut picture = Framebuffer::new(2, 2);
        picture.pixels_mut().copy_from_slice(&[1, 2, 3, 4]);
        let large = magnified(&picture, 2);
        assert_eq!(
            large.pixels(),
            [1, 1, 2, 2, 1, 1, 2, 2, 3, 3, 4, 4, 3, 3, 4, 4],
            "each twice as wide and high"
        );
        assert_eq!(magnified(&picture, 0), picture, "never less than it was");
        assert!(
            magnified(&Framebuffer::new(0, 3), 2).pixels().is_empty(),
            "nothing of nothing"
        );
    }
}
