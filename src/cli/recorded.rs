//! Pictures as arguments: the command line that a PNG carries, read by the grammar of the command line.

use std::ffi::OsString;
use std::path::{Path, PathBuf};

use super::arguments::{self, Arguments, PictureOptions, RenderOptions, Verb};
use super::failure::Failure;
use crate::figure::Record;
use crate::viewer::{Grammar, PictureSpec, Restored, SceneSource, SheetRequest};

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
        _ => Err("this is no sheet".to_owned()),
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
        _ => Err(NO_SCENE.to_owned()),
    }
}

/// The command that arguments name, such as a record tells.
pub(super) fn verb_of(arguments: &[String]) -> Result<Verb, String> {
    // A name without a command would open the window.
    let words = ["rasterscope"].into_iter().chain(arguments.iter().map(String::as_str));
    match arguments::parse_words(words.map(OsString::from).collect(), false) {
        Ok(Arguments { verb }) => Ok(verb),
        Err(Failure::Input(problem) | Failure::Other(problem)) => Err(problem),
        Err(Failure::Text(_) | Failure::Different) => Err("it asks for help".to_owned()),
    }
}

/// The figure that `render` draws of one scene.
pub(super) fn spec_of_render(options: &RenderOptions) -> PictureSpec {
    PictureSpec {
        insets: options.insets.clone(),
        legend: !options.no_legend,
        ..spec(&options.scene, &options.picture)
    }
}

/// The picture that options ask for.
pub(super) fn spec(scene: &Path, options: &PictureOptions) -> PictureSpec {
    PictureSpec {
        scene: SceneSource::from_address(scene),
        size: options.size.0,
        view: options.framing.view,
        render: options.sampling.settings(options.framing.view),
        dialect: options.sampling.reading(),
        legend: true,
        insets: Vec::new(),
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
    Restored::of_file(scene, read_arguments).map_err(Failure::Input)
}

/// The scene's path, as the command line takes it.
pub(super) fn scene_path(restored: &Restored) -> PathBuf {
    restored.spec.scene.address().into()
}
