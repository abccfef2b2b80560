//! Files and folders become the list of scenes.

use std::path::PathBuf;

use crate::viewer::ab::other::Against;
use crate::viewer::ab::outside::is_picture;
use crate::viewer::lesson::source::LessonSource;
use crate::viewer::library;
use crate::viewer::library::{SceneEntry, SceneSource};
use crate::viewer::state::Viewer;
use crate::viewer::view::camera::Camera;

impl Viewer {
    /// Adds the scenes in `paths` to the list and shows the first of them; at the start they are the list, or the
    /// gallery is where they hold none. A PNG with a record brings its state back; another picture becomes B.
    pub(in crate::viewer) fn open(&mut self, paths: &[PathBuf]) {
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
        let compares = !self.library.scenes.is_empty() || !documents.is_empty();
        let (mut scenes, problems) = library::list_scenes(if compares { &documents } else { paths });
        if let Some(picture) = pictures.last().filter(|_| compares) {
            self.compare(Against::File((*picture).clone()));
        }
        for problem in problems {
            self.chrome.messages.error(problem);
        }
        if self.library.scenes.is_empty() {
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
        if self.library.scenes.is_empty() {
            self.replace_scenes(library::gallery_entries());
        }
    }

    /// Appends scenes and shows the first of them; one that is in the list already is read again instead.
    pub(in crate::viewer) fn add_scenes(&mut self, scenes: Vec<SceneEntry>) {
        let place = |list: &[SceneEntry], source: &SceneSource| list.iter().position(|entry| entry.source == *source);
        let first = scenes.first().map(|entry| entry.source.clone());
        for mut scene in scenes {
            if place(&self.library.scenes, &scene.source).is_some() {
                continue;
            }
            if self.library.scenes.len() >= library::MAX_SCENES {
                self.chrome.messages.error(format!(
                    "{}: the list is full; start the program anew with it",
                    scene.label
                ));
                break;
            }
            scene.camera = Camera::new(self.library.start_view);
            self.library.scenes.push(scene);
        }
        if let Some(index) = first.and_then(|source| place(&self.library.scenes, &source)) {
            let known = self.library.scenes[index].scene().is_some() || self.library.scenes[index].failure().is_some();
            self.library.current = index;
            if known {
                self.read_current();
            }
        }
    }

    pub(in crate::viewer) fn replace_scenes(&mut self, mut scenes: Vec<SceneEntry>) {
        // Its steps would show other scenes.
        self.lesson = None;
        for scene in &mut scenes {
            scene.camera = Camera::new(self.library.start_view);
        }
        self.library.scenes = scenes;
        self.library.generation += 1;
        self.library.readers.drop_thumbnails();
        self.library.recent.clear();
        self.library.current = 0;
    }
}
