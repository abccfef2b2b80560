//! Filtering samples that read blocks of texels: 4 x 4 by a cubic kernel, and across the border of a texture that is wrapped
//! 2 x 2 or one; with one tap or several.
//!
//! ```text
//!      o   o   o   o        o texels with their weights, products of a column's and a row's
//!      o   o   o   o        # the sample
//!            #
//!      o   o   o   o        weights in the corners may be above zero again:
//!      o   o   o   o        below zero times below zero
//! ```
//!
//! Samples that mostly share their blocks go to `shared_blocks`. Of the others the weights are found first, in vectors of
//! samples; then their texels are added, in vectors of channels, two rows and two columns at a time as `sample_filter` does.
//! Each number is that of `bilinear::each`, whatever the vectors' width. Blocks that reach beyond the level are put together
//! by what stands there.
//!
//! Some weights are below zero, so that a sum may be no colour. It is clamped once, when everything that a sample reads is in
//! it: alpha to what there can be, then each premultiplied channel to alpha. So a texel that shines through never becomes
//! brighter than it could be over black.

#![expect(
    clippy::inline_always,
    reason = "a function that is not inlined into its dispatch loses the vector instructions"
)]

use fearless_simd::prelude::*;
use fearless_simd::{Simd, i32x8, u8x16, u8x32};

use super::bilinear::per_tap;
use super::block_weights::{Blocks, LARGE, OneTap, SMALL, Step, Tap, place_centres, rows, rows_beyond};
use super::cubic::TexelWeights;
use super::filter_plan::{GridLevel, Plan};
use super::fixed_point::{FRACTION_BITS, MASS};
use super::sample_filter::{BLOCK, SampleVector, by_fours};
use super::simd_channels::{FromColors, Spread, both_columns, in_columns, mean, round};
use super::texel_coordinates::{Positions, columns_and_rows};
use super::{MipLevel, Wrap, sample_filter, shared_blocks};

/// Stands for the offset of a block that reaches beyond the level.
const BEYOND: i32 = -1;

/// Where the samples of a block read one level.
struct Cells {
    /// The first texel of each sample's block, or [`BEYOND`].
    offsets: [i32; BLOCK],
    /// Its column, and its row.
    corners: [[i32; BLOCK]; 2],
    /// The weights of 2 x 2 texels each, as [`Spread::columns`] takes them: upper left, upper right, lower left, lower right.
    /// Small blocks have the first ones alone.
    weights: [[u64; BLOCK]; 4],
}

/// The latest blocks of `SIDE x SIDE` texels that reach beyond a level: beyond a border that the outermost texels go on from, and in
/// levels of few texels, many samples read the same.
struct Beyond<'p, S: Simd, const SIDE: usize> {
    wrap: Wrap,
    level: &'p MipLevel,
    /// By their corners, in [`Self::KEPT`] columns and rows; nothing before the first one is read.
    blocks: Vec<BeyondBlock<S>>,
}

/// One of them.
#[derive(Clone, Copy)]
struct BeyondBlock<S: Simd> {
    corner: [i32; 2],
    rows: [u8x16<S>; 4],
}

impl<'p, S: Simd, const SIDE: usize> Beyond<'p, S, SIDE> {
    /// Levels of so many columns and rows are kept whole.
    const KEPT: i32 = 8;

    #[inline(always)]
    fn none(plan: &'p Plan<'p>, level: &GridLevel<'p>) -> Self {
        Self {
            wrap: plan.wrap,
            level: level.level,
            blocks: Vec::new(),
        }
    }

    /// The rows of the block with this corner.
    #[inline(always)]
    fn rows(&mut self, simd: S, corner: [i32; 2]) -> [u8x16<S>; 4] {
        let [column, row] = corner.map(|at| at.rem_euclid(Self::KEPT).cast_unsigned() as usize);
        let at = row * Self::KEPT.cast_unsigned() as usize + column;
        if let Some(block) = self.blocks.get(at).filter(|block| block.corner == corner) {
            return block.rows;
        }
        self.read(simd, at, corner)
    }

    #[cold]
    #[inline(never)]
    fn read(&mut self, simd: S, at: usize, corner: [i32; 2]) -> [u8x16<S>; 4] {
        simd.vectorize(
            #[inline(always)]
            || {
                let none = BeyondBlock {
                    // No block starts so far outside of a level.
                    corner: [i32::MIN; 2],
                    rows: [u8x16::splat(simd, 0); 4],
                };
                self.blocks
                    .resize((Self::KEPT * Self::KEPT).cast_unsigned() as usize, none);
                let rows = rows_beyond::<S, SIDE>(simd, self.level, self.wrap, corner);
                self.blocks[at] = BeyondBlock { corner, rows };
                rows
            },
        )
    }
}

/// Filters samples; see [`super::Filter::points`].
#[inline(always)]
pub(super) fn filter_with<S: Simd, C: FromColors>(
    simd: S,
    plan: &Plan<'_>,
    weights: &TexelWeights,
    points: &[[u16; 2]],
    out: &mut [C],
) {
    match (plan.pixel.cubic(), shared_blocks::are_few(plan)) {
        (None, false) => filter_blocks::<S, C, SMALL>(simd, plan, weights, points, out),
        (None, true) => shared_blocks::filter_with::<S, C, SMALL>(simd, plan, weights, points, out),
        (Some(_), false) => filter_blocks::<S, C, LARGE>(simd, plan, weights, points, out),
        (Some(_), true) => shared_blocks::filter_with::<S, C, LARGE>(simd, plan, weights, points, out),
    }
}

/// The same with blocks of `SIDE x SIDE` texels.
#[inline(always)]
fn filter_blocks<S: Simd, C: FromColors, const SIDE: usize>(
    simd: S,
    plan: &Plan<'_>,
    weights: &TexelWeights,
    points: &[[u16; 2]],
    out: &mut [C],
) {
    let spread = Spread::new(simd);
    let count = plan.line.taps.count;
    let scale = per_tap(count);
    let mut cells = Cells::EMPTY;
    let read = [Some(&plan.finer), plan.coarser.as_ref()];
    let levels = read.map(|level| Some(OneTap::new(plan, weights, level?)));
    let mut beyond = read.map(|level| Some(Beyond::<S, SIDE>::none(plan, level?)));
    let mut inside = [sample_filter::Cells::EMPTY; 2];
    for (points, out) in points.chunks(BLOCK).zip(out.chunks_mut(BLOCK)) {
        if SIDE == SMALL && count == 1 && note_inside(simd, &levels, points, &mut inside) {
            sample_filter::weigh(simd, spread, plan, &inside, out);
            continue;
        }
        if let (LARGE, 1, [Some(one), None], [Some(beyond), _]) = (SIDE, count, &levels, &mut beyond) {
            cells.note_large(simd, one, points);
            by_fours!(simd, out, |i| {
                let first = cells.sum(simd, spread, beyond, i);
                let second = cells.sum(simd, spread, beyond, i + 1);
                let third = cells.sum(simd, spread, beyond, i + 2);
                let fourth = cells.sum(simd, spread, beyond, i + 3);
                let low = clamped(simd, both_columns(first, second), 1);
                round(simd, low, clamped(simd, both_columns(third, fourth), 1))
            });
            continue;
        }
        // Even and odd columns of each sample.
        let mut sums = [i32x8::splat(simd, 0); BLOCK];
        for (level, beyond) in read.into_iter().flatten().zip(beyond.iter_mut().flatten()) {
            let centres = centres(simd, plan, level, points);
            for number in 0..count {
                let tap = Tap {
                    plan,
                    weights,
                    level,
                    number,
                };
                cells.fill::<S, SIDE>(simd, tap, &centres, points.len());
                for (i, sum) in sums.iter_mut().enumerate().take(points.len()) {
                    *sum += cells.sum(simd, spread, beyond, i);
                }
            }
        }
        by_fours!(simd, out, |i| {
            let at = |k: usize| sums[(i + k) % BLOCK];
            let low = clamped(simd, both_columns(at(0), at(1)), count);
            let high = clamped(simd, both_columns(at(2), at(3)), count);
            if count == 1 {
                round(simd, low, high)
            } else {
                mean(simd, low, high, scale)
            }
        });
    }
}

/// Notes where up to [`BLOCK`] samples read the levels; whether none of them reads across a border.
#[inline(always)]
fn note_inside<S: Simd>(
    simd: S,
    levels: &[Option<OneTap<'_>>; 2],
    points: &[[u16; 2]],
    cells: &mut [sample_filter::Cells; 2],
) -> bool {
    let lanes = S::u32s::LEN;
    let last = points.len().saturating_sub(lanes);
    let mut are_inside = true;
    for first in (0..points.len()).step_by(lanes) {
        let first = first.min(last);
        for (one, cells) in levels.iter().flatten().zip(&mut *cells) {
            let Tap { plan, level, .. } = one.tap;
            let at = Positions::new(simd, columns_and_rows(simd, &points[first..]), plan.first);
            let [x, y] = one.places(simd, &at);
            // Without a sign, numbers below zero are the largest.
            let beyond = x.bitcast::<S::u32s>().simd_gt(farthest(simd, level.level.width()))
                | y.bitcast::<S::u32s>().simd_gt(farthest(simd, level.level.height()));
            are_inside &= !beyond.any_true();
            cells.note(simd, plan.pixel, level, SampleVector { at: [x, y], first });
        }
    }
    if !are_inside {
        // Those of later blocks that are not filled are read, too.
        *cells = [sample_filter::Cells::EMPTY; 2];
    }
    are_inside
}

/// Of an axis with so many texels, the centre of the last one.
#[inline(always)]
fn farthest<S: Simd>(simd: S, size: u32) -> S::u32s {
    S::u32s::splat(simd, (size - 1) << FRACTION_BITS)
}

/// Where the samples of a block lie in a level, in fixed point: columns, then rows; not yet inside it where taps are added.
type Centres = [[i32; BLOCK]; 2];

#[inline(always)]
fn centres<S: Simd>(simd: S, plan: &Plan<'_>, level: &GridLevel<'_>, points: &[[u16; 2]]) -> Centres {
    let lanes = S::u32s::LEN;
    let last = points.len().saturating_sub(lanes);
    let mut centres = [[0; BLOCK]; 2];
    for first in (0..points.len()).step_by(lanes) {
        // The last vector begins earlier rather than to be short.
        let first = first.min(last);
        let at = Positions::new(simd, columns_and_rows(simd, &points[first..]), plan.first);
        for (centres, axis) in centres.iter_mut().zip([&level.x, &level.y]) {
            let places = place_centres(simd, plan.endless(axis).as_ref(), plan.line.taps.count, (&at, axis));
            places.store_slice(&mut centres[first..first + lanes]);
        }
    }
    centres
}

/// Sums of two samples as what a colour can be: see the module.
#[inline(always)]
fn clamped<S: Simd>(simd: S, sums: i32x8<S>, taps: u32) -> i32x8<S> {
    /// Alpha, which is the last channel, in the place of each.
    const ALPHA: [u8; 32] = [
        12, 13, 14, 15, 12, 13, 14, 15, 12, 13, 14, 15, 12, 13, 14, 15, 12, 13, 14, 15, 12, 13, 14, 15, 12, 13, 14, 15,
        12, 13, 14, 15,
    ];
    let most = i32::from(u8::MAX) * MASS * taps.cast_signed();
    let inside = sums.max(i32x8::splat(simd, 0)).min(i32x8::splat(simd, most));
    let alpha = inside
        .bitcast::<u8x32<S>>()
        .swizzle_dyn_within_blocks(u8x32::simd_from(simd, ALPHA));
    inside.min(alpha.bitcast::<i32x8<S>>())
}

impl Cells {
    const EMPTY: Self = Self {
        offsets: [0; BLOCK],
        corners: [[0; BLOCK]; 2],
        weights: [[0; BLOCK]; 4],
    };

    /// Notes the cells of a tap of up to [`BLOCK`] samples.
    #[inline(always)]
    fn fill<S: Simd, const SIDE: usize>(&mut self, simd: S, tap: Tap<'_>, centres: &Centres, count: usize) {
        let lanes = S::u32s::LEN;
        let last = count.saturating_sub(lanes);
        let (right, down) = (Step::new(tap, &tap.level.x), Step::new(tap, &tap.level.y));
        for first in (0..count).step_by(lanes) {
            let first = first.min(last);
            let [columns, rows] = centres;
            let x = S::i32s::from_slice(simd, &columns[first..first + lanes]);
            let y = S::i32s::from_slice(simd, &rows[first..first + lanes]);
            let at = [right.place(simd, x), down.place(simd, y)];
            self.note::<S, SIDE>(simd, tap, SampleVector { at, first });
        }
    }

    /// Notes the large cells of up to [`BLOCK`] samples that have one tap.
    #[inline(always)]
    fn note_large<S: Simd>(&mut self, simd: S, one: &OneTap<'_>, points: &[[u16; 2]]) {
        let lanes = S::u32s::LEN;
        let last = points.len().saturating_sub(lanes);
        for first in (0..points.len()).step_by(lanes) {
            let first = first.min(last);
            let at = Positions::new(simd, columns_and_rows(simd, &points[first..]), one.tap.plan.first);
            let at = one.places(simd, &at);
            self.note::<S, LARGE>(simd, one.tap, SampleVector { at, first });
        }
    }

    /// Notes the cells of a vector of samples.
    #[inline(always)]
    fn note<S: Simd, const SIDE: usize>(&mut self, simd: S, tap: Tap<'_>, vector: SampleVector<S>) {
        let SampleVector { at, first } = vector;
        let lanes = S::u32s::LEN;
        let number = |value| S::i32s::splat(simd, value);
        let Blocks {
            corners: [left, top],
            weights,
        } = Blocks::new::<SIDE>(simd, tap, at);
        left.store_slice(&mut self.corners[0][first..first + lanes]);
        top.store_slice(&mut self.corners[1][first..first + lanes]);
        let level = tap.level.level;
        let farthest = |size: u32| number(size.cast_signed()) - number(if SIDE == SMALL { 2 } else { 4 });
        let inside = left.simd_ge(number(0))
            & top.simd_ge(number(0))
            & left.simd_le(farthest(level.width()))
            & top.simd_le(farthest(level.height()));
        let offsets = top * number(level.stride().cast_signed()) + left;
        let offsets = inside.select(offsets, number(BEYOND));
        offsets.store_slice(&mut self.offsets[first..first + lanes]);
        self.keep::<S>(0, first, in_columns::<S>(weights[0], weights[1]));
        if SIDE == LARGE {
            self.keep::<S>(1, first, in_columns::<S>(weights[2], weights[3]));
            self.keep::<S>(2, first, in_columns::<S>(weights[4], weights[5]));
            self.keep::<S>(3, first, in_columns::<S>(weights[6], weights[7]));
        }
    }

    /// Keeps the weights of a vector's quarters.
    #[inline(always)]
    fn keep<S: Simd>(&mut self, quarter: usize, first: usize, [low, high]: [S::u64s; 2]) {
        let lanes = S::u32s::LEN;
        let (first, second) = self.weights[quarter][first..first + lanes].split_at_mut(lanes / 2);
        low.store_slice(first);
        high.store_slice(second);
    }

    /// Red, green, blue and alpha of sample `i` in the units of the weights: even columns, then odd columns.
    #[inline(always)]
    fn sum<S: Simd, const SIDE: usize>(
        &self,
        simd: S,
        spread: Spread<S>,
        beyond: &mut Beyond<'_, S, SIDE>,
        i: usize,
    ) -> i32x8<S> {
        let i = i % BLOCK;
        if self.offsets[i] != BEYOND {
            return self.inside::<S, SIDE>(simd, spread, beyond.level, i);
        }
        let rows = beyond.rows(simd, [self.corners[0][i], self.corners[1][i]]);
        self.weighed::<S, SIDE>(simd, spread, rows, i)
    }

    /// The same of a sample whose block lies inside the level.
    #[inline(always)]
    fn inside<S: Simd, const SIDE: usize>(&self, simd: S, spread: Spread<S>, level: &MipLevel, i: usize) -> i32x8<S> {
        let i = i % BLOCK;
        // Samples that fill up the last four of a list are those of an earlier block, perhaps beyond the level; what they get is
        // dropped.
        let offset = self.offsets[i].max(0).cast_unsigned() as usize;
        let rows = rows::<S, SIDE>(simd, level, offset);
        self.weighed::<S, SIDE>(simd, spread, rows, i)
    }

    #[inline(always)]
    fn weighed<S: Simd, const SIDE: usize>(
        &self,
        simd: S,
        spread: Spread<S>,
        rows: [u8x16<S>; 4],
        i: usize,
    ) -> i32x8<S> {
        let weights = |quarter: usize| self.weights[quarter][i];
        let upper = spread.columns(simd, rows[0].zip_low(rows[1]), weights(0));
        if SIDE == SMALL {
            return upper;
        }
        let upper = upper + spread.columns(simd, rows[0].zip_high(rows[1]), weights(1));
        let lower = spread.columns(simd, rows[2].zip_low(rows[3]), weights(2))
            + spread.columns(simd, rows[2].zip_high(rows[3]), weights(3));
        upper + lower
    }
}
