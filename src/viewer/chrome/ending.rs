//! Whether Esc ends the program: where nothing is open it asks first, and ends only when it is pressed again soon.
//! A hand that closes one thing after the other does not lose hours of work by one press too many.

use std::time::{Duration, Instant};

/// How long the question waits for Esc again.
pub const ASKS_FOR: Duration = Duration::from_secs(2);

/// What is asked.
pub(in crate::viewer) const QUESTION: &str = "Esc again ends the program";

/// When it was asked last, until something else was closed.
#[derive(Clone, Copy, Debug, Default)]
pub(in crate::viewer) struct Ending {
    asked: Option<Instant>,
}

impl Ending {
    /// Esc with nothing open: true if the program ends, false if it is to be asked.
    pub(in crate::viewer) fn escape(&mut self, now: Instant) -> bool {
        let asked = self.asked.replace(now);
        asked.is_some_and(|asked| now.saturating_duration_since(asked) < ASKS_FOR)
    }

    /// Esc closed something: the next one asks anew.
    pub(in crate::viewer) fn forget(&mut self) {
        self.asked = None;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ending_asks_anew_after_two_seconds() {
        let start = Instant::now();
        let at = |ms| start + Duration::from_millis(ms);
        let mut ending = Ending::default();
        assert!(!ending.escape(at(0)), "the first asks");
        assert!(!ending.escape(at(2000)), "too late: it asks anew");
        assert!(ending.escape(at(3999)), "soon enough");
        ending.forget();
        assert!(!ending.escape(at(4000)), "something was closed in between");
    }
}
