//! What `inspect` understands.

use std::path::PathBuf;

use clap::Args;

use super::framing::PictureOptions;

#[derive(Debug, Args)]
pub(in crate::cli) struct InspectOptions {
    /// An SVG file, or a scene of the gallery such as gallery:basic/test4.svg
    pub(in crate::cli) scene: PathBuf,
    /// Column and row of the pixel, from 0
    #[arg(long, value_name = "X,Y", value_parser = pixel, allow_hyphen_values = true)]
    pub(in crate::cli) pixel: PixelPlace,
    /// The sample whose data are printed in full for every primitive, from 1 [default: the most telling one]
    #[arg(long, value_name = "K")]
    pub(in crate::cli) sample: Option<u32>,
    /// Print JSON instead of text: everything about every sample
    #[arg(long)]
    pub(in crate::cli) json: bool,
    #[command(flatten)]
    pub(in crate::cli) picture: PictureOptions,
}

/// Column and row of a pixel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::cli) struct PixelPlace(pub(in crate::cli) [u32; 2]);

pub(super) fn pixel(text: &str) -> Result<PixelPlace, String> {
    let place = text
        .split_once(',')
        .and_then(|(x, y)| Some(PixelPlace([x.trim().parse().ok()?, y.trim().parse().ok()?])));
    place.ok_or_else(|| "a pixel is its column and row from 0, such as 300,200".to_owned())
}
