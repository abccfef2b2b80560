//! Scenes come into the list, or make another one.

use crate::viewer::chrome::messages::Messages;
use crate::viewer::library::dialects::WantedDialects;
use crate::viewer::library::state::SceneList;
use crate::viewer::library::{MAX_SCENES, SceneEntry, SceneSource};
use crate::viewer::view::camera::Camera;

impl SceneList {
    /// Appends scenes and shows the first of them; one that is in the list already is read again instead.
    pub(in crate::viewer) fn add(
        &mut self,
        scenes: Vec<SceneEntry>,
        dialects: WantedDialects,
        messages: &mut Messages,
    ) {
        let place = |list: &[SceneEntry], source: &SceneSource| list.iter().position(|entry| entry.source == *source);
        let first = scenes.first().map(|entry| entry.source.clone());
        for mut scene in scenes {
            if place(&self.scenes, &scene.source).is_some() {
                continue;
            }
            if self.scenes.len() >= MAX_SCENES {
                messages.error(format!(
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
                self.read_current(dialects);
            }
        }
    }

    /// Shows this list from its first scene on.
    pub(in crate::viewer) fn replace(&mut self, mut scenes: Vec<SceneEntry>) {
        for scene in &mut scenes {
            scene.camera = Camera::new(self.start_view);
        }
        self.scenes = scenes;
        self.generation += 1;
        self.readers.drop_thumbnails();
        self.recent.clear();
        self.current = 0;
    }
}
