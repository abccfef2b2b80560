//! Signals: Ctrl+C ends a command between files, and a limit of a file's size is an error like a full disk.

use std::process::exit;
use std::sync::{Arc, Mutex, PoisonError};

use super::failure::print_error;
use super::progress;
use crate::figure::writing;
use crate::render::CancelToken;

/// What the next Ctrl+C cancels, instead of ending the program.
static AWAITED: Mutex<Option<Arc<CancelToken>>> = Mutex::new(None);

/// Begins to listen.
pub(super) fn listen() {
    // Where the system has no thread for it, nothing else starts either, and that is told.
    let _ = ctrlc::set_handler(stop);
    #[cfg(unix)]
    {
        // Without a handler the signal ends the program before the error can be told.
        let flag = Arc::default();
        let _ = signal_hook::flag::register(signal_hook::consts::SIGXFSZ, flag);
    }
}

/// A token that the first Ctrl+C from now on cancels, for a command that has something to save then. The second ends the
/// program.
pub(super) fn token() -> Arc<CancelToken> {
    let token = Arc::new(CancelToken::default());
    *AWAITED.lock().unwrap_or_else(PoisonError::into_inner) = Some(Arc::clone(&token));
    token
}

/// Ends the program as shells expect of what was interrupted, once no file is half-written.
#[expect(
    clippy::disallowed_methods,
    reason = "what is being drawn or read cannot be left in another way"
)]
fn stop() {
    let awaited = AWAITED.lock().unwrap_or_else(PoisonError::into_inner).take();
    if let Some(token) = awaited {
        token.cancel();
        return;
    }
    // Never let go: no other file is begun.
    let _writing = writing();
    progress::clear();
    print_error("stopped by Ctrl+C; every file that was written is whole");
    exit(130)
}
