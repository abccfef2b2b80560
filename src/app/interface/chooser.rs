//! Choosing a file with the mouse: the folders and files of one folder, of which only those are listed that can be opened.

use std::io::Read as _;
use std::path::{Path, PathBuf};
use std::{fs, io};

use egui::{Button, Response, RichText, Sense, Ui};

use super::palette::ENTRY;
use crate::viewer::{SceneSource, Viewer, kind_of_file, natural_order};

/// Files and folders that are listed of a folder: more than a hand goes through.
const MOST: usize = 10_000;

/// The folder that is listed.
#[derive(Debug, Default)]
pub(super) struct Chooser {
    folder: PathBuf,
    /// That of the scene that was shown when it was opened last.
    of_scene: Option<PathBuf>,
    items: Vec<Item>,
    /// Why the folder cannot be listed.
    problem: Option<String>,
    /// The folder of a path that is being typed, and what it has; nothing where it cannot be listed.
    typed: Option<(PathBuf, Option<Vec<Item>>)>,
}

/// A path that is being typed.
#[derive(Clone, Debug)]
pub(super) struct Typed {
    /// Where it leads so far.
    pub(super) path: PathBuf,
    /// The folder whose files can end it.
    folder: PathBuf,
    /// What was typed of the name in it.
    part: String,
}

/// A file or a folder of the list.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Item {
    /// Where it is.
    pub(super) path: PathBuf,
    /// Its name for people.
    pub(super) name: String,
    /// What it is, such as `folder` or `scene`.
    kind: &'static str,
}

/// What a picture is called in the list.
const PICTURE: &str = "picture";
/// What a lesson is called in the list, and how much of it is looked at for its first step, in bytes.
const LESSON: &str = "lesson";
const LONGEST_HEAD: u64 = 64 << 10;
/// How people write the path of their own folder.
pub(super) const HOME: &str = "~";
/// What a folder is called in the list.
const FOLDER: &str = "folder";

impl Item {
    /// Whether it is a folder to go into.
    pub(super) fn is_folder(&self) -> bool {
        self.kind == FOLDER
    }

    /// Its line.
    pub(super) fn show(&self, ui: &mut Ui, chosen: bool) -> Response {
        let kind = RichText::new(self.kind).small();
        let name = if self.is_folder() {
            format!("{}/", self.name)
        } else {
            self.name.clone()
        };
        let button = Button::selectable(chosen, name).right_text(kind).truncate();
        // Arrows choose it: Tab goes to the buttons beside the list.
        let button = button.sense(Sense::CLICK);
        ui.add_sized([ui.available_width(), ENTRY], button)
            .accessible_name(&self.name)
    }
}

impl Chooser {
    /// Lists the folder where it was left, or that of the scene that is shown, where that is another one than before.
    pub(super) fn begin(&mut self, viewer: &Viewer) {
        let of_scene = match viewer.scene_list().current().map(|entry| &entry.source) {
            Some(SceneSource::File(path)) => path.parent().and_then(|folder| fs::canonicalize(folder).ok()),
            _ => None,
        };
        if self.folder.as_os_str().is_empty() || (of_scene.is_some() && of_scene != self.of_scene) {
            self.of_scene.clone_from(&of_scene);
            self.folder = of_scene
                .or_else(|| std::env::current_dir().ok())
                .or_else(std::env::home_dir)
                .unwrap_or_else(|| PathBuf::from("."));
        }
        self.typed = None;
        self.list();
    }

    /// Lists another folder.
    pub(super) fn go_to(&mut self, folder: &Path) {
        self.folder = fs::canonicalize(folder).unwrap_or_else(|_| folder.to_owned());
        self.list();
    }

    /// The folder that is listed.
    pub(super) fn folder(&self) -> &Path {
        &self.folder
    }

    /// Why it cannot be listed.
    pub(super) fn problem(&self) -> Option<&str> {
        self.problem.as_deref()
    }

    /// The items whose names hold this text.
    pub(super) fn shown(&self, text: &str) -> Vec<Item> {
        holding(&self.items, text)
    }

    /// A text that means `path`, from the folder that is listed. Behind a separator all files of a folder can follow.
    pub(super) fn typed(&self, text: &str, path: &Path) -> Typed {
        let path = self.folder.join(path);
        let name = path.file_name().zip(path.parent());
        let (folder, part) = match name {
            Some((name, folder)) if text != HOME && !text.ends_with(std::path::is_separator) => {
                (folder.to_owned(), name.to_string_lossy().into_owned())
            }
            _ => (path.clone(), String::new()),
        };
        Typed { path, folder, part }
    }

    /// The folder of a path that is being typed, and the items in it that may be meant; `None` where it cannot be listed.
    pub(super) fn shown_at(&mut self, typed: &Typed) -> Option<(PathBuf, Vec<Item>)> {
        if self.typed.as_ref().is_none_or(|(folder, _)| *folder != typed.folder) {
            self.typed = Some((typed.folder.clone(), items(&typed.folder).ok()));
        }
        let (folder, items) = self.typed.as_ref()?;
        Some((folder.clone(), holding(items.as_ref()?, &typed.part)))
    }

    /// The folders and the pictures.
    pub(super) fn pictures(&self) -> Vec<Item> {
        let fits = |item: &&Item| item.is_folder() || item.kind == PICTURE;
        self.items.iter().filter(fits).cloned().collect()
    }

    fn list(&mut self) {
        match items(&self.folder) {
            Ok(items) => (self.items, self.problem) = (items, None),
            Err(error) => {
                self.items.clear();
                self.problem = Some(format!("cannot list this folder: {error}; go to another"));
            }
        }
    }
}

/// The items whose names hold this text.
fn holding(items: &[Item], text: &str) -> Vec<Item> {
    let wanted = text.trim().to_lowercase();
    let fits = |item: &&Item| item.name.to_lowercase().contains(&wanted);
    items.iter().filter(fits).cloned().collect()
}

/// What can be opened of a folder, folders first, by name; what is hidden is left out.
fn items(folder: &Path) -> io::Result<Vec<Item>> {
    let mut items = Vec::new();
    for found in fs::read_dir(folder)?.take(MOST) {
        let path = found?.path();
        let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        let kind = if path.is_dir() {
            Some(FOLDER)
        } else {
            kind_of_file(&path)
        };
        let opens = |kind: &&str| !name.starts_with('.') && (*kind != LESSON || path.is_file() && has_steps(&path));
        if let Some(kind) = kind.filter(opens) {
            items.push(Item {
                path,
                name: crate::plain::into_line(name),
                kind,
            });
        }
    }
    items.sort_by(|a, b| (b.is_folder().cmp(&a.is_folder())).then_with(|| natural_order(&a.name, &b.name)));
    Ok(items)
}

/// Whether this may be a lesson: many files that are none end in `.toml`.
fn has_steps(path: &Path) -> bool {
    let mut head = Vec::new();
    let read = fs::File::open(path).and_then(|file| file.take(LONGEST_HEAD).read_to_end(&mut head));
    let text = String::from_utf8_lossy(&head);
    read.is_ok()
        && text
            .lines()
            .any(|line| line.trim_start_matches(['[', ' ', '\t']).starts_with("step"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn folders_come_first_and_only_what_opens_is_listed() {
        let folder = tempfile::tempdir().expect("a folder");
        fs::create_dir(folder.path().join("zoo")).expect("a folder");
        fs::create_dir(folder.path().join(".hidden")).expect("a folder");
        for name in ["b10.svg", "b9.SVG", "c.png", "notes.txt", ".x.svg"] {
            fs::write(folder.path().join(name), "").expect("a file");
        }
        for (name, text) in [("l.toml", "title = 'x'\n[[step]]\n"), ("Cargo.toml", "[package]\n")] {
            fs::write(folder.path().join(name), text).expect("a file");
        }
        let items = items(folder.path()).expect("listed");
        let lines: Vec<(&str, &str)> = items.iter().map(|item| (item.name.as_str(), item.kind)).collect();
        let expected = [
            ("zoo", FOLDER),
            ("b9.SVG", "scene"),
            ("b10.svg", "scene"),
            ("c.png", "picture"),
            ("l.toml", "lesson"),
        ];
        assert_eq!(lines, expected, "in their order");
    }

    #[test]
    fn line_grows_by_no_name() {
        let item = Item {
            path: PathBuf::from("n.svg"),
            name: "n".repeat(250),
            kind: "scene",
        };
        let mut taken = 0.0;
        egui::Context::default()
            .run_ui(egui::RawInput::default(), |ui| {
                ui.set_width(480.0);
                taken = item.show(ui, false).rect.width();
            })
            .textures_delta
            .clear();
        assert!(taken <= 480.0, "{taken} points");
    }

    #[test]
    fn folder_that_cannot_be_listed_is_told() {
        let mut chooser = Chooser::default();
        chooser.go_to(Path::new("/no such folder"));
        assert!(
            chooser.problem().is_some() && chooser.shown("").is_empty(),
            "{chooser:?}"
        );
    }
}
