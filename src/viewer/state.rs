//! The viewer itself: what it keeps, how it starts, what can be asked of it.

use std::collections::HashMap;
use std::io;
use std::path::PathBuf;
use std::sync::Arc;
use std::sync::mpsc::{Receiver, Sender, channel};

use super::comparison::{Against, Comparison, Measured, Measuring, Panes, ReadPicture, is_picture};
use super::drawing::{Drawing, DrawingId, Drawn};
use super::ending::Ending;
use super::explaining::{self, Asked, Explained, Explaining};
use super::feeding::{self, Feeding};
use super::legends::{Legends, PlacedLegends};
use super::lesson::{LessonSource, Walk};
use super::mailbox::{Mailbox, Waker};
use super::messages::Messages;
use super::pointer::Pointer;
use super::probing::{self, ProbedSample, Probing, Target};
use super::reading::{ReadScene, Readers, Thumbnail};
use super::recorded::{Grammar, Restored};
use super::screenshot::{Saved, Saver};
use super::sheet::{self, SheetDesk, SheetPreview, SheetQuestion};
use super::{
    Camera, Dialog, Frame, Inspector, Message, NameTemplate, PixelRect, PixelZoom, PlacedInset, SceneEntry,
    SceneSource, Settings, Sight, Theme, ViewNumbers, library,
};
use crate::geometry::View;
use crate::inspect::{Feeds, TexelPlace};
use crate::plain;
use crate::scene::Dialect;

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
    pub(super) scenes: Vec<SceneEntry>,
    /// The dialects that were chosen for the scenes of folders.
    pub(super) chosen_readings: HashMap<PathBuf, Dialect>,
    /// Below `scenes.len()`, unless there are none.
    pub(super) current: usize,
    /// Grows when the list is replaced: results for an older list are dropped.
    pub(super) generation: u64,
    /// The lesson that is open.
    pub(super) lesson: Option<Walk>,
    /// Documents that were read so far.
    pub(super) documents: u64,
    /// The scenes shown last, latest last: the others are let go to save memory.
    pub(super) recent: Vec<usize>,
    pub(super) start_view: View,
    pub(super) settings: Settings,
    pub(super) screen: Screen,
    pub(super) pointer: Pointer,
    pub(super) inspector: Inspector,
    pub(super) inset: Option<PlacedInset>,
    /// B's, below A's, where both share the window.
    pub(super) other_inset: Option<PlacedInset>,
    pub(super) legends: Legends,
    pub(super) messages: Messages,
    pub(super) ending: Ending,
    pub(super) drawing: Drawing,
    /// Draws quick frames for whoever shows them on a surface that he lends.
    pub(super) surface_pool: Option<rayon::ThreadPool>,
    pub(super) comparison: Comparison,
    pub(super) probing: Probing,
    pub(super) explaining: Explaining,
    pub(super) feeding: Feeding,
    /// The texel of the explanation that the pointer is over.
    pub(super) pointed_texel: Option<TexelPlace>,
    pub(super) readers: Readers,
    pub(super) saver: Saver,
    pub(super) results: Receiver<Finished>,
    pub(super) revision: u64,
    pub(super) picture_revision: u64,
    /// What `picture_revision` stands for.
    pub(super) last_drawn: Option<DrawnState>,
    /// What [`Viewer::take_damage`] told last.
    pub(super) last_shown: Option<DrawnState>,
    pub(super) grammar: Option<Grammar>,
    /// The sheet that is being put together.
    pub(super) sheet: SheetDesk,
    /// What was restored from a picture, until its scene was read.
    pub(super) restored: Option<Restored>,
}

/// What is to be seen in the window besides the picture.
#[derive(Clone, Copy, Debug)]
pub(super) struct Screen {
    pub(super) window: [u32; 2],
    pub(super) free_area: Option<PixelRect>,
    pub(super) theme: Theme,
    pub(super) dialog: Option<Dialog>,
    /// Only the picture is to be seen; what is shown besides comes back as it was.
    pub(super) hidden: bool,
    pub(super) shown: Shown,
}

/// What of the overlay is shown.
#[expect(
    clippy::struct_excessive_bools,
    reason = "three things that are shown or not, each on its own"
)]
#[derive(Clone, Copy, Debug)]
pub(super) struct Shown {
    pub(super) text: bool,
    pub(super) panel: bool,
    /// Why the pinned pixel has its colour.
    pub(super) explanation: bool,
}

/// What decides the pixels of [`Viewer::draw_window`]; a frame and probed samples by their numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct DrawnState {
    pub(super) frame: u64,
    pub(super) comparison: [u64; 2],
    pub(super) panes: Panes,
    pub(super) samples: u64,
    pub(super) inset: Option<PlacedInset>,
    pub(super) other_inset: Option<PlacedInset>,
    pub(super) legends: PlacedLegends,
    pub(super) pixel_zoom: PixelZoom,
    pub(super) window: [u32; 2],
}

/// What a thread finished.
#[derive(Debug)]
pub(super) enum Finished {
    Read(ReadScene),
    Drawn(DrawingId, Drawn),
    Measured(Measured),
    PictureRead(ReadPicture),
    Probed(Target, Vec<ProbedSample>),
    Explained(Asked, Box<Option<Explained>>),
    Fed(Target, Box<Option<Feeds>>),
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
        let mut viewer = Self {
            scenes: Vec::new(),
            chosen_readings: HashMap::new(),
            current: 0,
            generation: 0,
            documents: 0,
            lesson: None,
            recent: Vec::new(),
            start_view: options.view,
            settings: options.settings,
            screen: Screen {
                window: options.window,
                free_area: None,
                theme: options.theme,
                dialog: None,
                hidden: false,
                shown: Shown {
                    text: true,
                    panel: true,
                    explanation: true,
                },
            },
            pointer: Pointer::default(),
            inspector: Inspector::default(),
            inset: None,
            other_inset: None,
            legends: Legends::default(),
            messages: Messages::default(),
            ending: Ending::default(),
            drawing: Drawing::start(
                mailbox.of(|drawn| Finished::Drawn(DrawingId::First, drawn)),
                DrawingId::First,
            )?,
            surface_pool: None,
            comparison: Comparison::new(
                mailbox.of(|drawn| Finished::Drawn(DrawingId::Second, drawn)),
                Measuring::new(mailbox.of(Finished::Measured), mailbox.of(Finished::PictureRead)),
            ),
            probing: probing::start(mailbox.of(|(target, samples)| Finished::Probed(target, samples)))?,
            explaining: explaining::start(mailbox.of(|(asked, found)| Finished::Explained(asked, Box::new(found))))?,
            feeding: feeding::start(mailbox.of(|(target, feeds)| Finished::Fed(target, Box::new(feeds))))?,
            pointed_texel: None,
            readers: Readers::start(mailbox.of(Finished::Read), mailbox.of(Finished::Thumbnail))?,
            saver: Saver::start(
                mailbox.of(Finished::Saved),
                options.screenshot_dir,
                options.screenshot_name,
            )?,
            results,
            revision: 0,
            picture_revision: 0,
            last_drawn: None,
            last_shown: None,
            grammar: options.grammar,
            sheet: SheetDesk::new(sheet::start(
                mailbox.of(|(question, drawn)| Finished::SheetDrawn(question, Box::new(drawn))),
            )?),
            restored: options.restored,
        };
        viewer.drawing.set_progressive(viewer.settings.progressive);
        viewer.open(&options.paths);
        if let Some(against) = options.against {
            viewer.compare_from_the_start(against);
        }
        viewer.update();
        Ok(viewer)
    }

    /// Adds the scenes in `paths` to the list and shows the first of them; at the start they are the list, or the
    /// gallery is where they hold none. A PNG with a record brings its state back; another picture becomes B.
    pub(super) fn open(&mut self, paths: &[PathBuf]) {
        let lesson = paths.iter().find_map(|path| LessonSource::from_address(path));
        if let Some(lesson) = lesson {
            self.open_lesson(&lesson);
            return self.open_gallery_if_empty();
        }
        let (pictures, documents): (Vec<&PathBuf>, Vec<&PathBuf>) = paths.iter().partition(|path| is_picture(path));
        let documents: Vec<PathBuf> = documents.into_iter().cloned().collect();
        if let ([], Some(picture)) = (documents.as_slice(), pictures.last())
            && self.restore(picture)
        {
            return self.open_gallery_if_empty();
        }
        // A picture alone at the start is told that it is no scene.
        let compares = !self.scenes.is_empty() || !documents.is_empty();
        let (mut scenes, problems) = library::list_scenes(if compares { &documents } else { paths });
        if let Some(picture) = pictures.last().filter(|_| compares) {
            self.compare(Against::File((*picture).clone()));
        }
        for problem in problems {
            self.messages.error(problem);
        }
        if self.scenes.is_empty() {
            if scenes.is_empty() {
                scenes = library::gallery_entries();
            }
            self.replace_scenes(scenes);
        } else if !scenes.is_empty() {
            self.add_scenes(scenes);
        }
    }

    /// A picture whose scene is gone leaves a list with something to look at too.
    fn open_gallery_if_empty(&mut self) {
        if self.scenes.is_empty() {
            self.replace_scenes(library::gallery_entries());
        }
    }

    /// Appends scenes and shows the first of them; one that is in the list already is read again instead.
    pub(super) fn add_scenes(&mut self, scenes: Vec<SceneEntry>) {
        let place = |list: &[SceneEntry], source: &SceneSource| list.iter().position(|entry| entry.source == *source);
        let first = scenes.first().map(|entry| entry.source.clone());
        for mut scene in scenes {
            if place(&self.scenes, &scene.source).is_some() {
                continue;
            }
            if self.scenes.len() >= library::MAX_SCENES {
                self.messages.error(format!(
                    "{}: the list is full; start the program anew with it",
                    scene.label
                ));
                break;
            }
            scene.camera = Camera::new(self.start_view);
            self.scenes.push(scene);
        }
        if let Some(index) = first.and_then(|source| place(&self.scenes, &source)) {
            let known = self.scenes[index].scene().is_some() || self.scenes[index].failure().is_some();
            self.current = index;
            if known {
                self.read_current();
            }
        }
    }

    pub(super) fn replace_scenes(&mut self, mut scenes: Vec<SceneEntry>) {
        // Its steps would show other scenes.
        self.lesson = None;
        for scene in &mut scenes {
            scene.camera = Camera::new(self.start_view);
        }
        self.scenes = scenes;
        self.generation += 1;
        self.readers.drop_thumbnails();
        self.recent.clear();
        self.current = 0;
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

    pub(super) fn drawn_state(&self) -> DrawnState {
        DrawnState {
            frame: self.drawing.number(),
            comparison: self.comparison.state(),
            panes: self.panes(),
            samples: self.probing.number(),
            inset: self.inset,
            other_inset: self.other_inset,
            legends: self.legends.places(),
            pixel_zoom: self.settings.pixel_zoom,
            window: self.screen.window,
        }
    }

    /// All scenes, in the order of the list.
    pub fn scenes(&self) -> &[SceneEntry] {
        &self.scenes
    }

    /// The place of the current scene in the list.
    pub fn current_index(&self) -> usize {
        self.current
    }

    /// The current scene; `None` only while the list is empty.
    pub fn current(&self) -> Option<&SceneEntry> {
        self.scenes.get(self.current)
    }

    /// Sampling, rules, dialect, pixel zoom.
    pub fn settings(&self) -> &Settings {
        &self.settings
    }

    /// The frame on the screen. It may show an older state, or be a preview; see [`Viewer::is_settled`].
    pub fn frame(&self) -> Option<&Frame> {
        self.drawing.frame()
    }

    /// The numbers of the current view; `None` before the scene was read.
    pub fn view_numbers(&self) -> Option<ViewNumbers> {
        let entry = self.current()?;
        Some(entry.camera.numbers(&self.sight()?))
    }

    /// The window in device pixels.
    pub fn window_size(&self) -> [u32; 2] {
        self.screen.window
    }

    /// The size of A's frame, and of B's: that of the window divided by the pixel zoom, unless both lie side by side.
    pub fn frame_size(&self) -> [u32; 2] {
        self.panes().frame
    }

    /// The dialog that is open.
    pub fn dialog(&self) -> Option<Dialog> {
        self.screen.dialog
    }

    /// Whether text lies over the picture.
    pub fn overlay_text(&self) -> bool {
        self.screen.shown.text
    }

    /// Whether the side panel is to be seen, unless everything is hidden.
    pub fn panel(&self) -> bool {
        self.screen.shown.panel
    }

    /// Light or dark panels.
    pub fn theme(&self) -> Theme {
        self.screen.theme
    }

    /// What the user is to be told, oldest first. Whoever shows a message dismisses it after a while.
    pub fn messages(&self) -> &[Message] {
        self.messages.all()
    }

    /// The pixel inspector.
    pub fn inspector(&self) -> &Inspector {
        &self.inspector
    }

    /// The inspector's inset in the window, where it is open and has room.
    pub fn inset(&self) -> Option<PlacedInset> {
        self.inset
    }

    /// The inset of the same pixel of B, where A and B share the window.
    pub fn other_inset(&self) -> Option<PlacedInset> {
        self.other_inset
    }

    /// The window's title: scene, settings or what of them differs between A and B, program.
    pub fn title(&self) -> String {
        let name = self.current().map_or("no scene", |entry| entry.label.as_str());
        let words = self.comparison_title();
        let words = words.unwrap_or_else(|| self.own_words().join(", "));
        plain::short_line(&format!("{name} - {words} - Rasterscope"), MAX_TITLE)
    }

    /// What the current camera looks at; `None` before the scene was read.
    pub(super) fn sight(&self) -> Option<Sight> {
        let scene = self.current()?.scene()?;
        Some(Sight {
            canvas: scene.canvas,
            frame: self.frame_size(),
        })
    }
}
