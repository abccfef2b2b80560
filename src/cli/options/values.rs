//! The values of options that have names: the same ones everywhere.

use clap::ValueEnum;
use clap::builder::PossibleValue;

use super::sweep::Quality;
use super::writeup::Assignment;
use crate::color::ResolveSpace;
use crate::compare::{Measure, ProfileChannel, SpectrumOf};
use crate::figure::Ground;
use crate::viewer::{BoardSort, Theme};

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
