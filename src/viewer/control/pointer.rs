//! What the pointer is over, and what its moves and presses do.

use glam::DVec2;

use crate::viewer::PixelRect;
use crate::viewer::inspector::PlacedInset;
use crate::viewer::state::Viewer;
use crate::viewer::view::pointer::{PointerButton, window_pixel};

impl Viewer {
    /// The pointer in window pixels; `None` outside the window or over a panel.
    pub fn pointer(&self) -> Option<DVec2> {
        self.pointer.at
    }

    /// Whether the pointer is over the inspector's inset.
    pub fn pointer_over_inset(&self) -> bool {
        self.pointer
            .at
            .is_some_and(|at| self.inset_at(window_pixel(at)).is_some())
    }

    /// The inset that lies over a window pixel, A's or B's.
    pub(in crate::viewer) fn inset_at(&self, at: [i64; 2]) -> Option<PlacedInset> {
        let mut insets = self.inspector.inset.into_iter().chain(self.inspector.other_inset);
        insets.find(|placed| placed.rect.contains(at))
    }

    /// Whether a drag is moving the picture.
    pub fn is_dragging(&self) -> bool {
        self.pointer.dragging
    }

    /// The frame pixel under the pointer: over the inset the magnified one.
    pub fn hovered_pixel(&self) -> Option<[u32; 2]> {
        let at = window_pixel(self.pointer.at?);
        let pixel = match self.inset_at(at) {
            Some(inset) => inset.pixel_at(at)?,
            None => self.frame_pixel(at),
        };
        self.in_frame(pixel)
    }

    pub(in crate::viewer) fn pointer_moved(&mut self, to: DVec2) {
        if !to.is_finite() {
            return;
        }
        let from = self.pointer.at.replace(to);
        if from != Some(to) {
            (self.pointer.wheels_inset, self.pointer.pinned_through_inset) = (false, None);
        }
        if self.ab.drags_line {
            self.drag_line(to.x);
        } else if let Some(from) = from.filter(|_| self.pointer.dragging) {
            self.pan(to - from);
        }
        self.follow_pointer();
    }

    /// Remembers the pixel under the pointer for the inspector. Unpinned, the inset gives way to the pointer, so what
    /// lies below the inset counts.
    pub(in crate::viewer) fn follow_pointer(&mut self) {
        if self.inspector.magnifier.pin.is_some() && self.pointer_over_inset() {
            return;
        }
        let Some(at) = self.pointer.at else { return };
        let pixel = self.frame_pixel(window_pixel(at));
        self.inspector.magnifier.last = self.in_frame(pixel).or(self.inspector.magnifier.last);
    }

    /// The frame pixel at a window pixel; it may lie outside the frame.
    fn frame_pixel(&self, at: [i64; 2]) -> [i64; 2] {
        let zoom = i64::from(self.settings.pixel_zoom.factor());
        let screen = at.map(|side| side.div_euclid(zoom));
        let corner = self.panes().at(screen).corner;
        [screen[0] - corner[0], screen[1] - corner[1]]
    }

    /// The place in the frame, in frame pixels, of a place in the window.
    pub(in crate::viewer) fn frame_position(&self, at: DVec2) -> DVec2 {
        let zoom = f64::from(self.settings.pixel_zoom.factor());
        let screen = at / zoom;
        let [x, y] = self.panes().at(window_pixel(screen)).corner;
        screen - DVec2::new(x as f64, y as f64)
    }

    pub(in crate::viewer) fn pointer_pressed(&mut self, button: PointerButton) {
        match button {
            PointerButton::Primary => {
                let on_line = self.take_line();
                self.pointer.dragging = self.pointer.at.is_some() && !on_line;
            }
            PointerButton::Secondary => self.pin_under_pointer(),
        }
    }

    /// Where a frame pixel is to be seen, in window pixels.
    pub fn shown_at(&self, pixel: [u32; 2]) -> PixelRect {
        let zoom = self.settings.pixel_zoom.factor();
        let [x, y] = pixel.map(i64::from);
        let [left, top] = self.panes().first.corner;
        PixelRect {
            x: (left + x) * i64::from(zoom),
            y: (top + y) * i64::from(zoom),
            width: zoom,
            height: zoom,
        }
    }

    /// The pixel, if the frame has it.
    pub(in crate::viewer) fn in_frame(&self, pixel: [i64; 2]) -> Option<[u32; 2]> {
        let [width, height] = self.frame_size();
        let inside = |value: i64, side: u32| u32::try_from(value).ok().filter(|value| *value < side);
        Some([inside(pixel[0], width)?, inside(pixel[1], height)?])
    }

    /// The frame's nearest pixel; `None` if it has no pixels.
    pub(in crate::viewer) fn nearest_in_frame(&self, pixel: [i64; 2]) -> Option<[u32; 2]> {
        let [width, height] = self.frame_size();
        let last = [i64::from(width) - 1, i64::from(height) - 1];
        self.in_frame([pixel[0].min(last[0]).max(0), pixel[1].min(last[1]).max(0)])
    }
}
