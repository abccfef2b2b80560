//! The list of scenes: which is shown, and what was read of them.

use std::collections::HashMap;
use std::path::PathBuf;

use crate::geometry::View;
use crate::scene::Dialect;
use crate::viewer::library::SceneEntry;
use crate::viewer::library::readers::Readers;

/// Files that are kept as opened.
const MOST_OPENED: usize = 12;

/// The list of scenes, and what reads them.
#[derive(Debug)]
pub(in crate::viewer) struct SceneList {
    pub(in crate::viewer) scenes: Vec<SceneEntry>,
    /// The dialects that were chosen for the scenes of folders.
    pub(in crate::viewer) chosen_readings: HashMap<PathBuf, Dialect>,
    /// Below `scenes.len()`, unless there are none.
    pub(in crate::viewer) current: usize,
    /// Grows when the list is replaced: results for an older list are dropped.
    pub(in crate::viewer) generation: u64,
    /// Documents that were read so far.
    pub(in crate::viewer) documents: u64,
    /// The scenes shown last, latest last: the others are let go to save memory.
    pub(in crate::viewer) recent: Vec<usize>,
    /// Files and folders that were opened, the latest first.
    pub(in crate::viewer) opened: Vec<PathBuf>,
    /// Whether files are read again when they change on the disk.
    pub(in crate::viewer) follows_files: bool,
    /// The view that every scene begins with.
    pub(in crate::viewer) start_view: View,
    pub(in crate::viewer) readers: Readers,
}

impl SceneList {
    /// An empty list.
    pub(in crate::viewer) fn new(start_view: View, readers: Readers) -> Self {
        Self {
            scenes: Vec::new(),
            chosen_readings: HashMap::new(),
            current: 0,
            generation: 0,
            documents: 0,
            recent: Vec::new(),
            opened: Vec::new(),
            follows_files: true,
            start_view,
            readers,
        }
    }

    /// The scene that is shown; `None` only while the list is empty.
    pub(in crate::viewer) fn current(&self) -> Option<&SceneEntry> {
        self.scenes.get(self.current)
    }

    /// Notes that these were opened, the first as the latest.
    pub(in crate::viewer) fn note_opened(&mut self, paths: &[PathBuf]) {
        for path in paths.iter().rev() {
            // Another session starts in another folder.
            let Ok(path) = std::path::absolute(path) else { continue };
            self.opened.retain(|before| *before != path);
            self.opened.insert(0, path);
        }
        self.opened.truncate(MOST_OPENED);
    }

    /// Shows the scene at `index`; nothing happens where there is none.
    pub(in crate::viewer) fn show(&mut self, index: usize) {
        if index < self.scenes.len() {
            self.current = index;
        }
    }

    /// Shows the scene so many places on, round and round.
    pub(in crate::viewer) fn step(&mut self, by: usize) {
        if !self.scenes.is_empty() {
            self.show((self.current + by) % self.scenes.len());
        }
    }
}
