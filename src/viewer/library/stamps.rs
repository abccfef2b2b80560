//! Whether the files of a scene are as they were when it was read: by their lengths and times, without reading them.

use std::fs;
use std::path::{Path, PathBuf};
use std::time::SystemTime;

/// Length and time of a file; `None` where there is none.
type Stamp = Option<(u64, Option<SystemTime>)>;

/// The files that a scene was read from, as they were then.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(in crate::viewer) struct Stamps(Vec<(PathBuf, Stamp)>);

impl Stamps {
    /// The document as it is now; a scene of the gallery has none.
    pub(in crate::viewer) fn of_document(document: Option<&Path>) -> Self {
        let mut stamps = Self::default();
        if let Some(document) = document {
            stamps.note(document.to_owned());
        }
        stamps
    }

    /// Notes a file as it is now.
    pub(in crate::viewer) fn note(&mut self, file: PathBuf) {
        let stamp = stamp(&file);
        self.0.push((file, stamp));
    }

    /// Whether all files are still as they were.
    pub(in crate::viewer) fn hold(&self) -> bool {
        self.0.iter().all(|(file, before)| stamp(file) == *before)
    }
}

fn stamp(file: &Path) -> Stamp {
    let about = fs::metadata(file).ok()?;
    Some((about.len(), about.modified().ok()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn files_that_are_saved_or_gone_are_not_as_they_were() {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let [document, texture] = ["a.svg", "a.png"].map(|name| folder.path().join(name));
        fs::write(&document, "1").expect("a file");
        let mut stamps = Stamps::of_document(Some(&document));
        stamps.note(texture.clone());
        assert!(stamps.hold(), "one that is missing may stay so");
        fs::write(&texture, "1").expect("a file");
        assert!(!stamps.hold(), "a file that was not there");
        let mut stamps = Stamps::of_document(Some(&document));
        stamps.note(texture.clone());
        fs::write(&texture, "12").expect("a file");
        assert!(!stamps.hold(), "a texture that was saved");
        let stamps = Stamps::of_document(Some(&document));
        fs::remove_file(&document).expect("removed");
        assert!(!stamps.hold(), "a document that is gone");
        assert!(Stamps::of_document(None).hold(), "the gallery stays as it is");
    }
}
