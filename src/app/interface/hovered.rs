//! What the pointer is over in an explanation, outlined in the picture.

use egui::{Color32, Pos2, Rect, Shape, Stroke, Ui, pos2};

use super::places::{around, points};
use crate::inspect::TexelPlace;
use crate::viewer::{Arrangement, Command, InspectorCommand, Viewer};

/// What outlines are drawn with, over anything: a light line on a dark one.
pub(super) const OUTLINE: [(f32, Color32); 2] = [
    (4.0, Color32::from_black_alpha(170)),
    (1.5, Color32::from_rgb(255, 214, 10)),
];

/// What the pointer is over.
#[derive(Debug, Default)]
pub(super) struct Hovered {
    /// A primitive of the scene.
    pub(super) primitive: Option<u32>,
    /// A sample.
    pub(super) sample: Option<usize>,
    /// A texel.
    pub(super) texel: Option<TexelPlace>,
}

impl Hovered {
    /// Tells the viewer which texel the pointer is over.
    pub(super) fn point_at_texel(&self, viewer: &Viewer, commands: &mut Vec<Command>) {
        if self.texel != viewer.inspector().pointed_texel() {
            commands.push(Command::Inspector(InspectorCommand::PointAtTexel(self.texel)));
        }
    }

    /// Outlines the primitive that the pointer is over in the picture, where no panel covers it; but for a texel, whose
    /// pixels are lit instead.
    pub(super) fn outline(&self, ui: &Ui, viewer: &Viewer, free: Rect) {
        let Some(primitive) = self.primitive.filter(|_| self.texel.is_none()) else {
            return;
        };
        let scale = f64::from(ui.pixels_per_point());
        #[expect(clippy::cast_possible_truncation, reason = "what is far outside is clipped")]
        let point = |[x, y]: [f64; 2]| {
            let near = |at: f64| (at / scale).clamp(-1e5, 1e5) as f32;
            pos2(near(x), near(y))
        };
        let contours: Vec<Vec<Pos2>> = viewer
            .both()
            .outline_of(primitive)
            .iter()
            .map(|contour| contour.iter().map(|at| point(*at)).collect())
            .collect();
        let inset = viewer
            .inspector()
            .inset()
            .map(|placed| points(&placed.rect, ui.pixels_per_point()));
        let shown = match viewer.ab().arrangement() {
            Arrangement::SideBySide => free.with_max_x(free.center().x),
            _ => free,
        };
        for part in around(shown, inset) {
            let painter = ui.painter().with_clip_rect(part);
            for (width, color) in OUTLINE {
                for contour in &contours {
                    // Closed lines have spikes at sharp corners, as long as the sides of the line take to meet.
                    let closed = contour.iter().chain(contour.first()).copied().collect();
                    painter.add(Shape::line(closed, Stroke::new(width, color)));
                }
            }
        }
    }
}
