//! The values of options that have names: the same ones everywhere.

use std::ops::RangeInclusive;

use clap::ValueEnum;
use clap::builder::PossibleValue;

use super::sweep::Quality;
use super::writeup::Assignment;
use crate::color::ResolveSpace;
use crate::compare::{Measure, ProfileChannel, SpectrumOf};
use crate::figure::Ground;
use crate::viewer::{BoardSort, Theme};

/// Reads a whole number within a range, for the parser of an option.
pub(super) fn whole<N: TryFrom<u32>>(range: RangeInclusive<u32>) -> impl Fn(&str) -> Result<N, String> + Clone {
    move |text| {
        let number = text.parse().ok().filter(|number| range.contains(number));
        let read = number.and_then(|number| N::try_from(number).ok());
        read.ok_or_else(|| format!("the value is a whole number from {} to {}", range.start(), range.end()))
    }
}

/// Gives a settings enum its names on the command line, which are its names everywhere.
macro_rules! named_values {
    ($($kind:ty),*) => {$(
        impl ValueEnum for $kind {
            fn value_variants<'a>() -> &'a [Self] {
                &Self::ALL
            }

            fn to_possible_value(&self) -> Option<PossibleValue> {
                Some(PossibleValue::new(self.name()))
            }
        }
    )*};
}

named_values!(
    BoardSort,
    ResolveSpace,
    Quality,
    Theme,
    Measure,
    ProfileChannel,
    SpectrumOf,
    Ground,
    Assignment
);
