//! In which dialect scenes are read, and which one a folder was given by hand.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use crate::rules::Rules;
use crate::scene::{Dialect, DialectChoice, Scene};
use crate::viewer::library::state::SceneList;
use crate::viewer::library::{SceneEntry, SceneSource, SceneState};
use crate::viewer::settings::Settings;

/// In which dialects the current scene is to be read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::viewer) struct WantedDialects {
    /// A's, as the settings say.
    pub(in crate::viewer) own: DialectChoice,
    /// B's, where it is another one; else B shares A's scene.
    pub(in crate::viewer) other: Option<DialectChoice>,
}

/// What a command line has to say for a document to be read in `dialect` again, where `choice` led to that.
pub(in crate::viewer) fn told_dialect(choice: DialectChoice, rules: Rules, dialect: Dialect) -> DialectChoice {
    match (choice, rules, dialect) {
        // There the course's rules ask for the course's dialect.
        (DialectChoice::Auto, Rules::Course, Dialect::Svg) => DialectChoice::Svg,
        _ => choice,
    }
}

impl SceneEntry {
    /// The folder for which a reading is chosen: the one that the scene lies in. The gallery's scenes say what they are.
    pub(in crate::viewer) fn folder(&self) -> Option<&Path> {
        match &self.source {
            SceneSource::File(path) => path.parent(),
            SceneSource::Gallery(_) => None,
        }
    }
}

impl SceneList {
    /// How the scene at `index` is read where the settings say `choice`.
    pub(in crate::viewer) fn reading_of(&self, index: usize, choice: DialectChoice) -> DialectChoice {
        let Some(entry) = self.scenes.get(index).filter(|_| choice == DialectChoice::Auto) else {
            return choice;
        };
        let chosen = entry.folder().and_then(|folder| self.chosen_readings.get(folder));
        match chosen {
            Some(Dialect::Course) => DialectChoice::AmongCourse,
            Some(Dialect::Svg) => DialectChoice::Svg,
            None if entry.is_of_course => DialectChoice::AmongCourse,
            None => DialectChoice::Auto,
        }
    }

    /// The choice of dialect that makes the current picture from its file alone, where that was read as `scene`.
    pub(in crate::viewer) fn dialect_of_picture(
        &self,
        settings: &Settings,
        scene: Option<&Arc<Scene>>,
    ) -> DialectChoice {
        let choice = self.reading_of(self.current, settings.dialect);
        let Some(dialect) = scene.map(|scene| scene.dialect) else {
            return choice;
        };
        told_dialect(choice.anywhere(dialect), settings.render.rules, dialect)
    }

    /// Which reading the current scene has, in few words, where it may be meant in the other dialect.
    pub fn reading_words(&self) -> Option<String> {
        let scene = self.current()?.scene()?;
        scene.other_reading.map(|_| format!("read as {}", scene.dialect.name()))
    }

    /// Which reading the current scene has where it may be meant in the other dialect, and why, in one line; `choice` is what
    /// the settings say.
    pub fn reading_note(&self, choice: DialectChoice) -> Option<String> {
        let entry = self.current()?;
        let scene = entry.scene()?;
        let folder = entry.folder()?;
        let other = scene.other_reading?.name();
        let why = match choice {
            DialectChoice::Course | DialectChoice::Svg => ", as the setting says",
            _ if self.chosen_readings.contains_key(folder) => ", as you chose for its folder",
            _ if entry.is_of_course => ", as other scenes of its folder are",
            _ => "",
        };
        let taken = scene.dialect.name();
        Some(format!("read as {taken}{why}; as {other} it is another picture"))
    }

    /// Reads the current scene in the other dialect, and with it all of its folder; where the settings say a dialect, they say
    /// the other one then.
    pub(in crate::viewer) fn choose_other_reading(&mut self, setting: &mut DialectChoice) {
        let Some(entry) = self.current() else { return };
        let Some(scene) = entry.scene() else { return };
        let (other, choice) = match scene.dialect {
            Dialect::Course => (Dialect::Svg, DialectChoice::Svg),
            Dialect::Svg => (Dialect::Course, DialectChoice::Course),
        };
        let folder: Option<PathBuf> = entry.folder().map(Path::to_owned);
        let before = self.readings(*setting);
        match folder.filter(|_| *setting == DialectChoice::Auto) {
            Some(folder) => {
                self.chosen_readings.insert(folder, other);
            }
            None => *setting = choice,
        }
        for (index, (before, now)) in before.into_iter().zip(self.readings(*setting)).enumerate() {
            if index != self.current && before != now {
                self.read_anew(index, *setting);
            }
        }
    }

    /// How each scene is read where the settings say `choice`.
    fn readings(&self, choice: DialectChoice) -> Vec<DialectChoice> {
        let scenes = 0..self.scenes.len();
        scenes.map(|index| self.reading_of(index, choice)).collect()
    }

    /// Lets go of a scene that is read in another way now, and asks for its thumbnail again; the old one stays until then.
    fn read_anew(&mut self, index: usize, choice: DialectChoice) {
        let Some(entry) = self.scenes.get_mut(index).filter(|entry| !entry.is_reading()) else {
            return;
        };
        entry.state = SceneState::Unread;
        entry.thumbnail_asked = false;
        if entry.thumbnail.is_some() {
            self.request_thumbnail(index, choice);
        }
    }
}
