//! A saved picture brings back its scene, view, settings and pin.

use std::path::{Path, PathBuf};

use glam::DVec2;

use crate::figure::{Guard, InsetPlace, InsetSpec};
use crate::viewer::ab::other::Other;
use crate::viewer::export::restored::Restored;
use crate::viewer::export::spec::PictureSpec;
use crate::viewer::inspector::Pin;
use crate::viewer::library;
use crate::viewer::state::Viewer;
use crate::viewer::view::camera::Camera;

impl Viewer {
    /// Protects what is shown: the scene with its textures, and a picture that is compared with it.
    pub fn guard(&self) -> Guard {
        let mut guard = Guard::default();
        if let Some((entry, scene)) = self.current().and_then(|entry| Some((entry, entry.scene()?))) {
            entry.source.protect(&scene.files, &mut guard);
        }
        if let Some(Other::Picture(picture)) = &self.ab.other {
            guard.protect(&picture.path);
        }
        guard
    }

    /// Shows what a picture's record tells: scene, view, settings. False where it has none.
    pub(in crate::viewer) fn restore(&mut self, shot: &Path) -> bool {
        let restored = match self
            .export
            .grammar
            .map(|grammar| Restored::of_file(shot, grammar.picture))
        {
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
            self.replace_scenes(scenes);
        } else {
            self.add_scenes(scenes);
        }
        self.settings.render = restored.spec.render;
        self.settings.render.outline = true;
        self.settings.dialect = restored.spec.dialect;
        if let Some(entry) = self.scene_list.scenes.get_mut(self.scene_list.current) {
            entry.camera = Camera::new(restored.spec.view);
        }
        self.chrome.messages.done(format!("as in {}", shot.display()));
        self.export.restored = Some(restored);
        true
    }

    /// Tells, once the scene was read, what changed since its picture was made.
    pub(in crate::viewer) fn complete_restored(&mut self) {
        let Some(entry) = self.current().filter(|entry| !entry.is_reading()) else {
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
        self.inspector.magnifier.pin = Some(Pin {
            pixel: [0, 0],
            place: Some((place, (self.scene_list.current, self.scene_list.generation))),
        });
    }
}
