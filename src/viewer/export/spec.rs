//! What makes a picture again: the words of its command line, and the record that its file carries.

use std::path::{Component, Path, PathBuf};

use crate::figure::{InsetSpec, Record, RecordedFile};
use crate::geometry::View;
use crate::plain;
use crate::render::RenderSettings;
use crate::scene::{self, DialectChoice, FileDigest, FolderResources, Scene};
use crate::viewer::library::SceneSource;
use crate::viewer::settings::{Settings, picture};

/// Everything that decides the pixels of a picture, in the words of the command line.
#[derive(Clone, Debug, PartialEq)]
pub struct PictureSpec {
    /// What is drawn.
    pub scene: SceneSource,
    /// Width and height in pixels.
    pub size: [u32; 2],
    /// From where.
    pub view: View,
    /// How; the outline follows the view.
    pub render: RenderSettings,
    /// How the document is read.
    pub dialect: DialectChoice,
    /// Whether a visualisation comes with its legend.
    pub legend: bool,
    /// What is magnified.
    pub insets: Vec<InsetSpec>,
}

impl PictureSpec {
    /// The words of the `render` command that draws the picture into `output`, without the program's name. Options that
    /// have their default value are left out, but for size and view.
    pub fn arguments(&self, output: &str) -> Vec<String> {
        let mut words = vec![
            "render".to_owned(),
            as_path(&self.scene.address()),
            "-o".to_owned(),
            as_path(output),
        ];
        words.extend(self.options());
        words.extend(self.inset_options());
        words.extend(self.legend_option());
        for path in scene::more_fonts() {
            words.extend(["--font".to_owned(), as_path(&path.display().to_string())]);
        }
        words
    }

    /// The options of the insets, which only commands that draw figures know.
    pub fn inset_options(&self) -> Vec<String> {
        let words = self
            .insets
            .iter()
            .map(|inset| ["--inset".to_owned(), inset.to_string()]);
        words.flatten().collect()
    }

    /// The options among them: size, view and the settings.
    pub fn options(&self) -> Vec<String> {
        let [width, height] = self.size;
        let mut words = vec!["--size".to_owned(), format!("{width}x{height}")];
        match self.view_text() {
            // A number may start with a minus.
            numbers if numbers.contains(',') => words.push(format!("--view={numbers}")),
            name => words.extend(["--view".to_owned(), name]),
        }
        for (name, value) in self.settings() {
            words.extend([format!("--{name}"), value]);
        }
        words
    }

    /// The option of the legend, which only the command for one figure knows.
    pub fn legend_option(&self) -> Option<String> {
        let has_one = self.render.visualisation != RenderSettings::default().visualisation;
        (has_one && !self.legend).then(|| "--no-legend".to_owned())
    }

    /// The view as `--view` takes it.
    pub fn view_text(&self) -> String {
        self.view.to_string()
    }

    /// The settings that differ from their defaults: names and values of the command line's options.
    pub fn settings(&self) -> Vec<(&'static str, String)> {
        let settings = Settings::of(self.render, self.dialect);
        let changed = picture::all().filter(|setting| !setting.is_default(&settings));
        changed
            .map(|setting| (setting.option, setting.value(&settings)))
            .collect()
    }

    /// The record of the picture that was drawn of `scene`, for a file `output`.
    pub fn record(&self, scene: &Scene, output: &Path) -> Record {
        Record {
            scene: Some(scene_file(&self.scene, scene, output)),
            textures: texture_files(scene),
            view: self.view_text(),
            settings: self
                .settings()
                .into_iter()
                .map(|(name, value)| (name.to_owned(), value))
                .collect(),
            ..plain_record(self.arguments(&output.display().to_string()), self.size)
        }
    }

    /// The record of another picture of this scene, written to `output` by the command `verb` with these options.
    pub fn record_of_command(
        &self,
        (verb, options): (&'static str, Vec<String>),
        scene: &Scene,
        output: &Path,
    ) -> Record {
        let mut record = self.record(scene, output);
        RecipeOfCommand { verb, options }.put_into(&mut record, self, output);
        record
    }
}

/// A command that makes a picture of a scene, but for its files.
#[derive(Clone, Debug)]
pub(in crate::viewer) struct RecipeOfCommand {
    pub(in crate::viewer) verb: &'static str,
    /// What follows scene and output.
    pub(in crate::viewer) options: Vec<String>,
}

impl RecipeOfCommand {
    /// Puts its command line into the record of the picture that is written to `output`.
    pub(in crate::viewer) fn put_into(&self, record: &mut Record, spec: &PictureSpec, output: &Path) {
        let mut words = vec![
            self.verb.to_owned(),
            as_path(&spec.scene.address()),
            "-o".to_owned(),
            as_path(&output.display().to_string()),
        ];
        words.extend(self.options.iter().cloned());
        record.command_line = shell_line(&words);
        record.arguments = words;
    }
}

/// The record of a picture of `size` pixels of which only the arguments are known.
pub fn plain_record(arguments: Vec<String>, size: [u32; 2]) -> Record {
    Record {
        version: Record::VERSION,
        program: concat!("rasterscope ", env!("CARGO_PKG_VERSION")).to_owned(),
        command_line: shell_line(&arguments),
        arguments,
        size,
        ..Record::default()
    }
}

/// The scene as a record names it.
fn scene_file(source: &SceneSource, scene: &Scene, output: &Path) -> RecordedFile {
    RecordedFile {
        address: source.address(),
        beside: match source {
            SceneSource::File(path) => relative_path(output.parent().unwrap_or(Path::new("")), path),
            SceneSource::Gallery(_) => None,
        },
        sha256: scene
            .files
            .document
            .map(|digest| digest.to_string())
            .unwrap_or_default(),
    }
}

/// A file that a picture was made from, as the record of the picture `output` names it.
pub fn input_file(path: &Path, output: &Path) -> RecordedFile {
    let bytes = FolderResources::read_file(path).ok();
    RecordedFile {
        address: path.display().to_string(),
        beside: relative_path(output.parent().unwrap_or(Path::new("")), path),
        sha256: bytes.map_or(String::new(), |bytes| FileDigest::of(&bytes).to_string()),
    }
}

/// The textures of a scene as records name them.
pub fn texture_files(scene: &Scene) -> Vec<RecordedFile> {
    let textures = scene.files.textures.iter();
    let textures = textures.map(|(address, digest)| RecordedFile {
        address: address.clone(),
        beside: None,
        sha256: digest.to_string(),
    });
    textures.collect()
}

/// The way from a folder to a file; `None` where there is none, or one of them does not exist.
fn relative_path(folder: &Path, file: &Path) -> Option<String> {
    let folder = if folder.as_os_str().is_empty() {
        Path::new(".")
    } else {
        folder
    };
    let (folder, file) = (folder.canonicalize().ok()?, file.canonicalize().ok()?);
    let common = folder
        .components()
        .zip(file.components())
        .take_while(|(a, b)| a == b)
        .count();
    // Files on different drives have no way between them.
    let rest = folder.components().skip(common);
    if common == 0 || rest.clone().any(|part| !matches!(part, Component::Normal(_))) {
        return None;
    }
    let up = rest.map(|_| Component::ParentDir);
    let way: PathBuf = up.chain(file.components().skip(common)).collect();
    way.to_str().map(str::to_owned)
}

/// Words as one line for a POSIX shell, after the program's name.
pub fn shell_line(arguments: &[String]) -> String {
    let words = std::iter::once("rasterscope".to_owned()).chain(arguments.iter().map(|word| shell_quoted(word)));
    words.collect::<Vec<_>>().join(" ")
}

/// A path that no one takes for an option.
pub fn as_path(path: &str) -> String {
    if path.starts_with('-') {
        format!("./{path}")
    } else {
        path.to_owned()
    }
}

/// The name of the picture beside the scene's name.
pub(in crate::viewer) fn output_name(label: &str) -> String {
    let file = label.rsplit(['/', '\\']).next().unwrap_or(label);
    let stem = file.rsplit_once('.').map_or(file, |(stem, _)| stem);
    format!("{}.png", if stem.is_empty() { "picture" } else { stem })
}

/// `word` as one word of a POSIX shell.
fn shell_quoted(word: &str) -> String {
    let bare = |c: char| c.is_ascii_alphanumeric() || "/._-+:,@%=".contains(c);
    if !word.is_empty() && word.chars().all(bare) {
        return word.to_owned();
    }
    if word.chars().all(plain::is_plain) {
        return format!("'{}'", word.replace('\'', r"'\''"));
    }
    // What steers a terminal stands as its bytes, so that the line can be looked at and still means the same
    // (dollar-single-quotes, POSIX.1-2024, 2.2.4).
    let mut quoted = "$'".to_owned();
    for character in word.chars() {
        match character {
            '\'' | '\\' => quoted.extend(['\\', character]),
            _ if plain::is_plain(character) => quoted.push(character),
            _ => {
                let bytes = character.to_string().into_bytes();
                quoted.extend(bytes.iter().map(|byte| format!("\\{byte:03o}")));
            }
        }
    }
    quoted.push('\'');
    quoted
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shell_quoting() {
        for (word, quoted) in [
            ("svg/basic/test4.svg", "svg/basic/test4.svg"),
            ("my scene.svg", "'my scene.svg'"),
            ("it's.svg", r"'it'\''s.svg'"),
            ("#ff8000", "'#ff8000'"),
            ("--view=-1,2,3", "--view=-1,2,3"),
            ("$(x)", "'$(x)'"),
            ("", "''"),
            ("a\u{1b}[m'\\\nb", r"$'a\033[m\'\\\012b'"),
            ("\u{202e}gvs", r"$'\342\200\256gvs'"),
        ] {
            assert_eq!(shell_quoted(word), quoted, "{word}");
        }
    }

    #[test]
    fn paths_are_no_options() {
        assert_eq!(as_path("-o.svg"), "./-o.svg", "a file of that name");
        assert_eq!(as_path("a-o.svg"), "a-o.svg", "as it is");
    }

    #[test]
    fn relative_paths_lead_from_folder_to_file() {
        let root = tempfile::tempdir().expect("a temporary folder");
        let at = |name: &str| root.path().join(name);
        std::fs::create_dir_all(at("out/deep")).expect("folders");
        std::fs::create_dir_all(at("scenes")).expect("a folder");
        std::fs::write(at("scenes/a.svg"), "").expect("a file");
        for (folder, way) in [
            ("out/deep", "../../scenes/a.svg"),
            ("scenes", "a.svg"),
            ("", "scenes/a.svg"),
        ] {
            assert_eq!(
                relative_path(&at(folder), &at("scenes/a.svg")).as_deref(),
                Some(way),
                "{folder}"
            );
        }
        assert_eq!(
            relative_path(&at("nowhere"), &at("scenes/a.svg")),
            None,
            "no such folder"
        );
    }

    #[test]
    fn output_beside_nothing() {
        for (label, name) in [
            ("basic/test4.svg", "test4.png"),
            ("a.b.svg", "a.b.png"),
            (".svg", "picture.png"),
            ("x", "x.png"),
        ] {
            assert_eq!(output_name(label), name, "{label}");
        }
    }
}
