//! `rasterscope lesson`: opens a lesson in the window, or draws its steps as slides.

use std::path::{Path, PathBuf};

use super::arguments::{LessonOptions, ViewerOptions};
use super::failure::Failure;
use super::{render, view};
use crate::figure::save_recorded_png;
use crate::raster::Framebuffer;
use crate::viewer::{BUILT_IN, Lesson, LessonSource, as_path, plain_record, slides};

/// The size of slides where none is asked for.
const SLIDE: [u32; 2] = [1600, 900];
/// The least that words and picture need.
const LEAST: [u32; 2] = [480, 270];

/// Opens the lesson, or writes its slides.
pub(super) fn run(options: &LessonOptions) -> Result<(), Failure> {
    let source = source(&options.lesson)?;
    let lesson = source.read().map_err(Failure::input)?;
    if let Some(folder) = &options.slides {
        let size = options.view.size.map_or(SLIDE, |size| size.0);
        return write((&lesson, &source.address()), size, folder);
    }
    let view = ViewerOptions {
        paths: vec![PathBuf::from(source.address())],
        ..options.view.clone()
    };
    view::run(&view, None)
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

/// Writes one PNG for each step; none is left half written.
fn write((lesson, address): (&Lesson, &str), size: [u32; 2], folder: &Path) -> Result<(), Failure> {
    if size[0] < LEAST[0] || size[1] < LEAST[1] {
        return Err(Failure::input(format!(
            "--size {}x{}: too small for words and picture; give {}x{} or more",
            size[0], size[1], LEAST[0], LEAST[1]
        )));
    }
    std::fs::create_dir_all(folder).map_err(|error| render::unwritable(folder, &error))?;
    // Words and picture: only the whole command makes it again.
    let record = plain_record(
        vec![
            "lesson".to_owned(),
            as_path(address),
            "--slides".to_owned(),
            as_path(&folder.display().to_string()),
            "--size".to_owned(),
            format!("{}x{}", size[0], size[1]),
        ],
        size,
    );
    let digits = lesson.steps.len().to_string().len().max(2);
    let mut number = 0;
    slides(lesson, size, |slide: &Framebuffer| {
        number += 1;
        let path = folder.join(format!("{number:0digits$}.png"));
        save_recorded_png(slide, &path, &record).map_err(|error| SlideFailure(render::unwritable(&path, &error)))
    })
    .map_err(|SlideFailure(failure)| failure)?;
    Ok(())
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
