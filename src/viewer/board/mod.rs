//! The board: up to nine settings side by side, each as a tile of the same region, beside the truth.

pub(in crate::viewer) mod entry;
pub(in crate::viewer) mod measure;
pub(in crate::viewer) mod measuring;
pub(in crate::viewer) mod numbers;
pub(in crate::viewer) mod report;

use crate::viewer::board::entry::{BoardEntry, MAX_ENTRIES};
use crate::viewer::board::measuring::BoardMeasuring;
use crate::viewer::board::numbers::BoardSort;

/// Pixels along each side of the region: at least, at first, at most.
pub(in crate::viewer) const SIDES: [u32; 3] = [16, 64, 256];

/// The state of the board.
#[derive(Debug)]
pub(in crate::viewer) struct Board {
    /// Whether it is to be seen.
    pub(in crate::viewer) open: bool,
    /// In the order in which they were added.
    pub(in crate::viewer) entries: Vec<BoardEntry>,
    pub(in crate::viewer) sort: BoardSort,
    /// Pixels along each side of the region.
    pub(in crate::viewer) side: u32,
    /// What it took the place of when it was opened, and gives back to Esc.
    pub(in crate::viewer) displaced: Option<Displaced>,
    /// How often all entries were replaced.
    pub(in crate::viewer) fillings: u64,
    pub(in crate::viewer) measuring: BoardMeasuring,
}

/// A card that lies where the board does.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::viewer) enum Displaced {
    Profile,
    Spectrum,
}

impl Board {
    pub(in crate::viewer) fn new(measuring: BoardMeasuring) -> Self {
        Self {
            open: false,
            entries: Vec::new(),
            sort: BoardSort::default(),
            side: SIDES[1],
            displaced: None,
            fillings: 0,
            measuring,
        }
    }

    /// Adds an entry.
    ///
    /// # Errors
    /// One line when there is no room, or it is there already.
    pub(in crate::viewer) fn add(&mut self, entry: BoardEntry) -> Result<(), String> {
        if self.entries.iter().any(|known| known.is_like(entry)) {
            return Err("the board has these settings already; change one, then add them".to_owned());
        }
        if let Some(problem) = self.entries.iter().find_map(|known| known.mistaken_for(entry)) {
            return Err(problem);
        }
        if self.entries.len() >= MAX_ENTRIES {
            return Err(format!("the board holds {MAX_ENTRIES} settings; remove one first"));
        }
        self.entries.push(entry);
        Ok(())
    }

    /// Puts these entries in the place of all others.
    pub(in crate::viewer) fn fill(&mut self, entries: Vec<BoardEntry>) {
        self.entries = entries;
        self.fillings += 1;
    }

    /// The entries in the order in which they are shown.
    pub(in crate::viewer) fn sorted(&self) -> Vec<BoardEntry> {
        let mut entries = self.entries.clone();
        let numbers = |entry: &BoardEntry| self.measuring.tile(*entry).map(|(tile, _)| &tile.numbers);
        entries.sort_by(|a, b| self.sort.order(numbers(a), numbers(b)));
        entries
    }

    /// Closes it; true if it was open.
    pub(in crate::viewer) fn escape(&mut self) -> bool {
        std::mem::take(&mut self.open)
    }
}
