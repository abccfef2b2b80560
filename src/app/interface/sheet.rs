//! The dialog that puts a sheet together: what differs, beside a preview of what will be saved.

use egui::{Align, Button, Checkbox, Color32, ComboBox, Context, Layout, Rect, RichText, ScrollArea, TextEdit};
use egui::{TextureHandle, TextureOptions, Ui, Vec2, pos2, vec2};

use super::controls::{choice, given_up_text, heading, row, tip};
use super::focus;
use super::look::CONTROL;
use super::modal::{beside, modal};
use super::scenes::image_of;
use crate::figure::{Ground, PAGE_WIDTH};
use crate::viewer::{
    Axis, Command, CommandSpec, PanelSize, PictureSetting, SceneEntry, SheetChange, SheetCommand, SheetPreview,
    SheetSide, Viewer, WindowCommand, commands, picture,
};

/// Width of the controls, in points.
const CONTROLS: f32 = 272.0;
/// What the window keeps free around the dialog, in points.
const AROUND: Vec2 = vec2(32.0, 48.0);
/// Least side of the preview, in points.
const LEAST: f32 = 96.0;

/// What the dialog remembers.
#[derive(Debug, Default)]
pub(super) struct SheetDialog {
    /// What was typed as values of columns and rows.
    values: [TypedValues; 2],
    size: String,
    preview: Option<ShownPreview>,
}

/// Values that a person types; they count only while they make sense.
#[derive(Debug, Default)]
struct TypedValues {
    /// Of this setting.
    name: String,
    text: String,
    problem: Option<String>,
}

/// A preview as a texture of exactly its size.
struct ShownPreview {
    number: u64,
    texture: TextureHandle,
}

impl std::fmt::Debug for ShownPreview {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("ShownPreview")
            .field("number", &self.number)
            .finish_non_exhaustive()
    }
}

impl SheetDialog {
    /// Shows the dialog.
    pub(super) fn show(&mut self, ctx: &Context, viewer: &Viewer, commands: &mut Vec<Command>) {
        let screen = ctx.content_rect().size();
        let size = (screen - AROUND).min(vec2(1500.0, 1100.0)).max(vec2(LEAST, LEAST));
        let modal = modal("sheet").show(ctx, |ui| {
            ui.set_width(size.x);
            let height = (size.y - 24.0).max(LEAST);
            ui.set_height(height);
            // A narrow window has room for the controls alone.
            if size.x >= CONTROLS + 2.0 * LEAST {
                ui.horizontal_top(|ui| {
                    ui.allocate_ui_with_layout(vec2(CONTROLS, height), Layout::top_down(Align::Min), |ui| {
                        ui.set_width(CONTROLS);
                        self.controls(ui, viewer, commands);
                    });
                    ui.add_space(8.0);
                    self.preview(ui, viewer, commands);
                });
            } else {
                self.controls(ui, viewer, commands);
            }
        });
        if beside(&modal.backdrop_response) {
            commands.push(Command::Window(WindowCommand::CloseDialog));
        }
    }

    fn controls(&mut self, ui: &mut Ui, viewer: &Viewer, commands: &mut Vec<Command>) {
        ui.heading("Sheet");
        // Above the rest: the window's messages lie over what is below.
        buttons(ui, self.problem(viewer), commands);
        ScrollArea::vertical()
            .id_salt("sheet controls")
            .auto_shrink(false)
            .show(ui, |ui| {
                for side in SheetSide::ALL {
                    self.axis(ui, viewer, side, commands);
                }
                self.panels(ui, viewer, commands);
                words(ui, viewer, commands);
            });
    }

    /// What is wrong with values that were typed: until they are mended, the sheet is another than its fields say.
    fn problem(&self, viewer: &Viewer) -> Option<&str> {
        let draft = viewer.sheet().draft();
        let mut typed = SheetSide::ALL.into_iter().zip(&self.values);
        typed.find_map(|(side, typed)| {
            draft.axis(side).filter(|axis| axis.name == typed.name)?;
            typed.problem.as_deref()
        })
    }

    /// What differs on a side, and by which values.
    fn axis(&mut self, ui: &mut Ui, viewer: &Viewer, side: SheetSide, commands: &mut Vec<Command>) {
        let (title, id) = match side {
            SheetSide::Columns => ("Columns", "sheet-columns"),
            SheetSide::Rows => ("Rows", "sheet-rows"),
        };
        heading(ui, title);
        let current = viewer.sheet().draft().axis(side);
        let name = current.map_or("nothing", |axis| axis.name.as_str());
        let mut chosen = None;
        let list = ComboBox::from_id_salt(title)
            .width(ui.available_width())
            .selected_text(name.replace('-', " "))
            .height(f32::INFINITY)
            .show_ui(ui, |ui| {
                let all = std::iter::once("nothing").chain(picture::all().map(|setting| setting.option));
                for other in all {
                    let label = other.replace('-', " ");
                    if ui.selectable_label(other == name, label).clicked() && other != name {
                        chosen = Some(other);
                    }
                }
            })
            .response
            .on_hover_text(tip(id))
            .accessible_name(title);
        focus::note_opener(&list);
        if let Some(name) = chosen {
            let axis = picture::find(name).map(Axis::first);
            commands.push(Command::Sheet(SheetCommand::Change(SheetChange::Axis(side, axis))));
            return;
        }
        let Some(axis) = current else { return };
        let counted = picture::find(&axis.name).map_or(Vec::new(), PictureSetting::names);
        if counted.is_empty() {
            self.typed(ui, axis, side, commands);
        } else {
            ticked(ui, axis, &counted, side, commands);
        }
    }

    /// Values that are typed.
    fn typed(&mut self, ui: &mut Ui, axis: &Axis, side: SheetSide, commands: &mut Vec<Command>) {
        let typed = &mut self.values[usize::from(side == SheetSide::Rows)];
        let known = axis.values.join(", ");
        let same = |text: &str| Axis::parse(&axis.name, text).is_ok_and(|typed| typed.values == axis.values);
        if typed.name != axis.name || (typed.problem.is_none() && !same(&typed.text)) {
            *typed = TypedValues {
                name: axis.name.clone(),
                text: known,
                problem: None,
            };
        }
        let response = ui
            .add(
                TextEdit::singleline(&mut typed.text)
                    .desired_width(f32::INFINITY)
                    .margin(vec2(8.0, 4.0)),
            )
            .on_hover_text("Values with commas between them")
            .accessible_name(format!("Values of the {}", side.name()));
        let before = given_up_text(ui, &response, &typed.text);
        let is_new = response.changed() || before.is_some();
        typed.text = before.unwrap_or_else(|| std::mem::take(&mut typed.text));
        if is_new {
            match Axis::of(&axis.name, &typed.text) {
                Ok(axis) => {
                    typed.problem = None;
                    commands.push(Command::Sheet(SheetCommand::Change(SheetChange::Axis(
                        side,
                        Some(axis),
                    ))));
                }
                Err(problem) => typed.problem = Some(problem),
            }
        }
        if let Some(problem) = &typed.problem {
            ui.label(RichText::new(problem).color(ui.visuals().warn_fg_color).small());
        }
    }

    /// How large panels are, and what they magnify.
    fn panels(&mut self, ui: &mut Ui, viewer: &Viewer, commands: &mut Vec<Command>) {
        heading(ui, "Panels");
        let draft = viewer.sheet().draft();
        let change = |panels| Command::Sheet(SheetCommand::Change(SheetChange::Panels(panels)));
        let [width, height] = viewer.both().layout().frame_size();
        let exact = match draft.panels {
            PanelSize::Exact(size) => size,
            _ => [800, 600],
        };
        let values = [
            (PanelSize::Window, "window"),
            (PanelSize::Page, "page"),
            (PanelSize::Exact(exact), "size"),
        ];
        let named = values.map(|(value, text)| (value, text.to_owned()));
        let tips = format!(
            "window: {width} x {height} pixels, each as in the window\npage: as large as makes the sheet {PAGE_WIDTH} pixels wide, \
             16 cm at 300 dpi\nsize: as large as you say"
        );
        commands.extend(choice(ui, "Panels", &tips, draft.panels, &named).map(change));
        if let PanelSize::Exact([width, height]) = draft.panels {
            row(ui, "Size", |ui| {
                if PanelSize::parse(&self.size).is_none_or(|typed| typed != draft.panels)
                    && !ui.ctx().text_edit_focused()
                {
                    self.size = format!("{width}x{height}");
                }
                let field = TextEdit::singleline(&mut self.size).desired_width(f32::INFINITY);
                let response = ui
                    .add(field)
                    .on_hover_text(tip("sheet-panels"))
                    .accessible_name("Size of panels");
                let before = given_up_text(ui, &response, &self.size);
                let is_new = response.changed() || before.is_some();
                self.size = before.unwrap_or_else(|| std::mem::take(&mut self.size));
                if is_new {
                    commands.extend(PanelSize::parse(&self.size).map(change));
                }
            });
        }
        let can = viewer.pixels().sheet_has_inset();
        let mut inset = draft.inset && can;
        let text = if can {
            "Inset of the pinned pixel"
        } else {
            "Inset: pin a pixel first"
        };
        let response = ui.add_enabled(can, Checkbox::new(&mut inset, text));
        if response.on_hover_text(tip("sheet-inset")).changed() {
            commands.push(Command::Sheet(SheetCommand::Change(SheetChange::Inset(inset))));
        }
    }

    /// The sheet as it will be saved, made to fit.
    fn preview(&mut self, ui: &mut Ui, viewer: &Viewer, commands: &mut Vec<Command>) {
        /// Height of the line below the preview, in points.
        const LINE: f32 = 20.0;
        let room = ui.available_size() - vec2(0.0, LINE);
        let scale = ui.pixels_per_point();
        commands.push(Command::Sheet(SheetCommand::SetRoom(device_size(room, scale))));
        ui.allocate_ui_with_layout(ui.available_size(), Layout::top_down(Align::Min), |ui| {
            let (area, _) = ui.allocate_exact_size(room, egui::Sense::hover());
            ui.painter().rect_filled(area, 4.0, ui.visuals().faint_bg_color);
            let weak = ui.visuals().weak_text_color();
            let told = |ui: &mut Ui, text: &str, color: Color32| {
                let label = egui::Label::new(RichText::new(text).color(color)).wrap();
                ui.put(area.shrink(12.0), label);
            };
            let line = match viewer.sheet().preview() {
                None => {
                    let failed = viewer.scene_list().current().is_none_or(SceneEntry::has_no_picture);
                    told(ui, if failed { "no scene to draw" } else { "drawing …" }, weak);
                    String::new()
                }
                Some((Err(problem), _)) => {
                    told(ui, &without_dashes(problem), ui.visuals().warn_fg_color);
                    String::new()
                }
                Some((Ok(preview), stale)) => {
                    self.picture(ui, area, viewer.sheet().preview_number(), preview);
                    size_words(preview, stale)
                }
            };
            // One line, so that the dialog keeps its height.
            ui.add(egui::Label::new(RichText::new(line).small().color(weak)).truncate());
        });
    }

    /// Paints the preview in the middle of `area`, on whole device pixels.
    fn picture(&mut self, ui: &Ui, area: Rect, number: u64, preview: &SheetPreview) {
        let picture = &preview.picture;
        if self.preview.as_ref().is_none_or(|shown| shown.number != number) {
            let texture = ui
                .ctx()
                .load_texture("sheet", image_of(picture), TextureOptions::NEAREST);
            self.preview = Some(ShownPreview { number, texture });
        }
        let Some(shown) = &self.preview else { return };
        let scale = ui.pixels_per_point();
        let size = vec2(picture.width() as f32, picture.height() as f32) / scale;
        let corner = ((area.center() - size / 2.0) * scale).round() / scale;
        let place = Rect::from_min_size(corner, size);
        let whole = Rect::from_min_max(pos2(0.0, 0.0), pos2(1.0, 1.0));
        ui.painter().image(shown.texture.id(), place, whole, Color32::WHITE);
    }
}

/// Values that can be counted: any of them, in their order.
fn ticked(ui: &mut Ui, axis: &Axis, counted: &[&'static str], side: SheetSide, commands: &mut Vec<Command>) {
    ui.horizontal_wrapped(|ui| {
        ui.spacing_mut().item_spacing = vec2(2.0, 2.0);
        for value in counted {
            let taken = axis.values.iter().any(|known| known == value);
            let button = Button::selectable(taken, *value)
                .frame_when_inactive(true)
                .min_size(CONTROL);
            let response = ui.add(button).accessible_name(format!("{}: {value}", axis.name));
            // One value at least: an axis without any is none.
            if response.clicked() && (!taken || axis.values.len() > 1) {
                let is_wanted = |other: &&&str| (*other == value) != axis.values.iter().any(|known| known == **other);
                let values = counted.iter().filter(is_wanted).map(|value| (*value).to_owned());
                let axis = Axis {
                    name: axis.name.clone(),
                    values: values.collect(),
                };
                commands.push(Command::Sheet(SheetCommand::Change(SheetChange::Axis(
                    side,
                    Some(axis),
                ))));
            }
        }
    });
}

/// Ground and caption.
fn words(ui: &mut Ui, viewer: &Viewer, commands: &mut Vec<Command>) {
    heading(ui, "Ground");
    let draft = viewer.sheet().draft();
    let values = Ground::ALL.map(|ground| (ground, ground.name().to_owned()));
    let chosen = choice(ui, "Ground", &tip("sheet-theme"), draft.theme, &values);
    commands.extend(chosen.map(|theme| Command::Sheet(SheetCommand::Change(SheetChange::Theme(theme)))));
    heading(ui, "Caption");
    let mut note = draft.note.clone();
    let field = TextEdit::multiline(&mut note)
        .desired_width(f32::INFINITY)
        .desired_rows(3)
        .margin(vec2(8.0, 4.0))
        .hint_text("a sentence that the caption ends with");
    let response = ui
        .add(field)
        .on_hover_text(tip("sheet-note"))
        .accessible_name("Caption");
    let before = given_up_text(ui, &response, &note);
    if response.changed() || before.is_some() {
        let note = before.unwrap_or(note);
        // It is one sentence on one line of the command.
        let note = note.replace(['\n', '\r'], " ");
        commands.push(Command::Sheet(SheetCommand::Change(SheetChange::Note(note))));
    }
}

/// What can be done with the sheet; where there is a `problem`, it can only be closed.
fn buttons(ui: &mut Ui, problem: Option<&str>, commands: &mut Vec<Command>) {
    let mut button = |ui: &mut Ui, id: &str, text: &str, width: f32| {
        let problem = problem.filter(|_| id != "sheet");
        let add = |ui: &mut Ui| ui.add_sized([width, CONTROL.y], Button::new(text));
        let response = ui.add_enabled_ui(problem.is_none(), add).inner;
        let response = response
            .on_hover_text(tip(id))
            .on_disabled_hover_text(format!("Mend the values first: {}", problem.unwrap_or_default()));
        if response.clicked() {
            commands.extend(commands::find(id).and_then(CommandSpec::command));
        }
    };
    let width = ui.available_width();
    ui.horizontal(|ui| {
        let half = ((width - ui.spacing().item_spacing.x) / 2.0).floor();
        button(ui, "save-sheet", "Save", half);
        button(ui, "sheet", "Close", half);
    });
    button(ui, "copy-sheet-command-line", "Copy command line", width);
}

/// A problem that the command line names an option in, such as `--sample-rate 1: ...`, in the words of the window.
fn without_dashes(problem: &str) -> String {
    match problem.strip_prefix("--").and_then(|rest| rest.split_once(' ')) {
        Some((option, rest)) => format!("{} {rest}", option.replace('-', " ")),
        None => problem.to_owned(),
    }
}

/// What the preview stands for.
fn size_words(preview: &SheetPreview, stale: bool) -> String {
    let [width, height] = preview.size;
    let panels = match preview.panels {
        1 => "1 panel".to_owned(),
        count => format!("{count} panels"),
    };
    let more = if stale { "; drawing …" } else { "" };
    format!("{panels}, {width} x {height} pixels{more}")
}

/// Points as whole device pixels.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "clamped to the longest side of a frame"
)]
fn device_size(points: Vec2, scale: f32) -> [u32; 2] {
    [points.x, points.y].map(|side| (side * scale).clamp(1.0, 65536.0) as u32)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn problems_are_told_in_words_of_the_window() {
        for (problem, told) in [
            (
                "--sample-rate 1: not with this pattern",
                "sample rate 1: not with this pattern",
            ),
            ("an inset has no room", "an inset has no room"),
        ] {
            assert_eq!(without_dashes(problem), told);
        }
    }
}
