//! Everything a user can do, as data: what a key, a menu, a script or a test asks for is one of these.
//!
//! Positions are in window pixels: device pixels from the window's upper left corner. Pixels that a user names are
//! frame pixels; the two differ only where a pixel zoom is in force.

pub(in crate::viewer) mod arguments;
pub mod lookup;
pub(in crate::viewer) mod spec;
pub(in crate::viewer) mod table;

use std::path::PathBuf;

use glam::DVec2;

use crate::compare::Measure;
use crate::figure::PixelRect;
use crate::inspect::TexelPlace;
use crate::raster::Framebuffer;
use crate::viewer::ab::other::{Against, Arrangement};
use crate::viewer::chrome::Dialog;
use crate::viewer::export::sheet::draft::SheetChange;
use crate::viewer::lesson::source::LessonSource;
use crate::viewer::settings::picture::SettingChange;
use crate::viewer::settings::{PixelZoom, Theme, Toggle};
use crate::viewer::view::camera::ViewNumbers;
use crate::viewer::view::pointer::PointerButton;

/// One thing that a user can do.
#[derive(Clone, Debug, PartialEq)]
pub enum Command {
    // Pointer.
    /// The pointer is at `at`, in window pixels; with the primary button down this drags the picture.
    PointerMoved {
        /// Window pixels.
        at: DVec2,
    },
    /// The pointer left the window, or is over a panel.
    PointerLeft,
    /// A button went down where the pointer is.
    PointerPressed(PointerButton),
    /// A button went up.
    PointerReleased(PointerButton),
    /// The wheel turned by `clicks` (up, away from the user, is above zero): zooms about the pointer, or changes
    /// the magnification where the pointer is over the inspector's inset.
    Wheel {
        /// Notches; fractions come from touch pads.
        clicks: f64,
    },
    /// Two fingers spread by `factor` (above 1) or closed: zooms about the pointer.
    Pinch {
        /// Ratio of the fingers' distances.
        factor: f64,
    },

    // View.
    /// Moves the picture by window pixels: what was at `p` is then at `p + by`.
    PanBy {
        /// Window pixels.
        by: DVec2,
    },
    /// Scales the picture by `factor`; what is at `at` stays there.
    ZoomAt {
        /// Window pixels; `None` is the middle of the window.
        at: Option<DVec2>,
        /// Above zero; above 1 enlarges.
        factor: f64,
    },
    /// Turns the picture clockwise about the middle of the window.
    RotateBy {
        /// Degrees.
        degrees: f64,
    },
    /// Back to the default view.
    ResetView,
    /// The largest view that shows the whole canvas; the rotation stays.
    FitView,
    /// One user unit is one pixel; the middle of the window stays.
    ActualSize,
    /// The view with exactly these numbers.
    SetView(ViewNumbers),
    /// Shows each frame pixel as a square of window pixels.
    SetPixelZoom(PixelZoom),
    /// The next pixel zoom, round and round.
    NextPixelZoom,

    // Sampling.
    /// Changes a setting of the picture; of its dialect, and the scene is read again.
    Set(SettingChange),
    /// The other dialect for the current scene and its folder.
    OtherReading,
    /// Whether coarse pictures may stand in for slow ones while the view moves.
    Progressive(Toggle),

    // A against B.
    /// A and B change places; without B it becomes a copy of A.
    SwapAb,
    /// Compares A with this.
    Compare(Against),
    /// A and B share the window so; without B it becomes a copy of A.
    Arrange(Arrangement),
    /// The same, or A alone where they share it so already.
    ToggleArrangement(Arrangement),
    /// Shows the other of A and B, until this is asked again: a flip by hand.
    FlipByHand,
    /// The line of the wipe: the part of the frame's width that is A's, kept within 0 and 1.
    SetWipe(f64),
    /// Shows this difference.
    SetMeasure(Measure),
    /// Shows differences times this, kept above zero.
    SetGain(f32),
    /// Doubles (above zero) or halves the gain so many times.
    StepGain(i32),
    /// Pins the pixel that differs most; from there the next.
    NextDifference,
    /// Whether the largest difference takes the last colour.
    Normalize(Toggle),

    // Scenes.
    /// The scene after the current one, round and round; in a lesson its next step.
    NextScene,
    /// The scene before the current one, round and round; in a lesson the step before.
    PreviousScene,
    /// The scene with this index, counted from 0. Nothing happens where there is none.
    Scene(usize),
    /// Replaces the scenes by those in these files and folders. Where they hold none, nothing changes.
    Open(Vec<PathBuf>),
    /// Replaces the scenes by the built-in gallery.
    OpenGallery,
    /// Reads the current scene again from where it came from.
    Reload,
    /// Opens a lesson at its first step: its scenes take the place of the list until it is closed.
    OpenLesson(LessonSource),
    /// The step of the open lesson with this index, counted from 0, as its author meant it.
    LessonStep(usize),
    /// Closes the lesson and brings back what was open before.
    CloseLesson,

    // Inspector.
    /// Opens or closes the pixel inspector.
    Inspector(Toggle),
    /// This many pixels along each side of the inspector's region, kept within 8 to 64.
    SetInspectorRegion(u32),
    /// This many window pixels along each side of a magnified pixel, kept within the inspector's limits.
    SetMagnification(u32),
    /// A higher (above zero) or lower magnification by so many steps; the inset's size stays about the same.
    StepMagnification(i32),
    /// Pins the pixel under the pointer and opens the inspector; unpins if that pixel is pinned already.
    PinUnderPointer,
    /// Pins this frame pixel, moved into the frame, and opens the inspector.
    Pin([i64; 2]),
    /// Moves the pin by so many frame pixels within the frame; pins first what the open inspector shows.
    Nudge([i64; 2]),
    /// The inspector follows the pointer again.
    Unpin,
    /// Shows or hides why the pinned pixel has its colour.
    Explanation(Toggle),
    /// The pointer is over this texel of the explanation, or over none: the pixels that it feeds are lit.
    PointAtTexel(Option<TexelPlace>),
    /// Copies place and colour of the inspected pixel.
    CopyPixel,
    /// Copies the inspected pixel's place and colour, or the picture while no pixel is inspected.
    Copy,
    /// Copies the picture.
    CopyPicture,
    /// Copies why the inspected pixel has its colour, as Markdown.
    CopyExplanation,

    // Out.
    /// Copies the command line that makes this picture.
    CopyCommandLine,
    /// Saves the frame, with the inspector's inset where it is open.
    Screenshot,
    /// Saves the whole window with overlay and panels.
    WindowScreenshot,
    /// Changes the sheet that is being put together.
    ChangeSheet(SheetChange),
    /// Device pixels that there are for the sheet's preview.
    SetSheetRoom([u32; 2]),
    /// Saves the sheet, its panels and the snippets for documents.
    SaveSheet,
    /// Copies the command line that makes the sheet.
    CopySheetCommandLine,

    // Window.
    /// The window's size in device pixels; zero when it is minimised.
    Resize([u32; 2]),
    /// The part of the window that no panel covers; the inset is placed inside. `None` is the whole window.
    SetFreeArea(Option<PixelRect>),
    /// Shows or hides the text over the picture.
    OverlayText(Toggle),
    /// Hides or shows everything but the picture.
    HideEverything(Toggle),
    /// Shows or hides the side panel.
    Panel(Toggle),
    /// Opens this dialog, or closes it if it is the one that is open.
    ToggleDialog(Dialog),
    /// Closes the dialog that is open.
    CloseDialog,
    /// This theme.
    SetTheme(Theme),
    /// The other theme.
    NextTheme,
    /// Removes a message from the screen.
    DismissMessage(u64),
    /// Closes or unpins what is open, the latest first; quits when nothing is.
    Escape,
    /// Ends the program.
    Quit,
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
    /// End the program.
    Quit,
}
