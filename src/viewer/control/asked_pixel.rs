//! What a hand asked about while A and B share the window: it stays under the pointer, or at least in sight.

use glam::DVec2;

use crate::viewer::inspector::AskedAt;
use crate::viewer::state::Viewer;
use crate::viewer::view::pointer::window_pixel;

/// Frame pixels that stay free between a panel and a pixel that another arrangement brings near it.
const PANEL_ROOM: i64 = 12;

impl Viewer {
    /// The place of the picture under the pointer; `None` over the inset, too.
    pub(in crate::viewer) fn place_asked_about(&self) -> Option<AskedAt> {
        let at = window_pixel(self.pointer.at?);
        if self.inset_at(at).is_some() {
            return None;
        }
        let zoom = i64::from(self.settings.pixel_zoom.factor());
        let second = self.panes().second;
        let in_second = second.is_some_and(|pane| pane.area.contains(at.map(|side| side.div_euclid(zoom))));
        Some(AskedAt { at, in_second })
    }

    /// Whether the pointer rests where it asked about the pinned pixel, which the room for the explanation took away from
    /// under it: another click there means the pinned one.
    pub(in crate::viewer) fn slid_away(&self) -> bool {
        let Some((asked, at)) = self.inspector.magnifier.asked_at.zip(self.pointer.at) else {
            return false;
        };
        let camera = self.current().map(|entry| entry.camera);
        let has_slid = self
            .inspector
            .magnifier
            .kept_view
            .is_some_and(|[_, set]| Some(set) == camera);
        let has_slid = has_slid || (self.fixed_size().is_some() && self.ab.moved.has_slid());
        has_slid && asked.at == window_pixel(at)
    }

    /// Where in the window a hand asked about the pinned pixel; `None` where it was pinned otherwise.
    pub fn asked_at(&self) -> Option<AskedAt> {
        self.inspector.magnifier.pin.and(self.inspector.magnifier.asked_at)
    }

    /// Grows with every pixel that is pinned.
    pub fn pins(&self) -> u64 {
        self.inspector.magnifier.pins
    }

    /// Another arrangement of A and B has other frames: takes back what the room for an explanation made of the view, and
    /// brings the explained pixel into sight where it would be outside or behind a panel.
    pub(in crate::viewer) fn keep_explained_pin_in_sight(&mut self) {
        if let Some([first, set]) = self.inspector.magnifier.kept_view.take() {
            self.look(|camera, _| {
                if *camera == set {
                    *camera = first;
                }
            });
        }
        let place = self.inspector.magnifier.pin.and_then(|pin| pin.place);
        let (Some((place, _)), Some(context), None) = (place, self.view_context(), self.fixed_size()) else {
            return;
        };
        let Some((camera, free)) = self.current().map(|entry| entry.camera).zip(self.free_screen()) else {
            return;
        };
        let pane = self.panes().first;
        let free = pane.area.intersection(&free);
        let now = camera.transform(&context).to_pixels(place).floor();
        let inside = |axis: usize, from: i64, to: i64| {
            let (low, high) = (
                from - pane.corner[axis] + PANEL_ROOM,
                to - pane.corner[axis] - 1 - PANEL_ROOM,
            );
            now[axis].min(high as f64).max(low as f64)
        };
        let at = DVec2::new(inside(0, free.x, free.right()), inside(1, free.y, free.bottom()));
        if at == now {
            return;
        }
        let mut moved = camera;
        moved.pan(at - now, &context);
        self.inspector.magnifier.kept_view = Some([camera, moved]);
        self.look(|camera, _| *camera = moved);
    }
}
