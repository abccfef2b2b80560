//! What `sweep` understands.

use std::path::PathBuf;

use clap::Args;

use super::framing::FramingOptions;
use super::lists::Lists;
use super::whole::whole;
use crate::cli::size::FrameSize;
use crate::color::ResolveSpace;
use crate::viewer::BoardSort;

#[derive(Debug, Args)]
pub(in crate::cli) struct SweepOptions {
    /// An SVG file, a scene of the gallery, or a PNG of this program: its scene and settings
    pub(in crate::cli) scene: PathBuf,
    /// The table to write
    #[arg(long, value_name = "OUT.csv")]
    pub(in crate::cli) csv: PathBuf,
    /// The table to write as Markdown as well, without settings that all rows share
    #[arg(long, value_name = "OUT.md")]
    pub(in crate::cli) markdown: Option<PathBuf>,
    /// Which rows of the tables come first: the least error, what people see least of it, or the least time [default: the order of the lists]
    #[arg(long, value_enum)]
    pub(in crate::cli) sort: Option<BoardSort>,
    /// Average the samples of every truth in these values [default: those of the combination]
    #[arg(long, value_name = "SPACE", value_enum)]
    pub(in crate::cli) truth_space: Option<ResolveSpace>,
    /// The chart to write [default: the table's name, ending in .png]
    #[arg(long, value_name = "OUT.png")]
    pub(in crate::cli) plot: Option<PathBuf>,
    /// Replace a table or chart of another making too; never what is read
    #[arg(long)]
    pub(in crate::cli) force: bool,
    /// What the chart shows over the time
    #[arg(long, default_value = Quality::default().name(), value_enum)]
    pub(in crate::cli) quality: Quality,
    /// Frames whose time is taken, for each combination
    #[arg(long, default_value = "5", value_name = "K", value_parser = whole::<u32>(1..=10_000))]
    pub(in crate::cli) frames: u32,
    /// Pixels of the pictures
    #[arg(long, default_value = "1024x1024", value_name = "WxH", allow_hyphen_values = true)]
    pub(in crate::cli) size: FrameSize,
    #[command(flatten)]
    pub(in crate::cli) axes: Lists,
    #[command(flatten)]
    pub(in crate::cli) framing: FramingOptions,
}

/// How far a picture is from the truth, as the chart shows it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(in crate::cli) enum Quality {
    /// What people see of the difference: 0 is none.
    #[default]
    Flip,
    /// Likeness of structure: 1 is equal.
    Ssim,
    /// Signal to noise in decibels.
    Psnr,
    /// Root mean square error in levels of 255.
    Rmse,
}

impl Quality {
    /// Every value, in the order of help.
    pub(in crate::cli) const ALL: [Self; 4] = [Self::Flip, Self::Ssim, Self::Psnr, Self::Rmse];

    /// The name on the command line.
    pub(in crate::cli) const fn name(self) -> &'static str {
        match self {
            Self::Flip => "flip",
            Self::Ssim => "ssim",
            Self::Psnr => "psnr",
            Self::Rmse => "rmse",
        }
    }

    /// For the axis of the chart.
    pub(in crate::cli) fn title(self) -> &'static str {
        match self {
            Self::Flip => "FLIP difference from the truth, 0 is none",
            Self::Ssim => "SSIM with the truth, 1 is equal",
            Self::Psnr => "PSNR against the truth in dB, more is nearer",
            Self::Rmse => "root mean square error against the truth, in levels of 255",
        }
    }
}
