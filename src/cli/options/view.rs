//! What `view` understands.

use std::path::PathBuf;

use clap::Args;

use super::framing::FramingOptions;
use super::sampling::SamplingOptions;
use crate::cli::size::FrameSize;
use crate::viewer::{Against, NameTemplate, Theme};

#[expect(
    clippy::struct_excessive_bools,
    reason = "three things that are wanted or not, each on its own"
)]
#[derive(Clone, Debug, Args)]
pub(in crate::cli) struct ViewerOptions {
    /// SVG files and folders of them, or a PNG of this program: its scene, view and settings
    pub(in crate::cli) paths: Vec<PathBuf>,
    /// The window's size in device pixels [default: 1280x800]
    #[arg(long, value_name = "WxH", allow_hyphen_values = true)]
    pub(in crate::cli) size: Option<FrameSize>,
    /// Compare with this from the start: `truth` (or `truth stored`, `truth linear`), `settings`, settings such as "sample-rate 16, dialect svg", or the file of a
    /// PNG or JPEG
    #[arg(long, value_name = "FILE|truth|SETTINGS", value_parser = against)]
    pub(in crate::cli) against: Option<Against>,
    #[command(flatten)]
    pub(in crate::cli) sampling: SamplingOptions,
    #[command(flatten)]
    pub(in crate::cli) framing: FramingOptions,
    /// Panels light or dark [default: as the desktop]
    #[arg(long, value_enum)]
    pub(in crate::cli) theme: Option<Theme>,
    /// The folder that screenshots go to [default: the current one]
    #[arg(long, value_name = "DIR")]
    pub(in crate::cli) screenshot_dir: Option<PathBuf>,
    /// How they are called: words and {scene} {rate} {pixel} {level} {pattern} {time} [default: rasterscope-{time}]
    #[arg(long, value_name = "TEMPLATE", value_parser = NameTemplate::parse)]
    pub(in crate::cli) screenshot_name: Option<NameTemplate>,
    /// Play a script from a file
    #[arg(long, value_name = "FILE", conflicts_with = "commands")]
    pub(in crate::cli) script: Option<PathBuf>,
    /// Play a script, such as "key =; pin 512,300; key z; shot out.png"
    #[arg(long = "do", id = "commands", value_name = "SCRIPT")]
    pub(in crate::cli) commands: Option<String>,
    /// Play the script, or save one picture of the window, without a window
    #[arg(long)]
    pub(in crate::cli) headless: bool,
    /// Write a line of CSV for each picture that the window shows: what it shows, milliseconds per stage
    #[arg(long, value_name = "FILE", conflicts_with = "headless")]
    pub(in crate::cli) frame_log: Option<PathBuf>,
    /// Neither take up what the last window left (size and place, theme, settings, folded sections, opened files) nor remember it
    /// for the next
    #[arg(long)]
    pub(in crate::cli) no_config: bool,
    /// Replace files of another making too: the frame log, slides; never what is read
    #[arg(long)]
    pub(in crate::cli) force: bool,
    /// Device pixels per point of the panels; without it the monitor's own scale, or 1 with --headless
    #[arg(long, value_name = "FACTOR", value_parser = scale)]
    pub(in crate::cli) scale: Option<f32>,
}

fn against(text: &str) -> Result<Against, String> {
    let against = Against::from_text(text).filter(|against| *against != Against::Nothing);
    against.ok_or_else(|| "compare with truth, \"truth stored\", \"truth linear\", settings, settings such as \"sample-rate 16, dialect svg\", or the file of a PNG or JPEG".to_owned())
}

fn scale(text: &str) -> Result<f32, String> {
    let factor = text.parse().ok().filter(|factor| (0.5..=8.0).contains(factor));
    factor.ok_or_else(|| "the scale of the panels is a factor from 0.5 to 8".to_owned())
}
