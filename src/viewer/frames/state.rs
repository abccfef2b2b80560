//! A's frame: what draws it, what of it is on the screen, and what lies over it.

use std::time::{Duration, Instant};

use crate::viewer::PixelRect;
use crate::viewer::frames::drawing::Drawing;
use crate::viewer::frames::frame::{Frame, PreviewQuality};
use crate::viewer::frames::legends::Legends;
use crate::viewer::frames::progress::LONG;

/// What draws A's frame, and what lies over it.
#[derive(Debug)]
pub struct Frames {
    pub(in crate::viewer) drawing: Drawing,
    /// Draws quick frames for whoever shows them on a surface that it lends.
    pub(in crate::viewer) surface_pool: Option<rayon::ThreadPool>,
    pub(in crate::viewer) legends: Legends,
}

impl Frames {
    pub(in crate::viewer) fn new(drawing: Drawing) -> Self {
        Self {
            drawing,
            surface_pool: None,
            legends: Legends::default(),
        }
    }

    /// The frame on the screen. It may show an older state, or be a preview; see
    /// [`Viewer::is_settled`](crate::viewer::Viewer::is_settled).
    pub fn frame(&self) -> Option<&Frame> {
        self.drawing.frame()
    }

    /// How the frame on the screen was made, unless it is final.
    pub fn preview(&self) -> Option<PreviewQuality> {
        Some(self.frame()?.preview.as_ref()?.quality)
    }

    /// Since when the picture on the screen has been wanted.
    pub fn wanted_since(&self) -> Instant {
        self.drawing.frame_since()
    }

    /// Whether final tiles are being drawn over what is on the screen.
    pub fn is_refining(&self) -> bool {
        self.drawing.refinement().is_some()
    }

    /// Which part of a refinement that takes long is done, `0.0..=1.0`.
    pub fn long_refinement(&self) -> Option<f64> {
        let (since, done) = self.drawing.refinement()?;
        (Instant::now().saturating_duration_since(since) >= LONG).then_some(done)
    }

    /// How long it will be until a scene has been waited for so long that it is to be told, if nothing of it is on the screen: no time
    /// at all from then on.
    pub fn wait_is_told_in(&self) -> Option<Duration> {
        self.drawing.wait_is_told_in()
    }

    /// What is said where the scene takes long of which nothing is on the screen yet.
    pub fn waiting_text(&self) -> Option<&'static str> {
        self.drawing.waiting_text()
    }

    /// What the status line says about a frame that is not final, such as `preview, rate 1`.
    pub fn preview_text(&self) -> Option<String> {
        self.drawing.preview_text()
    }

    /// Whether a frame is quick to draw and waits for [`Viewer::draw_frame`](crate::viewer::Viewer::draw_frame).
    pub fn waits_for_surface(&self) -> bool {
        self.drawing.waits_for_surface()
    }

    /// Where legends lie in the window, in window pixels.
    pub fn legend_places(&self) -> Vec<PixelRect> {
        self.legends.placed.iter().map(|(rect, _)| *rect).collect()
    }
}
