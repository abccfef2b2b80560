//! A pixel with its samples as dots in their own colours: the pointer lights one, a click or the arrows choose the one that is told
//! in full.

use egui::{Color32, Pos2, Rect, Role, Sense, Stroke, StrokeKind, Ui, Vec2, WidgetInfo, vec2};

use super::focus;
use super::hovered::OUTLINE;
use super::look::opaque;
use super::report::lines;
use crate::figure::is_dark;
use crate::inspect::{Explanation, Sample};

/// Side of the pixel, in points.
const SIDE: f32 = 132.0;
/// How much farther a sample aside of an arrow's direction counts than one ahead.
const ASIDE: f32 = 3.0;

/// Shows it; the sample that the pointer is over.
pub(super) fn show(ui: &mut Ui, explanation: &Explanation, chosen: &mut Option<usize>) -> Option<usize> {
    let mut nearest = None;
    ui.horizontal_top(|ui| {
        let (rect, response) = ui.allocate_exact_size(vec2(SIDE, SIDE), Sense::click());
        let samples = &explanation.samples;
        nearest = response.hover_pos().and_then(|pointer| {
            let distance = |i: usize| at_part(rect, samples[i].position).distance_sq(pointer);
            (0..samples.len()).min_by(|a, b| distance(*a).total_cmp(&distance(*b)))
        });
        // The space bar clicks, too, and points nowhere.
        if response.clicked() && nearest.is_some() {
            *chosen = nearest.filter(|nearest| *chosen != Some(*nearest));
        }
        for step in focus::arrows_in(ui, &response) {
            *chosen = neighbour(samples, *chosen, step);
        }
        response.widget_info(|| WidgetInfo::labeled(Role::Image, true, "Samples of the pixel"));
        let told = nearest.or(*chosen);
        draw(ui, explanation, rect, told);
        let words = match told {
            Some(sample) => {
                let mut words = vec![explanation.sample_title(sample)];
                words.extend(explanation.short_sample_lines(sample));
                words
            }
            None if explanation.exact => vec!["It holds one colour, and has no samples.".to_owned()],
            None => vec!["Point at a sample to light what it shows, click to choose it.".to_owned()],
        };
        // No words are higher than the pixel: what stands below stays under the pointer.
        ui.vertical(|ui| {
            ui.set_height(SIDE);
            ui.set_clip_rect(ui.clip_rect().intersect(ui.max_rect()));
            lines(ui, &words);
        });
    });
    nearest
}

/// The sample that an arrow leads to: the nearest in its direction. From none, the one in the middle.
fn neighbour(samples: &[Sample], from: Option<usize>, step: Vec2) -> Option<usize> {
    let Some(start) = from.and_then(|from| samples.get(from)) else {
        let middle = |i: usize| (place(samples[i].position) - Vec2::splat(0.5)).length_sq();
        return (0..samples.len()).min_by(|a, b| middle(*a).total_cmp(&middle(*b)));
    };
    let away = |sample: &Sample| {
        let by = place(sample.position) - place(start.position);
        let ahead = by.dot(step);
        (ahead > 1e-6).then(|| ahead + ASIDE * by.dot(step.rot90()).abs())
    };
    let ahead = samples
        .iter()
        .enumerate()
        .filter_map(|(i, sample)| Some((i, away(sample)?)));
    let nearest = ahead.min_by(|(_, a), (_, b)| a.total_cmp(b));
    nearest.map(|(i, _)| i).or(from)
}

fn draw(ui: &Ui, explanation: &Explanation, rect: Rect, told: Option<usize>) {
    // Off the grid samples may lie at the border, and their discs reach over it.
    let painter = ui.painter().with_clip_rect(rect.intersect(ui.clip_rect()));
    painter.rect_filled(rect, 0.0, opaque(explanation.color));
    let across = (explanation.samples.len() as f32).sqrt().max(1.0);
    let radius = (SIDE / across * 0.32).clamp(2.0, 14.0);
    for (number, sample) in explanation.samples.iter().enumerate() {
        let at = at_part(rect, sample.position);
        let (width, color) = if told == Some(number) {
            (2.5, OUTLINE[1].1)
        } else {
            (1.0, Color32::from_gray(if is_dark(sample.bytes) { 200 } else { 60 }))
        };
        let stroke = Stroke::new(width, color);
        if explanation.exact {
            // No sample: where colours are computed.
            painter.hline(at.x - radius / 2.0..=at.x + radius / 2.0, at.y, stroke);
            painter.vline(at.x, at.y - radius / 2.0..=at.y + radius / 2.0, stroke);
            continue;
        }
        let radius = radius * heaviness(explanation.samples.iter().map(|other| other.position), sample.position);
        painter.circle_filled(at, radius, opaque(sample.bytes));
        painter.circle_stroke(at, radius, stroke);
    }
    let line = Stroke::new(1.0, ui.visuals().weak_text_color());
    ui.painter().rect_stroke(rect, 0.0, line, StrokeKind::Outside);
}

/// How much larger a sample is drawn in whose place there are several, which is how those of weighted patterns weigh more: their area
/// is what they weigh.
fn heaviness(places: impl Iterator<Item = [f64; 2]>, own: [f64; 2]) -> f32 {
    let own = own.map(f64::to_bits);
    (places.filter(|place| place.map(f64::to_bits) == own).count() as f32).sqrt()
}

fn at_part(rect: Rect, position: [f64; 2]) -> Pos2 {
    rect.min + rect.size() * place(position)
}

#[expect(clippy::cast_possible_truncation, reason = "parts of a pixel")]
fn place([x, y]: [f64; 2]) -> Vec2 {
    vec2(x as f32, y as f32)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn samples_at_one_place_are_drawn_as_heavy_as_they_are() {
        let places = [
            [0.25, 0.5],
            [0.5, 0.5],
            [0.25, 0.5],
            [0.25, 0.75],
            [0.25, 0.5],
            [0.25, 0.5],
        ];
        let of = |own: [f64; 2]| heaviness(places.into_iter(), own);
        assert!((of([0.25, 0.5]) - 2.0).abs() < 1e-6, "four times the area of one");
        assert!((of([0.5, 0.5]) - 1.0).abs() < 1e-6, "one");
    }
}
