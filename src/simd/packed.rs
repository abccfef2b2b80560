//! Points that masks name, packed one after the other, four at a time: a shuffle brings those that are named to the front, where
//! there is one. Nothing branches on the bits, which nobody can foresee.
//!
//! ```text
//!     mask        1 0 1 1   0 0 1 0
//!     points      a b c d   e f g h
//!     packed      a c d g
//! ```

use fearless_simd::prelude::*;
use fearless_simd::{Simd, u8x16, u16x8};

/// Points that are packed together.
pub(crate) const PACKED: usize = 4;

/// Machines with vectors of so many 32-bit numbers have an instruction that brings bytes into any order; others may not.
const WITH_SHUFFLES: usize = 8;

/// The order of bytes that brings those of four points to the front that these bits name.
static ORDERS: [[u8; 16]; 1 << PACKED] = orders();

const fn orders() -> [[u8; 16]; 1 << PACKED] {
    let mut orders = [[0; 16]; 1 << PACKED];
    let mut bits = 0;
    while bits < orders.len() {
        let (mut point, mut byte) = (0_u8, 0);
        while point < 4 {
            let mut of_point = 0;
            while bits >> point & 1 == 1 && of_point < 4 {
                orders[bits][byte] = 4 * point + of_point;
                (of_point, byte) = (of_point + 1, byte + 1);
            }
            point += 1;
        }
        bits += 1;
    }
    orders
}

/// Puts those of four points, two numbers each, that the lowest four bits name at the front of `points`, and anything behind them;
/// how many.
#[inline(always)]
#[expect(clippy::inline_always, reason = "vector instructions reach inlined code only")]
pub(crate) fn pack_four<S: Simd>(simd: S, four: u16x8<S>, bits: u64, points: &mut [[u16; 2]; PACKED]) -> usize {
    let named = bits % (1 << PACKED);
    if S::u32s::LEN < WITH_SHUFFLES {
        let mut count = 0;
        for (i, point) in four.to_array().as_chunks().0.iter().enumerate() {
            // Stays only where the next one does not take its place.
            points[count % PACKED] = *point;
            count += usize::from(named >> i & 1 == 1);
        }
        return count;
    }
    let order = u8x16::load_array_ref(simd, &ORDERS[usize::try_from(named).unwrap_or(0)]);
    let packed = four.bitcast::<u8x16<S>>().swizzle_dyn_within_blocks(order);
    packed.bitcast::<u16x8<S>>().store_slice(points.as_flattened_mut());
    named.count_ones() as usize
}

#[cfg(test)]
mod tests {
    use fearless_simd::dispatch;

    use super::*;
    use crate::simd;

    #[test]
    fn named_points_come_first_in_their_order() {
        let four: [[u16; 2]; PACKED] = [[1, 2], [300, 4], [5, 60_000], [7, 8]];
        for bits in 0..1_u64 << PACKED {
            let expected: Vec<[u16; 2]> = (0..PACKED).filter(|i| bits >> i & 1 == 1).map(|i| four[i]).collect();
            for (name, level) in simd::tested() {
                let mut found = [[9; 2]; PACKED];
                let count = dispatch!(level, simd => {
                    // What lies above the lowest four does not matter.
                    pack_four(simd, u16x8::from_slice(simd, four.as_flattened()), bits | 0xF0, &mut found)
                });
                assert_eq!(found[..count], expected, "{name}: {bits:b}");
            }
        }
    }
}
