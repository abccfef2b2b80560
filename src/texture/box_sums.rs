//! Means over boxes from a table of sums in 64-bit floats, in vectors of channels: of light, and across borders of bytes.
//!
//! ```text
//!      a---b      the numbers around each corner are mixed along rows for both sides of the box, then between two rows
//!      |   |      for both columns; the same arithmetic as in `SummedAreaTable::mean`, number by number
//!      c---d
//! ```

#![expect(
    clippy::inline_always,
    reason = "a function that is not inlined into its dispatch loses the vector instructions"
)]

use fearless_simd::prelude::*;
use fearless_simd::{Simd, f64x4, f64x8, u32x4, u64x2};
use glam::DVec2;

use super::fixed_point::REACH;
use super::summed_area::{Stretch, Stretches, SummedAreaTable, Sums, SumsOfLight, length, stretches};
use super::{TexelBox, Wrap};
use crate::color::Premultiplied16;

/// A number of a table.
trait Number: Copy {
    /// Four of them.
    fn vector<S: Simd>(simd: S, numbers: [Self; 4]) -> f64x4<S>;
}

/// The numbers of a table.
#[derive(Clone, Copy)]
struct Numbers<'t, N> {
    sums: &'t [[N; 4]],
    size: [u32; 2],
}

/// The last column or row of numbers before a place, and how far the place is beyond it.
struct Cut {
    before: usize,
    beyond: f64,
}

/// Both sides of a box as [`Cut`]s.
struct Columns<S: Simd> {
    before: [usize; 2],
    beyond: f64x8<S>,
}

/// The mean of a box anywhere about a point, both in texels from the corner of the first one.
#[inline(always)]
pub(super) fn mean<S: Simd>(
    simd: S,
    table: &SummedAreaTable,
    at: DVec2,
    area: &TexelBox,
    wrap: Wrap,
) -> Premultiplied16 {
    let size = table.size();
    match table.sums() {
        Sums::Bytes(sums) => {
            let (sum, texels) = Numbers { sums, size }.wrapped(simd, at, area, wrap);
            table.color(sum.into(), texels)
        }
        Sums::Light(light) => {
            let sums = &light.sums;
            let (sum, texels) = Numbers { sums, size }.wrapped(simd, at, area, wrap);
            color(simd, light, sum, texels)
        }
    }
}

/// The colour of a mean of light: [`SummedAreaTable::color`].
#[inline(always)]
fn color<S: Simd>(simd: S, light: &SumsOfLight, sum: f64x4<S>, texels: f64) -> Premultiplied16 {
    /// More than what lies between dividing twice and multiplying once, as a part of the quotient.
    const APART: f64 = 1.0 / (1_u64 << 48) as f64;
    let factor = 1.0 / (texels * SumsOfLight::STEPS);
    let near = sum * f64x4::splat(simd, factor);
    let apart = near * f64x4::splat(simd, APART);
    let [least, most] = (near - apart).narrow(near + apart).split().into();
    // Nearly always both ends are one 32-bit float, which the quotient is then, too.
    let mean = if least.simd_eq(most).all_true() {
        least.into()
    } else {
        SumsOfLight::mean(sum.into(), texels)
    };
    light.color(mean)
}

impl<N: Number> Numbers<'_, N> {
    /// The sum over a box anywhere, and its area.
    #[inline(always)]
    fn wrapped<S: Simd>(&self, simd: S, at: DVec2, area: &TexelBox, wrap: Wrap) -> (f64x4<S>, f64) {
        let half = area.sides * 0.5;
        let [width, height] = self.size.map(f64::from);
        if let Some(columns) = one_stretch(wrap, width, at.x, half.x)
            && let Some(rows) = one_stretch(wrap, height, at.y, half.y)
        {
            let texels = (columns[1] - columns[0]) * (rows[1] - rows[0]);
            return (self.over(simd, columns, rows), texels);
        }
        self.across(
            simd,
            &stretches(wrap, width, at.x, half.x),
            &stretches(wrap, height, at.y, half.y),
        )
    }

    /// The same of the stretches that both of its sides become.
    #[inline(always)]
    fn across<S: Simd>(&self, simd: S, columns: &Stretches, rows: &Stretches) -> (f64x4<S>, f64) {
        let mut sum = f64x4::splat(simd, 0.0);
        let is_any = |stretch: &&Stretch| stretch.times > 0.0;
        for row in rows.iter().take_while(is_any) {
            for column in columns.iter().take_while(is_any) {
                let times = column.times * row.times;
                if times > 0.0 {
                    let part = self.over(simd, [column.from, column.to], [row.from, row.to]);
                    sum += part * f64x4::splat(simd, times);
                }
            }
        }
        (sum, length(columns) * length(rows))
    }

    /// The sum over a box inside the level.
    #[inline(always)]
    fn over<S: Simd>(&self, simd: S, columns: [f64; 2], rows: [f64; 2]) -> f64x4<S> {
        let stride = self.size[0] as usize + 1;
        let (left, right) = (Cut::new(columns[0], self.size[0]), Cut::new(columns[1], self.size[0]));
        let (top, bottom) = (Cut::new(rows[0], self.size[1]), Cut::new(rows[1], self.size[1]));
        let beyond = f64x4::splat(simd, left.beyond).combine(f64x4::splat(simd, right.beyond));
        let columns = Columns {
            before: [left.before, right.before],
            beyond,
        };
        let (first, third) = (top.before * stride, bottom.before * stride);
        let (first, second) = (
            self.row(simd, first, &columns),
            self.row(simd, first + stride, &columns),
        );
        let (third, fourth) = (
            self.row(simd, third, &columns),
            self.row(simd, third + stride, &columns),
        );
        let above = first + (second - first) * f64x8::splat(simd, top.beyond);
        let below = third + (fourth - third) * f64x8::splat(simd, bottom.beyond);
        let (left, right) = (below - above).split();
        right - left
    }

    /// The numbers of the row that starts there, at both places.
    #[inline(always)]
    fn row<S: Simd>(&self, simd: S, start: usize, columns: &Columns<S>) -> f64x8<S> {
        let left = &self.sums[start + columns.before[0]..][..2];
        let right = &self.sums[start + columns.before[1]..][..2];
        let before = N::vector(simd, left[0]).combine(N::vector(simd, right[0]));
        let after = N::vector(simd, left[1]).combine(N::vector(simd, right[1]));
        before + (after - before) * columns.beyond
    }
}

impl Cut {
    /// Of a place on an axis of so many texels.
    #[inline(always)]
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "`as` saturates, and places are clamped to their level"
    )]
    fn new(at: f64, side: u32) -> Self {
        let before = (at as u32).min(side - 1);
        Self {
            before: before as usize,
            beyond: at - f64::from(before),
        }
    }
}

/// What [`stretches`] finds first, where that counts once and is all.
#[inline(always)]
fn one_stretch(wrap: Wrap, side: f64, at: f64, half: f64) -> Option<[f64; 2]> {
    let half = half.min(REACH);
    let from = at - half;
    if wrap == Wrap::Clamp {
        let to = at + half;
        return (from >= 0.0 && to <= side).then_some([from, to]);
    }
    let period = if wrap == Wrap::Repeat { side } else { 2.0 * side };
    let from = from - (from / period).floor() * period;
    let to = from + 2.0 * half;
    // Below zero, or no number, is what is far away.
    if 2.0 * half >= period || from.is_nan() || from < 0.0 {
        None
    } else if to <= side {
        Some([from, to])
    } else if wrap == Wrap::Mirror && from >= side && to <= period {
        Some([side - (to - side), side - (from - side)])
    } else {
        None
    }
}

impl Number for f64 {
    #[inline(always)]
    fn vector<S: Simd>(simd: S, numbers: [Self; 4]) -> f64x4<S> {
        f64x4::simd_from(simd, numbers)
    }
}

impl Number for u32 {
    #[inline(always)]
    fn vector<S: Simd>(simd: S, numbers: [Self; 4]) -> f64x4<S> {
        /// A float in whose lower bits a whole number stands as it is.
        const WHOLE: f64 = (1_u64 << 52) as f64;
        let (low, high): (u64x2<S>, u64x2<S>) = u32x4::simd_from(simd, numbers).widen();
        let bits = low.combine(high) | WHOLE.to_bits();
        bits.bitcast::<f64x4<S>>() - f64x4::splat(simd, WHOLE)
    }
}

#[cfg(test)]
mod tests {
    use fearless_simd::dispatch;

    use super::super::{MipPyramid, oracle};
    use super::*;
    use crate::color::ResolveSpace;
    use crate::simd;

    #[test]
    fn means_are_those_of_one_box_after_the_other() {
        let (mut alone, mut across) = (0, 0);
        arbtest::arbtest(|u| {
            let pyramid: MipPyramid = oracle::pyramid(u)?;
            let space = *u.choose(&ResolveSpace::ALL)?;
            let table = SummedAreaTable::build(&pyramid.levels()[0], space);
            let [width, height] = table.size().map(f64::from);
            for _ in 0..30 {
                let mut number = |most: f64| Ok(f64::from(u.int_in_range(0..=1_000_000)?) / 1e6 * most);
                let sides = DVec2::new(
                    1.0 + number(3.0)? * number(width)?,
                    1.0 + number(3.0)? * number(height)?,
                );
                let at = DVec2::new(number(4.0)? - 1.5, number(4.0)? - 1.5) * DVec2::new(width, height);
                let at = if u.arbitrary()? { at } else { (at * 8.0).round() / 8.0 };
                let area = TexelBox { level: 0, sides };
                for wrap in Wrap::ALL {
                    let expected = table.mean(at, &area, wrap);
                    let is_alone = one_stretch(wrap, width, at.x, sides.x * 0.5).is_some()
                        && one_stretch(wrap, height, at.y, sides.y * 0.5).is_some();
                    *(if is_alone { &mut alone } else { &mut across }) += 1;
                    for (name, level) in simd::tested() {
                        let found = dispatch!(level, simd => mean(simd, &table, at, &area, wrap));
                        assert_eq!(found, expected, "{name}: {space:?} {wrap:?} {at:?} {area:?}");
                    }
                }
            }
            Ok(())
        })
        .budget_ms(800);
        assert!(alone > 100 && across > 100, "both ways: {alone} and {across}");
    }
}
