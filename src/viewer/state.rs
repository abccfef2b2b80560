//! The viewer itself: what it keeps, how it starts, what can be asked of it.

use std::io;
use std::path::PathBuf;
use std::sync::Arc;
use std::sync::mpsc::{Receiver, Sender, channel};

use crate::geometry::View;
use crate::inspect::Contributions;
use crate::plain;
use crate::viewer::ab::comparison::Comparison;
use crate::viewer::ab::measuring::{Measured, Measuring};
use crate::viewer::ab::other::Against;
use crate::viewer::ab::outside::ReadPicture;
use crate::viewer::chrome::interface_scale::InterfaceScale;
use crate::viewer::chrome::messages::Message;
use crate::viewer::chrome::{Chrome, Dialog};
use crate::viewer::export::naming::NameTemplate;
use crate::viewer::export::restored::{Grammar, Restored};
use crate::viewer::export::saver::{Saved, Saver};
use crate::viewer::export::sheet::desk::SheetDesk;
use crate::viewer::export::sheet::preview;
use crate::viewer::export::sheet::preview::{SheetPreview, SheetQuestion};
use crate::viewer::export::state::Export;
use crate::viewer::frames::drawing::{Drawing, DrawingId};
use crate::viewer::frames::frame::Frame;
use crate::viewer::frames::job::Drawn;
use crate::viewer::frames::legends::PlacedLegends;
use crate::viewer::frames::state::Frames;
use crate::viewer::inspector::explanation::{Asked, Explained};
use crate::viewer::inspector::samples::{ProbedSample, Target};
use crate::viewer::inspector::state::Inspection;
use crate::viewer::inspector::{Inspector, PlacedInset, contributions, explanation, samples};
use crate::viewer::jobs::mailbox::{Mailbox, Waker};
use crate::viewer::lesson::walk::Walk;
use crate::viewer::library::SceneEntry;
use crate::viewer::library::readers::{ReadScene, Readers, Thumbnail};
use crate::viewer::library::state::SceneList;
use crate::viewer::settings::{PixelZoom, Settings, Theme};
use crate::viewer::view::camera::{ViewContext, ViewNumbers};
use crate::viewer::view::panes::Panes;
use crate::viewer::view::pointer::Pointer;

/// Longest title of the window, in characters.
const MAX_TITLE: usize = 300;

/// How a viewer starts.
#[derive(Clone)]
pub struct ViewerOptions {
    /// Files and folders to open; none means the built-in gallery.
    pub paths: Vec<PathBuf>,
    /// Sampling, rules, dialect, pixel zoom.
    pub settings: Settings,
    /// The view of every scene.
    pub view: View,
    /// What the picture is compared with at the start.
    pub against: Option<Against>,
    /// The window in device pixels.
    pub window: [u32; 2],
    /// Where screenshots go; `None` is the current folder.
    pub screenshot_dir: Option<PathBuf>,
    /// How they are called.
    pub screenshot_name: NameTemplate,
    /// Light or dark panels.
    pub theme: Theme,
    /// Wakes the event loop; may do nothing.
    pub waker: Waker,
    /// Reads command lines; without it no picture brings a state back, and there are no sheets.
    pub grammar: Option<Grammar>,
    /// The picture that scene and settings come from.
    pub restored: Option<Restored>,
}

/// The program without a window.
#[derive(Debug)]
pub struct Viewer {
    pub(in crate::viewer) settings: Settings,
    pub(in crate::viewer) chrome: Chrome,
    pub(in crate::viewer) pointer: Pointer,
    pub(in crate::viewer) scene_list: SceneList,
    pub(in crate::viewer) frames: Frames,
    pub(in crate::viewer) ab: Comparison,
    pub(in crate::viewer) inspector: Inspection,
    pub(in crate::viewer) export: Export,
    /// The sheet that is being put together.
    pub(in crate::viewer) sheet: SheetDesk,
    /// The lesson that is open.
    pub(in crate::viewer) lesson: Option<Walk>,
    pub(in crate::viewer) results: Receiver<Finished>,
    pub(in crate::viewer) revision: u64,
    pub(in crate::viewer) picture_revision: u64,
    /// What `picture_revision` stands for.
    pub(in crate::viewer) last_drawn: Option<DrawnState>,
    /// What [`Viewer::take_damage`] told last.
    pub(in crate::viewer) last_shown: Option<DrawnState>,
}

/// What decides the pixels of [`Viewer::draw_window`]; a frame and probed samples by their numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::viewer) struct DrawnState {
    pub(in crate::viewer) frame: u64,
    pub(in crate::viewer) comparison: [u64; 2],
    pub(in crate::viewer) panes: Panes,
    pub(in crate::viewer) samples: u64,
    pub(in crate::viewer) inset: Option<PlacedInset>,
    pub(in crate::viewer) other_inset: Option<PlacedInset>,
    pub(in crate::viewer) legends: PlacedLegends,
    pub(in crate::viewer) pixel_zoom: PixelZoom,
    pub(in crate::viewer) window: [u32; 2],
}

/// What a thread finished.
#[derive(Debug)]
pub(in crate::viewer) enum Finished {
    Read(ReadScene),
    Drawn(DrawingId, Drawn),
    Measured(Measured),
    PictureRead(ReadPicture),
    Probed(Target, Vec<ProbedSample>),
    Explained(Asked, Box<Option<Explained>>),
    Contributed(Target, Box<Option<Contributions>>),
    Thumbnail(Thumbnail),
    Saved(Saved),
    SheetDrawn(SheetQuestion, Box<Result<SheetPreview, String>>),
}

impl std::fmt::Debug for ViewerOptions {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("ViewerOptions")
            .field("paths", &self.paths)
            .field("settings", &self.settings)
            .field("view", &self.view)
            .field("against", &self.against)
            .field("window", &self.window)
            .finish_non_exhaustive()
    }
}

impl Default for ViewerOptions {
    fn default() -> Self {
        Self {
            paths: Vec::new(),
            settings: Settings::default(),
            view: View::Default,
            against: None,
            window: [1280, 800],
            screenshot_dir: None,
            screenshot_name: NameTemplate::default(),
            theme: Theme::default(),
            waker: Arc::new(|| {}),
            grammar: None,
            restored: None,
        }
    }
}

impl Viewer {
    /// Opens the scenes and starts to read the first.
    ///
    /// # Errors
    /// When the system gives no threads.
    pub fn new(options: ViewerOptions) -> io::Result<Self> {
        let (sender, results): (Sender<Finished>, _) = channel();
        let mailbox = Mailbox::new(sender, Arc::clone(&options.waker));
        let drawing = Drawing::start(
            mailbox.of(|drawn| Finished::Drawn(DrawingId::First, drawn)),
            DrawingId::First,
        )?;
        let readers = Readers::start(mailbox.of(Finished::Read), mailbox.of(Finished::Thumbnail))?;
        let saver = Saver::start(
            mailbox.of(Finished::Saved),
            options.screenshot_dir,
            options.screenshot_name,
        )?;
        let mut viewer = Self {
            settings: options.settings,
            chrome: Chrome::new(options.window, options.theme),
            pointer: Pointer::default(),
            scene_list: SceneList::new(options.view, readers),
            frames: Frames::new(drawing),
            ab: Comparison::new(
                mailbox.of(|drawn| Finished::Drawn(DrawingId::Second, drawn)),
                Measuring::new(mailbox.of(Finished::Measured), mailbox.of(Finished::PictureRead)),
            ),
            inspector: Inspection::new(
                samples::start(mailbox.of(|(target, samples)| Finished::Probed(target, samples)))?,
                explanation::start(mailbox.of(|(asked, found)| Finished::Explained(asked, Box::new(found))))?,
                contributions::start(mailbox.of(|(target, found)| Finished::Contributed(target, Box::new(found))))?,
            ),
            export: Export {
                saver,
                grammar: options.grammar,
                restored: options.restored,
            },
            sheet: SheetDesk::new(preview::start(
                mailbox.of(|(question, drawn)| Finished::SheetDrawn(question, Box::new(drawn))),
            )?),
            lesson: None,
            results,
            revision: 0,
            picture_revision: 0,
            last_drawn: None,
            last_shown: None,
        };
        viewer.frames.drawing.set_progressive(viewer.settings.progressive);
        viewer.open(&options.paths);
        if let Some(against) = options.against {
            viewer.compare_from_the_start(against);
        }
        viewer.update();
        Ok(viewer)
    }

    /// Grows whenever something that is to be seen changed.
    pub fn revision(&self) -> u64 {
        self.revision
    }

    /// Grows whenever [`Viewer::draw_window`] draws other pixels than before: not, for instance, when only the pointer
    /// moved.
    pub fn picture_revision(&self) -> u64 {
        self.picture_revision
    }

    /// All scenes, in the order of the list.
    pub fn scenes(&self) -> &[SceneEntry] {
        &self.scene_list.scenes
    }

    /// The place of the current scene in the list.
    pub fn current_index(&self) -> usize {
        self.scene_list.current
    }

    /// The current scene; `None` only while the list is empty.
    pub fn current(&self) -> Option<&SceneEntry> {
        self.scene_list.current()
    }

    /// Sampling, rules, dialect, pixel zoom.
    pub fn settings(&self) -> &Settings {
        &self.settings
    }

    /// The frame on the screen. It may show an older state, or be a preview; see [`Viewer::is_settled`].
    pub fn frame(&self) -> Option<&Frame> {
        self.frames.drawing.frame()
    }

    /// The numbers of the current view; `None` before the scene was read.
    pub fn view_numbers(&self) -> Option<ViewNumbers> {
        let entry = self.current()?;
        Some(entry.camera.numbers(&self.view_context()?))
    }

    /// The window in device pixels.
    pub fn window_size(&self) -> [u32; 2] {
        self.chrome.window
    }

    /// The size of A's frame, and of B's: that of the window divided by the pixel zoom, unless both lie side by side.
    pub fn frame_size(&self) -> [u32; 2] {
        self.panes().frame
    }

    /// The dialog that is open.
    pub fn dialog(&self) -> Option<Dialog> {
        self.chrome.dialog
    }

    /// Whether text lies over the picture.
    pub fn overlay_text(&self) -> bool {
        self.chrome.shown.text
    }

    /// Whether the side panel is to be seen, unless everything is hidden.
    pub fn panel(&self) -> bool {
        self.chrome.shown.panel
    }

    /// Light or dark panels.
    pub fn theme(&self) -> Theme {
        self.chrome.theme
    }

    /// How large panels and their letters are.
    pub fn interface_scale(&self) -> InterfaceScale {
        self.chrome.interface_scale
    }

    /// What the scene says about itself, where that is to be seen.
    pub fn words(&self) -> Option<&str> {
        let scene = self.current()?.scene()?;
        scene.words.as_deref().filter(|_| self.chrome.shown.words)
    }

    /// Whether the ways on for newcomers lie over the picture.
    pub fn start_card(&self) -> bool {
        self.chrome.start_card
    }

    /// What the user is to be told, oldest first. Whoever shows a message dismisses it after a while.
    pub fn messages(&self) -> &[Message] {
        self.chrome.messages.all()
    }

    /// The pixel inspector.
    pub fn inspector(&self) -> &Inspector {
        &self.inspector.magnifier
    }

    /// The inspector's inset in the window, where it is open and has room.
    pub fn inset(&self) -> Option<PlacedInset> {
        self.inspector.inset
    }

    /// The inset of the same pixel of B, where A and B share the window.
    pub fn other_inset(&self) -> Option<PlacedInset> {
        self.inspector.other_inset
    }

    /// The window's title: scene, settings or what of them differs between A and B, program.
    pub fn title(&self) -> String {
        let name = self.current().map_or("no scene", |entry| entry.label.as_str());
        let words = self.comparison_title();
        let words = words.unwrap_or_else(|| self.own_words().join(", "));
        plain::short_line(&format!("{name} - {words} - Rasterscope"), MAX_TITLE)
    }

    /// What the current camera looks at; `None` before the scene was read.
    pub(in crate::viewer) fn view_context(&self) -> Option<ViewContext> {
        let scene = self.current()?.scene()?;
        Some(ViewContext {
            canvas: scene.canvas,
            frame: self.frame_size(),
        })
    }
}
