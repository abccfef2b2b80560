//! The slots of four samples in a word, sixteen bits each, the first one lowest.

use crate::raster::span::Span;
use crate::raster::surface_id::Slot;

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

/// The bits of the four samples from column `left` on that a span covers. Bits beyond a pixel's last column are of no
/// account.
#[inline]
pub(in crate::raster) fn covered(span: Span, left: i32) -> u64 {
    let first = |at: i32| FIRST[(at - left).clamp(0, 4).cast_unsigned() as usize];
    first(span.end) & !first(span.start)
}

/// Four samples of which the second slot shows where the lowest bits are set, and the first elsewhere; four times each.
#[inline]
pub(in crate::raster) fn of_pair([first, second]: [u64; 2], bits: u64) -> u64 {
    let mask = spread(bits);
    first & !mask | second & mask
}

/// Four times the same slot.
#[inline]
pub(in crate::raster) fn splat(slot: Slot) -> u64 {
    u64::from(slot) * 0x0001_0001_0001_0001
}

/// The four slots of a word.
#[inline]
#[expect(clippy::cast_possible_truncation, reason = "the lower sixteen bits are meant")]
pub(in crate::raster) fn lanes(word: u64) -> [Slot; PER_WORD] {
    [
        word as u16,
        (word >> 16) as u16,
        (word >> 32) as u16,
        (word >> 48) as u16,
    ]
}

/// A word of four slots.
#[inline]
pub(in crate::raster) fn joined([a, b, c, d]: [Slot; PER_WORD]) -> u64 {
    u64::from(a) | u64::from(b) << 16 | u64::from(c) << 32 | u64::from(d) << 48
}

/// A word with the slots in `mask` changed; the others are unspecified.
#[inline]
pub(in crate::raster) fn changed(word: u64, mask: u64, change: &mut impl FnMut(Slot) -> Slot) -> u64 {
    let slots = lanes(word);
    if word == splat(slots[0]) {
        return splat(change(slots[0]));
    }
    let mut found = slots;
    for (i, slot) in found.iter_mut().enumerate() {
        if mask & FIRST[i + 1] & !FIRST[i] != 0 {
            *slot = change(*slot);
        }
    }
    joined(found)
}

/// The sixteen bits of a word for each of the lowest four bits that is set.
#[inline]
pub(in crate::raster) fn spread(bits: u64) -> u64 {
    SPREAD_BITS[(bits & 0xF) as usize]
}
