//! Files and folders become the list of scenes, lessons or pictures to compare with; a saved picture brings back its scene,
//! view, settings and pin.

use std::path::{Path, PathBuf};

use glam::DVec2;

use crate::figure::{InsetPlace, InsetSpec};
use crate::viewer::SceneCommand;
use crate::viewer::ab::comparison::Comparison;
use crate::viewer::ab::other::Against;
use crate::viewer::ab::outside::is_picture;
use crate::viewer::ab::requests::ComparisonContext;
use crate::viewer::board::{Board, Displaced};
use crate::viewer::chrome::Chrome;
use crate::viewer::chrome::messages::no_such;
use crate::viewer::control::lesson::Lessons;
use crate::viewer::export::restored::Restored;
use crate::viewer::export::spec::PictureSpec;
use crate::viewer::export::state::Export;
use crate::viewer::inspector::state::Inspection;
use crate::viewer::lesson::source::LessonSource;
use crate::viewer::lesson::walk::Walk;
use crate::viewer::library;
use crate::viewer::library::SceneEntry;
use crate::viewer::library::state::SceneList;
use crate::viewer::profile::Profiling;
use crate::viewer::settings::picture::SettingChange;
use crate::viewer::settings::{Settings, patterns};
use crate::viewer::spectrum::SpectrumState;
use crate::viewer::view::camera::Camera;

/// What opening a file of this name gives: a `scene`, a `picture`, a `lesson` or a sample `pattern`; `None` where it is none of these.
pub fn kind_of_file(path: &Path) -> Option<&'static str> {
    if crate::scene::is_document(path) {
        return Some("scene");
    }
    if is_picture(path) {
        return Some("picture");
    }
    if patterns::is_pattern_file(path) {
        return Some("pattern");
    }
    LessonSource::from_address(path).map(|_| "lesson")
}

/// The list of scenes, and what else opened files change.
#[derive(Debug)]
pub(in crate::viewer) struct Opening<'a> {
    pub(in crate::viewer) lesson: &'a mut Option<Walk>,
    pub(in crate::viewer) settings: &'a mut Settings,
    pub(in crate::viewer) chrome: &'a mut Chrome,
    pub(in crate::viewer) scene_list: &'a mut SceneList,
    pub(in crate::viewer) ab: &'a mut Comparison,
    pub(in crate::viewer) inspector: &'a mut Inspection,
    pub(in crate::viewer) profiling: &'a mut Profiling,
    pub(in crate::viewer) board: &'a mut Board,
    pub(in crate::viewer) spectrum: &'a mut SpectrumState,
    pub(in crate::viewer) export: &'a mut Export,
}

impl Opening<'_> {
    pub(in crate::viewer) fn lessons(&mut self) -> Lessons<'_> {
        Lessons {
            lesson: self.lesson,
            settings: self.settings,
            chrome: self.chrome,
            scene_list: self.scene_list,
            ab: self.ab,
            inspector: self.inspector,
        }
    }

    pub(in crate::viewer) fn apply(&mut self, command: SceneCommand) {
        let is_step = match command {
            SceneCommand::Next => self.lessons().step(true),
            SceneCommand::Previous => self.lessons().step(false),
            _ => false,
        };
        if is_step {
            return;
        }
        let scenes = &mut *self.scene_list;
        if scenes.scenes.len() <= 1 && matches!(command, SceneCommand::Next | SceneCommand::Previous) {
            let words = "there is no other scene in the list; open more with Ctrl+O";
            self.chrome.messages.done(words.to_owned());
            return;
        }
        match command {
            SceneCommand::Next => scenes.step(1),
            SceneCommand::Previous => scenes.step(scenes.scenes.len().saturating_sub(1)),
            SceneCommand::Show(index) if index < scenes.scenes.len() => scenes.show(index),
            SceneCommand::Show(index) => {
                let missing = no_such("scene", index, "the list", scenes.scenes.len());
                self.chrome.messages.error(missing);
            }
            SceneCommand::Open(paths) => self.open(&paths),
            SceneCommand::OpenGallery => self.replace(library::gallery_entries()),
            SceneCommand::Reload => self.reload(),
            SceneCommand::GiveUpReading => {
                scenes.give_up_reading();
            }
            SceneCommand::RememberOpened(earlier) => scenes.remember_opened(&earlier),
            SceneCommand::FilesChanged(files) => self.files_changed(&files),
            SceneCommand::FollowFiles(toggle) => {
                let follows = toggle.of(scenes.follows_files);
                scenes.follows_files = follows;
                let words = if follows {
                    "files are read again when they change"
                } else {
                    "files are not read again by themselves"
                };
                self.chrome.messages.done(words.to_owned());
            }
            SceneCommand::OtherReading => scenes.choose_other_reading(&mut self.settings.dialect),
        }
    }

    /// Adds the scenes in `paths` to the list and shows the first of them; at the start they are the list, or the
    /// gallery is where they hold none. A PNG with a record brings its state back; another picture becomes B.
    pub(in crate::viewer) fn open(&mut self, paths: &[PathBuf]) {
        let there: Vec<PathBuf> = paths.iter().filter(|path| path.exists()).cloned().collect();
        self.scene_list.note_opened(&there);
        let (patterns, rest): (Vec<_>, Vec<_>) =
            paths.iter().cloned().partition(|path| patterns::is_pattern_file(path));
        if let Some(pattern) = patterns.last() {
            self.take_pattern(pattern);
            if rest.is_empty() {
                return self.open_gallery_if_empty();
            }
        }
        let paths = rest.as_slice();
        let lesson = paths.iter().find_map(|path| LessonSource::from_address(path));
        if let Some(lesson) = lesson {
            self.lessons().open(&lesson);
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
        let compares = !self.scene_list.scenes.is_empty() || !documents.is_empty();
        let (mut scenes, problems) = library::list_scenes(if compares { &documents } else { paths });
        if let Some(picture) = pictures.last().filter(|_| compares) {
            let mut context = ComparisonContext {
                settings: self.settings,
                messages: &mut self.chrome.messages,
            };
            self.ab.compare(Against::File((*picture).clone()), &mut context);
        }
        for problem in problems {
            self.chrome.messages.error(problem);
        }
        if self.scene_list.scenes.is_empty() {
            if scenes.is_empty() {
                scenes = library::gallery_entries();
            }
            self.replace(scenes);
        } else if !scenes.is_empty() {
            self.add(scenes);
        }
    }

    /// Samples by the pattern in a file, and tells it.
    fn take_pattern(&mut self, path: &Path) {
        let change = patterns::of_file(path).and_then(|value| SettingChange::of("pattern", &value));
        match change {
            Ok(change) => {
                change.apply(self.settings);
                let render = &self.settings.render;
                let (name, count) = (render.pattern.name(), render.sample_rate.samples());
                let plural = if count == 1 { "" } else { "s" };
                let words = format!("pattern {name}: {count} sample{plural} per pixel");
                self.chrome.messages.done(words);
            }
            Err(problem) => self.chrome.messages.error(problem),
        }
    }

    /// A picture whose scene is gone leaves a list with something to look at too.
    fn open_gallery_if_empty(&mut self) {
        if self.scene_list.scenes.is_empty() {
            self.replace(library::gallery_entries());
        }
    }

    /// Closes or unpins one thing, the latest first; false when nothing is open.
    pub(in crate::viewer) fn close_latest(&mut self) -> bool {
        // The board lies over a scene's words.
        if self.chrome.close_latest() || self.close_board() || self.close_words() {
            return true;
        }
        if self.scene_list.give_up_reading() || self.profiling.escape() || self.spectrum.escape() {
            return true;
        }
        let mut context = ComparisonContext {
            settings: self.settings,
            messages: &mut self.chrome.messages,
        };
        self.ab.escape_arrangement(&mut context)
            || self.inspector.magnifier.pin.take().is_some()
            || std::mem::take(&mut self.inspector.magnifier.open)
            || self.ab.escape(&mut context)
            || self.lessons().close()
    }

    /// Closes the board, which gives back the card in whose place it is; false where it is not open.
    fn close_board(&mut self) -> bool {
        if !self.board.escape() {
            return false;
        }
        match self.board.displaced.take() {
            Some(Displaced::Profile) => self.profiling.show(true),
            Some(Displaced::Spectrum) => self.spectrum.open = true,
            None => {}
        }
        true
    }

    /// Closes the scene's words; false where none are to be seen.
    fn close_words(&mut self) -> bool {
        self.scene_list.words().is_some() && std::mem::take(&mut self.chrome.shown.words)
    }

    fn add(&mut self, scenes: Vec<SceneEntry>) {
        if let Some((walk, first)) = self.lesson.as_mut().zip(scenes.first()) {
            walk.opened = Some(first.source.clone());
        }
        let dialects = self.ab.wanted_dialects(self.settings);
        self.scene_list.add(scenes, dialects, &mut self.chrome.messages);
    }

    fn replace(&mut self, scenes: Vec<SceneEntry>) {
        // Its steps would show other scenes.
        *self.lesson = None;
        self.scene_list.replace(scenes);
    }

    /// Shows what a picture's record tells: scene, view, settings. False where it has none.
    fn restore(&mut self, shot: &Path) -> bool {
        let grammar = self.export.grammar;
        let restored = match grammar.map(|grammar| Restored::of_file(shot, grammar.picture)) {
            None | Some(Ok(None)) => return false,
            Some(Ok(Some(restored))) => restored,
            Some(Err(problem)) => {
                self.chrome.messages.error(problem);
                return true;
            }
        };
        let address = PathBuf::from(restored.spec.scene.address());
        let (scenes, problems) = library::list_scenes(&[address]);
        if let Some(problem) = problems.into_iter().next() {
            let name = shot.display();
            self.chrome
                .messages
                .error(format!("{name}: the scene of this picture is not there: {problem}"));
            return true;
        }
        if self.scene_list.scenes.is_empty() {
            self.replace(scenes);
        } else {
            self.add(scenes);
        }
        self.settings.render = restored.spec.render;
        self.settings.render.outline = true;
        self.settings.dialect = restored.spec.dialect;
        if let Some(walk) = self.lesson.as_mut() {
            // Its scene stays when the lesson is closed, and looks as in the picture then, too.
            (walk.before.settings.render, walk.before.settings.dialect) = (self.settings.render, self.settings.dialect);
        }
        if let Some(entry) = self.scene_list.current_mut() {
            entry.camera = Camera::new(restored.spec.view);
        }
        self.chrome.messages.done(format!("as in {}", shot.display()));
        self.export.restored = Some(restored);
        true
    }

    /// Tells, once the scene was read, what changed since its picture was made.
    pub(in crate::viewer) fn complete_restored(&mut self) {
        let Some(entry) = self.scene_list.current().filter(|entry| !entry.is_reading()) else {
            return;
        };
        let Some(scene) = entry.scene().cloned() else { return };
        let source = entry.source.clone();
        let Some(restored) = self.export.restored.take_if(|restored| restored.spec.scene == source) else {
            return;
        };
        if let Some(inset) = restored.spec.insets.first() {
            self.pin_as_in(inset, &restored.spec, scene.canvas);
        }
        if let Some(differs) = &restored.record.differs {
            self.chrome
                .messages
                .done(format!("{}: {differs}", restored.shot.display()));
        }
        if let Some(change) = restored.changes(&scene.files) {
            self.chrome.messages.error(change);
        }
    }

    /// Pins the place of an inset, in a window that may have another size than the picture.
    fn pin_as_in(&mut self, inset: &InsetSpec, spec: &PictureSpec, canvas: DVec2) {
        let place = match inset.at {
            InsetPlace::User(place) => place,
            InsetPlace::Pixel(pixel) => {
                let centre = DVec2::from(pixel.map(f64::from)) + 0.5;
                spec.view.transform(canvas, spec.size).to_scene(centre)
            }
        };
        self.inspector.magnifier.set_magnification(inset.magnification);
        self.inspector.magnifier.set_region(inset.region);
        self.inspector.magnifier.open = true;
        self.inspector.pin_place(place, self.scene_list);
    }
}
