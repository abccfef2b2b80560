//! `rasterscope sheet`: one picture for each combination of settings, in a labelled grid.

use std::path::Path;
use std::sync::Arc;

use super::failure::{Failure, print_error};
use super::memory;
use super::options::lists::sampling;
use super::options::sheet::SheetOptions;
use super::picture::{on_threads, read_scene};
use super::render::{guard_of, name_for_png, unwritable};
use super::size::FrameSize;
use crate::figure::{Destination, Figure, Guard, Named};
use crate::viewer::{Choice, PictureSpec, Restored, SceneSource, Sheet, SheetRequest};

/// Draws the sheet and writes it, its panels and the snippets.
pub(super) fn run(options: &SheetOptions, restored: Option<&Restored>) -> Result<(), Failure> {
    name_for_png(&options.output)?;
    let mut guard = guard_of(options.force, restored);
    if let SceneSource::File(path) = SceneSource::from_address(&options.scene) {
        guard.protect(path);
    }
    let output = Destination::by_user(&options.output);
    check(&request(options).map_err(Failure::Input)?, output, &guard)?;
    let sheet = on_threads(options.framing.threads, || draw(options, &options.output))??;
    let files = sheet.panels.first().map(|panel| &panel.scene.files);
    if let Some(change) = restored
        .zip(files)
        .and_then(|(restored, files)| restored.changes(files))
    {
        print_error(&change);
    }
    write(&sheet, output, &guard).map(|_| ())
}

/// Says before anything is drawn which file would not be replaced.
pub(super) fn check(request: &SheetRequest, output: Destination<'_>, guard: &Guard) -> Result<(), Failure> {
    let beside = request.files_beside(output.path).into_iter();
    for (path, named) in beside
        .map(|path| (path, Named::ByProgram))
        .chain([(output.path.to_owned(), output.named)])
    {
        guard.target(&path, named).map_err(|error| unwritable(&path, &error))?;
    }
    Ok(())
}

/// Draws every panel and puts them together; `output` is the file that the record names.
pub(super) fn draw(options: &SheetOptions, output: &Path) -> Result<Sheet, Failure> {
    let request = request(options).map_err(Failure::Input)?;
    request.check_size().map_err(Failure::Input)?;
    memory::ask_for(request.pixels())?;
    let scene = SceneSource::from_address(&options.scene);
    // Its status says whether the scene is at fault.
    let mut unread = None;
    let mut read = |dialect| {
        let scene = read_scene(&scene, dialect).map(Arc::new);
        scene.map_err(|failure| unread.insert(failure).clone().into_line())
    };
    let drawn = request.draw(&mut read, output);
    drawn.map_err(|line| unread.unwrap_or(Failure::Input(line)))
}

/// Writes all files of a sheet, or none; gives what documents say about the sheet, from the folder it lies in.
pub(super) fn write(sheet: &Sheet, output: Destination<'_>, guard: &Guard) -> Result<Figure, Failure> {
    sheet
        .save(output, guard)
        .map_err(|(path, error)| unwritable(&path, &error))
}

/// What the first panel shows: the state that a sheet brings back.
///
/// # Errors
/// One line.
pub(super) fn spec(options: &SheetOptions) -> Result<PictureSpec, String> {
    let request = request(options)?;
    let first = request.first().cloned();
    first.ok_or_else(|| "a sheet without panels".to_owned())
}

/// What the options ask for.
///
/// # Errors
/// One line.
pub(super) fn request(options: &SheetOptions) -> Result<SheetRequest, String> {
    let axes = options.axis_lists()?;
    let page = SheetRequest::page_panel(&axes);
    let size = options.size.map_or([page; 2], |FrameSize(size)| size);
    let mut request = SheetRequest::new(axes, |choice| panel(options, choice, size))?;
    request.theme = options.theme;
    request.note.clone_from(&options.note);
    Ok(request)
}

/// What a panel of this size shows.
fn panel(options: &SheetOptions, choice: &Choice, size: [u32; 2]) -> Result<PictureSpec, String> {
    let sampling = sampling(choice)?;
    Ok(PictureSpec {
        scene: SceneSource::from_address(&options.scene),
        size,
        view: options.framing.view,
        render: sampling.settings(options.framing.view),
        dialect: options.axes.reading(&sampling),
        insets: options.insets.clone(),
        // The sheet has one for all panels.
        legend: false,
    })
}
