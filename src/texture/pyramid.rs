//! The pyramid: an image at every resolution down to one texel (Williams, "Pyramidal parametrics", SIGGRAPH 1983).

use rayon::prelude::*;

/// The longest side of a level, in texels.
pub const MAX_SIDE: u32 = 16_384;

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

/// All resolutions of an image; level 0 is the image itself, the last level is a single texel.
#[derive(Clone, Debug)]
pub struct MipPyramid {
    levels: Vec<MipLevel>,
    opaque: bool,
}

/// A level before its texels are rounded to bytes, so that rounding does not pile up from level to level.
struct ExactLevel {
    width: u32,
    height: u32,
    texels: Vec<[f32; 4]>,
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
        assert!(width > 0 && height > 0, "a level has at least one texel");
        assert!(width.max(height) <= MAX_SIDE, "a side has at most {MAX_SIDE} texels");
        assert_eq!(texels.len(), width as usize * height as usize, "one colour per texel");
        let stride = width;
        texels.resize(texels.len() + padding(stride), [0; 4]);
        Self {
            width,
            height,
            stride,
            texels,
        }
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
    fn rows(&self) -> impl IndexedParallelIterator<Item = &[[u8; 4]]> {
        let used = self.stride as usize * self.height as usize;
        let rows = self.texels[..used].par_chunks_exact(self.stride as usize);
        rows.map(|row| &row[..self.width as usize])
    }

    fn to_exact(&self) -> ExactLevel {
        let texels = self.rows().flatten_iter().map(|texel| texel.map(f32::from)).collect();
        ExactLevel {
            width: self.width,
            height: self.height,
            texels,
        }
    }
}

impl MipPyramid {
    /// Builds every level from the base, rows in parallel. Each level is the area-weighted mean of the one above it,
    /// also where a side is odd; texels are rounded to bytes only once.
    pub fn build(base: MipLevel) -> Self {
        let opaque = base.rows().all(|row| row.iter().all(|texel| texel[3] == u8::MAX));
        let mut levels = vec![base];
        if levels[0].width > 1 || levels[0].height > 1 {
            let mut exact = levels[0].to_exact().halved();
            levels.push(exact.to_level());
            while exact.width > 1 || exact.height > 1 {
                exact = exact.halved();
                levels.push(exact.to_level());
            }
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
    /// The next coarser level: half as wide and high, rounded down, at least one texel.
    fn halved(&self) -> Self {
        let (width, height) = ((self.width / 2).max(1), (self.height / 2).max(1));
        let columns = shares(self.width, width);
        let rows = shares(self.height, height);
        let stride = self.width as usize;
        let mut texels = vec![[0.0; 4]; width as usize * height as usize];
        texels.par_chunks_mut(width as usize).zip(&rows).for_each(|(out, row)| {
            for (texel, column) in out.iter_mut().zip(&columns) {
                for (j, row_weight) in row.weights.iter().enumerate().filter(|(_, weight)| **weight > 0.0) {
                    let line = &self.texels[(row.first + j) * stride..][..stride];
                    for (i, weight) in column.weights.iter().enumerate().filter(|(_, weight)| **weight > 0.0) {
                        let source = line[column.first + i];
                        for (sum, channel) in texel.iter_mut().zip(source) {
                            *sum += channel * weight * row_weight;
                        }
                    }
                }
            }
        });
        Self { width, height, texels }
    }

    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "means of bytes stay bytes; `as` saturates"
    )]
    fn to_level(&self) -> MipLevel {
        let texels = self
            .texels
            .par_iter()
            .map(|texel| texel.map(|channel| (channel + 0.5) as u8))
            .collect();
        MipLevel::new(self.width, self.height, texels)
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
