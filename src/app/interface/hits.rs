//! Words beside the inspector's large pixel: where it is, its colour, and what its samples hit.

use std::sync::Arc;

use egui::{Color32, FontId, Galley, Ui, pos2};

use super::places::points;
use crate::viewer::{Status, Viewer};

/// The inset's ground is light in every theme.
const INK: Color32 = Color32::from_rgb(0x20, 0x24, 0x28);
/// Height of the letters, in points.
const SIZE: f32 = 11.0;

/// Width below which words about hits would break into letters, in points.
const LEAST_WIDTH: f32 = 64.0;

/// Writes as many lines as fit, each wholly or not at all: half a number would be another number.
pub(super) fn hits(ui: &Ui, viewer: &Viewer) {
    let Some(placed) = viewer.inspector().inset() else {
        return;
    };
    let (Some(area), Some(status)) = (
        placed.text_area(),
        viewer
            .pixels()
            .inspected()
            .and_then(|pixel| viewer.pixels().status_of(pixel)),
    ) else {
        return;
    };
    let rect = points(&area, ui.pixels_per_point());
    let galleys = numbers(ui, &status, rect.width())
        .into_iter()
        .chain(shades(ui, viewer, rect.width()))
        .chain(words(ui, viewer, rect.width()));
    let mut top = rect.top();
    for galley in galleys {
        let next = top + galley.size().y;
        if next > rect.bottom() + 1.0 {
            break;
        }
        ui.painter().galley(pos2(rect.left(), top), galley, INK);
        top = next;
    }
}

/// Place and colour: lines that must not break, so that those that are too long are left out.
fn numbers(ui: &Ui, status: &Status, width: f32) -> Vec<Arc<Galley>> {
    let line = |text: String| {
        let galley = ui.painter().layout_no_wrap(text, FontId::proportional(SIZE), INK);
        (galley.size().x <= width).then_some(galley)
    };
    let [x, y] = status.pixel;
    let mut lines = vec![line(format!("pixel {x}, {y}")).or_else(|| line(format!("{x}, {y}")))];
    if let Some((decimal, hex)) = status.decimal_text().zip(status.hex_text()) {
        match line(format!("{decimal}  {hex}")) {
            Some(both) => lines.push(Some(both)),
            None => lines.extend([line(decimal), line(hex)]),
        }
    }
    lines.into_iter().flatten().collect()
}

/// How many colours the region has: along an edge, how well it is sampled.
fn shades(ui: &Ui, viewer: &Viewer, width: f32) -> Option<Arc<Galley>> {
    let colors = viewer.pixels().region_colors()?;
    let text = format!("{colors} {} shown", if colors == 1 { "colour" } else { "colours" });
    let galley = ui.painter().layout_no_wrap(text, FontId::proportional(SIZE), INK);
    (galley.size().x <= width).then_some(galley)
}

/// What the samples hit: long lines break between words.
fn words(ui: &Ui, viewer: &Viewer, width: f32) -> Vec<Arc<Galley>> {
    if width < LEAST_WIDTH {
        return Vec::new();
    }
    let count = viewer.inspector().pixel_samples().len();
    let hits = viewer.inspector().hits();
    let lines = hits.iter().map(|(hit, hits)| format!("{hits} of {count}: {hit}"));
    lines
        .map(|line| ui.painter().layout(line, FontId::proportional(SIZE), INK, width))
        .collect()
}
