//! Painting rows of pixels with 4 x 4 samples, four pixels on an edge at a time: [`VisibilityTile::paint`] and
//! [`VisibilityTile::change`] with few instructions.

use std::ops::Range;

use fearless_simd::Simd;
use fearless_simd::prelude::*;

use super::four::{Ends, TileRow, Window, each_window, fill};
use super::pairs::{Quad, QuadMask, put, quad, word_at};
use super::visibility::{PAIR, ROW, Slot, VisibilityTile};
use super::words::{lanes, splat};

/// Bits of which one is set for each shared pixel of four, and perhaps for others.
const PERHAPS_SHARED: u64 = 0x8000_8000_8000_8000;

impl VisibilityTile {
    /// Lets the samples that a row of pixels covers show `slot`.
    #[inline(always)]
    #[expect(
        clippy::inline_always,
        reason = "a call for each row of pixels would cost as much as the rest"
    )]
    pub(crate) fn paint_four<S: Simd>(&mut self, simd: S, row: &TileRow<'_>, slot: Slot) {
        // Those covered in part may be shared from now on, and full ones are not.
        let shared = &mut self.shared[row.y];
        *shared |= bits(&row.touched);
        if row.full.is_empty() {
            return each_window(
                simd,
                row,
                (row.touched.clone(), Ends::Both),
                #[inline(always)]
                |window| self.paint_quad(simd, row.y, window, slot),
            );
        }
        *shared &= !bits(&row.full);
        let (before, after) = row.beside_full();
        each_window(
            simd,
            row,
            (before, Ends::Left),
            #[inline(always)]
            |window| self.paint_quad(simd, row.y, window, slot),
        );
        each_window(
            simd,
            row,
            (after, Ends::Right),
            #[inline(always)]
            |window| self.paint_quad(simd, row.y, window, slot),
        );
        // Last: slots that were just written as vectors are read slowly.
        fill(&mut self.whole[row.y], row.full.clone(), slot);
    }

    /// Lets the samples that a row of pixels covers show what `change` makes of what they show.
    #[inline(always)]
    #[expect(
        clippy::inline_always,
        reason = "a call for each row of pixels would cost as much as the rest"
    )]
    pub(crate) fn change_four<S: Simd>(&mut self, simd: S, row: &TileRow<'_>, mut change: impl FnMut(Slot) -> Slot) {
        self.shared[row.y] |= bits(&row.touched);
        if row.full.is_empty() {
            return each_window(
                simd,
                row,
                (row.touched.clone(), Ends::Both),
                #[inline(always)]
                |window| self.change_quad(simd, row, window, &mut change),
            );
        }
        let (before, after) = row.beside_full();
        each_window(
            simd,
            row,
            (before, Ends::Left),
            #[inline(always)]
            |window| self.change_quad(simd, row, window, &mut change),
        );
        each_window(
            simd,
            row,
            (after, Ends::Right),
            #[inline(always)]
            |window| self.change_quad(simd, row, window, &mut change),
        );
        self.change_whole(row.y, row.full.clone(), &mut change);
    }

    /// Lets the samples of a window show `slot`.
    #[inline(always)]
    #[expect(clippy::inline_always, reason = "vector instructions reach inlined code only")]
    fn paint_quad<S: Simd>(&mut self, simd: S, y: usize, Window { x, live, masks }: Window, slot: Slot) {
        let whole = &mut self.whole[y];
        let word = word_at(whole, x);
        if word & live & PERHAPS_SHARED != 0 {
            return self.paint_shared_quad((y, x), masks, slot);
        }
        let number = |number| Quad::splat(simd, number);
        let (shown, covered) = (quad(simd, word), quad(simd, masks));
        let painted = in_part(simd, covered) & !shown.simd_eq(number(slot));
        put(whole, x, painted.select(number(PAIR), shown));
        self.pairs
            .set_quad(simd, ((y, x), painted), (covered, shown, number(slot)));
    }

    /// As [`VisibilityTile::paint_quad`] pixel by pixel.
    #[inline(never)]
    fn paint_shared_quad(&mut self, (y, x): (usize, usize), masks: u64, slot: Slot) {
        for (x, covered) in (x..).zip(lanes(masks)) {
            if covered != 0 {
                self.paint_samples((y, x), u64::from(covered), slot);
            }
        }
    }

    /// Lets the samples of a window show what `change` makes of what they show.
    #[inline(always)]
    #[expect(clippy::inline_always, reason = "vector instructions reach inlined code only")]
    fn change_quad<S: Simd>(
        &mut self,
        simd: S,
        row: &TileRow<'_>,
        Window { x, live, masks }: Window,
        change: &mut impl FnMut(Slot) -> Slot,
    ) {
        let whole = &mut self.whole[row.y];
        let word = word_at(whole, x);
        let [first, ..] = lanes(word >> (live.trailing_zeros() % 64));
        if first >= PAIR || (word ^ splat(first)) & live != 0 {
            return self.change_shared_quad(row, (x, masks), change);
        }
        if masks == 0 {
            return;
        }
        let number = |number| Quad::splat(simd, number);
        let (shown, covered) = (quad(simd, word), quad(simd, masks));
        let changed = in_part(simd, covered);
        put(whole, x, changed.select(number(PAIR), shown));
        self.pairs
            .set_quad(simd, ((row.y, x), changed), (covered, shown, number(change(first))));
    }

    /// As [`VisibilityTile::change_quad`] pixel by pixel.
    fn change_shared_quad(
        &mut self,
        row: &TileRow<'_>,
        (x, masks): (usize, u64),
        change: &mut impl FnMut(Slot) -> Slot,
    ) {
        for ((x, column), covered) in (x..).zip(row.column(x)..).zip(lanes(masks)) {
            if covered != 0 {
                self.change_samples(((row.y, x), column), (u64::from(covered), row.spans), change);
            }
        }
    }
}

/// A bit for each of some pixels of a row, at least one.
#[inline(always)]
#[expect(clippy::inline_always, reason = "a few instructions for every row of pixels")]
fn bits(xs: &Range<usize>) -> u64 {
    u64::MAX >> ((ROW - xs.len()) % ROW) << (xs.start % ROW)
}

/// Which of four masks name some samples.
#[inline(always)]
#[expect(clippy::inline_always, reason = "vector instructions reach inlined code only")]
fn in_part<S: Simd>(simd: S, masks: Quad<S>) -> QuadMask<S> {
    !masks.simd_eq(Quad::splat(simd, 0))
}
