//! What the bytes of the nearest texels count by a table, summed over the samples of pixels or over some of these: their light, for
//! one.

#![expect(
    clippy::inline_always,
    reason = "a function that is not inlined into its dispatch loses the vector instructions"
)]

use fearless_simd::prelude::*;
use fearless_simd::{Level, Simd, dispatch};

use super::covered::Covered;
use super::filter_plan::Plan;
use super::nearest_counts::{Counts, FourTexels};
use super::nearest_samples::{FEW, MANY, NearestSamples, Uncertain, ones};
use super::nearest_sums::{Found, exact_colors};
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
    /// As many as pixels; bit `j` of `masks[i]` says whether sample `j` of `pixels[i]` takes part. There are 64 samples at most, then.
    /// Without masks all take part.
    pub masks: Option<&'a [u64]>,
    /// What each byte counts.
    pub values: ByteValues<'a>,
}

impl<'a> ValueList<'a> {
    /// Whether there are no more samples than masks have bits for.
    pub(super) fn fits_masks(&self) -> bool {
        self.masks.is_none() || self.count <= 64
    }

    /// The masks of some pixels that follow each other.
    #[inline(always)]
    pub(super) fn masks_of(&self, first: usize, count: usize) -> Option<&'a [u64]> {
        self.masks.map(|masks| &masks[first..first + count])
    }
}

/// What each byte counts.
#[derive(Clone, Copy, Debug)]
pub enum ByteValues<'a> {
    /// 256 times itself.
    Stored,
    /// What stands there, at most `2^31`.
    Table(&'a [u32; 256]),
}

/// Red, green and blue of what all samples of each pixel count, which lie in the same places in all; `false` where other texels than
/// the nearest are read.
pub(super) fn sum(level: Level, plan: &Plan<'_>, side: u32, list: ValueList<'_>, sums: &mut [[u64; 3]]) -> bool {
    if !list.fits_masks() {
        false
    } else if list.inside.len() > FEW {
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
    match FourTexels::of(&samples) {
        Some(four) => dispatch!(level, simd => sum_counted(simd, (plan, side), (&samples, four), list, sums)),
        None => dispatch!(level, simd => sum_each(simd, (plan, side), &samples, list, sums)),
    }
    true
}

/// By counting in which texels samples lie.
#[inline(always)]
fn sum_counted<S: Simd, const N: usize>(
    simd: S,
    (plan, side): (&Plan<'_>, u32),
    (samples, four): (&NearestSamples<'_, N>, FourTexels),
    list: ValueList<'_>,
    sums: &mut [[u64; 3]],
) {
    let (lanes, middle) = (S::u32s::LEN, samples.middle(plan));
    let (texels, stride) = (samples.level.level.texels(), samples.level.level.stride());
    let count = u32::try_from(samples.count).unwrap_or(u32::MAX);
    let mut found = Counts::NONE;
    for (i, (pixels, sums)) in list.pixels.chunks(lanes).zip(sums.chunks_mut(lanes)).enumerate() {
        let masks = list.masks_of(i * lanes, pixels.len());
        let centres = samples.centres_around(simd, pixels, middle);
        found.count(simd, (samples, four), centres, Covered::new(simd, count, masks));
        for (sum, (first, counts)) in sums.iter_mut().zip(found.firsts.iter().zip(&found.in_texels)) {
            let mut all = [0; 3];
            for (step, shift) in [(0, 0), (stride, 16), (1, 32), (stride + 1, 48)] {
                let count = counts >> shift & 0xFFFF;
                add(&mut all, texels[(first + step) as usize], count, list.values);
            }
            *sum = all;
        }
        put_exact::<S, N>(simd, (plan, side), found.uncertain, (pixels, masks, list), sums);
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
    let mut found = Found::<N>::NONE;
    for (i, (pixels, sums)) in list.pixels.chunks(lanes).zip(sums.chunks_mut(lanes)).enumerate() {
        let masks = list.masks_of(i * lanes, pixels.len());
        let uncertain = found.find(simd, samples, (pixels, 0), middle);
        let found = &found.texels[..samples.count];
        for (lane, sum) in sums.iter_mut().enumerate() {
            let texel = |found: &[u32; MAX_LANES]| texels[found[lane % MAX_LANES] as usize];
            // Not in the list, which would be written to for each sample.
            let mut all = [0; 3];
            match masks {
                None => {
                    for found in found {
                        add(&mut all, texel(found), 1, list.values);
                    }
                }
                Some(masks) => {
                    for found in ones(masks[lane]).map_while(|sample| found.get(sample)) {
                        add(&mut all, texel(found), 1, list.values);
                    }
                }
            }
            *sum = all;
        }
        put_exact::<S, N>(simd, (plan, side), uncertain, (pixels, masks, list), sums);
    }
}

/// Puts what those pixels count for which it was not certain where their samples lie.
#[inline(always)]
fn put_exact<S: Simd, const N: usize>(
    simd: S,
    plan: (&Plan<'_>, u32),
    uncertain: Uncertain,
    (pixels, masks, list): (&[[u16; 2]], Option<&[u64]>, ValueList<'_>),
    sums: &mut [[u64; 3]],
) {
    for lane in uncertain.lanes(pixels.len()) {
        let mask = masks.map(|masks| masks[lane]);
        sums[lane] = exact::<S, N>(simd, plan, pixels[lane], (list.inside, mask, list.values));
    }
}

/// What the samples of a pixel count as they are decided one by one: those that lie there in it, or of these the ones that a mask
/// names.
#[cold]
#[inline(never)]
pub(super) fn exact<S: Simd, const N: usize>(
    simd: S,
    plan: (&Plan<'_>, u32),
    pixel: [u16; 2],
    (inside, mask, values): (&[[u8; 2]], Option<u64>, ByteValues<'_>),
) -> [u64; 3] {
    let (plan, side) = plan;
    let mut sum = [0; 3];
    let counts = |sample: u32| mask.is_none_or(|mask| mask.checked_shr(sample).unwrap_or(0) & 1 != 0);
    let counted = inside.iter().zip(0..).filter(|(_, sample)| counts(*sample));
    let inside = counted.map(|(place, _)| place.map(u32::from));
    exact_colors::<S, N>(simd, plan, (side, pixel), inside, |color| {
        let bytes = color.0.map(|channel| channel.to_be_bytes()[0]);
        add(&mut sum, bytes, 1, values);
    });
    sum
}

/// Adds what a texel counts, so many times.
#[inline(always)]
pub(super) fn add(sum: &mut [u64; 3], [r, g, b, _]: [u8; 4], count: u64, values: ByteValues<'_>) {
    for (sum, byte) in sum.iter_mut().zip([r, g, b]) {
        let value = match values {
            ByteValues::Stored => u32::from(byte) << 8,
            ByteValues::Table(values) => values[usize::from(byte)],
        };
        *sum += u64::from(value) * count;
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
            let masks = pixels.iter().map(|_| u.arbitrary()).collect::<Result<Vec<u64>>>()?;
            let list = ValueList {
                pixels: &pixels,
                count: inside.len(),
                masks: (inside.len() <= 64 && u.arbitrary()?).then_some(&masks[..]),
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
            let counted = samples.and_then(|samples| FourTexels::of(&samples));
            *(if counted.is_some() { &mut few } else { &mut other }) += 1;
            Ok(())
        })
        .budget_ms(if cfg!(feature = "scalar") { 8000 } else { 1500 });
        assert!(few > 20 && other > 20, "both ways were taken: {few} and {other}");
    }
}
