//! Which scene is shown, and when documents are read, drawn as thumbnails and let go.

use crate::viewer::library::readers::{Order, ReadScene, Side, Thumbnail};
use crate::viewer::library::{SceneSource, SceneState};
use crate::viewer::state::Viewer;

/// Scenes kept in memory besides the current one.
const KEPT: usize = 3;

impl Viewer {
    /// Sees to it that the current scene is read in the dialect that is set, and in B's.
    pub(in crate::viewer) fn want_scene(&mut self) {
        let Some(entry) = self.scene_list.scenes.get(self.scene_list.current) else {
            return;
        };
        match entry.state.dialect() {
            None => self.read_current(),
            Some(dialect) if dialect != self.reading_of(self.scene_list.current, self.settings.dialect) => {
                self.read_for(Side::A);
            }
            Some(_) => {}
        }
        self.let_go_of_old_scenes();
        self.want_other_scene();
    }

    /// The same for B where it has a dialect of its own; else B shares A's scene.
    fn want_other_scene(&mut self) {
        let own = self.own_dialect_of_b();
        let wanted = own.map(|dialect| self.reading_of(self.scene_list.current, dialect));
        let Some(entry) = self.scene_list.scenes.get_mut(self.scene_list.current) else {
            return;
        };
        match wanted {
            None => entry.other_state = SceneState::Unread,
            Some(dialect) if entry.other_state.dialect() != Some(dialect) => self.read_for(Side::B),
            Some(_) => {}
        }
    }

    /// Reads the current scene again.
    pub(in crate::viewer) fn read_current(&mut self) {
        self.scene_list.documents += 1;
        let documents = self.scene_list.documents;
        let Some(entry) = self.scene_list.scenes.get_mut(self.scene_list.current) else {
            return;
        };
        entry.document = documents;
        self.read_for(Side::A);
        if self.own_dialect_of_b().is_some() {
            self.read_for(Side::B);
        }
    }

    /// Reads the current scene for one side, in its dialect.
    fn read_for(&mut self, side: Side) {
        let (generation, index) = (self.scene_list.generation, self.scene_list.current);
        let dialect = match side {
            Side::A => self.settings.dialect,
            Side::B => self.own_dialect_of_b().unwrap_or(self.settings.dialect),
        };
        let dialect = self.reading_of(index, dialect);
        let Some(entry) = self.scene_list.scenes.get_mut(index) else {
            return;
        };
        let state = side.state(entry);
        let before = state.scene().cloned();
        *state = SceneState::Reading { dialect, before };
        let order = Order {
            generation,
            index,
            document: entry.document,
            source: entry.source.clone(),
            dialect,
            scene: None,
        };
        if side == Side::B {
            self.scene_list.readers.scenes.push(order);
            return;
        }
        for order in self.scene_list.readers.scenes.replace(order) {
            let forgotten = self
                .scene_list
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

    /// Takes in a scene that was read. One that is no longer shown is kept, if it was read as the settings say.
    pub(in crate::viewer) fn scene_read(&mut self, read: ReadScene) {
        let is_current = read.index == self.scene_list.current;
        let Some(entry) = self.scene_list.scenes.get_mut(read.index) else {
            return;
        };
        let dialect = read.dialect;
        let is_newest = read.generation == self.scene_list.generation && read.document == entry.document;
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
        if is_current || read.result.is_ok() {
            self.chrome.messages.forget_problems_of(&entry.source.address());
        }
        *side.state(entry) = match read.result {
            Ok(scene) => SceneState::Ready { scene, dialect },
            Err(message) => {
                // Over a picture that stays it is to be seen for as long as it is so.
                if is_current && (before.is_none() || self.chrome.hidden) {
                    self.chrome.messages.error(message.clone());
                }
                SceneState::Failed {
                    message,
                    dialect,
                    before,
                }
            }
        };
        if draws_again {
            self.request_thumbnail(read.index);
        }
    }

    /// Keeps the current scene and the ones shown last; the others are read again when they are asked for.
    fn let_go_of_old_scenes(&mut self) {
        let current = self.scene_list.current;
        if self.scene_list.recent.last() == Some(&current) {
            return;
        }
        for index in &self.scene_list.recent {
            if let Some(entry) = self.scene_list.scenes.get_mut(*index) {
                entry.other_state = SceneState::Unread;
            }
        }
        self.scene_list.recent.retain(|index| *index != current);
        self.scene_list.recent.push(current);
        while self.scene_list.recent.len() > KEPT + 1 {
            let oldest = self.scene_list.recent.remove(0);
            if let Some(entry) = self.scene_list.scenes.get_mut(oldest) {
                entry.state = SceneState::Unread;
            }
        }
    }

    /// Asks for the thumbnail of a scene in the list: it is read and drawn when nothing else is to be done, and stands
    /// in [`crate::viewer::library::SceneEntry::thumbnail`] then. To be called for the scenes that a panel shows.
    pub fn request_thumbnail(&mut self, index: usize) {
        let generation = self.scene_list.generation;
        let dialect = self.reading_of(index, self.settings.dialect);
        let Some(entry) = self
            .scene_list
            .scenes
            .get_mut(index)
            .filter(|entry| !entry.thumbnail_asked)
        else {
            return;
        };
        entry.thumbnail_asked = true;
        self.scene_list.readers.pending_thumbnails += 1;
        self.scene_list.readers.thumbnails.push(Order {
            generation,
            index,
            document: entry.document,
            source: entry.source.clone(),
            dialect,
            scene: entry.scene().cloned(),
        });
    }

    pub(in crate::viewer) fn thumbnail_drawn(&mut self, thumbnail: Thumbnail) {
        self.scene_list.readers.pending_thumbnails = self.scene_list.readers.pending_thumbnails.saturating_sub(1);
        let in_list = thumbnail.generation == self.scene_list.generation;
        if let Some(entry) = self.scene_list.scenes.get_mut(thumbnail.index).filter(|_| in_list) {
            entry.thumbnail = thumbnail.picture;
        }
    }
}
