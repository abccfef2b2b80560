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
