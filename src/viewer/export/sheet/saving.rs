//! Saving a sheet from the window: beside the screenshots, under a name that nothing had.

use std::io;
use std::path::{Path, PathBuf};

use crate::figure::{Destination, Guard, Unwritable};
use crate::viewer::export::naming::names_to_try;
use crate::viewer::export::sheet::preview::SheetQuestion;
use crate::viewer::export::spec::PictureSpec;

/// A sheet to be saved.
pub(in crate::viewer) struct SheetJob {
    question: SheetQuestion,
    spec: PictureSpec,
}

impl SheetJob {
    pub(in crate::viewer) fn new(question: &SheetQuestion, spec: PictureSpec) -> Self {
        Self {
            question: question.clone(),
            spec,
        }
    }

    /// What names the sheet.
    pub(in crate::viewer) fn spec(&self) -> &PictureSpec {
        &self.spec
    }

    /// Draws the sheet and saves it in `folder` as `stem.png`, its panels in `stem`; says where, and how large it is.
    ///
    /// # Errors
    /// One line when it cannot be drawn or saved; nothing is left then.
    pub(in crate::viewer) fn save(&self, folder: &Path, stem: &str) -> Result<(PathBuf, [u32; 2]), String> {
        let request = self.question.request()?;
        let cure = "choose another folder with --screenshot-dir";
        let panels = claimed(folder, stem).map_err(|error| match error.kind() {
            io::ErrorKind::AlreadyExists => {
                format!("{}: every name for this sheet is taken; {cure}", folder.display())
            }
            _ => format!("{}: cannot save here: {error}; {cure}", folder.display()),
        })?;
        let output = picture_beside(&panels);
        let first = request.first().cloned();
        let drawn = first
            .ok_or_else(|| "a sheet without panels".to_owned())
            .and_then(|first| {
                let known = &self.question.known;
                request.draw(&mut |dialect| known.read_in(dialect, &first), &output)
            });
        let saved = drawn.and_then(|sheet| {
            let size = [sheet.picture.width(), sheet.picture.height()];
            let unwritable = |(path, error): Unwritable| {
                let path = path.display();
                format!("{path}: cannot save here: {error}; {cure}")
            };
            let saved = sheet.save(Destination::by_program(&output), &Guard::default());
            saved.map_err(unwritable).map(|_| (output, size))
        });
        if saved.is_err() {
            // Nothing is in it yet; the first error is the one to tell.
            let _ = std::fs::remove_dir(&panels);
        }
        saved
    }
}

/// Makes the folder of the panels, which nothing of that name keeps from being new.
fn claimed(folder: &Path, stem: &str) -> io::Result<PathBuf> {
    for name in names_to_try(stem) {
        let panels = folder.join(name);
        let panels = panels.strip_prefix(".").unwrap_or(&panels).to_owned();
        if picture_beside(&panels).symlink_metadata().is_ok() {
            continue;
        }
        match std::fs::create_dir(&panels) {
            Ok(()) => return Ok(panels),
            Err(error) if error.kind() == io::ErrorKind::AlreadyExists => {}
            Err(error) => return Err(error),
        }
    }
    Err(io::ErrorKind::AlreadyExists.into())
}

/// The file of the whole sheet beside the folder of its panels. The name may hold points.
fn picture_beside(panels: &Path) -> PathBuf {
    let mut name = panels.as_os_str().to_owned();
    name.push(".png");
    name.into()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sheets_never_replace() {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let at = |name: &str| folder.path().join(name);
        std::fs::create_dir(at("a.b")).expect("a folder");
        std::fs::write(at("a.b-2.png"), "kept").expect("a file");
        let free = claimed(folder.path(), "a.b").expect("a writable folder");
        assert_eq!(free, at("a.b-3"), "neither a folder nor a picture of that name");
        assert_eq!(picture_beside(&free), at("a.b-3.png"), "beside it");
        assert_eq!(
            picture_beside(&free).with_extension(""),
            free,
            "where a sheet puts its panels"
        );
        let nowhere = claimed(&at("no/such"), "a").expect_err("no folder");
        assert_eq!(nowhere.kind(), io::ErrorKind::NotFound, "told as it is");
    }
}
