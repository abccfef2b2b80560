//! The view in numbers that can be typed or dragged.

use std::cell::Cell;

use egui::text::CCursorRange;
use egui::{Color32, DragValue, Layout, RichText, TextEdit, Ui, vec2};

use super::controls::{at_end, command_button, finite, gave_up, row};
use crate::viewer::{Command, SceneEntry, ViewCommand, ViewNumbers, Viewer};

/// Window pixels that the picture moves per pixel of dragging a number.
const DRAG_SPEED: f64 = 1.0;

/// Significant digits that a number shows at most; its tool tip and its line of text have them all.
const DIGITS: i32 = 8;

/// A number that can be dragged and typed.
struct Number<'a> {
    name: &'a str,
    unit: &'a str,
    /// Change per point of dragging.
    speed: f64,
    /// Decimals that mean something, where not all do.
    decimals: Option<usize>,
}

/// Shows the numbers and adds what was changed to `commands`. Before a scene was read there are none: those of `last` stay
/// meanwhile, so that nothing below moves under the pointer that goes from scene to scene.
pub(super) fn show(ui: &mut Ui, viewer: &Viewer, last: &mut ViewNumbers, commands: &mut Vec<Command>) {
    head(ui, commands);
    if let Some(numbers) = viewer.both().view_numbers() {
        *last = numbers;
        rows(ui, numbers, commands);
    } else {
        let is_reading = viewer.scene_list().current().is_some_and(SceneEntry::is_reading);
        ui.add_enabled_ui(is_reading, |ui| rows(ui, *last, &mut Vec::new()));
    }
}

/// The heading, and beside it the cards that measure what is seen.
fn head(ui: &mut Ui, commands: &mut Vec<Command>) {
    ui.add_space(3.0);
    ui.horizontal(|ui| {
        ui.label(RichText::new("View").strong().size(12.0));
        ui.spacing_mut().item_spacing.x = 4.0;
        at_end(ui, &["Spectrum", "Profile", "Board"], |ui| {
            for (id, text) in [("spectrum", "Spectrum"), ("profile", "Profile"), ("board", "Board")] {
                let command = crate::viewer::commands::find(id).and_then(crate::viewer::CommandSpec::command);
                if command_button(ui, id, text).clicked() {
                    commands.extend(command);
                }
            }
        });
    });
}

fn rows(ui: &mut Ui, before: ViewNumbers, commands: &mut Vec<Command>) {
    let mut numbers = before;
    row(ui, "Centre", |ui| {
        let width = (ui.available_width() - 4.0) / 2.0;
        let center = |name| Number {
            name,
            unit: "",
            speed: DRAG_SPEED / before.scale,
            decimals: Some(decimals(before.scale)),
        };
        center("Centre x").show(ui, width, &mut numbers.center.x);
        center("Centre y").show(ui, width, &mut numbers.center.y);
    });
    row(ui, "Scale", |ui| {
        let scale = Number {
            name: "Scale in pixels per unit",
            unit: " px/unit",
            speed: before.scale * 0.01,
            decimals: None,
        };
        scale.show(ui, ui.available_width(), &mut numbers.scale);
    });
    row(ui, "Rotation", |ui| {
        let rotation = Number {
            name: "Rotation in degrees, clockwise",
            unit: "°",
            speed: 0.5,
            decimals: Some(3),
        };
        rotation.show(ui, ui.available_width(), &mut numbers.rotation);
    });
    if numbers != before {
        commands.push(Command::View(ViewCommand::Set(ViewNumbers { ..numbers })));
    }
    ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = 4.0;
        for (id, text, command) in [
            ("reset-view", "Reset", Command::View(ViewCommand::Reset)),
            ("fit", "Fit", Command::View(ViewCommand::Fit)),
            ("actual-size", "1:1", Command::View(ViewCommand::ActualSize)),
            (
                "rotate-left",
                "−5°",
                Command::View(ViewCommand::RotateBy { degrees: -5.0 }),
            ),
            (
                "rotate-right",
                "+5°",
                Command::View(ViewCommand::RotateBy { degrees: 5.0 }),
            ),
        ] {
            if command_button(ui, id, text).clicked() {
                let known = crate::viewer::commands::find(id).and_then(crate::viewer::CommandSpec::command);
                commands.push(known.unwrap_or(command));
            }
        }
    });
}

impl Number<'_> {
    /// Never wider than `width` points, whatever the value: digits give way. Where something was typed that is no number, the
    /// value is none either.
    fn show(&self, ui: &mut Ui, width: f32, value: &mut f64) {
        let size = vec2(width, super::look::CONTROL.y);
        let layout = Layout::centered_and_justified(ui.layout().main_dir());
        ui.allocate_ui_with_layout(size, layout, |ui| {
            let id = ui.next_auto_id();
            let typing = ui.memory(|memory| memory.has_focus(id));
            let (before, decimals, unit) = (*value, self.decimals, self.unit);
            let room = width - 2.0 * ui.spacing().button_padding.x;
            let font = ui.style().drag_value_text_style.resolve(ui.style());
            let painter = ui.painter().clone();
            let fits = move |text: &str| {
                let text = format!("{text}{unit}");
                let galley = painter.layout_no_wrap(text, font.clone(), Color32::PLACEHOLDER);
                galley.size().x <= room
            };
            let mut typed = before;
            let is_none = Cell::new(false);
            let field = DragValue::new(&mut typed)
                .speed(self.speed)
                .max_decimals_opt(decimals)
                .suffix(unit)
                .clip_text(true)
                .update_while_editing(false)
                .custom_parser(|text| {
                    let number = finite(text);
                    is_none.set(number.is_none());
                    number
                })
                .custom_formatter(move |value, _| {
                    if typing {
                        all_digits(value)
                    } else {
                        shortened(value, decimals, &fits)
                    }
                });
            let response = ui.add(field);
            if !gave_up(ui, &response) {
                // What is no number sets nothing, and the viewer says what is possible.
                *value = if is_none.get() { f64::NAN } else { typed };
            }
            if response.clicked() {
                // The field chose the digits that it showed; the line of text begins with all of them.
                let mut state = TextEdit::load_state(ui.ctx(), id).unwrap_or_default();
                let all = CCursorRange::select_all_str(&all_digits(before));
                state.cursor.set_char_range(Some(all));
                state.store(ui.ctx(), id);
            }
            let tip = format!("{}: {}\ndrag, or click and type", self.name, all_digits(before));
            response.on_hover_text(tip).accessible_name(self.name);
        });
    }
}

/// The number so that reading it back gives the same one.
fn all_digits(value: f64) -> String {
    match value.abs() {
        size if size == 0.0 || (1e-5..1e16).contains(&size) => value.to_string(),
        _ => format!("{value:e}"),
    }
}

/// The number with as many digits as fit.
fn shortened(value: f64, decimals: Option<usize>, fits: &impl Fn(&str) -> bool) -> String {
    let mut texts = (1..=DIGITS).rev().map(|digits| rounded(value, digits, decimals));
    let fitting = texts.find(|text| fits(text));
    fitting.unwrap_or_else(|| rounded(value, 1, decimals))
}

/// The number with the given count of significant digits and no more decimals than given; very large and very small ones with an
/// exponent.
fn rounded(value: f64, digits: i32, decimals: Option<usize>) -> String {
    let value = match decimals {
        Some(decimals) => format!("{value:.decimals$}").parse().unwrap_or(value),
        None => value,
    };
    if value == 0.0 {
        return "0".to_owned();
    }
    let precision = usize::try_from(digits - 1).unwrap_or(0);
    let scientific = format!("{value:.precision$e}");
    let Some((mantissa, exponent)) = scientific.split_once('e') else {
        return scientific; // not finite
    };
    match exponent.parse::<i32>() {
        Ok(power @ -4..=6) => {
            let places = usize::try_from(digits - 1 - power).unwrap_or(0);
            without_zeros(&format!("{value:.places$}")).to_owned()
        }
        _ => format!("{}e{exponent}", without_zeros(mantissa)),
    }
}

/// Without the zeros that end the decimals.
fn without_zeros(number: &str) -> &str {
    if number.contains('.') {
        number.trim_end_matches('0').trim_end_matches('.')
    } else {
        number
    }
}

/// Decimals that tell neighbouring pixels apart, with one to spare.
fn decimals(scale: f64) -> usize {
    (1..15)
        .find(|digits| 10_f64.powi(*digits) > scale * 10.0)
        .and_then(|digits| usize::try_from(digits).ok())
        .unwrap_or(15)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_short_and_honest() {
        let text = |value, decimals| rounded(value, DIGITS, decimals);
        assert_eq!(text(512.345_678_9, Some(8)), "512.34568", "eight digits");
        assert_eq!(text(512.345_678_9, Some(2)), "512.35", "decimals that mean something");
        assert_eq!(text(-0.000_000_1, Some(2)), "0", "no minus before nothing");
        assert_eq!(text(2.6, None), "2.6", "no zeros at the end");
        assert_eq!(text(1_000_000.0, None), "1000000", "zeros before the point stay");
        assert_eq!(text(1e10, None), "1e10", "very large");
        assert_eq!(text(1e-10, None), "1e-10", "very small is not nothing");
        assert_eq!(text(9_999_999.96, None), "1e7", "rounded up to the next power");
        assert_eq!(text(f64::NAN, None), "NaN", "not a number");
    }

    #[test]
    fn digits_give_way() {
        let within = |length: usize| move |text: &str| text.len() <= length;
        for value in [
            512.345_678_9,
            -433.987_654,
            1.234_567_89e10,
            -1.234_567_89e-10,
            0.001_234_567,
        ] {
            let text = shortened(value, None, &within(8));
            assert!(text.len() <= 8, "{text} for {value}");
            let read: f64 = text.parse().expect("a number");
            assert!(((read - value) / value).abs() < 0.05, "{text} for {value}");
        }
    }

    #[test]
    fn typed_numbers_are_exact() {
        for value in [0.0, 0.1 + 0.2, 512.345_678_9, 1e-300, -1e300, 1e10, 1e-10] {
            assert_eq!(all_digits(value).parse(), Ok(value), "{value:e}");
        }
    }
}
