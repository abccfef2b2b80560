//! An inset: a small region of a frame, each pixel magnified by a whole number.
//!
//! Every source pixel is an exact block of `magnification x magnification` pixels of its colour. Grid lines run
//! between the blocks, never over them. Below the grid the centre pixel stands once more, large, with its samples, and
//! beside it there is room for words. An inset too small for that marks the samples on the centre pixel's own block.
//!
//! ```text
//!  margin  grid block grid block grid  margin
//! |  M   |  1 |  m  | 1 |  m  | 1 |  M   |
//! ```

use super::PixelRect;
use super::paint::{fill, for_each_index, inner, outer, over_white};
use super::samples::{SampleMark, draw_samples};
use crate::raster::Framebuffer;

/// Pixels around the grid: border, and the ticks that point at the centre pixel.
const MARGIN: u32 = 7;
/// Side of the centre pixel below the grid.
const DETAIL: u32 = 88;
/// Insets narrower than this have no room for it.
const WIDTH_FOR_DETAIL: u32 = 200;
/// Depth of the border's line.
const BORDER: u32 = 2;

const BORDER_COLOR: u32 = 0xff20_2428;
const MARGIN_COLOR: u32 = 0xfff4_f4f2;
const GRID_COLOR: u32 = 0xff80_8488;
pub(super) const CENTER_COLOR: u32 = 0xffff_3b30;
/// The two colours of the hatching outside the frame.
const OUTSIDE_COLORS: [u32; 2] = [0xffb8_bcc0, 0xffd0_d4d8];

/// Which pixels an inset shows, and how large.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Inset {
    /// The pixel in the middle, in frame pixels; it is the one that is marked.
    pub center: [i64; 2],
    /// Source pixels along each side.
    pub region: u32,
    /// Pixels along each side of a magnified pixel.
    pub magnification: u32,
    /// Whether the centre pixel stands large below the grid.
    has_detail: bool,
}

impl Inset {
    /// Fewest and most source pixels along each side.
    pub const REGION: std::ops::RangeInclusive<u32> = 8..=64;
    /// Smallest and largest magnification.
    pub const MAGNIFICATION: std::ops::RangeInclusive<u32> = 2..=96;

    /// The inset with its numbers brought into their ranges.
    pub fn new(center: [i64; 2], region: u32, magnification: u32) -> Self {
        let inset = Self {
            center,
            region: region.clamp(*Self::REGION.start(), *Self::REGION.end()),
            magnification: magnification.clamp(*Self::MAGNIFICATION.start(), *Self::MAGNIFICATION.end()),
            has_detail: false,
        };
        Self {
            has_detail: inset.grid_side() >= WIDTH_FOR_DETAIL,
            ..inset
        }
    }

    /// The same without the large centre pixel: where there is no room for it.
    #[must_use]
    pub fn without_detail(self) -> Self {
        Self {
            has_detail: false,
            ..self
        }
    }

    /// Width and height of the inset's picture.
    pub fn size(&self) -> [u32; 2] {
        let side = self.grid_side();
        let below = if self.has_detail { DETAIL + MARGIN } else { 0 };
        [side, side + below]
    }

    /// The grid with its margins.
    fn grid_side(&self) -> u32 {
        2 * MARGIN + self.region * self.pitch() + 1
    }

    /// Whether the centre pixel stands large below the grid.
    pub fn has_detail(&self) -> bool {
        self.has_detail
    }

    /// Where the centre pixel stands large, relative to the inset's upper left corner.
    pub fn detail(&self) -> Option<PixelRect> {
        self.has_detail.then(|| PixelRect {
            x: i64::from(MARGIN),
            y: i64::from(self.grid_side()),
            width: DETAIL,
            height: DETAIL,
        })
    }

    /// Where there is room for words about the centre pixel, relative to the inset's upper left corner. The ground is
    /// light in every theme.
    pub fn text_area(&self) -> Option<PixelRect> {
        let detail = self.detail()?;
        let x = detail.right() + i64::from(MARGIN);
        let right = i64::from(self.grid_side() - MARGIN);
        Some(PixelRect {
            x,
            width: u32::try_from(right - x).ok()?,
            ..detail
        })
    }

    /// From one block to the next.
    fn pitch(&self) -> u32 {
        self.magnification + 1
    }

    /// The source pixels shown; they may lie outside the frame.
    pub fn source(&self) -> PixelRect {
        let before = i64::from(self.region / 2);
        PixelRect {
            x: self.center[0] - before,
            y: self.center[1] - before,
            width: self.region,
            height: self.region,
        }
    }

    /// The block of a source pixel, relative to the inset's upper left corner; `None` if it is not shown.
    pub fn block(&self, pixel: [i64; 2]) -> Option<PixelRect> {
        let source = self.source();
        if !source.contains(pixel) {
            return None;
        }
        let start = |index: i64| i64::from(MARGIN) + 1 + index * i64::from(self.pitch());
        Some(PixelRect {
            x: start(pixel[0] - source.x),
            y: start(pixel[1] - source.y),
            width: self.magnification,
            height: self.magnification,
        })
    }

    /// The source pixel shown at a position relative to the inset's upper left corner. A grid line counts for the
    /// pixel after it; the large pixel below counts for the centre; margins show none.
    pub fn pixel_at(&self, [x, y]: [i64; 2]) -> Option<[i64; 2]> {
        if self.detail().is_some_and(|detail| detail.contains([x, y])) {
            return Some(self.center);
        }
        let source = self.source();
        let index = |position: i64| {
            let index = (position - i64::from(MARGIN)).div_euclid(i64::from(self.pitch()));
            (0..i64::from(self.region)).contains(&index).then_some(index)
        };
        Some([source.x + index(x)?, source.y + index(y)?])
    }

    /// Draws the inset: `frame`'s pixels over white, and `samples` on the centre pixel.
    pub fn draw(&self, frame: &Framebuffer, samples: &[SampleMark]) -> Framebuffer {
        self.draw_pixels(&|x, y| frame.rgba(x, y), samples)
    }

    /// As [`Inset::draw`], from the pixels that `rgba` knows: straight `[r, g, b, a]`. The others are hatched.
    pub fn draw_pixels(&self, rgba: &dyn Fn(u32, u32) -> Option<[u8; 4]>, samples: &[SampleMark]) -> Framebuffer {
        let [width, height] = self.size();
        let mut picture = Framebuffer::new(width, height);
        let all = PixelRect::of_size([width, height]);
        let grid = PixelRect::of_size([self.grid_side(); 2]);
        fill(&mut picture, &all, BORDER_COLOR);
        fill(&mut picture, &inner(&all, BORDER), MARGIN_COLOR);
        fill(&mut picture, &inner(&grid, MARGIN), GRID_COLOR);
        let source = self.source();
        for y in source.y..source.bottom() {
            for x in source.x..source.right() {
                if let Some(block) = self.block([x, y]) {
                    Self::draw_pixel(rgba, [x, y], &block, &mut picture);
                }
            }
        }
        self.mark_center(&mut picture);
        if let Some(detail) = self.detail() {
            fill(&mut picture, &detail, CENTER_COLOR);
            Self::draw_pixel(rgba, self.center, &inner(&detail, 1), &mut picture);
            draw_samples(&inner(&detail, 1), samples, &mut picture);
        } else if let Some(block) = self.block(self.center) {
            draw_samples(&block, samples, &mut picture);
        }
        picture
    }

    /// One magnified pixel, or hatching where there is none.
    fn draw_pixel(
        rgba: &dyn Fn(u32, u32) -> Option<[u8; 4]>,
        pixel: [i64; 2],
        block: &PixelRect,
        picture: &mut Framebuffer,
    ) {
        let inside = (u32::try_from(pixel[0]).ok()).zip(u32::try_from(pixel[1]).ok());
        if let Some(rgba) = inside.and_then(|(x, y)| rgba(x, y)) {
            fill(picture, block, over_white(rgba));
            return;
        }
        let width = picture.width() as usize;
        for_each_index(block, width, |index| {
            let stripe = (index % width + index / width) / 4 % 2;
            picture.pixels_mut()[index] = OUTSIDE_COLORS[stripe];
        });
    }

    /// The frame around the centre pixel, and the ticks that point at it from all sides.
    fn mark_center(&self, picture: &mut Framebuffer) {
        let Some(block) = self.block(self.center) else { return };
        let ring = outer(&block);
        let edges = [
            PixelRect { height: 1, ..ring },
            PixelRect {
                y: ring.bottom() - 1,
                height: 1,
                ..ring
            },
            PixelRect { width: 1, ..ring },
            PixelRect {
                x: ring.right() - 1,
                width: 1,
                ..ring
            },
        ];
        let side = i64::from(picture.width());
        let (depth, far) = (MARGIN - BORDER, side - i64::from(MARGIN));
        let near = i64::from(BORDER);
        let ticks = [
            PixelRect {
                y: near,
                height: depth,
                ..ring
            },
            PixelRect {
                y: far,
                height: depth,
                ..ring
            },
            PixelRect {
                x: near,
                width: depth,
                ..ring
            },
            PixelRect {
                x: far,
                width: depth,
                ..ring
            },
        ];
        for rect in edges.iter().chain(&ticks) {
            fill(picture, rect, CENTER_COLOR);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A frame whose every pixel has a colour of its own.
    fn colorful(width: u32, height: u32) -> Framebuffer {
        let mut frame = Framebuffer::new(width, height);
        for (i, pixel) in (1_u32..).zip(frame.pixels_mut()) {
            *pixel = 0xff00_0000 | i.wrapping_mul(2_654_435_761) >> 8;
        }
        frame
    }

    fn position(index: usize, width: u32) -> [i64; 2] {
        let width = width as usize;
        [index % width, index / width].map(|n| i64::try_from(n).expect("a small picture"))
    }

    #[test]
    fn inset_shows_every_pixel_as_an_exact_block() {
        let frame = colorful(40, 30);
        for (center, region, magnification) in [([20, 15], 8, 2), ([0, 0], 9, 5), ([39, 29], 64, 3), ([5, 8], 16, 16)] {
            let inset = Inset::new(center, region, magnification);
            let picture = inset.draw(&frame, &[]);
            assert_eq!([picture.width(), picture.height()], inset.size(), "the promised size");
            for y in 0..30_u32 {
                for x in 0..40_u32 {
                    let Some(block) = inset.block([x.into(), y.into()]) else {
                        continue;
                    };
                    for_each_index(&block, picture.width() as usize, |index| {
                        let source = frame.pixels()[(y * 40 + x) as usize];
                        assert_eq!(picture.pixels()[index], source, "pixel {x},{y} of {inset:?}");
                        let back = inset.pixel_at(position(index, picture.width()));
                        assert_eq!(back, Some([x.into(), y.into()]), "and back");
                    });
                }
            }
        }
    }

    #[test]
    fn inset_marks_samples_in_their_place_only() {
        let frame = colorful(40, 30);
        let marks = [0.25, 0.75].map(|x| SampleMark {
            at: [x, 0.5],
            color: [9, 8, 7, 255],
            covered: true,
        });
        for (region, magnification) in [(9, 24), (8, 20)] {
            let inset = Inset::new([20, 15], region, magnification);
            let (plain, marked) = (inset.draw(&frame, &[]), inset.draw(&frame, &marks));
            let place = inset.detail().or(inset.block([20, 15])).expect("the centre is shown");
            let mut changed = 0;
            for (index, (before, after)) in plain.pixels().iter().zip(marked.pixels()).enumerate() {
                let at = position(index, plain.width());
                assert!(before == after || place.contains(at), "{at:?} lies outside {place:?}");
                changed += usize::from(before != after);
            }
            assert!(changed > 50, "the dots are to be seen: {changed} pixels");
        }
    }

    #[test]
    fn inset_shows_the_centre_large_where_there_is_room() {
        let frame = colorful(40, 30);
        let inset = Inset::new([20, 15], 15, 20);
        let picture = inset.draw(&frame, &[]);
        let detail = inset.detail().expect("there is room");
        for_each_index(&inner(&detail, 1), picture.width() as usize, |index| {
            assert_eq!(picture.pixels()[index], frame.pixels()[15 * 40 + 20], "its colour");
        });
        assert_eq!(inset.pixel_at([detail.x, detail.y]), Some([20, 15]), "it can be read");
        let text = inset.text_area().expect("beside it");
        let all = PixelRect::of_size(inset.size());
        assert!(!text.overlaps(&detail) && text.intersection(&all) == text, "{text:?}");
        assert_eq!(inset.pixel_at([text.x, text.y]), None, "words are no pixels");
        assert!(Inset::new([0, 0], 8, 4).detail().is_none(), "too small");
    }

    #[test]
    fn inset_numbers_stay_in_range() {
        let inset = Inset::new([0, 0], 1000, 0);
        assert_eq!((inset.region, inset.magnification), (64, 2), "clamped");
        assert_eq!(inset.pixel_at([0, 0]), None, "the margin shows no pixel");
    }
}
