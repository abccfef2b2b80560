//! Random bits that depend on nothing but what they are of: a pixel, a sample, a seed.

/// Random bits, number by number, of a pixel.
#[inline]
pub(in crate::raster::sampling) fn hash(pixel: u64, number: u64) -> u64 {
    mix(pixel.wrapping_add((number + 1).wrapping_mul(0x9E37_79B9_7F4A_7C15)))
}

/// The finaliser of `SplitMix` (Steele, Lea and Flood, "Fast splittable pseudorandom number generators", OOPSLA 2014).
#[inline]
pub(in crate::raster::sampling) fn mix(mut bits: u64) -> u64 {
    bits = (bits ^ bits >> 30).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    bits = (bits ^ bits >> 27).wrapping_mul(0x94D0_49BB_1331_11EB);
    bits ^ bits >> 31
}

/// The lowest 16 of some random bits.
#[inline]
pub(super) fn low_quarter(random: u64) -> u32 {
    first_sixteen(random).into()
}

/// The same as a number that has no more.
#[inline]
pub(super) fn first_sixteen(random: u64) -> u16 {
    let [low, high, ..] = random.to_le_bytes();
    u16::from_le_bytes([low, high])
}

/// The lower and the upper half of some random bits.
pub(super) fn halves(random: u64) -> [u32; 2] {
    let [a, b, c, d, e, f, g, h] = random.to_le_bytes();
    [u32::from_le_bytes([a, b, c, d]), u32::from_le_bytes([e, f, g, h])]
}
