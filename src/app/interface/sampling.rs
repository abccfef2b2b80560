//! The settings of the picture, a control for each row of their table; pixel zoom and progressive drawing.

use egui::{Color32, DragValue, Layout, RichText, Ui, vec2};

use super::controls::{Offered, at_end, choice, choice_of, command_button, drop_down, finite, gave_up, row, tip};
use super::look::CONTROL;
use crate::scene::Dialect;
use crate::viewer::picture::{self, About, Control, PanelRow};
use crate::viewer::{
    Command, Dialog, PictureSetting, PixelZoom, SceneEntry, Settings, Toggle, ValueNote, ViewCommand, Viewer,
    WindowCommand,
};

/// Levels per point of dragging.
const SPEED: f64 = 0.02;
/// The opacity of a control without effect.
const PALE: f32 = 0.55;
/// Half a step: how far below the smallest number [`Control::Number`]'s `none` stands, so that dragging to the left reaches it.
const BELOW: f64 = 0.5;

/// Shows the settings and adds what was changed to `commands`.
pub(super) fn show(ui: &mut Ui, viewer: &Viewer, commands: &mut Vec<Command>) {
    let (document, sampling): (Vec<_>, Vec<_>) = picture::all().partition(|setting| setting.about == About::Document);
    ui.add_space(2.0);
    ui.horizontal(|ui| {
        // Whichever of both is to be seen: the controls are those of A.
        let title = if viewer.ab().other().is_some() {
            "Sampling of A"
        } else {
            "Sampling"
        };
        ui.label(RichText::new(title).strong().size(12.0));
        at_end(ui, &["Defaults", "Points"], |ui| {
            let changed = !picture::are_defaults(viewer.settings());
            let defaults = ui.add_enabled_ui(changed, |ui| command_button(ui, "default-settings", "Defaults"));
            if defaults.inner.clicked() {
                commands.push(Command::SetDefaults);
            }
            if command_button(ui, "pattern-view", "Points").clicked() {
                commands.push(Command::Window(WindowCommand::ToggleDialog(Dialog::Pattern)));
            }
        });
    });
    rows(ui, &sampling, viewer, commands);
    rows(ui, &document, viewer, commands);
    reading(ui, viewer, commands);
}

/// Settings below each other; those without a label stand beside the one before them.
pub(super) fn rows(ui: &mut Ui, settings: &[&'static PictureSetting], viewer: &Viewer, commands: &mut Vec<Command>) {
    let now = viewer.settings();
    let scene = viewer.scene_list().scene();
    let shown = settings.iter().filter_map(|setting| {
        Some(ShownSetting {
            setting,
            panel: setting.panel.as_ref()?,
            idle: setting.idle(now, scene),
        })
    });
    let shown: Vec<ShownSetting> = shown.collect();
    for group in shown.chunk_by(|_, next| next.panel.label.is_empty()) {
        let [first, ..] = group else { continue };
        if let Control::WideButtons(across) = first.panel.control {
            ui.label(RichText::new(first.panel.label).weak());
            for values in first.setting.offered(now).chunks(across) {
                weakened(ui, *first, |ui| buttons(ui, *first, values, now, commands));
            }
            continue;
        }
        row(ui, first.panel.label, |ui| {
            let gaps = (group.len() - 1) as f32 * 4.0;
            let parts: f32 = group.iter().map(|shown| shown.panel.control.part()).sum();
            let width = (ui.available_width() - gaps) / parts;
            for shown in group {
                let width = width * shown.panel.control.part();
                weakened(ui, *shown, |ui| control(ui, *shown, now, width, commands));
            }
        });
    }
}

/// A control, pale where it makes no difference.
fn weakened(ui: &mut Ui, shown: ShownSetting, control: impl FnOnce(&mut Ui)) {
    let (opacity, letters) = (ui.opacity(), ui.visuals().selection.stroke.color);
    if shown.idle.is_some() {
        ui.multiply_opacity(PALE);
        ui.visuals_mut().selection.stroke.color = pale_letters(ui.visuals().dark_mode, letters);
    }
    control(ui);
    ui.set_opacity(opacity);
    ui.visuals_mut().selection.stroke.color = letters;
}

/// The letters of a chosen value that is pale: over a light panel its ground becomes light, too, and white ones could not be read.
fn pale_letters(is_dark: bool, letters: Color32) -> Color32 {
    if is_dark { letters } else { Color32::BLACK }
}

/// A setting, and how the panel shows it.
#[derive(Clone, Copy)]
struct ShownSetting {
    setting: &'static PictureSetting,
    panel: &'static PanelRow,
    /// Why it makes no difference now. It can be set all the same: what takes its effect away may be changed next.
    idle: Option<&'static str>,
}

impl ShownSetting {
    /// What the tool tip of the command says that sets and steps the setting; where there is none, those that step it both
    /// ways. After that, why it makes no difference.
    fn tip(self) -> String {
        let mut commands = self.setting.commands.iter();
        let tip_of_steps = || {
            let steps = self.setting.commands.iter().filter(|command| command.step.is_some());
            steps.map(|command| tip(command.id)).collect::<Vec<_>>().join("; ")
        };
        let both = commands.find(|command| command.takes_value && command.step.is_some());
        self.with_idle(both.map_or_else(tip_of_steps, |command| tip(command.id)))
    }

    /// A tool tip, and why the setting makes no difference.
    fn with_idle(self, tip: String) -> String {
        match self.idle {
            Some(why) => format!("{tip}\nNo effect now: {why}."),
            None => tip,
        }
    }
}

fn control(ui: &mut Ui, shown: ShownSetting, now: &Settings, width: f32, commands: &mut Vec<Command>) {
    let ShownSetting { setting, panel, .. } = shown;
    match panel.control {
        Control::Buttons | Control::WideButtons(_) => {
            ui.allocate_ui(vec2(width, CONTROL.y), |ui| {
                buttons(ui, shown, &setting.offered(now), now, commands);
            });
        }
        Control::List | Control::ShortList => {
            let current = setting.value(now);
            let offered = setting.offered(now);
            let values = offered.iter().map(|value| Offered {
                value: value.as_str(),
                text: setting.short(value),
                tip: setting.note(value).map_or_else(String::new, ValueNote::tip),
            });
            let values: Vec<Offered<'_, &str>> = values.collect();
            let list = ui.scope(|ui| {
                ui.set_max_width(width);
                let tip = format!("{}\n{}", chooses(panel.name), shown.tip());
                drop_down(ui, panel.name, &tip, current.as_str(), &values)
            });
            let chosen = list.inner;
            commands.extend(chosen.and_then(|value| setting.to(value).ok()).map(Command::Set));
        }
        Control::Number {
            range,
            digits,
            prefix,
            none,
        } => {
            let number = Number {
                range,
                digits,
                prefix,
                none,
            };
            let chosen = number.show(ui, shown, now, width);
            commands.extend(chosen.and_then(|value| setting.to(&value).ok()).map(Command::Set));
        }
    }
}

/// What a list does that is called so: the words for settings beside their values are no sentence by themselves.
fn chooses(name: &str) -> String {
    let mut letters = name.chars();
    let first: String = letters.next().into_iter().flat_map(char::to_lowercase).collect();
    format!("Chooses the {first}{}", letters.as_str())
}

/// A button for each of these values.
fn buttons(ui: &mut Ui, shown: ShownSetting, values: &[String], now: &Settings, commands: &mut Vec<Command>) {
    let ShownSetting { setting, panel, .. } = shown;
    let current = setting.value(now);
    let values: Vec<(&str, String)> = values.iter().map(|value| (value.as_str(), value.clone())).collect();
    let tip = |value: &str| match setting.note(value) {
        Some(note) => shown.with_idle(note.tip()),
        None => format!("Sets the {} to {value}\n{}", setting.label, shown.tip()),
    };
    let chosen = choice_of(ui, panel.name, &tip, current.as_str(), &values);
    commands.extend(chosen.and_then(|value| setting.to(value).ok()).map(Command::Set));
}

/// A number to drag or to type.
struct Number {
    range: [f64; 2],
    digits: u8,
    prefix: &'static str,
    none: Option<&'static str>,
}

impl Number {
    /// The new value, if there is one.
    fn show(&self, ui: &mut Ui, shown: ShownSetting, now: &Settings, width: f32) -> Option<String> {
        let ShownSetting { setting, panel, .. } = shown;
        let name = panel.name;
        let Self {
            range,
            digits,
            prefix,
            none,
        } = *self;
        let power = 10.0_f64.powi(digits.into());
        let least = if none.is_some() { range[0] - BELOW } else { range[0] };
        let before = setting.value(now).parse().unwrap_or(least);
        let mut number = before;
        let signed = setting.signed;
        let field = DragValue::new(&mut number)
            .range(least..=range[1])
            .speed(SPEED * 100.0 / power)
            .max_decimals(digits.into())
            .prefix(prefix)
            .custom_formatter(move |number, _| {
                let rounded = (number * power).round() / power;
                match none {
                    Some(none) if number < range[0] => none.to_owned(),
                    _ if signed => format!("{rounded:+}"),
                    _ => rounded.to_string(),
                }
            })
            .custom_parser(move |text| {
                let text = text.trim().trim_start_matches(prefix.trim()).trim();
                match none {
                    Some(none) if text.is_empty() || text == none => Some(least),
                    _ => finite(text),
                }
            });
        let is_taken = sized(ui, width, field, name, &shown.with_idle(number_tip(setting)));
        number = if digits == 0 { number.round() } else { number };
        #[expect(clippy::float_cmp, reason = "a number that nobody touched is the same one")]
        let is_new = is_taken && number != before;
        is_new.then(|| match none {
            Some(none) if number < range[0] => none.to_owned(),
            _ => number.to_string(),
        })
    }
}

/// What the command says that takes the number.
fn number_tip(setting: &PictureSetting) -> String {
    let taking = setting.commands.iter().find(|command| command.takes_value);
    taking.map_or(String::new(), |command| tip(command.id))
}

/// A number's field of this width; whether the number that it leaves counts.
fn sized(ui: &mut Ui, width: f32, field: DragValue<'_>, name: &str, tip: &str) -> bool {
    let layout = Layout::centered_and_justified(ui.layout().main_dir());
    let shown = ui.allocate_ui_with_layout(vec2(width, CONTROL.y), layout, |ui| {
        let tip = format!("{tip}\ndrag, or click and type");
        let response = ui.add(field.clip_text(true).update_while_editing(false));
        let is_taken = !gave_up(ui, &response);
        response.on_hover_text(tip).accessible_name(name);
        is_taken
    });
    shown.inner
}

/// How scenes are read and shown, whatever the sampling.
fn reading(ui: &mut Ui, viewer: &Viewer, commands: &mut Vec<Command>) {
    let settings = viewer.settings();
    // For every choice, so that what is below stays under the pointer.
    row(ui, "", |ui| {
        ui.label(RichText::new(dialect_in_force(viewer)).weak().small())
    });
    row(ui, "Pixel zoom", |ui| {
        let values = PixelZoom::ALL.map(|value| (value, value.factor().to_string()));
        let chosen = choice(ui, "Pixel zoom", &tip("pixel-zoom"), settings.pixel_zoom, &values);
        commands.extend(chosen.map(ViewCommand::SetPixelZoom).map(Command::View));
    });
    row(ui, "Progressive", |ui| {
        let mut on = settings.progressive;
        let response = ui.checkbox(&mut on, "coarse first, then fine");
        let response = response.on_hover_text(tip("progressive"));
        if response.accessible_name("Progressive drawing").changed() {
            commands.push(Command::View(ViewCommand::Progressive(if on {
                Toggle::On
            } else {
                Toggle::Off
            })));
        }
    });
}

/// In which dialect the current scene was read.
fn dialect_in_force(viewer: &Viewer) -> &'static str {
    let entry = viewer.scene_list().current();
    match entry.and_then(|entry| entry.scene()).map(|scene| scene.dialect) {
        Some(Dialect::Course) => "read as course",
        Some(Dialect::Svg) => "read as svg",
        None if entry.is_some_and(SceneEntry::is_reading) => "reading …",
        None => "not read",
    }
}

#[cfg(test)]
mod tests {
    use super::super::look;
    use super::*;
    use crate::viewer::Theme;

    /// The luminance of a colour (WCAG 2.2).
    fn luminance(color: Color32) -> f32 {
        let linear = |byte: u8| match f32::from(byte) / 255.0 {
            part if part <= 0.04045 => part / 12.92,
            part => ((part + 0.055) / 1.055).powf(2.4),
        };
        0.2126 * linear(color.r()) + 0.7152 * linear(color.g()) + 0.0722 * linear(color.b())
    }

    #[test]
    fn pale_values_can_be_read() {
        for theme in [Theme::Dark, Theme::Light] {
            for presenter in [false, true] {
                let ctx = egui::Context::default();
                look::set_look(&ctx, (theme, presenter));
                let style = ctx.style_of(match theme {
                    Theme::Dark => egui::Theme::Dark,
                    Theme::Light => egui::Theme::Light,
                });
                let visuals = &style.visuals;
                let letters = pale_letters(visuals.dark_mode, visuals.selection.stroke.color);
                let ground = visuals.panel_fill.lerp_to_gamma(visuals.selection.bg_fill, PALE);
                let letters = ground.lerp_to_gamma(letters, PALE);
                let [dark, light] = [luminance(ground), luminance(letters)];
                let contrast = (dark.max(light) + 0.05) / (dark.min(light) + 0.05);
                assert!(
                    contrast >= 3.0,
                    "{contrast} to 1, {theme:?}, presenter look {presenter}"
                );
            }
        }
    }

    #[test]
    fn rows_have_the_names_of_menus() {
        for option in ["visualise", "lod-bias", "rules", "dialect", "anisotropy"] {
            let setting = picture::all()
                .find(|setting| setting.option == option)
                .expect("a setting");
            let row = setting.panel.as_ref().map(|panel| panel.label.to_owned());
            assert_eq!(row, Some(super::super::menu::capitalized(setting.label)), "{option}");
        }
    }

    #[test]
    fn tips_of_lists_are_sentences() {
        assert_eq!(chooses("Visualisation"), "Chooses the visualisation");
        for setting in picture::all() {
            let panel = setting.panel.as_ref();
            let list = panel.filter(|panel| matches!(panel.control, Control::List | Control::ShortList));
            let Some(panel) = list else { continue };
            let is_noun = panel.name.starts_with(char::is_uppercase) && panel.name.len() > 4;
            assert!(is_noun, "Chooses the {}", panel.name);
        }
    }
}
