//! The real window: winit's event loop, a softbuffer surface, no GPU.

#[cfg(target_os = "linux")]
mod desktop_scale;
#[cfg(target_os = "linux")]
mod desktop_theme;
mod frame_log;
mod handler;
mod icon;
mod last_session;
mod opened;
mod player;
mod remembered;
mod rhythm;
mod screen_reader;
mod startup;
mod wake;
mod watch;
mod whole_pixels;
mod winit_keys;
#[cfg(target_os = "linux")]
mod x11_scale;

use super::{AppError, ViewOptions, headless};
use handler::Handler;
use startup::NoWindow;
use wake::Wake;

/// Runs the window until it is closed. Without a display the session is played without one, and the line that comes
/// back says so.
///
/// # Errors
/// When a script is at fault, or neither a window nor its picture can be made.
pub(super) fn run(options: ViewOptions) -> Result<Option<String>, AppError> {
    let script = headless::read_script(&options)?;
    let event_loop = match startup::event_loop() {
        Ok(event_loop) => event_loop,
        Err(NoWindow::MissingLibrary(line)) => return Err(AppError::Window(line)),
        Err(NoWindow::NoDisplay(why)) => {
            let done = headless::run(&options)?.unwrap_or_else(|| "played the script without a window".to_owned());
            let cure = "for a window start it in a desktop session, through ssh -X, or under xvfb-run";
            return Ok(Some(format!("no display, since {why}: {done}; {cure}")));
        }
    };
    if let Some(await_end) = options.await_end {
        let proxy = event_loop.create_proxy();
        // The event loop may have ended already.
        await_end(Box::new(move || {
            let _ = proxy.send_event(Wake::End);
        }));
    }
    let mut handler = Handler::new(options, script, event_loop.create_proxy());
    let ended = event_loop.run_app(&mut handler);
    handler.remember();
    match handler.failure {
        Some(failure) => Err(failure),
        None => ended
            .map(|()| None)
            .map_err(|error| AppError::Window(format!("the display is gone: {error}"))),
    }
}
