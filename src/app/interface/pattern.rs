//! The dialog that shows a sample pattern by itself: its points, what vertical and level edges see of them, and its spectrum.
//!
//! ```text
//!    Sample pattern                 Close
//!    Samples per pixel   1 4 9 16 ...
//!    Pattern             sobol     seed 0
//!   .-------------. |  .-------------.
//!   |   o     o   | -  |             |
//!   | o     o     |    |    . o .    |      points of a pixel, and their places along both axes;
//!   |     o     o | -  |             |      power of each frequency, zero in the middle
//!   '-------------' |  '-------------'
//!    | |  | | | | |    ----___/\_--__---    and its mean by distance from there
//!    Discrepancy 0.12  1 pixel   8 x 8      of a pixel's points, or of those of neighbours together
//! ```

use egui::{Align, Color32, ColorImage, Context, Layout, Rect, Response, RichText, ScrollArea, Sense, Shape, Stroke};
use egui::{StrokeKind, TextureHandle, TextureOptions, Ui, Vec2, pos2, vec2};

use super::controls::{choice, row};
use super::modal::{beside, modal};
use super::{look, sampling};
use crate::inspect::counted;
use crate::raster::{PatternStatistics, PowerSpectrum, SamplePattern, SampleRate, Seed};
use crate::viewer::{Command, PictureSetting, Viewer, WindowCommand, picture};

/// What the dialog's area is called.
pub(super) const NAME: &str = "Sample pattern";
/// Largest side of a plot, in points.
const SIDE: f32 = 236.0;
/// Least side of two plots beside each other, in points.
const LEAST: f32 = 150.0;
/// Length of the lines that tell a place along an axis, in points.
const TICK: f32 = 8.0;
/// Height of the curve below a spectrum, in points.
const CURVE: f32 = 56.0;
/// The largest power that the curve has room for; random points have 1.
const MOST: f64 = 2.0;
/// What the window keeps free around the dialog, in points.
const AROUND: Vec2 = vec2(48.0, 96.0);

/// What the spectrum is of.
const OF: &str = "Of the points of single pixels, as a mean; or of 8 \u{d7} 8 neighbours together, in eighths of a cycle per pixel, which \
                  shows what they have in common and how they are arranged.";

/// Settings that decide where samples lie, by their options.
const SETTINGS: [&str; 3] = ["sample-rate", "pattern", "seed"];

/// What the dialog remembers.
#[derive(Debug, Default)]
pub(super) struct PatternDialog {
    shown: Option<ShownPattern>,
    /// Whether the spectrum is that of several pixels together.
    together: bool,
}

/// What a pattern follows from.
type Key = (SamplePattern, SampleRate, Seed, [i32; 2]);

/// A pattern that was measured.
struct ShownPattern {
    key: Key,
    statistics: PatternStatistics,
    /// The spectrum of single pixels, and of several together.
    spectra: [TextureHandle; 2],
}

impl std::fmt::Debug for ShownPattern {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("ShownPattern")
            .field("key", &self.key)
            .finish_non_exhaustive()
    }
}

impl PatternDialog {
    /// Shows the dialog.
    pub(super) fn show(&mut self, ctx: &Context, viewer: &Viewer, commands: &mut Vec<Command>) {
        let screen = ctx.content_rect().size() - AROUND;
        let modal = modal(NAME).show(ctx, |ui| {
            let across = if screen.x >= 2.0 * (LEAST + TICK) + 40.0 {
                2.0
            } else {
                1.0
            };
            let side = ((screen.x - 40.0) / across - TICK).clamp(64.0, SIDE);
            ui.set_width(across * (side + TICK) + 24.0);
            let closes = ui
                .horizontal(|ui| {
                    ui.heading(NAME);
                    ui.with_layout(Layout::right_to_left(Align::Center), |ui| ui.button("Close").clicked())
                        .inner
                })
                .inner;
            look::bars_beside(ui);
            let height = screen.y.max(64.0);
            let area = ScrollArea::vertical().max_height(height).min_scrolled_height(height);
            area.show(ui, |ui| {
                let settings: Vec<&PictureSetting> =
                    SETTINGS.iter().filter_map(|option| picture::find(option)).collect();
                sampling::rows(ui, &settings, viewer, commands);
                self.pattern(ui, viewer, side, across > 1.0);
            });
            closes
        });
        if modal.inner || beside(&modal.backdrop_response) {
            commands.push(Command::Window(WindowCommand::CloseDialog));
        }
    }

    /// Everything about the pattern in force.
    fn pattern(&mut self, ui: &mut Ui, viewer: &Viewer, side: f32, beside: bool) {
        let render = &viewer.settings().render;
        let pinned = viewer.pixels().pinned();
        let [x, y] = pinned.unwrap_or([0, 0]);
        let pixel = [x.cast_signed(), y.cast_signed()];
        let key = (render.pattern, render.sample_rate, render.seed, pixel);
        if self.shown.as_ref().is_none_or(|shown| shown.key != key) {
            let statistics = PatternStatistics::new(render.pattern, render.sample_rate, render.seed, pixel);
            let texture = |spectrum: &PowerSpectrum| {
                let context = ui.ctx();
                context.load_texture("spectrum of the pattern", image(spectrum), TextureOptions::NEAREST)
            };
            self.shown = Some(ShownPattern {
                key,
                spectra: [&statistics.spectrum, &statistics.together].map(texture),
                statistics,
            });
        }
        let Some(shown) = &self.shown else {
            return;
        };
        ui.add_space(2.0);
        ui.label(RichText::new(about(render.pattern, pixel)).small().weak());
        ui.add_space(4.0);
        let layout = if beside {
            Layout::left_to_right(Align::Min)
        } else {
            Layout::top_down(Align::Min)
        };
        ui.with_layout(layout, |ui| {
            ui.vertical(|ui| {
                points(ui, &shown.statistics, side);
                numbers(ui, &shown.statistics);
            });
            ui.vertical(|ui| {
                ui.set_max_width(side);
                spectrum(ui, shown, side, self.together);
                let of = [(false, "1 pixel".to_owned()), (true, "8 \u{d7} 8 pixels".to_owned())];
                if let Some(together) = choice(ui, "Spectrum of", OF, self.together, &of) {
                    self.together = together;
                }
            });
        });
    }
}

/// What is shown, in a sentence.
fn about(pattern: SamplePattern, [x, y]: [i32; 2]) -> String {
    let source = match pattern.source() {
        "" => String::new(),
        source => format!(" ({source})"),
    };
    let whose = if pattern.differs_by_pixel() {
        format!(" The points are those of pixel {x}, {y}.")
    } else {
        String::new()
    };
    let description = pattern.description().replace('`', "");
    format!("{}: {description}{source}.{whose}", pattern.name())
}

/// The points of a pixel, and their places along both axes.
fn points(ui: &mut Ui, statistics: &PatternStatistics, side: f32) -> Response {
    let (response, painter) = ui.allocate_painter(Vec2::splat(side + TICK), Sense::hover());
    let square = Rect::from_min_size(response.rect.min, Vec2::splat(side));
    let (ink, weak) = (ui.visuals().strong_text_color(), ui.visuals().weak_text_color());
    painter.rect_filled(square, 0.0, ui.visuals().extreme_bg_color);
    painter.rect_stroke(square, 0.0, Stroke::new(1.0, weak), StrokeKind::Inside);
    let radius = (side / 10.0 / (statistics.points.len() as f32).sqrt()).clamp(1.2, 4.0);
    for (point, count) in &statistics.places {
        #[expect(clippy::cast_possible_truncation, reason = "between 0 and 1")]
        let at = square.min + vec2(point[0] as f32, point[1] as f32) * side;
        // Its area is the weight; a heavy one hides no other.
        let heavier = (*count as f32).sqrt().min(4.0);
        painter.circle_filled(at, radius * heavier, ink);
        let stroke = Stroke::new(1.0, ink);
        painter.line_segment(
            [pos2(at.x, square.max.y + 2.0), pos2(at.x, square.max.y + TICK)],
            stroke,
        );
        painter.line_segment(
            [pos2(square.max.x + 2.0, at.y), pos2(square.max.x + TICK, at.y)],
            stroke,
        );
    }
    let [columns, rows] = statistics.projections;
    let heaviest = statistics.places.iter().map(|(_, count)| *count).max();
    let weights = heaviest.filter(|count| *count > 1).map_or(String::new(), |count| {
        format!("; the heaviest place weighs {count} of {}", statistics.points.len())
    });
    let name = format!(
        "{} points in {columns} columns and {rows} rows{weights}",
        statistics.places.len()
    );
    let tip = format!(
        "The samples of a pixel{weights}. The lines below and beside it are what a vertical and a level edge can tell apart."
    );
    response.on_hover_text(tip).accessible_name(name)
}

/// The power of each frequency, and its mean by distance from zero; of single pixels, or of several together.
fn spectrum(ui: &mut Ui, shown: &ShownPattern, side: f32, together: bool) {
    let (spectrum, low) = if together {
        let low = "with one sample per pixel, low on the left means that neighbours are arranged: their grain is fine";
        (&shown.statistics.together, low)
    } else {
        let low = "low on the left means little noise that the eye sees";
        (&shown.statistics.spectrum, low)
    };
    let picture = &shown.spectra[usize::from(together)];
    let (response, painter) = ui.allocate_painter(vec2(side, side), Sense::hover());
    let whole = Rect::from_min_max(pos2(0.0, 0.0), pos2(1.0, 1.0));
    painter.image(picture.id(), response.rect, whole, Color32::WHITE);
    let tip = format!(
        "How strong each frequency is in the points, up to {} cycles per pixel; zero is in the middle. Grey is what random points \
         have; bright spots turn what is as fine into another pattern, dark ones keep it out.",
        spectrum.reach()
    );
    response.on_hover_text(tip).accessible_name("Power spectrum");
    let (response, painter) = ui.allocate_painter(vec2(side, CURVE), Sense::hover());
    let rect = response.rect;
    let radial = spectrum.radial();
    let last = (radial.len() - 1).max(1) as f32;
    #[expect(clippy::cast_possible_truncation, reason = "between 0 and 1")]
    let height = |power: f64| rect.bottom() - (power.min(MOST) / MOST) as f32 * rect.height();
    let one = [pos2(rect.left(), height(1.0)), pos2(rect.right(), height(1.0))];
    let weak = Stroke::new(1.0, ui.visuals().weak_text_color());
    painter.extend(Shape::dashed_line(&one, weak, 3.0, 3.0));
    // Frequency zero is the number of points.
    let curve = (1_u16..).zip(&radial[1..]);
    let curve = curve.map(|(ring, power)| pos2(rect.left() + rect.width() * f32::from(ring) / last, height(*power)));
    painter.line(curve.collect(), Stroke::new(1.5, ui.visuals().strong_text_color()));
    let tip = format!(
        "The mean by distance from zero, up to {} cycles per pixel. The dashed line is what random points have; {low}.",
        spectrum.reach()
    );
    response.on_hover_text(tip).accessible_name("Mean power by frequency");
}

/// What is measured of the points.
fn numbers(ui: &mut Ui, statistics: &PatternStatistics) {
    let [columns, rows] = statistics.projections;
    let lines = [
        (
            "Discrepancy",
            format!("{:.4}", statistics.star_discrepancy),
            "The part of the points that lies in a box from the upper left corner differs from the box's area by so much at most. Less is \
             more even: it bounds the error of any edge that is level or vertical.",
        ),
        (
            "Distance",
            format!("{:.4} px", statistics.least_distance),
            "From one point to the nearest other, across the pixel's sides as well. Points that keep their distance make finer noise.",
        ),
        (
            "Projections",
            format!("{}, {}", counted(columns, "column"), counted(rows, "row")),
            "So many different places the points have along each axis. An edge that is nearly vertical, or nearly level, has that many \
             shades and one.",
        ),
    ];
    for (label, value, tip) in lines {
        row(ui, label, |ui| ui.label(value).on_hover_text(tip));
    }
}

/// A spectrum as a picture: random points are mid-grey, twice their power and more is white.
fn image(spectrum: &PowerSpectrum) -> ColorImage {
    let side = spectrum.side();
    let places = (0..side).flat_map(|row| (0..side).map(move |column| [column, row]));
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "0 to 255")]
    let gray = |place| Color32::from_gray((spectrum.at(place).min(2.0) * 127.5).round() as u8);
    ColorImage::new([side, side], places.map(gray).collect())
}
