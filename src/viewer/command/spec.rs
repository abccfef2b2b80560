//! What a line of the command table tells, and the headings that its lines stand under.

use crate::viewer::command::Command;
use crate::viewer::command::arguments::Argument;
use crate::viewer::key_chords::{Chord, Key};
use crate::viewer::settings::picture::PictureSetting;

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
    /// Other words by which people look for it, in small letters; they are shown nowhere.
    pub sought_as: &'static [&'static str],
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
    /// How textures are read.
    Textures,
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
    /// Steps so far through the values of a setting.
    Step(&'static PictureSetting, f64),
    /// Nothing: it needs its argument.
    NeedsArgument,
}

impl Group {
    /// Every heading, in the order of help and menus.
    pub const ALL: [Self; 8] = [
        Self::View,
        Self::Sampling,
        Self::Textures,
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
            Self::Textures => "Textures",
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
    pub fn command(&self) -> Option<Command> {
        match self.action {
            Action::Run(command) => Some(command.clone()),
            Action::Step(setting, by) => Some(Command::Set(setting.step(by))),
            Action::PerKey(_) | Action::NeedsArgument => None,
        }
    }

    /// The command of one of its keys, counted from 0.
    pub fn command_of_key(&self, at: usize) -> Option<Command> {
        match self.action {
            Action::PerKey(commands) => commands.get(at).cloned(),
            _ => self.command(),
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

/// A line that needs its argument, until it is given something to run.
pub(super) const fn spec(id: &'static str, name: &'static str, help: &'static str, group: Group) -> CommandSpec {
    CommandSpec {
        id,
        name,
        help,
        more: "",
        sought_as: &[],
        group,
        keys: &[],
        action: Action::NeedsArgument,
        argument: None,
    }
}

impl CommandSpec {
    /// Pressed by these keys.
    pub(super) const fn keys(self, keys: &'static [Chord]) -> Self {
        Self { keys, ..self }
    }

    /// What else the tool tip says.
    pub(super) const fn more(self, more: &'static str) -> Self {
        Self { more, ..self }
    }

    /// Found by these words, too.
    pub(super) const fn sought_as(self, words: &'static [&'static str]) -> Self {
        Self {
            sought_as: words,
            ..self
        }
    }

    /// Runs this.
    pub(super) const fn run(self, command: &'static Command) -> Self {
        Self {
            action: Action::Run(command),
            ..self
        }
    }

    /// Runs another command for each key.
    pub(super) const fn per_key(self, commands: &'static [Command]) -> Self {
        Self {
            action: Action::PerKey(commands),
            ..self
        }
    }

    /// May be followed by this.
    pub(super) const fn argument(self, argument: Argument) -> Self {
        Self {
            argument: Some(argument),
            ..self
        }
    }
}
