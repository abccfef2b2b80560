//! What `pattern` understands.

use clap::Args;
use clap::builder::{PossibleValuesParser, TypedValueParser as _};

use super::inspect::{PixelPlace, pixel};
use crate::raster::{SamplePattern, SampleRate};

#[derive(Debug, Args)]
pub(in crate::cli) struct PatternOptions {
    /// Which patterns; without a name all that have that many samples
    #[arg(value_name = "PATTERN", value_parser = PossibleValuesParser::new(SamplePattern::ALL.map(SamplePattern::name)).map(|name| named(&name)))]
    pub(in crate::cli) patterns: Vec<SamplePattern>,
    /// Samples per pixel, 1 to 256
    #[arg(long, default_value_t = 16, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=i64::from(SampleRate::MAX)))]
    pub(in crate::cli) sample_rate: u32,
    /// Which places samples have where chance decides about them: 0 to 65535
    #[arg(long, default_value_t = 0, value_name = "N")]
    pub(in crate::cli) seed: u16,
    /// Column and row of the pixel, from 0, whose samples are told
    #[arg(long, default_value = "0,0", value_name = "X,Y", value_parser = pixel)]
    pub(in crate::cli) pixel: PixelPlace,
    /// Print JSON instead of text, with the places of all samples and the power of their frequencies
    #[arg(long)]
    pub(in crate::cli) json: bool,
}

/// One of the names that the parser has let through.
fn named(name: &str) -> SamplePattern {
    let mut all = SamplePattern::ALL.into_iter();
    all.find(|pattern| pattern.name() == name).unwrap_or_default()
}
