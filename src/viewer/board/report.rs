//! A board for others: its table, its picture, and the words of the command line that makes it again.

use std::path::Path;

use crate::color::ResolveSpace;
use crate::figure::{Ground, Record, SheetPlan, Table, in_markdown, magnified};
use crate::raster::{Framebuffer, Region};
use crate::render::{milliseconds, time_words};
use crate::scene::Scene;
use crate::viewer::board::entry::{AS_A, BoardEntry, captions, differing, shared_words};
use crate::viewer::board::measure::{BoardPlace, BoardTile};
use crate::viewer::board::numbers::{BoardNumbers, BoardSort};
use crate::viewer::export::sheet::captions::title;
use crate::viewer::export::spec::{PictureSpec, RecipeOfCommand};

/// What the columns after those of the settings are called.
const COLUMNS: [&str; 3] = ["rmse", "flip", "time_ms"];
/// Tiles beside each other on a picture.
const ACROSS: usize = 5;
/// Pixels of a tile's width on a picture, about: captions need room.
const TILE: u32 = 256;

/// A board whose entries are measured, in the order in which they are shown.
#[derive(Debug)]
pub struct BoardReport<'a> {
    /// Of what, and beside which truth.
    pub place: &'a BoardPlace,
    /// The region of the truth.
    pub truth: &'a Framebuffer,
    /// The entries.
    pub rows: Vec<(BoardEntry, &'a BoardTile)>,
}

/// What `rasterscope board` is told besides the entries.
#[derive(Clone, Debug)]
pub struct BoardCommandLine {
    /// Size, view and settings of A.
    pub own: PictureSpec,
    /// The entries, in the order in which they were added.
    pub entries: Vec<BoardEntry>,
    /// What is compared.
    pub region: Region,
    /// By what entries are sorted.
    pub sort: BoardSort,
    /// In which values the truth is averaged, where not in A's.
    pub space: Option<ResolveSpace>,
    /// Ground and ink of the picture.
    pub ground: Ground,
    /// Frames whose time is taken, for each entry.
    pub frames: u32,
}

impl<'a> BoardReport<'a> {
    /// Puts the entries in order; those that were added first stay before others that are equal.
    pub fn new(
        place: &'a BoardPlace,
        truth: &'a Framebuffer,
        mut rows: Vec<(BoardEntry, &'a BoardTile)>,
        sort: BoardSort,
    ) -> Self {
        rows.sort_by(|(_, a), (_, b)| sort.order(Some(&a.numbers), Some(&b.numbers)));
        Self { place, truth, rows }
    }

    fn entries(&self) -> Vec<BoardEntry> {
        self.rows.iter().map(|(entry, _)| *entry).collect()
    }

    /// The settings that tell entries apart, a column each, and what was measured.
    pub fn table(&self) -> Table {
        let entries = self.entries();
        let told = differing(&entries);
        let names = told.iter().map(|setting| setting.option.replace('-', "_"));
        let head = names.chain(COLUMNS.map(str::to_owned)).collect();
        let line = |(entry, tile): &(BoardEntry, &BoardTile)| {
            let values = told
                .iter()
                .map(|setting| setting.short(&entry.value(setting)).to_owned());
            values.chain(cells(&tile.numbers)).collect()
        };
        Table {
            lines: std::iter::once(head).chain(self.rows.iter().map(line)).collect(),
        }
    }

    /// The same as Markdown, with a line below that says what was compared with what.
    pub fn markdown(&self) -> String {
        format!("{}\n{}\n", self.table().markdown(), in_markdown(&self.caption()))
    }

    /// What all entries have that is not at its default, as a sentence.
    fn shared(&self) -> String {
        match shared_words(&self.entries()).as_str() {
            "" => String::new(),
            words => format!(". In all: {words}"),
        }
    }

    /// That the region has nothing to compare: no entry differs from the truth there.
    pub fn is_without_difference(&self) -> bool {
        self.rows.iter().all(|(_, tile)| tile.pixels == *self.truth)
    }

    /// What was compared with what, and how the time was taken.
    pub fn caption(&self) -> String {
        let place = self.place;
        let [width, height] = place.truth.size;
        let shared = self.shared();
        let several = self.rows.iter().any(|(_, tile)| tile.frames > 1);
        let median = if several { "the median of several" } else { "drawn once" };
        format!(
            "{}: {} of {width} \u{d7} {height}{shared}. RMSE in levels and FLIP against the truth, {}. Time: of the whole frame, \
             {median}.",
            title(&place.truth.scene),
            place.region_words(),
            place.truth_words()
        )
    }

    /// The truth and all entries side by side, each pixel a square, with their numbers above.
    ///
    /// # Errors
    /// One line when it would be too large.
    pub fn picture(&self, ground: Ground) -> Result<Framebuffer, String> {
        let Region { width, height, .. } = self.place.region;
        let factor = (TILE / width.max(1)).max(1);
        let panel = [width, height].map(|side| side.saturating_mul(factor));
        let words = captions(&self.entries());
        let told = self.rows.iter().zip(words).map(|((_, tile), words)| {
            let BoardNumbers { rmse, flip, time } = tile.numbers;
            format!("{words}\nRMSE {rmse:.2}\nFLIP {flip:.4}, {}", time_words(time))
        });
        let first = format!("the truth\n{}", self.place.truth_words());
        let headers: Vec<String> = std::iter::once(first).chain(told).collect();
        let columns = headers.len().min(ACROSS);
        let plan = SheetPlan {
            panel,
            columns: vec![String::new(); columns],
            rows: vec![String::new(); headers.len().div_ceil(columns.max(1))],
            headers,
            caption: self.caption(),
            legend: None,
            ground,
        };
        let layout = plan
            .layout()
            .map_err(|problem| format!("{problem}; or compare a smaller region"))?;
        let tiles = self.rows.iter().map(|(_, tile)| &tile.pixels);
        let large: Vec<Framebuffer> = std::iter::once(self.truth)
            .chain(tiles)
            .map(|tile| magnified(tile, factor))
            .collect();
        Ok(layout.draw(&large.iter().collect::<Vec<_>>(), None))
    }
}

/// What is written of what was measured.
fn cells(numbers: &BoardNumbers) -> [String; 3] {
    [
        format!("{:.4}", numbers.rmse),
        format!("{:.6}", numbers.flip),
        format!("{:.4}", milliseconds(numbers.time)),
    ]
}

impl BoardCommandLine {
    /// Frames whose time is taken where nothing is said.
    pub const FRAMES: u32 = 5;

    /// Why its picture is not the same when it is made again.
    pub const DIFFERS: &str = "a picture with times, which differ from run to run";

    /// The words after the file that is written.
    pub fn options(&self) -> Vec<String> {
        let mut words = self.own.options();
        let own = BoardEntry {
            render: self.own.render,
            dialect: self.own.dialect,
        };
        for entry in &self.entries {
            let changes = entry.change_text(own);
            let text = if changes.is_empty() { AS_A.to_owned() } else { changes };
            words.extend(["--with".to_owned(), text]);
        }
        let Region { x, y, width, height } = self.region;
        words.push(format!("--region={x},{y},{width},{height}"));
        words.push(format!("--sort={}", self.sort.name()));
        words.extend(self.space.map(|space| format!("--truth-space={}", space.name())));
        if self.frames != Self::FRAMES {
            words.push(format!("--frames={}", self.frames));
        }
        if self.ground != Ground::default() {
            words.push(format!("--theme={}", self.ground.name()));
        }
        words
    }

    /// The record of the picture that is written to `output`.
    pub fn record(&self, scene: &Scene, output: &Path) -> Record {
        let mut record = self.own.record(scene, output);
        record.differs = Some(Self::DIFFERS.to_owned());
        self.recipe().put_into(&mut record, &self.own, output);
        record
    }

    /// The command, but for its files.
    pub(in crate::viewer) fn recipe(&self) -> RecipeOfCommand {
        RecipeOfCommand {
            verb: "board",
            options: self.options(),
        }
    }
}
