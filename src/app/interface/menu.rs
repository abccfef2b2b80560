//! The menu: every command of the table under its heading, with its keys, for hands that know none of them.
//!
//! Settings stand as lists of their values, and below these what steps through them. A command that needs an argument asks
//! for it in the palette.

use egui::containers::menu::{MenuButton, MenuConfig};
use egui::{Button, PopupCloseBehavior, RectAlign, RichText, ScrollArea, Tooltip, Ui};

use super::controls::tip_beside;
use super::{focus, look, standing};
use crate::plain;
use crate::viewer::{
    Action, Argument, Command, CommandSpec, Group, PictureSetting, SceneCommand, Viewer, WindowCommand, commands,
};

/// Least width of a list, in points, so that names and keys stay apart.
const WIDTH: f32 = 150.0;
/// Points of the window's height that a list leaves free.
const FREE: f32 = 40.0;
/// Points of a list's height that are its frame.
const FRAME: f32 = 20.0;
/// The commands that stand below the headings, too: what a newcomer looks for.
const FIRST_HELP: [&str; 2] = ["help", "palette"];

/// The button. Returns the command whose argument is to be asked for.
pub(super) fn show(ui: &mut Ui, viewer: &Viewer, commands: &mut Vec<Command>) -> Option<&'static CommandSpec> {
    let mut asks = None;
    // A click between two lines closes nothing; lines close it themselves.
    let config = MenuConfig::new().close_behavior(PopupCloseBehavior::CloseOnClickOutside);
    let button = MenuButton::from_button(Button::new("Menu").small()).config(config);
    let (response, _) = button.ui(ui, |ui| {
        list(ui, f32::INFINITY, |ui| {
            for group in Group::ALL {
                ui.menu_button(group.name(), |ui| {
                    asks = list(ui, f32::INFINITY, |ui| of_group(ui, viewer, group, commands)).or(asks.take());
                });
            }
            ui.separator();
            for spec in FIRST_HELP.into_iter().filter_map(commands::find) {
                entry(ui, viewer, spec, commands);
            }
        });
    });
    focus::note_opener(&response.accessible_name("Menu"));
    asks
}

/// What may be longer than the window is high, or than `most`.
fn list<R>(ui: &mut Ui, most: f32, contents: impl FnOnce(&mut Ui) -> R) -> R {
    ui.set_min_width(WIDTH);
    look::bars_beside(ui);
    let height = (ui.ctx().content_rect().height() - FREE).min(most);
    let area = ScrollArea::vertical().max_height(height).min_scrolled_height(height);
    area.show(ui, contents).inner
}

/// How high a list may be that opens beside the next line: as high as there is room from this line up or down. A higher one
/// would fit on neither side, and lie over the line.
fn beside_next(ui: &Ui) -> f32 {
    let (line, window) = (ui.available_rect_before_wrap(), ui.ctx().content_rect());
    let down = window.bottom() - line.top();
    let up = line.top() + ui.spacing().interact_size.y - window.top();
    down.max(up) - FRAME
}

/// The lines under a heading. Returns the command whose argument is to be asked for.
fn of_group(ui: &mut Ui, viewer: &Viewer, group: Group, commands: &mut Vec<Command>) -> Option<&'static CommandSpec> {
    let mut asks = None;
    let specs: Vec<&'static CommandSpec> = commands::all().iter().filter(|spec| spec.group == group).collect();
    for lines in specs.chunk_by(|a, b| setting_of(a).is_some() && setting_of(a) == setting_of(b)) {
        let setting = lines.first().copied().and_then(setting_of);
        let mut lines_of = |ui: &mut Ui| {
            for spec in lines {
                if entry(ui, viewer, spec, commands) {
                    asks = Some(*spec);
                }
                if spec.id == "open" {
                    recent(ui, viewer, commands);
                }
            }
        };
        let Some(setting) = setting else {
            lines_of(ui);
            continue;
        };
        let mut chosen = None;
        let most = beside_next(ui);
        ui.menu_button(capitalized(setting.label), |ui| {
            list(ui, most, |ui| {
                chosen = values(ui, viewer, setting);
                lines_of(ui);
            });
        });
        commands.extend(chosen);
    }
    asks
}

/// What was opened before, if anything was.
fn recent(ui: &mut Ui, viewer: &Viewer, commands: &mut Vec<Command>) {
    if viewer.scene_list().opened().is_empty() {
        return;
    }
    let most = beside_next(ui);
    ui.menu_button("Open again", |ui| {
        list(ui, most, |ui| {
            for path in viewer.scene_list().opened() {
                let name = path.file_name().unwrap_or(path.as_os_str()).to_string_lossy();
                let button = ui.button(plain::line(&name));
                if button.on_hover_text(plain::line(&path.display().to_string())).clicked() {
                    ui.close();
                    commands.push(Command::Scenes(SceneCommand::Open(vec![path.clone()])));
                }
            }
        });
    });
}

/// The setting that a command is about.
fn setting_of(spec: &CommandSpec) -> Option<&'static PictureSetting> {
    match (spec.action, spec.argument) {
        (Action::Step(setting, _), _) | (_, Some(Argument::Value(setting))) => Some(setting),
        _ => None,
    }
}

/// The values that can be listed; what was chosen.
fn values(ui: &mut Ui, viewer: &Viewer, setting: &'static PictureSetting) -> Option<Command> {
    let now = setting.value(viewer.settings());
    let mut chosen = None;
    let offered = setting.offered(viewer.settings());
    for value in &offered {
        let short = setting.short(value);
        let response = ui.selectable_label(*value == now, short);
        let response = response.accessible_name(format!("{}: {short}", setting.label));
        if let Some(note) = setting.note(value) {
            tip_beside(Tooltip::for_enabled(&response), RectAlign::RIGHT_START, note.tip());
        }
        if response.clicked() {
            chosen = setting.to(value).ok().map(Command::Set);
            ui.close();
        }
    }
    if !offered.is_empty() {
        ui.separator();
    }
    chosen
}

/// A command with its keys, marked while what it switches is on. True if it was chosen and needs an argument first; commands
/// that only keys or scripts can give have no line.
fn entry(ui: &mut Ui, viewer: &Viewer, spec: &'static CommandSpec, commands: &mut Vec<Command>) -> bool {
    let command = spec.command();
    if command == Some(Command::Window(WindowCommand::Escape)) || (command.is_none() && spec.argument.is_none()) {
        return false;
    }
    let dots = if command.is_none() { " \u{2026}" } else { "" };
    let standing = match &command {
        Some(command) => standing::of(viewer, command),
        None => standing::of_asking(viewer, spec),
    };
    let keys = RichText::new(spec.keys_text());
    // Weak letters cannot be read on a marked line.
    let keys = if standing.is_on {
        keys.color(ui.visuals().selection.stroke.color)
    } else {
        keys
    };
    let button = Button::new(format!("{}{dots}", spec.name)).shortcut_text(keys);
    let button = if standing.is_on { button.selected(true) } else { button };
    let response = ui
        .add_enabled(standing.idle.is_none(), button)
        .accessible_name(spec.name);
    match standing.idle {
        Some(why) => tip_beside(
            Tooltip::for_disabled(&response),
            RectAlign::RIGHT_START,
            format!("{}. {why}.", spec.help),
        ),
        None => tip_beside(Tooltip::for_enabled(&response), RectAlign::RIGHT_START, spec.help),
    }
    if !response.clicked() {
        return false;
    }
    ui.close();
    let asks = command.is_none();
    commands.extend(command);
    asks
}

/// With a capital at the start, as names in menus have it.
pub(super) fn capitalized(label: &str) -> String {
    let mut letters = label.chars();
    let first = letters.next().map(|letter| letter.to_uppercase().to_string());
    first.unwrap_or_default() + letters.as_str()
}
