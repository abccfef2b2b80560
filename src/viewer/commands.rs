//! The one table of commands: name, keys, help line, action. Key handling, help, palette, menus, tool tips, scripts
//! and the README's key table all read it.

use super::Command;
use super::command_table::TABLE;
use super::key::{Chord, Key, KeyPress};
use super::typed::Argument;

/// One line of the table.
#[derive(Clone, Copy, Debug)]
pub struct CommandSpec {
    /// The word in scripts and in the palette.
    pub id: &'static str,
    /// The name in menus and in the palette.
    pub name: &'static str,
    /// What it does, for help and tool tips: one sentence without a full stop.
    pub help: &'static str,
    /// What else a tool tip says: one sentence without a full stop, or nothing.
    pub more: &'static str,
    /// Under which heading it stands.
    pub group: Group,
    /// Its keys.
    pub keys: &'static [Chord],
    /// What it does without an argument.
    pub action: Action,
    /// What may follow the word in scripts and in the palette.
    pub argument: Option<Argument>,
}

/// The headings of help and menus, in their order.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Group {
    /// Pan, zoom, rotate.
    View,
    /// How samples become pixels.
    Sampling,
    /// A against B.
    Compare,
    /// Which document.
    Scenes,
    /// The microscope.
    Inspector,
    /// Pictures and text that leave the program.
    Save,
    /// Panels, help, quitting.
    Window,
}

/// What a command does when it is chosen without an argument.
#[derive(Clone, Copy, Debug)]
pub enum Action {
    /// This.
    Run(&'static Command),
    /// One of these for each of its keys, in their order.
    PerKey(&'static [Command]),
    /// Nothing: it needs its argument.
    NeedsArgument,
}

/// A gesture of the mouse, for help and the README.
#[derive(Clone, Copy, Debug)]
pub struct Gesture {
    /// What the hand does.
    pub gesture: &'static str,
    /// What happens: one sentence without a full stop.
    pub help: &'static str,
}

impl Group {
    /// Every heading, in the order of help and menus.
    pub const ALL: [Self; 7] = [
        Self::View,
        Self::Sampling,
        Self::Compare,
        Self::Scenes,
        Self::Inspector,
        Self::Save,
        Self::Window,
    ];

    /// The heading's text.
    pub const fn name(self) -> &'static str {
        match self {
            Self::View => "View",
            Self::Sampling => "Sampling",
            Self::Compare => "A against B",
            Self::Scenes => "Scenes",
            Self::Inspector => "Pixel inspector",
            Self::Save => "Save and copy",
            Self::Window => "Window",
        }
    }
}

impl CommandSpec {
    /// Help and whatever else there is to say, with full stops where it is more than one sentence; then the keys.
    pub fn tip(&self) -> String {
        let text = match self.more {
            "" => self.help.to_owned(),
            more => format!("{}. {more}.", self.help),
        };
        match self.keys_text() {
            keys if keys.is_empty() => text,
            keys => format!("{text} ({keys})"),
        }
    }

    /// The command without an argument; `None` where it needs one or depends on the key.
    pub fn command(&self) -> Option<&'static Command> {
        match self.action {
            Action::Run(command) => Some(command),
            Action::PerKey(_) | Action::NeedsArgument => None,
        }
    }

    /// The keys as one text, such as `Ctrl+R, F5`; empty without keys. A run of digits is shortened to `1-9`, the four
    /// arrows to `Shift+arrows`.
    pub fn keys_text(&self) -> String {
        let digit = |chord: &Chord| matches!(chord.key, Key::Char(c) if c.is_ascii_digit());
        if let [first, .., last] = self.keys
            && self.keys.iter().all(digit)
        {
            return format!("{first}-{last}");
        }
        let arrows = [Key::Left, Key::Right, Key::Up, Key::Down];
        if let [first, ..] = self.keys
            && self.keys.iter().map(|chord| chord.key).eq(arrows)
        {
            return first.to_string().replace("Left", "arrows");
        }
        let names: Vec<String> = self.keys.iter().map(ToString::to_string).collect();
        names.join(", ")
    }
}

/// The whole table, in the order of help and menus.
pub fn all() -> &'static [CommandSpec] {
    TABLE
}

/// The command called `id`.
pub fn find(id: &str) -> Option<&'static CommandSpec> {
    TABLE.iter().find(|spec| spec.id == id)
}

/// What a press of a key asks for: the layout's character decides first, the key's place second.
pub fn for_key(press: &KeyPress) -> Option<&'static Command> {
    let search = |matches: fn(&Chord, &KeyPress) -> bool| {
        TABLE.iter().find_map(|spec| {
            let at = spec.keys.iter().position(|chord| matches(chord, press))?;
            match spec.action {
                Action::Run(command) => Some(command),
                Action::PerKey(commands) => commands.get(at),
                Action::NeedsArgument => None,
            }
        })
    };
    search(Chord::matches_logical).or_else(|| search(Chord::matches_place))
}

/// The table of keys and gestures as Markdown, as it stands in the README.
pub fn markdown() -> String {
    use std::fmt::Write as _;

    let mut text = String::new();
    for group in Group::ALL {
        let lines = TABLE.iter().filter(|spec| spec.group == group && !spec.keys.is_empty());
        // Writing to a `String` cannot fail.
        let _ = writeln!(text, "| {} | |\n|---|---|", group.name());
        for spec in lines {
            let keys: Vec<String> = spec.keys_text().split(", ").map(markdown_key).collect();
            let _ = writeln!(text, "| {} | {} |", keys.join(", "), spec.help);
        }
        text.push('\n');
    }
    text.push_str("| Mouse | |\n|---|---|\n");
    for Gesture { gesture, help } in GESTURES {
        let _ = writeln!(text, "| {gesture} | {help} |");
    }
    text
}

/// A key as Markdown code; the backtick needs a longer fence.
fn markdown_key(key: &str) -> String {
    if key.contains('`') {
        format!("`` {key} ``")
    } else {
        format!("`{key}`")
    }
}

/// What the mouse does.
pub const GESTURES: &[Gesture] = &[
    Gesture {
        gesture: "drag",
        help: "Moves the picture with the pointer",
    },
    Gesture {
        gesture: "wheel, pinch",
        help: "Zooms about the pointer; over the pinned inspector changes its magnification",
    },
    Gesture {
        gesture: "right click",
        help: "Pins the pixel under the pointer and tells why it has its colour; again, unpins it",
    },
    Gesture {
        gesture: "drop files or folders",
        help: "Opens their scenes; of a saved picture its scene, view and settings",
    },
];

#[cfg(test)]
mod tests {
    use super::*;
    use crate::viewer::Modifiers;

    #[test]
    fn table_is_consistent() {
        let mut ids: Vec<&str> = TABLE.iter().map(|spec| spec.id).collect();
        ids.sort_unstable();
        let count = ids.len();
        ids.dedup();
        assert_eq!(ids.len(), count, "every id stands once");
        for spec in TABLE {
            if let Action::PerKey(commands) = spec.action {
                assert_eq!(commands.len(), spec.keys.len(), "{}: a command for each key", spec.id);
            }
            let reachable = !matches!(spec.action, Action::NeedsArgument) || spec.argument.is_some();
            assert!(reachable, "{} can be run", spec.id);
            assert!(
                !spec.help.is_empty() && !spec.help.ends_with('.'),
                "{}: {}",
                spec.id,
                spec.help
            );
        }
    }

    #[test]
    fn table_has_no_key_twice() {
        let chords: Vec<&Chord> = TABLE.iter().flat_map(|spec| spec.keys).collect();
        for (i, chord) in chords.iter().enumerate() {
            let twice = chords[..i]
                .iter()
                .any(|other| (other.key, other.modifiers) == (chord.key, chord.modifiers));
            assert!(!twice, "{chord} stands twice");
        }
    }

    #[test]
    fn keys_find_their_commands() {
        for spec in TABLE {
            for (at, chord) in spec.keys.iter().enumerate() {
                let expected = match spec.action {
                    Action::Run(command) => command,
                    Action::PerKey(commands) => &commands[at],
                    Action::NeedsArgument => panic!("{} has a key and nothing to do", spec.id),
                };
                let by_character = KeyPress::logical(chord.key, chord.modifiers);
                assert_eq!(for_key(&by_character), Some(expected), "{chord} by its character");
                if let Some((physical, modifiers)) = chord.place {
                    let by_place = KeyPress {
                        logical: None,
                        physical: Some(physical),
                        modifiers,
                    };
                    assert_eq!(for_key(&by_place), Some(expected), "{chord} by its place");
                }
            }
        }
        let none = KeyPress::logical(Key::Char('z'), Modifiers::ALT);
        assert_eq!(for_key(&none), None, "Alt+Z is nothing");
    }

    #[test]
    fn the_courses_keys_stay() {
        for key in ["Space", "-", "=", "z", "p", "l", "s", "1", "9", "`", "Esc"] {
            let press = KeyPress::from_name(key).expect(key);
            assert!(for_key(&press).is_some(), "{key} does something");
        }
    }

    #[test]
    fn markdown_holds_every_key() {
        let text = markdown();
        for spec in TABLE.iter().filter(|spec| !spec.keys.is_empty()) {
            assert!(text.contains(spec.help), "{}", spec.id);
        }
        assert!(text.contains("| `1-9` |") && text.contains("| `` ` `` |"), "{text}");
    }
}
