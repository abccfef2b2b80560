//! Where lessons come from: the program's own, and files.

use std::path::{Path, PathBuf};

use crate::viewer::lesson::model::{Lesson, LessonError};
use crate::viewer::lesson::parse;
use crate::viewer::settings::document;

/// Starts the address of a built-in lesson.
const PREFIX: &str = "lesson:";

/// Largest file that is read, in KiB.
const MOST_KIB: u64 = 1 << 10;

/// The lessons that come with the program: names and documents.
pub static BUILT_IN: [(&str, &str); 4] = [
    ("six-tasks", include_str!("../../../assets/lessons/six-tasks.toml")),
    ("anisotropy", include_str!("../../../assets/lessons/anisotropy.toml")),
    ("patterns", include_str!("../../../assets/lessons/patterns.toml")),
    ("thin-ray", include_str!("../../../assets/lessons/thin-ray.toml")),
];

/// Where a lesson is read from.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum LessonSource {
    /// One of [`BUILT_IN`].
    BuiltIn(usize),
    /// A file.
    File(PathBuf),
}

impl LessonSource {
    /// The lesson that a person writes as an address: `lesson:NAME` or the path of a TOML file; `None` for other paths.
    pub fn from_address(address: &Path) -> Option<Self> {
        if let Some(name) = address.to_str().and_then(|text| text.strip_prefix(PREFIX)) {
            return Self::named(name);
        }
        let ending = address.extension()?;
        ending
            .eq_ignore_ascii_case("toml")
            .then(|| Self::File(address.to_owned()))
    }

    /// The built-in lesson of this name.
    pub fn named(name: &str) -> Option<Self> {
        BUILT_IN.iter().position(|(known, _)| *known == name).map(Self::BuiltIn)
    }

    /// The lesson's address on a command line.
    pub fn address(&self) -> String {
        match self {
            Self::BuiltIn(index) => format!("{PREFIX}{}", BUILT_IN.get(*index).map_or("", |(name, _)| name)),
            Self::File(path) => path.display().to_string(),
        }
    }

    /// Reads the lesson.
    ///
    /// # Errors
    /// When the file cannot be read, is too large, or is no lesson: one line with the place and the cure.
    pub fn read(&self) -> Result<Lesson, LessonError> {
        let whole = |problem: String| LessonError {
            file: self.address(),
            at: None,
            problem,
        };
        match self {
            Self::BuiltIn(index) => {
                let document = BUILT_IN.get(*index).map(|(_, document)| *document);
                let document = document.ok_or_else(|| whole("no such lesson".to_owned()))?;
                Lesson::parse(document, &self.address())
            }
            Self::File(path) => {
                let text = document::read(path, MOST_KIB, "give a lesson in TOML").map_err(whole)?;
                parse::parse(&text, &self.address(), path.parent())
            }
        }
    }
}
