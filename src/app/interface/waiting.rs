//! While a document is read that takes long: how far that is, and a button that gives it up.

use std::time::Duration;

use egui::{Align2, Area, Frame, Id, Order, ProgressBar, Rect, Ui};

use super::controls::command_button;
use crate::viewer::{Command, SceneCommand, SceneEntry, Viewer};

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
    Area::new(Id::unique("waiting"))
        .order(Order::Middle)
        .fixed_pos(free.center())
        .pivot(Align2::CENTER_CENTER)
        .constrain_to(free)
        .fade_in(false)
        .show(ui.ctx(), |ui| {
            Frame::popup(ui.style()).show(ui, |ui| {
                ui.vertical_centered(|ui| {
                    ui.set_max_width(WIDTH.min(free.width() - 2.0 * MARGIN).max(0.0));
                    ui.label(format!("Reading {} \u{2026}", label(entry)));
                    ui.add(ProgressBar::new(part).show_percentage());
                    if command_button(ui, "give-up-reading", "Give up (Esc)").clicked() {
                        commands.push(Command::Scenes(SceneCommand::GiveUpReading));
                    }
                });
            });
        });
}

/// Its name, cut where it is long.
fn label(entry: &SceneEntry) -> String {
    const MOST: usize = 40;
    let name = &entry.label;
    match name.char_indices().nth(MOST) {
        Some((end, _)) => format!("{}\u{2026}", &name[..end]),
        None => name.clone(),
    }
}
