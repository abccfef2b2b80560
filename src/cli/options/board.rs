//! What `board` understands.

use std::path::PathBuf;

use clap::Args;

use super::framing::PictureOptions;
use super::whole::whole;
use crate::color::ResolveSpace;
use crate::figure::Ground;
use crate::raster::Region;
use crate::viewer::{BoardCommandLine, BoardSort};

#[derive(Clone, Debug, Args)]
pub(in crate::cli) struct BoardOptions {
    /// An SVG file, a scene of the gallery, or a PNG of this program: its scene and settings
    pub(in crate::cli) scene: PathBuf,
    /// Settings to compare, changes of those of the other options: "sample-rate 16, pattern sobol"; A changes nothing. Up to nine times
    #[arg(long = "with", value_name = "SETTINGS", allow_hyphen_values = true)]
    pub(in crate::cli) with: Vec<String>,
    /// Compare the values of a setting that has names, such as pattern, or those of a list, sample-rate=1,4,16
    #[arg(long, value_name = "SETTING[=LIST]")]
    pub(in crate::cli) vary: Option<String>,
    /// What is shown and compared: column, row, width and height in pixels [default: 64x64 pixels in the middle]
    #[arg(long, value_name = "X,Y,W,H", value_parser = region, allow_hyphen_values = true)]
    pub(in crate::cli) region: Option<Region>,
    /// What comes first: the least error, the least that people see of it, or the least time
    #[arg(long, default_value = BoardSort::default().name(), value_enum)]
    pub(in crate::cli) sort: BoardSort,
    /// Average the samples of the truth in these values [default: those of the other options]
    #[arg(long, value_name = "SPACE", value_enum)]
    pub(in crate::cli) truth_space: Option<ResolveSpace>,
    /// Frames whose time is taken, for each of the settings
    #[arg(long, default_value_t = BoardCommandLine::FRAMES, value_name = "K", value_parser = whole::<u32>(1..=10_000))]
    pub(in crate::cli) frames: u32,
    /// A picture to write: the truth and all settings side by side, with their numbers
    #[arg(short, long, value_name = "OUT.png")]
    pub(in crate::cli) output: Option<PathBuf>,
    /// Dark ink on white for print, or light ink on black for slides
    #[arg(long, default_value = Ground::Light.name(), value_enum)]
    pub(in crate::cli) theme: Ground,
    /// Replace a picture of another making too; never what is read
    #[arg(long)]
    pub(in crate::cli) force: bool,
    #[command(flatten)]
    pub(in crate::cli) table: TableForm,
    /// Print JSON
    #[arg(long, group = "form")]
    pub(in crate::cli) json: bool,
    #[command(flatten)]
    pub(in crate::cli) picture: PictureOptions,
}

/// How the table is printed where not as text.
#[derive(Clone, Copy, Debug, Args)]
pub(in crate::cli) struct TableForm {
    /// Print the table as Markdown instead of text
    #[arg(long, group = "form")]
    pub(in crate::cli) markdown: bool,
    /// Print it as CSV
    #[arg(long, group = "form")]
    pub(in crate::cli) csv: bool,
}

fn region(text: &str) -> Result<Region, String> {
    let numbers: Option<Vec<u32>> = text.split(',').map(|part| part.trim().parse().ok()).collect();
    match numbers.as_deref() {
        Some(&[x, y, width, height]) if width > 0 && height > 0 => Ok(Region { x, y, width, height }),
        _ => Err("a region is column, row, width and height in pixels, such as 480,480,64,64".to_owned()),
    }
}
