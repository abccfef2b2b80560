//! Where the samples of a pixel may lie: the patterns that a user chooses from, each an arrangement in a file of its own.
//!
//! ```text
//!    grid      jittered   multi-jittered      sobol        samples of a pixel, 4 of them
//!   .---.---.  .---.---.  .-.-.-.-.        .-.-.-.-.
//!   | o | o |  |o  |  o|  |o| | | |        | |o| | |
//!   |---+---|  |---+---|  |-+-+-+-|        |-+-+-+-|
//!   | o | o |  |  o| o |  | | |o| |        | | | |o|
//!   '---'---'  '---'---'  |-+-+-+-|        |-+-+-+-|
//!                         | |o| | |        |o| | | |
//!                         |-+-+-+-|        |-+-+-+-|
//!                         | | | |o|        | | |o| |
//! ```
//!
//! To add a pattern, write its arrangement and add an entry to the table below.

pub(in crate::raster::sampling) mod arrange;
mod blue_noise;
mod cells;
mod custom;
mod entry;
mod grid;
mod halton;
mod jittered;
mod multi_jittered;
mod r2;
mod random;
pub(in crate::raster::sampling) mod random_bits;
mod rotated;
mod sobol;

use crate::raster::sampling::pattern::arrange::Arrange;
pub use crate::raster::sampling::pattern::custom::{CustomPattern, CustomPatternError, CustomSample, CustomWords};
use crate::raster::sampling::pattern::entry::{Entry, Spread};
use crate::raster::sampling::rate::SampleRate;

/// Makes the enum of all patterns, with what there is to say of each.
macro_rules! patterns {
    ($($(#[$doc:meta])* $kind:ident => $entry:expr,)+) => {
        /// Where the samples of a pixel lie.
        ///
        /// All but the grid are snapped to a lattice of 256 x 256 points per pixel, so that coverage stays exact: a sample is
        /// moved by less than 1/256 of a pixel, and never out of its cell.
        #[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
        pub enum SamplePattern {
            $($(#[$doc])* $kind,)+
            /// Places and weights that somebody wrote down.
            Custom(&'static CustomPattern),
        }

        impl SamplePattern {
            /// Every value but the custom ones, in the order of menus and of the key that steps through them.
            pub const ALL: [Self; [$(stringify!($kind)),+].len()] = [$(Self::$kind),+];

            const fn entry(self) -> &'static Entry {
                match self {
                    $(Self::$kind => {
                        static ENTRY: Entry = $entry;
                        &ENTRY
                    })+
                    Self::Custom(pattern) => &pattern.entry,
                }
            }
        }
    };
}

// The table of patterns: an entry for each.
patterns! {
    /// The centres of `n x n` equal cells.
    #[default]
    Grid => Entry {
        name: "grid",
        description: "the middles of n x n cells",
        source: "",
        needs_square: true,
        spread: Spread::Fixed,
        arrange: &grid::Grid,
    },
    /// `n x n` points in `n^2` different columns and rows, one in each cell of the grid, which is turned by `atan(1 / n)`.
    /// With four samples this is the "rotated grid" of graphics hardware.
    Rotated => Entry {
        name: "rotated",
        description: "one in each of n x n cells, no two in a column or row: the grid turned by `atan(1/n)`",
        source: "graphics hardware for 4; Chiu, Shirley, Wang 1994",
        needs_square: true,
        spread: Spread::Fixed,
        arrange: &rotated::Rotated,
    },
    /// One point anywhere in each of `n x n` cells, other ones in every pixel.
    Jittered => Entry {
        name: "jittered",
        description: "anywhere in each of n x n cells, other places in every pixel",
        source: "Cook 1986",
        needs_square: true,
        spread: Spread::Own,
        arrange: &jittered::Jittered,
    },
    /// One point anywhere in each of `n x n` cells, the same ones in every pixel.
    JitteredSame => Entry {
        name: "jittered-same",
        description: "anywhere in each of n x n cells, the same places in every pixel",
        source: "",
        needs_square: true,
        spread: Spread::Alike,
        arrange: &jittered::Jittered,
    },
    /// Points anywhere in `n x n` cells and in `n^2` different columns and rows, other ones in every pixel.
    MultiJittered => Entry {
        name: "multi-jittered",
        description: "anywhere in each of n x n cells and n² columns and rows, other places in every pixel",
        source: "Kensler 2013",
        needs_square: true,
        spread: Spread::Own,
        arrange: &multi_jittered::MultiJittered,
    },
    /// Points anywhere in the pixel, other ones in every pixel.
    Random => Entry {
        name: "random",
        description: "anywhere, other places in every pixel",
        source: "",
        needs_square: false,
        spread: Spread::Own,
        arrange: &random::Random,
    },
    /// The first points, from number 1 on, of the sequence in bases 2 and 3.
    Halton => Entry {
        name: "halton",
        description: "radical inverses in bases 2 and 3, from number 1 on",
        source: "Halton 1960",
        needs_square: false,
        spread: Spread::Fixed,
        arrange: &halton::Halton,
    },
    /// Evenly from left to right, and radical inverses in base 2 from top to bottom.
    Hammersley => Entry {
        name: "hammersley",
        description: "evenly from left to right, radical inverses in base 2 from top to bottom",
        source: "Hammersley 1960",
        needs_square: false,
        spread: Spread::Fixed,
        arrange: &halton::Hammersley,
    },
    /// The first points of Sobol's sequence, scrambled otherwise in every pixel.
    Sobol => Entry {
        name: "sobol",
        description: "a (0, 2)-sequence, scrambled otherwise in every pixel",
        source: "Sobol 1967, Owen 1995, Burley 2020",
        needs_square: false,
        spread: Spread::Own,
        arrange: &sobol::Sobol,
    },
    /// The first points of Sobol's sequence, scrambled alike in every pixel.
    SobolSame => Entry {
        name: "sobol-same",
        description: "a (0, 2)-sequence, scrambled alike in every pixel",
        source: "",
        needs_square: false,
        spread: Spread::Alike,
        arrange: &sobol::Sobol,
    },
    /// The first points of Sobol's sequence, shifted in each pixel by the numbers of a tile of blue noise.
    BlueNoise => Entry {
        name: "blue-noise",
        description: "a (0, 2)-sequence, shifted in each pixel so that neighbours differ most",
        source: "Ulichney 1993, Georgiev and Fajardo 2016",
        needs_square: false,
        spread: Spread::Own,
        arrange: &blue_noise::BlueNoise,
    },
    /// The first points of the additive recurrence with the plastic number, beginning in the pixel's centre.
    R2 => Entry {
        name: "r2",
        description: "additive recurrence with the plastic number, from the middle on",
        source: "Roberts 2018",
        needs_square: false,
        spread: Spread::Fixed,
        arrange: &r2::R2,
    },
}

/// Chooses one of all possible ways in which patterns with random bits place their samples.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Seed(u16);

impl Seed {
    /// The greatest.
    pub const MAX: u32 = u16::MAX as u32;

    /// This one; `None` above [`Seed::MAX`].
    pub fn new(number: u32) -> Option<Self> {
        u16::try_from(number).ok().map(Self)
    }

    /// The number.
    pub fn number(self) -> u32 {
        self.0.into()
    }

    /// Random bits that it stands for.
    pub(super) fn bits(self) -> u64 {
        /// Those of number 0.
        const FIRST: u64 = 0x5261_7374_6572_7363;
        FIRST ^ u64::from(self.0).wrapping_mul(0x9E37_79B9_7F4A_7C15)
    }
}

impl SamplePattern {
    /// The name used in the command line and the interface.
    pub const fn name(self) -> &'static str {
        self.entry().name
    }

    /// Where the samples of a pixel lie, in few words.
    pub const fn description(self) -> &'static str {
        self.entry().description
    }

    /// Whom the pattern goes back to; empty where it is everybody's.
    pub const fn source(self) -> &'static str {
        self.entry().source
    }

    /// Whether the pattern divides a pixel into cells, so that only square numbers of samples are possible.
    pub const fn needs_square(self) -> bool {
        self.entry().needs_square
    }

    /// Whether each pixel has samples at places of its own.
    pub fn differs_by_pixel(self) -> bool {
        self.entry().spread == Spread::Own
    }

    /// Whether a seed decides where samples lie.
    pub fn is_seeded(self) -> bool {
        self.entry().spread != Spread::Fixed
    }

    /// What places the samples.
    pub(super) fn arrange(self) -> &'static dyn Arrange {
        self.entry().arrange
    }

    /// Whether it has that many samples.
    pub fn takes(self, rate: SampleRate) -> bool {
        match self {
            Self::Custom(pattern) => pattern.rate() == rate,
            _ => !self.needs_square() || rate.is_square(),
        }
    }

    /// The possible rate that is nearest to `rate`; the lower one of two.
    #[must_use]
    pub fn nearest(self, rate: SampleRate) -> SampleRate {
        match self {
            Self::Custom(pattern) => pattern.rate(),
            _ if self.takes(rate) => rate,
            _ => rate.nearest_square(),
        }
    }

    /// Why `rate` is not possible, and what is nearest; `None` where it is possible.
    pub fn refusal(self, rate: SampleRate) -> Option<String> {
        (!self.takes(rate)).then(|| {
            let free: Vec<&str> = Self::ALL
                .iter()
                .filter(|other| !other.needs_square())
                .map(|other| other.name())
                .collect();
            let [others @ .., last] = free.as_slice() else {
                return String::new();
            };
            let (name, others, nearest) = (self.name(), others.join(", "), self.nearest(rate).samples());
            let asked = rate.samples();
            match self {
                Self::Custom(_) => {
                    let plural = if nearest == 1 { "" } else { "s" };
                    format!("pattern {name} takes {nearest} sample{plural}, not {asked}; {others} and {last} take any number")
                }
                _ => format!(
                    "pattern {name} takes a square number of samples, not {asked}; {nearest} is nearest, and {others} and {last} take any"
                ),
            }
        })
    }

    /// The pattern with the same samples that is drawn fastest: one sample in the pixel's centre is a grid.
    #[must_use]
    pub(crate) fn simplest(self, rate: SampleRate) -> Self {
        match self {
            Self::Rotated | Self::R2 | Self::Hammersley if rate == SampleRate::ONE => Self::Grid,
            Self::Custom(custom) if custom.is_centre() => Self::Grid,
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
