//! The scenes a user can switch between: files, every scene in a folder, or the built-in gallery.

mod cameras;
pub(in crate::viewer) mod dialects;
pub mod gallery;
mod listing;
pub(in crate::viewer) mod readers;
mod reading;
mod stamps;
pub(in crate::viewer) mod state;

use std::cmp::Ordering;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::{Duration, Instant};

use crate::raster::Framebuffer;
use crate::scene::{DialectChoice, Problem, Progress, ReadOptions, Scene, SceneError};
use crate::viewer::library::stamps::Stamps;
use crate::viewer::view::camera::Camera;
use crate::{plain, scene};

/// How deep folders are searched.
const MAX_DEPTH: usize = 6;

/// Most scenes in a list.
pub(in crate::viewer) const MAX_SCENES: usize = 2000;

/// Most bytes of a folder that are looked at to find out whose its scenes are.
const MOST_LOOKED_AT: u64 = 64 << 20;

/// Where a scene is read from.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum SceneSource {
    /// A file.
    File(PathBuf),
    /// A scene of the built-in gallery, by its place there.
    Gallery(usize),
}

/// A scene in the list.
#[derive(Clone, Debug)]
pub struct SceneEntry {
    /// Where it is read from.
    pub source: SceneSource,
    /// Its name in the list, the title and messages: the path below the folder that was opened.
    pub label: String,
    /// Whether it was found in a folder whose scenes are the course's.
    pub(crate) is_of_course: bool,
    /// What became of reading it.
    pub state: SceneState,
    /// The same for B, where B has a dialect of its own.
    pub(in crate::viewer) other_state: SceneState,
    /// Counts what was read: other numbers, other files, or the file read again.
    pub(in crate::viewer) document: u64,
    /// The files that it was read from last, as they were then; `None` until then, and once the user gave it up.
    pub(in crate::viewer) stamps: Option<Stamps>,
    /// Where the user last looked.
    pub camera: Camera,
    /// A small picture of it, once it was asked for and drawn.
    pub thumbnail: Option<Arc<Framebuffer>>,
    /// Whether a thumbnail was asked for already; a scene that cannot be read gets none.
    pub(in crate::viewer) thumbnail_asked: bool,
}

/// How long the reading of a document takes that is worth a bar, and a way to give it up.
const LONG_READING: Duration = Duration::from_millis(400);

/// What became of reading a scene.
#[derive(Clone, Debug, Default)]
pub enum SceneState {
    /// Not asked for yet, or let go to save memory.
    #[default]
    Unread,
    /// A thread is at it.
    Reading {
        /// The choice it is read with.
        dialect: DialectChoice,
        /// What it was before: shown until the new one is there.
        before: Option<Arc<Scene>>,
        /// How far that is.
        progress: Progress,
        /// Since when.
        since: Instant,
    },
    /// Here it is.
    Ready {
        /// The scene.
        scene: Arc<Scene>,
        /// The choice it was read with.
        dialect: DialectChoice,
    },
    /// It could not be read.
    Failed {
        /// Why.
        why: ReadFailure,
        /// The choice it was read with.
        dialect: DialectChoice,
        /// What it was when it could be read last, in the same dialect: shown until it can be read again.
        before: Option<Arc<Scene>>,
    },
}

/// Why a scene could not be read.
#[derive(Clone, Debug)]
pub struct ReadFailure {
    /// One line: file, place, cause, cure.
    pub message: String,
    /// The line of the document at that place, or a piece of it.
    pub line: Option<String>,
}

impl SceneEntry {
    fn new(source: SceneSource, label: String) -> Self {
        Self {
            source,
            label: plain::into_line(label),
            is_of_course: false,
            state: SceneState::Unread,
            other_state: SceneState::Unread,
            document: 0,
            stamps: None,
            camera: Camera::default(),
            thumbnail: None,
            thumbnail_asked: false,
        }
    }

    /// The scene, once it was read; while it is read again, or cannot be read any more, as it was before.
    pub fn scene(&self) -> Option<&Arc<Scene>> {
        self.state.scene()
    }

    /// Why it could not be read.
    pub fn failure(&self) -> Option<&str> {
        match &self.state {
            SceneState::Failed { why, .. } => Some(&why.message),
            _ => None,
        }
    }

    /// The line of the document that [`SceneEntry::failure`] names, if there is one.
    pub fn failed_line(&self) -> Option<&str> {
        match &self.state {
            SceneState::Failed { why, .. } => why.line.as_deref(),
            _ => None,
        }
    }

    /// Whether it can be read neither now nor before: there is nothing to show of it.
    pub fn has_no_picture(&self) -> bool {
        self.failure().is_some() && self.scene().is_none()
    }

    /// Whether it is a file, not a scene of the gallery.
    pub fn is_file(&self) -> bool {
        matches!(self.source, SceneSource::File(_))
    }

    /// Whether it may be read otherwise now than it was: its files were saved, or it could not be read.
    fn is_stale(&self) -> bool {
        let Some(stamps) = &self.stamps else { return false };
        match self.state {
            SceneState::Unread | SceneState::Reading { .. } => false,
            SceneState::Ready { .. } => !stamps.hold(),
            // What it lacked, such as a texture, may be there by now.
            SceneState::Failed { .. } => true,
        }
    }

    /// Whether a thread is reading it.
    pub fn is_reading(&self) -> bool {
        matches!(self.state, SceneState::Reading { .. })
    }

    /// How far the reading of a document is that takes long, from 0 to 1; `None` for one that is read in no time.
    pub fn long_reading(&self) -> Option<f64> {
        match &self.state {
            SceneState::Reading { progress, since, .. } if since.elapsed() >= LONG_READING => Some(progress.part()),
            _ => None,
        }
    }

    /// Whether a thread is reading it in B's dialect.
    pub(in crate::viewer) fn is_read_for_b(&self) -> bool {
        matches!(self.other_state, SceneState::Reading { .. })
    }
}

impl SceneState {
    /// The scene, once it was read; while it is read again, or cannot be read any more, as it was before.
    pub(in crate::viewer) fn scene(&self) -> Option<&Arc<Scene>> {
        match self {
            Self::Ready { scene, .. } => Some(scene),
            Self::Reading { before, .. } | Self::Failed { before, .. } => before.as_ref(),
            Self::Unread => None,
        }
    }

    /// The choice of dialect that it is or was read with, if it is or was.
    pub(in crate::viewer) fn dialect(&self) -> Option<DialectChoice> {
        match self {
            Self::Unread => None,
            Self::Reading { dialect, .. } | Self::Ready { dialect, .. } | Self::Failed { dialect, .. } => {
                Some(*dialect)
            }
        }
    }
}

impl SceneSource {
    /// The scene's address on a command line.
    pub fn address(&self) -> String {
        match self {
            Self::File(path) => path.display().to_string(),
            Self::Gallery(index) => match gallery::SCENES.get(*index) {
                Some(scene) => format!("{GALLERY_PREFIX}{}", scene.name),
                None => GALLERY_PREFIX.to_owned(),
            },
        }
    }

    /// The document's file; a scene of the gallery has none.
    pub(in crate::viewer) fn document(&self) -> Option<&Path> {
        match self {
            Self::File(document) => Some(document),
            Self::Gallery(_) => None,
        }
    }

    /// The files of a scene's textures; none for one of the gallery.
    pub(in crate::viewer) fn textures<'a>(&'a self, scene: &'a Scene) -> impl Iterator<Item = PathBuf> + 'a {
        let folder = self
            .document()
            .map(|document| document.parent().unwrap_or(Path::new("")));
        let textures = scene.files.textures.iter();
        textures.filter_map(move |(address, _)| Some(folder?.join(address)))
    }

    /// The scene that a person writes as an address: `gallery:NAME`, with its ending or without as it is spoken of, or a path.
    pub fn from_address(address: &Path) -> Self {
        let is_called = |scene: &gallery::GalleryScene, name: &str| {
            scene.name == name || scene.name.strip_suffix(".svg") == Some(name)
        };
        let in_gallery = address
            .to_str()
            .and_then(|text| text.strip_prefix(GALLERY_PREFIX))
            .and_then(|name| gallery::SCENES.iter().position(|scene| is_called(scene, name)));
        match in_gallery {
            Some(index) => Self::Gallery(index),
            None => Self::File(address.to_owned()),
        }
    }

    /// Reads the scene.
    ///
    /// # Errors
    /// As [`scene::load`].
    pub fn read(&self, dialect: DialectChoice) -> Result<Scene, SceneError> {
        self.read_watched(dialect, &Progress::default())
    }

    /// As [`SceneSource::read`], while somebody waits who may give it up.
    ///
    /// # Errors
    /// As [`scene::load_watched`].
    pub fn read_watched(&self, dialect: DialectChoice, progress: &Progress) -> Result<Scene, SceneError> {
        match self {
            Self::File(path) => match in_gallery(path) {
                Some(name) => Err(SceneError {
                    file: path.display().to_string(),
                    location: None,
                    line: None,
                    problem: Problem::NotInGallery(gallery::cure(name)),
                }),
                None => scene::load_watched(path, dialect, progress),
            },
            Self::Gallery(index) => {
                let (name, document) = match gallery::SCENES.get(*index) {
                    Some(scene) => (scene.name, scene.document),
                    None => ("gallery", ""),
                };
                scene::read(document.as_bytes(), name, ReadOptions { dialect }, &gallery::Textures)
            }
        }
    }
}

/// Starts the address of a built-in scene.
const GALLERY_PREFIX: &str = "gallery:";

/// The name that an address has in the gallery, `gallery:NAME`, unless there is a file of that path.
pub fn in_gallery(path: &Path) -> Option<&str> {
    let name = path.to_str()?.strip_prefix(GALLERY_PREFIX)?;
    fs::symlink_metadata(path).is_err().then_some(name)
}

/// One scene, by its name in the gallery or its file's.
pub(in crate::viewer) fn entry_of(source: SceneSource) -> SceneEntry {
    let label = match &source {
        SceneSource::Gallery(index) => gallery::SCENES.get(*index).map(|scene| scene.name.to_owned()),
        SceneSource::File(path) => path.file_name().map(|name| name.to_string_lossy().into_owned()),
    };
    let label = label.unwrap_or_else(|| source.address());
    SceneEntry::new(source, label)
}

/// The built-in gallery as a list.
pub(in crate::viewer) fn gallery_entries() -> Vec<SceneEntry> {
    let entry = |(index, scene): (usize, &gallery::GalleryScene)| {
        SceneEntry::new(SceneSource::Gallery(index), scene.name.to_owned())
    };
    gallery::SCENES.iter().enumerate().map(entry).collect()
}

/// The scenes in `paths`, in their order, those of a folder by name; and one line for each path that gave none.
pub fn list_scenes(paths: &[PathBuf]) -> (Vec<SceneEntry>, Vec<String>) {
    let mut entries = Vec::new();
    let mut problems = Vec::new();
    for path in paths {
        if path.is_dir() {
            let mut files = Vec::new();
            if let Err(error) = search(path, 0, &mut files) {
                problems.push(format!(
                    "{}: cannot list this folder: {error}; check its permissions",
                    path.display()
                ));
            } else if files.is_empty() {
                problems.push(format!(
                    "{}: no scene in this folder; give one that holds .svg files",
                    path.display()
                ));
            }
            files.sort_by(|a, b| natural_order(&a.to_string_lossy(), &b.to_string_lossy()));
            let is_of_course = any_of_course(&files);
            entries.extend(files.into_iter().map(|file| {
                let label = file.strip_prefix(path).unwrap_or(&file).display().to_string();
                SceneEntry {
                    is_of_course,
                    ..SceneEntry::new(SceneSource::File(file), label)
                }
            }));
        } else {
            let source = SceneSource::from_address(path);
            if matches!(&source, SceneSource::File(path) if fs::symlink_metadata(path).is_err()) {
                problems.push(match in_gallery(path) {
                    Some(name) => format!("{}: {}", path.display(), Problem::NotInGallery(gallery::cure(name))),
                    None => format!("{}: no such file; give an SVG file or a folder of them", path.display()),
                });
                continue;
            }
            let label = match path.file_name() {
                Some(name) => name.to_string_lossy().into_owned(),
                None => path.display().to_string(),
            };
            entries.push(SceneEntry::new(source, label));
        }
    }
    entries.truncate(MAX_SCENES);
    (entries, problems)
}

/// Collects the scenes below `folder`. Links to folders are not followed, since they may lead in circles.
fn search(folder: &Path, depth: usize, files: &mut Vec<PathBuf>) -> std::io::Result<()> {
    for item in fs::read_dir(folder)? {
        let item = item?;
        let (path, kind) = (item.path(), item.file_type()?);
        let is_svg = scene::is_document(&path);
        if kind.is_dir() && depth < MAX_DEPTH {
            // A folder inside that cannot be listed does not take the others away.
            let _ = search(&path, depth + 1, files);
        } else if is_svg && !kind.is_dir() && path.is_file() {
            files.push(path);
        }
        if files.len() >= MAX_SCENES {
            break;
        }
    }
    Ok(())
}

/// Whether a folder is opened whole in which any document uses elements that only the course has.
pub fn is_folder_of_course(folder: &Path) -> bool {
    let mut files = Vec::new();
    // What cannot be listed holds nothing.
    let _ = search(folder, 0, &mut files);
    any_of_course(&files)
}

/// Whether any of the documents uses elements that only the course has. Looks at the small ones, which is where those are,
/// and not at more of them than can be read in a moment.
fn any_of_course(files: &[PathBuf]) -> bool {
    let mut left = MOST_LOOKED_AT;
    let mut small = files.iter().filter(|file| {
        let length = fs::metadata(file).map_or(u64::MAX, |about| about.len());
        let fits = length <= left;
        left -= if fits { length } else { 0 };
        fits
    });
    small.any(|file| fs::read(file).is_ok_and(|document| scene::is_of_course(&document)))
}

/// Order of names for people: `test2` comes before `test10`.
pub fn natural_order(a: &str, b: &str) -> Ordering {
    let (mut a, mut b) = (a, b);
    loop {
        let (digits_a, digits_b) = (digits(a), digits(b));
        let order = if digits_a.is_empty() || digits_b.is_empty() {
            let (first_a, first_b) = (a.chars().next(), b.chars().next());
            let (Some(x), Some(y)) = (first_a, first_b) else {
                return first_a.cmp(&first_b);
            };
            a = &a[x.len_utf8()..];
            b = &b[y.len_utf8()..];
            x.cmp(&y)
        } else {
            a = &a[digits_a.len()..];
            b = &b[digits_b.len()..];
            let value = |digits: &str| digits.trim_start_matches('0').to_owned();
            let (x, y) = (value(digits_a), value(digits_b));
            x.len().cmp(&y.len()).then(x.cmp(&y))
        };
        if order != Ordering::Equal {
            return order;
        }
    }
}

/// The digits that `text` starts with.
fn digits(text: &str) -> &str {
    let end = text.find(|c: char| !c.is_ascii_digit()).unwrap_or(text.len());
    &text[..end]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn scenes_of_the_gallery_have_their_names_with_and_without_ending() {
        let of = |address: &str| SceneSource::from_address(Path::new(address));
        let whole = of("gallery:basic/test4.svg");
        assert!(matches!(whole, SceneSource::Gallery(_)), "{whole:?}");
        assert_eq!(of("gallery:basic/test4"), whole, "as the README speaks of it");
        for other in ["basic/test4.svg", "gallery:basic", "gallery:basic/test4.svg.svg"] {
            assert_eq!(of(other), SceneSource::File(other.into()), "a path");
        }
        let read = of("gallery:study")
            .read(DialectChoice::Auto)
            .map(|_| ())
            .map_err(|error| error.to_string());
        let (scenes, problems) = list_scenes(&["gallery:study".into()]);
        assert_eq!(read.as_ref().err(), problems.first(), "the same in the window");
        assert!(
            scenes.is_empty() && problems[0].contains("no such scene in the gallery"),
            "{problems:?}"
        );
    }

    #[test]
    fn natural_order_counts() {
        let mut names = [
            "b/test10.svg",
            "b/test2.svg",
            "a/z.svg",
            "b/test1.svg",
            "b/test02b.svg",
            "",
        ];
        names.sort_by(|a, b| natural_order(a, b));
        let expected = [
            "",
            "a/z.svg",
            "b/test1.svg",
            "b/test2.svg",
            "b/test02b.svg",
            "b/test10.svg",
        ];
        assert_eq!(names, expected, "numbers by value");
    }

    #[test]
    fn open_folder_finds_scenes_below() {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let inner = folder.path().join("basic");
        fs::create_dir(&inner).expect("a folder inside");
        for name in ["test10.svg", "test9.SVG", "notes.txt"] {
            fs::write(inner.join(name), "").expect("a small file");
        }
        let (entries, problems) = list_scenes(&[folder.path().to_owned(), "nowhere.svg".into()]);
        let labels: Vec<&str> = entries.iter().map(|entry| entry.label.as_str()).collect();
        assert_eq!(labels.len(), 2, "{labels:?}");
        assert!(
            labels[0].ends_with("test9.SVG") && labels[1].ends_with("test10.svg"),
            "{labels:?}"
        );
        assert!(
            problems.len() == 1 && problems[0].starts_with("nowhere.svg: no such file"),
            "{problems:?}"
        );
        fs::remove_file(inner.join("test10.svg"))
            .and(fs::remove_file(inner.join("test9.SVG")))
            .expect("removed");
        assert_eq!(
            list_scenes(&[folder.path().to_owned()]).1.len(),
            1,
            "an empty folder is told"
        );
    }

    #[test]
    fn scene_that_is_being_read_is_not_read_a_second_time_for_its_thumbnail() {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let path = folder.path().join("a.svg");
        let document =
            "<svg xmlns='http://www.w3.org/2000/svg' width='9' height='9'><rect width='5' height='5'/></svg>";
        fs::write(&path, document).expect("a small file");
        let options = crate::viewer::ViewerOptions {
            paths: vec![path],
            ..Default::default()
        };
        let mut viewer = crate::viewer::Viewer::new(options).expect("threads");
        viewer.update();
        // What is found out meanwhile is taken in by the next poll only.
        assert!(viewer.scene_list.is_reading(), "it has begun");
        viewer.request_thumbnail(0);
        assert!(!viewer.scene_list.readers.has_thumbnails_pending(), "it waits");
        viewer.finish();
        viewer.request_thumbnail(0);
        assert!(viewer.scene_list.readers.has_thumbnails_pending(), "then it is drawn");
    }
}
