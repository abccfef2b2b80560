//! Which scene is shown, and when documents are read, drawn as thumbnails and let go.

use std::time::Instant;

use crate::plain;
use crate::scene::{DialectChoice, Problem, Progress};
use crate::viewer::chrome::Chrome;
use crate::viewer::library::dialects::WantedDialects;
use crate::viewer::library::readers::{Order, ReadScene, Side, Thumbnail};
use crate::viewer::library::state::SceneList;
use crate::viewer::library::{ReadFailure, SceneEntry, SceneSource, SceneState};

/// Scenes kept in memory besides the current one.
const KEPT: usize = 3;

impl SceneList {
    /// Sees to it that the current scene is read in the dialect that is set, and in B's.
    pub(in crate::viewer) fn want(&mut self, dialects: WantedDialects) {
        let Some(entry) = self.current() else { return };
        let is_shown_anew = self.recent.last() != Some(&self.current);
        match entry.state.dialect() {
            None => self.read_current(dialects),
            Some(_) if is_shown_anew && self.follows_files && entry.is_stale() => self.read_current(dialects),
            Some(dialect) if dialect != self.reading_of(self.current, dialects.own) => {
                self.read_for(Side::A, dialects);
            }
            Some(_) => {}
        }
        self.let_go_of_old_scenes();
        self.want_for_b(dialects);
    }

    /// The same for B where it has a dialect of its own; else B shares A's scene.
    fn want_for_b(&mut self, dialects: WantedDialects) {
        let wanted = dialects.other.map(|dialect| self.reading_of(self.current, dialect));
        let Some(entry) = self.current_mut() else { return };
        match wanted {
            None => entry.other_state = SceneState::Unread,
            Some(dialect) if entry.other_state.dialect() != Some(dialect) => self.read_for(Side::B, dialects),
            Some(_) => {}
        }
    }

    /// Reads the current scene again.
    pub(in crate::viewer) fn read_current(&mut self, dialects: WantedDialects) {
        self.documents += 1;
        let documents = self.documents;
        let Some(entry) = self.current_mut() else { return };
        entry.document = documents;
        self.read_for(Side::A, dialects);
        if dialects.other.is_some() {
            self.read_for(Side::B, dialects);
        }
    }

    /// Reads the current scene for one side, in its dialect.
    fn read_for(&mut self, side: Side, dialects: WantedDialects) {
        let (generation, index) = (self.generation, self.current);
        let dialect = match side {
            Side::A => dialects.own,
            Side::B => dialects.other.unwrap_or(dialects.own),
        };
        let dialect = self.reading_of(index, dialect);
        let Some(entry) = self.scenes.get_mut(index) else {
            return;
        };
        let state = side.state(entry);
        let before = state.scene().cloned();
        if let SceneState::Reading { progress, .. } = state {
            progress.give_up();
        }
        let progress = Progress::default();
        *state = SceneState::Reading {
            dialect,
            before,
            progress: progress.clone(),
            since: Instant::now(),
        };
        let order = Order {
            generation,
            index,
            document: entry.document,
            source: entry.source.clone(),
            dialect,
            progress,
            scene: None,
        };
        if side == Side::B {
            self.readers.scenes.push(order);
            return;
        }
        for order in self.readers.scenes.replace(order) {
            let forgotten = self
                .scenes
                .get_mut(order.index)
                .filter(|_| order.generation == generation);
            let again = order.index == index && order.dialect == dialect;
            if let Some((side, entry)) = forgotten
                .filter(|_| !again)
                .and_then(|entry| Some((Side::reading(entry, order.dialect)?, entry)))
            {
                *side.state(entry) = SceneState::Unread;
            }
        }
    }

    /// Gives up the current scene, if its reading takes long; false where none does.
    pub(in crate::viewer) fn give_up_reading(&mut self) -> bool {
        let Some(entry) = self.current_mut().filter(|entry| entry.long_reading().is_some()) else {
            return false;
        };
        let address = entry.source.address();
        if let SceneState::Reading {
            dialect,
            before,
            progress,
            ..
        } = &entry.state
        {
            progress.give_up();
            let message = format!("{}: {}", plain::line(&address), Problem::GivenUp);
            entry.stamps = None;
            entry.state = SceneState::Failed {
                why: ReadFailure { message, line: None },
                dialect: *dialect,
                before: before.clone(),
            };
        }
        true
    }

    /// Takes in a scene that was read. One that is no longer shown is kept, if it was read as the settings say; `choice` is the
    /// dialect that they say now.
    pub(in crate::viewer) fn take_in(&mut self, read: ReadScene, choice: DialectChoice, chrome: &mut Chrome) {
        let is_current = read.index == self.current;
        let Some(entry) = self.scenes.get_mut(read.index) else {
            return;
        };
        let dialect = read.dialect;
        let is_newest = read.generation == self.generation && read.document == entry.document;
        let Some(side) = Side::reading(entry, dialect).filter(|_| is_newest) else {
            return;
        };
        // A scene that was read again may look different in small too, and so may a file that was let go meanwhile. The old
        // thumbnail stays until the new one is there.
        let was_read = entry.scene().is_some();
        let is_stale = side == Side::A && (was_read || matches!(entry.source, SceneSource::File(_)));
        let draws_again = is_stale && entry.thumbnail.is_some() && read.result.is_ok();
        if side == Side::A {
            entry.thumbnail_asked &= !was_read && !draws_again;
        }
        let before = side.state(entry).scene().cloned();
        // A picture in one dialect says nothing of a document that cannot be read in the other.
        let before = before.filter(|scene| side == Side::A && dialect.allows(scene.dialect));
        if side == Side::A && read.result.is_err() && before.is_none() {
            entry.thumbnail = None;
        }
        if side == Side::A {
            entry.stamps = Some(read.stamps);
        }
        if is_current || read.result.is_ok() {
            chrome.messages.forget_problems_of(&entry.source.address());
        }
        *side.state(entry) = match read.result {
            Ok(scene) => SceneState::Ready { scene, dialect },
            Err(why) => {
                // Over a picture that stays it is to be seen for as long as it is so.
                if is_current && (before.is_none() || chrome.hidden) {
                    chrome.messages.error(why.message.clone());
                    self.told_broken = Some(((self.current, self.generation), entry.source.address()));
                }
                SceneState::Failed { why, dialect, before }
            }
        };
        if draws_again {
            self.request_thumbnail(read.index, choice);
        }
    }

    /// Keeps the current scene and the ones shown last; the others are read again when they are asked for.
    fn let_go_of_old_scenes(&mut self) {
        let current = self.current;
        if self.recent.last() == Some(&current) {
            return;
        }
        for index in &self.recent {
            if let Some(entry) = self.scenes.get_mut(*index) {
                entry.other_state = SceneState::Unread;
            }
        }
        self.recent.retain(|index| *index != current);
        self.recent.push(current);
        while self.recent.len() > KEPT + 1 {
            let oldest = self.recent.remove(0);
            if let Some(entry) = self.scenes.get_mut(oldest) {
                entry.state = SceneState::Unread;
            }
        }
    }

    /// Asks for the thumbnail of a scene in the list: it is read and drawn when nothing else is to be done, and stands
    /// in [`crate::viewer::library::SceneEntry::thumbnail`] then. `choice` is the dialect that the settings say.
    pub(in crate::viewer) fn request_thumbnail(&mut self, index: usize, choice: DialectChoice) {
        let generation = self.generation;
        let dialect = self.reading_of(index, choice);
        // What is being read is not read a second time for its thumbnail, nor is what cannot be read: the panels ask again.
        let is_due = |entry: &&mut SceneEntry| !entry.thumbnail_asked && !entry.is_reading() && !entry.has_no_picture();
        let Some(entry) = self.scenes.get_mut(index).filter(is_due) else {
            return;
        };
        entry.thumbnail_asked = true;
        self.readers.pending_thumbnails += 1;
        self.readers.thumbnails.push(Order {
            generation,
            index,
            document: entry.document,
            source: entry.source.clone(),
            dialect,
            progress: Progress::default(),
            scene: entry.scene().cloned(),
        });
    }

    pub(in crate::viewer) fn thumbnail_drawn(&mut self, thumbnail: Thumbnail) {
        self.readers.pending_thumbnails = self.readers.pending_thumbnails.saturating_sub(1);
        let in_list = thumbnail.generation == self.generation;
        if let Some(entry) = self.scenes.get_mut(thumbnail.index).filter(|_| in_list) {
            entry.thumbnail = thumbnail.picture;
        }
    }
}
