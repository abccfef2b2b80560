//! Screenshots and copies of the picture: asked for now, made when the frame of this state is there.

use std::path::Path;
use std::sync::Arc;

use crate::figure::{Record, add_legends};
use crate::raster::Framebuffer;
use crate::viewer::command::Effect;
use crate::viewer::export::saver::{Recipe, Saved, Shot, Work};
use crate::viewer::export::spec::PictureSpec;
use crate::viewer::frames::frame::Frame;
use crate::viewer::state::Viewer;

impl Viewer {
    /// Saves the picture of the whole window, as [`crate::viewer::command::Effect::PictureOfWindow`] asks for it.
    pub fn save_window_picture(&mut self, window: Framebuffer) {
        if window.pixels().is_empty() {
            self.chrome
                .messages
                .error("nothing to save: the window has no pixels; make it larger".to_owned());
        } else {
            let recipe = self.recipe_of_window();
            self.export
                .saver
                .push(Work::Picture(Shot::Ready(window), recipe.map(Box::new)));
        }
        self.update();
    }

    pub(in crate::viewer) fn ask_for_screenshot(&mut self) {
        self.export.saver.waiting = self.export.saver.waiting.saturating_add(1);
        self.export.saver.since = self.frames.drawing.newest_request();
        // No preview, and no rest: the picture of this moment, even if the view goes on moving.
        self.set_hurry(true);
    }

    /// The picture that screenshots wait for is another one now.
    pub(in crate::viewer) fn wait_for_newest_frame(&mut self) {
        self.export.saver.since = self.frames.drawing.newest_request();
    }

    /// Saves the screenshots that wait, as soon as there is a final frame of the state when they were asked for, or of
    /// a later one.
    pub(in crate::viewer) fn save_when_ready(&mut self) {
        let reading = self
            .current()
            .is_some_and(crate::viewer::library::SceneEntry::is_reading);
        if self.export.saver.waiting == 0 || reading || !self.inspector.samples.is_current() {
            return;
        }
        let Some(frame) = self.frames.drawing.final_frame(self.export.saver.since).cloned() else {
            if !self.frames.drawing.is_current() {
                return;
            }
            self.export.saver.waiting = 0;
            self.set_hurry(false);
            self.chrome
                .messages
                .error("nothing to save: there is no picture; open a scene first".to_owned());
            return;
        };
        if self.ab.shows_both() && !self.ab.is_current() {
            return;
        }
        let recipe = self.recipe_of_frame(&frame, self.ab.shows_both());
        for _ in 0..std::mem::take(&mut self.export.saver.waiting) {
            let shot = self.shot_of(&frame, recipe.as_ref());
            self.export
                .saver
                .push(Work::Picture(shot, recipe.clone().map(Box::new)));
        }
        self.set_hurry(false);
    }

    /// What a screenshot of this frame shows.
    fn shot_of(&self, frame: &Arc<Frame>, recipe: Option<&Recipe>) -> Shot {
        if !self.ab.shows_both() {
            return Shot::Frame {
                frame: Arc::clone(frame),
                insets: recipe.map_or(Vec::new(), |recipe| recipe.spec.insets.clone()),
                legends: self.legends_of_picture(),
            };
        }
        if self.inspector.inset.is_some() {
            // The inset is in window pixels.
            return Shot::Ready(self.window_picture());
        }
        let mut picture = self.composite().picture();
        add_legends(&mut picture, &self.legends_of_picture(), &[]);
        Shot::Ready(picture)
    }

    /// Copies the inspected pixel in words, or the picture while no pixel is inspected.
    pub(in crate::viewer) fn copy(&mut self) -> Vec<Effect> {
        if self.inspector.magnifier.open {
            self.copy_pixel()
        } else {
            self.copy_picture()
        }
    }

    /// The picture as a screenshot of this moment shows it.
    pub(in crate::viewer) fn copy_picture(&mut self) -> Vec<Effect> {
        let frame = self
            .frames
            .drawing
            .final_frame(self.frames.drawing.newest_request())
            .cloned();
        let both_current = !self.ab.shows_both() || self.ab.is_current();
        let Some(frame) = frame.filter(|_| both_current) else {
            let problem = "nothing copied: there is no finished picture yet; copy again when it is drawn";
            self.chrome.messages.error(problem.to_owned());
            return Vec::new();
        };
        let recipe = self.recipe_of_frame(&frame, self.ab.shows_both());
        match self.shot_of(&frame, recipe.as_ref()).picture() {
            Ok(picture) => {
                let (width, height) = (picture.width(), picture.height());
                self.chrome
                    .messages
                    .done(format!("copied the picture, {width} x {height} pixels"));
                vec![Effect::CopyPicture(picture)]
            }
            Err(problem) => {
                self.chrome.messages.error(problem);
                Vec::new()
            }
        }
    }

    /// How the picture of the whole window was made.
    fn recipe_of_window(&self) -> Option<Recipe> {
        Some(Recipe {
            spec: self.picture_spec()?,
            scene: Arc::clone(self.current()?.scene()?),
            differs: Some("a picture of the window; the command line draws what it shows, without panels".to_owned()),
        })
    }

    /// The record of a picture of the window that is written to `output`; `None` without a scene.
    pub fn record_of_window(&self, output: &Path) -> Option<Record> {
        Some(self.recipe_of_window()?.record(output))
    }

    /// How a frame was made, and what else its picture shows.
    fn recipe_of_frame(&self, frame: &Frame, with_other: bool) -> Option<Recipe> {
        let now = self.picture_spec()?;
        let picture = &frame.picture;
        let spec = PictureSpec {
            size: picture.size,
            render: picture.settings,
            // What A and B share has its own insets, in window pixels.
            insets: if with_other { Vec::new() } else { now.insets.clone() },
            ..now
        };
        let drawn_of_now = self
            .current()?
            .scene()
            .is_some_and(|scene| Arc::ptr_eq(scene, &picture.scene));
        let seen_from_there = spec.view.transform(picture.scene.canvas, picture.size) == picture.view;
        let differs = if !drawn_of_now || !seen_from_there {
            Some("the view moved on while this picture was saved; the command line draws where it went")
        } else if with_other {
            Some("A and B share this picture; the command line draws A alone")
        } else {
            None
        };
        Some(Recipe {
            spec,
            scene: Arc::clone(&picture.scene),
            differs: differs.map(str::to_owned),
        })
    }

    pub(in crate::viewer) fn picture_saved(&mut self, Saved(saved): Saved) {
        self.export.saver.running = self.export.saver.running.saturating_sub(1);
        match saved {
            Ok((path, [width, height])) => {
                self.chrome
                    .messages
                    .done(format!("saved {}, {width} x {height} pixels", path.display()));
            }
            Err(problem) => self.chrome.messages.error(problem),
        }
    }
}
