//! Pictures as arguments: the command line that a PNG carries, read by the grammar of the command line.

use std::ffi::OsString;
use std::path::{Path, PathBuf};

use super::arguments::{self, Arguments, Verb};

use super::failure::Failure;
use super::picture::spec_of_render;
use crate::figure::Record;
use crate::scene;
use crate::viewer::{Grammar, PictureSetting, PictureSpec, Restored, SceneSource, SheetRequest, picture};

/// Longest side of a window that comes back from a picture, in pixels.
const MAX_RESTORED_WINDOW: u32 = 4096;

/// What is wrong with a command line that shows something else.
const NO_SCENE: &str = "it draws no scene";

/// The grammar of the command line, for viewers.
pub const GRAMMAR: Grammar = Grammar {
    picture: read_arguments,
    sheet: read_sheet,
};

/// What the words of a `sheet` command ask for.
///
/// # Errors
/// One line when they are none.
fn read_sheet(words: &[String]) -> Result<SheetRequest, String> {
    match verb_of(words)? {
        Verb::Sheet(options) => super::sheet::request(&options),
        _ => Err("this is not a sheet".to_owned()),
    }
}

/// What the command line of a record draws.
///
/// # Errors
/// One line when it is none that draws a scene.
pub(super) fn read_arguments(record: &Record) -> Result<PictureSpec, String> {
    match verb_of(&record.arguments)? {
        Verb::Render(options) => Ok(spec_of_render(&options)),
        Verb::Sheet(options) => super::sheet::spec(&options),
        Verb::Board(options) => Ok(super::board::own(&options)),
        Verb::Spectrum(options) => Ok(super::spectrum::own(&options)),
        _ => Err(NO_SCENE.to_owned()),
    }
}

/// The command that arguments name, such as a record tells.
pub(super) fn verb_of(arguments: &[String]) -> Result<Verb, String> {
    Ok(arguments_of(arguments)?.verb)
}

/// What tells that a picture was drawn with typefaces that were not chosen now. They are not taken from a record, which may
/// name any folder of the disk.
pub(super) fn missing_fonts(record: &Record) -> Option<String> {
    let mut fonts = arguments_of(&record.arguments).ok()?.fonts;
    let chosen = scene::more_fonts();
    fonts.retain(|font| !chosen.contains(font));
    let options: Vec<String> = fonts.iter().map(|font| format!("--font {}", font.display())).collect();
    (!options.is_empty()).then(|| format!("drawn with {}; give it for the same letters", options.join(" ")))
}

fn arguments_of(arguments: &[String]) -> Result<Arguments, String> {
    // A name without a command would open the window.
    let words = ["rasterscope"].into_iter().chain(arguments.iter().map(String::as_str));
    match arguments::parse_words(words.map(OsString::from).collect(), false) {
        Ok(arguments) => Ok(arguments),
        Err(Failure::Input(problem) | Failure::Other(problem)) => Err(problem),
        Err(_) => Err("it asks for help".to_owned()),
    }
}

/// The state that a picture tells, for a command whose scene it stands for; `None` for what is no such picture.
pub(super) fn restored(scene: &Path) -> Result<Option<Restored>, Failure> {
    let is_png = scene
        .extension()
        .is_some_and(|ending| ending.eq_ignore_ascii_case("png"));
    if !is_png || !scene.is_file() {
        return Ok(None);
    }
    let restored = Restored::of_file(scene, read_arguments).map_err(Failure::Input)?;
    match restored.as_ref().map(|restored| &restored.spec.scene) {
        Some(SceneSource::File(path)) if !path.exists() => Err(Failure::input(format!(
            "{0}: its scene {1} is not there; give the scene instead, or draw the picture with `rasterscope rerun {0} --scene FILE -o OUT.png`",
            scene.display(),
            path.display()
        ))),
        _ => Ok(restored),
    }
}

/// The scene's path, as the command line takes it.
pub(super) fn scene_path(restored: &Restored) -> PathBuf {
    restored.spec.scene.address().into()
}

/// What the value of an option may name files in.
#[derive(Clone, Copy)]
enum Holds {
    /// A list of values of a setting.
    Values(&'static PictureSetting),
    /// Changes of settings, such as `sample-rate 16, pattern own.toml`.
    Changes,
    /// A setting and a list of its values, `pattern=grid,own.toml`.
    Axis,
}

impl Holds {
    /// What an option without its dashes holds; `None` where it names no files, or files that are read later.
    fn of(option: &str) -> Option<Self> {
        match option {
            "with" | "against" => Some(Self::Changes),
            "vary" => Some(Self::Axis),
            option => picture::find(option)
                .filter(|setting| setting.reads_files())
                .map(Self::Values),
        }
    }

    /// The same value with the contents of files in place of their names.
    fn read(self, value: &str) -> Result<String, String> {
        match self {
            Self::Values(setting) => setting.read_list(value),
            Self::Changes => picture::read_files(value, None),
            Self::Axis => match value.split_once('=') {
                Some((name, values)) => match Self::of(name.trim()) {
                    Some(Self::Values(setting)) => Ok(format!("{name}={}", setting.read_list(values)?)),
                    _ => Ok(value.to_owned()),
                },
                None => Ok(value.to_owned()),
            },
        }
    }
}

/// The same words with the contents of files in place of their names, where the values of a setting may lie in files. Only a
/// person's own words come here; the command line of a record names no file.
///
/// # Errors
/// When a file holds no value of its setting.
fn with_files_read(words: Vec<OsString>) -> Result<Vec<OsString>, Failure> {
    let mut before: Option<(String, Holds)> = None;
    let mut is_option = true;
    let read = |word: OsString| {
        let text = word.to_str().unwrap_or_default();
        let (head, option, holds, value) = match (before.take(), text.strip_prefix("--")) {
            (Some((option, holds)), _) => (String::new(), option, holds, text),
            (None, Some("")) => {
                is_option = false;
                return Ok(word);
            }
            (None, Some(option)) if is_option => {
                let (name, value) = option
                    .split_once('=')
                    .map_or((option, None), |(name, value)| (name, Some(value)));
                let holds = Holds::of(name).map(|holds| (name.to_owned(), holds));
                match (holds, value) {
                    (Some((name, holds)), Some(value)) => (format!("--{name}="), name, holds, value),
                    (holds, _) => {
                        before = holds.filter(|_| value.is_none());
                        return Ok(word);
                    }
                }
            }
            _ => return Ok(word),
        };
        let values = holds
            .read(value)
            .map_err(|problem| Failure::input(format!("--{option}: {problem}")))?;
        Ok(if values == value {
            word.clone()
        } else {
            (head + &values).into()
        })
    };
    words.into_iter().map(read).collect()
}

/// Reads the arguments, the program's name first. Where a picture that tells how it was made stands for the scene, its
/// options come before those that were written, so that these count.
pub(super) fn parse(arguments: impl IntoIterator<Item = OsString>) -> Result<(Arguments, Option<Restored>), Failure> {
    let words = with_files_read(arguments::with_default_command(arguments.into_iter().collect())?)?;
    let mut arguments = arguments::parse_words(words.clone(), false)?;
    let is_view = matches!(arguments.verb, Verb::View(_));
    let Some(restored) = arguments.verb.scene().map_or(Ok(None), |scene| restored(scene))? else {
        return Ok((arguments, None));
    };
    let mut options = restored.spec.options();
    if is_view && restored.spec.size.iter().any(|side| *side > MAX_RESTORED_WINDOW) {
        // `--size` and its value: no screen is that large.
        options.drain(..2);
    }
    if matches!(arguments.verb, Verb::Render(_) | Verb::Sheet(_)) {
        options.extend(restored.spec.inset_options());
    }
    if matches!(arguments.verb, Verb::Render(_)) {
        options.extend(restored.spec.legend_option());
    }
    let command = words.len().min(2);
    let words = [
        &words[..command],
        &options.iter().map(OsString::from).collect::<Vec<_>>(),
        &words[command..],
    ]
    .concat();
    let mut arguments = arguments::parse_words(words, true)?;
    if let Some(scene) = arguments.verb.scene() {
        *scene = scene_path(&restored);
    }
    Ok((arguments, Some(restored)))
}
