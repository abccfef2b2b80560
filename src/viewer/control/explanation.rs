//! When the pinned pixel is explained, and what of the explanation is shown.

use crate::inspect::{Detail, Explanation};
use crate::scene::PrimitiveKind;
use crate::viewer::command::Effect;
use crate::viewer::inspector::explanation::Asked;
use crate::viewer::inspector::samples::Target;
use crate::viewer::library::SceneEntry;
use crate::viewer::settings::Toggle;
use crate::viewer::state::Viewer;

/// Most points of an outline that are drawn over the picture.
const MOST_POINTS: usize = 20_000;

/// How it begins what is said where the explanation has no room.
pub(in crate::viewer) const NO_ROOM: &str = "no room here for the explanation of the pixel";

/// What is said about pixels of a scene that could not be read.
const NO_PICTURE: &str = "no picture to explain: this scene could not be read";

impl Viewer {
    /// Why the pinned pixel has its colour in the last frame that was finished; `None` until it was found out, and while
    /// no pixel is pinned or the explanation is closed.
    pub fn explanation(&self) -> Option<&Explanation> {
        Some(&self.inspector.explanation.answer()?.as_ref()?.own)
    }

    /// The same of B, where B is drawn by us too.
    pub fn other_explanation(&self) -> Option<&Explanation> {
        self.inspector.explanation.answer()?.as_ref()?.other.as_ref()
    }

    /// Whether there is to be an explanation in the window.
    pub fn explains(&self) -> bool {
        let is_open = self.inspector.magnifier.open && !self.chrome.hidden && !self.has_no_picture();
        is_open && self.chrome.shown.explanation && self.pinned_pixel().is_some()
    }

    /// Whether a hand asked why the pinned pixel has its colour, and not only a lesson's step.
    pub fn asks_about_pixel(&self) -> bool {
        self.inspector.magnifier.asked
    }

    /// Shows or hides the explanation. The switch goes by what is to be seen: it never closes what nobody sees, and where no
    /// pixel is pinned it pins one, since it would seem to do nothing otherwise.
    pub(in crate::viewer) fn show_explanation(&mut self, toggle: Toggle) {
        let shown = toggle.of(self.explains());
        if toggle == Toggle::Flip && self.refuses_to_explain() {
            return;
        }
        self.inspector.magnifier.asked |= shown;
        self.chrome.shown.explanation = shown;
        if !shown || toggle != Toggle::Flip {
            return;
        }
        if self.pinned_pixel().is_some() {
            (self.inspector.magnifier.open, self.chrome.hidden) = (true, false);
        } else if let Some(pixel) = self.hovered_pixel().or_else(|| self.inspected_pixel()) {
            self.pin(pixel.map(i64::from));
        }
    }

    /// Whether the current scene could not be read, so that there is nothing to look at.
    pub fn has_no_picture(&self) -> bool {
        self.current().is_some_and(SceneEntry::has_no_picture)
    }

    /// Tells whoever asks about a pixel that there is no picture; false where there is one.
    pub(in crate::viewer) fn refuses_to_explain(&mut self) -> bool {
        let has_none = self.has_no_picture();
        if has_none {
            self.chrome.messages.error(NO_PICTURE.to_owned());
        }
        has_none
    }

    /// Tells the user what went wrong around the viewer, in one line.
    pub fn tell_problem(&mut self, problem: String) {
        self.chrome.messages.error(problem);
        self.revision += 1;
    }

    /// Tells the user that what he asked for is not to be seen.
    pub fn say_no_room(&mut self) {
        let message = format!("{NO_ROOM}: make the window wider");
        self.chrome.messages.done(message);
        self.revision += 1;
    }

    /// Whether everything that is asked about the pinned pixel was found out.
    pub(in crate::viewer) fn explains_all(&self) -> bool {
        self.inspector.explanation.is_current() && self.inspector.contributions.is_current()
    }

    /// Sees to it that what is to be explained is found out.
    pub(in crate::viewer) fn want_explanation(&mut self) {
        // While the picture moves the last explanation stays: finding out others would only slow the picture down.
        if self.explains() && !self.frames.drawing.is_current() {
            return;
        }
        let pixel = self.pinned_pixel().filter(|_| self.explains());
        let asked = pixel.and_then(|pixel| self.question(pixel));
        self.inspector.explanation.want(asked, |_| None);
    }

    /// A pixel of the frame on the screen, as a question.
    fn question(&self, pixel: [u32; 2]) -> Option<Asked> {
        let target = Target {
            picture: self.frame()?.picture.clone(),
            pixel,
        };
        let file = self.current()?.label.clone();
        let own = &target.picture;
        let other = self.other_picture(own);
        Some(Asked { target, other, file })
    }

    /// The explanation as Markdown; explained now if nobody did yet.
    pub(in crate::viewer) fn copy_explanation(&mut self) -> Vec<Effect> {
        let pixel = self.inspected_pixel().filter(|_| self.inspector.magnifier.open);
        let asked = pixel.and_then(|pixel| self.question(pixel));
        let Some(explained) = asked.and_then(|asked| asked.explain()) else {
            let cure = "no pixel to explain: open the inspector with Z, or pin a pixel";
            self.chrome.messages.error(cure.to_owned());
            return Vec::new();
        };
        self.chrome
            .messages
            .done("copied the explanation as Markdown".to_owned());
        vec![Effect::CopyText(explained.own.markdown(Detail::Telling))]
    }

    /// The contours of a primitive of the frame on the screen, in window pixels; closed, but for a line of two points. Of two
    /// pictures side by side they lie over the first.
    pub fn outline_of(&self, primitive: u32) -> Vec<Vec<[f64; 2]>> {
        let Some(frame) = self.frame() else {
            return Vec::new();
        };
        let picture = &frame.picture;
        let Some(primitive) = picture.scene.primitives.get(primitive as usize) else {
            return Vec::new();
        };
        let zoom = f64::from(self.settings.pixel_zoom.factor());
        let [left, top] = self.panes().first.corner;
        let corner = glam::DVec2::new(left as f64, top as f64);
        let place = |points: &[glam::DVec2]| -> Vec<[f64; 2]> {
            let points = points.iter().take(MOST_POINTS);
            points
                .map(|point| ((picture.view.to_pixels(*point) + corner) * zoom).to_array())
                .collect()
        };
        match &primitive.kind {
            PrimitiveKind::Triangle { points, .. } => vec![place(points)],
            PrimitiveKind::Polygon { polygon, .. } => {
                let mut room = MOST_POINTS;
                let fits = |contour: &&[glam::DVec2]| {
                    let fits = contour.len() <= room;
                    room = room.saturating_sub(contour.len());
                    fits
                };
                polygon.contours().take_while(fits).map(place).collect()
            }
            PrimitiveKind::Hairline { ends, .. } => vec![place(ends)],
            PrimitiveKind::Point { at, .. } => {
                let [x, y] = (picture.view.to_pixels(*at).floor() + corner).to_array();
                let corner = |dx: f64, dy: f64| [(x + dx) * zoom, (y + dy) * zoom];
                vec![vec![
                    corner(0.0, 0.0),
                    corner(1.0, 0.0),
                    corner(1.0, 1.0),
                    corner(0.0, 1.0),
                ]]
            }
            PrimitiveKind::BeginLayer | PrimitiveKind::EndLayer { .. } => Vec::new(),
        }
    }
}
