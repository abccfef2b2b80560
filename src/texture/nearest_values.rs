//! What the bytes of the nearest texels count by a table, summed over the samples of pixels: their light, for one.
//!
//! Where a pixel's samples are spread over less than a texel, they lie in at most four. Then it is enough to count how many
//! lie in each, and a pixel takes four texels instead of one for every sample:
//!
//! ```text
//!        o  o | o  o
//!        o  o | o  o        left of one edge: 8
//!      -------+-------      above the other: 8
//!        o  o | o  o        both: 4
//!        o  o | o  o
//! ```

#![expect(
    clippy::inline_always,
    reason = "a function that is not inlined into its dispatch loses the vector instructions"
)]

use fearless_simd::prelude::*;
use fearless_simd::{Level, Simd, dispatch};

use super::filter_plan::Plan;
use super::fixed_point::FRACTION_BITS;
use super::nearest_sums::{FEW, Found, MANY, NearestSamples, exact_colors, is_uncertain};
use super::texel_coordinates::MAX_LANES;

/// Some pixels, where their samples lie, and what a byte counts.
#[derive(Clone, Copy, Debug)]
pub struct ValueList<'a> {
    /// Column and row of each pixel, counted from the grid's origin.
    pub pixels: &'a [[u16; 2]],
    /// Samples per pixel.
    pub count: usize,
    /// Column and row of each sample in its pixel, one pixel after the other; only those of one where they are the same in all.
    pub inside: &'a [[u8; 2]],
    /// What each byte counts.
    pub values: ByteValues<'a>,
}

/// What each byte counts.
#[derive(Clone, Copy, Debug)]
pub enum ByteValues<'a> {
    /// 256 times itself.
    Stored,
    /// What stands there, at most `2^31`.
    Table(&'a [u32; 256]),
}

/// How many samples of a vector of pixels lie in each of the four texels that have any.
struct Counted<S: Simd> {
    texels: [[u32; MAX_LANES]; 4],
    counts: [[u32; MAX_LANES]; 4],
    /// As in [`Found`].
    distance: S::i16s,
}

/// Where the first of the four texels lies at least, for each axis.
#[derive(Clone, Copy)]
struct FirstTexel([i32; 2]);

/// Red, green and blue of what all samples of each pixel count, which lie in the same places in all; `false` where other texels than
/// the nearest are read.
pub(super) fn sum(level: Level, plan: &Plan<'_>, side: u32, list: ValueList<'_>, sums: &mut [[u64; 3]]) -> bool {
    if list.inside.len() > FEW {
        sum_of::<MANY>(level, plan, side, list, sums)
    } else {
        sum_of::<FEW>(level, plan, side, list, sums)
    }
}

// Not inlined: its memory is not for lists that do not need it.
#[inline(never)]
fn sum_of<const N: usize>(
    level: Level,
    plan: &Plan<'_>,
    side: u32,
    list: ValueList<'_>,
    sums: &mut [[u64; 3]],
) -> bool {
    let Some(samples) = NearestSamples::<N>::of_places(plan, side, list.inside) else {
        return false;
    };
    match FirstTexel::of_few(&samples) {
        Some(first) => dispatch!(level, simd => sum_counted(simd, (plan, side), (&samples, first), list, sums)),
        None => dispatch!(level, simd => sum_each(simd, (plan, side), &samples, list, sums)),
    }
    true
}

/// By counting in which texels samples lie.
#[inline(always)]
fn sum_counted<S: Simd, const N: usize>(
    simd: S,
    (plan, side): (&Plan<'_>, u32),
    (samples, first): (&NearestSamples<'_, N>, FirstTexel),
    list: ValueList<'_>,
    sums: &mut [[u64; 3]],
) {
    let (lanes, middle) = (S::u32s::LEN, samples.middle(plan));
    let texels = samples.level.level.texels();
    for (pixels, sums) in list.pixels.chunks(lanes).zip(sums.chunks_mut(lanes)) {
        let at = samples.centres(simd, pixels, middle);
        let level = &samples.level;
        let centres = [
            at.around(simd, &level.x, samples.x.reach),
            at.around(simd, &level.y, samples.y.reach),
        ];
        let counted = Counted::new(simd, samples, first, centres);
        for (lane, (sum, pixel)) in sums.iter_mut().zip(pixels).enumerate() {
            if is_uncertain::<S>(counted.distance, lane) {
                *sum = exact::<S, N>(simd, (plan, side), *pixel, list);
                continue;
            }
            *sum = [0; 3];
            for (texel, count) in counted.texels.iter().zip(&counted.counts) {
                let [texel, count] = [texel, count].map(|of_lanes| of_lanes[lane % MAX_LANES]);
                add(sum, texels[texel as usize], count, list.values);
            }
        }
    }
}

/// By reading the texel of each sample.
#[inline(always)]
fn sum_each<S: Simd, const N: usize>(
    simd: S,
    (plan, side): (&Plan<'_>, u32),
    samples: &NearestSamples<'_, N>,
    list: ValueList<'_>,
    sums: &mut [[u64; 3]],
) {
    let (lanes, middle) = (S::u32s::LEN, samples.middle(plan));
    let texels = samples.level.level.texels();
    let mut found = Found::<S, N>::new(simd);
    for (pixels, sums) in list.pixels.chunks(lanes).zip(sums.chunks_mut(lanes)) {
        found.find(simd, samples, pixels, middle);
        for (lane, (sum, pixel)) in sums.iter_mut().zip(pixels).enumerate() {
            if found.is_uncertain(lane) {
                *sum = exact::<S, N>(simd, (plan, side), *pixel, list);
                continue;
            }
            *sum = [0; 3];
            for texel in &found.texels[..samples.count] {
                add(sum, texels[texel[lane % MAX_LANES] as usize], 1, list.values);
            }
        }
    }
}

/// What the samples of a pixel count as they are decided one by one.
#[cold]
#[inline(never)]
fn exact<S: Simd, const N: usize>(
    simd: S,
    (plan, side): (&Plan<'_>, u32),
    pixel: [u16; 2],
    list: ValueList<'_>,
) -> [u64; 3] {
    let mut sum = [0; 3];
    let inside = list.inside.iter().map(|place| place.map(u32::from));
    exact_colors::<S, N>(simd, plan, (side, pixel), inside, |color| {
        add(
            &mut sum,
            color.0.map(|channel| channel.to_be_bytes()[0]),
            1,
            list.values,
        );
    });
    sum
}

/// Adds what a texel counts, so many times.
#[inline(always)]
pub(super) fn add(sum: &mut [u64; 3], [r, g, b, _]: [u8; 4], count: u32, values: ByteValues<'_>) {
    for (sum, byte) in sum.iter_mut().zip([r, g, b]) {
        let value = match values {
            ByteValues::Stored => u32::from(byte) << 8,
            ByteValues::Table(values) => values[usize::from(byte)],
        };
        *sum += u64::from(value) * u64::from(count);
    }
}

impl FirstTexel {
    /// Where all samples lie in four texels at most; not of textures that go on for ever, which have no order.
    fn of_few<const N: usize>(samples: &NearestSamples<'_, N>) -> Option<Self> {
        const ONE: i32 = 1 << FRACTION_BITS;
        let mut least = [0; 2];
        for (least, axis) in least.iter_mut().zip([&samples.x, &samples.y]) {
            let offsets = || axis.of_samples[..samples.count].iter().copied();
            *least = offsets().min()?;
            if offsets().max()? - *least >= ONE {
                return None;
            }
        }
        samples.endless.is_none().then_some(Self(least))
    }
}

impl<S: Simd> Counted<S> {
    /// Of pixels whose centres lie there, in fixed point.
    #[inline(always)]
    fn new<const N: usize>(
        simd: S,
        samples: &NearestSamples<'_, N>,
        FirstTexel([left, top]): FirstTexel,
        [x, y]: [S::i32s; 2],
    ) -> Self {
        let number = |value: i32| S::i32s::splat(simd, value);
        let (column, row) = ((x + number(left)) >> FRACTION_BITS, (y + number(top)) >> FRACTION_BITS);
        // From the edges behind these.
        let right = x - ((column + number(1)) << FRACTION_BITS);
        let down = y - ((row + number(1)) << FRACTION_BITS);
        let fraction: S::i16s = number((1 << FRACTION_BITS) - 1).bitcast();
        let mut distance = S::i16s::splat(simd, i16::MAX);
        let (mut before, mut above, mut both) = (number(0), number(0), number(0));
        let offsets = samples.x.of_samples.iter().zip(&samples.y.of_samples);
        for (x, y) in offsets.take(samples.count) {
            let (x, y) = (right + number(*x), down + number(*y));
            // The upper halves are no distances, and nobody looks at them.
            distance = distance
                .min(x.bitcast::<S::i16s>() & fraction)
                .min(y.bitcast::<S::i16s>() & fraction);
            // What lies before an edge is below zero: one less for each.
            before += x >> 31;
            above += y >> 31;
            both += (x & y) >> 31;
        }
        let all = number(i32::try_from(samples.count).unwrap_or(i32::MAX));
        let counts = [
            number(0) - both,
            both - above,
            both - before,
            all + before + above - both,
        ];
        let mut counted = Self {
            texels: [[0; MAX_LANES]; 4],
            counts: [[0; MAX_LANES]; 4],
            distance,
        };
        let level = samples.level.level;
        let last = [level.width(), level.height()].map(|size| size.cast_signed() - 1);
        let last: S::i16s = number(last[0] | last[1] << 16).bitcast();
        let stride: S::i16s = number(1 | level.stride().cast_signed() << 16).bitcast();
        let steps = [(0, 0), (1, 0), (0, 1), (1, 1)];
        for (i, ((right, down), count)) in steps.into_iter().zip(counts).enumerate() {
            let (column, row) = (column + number(right), row + number(down));
            let at: S::i16s = (column & number(0xFFFF) | row << 16).bitcast();
            let inside = at.max(S::i16s::splat(simd, 0)).min(last);
            let texel: S::u32s = inside.pairwise_dot_product(stride).bitcast();
            texel.store_slice(&mut counted.texels[i][..S::u32s::LEN]);
            let count: S::u32s = count.bitcast();
            count.store_slice(&mut counted.counts[i][..S::u32s::LEN]);
        }
        counted
    }
}

#[cfg(test)]
mod tests {
    use arbtest::arbitrary::Result;

    use super::super::oracle;
    use super::*;
    use crate::simd;

    #[test]
    fn values_are_those_of_each_sample() {
        let table = std::array::from_fn(|byte| u32::try_from(byte * byte).expect("a few bits") << 12 | 5);
        let (mut few, mut other) = (0, 0);
        arbtest::arbtest(|u| {
            let pyramid = oracle::pyramid(u)?;
            let map = oracle::map(u, &pyramid.levels()[0])?;
            let grid = oracle::grid(u, &map)?;
            let filter = oracle::nearest(u, &pyramid, &map)?;
            let plan = filter.plan(grid);
            let side = u8::try_from(grid.side).expect("at most 16");
            let all = u32::from(side) * u32::from(side);
            let inside: Vec<[u8; 2]> = if u.arbitrary()? {
                (0..side)
                    .flat_map(|row| (0..side).map(move |column| [column, row]))
                    .collect()
            } else {
                let mut at = || u.int_in_range(0..=side - 1);
                (0..=all / 2).map(|_| Ok([at()?, at()?])).collect::<Result<_>>()?
            };
            let mut pixel = || Ok([u.int_in_range(0..=70)?, u.int_in_range(0..=70)?]);
            let pixels: Vec<[u16; 2]> = (0..21).map(|_| pixel()).collect::<Result<_>>()?;
            let list = ValueList {
                pixels: &pixels,
                count: inside.len(),
                inside: &inside,
                values: *u.choose(&[ByteValues::Stored, ByteValues::Table(&table)])?,
            };
            let expected = oracle::value_sums(&plan, grid.side, list);
            for (name, level) in simd::tested() {
                let mut found = vec![[0; 3]; pixels.len()];
                if !sum(level, &plan, grid.side, list, &mut found) {
                    return Ok(());
                }
                assert_eq!(found, expected, "{name}: {filter:?} {grid:?} {inside:?}");
            }
            let samples = NearestSamples::<MANY>::of_places(&plan, grid.side, &inside);
            let counted = samples.and_then(|samples| FirstTexel::of_few(&samples));
            *(if counted.is_some() { &mut few } else { &mut other }) += 1;
            Ok(())
        })
        .budget_ms(if cfg!(feature = "scalar") { 8000 } else { 1500 });
        assert!(few > 20 && other > 20, "both ways were taken: {few} and {other}");
    }
}
