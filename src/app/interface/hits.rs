//! Words beside the inspector's large pixel: where it is, its colour, and what its samples hit.

use egui::{Color32, FontId, Rect, Ui, pos2, vec2};

use crate::viewer::Viewer;

/// The inset's ground is light in every theme.
const INK: Color32 = Color32::from_rgb(0x20, 0x24, 0x28);
/// Height of the letters, in points.
const SIZE: f32 = 11.0;

/// Writes as many lines as fit.
pub(super) fn hits(ui: &Ui, viewer: &Viewer) {
    let scale = ui.pixels_per_point();
    let Some(placed) = viewer.inset() else { return };
    let (Some(area), Some(status)) = (
        placed.text_area(),
        viewer.inspected_pixel().and_then(|pixel| viewer.status_of(pixel)),
    ) else {
        return;
    };
    let part = |value: i64| i32::try_from(value).unwrap_or_default() as f32 / scale;
    let size = vec2(area.width as f32, area.height as f32) / scale;
    let rect = Rect::from_min_size(pos2(part(area.x), part(area.y)), size);
    let [x, y] = status.pixel;
    let mut lines = vec![format!("pixel {x}, {y}")];
    lines.extend(
        status
            .decimal_text()
            .zip(status.hex_text())
            .map(|(decimal, hex)| format!("{decimal}  {hex}")),
    );
    let count = viewer.pixel_samples().len();
    lines.extend(
        viewer
            .hits()
            .iter()
            .map(|(hit, hits)| format!("{hits} of {count}: {hit}")),
    );
    let painter = ui.painter().with_clip_rect(rect);
    let mut top = rect.top();
    for line in lines {
        let galley = painter.layout_no_wrap(line, FontId::proportional(SIZE), INK);
        if top + galley.size().y > rect.bottom() + 1.0 {
            break;
        }
        let next = top + galley.size().y;
        painter.galley(pos2(rect.left(), top), galley, INK);
        top = next;
    }
}
