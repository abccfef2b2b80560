//! The retained picture of the interface: premultiplied pixels, and per row the part that holds any.
//!
//! The interface changes far less often than the picture below it, so it is painted here once and laid over every
//! frame. Knowing each row's used part makes the transparent middle of the window free.

use super::pixel;

/// A rectangle of whole pixels, right and bottom exclusive.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct CanvasRect {
    /// First column.
    pub left: u32,
    /// First row.
    pub top: u32,
    /// Column after the last.
    pub right: u32,
    /// Row after the last.
    pub bottom: u32,
}

impl CanvasRect {
    /// Holds no pixel; joined with another it gives the other.
    pub const EMPTY: Self = Self {
        left: u32::MAX,
        top: u32::MAX,
        right: 0,
        bottom: 0,
    };

    /// Everything from the origin to `width` x `height`.
    pub const fn of_size(width: u32, height: u32) -> Self {
        Self {
            left: 0,
            top: 0,
            right: width,
            bottom: height,
        }
    }

    /// Whether it holds no pixel.
    pub const fn is_empty(self) -> bool {
        self.left >= self.right || self.top >= self.bottom
    }

    /// What both hold.
    #[must_use]
    pub fn intersect(self, other: Self) -> Self {
        Self {
            left: self.left.max(other.left),
            top: self.top.max(other.top),
            right: self.right.min(other.right),
            bottom: self.bottom.min(other.bottom),
        }
    }

    /// The smallest rectangle around both.
    #[must_use]
    pub fn join(self, other: Self) -> Self {
        if self.is_empty() {
            return other;
        }
        if other.is_empty() {
            return self;
        }
        Self {
            left: self.left.min(other.left),
            top: self.top.min(other.top),
            right: self.right.max(other.right),
            bottom: self.bottom.max(other.bottom),
        }
    }
}

/// Premultiplied pixels, `0xAARRGGBB`, rows from the top.
#[derive(Clone, Debug, Default)]
pub struct Canvas {
    width: u32,
    height: u32,
    pixels: Vec<u32>,
    /// Per row: columns outside `first..end` are transparent.
    used: Vec<[u32; 2]>,
}

/// A row without any pixel.
const UNUSED: [u32; 2] = [u32::MAX, 0];

impl Canvas {
    /// All transparent.
    pub fn new(width: u32, height: u32) -> Self {
        Self {
            width,
            height,
            pixels: vec![0; width as usize * height as usize],
            used: vec![UNUSED; height as usize],
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

    /// All pixels, row by row.
    pub fn pixels(&self) -> &[u32] {
        &self.pixels
    }

    /// Makes `area` transparent.
    pub fn clear(&mut self, area: CanvasRect) {
        let area = area.intersect(CanvasRect::of_size(self.width, self.height));
        if area.is_empty() {
            return;
        }
        for y in area.top..area.bottom {
            let start = y as usize * self.width as usize;
            self.pixels[start + area.left as usize..start + area.right as usize].fill(0);
            let [first, end] = &mut self.used[y as usize];
            // What is left of the used part, where that is one piece.
            match (area.left <= *first, area.right >= *end) {
                (true, true) => [*first, *end] = UNUSED,
                (true, false) => *first = area.right.max(*first),
                (false, true) => *end = area.left.min(*end),
                (false, false) => {}
            }
        }
    }

    /// The pixels `first..end` of row `y` for painting. The caller keeps inside the canvas.
    pub(super) fn span_mut(&mut self, y: u32, first: u32, end: u32) -> &mut [u32] {
        let used = &mut self.used[y as usize];
        used[0] = used[0].min(first);
        used[1] = used[1].max(end);
        let start = y as usize * self.width as usize;
        &mut self.pixels[start + first as usize..start + end as usize]
    }

    /// Lays the canvas over opaque pixels of the same size. Their top byte is of no interest and left as it falls.
    pub fn lay_over(&self, below: &mut [u32]) {
        self.lay_part_over(CanvasRect::of_size(self.width, self.height), below);
    }

    /// As [`Canvas::lay_over`], but only over the pixels of `area`.
    pub fn lay_part_over(&self, area: CanvasRect, below: &mut [u32]) {
        let area = area.intersect(CanvasRect::of_size(self.width, self.height));
        if area.is_empty() {
            return;
        }
        let width = self.width as usize;
        let rows = below.chunks_exact_mut(width).zip(self.pixels.chunks_exact(width));
        let rows = rows.zip(&self.used).skip(area.top as usize);
        for ((below, row), &[first, end]) in rows.take((area.bottom - area.top) as usize) {
            let (first, end) = (first.max(area.left), end.min(area.right));
            if first < end {
                let used = first as usize..end as usize;
                pixel::fill_from(&mut below[used.clone()], &row[used]);
            }
        }
    }
}
