//! A pixel that grows sample by sample: its mean so far, and how the covered part comes closer to the true area.

use egui::{Color32, Pos2, Rect, RichText, Sense, Shape, Slider, Stroke, Ui, pos2, vec2};

use super::look::opaque;
use crate::inspect::Explanation;

/// Height of the plot, in points.
const HEIGHT: f32 = 72.0;
/// What stands beside the slider, in points.
const BESIDE: f32 = 116.0;

/// The slider, the colour so far, the plot. `accumulated` is how many samples count; none means all.
pub(super) fn show(ui: &mut Ui, explanation: &Explanation, accumulated: &mut Option<usize>) {
    let all = explanation.samples.len();
    let mut count = accumulated.unwrap_or(all).clamp(1, all);
    ui.horizontal(|ui| {
        // What is beside it needs room: its number and its word.
        ui.spacing_mut().slider_width = (ui.available_width() - BESIDE).clamp(40.0, 180.0);
        let slider = ui.add(Slider::new(&mut count, 1..=all).text("samples"));
        if slider.changed() {
            *accumulated = Some(count);
        }
    });
    // Not a tip, which would lie over what the slider shows.
    let words = "The mean of the first samples, in the order of the pattern";
    ui.label(RichText::new(words).size(11.0).weak());
    let mean = explanation.mean_of_first(count);
    ui.horizontal(|ui| {
        let (rect, _) = ui.allocate_exact_size(vec2(28.0, 18.0), Sense::hover());
        ui.painter().rect_filled(rect, 2.0, opaque(mean));
        let [r, g, b, _] = mean;
        ui.label(
            RichText::new(format!("{r} {g} {b}  after {count} of {all}"))
                .monospace()
                .size(11.0),
        );
    });
    let Some(convergence) = explanation.convergence() else {
        return;
    };
    let (rect, _) = ui.allocate_exact_size(vec2(ui.available_width() - 4.0, HEIGHT), Sense::hover());
    plot(ui, rect, &convergence.parts, convergence.area, count);
    let words = format!(
        "{}: {:.1} % of {count} samples; {:.1} % of the area (line)",
        convergence.name,
        convergence.parts[count - 1] * 100.0,
        convergence.area * 100.0
    );
    ui.label(RichText::new(words).size(11.0).weak());
}

/// The covered part after each sample, the true area as a level line.
#[expect(clippy::cast_possible_truncation, reason = "places on a screen")]
fn plot(ui: &Ui, rect: Rect, parts: &[f64], area: f64, count: usize) {
    let painter = ui.painter();
    painter.rect_filled(rect, 2.0, ui.visuals().extreme_bg_color);
    let inside = rect.shrink(4.0);
    let last = parts.len().saturating_sub(1).max(1) as f32;
    let at = |i: usize, part: f64| -> Pos2 {
        pos2(
            inside.left() + inside.width() * i as f32 / last,
            inside.bottom() - inside.height() * part as f32,
        )
    };
    let truth = [at(0, area), pos2(inside.right(), at(0, area).y)];
    painter.extend(Shape::dashed_line(
        &truth,
        Stroke::new(1.0, Color32::from_rgb(230, 159, 0)),
        5.0,
        3.0,
    ));
    let points: Vec<Pos2> = parts.iter().enumerate().map(|(i, part)| at(i, *part)).collect();
    let line = ui.visuals().strong_text_color();
    painter.add(Shape::line(points.clone(), Stroke::new(1.5, line)));
    if let Some(now) = points.get(count - 1) {
        painter.circle_filled(*now, 3.5, ui.visuals().selection.bg_fill);
        painter.circle_stroke(*now, 3.5, Stroke::new(1.0, line));
    }
}
