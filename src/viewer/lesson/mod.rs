//! Lessons: steps that a teacher wrote, each a scene with its settings and a text beside it.
//!
//! A lesson is a TOML file. Whoever walks through it only gives commands; every step sets all that it needs, so that steps
//! can be taken in any order.

mod markdown;
mod parse;
mod slides;
mod walk;

use std::fmt;
use std::fs;
use std::io::Read as _;
use std::path::{Path, PathBuf};

use glam::DVec2;

use super::{Against, Arrangement, SceneSource, SettingChange, ViewNumbers};

pub use markdown::{Block, Look, Span};
pub use slides::{SlideError, slides};
pub(super) use walk::Walk;

/// Starts the address of a built-in lesson.
const PREFIX: &str = "lesson:";
/// Largest file that is read, in bytes.
const MOST_BYTES: u64 = 1 << 20;

/// The lessons that come with the program: names and documents.
pub static BUILT_IN: [(&str, &str); 2] = [
    ("six-tasks", include_str!("../../../assets/lessons/six-tasks.toml")),
    ("anisotropy", include_str!("../../../assets/lessons/anisotropy.toml")),
];

/// Where a lesson is read from.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum LessonSource {
    /// One of [`BUILT_IN`].
    BuiltIn(usize),
    /// A file.
    File(PathBuf),
}

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
    /// The pinned place, in user units.
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

impl Lesson {
    /// Reads the lesson in the TOML `document`, called `name` in messages. Its scenes are those of the gallery.
    ///
    /// # Errors
    /// For the first mistake, with its place.
    pub fn parse(document: &str, name: &str) -> Result<Self, LessonError> {
        parse::parse(document, name, None)
    }
}

impl LessonSource {
    /// The lesson that a person writes as an address: `lesson:NAME` or the path of a TOML file; `None` for other paths.
    pub fn from_address(address: &Path) -> Option<Self> {
        if let Some(name) = address.to_str().and_then(|text| text.strip_prefix(PREFIX)) {
            let known = BUILT_IN.iter().position(|(known, _)| *known == name);
            return known.map(Self::BuiltIn);
        }
        let ending = address.extension()?;
        ending
            .eq_ignore_ascii_case("toml")
            .then(|| Self::File(address.to_owned()))
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
                let unreadable =
                    |error: std::io::Error| whole(format!("cannot be read: {error}; give a lesson in TOML"));
                let mut bytes = Vec::new();
                let is_file = fs::metadata(path).map_err(unreadable)?.is_file();
                if !is_file {
                    return Err(whole("is no file; give a lesson in TOML".to_owned()));
                }
                let file = fs::File::open(path).map_err(unreadable)?;
                file.take(MOST_BYTES + 1).read_to_end(&mut bytes).map_err(unreadable)?;
                if bytes.len() as u64 > MOST_BYTES {
                    let most = MOST_BYTES >> 20;
                    return Err(whole(format!(
                        "is larger than {most} MiB; split it into several lessons"
                    )));
                }
                let text = String::from_utf8(bytes)
                    .map_err(|_| whole("is no text in UTF-8; save it in that encoding".to_owned()))?;
                parse::parse(&text, &self.address(), path.parent())
            }
        }
    }
}
