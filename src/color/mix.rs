//! Two colours that share an area: their mean, each weighted by its part.

use super::light::{Light, stored_light};
use super::{Premultiplied16, ResolveSpace};

/// Bits of a part.
const PART_BITS: u32 = 16;

impl ResolveSpace {
    /// The colour of an area of which `part` of `2^16` parts shows `above`, and the rest `below`: the mean of stored values, or of
    /// the light that they stand for, rounded to what samples store.
    #[inline]
    #[must_use]
    pub fn mix(self, below: Premultiplied16, above: Premultiplied16, part: u32) -> Premultiplied16 {
        match self {
            Self::Stored => mix_stored(below, above, part),
            Self::Linear => mix_light(below, above, part),
        }
    }
}

/// The mean of stored values: two channels side by side in a number, each with room for its sum, since none is above
/// [`Premultiplied16::ONE`].
#[inline]
fn mix_stored(below: Premultiplied16, above: Premultiplied16, part: u32) -> Premultiplied16 {
    const PAIR: u64 = 0x0000_FFFF_0000_FFFF;
    const HALF: u64 = 0x0000_8000_0000_8000;
    let [rest, part] = [(1 << PART_BITS) - part, part].map(u64::from);
    let [below, above] = [below, above].map(Premultiplied16::to_word);
    let pair = |shift: u32| {
        let sums = (below >> shift & PAIR) * rest + (above >> shift & PAIR) * part;
        (sums + HALF) >> PART_BITS & PAIR
    };
    Premultiplied16::from_word(pair(0) | pair(16) << 16)
}

/// The mean of light.
fn mix_light(below: Premultiplied16, above: Premultiplied16, part: u32) -> Premultiplied16 {
    let parts = [(1 << PART_BITS) - part, part];
    if parts[0] == 0 || below == above {
        return above;
    }
    let light = Light::mean([below, above], parts);
    let alpha = mix_stored(below, above, part).0[3];
    // As straight values are made of premultiplied ones, backwards.
    let one = u32::from(Premultiplied16::ONE);
    let channel = |k: usize| {
        let faded = (u32::from(stored_light(light[k])) * u32::from(alpha) + one / 2) / one;
        u16::try_from(faded).unwrap_or(alpha).min(alpha)
    };
    Premultiplied16([channel(0), channel(1), channel(2), alpha])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn areas_mix_what_they_show() {
        let [black, white] = [0, Premultiplied16::ONE].map(|of| Premultiplied16([of, of, of, Premultiplied16::ONE]));
        let half = 1 << (PART_BITS - 1);
        for (space, gray) in [(ResolveSpace::Stored, 32_640), (ResolveSpace::Linear, 48_000)] {
            let [red, green, blue, alpha] = space.mix(black, white, half).0;
            assert_eq!((red, red, alpha), (green, blue, Premultiplied16::ONE), "an opaque grey");
            assert!(red.abs_diff(gray) < 10, "{space:?}: half of each is {red}");
            assert_eq!(space.mix(black, white, 2 * half), white, "all of it");
            assert_eq!(space.mix(black, white, 0), black, "nothing of it");
            let clear = Premultiplied16::TRANSPARENT;
            let faded = space.mix(clear, white, half).0;
            assert_eq!(faded, [32_640; 4], "{space:?}: what is clear has no colour");
        }
    }
}
