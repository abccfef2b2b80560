//! What `bench` understands.

use std::path::PathBuf;

use clap::Args;

use super::framing::PictureOptions;
use super::whole::whole;

#[derive(Debug, Args)]
pub(in crate::cli) struct BenchOptions {
    /// SVG files, or scenes of the gallery such as gallery:basic/test4.svg
    #[arg(required = true, value_name = "SCENE")]
    pub(in crate::cli) scenes: Vec<PathBuf>,
    /// How often each scene is drawn
    #[arg(long, default_value_t = 30, value_name = "K", value_parser = whole::<u32>(1..=100_000))]
    pub(in crate::cli) frames: u32,
    /// Print JSON instead of text: an object, or for several scenes a list of objects
    #[arg(long)]
    pub(in crate::cli) json: bool,
    #[command(flatten)]
    pub(in crate::cli) picture: PictureOptions,
}
