//! The settings of texture footprints: anisotropy, bias of the level of detail, a fixed level, derivatives.

use egui::{DragValue, Layout, Ui, vec2};

use super::controls::{choice, gave_up, row, tip};
use super::look::CONTROL;
use crate::texture::{Anisotropy, Derivatives, FixedLevel, LodBias};
use crate::viewer::{Command, Viewer};

/// What stands for a level that nobody fixed.
const AUTO: &str = "auto";
/// Levels per point of dragging.
const SPEED: f64 = 0.02;
/// The dragged number that means [`AUTO`]: below it, so that dragging to the left leaves a fixed level.
const BELOW: f64 = -0.5;

/// Shows the settings and adds what was changed to `commands`.
pub(super) fn show(ui: &mut Ui, viewer: &Viewer, commands: &mut Vec<Command>) {
    let render = &viewer.settings().render;
    row(ui, "Anisotropy", |ui| {
        let mut values: Vec<_> = Anisotropy::STEPS.to_vec();
        if !values.contains(&render.anisotropy) {
            // In the place of the next lower step, so that the row does not get longer.
            let at = values.iter().rposition(|step| *step < render.anisotropy).unwrap_or(0);
            values[at] = render.anisotropy;
        }
        let values: Vec<_> = values.into_iter().map(|taps| (taps, taps.taps().to_string())).collect();
        let chosen = choice(ui, "Anisotropy", &tip("anisotropy"), render.anisotropy, &values);
        commands.extend(chosen.map(Command::SetAnisotropy));
    });
    row(ui, "Level bias", |ui| {
        let width = (ui.available_width() - 4.0) / 2.0;
        let before = render.detail.bias;
        let mut levels = before.levels();
        let field = DragValue::new(&mut levels)
            .range(-LodBias::MAX..=LodBias::MAX)
            .speed(SPEED)
            .max_decimals(2)
            .custom_formatter(|levels, _| format!("{:+}", (levels * 100.0).round() / 100.0));
        let is_taken = sized(ui, width, field, "Level of detail bias", "lod-bias");
        commands.extend(
            LodBias::new(levels)
                .filter(|bias| is_taken && *bias != before)
                .map(Command::SetLodBias),
        );
        fixed_level(ui, width, render.detail.fixed, commands);
    });
    row(ui, "Level per", |ui| {
        let values = Derivatives::ALL.map(|value| (value, value.name().to_owned()));
        let current = render.detail.derivatives;
        let chosen = choice(ui, "Level of detail per", &tip("lod-per"), current, &values);
        commands.extend(chosen.map(Command::SetDerivatives));
    });
}

/// A level to drag or type; `auto` below 0.
fn fixed_level(ui: &mut Ui, width: f32, before: Option<FixedLevel>, commands: &mut Vec<Command>) {
    let mut level = before.map_or(BELOW, FixedLevel::level);
    let shown = level;
    let field = DragValue::new(&mut level)
        .range(BELOW..=FixedLevel::MAX)
        .speed(SPEED)
        .max_decimals(2)
        .prefix("level ")
        .custom_formatter(|level, _| {
            if level < 0.0 {
                AUTO.to_owned()
            } else {
                ((level * 100.0).round() / 100.0).to_string()
            }
        })
        .custom_parser(|text| match text.trim().trim_start_matches("level").trim() {
            "" | AUTO => Some(BELOW),
            number => number.parse().ok(),
        });
    let is_taken = sized(ui, width, field, "Fixed level", "lod-level");
    #[expect(clippy::float_cmp, reason = "a number that nobody touched is the same one")]
    if is_taken && level != shown {
        commands.push(Command::SetFixedLevel(FixedLevel::new(level)));
    }
}

/// A number's field of this width; whether the number that it leaves counts.
fn sized(ui: &mut Ui, width: f32, field: DragValue<'_>, name: &str, id: &str) -> bool {
    let layout = Layout::centered_and_justified(ui.layout().main_dir());
    let shown = ui.allocate_ui_with_layout(vec2(width, CONTROL.y), layout, |ui| {
        let tip = format!("{}\ndrag, or click and type", tip(id));
        let response = ui.add(field.clip_text(true).update_while_editing(false));
        let is_taken = !gave_up(ui, &response);
        response.on_hover_text(tip).accessible_name(name);
        is_taken
    });
    shown.inner
}
