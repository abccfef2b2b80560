//! Pictures from outside as B: read and decoded in the thread that measures, by the same reader as `rasterscope diff`.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use super::super::background::guarded;
use super::super::typed::path;
use super::super::{Viewer, picture};
use super::{Against, Arrangement, Other};
use crate::color::ResolveSpace;
use crate::compare;
use crate::raster::Framebuffer;
use crate::scene::FolderResources;

/// A picture from outside.
#[derive(Clone, Debug, PartialEq)]
pub struct OutsidePicture {
    /// Its file.
    pub path: PathBuf,
    /// Its pixels.
    pub pixels: Framebuffer,
}

/// A picture that was read, or not.
#[derive(Debug)]
pub(in super::super) struct ReadPicture {
    path: PathBuf,
    result: Result<Framebuffer, String>,
}

impl AsRef<Framebuffer> for OutsidePicture {
    fn as_ref(&self) -> &Framebuffer {
        &self.pixels
    }
}

impl OutsidePicture {
    /// The file's name without its folder.
    pub fn name(&self) -> String {
        match self.path.file_name() {
            Some(name) => name.to_string_lossy().into_owned(),
            None => self.path.display().to_string(),
        }
    }
}

/// Whether a path names a picture and no scene.
pub(in super::super) fn is_picture(path: &Path) -> bool {
    let endings = ["png", "jpg", "jpeg"];
    let ending = path.extension();
    ending.is_some_and(|ending| endings.iter().any(|known| ending.eq_ignore_ascii_case(known)))
}

impl ReadPicture {
    /// Reads and decodes a file.
    pub(super) fn read(path: PathBuf) -> Self {
        let name = path.display();
        let result = guarded(|| {
            let bytes = FolderResources::read_file(&path)
                .map_err(|error| format!("{name}: {error}; give a PNG or JPEG picture"))?;
            compare::decode_picture(&bytes)
                .map_err(|error| format!("{name}: cannot be read as a picture: {error}; give a whole PNG or JPEG"))
        });
        let result = result.unwrap_or_else(|| {
            Err(format!(
                "{name}: reading this picture failed inside the program; please report it with the file"
            ))
        });
        Self { path, result }
    }
}

impl Viewer {
    /// The picture that is being read as B.
    pub fn loading_picture(&self) -> Option<&Path> {
        self.comparison.loading.as_deref()
    }

    pub(super) fn load_picture(&mut self, path: PathBuf) {
        match self.comparison.measuring.load(path.clone()) {
            Ok(()) => self.comparison.loading = Some(path),
            Err(error) => self.messages.error(format!(
                "{}: cannot be read: {error}; close other programs",
                path.display()
            )),
        }
    }

    /// Takes in a picture that was read; the newest wish counts.
    pub(in super::super) fn picture_read(&mut self, read: ReadPicture) {
        if self.comparison.loading.as_ref() != Some(&read.path) {
            return;
        }
        self.comparison.loading = None;
        match read.result {
            Ok(pixels) if pixels.pixels().is_empty() => {
                let name = read.path.display();
                self.messages
                    .error(format!("{name}: has no pixels; give another picture"));
            }
            Ok(pixels) => {
                self.messages.forget_problems_of(&read.path.display().to_string());
                let picture = Arc::new(OutsidePicture {
                    path: read.path,
                    pixels,
                });
                let [width, height] = [picture.pixels.width(), picture.pixels.height()];
                self.messages.done(format!(
                    "B is {}; A is drawn with its size, {width} x {height} pixels",
                    picture.name()
                ));
                self.set_other(Some(Other::Picture(picture)));
                self.show_somehow();
            }
            Err(problem) => self.messages.error(problem),
        }
    }

    /// Compares with this, and shows it at once.
    pub(in super::super) fn compare_from_the_start(&mut self, against: Against) {
        let settings = against == Against::Settings;
        self.compare(against);
        // A picture is shown when it was read.
        if settings {
            self.show_somehow();
        }
    }

    /// What was asked for is to be seen at once: as a wipe, unless both share the window already.
    pub(super) fn show_somehow(&mut self) {
        if self.comparison.arrangement == Arrangement::Alone {
            self.arrange(Arrangement::Wipe);
        }
    }
}

impl Against {
    /// What a person writes: `settings`, `truth`, `truth stored`, `truth linear`, `none`, settings such as `sample-rate 16,
    /// dialect svg`, or the path of a picture; nothing for no text and for settings that are none.
    pub fn from_text(text: &str) -> Option<Self> {
        match text {
            "" => None,
            text if picture::are_meant(text) => picture::parse_changes(text).map(Self::Changed),
            "settings" => Some(Self::Settings),
            "truth" => Some(Self::Truth(None)),
            "truth stored" => Some(Self::Truth(Some(ResolveSpace::Stored))),
            "truth linear" => Some(Self::Truth(Some(ResolveSpace::Linear))),
            "none" => Some(Self::Nothing),
            text => Some(Self::File(path(text))),
        }
    }
}
