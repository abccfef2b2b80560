//! Pictures from outside as B: read and decoded in the thread that measures, by the same reader as `rasterscope diff`.

use std::path::{Path, PathBuf};

use crate::compare;
use crate::raster::Framebuffer;
use crate::scene::FolderResources;
use crate::viewer::jobs::pool::guarded;

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
pub(in crate::viewer) struct ReadPicture {
    pub(in crate::viewer) path: PathBuf,
    /// Whether it is B already, and its file is read again.
    pub(in crate::viewer) again: bool,
    pub(in crate::viewer) result: Result<Framebuffer, String>,
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
pub(in crate::viewer) fn is_picture(path: &Path) -> bool {
    let endings = ["png", "jpg", "jpeg"];
    let ending = path.extension();
    ending.is_some_and(|ending| endings.iter().any(|known| ending.eq_ignore_ascii_case(known)))
}

impl ReadPicture {
    /// Reads and decodes a file.
    pub(in crate::viewer) fn read(path: PathBuf, again: bool) -> Self {
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
        Self { path, again, result }
    }
}
