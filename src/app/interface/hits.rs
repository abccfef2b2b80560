//! Words beside the inspector's large pixel: where it is, its colour, and what its samples hit.

use std::cmp::Reverse;
use std::sync::Arc;

use egui::{Color32, FontId, Galley, Ui, Vec2, pos2, vec2};

use super::places::points;
use crate::inspect::counted;
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
    let height = |galleys: &[Arc<Galley>]| galleys.iter().map(|galley| galley.size().y).sum::<f32>();
    let room = rect.height() + 1.0;
    let mut galleys = numbers(ui, &status, rect.width());
    galleys.extend(shades(ui, viewer, rect.width()));
    while height(&galleys) > room {
        galleys.pop();
    }
    let rest = vec2(rect.width(), room - height(&galleys));
    galleys.extend(words(ui, viewer, rest));
    let mut top = rect.top();
    for galley in galleys {
        let next = top + galley.size().y;
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

/// What the samples hit, what most of them do first: long lines break between words. Where there is not room for all, the
/// last line counts the others.
fn words(ui: &Ui, viewer: &Viewer, room: Vec2) -> Vec<Arc<Galley>> {
    if room.x < LEAST_WIDTH {
        return Vec::new();
    }
    let count = viewer.inspector().pixel_samples().len();
    let mut hits = viewer.inspector().hits();
    hits.sort_by_key(|(_, hits)| Reverse(*hits));
    let line = |text: String| ui.painter().layout(text, FontId::proportional(SIZE), INK, room.x);
    let lines: Vec<_> = hits
        .iter()
        .map(|(hit, hits)| line(format!("{hits} of {count}: {hit}")))
        .collect();
    let heights: Vec<f32> = lines.iter().map(|line| line.size().y).collect();
    let shown = lines_that_fit(&heights, room.y, line("1".to_owned()).size().y);
    let others = lines.len() - shown;
    let mut lines = lines;
    lines.truncate(shown);
    if others > 0 && (shown > 0 || room.y >= line("1".to_owned()).size().y) {
        // They are not colours, which the line above counts.
        lines.push(line(rest(shown, others)));
    }
    lines
}

/// What is said of hits that have no line of their own.
fn rest(shown: usize, others: usize) -> String {
    match shown {
        0 => format!("{} hit", counted(others, "thing")),
        _ => format!("and {others} more hit"),
    }
}

/// How many lines of these heights are shown, where a line of height `last` tells of the others if there is not room for all.
fn lines_that_fit(heights: &[f32], room: f32, last: f32) -> usize {
    let fits = |count: usize, rest: f32| heights[..count].iter().sum::<f32>() + rest <= room;
    if fits(heights.len(), 0.0) {
        return heights.len();
    }
    (0..heights.len()).rev().find(|count| fits(*count, last)).unwrap_or(0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn hits_without_a_line_are_no_colours() {
        // They stand below the number of colours.
        assert_eq!(rest(0, 2), "2 things hit");
        assert_eq!(rest(3, 1), "and 1 more hit");
    }

    #[test]
    fn lines_that_do_not_fit_are_counted_in_one_that_does() {
        let heights = [10.0, 20.0, 10.0, 10.0];
        for (room, expected) in [(50.0, 4), (49.0, 2), (40.0, 2), (39.0, 1), (19.0, 0), (5.0, 0)] {
            assert_eq!(lines_that_fit(&heights, room, 10.0), expected, "{room} points");
        }
    }
}
