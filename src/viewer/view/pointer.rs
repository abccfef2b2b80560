//! The pointer of the mouse.

use glam::DVec2;

/// A button of the mouse.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum PointerButton {
    /// Left: drags.
    Primary,
    /// Right: pins.
    Secondary,
}

/// Where the pointer is and what it does.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(in crate::viewer) struct Pointer {
    /// Window pixels; `None` outside the window or over a panel.
    pub(in crate::viewer) at: Option<DVec2>,
    /// Whether a drag moves the picture.
    pub(in crate::viewer) dragging: bool,
    /// Whether the wheel turned over the inset and the pointer has rested since: it goes on turning that, wherever the inset
    /// goes.
    pub(in crate::viewer) wheels_inset: bool,
    /// The pin that was set through the inset, which then went elsewhere, while the pointer has rested: the same click unpins
    /// it.
    pub(in crate::viewer) pinned_through_inset: Option<u64>,
}

/// The window pixel that contains a position.
pub(in crate::viewer) fn window_pixel(at: DVec2) -> [i64; 2] {
    #[expect(
        clippy::cast_possible_truncation,
        reason = "far positions saturate, which is as far outside"
    )]
    let floor = |value: f64| value.floor().clamp(-1e9, 1e9) as i64;
    [floor(at.x), floor(at.y)]
}
