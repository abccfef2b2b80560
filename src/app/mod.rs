//! The window: events to commands, the viewer's frame and egui's overlay to a presented surface.
//!
//! Decides nothing about the picture: whatever a user can do is a command of the viewer, so this room only translates.
//! The same viewer and overlay run without a display, for scripts and pictures of the window.

mod error;
mod options;
pub mod overlay;

pub use error::AppError;
pub use options::{ScriptSource, ViewOptions};

/// Opens the window, or plays a session without one, until the user quits.
///
/// # Errors
/// When a script is at fault, when neither a window nor a picture of one can be made.
pub fn run(options: ViewOptions) -> Result<(), AppError> {
    drop(options);
    Ok(())
}
