//! Commands to changes of state; and the turns of the wheel that keep the state, the frame and the inset together.

use std::time::Instant;

use glam::DVec2;

use super::drawing::Wish;
use super::settings::values::next_of;
use super::state::Finished;
use super::{Camera, Command, Effect, PixelRect, PixelZoom, Sight, Theme, Viewer, ending, library};
use crate::geometry::View;
use crate::raster::Region;
use crate::render::RenderSettings;

/// What one click of the wheel zooms by.
const WHEEL_FACTOR: f64 = 1.25;
/// Clicks of the wheel that count at once.
const MAX_CLICKS: f64 = 100.0;

impl Viewer {
    /// Does what `command` says, without waiting for anything, and returns what the program around has to do.
    ///
    /// Any command is fine at any time: one that makes no sense now changes nothing.
    #[must_use = "the program around the viewer has to carry out the effects"]
    pub fn apply(&mut self, command: Command) -> Vec<Effect> {
        if self.is_so_already(&command) {
            return Vec::new();
        }
        let effects = self.dispatch(command);
        self.update();
        effects
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
        self.is_final() && self.saver.is_idle()
    }

    /// Whether the final frame of the current state is there, and what the inspector and a comparison say about it.
    pub fn is_final(&self) -> bool {
        let reading = self
            .current()
            .is_some_and(|entry| entry.is_reading() || entry.is_read_for_b());
        let drawn = self.drawing.is_current() && self.comparison.is_current();
        !reading
            && drawn
            && self.probing.is_current()
            && self.explains_all()
            && self.is_measured()
            && self.sheet.is_current()
    }

    /// When to call [`Viewer::poll`] even if nothing wakes the event loop: then the hand rests, and the preview on the
    /// screen is to be refined, or nobody came for [`Viewer::draw_frame`]. `None` while there is nothing to wait for.
    pub fn due(&self) -> Option<Instant> {
        [self.drawing.due(), self.comparison_due()].into_iter().flatten().min()
    }

    /// Waits until [`Viewer::is_settled`]: for scripts, tests and pictures without a window.
    pub fn finish(&mut self) {
        self.finish_until(Self::is_settled);
    }

    /// As [`Viewer::finish`], and waits for the thumbnails that were asked for.
    pub fn finish_thumbnails(&mut self) {
        self.finish_until(|viewer| viewer.is_settled() && !viewer.readers.has_thumbnails_pending());
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
        self.set_hurry(self.saver.is_waiting());
    }

    /// Starts what is due.
    fn look_at_drawings(&mut self) {
        self.drawing.look();
        if let Some(drawing) = self.comparison.drawing_mut() {
            drawing.look();
        }
    }

    pub(super) fn take_in(&mut self, finished: Finished) {
        match finished {
            Finished::Read(read) => self.scene_read(read),
            Finished::Drawn(id, drawn) => {
                self.hold_pair();
                let drawing = self.drawing_of(id);
                let failed = drawing.is_some_and(|drawing| drawing.finished(drawn) && drawing.has_failed());
                self.release_pair();
                if failed {
                    let name = self.current().map_or(String::new(), |entry| entry.label.clone());
                    self.messages.error(format!(
                        "{name}: drawing this view failed inside the program; please report it with the file"
                    ));
                }
            }
            Finished::Measured(measured) => self.measured(measured),
            Finished::PictureRead(read) => self.picture_read(read),
            Finished::Probed(target, samples) => self.probing.finished(target, samples),
            Finished::Explained(asked, explanation) => self.explaining.finished(asked, *explanation),
            Finished::Fed(target, feeds) => self.feeding.finished(target, *feeds),
            Finished::Thumbnail(thumbnail) => self.thumbnail_drawn(thumbnail),
            Finished::Saved(saved) => self.picture_saved(saved),
            Finished::SheetDrawn(question, drawn) => self.sheet.previews.finished(question, *drawn),
        }
    }

    /// After any change: reads what must be read, wants the right frame, places the inset, saves what waits for it.
    pub(super) fn update(&mut self) {
        self.revision += 1;
        self.want_scene();
        self.complete_restored();
        self.follow_lesson();
        self.keep_pin_in_place();
        self.place_inset();
        self.want_frame();
        self.update_comparison();
        self.want_samples();
        self.want_explanation();
        self.want_feeds();
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

    /// Whether everything but the picture is hidden.
    pub fn everything_hidden(&self) -> bool {
        self.screen.hidden
    }

    /// Whether a command that windows repeat tells nothing new.
    fn is_so_already(&self, command: &Command) -> bool {
        match command {
            Command::PointerMoved { at } => self.pointer.at == Some(*at),
            Command::PointerLeft => self.pointer.at.is_none(),
            Command::Resize(size) => self.screen.window == *size,
            Command::SetFreeArea(area) => self.screen.free_area == *area,
            Command::PointAtTexel(texel) => self.pointed_texel == *texel,
            Command::SetSheetRoom(room) => !self.sheet_room_changes(*room),
            _ => false,
        }
    }

    fn dispatch(&mut self, command: Command) -> Vec<Effect> {
        match command {
            Command::CopyPixel => return self.copy_pixel(),
            Command::Copy => return self.copy(),
            Command::CopyPicture => return self.copy_picture(),
            Command::CopyCommandLine => return self.copy_command_line(),
            Command::CopyExplanation => return self.copy_explanation(),
            Command::CopySheetCommandLine => return self.copy_sheet_command_line(),
            Command::WindowScreenshot => return vec![Effect::PictureOfWindow],
            Command::Escape => return self.escape(),
            Command::Quit => return vec![Effect::Quit],
            command => self.change(command),
        }
        Vec::new()
    }

    /// Commands that only change the state.
    fn change(&mut self, command: Command) {
        match command {
            Command::PointerMoved { at } => self.pointer_moved(at),
            Command::PointerLeft => self.pointer.at = None,
            Command::PointerPressed(button) => {
                self.inspector.revealed = false;
                self.pointer_pressed(button);
            }
            Command::PointerReleased(super::PointerButton::Primary) => {
                (self.pointer.dragging, self.comparison.drags_line) = (false, false);
            }
            Command::Wheel { clicks } => self.wheel(clicks),
            Command::Pinch { factor } => self.zoom(self.pointer.at, factor),
            Command::PanBy { by } => self.pan(by),
            Command::ZoomAt { at, factor } => self.zoom(at, factor),
            Command::RotateBy { degrees } => self.look(|camera, sight| camera.rotate(degrees, sight)),
            Command::ResetView => self.reset_view(),
            Command::FitView => self.fit_view(),
            Command::ActualSize => self.look(Camera::actual_size),
            Command::SetView(numbers) => self.look(|camera, sight| camera.set(numbers, sight)),
            Command::SetPixelZoom(zoom) => self.set_pixel_zoom(zoom),
            Command::NextPixelZoom => self.set_pixel_zoom(next_of(&PixelZoom::ALL, self.settings.pixel_zoom, 1.0)),
            Command::NextScene if self.step_lesson(true) => {}
            Command::PreviousScene if self.step_lesson(false) => {}
            Command::NextScene => self.step_scene(1),
            Command::PreviousScene => self.step_scene(self.scenes.len().saturating_sub(1)),
            Command::OpenLesson(source) => self.open_lesson(&source),
            Command::LessonStep(step) => self.take_step(step),
            Command::CloseLesson => {
                self.close_lesson();
            }
            Command::Scene(index) => self.show_scene(index),
            Command::Open(paths) => self.open(&paths),
            Command::OpenGallery => self.replace_scenes(library::gallery_entries()),
            Command::Reload => self.read_current(),
            Command::Screenshot => self.ask_for_screenshot(),
            Command::SaveSheet => self.ask_for_sheet(),
            Command::ChangeSheet(change) => self.change_sheet(change),
            Command::SetSheetRoom(room) => self.set_sheet_room(room),
            command => self.change_sampling(command),
        }
    }

    fn change_sampling(&mut self, command: Command) {
        let Some(command) = self.change_comparison(command) else {
            return;
        };
        match command {
            Command::Set(change) => {
                let remark = change.apply(&mut self.settings);
                remark.into_iter().for_each(|remark| self.messages.error(remark));
            }
            Command::OtherReading => self.choose_other_reading(),
            Command::Progressive(toggle) => {
                self.settings.progressive = toggle.of(self.settings.progressive);
                self.drawing.set_progressive(self.settings.progressive);
                if let Some(drawing) = self.comparison.drawing_mut() {
                    drawing.set_progressive(self.settings.progressive);
                }
            }
            command => self.change_inspector(command),
        }
    }

    fn change_inspector(&mut self, command: Command) {
        match command {
            Command::Inspector(toggle) => {
                // What is hidden is not open to the eye: the key shows it again.
                self.inspector.open = toggle.of(self.inspector.open && !self.screen.hidden);
                if self.inspector.open {
                    self.screen.hidden = false;
                } else {
                    self.inspector.pin = None;
                    self.inspector.came_with_pin = false;
                }
            }
            Command::SetInspectorRegion(region) => self.inspector.set_region(region),
            Command::SetMagnification(magnification) => self.inspector.set_magnification(magnification),
            Command::StepMagnification(steps) => self.inspector.step(steps),
            Command::PinUnderPointer => self.pin_under_pointer(),
            Command::Pin(pixel) => self.pin(pixel),
            Command::Nudge(by) => self.nudge(by),
            Command::Unpin => self.inspector.pin = None,
            Command::PointAtTexel(texel) => self.pointed_texel = texel,
            Command::Explanation(toggle) => self.show_explanation(toggle),
            command => self.change_screen(&command),
        }
    }

    fn change_screen(&mut self, command: &Command) {
        let screen = &mut self.screen;
        match command {
            Command::Resize(size) => screen.window = *size,
            Command::SetFreeArea(area) => {
                self.set_free_area(*area);
                self.reveal_pin();
            }
            Command::OverlayText(toggle) => screen.shown.text = toggle.of(screen.shown.text),
            Command::Panel(toggle) => screen.shown.panel = toggle.of(screen.shown.panel),
            Command::HideEverything(toggle) => screen.hidden = toggle.of(screen.hidden),
            Command::ToggleDialog(dialog) => {
                screen.dialog = Some(*dialog).filter(|dialog| screen.dialog != Some(*dialog));
            }
            Command::CloseDialog => screen.dialog = None,
            Command::SetTheme(theme) => screen.theme = *theme,
            Command::NextTheme => screen.theme = next_of(&Theme::ALL, screen.theme, 1.0),
            Command::DismissMessage(id) => self.messages.dismiss(*id),
            // What has effects was handled in `dispatch`; letting go of another button does nothing.
            _ => {}
        }
    }

    /// Closes or unpins what is open, the latest first; when nothing is, asks once and then ends the program.
    fn escape(&mut self) -> Vec<Effect> {
        if self.close_latest() {
            self.ending.forget();
            return Vec::new();
        }
        if self.ending.escape(Instant::now()) {
            return vec![Effect::Quit];
        }
        self.messages.question(ending::QUESTION.to_owned());
        Vec::new()
    }

    /// Closes or unpins one thing; false when nothing is open.
    fn close_latest(&mut self) -> bool {
        self.screen.dialog.take().is_some()
            || std::mem::take(&mut self.screen.hidden)
            || self.escape_arrangement()
            || self.inspector.pin.take().is_some()
            || std::mem::take(&mut self.inspector.open)
            || self.escape_comparison()
            || self.close_lesson()
    }

    fn wheel(&mut self, clicks: f64) {
        if self.pointer_over_inset() {
            self.inspector.wheel(clicks);
        } else if clicks.is_finite() {
            let factor = WHEEL_FACTOR.powf(clicks.clamp(-MAX_CLICKS, MAX_CLICKS));
            self.zoom(self.pointer.at, factor);
        }
    }

    /// Changes the current scene's camera; nothing happens before the scene was read.
    pub(super) fn look(&mut self, change: impl FnOnce(&mut Camera, &Sight)) {
        if let Some((sight, entry)) = self.sight().zip(self.scenes.get_mut(self.current)) {
            change(&mut entry.camera, &sight);
        }
    }

    /// Into the part of the window that no panel covers.
    pub(super) fn fit_view(&mut self) {
        let zoom = f64::from(self.settings.pixel_zoom.factor());
        let window = PixelRect::of_size(self.screen.window);
        let free = self.screen.free_area.map_or(window, |free| free.intersection(&window));
        let panes = self.panes();
        let (corner, size) = if panes.second.is_some() || self.fixed_size().is_some() {
            (DVec2::ZERO, DVec2::from(panes.frame.map(f64::from)))
        } else {
            let corner = DVec2::new(free.x as f64, free.y as f64) / zoom;
            (corner, DVec2::new(f64::from(free.width), f64::from(free.height)) / zoom)
        };
        self.look(|camera, sight| camera.fit([corner, size], sight));
    }

    fn reset_view(&mut self) {
        if let Some(entry) = self.scenes.get_mut(self.current) {
            entry.camera = Camera::default();
        }
        self.center_fixed();
    }

    /// By window pixels.
    pub(super) fn pan(&mut self, by: DVec2) {
        let zoom = f64::from(self.settings.pixel_zoom.factor());
        if by.is_finite() && !self.move_fixed(by / zoom) {
            self.look(|camera, sight| camera.pan(by / zoom, sight));
        }
    }

    /// About the centre of a window pixel, so that the status line goes on telling the same place.
    fn zoom(&mut self, at: Option<DVec2>, factor: f64) {
        if self.zoom_fixed(at, factor) {
            return;
        }
        let at = at.map_or(self.middle(), |at| self.frame_position(at.floor() + 0.5));
        self.look(|camera, sight| camera.zoom(at, factor, sight));
    }

    /// Frame pixels become larger or smaller: the views are adapted so that the window shows the same part.
    fn set_pixel_zoom(&mut self, zoom: PixelZoom) {
        if self.fixed_size().is_some() {
            return self.zoom_fixed_to(None, zoom);
        }
        let factor = f64::from(self.settings.pixel_zoom.factor()) / f64::from(zoom.factor());
        self.settings.pixel_zoom = zoom;
        let frame = self.frame_size();
        for entry in &mut self.scenes {
            if let Some(canvas) = entry.scene().map(|scene| scene.canvas) {
                entry.camera.rescale(factor, &Sight { canvas, frame });
            }
        }
        self.follow_pointer();
    }

    fn step_scene(&mut self, by: usize) {
        if !self.scenes.is_empty() {
            self.show_scene((self.current + by) % self.scenes.len());
        }
    }

    fn show_scene(&mut self, index: usize) {
        if index < self.scenes.len() {
            self.current = index;
        }
    }

    /// Asks for the frame of the current state. A minimised window keeps the one it has.
    pub(super) fn want_frame(&mut self) {
        self.comparison.forget_postponed();
        let surface = self.surface_pool.is_some() && self.shows_plain_frame();
        self.drawing.lend_surface(surface);
        if let Some(other) = self.comparison.drawing_mut() {
            other.lend_surface(false);
        }
        let size = self.frame_size();
        let Some(entry) = self.scenes.get(self.current) else {
            return self.clear_frames();
        };
        if entry.failure().is_some() {
            return self.clear_frames();
        }
        let Some((scene, sight)) = entry.scene().cloned().zip(self.sight()) else {
            // Being read for the first time: the old picture stays until the new one is there.
            return;
        };
        if size.contains(&0) {
            return;
        }
        let picture = super::Picture {
            scene,
            document: entry.document,
            view: entry.camera.transform(&sight),
            settings: RenderSettings {
                outline: self.settings.render.outline && entry.camera.view() != View::Canvas,
                ..self.settings.render
            },
            size,
        };
        if self.lags_behind(&picture) {
            return;
        }
        let from = self.attention();
        let focus = self.inset.map(|placed| in_frame(&placed.inset.source(), size));
        let wish = Wish::new(picture, from, focus);
        self.drawing.want(wish.clone());
        self.want_other(&wish);
        self.release_pair();
    }

    fn clear_frames(&mut self) {
        self.drawing.clear();
        if let Some(drawing) = self.comparison.drawing_mut() {
            drawing.clear();
        }
        self.release_pair();
    }

    /// The frame pixel that is to be final first: the one that the inspector shows, or under the pointer, or in the
    /// middle.
    fn attention(&self) -> [u32; 2] {
        let inspected = self.inset.and_then(|_| self.inspected_pixel());
        let middle = self.frame_size().map(|side| side / 2);
        inspected.or(self.hovered_pixel()).unwrap_or(middle)
    }
}

/// The part of a rectangle of frame pixels that a frame of `size` has.
fn in_frame(rect: &PixelRect, size: [u32; 2]) -> Region {
    let inside = rect.intersection(&PixelRect::of_size(size));
    Region {
        x: u32::try_from(inside.x).unwrap_or(0),
        y: u32::try_from(inside.y).unwrap_or(0),
        width: inside.width,
        height: inside.height,
    }
}
