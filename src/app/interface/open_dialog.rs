//! The dialog that opens files: a list of a folder, a line to type into, and buttons to other folders.

use std::path::{Path, PathBuf};

use egui::{Align, Button, Context, Label, Layout, RichText, Ui, vec2};

use super::chooser::{HOME, Item, Typed};
use super::dialogs::{Dialogs, ListShown, arrows, list_of, step};
use super::look::CONTROL;
use super::modal::{beside, modal};
use super::palette::{BETWEEN_ENTRIES, ENTRY};
use crate::viewer::{Command, SceneCommand, WindowCommand, commands};

/// Height of what the dialog has besides its list, in points.
const REST: f32 = 130.0;
/// Lines of the list that are to be seen at most.
const MOST_ROWS: f32 = 14.0;
/// The same where pictures to compare with are listed.
const FEW_ROWS: f32 = 9.0;
/// What the button to the folder above does.
const UP: &str = "The folder that this one is in";
/// Where all buttons below the list have room in one row, in points.
const BOTH_SIDES: f32 = 310.0;
/// Its width at most, in points.
const WIDTH: f32 = 480.0;

impl Dialogs {
    /// Chooses a file to open: by the mouse, by the arrows, or by typing what its name holds or its whole path.
    pub(super) fn choose(&mut self, ctx: &Context, just_opened: bool, commands: &mut Vec<Command>) {
        let (up, down) = arrows(ctx);
        let screen = ctx.content_rect();
        let modal = modal("open").show(ctx, |ui| {
            ui.set_width((screen.width() - 60.0).min(WIDTH));
            ui.heading("Open");
            let shown = self.folder_shown();
            ui.add(Label::new(RichText::new(shown.display().to_string()).weak().small()).truncate());
            let hint = "part of a name, or a path";
            let enter = self.line(ui, "File", hint, just_opened);
            self.problem_line(ui);
            let Listed { folder, found, chosen } = self.listed([up, down]);
            if folder != shown {
                // The text became another one in this pass.
                ctx.request_repaint();
            }
            let mut taken = chosen.filter(|_| enter).and_then(|index| found.get(index));
            ui.scope(|ui| {
                let row = ENTRY + BETWEEN_ENTRIES;
                let rows = ((screen.height() * 0.8 - REST) / row).floor().clamp(1.0, MOST_ROWS);
                let height = rows * row - BETWEEN_ENTRIES;
                // As high for every folder: the buttons stay under the pointer.
                ui.set_min_height(height);
                let list = ListShown {
                    chosen: chosen.unwrap_or(usize::MAX),
                    moves: up || down,
                    height,
                };
                list_of(ui, &found, list, |ui, item, chosen| item.show(ui, chosen))
                    .inspect(|index| taken = found.get(*index));
                if let Some(problem) = self.chooser.problem() {
                    ui.label(RichText::new(problem).color(ui.visuals().warn_fg_color));
                } else if found.is_empty() {
                    ui.label(RichText::new("nothing here that can be opened").weak());
                }
            });
            ui.add_space(4.0);
            let pressed = foot(ui, folder.parent().is_some());
            match (pressed, taken.map(|item| item.path.clone())) {
                (Some(Foot::Cancel), _) => return true,
                (Some(Foot::Up), _) => self.enter(folder.parent()),
                (Some(Foot::Home), _) => self.enter(std::env::home_dir().as_deref()),
                (Some(Foot::Folder), _) => open(&folder, commands),
                (None, Some(path)) if path.is_dir() => self.enter(Some(&path)),
                (None, Some(path)) => open(&path, commands),
                (None, None) if enter => self.go(commands),
                (None, None) => {}
            }
            false
        });
        if modal.inner || beside(&modal.backdrop_response) {
            commands.push(Command::Window(WindowCommand::CloseDialog));
        }
    }

    /// The pictures and folders of the folder that is listed, to compare with one of them; which was pressed, or which arrows had
    /// led to where Enter `takes` that.
    pub(super) fn pictures(&mut self, ui: &mut Ui, (up, down): (bool, bool), takes: bool) -> Option<PathBuf> {
        let folder = self.chooser.folder().to_owned();
        ui.horizontal(|ui| {
            let up = ui.add_enabled(
                folder.parent().is_some(),
                Button::new("Up").min_size(vec2(44.0, CONTROL.y)),
            );
            if up.on_hover_text(UP).clicked() {
                self.list(folder.parent());
            }
            ui.add(Label::new(RichText::new(folder.display().to_string()).weak().small()).truncate());
        });
        let found = self.chooser.pictures();
        if up || down {
            // The first press leads to the first.
            let picked = self.picked.map_or(0, |at| step(at, [up, down], found.len()));
            self.picked = (!found.is_empty()).then_some(picked);
        }
        let row = ENTRY + BETWEEN_ENTRIES;
        let rows = ((ui.ctx().content_rect().height() * 0.8 - REST) / row)
            .floor()
            .clamp(1.0, FEW_ROWS);
        let height = rows * row - BETWEEN_ENTRIES;
        let list = ListShown {
            chosen: self.picked.unwrap_or(usize::MAX),
            moves: up || down,
            height,
        };
        let pressed = ui
            .scope(|ui| {
                ui.set_min_height(height);
                let pressed = list_of(ui, &found, list, |ui, item, chosen| item.show(ui, chosen));
                if found.is_empty() {
                    ui.label(RichText::new("no pictures here").weak());
                }
                pressed
            })
            .inner;
        ui.add_space(4.0);
        let path = pressed
            .or_else(|| self.picked.filter(|_| takes))
            .and_then(|index| found.get(index))
            .map(|item| item.path.clone())?;
        if path.is_dir() {
            self.list(Some(&path));
            return None;
        }
        Some(path)
    }

    /// Lists another folder, and leaves what was typed.
    fn list(&mut self, folder: Option<&Path>) {
        if let Some(folder) = folder {
            self.chooser.go_to(folder);
            self.picked = None;
        }
    }

    /// Lists another folder.
    fn enter(&mut self, folder: Option<&Path>) {
        if let Some(folder) = folder {
            self.chooser.go_to(folder);
            (self.text, self.picked, self.problem) = (String::new(), None, None);
        }
    }

    /// The path that is being typed, if it is one and not a part of a name.
    fn typed(&self) -> Option<Typed> {
        let argument = commands::find("open").and_then(|spec| spec.argument);
        let text = is_path(&self.text).then(|| self.text.trim())?;
        match argument?.parse(text) {
            Ok(Command::Scenes(SceneCommand::Open(paths))) => Some(self.chooser.typed(text, paths.first()?)),
            _ => None,
        }
    }

    /// The folder whose files are listed: that of a path that is being typed, if there is such a one.
    fn folder_shown(&mut self) -> PathBuf {
        let at_typed = self.typed().and_then(|typed| self.chooser.shown_at(&typed));
        at_typed.map_or_else(|| self.chooser.folder().to_owned(), |(folder, _)| folder)
    }

    /// What is listed after these arrows, and what of it Enter opens: where no arrow chose it, what a typed path names, or the
    /// first whose name holds what was typed.
    fn listed(&mut self, turn: [bool; 2]) -> Listed {
        let typed = self.typed();
        let (folder, found) = match &typed {
            Some(typed) => self.chooser.shown_at(typed).unwrap_or_default(),
            None => (self.chooser.folder().to_owned(), self.chooser.shown(&self.text)),
        };
        let named = |typed: &Typed| found.iter().position(|item| item.path == typed.path);
        let meant = match &typed {
            // Enter opens it even where it is no line of the list.
            Some(typed) if typed.path.exists() => named(typed),
            _ => Some(0),
        };
        let chosen = match self.picked.or(meant) {
            Some(at) => Some(step(at, turn, found.len())),
            None => turn.contains(&true).then_some(0),
        };
        let chosen = chosen.filter(|_| !found.is_empty());
        if turn.contains(&true) {
            self.picked = chosen;
        }
        let folder = if folder.as_os_str().is_empty() {
            self.chooser.folder().to_owned()
        } else {
            folder
        };
        Listed { folder, found, chosen }
    }

    /// Opens the file of a typed path, or lists its folder.
    fn go(&mut self, commands: &mut Vec<Command>) {
        let Some(Typed { path, .. }) = self.typed() else { return };
        if path.is_dir() {
            self.enter(Some(&path));
        } else if path.exists() {
            open(&path, commands);
        } else {
            self.problem = Some("no such file; mend the path, or type a part of a name".to_owned());
        }
    }
}

/// Opens a file, or every scene in a folder.
fn open(path: &Path, commands: &mut Vec<Command>) {
    let open = Command::Scenes(SceneCommand::Open(vec![path.to_owned()]));
    commands.extend([Command::Window(WindowCommand::CloseDialog), open]);
}

/// Whether a text is meant to be a path, and not a part of a name.
fn is_path(text: &str) -> bool {
    text.starts_with(HOME) || text.contains(std::path::is_separator)
}

/// What the dialog lists.
#[derive(Debug)]
struct Listed {
    /// The folder that it is in, as far as there is one.
    folder: PathBuf,
    found: Vec<Item>,
    /// The line that Enter opens.
    chosen: Option<usize>,
}

/// The buttons below the list of files.
#[derive(Clone, Copy, Debug)]
enum Foot {
    Up,
    Home,
    Folder,
    Cancel,
}

/// Those buttons; which was pressed.
fn foot(ui: &mut Ui, has_parent: bool) -> Option<Foot> {
    if ui.available_width() < BOTH_SIDES {
        // Otherwise they would cover each other.
        let to_folders = ui.horizontal(|ui| other_folders(ui, has_parent)).inner;
        let rest = ui.horizontal(|ui| ui.with_layout(Layout::right_to_left(Align::Center), ends).inner);
        return to_folders.or(rest.inner);
    }
    ui.horizontal(|ui| {
        let to_folders = other_folders(ui, has_parent);
        let rest = ui.with_layout(Layout::right_to_left(Align::Center), ends).inner;
        to_folders.or(rest)
    })
    .inner
}

/// The buttons to other folders.
fn other_folders(ui: &mut Ui, has_parent: bool) -> Option<Foot> {
    let mut pressed = None;
    for (foot, text, tip) in [(Foot::Up, "Up", UP), (Foot::Home, "Home", "Your own folder")] {
        let enabled = has_parent || matches!(foot, Foot::Home);
        let button = ui.add_enabled(enabled, Button::new(text).min_size(vec2(44.0, CONTROL.y)));
        if button.on_hover_text(tip).clicked() {
            pressed = Some(foot);
        }
    }
    pressed
}

/// The buttons that end the dialog, the last first.
fn ends(ui: &mut Ui) -> Option<Foot> {
    let folder = ui.add(Button::new("Open this folder").min_size(CONTROL));
    if folder.on_hover_text("Opens every scene in it").clicked() {
        return Some(Foot::Folder);
    }
    let cancel = ui.add(Button::new("Cancel").min_size(vec2(64.0, CONTROL.y)));
    cancel.clicked().then_some(Foot::Cancel)
}
