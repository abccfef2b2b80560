//! How long frames take: the first pays for memory that later ones find in place, so the middle of several counts.

use std::time::Duration;

use super::{CancelToken, Subject, draw_cancellable};
use crate::raster::Framebuffer;

/// How often a frame is drawn whose time is wanted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Repeats {
    /// Frames that count, at most; at least one does.
    pub frames: u32,
    /// No other frame begins once those before took this long together. Where the first takes as long, it counts itself.
    pub patience: Duration,
}

/// Draws the whole of `frame` again and again, and gives the time of each frame that counts; `None` once `cancel` says so.
pub fn time_draws(
    subject: &Subject<'_>,
    frame: &mut Framebuffer,
    repeats: Repeats,
    cancel: &CancelToken,
) -> Option<Vec<Duration>> {
    let mut draw = || Some(draw_cancellable(subject.scene, subject.view, subject.settings, frame, cancel)?.total());
    let first = draw()?;
    let (mut times, mut spent) = (Vec::new(), first);
    for _ in 0..repeats.frames {
        if cancel.is_cancelled() {
            return None;
        }
        if spent >= repeats.patience {
            break;
        }
        let time = draw()?;
        spent = spent.saturating_add(time);
        times.push(time);
    }
    if times.is_empty() {
        times.push(first);
    }
    Some(times)
}

/// The middle one, or the mean of the two in the middle.
pub fn median(mut times: Vec<Duration>) -> Duration {
    times.sort_unstable();
    let half = times.len() / 2;
    match times.len() {
        0 => Duration::ZERO,
        length if length % 2 == 1 => times[half],
        _ => (times[half - 1] + times[half]) / 2,
    }
}

/// A time as a number of milliseconds.
pub fn milliseconds(time: Duration) -> f64 {
    time.as_secs_f64() * 1e3
}

/// A time in milliseconds with three digits that count, as tiles and captions show it: `12.3 ms`, `0.012 ms`.
pub fn time_words(time: Duration) -> String {
    let time = milliseconds(time);
    let places = match time {
        _ if time >= 100.0 => 0,
        _ if time >= 10.0 => 1,
        _ if time >= 1.0 => 2,
        _ => 3,
    };
    format!("{time:.places$} ms")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::View;
    use crate::render::RenderSettings;
    use crate::scene::{DialectChoice, load};

    #[test]
    fn times_have_three_digits_that_count() {
        let words = |micros: u64| time_words(Duration::from_micros(micros));
        assert_eq!(
            [words(123_456), words(12_345), words(1_234), words(12)],
            ["123 ms", "12.3 ms", "1.23 ms", "0.012 ms"]
        );
    }

    #[test]
    fn median_is_the_middle() {
        let times = |numbers: &[u64]| numbers.iter().map(|n| Duration::from_millis(*n)).collect();
        assert_eq!(median(times(&[5, 1, 100])), Duration::from_millis(5), "odd");
        assert_eq!(median(times(&[4, 1, 100, 6])), Duration::from_millis(5), "even");
        assert_eq!(median(times(&[])), Duration::ZERO, "none");
    }

    #[test]
    fn frames_are_timed_as_often_as_patience_lasts() {
        let scene = load("svg/basic/test1.svg".as_ref(), DialectChoice::Auto).expect("a scene");
        let (view, settings) = (
            View::Default.transform(scene.canvas, [20, 20]),
            RenderSettings::default(),
        );
        let subject = Subject {
            scene: &scene,
            view: &view,
            settings: &settings,
        };
        let (mut frame, cancel) = (Framebuffer::new(20, 20), CancelToken::default());
        let mut count = |patience| {
            let repeats = Repeats { frames: 4, patience };
            time_draws(&subject, &mut frame, repeats, &cancel).map(|times| times.len())
        };
        assert_eq!(count(Duration::MAX), Some(4), "all that were asked for");
        assert_eq!(count(Duration::ZERO), Some(1), "the first counts itself");
        cancel.cancel();
        assert_eq!(count(Duration::MAX), None, "given up");
    }
}
