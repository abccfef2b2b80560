//! Files and folders become the list of scenes.

use std::path::{Path, PathBuf};

use crate::viewer::ab::other::Against;
use crate::viewer::ab::outside::is_picture;
use crate::viewer::lesson::source::LessonSource;
use crate::viewer::library;
use crate::viewer::library::{SceneEntry, SceneSource};
use crate::viewer::state::Viewer;
use crate::viewer::view::camera::Camera;

impl Viewer {
    /// What opening a file of this name gives: a `scene`, a `picture` or a `lesson`; `None` where it is none of these.
    pub fn kind_of_file(path: &Path) -> Option<&'static str> {
        if crate::scene::is_document(path) {
            return Some("scene");
        }
        if is_picture(path) {
            return Some("picture");
        }
        LessonSource::from_address(path).map(|_| "lesson")
    }

    /// Adds the scenes in `paths` to the list and shows the first of them; at the start they are the list, or the
    /// gallery is where they hold none. A PNG with a record brings its state back; another picture becomes B.
    pub(in crate::viewer) fn open(&mut self, paths: &[PathBuf]) {
        let there: Vec<PathBuf> = paths.iter().filter(|path| path.exists()).cloned().collect();
        self.scene_list.note_opened(&there);
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
        let compares = !self.scene_list.scenes.is_empty() || !documents.is_empty();
        let (mut scenes, problems) = library::list_scenes(if compares { &documents } else { paths });
        if let Some(picture) = pictures.last().filter(|_| compares) {
            self.compare(Against::File((*picture).clone()));
        }
        for problem in problems {
            self.chrome.messages.error(problem);
        }
        if self.scene_list.scenes.is_empty() {
            if scenes.is_empty() {
                scenes = library::gallery_entries();
            }
            self.replace_scenes(scenes);
        } else if !scenes.is_empty() {
            self.add_scenes(scenes);
        }
    }

    /// Files and folders that were opened, in this session or in earlier ones, the latest first.
    pub fn opened(&self) -> &[PathBuf] {
        &self.scene_list.opened
    }

    /// Takes up what earlier sessions opened.
    pub(in crate::viewer) fn remember_opened(&mut self, earlier: &[PathBuf]) {
        let now = std::mem::take(&mut self.scene_list.opened);
        self.scene_list.note_opened(earlier);
        self.scene_list.note_opened(&now);
    }

    /// A picture whose scene is gone leaves a list with something to look at too.
    fn open_gallery_if_empty(&mut self) {
        if self.scene_list.scenes.is_empty() {
            self.replace_scenes(library::gallery_entries());
        }
    }

    /// Appends scenes and shows the first of them; one that is in the list already is read again instead.
    pub(in crate::viewer) fn add_scenes(&mut self, scenes: Vec<SceneEntry>) {
        let place = |list: &[SceneEntry], source: &SceneSource| list.iter().position(|entry| entry.source == *source);
        let first = scenes.first().map(|entry| entry.source.clone());
        for mut scene in scenes {
            if place(&self.scene_list.scenes, &scene.source).is_some() {
                continue;
            }
            if self.scene_list.scenes.len() >= library::MAX_SCENES {
                self.chrome.messages.error(format!(
                    "{}: the list is full; start the program anew with it",
                    scene.label
                ));
                break;
            }
            scene.camera = Camera::new(self.scene_list.start_view);
            self.scene_list.scenes.push(scene);
        }
        if let Some(index) = first.and_then(|source| place(&self.scene_list.scenes, &source)) {
            let known =
                self.scene_list.scenes[index].scene().is_some() || self.scene_list.scenes[index].failure().is_some();
            self.scene_list.current = index;
            if known {
                self.read_current();
            }
        }
    }

    pub(in crate::viewer) fn replace_scenes(&mut self, mut scenes: Vec<SceneEntry>) {
        // Its steps would show other scenes.
        self.lesson = None;
        for scene in &mut scenes {
            scene.camera = Camera::new(self.scene_list.start_view);
        }
        self.scene_list.scenes = scenes;
        self.scene_list.generation += 1;
        self.scene_list.readers.drop_thumbnails();
        self.scene_list.recent.clear();
        self.scene_list.current = 0;
    }
}
