//! What `writeup` understands.

use std::path::PathBuf;

use clap::Args;

#[derive(Debug, Args)]
pub(in crate::cli) struct WriteupOptions {
    /// Which write-up
    #[arg(value_enum, default_value = Assignment::Course.name())]
    pub(in crate::cli) assignment: Assignment,
    /// The folder to write into; it is made where there is none
    #[arg(short, long, value_name = "OUT")]
    pub(in crate::cli) output: PathBuf,
    /// The course's scenes, with folders such as basic and texmap; those that are missing come from the gallery
    #[arg(long, value_name = "DIR")]
    pub(in crate::cli) scenes: Option<PathBuf>,
    /// Your own picture, PNG or JPEG, for the task of levels
    #[arg(long, value_name = "PHOTO")]
    pub(in crate::cli) own: Option<PathBuf>,
    /// Your own robot
    #[arg(long, value_name = "ROBOT.svg")]
    pub(in crate::cli) robot: Option<PathBuf>,
    /// Replace files of another making too; never what is read
    #[arg(long)]
    pub(in crate::cli) force: bool,
    /// Where insets look [default: OUT/pins.toml]
    #[arg(long, value_name = "FILE")]
    pub(in crate::cli) pins: Option<PathBuf>,
    /// Threads that draw [default: one per core]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=256))]
    pub(in crate::cli) threads: Option<u16>,
}

/// A write-up that the program knows the figures of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::cli) enum Assignment {
    /// A course on rasterization: six tasks and the competition.
    Course,
}

impl Assignment {
    pub(in crate::cli) const ALL: [Self; 1] = [Self::Course];

    pub(in crate::cli) const fn name(self) -> &'static str {
        match self {
            Self::Course => "course",
        }
    }
}
