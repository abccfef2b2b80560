//! The pinned pixel in the picture itself: a ring around it, so that the eye finds it without the inspector.

use egui::{Color32, Pos2, Rect, Stroke, Ui, Vec2};

use super::places::{around, insets, points};
use crate::viewer::Viewer;

/// Radius of the ring around a pixel of no extent, in points.
pub(super) const RADIUS: f32 = 8.0;
/// What must stay free beside the pinned pixel, so that one sees where it lies, in points.
pub(super) const ROOM: f32 = 24.0;
/// The ring on any ground, the widest line first, in the colour that marks the pixel in the inspector.
const RING: [(f32, Color32); 2] = [(4.5, Color32::WHITE), (2.0, Color32::from_rgb(0xff, 0x3b, 0x30))];
/// How much wider ring and lines are where they are to be seen from afar; the letters grow besides.
const PRESENTED: f32 = 1.6;

/// How wide ring and lines are: 1 as usual.
fn width(viewer: &Viewer) -> f32 {
    if viewer.chrome().presenter() { PRESENTED } else { 1.0 }
}

/// Draws the ring where neither panels nor insets lie. The pixel and its neighbours stay as they are.
pub(super) fn show(ui: &Ui, viewer: &Viewer, free: Rect) {
    let scale = ui.pixels_per_point();
    let parts = insets(viewer, scale).into_iter().fold(vec![free], |parts, hole| {
        parts.into_iter().flat_map(|part| around(part, Some(hole))).collect()
    });
    for (center, radius) in circles(viewer, scale) {
        for part in &parts {
            let painter = ui.painter().with_clip_rect(*part);
            for (line, color) in RING {
                painter.circle_stroke(center, radius, Stroke::new(line * width(viewer), color));
            }
        }
    }
}

/// What the rings take, in points.
pub(super) fn rings(viewer: &Viewer, scale: f32) -> impl Iterator<Item = Rect> {
    let line = RING[0].0 * width(viewer);
    let square = move |(center, radius)| Rect::from_center_size(center, Vec2::splat(2.0 * radius + line));
    circles(viewer, scale).map(square)
}

/// Centres and radii of the rings, in points.
fn circles(viewer: &Viewer, scale: f32) -> impl Iterator<Item = (Pos2, f32)> {
    viewer.pixels().pinned_places().into_iter().map(move |place| {
        let pixel = points(&place, scale);
        (pixel.center(), RADIUS * width(viewer) + pixel.size().length() / 2.0)
    })
}
