//! The line of the wipe: where it lies, and how it gives way to panels.

use crate::viewer::ab::comparison::Comparison;
use crate::viewer::view::layout::WindowLayout;

/// Window pixels between the line of a wipe and a panel at least.
const LINE_ROOM: f64 = 48.0;

/// Part of the room between panels that A and B each have at least, until somebody moves the line.
const LEAST_PART: f64 = 0.3;

impl Comparison {
    /// The line follows the pointer at `x`, in window pixels from the left.
    pub(in crate::viewer) fn drag_line(&mut self, x: f64, layout: &WindowLayout) {
        let x = self.in_sight_of_line(x, layout);
        let zoom = f64::from(layout.zoom());
        let panes = layout.panes();
        let corner = panes.first.corner[0] as f64;
        let part = (x / zoom - corner) / f64::from(panes.frame[0].max(1));
        self.wipe = Some(part.clamp(0.0, 1.0));
        self.touch();
    }

    /// The first column of the right part of frames of this width, where no panel covers the line.
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "between 0 and a frame's width"
    )]
    pub(in crate::viewer) fn wipe_column(&self, width: u32, layout: &WindowLayout) -> u32 {
        let width = f64::from(width);
        let zoom = f64::from(layout.zoom());
        let corner = layout.panes().first.corner[0] as f64;
        let part = self.wipe.unwrap_or(0.5);
        let wanted = (part.clamp(0.0, 1.0) * width).round();
        let free = self.in_sight_of_line((wanted + corner) * zoom, layout) / zoom - corner;
        free.round().clamp(0.0, width) as u32
    }

    /// The nearest place for the line of the wipe that no panel covers, in window pixels from the left: its grip and its
    /// letters are to be seen beside panels. A line that nobody moved leaves room for both pictures. Without panels any place
    /// will do.
    fn in_sight_of_line(&self, x: f64, layout: &WindowLayout) -> f64 {
        let Some(free) = layout.free_area() else { return x };
        let is_moved = self.wipe.is_some() || self.drags_line;
        let part = if is_moved { 0.0 } else { LEAST_PART };
        let room = LINE_ROOM.max(f64::from(free.width) * part);
        let low = if free.x > 0 { free.x as f64 + room } else { 0.0 };
        let window = i64::from(layout.window()[0]);
        let high = if free.right() < window {
            free.right() as f64 - room
        } else {
            window as f64
        };
        let has_room = f64::from(free.width) > 2.0 * room;
        if has_room { x.max(low).min(high) } else { x }
    }
}
