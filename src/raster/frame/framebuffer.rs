//! Resolved pixels.

use crate::raster::Region;

/// A picture: `width` x `height` resolved pixels, rows from the top.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Framebuffer {
    width: u32,
    height: u32,
    pixels: Vec<u32>,
}

impl Framebuffer {
    /// Longest side of a frame, in pixels.
    pub const MAX_SIDE: u32 = 16_384;

    /// A transparent frame. Either side may be zero.
    ///
    /// # Panics
    /// When a side exceeds [`Framebuffer::MAX_SIDE`].
    pub fn new(width: u32, height: u32) -> Self {
        assert!(
            width.max(height) <= Self::MAX_SIDE,
            "frame of {width}x{height} exceeds {}",
            Self::MAX_SIDE
        );
        Self {
            width,
            height,
            pixels: vec![0; width as usize * height as usize],
        }
    }

    /// Pixels in a row.
    pub fn width(&self) -> u32 {
        self.width
    }

    /// Rows.
    pub fn height(&self) -> u32 {
        self.height
    }

    /// All pixels, row by row, each `0xAARRGGBB` with straight sRGB-encoded channels.
    pub fn pixels(&self) -> &[u32] {
        &self.pixels
    }

    /// All pixels, as [`Framebuffer::pixels`].
    pub fn pixels_mut(&mut self) -> &mut [u32] {
        &mut self.pixels
    }

    /// Copies those of a tile's `pixels`, row by row, that lie in `wanted` and in the frame.
    pub fn copy_from(&mut self, tile: Region, pixels: &[u32], wanted: Region) {
        let own = Region::of_size([self.width, self.height]);
        self.copy(own, tile, pixels, tile.intersection(wanted).intersection(own));
    }

    /// Copies those of a tile's `pixels`, row by row, that this part of a larger frame has, which begins at `corner` of that.
    pub fn copy_part(&mut self, [x, y]: [u32; 2], tile: Region, pixels: &[u32]) {
        let own = Region {
            x,
            y,
            width: self.width,
            height: self.height,
        };
        self.copy(own, tile, pixels, tile.intersection(own));
    }

    /// Copies the pixels of `shown` from a tile to the frame, which has those of `own`: `shown` lies in both.
    fn copy(&mut self, own: Region, tile: Region, pixels: &[u32], shown: Region) {
        if shown.is_empty() {
            return;
        }
        let (width, length) = (self.width as usize, shown.width as usize);
        let left = (shown.x - tile.x) as usize;
        let rows = pixels.chunks_exact(tile.width as usize);
        let start = (shown.y - own.y) as usize * width + (shown.x - own.x) as usize;
        let targets = self.pixels[start..].chunks_mut(width);
        for (row, target) in rows
            .skip((shown.y - tile.y) as usize)
            .take(shown.height as usize)
            .zip(targets)
        {
            target[..length].copy_from_slice(&row[left..left + length]);
        }
    }

    /// The pixels of `region`, as far as the frame has them.
    #[must_use]
    pub fn cut(&self, region: Region) -> Self {
        let whole = Region::of_size([self.width, self.height]);
        let region = region.intersection(whole);
        if region.is_empty() {
            return Self::default();
        }
        let Region { x, y, width, height } = region;
        let rows = self.pixels.chunks_exact(self.width as usize);
        let (left, right) = (x as usize, x as usize + width as usize);
        let rows = rows.skip(y as usize).take(height as usize);
        Self {
            width,
            height,
            pixels: rows.flat_map(|row| &row[left..right]).copied().collect(),
        }
    }

    /// The pixel in column `x` of row `y` as straight `[r, g, b, a]`, or `None` outside the frame.
    pub fn rgba(&self, x: u32, y: u32) -> Option<[u8; 4]> {
        if x >= self.width || y >= self.height {
            return None;
        }
        let [a, r, g, b] = self.pixels[y as usize * self.width as usize + x as usize].to_be_bytes();
        Some([r, g, b, a])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cut_has_the_pixels_of_its_region() {
        let mut frame = Framebuffer::new(4, 3);
        for (number, pixel) in (0..).zip(frame.pixels_mut()) {
            *pixel = number;
        }
        let region = |x, y, width, height| Region { x, y, width, height };
        let cut = frame.cut(region(1, 1, 2, 2));
        assert_eq!([cut.width(), cut.height()], [2, 2], "its size");
        assert_eq!(cut.pixels(), [5, 6, 9, 10], "its pixels");
        assert_eq!(
            frame.cut(region(3, 2, 9, 9)).pixels(),
            [11],
            "what lies outside is left out"
        );
        assert!(frame.cut(region(9, 0, 2, 2)).pixels().is_empty(), "all of it");
    }

    #[test]
    fn part_of_a_frame_takes_its_own_pixels_of_a_tile() {
        let tile = Region {
            x: 4,
            y: 8,
            width: 4,
            height: 2,
        };
        let pixels: Vec<u32> = (1..=8).collect();
        for (corner, expected) in [
            ([3, 7], [0, 0, 0, 0, 1, 2]),
            ([6, 9], [7, 8, 0, 0, 0, 0]),
            ([5, 8], [2, 3, 4, 6, 7, 8]),
            ([8, 8], [0; 6]),
            ([4, 10], [0; 6]),
        ] {
            let mut part = Framebuffer::new(3, 2);
            part.copy_part(corner, tile, &pixels);
            assert_eq!(part.pixels(), expected, "{corner:?}");
        }
    }
}
