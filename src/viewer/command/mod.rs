//! Everything a user can do, as data: what a key, a menu, a script or a test asks for is one of these.
//!
//! Positions are in window pixels: device pixels from the window's upper left corner. Pixels that a user names are
//! frame pixels; the two differ only where a pixel zoom is in force.

pub(in crate::viewer) mod arguments;
pub mod key_bindings;
pub(in crate::viewer) mod parts;
pub(in crate::viewer) mod spec;
pub(in crate::viewer) mod table;

use std::path::PathBuf;

use crate::raster::Framebuffer;
use crate::viewer::settings::picture::SettingChange;

pub use parts::{
    AbCommand, BoardCommand, ExportCommand, InspectorCommand, LessonCommand, PointerCommand, ProfileCommand,
    SceneCommand, SheetCommand, SpectrumCommand, ViewCommand, WindowCommand,
};

/// One thing that a user can do, by the part of the viewer that it is about.
#[derive(Clone, Debug, PartialEq)]
pub enum Command {
    /// What the mouse does.
    Pointer(PointerCommand),
    /// Moving, scaling and turning the picture.
    View(ViewCommand),
    /// Changes a setting of the picture; of its dialect, and the scene is read again.
    Set(SettingChange),
    /// Brings every setting of sampling and textures back to its default.
    SetDefaults,
    /// Comparing A with B.
    Ab(AbCommand),
    /// Which scene is shown.
    Scenes(SceneCommand),
    /// Walking through a lesson.
    Lesson(LessonCommand),
    /// The inspector, its pin and the explanation.
    Inspector(InspectorCommand),
    /// The profile of an edge.
    Profile(ProfileCommand),
    /// Several settings beside the truth.
    Board(BoardCommand),
    /// The spectrum of the picture.
    Spectrum(SpectrumCommand),
    /// What leaves the program.
    Export(ExportCommand),
    /// The sheet that is being put together.
    Sheet(SheetCommand),
    /// What the window shows besides the picture.
    Window(WindowCommand),
}

impl Command {
    /// Sets a picture setting, named by its option, to a value such as `16`.
    ///
    /// # Errors
    /// One line where there is no such setting or no such value.
    pub fn set(option: &str, value: &str) -> Result<Self, String> {
        SettingChange::of(option, value).map(Self::Set)
    }

    /// Steps a picture setting to its next value, or to the one before where `by` is below zero; `None` where there is no
    /// such setting.
    pub fn step(option: &str, by: f64) -> Option<Self> {
        crate::viewer::settings::picture::find(option).map(|setting| Self::Set(setting.step(by)))
    }
}

/// What a command asks of the program around the viewer.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Effect {
    /// Put this text on the clipboard.
    CopyText(String),
    /// Put this picture on the clipboard.
    CopyPicture(Framebuffer),
    /// Give the picture of the whole window to [`crate::viewer::state::Viewer::save_window_picture`].
    PictureOfWindow,
    /// Show this folder in the platform's file manager.
    OpenFolder(PathBuf),
    /// Give the keyboard to the next panel.
    FocusPanel {
        /// To the one before.
        back: bool,
    },
    /// End the program.
    Quit,
}
