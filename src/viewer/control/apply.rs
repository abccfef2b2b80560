//! Commands to changes of state.

use std::time::Instant;

use crate::viewer::ab::requests::{KEPT, UNSEEN};
use crate::viewer::chrome::Dialog;
use crate::viewer::chrome::{Chrome, ending};
use crate::viewer::command::parts::{
    AbCommand, ExportCommand, InspectorCommand, PointerCommand, SceneCommand, SheetCommand, WindowCommand,
};
use crate::viewer::command::{Command, Effect};
use crate::viewer::control::comparing::Comparing;
use crate::viewer::control::copy::Copied;
use crate::viewer::control::update::follow_lesson;
use crate::viewer::inspector::Reveal;
use crate::viewer::settings::values::next_of;
use crate::viewer::settings::{Theme, Toggle};
use crate::viewer::state::Viewer;

/// What is said while everything but the picture is hidden.
const WAY_BACK: &str = "Tab brings the panels back, and so does a right click";

impl Viewer {
    /// Does what `command` says, without waiting for anything, and returns what the program around has to do.
    ///
    /// Any command is fine at any time: one that makes no sense now changes nothing.
    #[must_use = "the program around the viewer has to carry out the effects"]
    pub fn apply(&mut self, command: Command) -> Vec<Effect> {
        // Windows repeat some that tell nothing new.
        let is_so_already = match &command {
            Command::Pointer(PointerCommand::Moved { at }) => self.pointer.at == Some(*at),
            Command::Pointer(PointerCommand::Left) => self.pointer.at.is_none(),
            Command::Window(WindowCommand::Resize(size)) => self.chrome.window == *size,
            Command::Window(WindowCommand::SetFreeArea(area)) => self.chrome.free_area == *area,
            Command::Inspector(InspectorCommand::PointAtTexel(texel)) => self.inspector.pointed_texel == *texel,
            Command::Sheet(SheetCommand::SetRoom(room)) => !self.sheet.room_changes(*room),
            _ => false,
        };
        if is_so_already {
            return Vec::new();
        }
        if !is_passing(&command) {
            self.chrome.forget_ending();
            self.chrome.start_card &= comes_from_outside(&command);
        }
        let effects = self.dispatch(command);
        self.update();
        effects
    }

    /// Every command has its arm: one that nobody carries out does not compile.
    fn dispatch(&mut self, command: Command) -> Vec<Effect> {
        match command {
            Command::Pointer(command) => self.hand().apply_pointer(command),
            Command::View(command) => {
                self.hand().apply_view(command);
                self.drawings().follow_settings();
            }
            Command::Set(change) => {
                let messages = &mut self.chrome.messages;
                messages.retract(KEPT);
                let before = self.settings.render;
                if let Some(remark) = change.apply(&mut self.settings) {
                    messages.error(remark);
                }
                // Else a key seems to do nothing.
                let key = self.ab.key_to_a().filter(|_| self.settings.render != before);
                if let Some(key) = key {
                    messages.done(format!("{UNSEEN}; press {key} to see A"));
                }
            }
            Command::SetDefaults => self.set_defaults(),
            Command::Ab(command) => self.apply_ab(command),
            Command::Scenes(command) => self.opening().apply(command),
            Command::Lesson(command) => self.opening().lessons().apply(command),
            Command::Inspector(command) => self.hand().apply_inspector(command),
            Command::Profile(command) => {
                self.hand().apply_profile(command);
                self.board.open &= !self.profiling.open;
            }
            Command::Board(command) => {
                let copied = self.apply_board(command);
                return tell_copied(&mut self.chrome, copied);
            }
            Command::Spectrum(command) => {
                self.hand().apply_spectrum(command);
                self.board.open &= !self.spectrum.open;
            }
            Command::Export(ExportCommand::WindowScreenshot) => return vec![Effect::PictureOfWindow],
            Command::Export(ExportCommand::OpenFolder) => {
                return vec![Effect::OpenFolder(self.export.saver.folder_to_show())];
            }
            Command::Export(command) => {
                let saves = matches!(command, ExportCommand::Screenshot | ExportCommand::SaveAs(_));
                let copied = self.saving().export(command);
                if saves {
                    // No preview, and no rest: the picture of this moment, even if the view goes on moving.
                    self.drawings().set_hurry(true);
                }
                return tell_copied(&mut self.chrome, copied);
            }
            Command::Sheet(command) => {
                let copied = self.saving().change_sheet(command);
                return tell_copied(&mut self.chrome, copied);
            }
            Command::Window(command) => return self.apply_window(command),
        }
        Vec::new()
    }

    /// Carries out a command; what is looked at and explained stays in sight.
    fn apply_ab(&mut self, command: AbCommand) {
        // Before: the other frames may leave the pixel outside.
        let (before, explains) = (self.both().layout, self.pixels().explains());
        let jumps = command == AbCommand::NextDifference;
        Comparing {
            settings: &mut self.settings,
            messages: &mut self.chrome.messages,
            scene_list: &mut self.scene_list,
            frames: &mut self.frames,
            ab: &mut self.ab,
            saver: &mut self.export.saver,
        }
        .apply(command);
        if jumps {
            self.hand().jump();
        }
        self.hand().follow_arrangement(&before, explains);
        self.ab.touch();
    }

    fn apply_window(&mut self, command: WindowCommand) -> Vec<Effect> {
        let screen = &mut self.chrome;
        match command {
            WindowCommand::Resize(size) => {
                screen.window = size;
                // Panels may cover more of a smaller window.
                let magnifier = &mut self.inspector.magnifier;
                if magnifier.pin.is_some() {
                    magnifier.reveal = Some(Reveal::Resized);
                }
                self.hand().rest_in_another_window();
            }
            WindowCommand::SetFreeArea(area) => {
                self.hand().set_free_area(area);
                follow_lesson(self);
                self.hand().reveal_pin();
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
                if screen.dialog == Some(Dialog::Sheet) {
                    self.sheet.draft.suit(self.settings.render.pattern);
                }
            }
            WindowCommand::CloseDialog => screen.dialog = None,
            WindowCommand::SetTheme(theme) => screen.theme = theme,
            WindowCommand::NextTheme => screen.theme = next_of(&Theme::ALL, screen.theme, 1.0),
            WindowCommand::About(toggle) => screen.shown.words = toggle.of(screen.shown.words),
            WindowCommand::StartCard(toggle) => screen.start_card = toggle.of(screen.start_card),
            WindowCommand::SetInterfaceScale(scale) => screen.interface_scale = scale,
            WindowCommand::StepInterfaceScale { up } => screen.interface_scale = screen.interface_scale.step(up),
            WindowCommand::Presenter(toggle) => screen.presenter = toggle.of(screen.presenter),
            WindowCommand::FocusPanel { back } => return vec![Effect::FocusPanel { back }],
            WindowCommand::DismissMessage(id) => self.chrome.messages.dismiss(id),
            WindowCommand::BringBack => self.bring_back(),
            WindowCommand::Escape => return self.escape(),
            WindowCommand::Quit => return vec![Effect::Quit],
        }
        Vec::new()
    }

    /// Closes or unpins what is open, the latest first; when nothing is, asks once and then ends the program.
    fn escape(&mut self) -> Vec<Effect> {
        if self.opening().close_latest() {
            self.chrome.forget_ending();
            return Vec::new();
        }
        if self.chrome.ending.escape(Instant::now()) {
            return vec![Effect::Quit];
        }
        self.chrome.messages.question(ending::QUESTION.to_owned());
        Vec::new()
    }
}

/// What the program around the viewer does with what is copied; the user is told.
fn tell_copied(chrome: &mut Chrome, copied: Option<Result<Copied, String>>) -> Vec<Effect> {
    match copied {
        Some(Ok(Copied { effect, message })) => {
            chrome.messages.done(message);
            vec![effect]
        }
        Some(Err(problem)) => {
            chrome.messages.error(problem);
            Vec::new()
        }
        None => Vec::new(),
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
