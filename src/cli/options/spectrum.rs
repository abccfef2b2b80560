//! What `spectrum` understands.

use std::path::PathBuf;

use clap::Args;

use super::framing::PictureOptions;
use super::whole::whole;
use crate::compare::SpectrumOf;
use crate::raster::Region;

#[derive(Debug, Args)]
pub(in crate::cli) struct SpectrumOptions {
    /// An SVG file, a scene of the gallery, or a PNG of this program: its scene and settings
    pub(in crate::cli) scene: PathBuf,
    /// What is transformed: the frame, its difference to the truth, the mip level that the pixel in the middle of the region
    /// reads, or the scene before pixels sample it
    #[arg(long, default_value = SpectrumOf::default().name(), value_enum)]
    pub(in crate::cli) of: SpectrumOf,
    /// The pixels that are transformed: column and row of the first, width and height, as far as the picture has
    /// them [default: all]; of more than 512 the middle
    #[arg(long, value_name = "X,Y,W,H", value_parser = region)]
    pub(in crate::cli) region: Option<Region>,
    /// A picture of the spectrum to write, with axes and the box of frequencies that pixels can show
    #[arg(short, long, value_name = "OUT.png")]
    pub(in crate::cli) output: Option<PathBuf>,
    /// How many of the strongest waves are listed
    #[arg(long, default_value_t = 8, value_name = "N", value_parser = whole::<u16>(1..=1000))]
    pub(in crate::cli) peaks: u16,
    /// A table of them to write
    #[arg(long, value_name = "OUT.csv")]
    pub(in crate::cli) csv: Option<PathBuf>,
    /// Replace pictures and tables of another making too; never what is read
    #[arg(long)]
    pub(in crate::cli) force: bool,
    /// Print JSON instead of text
    #[arg(long)]
    pub(in crate::cli) json: bool,
    #[command(flatten)]
    pub(in crate::cli) picture: PictureOptions,
}

fn region(text: &str) -> Result<Region, String> {
    let numbers: Option<Vec<u32>> = text.split(',').map(|part| part.trim().parse().ok()).collect();
    match numbers.as_deref() {
        Some(&[x, y, width, height]) if width > 0 && height > 0 => Ok(Region { x, y, width, height }),
        _ => Err("a region is column, row, width and height in pixels, such as 300,200,128,128".to_owned()),
    }
}
