//! How many samples make a pixel.

/// Samples per pixel, from 1 to 256. Most patterns take square numbers `n x n` only: see [`crate::raster::SamplePattern::takes`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct SampleRate {
    samples: u16,
}

impl SampleRate {
    /// One sample, in the pixel's centre.
    pub const ONE: Self = Self { samples: 1 };
    /// The rates that the keys step through, as sides: rates 1, 4, 9 ... 64.
    pub const MAX_KEY_SIDE: u8 = 8;
    /// The largest rate is 256.
    pub const MAX_SIDE: u8 = 16;
    /// The most samples per pixel.
    pub const MAX: u32 = Self::MAX_SIDE as u32 * Self::MAX_SIDE as u32;

    /// The rate of `samples` per pixel, or `None` unless that is 1 to 256.
    pub fn new(samples: u32) -> Option<Self> {
        let inside = (1..=Self::MAX).contains(&samples);
        u16::try_from(samples)
            .ok()
            .filter(|_| inside)
            .map(|samples| Self { samples })
    }

    /// As [`SampleRate::new`], but `None` unless `samples` is 1, 4, 9, 16 ... 256.
    pub fn square(samples: u32) -> Option<Self> {
        Self::new(samples).filter(|rate| rate.is_square())
    }

    fn of_side(side: u8) -> Self {
        Self {
            samples: u16::from(side) * u16::from(side),
        }
    }

    /// Samples per pixel.
    pub fn samples(self) -> u32 {
        u32::from(self.samples)
    }

    /// Samples along one side of a pixel, `n` of `n x n`; of the next square number where it is none.
    pub fn side(self) -> u32 {
        self.ceiling().into()
    }

    /// The side of the least square number of samples that is no less.
    fn ceiling(self) -> u8 {
        (1..=Self::MAX_SIDE)
            .find(|side| Self::of_side(*side) >= self)
            .unwrap_or(Self::MAX_SIDE)
    }

    /// The mean distance of neighbouring samples, in pixels.
    pub fn step(self) -> f64 {
        // Exact where it is a square number.
        1.0 / f64::from(self.samples).sqrt()
    }

    /// Whether it is a square number.
    pub fn is_square(self) -> bool {
        Self::of_side(self.ceiling()) == self
    }

    /// The nearest square number of samples; the lower one of two.
    #[must_use]
    pub fn nearest_square(self) -> Self {
        let above = self.ceiling();
        let (below, above) = (Self::of_side((above - 1).max(1)), Self::of_side(above));
        if self.samples.abs_diff(below.samples) <= self.samples.abs_diff(above.samples) {
            below
        } else {
            above
        }
    }

    /// The next higher rate that keys reach, or the same at the end.
    #[must_use]
    pub fn higher(self) -> Self {
        let next = (1..=Self::MAX_KEY_SIDE).map(Self::of_side).find(|rate| *rate > self);
        next.unwrap_or(self)
    }

    /// The next lower square number of samples, or the same at the end.
    #[must_use]
    pub fn lower(self) -> Self {
        Self::of_side((self.ceiling() - 1).max(1))
    }
}

impl Default for SampleRate {
    fn default() -> Self {
        Self::ONE
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rate(samples: u32) -> SampleRate {
        SampleRate::new(samples).expect("1 to 256")
    }

    #[test]
    fn rates_are_numbers_from_1_to_256() {
        let found: Vec<u32> = (0..=300).filter_map(SampleRate::new).map(SampleRate::samples).collect();
        assert_eq!(found, (1..=256).collect::<Vec<_>>(), "all of them");
        let squares: Vec<u32> = (0..=300).filter_map(SampleRate::square).map(SampleRate::side).collect();
        assert_eq!(squares, (1..=16).collect::<Vec<_>>(), "the squares by their sides");
    }

    #[test]
    fn keys_step_through_squares() {
        let mut seen = vec![rate(1)];
        while let Some(last) = seen.last().copied()
            && last.higher() != last
        {
            assert_eq!(last.higher().lower(), last, "there and back");
            seen.push(last.higher());
        }
        assert_eq!(seen, [1, 4, 9, 16, 25, 36, 49, 64].map(rate), "up");
        assert_eq!((rate(5).higher(), rate(5).lower()), (rate(9), rate(4)), "between two");
        assert_eq!((rate(100).higher(), rate(100).lower()), (rate(100), rate(81)), "beyond");
        assert_eq!((rate(1).lower(), rate(256).lower()), (rate(1), rate(225)), "the ends");
    }

    #[test]
    fn nearest_square_is_nearest() {
        for (samples, nearest) in [
            (1, 1),
            (2, 1),
            (3, 4),
            (6, 4),
            (7, 9),
            (12, 9),
            (13, 16),
            (240, 225),
            (241, 256),
        ] {
            assert_eq!(rate(samples).nearest_square(), rate(nearest), "{samples}");
        }
    }
}
