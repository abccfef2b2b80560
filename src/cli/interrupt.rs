//! Signals: Ctrl+C ends a command between files, as do the end of the session and of the terminal; a limit of a file's size
//! is an error like a full disk, and memory that runs out one like any other.

use std::process::exit;
#[cfg(unix)]
use std::sync::atomic::AtomicBool;
use std::sync::atomic::{AtomicU8, Ordering};
use std::sync::{Arc, Mutex, PoisonError};

use super::failure::{Failure, print_error};
use super::progress;
use crate::figure::writing;
use crate::render::CancelToken;

/// What the next signal does, instead of ending the program.
static AWAITED: Mutex<Option<Box<dyn Fn() + Send>>> = Mutex::new(None);
/// The place of the last signal in the table below.
static LAST: AtomicU8 = AtomicU8::new(0);
/// Signals that ask the program to end: their numbers, and how people call them.
const SIGNALS: [(u8, &str); 3] = [(2, "Ctrl+C"), (15, "SIGTERM"), (1, "SIGHUP")];

/// What is left of work that nobody had to save.
const WHOLE: &str = "; every file that was written is whole";

/// Begins to listen.
pub(super) fn listen() {
    // Where the system has no thread for it, nothing else starts either, and that is told.
    let _ = ctrlc::set_handler(|| stop(0));
    #[cfg(unix)]
    {
        // Without a handler the signal ends the program before the error can be told.
        let flag = Arc::default();
        let _ = signal_hook::flag::register(signal_hook::consts::SIGXFSZ, flag);
        // An allocation that fails ends the program by SIGABRT, after the standard library said so. For whoever called it
        // that is a machine without room, as any other: status 1, and no core file.
        let always = Arc::new(AtomicBool::new(true));
        let _ = signal_hook::flag::register_conditional_shutdown(signal_hook::consts::SIGABRT, 1, always);
        for place in [1, 2] {
            let _ = unix::listen_to(place);
        }
    }
}

/// A token that the first signal from now on cancels, for a command that has something to save then. The second ends the
/// program.
pub(super) fn token() -> Arc<CancelToken> {
    let token = Arc::new(CancelToken::default());
    let cancelled = Arc::clone(&token);
    instead(Box::new(move || cancelled.cancel()));
    token
}

/// Does this at the first signal from now on. The second ends the program.
pub(super) fn instead(work: Box<dyn Fn() + Send>) {
    *AWAITED.lock().unwrap_or_else(PoisonError::into_inner) = Some(work);
}

/// The end that the last signal asked for.
#[cfg(feature = "window")]
pub(super) fn ended() -> Failure {
    ended_with(WHOLE)
}

/// The same; `what` goes on after "stopped by Ctrl+C".
pub(super) fn ended_with(what: &str) -> Failure {
    let (signal, name) = SIGNALS[usize::from(LAST.load(Ordering::Relaxed))];
    Failure::Stopped {
        line: line(name, what),
        status: 128 + signal,
    }
}

fn line(name: &str, what: &str) -> String {
    format!("stopped by {name}{what}")
}

/// Ends the program as shells expect of what was interrupted, once no file is half-written.
#[expect(
    clippy::disallowed_methods,
    reason = "what is being drawn or read cannot be left in another way"
)]
fn stop(place: u8) {
    LAST.store(place, Ordering::Relaxed);
    let awaited = AWAITED.lock().unwrap_or_else(PoisonError::into_inner).take();
    if let Some(work) = awaited {
        return work();
    }
    let (signal, name) = SIGNALS[usize::from(place)];
    // Never let go: no other file is begun.
    let _writing = writing();
    progress::clear();
    print_error(&line(name, WHOLE));
    exit(128 + i32::from(signal))
}

#[cfg(unix)]
mod unix {
    use std::io::{self, Read as _};
    use std::os::unix::net::UnixStream;
    use std::thread;

    use super::{SIGNALS, stop};

    /// Stops the program by the signal at this place of the table, from a thread that waits for it; unless it is ignored, as
    /// `nohup` has it.
    pub(super) fn listen_to(place: u8) -> io::Result<()> {
        let (signal, name) = SIGNALS[usize::from(place)];
        if is_ignored(signal) {
            return Ok(());
        }
        let (mut told, tell) = UnixStream::pair()?;
        signal_hook::low_level::pipe::register(signal.into(), tell)?;
        let wait = move || {
            while told.read_exact(&mut [0]).is_ok() {
                stop(place);
            }
        };
        thread::Builder::new().name(name.to_owned()).spawn(wait).map(drop)
    }

    /// Whether whoever started the program wants it to ignore a signal; Linux tells that.
    fn is_ignored(signal: u8) -> bool {
        let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
        let ignored = status.lines().find_map(|line| line.strip_prefix("SigIgn:"));
        let ignored = ignored.and_then(|mask| u64::from_str_radix(mask.trim(), 16).ok());
        ignored.is_some_and(|mask| mask >> (signal - 1) & 1 == 1)
    }
}

#[cfg(test)]
mod tests {
    use super::SIGNALS;

    #[test]
    fn exit_status_of_every_signal_is_on_the_page_of_options() {
        let page = include_str!("help/options.md");
        for (signal, name) in SIGNALS {
            let told = format!("{} after {name}", 128 + signal);
            assert!(page.contains(&told), "{told}");
        }
    }
}
