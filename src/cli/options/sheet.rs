//! What `sheet` understands.

use std::path::PathBuf;

use clap::Args;

use super::framing::FramingOptions;
use super::lists::Lists;
use crate::cli::size::FrameSize;
use crate::figure::{Ground, InsetSpec};
use crate::viewer::AxisLists;

#[derive(Clone, Debug, Args)]
pub(in crate::cli) struct SheetOptions {
    /// An SVG file, a scene of the gallery, or a PNG of this program: its scene and settings
    pub(in crate::cli) scene: PathBuf,
    /// The PNG file to write
    #[arg(short, long, value_name = "OUT.png")]
    pub(in crate::cli) output: PathBuf,
    /// Pixels of each panel [default: squares that make the sheet 1890 pixels wide, 16 cm at 300 dpi]
    #[arg(long, value_name = "WxH", allow_hyphen_values = true)]
    pub(in crate::cli) size: Option<FrameSize>,
    /// Magnify a region of every panel: X,Y is its middle in pixels, uX,Y in canvas units; may come several times
    #[arg(long = "inset", value_name = "X,Y[:REGION@FACTOR[:CORNER]]")]
    pub(in crate::cli) insets: Vec<InsetSpec>,
    /// Dark ink on white for print, or light ink on black for slides
    #[arg(long, default_value = Ground::Light.name(), value_enum)]
    pub(in crate::cli) theme: Ground,
    /// Put the panels of the only list below each other instead of side by side
    #[arg(long)]
    pub(in crate::cli) stacked: bool,
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

impl SheetOptions {
    /// The lists of values, in the direction that is asked for.
    ///
    /// # Errors
    /// One line where more than one list is to be a stack.
    pub(in crate::cli) fn axis_lists(&self) -> Result<AxisLists, String> {
        let lists = self.axes.0.clone().stacked(self.stacked);
        if self.stacked && lists.axes().count() > 1 {
            return Err(
                "--stacked: of two lists the second goes from top to bottom already; leave one of both out".to_owned(),
            );
        }
        Ok(lists)
    }
}
