//! The one table of commands: name, keys, help line, action. Key handling, help, palette, menus, tool tips, scripts
//! and the README's key table all read it.

use std::sync::LazyLock;

use crate::viewer::command::Command;
use crate::viewer::command::arguments::Argument;
use crate::viewer::command::spec::{Action, CommandSpec, Group};
use crate::viewer::command::table;
use crate::viewer::key_chords::{Chord, KeyPress};
use crate::viewer::settings::picture;
use crate::viewer::settings::picture::{About, PictureSetting};

/// A gesture of the mouse, for help and the README.
#[derive(Clone, Copy, Debug)]
pub struct Gesture {
    /// What the hand does.
    pub gesture: &'static str,
    /// What happens: one sentence without a full stop.
    pub help: &'static str,
}

/// The whole table, in the order of help and menus: each heading's own lines, and those of the picture settings.
pub fn all() -> &'static [CommandSpec] {
    static ALL: LazyLock<Vec<CommandSpec>> = LazyLock::new(|| {
        let of_settings: Vec<CommandSpec> = picture::all().flat_map(of_setting).collect();
        let mut all = Vec::new();
        for group in Group::ALL {
            let own = table::of(group).iter().copied();
            let settings = of_settings.iter().filter(|spec| spec.group == group).copied();
            if group == Group::Sampling {
                all.extend(settings.chain(own));
            } else {
                all.extend(own.chain(settings));
            }
        }
        all
    });
    &ALL
}

/// The lines of a setting.
fn of_setting(setting: &'static PictureSetting) -> impl Iterator<Item = CommandSpec> {
    let group = match setting.about {
        About::Samples => Group::Sampling,
        About::Textures => Group::Textures,
        About::Document => Group::Scenes,
    };
    setting.commands.iter().map(move |command| CommandSpec {
        id: command.id,
        name: command.name,
        help: command.help,
        more: command.more,
        sought_as: &[],
        group,
        keys: command.keys,
        action: command
            .step
            .map_or(Action::NeedsArgument, |by| Action::Step(setting, by)),
        argument: command.takes_value.then_some(Argument::Value(setting)),
    })
}

/// The command called `id`.
pub fn find(id: &str) -> Option<&'static CommandSpec> {
    // The option of a command line and its command are one setting.
    let id = if id == "sample-rate" { "rate" } else { id };
    all().iter().find(|spec| spec.id == id)
}

/// What a press of a key asks for: the layout's character decides first, the key's place second.
pub fn for_key(press: &KeyPress) -> Option<Command> {
    let search = |matches: fn(&Chord, &KeyPress) -> bool| {
        all().iter().find_map(|spec| {
            let at = spec.keys.iter().position(|chord| matches(chord, press))?;
            spec.command_of_key(at)
        })
    };
    search(Chord::matches_logical).or_else(|| search(Chord::matches_place))
}

/// The command of a key by the name that help has for it, such as `Shift+D`, and what the key runs.
pub fn of_key_name(name: &str) -> Option<(&'static CommandSpec, Command)> {
    all().iter().find_map(|spec| {
        let at = spec.keys.iter().position(|chord| chord.to_string() == name)?;
        Some((spec, spec.command_of_key(at)?))
    })
}

/// The table of keys and gestures as Markdown, as it stands in the README.
pub fn markdown() -> String {
    use std::fmt::Write as _;

    let mut text = String::new();
    for group in Group::ALL {
        let lines = all().iter().filter(|spec| spec.group == group && !spec.keys.is_empty());
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
        help: "Moves the picture with the pointer; on the inspector moves that to another corner; draws the line of an open edge profile",
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
        help: "Opens their scenes; of a saved picture its scene, view and settings. Not under Wayland: Ctrl+O opens files there",
    },
];

#[cfg(test)]
mod tests {
    use super::*;
    use crate::viewer::Modifiers;
    use crate::viewer::key_chords::Key;

    #[test]
    fn table_is_consistent() {
        let mut ids: Vec<&str> = all().iter().map(|spec| spec.id).collect();
        ids.sort_unstable();
        let count = ids.len();
        ids.dedup();
        assert_eq!(ids.len(), count, "every id stands once");
        for spec in all() {
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
        let chords: Vec<&Chord> = all().iter().flat_map(|spec| spec.keys).collect();
        for (i, chord) in chords.iter().enumerate() {
            let twice = chords[..i]
                .iter()
                .any(|other| (other.key, other.modifiers) == (chord.key, chord.modifiers));
            assert!(!twice, "{chord} stands twice");
        }
    }

    #[test]
    fn keys_find_their_commands() {
        for spec in all() {
            for (at, chord) in spec.keys.iter().enumerate() {
                let expected = spec.command_of_key(at);
                assert!(expected.is_some(), "{} has a key and something to do", spec.id);
                let by_character = KeyPress::logical(chord.key, chord.modifiers);
                assert_eq!(for_key(&by_character), expected, "{chord} by its character");
                if let Some((physical, modifiers)) = chord.place {
                    let by_place = KeyPress {
                        logical: None,
                        physical: Some(physical),
                        modifiers,
                    };
                    assert_eq!(for_key(&by_place), expected, "{chord} by its place");
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
        for spec in all().iter().filter(|spec| !spec.keys.is_empty()) {
            assert!(text.contains(spec.help), "{}", spec.id);
        }
        assert!(text.contains("| `1-9` |") && text.contains("| `` ` `` |"), "{text}");
    }
}
