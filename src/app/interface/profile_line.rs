//! The line of an edge profile over the picture, with its ends, which can be dragged.

use egui::{Color32, CursorIcon, Pos2, Rect, Stroke, Ui, pos2};
use glam::DVec2;

use super::places::{beside_insets, points};
use crate::viewer::Viewer;

/// Radius of an end, in points: the pixel inside is to be seen.
const END: f32 = 5.0;
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
        let [from, to] = place.ends.map(|end| in_points(end, scale));
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

/// Window pixels as points; far ones are brought near, where no window reaches.
#[expect(clippy::cast_possible_truncation, reason = "clamped")]
pub(super) fn in_points(at: DVec2, scale: f32) -> Pos2 {
    const FAR: f64 = 1e6;
    let [x, y] = at.to_array().map(|side| side.clamp(-FAR, FAR) as f32);
    pos2(x, y) / scale
}
