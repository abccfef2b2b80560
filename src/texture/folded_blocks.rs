//! Blocks of 4 x 4 texels of a texture that goes on for ever, as blocks of the texture itself.
//!
//! ```text
//!      |c b a|a b c|c b a|      a block that lies in a copy that is turned round has its texels in the texture from the last to
//!             + +   + +         the first: its weights are turned round instead
//!             a b   b a
//! ```
//!
//! Blocks that lie across a border are put together by what stands there.

#![expect(
    clippy::inline_always,
    reason = "a function that is not inlined into its dispatch loses the vector instructions"
)]

use fearless_simd::Simd;
use fearless_simd::prelude::*;

use super::sample_offsets::{Footing, TEXELS};
use super::tent_weights::{Products, Weighed};
use super::wrap::Endless;

/// Where pixels read a level, and what they weigh there.
pub(super) struct Folded<S: Simd> {
    /// The first of the 4 x 4 texels, where they lie inside the level.
    pub(super) offsets: S::u32s,
    /// In rows from the first texel.
    pub(super) weights: Products<S>,
    /// Column and row of the first texel.
    pub(super) corners: [S::i32s; 2],
    /// Bit by bit, which pixels read across a border, from texels that follow each other from their corners.
    pub(super) beyond: u64,
}

/// An axis of some blocks.
struct Line<S: Simd> {
    /// Their first texels, inside the level.
    firsts: S::i32s,
    is_inside: S::mask32s,
    is_turned: S::mask32s,
}

impl<S: Simd> Folded<S> {
    /// Of a texture that ends, in which all blocks lie.
    #[inline(always)]
    pub(super) fn inside(simd: S, footing: &Footing<'_>, Weighed { corners, weights }: Weighed<S>) -> Self {
        let stride = S::i32s::splat(simd, footing.level.level.stride().cast_signed());
        let [left, top] = corners;
        Self {
            offsets: (top * stride + left).bitcast(),
            weights,
            corners,
            beyond: 0,
        }
    }

    /// Of one that goes on for ever.
    #[inline(always)]
    pub(super) fn new(simd: S, footing: &Footing<'_>, Weighed { corners, weights }: Weighed<S>) -> Self {
        let [Some(right), Some(down)] = &footing.endless else {
            return Self::inside(simd, footing, Weighed { corners, weights });
        };
        let level = footing.level.level;
        let stride = S::i32s::splat(simd, level.stride().cast_signed());
        let [left, top] = corners;
        let x = Line::new(simd, (right, level.width()), left);
        let y = Line::new(simd, (down, level.height()), top);
        let is_inside = x.is_inside & y.is_inside;
        let offsets = is_inside.select(y.firsts * stride + x.firsts, S::i32s::splat(simd, 0));
        let mut folded = weights;
        for row in 0..4 {
            for column in 0..4 {
                let across = |row: &[S::i32s; 4]| (x.is_turned & is_inside).select(row[3 - column], row[column]);
                folded[row][column] =
                    (y.is_turned & is_inside).select(across(&weights[3 - row]), across(&weights[row]));
            }
        }
        let all = u64::MAX >> (64 - S::u32s::LEN);
        Self {
            offsets: offsets.bitcast(),
            weights: folded,
            corners,
            beyond: all & !is_inside.to_bitmask(),
        }
    }
}

impl<S: Simd> Line<S> {
    #[inline(always)]
    fn new(simd: S, (endless, side): (&Endless, u32), firsts: S::i32s) -> Self {
        let number = |value| S::i32s::splat(simd, value);
        // Without a sign, numbers below zero are the largest; no block of such a number is in a level that is too small.
        let side = side.cast_signed();
        let blocks = S::u32s::splat(simd, (side - TEXELS.cast_signed() + 1).max(0).cast_unsigned());
        let lies_inside = |firsts: S::i32s| firsts.bitcast::<S::u32s>().simd_lt(blocks);
        if endless.fixed_turn < 0 {
            let is_inside = lies_inside(firsts);
            return Self {
                firsts,
                is_inside,
                is_turned: firsts.simd_lt(number(i32::MIN)),
            };
        }
        let turned = number(2 * side - TEXELS.cast_signed()) - firsts;
        let is_turned = lies_inside(turned);
        Self {
            firsts: is_turned.select(turned, firsts),
            is_inside: lies_inside(firsts) | is_turned,
            is_turned,
        }
    }
}

#[cfg(test)]
mod tests {
    use fearless_simd::dispatch;
    use glam::DVec2;

    use super::super::filter_plan::{Axis, GridLevel, Plan, TapLine};
    use super::super::sample_offsets::{Footings, Scale};
    use super::super::{MipLevel, PixelSampling, Taps, Wrap};
    use super::*;
    use crate::simd;

    /// Calls `visit` with the blocks that start there, folded, of a level of `7 x 5` texels.
    fn folded(wrap: Wrap, corners: [i32; 2], mut visit: impl FnMut(&MipLevel, &str, [i32; 2], [[i32; 4]; 4])) {
        let level = MipLevel::new(7, 5, (0..35).map(|i| [i, 0, 0, 255]).collect());
        let axis = |last| Axis {
            at_pivot: 0.0,
            right: 0.1,
            down: 0.0,
            last,
        };
        let plan = Plan {
            pixel: PixelSampling::Bilinear,
            wrap,
            first: DVec2::ZERO,
            line: TapLine {
                taps: Taps::ONE,
                steps: 1.0,
            },
            finer: GridLevel {
                level: &level,
                number: 0,
                mass: 1,
                x: axis(6.0),
                y: axis(4.0),
            },
            coarser: None,
        };
        let footings = Footings::of_plan(&plan, Scale::new(4)).expect("few texels");
        for (name, simd) in simd::tested() {
            let (found, weights) = dispatch!(simd, simd => fold(simd, &footings.finer, corners));
            visit(&level, name, found, weights);
        }
    }

    /// Where the first texel lies, -1 where there is none in the level, and the weights of all, which were 0 to 15.
    #[inline(always)]
    fn fold<S: Simd>(simd: S, footing: &Footing<'_>, corners: [i32; 2]) -> ([i32; 2], [[i32; 4]; 4]) {
        let number = |value: usize| S::i32s::splat(simd, i32::try_from(value).unwrap_or(0));
        let weighed = Weighed {
            corners: corners.map(|at| S::i32s::splat(simd, at)),
            weights: std::array::from_fn(|row| std::array::from_fn(|column| number(4 * row + column))),
        };
        let folded = Folded::new(simd, footing, weighed);
        let weights = folded.weights.map(|row| row.map(|weight| weight.as_slice()[0]));
        if folded.beyond & 1 == 1 {
            return ([-1; 2], weights);
        }
        let stride = footing.level.level.stride();
        let offset = folded.offsets.as_slice()[0];
        ([offset % stride, offset / stride].map(u32::cast_signed), weights)
    }

    #[test]
    fn weights_go_to_the_texels_that_stand_there() {
        let (mut inside, mut beyond) = (0, 0);
        for wrap in Wrap::ALL {
            for corner in (-4..16).flat_map(|x| (-4..12).map(move |y| [x, y])) {
                if wrap == Wrap::Clamp && !((0..4).contains(&corner[0]) && (0..2).contains(&corner[1])) {
                    continue;
                }
                folded(wrap, corner, |level, name, found, weights| {
                    if found[0] < 0 {
                        beyond += 1;
                        return;
                    }
                    inside += 1;
                    let mut expected = std::collections::BTreeMap::new();
                    let mut texels = std::collections::BTreeMap::new();
                    for (row, column) in (0..16).map(|i| (i / 4, i % 4)) {
                        let at = |corner: [i32; 2]| [corner[0] + column, corner[1] + row];
                        expected.insert(4 * row + column, level.wrapped(wrap, at(corner)));
                        let weight = weights[row.cast_unsigned() as usize][column.cast_unsigned() as usize];
                        texels.insert(weight, level.texel(at(found)[0], at(found)[1]));
                    }
                    assert_eq!(texels, expected, "{name}: {wrap:?} {corner:?}");
                });
            }
        }
        assert!(inside > 100 && beyond > 100, "{inside} and {beyond}");
    }
}
