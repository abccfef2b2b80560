//! What pixels show that two primitives share: two slots, and a bit for each sample.
//!
//! Masks, first and second slots each lie side by side, so that those of a few pixels are one vector.

use fearless_simd::prelude::*;
use fearless_simd::{Simd, mask16x8, u16x8, u64x2};

use super::visibility::{Slot, joined, lanes};

/// Pixels of a [`Quad`].
pub(crate) const QUAD: usize = 4;

/// Most samples along the side of a pixel whose masks take 16 bits.
const NARROW_SIDE: usize = 4;

/// Two slots that share the samples of a pixel.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Pair {
    /// Bit `side * row + column` for each sample that shows `second`; neither all are set nor none.
    pub(crate) mask: u64,
    pub(crate) first: Slot,
    pub(crate) second: Slot,
}

/// One pair for each pixel of a tile, of account or not.
#[derive(Debug, Default)]
pub(crate) struct Pairs {
    masks: Masks,
    firsts: Vec<Slot>,
    seconds: Vec<Slot>,
}

/// The pairs of pixels side by side.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PairRow<'a> {
    narrow: &'a [u16],
    wide: &'a [u64],
    firsts: &'a [Slot],
    seconds: &'a [Slot],
}

/// Masks of as many bits as they need; one of the two is empty.
#[derive(Debug, Default)]
struct Masks {
    is_wide: bool,
    narrow: Vec<u16>,
    wide: Vec<u64>,
}

/// Four pixels side by side, in the lower half of vectors.
pub(crate) type Quad<S> = u16x8<S>;

/// Which of them.
pub(crate) type QuadMask<S> = mask16x8<S>;

impl Pairs {
    /// None, for pixels of `side x side` samples, at most 64.
    pub(crate) fn new(side: usize) -> Self {
        Self {
            masks: Masks {
                is_wide: side > NARROW_SIDE,
                ..Masks::default()
            },
            ..Self::default()
        }
    }

    /// Makes room for those of `count` pixels.
    pub(crate) fn make_room(&mut self, count: usize) {
        if self.firsts.len() < count {
            self.firsts.resize(count, 0);
            self.seconds.resize(count, 0);
            if self.masks.is_wide {
                self.masks.wide.resize(count, 0);
            } else {
                self.masks.narrow.resize(count, 0);
            }
        }
    }

    #[inline(always)]
    #[expect(clippy::inline_always, reason = "a few instructions for every pixel on an edge")]
    pub(crate) fn get(&self, pixel: usize) -> Pair {
        let mask = if self.masks.is_wide {
            self.masks.wide[pixel]
        } else {
            u64::from(self.masks.narrow[pixel])
        };
        Pair {
            mask,
            first: self.firsts[pixel],
            second: self.seconds[pixel],
        }
    }

    #[inline(always)]
    #[expect(clippy::inline_always, reason = "a few instructions for every pixel on an edge")]
    #[expect(clippy::cast_possible_truncation, reason = "narrow masks have sixteen bits")]
    pub(crate) fn set(&mut self, pixel: usize, pair: Pair) {
        if self.masks.is_wide {
            self.masks.wide[pixel] = pair.mask;
        } else {
            self.masks.narrow[pixel] = pair.mask as u16;
        }
        self.firsts[pixel] = pair.first;
        self.seconds[pixel] = pair.second;
    }

    /// Lets those of the pixels from `pixel` on that `which` names be pairs; masks must be narrow.
    #[inline(always)]
    #[expect(clippy::inline_always, reason = "vector instructions reach inlined code only")]
    pub(crate) fn set_quad<S: Simd>(
        &mut self,
        simd: S,
        (pixel, which): (usize, QuadMask<S>),
        (masks, firsts, seconds): (Quad<S>, Quad<S>, Quad<S>),
    ) {
        let range = pixel..pixel + QUAD;
        for (all, new) in [
            (&mut self.masks.narrow, masks),
            (&mut self.firsts, firsts),
            (&mut self.seconds, seconds),
        ] {
            if let Some(four) = all.get_mut(range.clone()).and_then(<[u16]>::first_chunk_mut) {
                put(four, which.select(new, quad(simd, joined(*four))));
            }
        }
    }

    /// The pairs of `count` pixels from `first` on.
    #[inline]
    pub(crate) fn row(&self, first: usize, count: usize) -> PairRow<'_> {
        let range = first..first + count;
        PairRow {
            narrow: self.masks.narrow.get(range.clone()).unwrap_or_default(),
            wide: self.masks.wide.get(range.clone()).unwrap_or_default(),
            firsts: self.firsts.get(range.clone()).unwrap_or_default(),
            seconds: self.seconds.get(range).unwrap_or_default(),
        }
    }
}

impl PairRow<'_> {
    /// That of pixel number `at`; any for a number that is none.
    #[inline(always)]
    #[expect(clippy::inline_always, reason = "a few instructions for every pixel on an edge")]
    pub(crate) fn get(&self, at: usize) -> Pair {
        let mask = match self.narrow.get(at) {
            Some(mask) => u64::from(*mask),
            None => self.wide.get(at).copied().unwrap_or_default(),
        };
        Pair {
            mask,
            first: self.firsts.get(at).copied().unwrap_or_default(),
            second: self.seconds.get(at).copied().unwrap_or_default(),
        }
    }
}

/// Four numbers, the first one lowest, as a vector.
#[inline(always)]
#[expect(clippy::inline_always, reason = "vector instructions reach inlined code only")]
pub(crate) fn quad<S: Simd>(simd: S, word: u64) -> Quad<S> {
    u64x2::splat(simd, word).bitcast()
}

/// A vector as four numbers.
#[inline(always)]
#[expect(clippy::inline_always, reason = "vector instructions reach inlined code only")]
pub(crate) fn put<S: Simd>(four: &mut [u16; QUAD], vector: Quad<S>) {
    let [word, _] = vector.bitcast::<u64x2<S>>().to_array();
    *four = lanes(word);
}
