//! What covers the picture until it is closed: help, the command palette, going to a pixel.

use egui::style::ScrollAnimation;
use egui::text::{CCursor, CCursorRange};
use egui::{
    Align, Align2, Area, Button, Context, Event, Id, Key, Label, Layout, Modal, Order, Rect, RichText, ScrollArea,
};
use egui::{TextEdit, Ui, vec2};

use super::chooser::Chooser;
use super::focus;
use super::look::{self, CONTROL};
use super::modal::{BACKDROP, beside, modal};
use super::palette::{self, BETWEEN_ENTRIES, Does, ENTRY};
use super::pattern::{self, PatternDialog};
use super::scenes::Thumbnails;
use super::sheet::SheetDialog;
use super::start;
use crate::viewer::commands::{self, GESTURES};
use crate::viewer::{AbCommand, Action, Against, Command, CommandSpec, Dialog, Group, Viewer, WindowCommand};

/// What was typed into the dialogs.
#[derive(Debug, Default)]
pub(super) struct Dialogs {
    open: Option<Dialog>,
    pub(super) text: String,
    pub(super) problem: Option<String>,
    pub(super) chosen: usize,
    /// The file that arrows lead to.
    pub(super) picked: Option<usize>,
    /// The path of a picture that was typed last: where it was wrong, it need not be typed again.
    path: String,
    /// The text was replaced: its line puts the caret behind it.
    caret_to_end: bool,
    sheet: SheetDialog,
    pattern: PatternDialog,
    /// The folder to open files from: it is listed where it was left.
    pub(super) chooser: Chooser,
    /// The pictures of the page of scenes.
    pub(super) thumbnails: Thumbnails,
    /// The command that the palette opens with, to ask for its argument.
    begins_with: Option<&'static CommandSpec>,
}

/// What the area of the page of scenes is called.
pub(super) const ALL_SCENES: &str = "all scenes";

/// What the palette's area is called.
const PALETTE: &str = "palette area";

/// A question for the argument of a command.
struct Question {
    title: &'static str,
    /// What is asked for.
    name: &'static str,
    /// Its form.
    hint: String,
    /// What is said while there is no answer.
    missing: &'static str,
    /// The word on the button.
    button: &'static str,
    /// The command that takes the answer.
    command: &'static str,
    /// Whether the answer is a path, which may be long.
    takes_path: bool,
    /// Whether the answer is a picture of the folder that is listed, too.
    lists_pictures: bool,
}

/// The titles of the dialogs that ask for something.
const GO_TO_PIXEL: &str = "Go to pixel";
const COMPARE_PICTURE: &str = "Compare with a picture";
const SAVE_AS: &str = "Save picture as";

/// Where the open dialog was in the last pass, in points.
pub(super) fn place(ctx: &Context, viewer: &Viewer) -> Option<Rect> {
    let name = match viewer.chrome().dialog()? {
        Dialog::Help => "help",
        Dialog::Palette => PALETTE,
        Dialog::Open => "open",
        Dialog::GoToPixel => GO_TO_PIXEL,
        Dialog::ComparePicture => COMPARE_PICTURE,
        Dialog::SaveAs => SAVE_AS,
        Dialog::Scenes => ALL_SCENES,
        Dialog::Sheet => "sheet",
        Dialog::Pattern => pattern::NAME,
    };
    ctx.memory(|memory| memory.area_rect(Id::unique(name)))
}

impl Dialogs {
    /// Opens the palette where it asks for the argument of a command.
    pub(super) fn ask_for(&mut self, spec: &'static CommandSpec, commands: &mut Vec<Command>) {
        self.begins_with = Some(spec);
        commands.push(Command::Window(WindowCommand::ToggleDialog(Dialog::Palette)));
    }

    /// Shows the dialog that is open. Returns the scenes whose thumbnails it misses.
    pub(super) fn show(&mut self, ctx: &Context, viewer: &Viewer, commands: &mut Vec<Command>) -> Vec<usize> {
        let just_opened = self.open != viewer.chrome().dialog();
        if just_opened {
            let begins_with = self.begins_with.take();
            let path = std::mem::take(&mut self.path);
            let is_path = viewer.chrome().dialog() == Some(Dialog::ComparePicture) && !path.is_empty();
            *self = Self {
                open: viewer.chrome().dialog(),
                text: if is_path { path.clone() } else { String::new() },
                caret_to_end: is_path,
                path,
                chooser: std::mem::take(&mut self.chooser),
                thumbnails: std::mem::take(&mut self.thumbnails),
                ..Self::default()
            };
            if let Some(spec) = begins_with.filter(|_| viewer.chrome().dialog() == Some(Dialog::Palette)) {
                self.go_on(spec);
            }
        }
        match viewer.chrome().dialog() {
            Some(Dialog::Help) => help(ctx, viewer, just_opened, commands),
            Some(Dialog::Open) => {
                if just_opened {
                    self.chooser.begin(viewer);
                }
                self.choose(ctx, just_opened, commands);
            }
            Some(Dialog::Palette) => self.palette(ctx, viewer, just_opened, commands),
            Some(asking @ (Dialog::GoToPixel | Dialog::ComparePicture | Dialog::SaveAs)) => {
                self.ask_what(asking, viewer, just_opened);
                let question = question(asking, viewer);
                self.ask(ctx, &question, just_opened, commands);
                if asking == Dialog::ComparePicture {
                    self.path.clone_from(&self.text);
                }
            }
            Some(Dialog::Scenes) => return self.gallery(ctx, viewer, just_opened, commands),
            Some(Dialog::Sheet) => self.sheet.show(ctx, viewer, commands),
            Some(Dialog::Pattern) => self.pattern.show(ctx, viewer, commands),
            None => {}
        }
        Vec::new()
    }

    /// Gets ready to ask for something.
    fn ask_what(&mut self, asking: Dialog, viewer: &Viewer, just_opened: bool) {
        if !just_opened {
            return;
        }
        match asking {
            Dialog::ComparePicture => self.chooser.begin(viewer),
            Dialog::SaveAs => {
                if let Some(path) = viewer.new_picture_path() {
                    self.text = path.display().to_string();
                    self.caret_to_end = true;
                }
            }
            _ => {}
        }
    }

    /// A line of text that has the keyboard from the start, until Tab takes it to a button; what is typed is the line's even then.
    /// True when Enter was pressed in it.
    pub(super) fn line(&mut self, ui: &mut Ui, name: &str, hint: &str, just_opened: bool) -> bool {
        let id = ui.unique_id().with(name);
        if std::mem::take(&mut self.caret_to_end) {
            let mut state = TextEdit::load_state(ui.ctx(), id).unwrap_or_default();
            let end = CCursor::new(self.text.chars().count());
            state.cursor.set_char_range(Some(CCursorRange::one(end)));
            state.store(ui.ctx(), id);
        }
        // Before the line takes in what was typed in this pass.
        if just_opened || focus::is_free(ui.ctx()) || types(ui.ctx()) {
            ui.memory_mut(|memory| memory.request_focus(id));
        }
        let response = ui
            .add(
                TextEdit::singleline(&mut self.text)
                    .id(id)
                    .hint_text(hint)
                    .desired_width(f32::INFINITY)
                    .margin(vec2(8.0, 6.0)),
            )
            .accessible_name(name);
        if response.changed() {
            self.problem = None;
            self.chosen = 0;
            self.picked = None;
        }
        // Enter takes the focus from the line; where a button has it, that is pressed.
        let enter = ui.input(|input| input.key_pressed(Key::Enter));
        enter && response.lost_focus() && focus::is_free(ui.ctx())
    }

    /// Asks for the argument of a command.
    fn ask(&mut self, ctx: &Context, question: &Question, just_opened: bool, commands: &mut Vec<Command>) {
        let turn = if question.lists_pictures {
            arrows(ctx)
        } else {
            (false, false)
        };
        let modal = modal(question.title).show(ctx, |ui| {
            let width = if question.takes_path { 420.0 } else { 300.0_f32 };
            ui.set_width(width.min(ctx.content_rect().width() - 40.0));
            ui.heading(question.title);
            let mut enter = self.line(ui, question.name, &question.hint, just_opened);
            self.problem_line(ui);
            if question.lists_pictures {
                let takes = enter && self.picked.is_some();
                enter &= !takes;
                if let Some(path) = self.pictures(ui, turn, takes) {
                    let compare = Command::Ab(AbCommand::Compare(Against::File(path)));
                    commands.extend([Command::Window(WindowCommand::CloseDialog), compare]);
                }
            }
            let is_empty = self.text.trim().is_empty();
            let pressed = buttons(ui, question.button, is_empty.then_some(question.missing));
            if enter && is_empty {
                self.problem = Some(question.missing.to_owned());
            } else if enter || pressed == Some(true) {
                self.run(commands::find(question.command), &self.text.clone(), commands);
            }
            pressed == Some(false)
        });
        if modal.inner || beside(&modal.backdrop_response) {
            commands.push(Command::Window(WindowCommand::CloseDialog));
        }
    }

    /// Runs a command with its argument and closes the dialog, or says what is wrong.
    fn run(&mut self, spec: Option<&'static CommandSpec>, argument: &str, commands: &mut Vec<Command>) {
        let Some(spec) = spec else {
            return;
        };
        if argument.trim().is_empty() {
            // Where values can follow, whoever chooses the command may want to name one.
            let asks = matches!(spec.action, Action::Step(..)) && spec.argument.is_some();
            match spec.command().filter(|_| !asks) {
                Some(command) => commands.extend([Command::Window(WindowCommand::CloseDialog), command]),
                None => self.go_on(spec),
            }
            return;
        }
        match spec.argument.map(|kind| kind.parse(argument)) {
            Some(Ok(command)) => commands.extend([Command::Window(WindowCommand::CloseDialog), command]),
            Some(Err(problem)) => self.problem = Some(problem),
            None => self.problem = Some(format!("{} takes nothing behind it", spec.id)),
        }
    }

    /// The palette goes on with the argument of a command.
    fn go_on(&mut self, spec: &CommandSpec) {
        self.text = format!("{} ", spec.id);
        self.caret_to_end = true;
        self.chosen = 0;
        self.problem = spec.argument.map(|argument| format!("type {}", argument.usage()));
    }

    pub(super) fn problem_line(&self, ui: &mut Ui) {
        if let Some(problem) = &self.problem {
            ui.label(RichText::new(problem).color(ui.visuals().warn_fg_color).small());
        }
    }

    fn palette(&mut self, ctx: &Context, viewer: &Viewer, just_opened: bool, commands: &mut Vec<Command>) {
        let (up, down) = arrows(ctx);
        let screen = ctx.content_rect();
        let area = Area::new(Id::unique(PALETTE))
            .order(Order::Foreground)
            .anchor(Align2::CENTER_TOP, vec2(0.0, (screen.height() * 0.08).round()))
            .fade_in(false);
        let modal = Modal::new(Id::unique("palette"))
            .area(area)
            .backdrop_color(BACKDROP)
            .show(ctx, |ui| {
                ui.set_width((screen.width() - 60.0).min(480.0));
                let hint = "type a command, a value or a scene";
                let enter = self.line(ui, "Command", hint, just_opened);
                self.problem_line(ui);
                let (argument, found) = palette::find(&self.text, viewer);
                self.chosen = step(self.chosen, [up, down], found.len());
                let mut run = found.get(self.chosen).filter(|_| enter);
                // It ends below a row, so that what is cut off is not taken for all.
                let row = ENTRY + BETWEEN_ENTRIES;
                let height = (screen.height() * 0.6 / row).floor().max(1.0) * row - BETWEEN_ENTRIES;
                let list = ListShown {
                    chosen: self.chosen,
                    moves: up || down,
                    height,
                };
                let pressed = list_of(ui, &found, list, |ui, entry, chosen| entry.show(ui, chosen));
                run = pressed.and_then(|index| found.get(index)).or(run);
                if found.is_empty() {
                    ui.label(RichText::new("nothing of that name").weak());
                }
                match run.map(|entry| &entry.does) {
                    Some(Does::Command(spec)) => self.run(Some(spec), &argument, commands),
                    Some(Does::Run(command)) => {
                        commands.extend([Command::Window(WindowCommand::CloseDialog), command.clone()]);
                    }
                    None => return,
                }
                ui.ctx().request_repaint();
            });
        if beside(&modal.backdrop_response) {
            commands.push(Command::Window(WindowCommand::CloseDialog));
        }
    }
}

/// What a dialog asks for.
fn question(asking: Dialog, viewer: &Viewer) -> Question {
    match asking {
        Dialog::ComparePicture => Question {
            title: COMPARE_PICTURE,
            name: "Path",
            hint: "path of a PNG or JPEG; or choose one below".to_owned(),
            missing: "type the path of a picture first, or choose one",
            button: "Compare",
            command: "against",
            takes_path: true,
            lists_pictures: true,
        },
        Dialog::SaveAs => Question {
            title: SAVE_AS,
            name: "File",
            hint: "path of a new PNG file".to_owned(),
            missing: "type the path of a new PNG file first",
            button: "Save",
            command: "save-as",
            takes_path: true,
            lists_pictures: false,
        },
        _ => {
            let [width, height] = viewer.both().layout().frame_size();
            Question {
                title: GO_TO_PIXEL,
                name: "Pixel",
                hint: format!("x, y below {width}, {height}"),
                missing: "type the pixel's column and row first",
                button: "Pin",
                command: "pin",
                takes_path: false,
                lists_pictures: false,
            }
        }
    }
}

/// Whether something is typed that no button takes, as those take the space bar.
fn types(ctx: &Context) -> bool {
    let is_word = |event: &Event| matches!(event, Event::Text(text) | Event::Paste(text) if !text.trim().is_empty());
    ctx.input(|input| input.events.iter().any(is_word))
}

/// Whether the arrows up and down were pressed: taken before the line of text sees them. Those that lead from button to button are
/// left alone.
pub(super) fn arrows(ctx: &Context) -> (bool, bool) {
    if !focus::is_free(ctx) && !ctx.text_edit_focused() {
        return (false, false);
    }
    ctx.input_mut(|input| {
        let mut pressed = |key| input.consume_key(egui::Modifiers::NONE, key);
        (pressed(Key::ArrowUp), pressed(Key::ArrowDown))
    })
}

/// The chosen line of `count` after these arrows.
pub(super) fn step(chosen: usize, [up, down]: [bool; 2], count: usize) -> usize {
    let next = (chosen + usize::from(down)).saturating_sub(usize::from(up));
    next.min(count.saturating_sub(1))
}

/// How a list of lines is shown.
#[derive(Clone, Copy, Debug)]
pub(super) struct ListShown {
    /// The line that is chosen.
    pub(super) chosen: usize,
    /// Whether that is another one than before: the list is scrolled to it.
    pub(super) moves: bool,
    pub(super) height: f32,
}

/// A list of lines to choose from; which was pressed.
pub(super) fn list_of<T>(
    ui: &mut Ui,
    lines: &[T],
    list: ListShown,
    show: impl Fn(&mut Ui, &T, bool) -> egui::Response,
) -> Option<usize> {
    let ListShown { chosen, moves, height } = list;
    let mut pressed = None;
    look::bars_beside(ui);
    // An area keeps the height that it had: without a least height, a list that a filter made short stays so.
    let area = ScrollArea::vertical().max_height(height).min_scrolled_height(height);
    area.show(ui, |ui| {
        ui.spacing_mut().item_spacing.y = BETWEEN_ENTRIES;
        for (index, line) in lines.iter().enumerate() {
            let response = show(ui, line, index == chosen);
            if index == chosen && moves {
                response.scroll_to_me(None);
            }
            // The second half of a double click on a folder would choose what its list has there.
            if response.clicked() && !response.double_clicked() && !response.triple_clicked() {
                pressed = Some(index);
            }
        }
    });
    pressed
}

/// OK and cancel; which was pressed. OK does nothing while something is `missing`.
fn buttons(ui: &mut Ui, ok: &str, missing: Option<&str>) -> Option<bool> {
    ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
        let accept = Button::new(ok).min_size(vec2(64.0, CONTROL.y));
        let accept = ui.add_enabled(missing.is_none(), accept);
        let accept = accept.on_disabled_hover_text(missing.unwrap_or_default()).clicked();
        let cancel = ui.add(Button::new("Cancel").min_size(vec2(64.0, CONTROL.y))).clicked();
        accept.then_some(true).or(cancel.then_some(false))
    })
    .inner
}

/// Room for the button beside the title of the help, in points.
const CLOSE: f32 = 56.0;

/// Ways on for newcomers, and all keys and gestures from the one table.
fn help(ctx: &Context, viewer: &Viewer, just_opened: bool, commands: &mut Vec<Command>) {
    let screen = ctx.content_rect();
    let columns = if screen.width() >= 760.0 { 2 } else { 1 };
    let mut way = Vec::new();
    let modal = modal("help").show(ctx, |ui| {
        ui.set_width((screen.width() - 60.0).min(if columns == 2 { 780.0 } else { 430.0 }));
        ui.horizontal(|ui| {
            ui.scope(|ui| {
                // In a tiny window the title gives way to the button.
                ui.set_max_width((ui.available_width() - CLOSE).max(0.0));
                ui.add(Label::new(RichText::new("Keys and gestures").heading()).truncate());
            });
            ui.with_layout(Layout::right_to_left(Align::Center), |ui| ui.button("Close").clicked())
                .inner
        })
        .inner
            | {
                ui.add_space(4.0);
                look::bars_beside(ui);
                // An area keeps the height that it had: without a least height, the help of a window that grew stays low.
                let height = (screen.height() - 120.0).max(64.0);
                let mut area = ScrollArea::vertical().max_height(height).min_scrolled_height(height);
                if just_opened {
                    // The ways on stand at the top.
                    area = area.vertical_scroll_offset(0.0);
                }
                area.show(ui, |ui| {
                    ui.scroll_with_delta_animation(vec2(0.0, scrolled(ctx, height)), ScrollAnimation::none());
                    way = start::ways(ui, viewer, columns).taken;
                    ui.add_space(8.0);
                    let (left, right) = Group::ALL.split_at(if columns == 2 { 4 } else { Group::ALL.len() });
                    ui.columns(columns, |columns| {
                        for group in left {
                            help_group(&mut columns[0], *group);
                        }
                        if let Some(column) = columns.get_mut(1) {
                            for group in right {
                                help_group(column, *group);
                            }
                        }
                        if let Some(column) = columns.last_mut() {
                            help_gestures(column);
                        }
                    });
                });
                false
            }
    });
    if modal.inner || beside(&modal.backdrop_response) || !way.is_empty() {
        commands.push(Command::Window(WindowCommand::CloseDialog));
    }
    commands.extend(way);
}

/// How far keys scroll what is `height` high: by lines and by pages, up where that is above zero.
fn scrolled(ctx: &Context, height: f32) -> f32 {
    const LINE: f32 = 40.0;
    let page = (height - LINE).max(LINE);
    ctx.input(|input| {
        let pressed = |key: Key| input.num_presses(key) as f32;
        let lines = pressed(Key::ArrowUp) - pressed(Key::ArrowDown);
        let pages = pressed(Key::PageUp) - pressed(Key::PageDown);
        lines * LINE + pages * page
    })
}

fn help_group(ui: &mut Ui, group: Group) {
    ui.label(RichText::new(group.name()).strong());
    for spec in commands::all()
        .iter()
        .filter(|spec| spec.group == group && !spec.keys.is_empty())
    {
        help_line(ui, &spec.keys_text(), spec.help);
    }
    ui.add_space(8.0);
}

fn help_gestures(ui: &mut Ui) {
    ui.label(RichText::new("Mouse").strong());
    for gesture in GESTURES {
        help_line(ui, gesture.gesture, gesture.help);
    }
}

fn help_line(ui: &mut Ui, keys: &str, help: &str) {
    ui.horizontal_top(|ui| {
        ui.allocate_ui_with_layout(vec2(112.0, 16.0), Layout::top_down(Align::Min), |ui| {
            ui.set_width(112.0);
            ui.add(Label::new(RichText::new(keys).small().strong()).wrap());
        });
        ui.add(Label::new(RichText::new(help).small()).wrap());
    });
}
