//! The pinned pixel in the picture itself: a ring around it, so that the eye finds it without the inspector.

use egui::{Color32, Rect, Stroke, Ui};

use super::floating::{around, points};
use crate::viewer::Viewer;

/// Radius of the ring around a pixel of no extent, in points.
pub(super) const RADIUS: f32 = 8.0;
/// What must stay free beside the pinned pixel, so that one sees where it lies, in points.
pub(super) const ROOM: f32 = 24.0;
/// The ring on any ground, the widest line first, in the colour that marks the pixel in the inspector.
const RING: [(f32, Color32); 2] = [(4.5, Color32::WHITE), (2.0, Color32::from_rgb(0xff, 0x3b, 0x30))];

/// Draws the ring where neither panels nor insets lie. The pixel and its neighbours stay as they are.
pub(super) fn show(ui: &Ui, viewer: &Viewer, free: Rect) {
    let scale = ui.pixels_per_point();
    let insets = viewer.inset().into_iter().chain(viewer.other_inset());
    let parts = insets.fold(vec![free], |parts, placed| {
        let hole = points(&placed.rect, scale);
        parts.into_iter().flat_map(|part| around(part, Some(hole))).collect()
    });
    for place in viewer.pinned_places() {
        let pixel = points(&place, scale);
        let radius = RADIUS + pixel.size().length() / 2.0;
        for part in &parts {
            let painter = ui.painter().with_clip_rect(*part);
            for (width, color) in RING {
                painter.circle_stroke(pixel.center(), radius, Stroke::new(width, color));
            }
        }
    }
}
