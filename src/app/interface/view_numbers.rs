//! The view in numbers that can be typed or dragged.

use egui::{DragValue, Response, Ui};

use super::controls::{command_button, heading, row};
use crate::viewer::{Command, ViewNumbers, Viewer};

/// Window pixels that the picture moves per pixel of dragging a number.
const DRAG_SPEED: f64 = 1.0;

/// Shows the numbers and adds what was changed to `commands`.
pub(super) fn show(ui: &mut Ui, viewer: &Viewer, commands: &mut Vec<Command>) {
    let Some(before) = viewer.view_numbers() else {
        return;
    };
    heading(ui, "View");
    let mut numbers = before;
    let unit = DRAG_SPEED / before.scale;
    let decimals = decimals(before.scale);
    row(ui, "Centre", |ui| {
        let width = (ui.available_width() - 4.0) / 2.0;
        number(
            ui,
            width,
            "Centre x",
            DragValue::new(&mut numbers.center.x).speed(unit).max_decimals(decimals),
        );
        number(
            ui,
            width,
            "Centre y",
            DragValue::new(&mut numbers.center.y).speed(unit).max_decimals(decimals),
        );
    });
    row(ui, "Scale", |ui| {
        let speed = before.scale * 0.01;
        let field = DragValue::new(&mut numbers.scale)
            .speed(speed)
            .max_decimals(6)
            .suffix(" px/unit");
        number(ui, ui.available_width(), "Scale in pixels per unit", field);
    });
    row(ui, "Rotation", |ui| {
        let field = DragValue::new(&mut numbers.rotation)
            .speed(0.5)
            .max_decimals(3)
            .suffix("°");
        number(ui, ui.available_width(), "Rotation in degrees, clockwise", field);
    });
    if numbers != before {
        commands.push(Command::SetView(ViewNumbers { ..numbers }));
    }
    ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = 4.0;
        for (id, text, command) in [
            ("reset-view", "Reset", Command::ResetView),
            ("fit", "Fit", Command::FitView),
            ("actual-size", "1:1", Command::ActualSize),
            ("rotate-left", "−5°", Command::RotateBy { degrees: -5.0 }),
            ("rotate-right", "+5°", Command::RotateBy { degrees: 5.0 }),
        ] {
            if command_button(ui, id, text).clicked() {
                let known = crate::viewer::commands::find(id).and_then(crate::viewer::CommandSpec::command);
                commands.push(known.cloned().unwrap_or(command));
            }
        }
    });
}

fn number(ui: &mut Ui, width: f32, name: &str, field: DragValue<'_>) -> Response {
    ui.add_sized([width, super::look::CONTROL.y], field.update_while_editing(false))
        .on_hover_text(format!("{name}: drag, or click and type"))
        .accessible_name(name)
}

/// Decimals that tell neighbouring pixels apart, with one to spare.
fn decimals(scale: f64) -> usize {
    (1..15)
        .find(|digits| 10_f64.powi(*digits) > scale * 10.0)
        .and_then(|digits| usize::try_from(digits).ok())
        .unwrap_or(15)
}
