//! Pixels of two flat colours that were resolved before.

use crate::raster::paint::visibility::two_surfaces::TwoSurfaces;

/// How many pixels of two surfaces are known at once: `2^KNOWN_LOG2`.
const KNOWN_LOG2: u32 = 8;

/// Pixels of two surfaces that were resolved before in the same tile, each in a place that its key says: along an edge all are one of
/// a few.
#[derive(Debug)]
pub(super) struct KnownPixels(Box<[(u64, u32); 1 << KNOWN_LOG2]>);

impl Default for KnownPixels {
    fn default() -> Self {
        Self(Box::new([(0, 0); 1 << KNOWN_LOG2]))
    }
}

impl KnownPixels {
    /// Forgets all.
    pub(super) fn clear(&mut self) {
        self.0.fill((0, 0));
    }

    /// The pixel that shows two surfaces, which `find` finds where it is not known.
    #[inline]
    pub(super) fn pixel(
        &mut self,
        TwoSurfaces { mask, first, second }: TwoSurfaces,
        find: impl FnOnce() -> u32,
    ) -> u32 {
        // By Knuth, 2^64 over the golden ratio: keys side by side get places far apart.
        const SCATTER: u64 = 0x9E37_79B9_7F4A_7C15;
        // Never that of nothing.
        let key = 1 << 48 | u64::from(mask.count_ones()) << 32 | u64::from(first) << 16 | u64::from(second);
        let place = key.wrapping_mul(SCATTER) >> (64 - KNOWN_LOG2);
        let (known, pixel) = &mut self.0[place as usize];
        if *known != key {
            (*known, *pixel) = (key, find());
        }
        *pixel
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pixels_are_found_once_for_each_pair_and_number_of_samples() {
        let mut known = KnownPixels::default();
        let mut found = 0;
        for _ in 0..2 {
            for (first, second, mask) in [(3, 5, 0b11), (5, 3, 0b11), (3, 5, 0b111)] {
                let two = TwoSurfaces { mask, first, second };
                let expected = u32::from(first) << 16 | mask.count_ones();
                let pixel = known.pixel(two, || {
                    found += 1;
                    expected
                });
                assert_eq!(pixel, expected, "{two:?}");
            }
        }
        assert_eq!(found, 3, "the second time all are known");
        known.clear();
        let two = TwoSurfaces {
            mask: 3,
            first: 3,
            second: 5,
        };
        assert_eq!(known.pixel(two, || 7), 7, "forgotten");
    }
}
