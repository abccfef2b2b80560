//! What of the window is to be seen besides the picture: panels, dialogs, messages.

pub(in crate::viewer) mod ending;
pub(in crate::viewer) mod interface_scale;
pub(in crate::viewer) mod messages;

use crate::figure::PixelRect;
use crate::viewer::chrome::ending::Ending;
use crate::viewer::chrome::interface_scale::InterfaceScale;
use crate::viewer::chrome::messages::{Message, Messages};
use crate::viewer::settings::Theme;

/// Something that covers the picture and takes the keyboard until it is closed. One at a time.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Dialog {
    /// All keys and commands.
    Help,
    /// The command palette.
    Palette,
    /// Chooses a file or a folder to open.
    Open,
    /// Asks for a pixel.
    GoToPixel,
    /// Asks for a picture's path.
    ComparePicture,
    /// All scenes as large pictures.
    Scenes,
    /// Asks where the picture is to be saved.
    SaveAs,
    /// Puts a sheet together.
    Sheet,
    /// The sample pattern by itself.
    Pattern,
}

/// What is to be seen in the window besides the picture.
#[expect(clippy::struct_excessive_bools, reason = "each is so or not on its own")]
#[derive(Debug)]
pub struct Chrome {
    pub(in crate::viewer) window: [u32; 2],
    pub(in crate::viewer) free_area: Option<PixelRect>,
    pub(in crate::viewer) theme: Theme,
    pub(in crate::viewer) dialog: Option<Dialog>,
    /// Only the picture is to be seen; what is shown besides comes back as it was.
    pub(in crate::viewer) hidden: bool,
    pub(in crate::viewer) shown: Shown,
    /// Whether the ways on for newcomers lie over the picture.
    pub(in crate::viewer) start_card: bool,
    pub(in crate::viewer) interface_scale: InterfaceScale,
    pub(in crate::viewer) takes_drops: bool,
    /// Whether the window is to be read from afar.
    pub(in crate::viewer) presenter: bool,
    pub(in crate::viewer) messages: Messages,
    pub(in crate::viewer) ending: Ending,
}

impl Chrome {
    pub(in crate::viewer) fn new(window: [u32; 2], theme: Theme) -> Self {
        Self {
            window,
            free_area: None,
            theme,
            dialog: None,
            hidden: false,
            shown: Shown {
                text: true,
                panel: true,
                explanation: true,
                words: false,
            },
            start_card: false,
            takes_drops: true,
            interface_scale: InterfaceScale::default(),
            presenter: false,
            messages: Messages::default(),
            ending: Ending::default(),
        }
    }
    /// The window in device pixels.
    pub fn window_size(&self) -> [u32; 2] {
        self.window
    }

    /// The dialog that is open.
    pub fn dialog(&self) -> Option<Dialog> {
        self.dialog
    }

    /// Whether everything but the picture is hidden.
    pub fn everything_hidden(&self) -> bool {
        self.hidden
    }

    /// Whether text lies over the picture.
    pub fn overlay_text(&self) -> bool {
        self.shown.text
    }

    /// Whether the side panel is to be seen, unless everything is hidden.
    pub fn panel(&self) -> bool {
        self.shown.panel
    }

    /// Whether what the scene says about itself is to be seen.
    pub fn about(&self) -> bool {
        self.shown.words
    }

    /// Light or dark panels.
    pub fn theme(&self) -> Theme {
        self.theme
    }

    /// How large panels and their letters are.
    pub fn interface_scale(&self) -> InterfaceScale {
        self.interface_scale
    }

    /// Whether the window looks as a projector needs it: larger, with more contrast.
    pub fn presenter(&self) -> bool {
        self.presenter
    }

    /// How many times as large as the monitor has them panels and letters are to be.
    pub fn interface_factor(&self) -> f32 {
        /// What the presenter look adds.
        const LARGER: f32 = 1.5;
        self.interface_scale.factor() * if self.presenter { LARGER } else { 1.0 }
    }

    /// Whether the ways on for newcomers lie over the picture.
    pub fn start_card(&self) -> bool {
        self.start_card
    }

    /// Whether files can be dropped on the window.
    pub fn takes_drops(&self) -> bool {
        self.takes_drops
    }

    /// What the user is to be told, oldest first. Whoever shows a message dismisses it after a while.
    pub fn messages(&self) -> &[Message] {
        self.messages.all()
    }

    /// What went wrong so far and was not mended since, oldest first, whether it is still among the messages or not.
    pub fn errors(&self) -> &[String] {
        self.messages.errors()
    }

    /// Closes one thing that covers the picture, the latest first; false when nothing does.
    pub(in crate::viewer) fn close_latest(&mut self) -> bool {
        self.dialog.take().is_some() || std::mem::take(&mut self.start_card) || std::mem::take(&mut self.hidden)
    }

    /// Something else than Esc was asked for, or Esc closed something: the question whether to end is answered.
    pub(in crate::viewer) fn forget_ending(&mut self) {
        self.ending.forget();
        self.messages.retract(ending::QUESTION);
    }

    /// The part of the window that no panel covers.
    pub(in crate::viewer) fn free_window(&self) -> PixelRect {
        let window = PixelRect::of_size(self.window);
        self.free_area.map_or(window, |free| free.intersection(&window))
    }
}

/// What of the overlay is shown.
#[expect(
    clippy::struct_excessive_bools,
    reason = "four things that are shown or not, each on its own"
)]
#[derive(Clone, Copy, Debug)]
pub(in crate::viewer) struct Shown {
    pub(in crate::viewer) text: bool,
    pub(in crate::viewer) panel: bool,
    /// Why the pinned pixel has its colour.
    pub(in crate::viewer) explanation: bool,
    /// What the scene says about itself.
    pub(in crate::viewer) words: bool,
}
