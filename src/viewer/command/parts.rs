//! Commands by the part of the viewer that they are about.

use std::path::PathBuf;

use glam::DVec2;

use crate::color::ResolveSpace;
use crate::compare::{Measure, ProfileChannel, SpectrumOf};
use crate::figure::{PixelRect, TableFormat};
use crate::inspect::TexelPlace;
use crate::viewer::ab::other::{Against, Arrangement};
use crate::viewer::board::numbers::BoardSort;
use crate::viewer::chrome::Dialog;
use crate::viewer::chrome::interface_scale::InterfaceScale;
use crate::viewer::export::sheet::axes::Axis;
use crate::viewer::export::sheet::draft::SheetChange;
use crate::viewer::lesson::source::LessonSource;
use crate::viewer::settings::picture::SettingChange;
use crate::viewer::settings::{PixelZoom, Theme, Toggle};
use crate::viewer::spectrum::SpectrumPart;
use crate::viewer::view::camera::ViewNumbers;
use crate::viewer::view::pointer::PointerButton;

/// What the mouse does.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum PointerCommand {
    /// The pointer is at `at`, in window pixels; with the primary button down this drags the picture.
    Moved {
        /// Window pixels.
        at: DVec2,
    },
    /// The pointer left the window, or is over a panel.
    Left,
    /// A button went down where the pointer is.
    Pressed(PointerButton),
    /// A button went up.
    Released(PointerButton),
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
}

/// Moving, scaling and turning the picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ViewCommand {
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
    Reset,
    /// The largest view that shows the whole canvas; the rotation stays.
    Fit,
    /// One canvas unit is one pixel; the middle of the window stays.
    ActualSize,
    /// The view with exactly these numbers.
    Set(ViewNumbers),
    /// Shows each frame pixel as a square of window pixels.
    SetPixelZoom(PixelZoom),
    /// The next pixel zoom, round and round.
    NextPixelZoom,
    /// Whether coarse pictures may stand in for slow ones while the view moves.
    Progressive(Toggle),
}

/// Comparing A with B.
#[derive(Clone, Debug, PartialEq)]
pub enum AbCommand {
    /// A and B change places; without B it becomes a copy of A.
    Swap,
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
    /// Doubles the gain this many times, or halves it where the number is below zero.
    StepGain(i32),
    /// Pins the pixel that differs most; from there the next.
    NextDifference,
    /// Whether the largest difference takes the last colour.
    Normalize(Toggle),
    /// The truth is averaged in these values, or without any in A's.
    SetTruthSpace(Option<ResolveSpace>),
}

/// Which scene is shown.
#[derive(Clone, Debug, PartialEq)]
pub enum SceneCommand {
    /// The other dialect for the current scene and its folder.
    OtherReading,
    /// The scene after the current one, round and round; in a lesson its next step.
    Next,
    /// The scene before the current one, round and round; in a lesson the step before.
    Previous,
    /// The scene with this index, counted from 0; where there is none, the user is told.
    Show(usize),
    /// Replaces the scenes by those in these files and folders. Where they hold none, nothing changes.
    Open(Vec<PathBuf>),
    /// Replaces the scenes by the built-in gallery.
    OpenGallery,
    /// Reads the current scene again from where it came from.
    Reload,
    /// Reads the current scene no further, if that takes long.
    GiveUpReading,
    /// These were opened in earlier sessions, the latest first.
    RememberOpened(Vec<PathBuf>),
    /// These files changed on the disk: what is shown of them is read again.
    FilesChanged(Vec<PathBuf>),
    /// Whether files are read again when they change on the disk.
    FollowFiles(Toggle),
}

/// Walking through a lesson.
#[derive(Clone, Debug, PartialEq)]
pub enum LessonCommand {
    /// Opens a lesson at its first step: its scenes take the place of the list until it is closed.
    Open(LessonSource),
    /// The step of the open lesson with this index, counted from 0, as its author meant it.
    Step(usize),
    /// Closes the lesson and brings back what was open before. A file that was opened meanwhile stays.
    Close,
}

/// The inspector, its pin and the explanation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum InspectorCommand {
    /// Opens or closes the pixel inspector.
    Show(Toggle),
    /// This many pixels along each side of the inspector's region, kept within 8 to 64.
    SetRegion(u32),
    /// This many window pixels along each side of a magnified pixel, kept within the inspector's limits.
    SetMagnification(u32),
    /// Raises the magnification by this many steps, or lowers it where the number is below zero; the inset's size stays
    /// about the same.
    StepMagnification(i32),
    /// Pins the pixel under the pointer and opens the inspector; unpins if that pixel is pinned already.
    PinUnderPointer,
    /// Pins this frame pixel, moved into the frame, and opens the inspector.
    Pin([i64; 2]),
    /// Pins the pixel nearest to the middle of the free picture where two colours meet.
    PinEdge,
    /// Moves the pin by frame pixels, within the frame; pins what the open inspector shows first.
    Nudge([i64; 2]),
    /// The inspector follows the pointer again.
    Unpin,
    /// Shows or hides why the pinned pixel has its colour.
    Explanation(Toggle),
    /// The pointer is over this texel of the explanation, or over none: the pixels that it contributes to are lit.
    PointAtTexel(Option<TexelPlace>),
}

/// The profile of an edge.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ProfileCommand {
    /// Whether a drag over the picture draws a line, whose values are plotted.
    Show(Toggle),
    /// Plots the values along the line between the middles of these frame pixels.
    SetLine([[i64; 2]; 2]),
    /// Plots this of the colours.
    SetChannel(ProfileChannel),
}

/// Several settings of one region, beside the truth.
#[derive(Clone, Debug, PartialEq)]
pub enum BoardCommand {
    /// Opens or closes the board.
    Show(Toggle),
    /// Adds A's settings.
    AddA,
    /// Adds A's settings with these changes.
    Add(Vec<SettingChange>),
    /// An entry for each value of a setting takes the place of all others.
    Vary(Axis),
    /// Removes the entry with this place in the order that is shown, counted from 0.
    Remove(usize),
    /// Removes all entries.
    Clear,
    /// Sorts entries by this.
    Sort(BoardSort),
    /// A takes the settings of the entry with this place, counted from 0.
    MakeA(usize),
    /// This many pixels along each side of the region, kept within 16 to 256.
    SetSide(u32),
    /// Copies the table.
    Copy(TableFormat),
    /// Saves the board as a picture.
    Save,
}

/// The spectrum of the picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum SpectrumCommand {
    /// Whether it is to be seen.
    Show(Toggle),
    /// Shows that of this.
    Of(SpectrumOf),
    /// Shows that of this part of the picture.
    Part(SpectrumPart),
}

/// What leaves the program.
#[derive(Clone, Debug, PartialEq)]
pub enum ExportCommand {
    /// Copies place and colour of the inspected pixel.
    CopyPixel,
    /// Copies the inspected pixel's place and colour, or the picture while no pixel is inspected.
    Copy,
    /// Copies the picture.
    CopyPicture,
    /// Copies why the inspected pixel has its colour, as Markdown.
    CopyExplanation,
    /// Copies the command line that makes this picture.
    CopyCommandLine,
    /// Saves the frame, with the inspector's inset where it is open.
    Screenshot,
    /// Saves the same in this PNG file, which must not exist yet.
    SaveAs(PathBuf),
    /// Opens the folder where a picture was saved last, or would be.
    OpenFolder,
    /// Saves the whole window with overlay and panels.
    WindowScreenshot,
}

/// The sheet that is being put together.
#[derive(Clone, Debug, PartialEq)]
pub enum SheetCommand {
    /// Changes the sheet that is being put together.
    Change(SheetChange),
    /// Device pixels that there are for the sheet's preview.
    SetRoom([u32; 2]),
    /// Saves the sheet, its panels and the snippets for documents.
    Save,
    /// Copies the command line that makes the sheet.
    CopyCommandLine,
}

/// What the window shows besides the picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum WindowCommand {
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
    /// Shows or hides what the scene says about itself.
    About(Toggle),
    /// Shows or hides the ways on for newcomers.
    StartCard(Toggle),
    /// Panels and letters of this size.
    SetInterfaceScale(InterfaceScale),
    /// The next larger size of panels and letters, or with `up` false the next smaller one.
    StepInterfaceScale {
        /// Larger, not smaller.
        up: bool,
    },
    /// Larger type, a thick ring around the pin and more contrast, for a projector, or none of that.
    Presenter(Toggle),
    /// The next panel has the keyboard; behind the last the picture.
    FocusPanel {
        /// The panel before.
        back: bool,
    },
    /// Removes a message from the screen.
    DismissMessage(u64),
    /// Brings back what a single press took away last: settings before the defaults, the tiles of a board that was cleared.
    BringBack,
    /// Closes or unpins what is open, the latest first; quits when nothing is.
    Escape,
    /// Ends the program.
    Quit,
}
