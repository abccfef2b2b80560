//! What `pattern` understands.

use clap::Args;

use super::inspect::{PixelPlace, pixel};
use super::whole::whole;
use crate::raster::SampleRate;

#[derive(Debug, Args)]
pub(in crate::cli) struct PatternOptions {
    /// Which patterns, by name or as TOML files; without one all that have that many samples
    #[arg(value_name = "PATTERN")]
    pub(in crate::cli) patterns: Vec<String>,
    /// Samples per pixel, 1 to 256 [default: 16, or as many as a custom pattern has]
    #[arg(long, value_name = "N", value_parser = whole::<u32>(1..=SampleRate::MAX))]
    pub(in crate::cli) sample_rate: Option<u32>,
    /// Which places samples have where chance decides about them: 0 to 65535
    #[arg(long, default_value_t = 0, value_name = "N", value_parser = whole::<u16>(0..=65_535))]
    pub(in crate::cli) seed: u16,
    /// Column and row of the pixel, from 0, whose samples are listed
    #[arg(long, default_value = "0,0", value_name = "X,Y", value_parser = pixel, allow_hyphen_values = true)]
    pub(in crate::cli) pixel: PixelPlace,
    /// Print JSON instead of text, with the places of all samples and the power of their frequencies
    #[arg(long)]
    pub(in crate::cli) json: bool,
}
