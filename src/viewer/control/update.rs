//! The turns of the wheel: results are taken in, and state, frames and inset are kept together.

use std::time::Instant;

use crate::raster::Framebuffer;
use crate::viewer::ab::requests::ComparisonContext;
use crate::viewer::control::save::Screenshots;
use crate::viewer::export::saver::{SAVING_SHEET, Shot, Work};
use crate::viewer::state::{Finished, Viewer};

impl Viewer {
    /// Takes in what the threads finished; true if something that is to be seen changed. Never waits.
    pub fn poll(&mut self) -> bool {
        let mut any = false;
        while let Ok(finished) = self.results.try_recv() {
            self.take_in(finished);
            any = true;
        }
        if self.due().is_some_and(|due| due <= Instant::now()) {
            self.drawings().look();
            any = true;
        }
        if any {
            self.update();
        }
        any
    }

    /// Whether the frame of the current state is there and everything that was asked for is saved.
    pub fn is_settled(&self) -> bool {
        self.is_final() && self.export.saver.is_idle()
    }

    /// Whether the final frame of the current state is there, and what the inspector and a comparison say about it.
    pub fn is_final(&self) -> bool {
        let drawn = self.frames.drawing.is_current() && self.ab.is_current();
        !self.scene_list.is_reading_any()
            && drawn
            && self.inspector.is_answered()
            && self.profiling.truth.is_current()
            && self.spectrum.spectra.is_current()
            && self.both().is_measured()
            && self.sheet.is_current()
            && self.board.measuring.is_current()
    }

    /// When to call [`Viewer::poll`] even if nothing wakes the event loop: then the hand rests, and the preview on the
    /// screen is to be refined, or nobody came for [`Viewer::draw_frame`]. `None` while there is nothing to wait for.
    pub fn due(&self) -> Option<Instant> {
        let both = [self.frames.drawing.due(), self.ab.due()];
        both.into_iter().flatten().min()
    }

    /// Waits until [`Viewer::is_settled`]: for scripts, tests and pictures without a window.
    pub fn finish(&mut self) {
        self.finish_until(Self::is_settled);
    }

    /// As [`Viewer::finish`], and waits for the thumbnails that were asked for.
    pub fn finish_thumbnails(&mut self) {
        self.finish_until(|viewer| viewer.is_settled() && !viewer.scene_list.readers.has_thumbnails_pending());
    }

    fn finish_until(&mut self, done: fn(&Self) -> bool) {
        self.poll();
        self.drawings().set_hurry(true);
        while !done(self) {
            // Every pending piece of work sends its result, even when it fails; without threads there is none left.
            let Ok(finished) = self.results.recv() else { break };
            self.take_in(finished);
            self.update();
        }
        let waits = self.export.saver.is_waiting();
        self.drawings().set_hurry(waits);
    }

    pub(in crate::viewer) fn take_in(&mut self, finished: Finished) {
        match finished {
            Finished::Read(read) => self.scene_list.take_in(read, self.settings.dialect, &mut self.chrome),
            Finished::Drawn(id, drawn) => self.drawings().take_in(id, drawn),
            Finished::Measured(measured) => {
                if self.ab.measured(measured) {
                    self.hand().jump();
                }
            }
            Finished::PictureRead(read) => {
                let mut context = ComparisonContext {
                    settings: &self.settings,
                    messages: &mut self.chrome.messages,
                };
                self.ab.picture_read(read, &mut context);
            }
            Finished::Probed(target, samples) => self.inspector.samples.finished(target, samples),
            Finished::Explained(asked, explanation) => self.inspector.explanation.finished(asked, *explanation),
            Finished::Contributed(target, found) => self.inspector.contributions.finished(target, *found),
            Finished::Profiled(asked, found) => self.profiling.truth.finished(asked, found),
            Finished::Board(news) => self.board.measuring.take_in(news),
            Finished::Transformed(asked, found) => self.spectrum.spectra.finished(asked, found),
            Finished::Thumbnail(thumbnail) => self.scene_list.thumbnail_drawn(thumbnail),
            Finished::Saved(saved) => self.export.saver.take_in(saved, &mut self.chrome.messages),
            Finished::SheetDrawn(question, drawn) => self.sheet.previews.finished(question, *drawn),
        }
    }

    /// After any change: reads what must be read, wants the right frame, places the inset, saves what waits for it.
    pub(in crate::viewer) fn update(&mut self) {
        self.revision += 1;
        if let Some(broken) = self.scene_list.left_broken() {
            self.chrome.messages.forget_problems_of(&broken);
        }
        self.scene_list.want(self.ab.wanted_dialects(&self.settings));
        self.opening().complete_restored();
        follow_lesson(self);
        let shows_step = self.shows_scene_of_step();
        self.hand().place(shows_step);
        self.drawings().want_frame();
        self.drawings().update_comparison();
        self.hand().want_answers();
        self.hand().want_truth_along_line();
        self.want_board();
        self.hand().want_spectrum();
        let legends = self.pixels().legends();
        self.frames.legends.place(legends);
        let drawn = self.window().drawn_state();
        if self.last_drawn != Some(drawn) {
            self.last_drawn = Some(drawn);
            self.picture_revision += 1;
        }
        let screenshots = self.saving().save_screenshots();
        if screenshots != Screenshots::Wait {
            self.drawings().set_hurry(false);
        }
        if screenshots == Screenshots::NoPicture {
            let problem = "nothing to save: there is no picture; open a scene first";
            self.chrome.messages.error(problem.to_owned());
        }
        let mut saving = self.saving();
        saving.want_sheet();
        match saving.save_sheets() {
            Ok(true) => self.chrome.messages.done(SAVING_SHEET.to_owned()),
            Ok(false) => {}
            Err(problem) => self.chrome.messages.error(problem.to_owned()),
        }
    }

    /// Saves the picture of the whole window, as [`crate::viewer::command::Effect::PictureOfWindow`] asks for it.
    pub fn save_window_picture(&mut self, window: Framebuffer) {
        if window.pixels().is_empty() {
            self.chrome
                .messages
                .error("nothing to save: the window has no pixels; make it larger".to_owned());
        } else {
            let recipe = self.recipes().recipe_of_window();
            self.export.saver.push(Work::Picture {
                shot: Shot::Ready(window),
                recipe: recipe.map(Box::new),
                file: None,
            });
        }
        self.update();
    }
}

/// Sets the view of a lesson's step where that is due; its pin stays in sight, and goes with its scene.
pub(in crate::viewer) fn follow_lesson(viewer: &mut Viewer) {
    viewer.opening().lessons().let_go_of_pin();
    if viewer.opening().lessons().follow() {
        viewer.hand().keep_pin_in_place();
        viewer.hand().reveal_pin();
        viewer.opening().lessons().take_view();
    }
}
