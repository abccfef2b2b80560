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

pub use error::AppError;
pub use options::{ScriptSource, ViewOptions};

/// Opens the window, or plays a session without one, until the user quits. Where no display can be reached, the
/// window's first frame is saved as PNG instead. The answer is a line for the user, if there is anything to say.
///
/// # Errors
/// When a script is at fault, when neither a window nor a picture of one can be made.
pub fn run(options: &ViewOptions) -> Result<Option<String>, AppError> {
    if options.headless {
        headless::run(options)
    } else {
        window::run(options)
    }
}
