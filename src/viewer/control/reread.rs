//! Files that were saved, or that the user wants read again: scenes, lessons, the picture that A is compared with, sample
//! patterns.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use crate::viewer::ab::comparison::Comparison;
use crate::viewer::ab::other::Other;
use crate::viewer::control::open::Opening;
use crate::viewer::lesson::walk::Walk;
use crate::viewer::settings::picture::SettingChange;
use crate::viewer::settings::{Settings, patterns};
use crate::viewer::state::Viewer;

impl Viewer {
    /// The files that what is shown was read from: the scene's, those of its textures, the lesson's, the picture's that it is
    /// compared with, those of sample patterns.
    pub fn files(&self) -> Vec<PathBuf> {
        let mut files = self.scene_list.files();
        files.extend(self.lesson.as_ref().and_then(Walk::file).map(Path::to_owned));
        files.extend(self.ab.file_of_picture().map(Path::to_owned));
        files.extend(pattern_files(&self.settings, &self.ab));
        files
    }
}

impl Opening<'_> {
    /// Reads again what is shown of these files, unless the user does not want that.
    pub(in crate::viewer) fn files_changed(&mut self, files: &[PathBuf]) {
        if !self.scene_list.follows_files || files.is_empty() {
            return;
        }
        let lesson = self.lesson.as_ref().and_then(Walk::file).map(Path::to_owned);
        let picture = self.ab.file_of_picture().map(Path::to_owned);
        let patterns = pattern_files(self.settings, self.ab);
        let is_lesson = |file: &PathBuf| lesson.as_ref() == Some(file);
        let is_picture = |file: &PathBuf| picture.as_ref() == Some(file);
        if files.iter().any(is_lesson) {
            self.lessons().reload();
        }
        if files.iter().any(is_picture) {
            self.ab.read_picture_again(&mut self.chrome.messages);
        }
        for pattern in patterns.iter().filter(|pattern| files.contains(pattern)) {
            self.read_pattern_again(pattern);
        }
        let is_other = |file: &PathBuf| !is_lesson(file) && !is_picture(file) && !patterns.contains(file);
        // A picture may be a texture, too.
        let of_scene = self.scene_list.files();
        if files.iter().any(|file| is_other(file) || of_scene.contains(file)) {
            self.scene_list.read_current(self.ab.wanted_dialects(self.settings));
        }
    }

    /// Reads all of them again.
    pub(in crate::viewer) fn reload(&mut self) {
        self.scene_list.read_current(self.ab.wanted_dialects(self.settings));
        self.ab.read_picture_again(&mut self.chrome.messages);
        for pattern in pattern_files(self.settings, self.ab) {
            self.read_pattern_again(&pattern);
        }
    }

    /// A and B sample by what the file holds now, where they sample by it; where it holds no pattern, they stay as they are
    /// and the user is told.
    fn read_pattern_again(&mut self, file: &Path) {
        let change = patterns::of_file(file).and_then(|value| SettingChange::of("pattern", &value));
        let change = match change {
            Ok(change) => change,
            Err(problem) => return self.chrome.messages.error(problem),
        };
        self.chrome.messages.forget_problems_of(&file.display().to_string());
        follow(file, &change, self.settings);
        if let Some(Other::Settings { render, dialect }) = &mut self.ab.other {
            let mut other = Settings::of(*render, *dialect);
            follow(file, &change, &mut other);
            *render = other.render;
        }
    }
}

/// Makes the change where the pattern comes from this file; one that is only offered is offered as it is now.
fn follow(file: &Path, change: &SettingChange, settings: &mut Settings) {
    let is_of_file = |pattern| patterns::file_of(pattern).is_some_and(|own| own == file);
    if is_of_file(settings.render.pattern) {
        change.apply(settings);
    } else if settings.own_pattern.is_some_and(is_of_file) {
        let mut chosen = *settings;
        change.apply(&mut chosen);
        settings.own_pattern = chosen.own_pattern;
    }
}

/// The files of the patterns that A and B sample by, and of the one that lists offer.
fn pattern_files(settings: &Settings, ab: &Comparison) -> BTreeSet<PathBuf> {
    let of_b = match ab.other() {
        Some(Other::Settings { render, .. }) => Some(render.pattern),
        _ => None,
    };
    let patterns = [Some(settings.render.pattern), settings.own_pattern, of_b];
    patterns.into_iter().flatten().filter_map(patterns::file_of).collect()
}
