//! What `render` understands.

use std::path::PathBuf;

use clap::Args;

use super::framing::PictureOptions;
use crate::figure::InsetSpec;

#[derive(Debug, Args)]
pub(in crate::cli) struct RenderOptions {
    /// An SVG file, a folder whose scenes are all drawn, or a PNG of this program: its scene and settings
    pub(in crate::cli) scene: PathBuf,
    /// The PNG file to write; for a folder, the folder to write into
    #[arg(short, long, value_name = "OUT")]
    pub(in crate::cli) output: PathBuf,
    /// Replace pictures of another making too, in the folder to write into; never what is read
    #[arg(long)]
    pub(in crate::cli) force: bool,
    /// Leave the legend of a visualisation away
    #[arg(long)]
    pub(in crate::cli) no_legend: bool,
    #[command(flatten)]
    pub(in crate::cli) picture: PictureOptions,

    /// Magnify a region in a corner: X,Y is its middle in pixels, uX,Y in canvas units; may come several times
    #[arg(long = "inset", value_name = "X,Y[:REGION@FACTOR[:CORNER]]")]
    pub(in crate::cli) insets: Vec<InsetSpec>,
}
