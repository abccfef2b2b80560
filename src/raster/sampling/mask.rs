//! Which samples of a pixel: a bit for each.

use std::ops::Range;

use crate::raster::SampleRate;

/// Samples that a word of a mask has bits for.
pub(crate) const MASK_BITS: usize = 64;

const WORDS: usize = SampleRate::MAX as usize / MASK_BITS;

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

    /// Those of the first 64 samples whose bits are set.
    #[inline]
    pub(crate) fn of_bits(bits: u64) -> Self {
        let mut mask = Self::default();
        mask.0[0] = bits;
        mask
    }

    /// Adds as many samples as `bits` has, from number `first` on, which are fewer than 64.
    #[inline]
    pub(crate) fn add(&mut self, first: usize, bits: u64) {
        let (word, shift) = (first / 64, first % 64);
        self.0[word] |= bits << shift;
        if shift > 0
            && let Some(next) = self.0.get_mut(word + 1)
        {
            *next |= bits >> (64 - shift);
        }
    }

    /// Adds the samples of another.
    #[inline]
    pub(crate) fn merge(&mut self, other: &Self) {
        for (word, other) in self.0.iter_mut().zip(other.0) {
            *word |= other;
        }
    }

    /// The bits of the first 64 samples.
    #[inline]
    pub(crate) fn low(&self) -> u64 {
        self.0[0]
    }

    /// The bits of the samples from number `first` on, at least four of them.
    #[inline]
    pub(crate) fn from(&self, first: usize) -> u64 {
        let (word, shift) = (first / 64, first % 64);
        let next = self.0.get(word + 1).map_or(0, |next| next << 1 << (63 - shift));
        self.0[word] >> shift | next
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

impl SampleMask {
    /// Calls `visit` with each run of samples side by side, from the lowest numbers on.
    #[inline(always)]
    #[expect(
        clippy::inline_always,
        reason = "a call for every run would cost as much as the rest"
    )]
    pub(crate) fn each_run(&self, mut visit: impl FnMut(Range<usize>)) {
        for (word, first) in self.0.iter().zip((0..).step_by(64)) {
            let (mut rest, mut at) = (*word, first);
            while rest != 0 {
                let skipped = rest.trailing_zeros();
                rest >>= skipped;
                let length = rest.trailing_ones();
                at += skipped as usize;
                visit(at..at + length as usize);
                rest = rest.unbounded_shr(length);
                at += length as usize;
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
            let mut in_runs = Vec::new();
            odd.each_run(|run| in_runs.extend(run));
            assert_eq!(in_runs, expected, "runs of every third of {count}");
            assert_eq!(odd.is_empty(), expected.is_empty(), "{count}");
            assert_eq!(odd.count(), expected.len(), "{count}");
            assert_eq!(SampleMask::all(count).count(), count, "all of {count}");
        }
    }

    #[test]
    fn masks_are_written_and_read_in_pieces() {
        for side in 9..=16_usize {
            let bits = |row: usize| 0x5A3C_u64.rotate_left(u32::try_from(row).expect("a row")) & ((1 << side) - 1);
            let mut mask = SampleMask::default();
            (0..side).for_each(|row| mask.add(row * side, bits(row)));
            let mut samples = Vec::new();
            mask.each(|sample| samples.push(sample));
            let is_set = |sample: &usize| bits(sample / side) >> (sample % side) & 1 == 1;
            let expected: Vec<usize> = (0..side * side).filter(is_set).collect();
            assert_eq!(samples, expected, "{side} x {side}");
            let mut in_runs = Vec::new();
            mask.each_run(|run| in_runs.extend(run));
            assert_eq!(in_runs, expected, "{side} x {side} in runs");
            for first in 0..side * side {
                let four = |mask: u64| mask & 0xF;
                let expected = (first..(first + 4).min(side * side))
                    .map(|sample| u64::from(is_set(&sample)) << (sample - first))
                    .sum::<u64>();
                assert_eq!(four(mask.from(first)), expected, "four of {side} x {side} from {first}");
            }
        }
    }
}
