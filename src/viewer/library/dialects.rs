//! What the two readings of a document tell about it.

use std::path::Path;

use crate::viewer::library::{SceneEntry, SceneSource};

impl SceneEntry {
    /// The folder for which a reading is chosen: the one that the scene lies in. The gallery's scenes say what they are.
    pub(in crate::viewer) fn folder(&self) -> Option<&Path> {
        match &self.source {
            SceneSource::File(path) => path.parent(),
            SceneSource::Gallery(_) => None,
        }
    }
}
