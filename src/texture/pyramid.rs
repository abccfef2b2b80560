//! The pyramid: an image at every resolution down to one texel (Williams, "Pyramidal parametrics", SIGGRAPH 1983).
//!
//! # Where texels lie in memory
//!
//! Row by row, so that one load reads two or four neighbours, with a gap after rows whose length would put the texels
//! of a column into the same few places of a cache. Measured for the four texels around a point, 64 x 64 pixels at a
//! time, in a texture of 4096 x 4096, nanoseconds per pixel:
//!
//! | texels per pixel, turned by | rows | rows and gaps | tiles of 4 x 4 | Morton order |
//! |---|---|---|---|---|
//! | 0.7, 0 degrees | 1.7 | 1.7 | 3.9 | 6.0 |
//! | 0.7, 45 degrees | 2.3 | 1.9 | 3.8 | 5.9 |
//! | 1, 30 degrees | 3.4 | 2.1 | 4.0 | 6.1 |
//! | 1.4, 90 degrees | 2.8 | 2.4 | 5.4 | 7.2 |
//! | 2, 45 degrees | 9.1 | 4.5 | 4.4 | 12.7 |
//!
//! Tiles draw level with rows only where pixels lie so far apart that a pyramid should be read anyway.

use std::borrow::Cow;

use rayon::prelude::*;

use super::PyramidFilter;
use super::pyramid_filter::weights;
use super::pyramid_values::{PyramidValues, light};
use crate::color::ResolveSpace;

/// The longest side of a level, in texels.
pub const MAX_SIDE: u32 = 16_384;

/// Texels from one row to the next: a cache line more where rows are multiples of a kilobyte.
fn stride(width: u32) -> u32 {
    const KILOBYTE: u32 = 256;
    const CACHE_LINE: u32 = 16;
    if width.is_multiple_of(KILOBYTE) {
        width + CACHE_LINE
    } else {
        width
    }
}

/// Texels after the last row that kernels may read and never use: a block of 4 x 4 texels that starts at the last one
/// reaches 3 rows and 4 texels further.
fn padding(stride: u32) -> usize {
    3 * stride as usize + 4
}

/// One resolution of an image: `width x height` premultiplied RGBA texels in rows from the top.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct MipLevel {
    width: u32,
    height: u32,
    /// Texels from one row to the next.
    stride: u32,
    /// The rows, and a padding.
    texels: Vec<[u8; 4]>,
}

/// A level, and its number in its pyramid.
#[derive(Clone, Copy, Debug)]
pub(super) struct NumberedLevel<'a> {
    pub(super) level: &'a MipLevel,
    pub(super) number: usize,
}

/// All resolutions of an image; level 0 is the image itself, the last level is a single texel.
#[derive(Clone, Debug)]
pub struct MipPyramid {
    levels: Vec<MipLevel>,
    opaque: bool,
}

/// A level before its texels are rounded to bytes, so that rounding does not pile up from level to level.
pub(super) struct ExactLevel {
    pub(super) width: u32,
    pub(super) height: u32,
    pub(super) texels: Vec<[f32; 4]>,
}

/// How texels of a finer row or column contribute to one of the coarser: at most three, with weights that sum to one.
struct Share {
    first: usize,
    weights: [f32; 3],
}

impl MipLevel {
    /// A level of `width` x `height` premultiplied RGBA texels in rows from the top.
    ///
    /// # Panics
    /// When a side is zero or above [`MAX_SIDE`], or the number of texels is not their product.
    pub fn new(width: u32, height: u32, mut texels: Vec<[u8; 4]>) -> Self {
        assert_eq!(texels.len(), width as usize * height as usize, "one colour per texel");
        if stride(width) != width {
            return Self::from_rows(width, height, |y, row| {
                row.copy_from_slice(&texels[y * width as usize..][..width as usize]);
            });
        }
        Self::check(width, height);
        texels.resize(texels.len() + padding(width), [0; 4]);
        Self {
            width,
            height,
            stride: width,
            texels,
        }
    }

    /// A level whose rows are written by `write(y, row)`, in parallel.
    pub(super) fn from_rows(width: u32, height: u32, write: impl Fn(usize, &mut [[u8; 4]]) + Sync) -> Self {
        let mut level = Self::blank(width, height);
        level.rows_mut().enumerate().for_each(|(y, row)| write(y, row));
        level
    }

    /// A level that is transparent yet.
    pub(super) fn blank(width: u32, height: u32) -> Self {
        Self::check(width, height);
        let stride = stride(width);
        Self {
            width,
            height,
            stride,
            texels: vec![[0; 4]; stride as usize * height as usize + padding(stride)],
        }
    }

    fn check(width: u32, height: u32) {
        assert!(width > 0 && height > 0, "a level has at least one texel");
        assert!(width.max(height) <= MAX_SIDE, "a side has at most {MAX_SIDE} texels");
    }

    /// Texels in a row.
    pub fn width(&self) -> u32 {
        self.width
    }

    /// Rows of texels.
    pub fn height(&self) -> u32 {
        self.height
    }

    /// The premultiplied RGBA texel in column `x` of row `y`; the nearest border texel beyond the level.
    #[inline]
    pub fn texel(&self, x: i32, y: i32) -> [u8; 4] {
        let x = x.max(0).cast_unsigned().min(self.width - 1);
        let y = y.max(0).cast_unsigned().min(self.height - 1);
        self.texels[y as usize * self.stride as usize + x as usize]
    }

    /// All texels, row by row, and a padding: a block of 4 x 4 texels may be read wherever it starts in the level.
    #[inline]
    pub(super) fn texels(&self) -> &[[u8; 4]] {
        &self.texels
    }

    /// Texels from one row to the next.
    #[inline]
    pub(super) fn stride(&self) -> u32 {
        self.stride
    }

    /// The rows without padding.
    pub(super) fn rows(&self) -> impl IndexedParallelIterator<Item = &[[u8; 4]]> {
        let used = self.stride as usize * self.height as usize;
        let rows = self.texels[..used].par_chunks_exact(self.stride as usize);
        rows.map(|row| &row[..self.width as usize])
    }

    /// A row, counted from the top.
    pub(super) fn row(&self, y: usize) -> &[[u8; 4]] {
        &self.texels[y * self.stride as usize..][..self.width as usize]
    }

    /// The same, to be written.
    pub(super) fn row_mut(&mut self, y: usize) -> &mut [[u8; 4]] {
        &mut self.texels[y * self.stride as usize..][..self.width as usize]
    }

    fn rows_mut(&mut self) -> impl IndexedParallelIterator<Item = &mut [[u8; 4]]> {
        let (width, stride) = (self.width as usize, self.stride as usize);
        let used = stride * self.height as usize;
        self.texels[..used]
            .par_chunks_exact_mut(stride)
            .map(move |row| &mut row[..width])
    }
}

impl MipPyramid {
    /// Builds every level from the base, rows in parallel. Each level is the area-weighted mean of the stored values of the one
    /// above it, also where a side is odd; texels are rounded to bytes only once.
    pub fn build(base: MipLevel) -> Self {
        Self::build_by(base, PyramidFilter::Box)
    }

    /// The same with another filter. Where that has weights below zero, texels are clamped to what a premultiplied colour can be,
    /// after the sum; what the next level is made of is not.
    pub fn build_by(base: MipLevel, filter: PyramidFilter) -> Self {
        let values = PyramidValues::new(ResolveSpace::Stored, filter);
        Self::build_with(base, filter, |row| Cow::Borrowed(row), |mean| values.texel(mean))
    }

    /// The same with means of linear light, each texel weighted by its alpha.
    pub fn build_in_light(base: MipLevel, filter: PyramidFilter) -> Self {
        let values = PyramidValues::new(ResolveSpace::Linear, filter);
        let texel = |mean| values.texel(mean);
        Self::build_with(
            base,
            filter,
            |row| Cow::Owned(row.iter().copied().map(light).collect()),
            texel,
        )
    }

    /// Builds every level from the base, whose rows `parts` takes to what is averaged; `texel` makes texels of means.
    fn build_with<C: Copy + Into<f32> + Sync + Send>(
        base: MipLevel,
        filter: PyramidFilter,
        parts: impl for<'r> Fn(&'r [[u8; 4]]) -> Cow<'r, [[C; 4]]> + Sync,
        texel: impl Fn([f32; 4]) -> [u8; 4] + Sync,
    ) -> Self {
        let opaque = base.rows().all(|row| row.iter().all(|texel| texel[3] == u8::MAX));
        let (mut width, mut height) = (base.width, base.height);
        let mut levels = vec![base];
        let mut exact: Option<ExactLevel> = None;
        while width > 1 || height > 1 {
            let size = [width, height];
            let sizes = [size, size.map(|side| (side / 2).max(1))];
            let (next, level) = match (&exact, &levels[0]) {
                (Some(exact), _) => coarser(filter, sizes, |y| Cow::Borrowed(exact.row(y)), &texel),
                (None, base) => coarser(filter, sizes, |y| parts(base.row(y)), &texel),
            };
            (width, height) = (next.width, next.height);
            exact = Some(next);
            levels.push(level);
        }
        Self { levels, opaque }
    }

    /// Whether every texel is opaque.
    pub fn is_opaque(&self) -> bool {
        self.opaque
    }

    /// The levels, finest first; never empty.
    pub fn levels(&self) -> &[MipLevel] {
        &self.levels
    }

    /// Number of the last level, the single texel.
    pub fn last_level(&self) -> usize {
        self.levels.len() - 1
    }
}

impl ExactLevel {
    /// A row, counted from the top.
    pub(super) fn row(&self, y: usize) -> &[[f32; 4]] {
        &self.texels[y * self.width as usize..][..self.width as usize]
    }
}

/// A coarser level by this filter: from a size to another one, of which each side is as long, or half as long and rounded down.
pub(super) fn coarser<'l, C: Copy + Into<f32> + 'l>(
    filter: PyramidFilter,
    sizes: [[u32; 2]; 2],
    line: impl Fn(usize) -> Cow<'l, [[C; 4]]> + Sync,
    texel: impl Fn([f32; 4]) -> [u8; 4] + Sync,
) -> (ExactLevel, MipLevel) {
    match filter {
        PyramidFilter::Box => halve(sizes, line, texel),
        PyramidFilter::Tent | PyramidFilter::Kaiser => weigh(filter, sizes, line, texel),
    }
}

/// The same by weights of more texels: rows first, then columns of what they became.
fn weigh<'l, C: Copy + Into<f32> + 'l>(
    filter: PyramidFilter,
    [size, [width, height]]: [[u32; 2]; 2],
    line: impl Fn(usize) -> Cow<'l, [[C; 4]]> + Sync,
    texel: impl Fn([f32; 4]) -> [u8; 4] + Sync,
) -> (ExactLevel, MipLevel) {
    let [columns, rows] = [weights(filter, size[0], width), weights(filter, size[1], height)];
    let mut narrow = vec![[0.0; 4]; width as usize * size[1] as usize];
    narrow
        .par_chunks_mut(width as usize)
        .enumerate()
        .for_each(|(y, narrow)| {
            let fine = line(y);
            for (sum, column) in narrow.iter_mut().zip(&columns) {
                for (weight, x) in column.weights.iter().zip(column.first..) {
                    add(sum, fine[inside(x, fine.len())].map(Into::into), *weight);
                }
            }
        });
    let mut level = MipLevel::blank(width, height);
    let mut texels = vec![[0.0; 4]; width as usize * height as usize];
    let parts = texels.par_chunks_mut(width as usize).zip(level.rows_mut());
    parts.zip(&rows).for_each(|((exact, rounded), row)| {
        for (weight, y) in row.weights.iter().zip(row.first..) {
            let start = inside(y, size[1] as usize) * width as usize;
            for (sum, fine) in exact.iter_mut().zip(&narrow[start..]) {
                add(sum, *fine, *weight);
            }
        }
        for (rounded, exact) in rounded.iter_mut().zip(exact) {
            *rounded = texel(*exact);
        }
    });
    (ExactLevel { width, height, texels }, level)
}

fn add(sum: &mut [f32; 4], part: [f32; 4], weight: f32) {
    for (sum, part) in sum.iter_mut().zip(part) {
        *sum += part * weight;
    }
}

/// The nearest of a side's texels.
fn inside(texel: i64, side: usize) -> usize {
    usize::try_from(texel).unwrap_or(0).min(side - 1)
}

/// The next coarser level of one of `size` texels, whose rows `line` tells: half as wide and high, rounded down, at least one
/// texel; or half in one of them alone. `texel` makes texels of means.
fn halve<'l, C: Copy + Into<f32> + 'l>(
    [size, [width, height]]: [[u32; 2]; 2],
    line: impl Fn(usize) -> Cow<'l, [[C; 4]]> + Sync,
    texel: impl Fn([f32; 4]) -> [u8; 4] + Sync,
) -> (ExactLevel, MipLevel) {
    let columns = shares(size[0], width);
    let rows = shares(size[1], height);
    let even = size == [2 * width, 2 * height];
    let mut level = MipLevel::blank(width, height);
    let mut exact = vec![[0.0; 4]; width as usize * height as usize];
    let parts = exact.par_chunks_mut(width as usize).zip(level.rows_mut());
    parts.zip(&rows).for_each(|((exact, rounded), row)| {
        if even {
            mean_of_four(exact, &line(row.first), &line(row.first + 1));
        } else {
            for (j, weight) in row.weights.iter().enumerate().filter(|(_, weight)| **weight > 0.0) {
                add_line(exact, &line(row.first + j), &columns, *weight);
            }
        }
        for (rounded, exact) in rounded.iter_mut().zip(exact) {
            *rounded = texel(*exact);
        }
    });
    let exact = ExactLevel {
        width,
        height,
        texels: exact,
    };
    (exact, level)
}

/// The means of 2 x 2 texels.
fn mean_of_four<C: Copy + Into<f32>>(means: &mut [[f32; 4]], upper: &[[C; 4]], lower: &[[C; 4]]) {
    let (upper, lower) = (upper.as_chunks::<2>().0, lower.as_chunks::<2>().0);
    for ((mean, [a, b]), [c, d]) in means.iter_mut().zip(upper).zip(lower) {
        for (i, mean) in mean.iter_mut().enumerate() {
            let sum = a[i].into() + b[i].into() + c[i].into() + d[i].into();
            *mean = sum * 0.25;
        }
    }
}

/// Adds the shares of a finer line to those of a coarser one.
fn add_line<C: Copy + Into<f32>>(sums: &mut [[f32; 4]], line: &[[C; 4]], columns: &[Share], row_weight: f32) {
    for (sum, column) in sums.iter_mut().zip(columns) {
        for (weight, source) in column.weights.iter().zip(&line[column.first..]) {
            for (sum, channel) in sum.iter_mut().zip(source) {
                *sum += (*channel).into() * weight * row_weight;
            }
        }
    }
}

/// The overlap of each of `coarse` equal intervals with `fine` unit intervals, as weights that sum to one.
fn shares(fine: u32, coarse: u32) -> Vec<Share> {
    let ratio = f64::from(fine) / f64::from(coarse);
    (0..coarse)
        .map(|i| {
            let (start, end) = (f64::from(i) * ratio, f64::from(i + 1) * ratio);
            // An odd side of 2k + 1 texels gives k intervals of 2 + 1/k: each touches three texels at most.
            let first = i as usize * fine as usize / coarse as usize;
            let overlap = |j: usize| {
                let left = (first + j) as f64;
                ((end.min(left + 1.0) - start.max(left)) / ratio).max(0.0)
            };
            let last = fine as usize - first;
            let weights = std::array::from_fn(|j| if j < last { narrow(overlap(j)) } else { 0.0 });
            Share { first, weights }
        })
        .collect()
}

#[expect(clippy::cast_possible_truncation, reason = "a weight in 0..=1 loses only digits")]
fn narrow(weight: f64) -> f32 {
    // Overlaps that are only rounding noise would read a texel that does not belong here.
    if weight < 1e-9 { 0.0 } else { weight as f32 }
}

#[cfg(test)]
mod tests {
    use arbtest::arbitrary;

    use super::*;

    fn mean(level: &MipLevel) -> [f64; 4] {
        let mut sum = [0.0; 4];
        let texels: Vec<_> = level.rows().flatten_iter().copied().collect();
        for texel in &texels {
            for (sum, channel) in sum.iter_mut().zip(texel) {
                *sum += f64::from(*channel);
            }
        }
        sum.map(|sum| sum / texels.len() as f64)
    }

    #[test]
    fn means_of_light_are_brighter_than_those_of_stored_values() {
        let [black, white] = [[0, 0, 0, 255], [255; 4]];
        let checker = || MipLevel::new(2, 2, vec![black, white, white, black]);
        let top = |pyramid: MipPyramid| pyramid.levels()[1].texel(0, 0);
        assert_eq!(
            top(MipPyramid::build(checker())),
            [128, 128, 128, 255],
            "half of the value"
        );
        // IEC 61966-2-1: half of the light is 0.7354 of the value.
        assert_eq!(
            top(MipPyramid::build_in_light(checker(), PyramidFilter::Box)),
            [188, 188, 188, 255],
            "half of the light"
        );
        let half_clear = MipLevel::new(2, 1, vec![white, [0; 4]]);
        assert_eq!(
            top(MipPyramid::build_in_light(half_clear, PyramidFilter::Box)),
            [128; 4],
            "white, half as opaque"
        );
    }

    #[test]
    fn even_images_stay_as_they_are_in_light() {
        arbtest::arbtest(|u| {
            let (width, height) = (u.int_in_range(1..=9)?, u.int_in_range(1..=9)?);
            let alpha: u8 = *u.choose(&[255, 255, 0, 90, 200])?;
            let mut channel = || u.int_in_range(0..=alpha);
            let texel = [channel()?, channel()?, channel()?, alpha];
            let base = MipLevel::new(width, height, vec![texel; (width * height) as usize]);
            let pyramid = MipPyramid::build_in_light(base, *u.choose(&PyramidFilter::ALL)?);
            for level in pyramid.levels() {
                let found = level.texel(0, 0);
                // Premultiplied bytes tell no more of a colour than its alpha lets them.
                let near = found
                    .iter()
                    .zip(texel)
                    .all(|(a, b)| a.abs_diff(b) <= u8::from(alpha < 255));
                assert!(near, "{texel:?} became {found:?}");
            }
            Ok(())
        })
        .budget_ms(200);
    }

    #[test]
    fn pyramid_ends_in_one_texel_that_is_the_mean() {
        arbtest::arbtest(|u| {
            let (width, height) = (u.int_in_range(1..=33)?, u.int_in_range(1..=33)?);
            let texels = (0..width * height)
                .map(|_| u.arbitrary())
                .collect::<arbitrary::Result<Vec<[u8; 4]>>>()?;
            let pyramid = MipPyramid::build(MipLevel::new(width, height, texels));
            let last = &pyramid.levels()[pyramid.last_level()];
            assert_eq!((last.width(), last.height()), (1, 1), "the top of {width}x{height}");
            let expected = mean(&pyramid.levels()[0]);
            for level in pyramid.levels() {
                for (found, expected) in mean(level).iter().zip(expected) {
                    // Each texel is rounded once, by half a level at most.
                    assert!(
                        (found - expected).abs() <= 0.51,
                        "mean {found} of a level, {expected} of the base"
                    );
                }
            }
            Ok(())
        })
        .budget_ms(300);
    }

    #[test]
    fn levels_of_every_filter_are_those_of_all_weights_at_once() {
        arbtest::arbtest(|u| {
            let (width, height) = (u.int_in_range(1..=21)?, u.int_in_range(1..=21)?);
            let filter = *u.choose(&[PyramidFilter::Tent, PyramidFilter::Kaiser])?;
            let texels = (0..width * height)
                .map(|_| u.arbitrary().map(|[r, g, b]: [u8; 3]| [r, g, b, 255]))
                .collect::<arbitrary::Result<Vec<[u8; 4]>>>()?;
            let base = MipLevel::new(width, height, texels);
            let pyramid = MipPyramid::build_by(base.clone(), filter);
            let Some(level) = pyramid.levels().get(1) else {
                return Ok(());
            };
            let columns = weights(filter, width, level.width());
            let rows = weights(filter, height, level.height());
            for (y, row) in rows.iter().enumerate() {
                for (x, column) in columns.iter().enumerate() {
                    let mut red = 0.0;
                    for (down, j) in row.weights.iter().zip(row.first..) {
                        for (across, i) in column.weights.iter().zip(column.first..) {
                            let [i, j] = [i, j].map(|at| i32::try_from(at).unwrap());
                            red += f64::from(base.texel(i, j)[0]) * f64::from(*down) * f64::from(*across);
                        }
                    }
                    let found = f64::from(level.texel(i32::try_from(x).unwrap(), i32::try_from(y).unwrap())[0]);
                    assert!(
                        (found - red.clamp(0.0, 255.0)).abs() < 0.51,
                        "{filter:?}: {found}, not {red}"
                    );
                }
            }
            Ok(())
        })
        .budget_ms(300);
    }

    #[test]
    fn sharp_filter_rings_and_stays_a_colour() {
        let stripe: Vec<[u8; 4]> = (0..32)
            .map(|x| if (8..24).contains(&x) { [255; 4] } else { [0; 4] })
            .collect();
        let level = |filter| MipPyramid::build_by(MipLevel::new(32, 1, stripe.clone()), filter).levels()[1].clone();
        let [soft, hard, sharp] = PyramidFilter::ALL.map(level);
        assert_eq!([soft.texel(3, 0)[3], soft.texel(4, 0)[3]], [0, 255], "its own texels");
        assert_eq!(
            [hard.texel(3, 0)[3], hard.texel(4, 0)[3]],
            [32, 223],
            "an eighth of the neighbours"
        );
        assert!(sharp.texel(5, 0)[3] == 255 && sharp.texel(2, 0)[3] == 0, "clamped");
        let is_colour = |x| {
            sharp.texel(x, 0)[..3]
                .iter()
                .all(|channel| *channel <= sharp.texel(x, 0)[3])
        };
        assert!((0..16).all(is_colour), "premultiplied");
    }

    #[test]
    fn pyramid_sides_halve_rounded_down() {
        let pyramid = MipPyramid::build(MipLevel::new(5, 2, vec![[9, 9, 9, 255]; 10]));
        let sides: Vec<_> = pyramid
            .levels()
            .iter()
            .map(|level| (level.width(), level.height()))
            .collect();
        assert_eq!(sides, [(5, 2), (2, 1), (1, 1)], "levels of 5x2");
    }

    #[test]
    fn pyramid_weighs_odd_sides_by_area() {
        let level = MipLevel::new(3, 1, vec![[30, 0, 0, 255], [60, 0, 0, 255], [90, 30, 0, 255]]);
        let top = MipPyramid::build(level).levels()[1].texel(0, 0);
        assert_eq!(top, [60, 10, 0, 255], "a third each");
        let wide = MipLevel::new(5, 1, [0, 0, 100, 0, 0].map(|red| [red, 0, 0, 255]).to_vec());
        let pyramid = MipPyramid::build(wide);
        let half = &pyramid.levels()[1];
        assert_eq!(
            [half.texel(0, 0)[0], half.texel(1, 0)[0]],
            [20, 20],
            "the middle texel goes to both halves"
        );
    }

    #[test]
    fn pyramid_of_a_constant_is_constant() {
        for (width, height) in [(1, 1), (7, 3), (640, 479), (1, 100)] {
            let texel = [201, 3, 77, 255];
            let pyramid = MipPyramid::build(MipLevel::new(width, height, vec![texel; (width * height) as usize]));
            let same = pyramid
                .levels()
                .iter()
                .all(|level| level.rows().flatten_iter().all(|found| *found == texel));
            assert!(same, "{width}x{height}");
        }
    }
}
