//! What the command line asks of the window.

use std::path::PathBuf;

use crate::geometry::View;
use crate::viewer::{Against, Grammar, NameTemplate, Restored, Settings, Theme};

/// How a session starts.
#[expect(
    clippy::struct_excessive_bools,
    reason = "three things that are wanted or not, each on its own"
)]
#[derive(Clone, Debug, Default)]
pub struct ViewOptions {
    /// Files and folders to open; none means the built-in gallery.
    pub paths: Vec<PathBuf>,
    /// Sampling, rules, dialect, pixel zoom.
    pub settings: Settings,
    /// The picture settings among them that were asked for, by their options: the others may be those of the last session.
    pub given: Vec<&'static str>,
    /// The view of every scene.
    pub view: View,
    /// What the picture is compared with at the start.
    pub against: Option<Against>,
    /// The window's inner size in device pixels; `None` is 1280x800 points, as far as
    /// the monitor has room.
    pub size: Option<[u32; 2]>,
    /// Device pixels per point of the panels; `None` is the monitor's own scale, or 1 without a window.
    pub scale: Option<f32>,
    /// Light or dark panels; `None` follows the desktop, or is dark where that is unknown.
    pub theme: Option<Theme>,
    /// Where screenshots go; `None` is the current folder.
    pub screenshot_dir: Option<PathBuf>,
    /// How they are called.
    pub screenshot_name: NameTemplate,
    /// Commands to play at the start.
    pub script: Option<ScriptSource>,
    /// Never opens a window: plays the script, or saves one picture of the window, and ends.
    pub headless: bool,
    /// The file that gets a line for each picture that the window shows.
    pub frame_log: Option<PathBuf>,
    /// Whether nothing is remembered from one session to the next, and nothing of the last one is taken up.
    pub no_config: bool,
    /// Whether that file may replace one of another making.
    pub force: bool,
    /// Reads command lines.
    pub grammar: Option<Grammar>,
    /// The picture that scene and settings come from.
    pub restored: Option<Restored>,
    /// Takes what is to be done when the system asks the program to end.
    pub await_end: Option<AwaitEnd>,
}

/// Takes what another thread is to do once, when the system asks the program to end.
pub type AwaitEnd = fn(Box<dyn Fn() + Send>);

/// Where a script comes from.
#[derive(Clone, Debug)]
pub enum ScriptSource {
    /// A file.
    File(PathBuf),
    /// The text itself, as `--do` gives it.
    Text(String),
}
