//! How many samples make a pixel.

/// Samples per pixel: a square number `n x n` from 1 to 256.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct SampleRate {
    side: u8,
}

impl SampleRate {
    /// One sample, in the pixel's centre.
    pub const ONE: Self = Self { side: 1 };
    /// The rates that the keys step through, as sides: rates 1, 4, 9 ... 64.
    pub const MAX_KEY_SIDE: u8 = 8;
    /// The largest rate is 256.
    pub const MAX_SIDE: u8 = 16;

    /// The rate of `samples` per pixel, or `None` unless that is 1, 4, 9, 16 ... 256.
    pub fn new(samples: u32) -> Option<Self> {
        (1..=Self::MAX_SIDE)
            .map(|side| Self { side })
            .find(|rate| rate.samples() == samples)
    }

    /// Samples per pixel, `n * n`.
    pub fn samples(self) -> u32 {
        u32::from(self.side) * u32::from(self.side)
    }

    /// Samples along one side of a pixel, `n`.
    pub fn side(self) -> u32 {
        u32::from(self.side)
    }

    /// The next higher rate that keys reach, or the same at the end.
    #[must_use]
    pub fn higher(self) -> Self {
        Self {
            side: (self.side + 1).min(Self::MAX_KEY_SIDE.max(self.side)),
        }
    }

    /// The next lower rate, or the same at the end.
    #[must_use]
    pub fn lower(self) -> Self {
        Self {
            side: (self.side - 1).max(1),
        }
    }
}

impl Default for SampleRate {
    fn default() -> Self {
        Self::ONE
    }
}
