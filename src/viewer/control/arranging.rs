//! The view while A and B are arranged anew: what lies in the middle of the free picture stays in the middle, and an explained
//! pixel stays in sight.
//!
//! ```text
//!   wipe, difference, alone        side by side
//!   +-----------------+-----+      +--------+--------+-----+
//!   |                 |panel|      |        |        |panel|
//!   |        x        |     |  ->  |   x    |   x    |     |
//!   |                 |     |      |        |        |     |
//!   +-----------------+-----+      +--------+--------+-----+
//! ```

use glam::DVec2;

use crate::figure::PixelRect;
use crate::viewer::control::hand::Hand;
use crate::viewer::view::camera::{Camera, ViewContext};
use crate::viewer::view::layout::WindowLayout;
use crate::viewer::view::panes::{Arranged, Pane, Panes};

/// Frame pixels that stay free between a panel and a pixel that another arrangement brings near it.
const PANEL_ROOM: i64 = 12;

/// Where the canvas and a pinned pixel may go: a camera, its frame's pane and the free part of that.
struct Room {
    camera: Camera,
    context: ViewContext,
    pane: Pane,
    free: PixelRect,
}

impl Hand<'_> {
    /// Frames lie elsewhere than `before`, by another arrangement. A view that a hand has moved shows in the middle of the free
    /// picture what it showed there, to the place of the samples, and going back gives back the very view. One that no hand
    /// has moved is as the window's parts make it. `explains`: whether a pixel was explained there.
    pub(in crate::viewer) fn follow_arrangement(&mut self, before: &WindowLayout, explains: bool) {
        let layout = self.layout();
        if layout.panes() == before.panes() {
            return;
        }
        let kept = self.inspector.magnifier.kept_view;
        // What room for an explanation and a smaller window made of a view is no hand's.
        let own = |camera: Camera| kept.filter(|[_, set]| *set == camera).map_or(camera, |[own, _]| own);
        let is_drawn = before.fixed_size().is_none() && layout.fixed_size().is_none();
        let moved = self
            .scene_list
            .camera()
            .filter(|camera| is_drawn && !own(*camera).is_untouched());
        let Some(camera) = moved else {
            if explains {
                self.take_back_room_for_explanation(&layout);
                self.keep_explained_pin_in_sight(true);
            }
            return;
        };
        let first = self.ab.arranged.filter(|arranged| {
            let [shifted, in_sight] = arranged.set;
            [shifted, in_sight].contains(&camera) || [shifted, in_sight].contains(&own(camera))
        });
        let first = first.unwrap_or_else(|| Arranged {
            own: camera,
            kept,
            panes: before.panes(),
            middle: middle(before),
            set: [camera; 2],
        });
        let set = if first.panes == layout.panes() {
            self.inspector.magnifier.kept_view = first.kept;
            Some(first.own)
        } else {
            self.inspector.magnifier.kept_view = None;
            first.middle.zip(middle(&layout)).and_then(|(old, now)| {
                let context = self.scene_list.view_context(layout.frame_size())?;
                let mut camera = first.own;
                camera.pan(between(&first.panes, &layout.panes(), (now - old).round()), &context);
                Some(camera)
            })
        };
        if let Some(set) = set {
            self.scene_list.look(layout.frame_size(), |camera, _| *camera = set);
        }
        let shifted = self.scene_list.camera().unwrap_or(first.own);
        if explains {
            self.keep_explained_pin_in_sight(false);
        }
        let set = [shifted, self.scene_list.camera().unwrap_or(shifted)];
        self.ab.arranged = Some(Arranged { set, ..first });
    }

    /// Takes back what the room for an explanation made of the view in the frames of another arrangement.
    fn take_back_room_for_explanation(&mut self, layout: &WindowLayout) {
        if let Some(views) = self.inspector.magnifier.kept_view.take() {
            self.scene_list.look_back(layout.frame_size(), views);
        }
    }

    /// Brings the explained pixel into sight where it would be outside or behind a panel; in a half of the window all of the
    /// canvas, if it is to be shown `whole` and has room.
    fn keep_explained_pin_in_sight(&mut self, whole: bool) {
        let layout = self.layout();
        let place = self.inspector.magnifier.pin.and_then(|pin| pin.place);
        let (Some((place, _)), Some(context), None) = (place, self.both().view_context(), self.ab.fixed_size()) else {
            return;
        };
        let Some((camera, free)) = self.scene_list.camera().zip(layout.free_screen()) else {
            return;
        };
        let pane = layout.panes().first;
        let room = Room {
            camera,
            context,
            pane,
            free: pane.area.intersection(&free),
        };
        let by = room.for_pin(place, whole && layout.panes().second.is_some());
        if by == DVec2::ZERO {
            return;
        }
        let mut moved = camera;
        moved.pan(by, &context);
        self.inspector.magnifier.kept_view = Some([camera, moved]);
        self.scene_list.look(layout.frame_size(), |camera, _| *camera = moved);
    }
}

impl Room {
    /// By how many whole pixels the picture has to move for a place of the scene to be in sight; with `whole`, for all of the
    /// canvas to be.
    fn for_pin(&self, place: DVec2, whole: bool) -> DVec2 {
        let (camera, free) = (&self.camera, &self.free);
        let transform = camera.transform(&self.context);
        let now = transform.to_pixels(place).floor();
        let [zero, end] = [DVec2::ZERO, self.context.canvas];
        let corners = [zero, end, DVec2::new(zero.x, end.y), DVec2::new(end.x, zero.y)];
        let corners = corners.map(|corner| transform.to_pixels(corner));
        let by = |axis: usize, from: i64, to: i64| {
            let (from, to) = (from - self.pane.corner[axis], to - self.pane.corner[axis]);
            let inside = (from + PANEL_ROOM) as f64..=(to - 1 - PANEL_ROOM) as f64;
            let (low, high) = (from as f64, to as f64);
            let along = corners.map(|corner| corner[axis]);
            let least = along.into_iter().fold(f64::INFINITY, f64::min).floor();
            let most = along.into_iter().fold(f64::NEG_INFINITY, f64::max).ceil();
            let of_canvas = 0.0_f64.max(low - least).min(high - most);
            // Outside of the canvas a pin may lie anywhere.
            if whole && most - least <= high - low && inside.contains(&(now[axis] + of_canvas)) {
                of_canvas
            } else {
                now[axis].min(*inside.end()).max(*inside.start()) - now[axis]
            }
        };
        DVec2::new(by(0, free.x, free.right()), by(1, free.y, free.bottom()))
    }
}

/// The middle of the free part of the first frame, in screen pixels; `None` where all of it is covered.
fn middle(layout: &WindowLayout) -> Option<DVec2> {
    let free = layout.panes().first.area.intersection(&layout.free_screen()?);
    let size = DVec2::new(f64::from(free.width), f64::from(free.height));
    (free.width > 0 && free.height > 0).then(|| DVec2::new(free.x as f64, free.y as f64) + size / 2.0)
}

/// What a picture has to move by, in frame pixels, so that it lies `by` screen pixels from where it lay: frames grow about
/// their middle.
fn between(old: &Panes, now: &Panes, by: DVec2) -> DVec2 {
    let middle = |panes: &Panes| {
        let corner = DVec2::from(panes.first.corner.map(|side| side as f64));
        corner + DVec2::from(panes.frame.map(f64::from)) / 2.0
    };
    middle(old) - middle(now) + by
}
