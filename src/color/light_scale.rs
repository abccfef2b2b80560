//! Linear light (IEC 61966-2-1) in whole numbers: of stored values, and where it becomes the next byte.
//!
//! How fine a number is, says who sums up: `BITS` is how many bits all light has. From light to a byte leads a table: light is cut
//! into pieces so narrow that each holds at most one step from a byte to the next, and that is compared exactly. The light of a
//! mean is at least another, which is a whole number, where the whole part of it is: nothing is rounded before.

use super::Premultiplied16;
use crate::rules::Rules;

/// Pieces that light is cut into, as a power of two: a piece spans less than lies between any two bytes, which is least in the dark.
const PIECES_LOG2: u32 = 12;
const PIECES: usize = (1 << PIECES_LOG2) + 1;

/// Linear light of a stored channel, `0.0..=1.0`.
fn light_of(stored: f64) -> f64 {
    let stored = stored / f64::from(Premultiplied16::ONE);
    if stored <= 0.040_45 {
        stored / 12.92
    } else {
        ((stored + 0.055) / 1.055).powf(2.4)
    }
}

/// Linear light of a stored channel in parts of `2^BITS`.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "between nothing and 2^31 at most"
)]
pub(super) fn whole_light<const BITS: u32>(stored: f64) -> u32 {
    (light_of(stored) * f64::from(1_u32 << BITS)).round() as u32
}

/// Where light in parts of `2^BITS` becomes the next byte.
#[derive(Debug)]
pub(super) struct Steps<const BITS: u32> {
    /// The least light of each byte from 1 on, and more than all light.
    least: [u32; 256],
    /// How many of these each piece of light begins with, or has below it.
    below: [u8; PIECES],
}

impl<const BITS: u32> Steps<BITS> {
    /// Bits of light inside a piece.
    const PIECE_BITS: u32 = BITS - PIECES_LOG2;

    /// Those that are rounded to nearest; and truncated.
    pub(super) fn both() -> [Self; 2] {
        [0.5, 0.0].map(Self::new)
    }

    /// Of [`Steps::both`], those that `rules` say.
    pub(super) fn by_rules(both: &[Self; 2], rules: Rules) -> &Self {
        match rules {
            Rules::Standard | Rules::Float => &both[0],
            Rules::Course => &both[1],
        }
    }

    /// With this much of a byte being enough for the next one's light to be `1 - below` away.
    fn new(below: f64) -> Self {
        let per_byte = f64::from(Premultiplied16::PER_BYTE);
        let mut least = [u32::MAX; 256];
        for (least, byte) in least.iter_mut().zip(1..=255_u8) {
            *least = whole_light::<BITS>((f64::from(byte) - below) * per_byte);
        }
        let mut pieces = [0; PIECES];
        for (piece, below) in (0_u32..).zip(&mut pieces) {
            let count = least.partition_point(|light| *light <= piece << Self::PIECE_BITS);
            *below = u8::try_from(count).unwrap_or(u8::MAX);
        }
        Self { least, below: pieces }
    }

    /// The byte of this light.
    #[inline]
    #[expect(clippy::cast_possible_truncation, reason = "at most 2^31")]
    pub(super) fn byte(&self, light: u64) -> u32 {
        let light = light.min(1 << BITS) as u32;
        let below = self.below[(light >> Self::PIECE_BITS) as usize];
        u32::from(below) + u32::from(self.least[usize::from(below)] <= light)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Both sides of each step, and how far these are apart.
    fn try_steps<const BITS: u32>() {
        for steps in Steps::<BITS>::both() {
            for (byte, least) in (1_u32..).zip(&steps.least[..255]) {
                let of = |light: u32| steps.byte(light.into());
                assert_eq!((of(least - 1), of(*least)), (byte - 1, byte), "{BITS} bits");
            }
            for pair in steps.least[..255].windows(2) {
                assert!(
                    pair[1] - pair[0] > 1 << Steps::<BITS>::PIECE_BITS,
                    "at most one step in a piece: {pair:?}"
                );
            }
            assert_eq!(steps.byte(u64::MAX), 255, "beyond all light, {BITS} bits");
        }
    }

    #[test]
    fn every_step_from_byte_to_byte_is_where_its_least_light_is() {
        try_steps::<31>();
        try_steps::<24>();
    }
}
