//! Pictures from outside become B, and follow their files: read in the thread that measures.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use crate::raster::Framebuffer;
use crate::viewer::ab::comparison::Comparison;
use crate::viewer::ab::other::Other;
use crate::viewer::ab::outside::{OutsidePicture, ReadPicture};
use crate::viewer::ab::requests::ComparisonContext;
use crate::viewer::chrome::messages::Messages;

/// Said of a picture that is B and cannot be read any more.
const STAYS: &str = "B stays as it was read last";

impl Comparison {
    /// The file of the picture that is B.
    pub(in crate::viewer) fn file_of_picture(&self) -> Option<&Path> {
        match self.other.as_ref()? {
            Other::Picture(picture) => Some(&picture.path),
            Other::Settings { .. } | Other::Truth(_) => None,
        }
    }

    pub(in crate::viewer) fn load_picture(&mut self, path: PathBuf, messages: &mut Messages) {
        match self.measuring.load(path.clone()) {
            Ok(()) => self.loading = Some(path),
            Err(error) => messages.error(unread(&path, &error)),
        }
    }

    /// Reads B again where it is a picture.
    pub(in crate::viewer) fn read_picture_again(&mut self, messages: &mut Messages) {
        let Some(path) = self.file_of_picture().map(Path::to_owned) else {
            return;
        };
        if let Err(error) = self.measuring.load_again(path.clone()) {
            messages.error(unread(&path, &error));
        }
    }

    /// Takes in a picture that was read; the newest request counts.
    pub(in crate::viewer) fn picture_read(&mut self, read: ReadPicture, context: &mut ComparisonContext<'_>) {
        let name = read.path.display().to_string();
        let result = read.result.and_then(|pixels| match pixels.pixels() {
            [] => Err(format!("{name}: has no pixels; give another picture")),
            _ => Ok(pixels),
        });
        if read.again {
            self.measuring.rereads = self.measuring.rereads.saturating_sub(1);
            self.take_again(&read.path, result, context);
            return;
        }
        if self.loading.as_ref() != Some(&read.path) {
            return;
        }
        self.loading = None;
        match result {
            Ok(pixels) => {
                context.messages.forget_problems_of(&name);
                let picture = Arc::new(OutsidePicture {
                    path: read.path,
                    pixels,
                });
                let [width, height] = [picture.pixels.width(), picture.pixels.height()];
                context.messages.done(format!(
                    "B is {}; A is drawn with its size, {width} x {height} pixels",
                    picture.name()
                ));
                self.set_other(Some(Other::Picture(picture)));
                self.show_somehow(context);
            }
            Err(problem) => context.messages.error(problem),
        }
    }

    /// B is what its file holds now, seen as before; where that is no picture, it stays.
    fn take_again(&mut self, path: &Path, result: Result<Framebuffer, String>, context: &mut ComparisonContext<'_>) {
        let before = match &self.other {
            Some(Other::Picture(picture)) if picture.path == path => Arc::clone(picture),
            _ => return,
        };
        match result {
            Ok(pixels) => {
                context.messages.forget_problems_of(&path.display().to_string());
                if pixels == before.pixels {
                    return;
                }
                let size = |picture: &Framebuffer| [picture.width(), picture.height()];
                let keeps_size = size(&pixels) == size(&before.pixels);
                let (swapped, moved) = (self.swapped, self.moved);
                let path = path.to_owned();
                self.set_other(Some(Other::Picture(Arc::new(OutsidePicture { path, pixels }))));
                self.swapped = swapped;
                if keeps_size {
                    self.moved = moved;
                }
            }
            Err(problem) => context.messages.error(format!("{problem}; {STAYS}")),
        }
    }
}

/// Why a file is not read.
fn unread(path: &Path, error: &std::io::Error) -> String {
    format!("{}: cannot be read: {error}; close other programs", path.display())
}
