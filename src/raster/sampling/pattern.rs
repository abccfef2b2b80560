//! Where the samples of a pixel may lie: the patterns that a user chooses from.

use crate::raster::SampleRate;

/// Where the samples of a pixel lie.
///
/// All but the grid are snapped to a lattice of 256 x 256 points per pixel, so that coverage stays exact: a sample is
/// moved by less than 1/256 of a pixel, and never out of its cell. All but [`SamplePattern::Jittered`] are the same in
/// every pixel; there, a scene that moves by whole pixels changes its picture.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum SamplePattern {
    /// The centres of `n x n` equal cells.
    #[default]
    Grid,
    /// `n x n` points in `n^2` different columns and rows, one in each cell of the grid, which is turned by `atan(1 / n)`.
    /// With four samples this is the "rotated grid" of graphics hardware; the general arrangement is the canonical one
    /// of Chiu, Shirley and Wang, "Multi-jittered sampling" (Graphics Gems IV, 1994).
    Rotated,
    /// One point anywhere in each of `n x n` cells, other ones in every pixel (Cook, "Stochastic sampling in computer
    /// graphics", ACM Transactions on Graphics 5, 1986).
    Jittered,
    /// One point anywhere in each of `n x n` cells, the same ones in every pixel.
    JitteredSame,
    /// The first points, from number 1 on, of the sequence in bases 2 and 3 (Halton, "On the efficiency of certain
    /// quasi-random sequences of points", Numerische Mathematik 2, 1960).
    Halton,
    /// The first points of the additive recurrence with the plastic number (Roberts, "The unreasonable effectiveness of
    /// quasirandom sequences", 2018), beginning in the pixel's centre.
    R2,
}

impl SamplePattern {
    /// Every value, in the order of menus and of the key that steps through them.
    pub const ALL: [Self; 6] = [
        Self::Grid,
        Self::Rotated,
        Self::Jittered,
        Self::JitteredSame,
        Self::Halton,
        Self::R2,
    ];

    /// The name used in the command line and the interface.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Grid => "grid",
            Self::Rotated => "rotated",
            Self::Jittered => "jittered",
            Self::JitteredSame => "jittered-same",
            Self::Halton => "halton",
            Self::R2 => "r2",
        }
    }

    /// Where the samples of a pixel lie, in few words.
    pub const fn description(self) -> &'static str {
        match self {
            Self::Grid => "the middles of n x n cells",
            Self::Rotated => "one in each of n x n cells, no two in a column or row: the grid turned by `atan(1/n)`",
            Self::Jittered => "anywhere in each of n x n cells, other places in every pixel",
            Self::JitteredSame => "anywhere in each of n x n cells, the same places in every pixel",
            Self::Halton => "radical inverses in bases 2 and 3, from number 1 on",
            Self::R2 => "additive recurrence with the plastic number, from the middle on",
        }
    }

    /// Whom the pattern goes back to; empty where it is everybody's.
    pub const fn source(self) -> &'static str {
        match self {
            Self::Grid | Self::JitteredSame => "",
            Self::Rotated => "graphics hardware for 4; Chiu, Shirley, Wang 1994",
            Self::Jittered => "Cook 1986",
            Self::Halton => "Halton 1960",
            Self::R2 => "Roberts 2018",
        }
    }

    /// Whether the pattern divides a pixel into cells, so that only square numbers of samples are possible.
    pub const fn needs_square(self) -> bool {
        !matches!(self, Self::Halton | Self::R2)
    }

    /// Whether it has that many samples.
    pub fn takes(self, rate: SampleRate) -> bool {
        !self.needs_square() || rate.is_square()
    }

    /// The possible rate that is nearest to `rate`; the lower one of two.
    #[must_use]
    pub fn nearest(self, rate: SampleRate) -> SampleRate {
        if self.takes(rate) { rate } else { rate.nearest_square() }
    }

    /// Why `rate` is not possible, and what is nearest; `None` where it is possible.
    pub fn refusal(self, rate: SampleRate) -> Option<String> {
        (!self.takes(rate)).then(|| {
            let free: Vec<&str> = Self::ALL
                .iter()
                .filter(|other| !other.needs_square())
                .map(|other| other.name())
                .collect();
            format!(
                "pattern {} takes a square number of samples, not {}; {} is nearest, and {} take any",
                self.name(),
                rate.samples(),
                self.nearest(rate).samples(),
                free.join(" and ")
            )
        })
    }

    /// The pattern with the same samples that is drawn fastest: one sample in the pixel's centre is a grid.
    #[must_use]
    pub(crate) fn simplest(self, rate: SampleRate) -> Self {
        match self {
            Self::Rotated | Self::R2 if rate == SampleRate::ONE => Self::Grid,
            pattern => pattern,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rates_that_a_pattern_refuses_have_a_nearest_one() {
        for pattern in SamplePattern::ALL {
            for samples in 1..=256 {
                let rate = SampleRate::new(samples).expect("a rate");
                let nearest = pattern.nearest(rate);
                assert!(pattern.takes(nearest), "{pattern:?} takes {nearest:?}");
                assert_eq!(
                    pattern.refusal(rate).is_none(),
                    nearest == rate,
                    "{pattern:?} {samples}"
                );
                let closer = |other: &SampleRate| {
                    pattern.takes(*other) && other.samples().abs_diff(samples) < nearest.samples().abs_diff(samples)
                };
                assert!(
                    !(1..=256).filter_map(SampleRate::new).any(|other| closer(&other)),
                    "{nearest:?} for {samples}"
                );
            }
        }
        let five = SampleRate::new(5).expect("a rate");
        let refusal = SamplePattern::Rotated.refusal(five).expect("no square");
        assert!(refusal.contains("not 5; 4 is nearest"), "{refusal}");
    }
}
