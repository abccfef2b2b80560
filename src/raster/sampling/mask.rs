//! Which samples of a pixel: a bit for each.

use crate::raster::SampleRate;

const WORDS: usize = (SampleRate::MAX / 64) as usize;

/// Some samples of a pixel, by their numbers.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct SampleMask([u64; WORDS]);

impl SampleMask {
    /// The first `count` samples, at most 256.
    pub(crate) fn all(count: usize) -> Self {
        let mut mask = Self::default();
        mask.set_each(count, |_| true);
        mask
    }

    /// Makes it those of the first `count` samples, at most 256, that `inside` says; it must be empty.
    #[inline(always)]
    #[expect(
        clippy::inline_always,
        reason = "a call for every sample would cost more than the rest"
    )]
    pub(crate) fn set_each(&mut self, count: usize, mut inside: impl FnMut(usize) -> bool) {
        for (word, first) in self.0.iter_mut().zip((0..count).step_by(64)) {
            let mut bits = 0;
            for bit in 0..(count - first).min(64) {
                bits |= u64::from(inside(first + bit)) << bit;
            }
            *word = bits;
        }
    }

    /// Whether it holds no sample.
    #[inline]
    pub(crate) fn is_empty(&self) -> bool {
        self.0 == [0; WORDS]
    }

    /// How many samples it holds.
    #[inline]
    pub(crate) fn count(&self) -> usize {
        self.0.iter().map(|word| word.count_ones() as usize).sum()
    }

    /// Calls `visit` with the numbers of its samples, from the lowest on.
    #[inline(always)]
    #[expect(
        clippy::inline_always,
        reason = "a call for every sample would cost more than the rest"
    )]
    pub(crate) fn each(&self, mut visit: impl FnMut(usize)) {
        for (word, first) in self.0.iter().zip((0..).step_by(64)) {
            let mut rest = *word;
            while rest != 0 {
                visit(first + rest.trailing_zeros() as usize);
                rest &= rest - 1;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn masks_hold_what_they_were_given() {
        for count in [0, 1, 5, 63, 64, 65, 128, 200, 256] {
            let mut odd = SampleMask::default();
            odd.set_each(count, |i| i % 3 == 1);
            let expected: Vec<usize> = (0..count).filter(|i| i % 3 == 1).collect();
            let mut found = Vec::new();
            odd.each(|sample| found.push(sample));
            assert_eq!(found, expected, "every third of {count}");
            assert_eq!(odd.is_empty(), expected.is_empty(), "{count}");
            assert_eq!(odd.count(), expected.len(), "{count}");
            assert_eq!(SampleMask::all(count).count(), count, "all of {count}");
        }
    }
}
