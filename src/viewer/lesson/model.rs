//! A lesson: its steps, and what each of them shows.

use std::fmt;

use glam::DVec2;

use crate::viewer::ab::other::{Against, Arrangement};
use crate::viewer::lesson::markdown::Block;
use crate::viewer::library::SceneSource;
use crate::viewer::settings::picture::SettingChange;
use crate::viewer::view::camera::ViewNumbers;

/// A lesson.
#[derive(Clone, Debug, PartialEq)]
pub struct Lesson {
    /// Its name for people.
    pub title: String,
    /// What is shown, one after the other; at least one.
    pub steps: Vec<LessonStep>,
}

/// A step of a lesson.
#[derive(Clone, Debug, PartialEq)]
pub struct LessonStep {
    /// Its name for people; may be empty.
    pub title: String,
    /// What it says.
    pub text: Vec<Block>,
    /// What it shows.
    pub scene: SceneSource,
    /// The settings that differ from their defaults.
    pub settings: Vec<SettingChange>,
    /// From where; `None` is the whole canvas in the part of the window that is free.
    pub view: Option<ViewNumbers>,
    /// The pinned place, in canvas units.
    pub pin: Option<DVec2>,
    /// Whether it shows why the pinned pixel has its colour.
    pub explained: bool,
    /// What it is compared with, and how both share the window.
    pub against: Option<(Against, Arrangement)>,
}

/// Why a lesson cannot be read.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub struct LessonError {
    /// The lesson's file or name.
    pub file: String,
    /// Line and column from 1; none where the file as a whole is at fault.
    pub at: Option<[usize; 2]>,
    /// What is wrong, and the cure.
    pub problem: String,
}

impl fmt::Display for LessonError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.at {
            Some([line, column]) => write!(f, "{}:{line}:{column}: {}", self.file, self.problem),
            None => write!(f, "{}: {}", self.file, self.problem),
        }
    }
}
