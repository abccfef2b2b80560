//! The board at this moment: what stands on it, of which region, and what commands change of it.

use crate::color::ResolveSpace;
use crate::figure::{Ground, TableFormat};
use crate::raster::{Framebuffer, Region};
use crate::render::RenderSettings;
use crate::viewer::BoardCommand;
use crate::viewer::board::SIDES;
use crate::viewer::board::entry::{BoardEntry, MAX_ENTRIES, captions, shared_words};
use crate::viewer::board::measure::{BoardPlace, BoardTile};
use crate::viewer::board::measuring::BoardQuestion;
use crate::viewer::board::numbers::BoardSort;
use crate::viewer::board::report::{BoardCommandLine, BoardReport};
use crate::viewer::board::{Board, Displaced};
use crate::viewer::chrome::messages::no_such;
use crate::viewer::command::Effect;
use crate::viewer::control::copy::Copied;
use crate::viewer::control::recipes::Recipes;
use crate::viewer::export::saver::{Recipe, Shot, Work};
use crate::viewer::export::sheet::axes::Axis;
use crate::viewer::export::spec::PictureSpec;
use crate::viewer::settings::Theme;
use crate::viewer::settings::picture::SettingChange;
use crate::viewer::state::Viewer;

/// Said where tiles are still missing.
const NOT_YET: &str = "the board is not measured yet; wait until every tile has its numbers";
/// Said where there are none.
const EMPTY: &str = "the board is empty; add settings first, with board-add or board-vary";

/// A tile of the board as it is shown.
#[derive(Clone, Debug)]
pub struct ShownTile<'a> {
    /// What tells it from the others.
    pub caption: String,
    /// Its pixels and numbers, once they are there.
    pub tile: Option<&'a BoardTile>,
    /// Whether they are of another view, while those of this one are measured.
    pub is_stale: bool,
    /// Whether A has these settings.
    pub is_a: bool,
}

/// The board over the picture.
#[derive(Clone, Copy, Debug)]
pub struct Boarded<'a> {
    pub(in crate::viewer) recipes: Recipes<'a>,
    pub(in crate::viewer) board: &'a Board,
}

impl<'a> Boarded<'a> {
    /// Whether it is to be seen.
    pub fn is_open(&self) -> bool {
        self.board.open && !self.recipes.pixels.chrome.hidden
    }

    /// What entries are sorted by.
    pub fn sort(&self) -> BoardSort {
        self.board.sort
    }

    /// Pixels along each side of the region, where the frame has as many.
    pub fn side(&self) -> u32 {
        self.board.side
    }

    /// In which values the truth is averaged, where not in A's.
    pub fn truth_space(&self) -> Option<ResolveSpace> {
        self.recipes.both.ab.truth_space()
    }

    /// What is shown of what: the region, the truth.
    pub fn words(&self) -> Option<[String; 2]> {
        let place = self.place()?;
        Some([place.region_words(), place.truth_words()])
    }

    /// What all entries have that is not at its default, such as `sample rate 64`; may be empty.
    pub fn shared_words(&self) -> String {
        shared_words(&self.board.entries)
    }

    /// Grows with every change of the tiles.
    pub fn number(&self) -> u64 {
        self.board.measuring.number()
    }

    /// Grows whenever all entries are replaced: who looks at them begins anew.
    pub fn fillings(&self) -> u64 {
        self.board.fillings
    }

    /// Whether tiles are being measured.
    pub fn is_measuring(&self) -> bool {
        !self.board.measuring.is_current()
    }

    /// Why tiles are missing, in one line.
    pub fn problem(&self) -> Option<&'a str> {
        self.board.measuring.found()?.problem.as_deref()
    }

    /// The region of the truth, and whether it is that of another view.
    pub fn truth(&self) -> Option<(&'a Framebuffer, bool)> {
        self.board.measuring.truth()
    }

    /// The entries in the order in which they are shown.
    pub fn tiles(&self) -> Vec<ShownTile<'a>> {
        let entries = self.board.sorted();
        let own = BoardEntry::of(self.recipes.both.settings);
        let tile = |(entry, caption): (&BoardEntry, String)| {
            let found = self.board.measuring.tile(*entry);
            ShownTile {
                caption,
                tile: found.map(|(tile, _)| tile),
                is_stale: found.is_some_and(|(_, is_stale)| is_stale),
                is_a: entry.is_like(own),
            }
        };
        entries.iter().zip(captions(&entries)).map(tile).collect()
    }

    /// The region: around the pinned pixel, or the middle of the free picture; inside the frame.
    fn region(&self) -> Option<Region> {
        let layout = self.recipes.both.layout;
        let size = layout.frame_size();
        let pixels = &self.recipes.pixels;
        let at = pixels.pinned().or_else(|| pixels.middle())?;
        let side = self.board.side;
        let along = |axis: usize| {
            let length = side.min(size[axis]);
            (at[axis].saturating_sub(length / 2).min(size[axis] - length), length)
        };
        let ([x, width], [y, height]) = (along(0).into(), along(1).into());
        (width > 0 && height > 0).then_some(Region { x, y, width, height })
    }

    /// Size, view and settings of A, as the frame on the screen has them.
    fn own(&self) -> Option<PictureSpec> {
        let spec = self.recipes.picture_spec()?;
        let frame = self.recipes.both.frames.frame()?;
        Some(PictureSpec {
            size: frame.picture.size,
            render: RenderSettings {
                outline: frame.picture.settings.outline,
                ..spec.render
            },
            legend: false,
            insets: Vec::new(),
            ..spec
        })
    }

    fn place(&self) -> Option<BoardPlace> {
        Some(BoardPlace::new(self.own()?, self.region()?, self.truth_space()))
    }

    /// What is to be measured; nothing while the picture moves, or the board is not to be seen.
    fn question(&self) -> Option<BoardQuestion> {
        let both = &self.recipes.both;
        let rests = both.frames.drawing.is_current() && both.ab.is_current() && both.is_measured();
        if !self.is_open() || self.board.entries.is_empty() || !rests || both.scene_list.is_reading_any() {
            return None;
        }
        Some(BoardQuestion {
            place: self.place()?,
            known: self.recipes.known_scene()?,
            own_dialect: both.settings.dialect,
            entries: self.board.entries.clone(),
        })
    }

    /// What was measured; `None` while something is missing.
    pub fn report(&self) -> Option<BoardReport<'a>> {
        let found = self.board.measuring.found().filter(|_| !self.is_measuring())?;
        let truth = found.truth.as_deref()?;
        let row = |entry: &BoardEntry| Some((*entry, found.tile(*entry)?));
        let rows: Option<Vec<_>> = self.board.entries.iter().map(row).collect();
        let rows = rows.filter(|rows| !rows.is_empty())?;
        Some(BoardReport::new(&found.place, truth, rows, self.board.sort))
    }

    /// Whether no entry differs from the truth in the region, as far as that is known.
    pub fn is_without_difference(&self) -> bool {
        self.report().is_some_and(|report| report.is_without_difference())
    }

    fn command_line(&self, region: Region) -> Option<BoardCommandLine> {
        Some(BoardCommandLine {
            own: self.own()?,
            entries: self.board.entries.clone(),
            region,
            sort: self.board.sort,
            space: self.truth_space(),
            ground: self.ground(),
            frames: BoardCommandLine::FRAMES,
        })
    }

    /// Saved boards look as the panels do.
    fn ground(&self) -> Ground {
        match self.recipes.pixels.chrome.theme() {
            Theme::Dark => Ground::Dark,
            Theme::Light => Ground::Light,
        }
    }

    /// Why there is nothing to report.
    fn why_none(&self) -> &'static str {
        if self.board.entries.is_empty() { EMPTY } else { NOT_YET }
    }

    /// The table for the clipboard.
    fn copied(&self, format: TableFormat) -> Result<Copied, String> {
        let report = self.report().ok_or_else(|| self.why_none())?;
        let count = report.rows.len();
        let (text, name) = match format {
            TableFormat::Markdown => (report.markdown(), "Markdown"),
            TableFormat::Csv => (report.table().csv(), "CSV"),
        };
        Ok(Copied {
            effect: Effect::CopyText(text),
            message: format!("copied the board as {name}, {count} settings"),
        })
    }

    /// The picture of the board, and how it was made.
    fn saved(&self) -> Result<Work, String> {
        let report = self.report().ok_or_else(|| self.why_none())?;
        let picture = report.picture(self.ground())?;
        let line = self.command_line(report.place.region);
        let scene = self.recipes.known_scene().map(|known| known.scene);
        let recipe = line.zip(scene).map(|(line, scene)| Recipe {
            command: Some(line.recipe()),
            spec: line.own,
            scene,
            differs: Some(BoardCommandLine::DIFFERS.to_owned()),
            compared: None,
        });
        Ok(Work::Picture {
            shot: Shot::Ready(picture),
            recipe: recipe.map(Box::new),
            file: None,
        })
    }
}

/// Said where an axis has more values than a board has room for.
fn first_of(axis: &Axis, count: usize) -> String {
    format!(
        "the board has the first {MAX_ENTRIES} of {count} values; others can be named: board-vary {} VALUE,VALUE",
        axis.name
    )
}

impl Viewer {
    /// The board: several settings of one region, beside the truth.
    pub fn board(&self) -> Boarded<'_> {
        Boarded {
            recipes: self.recipes(),
            board: &self.board,
        }
    }

    /// Carries out a command; what goes to the clipboard is answered, and what is wrong in one line.
    pub(in crate::viewer) fn apply_board(&mut self, command: BoardCommand) -> Option<Result<Copied, String>> {
        let own = BoardEntry::of(&self.settings);
        match command {
            BoardCommand::Show(toggle) => {
                // What is hidden is not open to the eye.
                if !toggle.of(self.board().is_open()) {
                    self.board.open = false;
                    return None;
                }
                self.show_board();
                if self.board.entries.is_empty() {
                    self.board.entries.push(own);
                }
            }
            BoardCommand::AddA => return self.add_to_board(&[]).err().map(Err),
            BoardCommand::Add(changes) => return self.add_to_board(&changes).err().map(Err),
            BoardCommand::Vary(axis) => return self.vary_on_board(&axis).err().map(Err),
            BoardCommand::Remove(index) => {
                let Some(entry) = self.board.sorted().get(index).copied() else {
                    return Some(Err(self.no_tile(index)));
                };
                self.board.entries.retain(|known| *known != entry);
            }
            BoardCommand::Clear => self.clear_board(),
            BoardCommand::Sort(sort) => self.board.sort = sort,
            BoardCommand::SetSide(side) => self.board.side = side.clamp(SIDES[0], SIDES[2]),
            BoardCommand::MakeA(index) => {
                let Some(entry) = self.board.sorted().get(index).copied() else {
                    return Some(Err(self.no_tile(index)));
                };
                let outline = self.settings.render.outline;
                self.settings.render = RenderSettings {
                    outline,
                    ..entry.render
                };
                self.settings.dialect = entry.dialect;
            }
            BoardCommand::Copy(format) => return Some(self.board().copied(format)),
            BoardCommand::Save => match self.board().saved() {
                Ok(work) => self.export.saver.push(work),
                Err(problem) => return Some(Err(problem)),
            },
        }
        self.chrome.hidden &= !self.board.open;
        None
    }

    /// Said where the board has no tile with this index.
    fn no_tile(&self, index: usize) -> String {
        no_such("tile", index, "the board", self.board.entries.len())
    }

    /// The settings of A with these changes become an entry.
    fn add_to_board(&mut self, changes: &[SettingChange]) -> Result<(), String> {
        let (entry, remark) = BoardEntry::of(&self.settings).changed(changes);
        if let Some(remark) = remark {
            self.chrome.messages.error(remark);
        }
        self.board.add(entry)?;
        self.show_board();
        Ok(())
    }

    /// An entry for each value of a setting takes the place of all others.
    fn vary_on_board(&mut self, axis: &Axis) -> Result<(), String> {
        let own = BoardEntry::of(&self.settings);
        let mut entries = own.vary(axis)?;
        if let Some(remark) = own.not_as_asked(axis) {
            self.chrome.messages.error(remark);
        }
        let count = entries.len();
        entries.truncate(MAX_ENTRIES);
        if count > MAX_ENTRIES {
            self.chrome.messages.done(first_of(axis, count));
        }
        self.board.fill(entries);
        self.show_board();
        Ok(())
    }

    fn show_board(&mut self) {
        // No card is open beside an open board.
        if !std::mem::replace(&mut self.board.open, true) {
            let cards = [
                (self.profiling.open, Displaced::Profile),
                (self.spectrum.open, Displaced::Spectrum),
            ];
            self.board.displaced = cards.into_iter().find_map(|(is_open, card)| is_open.then_some(card));
        }
        self.chrome.hidden = false;
        // Cards would lie on each other.
        self.profiling.show(false);
        self.spectrum.open = false;
    }

    /// Has measured what is to be seen of the board; gives up what is not any more.
    pub(in crate::viewer) fn want_board(&mut self) {
        match self.board().question() {
            Some(question) => self.board.measuring.want(question),
            None => self.board.measuring.pause(),
        }
    }
}
