//! What the reader has to say about the document, and where the time of the last redraw went.

use std::time::Duration;

use egui::{Label, RichText, Sense, Ui, vec2};

use super::controls::{command_button, heading};
use crate::inspect::counted;
use crate::viewer::{Command, SceneCommand, SceneEntry, Viewer};

/// What is said of a picture whose file cannot be read any more.
pub(super) const AS_BEFORE: &str = "shown as it was read last";

/// Whether [`report`] has something to say.
pub(super) fn has_report(viewer: &Viewer) -> bool {
    let noted = |entry: &SceneEntry| entry.scene().is_some_and(|scene| !scene.report.is_empty());
    viewer
        .scene_list()
        .current()
        .is_some_and(|entry| entry.failure().is_some() || noted(entry))
}

/// Height of [`Readings::show`], in points.
pub(super) const READINGS: f32 = 96.0;

/// What is said about the readings of a scene, kept while the next scene is read.
#[derive(Debug, Default)]
pub(super) struct Readings {
    note: Option<String>,
    /// Whether a scene of the list has two readings, or may have: then all have the room for the note.
    seen: bool,
}

impl Readings {
    /// Of a list that is new: scenes that are not read yet may have two readings, but not those of the gallery.
    pub(super) fn of_list(scenes: &[SceneEntry]) -> Self {
        Self {
            note: None,
            seen: scenes.len() > 1 && scenes.iter().any(SceneEntry::is_file),
        }
    }

    /// Takes in the current scene.
    pub(super) fn follow(&mut self, viewer: &Viewer) {
        if viewer.scene_list().current().is_none_or(|entry| !entry.is_reading()) {
            self.note = viewer.scene_list().reading_note(viewer.settings().dialect);
        }
        self.seen |= self.note.is_some();
    }

    /// Height that every scene of the list has for the note, so that nothing moves from one to the next.
    pub(super) fn height(&self) -> f32 {
        if self.seen { READINGS } else { 0.0 }
    }

    /// Which of two readings of the scene was taken, and a button for the other; as high for every scene.
    pub(super) fn show(&self, ui: &mut Ui, viewer: &Viewer, commands: &mut Vec<Command>) {
        ui.scope(|ui| {
            ui.set_min_height(READINGS - ui.spacing().item_spacing.y);
            self.contents(ui, viewer, commands);
        });
    }

    fn contents(&self, ui: &mut Ui, viewer: &Viewer, commands: &mut Vec<Command>) {
        let Some(note) = &self.note else {
            if let Some(scene) = viewer.scene_list().current().and_then(SceneEntry::scene) {
                heading(ui, "One reading");
                let note = format!("read as {}", scene.dialect.name());
                ui.label(RichText::new(note).small().weak());
            }
            return;
        };
        heading(ui, "Two readings");
        // Above the note, which takes one line or two.
        if command_button(ui, "other-reading", "The other reading").clicked() {
            commands.push(Command::Scenes(SceneCommand::OtherReading));
        }
        ui.label(RichText::new(note).small());
    }
}

/// The reader's report, and why a scene could not be read.
pub(super) fn report(ui: &mut Ui, viewer: &Viewer) {
    let Some(entry) = viewer.scene_list().current() else {
        return;
    };
    if let Some(message) = entry.failure() {
        heading(ui, "Not read");
        ui.label(RichText::new(message).color(ui.visuals().error_fg_color));
        failed_line(ui, entry);
        if entry.scene().is_some() {
            ui.label(RichText::new(AS_BEFORE).small());
        }
        return;
    }
    let Some(scene) = entry.scene() else {
        return;
    };
    if scene.report.is_empty() {
        heading(ui, "Reader: no notes");
        return;
    }
    heading(ui, &format!("Reader: {}", counted(scene.report.count(), "note")));
    for line in scene.report.lines() {
        ui.label(RichText::new(line).small().color(ui.visuals().warn_fg_color));
    }
}

/// The line of the document that cannot be read, if it is one.
pub(super) fn failed_line(ui: &mut Ui, entry: &SceneEntry) {
    if let Some(line) = entry.failed_line() {
        ui.label(RichText::new(line).monospace().small());
    }
}

/// Time of the last redraw and its stages, as numbers and as a bar, unless pictures must not depend on time; and how
/// much it filled.
pub(super) fn timing(ui: &mut Ui, viewer: &Viewer, timed: bool) {
    // A scene that could not be read has no frame: the lines stay, so that what is below does not move.
    if viewer.frames().frame().is_none() && !viewer.scene_list().has_no_picture() {
        return;
    }
    let stats = viewer.frames().frame().map(|frame| frame.stats).unwrap_or_default();
    if timed {
        heading(ui, &format!("Redraw  {}", milliseconds(stats.total())));
        let stages = [
            ("transform", stats.transform),
            ("bin", stats.bin),
            ("raster", stats.raster),
            ("resolve", stats.resolve),
        ];
        bar(ui, &stages.map(|(_, time)| time));
        let words = stages.map(|(name, time)| format!("{name} {}", number(time)));
        // On one line, so that what is below does not move.
        ui.add(Label::new(RichText::new(words.join(" · ")).small().weak()).truncate());
    } else {
        ui.add_space(4.0);
    }
    // Points and hairlines fill nothing; the line stays, so that what is below does not move from scene to scene.
    let text = filled(stats.triangles);
    if timed || text.is_some() || viewer.scene_list().has_no_picture() {
        ui.label(RichText::new(text.unwrap_or_default()).small().weak());
    }
}

/// So many triangles and polygons in words; nothing where there are none.
fn filled(count: u64) -> Option<String> {
    match count {
        0 => None,
        1 => Some("1 triangle or polygon".to_owned()),
        _ => Some(format!("{} triangles and polygons", grouped(count))),
    }
}

/// The stages as parts of a whole, the darkest first.
fn bar(ui: &mut Ui, parts: &[Duration]) {
    let (rect, _) = ui.allocate_exact_size(vec2(ui.available_width(), 4.0), Sense::hover());
    let whole: f32 = parts.iter().map(Duration::as_secs_f32).sum();
    let accent = ui.visuals().selection.bg_fill;
    let mut left = rect.left();
    for (part, strength) in parts.iter().zip([1.0, 0.45, 0.75, 0.3]) {
        let width = rect.width() * part.as_secs_f32() / whole.max(f32::MIN_POSITIVE);
        let piece = egui::Rect::from_min_size(egui::pos2(left, rect.top()), vec2(width, rect.height()));
        ui.painter().rect_filled(piece, 0.0, accent.gamma_multiply(strength));
        left += width;
    }
}

fn milliseconds(time: Duration) -> String {
    format!("{} ms", number(time))
}

/// Milliseconds without their unit.
fn number(time: Duration) -> String {
    let ms = time.as_secs_f64() * 1000.0;
    match ms {
        ms if ms < 9.995 => format!("{ms:.2}"),
        ms if ms < 99.95 => format!("{ms:.1}"),
        ms => format!("{ms:.0}"),
    }
}

/// A count with thin spaces between groups of three digits.
fn grouped(count: u64) -> String {
    let digits = count.to_string();
    let mut text = String::new();
    for (index, digit) in digits.chars().enumerate() {
        if index > 0 && (digits.len() - index).is_multiple_of(3) {
            text.push('\u{2009}');
        }
        text.push(digit);
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn fills_in_words() {
        assert_eq!(filled(0), None, "a scene of points");
        assert_eq!(filled(1).as_deref(), Some("1 triangle or polygon"));
        assert_eq!(
            filled(1_234_567).as_deref(),
            Some("1\u{2009}234\u{2009}567 triangles and polygons")
        );
    }
}
