//! The pinned pixel in the picture itself: a ring around it, so that the eye finds it without the inspector.

use egui::{Color32, Pos2, Rect, Stroke, Ui, Vec2};

use super::places::{beside_insets, points};
use crate::figure::PinRing;
use crate::viewer::Viewer;

/// What must stay free beside the pinned pixel, so that one sees where it lies, in points.
pub(super) const ROOM: f32 = 24.0;
/// How much wider ring and lines are where they are to be seen from afar; the letters grow besides.
const PRESENTED: f32 = 1.6;

/// How wide ring and lines are: 1 as usual.
fn width(viewer: &Viewer) -> f32 {
    if viewer.chrome().presenter() { PRESENTED } else { 1.0 }
}

/// Draws the ring where neither panels nor insets lie. The pixel and its neighbours stay as they are.
pub(super) fn show(ui: &Ui, viewer: &Viewer, free: Rect) {
    let scale = ui.pixels_per_point();
    let parts = beside_insets(viewer, free, scale);
    for (center, radius) in circles(viewer, scale) {
        for part in &parts {
            let painter = ui.painter().with_clip_rect(*part);
            for (line, color) in PinRing::LINES {
                let [_, r, g, b] = color.to_be_bytes();
                let color = Color32::from_rgb(r, g, b);
                painter.circle_stroke(center, radius, Stroke::new(line * width(viewer), color));
            }
        }
    }
}

/// What the rings take, in points.
pub(super) fn rings(viewer: &Viewer, scale: f32) -> impl Iterator<Item = Rect> {
    let line = PinRing::LINES[0].0 * width(viewer);
    let square = move |(center, radius)| Rect::from_center_size(center, Vec2::splat(2.0 * radius + line));
    circles(viewer, scale).map(square)
}

/// Centres and radii of the rings, in points.
fn circles(viewer: &Viewer, scale: f32) -> impl Iterator<Item = (Pos2, f32)> {
    viewer.pixels().pinned_places().into_iter().map(move |place| {
        let pixel = points(&place, scale);
        (pixel.center(), PinRing::radius(pixel.size().into(), width(viewer)))
    })
}
