//! Weighted sums of opaque samples by 32-bit floats: so near that they tell nearly every pixel.
//!
//! A sample is added to all pixels around it at once: what it weighs is the product of what its column weighs in each of their
//! columns, and its row in each of their rows. Eight columns lie side by side in a vector, and two rows.
//!
//! ```text
//!     column's weights   a b c d e f g -   a b c d e f g -
//!     row's weights      p p p p p p p p   q q q q q q q q
//!     products           what it weighs in the pixels of two rows around it
//! ```
//!
//! Rounding moves a sum by less than is known ([`super::near_means`]). Where that leaves open which pixel it is, whole numbers decide.

#![expect(
    clippy::inline_always,
    reason = "only what is inlined into a dispatched function is compiled for its vector instructions"
)]

use fearless_simd::prelude::*;
use fearless_simd::{Simd, dispatch, f32x8, f32x16};

use crate::color::{Premultiplied16, ResolveSpace};
use crate::raster::frame::block::PixelBlock;
use crate::raster::paint::sample_colors::{PixelColors, SampleColors};
use crate::raster::paint::wide::finish::{Finish, is_too_little};
use crate::raster::paint::wide::flat::{FlatPixels, PixelBits};
use crate::raster::paint::wide::free::{FreeSums, WeighedPositions};
use crate::raster::paint::wide::near_means::{FILLED, NearMeans};
use crate::raster::sampling::positions::Position;
use crate::rules::Rules;
use crate::simd;

/// Columns of pixels that a sample is added to, at most.
const COLUMNS: usize = 8;
/// Numbers that are multiplied at once: two rows of these.
const LANES: usize = 2 * COLUMNS;
/// The most vectors that all pixels around a sample fill.
const MOST_VECTORS: usize = 4;
/// Samples of a pixel that are summed up one after the other: sums of more are summed up then.
const IN_A_ROW: usize = 16;
/// Red, green, blue, and what samples weigh.
const SUMS: usize = 4;

/// Sums up weighted samples, reusing its memory.
#[derive(Debug)]
pub(super) struct NearSums {
    /// What is certain.
    exact: FreeSums,
    space: ResolveSpace,
    /// Pixels on each side.
    margin: usize,
    weights: Weights,
    means: NearMeans,
    /// The channels of the samples of the pixel at work.
    values: Vec<[f32; 4]>,
    /// The last rows of pixels, each in the place of the one that is no longer needed: all red, all green and so on.
    sums: Vec<f32>,
    /// Numbers in a row of one of these: for the pixels of the tile, and those beside it that are in reach of its margin.
    stride: usize,
}

/// What samples weigh in the pixels around them, the first of these first.
#[derive(Debug)]
enum Weights {
    /// Samples lie anywhere: what their columns and rows weigh, by these.
    Own(Vec<[f32; COLUMNS]>),
    /// At the same places in every pixel: what each weighs in two rows of pixels, sample by sample, and what all do together.
    Same {
        each: Vec<[f32; LANES]>,
        all: Vec<[f32; LANES]>,
    },
}

/// A painted tile.
#[derive(Clone, Copy)]
pub(super) struct PaintedTile<'t> {
    pub(super) colors: &'t SampleColors,
    pub(super) samples: &'t WeighedPositions,
    pub(super) flat: &'t FlatPixels,
}

/// The sums of a pixel's samples in two rows of pixels.
#[derive(Clone, Copy)]
struct Added<S: Simd> {
    red: f32x16<S>,
    green: f32x16<S>,
    blue: f32x16<S>,
    weight: f32x16<S>,
}

impl NearSums {
    /// `None` where a pixel takes samples of more pixels than fit, or where all of them weigh too little.
    pub(super) fn new(space: ResolveSpace, samples: &WeighedPositions, rules: Rules) -> Option<Self> {
        let margin = samples.weights.margin().cast_unsigned() as usize;
        let (exact, count) = (FreeSums::new(space, samples), samples.positions.count());
        if 2 * margin + 1 > COLUMNS {
            return None;
        }
        let same = exact.same();
        let weights = if same.is_empty() {
            Weights::Own(by_place(samples))
        } else if is_too_little(same.iter().map(|(all, _)| all).sum(), count) {
            return None;
        } else {
            same_weights(same, margin)
        };
        let in_a_row = count.min(IN_A_ROW) + count / IN_A_ROW;
        let means = NearMeans::new(space, samples, (same, in_a_row), rules);
        Some(Self {
            exact,
            space,
            margin,
            weights,
            means,
            values: vec![[0.0; 4]; count],
            sums: Vec::new(),
            stride: 0,
        })
    }

    /// Resolves the pixels of a tile that are not flat; whether all samples around them are opaque. If not, there is more to do.
    pub(super) fn resolve(&mut self, tile: PaintedTile<'_>, finish: &Finish<'_>, block: &mut PixelBlock<'_>) -> bool {
        let around = 2 * self.margin + 1;
        self.exact.find_places(tile.colors, &tile.samples.positions, tile.flat);
        self.stride = tile.colors.width() + LANES;
        self.sums.resize(around * SUMS * self.stride, 0.0);
        dispatch!(simd::level(), simd => match around.div_ceil(2) {
            1 => self.rows::<_, 1>(simd, tile, finish, block),
            2 => self.rows::<_, 2>(simd, tile, finish, block),
            3 => self.rows::<_, 3>(simd, tile, finish, block),
            _ => self.rows::<_, MOST_VECTORS>(simd, tile, finish, block),
        })
    }

    /// Adds each row of painted pixels to those around it, of which the first is finished then.
    #[inline(always)]
    fn rows<S: Simd, const VECTORS: usize>(
        &mut self,
        simd: S,
        tile: PaintedTile<'_>,
        finish: &Finish<'_>,
        block: &mut PixelBlock<'_>,
    ) -> bool {
        simd.vectorize(
            #[inline(always)]
            || {
                let (flat, beside) = (tile.flat, 2 * self.margin);
                let of_row = SUMS * self.stride;
                for y in 0..flat.height() + beside {
                    self.sums[y % (beside + 1) * of_row..][..of_row].fill(0.0);
                    let around = u128::from(flat.around(y, self.margin).word());
                    let mut needed = (0..=beside).fold(0, |needed, by| needed | around << by);
                    while needed != 0 {
                        let x = needed.trailing_zeros() as usize;
                        needed &= needed - 1;
                        if !self.add::<S, VECTORS>(simd, tile.colors, [x, y]) {
                            return false;
                        }
                    }
                    if let Some(row) = y.checked_sub(beside) {
                        self.finish(simd, (tile, row), finish, block);
                    }
                }
                true
            },
        )
    }

    /// Adds the pixel in this column and row of what was painted to those around it, unless it is not opaque; whether it is.
    #[inline(always)]
    fn add<S: Simd, const VECTORS: usize>(&mut self, simd: S, colors: &SampleColors, [x, y]: [usize; 2]) -> bool {
        let pixel = colors.pixel(y * colors.width() + x);
        let value = match pixel {
            PixelColors::Whole(color) if color.is_opaque() => self.means.value(color),
            PixelColors::Whole(_) => return false,
            PixelColors::Split(samples) => {
                if !self.take_apart(samples) {
                    return false;
                }
                [0.0; 4]
            }
        };
        let is_whole = matches!(pixel, PixelColors::Whole(_));
        for vector in 0..VECTORS {
            let places = self.exact.places_of([x, y]);
            let added = match (&self.weights, is_whole) {
                (Weights::Own(of), true) => whole(simd, own_sum::<S>(simd, (of, places), vector), value),
                (Weights::Own(of), false) => own::<S>(simd, (of, places), vector, &self.values),
                (Weights::Same { all, .. }, true) => whole(simd, f32x16::simd_from(simd, all[vector]), value),
                (Weights::Same { each, .. }, false) => same::<S, VECTORS>(simd, each, vector, &self.values),
            };
            self.put(simd, ([x, y], vector), added);
        }
        true
    }

    /// Takes the channels of samples apart; whether all are opaque.
    #[inline(always)]
    fn take_apart(&mut self, samples: &[Premultiplied16]) -> bool {
        let mut alpha = u16::MAX;
        for sample in samples {
            alpha = alpha.min(sample.0[3]);
        }
        if alpha != Premultiplied16::ONE {
            return false;
        }
        match self.space {
            ResolveSpace::Stored => {
                for (values, sample) in self.values.iter_mut().zip(samples) {
                    *values = NearMeans::stored(*sample);
                }
            }
            ResolveSpace::Linear => {
                for (values, sample) in self.values.iter_mut().zip(samples) {
                    *values = self.means.light(*sample);
                }
            }
        }
        true
    }

    /// Adds the sums of a pixel in this column and row of what was painted to two rows of pixels around it.
    #[inline(always)]
    fn put<S: Simd>(&mut self, simd: S, ([x, y], vector): ([usize; 2], usize), added: Added<S>) {
        let around = 2 * self.margin + 1;
        let (red, green, blue) = (added.red.split(), added.green.split(), added.blue.split());
        let weight = added.weight.split();
        let mut put = [[red.0, green.0, blue.0, weight.0], [red.1, green.1, blue.1, weight.1]];
        let count = match self.weights {
            Weights::Own(_) => SUMS,
            Weights::Same { .. } => SUMS - 1,
        };
        for (row, added) in (2 * vector..around).zip(&mut put) {
            let first = (y + 1 + row) % around * SUMS * self.stride + x;
            for (channel, added) in added.iter().enumerate().take(count) {
                if let Some(sums) = self.sums[first + channel * self.stride..].first_chunk_mut::<COLUMNS>() {
                    *sums = (f32x8::simd_from(simd, *sums) + *added).to_array();
                }
            }
        }
    }

    /// Resolves the pixels of a finished row that are not flat.
    #[inline(always)]
    fn finish<S: Simd>(
        &self,
        simd: S,
        (tile, row): (PaintedTile<'_>, usize),
        finish: &Finish<'_>,
        block: &mut PixelBlock<'_>,
    ) {
        let line = block.line(block.rect.y.start + i32::try_from(row).unwrap_or(0));
        let beside = 2 * self.margin;
        let sums = &self.sums[row % (beside + 1) * SUMS * self.stride + beside..];
        let is_same = matches!(self.weights, Weights::Same { .. });
        for run in tile.flat.mixed(row).runs() {
            for start in run.clone().step_by(FILLED) {
                let at = |sum: usize| f32x16::from_slice(simd, &sums[sum * self.stride + start..][..LANES]);
                let weight = if is_same { f32x16::splat(simd, 1.0) } else { at(3) };
                let (pixels, certain) = self.means.pixels(simd, [at(0), at(1), at(2)], weight);
                let pixels = pixels.to_array();
                let end = run.end.min(start + FILLED);
                line[start..end].copy_from_slice(&pixels[..end - start]);
                let open = PixelBits::new(!certain).first(end - start);
                for x in open.runs().flatten() {
                    let place = [start + x, row];
                    line[start + x] = finish.pixel(place, self.exact.sum(tile.colors, &tile.samples.weights, place));
                }
            }
        }
    }
}

/// What all samples of a pixel weigh together in two rows of pixels.
#[inline(always)]
fn own_sum<S: Simd>(simd: S, (of, places): (&[[f32; COLUMNS]], &[Position]), vector: usize) -> f32x16<S> {
    let mut all = f32x16::splat(simd, 0.0);
    for places in places.chunks(IN_A_ROW) {
        let mut sum = f32x16::splat(simd, 0.0);
        for place in places {
            let (columns, rows) = own_weights(simd, of, *place, vector);
            sum = columns.mul_add(rows, sum);
        }
        all += sum;
    }
    all
}

/// The sums of a pixel's samples in two rows of pixels.
#[inline(always)]
fn own<S: Simd>(
    simd: S,
    (of, places): (&[[f32; COLUMNS]], &[Position]),
    vector: usize,
    values: &[[f32; 4]],
) -> Added<S> {
    let mut all = Added::none(simd);
    for (places, values) in places.chunks(IN_A_ROW).zip(values.chunks(IN_A_ROW)) {
        let mut sum = Added::none(simd);
        for (place, value) in places.iter().zip(values) {
            let (columns, rows) = own_weights(simd, of, *place, vector);
            let weight = columns * rows;
            sum.add(simd, weight, *value);
            sum.weight += weight;
        }
        all.join(sum);
    }
    all
}

/// The same of samples at the same places in every pixel.
#[inline(always)]
fn same<S: Simd, const VECTORS: usize>(simd: S, each: &[[f32; LANES]], vector: usize, values: &[[f32; 4]]) -> Added<S> {
    let mut all = Added::none(simd);
    for (weights, values) in each.chunks(IN_A_ROW * VECTORS).zip(values.chunks(IN_A_ROW)) {
        let mut sum = Added::none(simd);
        for (weights, value) in weights.as_chunks::<VECTORS>().0.iter().zip(values) {
            sum.add(simd, f32x16::simd_from(simd, weights[vector]), *value);
        }
        all.join(sum);
    }
    all
}

/// What a sample's column weighs in each column of pixels around it, and its row in two rows of them.
#[inline(always)]
fn own_weights<S: Simd>(
    simd: S,
    of: &[[f32; COLUMNS]],
    [column, row]: Position,
    vector: usize,
) -> (f32x16<S>, f32x16<S>) {
    let columns = f32x8::simd_from(simd, of[usize::from(column)]);
    let rows = &of[usize::from(row)];
    let (upper, lower) = (
        f32x8::splat(simd, rows[2 * vector]),
        f32x8::splat(simd, rows[2 * vector + 1]),
    );
    (columns.combine(columns), upper.combine(lower))
}

/// The sums of a pixel whose samples all show this.
#[inline(always)]
fn whole<S: Simd>(_: S, weight: f32x16<S>, [red, green, blue, _]: [f32; 4]) -> Added<S> {
    Added {
        red: weight * red,
        green: weight * green,
        blue: weight * blue,
        weight,
    }
}

impl<S: Simd> Added<S> {
    #[inline(always)]
    fn none(simd: S) -> Self {
        let none = f32x16::splat(simd, 0.0);
        Self {
            red: none,
            green: none,
            blue: none,
            weight: none,
        }
    }

    /// Adds a sample, but for what it weighs.
    #[inline(always)]
    fn add(&mut self, simd: S, weight: f32x16<S>, [red, green, blue, _]: [f32; 4]) {
        self.red = weight.mul_add(f32x16::splat(simd, red), self.red);
        self.green = weight.mul_add(f32x16::splat(simd, green), self.green);
        self.blue = weight.mul_add(f32x16::splat(simd, blue), self.blue);
    }

    #[inline(always)]
    fn join(&mut self, other: Self) {
        self.red += other.red;
        self.green += other.green;
        self.blue += other.blue;
        self.weight += other.weight;
    }
}

/// What columns of samples weigh in the pixels around them, by these columns, or rows.
fn by_place(samples: &WeighedPositions) -> Vec<[f32; COLUMNS]> {
    let (weights, margin) = (&samples.weights, samples.weights.margin());
    let side = weights.of_pixel(0).len();
    let mut all = vec![[0.0; COLUMNS]; side];
    for (lane, beside) in (-margin..=margin).rev().enumerate() {
        for (of, weight) in all.iter_mut().zip(weights.of_pixel(beside)) {
            of[lane] = *weight as f32;
        }
    }
    all
}

/// What samples at the same places weigh in the pixels around them.
fn same_weights(around: &[(i64, Vec<i64>)], margin: usize) -> Weights {
    let side = 2 * margin + 1;
    let vectors = side.div_ceil(2);
    let count = around.first().map_or(0, |(_, each)| each.len());
    let mut each = vec![[0.0; LANES]; count * vectors];
    let mut all = vec![[0.0; LANES]; vectors];
    // The first pixel around a sample is the one that has it in the last pixel around itself.
    for (number, (together, weights)) in around.iter().rev().enumerate() {
        let (row, column) = (number / side, number % side);
        let (vector, lane) = (row / 2, row % 2 * COLUMNS + column);
        all[vector][lane] = *together as f32;
        for (sample, weight) in weights.iter().enumerate() {
            each[sample * vectors + vector][lane] = *weight as f32;
        }
    }
    Weights::Same { each, all }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::raster::paint::wide::random_tile::{SIZE, painted};
    use crate::raster::random::any_filter;
    use crate::raster::resolve::axis_weights::AxisWeights;
    use crate::raster::sampling::positions::{SamplePositions, lattice};
    use crate::raster::span::{Span, SpanRect};
    use crate::raster::{SamplePattern, SampleRate, Seed};

    #[test]
    fn pixels_are_those_of_whole_numbers() {
        let mut tried = 0;
        arbtest::arbtest(|u| {
            let pattern = *u.choose(&SamplePattern::ALL)?;
            let count = *u.choose(&[1_u32, 4, 9, 16, 25, 64])?;
            let (space, rules) = (*u.choose(&ResolveSpace::ALL)?, *u.choose(&Rules::ALL)?);
            let rate = SampleRate::new(count).expect("a rate");
            if !pattern.takes(rate) {
                return Ok(());
            }
            let samples = WeighedPositions {
                positions: SamplePositions::new(pattern, rate, Seed::default()),
                weights: AxisWeights::new(any_filter(u)?, lattice(pattern, rate).side()),
            };
            let Some(mut near) = NearSums::new(space, &samples, rules) else {
                return Ok(());
            };
            let margin = samples.weights.margin();
            let colors = painted(u, count.cast_signed(), margin)?;
            let margin = margin.cast_unsigned() as usize;
            let mut flat = FlatPixels::default();
            flat.find(&colors, margin);
            let [width, height] = SIZE.map(|length| usize::try_from(length).unwrap_or(0));
            let [mut found, mut expected] = [(); 2].map(|()| vec![0; width * height]);
            let [x, y] = SIZE.map(|end| Span { start: 0, end });
            let finish = Finish {
                colors: &colors,
                margin,
                space,
                rules,
                clamped: None,
            };
            let tile = PaintedTile {
                colors: &colors,
                samples: &samples,
                flat: &flat,
            };
            let mut block = PixelBlock::in_rows(SpanRect { x, y }, &mut found, width);
            if !near.resolve(tile, &finish, &mut block) {
                return Ok(());
            }
            tried += 1;
            FreeSums::new(space, &samples).each(&colors, &samples, &flat, &mut |[x, y], sum| {
                expected[y * width + x] = finish.pixel([x, y], sum);
            });
            assert_eq!(
                found, expected,
                "{pattern:?}, {count} samples, margin {margin}, {space:?}, {rules:?}"
            );
            Ok(())
        })
        .budget_ms(1500);
        assert!(tried > 20, "{tried} tiles were resolved");
    }
}
