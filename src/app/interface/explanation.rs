//! Why the pinned pixel has its colour: a tree beside the picture. What the pointer is over is outlined in the scene.

use egui::{Button, CollapsingHeader, Response, RichText, ScrollArea, Sense, Stroke, Ui, vec2};

use super::controls::{at_end, command_button, tip};
use super::floating::shows_other_than_set;
use super::hovered::Hovered;
use super::look::opaque;
use super::look::{self, CONTROL};
use super::report::{bring_into_sight, lines, section};
use super::{compare, samples, scrubber, texture_view};
use crate::inspect::{Difference, Explanation, Paint};
use crate::render::Visualisation;
use crate::viewer::{Arrangement, Command, ExportCommand, InspectorCommand, Toggle, Viewer};

/// Width of the panel where no hand gave it another, in points, frame included.
pub(super) const WIDTH: f32 = 312.0;
/// Width that it needs.
pub(super) const LEAST_WIDTH: f32 = 300.0;
/// What of the picture must stay free beside the panel, in points.
const LEAST_REST: f32 = 300.0;
/// What the panel remembers.
#[derive(Debug, Default)]
pub(super) struct ExplanationPanel {
    /// The sample that is told in full, where the user chose one.
    chosen: Option<usize>,
    /// How many samples are accumulated; none are all.
    accumulated: Option<usize>,
    /// The pixel that these belong to.
    pixel: Option<[u32; 2]>,
    /// How many samples it had.
    count: usize,
    /// Whether it also has what belongs to a comparison: where the panel for that is not to be seen.
    pub(super) has_comparison: bool,
    /// Whether it is a page of a lesson's panel, whose tabs lead away from it.
    pub(super) is_page: bool,
}

/// What is told of the pinned pixel.
#[derive(Clone, Copy)]
struct Reported<'a> {
    viewer: &'a Viewer,
    explanation: &'a Explanation,
}

/// The heading of one of the paints.
#[derive(Clone, Copy)]
struct PaintHeading {
    number: usize,
    /// Whether the sample that is pointed at or chosen has it.
    is_lit: bool,
}

impl ExplanationPanel {
    /// Fills the panel; what the pointer is over.
    pub(super) fn show(&mut self, ui: &mut Ui, viewer: &Viewer, commands: &mut Vec<Command>) -> Hovered {
        let mut hovered = Hovered::default();
        look::beside_bar(ui, |ui| {
            title(ui, viewer, self.is_page, commands);
            if self.has_comparison {
                compare::controls(ui, viewer, commands);
                ui.add_space(2.0);
            }
        });
        let in_sight = viewer.pixels().explains();
        let explanation = viewer.inspector().explanation().filter(|_| in_sight);
        let mut area = ScrollArea::vertical().id_salt("explanation").auto_shrink(false);
        if let Some(explanation) = explanation.filter(|explanation| self.pixel != Some(explanation.pixel)) {
            *self = Self {
                pixel: Some(explanation.pixel),
                has_comparison: self.has_comparison,
                is_page: self.is_page,
                ..Self::default()
            };
            area = area.vertical_scroll_offset(0.0);
        }
        // Sample 4 of 16 is not sample 4 of 9, and there may be none of that number.
        let count = explanation.map_or(self.count, |explanation| explanation.samples.len());
        if std::mem::replace(&mut self.count, count) != count {
            (self.chosen, self.accumulated) = (None, None);
        }
        area.show(ui, |ui| {
            if !in_sight {
                ui.label("The pinned pixel is outside the window now. It comes back with the view.");
                ui.add_space(2.0);
                if command_button(ui, "unpin", "Unpin").clicked() {
                    commands.push(Command::Inspector(InspectorCommand::Unpin));
                }
                self.comparison(ui, viewer, commands);
            } else if let Some(explanation) = explanation {
                self.report(ui, Reported { viewer, explanation }, commands, &mut hovered);
            } else {
                ui.label(RichText::new("finding out …").weak());
                self.comparison(ui, viewer, commands);
            }
        });
        hovered
    }

    fn report(
        &mut self,
        ui: &mut Ui,
        Reported { viewer, explanation }: Reported<'_>,
        commands: &mut Vec<Command>,
        hovered: &mut Hovered,
    ) {
        lines(ui, &explanation.pixel_lines());
        other_view(ui, viewer, commands);
        against(ui, viewer, explanation);
        // A report says where its keys are; here that goes without saying.
        let help = explanation.help_lines();
        let help: Vec<String> = help.iter().map(|line| line.replace(" in the window)", ")")).collect();
        if !help.is_empty() {
            section(ui, "hints", "What would help", true, |ui| {
                lines(ui, &help);
            });
        }
        self.comparison(ui, viewer, commands);
        section(ui, "resolve", explanation.resolve_title(), false, |ui| {
            lines(ui, &explanation.resolve_lines());
        });
        let count = explanation.samples.len();
        let heading = if explanation.exact {
            "The pixel".to_owned()
        } else if count == 1 {
            "The sample".to_owned()
        } else {
            format!("The {count} samples")
        };
        section(ui, "samples", &heading, true, |ui| {
            hovered.sample = samples::show(ui, explanation, &mut self.chosen);
        });
        // The pixel is no mean of its own samples where it takes others too.
        if count > 1 && explanation.resolve.around.is_none() {
            section(ui, "scrubber", "Sample by sample", false, |ui| {
                scrubber::show(ui, explanation, &mut self.accumulated);
            });
        }
        let over = hovered.sample.or(self.chosen);
        let lit = over.and_then(|sample| explanation.samples.get(sample));
        // The topmost first, as one sees them.
        for paint in (0..explanation.paints.len()).rev() {
            let is_lit = lit.is_some_and(|sample| sample.stack.contains(&paint));
            let heading = PaintHeading { number: paint, is_lit };
            self.paint(ui, Reported { viewer, explanation }, heading, hovered);
        }
        if let Some(words) = explanation.unlisted_words() {
            lines(ui, &[words]);
        }
        if explanation.paints.is_empty() {
            lines(
                ui,
                &["Nothing paints this pixel: every sample shows the background.".to_owned()],
            );
        }
        pinholes(ui, explanation);
        missed(ui, explanation, hovered);
    }

    /// What A and B are and how far they are apart, where no other panel says so.
    fn comparison(&self, ui: &mut Ui, viewer: &Viewer, commands: &mut Vec<Command>) {
        if self.has_comparison {
            section(ui, "comparison", compare::title(viewer), true, |ui| {
                compare::details(ui, viewer, commands);
            });
        }
    }

    fn paint(
        &mut self,
        ui: &mut Ui,
        Reported { viewer, explanation }: Reported<'_>,
        PaintHeading { number, is_lit }: PaintHeading,
        hovered: &mut Hovered,
    ) {
        let paint = &explanation.paints[number];
        let title = explanation.paint_title(number);
        let title = if is_lit { format!("{title}  \u{2039}") } else { title };
        let seen = paint.fragments.iter().any(|fragment| fragment.seen);
        let text = RichText::new(title).size(12.0);
        let text = match (is_lit, seen) {
            (true, _) => text.strong(),
            (false, true) => text,
            (false, false) => text.weak(),
        };
        let sample = hovered
            .sample
            .or(self.chosen)
            .or_else(|| explanation.telling_sample(number));
        let header = CollapsingHeader::new(text)
            // Of each pixel: what was folded for one is not for the next.
            .id_salt(("paint", explanation.pixel, number))
            .default_open(is_topmost(explanation, number))
            .show(ui, |ui| {
                lines(ui, &explanation.paint_lines(number));
                if let Some(sample) = sample {
                    if let Some(texel) = texture_view::show(ui, viewer, paint, sample) {
                        hovered.texel = Some(texel);
                    }
                    lines(ui, &[format!("At {}:", explanation.sample_title(sample))]);
                    ui.indent("fragment", |ui| lines(ui, &explanation.fragment_lines(number, sample)));
                }
            });
        bring_into_sight(ui, &header);
        let inside = header.body_response.as_ref().is_some_and(Response::contains_pointer);
        if header.header_response.contains_pointer() || inside {
            hovered.primitive = Some(paint.primitive);
        }
    }
}

/// Says so where the window shows other colours than those that are explained, and leads back to them.
fn other_view(ui: &mut Ui, viewer: &Viewer, commands: &mut Vec<Command>) {
    if viewer.ab().arrangement() == Arrangement::Alone && shows_other_than_set(viewer) {
        let note = "The window shows B. The explanation is about A, the picture of the settings.";
        ui.label(RichText::new(note).color(ui.visuals().warn_fg_color));
    }
    let name = match viewer.settings().render.visualisation {
        Visualisation::Color => return,
        Visualisation::Primitive => "primitives",
        Visualisation::Clamped => "clamped pixels",
        Visualisation::Barycentric => "barycentric weights",
        Visualisation::Uv => "(u, v)",
        Visualisation::LevelOfDetail => "level-of-detail",
        Visualisation::MipLevels => "mip levels",
        other => other.name(),
    };
    let note = format!("The window shows the {name} view. The explanation is about the picture's own colour.");
    ui.label(RichText::new(note).color(ui.visuals().warn_fg_color));
    let button = ui.add(Button::new("Back to the picture").min_size(CONTROL));
    if button.on_hover_text(tip("visualise")).clicked() {
        commands.extend(Command::set("visualise", Visualisation::Color.name()));
    }
}

fn pinholes(ui: &mut Ui, explanation: &Explanation) {
    if !explanation.pinholes.is_empty() {
        section(ui, "pinholes", "What the float rules leave open", true, |ui| {
            lines(ui, &explanation.pinhole_lines());
        });
    }
}

fn missed(ui: &mut Ui, explanation: &Explanation, hovered: &mut Hovered) {
    if explanation.missed.is_empty() {
        return;
    }
    section(ui, "missed", "What no sample meets", true, |ui| {
        for (line, missed) in explanation.missed_lines().iter().zip(&explanation.missed) {
            if lines(ui, std::slice::from_ref(line)).contains_pointer() {
                hovered.primitive = Some(missed.primitive);
            }
        }
    });
}

/// What B tells differently.
fn against(ui: &mut Ui, viewer: &Viewer, explanation: &Explanation) {
    let Some(other) = viewer.inspector().other_explanation() else {
        return;
    };
    let differences = explanation.differences(other);
    // The one in front first, as the titles of the comparison have it.
    let heading = if viewer.ab().is_swapped() { "B  |  A" } else { "A  |  B" };
    section(ui, "against", heading, true, |ui| {
        if differences.is_empty() {
            lines(ui, &["A and B tell the same of this pixel.".to_owned()]);
            return;
        }
        let told = differences.iter().map(|difference| {
            let Difference { what, a, b } = difference;
            let [front, back] = if viewer.ab().is_swapped() { [b, a] } else { [a, b] };
            format!("{what}  {front}  |  {back}")
        });
        lines(ui, &told.collect::<Vec<_>>());
    });
}

/// Whether a paint is what most people ask about: the topmost one that is seen.
fn is_topmost(explanation: &Explanation, paint: usize) -> bool {
    let seen = |paint: &Paint| paint.fragments.iter().any(|fragment| fragment.seen);
    explanation.paints.iter().rposition(seen) == Some(paint)
}

fn title(ui: &mut Ui, viewer: &Viewer, is_page: bool, commands: &mut Vec<Command>) {
    ui.horizontal(|ui| {
        let in_sight = viewer.pixels().explains();
        let explanation = viewer.inspector().explanation().filter(|_| in_sight);
        if let Some(color) = explanation.map(|explanation| explanation.color) {
            let (rect, _) = ui.allocate_exact_size(vec2(16.0, 16.0), Sense::hover());
            ui.painter().rect_filled(rect, 2.0, opaque(color));
            ui.painter().rect_stroke(
                rect,
                2.0,
                Stroke::new(1.0, ui.visuals().weak_text_color()),
                egui::StrokeKind::Outside,
            );
        }
        let pixel = viewer.pixels().inspected().filter(|_| in_sight);
        let name = pixel.map_or("Pinned pixel".to_owned(), |[x, y]| format!("Pixel {x}, {y}"));
        ui.label(RichText::new(name).strong().size(14.0));
        if viewer.ab().other().is_some() {
            ui.label("of A");
        }
        let texts = ["Copy", "Close"];
        at_end(ui, if is_page { &texts[..1] } else { &texts }, |ui| {
            let copy = ui.add_enabled_ui(in_sight, |ui| command_button(ui, "copy-explanation", "Copy"));
            if copy.inner.clicked() {
                commands.push(Command::Export(ExportCommand::CopyExplanation));
            }
            if !is_page && command_button(ui, "explanation", "Close").clicked() {
                commands.push(Command::Inspector(InspectorCommand::Explanation(Toggle::Off)));
            }
        });
    });
    ui.add_space(2.0);
}

/// Whether there is room for the panel beside what must stay free of the picture, in `width` points.
pub(super) fn fits(width: f32) -> bool {
    width >= WIDTH + LEAST_REST
}

/// How wide a panel is that would be `width` points wide, in a room that it [fits].
pub(super) fn fitted(width: f32, room: f32) -> f32 {
    width.min(room - LEAST_REST).max(LEAST_WIDTH)
}

/// Whether there is a pixel to explain, and room for the panel in `width` points.
pub(super) fn is_shown(viewer: &Viewer, width: f32) -> bool {
    viewer.pixels().has_explanation_open() && fits(width)
}
