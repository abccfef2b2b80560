//! Text to steps. Every mistake is told with line, column and cure.

use std::fmt;
use std::path::PathBuf;
use std::time::Duration;

use glam::DVec2;

use crate::plain;
use crate::raster::Framebuffer;
use crate::viewer::commands;
use crate::viewer::settings::values::{path, point};
use crate::viewer::{Command, KeyPress, PointerButton};

/// Longest wait in one step.
const MAX_WAIT: Duration = Duration::from_mins(1);
/// Longest message, in characters.
const LONGEST_MESSAGE: usize = 400;
/// The words besides the commands of the table, with their forms.
const WORDS: &str = "key, type, move, leave, click, right-click, drag, wheel, resize, wait, shot";

/// A list of steps.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Script {
    /// In the order in which they are played.
    pub steps: Vec<ScriptStep>,
}

/// A step and where it stands in the script.
#[derive(Clone, Debug, PartialEq)]
pub struct ScriptStep {
    /// Line, from 1.
    pub line: u32,
    /// Column in characters, from 1.
    pub column: u32,
    /// What to do.
    pub step: Step,
}

impl ScriptStep {
    /// What is wrong here, in the script called `name`.
    pub(super) fn error(&self, name: &str, message: String) -> ScriptError {
        ScriptError {
            name: name.to_owned(),
            line: self.line,
            column: self.column,
            message,
        }
    }
}

/// What a user does.
#[derive(Clone, Debug, PartialEq)]
pub enum Step {
    /// Presses and releases a key.
    Key(KeyPress),
    /// Types into what has the keyboard.
    Type(String),
    /// Moves the pointer to a window pixel.
    Move(DVec2),
    /// Takes the pointer out of the window.
    Leave,
    /// Moves the pointer and clicks.
    Click {
        /// Window pixel.
        at: DVec2,
        /// Which button.
        button: PointerButton,
    },
    /// Presses the primary button, moves and releases it.
    Drag {
        /// Window pixel where the button goes down.
        from: DVec2,
        /// Window pixel where it goes up.
        to: DVec2,
    },
    /// Turns the wheel.
    Wheel {
        /// Up is above zero.
        clicks: f64,
        /// Window pixel to move the pointer to first.
        at: Option<DVec2>,
    },
    /// Gives the window another size, in device pixels.
    Resize([u32; 2]),
    /// Lets time pass, or waits until the picture is finished.
    Wait(Option<Duration>),
    /// Saves a picture of the whole window.
    Shot(PathBuf),
    /// A command of the table.
    Run(Command),
}

/// What is wrong with a script, or went wrong while it was played. Displays as `NAME:LINE:COLUMN: ...`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ScriptError {
    /// The script's name: its file, or `--do`.
    pub name: String,
    /// Line, from 1.
    pub line: u32,
    /// Column in characters, from 1.
    pub column: u32,
    /// What, and the cure.
    pub message: String,
}

impl fmt::Display for ScriptError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self {
            name,
            line,
            column,
            message,
        } = self;
        write!(f, "{name}:{line}:{column}: {message}")
    }
}

impl std::error::Error for ScriptError {}

impl Script {
    /// Reads the script `text`, called `name` in messages.
    ///
    /// # Errors
    /// For the first step that is not understood.
    pub fn parse(text: &str, name: &str) -> Result<Self, ScriptError> {
        let mut steps = Vec::new();
        for piece in split(text) {
            let error = |message: String| ScriptError {
                name: name.to_owned(),
                line: piece.line,
                column: piece.column,
                // It quotes the step, which may be long and hold anything.
                message: plain::short_line(&message, LONGEST_MESSAGE),
            };
            if piece.is_open {
                return Err(error("the quote is not closed; end the text with \"".to_owned()));
            }
            let step = parse_step(&piece.text).map_err(error)?;
            steps.push(ScriptStep {
                line: piece.line,
                column: piece.column,
                step,
            });
        }
        Ok(Self { steps })
    }
}

/// The text of one step.
struct Piece {
    text: String,
    line: u32,
    column: u32,
    /// Whether it ends inside a quote.
    is_open: bool,
}

/// Cuts a script into its steps, without blanks around them, empty steps and comments.
fn split(text: &str) -> Vec<Piece> {
    let mut pieces = Vec::new();
    let mut piece: Option<Piece> = None;
    let (mut line, mut column) = (1, 0);
    let mut in_comment = false;
    for character in text.chars() {
        column += 1;
        let quoted = piece.as_ref().is_some_and(|piece| piece.is_open);
        let ends = !quoted && (character == '\n' || (character == ';' && !in_comment));
        if ends {
            pieces.extend(piece.take());
        } else if let Some(piece) = &mut piece {
            piece.text.push(character);
            piece.is_open ^= character == '"';
        } else if !in_comment && !character.is_whitespace() && character != '\u{feff}' {
            in_comment = character == '#';
            piece = (!in_comment).then(|| Piece {
                text: character.to_string(),
                line,
                column,
                is_open: character == '"',
            });
        }
        if character == '\n' {
            (line, column, in_comment) = (line + 1, 0, false);
        }
    }
    pieces.extend(piece);
    pieces
}

/// One step: a word and what follows it.
fn parse_step(text: &str) -> Result<Step, String> {
    let text = text.trim();
    let (word, rest) = text.split_once(char::is_whitespace).unwrap_or((text, ""));
    let rest = unquoted(rest.trim());
    let form = |usage: &str| format!("\"{rest}\" does not fit {word}; write {word} {usage}");
    match word {
        "key" => parse_key(rest).map(Step::Key),
        "type" => Ok(Step::Type(rest.to_owned())),
        "move" => point(rest).map(Step::Move).ok_or_else(|| form("X,Y")),
        "leave" if rest.is_empty() => Ok(Step::Leave),
        "leave" => Err("leave stands alone".to_owned()),
        "click" => click(rest, PointerButton::Primary).ok_or_else(|| form("X,Y")),
        "right-click" => click(rest, PointerButton::Secondary).ok_or_else(|| form("X,Y")),
        "drag" => drag(rest).ok_or_else(|| form("X,Y X,Y")),
        "wheel" => wheel(rest).ok_or_else(|| form("CLICKS, or CLICKS X,Y")),
        "resize" => size(rest)
            .map(Step::Resize)
            .ok_or_else(|| form(&format!("WxH in pixels, from 1 to {} each", Framebuffer::MAX_SIDE))),
        "wait" => wait(rest).ok_or_else(|| form("MILLISECONDS up to 60000, or nothing")),
        "shot" if rest.is_empty() => Err("a picture needs a name; write shot FILE.png".to_owned()),
        "shot" => Ok(Step::Shot(path(rest))),
        _ => parse_command(word, rest).map(Step::Run),
    }
}

/// What stands in the quotes, where all of `text` is quoted.
fn unquoted(text: &str) -> &str {
    let inner = text.strip_prefix('"').and_then(|text| text.strip_suffix('"'));
    inner.filter(|inner| !inner.contains('"')).unwrap_or(text)
}

fn parse_key(name: &str) -> Result<KeyPress, String> {
    KeyPress::from_name(name)
        .ok_or_else(|| format!("\"{name}\" is not a key; write one such as =, Ctrl+Shift+S, PageUp or F5"))
}

fn parse_command(word: &str, rest: &str) -> Result<Command, String> {
    let Some(spec) = commands::find(word) else {
        return Err(format!(
            "\"{word}\" is not a step; write {WORDS}, or the name of a command such as rate, pin or reset-view"
        ));
    };
    if rest.is_empty()
        && let Some(command) = spec.command()
    {
        return Ok(command);
    }
    match spec.argument {
        // What names the form is its cure; what is wrong with a file has one of its own.
        Some(argument) => argument.parse(rest).map_err(|problem| {
            if problem.ends_with(argument.usage().as_ref()) {
                format!("{problem}; write that behind {word}")
            } else {
                problem
            }
        }),
        None => Err(format!("{word} takes nothing here; write it alone, or press its key")),
    }
}

fn click(text: &str, button: PointerButton) -> Option<Step> {
    Some(Step::Click {
        at: point(text)?,
        button,
    })
}

fn drag(text: &str) -> Option<Step> {
    let (from, to) = text.split_once(char::is_whitespace)?;
    Some(Step::Drag {
        from: point(from)?,
        to: point(to)?,
    })
}

fn wheel(text: &str) -> Option<Step> {
    let (clicks, at) = match text.split_once(char::is_whitespace) {
        Some((clicks, at)) => (clicks, Some(point(at)?)),
        None => (text, None),
    };
    let clicks = clicks.parse().ok().filter(|clicks: &f64| clicks.is_finite())?;
    Some(Step::Wheel { clicks, at })
}

fn size(text: &str) -> Option<[u32; 2]> {
    let (width, height) = text.split_once('x')?;
    let fits = |side: &u32| (1..=Framebuffer::MAX_SIDE).contains(side);
    let side = |text: &str| text.trim().parse().ok().filter(fits);
    Some([side(width)?, side(height)?])
}

fn wait(text: &str) -> Option<Step> {
    if text.is_empty() {
        return Some(Step::Wait(None));
    }
    let time = Duration::from_millis(text.parse().ok()?);
    (time <= MAX_WAIT).then_some(Step::Wait(Some(time)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::viewer::Key;
    use crate::viewer::{BUILT_IN, InspectorCommand, LessonCommand, LessonSource};

    fn steps(text: &str) -> Vec<Step> {
        let script = Script::parse(text, "test").unwrap_or_else(|error| panic!("{error}"));
        script.steps.into_iter().map(|step| step.step).collect()
    }

    #[test]
    fn script_steps() {
        let parsed = steps("key =; pin 512,300; key z; shot out.png");
        assert_eq!(parsed.len(), 4, "{parsed:?}");
        assert_eq!(
            parsed[1],
            Step::Run(Command::Inspector(InspectorCommand::Pin([512, 300]))),
            "a command with its argument"
        );
        assert!(
            matches!(&parsed[0], Step::Key(press) if press.logical == Some(Key::Char('='))),
            "{parsed:?}"
        );
        let text =
            "# all of it\n\n drag 1,2 3,4 # 5\nwheel -2 7,8;wait;wait 20 ;; leave\nshot \"a; b.png\"\r\nresize 800x600";
        let error = Script::parse(text, "test").expect_err("a comment is no point");
        assert_eq!((error.line, error.column), (3, 2), "{error}");
        let parsed = steps(&text.replace(" # 5", ""));
        assert_eq!(parsed.len(), 7, "{parsed:?}");
        assert_eq!(parsed[5], Step::Shot("a; b.png".into()), "quoted");
        assert_eq!(parsed[3], Step::Wait(Some(Duration::from_millis(20))), "milliseconds");
    }

    #[test]
    fn script_opens_lessons_by_name() {
        for (index, (name, _)) in BUILT_IN.iter().enumerate() {
            let opened = Step::Run(Command::Lesson(LessonCommand::Open(LessonSource::BuiltIn(index))));
            for text in [format!("lesson {name}"), format!("lesson lesson:{name}")] {
                assert_eq!(steps(&text), std::slice::from_ref(&opened), "{text}");
            }
            let error = Script::parse("lesson seven-tasks", "s").expect_err("there is none");
            assert!(error.to_string().contains(name), "{error}");
        }
    }

    #[test]
    fn script_errors_name_place_and_cure() {
        for (text, line, column, cure) in [
            ("key =\n  kye z", 2, 3, "write key"),
            ("key nothing", 1, 1, "PageUp"),
            ("rate 257", 1, 1, "from 1 to 256"),
            ("rate", 1, 1, "from 1 to 256"),
            ("reset-view 3", 1, 1, "alone"),
            ("é; pin a,b", 1, 1, "write key"),
            ("key é; pin a,b", 1, 8, "whole pixels"),
            ("shot", 1, 1, "FILE.png"),
            ("shot \"x", 1, 1, "end the text"),
            ("resize 99999x1", 1, 1, "16384"),
            ("resize 0x300", 1, 1, "from 1"),
            ("wait 99999999999999999999", 1, 1, "60000"),
            ("wheel nan", 1, 1, "CLICKS"),
        ] {
            let error = Script::parse(text, "s").expect_err(text);
            assert_eq!((error.line, error.column), (line, column), "{error}");
            assert!(error.to_string().contains(cure), "{error} does not say {cure}");
        }
    }

    #[test]
    fn script_never_panics() {
        arbtest::arbtest(|u| {
            let words = [
                "key", "pin", "drag", "wheel", "shot", ";", "\n", "#", "\"", " ", ",", "-1", "é", "x", "+", "type",
            ];
            let mut text = String::new();
            for _ in 0..u.int_in_range(0..=20)? {
                text.push_str(u.choose(&words)?);
            }
            let _ = Script::parse(&text, "any");
            Ok(())
        })
        .budget_ms(300);
    }

    #[test]
    fn script_can_name_every_command() {
        for spec in commands::all() {
            let alone = parse_command(spec.id, "");
            assert_eq!(alone.ok(), spec.command(), "{} alone", spec.id);
        }
    }
}
