//! The plot of a spectrum: its waves as a picture, the box of frequencies that pixels can show, the wave that is pointed at.

use std::sync::Arc;

use egui::{
    Align2, Color32, FontId, Pos2, Rect, Role, Sense, Shape, Stroke, TextureHandle, TextureOptions, Ui, Vec2,
    WidgetInfo, pos2, vec2,
};

use super::focus;
use super::scenes::image_of;
use crate::compare::SpectrumReading;
use crate::viewer::SpectrumFound;

/// Room for the numbers on the left and below, in points.
const AXES: Vec2 = vec2(28.0, 15.0);
/// How far around the pointer the strongest wave counts, in points.
const NEAR: f32 = 3.0;
/// How far an arrow moves, in points.
const STEP: f32 = 4.0;
/// The line of the box, and what tells two places to belong together.
const BOX: Color32 = Color32::from_rgb(255, 255, 255);
const LINK: Color32 = Color32::from_rgb(255, 214, 10);

/// The picture of a spectrum, of exactly the size in which it is shown.
#[derive(Default)]
pub(super) struct SpectrumPlot {
    /// The frequency that arrows moved to, while the plot has the focus.
    chosen: Option<[f64; 2]>,
    drawn: Option<(Arc<SpectrumFound>, u32, TextureHandle)>,
}

impl std::fmt::Debug for SpectrumPlot {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("SpectrumPlot").finish_non_exhaustive()
    }
}

/// Where frequencies are.
#[derive(Clone, Copy, Debug)]
struct Axes {
    rect: Rect,
    reach: f64,
}

impl SpectrumPlot {
    /// Draws the spectrum `width` points wide; the wave that the pointer is over, or that arrows moved to.
    pub(super) fn show(
        &mut self,
        ui: &mut Ui,
        found: &Arc<SpectrumFound>,
        width: f32,
        is_current: bool,
    ) -> Option<SpectrumReading> {
        let scale = ui.pixels_per_point();
        let side = Self::side(ui, width);
        let square = Vec2::splat(side as f32 / scale);
        let (response, painter) = ui.allocate_painter(Self::size(ui, width), Sense::focusable_noninteractive());
        let corner = response.rect.min + vec2(AXES.x, 4.0);
        let corner = pos2((corner.x * scale).round(), (corner.y * scale).round()) / scale;
        let axes = Axes {
            rect: Rect::from_min_size(corner, square),
            reach: found.analysis.reach(),
        };
        let texture = self.texture(ui, found, side);
        let whole = Rect::from_min_max(pos2(0.0, 0.0), pos2(1.0, 1.0));
        // That of another moment is pale.
        let tint = if is_current {
            Color32::WHITE
        } else {
            Color32::from_gray(150)
        };
        painter.image(texture.id(), axes.rect, whole, tint);
        axes.numbers(ui);
        let inside = painter.with_clip_rect(axes.rect);
        if let Some(corners) = found.analysis.nyquist() {
            let mut points: Vec<Pos2> = corners.map(|corner| axes.place(corner)).to_vec();
            points.extend(points.first().copied());
            for (width, color) in [(2.5, Color32::from_black_alpha(150)), (1.0, BOX)] {
                inside.add(Shape::line(points.clone(), Stroke::new(width, color)));
            }
        }
        for step in focus::arrows_in(ui, &response) {
            let from = axes.place(self.chosen.unwrap_or_default());
            self.chosen = axes.frequency(from + STEP * step).or(self.chosen);
        }
        self.chosen = self.chosen.filter(|_| response.has_focus());
        let pointed = response.hover_pos().and_then(|at| axes.frequency(at));
        let reading = pointed.or(self.chosen).and_then(|frequency| {
            let near = f64::from(NEAR / axes.rect.width()) * 2.0 * axes.reach;
            found.analysis.strongest_near(frequency, near)
        });
        if let Some(reading) = &reading {
            axes.mark(ui, reading, found);
        }
        response.widget_info(|| WidgetInfo::labeled(Role::Image, true, "Strength of each frequency"));
        reading
    }

    /// What a plot takes that is `width` points wide, in points.
    pub(super) fn size(ui: &Ui, width: f32) -> Vec2 {
        vec2(
            width,
            Self::side(ui, width) as f32 / ui.pixels_per_point() + AXES.y + 4.0,
        )
    }

    /// The side of its square: whole device pixels, so that none of the picture's is left out.
    fn side(ui: &Ui, width: f32) -> u32 {
        pixels((width - AXES.x) * ui.pixels_per_point())
    }

    fn texture(&mut self, ui: &Ui, found: &Arc<SpectrumFound>, side: u32) -> &TextureHandle {
        let stale =
            |(old, room, _): &(Arc<SpectrumFound>, u32, TextureHandle)| !Arc::ptr_eq(old, found) || *room != side;
        if self.drawn.as_ref().is_some_and(stale) {
            self.drawn = None;
        }
        let (_, _, texture) = self.drawn.get_or_insert_with(|| {
            let image = image_of(&found.analysis.picture(side));
            let texture = ui.ctx().load_texture("spectrum", image, TextureOptions::NEAREST);
            (Arc::clone(found), side, texture)
        });
        texture
    }
}

impl Axes {
    #[expect(clippy::cast_possible_truncation, reason = "points on a screen")]
    fn place(&self, frequency: [f64; 2]) -> Pos2 {
        let part = frequency.map(|along| (along / self.reach).midpoint(1.0).clamp(-1e3, 1e3) as f32);
        self.rect.min + vec2(part[0], part[1]) * self.rect.size()
    }

    fn frequency(&self, at: Pos2) -> Option<[f64; 2]> {
        let part = (at - self.rect.min) / self.rect.size();
        let along = |part: f32| (f64::from(part) * 2.0 - 1.0) * self.reach;
        self.rect.contains(at).then(|| [along(part.x), along(part.y)])
    }

    /// Numbers of both axes.
    fn numbers(&self, ui: &Ui) {
        let ink = ui.visuals().weak_text_color();
        let font = FontId::proportional(10.0);
        for (along, anchors) in [
            (-self.reach, [Align2::LEFT_TOP, Align2::RIGHT_TOP]),
            (0.0, [Align2::CENTER_TOP, Align2::RIGHT_CENTER]),
            (self.reach, [Align2::RIGHT_TOP, Align2::RIGHT_BOTTOM]),
        ] {
            let text = format!("{along}");
            let at = self.place([along, along]);
            let below = pos2(at.x, self.rect.bottom() + 2.0);
            ui.painter().text(below, anchors[0], &text, font.clone(), ink);
            let beside = pos2(self.rect.left() - 4.0, at.y);
            ui.painter().text(beside, anchors[1], &text, font.clone(), ink);
        }
    }

    /// The wave, its mirror image, and where it lands or comes from.
    fn mark(&self, ui: &Ui, reading: &SpectrumReading, found: &SpectrumFound) {
        let painter = ui.painter().with_clip_rect(self.rect);
        let at = self.place(reading.wave.frequency);
        let [x, y] = reading.wave.frequency;
        let mirrored = self.place([-x, -y]);
        // Both in the same units only where texels are pixels.
        let other = match (reading.lands, &reading.source) {
            (Some(lands), _) if found.level.is_none() => Some(lands),
            (None, Some((source, part))) if *part >= 0.5 && self.reach > 1.0 => Some(source.frequency),
            _ => None,
        };
        for (width, black) in [(3.5, true), (1.5, false)] {
            let color = |color: Color32| if black { Color32::from_black_alpha(170) } else { color };
            if let Some(other) = other {
                let other = self.place(other);
                painter.line_segment([at, other], Stroke::new(width, color(LINK)));
                painter.circle_stroke(other, 4.0, Stroke::new(width, color(LINK)));
            }
            painter.circle_stroke(at, 5.0, Stroke::new(width, color(BOX)));
            painter.circle_stroke(mirrored, 3.0, Stroke::new(width, color(BOX)));
        }
    }
}

#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "clamped to what a window has"
)]
fn pixels(points: f32) -> u32 {
    points.round().clamp(1.0, 4096.0) as u32
}
