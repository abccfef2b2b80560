//! Moving, scaling and turning the view of the current scene.

use glam::DVec2;

use crate::viewer::PixelRect;
use crate::viewer::settings::PixelZoom;
use crate::viewer::state::Viewer;
use crate::viewer::view::camera::{Camera, ViewContext};

/// What one click of the wheel zooms by.
const WHEEL_FACTOR: f64 = 1.25;

/// Clicks of the wheel that count at once.
const MAX_CLICKS: f64 = 100.0;

impl Viewer {
    /// The point in the middle of the window, in frame pixels.
    pub(in crate::viewer) fn middle(&self) -> DVec2 {
        DVec2::from(self.frame_size().map(f64::from)) / 2.0
    }

    pub(in crate::viewer) fn wheel(&mut self, clicks: f64) {
        self.pointer.wheels_inset |= self.pointer_over_inset();
        self.pointer.wheels_inset &= self.inspector.inset.is_some();
        if self.pointer.wheels_inset {
            self.inspector.magnifier.wheel(clicks);
        } else if clicks.is_finite() {
            let factor = WHEEL_FACTOR.powf(clicks.clamp(-MAX_CLICKS, MAX_CLICKS));
            self.zoom(self.pointer.at, factor);
        }
    }

    /// Changes the current scene's camera; nothing happens before the scene was read.
    pub(in crate::viewer) fn look(&mut self, change: impl FnOnce(&mut Camera, &ViewContext)) {
        if let Some((context, entry)) = self
            .view_context()
            .zip(self.scene_list.scenes.get_mut(self.scene_list.current))
        {
            change(&mut entry.camera, &context);
        }
    }

    /// Into the part of the window that no panel covers.
    pub(in crate::viewer) fn fit_view(&mut self) {
        let part = self.free_part();
        self.look(|camera, context| camera.fit(part, context));
    }

    /// The default view, or where a panel covers some of the canvas then, the like in the part of the window that is free.
    pub(in crate::viewer) fn reset_view(&mut self) {
        if let Some(entry) = self.scene_list.scenes.get_mut(self.scene_list.current) {
            entry.camera = Camera::default();
        }
        let part = self.free_part();
        self.look(|camera, context| camera.show_canvas(part, context));
        self.center_fixed();
    }

    /// Keeps a canvas that no hand has moved where panels leave room for it. A pinned pixel is to stay what it is: while there
    /// is one, no other scale comes.
    pub(in crate::viewer) fn follow_free_part(&mut self) {
        let is_pinned = self.inspector.magnifier.pin.is_some();
        // A lesson has views of its own.
        if is_pinned || self.lesson.is_some() {
            return;
        }
        let part = self.free_part();
        self.look(|camera, context| camera.follow(part, context));
    }

    /// Whether something of the canvas lies in the part of the window that no panel covers; true where there is no scene, or
    /// no canvas that a view could lose.
    pub fn canvas_in_sight(&self) -> bool {
        let camera = self.current().map(|entry| &entry.camera);
        let Some((context, camera)) = self.view_context().zip(camera) else {
            return true;
        };
        self.fixed_size().is_some() || camera.sees_canvas(self.free_part(), &context)
    }

    /// The part of the frame that no panel covers: its corner and size in frame pixels.
    pub(in crate::viewer) fn free_part(&self) -> [DVec2; 2] {
        let zoom = f64::from(self.settings.pixel_zoom.factor());
        let window = PixelRect::of_size(self.chrome.window);
        let free = self.chrome.free_area.map_or(window, |free| free.intersection(&window));
        let panes = self.panes();
        if panes.second.is_some() || self.fixed_size().is_some() {
            return [DVec2::ZERO, DVec2::from(panes.frame.map(f64::from))];
        }
        let corner = DVec2::new(free.x as f64, free.y as f64) / zoom;
        [corner, DVec2::new(f64::from(free.width), f64::from(free.height)) / zoom]
    }

    /// By window pixels.
    pub(in crate::viewer) fn pan(&mut self, by: DVec2) {
        let zoom = f64::from(self.settings.pixel_zoom.factor());
        if by.is_finite() && !self.move_fixed(by / zoom) {
            self.look(|camera, context| camera.pan(by / zoom, context));
        }
    }

    /// About the centre of a window pixel, so that the status line goes on telling the same place.
    pub(in crate::viewer) fn zoom(&mut self, at: Option<DVec2>, factor: f64) {
        if self.zoom_fixed(at, factor) {
            return;
        }
        let at = at.map_or(self.middle(), |at| self.frame_position(at.floor() + 0.5));
        self.look(|camera, context| camera.zoom(at, factor, context));
    }

    /// Frame pixels become larger or smaller: the views are adapted so that the window shows the same part.
    pub(in crate::viewer) fn set_pixel_zoom(&mut self, zoom: PixelZoom) {
        if self.fixed_size().is_some() {
            return self.zoom_fixed_to(None, zoom);
        }
        let factor = f64::from(self.settings.pixel_zoom.factor()) / f64::from(zoom.factor());
        self.settings.pixel_zoom = zoom;
        let frame = self.frame_size();
        for entry in &mut self.scene_list.scenes {
            if let Some(canvas) = entry.scene().map(|scene| scene.canvas) {
                entry.camera.rescale(factor, &ViewContext { canvas, frame });
            }
        }
        self.follow_pointer();
    }
}
