//! Pixels in the middle of pixels that all show one and the same colour: whatever these weigh, the sum is that colour.

use crate::color::Premultiplied16;
use crate::raster::paint::sample_colors::{PixelColors, SampleColors};

/// Which pixels of a tile are flat.
#[derive(Debug, Default)]
pub(super) struct FlatPixels {
    /// Pixels in a row of the tile.
    width: usize,
    /// Row by row, whether a pixel is.
    flat: Vec<bool>,
    /// For each column, how many rows up to the one at work show the colour of the one above.
    down: Vec<(u32, Premultiplied16)>,
}

impl FlatPixels {
    /// Looks at a tile that was painted with so many pixels around it.
    pub(super) fn find(&mut self, colors: &SampleColors, margin: usize) {
        let beside = 2 * margin;
        let needed = u32::try_from(beside).unwrap_or(u32::MAX);
        self.width = colors.width() - beside;
        self.flat.clear();
        self.down.clear();
        self.down.resize(self.width, (0, Premultiplied16::TRANSPARENT));
        for y in 0..colors.rect.y.length() {
            // How many pixels up to this one show one colour.
            let (mut across, mut before) = (0, Premultiplied16::TRANSPARENT);
            for x in 0..colors.width() {
                across = match colors.pixel(y * colors.width() + x) {
                    PixelColors::Split(_) => 0,
                    PixelColors::Whole(color) if across > 0 && color == before => across + 1,
                    PixelColors::Whole(color) => {
                        before = color;
                        1
                    }
                };
                let Some(down) = x.checked_sub(beside).and_then(|column| self.down.get_mut(column)) else {
                    continue;
                };
                *down = match *down {
                    _ if across <= needed => (0, before),
                    (rows, color) if rows > 0 && color == before => (rows + 1, before),
                    _ => (1, before),
                };
            }
            if y >= beside {
                self.flat.extend(self.down.iter().map(|(rows, _)| *rows > needed));
            }
        }
    }

    /// Whether all pixels are flat.
    pub(super) fn are_all(&self) -> bool {
        !self.flat.contains(&false)
    }

    /// Pixels in a row.
    pub(super) fn width(&self) -> usize {
        self.width
    }

    /// Rows of pixels.
    pub(super) fn height(&self) -> usize {
        self.flat.len().checked_div(self.width).unwrap_or(0)
    }

    /// For each pixel of a row whether it is flat.
    pub(super) fn row(&self, y: usize) -> &[bool] {
        &self.flat[y * self.width..][..self.width]
    }
}
