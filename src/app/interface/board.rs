//! The card of the board: the truth and up to nine settings of one region, each pixel a square, with what was measured.
//!
//! ```text
//!    Board  64 x 64 pixels from 600, 368 ...                      x
//!    [Add A] [Vary] Sort [RMSE|FLIP|time] Truth [as A|...] ...
//!    +-----+  +-----+  +-----+
//!    |truth|  |     |  |     |     tiles; a click on one gives A its settings
//!    +-----+  +-----+  +-----+
//!    truth    1 grid x  2 r2 x
//!             RMSE 4.0  RMSE 8.9
//! ```

use egui::style::ScrollAnimation;
use egui::{
    Align, Align2, Area, Button, Color32, ComboBox, Frame, Id, Layout, Order, Rect, RectAlign, RichText, ScrollArea,
    TextStyle, Tooltip, Ui, Vec2, vec2,
};

use super::board_tiles::{BoardTiles, Grid, caption_lines, list};
use super::controls::{command_button, tip, tip_beside};
use super::corner::CardCorner;
use super::focus::{self, FocusPanel};
use super::look::{self, BAR_ROOM, CONTROL};
use crate::color::ResolveSpace;
use crate::figure::TableFormat;
use crate::viewer::{AbCommand, Axis, BoardCommand, BoardSort, Command, ShownTile, Toggle, Viewer, commands, picture};

/// Free space around the card, in points.
const MARGIN: f32 = 10.0;
/// What the card's frame takes of its width and height, in points.
const FRAME: f32 = 14.0;
/// Height of what is below title and controls at least, in points.
const LEAST_TILES: f32 = 60.0;
/// So little room above the card, in points, is not left free: the next entry would move the card up by a part of it.
const LITTLE: f32 = 64.0;
/// Width of the controls in one or two rows, in points.
const CONTROLS: f32 = 660.0;

/// Width of a card below which what leaves the board is in a list, in points: else some of it would stand in a row of its own.
const NARROW: f32 = CONTROLS;

/// Height of the list of settings, in points.
const VARY_HEIGHT: f32 = 320.0;

/// How large the card's contents have been, in a room of this size, both in points. They stay so large: the buttons above the tiles
/// would move away from under the pointer that adds entries with them.
#[derive(Debug, Default)]
struct Kept {
    room: Vec2,
    size: Vec2,
}

impl Kept {
    /// Another room, and a board without tiles, begin anew.
    fn follow(&mut self, room: Vec2, is_empty: bool) {
        if self.room != room || is_empty {
            *self = Self { room, size: Vec2::ZERO };
        }
    }

    /// Takes in how large contents with tiles are. Where there is little room left above, they take that as well.
    fn take(&mut self, size: Vec2) {
        let left = self.room.y - size.y;
        let height = if left < LITTLE { size.y.max(self.room.y) } else { size.y };
        self.size = self.size.max(vec2(size.x, height));
    }
}

/// What the card remembers.
#[derive(Debug, Default)]
pub(super) struct BoardCard {
    tiles: BoardTiles,
    corner: CardCorner,
    /// What stood above the tiles in the last pass, in points.
    above: f32,
    kept: Kept,
    /// Whether the list of settings hung open in the last pass.
    list_open: bool,
}

impl BoardCard {
    /// Shows it in the lower right corner of what is `free`, as large as it needs and has room for. Returns where it is. Times
    /// are shown only where pictures may depend on them: `timed`.
    pub(super) fn show(
        &mut self,
        ui: &Ui,
        viewer: &Viewer,
        (free, timed): (Rect, bool),
        commands: &mut Vec<Command>,
    ) -> Option<Rect> {
        let board = viewer.board();
        if !board.is_open() {
            self.kept = Kept::default();
            return None;
        }
        let room = free.shrink(MARGIN).size() - Vec2::splat(FRAME);
        let tiles = board.tiles();
        self.kept.follow(room, tiles.is_empty());
        let bar = f32::from(BAR_ROOM);
        let for_tiles = vec2(room.x - bar, room.y - self.above.max(60.0));
        let captions = |width: f32| caption_lines(ui, &tiles, width);
        let grid = Grid::of(
            (tiles.len() + 1, board.side()),
            ui.pixels_per_point(),
            for_tiles,
            captions,
        );
        let width = (grid.map_or(0.0, Grid::width) + bar).max(CONTROLS);
        let width = width.max(self.kept.size.x).min(room.x);
        let id = Id::unique("board");
        let area = Area::new(id)
            .order(Order::Middle)
            .fixed_pos(free.shrink(MARGIN).right_bottom())
            .pivot(Align2::RIGHT_BOTTOM)
            .constrain_to(free)
            .fade_in(false)
            .show(ui.ctx(), |ui| {
                FocusPanel::Board.head_of_area(ui, id);
                Frame::popup(ui.style()).show(ui, |ui| {
                    ui.set_width(width);
                    ui.set_min_height(self.kept.size.y.min(room.y));
                    let top = ui.cursor().top();
                    head(ui, viewer, commands);
                    let head = ui.cursor().top() - top;
                    // In a low window the controls go out of sight, and what closes the board does not.
                    let is_low = room.y < self.above + LEAST_TILES;
                    if !is_low {
                        self.controls(ui, viewer, head, commands);
                        if tiles.is_empty() {
                            return;
                        }
                    }
                    let above = if is_low { head } else { self.above };
                    let height = (room.y - above).max(LEAST_TILES);
                    look::bars_beside(ui);
                    ScrollArea::vertical()
                        // Other entries begin with the truth and the best.
                        .id_salt(("board tiles", board.fillings()))
                        // As wide as the card: the bar lies on its right.
                        .auto_shrink([false, true])
                        .max_height(height)
                        // An area keeps the height that it had: without a least height, a board that was cleared stays so low.
                        .min_scrolled_height(height)
                        .show(ui, |ui| {
                            if is_low {
                                self.controls(ui, viewer, head, commands);
                            }
                            if tiles.is_empty() {
                                return;
                            }
                            // For the frame around the tile that A is.
                            ui.add_space(2.0);
                            match grid {
                                Some(grid) => self.tiles.show(ui, viewer, (&tiles, grid, timed), commands),
                                None => list(ui, &tiles, timed, commands),
                            }
                        });
                    if !tiles.is_empty() {
                        self.kept.take(ui.min_rect().size());
                    }
                });
            });
        self.corner.drawn(ui.ctx(), area.response.rect);
        Some(area.response.rect)
    }

    /// What is above the tiles, below a title so high.
    fn controls(&mut self, ui: &mut Ui, viewer: &Viewer, head: f32, commands: &mut Vec<Command>) {
        let top = ui.cursor().top();
        controls(ui, viewer, &mut self.list_open, commands);
        if let Some(words) = in_all(&viewer.board().tiles(), &viewer.board().shared_words()) {
            ui.label(RichText::new(words).small().weak());
        }
        if viewer.board().is_without_difference() {
            let words =
                "Nothing differs here: pin a pixel elsewhere, or make the region larger (board-region in the palette).";
            ui.label(RichText::new(words).small().weak());
        }
        self.above = head + ui.cursor().top() - top;
        if viewer.board().tiles().is_empty() {
            let hint = "Nothing to compare yet: Add A puts the settings of the picture here, Vary one entry for each value of \
                        a setting.";
            ui.label(RichText::new(hint).small().weak());
        }
    }
}

/// The title, what is compared with what, and what closes the card.
fn head(ui: &mut Ui, viewer: &Viewer, commands: &mut Vec<Command>) {
    let mut has_room = true;
    ui.horizontal(|ui| {
        ui.label(RichText::new("Board").strong()).on_hover_text(tip("board"));
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            let close = ui.add(Button::new("\u{d7}").min_size(CONTROL));
            let close = close
                .on_hover_text("Closes the board and gives up what is being measured. Its entries come back with it.");
            if close.accessible_name("Close the board").clicked() {
                commands.push(Command::Board(BoardCommand::Show(Toggle::Off)));
            }
            has_room = ui.available_width() >= width_of_words(ui, viewer);
            if has_room {
                ui.with_layout(Layout::left_to_right(Align::Center), |ui| about(ui, viewer));
            }
        });
    });
    if !has_room {
        about(ui, viewer);
    }
    if let Some(problem) = viewer.board().problem() {
        ui.label(RichText::new(problem).small().color(ui.visuals().warn_fg_color));
    }
}

/// What is compared with what, in as many lines as it takes.
fn about(ui: &mut Ui, viewer: &Viewer) {
    let label = egui::Label::new(RichText::new(words(viewer)).small().weak()).wrap();
    ui.add(label).on_hover_text(format!("{}. {MEASURED}", words(viewer)));
}

/// The width of that in one line, in points, with room for what is said while it is measured: the line stays where it is.
fn width_of_words(ui: &Ui, viewer: &Viewer) -> f32 {
    let text = format!("{}{MEASURING}", words(viewer).trim_end_matches(MEASURING));
    let font = TextStyle::Small.resolve(ui.style());
    ui.painter().layout_no_wrap(text, font, Color32::WHITE).size().x
}

/// Said while tiles are measured.
const MEASURING: &str = "; measuring \u{2026}";

/// How numbers are made.
const MEASURED: &str = "RMSE in levels of 255 and FLIP are those of this region alone. The time is that of the whole frame, the median of \
                        up to five drawings, fewer where one takes long";

/// The region and the truth in words.
fn words(viewer: &Viewer) -> String {
    let board = viewer.board();
    let Some([region, truth]) = board.words() else {
        return "no picture to compare".to_owned();
    };
    let why = board.truth_space().map_or(", as A", |_| "");
    let more = if board.is_measuring() { MEASURING } else { "" };
    format!("{region}; truth: {truth}{why}{more}")
}

/// What all tiles share, and that the picture beside them has other settings; `None` where there is nothing to say.
fn in_all(tiles: &[ShownTile<'_>], shared: &str) -> Option<String> {
    let shared = (!shared.is_empty()).then(|| told_of_all(shared));
    let is_elsewhere = !tiles.is_empty() && !tiles.iter().any(|tile| tile.is_a);
    let elsewhere = is_elsewhere.then(|| "The settings of A are on no tile.".to_owned());
    let words: Vec<String> = shared.into_iter().chain(elsewhere).collect();
    (!words.is_empty()).then(|| words.join(" "))
}

/// That all pictures which are compared have these settings.
pub(super) fn told_of_all(settings: &str) -> String {
    format!("In all: {settings}.")
}

/// What changes the board.
fn controls(ui: &mut Ui, viewer: &Viewer, list_open: &mut bool, commands: &mut Vec<Command>) {
    let board = viewer.board();
    ui.horizontal_wrapped(|ui| {
        ui.spacing_mut().item_spacing = vec2(3.0, 3.0);
        if command_button(ui, "board-add", "Add A").clicked() {
            commands.push(Command::Board(BoardCommand::AddA));
        }
        vary(ui, viewer, list_open, commands);
        together(ui, 166.0, "sort", |ui| {
            let sorts = BoardSort::ALL.map(|sort| (sort, sort_name(sort)));
            let sort = few(ui, ("Sort by", "board-sort"), board.sort(), &sorts);
            commands.extend(sort.map(BoardCommand::Sort).map(Command::Board));
        });
        together(ui, 172.0, "truth", |ui| {
            let spaces = [
                (None, "as A"),
                (Some(ResolveSpace::Stored), ResolveSpace::Stored.name()),
                (Some(ResolveSpace::Linear), ResolveSpace::Linear.name()),
            ];
            let space = few(ui, ("Truth averaged", "truth-space"), board.truth_space(), &spaces);
            commands.extend(space.map(AbCommand::SetTruthSpace).map(Command::Ab));
        });
        if ui.max_rect().width() < NARROW {
            more(ui, commands);
        } else {
            leaving(ui, commands);
        }
    });
}

/// What leaves the board, in a row: copies and pictures of it, and all that is on it.
fn leaving(ui: &mut Ui, commands: &mut Vec<Command>) {
    together(ui, 94.0, "copy", |ui| {
        for (format, text) in [(TableFormat::Markdown, "MD"), (TableFormat::Csv, "CSV")] {
            let button = ui.add(Button::new(text).min_size(CONTROL));
            let button = button.on_hover_text(tip("board-copy"));
            if button.accessible_name(copy_name(format)).clicked() {
                commands.push(Command::Board(BoardCommand::Copy(format)));
            }
        }
    });
    if command_button(ui, "save-board", "Save").clicked() {
        commands.push(Command::Board(BoardCommand::Save));
    }
    if command_button(ui, "board-clear", "Clear").clicked() {
        commands.push(Command::Board(BoardCommand::Clear));
    }
}

/// The same as a list, where a row of its own would be taken from the tiles.
fn more(ui: &mut Ui, commands: &mut Vec<Command>) {
    let named = |id: &str, command: BoardCommand| {
        let name = commands::find(id).map_or("", |spec| spec.name);
        (name.to_owned(), tip(id), command)
    };
    let copy = |format: TableFormat| (copy_name(format), tip("board-copy"), BoardCommand::Copy(format));
    let lines = [
        copy(TableFormat::Markdown),
        copy(TableFormat::Csv),
        named("save-board", BoardCommand::Save),
        named("board-clear", BoardCommand::Clear),
    ];
    let list = ComboBox::from_id_salt("more of the board")
        .width(64.0)
        .selected_text("More \u{2026}")
        .show_ui(ui, |ui| {
            for (name, tip, command) in lines {
                let line = ui.selectable_label(false, name);
                if line.clicked() {
                    commands.push(Command::Board(command));
                }
                tip_beside(Tooltip::for_enabled(&line), RectAlign::LEFT_START, tip);
            }
        });
    let list = list.response.on_hover_text("Copies, saves or clears the board");
    focus::note_opener(&list.accessible_name("More of the board"));
}

fn copy_name(format: TableFormat) -> String {
    let name = match format {
        TableFormat::Markdown => "Markdown",
        TableFormat::Csv => "CSV",
    };
    format!("Copy the board as {name}")
}

/// A label and its buttons, which take about `width` points and stay in one row.
fn together(ui: &mut Ui, width: f32, text: &str, contents: impl FnOnce(&mut Ui)) {
    if ui.available_size_before_wrap().x < width {
        ui.end_row();
    }
    ui.add_space(2.0);
    // As high as the buttons, so that they stand in its row from the first on.
    let size = vec2(28.0, CONTROL.y);
    ui.allocate_ui_with_layout(size, Layout::right_to_left(Align::Center), |ui| {
        ui.set_min_size(size);
        ui.label(RichText::new(text).small().weak());
    });
    contents(ui);
}

fn sort_name(sort: BoardSort) -> &'static str {
    match sort {
        BoardSort::Rmse => "RMSE",
        BoardSort::Flip => "FLIP",
        BoardSort::Time => "time",
    }
}

/// One of few values, side by side, as wide as their names; what was chosen, if it was just now. `named` is what screen readers
/// call it, and the command whose tool tip it has.
fn few<T: Copy + PartialEq>(ui: &mut Ui, (name, id): (&str, &str), current: T, values: &[(T, &str)]) -> Option<T> {
    let mut chosen = None;
    for (value, text) in values {
        let button = Button::selectable(*value == current, *text)
            .frame_when_inactive(true)
            .min_size(CONTROL);
        let response = ui.add(button).on_hover_text(tip(id));
        if response.accessible_name(format!("{name}: {text}")).clicked() && *value != current {
            chosen = Some(*value);
        }
    }
    chosen
}

/// A list of settings, of which one fills the board; `open` is whether it hung open before. It opens at its top: it has no value that
/// is chosen, and an area would open where it was left.
fn vary(ui: &mut Ui, viewer: &Viewer, open: &mut bool, commands: &mut Vec<Command>) {
    let was_open = *open;
    let scene = viewer.scene_list().scene();
    let list = ComboBox::from_id_salt("vary on the board")
        .width(70.0)
        .selected_text("Vary \u{2026}")
        .height(f32::INFINITY)
        .show_ui(ui, |ui| {
            // The list's own bar is hidden until the pointer is there, and nothing says that there is more.
            look::bars_beside(ui);
            ScrollArea::vertical().max_height(VARY_HEIGHT).show(ui, |ui| {
                for (index, setting) in picture::all().enumerate() {
                    let label = setting.option.replace('-', " ");
                    // Tiles that are all alike teach nothing.
                    let why = setting.idle(viewer.settings(), scene);
                    let line = ui.add_enabled(why.is_none(), Button::selectable(false, label));
                    let line = line.on_disabled_hover_text(format!("No effect: {}", why.unwrap_or_default()));
                    if index == 0 && !was_open {
                        line.scroll_to_me_animation(Some(Align::TOP), ScrollAnimation::none());
                    }
                    if line.clicked() {
                        commands.push(Command::Board(BoardCommand::Vary(Axis::first(setting))));
                        // Enter does not close it by itself.
                        ui.close();
                    }
                }
            });
        });
    *open = list.inner.is_some();
    let list = list
        .response
        .on_hover_text(tip("board-vary"))
        .accessible_name("Vary on the board");
    focus::note_opener(&list);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn board_stays_as_large_as_it_was() {
        let (room, mut kept) = (vec2(600.0, 400.0), Kept::default());
        let sizes = [(300.0, 150.0), (500.0, 120.0), (400.0, 330.0), (400.0, 350.0)].map(|(width, height)| {
            kept.follow(room, false);
            kept.take(vec2(width, height));
            kept.size
        });
        let expected = [
            (300.0, 150.0),
            (500.0, 150.0),
            (500.0, 330.0),
            // Nearly all of the room.
            (500.0, 400.0),
        ];
        assert_eq!(sizes, expected.map(Vec2::from));
        let sizes = [(room, true), (vec2(500.0, 400.0), false)].map(|(room, is_empty)| {
            kept.take(vec2(300.0, 200.0));
            kept.follow(room, is_empty);
            kept.size
        });
        assert_eq!(sizes, [Vec2::ZERO; 2], "another board, another room");
    }

    #[test]
    fn boards_say_what_all_tiles_share_and_where_a_is_not() {
        let tile = |is_a| ShownTile {
            caption: String::new(),
            tile: None,
            is_stale: false,
            is_a,
        };
        assert_eq!(in_all(&[tile(true)], ""), None, "nothing to say");
        assert_eq!(in_all(&[], ""), None, "of nothing");
        assert_eq!(
            in_all(&[tile(false), tile(true)], "sample rate 64").as_deref(),
            Some("In all: sample rate 64.")
        );
        assert_eq!(
            in_all(&[tile(false)], "sample rate 64").as_deref(),
            Some("In all: sample rate 64. The settings of A are on no tile.")
        );
    }
}
