//! When the next frame may be shown: never two pictures within 16 ms, since X11 does not wait for the screen.

use std::time::{Duration, Instant};

/// Least time between two frames.
const FLOOR: Duration = Duration::from_millis(16);

/// When frames were shown.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Rhythm {
    last_frame: Option<Instant>,
    last_picture: Option<Instant>,
    /// The viewer's number of the picture that was shown last.
    picture: u64,
}

impl Rhythm {
    /// A frame begins.
    pub(super) fn begin(&mut self, now: Instant) {
        self.last_frame = Some(now);
    }

    /// The frame that began last shows the `picture` with this number.
    pub(super) fn shows(&mut self, picture: u64) {
        if std::mem::replace(&mut self.picture, picture) != picture {
            self.last_picture = self.last_frame;
        }
    }

    /// When the next frame may begin, which shows the `picture` with this number; `None` for at once. Panels that were
    /// shown alone do not keep a picture waiting.
    pub(super) fn due(&self, picture: u64, now: Instant) -> Option<Instant> {
        let last = if picture == self.picture {
            self.last_frame
        } else {
            self.last_picture
        };
        last?.checked_add(FLOOR).filter(|due| *due > now)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn panels_do_not_keep_a_picture_waiting() {
        let start = Instant::now();
        let at = |ms| start + Duration::from_millis(ms);
        let mut rhythm = Rhythm::default();
        assert_eq!(rhythm.due(1, at(0)), None, "the first comes at once");
        rhythm.begin(at(0));
        rhythm.shows(1);
        assert_eq!(
            rhythm.due(2, at(3)),
            Some(at(16)),
            "the next picture waits for its time"
        );
        assert_eq!(rhythm.due(1, at(3)), Some(at(16)), "so do panels");
        rhythm.begin(at(16));
        rhythm.shows(1);
        assert_eq!(rhythm.due(1, at(17)), Some(at(32)), "panels after panels");
        assert_eq!(rhythm.due(2, at(17)), None, "the picture has waited long enough");
        rhythm.begin(at(17));
        rhythm.shows(2);
        assert_eq!(rhythm.due(3, at(18)), Some(at(33)), "and the next waits again");
    }
}
