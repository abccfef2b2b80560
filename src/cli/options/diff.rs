//! What `diff` understands.

use std::path::PathBuf;

use clap::Args;

use super::framing::FramingOptions;
use super::sampling::SamplingOptions;
use super::whole::whole;
use crate::compare::Measure;

#[derive(Debug, Args)]
pub(in crate::cli) struct DiffOptions {
    /// The reference: a PNG or JPEG, or a scene (.svg, gallery:...) that is drawn at the size of B
    pub(in crate::cli) a: PathBuf,
    /// What is compared with it: a PNG or JPEG of the same size
    pub(in crate::cli) b: PathBuf,
    /// A PNG file to write the difference into, as a picture
    #[arg(short, long, value_name = "DIFF.png")]
    pub(in crate::cli) output: Option<PathBuf>,
    /// Which difference the picture shows
    #[arg(long, default_value = Measure::default().name(), value_enum, requires = "output")]
    pub(in crate::cli) mode: Measure,
    /// What the shown difference is multiplied with
    #[arg(long, default_value = "1", value_name = "G", value_parser = gain, allow_negative_numbers = true, requires = "output")]
    pub(in crate::cli) gain: f32,
    /// Choose the gain that makes the largest difference the last colour
    #[arg(long, conflicts_with = "gain", requires = "output")]
    pub(in crate::cli) normalize: bool,
    /// Levels of 255 that a channel may differ by without an exit status of 1
    #[arg(long, default_value_t = 0, value_name = "T", allow_negative_numbers = true, value_parser = whole::<u8>(0..=255))]
    pub(in crate::cli) tolerance: u8,
    /// Most pixels of a picture; comparing takes about 16 bytes of memory for each
    #[arg(long, default_value_t = MAX_PIXELS, value_name = "N")]
    pub(in crate::cli) max_pixels: u64,
    /// Print JSON instead of text
    #[arg(long)]
    pub(in crate::cli) json: bool,
    #[command(flatten, next_help_heading = "How a scene is drawn")]
    pub(in crate::cli) sampling: SamplingOptions,
    #[command(flatten)]
    pub(in crate::cli) framing: FramingOptions,
}

/// Pixels of pictures that `diff` compares unasked: with all that it makes of them about 1.6 GB.
pub(in crate::cli) const MAX_PIXELS: u64 = 100_000_000;

fn gain(text: &str) -> Result<f32, String> {
    let gain = text.parse().ok().filter(|gain| (1e-6..=1e6).contains(gain));
    gain.ok_or_else(|| "the gain is a number from 0.000001 to 1000000".to_owned())
}
