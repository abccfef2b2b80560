//! While a document is read that takes long: how far that is, and a button that gives it up.

use std::time::Duration;

use egui::{Frame, Label, ProgressBar, Rect, Ui};

use super::controls::command_button;
use super::places::card_area;
use crate::viewer::{Command, SceneCommand, Viewer};

/// Width of the bar, in points.
const WIDTH: f32 = 230.0;
/// Free space at its sides, in points.
const MARGIN: f32 = 16.0;
/// How often its length is looked at.
const PACE: Duration = Duration::from_millis(100);

/// Shows the bar in the middle of what is `free` and adds what was pressed to `commands`.
pub(super) fn show(ui: &Ui, viewer: &Viewer, free: Rect, commands: &mut Vec<Command>) {
    let Some(entry) = viewer.scene_list().current().filter(|entry| entry.is_reading()) else {
        return;
    };
    ui.ctx().request_repaint_after(PACE);
    let Some(part) = entry.long_reading() else { return };
    #[expect(clippy::cast_possible_truncation, reason = "between 0 and 1")]
    let part = part as f32;
    card_area("waiting", free.center(), free).show(ui.ctx(), |ui| {
        Frame::popup(ui.style()).show(ui, |ui| {
            ui.vertical_centered(|ui| {
                ui.set_max_width(WIDTH.min(free.width() - 2.0 * MARGIN).max(0.0));
                ui.add(Label::new(format!("Reading {}", entry.label)).truncate());
                ui.add(ProgressBar::new(part).show_percentage());
                if command_button(ui, "give-up-reading", "Give up (Esc)").clicked() {
                    commands.push(Command::Scenes(SceneCommand::GiveUpReading));
                }
            });
        });
    });
}
