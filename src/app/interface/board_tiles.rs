//! The tiles of the board: as large as there is room for all of them, or a list where there is none.

use egui::text::LayoutJob;
use egui::{
    Align, Align2, Button, Color32, FontId, Label, Layout, Rect, RectAlign, RichText, Sense, Stroke, StrokeKind,
    TextFormat, TextureHandle, TextureOptions, Tooltip, Ui, Vec2, pos2, vec2,
};

use super::controls::{tip, tip_beside};
use super::scenes::image_of;
use crate::figure::shrunk;
use crate::raster::Framebuffer;
use crate::render::time_words;
use crate::viewer::{BoardCommand, BoardSort, Command, ShownTile, Viewer};

/// Least width of a tile with its words, in points.
const LEAST: f32 = 96.0;
/// Side below which tiles rather scroll than shrink, in points.
const SMALL: f32 = 60.0;
/// Largest side of a tile, in points.
const MOST: f32 = 264.0;
/// Free space between tiles, in points.
const GAP: f32 = 8.0;
/// Tiles beside each other at most.
const ACROSS: usize = 5;
/// Height of a line of words below a tile, in points.
const LINE: f32 = 14.0;
/// Width from which the time stands beside the error, in points.
const WIDE: f32 = 132.0;
/// What the button beside a caption takes of its width, in points.
const REMOVE: f32 = 18.0;
/// Size of the words, in points.
const LETTERS: f32 = 11.0;
/// Most lines of a caption: enough for three settings in the narrowest tile, and what has most values comes first.
const LINES: usize = 6;

/// Width of the tool tip of a tile at most, in points.
const TIP: f32 = 420.0;
/// Where the tool tip of a tile is: over its upper edge, from its left end on, or up to its right end.
const OVER: RectAlign = RectAlign {
    parent: Align2::LEFT_TOP,
    child: Align2::LEFT_TOP,
};
const OVER_RIGHT: RectAlign = RectAlign {
    parent: Align2::RIGHT_TOP,
    child: Align2::RIGHT_TOP,
};

/// How tiles lie.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Grid {
    columns: usize,
    /// Side of a tile, in points: a whole number of device pixels for each of its pixels.
    tile: f32,
    /// Width of a tile with its words, in points.
    cell: f32,
    /// Lines that captions take.
    captions: usize,
}

/// Textures of the tiles, and what they were made for.
#[derive(Default)]
pub(super) struct BoardTiles {
    of: Option<(u64, BoardSort, usize)>,
    textures: Vec<Option<TextureHandle>>,
}

impl std::fmt::Debug for BoardTiles {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("BoardTiles")
            .field("of", &self.of)
            .finish_non_exhaustive()
    }
}

impl Grid {
    /// For so many tiles of `side` x `side` pixels: as large as they all fit in `room` points, and no larger than is of
    /// use. Where they would be tiny, they scroll. `None` where not even one fits. `captions` tells how many lines captions
    /// take in a width.
    pub(super) fn of(
        (count, side): (usize, u32),
        scale: f32,
        room: Vec2,
        captions: impl Fn(f32) -> usize,
    ) -> Option<Self> {
        let with = |factor: u32| {
            let tile = (side * factor) as f32 / scale;
            let cell = tile.max(LEAST);
            let columns = (1..=ACROSS.min(count.max(1)))
                .rev()
                .find(|columns| *columns as f32 * (cell + GAP) - GAP <= room.x)?;
            let captions = captions(cell - REMOVE).clamp(1, LINES);
            Some(Self {
                columns,
                tile,
                cell,
                captions,
            })
        };
        let fits = |grid: &Self| {
            let rows = count.div_ceil(grid.columns) as f32;
            rows * grid.height() <= room.y
        };
        let all: Vec<Self> = (1..=16).filter_map(with).filter(|grid| grid.tile <= MOST).collect();
        let whole = all.iter().rev().find(|grid| fits(grid) && grid.tile >= SMALL);
        let mut scrolling = all.iter().filter(|grid| grid.height() <= room.y);
        let smallest = scrolling.clone().find(|grid| grid.tile >= SMALL);
        whole.or(smallest).or(scrolling.next_back()).copied()
    }

    /// Width of all tiles side by side, in points, with room for a bar.
    pub(super) fn width(self) -> f32 {
        self.columns as f32 * (self.cell + GAP) - GAP
    }

    /// Lines of numbers.
    fn lines(self) -> f32 {
        if self.cell >= WIDE { 2.0 } else { 3.0 }
    }

    /// Height of a tile with its words and the space below, in points.
    fn height(self) -> f32 {
        self.tile + (self.captions as f32 + self.lines()) * LINE + GAP + 6.0
    }
}

impl BoardTiles {
    /// Shows the truth and all `tiles`.
    pub(super) fn show(
        &mut self,
        ui: &mut Ui,
        viewer: &Viewer,
        (tiles, grid, timed): (&[ShownTile<'_>], Grid, bool),
        commands: &mut Vec<Command>,
    ) {
        self.load(ui, viewer, tiles);
        let all = 0..=tiles.len();
        for row in all.collect::<Vec<_>>().chunks(grid.columns) {
            ui.horizontal_top(|ui| {
                ui.spacing_mut().item_spacing.x = GAP;
                for number in row {
                    let texture = self.textures.get(*number).and_then(Option::as_ref);
                    let size = vec2(grid.cell, grid.height() - GAP);
                    ui.allocate_ui_with_layout(size, Layout::top_down(Align::Min), |ui| {
                        ui.set_min_size(size);
                        ui.spacing_mut().item_spacing = vec2(2.0, 0.0);
                        match number.checked_sub(1) {
                            None => truth(ui, viewer, (texture, grid)),
                            Some(index) => entry(ui, (&tiles[index], texture), (index, grid, timed), commands),
                        }
                    });
                }
            });
        }
    }

    fn load(&mut self, ui: &Ui, viewer: &Viewer, tiles: &[ShownTile<'_>]) {
        let board = viewer.board();
        let of = (board.number(), board.sort(), tiles.len());
        if self.of == Some(of) {
            return;
        }
        self.of = Some(of);
        let truth = board.truth().map(|(pixels, _)| pixels);
        let pixels = tiles.iter().map(|tile| tile.tile.map(|tile| &tile.pixels));
        let load = |pixels: &Framebuffer| {
            // Over white, as it will be on paper.
            let image = image_of(&shrunk(pixels, [pixels.width(), pixels.height()]));
            ui.ctx().load_texture("board tile", image, TextureOptions::NEAREST)
        };
        self.textures = std::iter::once(truth)
            .chain(pixels)
            .map(|pixels| pixels.map(load))
            .collect();
    }
}

/// The pixels of a tile, or an empty place; where they are, on whole device pixels.
fn picture(ui: &mut Ui, texture: Option<&TextureHandle>, grid: Grid, sense: Sense) -> (Rect, egui::Response) {
    let (place, response) = ui.allocate_exact_size(Vec2::splat(grid.tile), sense);
    let scale = ui.pixels_per_point();
    let corner = (place.min * scale).round() / scale;
    let place = Rect::from_min_size(corner, place.size());
    ui.painter().rect_filled(place, 0.0, ui.visuals().extreme_bg_color);
    if let Some(texture) = texture {
        // A region at the frame's edge may be narrower.
        let [width, height] = texture.size().map(|side| side as f32);
        let size = vec2(width, height) * (grid.tile / width.max(height).max(1.0));
        let whole = Rect::from_min_max(pos2(0.0, 0.0), pos2(1.0, 1.0));
        let at = Rect::from_min_size(corner, size);
        ui.painter().image(texture.id(), at, whole, Color32::WHITE);
    }
    (place, response)
}

fn truth(ui: &mut Ui, viewer: &Viewer, (texture, grid): (Option<&TextureHandle>, Grid)) {
    picture(ui, texture, grid, Sense::hover());
    ui.add_space(3.0);
    let stale = viewer.board().truth().is_none_or(|(_, stale)| stale);
    caption(ui, "the truth", stale, grid);
    let words = viewer.board().words().map_or(String::new(), |[_, truth]| truth);
    ui.add(Label::new(RichText::new(words).size(LETTERS).weak()).wrap());
}

/// A tile: a click gives A its settings.
fn entry(
    ui: &mut Ui,
    (tile, texture): (&ShownTile<'_>, Option<&TextureHandle>),
    (index, grid, timed): (usize, Grid, bool),
    commands: &mut Vec<Command>,
) {
    let (place, response) = picture(ui, texture, grid, Sense::click());
    let name = format!("Make tile {} A", index + 1);
    let stroke = if tile.is_a {
        Some(Stroke::new(2.0, ui.visuals().selection.bg_fill))
    } else if response.hovered() || response.has_focus() {
        Some(Stroke::new(2.0, ui.visuals().widgets.hovered.fg_stroke.color))
    } else {
        None
    };
    if let Some(stroke) = stroke {
        ui.painter().rect_stroke(place, 0.0, stroke, StrokeKind::Outside);
    }
    let does = if tile.is_a {
        "A has the settings of this tile"
    } else {
        "Gives A the settings of this tile"
    };
    let mut tip = Tooltip::for_enabled(&response).width(TIP);
    // Along the tile's own upper edge: below it and above it are the numbers that one compares.
    tip.popup = tip.popup.gap(0.0).align_alternatives(&[OVER_RIGHT]);
    tip_beside(tip, OVER, format!("{does}: {}.", tile.caption));
    if response.accessible_name(name).clicked() {
        commands.push(Command::Board(BoardCommand::MakeA(index)));
    }
    ui.add_space(3.0);
    let told = format!("{} {}", index + 1, tile.caption);
    ui.horizontal_top(|ui| {
        caption(ui, &told, tile.is_stale, grid);
        remove(ui, index, commands);
    });
    let [rmse, flip, time] = numbers(tile, timed);
    let small = |text: String| {
        let text = RichText::new(text).monospace().size(LETTERS);
        // Of another picture.
        if tile.is_stale { text.weak().italics() } else { text }
    };
    if grid.cell >= WIDE {
        ui.allocate_ui_with_layout(vec2(grid.cell, LINE), Layout::left_to_right(Align::Center), |ui| {
            ui.set_min_size(vec2(grid.cell, LINE));
            ui.label(small(rmse));
            ui.with_layout(Layout::right_to_left(Align::Center), |ui| ui.label(small(time)));
        });
        ui.label(small(flip));
    } else {
        for text in [rmse, flip, time] {
            ui.label(small(text));
        }
    }
}

/// What a tile is; as many lines as the longest takes are kept free.
fn caption(ui: &mut Ui, text: &str, stale: bool, grid: Grid) {
    let color = if stale {
        ui.visuals().weak_text_color()
    } else {
        ui.visuals().strong_text_color()
    };
    let size = vec2(grid.cell - REMOVE, grid.captions as f32 * LINE);
    ui.allocate_ui_with_layout(size, Layout::top_down(Align::Min), |ui| {
        ui.set_min_size(size);
        ui.label(job(text, color, size.x));
    });
}

/// A caption in [`LINES`] at most.
fn job(text: &str, color: Color32, width: f32) -> LayoutJob {
    let format = TextFormat::simple(FontId::proportional(LETTERS), color);
    let mut job = LayoutJob::single_section(text.to_owned(), format);
    (job.wrap.max_width, job.wrap.max_rows) = (width, LINES);
    job
}

/// How many lines the longest caption takes in a width.
pub(super) fn caption_lines(ui: &Ui, tiles: &[ShownTile<'_>], width: f32) -> usize {
    let rows = tiles.iter().map(|tile| {
        // With the number of a tile before it.
        let job = job(&format!("9 {}", tile.caption), Color32::WHITE, width);
        ui.painter().layout_job(job).rows.len()
    });
    rows.max().unwrap_or(1)
}

fn remove(ui: &mut Ui, index: usize, commands: &mut Vec<Command>) {
    let button = ui.add(Button::new(RichText::new("\u{d7}").size(LETTERS)).small().frame(false));
    let response = button.on_hover_text(tip("board-remove"));
    if response.accessible_name(format!("Remove tile {}", index + 1)).clicked() {
        commands.push(Command::Board(BoardCommand::Remove(index)));
    }
}

/// What was measured, in words.
fn numbers(tile: &ShownTile<'_>, timed: bool) -> [String; 3] {
    let Some(numbers) = tile.tile.map(|tile| tile.numbers) else {
        return ["\u{2026}".to_owned(), String::new(), String::new()];
    };
    let time = if timed { time_words(numbers.time) } else { String::new() };
    [
        format!("RMSE {:.2}", numbers.rmse),
        format!("FLIP {:.4}", numbers.flip),
        time,
    ]
}

/// All entries, a line each: where tiles have no room.
pub(super) fn list(ui: &mut Ui, tiles: &[ShownTile<'_>], timed: bool, commands: &mut Vec<Command>) {
    for (index, tile) in tiles.iter().enumerate() {
        let [rmse, flip, time] = numbers(tile, timed);
        ui.horizontal(|ui| {
            let told: Vec<String> = [rmse, flip, time].into_iter().filter(|text| !text.is_empty()).collect();
            let text = format!("{} {}: {}", index + 1, tile.caption, told.join(", "));
            let button = Button::selectable(tile.is_a, RichText::new(text).size(LETTERS)).truncate();
            let room = vec2(ui.available_width() - 22.0, LINE + 4.0);
            let response = ui.add_sized(room, button).on_hover_text(tip("board-a"));
            let name = format!("Make tile {} A", index + 1);
            if response.accessible_name(name).clicked() {
                commands.push(Command::Board(BoardCommand::MakeA(index)));
            }
            remove(ui, index, commands);
        });
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tiles_are_as_large_as_all_fit() {
        let of = |count, scale, room: [f32; 2]| Grid::of((count, 64), scale, room.into(), |_| 1);
        let wide = of(10, 1.0, [1000.0, 640.0]).expect("room");
        assert_eq!(
            (wide.columns, wide.tile),
            (5, 192.0),
            "two rows of five, three pixels each"
        );
        let few = of(2, 1.0, [1000.0, 640.0]).expect("room");
        assert_eq!((few.columns, few.tile), (2, 256.0), "no larger than is of use");
        let dense = of(10, 2.0, [580.0, 300.0]).expect("room");
        assert_eq!((dense.columns, dense.tile), (5, 64.0), "two device pixels a point");
        let tall = of(10, 1.0, [300.0, 300.0]).expect("room for some");
        assert_eq!((tall.columns, tall.tile), (2, 64.0), "the rest scrolls");
        let small = of(10, 4.0, [580.0, 240.0]).expect("room for some");
        assert_eq!((small.columns, small.tile), (5, 64.0), "no tiny ones");
        assert_eq!(of(10, 1.0, [90.0, 300.0]), None, "too narrow");
        assert_eq!(of(10, 1.0, [300.0, 90.0]), None, "too low");
    }
}
