//! Keys, pointer and wheel: what the panels do not take is the picture's.

use egui::{Pos2, pos2};
use glam::DVec2;

use super::Session;
use crate::viewer::{
    Command, Dialog, Key, KeyPress, Modifiers, PointerButton, PointerCommand, Toggle, WindowCommand, commands,
};

impl Session {
    /// The command that a key asks for, unless a line of text or an open list wants the key.
    pub(in crate::app) fn command_for(&self, press: &KeyPress) -> Option<Command> {
        if self.interface.list_is_open() {
            // What lies behind a list has none of its keys.
            if press.logical != Some(Key::Escape) {
                self.interface.enter_list();
            }
            return None;
        }
        let in_dialog = self.viewer.chrome().dialog().is_some();
        let in_card = in_dialog || self.viewer.chrome().start_card();
        // Esc closes a card, whatever has the focus in it.
        let by_focus = !(in_card && press.logical == Some(Key::Escape)) && self.interface.takes_key(press);
        // The picture behind a card has none of the keys that press its buttons. Before one of its own has the focus, all keys
        // but Tab close the start card.
        let by_card = match press.logical {
            Some(Key::Tab) => in_card,
            Some(Key::Space | Key::Enter) => in_dialog,
            _ => false,
        };
        if by_focus || by_card {
            return None;
        }
        if self.viewer.chrome().start_card() && matches!(press.logical, Some(Key::Space | Key::Enter)) {
            return Some(Command::Window(WindowCommand::StartCard(Toggle::Off)));
        }
        let command = commands::for_key(press)?;
        if self.asks_again(&command) || (self.viewer.chrome().dialog() == Some(Dialog::Help) && !is_for_help(&command))
        {
            return None;
        }
        let typing = self.interface.has_keyboard();
        let asks = matches!(
            self.viewer.chrome().dialog(),
            Some(
                Dialog::Palette
                    | Dialog::Open
                    | Dialog::Scenes
                    | Dialog::GoToPixel
                    | Dialog::ComparePicture
                    | Dialog::SaveAs
            )
        );
        let passes = match press.logical {
            _ if !typing && !asks => true,
            Some(Key::Escape) => asks,
            Some(Key::F(_)) => true,
            Some(Key::Char(c)) => press.modifiers.contains(Modifiers::CTRL) && !"acvxyz".contains(c),
            _ => false,
        };
        passes.then(|| command.clone())
    }

    /// Whether a command asks what a dialog is asking already: what is typed next is the answer, and nothing that the picture
    /// is to do.
    fn asks_again(&self, command: &Command) -> bool {
        let Command::Window(WindowCommand::ToggleDialog(asked)) = command else {
            return false;
        };
        let takes_text = matches!(
            asked,
            Dialog::Palette | Dialog::Open | Dialog::GoToPixel | Dialog::SaveAs
        );
        takes_text && self.viewer.chrome().dialog() == Some(*asked)
    }

    /// A pointer at `at`, in window pixels, or none in the window. True if the picture has it.
    pub(in crate::app) fn pointer_at(&mut self, at: Option<DVec2>) -> bool {
        self.pointer = at;
        let on_picture = self.holds_picture || self.is_on_picture();
        match at {
            Some(at) if on_picture => self.run(Command::Pointer(PointerCommand::Moved { at })),
            _ if self.viewer.pixels().pointer().is_some() => self.run(Command::Pointer(PointerCommand::Left)),
            _ => {}
        }
        on_picture
    }

    /// Puts the pointer on the picture where a panel that lay between them went away; true if that is so.
    pub(super) fn find_pointer(&mut self) -> bool {
        let found = self.pointer.is_some() && self.viewer.pixels().pointer().is_none() && self.is_on_picture();
        if found {
            self.pointer_at(self.pointer);
        }
        found
    }

    /// Takes the pointer off the picture where a card came to lie between them; true if that is so.
    pub(super) fn lose_pointer(&mut self) -> bool {
        let has_it = self.viewer.pixels().pointer().is_some() && !self.holds_picture;
        let covers = |at: DVec2| self.interface.card_covers(self.to_points(at));
        let is_lost = has_it && self.pointer.is_some_and(covers);
        if is_lost {
            self.run(Command::Pointer(PointerCommand::Left));
        }
        is_lost
    }

    /// A button of the mouse at the pointer's place. True if the picture took it.
    pub(in crate::app) fn pointer_button(&mut self, button: PointerButton, down: bool) -> bool {
        if down && self.is_on_picture() {
            self.find_pointer();
            self.interface.leave_panels();
            self.holds_picture = button == PointerButton::Primary;
            self.run(Command::Pointer(PointerCommand::Pressed(button)));
            return true;
        }
        if !down && self.holds_picture {
            self.holds_picture = false;
            self.run(Command::Pointer(PointerCommand::Released(button)));
            self.pointer_at(self.pointer);
            return true;
        }
        false
    }

    /// Turns of the wheel. True if the picture took them.
    pub(in crate::app) fn turn_wheel(&mut self, clicks: f64) -> bool {
        let on_picture = self.is_on_picture();
        if on_picture {
            self.find_pointer();
            self.run(Command::Pointer(PointerCommand::Wheel { clicks }));
        }
        on_picture
    }

    /// Two fingers on a touch pad. True if the picture took them.
    pub(in crate::app) fn pinch(&mut self, factor: f64) -> bool {
        let on_picture = self.is_on_picture();
        if on_picture {
            self.find_pointer();
            self.run(Command::Pointer(PointerCommand::Pinch { factor }));
        }
        on_picture
    }

    pub(super) fn is_on_picture(&self) -> bool {
        self.pointer
            .is_some_and(|at| !self.interface.covers(self.to_points(at)))
    }

    #[expect(clippy::cast_possible_truncation, reason = "window pixels are small")]
    pub(super) fn to_points(&self, at: DVec2) -> Pos2 {
        pos2(at.x as f32, at.y as f32) / self.scale()
    }
}

/// Whether a key does its work over the sheet of all keys: those that close it, and those of the window itself. What the others
/// change would lie behind it.
fn is_for_help(command: &Command) -> bool {
    matches!(
        command,
        Command::Window(
            WindowCommand::Escape
                | WindowCommand::ToggleDialog(Dialog::Help)
                | WindowCommand::Quit
                | WindowCommand::StepInterfaceScale { .. }
                | WindowCommand::SetInterfaceScale(_)
        )
    )
}
