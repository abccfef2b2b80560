//! The files that are shown, followed on the disk: told when another program has saved them.
//!
//! Folders are watched, not files: editors write a new file and rename it, and what was deleted may come back.
//!
//! ```text
//! events of folders -> of files that are shown -> 120 ms without another -> told
//! ```

use std::collections::{BTreeMap, BTreeSet};
use std::ffi::OsString;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::mpsc::{Receiver, channel};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, Instant};

use notify::event::{AccessKind, AccessMode, MetadataKind, ModifyKind};
use notify::{Event, EventKind, RecommendedWatcher, RecursiveMode, Watcher as _};

use crate::viewer::Waker;

/// How long files rest before they are told: programs write in pieces.
const REST: Duration = Duration::from_millis(120);
/// When to look again for a folder that is gone.
const LOOK_AGAIN: Duration = Duration::from_secs(1);

/// What is watched, and what changed.
#[derive(Debug)]
pub(super) struct Watch {
    watcher: RecommendedWatcher,
    events: Receiver<notify::Result<Event>>,
    /// What the files and their folders are called.
    names: Arc<Mutex<BTreeSet<OsString>>>,
    /// As the viewer names them.
    files: Vec<PathBuf>,
    /// The same by their places on the disk, which events name.
    places: BTreeMap<PathBuf, PathBuf>,
    /// Folders that are watched.
    folders: BTreeSet<PathBuf>,
    changed: BTreeSet<PathBuf>,
    /// When they have rested.
    due: Option<Instant>,
    look_again: Option<Instant>,
}

impl Watch {
    /// Watches nothing yet; `wake` is called from another thread when something happened.
    ///
    /// # Errors
    /// When the system watches no files.
    pub(super) fn new(wake: Waker) -> notify::Result<Self> {
        let (sender, events) = channel();
        let names = Arc::new(Mutex::new(BTreeSet::new()));
        let listened = Arc::clone(&names);
        let watcher = notify::recommended_watcher(move |event: notify::Result<Event>| {
            // What happens to other files of a busy folder wakes nobody.
            let names = listened.lock().unwrap_or_else(PoisonError::into_inner);
            if event.as_ref().is_ok_and(|event| !may_matter(event, &names)) {
                return;
            }
            drop(names);
            // Nobody listens any more: the window closes.
            let _ = sender.send(event);
            wake();
        })?;
        Ok(Self {
            watcher,
            events,
            names,
            files: Vec::new(),
            places: BTreeMap::new(),
            folders: BTreeSet::new(),
            changed: BTreeSet::new(),
            due: None,
            look_again: None,
        })
    }

    /// Watches these files, of which the first decides what the others belong to: a texture that is missing for a moment is
    /// watched on, as long as its document is. Returns those that changed and rest by now.
    pub(super) fn turn(&mut self, files: Vec<PathBuf>) -> Vec<PathBuf> {
        self.follow(files);
        self.take_events();
        let now = Instant::now();
        if self.look_again.is_some_and(|at| at <= now) {
            self.look_again = None;
            self.watch_folders();
        }
        if self.due.is_none_or(|due| due > now) {
            return Vec::new();
        }
        self.due = None;
        std::mem::take(&mut self.changed).into_iter().collect()
    }

    /// When to come back though nothing happens.
    pub(super) fn due(&self) -> Option<Instant> {
        [self.due, self.look_again].into_iter().flatten().min()
    }

    fn follow(&mut self, mut files: Vec<PathBuf>) {
        if files.first() == self.files.first() {
            let missing = self.files.iter().filter(|file| !files.contains(file));
            let missing: Vec<PathBuf> = missing.cloned().collect();
            files.extend(missing);
        }
        if files == self.files {
            return;
        }
        let is_other = files.first() != self.files.first();
        self.files = files;
        if is_other {
            self.changed.clear();
            self.due = None;
        }
        self.watch_folders();
    }

    /// Watches the folders of all files, and no others. What a folder that comes back holds has changed.
    fn watch_folders(&mut self) {
        self.places.clear();
        let mut wanted = BTreeSet::new();
        let mut is_gone = false;
        for file in &self.files {
            let folder = file.parent().filter(|folder| !folder.as_os_str().is_empty());
            let named = fs::canonicalize(folder.unwrap_or(Path::new(".")));
            let named = named.ok().zip(file.file_name()).map(|(folder, name)| folder.join(name));
            is_gone |= named.is_none();
            // A link changes, and what it leads to.
            for place in named.into_iter().chain(fs::canonicalize(file).ok()) {
                wanted.extend(place.parent().map(Path::to_owned));
                self.places.insert(place, file.clone());
            }
        }
        let places = self.places.keys().chain(&wanted);
        let names = places
            .filter_map(|place| place.file_name().map(OsString::from))
            .collect();
        *self.names.lock().unwrap_or_else(PoisonError::into_inner) = names;
        for old in self.folders.difference(&wanted) {
            // It may be gone already.
            let _ = self.watcher.unwatch(old);
        }
        let before = std::mem::take(&mut self.folders);
        for folder in wanted {
            let is_watched =
                before.contains(&folder) || self.watcher.watch(&folder, RecursiveMode::NonRecursive).is_ok();
            if is_watched {
                self.folders.insert(folder);
            } else {
                is_gone = true;
            }
        }
        if is_gone {
            self.look_again = Instant::now().checked_add(LOOK_AGAIN);
        }
    }

    fn take_events(&mut self) {
        let events: Vec<notify::Result<Event>> = self.events.try_iter().collect();
        for event in events {
            let Ok(event) = event else {
                self.lose_folders(|_| true);
                continue;
            };
            if event.need_rescan() {
                self.note(self.files.clone());
            }
            if event.paths.iter().any(|path| self.folders.contains(path)) {
                self.lose_folders(|folder| event.paths.contains(folder));
            }
            let files = event
                .paths
                .iter()
                .filter_map(|path| self.places.get(path).cloned())
                .collect();
            self.note(files);
        }
    }

    /// These files changed.
    fn note(&mut self, files: Vec<PathBuf>) {
        if !files.is_empty() {
            self.changed.extend(files);
            self.due = Instant::now().checked_add(REST);
        }
    }

    /// Folders that are gone, or have other places now: what they hold is told, and they are looked for.
    fn lose_folders(&mut self, is_lost: impl Fn(&PathBuf) -> bool) {
        let (lost, kept): (BTreeSet<PathBuf>, BTreeSet<PathBuf>) =
            std::mem::take(&mut self.folders).into_iter().partition(is_lost);
        self.folders = kept;
        let holds = |place: &Path| place.parent().is_some_and(|folder| lost.contains(folder));
        let files = self.places.iter().filter(|(place, _)| holds(place));
        let files = files.map(|(_, file)| file.clone()).collect();
        for folder in &lost {
            // It may be gone already.
            let _ = self.watcher.unwatch(folder);
        }
        self.note(files);
        self.look_again = Instant::now().checked_add(LOOK_AGAIN);
    }
}

/// Whether an event may be about files of these names, or about their folders.
fn may_matter(event: &Event, names: &BTreeSet<OsString>) -> bool {
    let is_named = |path: &PathBuf| path.file_name().is_none_or(|name| names.contains(name));
    event.need_rescan() || (changes(event.kind) && event.paths.iter().any(is_named))
}

/// Whether a file may hold something else after an event: reading it is one, too.
fn changes(kind: EventKind) -> bool {
    match kind {
        EventKind::Access(access) => access == AccessKind::Close(AccessMode::Write),
        EventKind::Modify(ModifyKind::Metadata(what)) => what != MetadataKind::AccessTime,
        _ => true,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What is told within some seconds.
    fn told(watch: &mut Watch, files: &[PathBuf]) -> Vec<PathBuf> {
        let start = Instant::now();
        while start.elapsed() < Duration::from_secs(20) {
            let changed = watch.turn(files.to_vec());
            if !changed.is_empty() {
                return changed;
            }
            std::thread::sleep(Duration::from_millis(10));
        }
        Vec::new()
    }

    /// Whether nothing is told for as long as files rest, thrice.
    fn is_quiet(watch: &mut Watch, files: &[PathBuf]) -> bool {
        let start = Instant::now();
        while start.elapsed() < REST * 3 {
            if !watch.turn(files.to_vec()).is_empty() {
                return false;
            }
            std::thread::sleep(Duration::from_millis(10));
        }
        true
    }

    #[test]
    fn files_are_told_once_they_rest() {
        let folder = tempfile::tempdir().expect("a folder");
        let inside = folder.path().join("scenes");
        fs::create_dir(&inside).expect("a folder");
        let file = inside.join("a.svg");
        let files = [file.clone(), inside.join("texture.png")];
        let document = &files[..1];
        fs::write(&file, "1").expect("a file");
        let mut watch = Watch::new(Arc::new(|| {})).expect("files are watched");
        assert!(is_quiet(&mut watch, &files), "nothing at first");
        let _ = fs::read(&file);
        fs::write(inside.join("other.svg"), "1").expect("a file");
        assert!(
            is_quiet(&mut watch, &files),
            "reading changes nothing, nor do other files"
        );
        for piece in 0..10 {
            fs::write(&file, format!("{piece}")).expect("a file");
        }
        assert_eq!(told(&mut watch, &files), document, "written in pieces, told once");
        assert!(is_quiet(&mut watch, &files), "and not again");
        let draft = inside.join(".a.svg.new");
        fs::write(&draft, "2").expect("a file");
        fs::rename(&draft, &file).expect("renamed");
        assert_eq!(told(&mut watch, &files), document, "by a rename");
        fs::write(&files[1], "a texture").expect("a file");
        assert_eq!(
            told(&mut watch, &files),
            [files[1].clone()],
            "a file that was not there"
        );
        fs::remove_file(&files[1]).expect("removed");
        assert_eq!(told(&mut watch, document), [files[1].clone()], "gone");
        fs::write(&files[1], "again").expect("a file");
        assert_eq!(
            told(&mut watch, document),
            [files[1].clone()],
            "a texture is watched while it is missing"
        );
    }

    #[test]
    fn folders_that_come_back_are_watched_again() {
        let folder = tempfile::tempdir().expect("a folder");
        let inside = folder.path().join("scenes");
        let file = inside.join("a.svg");
        let files = [file.clone()];
        let mut watch = Watch::new(Arc::new(|| {})).expect("files are watched");
        for round in 0..2 {
            fs::create_dir(&inside).expect("a folder");
            fs::write(&file, "1").expect("a file");
            let start = Instant::now();
            while watch.folders.is_empty() && start.elapsed() < Duration::from_secs(20) {
                watch.turn(files.to_vec());
                std::thread::sleep(Duration::from_millis(10));
            }
            // What it brought back with it may be told first.
            is_quiet(&mut watch, &files);
            fs::write(&file, "2").expect("a file");
            assert_eq!(told(&mut watch, &files), files, "written in round {round}");
            is_quiet(&mut watch, &files);
            fs::remove_dir_all(&inside).expect("removed");
            assert_eq!(told(&mut watch, &files), files, "gone in round {round}");
        }
    }
}
