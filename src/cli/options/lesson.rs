//! What `lesson` understands.

use std::path::PathBuf;

use clap::Args;

use super::view::ViewerOptions;
use super::whole::whole;

#[derive(Debug, Args)]
pub(in crate::cli) struct LessonOptions {
    /// A lesson in TOML, or one of the program's: six-tasks, anisotropy, patterns, thin-ray
    pub(in crate::cli) lesson: PathBuf,
    /// Draw each step into a numbered PNG in this folder [size by default: 1600x900]
    #[arg(long, value_name = "DIR")]
    pub(in crate::cli) slides: Option<PathBuf>,
    /// Draw only this step, counted from 1
    #[arg(long, value_name = "N", requires = "slides", value_parser = whole::<u32>(1..=u32::MAX))]
    pub(in crate::cli) step: Option<u32>,
    #[command(flatten)]
    pub(in crate::cli) view: ViewerOptions,
}
