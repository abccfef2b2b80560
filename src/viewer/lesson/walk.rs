//! A lesson that is open, and what comes back when it is closed.

use std::path::Path;

use glam::DVec2;

use crate::viewer::ab::comparison::Kept;
use crate::viewer::lesson::model::Lesson;
use crate::viewer::lesson::source::LessonSource;
use crate::viewer::library::state::SceneList;
use crate::viewer::library::{SceneEntry, SceneSource};
use crate::viewer::settings::Settings;
use crate::viewer::view::camera::Camera;

/// A lesson that is open.
#[derive(Debug)]
pub(in crate::viewer) struct Walk {
    pub(in crate::viewer) lesson: Lesson,
    /// Where it was read from, if from anywhere.
    pub(in crate::viewer) source: Option<LessonSource>,
    /// The step that is shown.
    pub(in crate::viewer) at: usize,
    /// For each step its place in the list of scenes.
    pub(in crate::viewer) scenes: Vec<usize>,
    /// Whether the step's view is to be set as soon as its scene was read.
    pub(in crate::viewer) view_pending: bool,
    /// The view as the step set it, and the free part of the frame that it was set for: while nobody moves it, it follows that
    /// part.
    pub(in crate::viewer) shown: Option<(Camera, [DVec2; 2])>,
    /// The scene that the user opened last since the lesson began: it stays when the lesson is closed.
    pub(in crate::viewer) opened: Option<SceneSource>,
    pub(in crate::viewer) before: Before,
}

impl Walk {
    /// Whether the scene is shown that the step speaks of, and not another one of the list.
    pub(in crate::viewer) fn shows_step(&self, scenes: &SceneList) -> bool {
        self.scenes.get(self.at) == Some(&scenes.current)
    }

    /// How many scenes of the list are the lesson's; the user opened those behind them.
    pub(in crate::viewer) fn own_scenes(&self) -> usize {
        self.scenes.iter().max().map_or(0, |last| last + 1)
    }

    /// Whether this is the view that the step set.
    pub(in crate::viewer) fn is_as_set(&self, camera: Option<Camera>) -> bool {
        self.shown.is_some_and(|(shown, _)| camera == Some(shown))
    }

    /// The file that it was read from, if from any.
    pub(in crate::viewer) fn file(&self) -> Option<&Path> {
        match self.source.as_ref()? {
            LessonSource::File(path) => Some(path),
            LessonSource::BuiltIn(_) => None,
        }
    }
}

/// What comes back when the lesson is closed.
#[derive(Debug)]
pub(in crate::viewer) struct Before {
    pub(in crate::viewer) scenes: Vec<SceneEntry>,
    pub(in crate::viewer) current: usize,
    pub(in crate::viewer) settings: Settings,
    pub(in crate::viewer) explanation: bool,
    pub(in crate::viewer) comparison: Kept,
    /// The pinned place of the current scene, in canvas units.
    pub(in crate::viewer) pin: Option<DVec2>,
    /// Whether the pixel inspector was open.
    pub(in crate::viewer) inspector: bool,
}
