//! The few controls that the panels are built of; each has an accessible name and says its key in its tool tip.

use egui::{
    Align, Button, Color32, ComboBox, Key, Layout, RectAlign, Response, RichText, TextStyle, Tooltip, Ui, vec2,
};

use super::focus;
use super::look::CONTROL;
use crate::viewer::{CommandSpec, commands};

/// Width of a row's label, in points.
const LABEL_WIDTH: f32 = 78.0;

/// A heading with a line above it.
pub(super) fn heading(ui: &mut Ui, text: &str) {
    ui.add_space(8.0);
    ui.label(RichText::new(text).strong().size(12.0));
    ui.add_space(1.0);
}

/// A label on the left and a control that fills the rest of the row.
pub(super) fn row<R>(ui: &mut Ui, label: &str, contents: impl FnOnce(&mut Ui) -> R) -> R {
    ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = 4.0;
        ui.allocate_ui_with_layout(
            vec2(LABEL_WIDTH, CONTROL.y),
            Layout::left_to_right(Align::Center),
            |ui| {
                ui.set_min_width(LABEL_WIDTH);
                ui.label(RichText::new(label).weak());
            },
        );
        contents(ui)
    })
    .inner
}

/// A value that can be chosen.
pub(super) struct Offered<'t, T> {
    pub(super) value: T,
    pub(super) text: &'t str,
    /// What is told of it alone; empty where that says nothing more than the control's own tool tip.
    pub(super) tip: String,
}

/// One of several values, side by side over the whole width; what was chosen, if it was just now.
pub(super) fn choice<T: Copy + PartialEq>(
    ui: &mut Ui,
    name: &str,
    tip: &str,
    current: T,
    values: &[(T, String)],
) -> Option<T> {
    choice_of(ui, name, &|_| tip.to_owned(), current, values)
}

/// The same with a tool tip for each value.
pub(super) fn choice_of<T: Copy + PartialEq>(
    ui: &mut Ui,
    name: &str,
    tip: &dyn Fn(T) -> String,
    current: T,
    values: &[(T, String)],
) -> Option<T> {
    choice_where(ui, name, &|value| (tip(value), true), current, values)
}

/// The same where some values cannot be chosen: the tool tip of each, which then says why, and whether it can.
pub(super) fn choice_where<T: Copy + PartialEq>(
    ui: &mut Ui,
    name: &str,
    tip: &dyn Fn(T) -> (String, bool),
    current: T,
    values: &[(T, String)],
) -> Option<T> {
    let gap = 2.0;
    let count = values.len().max(1) as f32;
    let width = ((ui.available_width() - gap * (count - 1.0)) / count).floor();
    let mut chosen = None;
    ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = gap;
        ui.spacing_mut().button_padding.x = 1.0;
        for (value, text) in values {
            let button = Button::selectable(*value == current, fitted(ui, text, width))
                .frame_when_inactive(true)
                .min_size(vec2(width, CONTROL.y));
            let (tip, enabled) = tip(*value);
            let add = |ui: &mut Ui| ui.add_sized([width, CONTROL.y], button);
            let response = if enabled {
                add(ui)
            } else {
                ui.add_enabled_ui(false, add).inner
            };
            let response = response
                .on_hover_text(tip.as_str())
                .on_disabled_hover_text(tip)
                .accessible_name(format!("{name}: {text}"));
            if response.clicked() && *value != current {
                chosen = Some(*value);
            }
        }
    });
    chosen
}

/// A button's text, in smaller letters where it would touch the sides.
fn fitted(ui: &Ui, text: &str, width: f32) -> RichText {
    /// Free points on both sides together.
    const FREE: f32 = 6.0;
    let font = TextStyle::Button.resolve(ui.style());
    let needed = ui
        .painter()
        .layout_no_wrap(text.to_owned(), font.clone(), Color32::WHITE)
        .size()
        .x;
    let size = font.size * ((width - FREE) / needed.max(1.0)).clamp(0.8, 1.0);
    RichText::new(text).size(size)
}

/// One of more values than there is room for buttons. `name` is for screen readers and identifies the control.
pub(super) fn drop_down<T: Copy + PartialEq>(
    ui: &mut Ui,
    name: &str,
    tip: &str,
    current: T,
    values: &[Offered<'_, T>],
) -> Option<T> {
    /// What padding and the arrow take of the width, beside what [`fitted`] leaves free.
    const ARROW: f32 = 26.0;
    let shown = values.iter().find(|offered| offered.value == current);
    let shown = shown.map_or("", |offered| offered.text);
    let mut chosen = None;
    let list = ComboBox::from_id_salt(name)
        .width(ui.available_width())
        .selected_text(fitted(ui, shown, ui.available_width() - ARROW))
        .truncate()
        .height(f32::INFINITY)
        .show_ui(ui, |ui| {
            for Offered { value, text, tip } in values {
                let line = ui.selectable_label(*value == current, *text);
                if !tip.is_empty() {
                    tip_beside(Tooltip::for_enabled(&line), RectAlign::LEFT_START, tip);
                }
                if line.clicked() && *value != current {
                    chosen = Some(*value);
                }
            }
        })
        .response
        .on_hover_text(tip)
        .accessible_name(name.to_owned());
    focus::note_opener(&list);
    chosen
}

/// A tool tip beside a line of a list, on the side where it covers none of the next lines.
pub(super) fn tip_beside(mut tip: Tooltip<'_>, side: RectAlign, text: impl Into<RichText>) {
    tip.popup = tip.popup.align(side);
    tip.show(|ui| ui.label(text.into()));
}

/// The number that was typed into a field; what is no finite one counts as nothing, and not as the end of the field's range.
pub(super) fn finite(text: &str) -> Option<f64> {
    let plain: String = text.chars().filter(|letter| !letter.is_whitespace()).collect();
    let number = plain.replace('\u{2212}', "-").parse().ok();
    number.filter(|number: &f64| number.is_finite())
}

/// Whether Esc gave up what was typed into a number's field: then the old number stays.
///
/// egui heeds the key in the pass in which it is pressed, but a field counts as just left in the pass after it, too, and
/// takes its text there.
pub(super) fn gave_up(ui: &Ui, field: &Response) -> bool {
    let pass = ui.ctx().cumulative_pass_nr();
    let had_keyboard = ui.memory(|memory| memory.had_focus_last_frame(field.id));
    let leaves = had_keyboard && ui.input(|input| input.key_pressed(Key::Escape));
    let key = field.id.with("given up");
    ui.data_mut(|data| {
        if leaves {
            data.insert_temp(key, pass);
        }
        data.get_temp(key).is_some_and(|since: u64| pass <= since + 1)
    })
}

/// What a line of text held when it got the keyboard, once Esc gives up what was typed since.
pub(super) fn given_up_text(ui: &Ui, line: &Response, text: &str) -> Option<String> {
    let key = line.id.with("before");
    if line.gained_focus() {
        ui.data_mut(|data| data.insert_temp(key, text.to_owned()));
    }
    let leaves = line.lost_focus() && ui.input(|input| input.key_pressed(Key::Escape));
    leaves.then(|| ui.data(|data| data.get_temp(key)))?
}

/// What the tool tip of the command `id` says.
pub(super) fn tip(id: &str) -> String {
    commands::find(id).map(CommandSpec::tip).unwrap_or_default()
}

/// Buttons with these texts at the right end of a row. They are laid out from left to right, which is the way that Tab goes.
pub(super) fn at_end<R>(ui: &mut Ui, texts: &[&str], buttons: impl FnOnce(&mut Ui) -> R) -> R {
    let font = TextStyle::Button.resolve(ui.style());
    let spacing = ui.spacing();
    let (padding, gap) = (2.0 * spacing.button_padding.x, spacing.item_spacing.x);
    let widths = texts.iter().map(|text| {
        let text = ui
            .painter()
            .layout_no_wrap((*text).to_owned(), font.clone(), Color32::WHITE);
        (text.size().x + padding).max(CONTROL.x)
    });
    let width = widths.sum::<f32>() + gap * (texts.len().max(1) - 1) as f32;
    ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
        let size = vec2(width, CONTROL.y);
        ui.allocate_ui_with_layout(size, Layout::left_to_right(Align::Center), buttons)
            .inner
    })
    .inner
}

/// A button for the command `id`: its tool tip and accessible name come from the table.
pub(super) fn command_button(ui: &mut Ui, id: &str, text: &str) -> Response {
    let name = commands::find(id).map_or(id, |spec| spec.name);
    let button = Button::new(text).min_size(CONTROL);
    ui.add(button).on_hover_text(tip(id)).accessible_name(name)
}
