//! `rasterscope rerun`: draws again what a picture shows, by the command line in its file, and compares.

use std::path::{Path, PathBuf};

use super::arguments::Verb;
use super::failure::{Failure, print, print_error};
use super::options::rerun::RerunOptions;
use super::picture::{Picture, on_threads};
use super::render::{name_for_png, unwritable};
use super::restore::{missing_fonts, read_arguments, scene_path, verb_of};
use super::{board, diff, lesson, sheet, spectrum};
use crate::compare;
use crate::figure::{Destination, Guard, Named, Record, RecordError, save_picture};
use crate::plain;
use crate::raster::Framebuffer;
use crate::scene::FolderResources;
use crate::viewer::{Restored, SceneSource, changed_inputs, found_file, shell_line};

/// A picture that was drawn again.
struct Again {
    frame: Framebuffer,
    /// For the file that it may be written to.
    record: Record,
    /// What of its files has changed, in one line.
    change: Option<String>,
    /// Protects what it was drawn from.
    guard: Guard,
}

/// Draws, and compares or writes.
pub(super) fn run(options: &RerunOptions) -> Result<(), Failure> {
    let shot = options.shot.as_path();
    if !options.check && options.output.is_none() {
        return Err(Failure::input(format!(
            "{}: what is to be done? --check compares it with what is drawn now, -o OUT.png writes that",
            shot.display()
        )));
    }
    if let Some(output) = &options.output {
        name_for_png(output)?;
    }
    let record = record_of(shot)?;
    if let Some(output) = &options.output {
        let target = guard(options).target(output, Named::ByUser);
        target.map_err(|error| unwritable(output, &error))?;
    }
    if let Some(differs) = &record.differs {
        let line = format!("{}: {differs}", shot.display());
        if options.check {
            return Err(Failure::input(format!(
                "{line}; the command line is: {}",
                shell_line(&record.arguments)
            )));
        }
        print_error(&line);
    }
    if let Some(fonts) = missing_fonts(&record) {
        print_error(&format!("{}: {fonts}", shot.display()));
    }
    let verb = verb_of(&record.arguments).map_err(|error| at_fault(shot, &error))?;
    let verb = with_inputs_found(options, verb, &record)?;
    let mut again = on_threads(options.threads, || draw(options, verb, &record))??;
    if !record.inputs.is_empty() {
        again.change = changed_inputs(&record, &again.record, shot);
    }
    if options.check {
        return check(shot, &again);
    }
    if let Some(change) = &again.change {
        print_error(&format!("{change}: the picture may differ"));
    }
    let output = options.output.as_deref().unwrap_or(shot);
    let named = Destination::by_user(output);
    save_picture(&again.frame, Some(&again.record), named, &again.guard).map_err(|error| unwritable(output, &error))
}

/// Protects the picture that is drawn again, and the scene that stands for its own.
fn guard(options: &RerunOptions) -> Guard {
    let mut guard = Guard::default().with(&options.shot);
    if let Some(scene) = &options.scene {
        guard.protect(scene);
    }
    guard
}

/// What the picture tells.
fn record_of(shot: &Path) -> Result<Record, Failure> {
    let name = shot.display();
    let found = Record::of_file(shot).map_err(|error| {
        let cure = match error {
            RecordError::Newer { .. } => "",
            _ => "; give a PNG that rasterscope wrote",
        };
        Failure::input(format!("{name}: {error}{cure}"))
    })?;
    found.ok_or_else(|| {
        Failure::input(format!(
            "{name}: no record in this file; give a PNG that rasterscope wrote and no other program has changed"
        ))
    })
}

fn at_fault(shot: &Path, error: &str) -> Failure {
    let name = shot.display();
    Failure::input(format!(
        "{name}: the command line in this picture is at fault: {error}; give a PNG that rasterscope wrote"
    ))
}

/// Draws what the record tells, by the same code as the command that it names.
fn draw(options: &RerunOptions, verb: Verb, record: &Record) -> Result<Again, Failure> {
    let shot = options.shot.as_path();
    let output = options.output.as_deref().unwrap_or(shot);
    let alone = |(frame, record)| Again {
        frame,
        record,
        change: None,
        guard: guard(options),
    };
    let protected = |(frame, record, inputs): (Framebuffer, Record, Guard)| Again {
        guard: inputs.with(shot),
        ..alone((frame, record))
    };
    match verb {
        Verb::Render(_) => {
            let restored = restored(options)?;
            let mut picture = Picture::read(restored.spec.clone())?;
            picture.draw_figure()?;
            let mut guard = guard(options);
            picture.protect(&mut guard);
            Ok(Again {
                guard,
                record: picture.record(output),
                change: restored.changed(&picture.scene.files),
                frame: picture.into_frame(),
            })
        }
        Verb::Sheet(mut of_sheet) => {
            let restored = restored(options)?;
            of_sheet.scene = scene_path(&restored);
            let sheet = sheet::draw(&of_sheet, output)?;
            let files = sheet.panels.first().map(|panel| &panel.scene.files);
            let mut guard = guard(options);
            for panel in &sheet.panels {
                panel.spec.scene.protect(&panel.scene.files, &mut guard);
            }
            Ok(Again {
                guard,
                change: files.and_then(|files| restored.changed(files)),
                record: sheet.record,
                frame: sheet.picture,
            })
        }
        Verb::Board(mut of_board) => {
            let restored = restored(options)?;
            of_board.scene = scene_path(&restored);
            board::picture_of(&of_board, output).map(protected)
        }
        Verb::Spectrum(mut of_spectrum) => {
            let restored = restored(options)?;
            of_spectrum.scene = scene_path(&restored);
            spectrum::picture_of(&of_spectrum, output).map(protected)
        }
        Verb::Diff(of_diff) => diff::picture(&of_diff, output).map(protected),
        Verb::Lesson(of_lesson) if of_lesson.slides.is_some() && of_lesson.step.is_some() => {
            let mut again = alone(lesson::picture(&of_lesson, output)?);
            if options.output.is_some() {
                lesson::protect(&of_lesson, &mut again.guard)?;
            }
            Ok(again)
        }
        _ => Err(Failure::input(format!(
            "{}: such a picture cannot be drawn again alone; run its command line: {}",
            shot.display(),
            shell_line(&record.arguments)
        ))),
    }
}

/// The command with the files of a difference or a lesson where they are found now, as scenes are.
fn with_inputs_found(options: &RerunOptions, verb: Verb, record: &Record) -> Result<Verb, Failure> {
    let shot = options.shot.as_path();
    let find = |path: &mut PathBuf, input: usize| {
        let Some(input) = record.inputs.get(input) else {
            return Ok(());
        };
        let SceneSource::File(named) = SceneSource::from_address(path) else {
            return Ok(());
        };
        *path = found_file(input, &named, shot);
        if path.is_file() {
            return Ok(());
        }
        Err(Failure::input(format!(
            "{}: it was made from {}, which is not there; put that back, or run its command line with another file: {}",
            shot.display(),
            input.address,
            shell_line(&record.arguments)
        )))
    };
    match verb {
        Verb::Diff(mut of_diff) => {
            match &options.scene {
                Some(scene) if diff::is_scene(&of_diff.a) => of_diff.a.clone_from(scene),
                Some(_) => return Err(no_scene(shot)),
                None => find(&mut of_diff.a, 0)?,
            }
            find(&mut of_diff.b, 1)?;
            Ok(Verb::Diff(of_diff))
        }
        Verb::Lesson(_) if options.scene.is_some() => Err(no_scene(shot)),
        Verb::Lesson(mut of_lesson) => {
            find(&mut of_lesson.lesson, 0)?;
            Ok(Verb::Lesson(of_lesson))
        }
        verb => Ok(verb),
    }
}

/// A scene was given for a picture that has none.
fn no_scene(shot: &Path) -> Failure {
    Failure::input(format!(
        "{}: this picture is not drawn from a scene that --scene could name; leave --scene out",
        shot.display()
    ))
}

/// The state that the picture tells, with the scene that the options name.
fn restored(options: &RerunOptions) -> Result<Restored, Failure> {
    let shot = options.shot.as_path();
    let found = Restored::of_file(shot, read_arguments).map_err(Failure::Input)?;
    let mut restored = found.ok_or_else(|| at_fault(shot, "it is gone"))?;
    match (&options.scene, &restored.spec.scene) {
        (Some(scene), _) => restored.spec.scene = SceneSource::from_address(scene),
        (None, SceneSource::File(path)) if !path.exists() => {
            return Err(Failure::input(format!(
                "{}: its scene {} is not there; name it with --scene FILE",
                shot.display(),
                path.display()
            )));
        }
        (None, _) => {}
    }
    Ok(restored)
}

/// Compares every pixel and says what was found.
fn check(shot: &Path, again: &Again) -> Result<(), Failure> {
    let name = shot.display().to_string();
    let name = plain::line(&name);
    let unreadable = |error: &dyn std::fmt::Display| {
        Failure::input(format!(
            "{name}: cannot be read as a picture: {error}; give a whole PNG"
        ))
    };
    let bytes = FolderResources::read_file(shot).map_err(|error| unreadable(&error))?;
    let size = compare::encoded_size(&bytes).map_err(|error| unreadable(&error))?;
    let change = again.change.as_ref().map(|change| plain::line(change));
    let why = change.as_ref().map_or(String::new(), |change| format!("; {change}"));
    let now = [again.frame.width(), again.frame.height()];
    if size != now {
        let ([w, h], [w2, h2]) = (size, now);
        print(&format!(
            "{name}: differs: {w} x {h} pixels, drawn again {w2} x {h2}{why}"
        ))?;
        return Err(Failure::Different);
    }
    let all = again.frame.pixels().len();
    let different = compare::count_different(&bytes, &again.frame).map_err(|error| unreadable(&error))?;
    if different == 0 {
        let although = change.map_or(String::new(), |change| format!(", although {change}"));
        let all = if all == 1 {
            "the only pixel".to_owned()
        } else {
            format!("all {all} pixels")
        };
        return print(&format!("{name}: the same, {all}{although}"));
    }
    print(&format!("{name}: differs in {different} of {all} pixels{why}"))?;
    Err(Failure::Different)
}
