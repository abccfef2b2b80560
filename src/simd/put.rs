//! Puts vectors where there may be room for a part of them only.

#![expect(
    clippy::inline_always,
    reason = "a function that is not inlined into its dispatch loses the vector instructions"
)]

use fearless_simd::prelude::*;
use fearless_simd::{Simd, u32x16};

/// Puts the first lanes, as many as there is room for.
#[inline(always)]
pub(crate) fn put_lanes<S: Simd>(lanes: u32x16<S>, room: &mut [u32]) {
    if let Some(room) = room.first_chunk_mut() {
        lanes.store_array(room);
    } else {
        put_few(&lanes.to_array(), room);
    }
}

/// Not inlined: compilers would make one call of `memcpy` of both ways, to which the vector goes by way of memory.
#[cold]
#[inline(never)]
fn put_few(lanes: &[u32; 16], room: &mut [u32]) {
    let count = room.len().min(lanes.len());
    room[..count].copy_from_slice(&lanes[..count]);
}

#[cfg(test)]
mod tests {
    use fearless_simd::dispatch;

    use super::*;
    use crate::simd;

    #[test]
    fn lanes_are_put_as_far_as_there_is_room_on_every_level() {
        let lanes: [u32; 16] = std::array::from_fn(|i| u32::try_from(i).expect("a few") + 1);
        for (name, level) in simd::tested() {
            for length in 0..=20 {
                let mut room = vec![0; length];
                dispatch!(level, simd => put_lanes(u32x16::simd_from(simd, lanes), &mut room));
                let count = length.min(16);
                assert_eq!(room[..count], lanes[..count], "{name}: room for {length}");
                assert!(room[count..].iter().all(|value| *value == 0), "{name}: nothing beyond");
            }
        }
    }
}
