//! The list of scenes: which is shown, and what was read of them.

use std::collections::HashMap;
use std::path::PathBuf;
use std::sync::Arc;

use crate::geometry::View;
use crate::scene::{Dialect, Scene};
use crate::viewer::library::readers::Readers;
use crate::viewer::library::{SceneEntry, SceneSource};

/// Files that are kept as opened.
const MOST_OPENED: usize = 12;

/// The list of scenes, and what reads them.
#[derive(Debug)]
pub struct SceneList {
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
    /// Which scene was told to be broken, and its address.
    pub(in crate::viewer) told_broken: Option<((usize, u64), String)>,
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
            told_broken: None,
        }
    }

    /// The address of the scene that was told to be broken, once another one is shown.
    pub(in crate::viewer) fn left_broken(&mut self) -> Option<String> {
        let now = self.identity();
        let (_, address) = self.told_broken.take_if(|(broken, _)| *broken != now)?;
        Some(address)
    }

    /// All scenes, in the order of the list.
    pub fn scenes(&self) -> &[SceneEntry] {
        &self.scenes
    }

    /// The place of the current scene in the list.
    pub fn current_index(&self) -> usize {
        self.current
    }

    /// Files and folders that were opened, by this program or by earlier ones, the latest first.
    pub fn opened(&self) -> &[PathBuf] {
        &self.opened
    }

    /// Whether files are to be read again when they change on the disk.
    pub fn follows_files(&self) -> bool {
        self.follows_files
    }

    /// What the current scene says about itself.
    pub fn words(&self) -> Option<&str> {
        self.current()?.scene()?.words.as_deref()
    }

    /// Whether the current scene could not be read, so that there is nothing to look at.
    pub fn has_no_picture(&self) -> bool {
        self.current().is_some_and(SceneEntry::has_no_picture)
    }

    /// The files that the current scene was read from: its own and those of its textures.
    pub(in crate::viewer) fn files(&self) -> Vec<PathBuf> {
        let Some((entry, SceneSource::File(document))) = self.current().map(|entry| (entry, &entry.source)) else {
            return Vec::new();
        };
        let textures = entry.scene().into_iter().flat_map(|scene| entry.source.textures(scene));
        std::iter::once(document.clone()).chain(textures).collect()
    }

    /// Whether a thread reads the current scene.
    pub(in crate::viewer) fn is_reading(&self) -> bool {
        self.current().is_some_and(SceneEntry::is_reading)
    }

    /// The same, in A's dialect or in B's.
    pub(in crate::viewer) fn is_reading_any(&self) -> bool {
        self.current()
            .is_some_and(|entry| entry.is_reading() || entry.is_read_for_b())
    }

    /// The name of the current scene; empty without one.
    pub(in crate::viewer) fn label(&self) -> String {
        self.current().map_or(String::new(), |entry| entry.label.clone())
    }

    /// The scene that is shown; `None` only while the list is empty.
    pub fn current(&self) -> Option<&SceneEntry> {
        self.scenes.get(self.current)
    }

    /// Its scene, as A reads it, once that was read.
    pub fn scene(&self) -> Option<&Scene> {
        self.current()?.scene().map(Arc::as_ref)
    }

    pub(in crate::viewer) fn current_mut(&mut self) -> Option<&mut SceneEntry> {
        self.scenes.get_mut(self.current)
    }

    /// Tells the current scene from all others, also from those of earlier lists.
    pub(in crate::viewer) fn identity(&self) -> (usize, u64) {
        (self.current, self.generation)
    }

    /// Takes up what was opened earlier.
    pub(in crate::viewer) fn remember_opened(&mut self, earlier: &[PathBuf]) {
        let now = std::mem::take(&mut self.opened);
        self.note_opened(earlier);
        self.note_opened(&now);
    }

    /// Notes that these were opened, the first as the latest.
    pub(in crate::viewer) fn note_opened(&mut self, paths: &[PathBuf]) {
        for path in paths.iter().rev() {
            // The program may start in another folder next time.
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

    /// Shows the scene `by` places further on, round and round.
    pub(in crate::viewer) fn step(&mut self, by: usize) {
        if !self.scenes.is_empty() {
            self.show((self.current + by) % self.scenes.len());
        }
    }
}
