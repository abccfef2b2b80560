//! The turns of the wheel: results are taken in, and state, frames and inset are kept together.

use std::time::Instant;

use crate::viewer::state::{DrawnState, Finished, Viewer};

impl Viewer {
    pub(in crate::viewer) fn drawn_state(&self) -> DrawnState {
        DrawnState {
            frame: self.frames.drawing.number(),
            comparison: self.ab.state(),
            panes: self.panes(),
            samples: self.inspector.samples.number(),
            inset: self.inspector.inset,
            other_inset: self.inspector.other_inset,
            legends: self.frames.legends.places(),
            pixel_zoom: self.settings.pixel_zoom,
            window: self.chrome.window,
        }
    }

    /// Takes in what the threads finished; true if something that is to be seen changed. Never waits.
    pub fn poll(&mut self) -> bool {
        let mut any = false;
        while let Ok(finished) = self.results.try_recv() {
            self.take_in(finished);
            any = true;
        }
        if self.due().is_some_and(|due| due <= Instant::now()) {
            self.look_at_drawings();
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
        let reading = self
            .current()
            .is_some_and(|entry| entry.is_reading() || entry.is_read_for_b());
        let drawn = self.frames.drawing.is_current() && self.ab.is_current();
        !reading
            && drawn
            && self.inspector.samples.is_current()
            && self.explains_all()
            && self.is_measured()
            && self.sheet.is_current()
    }

    /// When to call [`Viewer::poll`] even if nothing wakes the event loop: then the hand rests, and the preview on the
    /// screen is to be refined, or nobody came for [`Viewer::draw_frame`]. `None` while there is nothing to wait for.
    pub fn due(&self) -> Option<Instant> {
        [self.frames.drawing.due(), self.comparison_due()]
            .into_iter()
            .flatten()
            .min()
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
        self.set_hurry(true);
        while !done(self) {
            // Every pending piece of work sends its result, even when it fails; without threads there is none left.
            let Ok(finished) = self.results.recv() else { break };
            self.take_in(finished);
            self.update();
        }
        self.set_hurry(self.export.saver.is_waiting());
    }

    /// Starts what is due.
    fn look_at_drawings(&mut self) {
        self.frames.drawing.look();
        if let Some(drawing) = self.ab.drawing_mut() {
            drawing.look();
        }
    }

    pub(in crate::viewer) fn take_in(&mut self, finished: Finished) {
        match finished {
            Finished::Read(read) => self.scene_read(read),
            Finished::Drawn(id, drawn) => {
                self.hold_pair();
                let drawing = self.drawing_of(id);
                let failed = drawing.is_some_and(|drawing| drawing.finished(drawn) && drawing.has_failed());
                self.release_pair();
                if failed {
                    let name = self.current().map_or(String::new(), |entry| entry.label.clone());
                    self.chrome.messages.error(format!(
                        "{name}: drawing this view failed inside the program; please report it with the file"
                    ));
                }
            }
            Finished::Measured(measured) => self.measured(measured),
            Finished::PictureRead(read) => self.picture_read(read),
            Finished::Probed(target, samples) => self.inspector.samples.finished(target, samples),
            Finished::Explained(asked, explanation) => self.inspector.explanation.finished(asked, *explanation),
            Finished::Contributed(target, found) => self.inspector.contributions.finished(target, *found),
            Finished::Thumbnail(thumbnail) => self.thumbnail_drawn(thumbnail),
            Finished::Saved(saved) => self.picture_saved(saved),
            Finished::SheetDrawn(question, drawn) => self.sheet.previews.finished(question, *drawn),
        }
    }

    /// After any change: reads what must be read, wants the right frame, places the inset, saves what waits for it.
    pub(in crate::viewer) fn update(&mut self) {
        self.revision += 1;
        self.want_scene();
        self.complete_restored();
        self.follow_lesson();
        self.follow_free_part();
        self.keep_pin_in_place();
        self.place_inset();
        self.want_frame();
        self.update_comparison();
        self.want_samples();
        self.want_explanation();
        self.want_contributions();
        self.place_legends();
        let drawn = self.drawn_state();
        if self.last_drawn != Some(drawn) {
            self.last_drawn = Some(drawn);
            self.picture_revision += 1;
        }
        self.save_when_ready();
        self.want_sheet();
        self.save_sheets_when_ready();
    }
}
