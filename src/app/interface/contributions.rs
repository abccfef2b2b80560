//! The pixels that the texel under the pointer contributes to: lit in the magnifier and in the picture.

use egui::{Color32, Mesh, Painter, Rect, Stroke, StrokeKind, Ui};

use super::places::{around, points};
use crate::viewer::Viewer;

/// What is lit, over anything: a light line on a dark one.
pub(super) const LIT: [(f32, Color32); 2] = [
    (3.5, Color32::from_black_alpha(190)),
    (1.5, Color32::from_rgb(64, 224, 255)),
];
/// Smallest side of a pixel that is framed and not filled, in points.
const FRAMED: f32 = 6.0;
/// How strongly a pixel is lit that reads next to nothing of the texel.
const LEAST: f64 = 0.35;
/// From the lit pixels to the frame that helps to find them, in points.
const AROUND: f32 = 4.0;

/// Lights them, in the picture where no panel covers it.
pub(super) fn show(ui: &Ui, viewer: &Viewer, free: Rect) {
    let fed = viewer.inspector().contributed_pixels();
    let most = fed.iter().fold(0.0_f64, |most, fed| most.max(fed.weight));
    let scale = ui.pixels_per_point();
    let inset = viewer.inspector().inset();
    let parts = around(free, inset.map(|placed| points(&placed.rect, scale)));
    let mut all = Rect::NOTHING;
    for fed in fed {
        #[expect(clippy::cast_possible_truncation, reason = "between 0 and 1")]
        let strength = (LEAST + (1.0 - LEAST) * fed.weight / most) as f32;
        let place = points(&viewer.both().layout().shown_at(fed.pixel), scale);
        all |= place;
        for part in parts.iter().filter(|part| part.intersects(place)) {
            light(&ui.painter().with_clip_rect(*part), place, strength);
        }
        let block = inset.and_then(|placed| placed.block(fed.pixel.map(i64::from)));
        if let Some(block) = block {
            light(ui.painter(), points(&block, scale), strength);
        }
    }
    for part in parts.iter().filter(|_| all.is_positive()) {
        frame(&ui.painter().with_clip_rect(*part), all.expand(AROUND), 1.0);
    }
}

/// Frames a pixel where it is large enough to be seen in its frame, else fills it.
fn light(painter: &Painter, pixel: Rect, strength: f32) {
    if pixel.width() < FRAMED {
        // Without the soft edges of other shapes, in which a single pixel would be lost.
        let mut mesh = Mesh::default();
        mesh.add_colored_rect(pixel, LIT[1].1.gamma_multiply(strength));
        painter.add(mesh);
    } else {
        frame(painter, pixel.shrink(0.5), strength);
    }
}

fn frame(painter: &Painter, rect: Rect, strength: f32) {
    for (width, color) in LIT {
        let stroke = Stroke::new(width, color.gamma_multiply(strength));
        painter.rect_stroke(rect, 0.0, stroke, StrokeKind::Inside);
    }
}
