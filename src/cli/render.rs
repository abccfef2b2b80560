//! `rasterscope render`: a scene, or every scene in a folder, into PNG files.

use std::collections::HashSet;
use std::io;
use std::path::{Path, PathBuf};

use super::failure::{Failure, print_error};
use super::options::render::RenderOptions;
use super::picture::{Picture, on_threads, spec, tell_reading};
use super::progress;
use crate::figure::{Destination, Guard, save_picture};
use crate::scene::DialectChoice;
use crate::viewer::{PictureSpec, Restored, SceneEntry, SceneSource, in_gallery, list_scenes};

/// Draws what the options ask for.
pub(super) fn run(options: &RenderOptions, restored: Option<&Restored>) -> Result<(), Failure> {
    on_threads(options.picture.framing.threads, || {
        if options.scene.is_dir() {
            folder(options)
        } else {
            if let SceneSource::File(path) = SceneSource::from_address(&options.scene)
                && in_gallery(&path).is_none()
            {
                // What is asked for decides whether the output is a picture or a folder.
                ask_for(&path)?;
            }
            name_for_png(&options.output)?;
            let scene = SceneToDraw {
                source: SceneSource::from_address(&options.scene),
                is_of_course: false,
            };
            one(scene, Destination::by_user(&options.output), options, restored)
        }
    })?
}

/// Says that there is nothing to draw at this place.
fn ask_for(path: &Path) -> Result<(), Failure> {
    match path.metadata() {
        Err(error) if error.kind() == io::ErrorKind::NotFound => Err(Failure::input(format!(
            "{}: there is no such file or folder; give the path of an SVG file, or of a folder of them",
            path.display()
        ))),
        _ => Ok(()),
    }
}

/// Every scene below a folder, into a folder of the same shape.
fn folder(options: &RenderOptions) -> Result<(), Failure> {
    if options.output.exists() && !options.output.is_dir() {
        return Err(Failure::input(format!(
            "{}: there is a file of that name, and the pictures of a folder go into one; give a folder with -o",
            options.output.display()
        )));
    }
    if !options.output.exists() && is_named_like_a_picture(&options.output) {
        return Err(Failure::input(format!(
            "{}: the pictures of a folder go into a folder, and this is the name of one picture; give another with -o",
            options.output.display()
        )));
    }
    let (entries, problems) = list_scenes(std::slice::from_ref(&options.scene));
    if let Some(problem) = problems.into_iter().next() {
        return Err(Failure::Input(problem));
    }
    progress::count(entries.len());
    let mut failed = 0;
    let mut taken = HashSet::new();
    for entry in &entries {
        progress::begin(&entry.label);
        let output = picture_of(entry, options);
        let drawn = if taken.insert(output.clone()) {
            let scene = SceneToDraw {
                source: entry.source.clone(),
                is_of_course: entry.is_of_course,
            };
            one(scene, Destination::by_program(&output), options, None)
        } else {
            let (scene, output) = (entry.source.address(), output.display());
            Err(Failure::input(format!(
                "{scene}: another scene's picture is {output} already; rename the scene"
            )))
        };
        match drawn {
            Ok(()) => {}
            Err(Failure::Input(problem)) => {
                failed += 1;
                print_error(&problem);
            }
            Err(other) => return Err(other),
        }
        progress::done();
    }
    if failed > 0 {
        let all = entries.len();
        return Err(Failure::input(format!(
            "{failed} of {all} pictures were not written: each has its line above"
        )));
    }
    Ok(())
}

/// Whether somebody who names a file so means a picture.
fn is_named_like_a_picture(output: &Path) -> bool {
    let ending = output.extension().unwrap_or_default();
    ["png", "jpg", "jpeg"]
        .iter()
        .any(|known| ending.eq_ignore_ascii_case(known))
}

/// Where the picture of a scene in a folder goes: the same place in the output folder.
fn picture_of(entry: &SceneEntry, options: &RenderOptions) -> PathBuf {
    let inner = match &entry.source {
        SceneSource::File(path) => path.strip_prefix(&options.scene).unwrap_or(path),
        SceneSource::Gallery(_) => Path::new(&entry.label),
    };
    options.output.join(inner).with_extension("png")
}

/// A scene to be drawn.
struct SceneToDraw {
    source: SceneSource,
    /// Whether it lies in a folder of the course's.
    is_of_course: bool,
}

/// Draws a scene.
fn one(
    scene: SceneToDraw,
    output: Destination<'_>,
    options: &RenderOptions,
    restored: Option<&Restored>,
) -> Result<(), Failure> {
    let SceneToDraw { source, is_of_course } = scene;
    let Destination { path: output, named } = output;
    let mut guard = guard_of(options.force, restored);
    if let SceneSource::File(path) = &source {
        guard.protect(path);
    }
    // Asked before the work as well.
    guard
        .target(output, named)
        .map_err(|error| unwritable(output, &error))?;
    let sampling = &options.picture.sampling;
    let (dialect, why) = match (sampling.dialect(), sampling.reading()) {
        (DialectChoice::Auto, DialectChoice::Course) => (DialectChoice::Course, ", as --rules course asks for"),
        (DialectChoice::Auto, _) if is_of_course => (DialectChoice::AmongCourse, ", as other scenes of the folder are"),
        (dialect, _) => (dialect, ""),
    };
    let scene = PictureSpec {
        scene: source.clone(),
        dialect,
        legend: !options.no_legend,
        insets: options.insets.clone(),
        ..spec(&options.scene, &options.picture)
    };
    let mut picture = Picture::read(scene)?;
    if !why.is_empty() {
        tell_reading(&source, &picture.scene, why);
    }
    picture.tell_changes(restored);
    picture.protect(&mut guard);
    picture.draw_figure()?;
    if let Some(folder) = folder_to_make(output, options) {
        std::fs::create_dir_all(&folder).map_err(|error| unwritable(&folder, &error))?;
    }
    let record = picture.record(output);
    save_picture(
        picture.frame(),
        Some(&record),
        Destination { path: output, named },
        &guard,
    )
    .map_err(|error| unwritable(output, &error))
}

/// The folder of an output among many; a single picture goes only where its user has made room.
fn folder_to_make(output: &Path, options: &RenderOptions) -> Option<PathBuf> {
    (output != options.output)
        .then(|| output.parent().map(Path::to_owned))
        .flatten()
}

/// Says before anything is drawn that a name is none for a PNG.
pub(super) fn name_for_png(output: &Path) -> Result<(), Failure> {
    if output
        .extension()
        .is_some_and(|ending| ending.eq_ignore_ascii_case("png"))
    {
        return Ok(());
    }
    let cure = if output.is_dir() {
        "this is a folder; give the name of a picture in it, which ends in .png"
    } else {
        "pictures are written as PNG; give a name that ends in .png"
    };
    Err(Failure::input(format!("{}: {cure}", output.display())))
}

/// Protects the picture that a scene and its settings come from.
pub(super) fn guard_of(force: bool, restored: Option<&Restored>) -> Guard {
    let mut guard = Guard::new(force);
    if let Some(restored) = restored {
        guard.protect(&restored.shot);
    }
    guard
}

/// A file could not be written.
pub(super) fn unwritable(path: &Path, error: &io::Error) -> Failure {
    unwritable_by("-o", path, error)
}

/// As [`unwritable`], where another `option` names the place.
pub(super) fn unwritable_by(option: &str, path: &Path, error: &io::Error) -> Failure {
    if error.kind() == io::ErrorKind::OutOfMemory {
        let path = path.display();
        return Failure::other(format!(
            "{path}: not written: out of memory; close other programs, or draw fewer pixels with --size"
        ));
    }
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty());
    if let Some(folder) = folder.filter(|folder| error.kind() == io::ErrorKind::NotFound && !folder.exists()) {
        return Failure::input(format!(
            "{}: cannot write here: there is no folder {}; make it, or choose another place with {option}",
            path.display(),
            folder.display()
        ));
    }
    let line = format!(
        "{}: cannot write here: {error}; choose another place with {option}",
        path.display()
    );
    // Nothing is wrong with the place itself.
    match error.kind() {
        io::ErrorKind::StorageFull | io::ErrorKind::QuotaExceeded | io::ErrorKind::FileTooLarge => Failure::other(line),
        _ => Failure::input(line),
    }
}
