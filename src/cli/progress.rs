//! How far a command is: a bar on a terminal, once it takes longer than people wait without wondering.

use std::io::IsTerminal as _;
use std::sync::mpsc::{RecvTimeoutError, Sender, channel};
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::thread::JoinHandle;
use std::time::Duration;

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

/// So long nothing is shown.
const PATIENCE: Duration = Duration::from_secs(2);
/// How often the bar tells that it is alive.
const BEAT: Duration = Duration::from_millis(250);
/// What it says while nobody knows how much there is to do, and when somebody does.
const ALONE: &str = "{spinner} {elapsed} {msg}(Ctrl+C stops)";
const COUNTED: &str = "{bar:30} {pos}/{len} {elapsed} {msg}(Ctrl+C stops)";
const SHARED: &str = "{bar:30} {percent} % {elapsed} {msg}(Ctrl+C stops)";

/// The bar of the command at work. Ctrl+C and errors find it here wherever they come from.
static BAR: Mutex<Option<ProgressBar>> = Mutex::new(None);

/// The bar of a command, until it is dropped.
pub(super) struct Progress {
    /// Keeps the thread that waits to show the bar from doing so.
    patience: Option<(Sender<()>, JoinHandle<()>)>,
}

impl Progress {
    /// Begins to wait. Without a terminal there is nothing to show.
    pub(super) fn start() -> Self {
        if !std::io::stderr().is_terminal() {
            return Self { patience: None };
        }
        let bar = ProgressBar::hidden();
        set_style(&bar, ALONE);
        *current() = Some(bar.clone());
        let (sender, ended) = channel();
        let show = move || {
            if ended.recv_timeout(PATIENCE) == Err(RecvTimeoutError::Timeout) {
                bar.set_draw_target(ProgressDrawTarget::stderr());
                while ended.recv_timeout(BEAT) == Err(RecvTimeoutError::Timeout) {
                    bar.tick();
                }
            }
        };
        // A system without a thread to spare shows no bar.
        let thread = std::thread::Builder::new().name("progress".to_owned()).spawn(show);
        Self {
            patience: thread.ok().map(|thread| (sender, thread)),
        }
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        if let Some((sender, thread)) = self.patience.take() {
            drop(sender);
            // It does nothing that could fail.
            let _ = thread.join();
        }
        clear();
    }
}

/// Tells how many steps there are.
pub(super) fn count(steps: usize) {
    if let Some(bar) = &*current() {
        set_style(bar, COUNTED);
        bar.set_length(steps as u64);
    }
}

/// Whether somebody looks.
pub(super) fn is_watched() -> bool {
    current().is_some()
}

/// So much of the only step is done. Where steps are counted, they tell more.
pub(super) fn share(done: u64, all: u64) {
    if let Some(bar) = &*current() {
        if bar.length().is_none() {
            set_style(bar, SHARED);
            bar.set_length(all);
        }
        if bar.length() == Some(all) {
            bar.set_position(done);
        }
    }
}

/// A step begins.
pub(super) fn begin(step: &str) {
    if let Some(bar) = &*current() {
        bar.set_message(format!("{step} "));
    }
}

/// A step is done.
pub(super) fn done() {
    if let Some(bar) = &*current() {
        bar.inc(1);
    }
}

/// Prints while the bar is away.
pub(super) fn aside(print: impl FnOnce()) {
    let bar = current().clone();
    match bar {
        Some(bar) => bar.suspend(print),
        None => print(),
    }
}

/// Takes the bar away for good.
pub(super) fn clear() {
    if let Some(bar) = current().take() {
        bar.finish_and_clear();
    }
}

fn current() -> MutexGuard<'static, Option<ProgressBar>> {
    // A bar is whole even after a panic.
    BAR.lock().unwrap_or_else(PoisonError::into_inner)
}

fn set_style(bar: &ProgressBar, template: &str) {
    if let Ok(style) = ProgressStyle::with_template(template) {
        bar.set_style(style);
    }
}
