//! Where the magnifiers of a comparison go.

use glam::{DVec2, dvec2};

use crate::figure::PixelRect;
use crate::viewer::control::window::magnified;
use crate::viewer::inspector::PlacedInset;
use crate::viewer::state::Viewer;

impl Viewer {
    /// Where the magnifiers of a pixel of both go, inside the window pixels of `area`.
    pub(in crate::viewer) fn place_magnifiers(
        &mut self,
        center: [u32; 2],
        area: &PixelRect,
    ) -> Option<[PlacedInset; 2]> {
        let (shown, panes) = (self.shown_at(center), self.panes());
        let Some((second, canvas)) = panes.second.zip(self.canvas_in_frame()) else {
            return self.inspector.magnifier.place_both(center, &shown, area);
        };
        let zoom = self.settings.pixel_zoom.factor();
        // The magnifier of A lies in A's half, whichever that is.
        let (own, other) = if self.ab.swapped {
            (second, panes.first)
        } else {
            (panes.first, second)
        };
        let [low, high] = canvas.map(|place| screen_place(place, own.corner));
        let side = |axis: usize| u32::try_from(high[axis] - low[axis]).unwrap_or_default();
        let canvas = PixelRect {
            x: low[0],
            y: low[1],
            width: side(0),
            height: side(1),
        };
        let [canvas, own, other] = [canvas, own.area, other.area].map(|rect| magnified(&rect, zoom));
        self.inspector
            .magnifier
            .place_in_halves(center, &shown, &canvas, [&own, &other])
    }

    /// The corners of the box around the canvas, in frame pixels; `None` before the scene was read.
    pub(crate) fn canvas_in_frame(&self) -> Option<[DVec2; 2]> {
        let context = self.view_context()?;
        let view = self.current()?.camera.transform(&context);
        let DVec2 { x, y } = context.canvas;
        let corners = [dvec2(0.0, 0.0), dvec2(x, 0.0), dvec2(0.0, y), dvec2(x, y)].map(|at| view.to_pixels(at));
        let low = corners.into_iter().reduce(DVec2::min)?;
        let high = corners.into_iter().reduce(DVec2::max)?;
        Some([low, high])
    }
}

/// The screen pixel of a place in a frame whose corner lies at `corner`; far places are brought near.
fn screen_place(place: DVec2, corner: [i64; 2]) -> [i64; 2] {
    /// Farther away nothing is to be seen.
    const FAR: f64 = 1e6;
    #[expect(clippy::cast_possible_truncation, reason = "clamped")]
    let near = |at: f64| at.round().clamp(-FAR, FAR) as i64;
    [near(place.x) + corner[0], near(place.y) + corner[1]]
}
