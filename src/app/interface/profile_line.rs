//! The line of an edge profile over the picture, with its ends, which can be dragged.

use egui::{Color32, CursorIcon, Pos2, Rect, Stroke, Ui, pos2};
use glam::DVec2;

use super::places::{beside_insets, points};
use crate::viewer::Viewer;

/// Radius of an end, in points: the pixel inside is to be seen.
pub(super) const END: f32 = 5.0;
/// Radius of the mark of a pixel that the pointer is over in the plot, in points.
const MARK: f32 = 4.0;
/// Line and ends on any ground, the widest line first.
const LINE: [(f32, Color32); 2] = [(3.0, Color32::from_black_alpha(150)), (1.0, Color32::WHITE)];

/// Draws the line where neither panels nor insets lie, and a mark where the pixel `pointed` lies; the pointer tells what a
/// drag does.
pub(super) fn show(ui: &Ui, viewer: &Viewer, free: Rect, pointed: Option<[u32; 2]>) {
    let profile = viewer.profile();
    if !profile.is_open() {
        return;
    }
    cursor(ui, viewer);
    let scale = ui.pixels_per_point();
    for place in profile.places() {
        let Some(ends) = near(place.ends) else { continue };
        let [from, to] = ends.map(|end| in_points(end, scale));
        let pane = free.intersect(points(&place.area, scale));
        for part in beside_insets(viewer, pane, scale) {
            let painter = ui.painter().with_clip_rect(part);
            // From ring to ring: an end shows the pixel that it is on.
            let way = to - from;
            let gap = if way.length() > 2.0 * END {
                way.normalized() * END
            } else {
                way / 2.0
            };
            for (width, color) in LINE {
                painter.line_segment([from + gap, to - gap], Stroke::new(width, color));
                for end in [from, to] {
                    painter.circle_stroke(end, END, Stroke::new(width + 0.5, color));
                }
            }
        }
    }
    for place in pointed.into_iter().flat_map(|pixel| profile.middles(pixel)) {
        let pane = free.intersect(points(&place.area, scale));
        let [at, _] = place.ends.map(|end| in_points(end, scale));
        for part in beside_insets(viewer, pane, scale) {
            let edge = Stroke::new(1.5, Color32::BLACK);
            let fill = ui.visuals().selection.bg_fill;
            ui.painter().with_clip_rect(part).circle(at, MARK, fill, edge);
        }
    }
}

fn cursor(ui: &Ui, viewer: &Viewer) {
    let pixels = viewer.pixels();
    let Some(at) = pixels.pointer() else { return };
    let icon = if viewer.profile().is_dragging() {
        CursorIcon::Crosshair
    } else if pixels.over_inset() {
        return;
    } else if viewer.profile().end_at(at).is_some() {
        CursorIcon::Grab
    } else {
        CursorIcon::Crosshair
    };
    ui.ctx().set_cursor_icon(icon);
}

/// The part of a line that a window may show, in window pixels: ends that were brought near one by one would turn it.
fn near([from, to]: [DVec2; 2]) -> Option<[DVec2; 2]> {
    const REACH: f64 = 1e5;
    let way = to - from;
    let (mut first, mut last) = (0.0_f64, 1.0_f64);
    for (at, step) in from.to_array().into_iter().zip(way.to_array()) {
        if step != 0.0 {
            let [low, high] = [-REACH, REACH].map(|side| (side - at) / step);
            (first, last) = (first.max(low.min(high)), last.min(low.max(high)));
        } else if at.abs() > REACH {
            return None;
        }
    }
    (first <= last).then(|| [first, last].map(|part| from + way * part))
}

/// Window pixels as points; far ones are brought near, where no window reaches.
#[expect(clippy::cast_possible_truncation, reason = "clamped")]
pub(super) fn in_points(at: DVec2, scale: f32) -> Pos2 {
    const FAR: f64 = 1e6;
    let [x, y] = at.to_array().map(|side| side.clamp(-FAR, FAR) as f32);
    pos2(x, y) / scale
}

#[cfg(test)]
mod tests {
    use glam::dvec2;

    use super::*;

    #[test]
    fn far_lines_keep_their_slope() {
        let ends = [dvec2(3.5, 4.5), dvec2(70.5, 9.5)];
        assert_eq!(near(ends), Some(ends), "near ones stay");
        let [from, to] = near([dvec2(-4e8, -5e7), dvec2(4e8, 5e7)]).expect("a part through the window");
        let way = to - from;
        assert!((way.y / way.x - 0.125).abs() < 1e-9, "{from} to {to}");
        assert!(from.abs().max_element() < 1.1e5 && to.abs().max_element() < 1.1e5);
        assert_eq!(near([dvec2(-4e8, 5e7), dvec2(4e8, 6e7)]), None, "far below");
        assert_eq!(near([dvec2(2e5, 0.0), dvec2(2e5, 9.0)]), None, "upright and far away");
    }
}
