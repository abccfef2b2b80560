//! The part of a frame that one tile is painted into.

use std::ops::Range;

use fearless_simd::{Simd, dispatch};

use crate::raster::coverage::mask8x8::CoverageMask;
use crate::raster::span::{Span, SpanRect};
use crate::simd;

/// So many pixels of a stamp are set one by one.
const FEW: u32 = 16;

/// A rectangle of a frame's pixels.
#[derive(Debug)]
pub(crate) struct PixelBlock<'p> {
    /// Which pixels of the frame these are.
    pub(crate) rect: SpanRect,
    /// From the first pixel of the rectangle on.
    pixels: &'p mut [u32],
    /// Distance between two rows.
    stride: usize,
    /// What all of its pixels are, as long as nothing was painted.
    shown: Option<u32>,
}

/// Gives all pixels one value.
pub(crate) fn fill(pixels: &mut [u32], pixel: u32) {
    const WHITE: u32 = u32::MAX;
    if pixel == WHITE {
        // Of equal bytes, which processors write without reading what they overwrite.
        pixels.fill(WHITE);
        return;
    }
    dispatch!(simd::level(), simd => simd.vectorize(
        #[inline(always)]
        || pixels.fill(pixel),
    ));
}

impl<'p> PixelBlock<'p> {
    /// The rectangle `rect` of a frame; `pixels` begins with its first pixel, and its rows lie `stride` apart.
    pub(crate) fn new(rect: SpanRect, pixels: &'p mut [u32], stride: usize) -> Self {
        Self {
            rect,
            pixels,
            stride,
            shown: None,
        }
    }

    /// The same, all pixels of which are `shown` already.
    pub(crate) fn showing(self, shown: Option<u32>) -> Self {
        Self { shown, ..self }
    }

    /// The rectangle `rect` of a frame; `pixels` are rows of the frame, the rectangle's first one and more, and `stride`
    /// wide.
    pub(crate) fn in_rows(rect: SpanRect, pixels: &'p mut [u32], stride: usize) -> Self {
        let left = usize::try_from(rect.x.start).unwrap_or(0);
        Self::new(rect, &mut pixels[left..], stride)
    }

    /// The pixels of row `y` of the frame.
    #[inline]
    pub(crate) fn line(&mut self, y: i32) -> &mut [u32] {
        self.span(y, self.rect.x)
    }

    /// The pixels `xs` of row `y` of the frame, which must lie in the rectangle.
    #[inline]
    pub(crate) fn span(&mut self, y: i32, xs: Span) -> &mut [u32] {
        let length = |from: i32, to: i32| usize::try_from(to - from).unwrap_or(0);
        let start = length(self.rect.y.start, y) * self.stride + length(self.rect.x.start, xs.start);
        &mut self.pixels[start..][..length(xs.start, xs.end)]
    }

    /// Sets the pixel in column `x` and row `y` of the rectangle.
    #[inline]
    pub(crate) fn put(&mut self, [x, y]: [u16; 2], value: u32) {
        self.pixels[usize::from(y) * self.stride + usize::from(x)] = value;
    }

    /// The pixels of some columns of row `y` of the rectangle.
    #[inline]
    pub(crate) fn run(&mut self, y: u16, columns: Range<u16>) -> &mut [u32] {
        let row = usize::from(y) * self.stride;
        &mut self.pixels[row + usize::from(columns.start)..row + usize::from(columns.end)]
    }

    /// Sets the pixels of a stamp, counted from the rectangle's first.
    #[inline]
    pub(crate) fn stamp(&mut self, mut stamp: CoverageMask, pixel: u32) {
        let place = |index: i32| usize::try_from(index).unwrap_or(0);
        let origin = place(stamp.row) * self.stride + place(stamp.column);
        // Most stamps have a few bits, for which runs would be more work.
        if stamp.mask.count_ones() <= FEW {
            while stamp.mask != 0 {
                let bit = stamp.mask.trailing_zeros() as usize;
                self.pixels[origin + bit / 8 * self.stride + bit % 8] = pixel;
                stamp.mask &= stamp.mask - 1;
            }
            return;
        }
        let SpanRect { x, y } = self.rect;
        let stamp = stamp.moved(x.start, y.start);
        stamp.each_run(|y, xs| self.span(y, xs).fill(pixel));
    }

    /// Changes every pixel.
    pub(crate) fn map(&mut self, change: impl Fn(u32) -> u32) {
        for y in self.rect.y.start..self.rect.y.end {
            for pixel in self.line(y) {
                *pixel = change(*pixel);
            }
        }
    }

    /// Gives all pixels one value, before anything else is painted.
    pub(crate) fn fill(&mut self, pixel: u32) {
        if self.shown.take() == Some(pixel) {
            return;
        }
        dispatch!(simd::level(), simd => simd.vectorize(
            #[inline(always)]
            || {
                for y in self.rect.y.start..self.rect.y.end {
                    self.line(y).fill(pixel);
                }
            },
        ));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn stamps_set_the_pixels_of_their_bits() {
        const WIDTH: usize = 20;
        let span = |start: i32, end: i32| Span { start, end };
        let rect = SpanRect {
            x: span(100, 120),
            y: span(50, 62),
        };
        arbtest::arbtest(|u| {
            let (column, row) = (u.int_in_range(0..=12)?, u.int_in_range(0..=4)?);
            // With few bits and with many.
            let mask: u64 = u.arbitrary::<u64>()? & *u.choose(&[u64::MAX, 0x0303, 0x0408_0010_2000_0101])?;
            let mut pixels = vec![0; WIDTH * 12];
            let coverage = CoverageMask { column, row, mask };
            PixelBlock::new(rect, &mut pixels, WIDTH).stamp(coverage, 7);
            for (i, pixel) in (0_i32..).zip(&pixels) {
                let (x, y) = (i % 20 - column, i / 20 - row);
                let inside = (0..8).contains(&x) && (0..8).contains(&y) && mask >> (8 * y + x) & 1 == 1;
                assert_eq!(*pixel, if inside { 7 } else { 0 }, "{coverage:?}: {x}, {y}");
            }
            Ok(())
        })
        .budget_ms(200);
    }
}
