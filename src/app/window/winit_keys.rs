//! winit's keys as the viewer's: the character first, the key's place second.

use winit::event::KeyEvent;
use winit::keyboard::{Key as LogicalKey, KeyCode, ModifiersState, NamedKey, PhysicalKey};

use crate::viewer::{AbCommand, Command, InspectorCommand, Key, KeyPress, Modifiers, SceneCommand, ViewCommand};

/// What a key event presses.
pub(super) fn press(event: &KeyEvent, held: ModifiersState) -> KeyPress {
    KeyPress {
        logical: logical(&event.logical_key),
        physical: match event.physical_key {
            PhysicalKey::Code(code) => place(code),
            PhysicalKey::Unidentified(_) => None,
        },
        modifiers: modifiers(held),
    }
}

/// What is held. Command on a Mac counts as Ctrl.
pub(super) fn modifiers(held: ModifiersState) -> Modifiers {
    let ctrl = held.control_key() || (cfg!(target_os = "macos") && held.super_key());
    [
        (ctrl, Modifiers::CTRL),
        (held.shift_key(), Modifiers::SHIFT),
        (held.alt_key(), Modifiers::ALT),
    ]
    .into_iter()
    .filter(|(is_held, _)| *is_held)
    .fold(Modifiers::NONE, |all, (_, modifier)| all.with(modifier))
}

/// Whether holding the key down repeats the command: steps do, switches do not.
pub(super) fn repeats(command: &Command) -> bool {
    if let Command::Set(change) = command {
        return change.repeats();
    }
    matches!(
        command,
        Command::Inspector(InspectorCommand::Nudge(_) | InspectorCommand::StepMagnification(_))
            | Command::View(ViewCommand::RotateBy { .. } | ViewCommand::ZoomAt { .. } | ViewCommand::PanBy { .. })
            | Command::Scenes(SceneCommand::Next | SceneCommand::Previous)
            | Command::Ab(AbCommand::StepGain(_) | AbCommand::NextDifference)
    )
}

fn logical(key: &LogicalKey) -> Option<Key> {
    match key {
        LogicalKey::Character(text) => {
            let mut characters = text.chars();
            let first = characters.next()?;
            characters.next().is_none().then(|| Key::from_char(first))
        }
        // A dead key counts as the character it would add: the backtick of many layouts.
        LogicalKey::Dead(character) => character.map(Key::from_char),
        LogicalKey::Named(name) => named(*name),
        LogicalKey::Unidentified(_) => None,
    }
}

fn named(name: NamedKey) -> Option<Key> {
    const FUNCTION_KEYS: [NamedKey; 12] = [
        NamedKey::F1,
        NamedKey::F2,
        NamedKey::F3,
        NamedKey::F4,
        NamedKey::F5,
        NamedKey::F6,
        NamedKey::F7,
        NamedKey::F8,
        NamedKey::F9,
        NamedKey::F10,
        NamedKey::F11,
        NamedKey::F12,
    ];
    Some(match name {
        NamedKey::Space => Key::Space,
        NamedKey::Escape => Key::Escape,
        NamedKey::Enter => Key::Enter,
        NamedKey::Tab => Key::Tab,
        NamedKey::ArrowLeft => Key::Left,
        NamedKey::ArrowRight => Key::Right,
        NamedKey::ArrowUp => Key::Up,
        NamedKey::ArrowDown => Key::Down,
        NamedKey::PageUp => Key::PageUp,
        NamedKey::PageDown => Key::PageDown,
        other => {
            let index = FUNCTION_KEYS.iter().position(|key| *key == other)?;
            Key::F(u8::try_from(index + 1).ok()?)
        }
    })
}

/// What a US keyboard has in that place without Shift.
fn place(code: KeyCode) -> Option<Key> {
    const PLACES: [(KeyCode, char); 47] = [
        (KeyCode::KeyA, 'a'),
        (KeyCode::KeyB, 'b'),
        (KeyCode::KeyC, 'c'),
        (KeyCode::KeyD, 'd'),
        (KeyCode::KeyE, 'e'),
        (KeyCode::KeyF, 'f'),
        (KeyCode::KeyG, 'g'),
        (KeyCode::KeyH, 'h'),
        (KeyCode::KeyI, 'i'),
        (KeyCode::KeyJ, 'j'),
        (KeyCode::KeyK, 'k'),
        (KeyCode::KeyL, 'l'),
        (KeyCode::KeyM, 'm'),
        (KeyCode::KeyN, 'n'),
        (KeyCode::KeyO, 'o'),
        (KeyCode::KeyP, 'p'),
        (KeyCode::KeyQ, 'q'),
        (KeyCode::KeyR, 'r'),
        (KeyCode::KeyS, 's'),
        (KeyCode::KeyT, 't'),
        (KeyCode::KeyU, 'u'),
        (KeyCode::KeyV, 'v'),
        (KeyCode::KeyW, 'w'),
        (KeyCode::KeyX, 'x'),
        (KeyCode::KeyY, 'y'),
        (KeyCode::KeyZ, 'z'),
        (KeyCode::Digit0, '0'),
        (KeyCode::Digit1, '1'),
        (KeyCode::Digit2, '2'),
        (KeyCode::Digit3, '3'),
        (KeyCode::Digit4, '4'),
        (KeyCode::Digit5, '5'),
        (KeyCode::Digit6, '6'),
        (KeyCode::Digit7, '7'),
        (KeyCode::Digit8, '8'),
        (KeyCode::Digit9, '9'),
        (KeyCode::Minus, '-'),
        (KeyCode::Equal, '='),
        (KeyCode::BracketLeft, '['),
        (KeyCode::BracketRight, ']'),
        (KeyCode::Backquote, '`'),
        (KeyCode::Slash, '/'),
        (KeyCode::Semicolon, ';'),
        (KeyCode::Quote, '\''),
        (KeyCode::Comma, ','),
        (KeyCode::Period, '.'),
        (KeyCode::Backslash, '\\'),
    ];
    PLACES
        .iter()
        .find(|(known, _)| *known == code)
        .map(|(_, character)| Key::Char(*character))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::viewer::{ExportCommand, WindowCommand, commands};

    fn command(logical_key: &LogicalKey, code: KeyCode, held: ModifiersState) -> Option<Command> {
        commands::for_key(&KeyPress {
            logical: logical(logical_key),
            physical: place(code),
            modifiers: modifiers(held),
        })
    }

    #[test]
    fn keys_of_other_layouts() {
        let character = |text: &str| LogicalKey::Character(text.into());
        let none = ModifiersState::empty();
        let azerty_digit = command(&character("&"), KeyCode::Digit1, none);
        assert_eq!(
            azerty_digit,
            Some(Command::Scenes(SceneCommand::Show(0))),
            "AZERTY makes & where 1 is"
        );
        let qwertz_equals = command(&character("="), KeyCode::Digit0, ModifiersState::SHIFT);
        assert_eq!(
            qwertz_equals,
            Command::step("sample-rate", 1.0),
            "QWERTZ makes = with Shift and 0"
        );
        let swedish_backtick = command(&LogicalKey::Dead(Some('`')), KeyCode::Equal, ModifiersState::SHIFT);
        assert!(
            matches!(swedish_backtick, Some(Command::Window(WindowCommand::OverlayText(_)))),
            "a dead key: {swedish_backtick:?}"
        );
        let capital = command(
            &character("S"),
            KeyCode::KeyS,
            ModifiersState::SHIFT | ModifiersState::CONTROL,
        );
        assert_eq!(
            capital,
            Some(Command::Export(ExportCommand::WindowScreenshot)),
            "Shift makes a capital"
        );
        assert_eq!(
            logical(&LogicalKey::Named(NamedKey::F5)),
            Some(Key::F(5)),
            "a function key"
        );
    }

    #[test]
    fn keys_that_repeat() {
        assert!(repeats(&Command::Inspector(InspectorCommand::Nudge([1, 0]))), "a step");
        assert!(
            !repeats(&Command::Export(ExportCommand::Screenshot)),
            "a held S saves one picture"
        );
    }
}
