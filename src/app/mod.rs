//! The window: events to commands, the viewer's frame and egui's overlay to a presented surface.
//!
//! Decides nothing about the picture: whatever a user can do is a command of the viewer, so this room only translates.
//! The same viewer and overlay run without a display, for scripts and pictures of the window.

mod error;
mod headless;
mod interface;
mod options;
pub mod overlay;
mod session;
mod window;

use std::io::Write as _;

pub use error::AppError;
pub use options::{AwaitEnd, ScriptSource, ViewOptions};

/// Opens the window, or plays a session without one, until the user quits. Where no display can be reached, the
/// window's first frame is saved as PNG instead, and a line on stdout says so.
///
/// # Errors
/// When a script is at fault, when neither a window nor a picture of one can be made.
pub fn run(options: ViewOptions) -> Result<(), AppError> {
    let line = if options.headless {
        headless::run(&options)?
    } else {
        window::run(options)?
    };
    if let Some(line) = line {
        // Whoever closed stdout does not want to read it.
        let _ = writeln!(std::io::stdout(), "{}", crate::plain::line(&line));
    }
    Ok(())
}
