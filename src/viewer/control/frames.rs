//! Which frame is wanted, and how far it is.

use std::time::{Duration, Instant};

use crate::geometry::View;
use crate::raster::Region;
use crate::render::RenderSettings;
use crate::viewer::PixelRect;
use crate::viewer::frames::frame::PreviewQuality;
use crate::viewer::frames::request::FrameRequest;
use crate::viewer::state::Viewer;

/// A refinement that takes longer shows how far it is.
const LONG: Duration = Duration::from_millis(200);

/// The part of a rectangle of frame pixels that a frame of `size` has.
fn in_frame(rect: &PixelRect, size: [u32; 2]) -> Region {
    let inside = rect.intersection(&PixelRect::of_size(size));
    Region {
        x: u32::try_from(inside.x).unwrap_or(0),
        y: u32::try_from(inside.y).unwrap_or(0),
        width: inside.width,
        height: inside.height,
    }
}

impl Viewer {
    /// How the frame on the screen was made, unless it is final.
    pub fn preview(&self) -> Option<PreviewQuality> {
        Some(self.frame()?.preview.as_ref()?.quality)
    }

    /// Since when the picture on the screen has been wanted.
    pub fn wanted_since(&self) -> Instant {
        self.frames.drawing.frame_since()
    }

    /// Whether final tiles are being drawn over what is on the screen.
    pub fn is_refining(&self) -> bool {
        self.frames.drawing.refinement().is_some()
    }

    /// Which part of a refinement that takes long is done, `0.0..=1.0`.
    pub fn long_refinement(&self) -> Option<f64> {
        let (since, done) = self.frames.drawing.refinement()?;
        (Instant::now().saturating_duration_since(since) >= LONG).then_some(done)
    }

    /// What the status line says about a frame that is not final, such as `preview, rate 1`.
    pub fn preview_text(&self) -> Option<String> {
        let preview = self.preview();
        match (preview, self.frames.drawing.refinement()) {
            (Some(_), Some((_, done))) => Some(format!("refining {:.0} %", done * 100.0)),
            (Some(quality), None) => Some(format!("preview, {quality}")),
            (None, _) => None,
        }
    }

    /// Asks for the frame of the current state. A minimised window keeps the one it has.
    pub(in crate::viewer) fn want_frame(&mut self) {
        self.ab.forget_postponed();
        let surface = self.frames.surface_pool.is_some() && self.shows_plain_frame();
        self.frames.drawing.lend_surface(surface);
        if let Some(other) = self.ab.drawing_mut() {
            other.lend_surface(false);
        }
        let size = self.frame_size();
        let Some(entry) = self.scene_list.scenes.get(self.scene_list.current) else {
            return self.clear_frames();
        };
        if entry.has_no_picture() {
            return self.clear_frames();
        }
        let Some((scene, context)) = entry.scene().cloned().zip(self.view_context()) else {
            // Being read for the first time: the old picture stays until the new one is there.
            return;
        };
        if size.contains(&0) {
            return;
        }
        let picture = crate::viewer::frames::frame::Picture {
            scene,
            document: entry.document,
            view: entry.camera.transform(&context),
            settings: RenderSettings {
                outline: self.settings.render.outline && entry.camera.view() != View::Canvas,
                ..self.settings.render
            },
            size,
        };
        if self.lags_behind(&picture) {
            return;
        }
        let from = self.attention();
        let focus = self
            .inspector
            .inset
            .map(|placed| in_frame(&placed.inset.source(), size));
        let request = FrameRequest::new(picture, from, focus);
        self.frames.drawing.want(request.clone());
        self.want_other(&request);
        self.release_pair();
    }

    fn clear_frames(&mut self) {
        self.frames.drawing.clear();
        if let Some(drawing) = self.ab.drawing_mut() {
            drawing.clear();
        }
        self.release_pair();
    }

    /// The frame pixel that is to be final first: the one that the inspector shows, or under the pointer, or in the
    /// middle.
    fn attention(&self) -> [u32; 2] {
        let inspected = self.inspector.inset.and_then(|_| self.inspected_pixel());
        let middle = self.frame_size().map(|side| side / 2);
        inspected.or(self.hovered_pixel()).unwrap_or(middle)
    }
}
