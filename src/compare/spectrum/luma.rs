//! The luma of a rectangle of pixels or texels, as numbers.

use crate::compare::ProfileChannel;
use crate::raster::{Framebuffer, Region};
use crate::texture::MipLevel;

/// Luma in levels of 0 to 255 (ITU-R BT.601, as [`ProfileChannel::Luma`] has it), or a difference of two, row by row.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct LumaPlane {
    /// Columns and rows.
    pub(super) size: [u32; 2],
    pub(super) values: Vec<f32>,
}

impl LumaPlane {
    /// That of the pixels of `region`, which lies in the frame.
    pub(super) fn of_frame(frame: &Framebuffer, region: Region) -> Self {
        let width = frame.width() as usize;
        let columns = region.x as usize..region.right() as usize;
        let rows = (region.y as usize..region.bottom() as usize).map(|y| y * width);
        let pixels = rows.flat_map(|start| frame.pixels()[start..][columns.clone()].iter().copied());
        Self {
            size: [region.width, region.height],
            values: pixels.map(luma).collect(),
        }
    }

    /// That of the texels of `region`, on white paper.
    pub(super) fn of_level(level: &MipLevel, region: Region) -> Self {
        let places = (region.y..region.bottom()).flat_map(|y| (region.x..region.right()).map(move |x| (x, y)));
        let texel = |(x, y): (u32, u32)| {
            let [r, g, b, a] = level.texel(x.cast_signed(), y.cast_signed());
            // Premultiplied: white fills what is left.
            let over = |channel: u8| channel.saturating_add(255 - a);
            luma(u32::from_be_bytes([255, over(r), over(g), over(b)]))
        };
        Self {
            size: [region.width, region.height],
            values: places.map(texel).collect(),
        }
    }

    /// The number that all of them are; `None` where they differ.
    pub(super) fn constant(&self) -> Option<f32> {
        let (first, rest) = self.values.split_first()?;
        // Bit for bit: what differs at all has waves.
        let is_first = |value: &f32| value.total_cmp(first).is_eq();
        rest.iter().all(is_first).then_some(*first)
    }

    /// What is left of it without `other`, which has its size.
    pub(super) fn minus(mut self, other: &Self) -> Self {
        for (value, other) in self.values.iter_mut().zip(&other.values) {
            *value -= other;
        }
        self
    }
}

/// That of a pixel.
#[expect(clippy::cast_possible_truncation, reason = "from 0 to 255")]
pub(super) fn luma(pixel: u32) -> f32 {
    ProfileChannel::Luma.value(pixel) as f32
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn planes_are_of_their_region() {
        let mut frame = Framebuffer::new(4, 3);
        for (i, pixel) in (0_u32..).zip(frame.pixels_mut()) {
            *pixel = 0xff00_0000 | (i * 0x0001_0101);
        }
        let region = Region {
            x: 1,
            y: 1,
            width: 2,
            height: 2,
        };
        let plane = LumaPlane::of_frame(&frame, region);
        let near = |found: &[f32], expected: [f32; 4]| {
            let off = found
                .iter()
                .zip(expected)
                .map(|(found, expected)| (found - expected).abs());
            assert!(off.fold(0.0, f32::max) < 1e-4, "{found:?} for {expected:?}");
        };
        near(&plane.values, [5.0, 6.0, 9.0, 10.0]);
        let level = MipLevel::new(2, 2, vec![[0, 0, 0, 0], [0, 0, 0, 255], [9, 9, 9, 255], [0, 0, 0, 127]]);
        let texels = LumaPlane::of_level(&level, Region::of_size([2, 2]));
        near(&texels.values, [255.0, 0.0, 9.0, 128.0]);
        assert_eq!(plane.constant(), None, "several values");
        let nothing = plane.clone().minus(&plane);
        assert_eq!(nothing.constant(), Some(0.0), "nothing is left");
        near(&texels.minus(&plane).values, [250.0, -6.0, 0.0, 118.0]);
    }
}
