//! The text of a lesson's step, beside the picture. Where there is no room for the explanation of a pixel besides, that is
//! the panel's other page.

use std::ops::Range;

use egui::text::{CCursor, LayoutJob, TextFormat};
use egui::{CursorIcon, FontFamily, FontId, RichText, ScrollArea, Sense, Ui};

use super::controls::{at_end, choice, command_button, tip};
use super::look::CONTROL;
use crate::viewer::{
    Block, Command, CommandSpec, InspectorCommand, Lesson, LessonCommand, LessonStep, Look, SceneCommand, Span, Toggle,
    Viewer, commands,
};

/// Width of the panel, in points, frame included.
pub(super) const WIDTH: f32 = 300.0;
/// Letters, in points.
const SIZE: f32 = 14.0;
/// Letters of headings.
const HEADING: f32 = 17.0;
/// Height of the list of steps, in points.
const LIST: f32 = 320.0;
/// What slanted letters are moved apart by, in points: their spaces look narrower than they are.
const SLANTED: f32 = 0.3;
/// Free space between words and what stands in a box or is slanted, in points: it is larger than its words.
const BESIDE_BOX: f32 = 2.5;
/// What an item's words are moved to the right by, in points.
const INDENT: f32 = 18.0;

/// Whether the explanation's page is open. A step that explains a pixel begins with its text.
pub(super) fn is_turned(viewer: &Viewer) -> bool {
    viewer.pixels().has_explanation_open() && viewer.inspector().asks_about_pixel()
}

/// The two pages of a panel that lesson and explanation share.
pub(super) fn pages(ui: &mut Ui, viewer: &Viewer, commands: &mut Vec<Command>) {
    let pages = [(false, "Text".to_owned()), (true, "Why this colour".to_owned())];
    if let Some(turned) = choice(ui, "Page", &tip("explanation"), is_turned(viewer), &pages) {
        let to = if turned { Toggle::On } else { Toggle::Off };
        commands.push(Command::Inspector(InspectorCommand::Explanation(to)));
    }
    ui.add_space(4.0);
}

/// Where in the lesson the reader is, and buttons to go on.
pub(super) fn head(ui: &mut Ui, viewer: &Viewer, commands: &mut Vec<Command>) {
    let Some((lesson, at)) = viewer.lesson() else { return };
    ui.horizontal(|ui| {
        steps(ui, lesson, at, commands);
        at_end(ui, &["Back", "Next", "Close"], |ui| {
            let back = ui.add_enabled_ui(at > 0, |ui| command_button(ui, "previous-scene", "Back"));
            back.response.on_disabled_hover_text("This is the first step");
            if back.inner.clicked() {
                commands.push(Command::Scenes(SceneCommand::Previous));
            }
            let is_last = at + 1 == lesson.steps.len();
            let next = ui.add_enabled_ui(!is_last, |ui| command_button(ui, "next-scene", "Next"));
            next.response.on_disabled_hover_text("This is the last step");
            if next.inner.clicked() {
                commands.push(Command::Scenes(SceneCommand::Next));
            }
            if command_button(ui, "close-lesson", "Close").clicked() {
                commands.push(Command::Lesson(LessonCommand::Close));
            }
        });
    });
    ui.label(RichText::new(&lesson.title).size(12.0).weak());
    ui.add_space(4.0);
}

/// What the button back to the step's own scene does.
const SHOW_STEP: &str = "Shows the scene of this step, with its view, settings and pin. A file that you opened stays in the \
                         list, and when the lesson is closed.";

/// Says so where another scene is shown than the step speaks of, with a way back.
pub(super) fn other_scene(ui: &mut Ui, viewer: &Viewer, commands: &mut Vec<Command>) {
    let Some((_, at)) = viewer.lesson().filter(|_| !viewer.shows_scene_of_step()) else {
        return;
    };
    ui.horizontal(|ui| {
        ui.label(RichText::new("the text is about another scene").small());
        at_end(ui, &["Show it"], |ui| {
            let show = ui.add(egui::Button::new("Show it").min_size(CONTROL));
            let show = show
                .on_hover_text(SHOW_STEP)
                .accessible_name("Show the scene of the step");
            if show.clicked() {
                commands.push(Command::Lesson(LessonCommand::Step(at)));
            }
        });
    });
    ui.add_space(4.0);
}

/// Where the reader is, as a button with a list of all steps.
fn steps(ui: &mut Ui, lesson: &Lesson, at: usize, commands: &mut Vec<Command>) {
    let of = format!("step {} of {}", at + 1, lesson.steps.len());
    let button = egui::Button::new(RichText::new(format!("{of} \u{2026}")).size(12.0)).small();
    let (response, _) = egui::containers::menu::MenuButton::from_button(button).ui(ui, |ui| {
        ScrollArea::vertical().max_height(LIST).show(ui, |ui| {
            for (number, step) in lesson.steps.iter().enumerate() {
                let name = format!("{}. {}", number + 1, step.title);
                if ui.selectable_label(number == at, name.trim_end_matches(". ")).clicked() {
                    commands.push(Command::Lesson(LessonCommand::Step(number)));
                    ui.close();
                }
            }
        });
    });
    response.on_hover_text("Goes to any step").accessible_name(&of);
}

/// The text of the step. Keys that it names can be clicked.
pub(super) fn text(ui: &mut Ui, viewer: &Viewer, commands: &mut Vec<Command>) {
    let step = viewer
        .lesson()
        .and_then(|(lesson, at)| Some((at, lesson.steps.get(at)?)));
    let Some((at, step)) = step else { return };
    // Another step begins at its beginning.
    ScrollArea::vertical()
        .id_salt(("lesson", at))
        .auto_shrink(false)
        .show(ui, |ui| words(ui, step, commands));
}

fn words(ui: &mut Ui, step: &LessonStep, commands: &mut Vec<Command>) {
    if !step.title.is_empty() {
        ui.label(RichText::new(&step.title).size(HEADING + 2.0).strong());
        ui.add_space(6.0);
    }
    for block in &step.text {
        match block {
            Block::Heading(words) => {
                ui.add_space(4.0);
                ui.label(layout(ui, words, HEADING, true).job);
            }
            Block::Paragraph(words) => paragraph(ui, words, commands),
            Block::Item { depth, marker, words } => {
                ui.horizontal_top(|ui| {
                    #[expect(clippy::cast_precision_loss, reason = "a few")]
                    ui.add_space(INDENT * (*depth).min(4) as f32);
                    ui.label(RichText::new(marker).size(SIZE));
                    ui.vertical(|ui| paragraph(ui, words, commands));
                });
            }
            Block::Code(code) => {
                ui.label(RichText::new(code).monospace().size(SIZE - 1.5));
            }
        }
        ui.add_space(6.0);
    }
}

/// Words whose keys can be clicked: hands that know no keys find there what they do.
fn paragraph(ui: &mut Ui, spans: &[Span], commands: &mut Vec<Command>) {
    let Words { mut job, keys } = layout(ui, spans, SIZE, false);
    job.wrap.max_width = ui.available_width();
    let galley = ui.fonts_mut(|fonts| fonts.layout_job(job));
    let label = ui.label(std::sync::Arc::clone(&galley));
    for key in keys {
        let cursor = |index: usize| {
            let cursor = CCursor {
                prefer_next_row: index == key.letters.start,
                ..CCursor::new(index)
            };
            galley.pos_from_cursor(cursor).translate(label.rect.min.to_vec2())
        };
        let place = cursor(key.letters.start).union(cursor(key.letters.end));
        let response = ui.interact(
            place.expand(BESIDE_BOX),
            label.id.with(key.letters.start),
            Sense::click(),
        );
        let response = response.on_hover_cursor(CursorIcon::PointingHand);
        let response = response.on_hover_text(format!("{}: {}. A click does it, too.", key.spec.name, key.spec.help));
        if response.accessible_name(format!("Key: {}", key.spec.name)).clicked() {
            commands.push(key.command);
        }
    }
}

/// Words in their looks, and the keys among them.
struct Words {
    job: LayoutJob,
    keys: Vec<KeyInWords>,
}

/// A key that words name.
struct KeyInWords {
    /// Where its letters are among all letters.
    letters: Range<usize>,
    spec: &'static CommandSpec,
    command: Command,
}

/// Words in their looks.
fn layout(ui: &Ui, spans: &[Span], size: f32, heading: bool) -> Words {
    let visuals = ui.visuals();
    let mut job = LayoutJob::default();
    let mut keys = Vec::new();
    let mut letters = 0;
    let mut after = None;
    for span in spans {
        let strong = span.look == Look::Bold || heading;
        let color = if strong {
            visuals.strong_text_color()
        } else {
            visuals.text_color()
        };
        let (family, size) = if span.look == Look::Code {
            (FontFamily::Monospace, size - 1.5)
        } else {
            (FontFamily::Proportional, size)
        };
        let mut format = TextFormat {
            italics: span.look == Look::Italic,
            extra_letter_spacing: if span.look == Look::Italic { SLANTED } else { 0.0 },
            line_height: Some(size * 1.4),
            ..TextFormat::simple(FontId::new(size, family), color)
        };
        if span.look == Look::Code {
            format.background = visuals.code_bg_color;
        }
        let in_box = span.look == Look::Code;
        // Letters that lean to the right lean on a space behind them.
        let leans_on = after == Some(Look::Italic) && span.text.starts_with(' ');
        let is_apart = in_box || after == Some(Look::Code) || leans_on;
        let space = if is_apart && !job.is_empty() { BESIDE_BOX } else { 0.0 };
        job.append(&span.text, space, format);
        after = Some(span.look);
        let end = letters + span.text.chars().count();
        let key = commands::of_key_name(&span.text).filter(|_| in_box);
        keys.extend(key.map(|(spec, command)| KeyInWords {
            letters: letters..end,
            spec,
            command,
        }));
        letters = end;
    }
    Words { job, keys }
}
