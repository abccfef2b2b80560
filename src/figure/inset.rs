//! An inset: a small region of a frame, each pixel magnified by a whole number.
//!
//! Every source pixel is an exact block of `magnification x magnification` pixels of its colour. Grid lines run
//! between the blocks, never over them; only the sample marks of the centre pixel lie inside its block.
//!
//! ```text
//!  margin  grid block grid block grid  margin
//! |  M   |  1 |  m  | 1 |  m  | 1 |  M   |
//! ```

use super::PixelRect;
use crate::raster::Framebuffer;

/// Pixels around the grid: border, and the ticks that point at the centre pixel.
const MARGIN: u32 = 7;
/// Depth of the border's line.
const BORDER: u32 = 2;

const BORDER_COLOR: u32 = 0xff20_2428;
const MARGIN_COLOR: u32 = 0xfff4_f4f2;
const GRID_COLOR: u32 = 0xff80_8488;
const CENTER_COLOR: u32 = 0xffff_3b30;
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
}

/// One sample of the centre pixel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SampleMark {
    /// Where in the pixel, each coordinate in `0.0..=1.0`.
    pub at: [f64; 2],
    /// The sample's colour, straight `[r, g, b, a]`.
    pub color: [u8; 4],
    /// Whether a primitive covers it.
    pub covered: bool,
}

impl Inset {
    /// Fewest and most source pixels along each side.
    pub const REGION: std::ops::RangeInclusive<u32> = 8..=64;
    /// Smallest and largest magnification.
    pub const MAGNIFICATION: std::ops::RangeInclusive<u32> = 2..=96;

    /// The inset with its numbers brought into their ranges.
    pub fn new(center: [i64; 2], region: u32, magnification: u32) -> Self {
        Self {
            center,
            region: region.clamp(*Self::REGION.start(), *Self::REGION.end()),
            magnification: magnification.clamp(*Self::MAGNIFICATION.start(), *Self::MAGNIFICATION.end()),
        }
    }

    /// Pixels along each side of the inset's picture.
    pub fn side(&self) -> u32 {
        2 * MARGIN + self.region * self.pitch() + 1
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
    /// pixel after it; margins show none.
    pub fn pixel_at(&self, [x, y]: [i64; 2]) -> Option<[i64; 2]> {
        let source = self.source();
        let index = |position: i64| {
            let index = (position - i64::from(MARGIN)).div_euclid(i64::from(self.pitch()));
            (0..i64::from(self.region)).contains(&index).then_some(index)
        };
        Some([source.x + index(x)?, source.y + index(y)?])
    }

    /// Draws the inset: `frame`'s pixels over white, and `samples` as dots on the centre pixel.
    pub fn draw(&self, frame: &Framebuffer, samples: &[SampleMark]) -> Framebuffer {
        let side = self.side();
        let mut picture = Framebuffer::new(side, side);
        let all = PixelRect::of_size([side, side]);
        fill(&mut picture, &all, BORDER_COLOR);
        fill(&mut picture, &inner(&all, BORDER), MARGIN_COLOR);
        fill(&mut picture, &inner(&all, MARGIN), GRID_COLOR);
        let source = self.source();
        for y in source.y..source.bottom() {
            for x in source.x..source.right() {
                self.draw_pixel(frame, [x, y], &mut picture);
            }
        }
        self.mark_center(&mut picture, samples);
        picture
    }

    /// One magnified pixel, or hatching where the frame has none.
    fn draw_pixel(&self, frame: &Framebuffer, pixel: [i64; 2], picture: &mut Framebuffer) {
        let Some(block) = self.block(pixel) else { return };
        let inside = (u32::try_from(pixel[0]).ok()).zip(u32::try_from(pixel[1]).ok());
        if let Some(rgba) = inside.and_then(|(x, y)| frame.rgba(x, y)) {
            fill(picture, &block, over_white(rgba));
            return;
        }
        let width = picture.width() as usize;
        for_each_index(&block, width, |index| {
            let stripe = (index % width + index / width) / 4 % 2;
            picture.pixels_mut()[index] = OUTSIDE_COLORS[stripe];
        });
    }

    /// The frame around the centre pixel, the ticks that point at it from all sides, and its samples.
    fn mark_center(&self, picture: &mut Framebuffer, samples: &[SampleMark]) {
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
        for sample in samples {
            self.draw_sample(&block, sample, samples.len(), picture);
        }
    }

    /// A disc of the sample's colour where a primitive covers it, a square where none does, ringed so that it stands
    /// out. Marks are left out where they would run into each other.
    fn draw_sample(&self, block: &PixelRect, sample: &SampleMark, count: usize, picture: &mut Framebuffer) {
        let per_side = (count as f64).sqrt().ceil();
        let spacing = f64::from(self.magnification) / per_side;
        let radius = (spacing * 0.3).min(6.0);
        if radius < 1.0 {
            return;
        }
        let [x, y] = sample.at.map(|part| part * f64::from(self.magnification));
        let width = picture.width() as usize;
        let ring = if is_dark(sample.color) {
            0xffff_ffff
        } else {
            0xff00_0000
        };
        for_each_index(block, width, |index| {
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
}

/// `rect` without `depth` pixels on every side.
fn inner(rect: &PixelRect, depth: u32) -> PixelRect {
    PixelRect {
        x: rect.x + i64::from(depth),
        y: rect.y + i64::from(depth),
        width: rect.width.saturating_sub(2 * depth),
        height: rect.height.saturating_sub(2 * depth),
    }
}

/// `rect` with one pixel more on every side.
fn outer(rect: &PixelRect) -> PixelRect {
    PixelRect {
        x: rect.x - 1,
        y: rect.y - 1,
        width: rect.width + 2,
        height: rect.height + 2,
    }
}

fn fill(picture: &mut Framebuffer, rect: &PixelRect, color: u32) {
    let width = picture.width() as usize;
    for_each_index(rect, width, |index| picture.pixels_mut()[index] = color);
}

/// Calls `visit` with the index of every pixel of `rect`, which lies inside a picture of this `width`.
fn for_each_index(rect: &PixelRect, width: usize, mut visit: impl FnMut(usize)) {
    for y in rect.y..rect.bottom() {
        for x in rect.x..rect.right() {
            if let (Ok(x), Ok(y)) = (usize::try_from(x), usize::try_from(y)) {
                visit(y * width + x);
            }
        }
    }
}

/// Whether white reads better than black on this straight colour over white.
pub fn is_dark([r, g, b, a]: [u8; 4]) -> bool {
    let luma = 0.299 * f32::from(r) + 0.587 * f32::from(g) + 0.114 * f32::from(b);
    let opacity = f32::from(a) / 255.0;
    luma * opacity + 255.0 * (1.0 - opacity) < 140.0
}

/// A straight colour over white, as opaque `0xAARRGGBB`.
fn over_white([r, g, b, a]: [u8; 4]) -> u32 {
    let alpha = u32::from(a);
    let mix = |channel: u8| (u32::from(channel) * alpha + 255 * (255 - alpha) + 127) / 255;
    0xff00_0000 | mix(r) << 16 | mix(g) << 8 | mix(b)
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
            assert_eq!(picture.width(), inset.side(), "the promised size");
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
    fn inset_marks_samples_inside_the_centre_block_only() {
        let frame = colorful(40, 30);
        let inset = Inset::new([20, 15], 9, 24);
        let plain = inset.draw(&frame, &[]);
        let marks = [0.25, 0.75].map(|x| SampleMark {
            at: [x, 0.5],
            color: [9, 8, 7, 255],
            covered: true,
        });
        let marked = inset.draw(&frame, &marks);
        let block = inset.block([20, 15]).expect("the centre is shown");
        let mut changed = 0;
        for (index, (before, after)) in plain.pixels().iter().zip(marked.pixels()).enumerate() {
            let at = position(index, plain.width());
            assert!(
                before == after || block.contains(at),
                "{at:?} lies outside the centre pixel"
            );
            changed += usize::from(before != after);
        }
        assert!(changed > 50, "the dots are to be seen: {changed} pixels");
    }

    #[test]
    fn inset_numbers_stay_in_range() {
        let inset = Inset::new([0, 0], 1000, 0);
        assert_eq!((inset.region, inset.magnification), (64, 2), "clamped");
        assert_eq!(inset.pixel_at([0, 0]), None, "the margin shows no pixel");
    }
}
