//! Pictures from outside become B.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use crate::viewer::ab::other::{Against, Arrangement, Other};
use crate::viewer::ab::outside::{OutsidePicture, ReadPicture};
use crate::viewer::state::Viewer;

impl Viewer {
    /// The picture that is being read as B.
    pub fn loading_picture(&self) -> Option<&Path> {
        self.ab.loading.as_deref()
    }

    pub(in crate::viewer) fn load_picture(&mut self, path: PathBuf) {
        match self.ab.measuring.load(path.clone()) {
            Ok(()) => self.ab.loading = Some(path),
            Err(error) => self.chrome.messages.error(format!(
                "{}: cannot be read: {error}; close other programs",
                path.display()
            )),
        }
    }

    /// Takes in a picture that was read; the newest request counts.
    pub(in crate::viewer) fn picture_read(&mut self, read: ReadPicture) {
        if self.ab.loading.as_ref() != Some(&read.path) {
            return;
        }
        self.ab.loading = None;
        match read.result {
            Ok(pixels) if pixels.pixels().is_empty() => {
                let name = read.path.display();
                self.chrome
                    .messages
                    .error(format!("{name}: has no pixels; give another picture"));
            }
            Ok(pixels) => {
                self.chrome
                    .messages
                    .forget_problems_of(&read.path.display().to_string());
                let picture = Arc::new(OutsidePicture {
                    path: read.path,
                    pixels,
                });
                let [width, height] = [picture.pixels.width(), picture.pixels.height()];
                self.chrome.messages.done(format!(
                    "B is {}; A is drawn with its size, {width} x {height} pixels",
                    picture.name()
                ));
                self.set_other(Some(Other::Picture(picture)));
                self.show_somehow();
            }
            Err(problem) => self.chrome.messages.error(problem),
        }
    }

    /// Compares with this, and shows it at once.
    pub(in crate::viewer) fn compare_from_the_start(&mut self, against: Against) {
        let settings = against == Against::Settings;
        self.compare(against);
        // A picture is shown when it was read.
        if settings {
            self.show_somehow();
        }
    }

    /// What was asked for is to be seen at once: as a wipe, unless both share the window already.
    pub(in crate::viewer) fn show_somehow(&mut self) {
        if self.ab.arrangement == Arrangement::Alone {
            self.arrange(Arrangement::Wipe);
        }
    }
}
