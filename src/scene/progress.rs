//! How far the reading of a document has come, for whoever waits for it and may give it up.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU32, Ordering};

use super::Problem;
use super::error::Fault;

/// What parts are counted in.
const WHOLE: f64 = 1000.0;

/// A document that is being read, seen from another thread: all clones are of the same reading.
#[derive(Clone, Debug, Default)]
pub struct Progress(Arc<State>);

#[derive(Debug, Default)]
struct State {
    /// In thousandths.
    done: AtomicU32,
    given_up: AtomicBool,
}

impl Progress {
    /// How much is done, from 0 to 1; parts are estimates of the time they take.
    pub fn part(&self) -> f64 {
        f64::from(self.0.done.load(Ordering::Relaxed)) / WHOLE
    }

    /// Nobody waits any more: reading ends soon, with an error.
    pub fn give_up(&self) {
        self.0.given_up.store(true, Ordering::Relaxed);
    }

    /// Ends the reading where nobody waits for it any more.
    pub(super) fn go_on(&self) -> Result<(), Fault> {
        if self.0.given_up.load(Ordering::Relaxed) {
            return Err(Problem::GivenUp.nowhere());
        }
        Ok(())
    }

    /// So much is done; less than before changes nothing.
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "clamped to a thousand thousandths"
    )]
    pub(super) fn reach(&self, part: f64) {
        let part = (part.clamp(0.0, 1.0) * WHOLE) as u32;
        self.0.done.fetch_max(part, Ordering::Relaxed);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{NoResources, ReadOptions, read_watched};

    #[test]
    fn progress_never_goes_back() {
        let progress = Progress::default();
        for (part, shown) in [(0.25, 0.25), (0.1, 0.25), (f64::NAN, 0.25), (7.0, 1.0)] {
            progress.reach(part);
            assert!((progress.part() - shown).abs() < 1e-9, "{part}: {}", progress.part());
        }
    }

    #[test]
    fn reading_that_is_given_up_ends_with_an_error() {
        let text = format!(
            "<svg width='9' height='9'>{}</svg>",
            "<rect width='1' height='1'/>".repeat(5000)
        );
        for dialect in crate::scene::DialectChoice::ALL {
            let read = |progress: &Progress| {
                read_watched(
                    text.as_bytes(),
                    "a.svg",
                    ReadOptions { dialect },
                    &NoResources,
                    progress,
                )
                .map(|_| ())
            };
            let progress = Progress::default();
            read(&progress).expect("a scene");
            assert!(progress.part() > 0.8, "{dialect:?}: {}", progress.part());
            let progress = Progress::default();
            progress.give_up();
            let error = read(&progress).expect_err("given up");
            assert!(matches!(error.problem, Problem::GivenUp), "{dialect:?}: {error}");
        }
    }
}
