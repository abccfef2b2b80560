//! The line of the wipe: where it is to be seen, and how the pointer takes hold of it.

use crate::raster::Framebuffer;
use crate::viewer::ab::other::Arrangement;
use crate::viewer::state::Viewer;

/// Window pixels on either side of the line of a wipe where a press takes hold of it, at a pixel zoom of 1.
const GRIP: f64 = 6.0;

/// Window pixels between the line of a wipe and a panel at least.
const LINE_ROOM: f64 = 48.0;

/// Part of the room between panels that A and B each have at least, until somebody moves the line.
const LEAST_PART: f64 = 0.3;

impl Viewer {
    /// Takes hold of the line of the wipe where the pointer is on it.
    pub(in crate::viewer) fn take_line(&mut self) -> bool {
        self.ab.drags_line = self.pointer_over_line();
        self.ab.drags_line
    }

    /// Whether the pointer is on the line of the wipe, or drags it.
    pub fn pointer_over_line(&self) -> bool {
        let near = |(line, at): (f64, glam::DVec2)| (at.x - line).abs() <= GRIP;
        let over = self.wipe_line().zip(self.pointer.at).is_some_and(near);
        self.ab.drags_line || (over && !self.pointer_over_inset())
    }

    /// The line follows the pointer at `x`, in window pixels from the left.
    pub(in crate::viewer) fn drag_line(&mut self, x: f64) {
        let x = self.in_sight_of_line(x);
        let zoom = f64::from(self.settings.pixel_zoom.factor());
        let panes = self.panes();
        let corner = panes.first.corner[0] as f64;
        let part = (x / zoom - corner) / f64::from(panes.frame[0].max(1));
        self.ab.wipe = Some(part.clamp(0.0, 1.0));
        self.ab.touch();
    }

    /// The first column of the right part, where no panel covers the line.
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "between 0 and a frame's width"
    )]
    pub(in crate::viewer) fn wipe_column(&self, frame: &Framebuffer) -> u32 {
        let width = f64::from(frame.width());
        let zoom = f64::from(self.settings.pixel_zoom.factor());
        let corner = self.panes().first.corner[0] as f64;
        let part = self.ab.wipe.unwrap_or(0.5);
        let wanted = (part.clamp(0.0, 1.0) * width).round();
        let free = self.in_sight_of_line((wanted + corner) * zoom) / zoom - corner;
        free.round().clamp(0.0, width) as u32
    }

    /// The nearest place for the line of the wipe that no panel covers, in window pixels from the left: its grip and its
    /// letters are to be seen beside panels. A line that nobody moved leaves room for both pictures. Without panels any place
    /// will do.
    fn in_sight_of_line(&self, x: f64) -> f64 {
        let Some(free) = self.chrome.free_area else { return x };
        let is_moved = self.ab.wipe.is_some() || self.ab.drags_line;
        let part = if is_moved { 0.0 } else { LEAST_PART };
        let room = LINE_ROOM.max(f64::from(free.width) * part);
        let low = if free.x > 0 { free.x as f64 + room } else { 0.0 };
        let window = i64::from(self.chrome.window[0]);
        let high = if free.right() < window {
            free.right() as f64 - room
        } else {
            window as f64
        };
        let has_room = f64::from(free.width) > 2.0 * room;
        if has_room { x.max(low).min(high) } else { x }
    }

    /// Where the line of the wipe is, in window pixels from the left; `None` where there is none.
    pub fn wipe_line(&self) -> Option<f64> {
        let wipes = self.arrangement() == Arrangement::Wipe;
        let [front, _] = self.pair().filter(|_| wipes)?;
        let column = i64::from(self.wipe_column(front)) + self.panes().first.corner[0];
        let zoom = f64::from(self.settings.pixel_zoom.factor());
        Some(column as f64 * zoom)
    }
}
