//! Whole numbers as values of options, refused in the words of all settings.

use std::ops::RangeInclusive;

/// Reads a whole number within a range, for the parser of an option.
pub(super) fn whole<N: TryFrom<u32>>(range: RangeInclusive<u32>) -> impl Fn(&str) -> Result<N, String> + Clone {
    move |text| {
        let number = text.parse().ok().filter(|number| range.contains(number));
        let read = number.and_then(|number| N::try_from(number).ok());
        read.ok_or_else(|| format!("the value is a whole number from {} to {}", range.start(), range.end()))
    }
}
