//! `rasterscope lesson`: opens a lesson in the window, or draws its steps as slides.

use std::path::{Path, PathBuf};

use super::arguments::{LessonOptions, ViewerOptions};
use super::failure::Failure;
use super::{memory, progress, render, view};
use crate::figure::{Guard, Named, Record, save_picture};
use crate::raster::Framebuffer;
use crate::viewer::{BUILT_IN, LessonSource, as_path, plain_record, slides};

/// The size of slides where none is asked for.
const SLIDE: [u32; 2] = [1600, 900];
/// The least that words and picture need.
const LEAST: [u32; 2] = [480, 270];

/// Opens the lesson, or writes its slides.
pub(super) fn run(options: &LessonOptions) -> Result<(), Failure> {
    let source = source(&options.lesson)?;
    if let Some(folder) = &options.slides {
        let guard = Guard::new(options.view.force);
        return draw(options, |slide, path, record| {
            // Only now, so that a lesson that is refused leaves no empty folder.
            std::fs::create_dir_all(folder).map_err(|error| render::unwritable_by("--slides", folder, &error))?;
            let saved = save_picture(slide, Some(record), (&path, Named::ByProgram), &guard);
            progress::done();
            saved.map_err(|error| render::unwritable_by("--slides", &path, &error))
        });
    }
    source.read().map_err(Failure::input)?;
    let view = ViewerOptions {
        paths: vec![PathBuf::from(source.address())],
        ..options.view.clone()
    };
    view::run(&view, None)
}

/// The one slide that the options ask for, and its record.
pub(super) fn picture(options: &LessonOptions) -> Result<(Framebuffer, Record), Failure> {
    let mut only = None;
    draw(options, |slide, _, record| {
        only = Some((slide.clone(), record.clone()));
        Ok(())
    })?;
    only.ok_or_else(|| Failure::other("a lesson without steps"))
}

/// The lesson that a person names; those of the program need no prefix.
fn source(address: &Path) -> Result<LessonSource, Failure> {
    let named = BUILT_IN.iter().position(|(name, _)| Path::new(name) == address);
    let source = named.map(LessonSource::BuiltIn);
    source.or_else(|| LessonSource::from_address(address)).ok_or_else(|| {
        let names: Vec<&str> = BUILT_IN.iter().map(|(name, _)| *name).collect();
        Failure::input(format!(
            "{}: no lesson; give a file that ends in .toml, or one of {}",
            address.display(),
            names.join(", ")
        ))
    })
}

/// Draws the slides that the options ask for and hands each over, with its file and its record.
fn draw(
    options: &LessonOptions,
    mut take: impl FnMut(&Framebuffer, PathBuf, &Record) -> Result<(), Failure>,
) -> Result<(), Failure> {
    let source = source(&options.lesson)?;
    let lesson = source.read().map_err(Failure::input)?;
    let size = options.view.size.map_or(SLIDE, |size| size.0);
    if size[0] < LEAST[0] || size[1] < LEAST[1] {
        return Err(Failure::input(format!(
            "--size {}x{}: too small for words and picture; give {}x{} or more",
            size[0], size[1], LEAST[0], LEAST[1]
        )));
    }
    let count = lesson.steps.len();
    let numbers = match options.step.map(|step| usize::try_from(step).unwrap_or(usize::MAX)) {
        None => 1..=count,
        Some(step) if step <= count => step..=step,
        Some(step) => {
            let name = options.lesson.display();
            return Err(Failure::input(format!(
                "{name}: there is no step {step}; it has {count}"
            )));
        }
    };
    progress::count(numbers.clone().count());
    memory::ask_for(memory::pixels(size).saturating_mul(3))?;
    let folder = options.slides.as_deref().unwrap_or(Path::new(""));
    let digits = count.to_string().len().max(2);
    slides(&lesson, size, numbers, |number, slide| {
        let record = record(&source, (folder, number), size);
        let path = folder.join(format!("{number:0digits$}.png"));
        take(slide, path, &record).map_err(SlideFailure)
    })
    .map_err(|SlideFailure(failure)| failure)
}

/// The record of the slide with this number in a folder: words and picture, so that no scene comes back from it.
fn record(lesson: &LessonSource, (folder, number): (&Path, usize), size: [u32; 2]) -> Record {
    let words = [
        "lesson".to_owned(),
        as_path(&lesson.address()),
        "--slides".to_owned(),
        as_path(&folder.display().to_string()),
        "--size".to_owned(),
        format!("{}x{}", size[0], size[1]),
        format!("--step={number}"),
    ];
    plain_record(words.to_vec(), size)
}

/// What went wrong with a slide, in the terms of the command line.
struct SlideFailure(Failure);

impl From<crate::viewer::SlideError> for SlideFailure {
    fn from(error: crate::viewer::SlideError) -> Self {
        Self(match error {
            crate::viewer::SlideError::Threads(_) => Failure::other(error),
            _ => Failure::input(error),
        })
    }
}
