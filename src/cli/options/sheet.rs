//! What `sheet` understands.

use std::path::PathBuf;

use clap::Args;

use super::framing::FramingOptions;
use super::lists::Lists;
use crate::cli::size::FrameSize;
use crate::figure::{Ground, InsetSpec};

#[derive(Clone, Debug, Args)]
pub(in crate::cli) struct SheetOptions {
    /// An SVG file, a scene of the gallery, or a PNG of this program: its scene and settings
    pub(in crate::cli) scene: PathBuf,
    /// The PNG file to write
    #[arg(short, long, value_name = "OUT.png")]
    pub(in crate::cli) output: PathBuf,
    /// Pixels of each panel [default: squares that make the sheet 1890 pixels wide, 16 cm at 300 dpi]
    #[arg(long, value_name = "WxH")]
    pub(in crate::cli) size: Option<FrameSize>,
    /// Magnify a region of every panel: X,Y is its middle in pixels, uX,Y in user units; may come several times
    #[arg(long = "inset", value_name = "X,Y[:REGION@FACTOR[:CORNER]]")]
    pub(in crate::cli) insets: Vec<InsetSpec>,
    /// Dark ink on white for print, or light ink on black for slides
    #[arg(long, default_value = Ground::Light.name(), value_enum)]
    pub(in crate::cli) theme: Ground,
    /// Replace panels and snippets of another making too; never what is read
    #[arg(long)]
    pub(in crate::cli) force: bool,
    /// A sentence that the caption ends with
    #[arg(long, value_name = "TEXT")]
    pub(in crate::cli) note: Option<String>,
    #[command(flatten)]
    pub(in crate::cli) axes: Lists,
    #[command(flatten)]
    pub(in crate::cli) framing: FramingOptions,
}
