//! What of the window is to be seen besides the picture: panels, dialogs, messages.

pub(in crate::viewer) mod ending;
pub(in crate::viewer) mod interface_scale;
pub(in crate::viewer) mod messages;

use crate::figure::PixelRect;
use crate::viewer::chrome::ending::Ending;
use crate::viewer::chrome::interface_scale::InterfaceScale;
use crate::viewer::chrome::messages::Messages;
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
    /// Puts a sheet together.
    Sheet,
}

/// What is to be seen in the window besides the picture.
#[derive(Debug)]
pub(in crate::viewer) struct Chrome {
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
            interface_scale: InterfaceScale::default(),
            messages: Messages::default(),
            ending: Ending::default(),
        }
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
