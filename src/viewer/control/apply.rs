//! Commands to changes of state.

use crate::viewer::command::parts::{
    ExportCommand, InspectorCommand, LessonCommand, PointerCommand, SceneCommand, SheetCommand, ViewCommand,
    WindowCommand,
};
use std::time::Instant;

use crate::viewer::chrome::ending;
use crate::viewer::command::{Command, Effect};
use crate::viewer::library;
use crate::viewer::settings::values::next_of;
use crate::viewer::settings::{PixelZoom, Theme, Toggle};
use crate::viewer::state::Viewer;
use crate::viewer::view::camera::Camera;
use crate::viewer::view::pointer::PointerButton;

/// What is said while everything but the picture is hidden.
const WAY_BACK: &str = "Tab brings the panels back, and so does a right click";

impl Viewer {
    /// Does what `command` says, without waiting for anything, and returns what the program around has to do.
    ///
    /// Any command is fine at any time: one that makes no sense now changes nothing.
    #[must_use = "the program around the viewer has to carry out the effects"]
    pub fn apply(&mut self, command: Command) -> Vec<Effect> {
        if self.is_so_already(&command) {
            return Vec::new();
        }
        if !is_passing(&command) {
            self.chrome.ending.forget();
            self.chrome.start_card &= comes_from_outside(&command);
        }
        let effects = self.dispatch(command);
        self.update();
        effects
    }

    /// Whether everything but the picture is hidden.
    pub fn everything_hidden(&self) -> bool {
        self.chrome.hidden
    }

    /// Whether a command that windows repeat tells nothing new.
    fn is_so_already(&self, command: &Command) -> bool {
        match command {
            Command::Pointer(PointerCommand::Moved { at }) => self.pointer.at == Some(*at),
            Command::Pointer(PointerCommand::Left) => self.pointer.at.is_none(),
            Command::Window(WindowCommand::Resize(size)) => self.chrome.window == *size,
            Command::Window(WindowCommand::SetFreeArea(area)) => self.chrome.free_area == *area,
            Command::Inspector(InspectorCommand::PointAtTexel(texel)) => self.inspector.pointed_texel == *texel,
            Command::Sheet(SheetCommand::SetRoom(room)) => !self.sheet_room_changes(*room),
            _ => false,
        }
    }

    /// Every command has its arm: one that nobody carries out does not compile.
    fn dispatch(&mut self, command: Command) -> Vec<Effect> {
        match command {
            Command::Pointer(command) => self.apply_pointer(command),
            Command::View(command) => self.apply_view(command),
            Command::Set(change) => {
                if let Some(remark) = change.apply(&mut self.settings) {
                    self.chrome.messages.error(remark);
                }
            }
            Command::Ab(command) => self.apply_ab(command),
            Command::Scenes(command) => self.apply_scenes(command),
            Command::Lesson(command) => self.apply_lesson(command),
            Command::Inspector(command) => self.apply_inspector(command),
            Command::Export(command) => return self.apply_export(command),
            Command::Sheet(command) => return self.apply_sheet(command),
            Command::Window(command) => return self.apply_window(command),
        }
        Vec::new()
    }

    fn apply_pointer(&mut self, command: PointerCommand) {
        match command {
            PointerCommand::Moved { at } => self.pointer_moved(at),
            PointerCommand::Left => self.pointer.at = None,
            PointerCommand::Pressed(button) => {
                self.inspector.magnifier.revealed = false;
                self.pointer_pressed(button);
            }
            PointerCommand::Released(PointerButton::Primary) => {
                (self.pointer.dragging, self.ab.drags_line) = (false, false);
            }
            PointerCommand::Released(PointerButton::Secondary) => {}
            PointerCommand::Wheel { clicks } => self.wheel(clicks),
            PointerCommand::Pinch { factor } => self.zoom(self.pointer.at, factor),
        }
    }

    fn apply_view(&mut self, command: ViewCommand) {
        match command {
            ViewCommand::PanBy { by } => self.pan(by),
            ViewCommand::ZoomAt { at, factor } => self.zoom(at, factor),
            ViewCommand::RotateBy { degrees } => self.look(|camera, context| camera.rotate(degrees, context)),
            ViewCommand::Reset => self.reset_view(),
            ViewCommand::Fit => self.fit_view(),
            ViewCommand::ActualSize => self.look(Camera::actual_size),
            ViewCommand::Set(numbers) => self.look(|camera, context| camera.set(numbers, context)),
            ViewCommand::SetPixelZoom(zoom) => self.set_pixel_zoom(zoom),
            ViewCommand::NextPixelZoom => self.set_pixel_zoom(next_of(&PixelZoom::ALL, self.settings.pixel_zoom, 1.0)),
            ViewCommand::Progressive(toggle) => {
                self.settings.progressive = toggle.of(self.settings.progressive);
                self.frames.drawing.set_progressive(self.settings.progressive);
                if let Some(drawing) = self.ab.drawing_mut() {
                    drawing.set_progressive(self.settings.progressive);
                }
            }
        }
    }

    fn apply_scenes(&mut self, command: SceneCommand) {
        match command {
            SceneCommand::Next if self.step_lesson(true) => {}
            SceneCommand::Previous if self.step_lesson(false) => {}
            SceneCommand::Next => self.scene_list.step(1),
            SceneCommand::Previous => self.scene_list.step(self.scene_list.scenes.len().saturating_sub(1)),
            SceneCommand::Show(index) => self.scene_list.show(index),
            SceneCommand::Open(paths) => self.open(&paths),
            SceneCommand::OpenGallery => self.replace_scenes(library::gallery_entries()),
            SceneCommand::Reload => self.read_current(),
            SceneCommand::RememberOpened(earlier) => self.remember_opened(&earlier),
            SceneCommand::FilesChanged(files) => self.files_changed(&files),
            SceneCommand::FollowFiles(toggle) => {
                let follows = toggle.of(self.scene_list.follows_files);
                self.scene_list.follows_files = follows;
                let words = if follows {
                    "files are read again when they change"
                } else {
                    "files are not read again by themselves"
                };
                self.chrome.messages.done(words.to_owned());
            }
            SceneCommand::OtherReading => self.choose_other_reading(),
        }
    }

    fn apply_lesson(&mut self, command: LessonCommand) {
        match command {
            LessonCommand::Open(source) => self.open_lesson(&source),
            LessonCommand::Step(step) => self.take_step(step),
            LessonCommand::Close => {
                self.close_lesson();
            }
        }
    }

    fn apply_inspector(&mut self, command: InspectorCommand) {
        match command {
            InspectorCommand::Show(toggle) => self.show_inspector(toggle),
            InspectorCommand::SetRegion(region) => self.inspector.magnifier.set_region(region),
            InspectorCommand::SetMagnification(magnification) => {
                self.inspector.magnifier.set_magnification(magnification);
            }
            InspectorCommand::StepMagnification(steps) => self.inspector.magnifier.step(steps),
            InspectorCommand::PinUnderPointer => self.pin_under_pointer(),
            InspectorCommand::Pin(pixel) => self.pin(pixel),
            InspectorCommand::PinEdge => self.pin_edge(),
            InspectorCommand::Nudge(by) => self.nudge(by),
            InspectorCommand::Unpin => self.inspector.magnifier.pin = None,
            InspectorCommand::PointAtTexel(texel) => self.inspector.pointed_texel = texel,
            InspectorCommand::Explanation(toggle) => self.show_explanation(toggle),
        }
    }

    fn apply_export(&mut self, command: ExportCommand) -> Vec<Effect> {
        match command {
            ExportCommand::CopyPixel => self.copy_pixel(),
            ExportCommand::Copy => self.copy(),
            ExportCommand::CopyPicture => self.copy_picture(),
            ExportCommand::CopyExplanation => self.copy_explanation(),
            ExportCommand::CopyCommandLine => self.copy_command_line(),
            ExportCommand::WindowScreenshot => vec![Effect::PictureOfWindow],
            ExportCommand::Screenshot => {
                self.ask_for_screenshot();
                Vec::new()
            }
        }
    }

    fn apply_sheet(&mut self, command: SheetCommand) -> Vec<Effect> {
        match command {
            SheetCommand::Change(change) => self.change_sheet(change),
            SheetCommand::SetRoom(room) => self.set_sheet_room(room),
            SheetCommand::Save => self.ask_for_sheet(),
            SheetCommand::CopyCommandLine => return self.copy_sheet_command_line(),
        }
        Vec::new()
    }

    fn apply_window(&mut self, command: WindowCommand) -> Vec<Effect> {
        let screen = &mut self.chrome;
        match command {
            WindowCommand::Resize(size) => {
                screen.window = size;
                // Panels may cover more of a smaller window.
                let magnifier = &mut self.inspector.magnifier;
                magnifier.revealed |= magnifier.pin.is_some();
            }
            WindowCommand::SetFreeArea(area) => {
                self.set_free_area(area);
                self.reveal_pin();
            }
            WindowCommand::OverlayText(toggle) => screen.shown.text = toggle.of(screen.shown.text),
            WindowCommand::Panel(toggle) => screen.shown.panel = toggle.of(screen.shown.panel),
            WindowCommand::HideEverything(toggle) => {
                screen.hidden = toggle.of(screen.hidden);
                if screen.hidden {
                    screen.messages.done(WAY_BACK.to_owned());
                } else {
                    screen.messages.retract(WAY_BACK);
                }
            }
            WindowCommand::ToggleDialog(dialog) => {
                screen.dialog = Some(dialog).filter(|dialog| screen.dialog != Some(*dialog));
            }
            WindowCommand::CloseDialog => screen.dialog = None,
            WindowCommand::SetTheme(theme) => screen.theme = theme,
            WindowCommand::NextTheme => screen.theme = next_of(&Theme::ALL, screen.theme, 1.0),
            WindowCommand::About(toggle) => screen.shown.words = toggle.of(screen.shown.words),
            WindowCommand::StartCard(toggle) => screen.start_card = toggle.of(screen.start_card),
            WindowCommand::SetInterfaceScale(scale) => screen.interface_scale = scale,
            WindowCommand::StepInterfaceScale { up } => screen.interface_scale = screen.interface_scale.step(up),
            WindowCommand::DismissMessage(id) => self.chrome.messages.dismiss(id),
            WindowCommand::Escape => return self.escape(),
            WindowCommand::Quit => return vec![Effect::Quit],
        }
        Vec::new()
    }

    fn show_inspector(&mut self, toggle: Toggle) {
        // What is hidden is not open to the eye: the key shows it again.
        self.inspector.magnifier.open = toggle.of(self.inspector.magnifier.open && !self.chrome.hidden);
        if self.inspector.magnifier.open {
            self.chrome.hidden = false;
        } else {
            self.inspector.magnifier.pin = None;
            self.inspector.magnifier.came_with_pin = false;
        }
    }

    /// Closes or unpins what is open, the latest first; when nothing is, asks once and then ends the program.
    fn escape(&mut self) -> Vec<Effect> {
        if self.close_latest() {
            self.chrome.ending.forget();
            return Vec::new();
        }
        if self.chrome.ending.escape(Instant::now()) {
            return vec![Effect::Quit];
        }
        self.chrome.messages.question(ending::QUESTION.to_owned());
        Vec::new()
    }

    /// Closes or unpins one thing; false when nothing is open.
    fn close_latest(&mut self) -> bool {
        self.chrome.dialog.take().is_some()
            || std::mem::take(&mut self.chrome.start_card)
            || std::mem::take(&mut self.chrome.hidden)
            || self.escape_arrangement()
            || self.inspector.magnifier.pin.take().is_some()
            || std::mem::take(&mut self.inspector.magnifier.open)
            || self.escape_comparison()
            || self.close_lesson()
    }
}

/// Whether a command leaves the question of Esc standing: Esc itself, and what windows tell by themselves.
fn is_passing(command: &Command) -> bool {
    matches!(
        command,
        Command::Pointer(PointerCommand::Moved { .. } | PointerCommand::Left)
            | Command::Window(WindowCommand::Resize(_) | WindowCommand::SetFreeArea(_) | WindowCommand::Escape)
            | Command::Sheet(SheetCommand::SetRoom(_))
            | Command::Scenes(SceneCommand::FilesChanged(_))
            | Command::Inspector(InspectorCommand::PointAtTexel(_))
    )
}

/// Whether a command may come without a hand, and leaves the start card: themes follow the desktop, and the side panel folds
/// with the window's size; a hand flips it.
fn comes_from_outside(command: &Command) -> bool {
    matches!(
        command,
        Command::Window(
            WindowCommand::StartCard(_) | WindowCommand::SetTheme(_) | WindowCommand::Panel(Toggle::On | Toggle::Off)
        )
    )
}
