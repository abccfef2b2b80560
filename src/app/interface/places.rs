//! Where things of the picture lie in the window: device pixels as points, and what is left of a rectangle around a hole.

use egui::{Align2, Area, Id, Order, Pos2, Rect, pos2, vec2};

use crate::viewer::{PixelRect, Viewer};

/// Where the insets lie, in points.
pub(super) fn insets(viewer: &Viewer, scale: f32) -> Vec<Rect> {
    let insets = viewer
        .inspector()
        .inset()
        .into_iter()
        .chain(viewer.inspector().other_inset());
    insets.map(|placed| points(&placed.rect, scale)).collect()
}

/// Device pixels as points.
pub(super) fn points(rect: &PixelRect, scale: f32) -> Rect {
    let part = |value: i64| i32::try_from(value).unwrap_or_default() as f32 / scale;
    let size = vec2(rect.width as f32, rect.height as f32) / scale;
    Rect::from_min_size(pos2(part(rect.x), part(rect.y)), size)
}

/// What is left of a rectangle around a hole.
pub(super) fn around(whole: Rect, hole: Option<Rect>) -> Vec<Rect> {
    let Some(hole) = hole.filter(|hole| hole.intersects(whole)) else {
        return vec![whole];
    };
    let hole = hole.intersect(whole);
    let parts = [
        Rect::from_min_max(whole.min, pos2(whole.right(), hole.top())),
        Rect::from_min_max(pos2(whole.left(), hole.bottom()), whole.max),
        Rect::from_min_max(pos2(whole.left(), hole.top()), hole.left_bottom()),
        Rect::from_min_max(hole.right_top(), pos2(whole.right(), hole.bottom())),
    ];
    parts.into_iter().filter(Rect::is_positive).collect()
}

/// What is left of a rectangle around holes.
pub(super) fn beside(whole: Rect, holes: impl IntoIterator<Item = Rect>) -> Vec<Rect> {
    holes.into_iter().fold(vec![whole], |parts, hole| {
        parts.into_iter().flat_map(|part| around(part, Some(hole))).collect()
    })
}

/// What of a pane no inset covers.
pub(super) fn beside_insets(viewer: &Viewer, pane: Rect, scale: f32) -> Vec<Rect> {
    beside(pane, insets(viewer, scale))
}

/// Where a card over the picture goes: about `at`, as far as that leaves it in what is `free`.
pub(super) fn card_area(name: &str, at: Pos2, free: Rect) -> Area {
    Area::new(Id::unique(name))
        .order(Order::Middle)
        .fixed_pos(at)
        .pivot(Align2::CENTER_CENTER)
        .constrain_to(free)
        .fade_in(false)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parts_around_a_hole_are_the_rest() {
        let rect = |x: f32, y: f32, width: f32, height: f32| Rect::from_min_size(pos2(x, y), vec2(width, height));
        let whole = rect(0.0, 0.0, 100.0, 80.0);
        let area = |parts: Vec<Rect>| parts.iter().map(Rect::area).sum::<f32>();
        for (hole, left) in [
            (None, 8000.0),
            (Some(rect(200.0, 0.0, 10.0, 10.0)), 8000.0),
            (Some(rect(20.0, 30.0, 10.0, 10.0)), 7900.0),
            (Some(rect(90.0, 70.0, 50.0, 50.0)), 7900.0),
            (Some(whole), 0.0),
        ] {
            assert!((area(around(whole, hole)) - left).abs() < 0.1, "{hole:?}");
        }
    }
}
