//! What a hand does to the picture: it points, drags, turns the wheel, moves the view.

use glam::DVec2;

use crate::figure::Corner;
use crate::viewer::ab::comparison::Comparison;
use crate::viewer::chrome::Chrome;
use crate::viewer::control::both::Both;
use crate::viewer::control::pointing::Pointing;
use crate::viewer::control::viewing::Viewing;
use crate::viewer::frames::state::Frames;
use crate::viewer::inspector::state::Inspection;
use crate::viewer::library::state::SceneList;
use crate::viewer::profile::Profiling;
use crate::viewer::settings::Settings;
use crate::viewer::spectrum::SpectrumState;
use crate::viewer::view::camera::Camera;
use crate::viewer::view::layout::WindowLayout;
use crate::viewer::view::pointer::{Pointer, PointerButton, WheelTarget, window_pixel};
use crate::viewer::{PointerCommand, ViewCommand};

/// What one click of the wheel zooms by.
const WHEEL_FACTOR: f64 = 1.25;

/// Clicks of the wheel that count at once.
const MAX_CLICKS: f64 = 100.0;

/// What a hand has hold of: the pointer, the view, the pinned pixel and the line of a profile. Frames it only looks at.
#[derive(Debug)]
pub(in crate::viewer) struct Hand<'a> {
    pub(in crate::viewer) settings: &'a mut Settings,
    pub(in crate::viewer) chrome: &'a mut Chrome,
    pub(in crate::viewer) scene_list: &'a mut SceneList,
    pub(in crate::viewer) frames: &'a Frames,
    pub(in crate::viewer) ab: &'a mut Comparison,
    pub(in crate::viewer) inspector: &'a mut Inspection,
    pub(in crate::viewer) profiling: &'a mut Profiling,
    pub(in crate::viewer) spectrum: &'a mut SpectrumState,
    pub(in crate::viewer) pointer: &'a mut Pointer,
}

impl Hand<'_> {
    pub(in crate::viewer) fn layout(&self) -> WindowLayout {
        self.ab.layout(self.settings.pixel_zoom, self.chrome)
    }

    pub(in crate::viewer) fn both(&self) -> Both<'_> {
        Both::new(self.settings, self.chrome, self.scene_list, self.frames, self.ab)
    }

    pub(in crate::viewer) fn pixels(&self) -> Pointing<'_> {
        Pointing {
            both: self.both(),
            chrome: self.chrome,
            inspector: self.inspector,
            pointer: self.pointer,
        }
    }

    pub(in crate::viewer) fn viewing(&mut self) -> Viewing<'_> {
        Viewing {
            settings: self.settings,
            chrome: self.chrome,
            scene_list: self.scene_list,
            ab: self.ab,
        }
    }

    pub(in crate::viewer) fn apply_pointer(&mut self, command: PointerCommand) {
        match command {
            PointerCommand::Moved { at } => self.pointer_moved(at),
            PointerCommand::Left => self.pointer.at = None,
            PointerCommand::Pressed(button) => {
                self.inspector.magnifier.reveal = None;
                self.pointer_pressed(button);
            }
            PointerCommand::Released(PointerButton::Primary) => {
                (self.pointer.dragging, self.pointer.drags_inset, self.ab.drags_line) = (false, false, false);
                self.profiling.drag = None;
            }
            PointerCommand::Released(PointerButton::Secondary) => {}
            PointerCommand::Wheel { clicks } => self.wheel(clicks),
            PointerCommand::Pinch { factor } => {
                let at = self.pointer.at;
                self.viewing().zoom(at, factor);
            }
        }
    }

    pub(in crate::viewer) fn apply_view(&mut self, command: ViewCommand) {
        let sets_zoom = matches!(command, ViewCommand::SetPixelZoom(_) | ViewCommand::NextPixelZoom);
        if let ViewCommand::Set(numbers) = command {
            let context = self.both().view_context();
            let remark = context.and_then(|context| Camera::remark(numbers, &context));
            if let Some(remark) = remark {
                self.chrome.messages.done(remark);
            }
        }
        self.viewing().apply(command);
        // Another frame pixel lies under a pointer that rests.
        if sets_zoom && self.ab.fixed_size().is_none() {
            self.follow_pointer();
        }
    }

    fn pointer_moved(&mut self, to: DVec2) {
        if !to.is_finite() {
            return;
        }
        let from = self.pointer.at.replace(to);
        if from != Some(to) {
            (self.pointer.wheels, self.pointer.pinned_through_inset) = (None, None);
            self.pointer.pins_before = self.inspector.magnifier.pins;
            self.inspector.magnifier.let_go();
        }
        if self.profiling.drag.is_some() {
            self.drag_profile(to);
        } else if self.ab.drags_line {
            self.ab.drag_line(to.x, &self.layout());
        } else if self.pointer.drags_inset {
            let at = window_pixel(to);
            let area = self.layout().free_window_at(at);
            self.inspector.magnifier.dragged = Some(Corner::nearest(&area, at));
        } else if let Some(from) = from.filter(|_| self.pointer.dragging) {
            self.viewing().pan(to - from);
        }
        self.follow_pointer();
    }

    /// Remembers the pixel under the pointer for the inspector. Unpinned, the inset gives way to the pointer, so what
    /// lies below the inset counts.
    fn follow_pointer(&mut self) {
        if self.inspector.magnifier.pin.is_some() && self.pixels().over_inset() {
            return;
        }
        let Some(at) = self.pointer.at else { return };
        let layout = self.layout();
        let pixel = layout.in_frame(layout.frame_pixel(window_pixel(at)));
        self.inspector.magnifier.last = pixel.or(self.inspector.magnifier.last);
    }

    fn pointer_pressed(&mut self, button: PointerButton) {
        match button {
            PointerButton::Primary => {
                self.press_on_line();
                let is_taken = self.profiling.drag.is_some();
                self.ab.drags_line = !is_taken && self.pixels().over_line();
                self.pointer.drags_inset = !is_taken && !self.ab.drags_line && self.pixels().over_inset();
                let is_taken = is_taken || self.ab.drags_line || self.pointer.drags_inset;
                self.pointer.dragging = self.pointer.at.is_some() && !is_taken;
            }
            PointerButton::Secondary => self.pin_under_pointer(),
        }
    }

    fn wheel(&mut self, clicks: f64) {
        let over = if self.pixels().over_inset() {
            WheelTarget::Inset
        } else {
            WheelTarget::Picture
        };
        let target = *self.pointer.wheels.get_or_insert(over);
        self.pointer.pins_before = self.inspector.magnifier.pins;
        if target == WheelTarget::Inset
            && let Some(placed) = self.inspector.inset
        {
            self.inspector.magnifier.wheel(clicks, &placed.inset);
        } else if clicks.is_finite() {
            let factor = WHEEL_FACTOR.powf(clicks.clamp(-MAX_CLICKS, MAX_CLICKS));
            let at = self.pointer.at;
            self.inspector.magnifier.spared = at.map(window_pixel);
            self.viewing().zoom(at, factor);
        }
    }
}
