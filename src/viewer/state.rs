//! The viewer itself: what it keeps, how it starts, what can be asked of it.

use std::io;
use std::path::PathBuf;
use std::sync::Arc;
use std::sync::mpsc::{Receiver, Sender, channel};

use crate::compare::Profile;
use crate::geometry::View;
use crate::inspect::Contributions;
use crate::render::RenderSettings;
use crate::viewer::ab::comparison::Comparison;
use crate::viewer::ab::measuring::{Measured, Measuring};
use crate::viewer::ab::other::Against;
use crate::viewer::ab::outside::ReadPicture;
use crate::viewer::ab::requests::ComparisonContext;
use crate::viewer::board::Board;
use crate::viewer::board::entry::BoardEntry;
use crate::viewer::board::measuring::{BoardMeasuring, BoardNews};
use crate::viewer::chrome::Chrome;
use crate::viewer::chrome::messages::MessageKind;
use crate::viewer::export::naming::NameTemplate;
use crate::viewer::export::restored::{Grammar, Restored};
use crate::viewer::export::saver::{Saved, Saver};
use crate::viewer::export::sheet::desk::SheetDesk;
use crate::viewer::export::sheet::preview;
use crate::viewer::export::sheet::preview::{SheetPreview, SheetQuestion};
use crate::viewer::export::state::Export;
use crate::viewer::frames::drawing::{Drawing, DrawingId};
use crate::viewer::frames::job::Drawn;
use crate::viewer::frames::legends::PlacedLegends;
use crate::viewer::frames::state::Frames;
use crate::viewer::inspector::explanation::{Asked, Explained};
use crate::viewer::inspector::samples::{ProbedSample, Target};
use crate::viewer::inspector::state::Inspection;
use crate::viewer::inspector::{PlacedInset, contributions, explanation, samples};
use crate::viewer::jobs::mailbox::{Mailbox, Waker};
use crate::viewer::lesson::model::Lesson;
use crate::viewer::lesson::walk::Walk;
use crate::viewer::library::readers::{ReadScene, Readers, Thumbnail};
use crate::viewer::library::state::SceneList;
use crate::viewer::profile::Profiling;
use crate::viewer::profile::truth;
use crate::viewer::profile::truth::LineOfPicture;
use crate::viewer::settings::{PixelZoom, Settings, Theme};
use crate::viewer::spectrum::SpectrumState;
use crate::viewer::spectrum::question;
use crate::viewer::spectrum::question::{SpectrumFound, SpectrumQuestion};
use crate::viewer::view::panes::Panes;
use crate::viewer::view::pointer::Pointer;

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
    /// Whether files can be dropped on the window.
    pub takes_drops: bool,
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
    pub(in crate::viewer) profiling: Profiling,
    pub(in crate::viewer) board: Board,
    pub(in crate::viewer) spectrum: SpectrumState,
    pub(in crate::viewer) export: Export,
    /// The sheet that is being put together.
    pub(in crate::viewer) sheet: SheetDesk,
    /// The lesson that is open.
    pub(in crate::viewer) lesson: Option<Walk>,
    /// What a press took away last, until it is brought back.
    pub(in crate::viewer) taken_away: Option<TakenAway>,
    pub(in crate::viewer) results: Receiver<Finished>,
    pub(in crate::viewer) revision: u64,
    pub(in crate::viewer) picture_revision: u64,
    /// What `picture_revision` stands for.
    pub(in crate::viewer) last_drawn: Option<DrawnState>,
    /// What [`Viewer::take_damage`] told last.
    pub(in crate::viewer) last_shown: Option<DrawnState>,
}

/// What a press took away last.
#[derive(Clone, Debug)]
pub(in crate::viewer) enum TakenAway {
    /// The settings before the defaults.
    Settings(RenderSettings),
    /// The tiles of the board, as they were added.
    Board(Vec<BoardEntry>),
}

/// What decides the window's pixels below the panels; a frame and probed samples by their numbers.
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
    Profiled(LineOfPicture, Option<Profile>),
    Board(BoardNews),
    Transformed(SpectrumQuestion, Option<Arc<SpectrumFound>>),
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
            takes_drops: true,
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
            chrome: Chrome {
                takes_drops: options.takes_drops,
                ..Chrome::new(options.window, options.theme)
            },
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
            profiling: Profiling::new(truth::start(
                mailbox.of(|(asked, found)| Finished::Profiled(asked, found)),
            )?),
            board: Board::new(BoardMeasuring::start(mailbox.of(Finished::Board))?),
            spectrum: SpectrumState::new(question::start(
                mailbox.of(|(asked, found)| Finished::Transformed(asked, found)),
            )?),
            export: Export {
                saver,
                grammar: options.grammar,
                restored: options.restored,
            },
            sheet: SheetDesk::new(preview::start(
                mailbox.of(|(question, drawn)| Finished::SheetDrawn(question, Box::new(drawn))),
            )?),
            lesson: None,
            taken_away: None,
            results,
            revision: 0,
            picture_revision: 0,
            last_drawn: None,
            last_shown: None,
        };
        viewer.frames.drawing.set_progressive(viewer.settings.progressive);
        viewer.opening().open(&options.paths);
        if let Some(against) = options.against {
            let mut context = ComparisonContext {
                settings: &viewer.settings,
                messages: &mut viewer.chrome.messages,
            };
            viewer.ab.compare_from_the_start(against, &mut context);
        }
        viewer.update();
        Ok(viewer)
    }

    /// Grows whenever something that is to be seen changed.
    pub fn revision(&self) -> u64 {
        self.revision
    }

    /// Grows whenever the window below the panels shows other pixels than before: not, for instance, when only the pointer
    /// moved.
    pub fn picture_revision(&self) -> u64 {
        self.picture_revision
    }

    /// Sampling, rules, dialect, pixel zoom.
    pub fn settings(&self) -> &Settings {
        &self.settings
    }

    /// What is to be seen in the window besides the picture.
    pub fn chrome(&self) -> &Chrome {
        &self.chrome
    }

    /// The list of scenes.
    pub fn scene_list(&self) -> &SceneList {
        &self.scene_list
    }

    /// A's frame.
    pub fn frames(&self) -> &Frames {
        &self.frames
    }

    /// What A is compared with.
    pub fn ab(&self) -> &Comparison {
        &self.ab
    }

    /// The pixel inspector, and what was found out about its pixel.
    pub fn inspector(&self) -> &Inspection {
        &self.inspector
    }

    /// The sheet that is being put together.
    pub fn sheet(&self) -> &SheetDesk {
        &self.sheet
    }

    /// The lesson that is open, and the number of its step, from 0.
    pub fn lesson(&self) -> Option<(&Lesson, usize)> {
        self.lesson.as_ref().map(|walk| (&walk.lesson, walk.at))
    }

    /// Whether the scene is shown that the open lesson's step speaks of, and not another one of the list; false without a lesson.
    pub fn shows_scene_of_step(&self) -> bool {
        let shows = |walk: &Walk| walk.shows_step(&self.scene_list);
        self.lesson.as_ref().is_some_and(shows)
    }

    /// Asks for the thumbnail of a scene in the list: it is read and drawn when nothing else is to be done. To be called for
    /// the scenes that a panel shows.
    pub fn request_thumbnail(&mut self, index: usize) {
        self.scene_list.request_thumbnail(index, self.settings.dialect);
    }

    /// Tells the user something about the program around the viewer, in one line.
    pub fn tell(&mut self, kind: MessageKind, text: String) {
        self.chrome.messages.add(kind, text);
        self.revision += 1;
    }

    /// Takes back what was told and is no longer so: messages that begin like this.
    pub fn retract(&mut self, beginning: &str) {
        self.chrome.messages.retract(beginning);
        self.revision += 1;
    }
}
