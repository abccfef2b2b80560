//! What is drawn of a scene, how large, and on how many threads.

use clap::Args;

use super::sampling::SamplingOptions;
use super::whole::whole;
use crate::cli::size::FrameSize;
use crate::cli::view_option;
use crate::geometry::View;

/// What every command that draws understands.
#[derive(Clone, Debug, Args)]
pub(in crate::cli) struct PictureOptions {
    /// Pixels of the picture
    #[arg(long, default_value = "1024x1024", value_name = "WxH", allow_hyphen_values = true)]
    pub(in crate::cli) size: FrameSize,
    #[command(flatten)]
    pub(in crate::cli) sampling: SamplingOptions,
    #[command(flatten)]
    pub(in crate::cli) framing: FramingOptions,
}

/// What part of a scene is drawn, and on how many threads.
#[derive(Clone, Debug, Args)]
pub(in crate::cli) struct FramingOptions {
    /// Which part of the scene: all of it with a margin and an outline; `canvas`, which fills the picture, stretched where proportions
    /// differ; or centre, pixels per canvas unit and degrees
    #[arg(long, default_value = "default", value_name = "default|canvas|CX,CY,SCALE[,ROTATION]", value_parser = view_option::parse, allow_hyphen_values = true)]
    pub(in crate::cli) view: View,
    /// Threads that draw or compare [default: one per core]
    #[arg(long, value_name = "N", value_parser = whole::<u16>(1..=256))]
    pub(in crate::cli) threads: Option<u16>,
}
