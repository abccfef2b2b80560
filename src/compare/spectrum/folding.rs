//! Where a wave lands that is too fine for the pixels.
//!
//! Pixels that each read one point cannot tell a frequency from that with a whole number of cycles per pixel more or less
//! (H. Nyquist, 1928; C. E. Shannon, "Communication in the presence of noise", 1949): what lies outside of the box of half a
//! cycle per pixel is seen inside, as its alias.

/// The bands around the box, each with its mirror image, by the axes along which their waves are too fine.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Band {
    /// Too fine from column to column.
    Across,
    /// Too fine from row to row.
    Down,
    /// Too fine along both.
    Both,
}

impl Band {
    /// Every band, in the order of legends.
    pub const ALL: [Self; 3] = [Self::Across, Self::Down, Self::Both];

    /// What legends call it.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Across => "too fine across",
            Self::Down => "too fine down",
            Self::Both => "too fine both ways",
        }
    }

    /// Its colour, opaque `0xAARRGGBB`: three of those that colour-blind eyes tell apart (M. Okabe and K. Ito, 2008).
    pub const fn color(self) -> u32 {
        match self {
            Self::Across => 0xffe6_9f00,
            Self::Down => 0xff56_b4e9,
            Self::Both => 0xffe0_7bb4,
        }
    }

    /// That of a frequency, in cycles per pixel; `None` inside of the box.
    pub(super) fn of(frequency: [f64; 2]) -> Option<Self> {
        match frequency.map(|along| turns(along) != 0.0) {
            [false, false] => None,
            [true, false] => Some(Self::Across),
            [false, true] => Some(Self::Down),
            [true, true] => Some(Self::Both),
        }
    }
}

/// How many whole cycles per pixel the pixels do not see; the rest lies in `-0.5..=0.5`, whose ends are one frequency: half a
/// cycle per pixel is not too fine, whichever way it runs.
fn turns(along: f64) -> f64 {
    /// What sums and products of frequencies are rounded by at most.
    const ROUNDING: f64 = 1e-9;
    (along.abs() - 0.5 - ROUNDING).ceil().max(0.0).copysign(along)
}

/// Where a frequency is seen, in cycles per pixel.
pub(super) fn folded(frequency: [f64; 2]) -> [f64; 2] {
    frequency.map(|along| along - turns(along))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn frequencies_fold_into_the_box() {
        for (frequency, expected, band) in [
            ([0.3, -0.4], [0.3, -0.4], None),
            ([0.7, 0.1], [-0.3, 0.1], Some(Band::Across)),
            ([-0.7, 0.1], [0.3, 0.1], Some(Band::Across)),
            ([0.2, -1.2], [0.2, -0.2], Some(Band::Down)),
            ([1.4, 0.9], [0.4, -0.1], Some(Band::Both)),
            ([0.5, -0.5], [0.5, -0.5], None),
            ([-0.5, 0.1 + 0.4], [-0.5, 0.5], None),
            ([1.5, -1.5], [0.5, -0.5], Some(Band::Both)),
        ] {
            let found = folded(frequency);
            let off = (found[0] - expected[0]).hypot(found[1] - expected[1]);
            assert!(off < 1e-12, "{frequency:?}: {found:?}");
            assert_eq!(Band::of(frequency), band, "{frequency:?}");
        }
    }
}
