//! On which side of the picture the explanation of a pixel stands.

use egui::{Rangef, Rect};

use super::places::points;
use super::{look, pin};
use crate::figure::PinRing;
use crate::viewer::{Arrangement, AskedAt, Viewer};

/// Which side the panel takes in the room that other panels leave. It is chosen when the panel opens and when another
/// pixel is pinned that it would cover, never by how A and B are shown: its buttons stay under the pointer.
#[derive(Clone, Copy, Debug)]
pub(super) struct Side {
    /// Whether it is the left one.
    pub(super) is_left: bool,
    /// The pin that it was chosen for.
    pins: u64,
    /// The window's width then, in points.
    width: f32,
}

/// Where the panel goes, in points.
#[derive(Clone, Copy, Debug)]
pub(super) struct Room {
    /// What other panels leave.
    pub(super) free: Rect,
    /// The panel's width.
    pub(super) panel: f32,
    /// The window's.
    pub(super) window: f32,
}

impl Room {
    /// What the panel leaves.
    fn beside(&self, is_left: bool) -> Rect {
        if is_left {
            self.free.with_min_x(self.free.left() + self.panel)
        } else {
            self.free.with_max_x(self.free.right() - self.panel)
        }
    }
}

impl Side {
    /// The side `before`, unless that will not do for another pin or another window of `width` points.
    pub(super) fn choose(before: Option<Self>, viewer: &Viewer, room: Room, scale: f32) -> Self {
        let (pins, width) = (viewer.inspector().pins(), room.window);
        #[expect(clippy::float_cmp, reason = "the same window")]
        let stays = |side: &Self| (side.pins == pins && side.width == width) || !side.covers_pin(viewer, room, scale);
        let is_left = before
            .filter(stays)
            .map_or_else(|| opens_left(viewer, room, scale), |side| side.is_left);
        Self { is_left, pins, width }
    }

    fn covers_pin(self, viewer: &Viewer, room: Room, scale: f32) -> bool {
        let rest = room.beside(self.is_left).shrink(pin::ROOM);
        let places = viewer.pixels().pinned_places();
        places
            .iter()
            .any(|place| !rest.x_range().contains(points(place, scale).center().x))
    }
}

/// Whether the panel opens on the left: unless the pinned pixel lies there. Side by side the place that was clicked is to
/// stay in its own half.
fn opens_left(viewer: &Viewer, room: Room, scale: f32) -> bool {
    let asked = viewer
        .inspector()
        .asked_at()
        .filter(|_| viewer.ab().arrangement() == Arrangement::SideBySide);
    if let Some(AskedAt { at: [x, _], in_second }) = asked {
        let x = i32::try_from(x).unwrap_or_default() as f32 / scale;
        let fitness = |is_left: bool| {
            let rest = room.beside(is_left);
            let middle = rest.center().x;
            let half = if in_second {
                Rangef::new(middle, rest.right())
            } else {
                Rangef::new(rest.left(), middle)
            };
            (half.shrink(PinRing::RADIUS).contains(x), rest.x_range().contains(x))
        };
        return fitness(true) >= fitness(false);
    }
    let places = viewer.pixels().pinned_places();
    let x = places.first().map(|place| points(place, scale).left());
    x.is_none_or(|x| x > room.free.left() + room.panel + look::PANEL_WIDTH / 8.0)
}
