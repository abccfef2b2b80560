//! Moving, scaling and turning the view of the current scene, and pictures that have a size of their own.

use glam::DVec2;

use crate::viewer::ViewCommand;
use crate::viewer::ab::comparison::Comparison;
use crate::viewer::chrome::Chrome;
use crate::viewer::library::state::SceneList;
use crate::viewer::settings::values::next_of;
use crate::viewer::settings::{PixelZoom, Settings};
use crate::viewer::view::camera::Camera;
use crate::viewer::view::layout::WindowLayout;

/// What two fingers must spread by to reach the next pixel zoom.
const ZOOM_STEP: f64 = 1.25;

/// The views of scenes, and what else decides which part of a picture the window shows.
#[derive(Debug)]
pub(in crate::viewer) struct Viewing<'a> {
    pub(in crate::viewer) settings: &'a mut Settings,
    pub(in crate::viewer) chrome: &'a Chrome,
    pub(in crate::viewer) scene_list: &'a mut SceneList,
    pub(in crate::viewer) ab: &'a mut Comparison,
}

impl Viewing<'_> {
    pub(in crate::viewer) fn apply(&mut self, command: ViewCommand) {
        let frame = self.layout().frame_size();
        match command {
            ViewCommand::PanBy { by } => self.pan(by),
            ViewCommand::ZoomAt { at, factor } => self.zoom(at, factor),
            ViewCommand::RotateBy { degrees } => {
                self.scene_list
                    .look(frame, |camera, context| camera.rotate(degrees, context));
            }
            ViewCommand::Reset => {
                self.scene_list.reset_view(&self.layout());
                self.ab.center();
            }
            ViewCommand::Fit => self.scene_list.fit_view(&self.layout()),
            ViewCommand::ActualSize => self.scene_list.look(frame, Camera::actual_size),
            ViewCommand::Set(numbers) => {
                self.scene_list
                    .look(frame, |camera, context| camera.set(numbers, context));
            }
            ViewCommand::SetPixelZoom(zoom) => self.set_pixel_zoom(zoom),
            ViewCommand::NextPixelZoom => {
                self.set_pixel_zoom(next_of(&PixelZoom::ALL, self.settings.pixel_zoom, 1.0));
            }
            ViewCommand::Progressive(toggle) => {
                self.settings.progressive = toggle.of(self.settings.progressive);
            }
        }
    }

    fn layout(&self) -> WindowLayout {
        self.ab.layout(self.settings.pixel_zoom, self.chrome)
    }

    /// By window pixels.
    pub(in crate::viewer) fn pan(&mut self, by: DVec2) {
        let layout = self.layout();
        let by = by / f64::from(layout.zoom());
        if by.is_finite() && !self.move_fixed(by) {
            self.scene_list
                .look(layout.frame_size(), |camera, context| camera.pan(by, context));
        }
    }

    /// About the centre of a window pixel, so that the status line goes on telling the same place.
    pub(in crate::viewer) fn zoom(&mut self, at: Option<DVec2>, factor: f64) {
        if self.zoom_fixed(at, factor) {
            return;
        }
        let layout = self.layout();
        let at = at.map_or(layout.middle(), |at| layout.frame_position(at.floor() + 0.5));
        self.scene_list
            .look(layout.frame_size(), |camera, context| camera.zoom(at, factor, context));
    }

    /// Frame pixels become larger or smaller: the views are adapted so that the window shows the same part.
    fn set_pixel_zoom(&mut self, zoom: PixelZoom) {
        if self.ab.fixed_size().is_some() {
            return self.zoom_fixed_to(None, zoom);
        }
        let factor = f64::from(self.settings.pixel_zoom.factor()) / f64::from(zoom.factor());
        self.settings.pixel_zoom = zoom;
        let frame = self.layout().frame_size();
        self.scene_list.rescale(factor, frame);
    }

    /// Moves pictures that have a size of their own; false where there are none.
    fn move_fixed(&mut self, by: DVec2) -> bool {
        let layout = self.layout();
        let Some(frame) = layout.fixed_size() else {
            return false;
        };
        self.ab.moved.add(by, &layout.panes().first.area, frame);
        self.ab.touch();
        true
    }

    /// Zooms pictures that have a size of their own by steps of the pixel zoom; `at` is a window pixel that stays. False
    /// where there are none.
    fn zoom_fixed(&mut self, at: Option<DVec2>, factor: f64) -> bool {
        if self.ab.fixed_size().is_none() {
            return false;
        }
        let moved = &mut self.ab.moved;
        let steps = moved.rest + factor.ln() / ZOOM_STEP.ln();
        if !steps.is_finite() {
            return true;
        }
        let whole = steps.round().clamp(-10.0, 10.0);
        moved.rest = (steps - whole).clamp(-1.0, 1.0);
        let now = self.settings.pixel_zoom;
        let mut place = PixelZoom::ALL.iter().position(|zoom| *zoom == now).unwrap_or(0);
        for step in 0..10 {
            if f64::from(step) < whole.abs() {
                place = if whole > 0.0 {
                    place + 1
                } else {
                    place.saturating_sub(1)
                };
            }
        }
        let next = PixelZoom::ALL[place.min(PixelZoom::ALL.len() - 1)];
        self.zoom_fixed_to(at, next);
        true
    }

    /// The same to a certain pixel zoom.
    fn zoom_fixed_to(&mut self, at: Option<DVec2>, zoom: PixelZoom) {
        let window = DVec2::from(self.chrome.window.map(f64::from));
        // The centre of a window pixel, so that the frame pixel there stays whatever the corner is rounded to.
        let at = at.unwrap_or(window / 2.0).floor() + 0.5;
        let before = self.layout().frame_position(at);
        self.settings.pixel_zoom = zoom;
        let after = self.layout().frame_position(at);
        self.move_fixed(after - before);
    }
}
