//! Which sides of pixels are edges: where luma differs, unless something beside differs much more.

use rayon::prelude::*;

/// The edge between a pixel and the one on its left.
pub(super) const LEFT: u8 = 1;
/// The edge between a pixel and the one above it.
pub(super) const TOP: u8 = 2;

/// The least difference of luma that is an edge, `0.0..=1.0`.
pub const THRESHOLD: f64 = 0.1;
/// An edge is dropped where luma differs by more than this many times as much beside it: the eye sees that one only.
pub const FACTOR: i32 = 2;

/// Columns and rows around the frame that have no edges, so that nobody has to ask where it ends.
const PADDING: usize = 2;
const PADDING_PIXELS: i32 = 2;

/// Weights of red, green and blue in luma (ITU-R BT.709), in parts of 10 000.
const WEIGHTS: [i32; 3] = [2126, 7152, 722];
/// The luma of opaque white.
const WHITE: i32 = 10_000 * 255 * 255;
/// [`THRESHOLD`] in the same measure.
const LEAST: i32 = WHITE / 10;

/// Pixels that are passed over at once where none has an edge.
pub(super) const CHUNK: usize = 32;
/// Rows that a thread takes at once.
pub(super) const BAND: usize = 32;

/// The luma of a stored colour weighted by its opacity, and that opacity: both `0..=WHITE`.
#[inline]
fn luma(pixel: u32) -> [i32; 2] {
    let [a, r, g, b] = pixel.to_be_bytes().map(i32::from);
    let luma = WEIGHTS[0] * r + WEIGHTS[1] * g + WEIGHTS[2] * b;
    [luma * a, a * (WHITE / 255)]
}

/// How far two pixels are apart, `0..=WHITE`.
#[inline]
fn distance(a: [i32; 2], b: [i32; 2]) -> i32 {
    (a[0] - b[0]).abs().max((a[1] - b[1]).abs())
}

/// How far two pixels `0xAARRGGBB` are apart as edges measure it, `0.0..=1.0`.
pub(super) fn contrast(a: u32, b: u32) -> f64 {
    f64::from(distance(luma(a), luma(b))) / f64::from(WHITE)
}

/// The rows of pixels around one: two above it, itself, and the one below; none beyond the frame.
struct Rows<'a> {
    above: [Option<&'a [u32]>; 2],
    own: &'a [u32],
    below: Option<&'a [u32]>,
}

impl Rows<'_> {
    /// Marks the edges of the row.
    fn mark(&self, flags: &mut [u8]) {
        for (start, flags) in (0..).step_by(CHUNK).zip(flags.chunks_mut(CHUNK)) {
            let end = start + flags.len();
            // Most pixels are those beside them.
            let is_flat = self.own[start.max(1)..end] == self.own[start.max(1) - 1..end - 1];
            let goes_on = |above: &[u32]| above[start..end] == self.own[start..end];
            if is_flat && self.above[1].is_none_or(goes_on) {
                continue;
            }
            let mut left = self.own[start.saturating_sub(1)];
            let mut luma_left = luma(left);
            for (x, flags) in (start..end).zip(flags) {
                let own = self.own[x];
                let above = self.above[1].map_or(own, |above| above[x]);
                if own != left || own != above {
                    let here = luma(own);
                    let is_edge = |other: [i32; 2], side: u8| u8::from(distance(here, other) >= LEAST) * side;
                    let found = is_edge(luma_left, LEFT) | is_edge(luma(above), TOP);
                    luma_left = here;
                    *flags = if found == 0 { 0 } else { self.adapted(x, found) };
                }
                left = own;
            }
        }
    }

    /// Drops those of a pixel's edges beside which luma differs much more.
    fn adapted(&self, x: usize, found: u8) -> u8 {
        let own = self.own[x];
        let in_row = |x: Option<usize>| x.and_then(|x| self.own.get(x)).copied();
        let in_column = |row: Option<&[u32]>| row.map(|row| row[x]);
        // Beyond the frame nothing differs.
        let between = |a: Option<u32>, b: Option<u32>| a.zip(b).map_or(0, |(a, b)| distance(luma(a), luma(b)));
        let (left, top) = (in_row(x.checked_sub(1)), in_column(self.above[1]));
        let [to_left, to_top] = [left, top].map(|other| between(Some(own), other));
        let others = [
            between(Some(own), in_row(Some(x + 1))),
            between(Some(own), in_column(self.below)),
            between(left, in_row(x.checked_sub(2))),
            between(top, in_column(self.above[0])),
        ];
        let most = others.into_iter().fold(to_left.max(to_top), i32::max);
        let kept = |side: u8, distance: i32| if FACTOR * distance >= most { found & side } else { 0 };
        kept(LEFT, to_left) | kept(TOP, to_top)
    }
}

/// The edges of a frame or a part of one: [`LEFT`] and [`TOP`] of each pixel.
#[derive(Debug)]
pub(super) struct Edges {
    pub(super) size: [usize; 2],
    stride: usize,
    flags: Vec<u8>,
}

impl Edges {
    /// Of `pixels` `0xAARRGGBB`, row by row.
    pub(super) fn new(pixels: &[u32], size: [usize; 2]) -> Self {
        let [width, height] = size;
        let stride = width + 2 * PADDING;
        let mut flags = vec![0; stride * (height + 2 * PADDING)];
        let own = &mut flags[PADDING * stride..][..height * stride];
        own.par_chunks_mut(BAND * stride).enumerate().for_each(|(band, flags)| {
            let row = |y: Option<usize>| y.and_then(|y| pixels.chunks_exact(width).nth(y));
            for (y, flags) in (band * BAND..).zip(flags.chunks_exact_mut(stride)) {
                let rows = Rows {
                    above: [row(y.checked_sub(2)), row(y.checked_sub(1))],
                    own: &pixels[y * width..][..width],
                    below: row(Some(y + 1)),
                };
                rows.mark(&mut flags[PADDING..][..width]);
            }
        });
        Self { size, stride, flags }
    }

    /// A row, and the one column after its last, which has no edges. The row below the last has none either.
    #[inline]
    pub(super) fn row(&self, y: usize) -> &[u8] {
        let start = (y + PADDING) * self.stride + PADDING;
        &self.flags[start..=start + self.size[0]]
    }

    /// Where the flags of a pixel are that lies in the frame or at most two pixels beside it.
    #[inline]
    pub(super) fn place(&self, [x, y]: [i32; 2]) -> usize {
        let [x, y] = [x, y].map(|at| usize::try_from(at + PADDING_PIXELS).unwrap_or(0));
        y * self.stride + x
    }

    /// How far apart the flags of pixels in the next column and in the next row are.
    pub(super) fn steps(&self) -> [usize; 2] {
        [1, self.stride]
    }

    /// The edges of the pixel at such a place.
    #[inline]
    pub(super) fn at_place(&self, place: usize) -> u8 {
        self.flags.get(place).copied().unwrap_or(0)
    }

    /// The edges of a pixel; none beyond the frame.
    #[inline]
    pub(super) fn at(&self, [x, y]: [i32; 2]) -> u8 {
        let place = |at: i32| usize::try_from(at + PADDING_PIXELS);
        match (place(x), place(y)) {
            (Ok(x), Ok(y)) if x < self.stride => self.flags.get(y * self.stride + x).copied().unwrap_or(0),
            _ => 0,
        }
    }
}
