//! What pixels show that two primitives share: two surfaces, and a bit for each sample.
//!
//! The masks, first and second surfaces of a row of pixels each lie side by side, so that those of a few pixels are a vector.

use crate::raster::surface_id::{GROUP, LAST_GROUP, ROW, SurfaceId};
use fearless_simd::prelude::*;
use fearless_simd::{Simd, mask16x8, u16x8, u64x2};

use crate::raster::paint::visibility::packed::{joined, lanes};

/// Most samples along the side of a pixel whose masks take 16 bits.
const NARROW_SIDE: usize = 4;

/// A pixel of a tile: its row and its column, counted from the tile's first pixel.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PixelIndex {
    pub(crate) y: usize,
    pub(crate) x: usize,
}

/// Four pixels side by side, in the lower half of a vector.
pub(crate) type Group<S> = u16x8<S>;

/// Some of them.
pub(crate) type GroupMask<S> = mask16x8<S>;

/// Two surfaces that share the samples of a pixel.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct TwoSurfaces {
    /// Bit `side * row + column` for each sample that shows `second`; neither all are set nor none.
    pub(crate) mask: u64,
    pub(crate) first: SurfaceId,
    pub(crate) second: SurfaceId,
}

/// The same of four pixels side by side, with narrow masks.
#[derive(Clone, Copy)]
pub(crate) struct TwoSurfaceGroup<S: Simd> {
    pub(crate) masks: Group<S>,
    pub(crate) firsts: Group<S>,
    pub(crate) seconds: Group<S>,
}

/// Two surfaces for each pixel of a tile, of account or not.
#[derive(Debug)]
pub(crate) struct TwoSurfacePixels {
    rows: Vec<Row>,
    /// Whether masks need more than 16 bits, and these masks.
    is_wide: bool,
    wide: Vec<[u64; ROW]>,
}

/// The two surfaces of each pixel of a row.
#[derive(Clone, Debug)]
struct Row {
    masks: [u16; ROW],
    firsts: [SurfaceId; ROW],
    seconds: [SurfaceId; ROW],
}

/// The two surfaces of each pixel of a row, or none.
#[derive(Clone, Copy, Debug)]
pub(crate) struct TwoSurfaceRow<'a> {
    row: &'a Row,
    wide: Option<&'a [u64; ROW]>,
}

impl Row {
    const NONE: Self = Self {
        masks: [0; ROW],
        firsts: [0; ROW],
        seconds: [0; ROW],
    };
}

impl TwoSurfacePixels {
    /// None, for pixels of `side x side` samples, at most 64.
    pub(crate) fn new(side: usize) -> Self {
        Self {
            rows: Vec::new(),
            is_wide: side > NARROW_SIDE,
            wide: Vec::new(),
        }
    }

    /// Makes room for those of so many rows.
    pub(crate) fn make_room(&mut self, rows: usize) {
        if self.rows.len() < rows {
            self.rows.resize(rows, Row::NONE);
            if self.is_wide {
                self.wide.resize(rows, [0; ROW]);
            }
        }
    }

    /// That of a pixel.
    #[inline(always)]
    #[expect(clippy::inline_always, reason = "a few instructions for every pixel on an edge")]
    pub(crate) fn get(&self, PixelIndex { y, x }: PixelIndex) -> TwoSurfaces {
        self.row(y).get(x)
    }

    /// Sets that of a pixel.
    #[inline(always)]
    #[expect(clippy::inline_always, reason = "a few instructions for every pixel on an edge")]
    #[expect(clippy::cast_possible_truncation, reason = "narrow masks have sixteen bits")]
    pub(crate) fn set(&mut self, PixelIndex { y, x }: PixelIndex, two: TwoSurfaces) {
        let (row, x) = (&mut self.rows[y], x % ROW);
        if self.is_wide {
            self.wide[y][x] = two.mask;
        } else {
            row.masks[x] = two.mask as u16;
        }
        row.firsts[x] = two.first;
        row.seconds[x] = two.second;
    }

    /// Sets those of the four pixels from `first` on that `which` names; masks must be narrow.
    #[inline(always)]
    #[expect(clippy::inline_always, reason = "vector instructions reach inlined code only")]
    pub(crate) fn set_group<S: Simd>(
        &mut self,
        simd: S,
        first: PixelIndex,
        which: GroupMask<S>,
        two: TwoSurfaceGroup<S>,
    ) {
        debug_assert!(!self.is_wide, "masks of sixteen bits");
        let row = &mut self.rows[first.y];
        for (all, new) in [
            (&mut row.masks, two.masks),
            (&mut row.firsts, two.firsts),
            (&mut row.seconds, two.seconds),
        ] {
            let old = group(simd, word_at(all, first.x));
            put(all, first.x, which.select(new, old));
        }
    }

    /// Those of row `y`.
    #[inline(always)]
    #[expect(clippy::inline_always, reason = "a few instructions for every pixel on an edge")]
    pub(crate) fn row(&self, y: usize) -> TwoSurfaceRow<'_> {
        TwoSurfaceRow {
            row: self.rows.get(y).unwrap_or(&Row::NONE),
            wide: self.wide.get(y),
        }
    }
}

impl TwoSurfaceRow<'_> {
    /// That of column `x`.
    #[inline(always)]
    #[expect(clippy::inline_always, reason = "a few instructions for every pixel on an edge")]
    pub(crate) fn get(self, x: usize) -> TwoSurfaces {
        let x = x % ROW;
        TwoSurfaces {
            mask: match self.wide {
                Some(masks) => masks[x],
                None => u64::from(self.row.masks[x]),
            },
            first: self.row.firsts[x],
            second: self.row.seconds[x],
        }
    }
}

/// The four numbers of a row from number `x` on, at most [`LAST_GROUP`], the first one lowest.
#[inline(always)]
#[expect(clippy::inline_always, reason = "one instruction, mostly")]
pub(crate) fn word_at(row: &[u16; ROW], x: usize) -> u64 {
    let x = x.min(LAST_GROUP);
    joined([row[x], row[x + 1], row[x + 2], row[x + 3]])
}

/// Four numbers, the first one lowest, as a vector.
#[inline(always)]
#[expect(clippy::inline_always, reason = "vector instructions reach inlined code only")]
pub(crate) fn group<S: Simd>(simd: S, word: u64) -> Group<S> {
    u64x2::splat(simd, word).bitcast()
}

/// Puts a vector where [`word_at`] finds it.
#[inline(always)]
#[expect(clippy::inline_always, reason = "vector instructions reach inlined code only")]
pub(crate) fn put<S: Simd>(row: &mut [u16; ROW], x: usize, vector: Group<S>) {
    let x = x.min(LAST_GROUP);
    let [word, _] = vector.bitcast::<u64x2<S>>().to_array();
    row[x..x + GROUP].copy_from_slice(&lanes(word));
}
