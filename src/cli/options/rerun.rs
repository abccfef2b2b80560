//! What `rerun` understands.

use std::path::PathBuf;

use clap::Args;

#[derive(Debug, Args)]
pub(in crate::cli) struct RerunOptions {
    /// A PNG that this program wrote
    pub(in crate::cli) shot: PathBuf,
    /// Compare with the picture instead of writing a file
    #[arg(long)]
    pub(in crate::cli) check: bool,
    /// The PNG file to write
    #[arg(short, long, value_name = "OUT.png", conflicts_with = "check")]
    pub(in crate::cli) output: Option<PathBuf>,
    /// The scene, where it is no longer at its place
    #[arg(long, value_name = "FILE")]
    pub(in crate::cli) scene: Option<PathBuf>,
    /// Threads that draw [default: one per core]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=256))]
    pub(in crate::cli) threads: Option<u16>,
}
