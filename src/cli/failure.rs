//! What went wrong, as one line and an exit status.

use std::fmt::Display;
use std::process::ExitCode;

use super::progress;
use crate::plain;
use crate::scene::SceneError;

/// An end of the program other than success.
#[derive(Clone, Debug)]
pub(super) enum Failure {
    /// The input or the arguments are at fault.
    Input(String),
    /// Everything else.
    Other(String),
    /// Not a failure: a text that was asked for, such as the help.
    Text(String),
    /// A signal asked the program to end: what is said, and the exit status.
    Stopped {
        /// Which signal.
        line: String,
        /// 128 and the signal's number, as shells tell it.
        status: u8,
    },
    /// Not a failure either: pictures that were compared differ, which the exit status says.
    Different,
}

impl Failure {
    /// The user's file or argument is at fault: `what` names it, the place, the cause and the cure.
    pub(super) fn input(what: impl Display) -> Self {
        Self::Input(what.to_string())
    }

    /// Something else went wrong.
    pub(super) fn other(what: impl Display) -> Self {
        Self::Other(what.to_string())
    }

    /// A scene cannot be read: it is at fault, or there is too little memory.
    pub(super) fn of_scene(error: &SceneError) -> Self {
        if error.problem.is_of_memory() {
            Self::other(error)
        } else {
            Self::input(error)
        }
    }

    /// What it says, without its exit status.
    pub(super) fn into_line(self) -> String {
        match self {
            Self::Input(line) | Self::Other(line) | Self::Text(line) | Self::Stopped { line, .. } => line,
            Self::Different => String::new(),
        }
    }

    /// Prints it and gives the exit status.
    pub(super) fn report(&self) -> ExitCode {
        match self {
            Self::Input(line) => {
                print_error(line);
                ExitCode::from(2)
            }
            Self::Other(line) => {
                print_error(line);
                ExitCode::from(1)
            }
            Self::Stopped { line, status } => {
                print_error(line);
                ExitCode::from(*status)
            }
            Self::Different => ExitCode::from(1),
            Self::Text(text) => match print(text.trim_end()) {
                Ok(()) => ExitCode::SUCCESS,
                Err(failure) => failure.report(),
            },
        }
    }
}

/// Prints a line, or lines, on stdout. A reader that has gone away is no reason to fail.
///
/// Names in it must be lines already (see [`plain::line`]); what else could steer a terminal is escaped here.
pub(super) fn print(text: &str) -> Result<(), Failure> {
    print_raw(&plain::lines(text))
}

/// As [`print()`], of JSON.
pub(super) fn print_json(text: &str) -> Result<(), Failure> {
    print_raw(&plain::json(text))
}

fn print_raw(text: &str) -> Result<(), Failure> {
    use std::io::Write as _;
    progress::clear();
    let mut stdout = std::io::stdout().lock();
    match writeln!(stdout, "{text}").and_then(|()| stdout.flush()) {
        Err(error) if error.kind() != std::io::ErrorKind::BrokenPipe => Err(Failure::other(format!(
            "standard output: cannot write: {error}; send it elsewhere"
        ))),
        _ => Ok(()),
    }
}

/// Prints one line on stderr.
pub(super) fn print_error(line: &str) {
    use std::io::Write as _;
    let line = plain::short_line(line.trim_end(), plain::MAX_LINE);
    progress::aside(|| {
        let _ = writeln!(std::io::stderr().lock(), "rasterscope: {line}");
    });
}

/// What is wrong and how to find the cure, out of a message of several paragraphs about a command.
pub(super) fn one_line(message: &str, command: Option<&str>) -> String {
    let message = message.strip_prefix("error: ").unwrap_or(message);
    let usage = message.find("\n\nUsage:").unwrap_or(message.len());
    let hint = message.find("\n\nFor more information").unwrap_or(message.len());
    let words: Vec<&str> = message[..usage.min(hint)].split_whitespace().collect();
    let words = words.join(" ");
    // That an option may be meant as a path is said of every option that is not known, and is never so.
    let words = words.split(" tip: to pass ").next().unwrap_or("");
    let command = command.map_or_else(String::new, |command| format!("{command} "));
    format!(
        "{}; see `rasterscope {command}--help`",
        words.replace(" tip: ", "; tip: ")
    )
}
