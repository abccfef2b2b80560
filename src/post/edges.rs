//! Which sides of pixels are edges: where luma differs, unless something beside differs much more.

#![expect(
    clippy::inline_always,
    reason = "only what is inlined into a dispatched function is compiled for its vector instructions"
)]

use std::array::from_fn;

use fearless_simd::{Simd, dispatch};
use rayon::prelude::*;

use super::bits::{self, BAND, Bits, Words};
use crate::simd;

/// The edge between a pixel and the one on its left, among the [`Words`] of a pixel.
pub(super) const LEFT: usize = 0;
/// The edge between a pixel and the one above it.
pub(super) const TOP: usize = 1;

/// A step of a diagonal that rises, among the stairs of a pixel: it has a left and a top edge.
pub(super) const RISE: usize = 0;
/// A step of one that falls: it has a top and a right edge.
pub(super) const FALL: usize = 1;

/// The least difference of luma that is an edge, `0.0..=1.0`.
pub const THRESHOLD: f64 = 0.1;
/// An edge is dropped where luma differs by more than this many times as much beside it: the eye sees that one only.
pub const FACTOR: i32 = 2;

/// Weights of red, green and blue in luma (ITU-R BT.709), in parts of 10 000.
const WEIGHTS: [i32; 3] = [2126, 7152, 722];
/// The luma of opaque white.
const WHITE: i32 = 10_000 * 255 * 255;
/// [`THRESHOLD`] in the same measure.
const LEAST: i32 = WHITE / 10;

/// Pixels whose edges are found at once: as many as a word has bits.
const CHUNK: usize = 64;
/// Pixels of a chunk with those beside it: two on its left and one on its right.
const WIDE: usize = CHUNK + 3;

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

/// Numbers of a chunk's pixels: in its own row with those beside it; and two rows above, one above, and below.
struct Near<T> {
    own: [T; WIDE],
    others: [[T; CHUNK]; 3],
}

/// How far pixels of a chunk are from the ones on their left, from the column before the chunk to that after it; and from
/// those above, from the row before the own one to that after it.
struct Distances {
    across: [i32; CHUNK + 2],
    down: [[i32; CHUNK]; 3],
}

impl Near<u32> {
    /// The chunk that begins in column `start`. Beyond the frame nothing differs: there is what stands at its border.
    fn new(rows: [&[u32]; 4], start: usize) -> Self {
        let [above_that, above, own, below] = rows;
        let last = own.len() - 1;
        if start >= 2 && start + CHUNK < own.len() {
            let chunk = |row: &[u32]| from_fn(|x| row[start..start + CHUNK][x]);
            return Self {
                own: from_fn(|x| own[start - 2..start - 2 + WIDE][x]),
                others: [above_that, above, below].map(chunk),
            };
        }
        let chunk = |row: &[u32]| from_fn(|x| row[(start + x).min(last)]);
        Self {
            own: from_fn(|x| own[(start + x).saturating_sub(2).min(last)]),
            others: [above_that, above, below].map(chunk),
        }
    }

    #[inline(always)]
    fn map(&self, number: impl Fn(u32) -> i32) -> Near<i32> {
        Near {
            own: from_fn(|x| number(self.own[x])),
            others: from_fn(|row| from_fn(|x| number(self.others[row][x]))),
        }
    }

    fn is_opaque(&self) -> bool {
        let all = |pixels: &[u32]| pixels.iter().fold(u32::MAX, |all, pixel| all & pixel);
        let others = self.others.iter().fold(u32::MAX, |sum, row| sum & all(row));
        (all(&self.own) & others) >> 24 == 255
    }

    /// The edges of the pixels.
    #[inline(always)]
    fn words(&self) -> Words {
        let mut distances = Distances {
            across: [0; CHUNK + 2],
            down: [[0; CHUNK]; 3],
        };
        distances.widen(&self.map(|pixel| luma(pixel)[0]));
        if !self.is_opaque() {
            distances.widen(&self.map(|pixel| luma(pixel)[1]));
        }
        distances.words()
    }
}

impl Distances {
    /// Takes in how far these numbers are apart.
    #[inline(always)]
    fn widen(&mut self, near: &Near<i32>) {
        for (x, most) in self.across.iter_mut().enumerate() {
            *most = (*most).max((near.own[x + 1] - near.own[x]).abs());
        }
        let [above_that, above, below] = &near.others;
        for x in 0..CHUNK {
            let own = near.own[x + 2];
            let apart = [above[x] - above_that[x], own - above[x], below[x] - own];
            for (most, apart) in self.down.iter_mut().zip(apart) {
                most[x] = most[x].max(apart.abs());
            }
        }
    }

    /// The edges, but for those beside which luma differs much more.
    #[inline(always)]
    fn words(&self) -> Words {
        let mut flags = [[0; CHUNK]; 2];
        for x in 0..CHUNK {
            let own = [self.across[x + 1], self.down[1][x]];
            let across = self.across[x].max(own[0]).max(self.across[x + 2]);
            let down = self.down[0][x].max(own[1]).max(self.down[2][x]);
            let most = across.max(down);
            for (flags, own) in flags.iter_mut().zip(own) {
                flags[x] = u8::from(own >= LEAST && FACTOR * own >= most);
            }
        }
        flags.map(|flags| packed(&flags))
    }
}

/// A bit for each of some numbers that are 0 or 1.
#[inline(always)]
fn packed(flags: &[u8; CHUNK]) -> u64 {
    let (eights, _) = flags.as_chunks::<8>();
    let bytes = eights
        .iter()
        .map(|eight| u64::from_le_bytes(*eight).wrapping_mul(0x0102_0408_1020_4080) >> 56);
    bytes.rev().fold(0, |all, byte| all << 8 | byte)
}

/// The edges of some pixels: of 64 from `start` on, or of those up to the row's end. The rows are two above theirs, the one
/// above, their own, and the one below.
fn found(rows: [&[u32]; 4], start: usize) -> Words {
    let [_, above, own, _] = rows;
    let end = own.len().min(start + CHUNK);
    // Most pixels are those beside them.
    let is_flat = own[start.max(1)..end] == own[start.max(1) - 1..end - 1];
    if is_flat && above[start..end] == own[start..end] {
        return [0; 2];
    }
    let near = Near::new(rows, start);
    let found = dispatch!(simd::level(), simd => simd.vectorize(
        #[inline(always)]
        || near.words(),
    ));
    found.map(|word| word & u64::MAX >> (CHUNK - (end - start)))
}

/// The edges of a frame or a part of one.
#[derive(Debug)]
pub(super) struct Edges {
    pub(super) size: [usize; 2],
    pub(super) rows: Bits,
    pub(super) columns: Bits,
    /// Steps of diagonals, row by row: [`RISE`] and [`FALL`] of each pixel.
    pub(super) stairs: Bits,
}

impl Edges {
    /// Of `pixels` `0xAARRGGBB`, row by row.
    pub(super) fn new(pixels: &[u32], size: [usize; 2]) -> Self {
        let [width, height] = size;
        let mut rows = Bits::rows(width, height);
        let mut stairs = Bits::rows(width, height);
        let mut columns = Bits::columns(height, width);
        let (row_words, stride) = rows.rows_mut();
        let (stair_words, _) = stairs.rows_mut();
        let (column_words, column_stride) = columns.columns_mut();
        let bands = row_words[..height * stride].par_chunks_mut(BAND * stride);
        let bands = bands.zip(stair_words.par_chunks_mut(BAND * stride));
        let bands = bands.zip(column_words.par_chunks_mut(column_stride)).enumerate();
        bands.for_each(|(band, ((words, stairs), columns))| {
            let row = |y: usize| &pixels[y.min(height - 1) * width..][..width];
            for (y, words) in (band * BAND..).zip(words.chunks_exact_mut(stride)) {
                let rows = [row(y.saturating_sub(2)), row(y.saturating_sub(1)), row(y), row(y + 1)];
                for (start, word) in (0..width).step_by(CHUNK).zip(&mut words[1..]) {
                    *word = found(rows, start);
                }
            }
            for (words, stairs) in words.chunks_exact(stride).zip(stairs.chunks_exact_mut(stride)) {
                for (both, stairs) in words.windows(2).zip(stairs) {
                    let ([left, top], [next, _]) = (both[0], both[1]);
                    *stairs = [left & top, (left >> 1 | next << 63) & top];
                }
            }
            let columns = &mut columns[Bits::BEFORE..][..width];
            for (word, columns) in (1..).zip(columns.chunks_mut(CHUNK)) {
                turn(words, stride, word, columns);
            }
        });
        Self {
            size,
            rows,
            columns,
            stairs,
        }
    }

    /// Whether a side of a pixel is an edge, which lies in the frame or at most two pixels beside it.
    #[inline]
    pub(super) fn has(&self, [x, y]: [i32; 2], side: usize) -> bool {
        let (word, bit) = bits::place(x);
        self.rows.word(word, y)[side] >> bit & 1 != 0
    }
}

/// Makes words of columns from those of rows.
fn turn(rows: &[Words], stride: usize, word: usize, columns: &mut [Words]) {
    for side in [LEFT, TOP] {
        let mut turned: [u64; BAND] = from_fn(|y| rows.get(y * stride + word).map_or(0, |words| words[side]));
        if turned.iter().any(|word| *word != 0) {
            bits::turn(&mut turned);
            for (column, turned) in columns.iter_mut().zip(turned) {
                column[side] = turned;
            }
        }
    }
}
