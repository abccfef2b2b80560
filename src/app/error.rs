//! Why a session could not run.

use std::path::PathBuf;

use crate::viewer::script::ScriptError;

/// What ends a session early. Each message is one line that says what to do.
#[derive(Debug, thiserror::Error)]
pub enum AppError {
    /// The script cannot be read or is at fault: the user's input (exit status 2).
    #[error("{0}")]
    Script(String),
    /// Steps of a script made something go wrong, at least one: the user's input.
    #[error("{}", .0.iter().map(ToString::to_string).collect::<Vec<_>>().join("; "))]
    Steps(Vec<ScriptError>),
    /// A session without a window met a scene that cannot be read or a picture that cannot be saved: the user's input.
    #[error("{0}")]
    Input(String),
    /// A file could not be written.
    #[error("{}: cannot write this picture: {cause}; choose another place", path.display())]
    Write {
        /// Which.
        path: PathBuf,
        /// Why.
        cause: std::io::Error,
    },
    /// The system gave no threads.
    #[error("cannot start: the system gives no threads: {0}; close other programs")]
    Threads(#[source] std::io::Error),
    /// The window could not be opened or drawn.
    #[error("{0}")]
    Window(String),
    /// The system asked the program to end, and what was to be remembered is.
    #[error("ended by the system")]
    Ended,
}

impl AppError {
    /// Whether the user's input is at fault rather than the system.
    pub fn is_input(&self) -> bool {
        matches!(self, Self::Script(_) | Self::Steps(_) | Self::Input(_))
    }
}
