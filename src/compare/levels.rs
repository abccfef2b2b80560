//! What the bytes say: how many pixels differ, by how much, and the mean errors.

use rayon::prelude::*;

use super::Pair;

/// Rows that one thread counts at a time.
const ROWS: usize = 16;

/// Differences of two pictures' channels in levels of 255.
///
/// Alpha counts as a fourth channel where any pixel of either picture is not opaque, and alone where one is wholly transparent.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Levels {
    /// Pixels in either picture.
    pub pixels: u64,
    /// Channels that count: 3, or 4 with alpha.
    pub channels: u8,
    /// Where red, green, blue and alpha differ most; `None` where a channel is equal everywhere.
    pub largest: [Option<Largest>; 4],
    /// How many pixels have this largest difference among their channels; `[0]` counts the equal ones.
    by_largest: Box<[u64; 256]>,
    /// Sum over pixels and channels.
    absolute: u64,
    /// Sum over pixels and channels, in levels squared.
    squared: u64,
}

/// The largest difference of a channel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Largest {
    /// In levels of 255, above zero.
    pub level: u8,
    /// Column and row of the first pixel that has it, in reading order.
    pub at: [u32; 2],
}

impl Levels {
    /// Pixels of which a channel differs by more than `tolerance` levels.
    pub fn beyond(&self, tolerance: u8) -> u64 {
        self.by_largest.iter().skip(usize::from(tolerance) + 1).sum()
    }

    /// Pixels that differ at all.
    pub fn differing(&self) -> u64 {
        self.beyond(0)
    }

    /// The largest difference of any channel, in levels; 0 for equal pictures.
    pub fn largest_level(&self) -> u8 {
        self.largest
            .iter()
            .flatten()
            .map(|largest| largest.level)
            .max()
            .unwrap_or(0)
    }

    /// Mean absolute error over pixels and channels, in levels.
    pub fn mae(&self) -> f64 {
        self.mean(self.absolute)
    }

    /// Root mean square error over pixels and channels, in levels.
    pub fn rmse(&self) -> f64 {
        self.mean(self.squared).sqrt()
    }

    /// Peak signal-to-noise ratio `20 log10(255 / RMSE)` in decibels; infinite for equal pictures.
    pub fn psnr(&self) -> f64 {
        20.0 * (255.0 / self.rmse()).log10()
    }

    fn mean(&self, sum: u64) -> f64 {
        let count = self.pixels * u64::from(self.channels);
        if count == 0 { 0.0 } else { exact(sum) / exact(count) }
    }
}

/// Sums stay far below 2^53: a frame has at most 2^28 pixels of 4 channels, a square is below 2^16.
fn exact(sum: u64) -> f64 {
    sum as f64
}

impl Pair<'_> {
    /// Counts the differences of all channels.
    pub fn levels(self) -> Levels {
        let length = (self.a.width() as usize * ROWS).max(1);
        let parts = self
            .a
            .pixels()
            .par_chunks(length)
            .zip(self.b.pixels().par_chunks(length));
        let count = parts
            .enumerate()
            .map(|(i, (a, b))| Count::of(a, b, i * length))
            .reduce(Count::default, |one, other| one.and(&other));
        let width = self.a.width() as usize;
        let largest = count.largest.map(|(level, index)| {
            let at = [index % width.max(1), index / width.max(1)].map(|side| u32::try_from(side).unwrap_or(u32::MAX));
            (level > 0).then_some(Largest { level, at })
        });
        Levels {
            pixels: self.a.pixels().len() as u64,
            channels: if count.opaque { 3 } else { 4 },
            largest,
            by_largest: count.by_largest,
            absolute: count.absolute,
            squared: count.squared,
        }
    }
}

/// The differences of a part of two pictures.
struct Count {
    opaque: bool,
    /// Of red, green, blue, alpha: the level and the index of its first pixel.
    largest: [(u8, usize); 4],
    by_largest: Box<[u64; 256]>,
    absolute: u64,
    squared: u64,
}

impl Default for Count {
    fn default() -> Self {
        Self {
            opaque: true,
            largest: [(0, usize::MAX); 4],
            by_largest: Box::new([0; 256]),
            absolute: 0,
            squared: 0,
        }
    }
}

impl Count {
    /// Pixels `0xAARRGGBB`, of which the first has the index `first`.
    fn of(a: &[u32], b: &[u32], first: usize) -> Self {
        let mut count = Self::default();
        let mut alphas = u32::MAX;
        for (i, (a, b)) in (first..).zip(a.iter().zip(b)) {
            alphas &= a & b;
            if a == b {
                count.by_largest[0] += 1;
                continue;
            }
            let levels = channel_levels(*a, *b);
            let mut most = 0;
            for (level, largest) in levels.into_iter().zip(&mut count.largest) {
                if level > largest.0 {
                    *largest = (level, i);
                }
                most = most.max(level);
                count.absolute += u64::from(level);
                count.squared += u64::from(level) * u64::from(level);
            }
            count.by_largest[usize::from(most)] += 1;
        }
        count.opaque = alphas >> 24 == 0xFF;
        count
    }

    fn and(mut self, other: &Self) -> Self {
        self.opaque &= other.opaque;
        for (mine, theirs) in self.largest.iter_mut().zip(other.largest) {
            if theirs.0 > mine.0 || theirs.0 == mine.0 && theirs.1 < mine.1 {
                *mine = theirs;
            }
        }
        for (mine, theirs) in self.by_largest.iter_mut().zip(other.by_largest.iter()) {
            *mine += theirs;
        }
        self.absolute += other.absolute;
        self.squared += other.squared;
        self
    }
}

/// What of two pixels `0xAARRGGBB` is compared: where either is wholly transparent, and so has no colour, their alphas alone.
#[inline]
pub(super) fn compared(a: u32, b: u32) -> [u32; 2] {
    let mask = if a >> 24 == 0 || b >> 24 == 0 {
        0xff00_0000
    } else {
        u32::MAX
    };
    [a & mask, b & mask]
}

/// How far red, green, blue and alpha of two pixels `0xAARRGGBB` are apart.
#[inline]
pub(super) fn channel_levels(a: u32, b: u32) -> [u8; 4] {
    let [a, b] = compared(a, b);
    let ([aa, ar, ag, ab], [ba, br, bg, bb]) = (a.to_be_bytes(), b.to_be_bytes());
    [ar.abs_diff(br), ag.abs_diff(bg), ab.abs_diff(bb), aa.abs_diff(ba)]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::raster::Framebuffer;

    fn frame(width: u32, pixels: &[u32]) -> Framebuffer {
        let mut frame = Framebuffer::new(width, u32::try_from(pixels.len()).expect("few") / width);
        frame.pixels_mut().copy_from_slice(pixels);
        frame
    }

    #[test]
    fn levels_of_four_pixels_by_hand() {
        let a = frame(2, &[0xFF00_0000, 0xFF10_2030, 0xFFFF_FFFF, 0xFF80_8080]);
        let b = frame(2, &[0xFF00_0000, 0xFF13_2030, 0xFFFF_FBFF, 0xFF80_807C]);
        let levels = Pair::new(&a, &b).expect("one size").levels();
        assert_eq!(
            (levels.pixels, levels.channels, levels.differing()),
            (4, 3, 3),
            "counts"
        );
        let largest = |level, at| Some(Largest { level, at });
        assert_eq!(
            levels.largest,
            [largest(3, [1, 0]), largest(4, [0, 1]), largest(4, [1, 1]), None],
            "where"
        );
        assert_eq!((levels.beyond(3), levels.beyond(4)), (2, 0), "beyond a tolerance");
        assert_eq!(levels.largest_level(), 4, "of any channel");
        // Three differences of 3, 4, 4 among twelve channels.
        assert!((levels.mae() - 11.0 / 12.0).abs() < 1e-12, "MAE {}", levels.mae());
        assert!((levels.rmse() - (41.0_f64 / 12.0).sqrt()).abs() < 1e-12, "RMSE");
        assert!((levels.psnr() - 42.794_777_5).abs() < 1e-6, "PSNR {}", levels.psnr());
        assert_eq!(levels.squared, 41, "9 + 16 + 16");
    }

    #[test]
    fn levels_count_alpha_where_there_is_any() {
        let a = frame(1, &[0xFF10_1010, 0]);
        let b = frame(1, &[0xFF10_1010, 0x0800_0000]);
        let levels = Pair::new(&a, &b).expect("one size").levels();
        assert_eq!((levels.channels, levels.differing()), (4, 1), "alpha counts");
        assert_eq!(levels.largest[3], Some(Largest { level: 8, at: [0, 1] }), "in alpha");
        assert!((levels.mae() - 1.0).abs() < 1e-12, "8 levels in eight channels");
    }

    #[test]
    fn what_is_transparent_has_no_colour() {
        // Opaque white, pale white and red against what is not there.
        let a = frame(1, &[0xFFFF_FFFF, 0x0AFF_FFFF, 0]);
        let b = frame(1, &[0, 0, 0x80FF_0000]);
        let levels = Pair::new(&a, &b).expect("one size").levels();
        let largest = Some(Largest { level: 255, at: [0, 0] });
        assert_eq!(levels.largest, [None, None, None, largest], "alpha alone");
        assert_eq!(levels.squared, 255 * 255 + 10 * 10 + 128 * 128, "of alpha");
        assert_eq!(levels.beyond(10), 2, "pale white is nearly nothing");
    }

    #[test]
    fn levels_of_equal_and_of_empty_pictures() {
        let a = frame(3, &[0xFF12_3456; 6]);
        let levels = Pair::new(&a, &a).expect("one size").levels();
        assert_eq!((levels.differing(), levels.largest_level()), (0, 0), "nothing differs");
        assert!(levels.psnr().is_infinite() && levels.rmse() == 0.0, "no error");
        let none = Framebuffer::new(0, 0);
        assert_eq!(
            Pair::new(&none, &none).expect("one size").levels().pixels,
            0,
            "no pixels"
        );
    }

    #[test]
    fn levels_do_not_depend_on_the_order_of_the_pair() {
        arbtest::arbtest(|u| {
            let width = u.int_in_range(1..=9)?;
            let rows = u.int_in_range(1..=40_u32)?;
            let mut pixels = || -> arbtest::arbitrary::Result<Framebuffer> {
                let pixels: Vec<u32> = (0..width * rows)
                    .map(|_| Ok(*u.choose(&[0xFF00_0000, 0xFF01_0203, 0xFFFF_FFFF, 0x80FF_0000])?))
                    .collect::<Result<_, arbtest::arbitrary::Error>>()?;
                Ok(frame(width, &pixels))
            };
            let (a, b) = (pixels()?, pixels()?);
            let pair = Pair::new(&a, &b).expect("one size");
            assert_eq!(pair.levels(), pair.swapped().levels(), "the same both ways");
            Ok(())
        });
    }
}
