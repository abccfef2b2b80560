//! The weights of the 4 x 4 texels that the samples of a pixel read, for a vector of pixels at once.
//!
//! Bilinear filtering weighs the texel in column `c` and row `r` by `tent(x - c) tent(y - r)`, where `tent(d)` is
//! `max(0, 1 - |d|)`. Over all samples of a pixel, a texel weighs the sum of these products.
//!
//! With coordinates counted from the first of the four texels, tents are differences of *tails*: `clamp(x - k, 0, 1)` is
//! the part of a sample that belongs to texels beyond `k`. Tails are cheaper than tents; products of tails can be summed
//! over the samples just as well, and differences need to be taken only once a pixel. And it is the tails that are
//! rounded to 16 bits, so that no weight is negative and all sum to their total exactly.

#![expect(
    clippy::inline_always,
    reason = "a function that is not inlined into its dispatch loses the vector instructions"
)]

use fearless_simd::Simd;
use fearless_simd::prelude::*;

use super::covered::Covered;
use super::filter_plan::Axis;
use super::sample_offsets::{Footing, Lines, Offsets, Scale, TEXELS};
use super::texel_coordinates::Positions;
use super::wrap::Endless;

/// Adding this to a 32-bit float rounds it to a whole number, which then stands in the lower bits.
const WHOLE: f32 = 8_388_608.0;
const WHOLE_BITS: i32 = 0x007F_FFFF;

/// Sums of products of tails; `0` stands for all of a sample, `k + 1` for its part beyond texel `k`. `[y][x]`.
pub(super) type Products<S> = [[<S as Simd>::i32s; 4]; 4];

/// Where pixels begin in a level, and the weights of the texels there.
pub(super) struct Weighed<S: Simd> {
    /// Column and row of the first of the 4 x 4 texels; where a texture goes on for ever, perhaps beyond it.
    pub(super) corners: [S::i32s; 2],
    /// In rows from the first texel.
    pub(super) weights: Products<S>,
}

/// Samples of one axis relative to the first texel, twice in each pair of 16-bit lanes.
#[derive(Clone, Copy)]
struct Place<S: Simd> {
    /// The centre of the pixel.
    center: S::i16s,
    /// The greatest position inside the level.
    last: S::i16s,
}

/// Weights with the sum `totals`, for `T + 2` texels in each direction; the others are zero.
#[inline(always)]
pub(super) fn weigh<S: Simd, const T: usize, const ENDLESS: bool>(
    simd: S,
    footing: &Footing<'_>,
    at: &Positions<S>,
    covered: Covered<S>,
    totals: S::i32s,
) -> Weighed<S> {
    let scale = footing.scale;
    let endless = |axis: usize| footing.endless[axis].as_ref().filter(|_| ENDLESS);
    let (first_x, x) = place(simd, scale, at, (&footing.level.x, &footing.x, endless(0)));
    let (first_y, y) = place(simd, scale, at, (&footing.level.y, &footing.y, endless(1)));
    let lines = match footing.lines {
        Some(Lines::Upright) => Some((&footing.x.columns, &footing.y.rows)),
        Some(Lines::Turned) => Some((&footing.x.rows, &footing.y.columns)),
        None => None,
    };
    let products = match (covered, lines) {
        (Covered::All, Some(offsets)) => {
            let x = line::<S, T>(simd, scale, x, offsets.0);
            let y = line::<S, T>(simd, scale, y, offsets.1);
            outer::<S, T>(simd, x, y)
        }
        _ => products::<S, T>(simd, footing, x, y, covered),
    };
    Weighed {
        corners: [first_x, first_y],
        weights: differences::<S, T>(simd, products, footing.per_product, totals),
    }
}

/// The first texel that a pixel's samples read on an axis, and their place relative to it.
#[inline(always)]
fn place<S: Simd>(
    simd: S,
    scale: Scale,
    at: &Positions<S>,
    (axis, offsets, endless): (&Axis, &Offsets, Option<&Endless>),
) -> (S::i32s, Place<S>) {
    let number = |value: i32| S::i32s::splat(simd, value);
    let farthest = number(TEXELS.cast_signed() - 1);
    let (center, first, inside) = if let Some(endless) = endless {
        let center = at.near_endless(simd, axis, endless, scale.bits);
        let first = (center + number(offsets.least)) >> scale.bits;
        (center, first, farthest << scale.bits)
    } else {
        let center = at.near(simd, axis, scale.bits);
        let last = number(to_whole(axis.last));
        let first = ((center + number(offsets.least)) >> scale.bits)
            .max(number(0))
            .min(last);
        (center, first, (last - first).min(farthest) << scale.bits)
    };
    let place = Place {
        center: twice(simd, center - (first << scale.bits)),
        last: twice(simd, inside),
    };
    (first, place)
}

/// The number of a level's last texel.
#[expect(clippy::cast_possible_truncation, reason = "levels have whole sides far below 2^31")]
fn to_whole(last: f64) -> i32 {
    last as i32
}

/// The lower 16 bits of each lane in both of its halves.
#[inline(always)]
fn twice<S: Simd>(simd: S, value: S::i32s) -> S::i16s {
    (value & S::i32s::splat(simd, 0xFFFF) | value << 16).bitcast()
}

/// Two numbers of 16 bits in all pairs of lanes.
#[inline(always)]
fn pair<S: Simd>(simd: S, first: i16, second: i16) -> S::i16s {
    let both = u32::from(first.cast_unsigned()) | u32::from(second.cast_unsigned()) << 16;
    S::i32s::splat(simd, both.cast_signed()).bitcast()
}

/// The tails of samples at `center + offset` beyond the first `T` texels.
#[inline(always)]
fn tails<S: Simd, const T: usize>(simd: S, scale: Scale, at: S::i16s, last: S::i16s) -> [S::i16s; 3] {
    let one = pair(simd, 1 << scale.bits, 1 << scale.bits);
    let two: S::u16s = (one + one).bitcast();
    let inside = at.max(S::i16s::splat(simd, 0)).min(last);
    let bits: S::u16s = inside.bitcast();
    // Saturating at zero; the numbers are far below 2^15.
    let beyond: S::i16s = bits.saturating_sub(one.bitcast::<S::u16s>()).bitcast();
    let zero = S::i16s::splat(simd, 0);
    if T == 3 {
        [inside.min(one), beyond.min(one), bits.saturating_sub(two).bitcast()]
    } else {
        [inside.min(one), beyond, zero]
    }
}

/// Sums of the tails of the samples of one line, which starts with their number times one.
#[inline(always)]
fn line<S: Simd, const T: usize>(simd: S, scale: Scale, place: Place<S>, offsets: &[i16]) -> [S::i32s; 4] {
    let mut sums = [S::i32s::splat(simd, 0); 4];
    sums[0] = S::i32s::splat(simd, (scale.side << scale.bits).cast_signed());
    for i in (0..scale.side as usize).step_by(2) {
        let alone = i + 1 == scale.side as usize;
        let at = place.center + pair(simd, offsets[i], offsets[i + usize::from(!alone)]);
        let tails = tails::<S, T>(simd, scale, at, place.last);
        let units = pair(simd, 1, i16::from(!alone));
        for k in 0..T {
            sums[k + 1] += tails[k].pairwise_dot_product(units);
        }
    }
    sums
}

/// The products of all sums of two lines.
#[inline(always)]
fn outer<S: Simd, const T: usize>(simd: S, x: [S::i32s; 4], y: [S::i32s; 4]) -> Products<S> {
    let mut products = [[S::i32s::splat(simd, 0); 4]; 4];
    for j in 0..=T {
        for i in 0..=T {
            products[j][i] = x[i] * y[j];
        }
    }
    products
}

/// The sums over all samples that take part.
#[inline(always)]
fn products<S: Simd, const T: usize>(
    simd: S,
    footing: &Footing<'_>,
    x: Place<S>,
    y: Place<S>,
    covered: Covered<S>,
) -> Products<S> {
    let mut sums = [[S::i32s::splat(simd, 0); 4]; 4];
    let scale = footing.scale;
    let one = 1 << scale.bits;
    for j in 0..scale.side {
        let row_x = x.center + S::i16s::splat(simd, footing.x.rows[j as usize]);
        let row_y = y.center + S::i16s::splat(simd, footing.y.rows[j as usize]);
        let bits = covered.row(simd, scale, j);
        for i in (0..scale.side as usize).step_by(2) {
            let alone = i + 1 == scale.side as usize;
            let columns = |offsets: &Offsets| pair(simd, offsets.columns[i], offsets.columns[i + usize::from(!alone)]);
            let at_x = tails::<S, T>(simd, scale, row_x + columns(&footing.x), x.last);
            let at_y = tails::<S, T>(simd, scale, row_y + columns(&footing.y), y.last);
            let whole = pair(simd, one, one);
            let along_y = [whole, at_y[0], at_y[1], at_y[2]];
            let mut along_x = [whole, at_x[0], at_x[1], at_x[2]];
            if bits.is_some() || alone {
                let live = match bits {
                    // A sample's bit to the highest place of its lane, and from there to all.
                    Some(bits) => (bits * pair(simd, highest(i), highest(i + 1))) >> 15,
                    None => pair(simd, -1, 0),
                };
                for along_x in &mut along_x[..=T] {
                    *along_x &= live;
                }
            }
            for b in 0..=T {
                for a in 0..=T {
                    sums[b][a] += along_y[b].pairwise_dot_product(along_x[a]);
                }
            }
        }
    }
    sums
}

/// What moves bit `i` of a 16-bit number to its highest place.
#[inline(always)]
fn highest(i: usize) -> i16 {
    (0x8000_u16 >> (i % 16)).cast_signed()
}

impl<S: Simd> Covered<S> {
    /// The bits of row `row` in both halves of each lane.
    #[inline(always)]
    fn row(&self, simd: S, scale: Scale, row: u32) -> Option<S::i16s> {
        let Self::Some(low, high) = *self else {
            return None;
        };
        let first = row * scale.side;
        let bits = if first >= 32 {
            high >> (first - 32)
        } else if first == 0 {
            low
        } else {
            low >> first | high << (32 - first)
        };
        let bits: S::i32s = (bits & S::u32s::splat(simd, (1 << scale.side) - 1)).bitcast();
        Some(twice(simd, bits))
    }
}

/// From sums of products of tails to weights.
#[inline(always)]
fn differences<S: Simd, const T: usize>(simd: S, sums: Products<S>, per_product: f32, totals: S::i32s) -> Products<S> {
    let zero = S::i32s::splat(simd, 0);
    let factor = S::f32s::splat(simd, per_product);
    let rounded = |sum: S::i32s| -> S::i32s {
        let whole = S::f32s::float_from(sum) * factor + S::f32s::splat(simd, WHOLE);
        whole.bitcast::<S::i32s>() & S::i32s::splat(simd, WHOLE_BITS)
    };
    let mut weights = [[zero; 4]; 4];
    let mut beyond_rows = totals;
    for r in 0..=T {
        // What is left for rows beyond this one; rounding must not make it more than it was.
        let next = if r < T {
            rounded(sums[r + 1][0]).min(beyond_rows)
        } else {
            zero
        };
        let mut beyond = beyond_rows - next;
        for c in 0..=T {
            let left = if c == T {
                zero
            } else if r < T {
                rounded(sums[r][c + 1] - sums[r + 1][c + 1]).min(beyond)
            } else {
                rounded(sums[r][c + 1]).min(beyond)
            };
            weights[r][c] = beyond - left;
            beyond = left;
        }
        beyond_rows = next;
    }
    weights
}
