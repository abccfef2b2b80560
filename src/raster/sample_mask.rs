//! Which samples of a pixel: a bit for each.

use super::SampleRate;

const WORDS: usize = (SampleRate::MAX / 64) as usize;

/// Some samples of a pixel, by their numbers.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct SampleMask([u64; WORDS]);

impl SampleMask {
    /// The first `count` samples.
    pub(crate) fn all(count: usize) -> Self {
        Self::from_bits(count, |_| true)
    }

    /// Those of the first `count` samples, at most 256, that `inside` says.
    #[inline]
    pub(crate) fn from_bits(count: usize, inside: impl Fn(usize) -> bool) -> Self {
        let mut mask = Self::default();
        for (word, first) in mask.0.iter_mut().zip((0..count).step_by(64)) {
            for (bit, sample) in (first..count.min(first + 64)).enumerate() {
                *word |= u64::from(inside(sample)) << bit;
            }
        }
        mask
    }

    /// How many samples it holds.
    #[inline]
    pub(crate) fn count(&self) -> usize {
        self.0.iter().map(|word| word.count_ones() as usize).sum()
    }

    /// The numbers of its samples, from the lowest on.
    #[inline]
    pub(crate) fn iter(self) -> impl Iterator<Item = usize> {
        self.0.into_iter().enumerate().flat_map(|(i, word)| {
            std::iter::successors(Some(word), |rest| Some(rest & rest.wrapping_sub(1)))
                .take_while(|rest| *rest != 0)
                .map(move |rest| i * 64 + rest.trailing_zeros() as usize)
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn masks_hold_what_they_were_given() {
        for count in [0, 1, 5, 63, 64, 65, 128, 200, 256] {
            let odd = SampleMask::from_bits(count, |i| i % 3 == 1);
            let expected: Vec<usize> = (0..count).filter(|i| i % 3 == 1).collect();
            assert_eq!(odd.iter().collect::<Vec<_>>(), expected, "every third of {count}");
            assert_eq!(odd.count(), expected.len(), "{count}");
            assert_eq!(SampleMask::all(count).count(), count, "all of {count}");
        }
    }
}
