//! What is said of a drawing, A's or B's, that takes long.

use std::time::{Duration, Instant};

use crate::viewer::frames::drawing::Drawing;

/// What takes longer is told: how far a refinement is, and that nothing of a scene is there yet.
pub(super) const LONG: Duration = Duration::from_millis(200);

impl Drawing {
    /// How long it will be until a scene has been waited for so long that it is to be told, if nothing of it is on the screen: no time
    /// at all from then on.
    pub(in crate::viewer) fn wait_is_told_in(&self) -> Option<Duration> {
        let since = self.awaited_since()?;
        Some(LONG.saturating_sub(Instant::now().saturating_duration_since(since)))
    }

    /// What is said where the scene takes long of which nothing is on the screen yet.
    pub(in crate::viewer) fn waiting_text(&self) -> Option<&'static str> {
        let is_long = self.wait_is_told_in()?.is_zero();
        is_long.then_some(match self.frame() {
            Some(_) => "drawing …, still the last scene",
            None => "drawing …",
        })
    }

    /// What is said about a frame that is not final, such as `preview, rate 1`.
    pub(in crate::viewer) fn preview_text(&self) -> Option<String> {
        if let Some(text) = self.waiting_text() {
            return Some(text.to_owned());
        }
        let quality = self.frame()?.preview.as_ref()?.quality;
        Some(match self.refinement() {
            Some((_, done)) => format!("refining {:.0} %", done * 100.0),
            None => format!("preview, {quality}"),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::viewer::frames::drawing::tests::Desk;

    #[test]
    fn scene_that_takes_long_is_told() {
        let mut desk = Desk::new();
        let first = desk.picture(4, [50.0, 50.0], 1.0);
        desk.want(&first);
        desk.work();
        desk.want_another_scene();
        let drawing = desk.drawing;
        assert_eq!(drawing.wait_is_told_in(), Some(Duration::ZERO), "longer than {LONG:?}");
        assert_eq!(
            drawing.preview_text().as_deref(),
            Some("drawing …, still the last scene"),
            "what is on the screen is another scene's"
        );
    }
}
