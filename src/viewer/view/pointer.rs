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

/// What the wheel turns.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::viewer) enum WheelTarget {
    /// The magnification of the inset.
    Inset,
    /// The scale of the picture.
    Picture,
}

/// Where the pointer is and what it does.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(in crate::viewer) struct Pointer {
    /// Window pixels; `None` outside the window or over a panel.
    pub(in crate::viewer) at: Option<DVec2>,
    /// Whether a drag moves the picture.
    pub(in crate::viewer) dragging: bool,
    /// Whether a drag moves the inset from corner to corner.
    pub(in crate::viewer) drags_inset: bool,
    /// What the wheel turned while the pointer has rested: it goes on turning that, wherever the inset goes.
    pub(in crate::viewer) wheels: Option<WheelTarget>,
    /// The pin that was set through the inset, which then went elsewhere, while the pointer has rested: the same click unpins
    /// it.
    pub(in crate::viewer) pinned_through_inset: Option<u64>,
    /// How many pins there had been when it last moved: one that came later, such as by arrow keys, is what is meant while it
    /// rests.
    pub(in crate::viewer) pins_before: u64,
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
