//! The status line: the pixel under the pointer, where it lies, its colour; and what the window shows.

use egui::{Align, Color32, CornerRadius, FontId, Layout, Sense, Stroke, StrokeKind, Ui, vec2};

use super::controls::tip;
use super::menu;
use crate::scene::Scene;
use crate::viewer::picture::{About, changed_words, reads_textures};
use crate::viewer::{
    Arrangement, Command, CommandSpec, InspectorCommand, SceneEntry, Settings, Status, Toggle, Viewer, WindowCommand,
};

/// Height of the line's contents, in points.
const HEIGHT: f32 = 18.0;

/// Fills the line. Where there is little room the menu and the switch of the panel stay, then the pixel; the rest gives way.
/// Returns the command of the menu whose argument is to be asked for.
/// `shown_at` is at how many percent the desktop shows the window, where it scales that by itself.
pub(super) fn show(
    ui: &mut Ui,
    viewer: &Viewer,
    shown_at: Option<u32>,
    commands: &mut Vec<Command>,
) -> Option<&'static CommandSpec> {
    ui.set_height(HEIGHT);
    ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
        ui.spacing_mut().item_spacing.x = 6.0;
        panel_switch(ui, viewer, commands);
        close_of_inspector(ui, viewer, commands);
        ui.with_layout(Layout::left_to_right(Align::Center), |ui| {
            ui.shrink_clip_rect(ui.max_rect());
            let asks = menu::show(ui, viewer, commands);
            ui.add_space(4.0);
            match viewer.pixels().status() {
                Some(status) => pixel(ui, viewer, &status),
                None => word(ui, what_to_do(viewer), FontId::proportional(13.0), true),
            }
            ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
                if let Some(percent) = shown_at {
                    scaled_by_desktop(ui, percent);
                }
                picture(ui, viewer);
            });
            asks
        })
        .inner
    })
    .inner
}

/// What is said while no pixel is pointed at.
fn what_to_do(viewer: &Viewer) -> &'static str {
    if viewer.scene_list().current().is_none_or(SceneEntry::has_no_picture) {
        "? shows all keys"
    } else {
        "point at a pixel; right click explains it, ? shows all keys"
    }
}

/// A word, unless there is no room for all of it.
fn word(ui: &mut Ui, text: &str, font: FontId, weak: bool) {
    let color = if weak {
        ui.visuals().weak_text_color()
    } else {
        ui.visuals().text_color()
    };
    let galley = ui.painter().layout_no_wrap(text.to_owned(), font, color);
    if galley.size().x <= ui.available_width() {
        ui.label(galley);
    }
}

/// Folds the side panel, or brings it back.
fn panel_switch(ui: &mut Ui, viewer: &Viewer, commands: &mut Vec<Command>) {
    let button = egui::Button::selectable(viewer.chrome().panel(), "Panel")
        .frame_when_inactive(true)
        .small();
    if ui
        .add(button)
        .on_hover_text(tip("panel"))
        .accessible_name("Side panel")
        .clicked()
    {
        commands.push(Command::Window(WindowCommand::Panel(Toggle::Flip)));
    }
    ui.add_space(4.0);
}

/// Closes an inspector that follows the pointer: its inset gives way to whoever wants to click there.
fn close_of_inspector(ui: &mut Ui, viewer: &Viewer, commands: &mut Vec<Command>) {
    if !viewer.inspector().magnifier().open || viewer.pixels().pinned().is_some() {
        return;
    }
    let button = ui.add(egui::Button::new("Inspector  \u{d7}").small());
    let button = button.on_hover_text(tip("inspector"));
    if button.accessible_name("Close the pixel inspector").clicked() {
        commands.push(Command::Inspector(InspectorCommand::Show(Toggle::Off)));
    }
    ui.add_space(4.0);
}

fn pixel(ui: &mut Ui, viewer: &Viewer, status: &Status) {
    let [x, y] = status.pixel;
    let pinned = viewer.pixels().pinned() == Some(status.pixel);
    field(ui, if pinned { "pinned" } else { "pixel" }, &format!("{x}, {y}"));
    if let Some(([r, g, b, _], (decimal, hex))) = status.rgba.zip(status.decimal_text().zip(status.hex_text())) {
        let (swatch, response) = ui.allocate_exact_size(vec2(14.0, 14.0), Sense::hover());
        let line = Stroke::new(1.0, ui.visuals().widgets.noninteractive.fg_stroke.color);
        ui.painter()
            .rect_filled(swatch, CornerRadius::same(3), Color32::from_rgb(r, g, b));
        ui.painter()
            .rect_stroke(swatch, CornerRadius::same(3), line, StrokeKind::Inside);
        response.accessible_name(format!("Colour {hex}"));
        word(ui, &decimal, numbers(), false);
        match viewer
            .pixels()
            .other_status_of(status.pixel)
            .and_then(|other| other.decimal_text())
        {
            Some(other) => field(ui, "B", &other),
            None => word(ui, &hex, numbers(), false),
        }
        ui.add_space(4.0);
    } else if viewer.frames().preview().is_some() {
        // No number comes from a pixel that is not final.
        word(ui, "…", numbers(), true);
        ui.add_space(4.0);
    }
    field(ui, "canvas", &status.user_text());
}

/// A value with its name before it, both or none.
fn field(ui: &mut Ui, name: &str, value: &str) {
    let (weak, plain) = (ui.visuals().weak_text_color(), ui.visuals().text_color());
    let name = ui
        .painter()
        .layout_no_wrap(name.to_owned(), FontId::proportional(11.0), weak);
    let value = ui.painter().layout_no_wrap(value.to_owned(), numbers(), plain);
    if name.size().x + value.size().x + 6.0 <= ui.available_width() {
        ui.label(name);
        ui.label(value);
        ui.add_space(4.0);
    }
}

/// Warns that pixels on the screen are not those that were drawn.
fn scaled_by_desktop(ui: &mut Ui, percent: u32) {
    let text = format!("shown at {percent} % by the desktop");
    let text = egui::RichText::new(text).size(11.0).color(ui.visuals().warn_fg_color);
    ui.label(text).on_hover_text(
        "The desktop scales the window by itself, so that pixels on the screen are mixtures of those that were drawn. Set its \
         scale to 100 % or 200 % to see them as they are; saved pictures are not scaled.",
    );
    ui.add_space(4.0);
}

/// Size, scale and settings in few words, as far as there is room.
fn picture(ui: &mut Ui, viewer: &Viewer) {
    let [width, height] = viewer.both().layout().frame_size();
    if let Some(text) = viewer.frames().preview_text() {
        ui.label(egui::RichText::new(text).size(11.0).color(ui.visuals().warn_fg_color));
        ui.add_space(4.0);
    }
    // First, so that it is the last to give way: the other reading is another picture.
    let mut words: Vec<String> = viewer.scene_list().reading_words().into_iter().collect();
    words.extend(viewer.ab().preview_text().map(|text| format!("B: {text}")));
    words.push(format!("{width}×{height}"));
    if let Some(numbers) = viewer.both().view_numbers() {
        words.push(format!("{} px/unit", short(numbers.scale)));
    }
    if fills_window_with_b(viewer) {
        words.push("B".to_owned());
    }
    if let Some(settings) = settings_in_window(viewer) {
        words.extend(settings_words(&settings, viewer.scene_list().scene()));
    }
    for word in words {
        let font = FontId::proportional(11.0);
        let color = ui.visuals().weak_text_color();
        let galley = ui.painter().layout_no_wrap(word, font, color);
        if galley.size().x + 16.0 > ui.available_width() {
            return;
        }
        ui.label(galley);
        ui.add_space(4.0);
    }
}

/// How the picture of this scene in the window is sampled.
fn settings_words(settings: &Settings, scene: Option<&Scene>) -> Vec<String> {
    let render = &settings.render;
    let mut words = Vec::new();
    // Areas have no samples.
    if !render.covers_areas() {
        words.push(format!("{}×", render.sample_rate.samples()));
    }
    words.extend(changed_words(settings, About::Samples, scene));
    if reads_textures(scene) {
        words.push(format!(
            "{} / {}",
            render.pixel_sampling.name(),
            render.level_sampling.name()
        ));
    }
    words.extend(changed_words(settings, About::Textures, scene));
    words
}

/// Whether B is what the window shows, and nothing of A.
fn fills_window_with_b(viewer: &Viewer) -> bool {
    let ab = viewer.ab();
    let is_whole = matches!(ab.arrangement(), Arrangement::Alone | Arrangement::Flip);
    is_whole && ab.other().is_some() && ab.shows_b()
}

/// The settings of the picture that fills the window; those of A where both share it, and none of a picture from outside.
fn settings_in_window(viewer: &Viewer) -> Option<Settings> {
    let own = viewer.settings();
    if !fills_window_with_b(viewer) {
        return Some(*own);
    }
    let render = viewer.ab().other_settings(own)?;
    Some(Settings { render, ..*own })
}

fn numbers() -> FontId {
    FontId::monospace(12.0)
}

/// A number with about four digits.
pub(super) fn short(value: f64) -> String {
    match value {
        v if (0.01..10.0).contains(&v) => format!("{v:.3}"),
        v if (10.0..10_000.0).contains(&v) => format!("{v:.1}"),
        v => format!("{v:.2e}"),
    }
}
