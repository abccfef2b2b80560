//! What `profile` understands.

use std::path::PathBuf;

use clap::Args;

use super::framing::PictureOptions;
use crate::compare::{Line, ProfileChannel};

#[derive(Debug, Args)]
pub(in crate::cli) struct ProfileOptions {
    /// An SVG file, a scene of the gallery, or a PNG of this program: its scene and settings
    pub(in crate::cli) scene: PathBuf,
    /// The line across the edge: column and row of the pixels at its ends, from 0
    #[arg(long, value_name = "X0,Y0,X1,Y1", value_parser = line, allow_hyphen_values = true)]
    pub(in crate::cli) line: Line,
    /// What of the colours is measured
    #[arg(long, default_value = ProfileChannel::default().name(), value_enum)]
    pub(in crate::cli) channel: ProfileChannel,
    /// A table to write: a line for each pixel, with its values and those of the truth
    #[arg(long, value_name = "OUT.csv")]
    pub(in crate::cli) csv: Option<PathBuf>,
    /// Replace a table of another making too; never what is read
    #[arg(long)]
    pub(in crate::cli) force: bool,
    /// Print JSON instead of text, with the values of every pixel
    #[arg(long)]
    pub(in crate::cli) json: bool,
    #[command(flatten)]
    pub(in crate::cli) picture: PictureOptions,
}

fn line(text: &str) -> Result<Line, String> {
    let numbers: Option<Vec<i64>> = text
        .split(',')
        .map(|part| part.trim().parse::<i32>().ok().map(i64::from))
        .collect();
    match numbers.as_deref() {
        Some(&[a, b, c, d]) => Ok(Line { ends: [[a, b], [c, d]] }),
        _ => Err("a line is column and row of two pixels, such as 300,200,340,200".to_owned()),
    }
}
