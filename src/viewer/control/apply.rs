//! Commands to changes of state.

use std::time::Instant;

use crate::viewer::chrome::ending;
use crate::viewer::command::{Command, Effect};
use crate::viewer::library;
use crate::viewer::settings::values::next_of;
use crate::viewer::settings::{PixelZoom, Theme};
use crate::viewer::state::Viewer;
use crate::viewer::view::camera::Camera;

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
            Command::PointerReleased(crate::viewer::view::pointer::PointerButton::Primary) => {
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
}
