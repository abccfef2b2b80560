//! The surfaces of four samples in a word, sixteen bits each, the first one lowest.

use crate::raster::surface_id::SurfaceId;

/// Samples of a sample row in one word.
pub(in crate::raster) const PER_WORD: usize = 4;

/// The bits of the first `i` samples of a word.
const FIRST: [u64; PER_WORD + 1] = [0, 0xFFFF, 0xFFFF_FFFF, 0xFFFF_FFFF_FFFF, u64::MAX];

/// For four bits the sixteen bits of a word that belong to each.
const SPREAD_BITS: [u64; 16] = {
    let mut spread = [0; 16];
    let mut bits = 0;
    while bits < 16 {
        let mut lane = 0;
        while lane < PER_WORD {
            if bits >> lane & 1 != 0 {
                spread[bits] |= 0xFFFF << (16 * lane);
            }
            lane += 1;
        }
        bits += 1;
    }
    spread
};

/// Four samples of which the second surface shows where the lowest bits are set, and the first elsewhere; four times each.
#[inline]
pub(in crate::raster) fn of_two([first, second]: [u64; 2], bits: u64) -> u64 {
    let mask = spread(bits);
    first & !mask | second & mask
}

/// Four times the same surface.
#[inline]
pub(in crate::raster) fn splat(surface: SurfaceId) -> u64 {
    u64::from(surface) * 0x0001_0001_0001_0001
}

/// The four surfaces of a word.
#[inline]
#[expect(clippy::cast_possible_truncation, reason = "the lower sixteen bits are meant")]
pub(in crate::raster) fn lanes(word: u64) -> [SurfaceId; PER_WORD] {
    [
        word as u16,
        (word >> 16) as u16,
        (word >> 32) as u16,
        (word >> 48) as u16,
    ]
}

/// A word of four surfaces.
#[inline]
pub(in crate::raster) fn joined([a, b, c, d]: [SurfaceId; PER_WORD]) -> u64 {
    u64::from(a) | u64::from(b) << 16 | u64::from(c) << 32 | u64::from(d) << 48
}

/// The samples of a word that show the same as those of another one, a bit for each.
#[inline]
pub(in crate::raster) fn equal(word: u64, other: u64) -> u64 {
    const LOW: u64 = 0x7FFF_7FFF_7FFF_7FFF;
    let differ = word ^ other;
    // The highest bit of each sample that is not zero, then the lowest one of those that are.
    let other = ((differ & LOW) + LOW) | differ;
    let same = !(other | LOW) >> 15;
    // From bits 0, 16, 32 and 48 to bits 48 to 51; nothing else gets there.
    same.wrapping_mul(0x0001_0002_0004_0008) >> 48 & 0xF
}

/// A word with the surfaces in `mask` changed; the others are unspecified.
#[inline]
pub(in crate::raster) fn changed(word: u64, mask: u64, change: &mut impl FnMut(SurfaceId) -> SurfaceId) -> u64 {
    let surfaces = lanes(word);
    if word == splat(surfaces[0]) {
        return splat(change(surfaces[0]));
    }
    let mut found = surfaces;
    for (i, surface) in found.iter_mut().enumerate() {
        if mask & FIRST[i + 1] & !FIRST[i] != 0 {
            *surface = change(*surface);
        }
    }
    joined(found)
}

/// The sixteen bits of a word for each of the lowest four bits that is set.
#[inline]
pub(in crate::raster) fn spread(bits: u64) -> u64 {
    SPREAD_BITS[(bits & 0xF) as usize]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equal_samples_have_a_bit() {
        arbtest::arbtest(|u| {
            let mut word = || -> arbtest::arbitrary::Result<[SurfaceId; PER_WORD]> {
                let mut one = || u.choose(&[0, 1, 0x7FFF, 0x8000, 0x8001, 0xFFFE, 0xFFFF]).copied();
                Ok([one()?, one()?, one()?, one()?])
            };
            let (first, second) = (word()?, word()?);
            let same = |i: usize| u64::from(first[i] == second[i]) << i;
            let expected: u64 = (0..PER_WORD).map(same).sum();
            assert_eq!(
                equal(joined(first), joined(second)),
                expected,
                "{first:x?} and {second:x?}"
            );
            Ok(())
        })
        .budget_ms(100);
    }
}
