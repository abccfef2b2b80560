//! `rasterscope lesson`: opens a lesson in the window, or draws its steps as slides.

use std::collections::HashSet;
use std::ops::RangeInclusive;
use std::path::{Path, PathBuf};

use super::failure::Failure;
use super::options::lesson::LessonOptions;
use super::options::view::ViewerOptions;
use super::picture::set_threads;
use super::{memory, progress, render, view};
use crate::figure::{Destination, Ground, Guard, Named, Record, save_picture};
use crate::geometry::View;
use crate::raster::Framebuffer;
use crate::scene::DialectChoice;
use crate::viewer::{
    Against, BUILT_IN, Lesson, LessonSource, SceneSource, Slide, SlideError, Theme, as_path, input_file, plain_record,
    slides, texture_files,
};

/// The size of slides where none is asked for.
const SLIDE: [u32; 2] = [1600, 900];
/// The least that words and picture need.
const LEAST: [u32; 2] = [480, 270];

/// The slides that the options ask for.
struct Slides<'a> {
    source: LessonSource,
    lesson: Lesson,
    size: [u32; 2],
    ground: Ground,
    /// Of the steps, from 1.
    numbers: RangeInclusive<usize>,
    folder: &'a Path,
}

/// Opens the lesson, or writes its slides.
pub(super) fn run(options: &LessonOptions) -> Result<(), Failure> {
    if let Some(folder) = &options.slides {
        refuse_for_slides(&options.view)?;
        if options.view.framing.threads.is_some() {
            set_threads(options.view.framing.threads)?;
        }
        let slides = Slides::new(options)?;
        let guard = slides.guard(options.view.force)?;
        return slides.draw(|slide, number| {
            let path = slides.path(number);
            // Only now, so that a lesson that is refused leaves no empty folder.
            std::fs::create_dir_all(folder).map_err(|error| render::unwritable_by("--slides", folder, &error))?;
            let record = slides.record(slide, number, &path);
            let saved = save_picture(&slide.picture, Some(&record), Destination::by_program(&path), &guard);
            progress::done();
            saved.map_err(|error| render::unwritable_by("--slides", &path, &error))
        });
    }
    let source = source(&options.lesson)?;
    source.read().map_err(Failure::input)?;
    let view = ViewerOptions {
        paths: vec![PathBuf::from(source.address())],
        ..options.view.clone()
    };
    view::run(&view, None)
}

/// Refuses options that no slide takes: each step says what it shows, and there is no window.
fn refuse_for_slides(options: &ViewerOptions) -> Result<(), Failure> {
    let refused = |option: &str, why: &str| Err(Failure::input(format!("{option}: {why}")));
    let of_steps = [
        (options.framing.view != View::Default, "view"),
        (options.against.is_some(), "against"),
    ];
    let of_steps = of_steps.into_iter().filter_map(|(given, name)| given.then_some(name));
    if let Some(name) = options.sampling.given().iter().copied().chain(of_steps).next() {
        return refused(
            &format!("--{name}"),
            "slides show what the steps of the lesson say; leave it out, or write it into its steps",
        );
    }
    if let Some(path) = options.paths.first() {
        return refused(&path.display().to_string(), "slides are of one lesson; leave it out");
    }
    let of_window = [
        (options.scale.is_some(), "--scale"),
        (options.script.is_some(), "--script"),
        (options.commands.is_some(), "--do"),
        (options.screenshot_dir.is_some(), "--screenshot-dir"),
        (options.screenshot_name.is_some(), "--screenshot-name"),
        (options.frame_log.is_some(), "--frame-log"),
    ];
    match of_window.into_iter().find(|(given, _)| *given) {
        Some((_, option)) => refused(
            option,
            "slides are drawn without a window; leave it out, or leave out --slides",
        ),
        None => Ok(()),
    }
}

/// The one slide that the options ask for, and its record for the file `output`.
pub(super) fn picture(options: &LessonOptions, output: &Path) -> Result<(Framebuffer, Record), Failure> {
    let mut only = None;
    let slides = Slides::new(options)?;
    slides.draw(|slide, number| {
        only = Some((slide.picture.clone(), slides.record(slide, number, output)));
        Ok(())
    })?;
    only.ok_or_else(|| Failure::other("a lesson without steps"))
}

/// Protects everything that the lesson is read from.
pub(super) fn protect(options: &LessonOptions, guard: &mut Guard) -> Result<(), Failure> {
    Slides::new(options)?.protect(guard);
    Ok(())
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

impl<'a> Slides<'a> {
    fn new(options: &'a LessonOptions) -> Result<Self, Failure> {
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
        Ok(Self {
            source,
            lesson,
            size,
            ground: match options.view.theme {
                Some(Theme::Dark) => Ground::Dark,
                Some(Theme::Light) | None => Ground::Light,
            },
            numbers,
            folder: options.slides.as_deref().unwrap_or(Path::new("")),
        })
    }

    /// The file of the slide with this number.
    fn path(&self, number: usize) -> PathBuf {
        let digits = self.lesson.steps.len().to_string().len().max(2);
        self.folder.join(format!("{number:0digits$}.png"))
    }

    /// Draws the slides and hands each over, with its number.
    fn draw(&self, mut take: impl FnMut(&Slide, usize) -> Result<(), Failure>) -> Result<(), Failure> {
        progress::count(self.numbers.clone().count());
        memory::ask_for(memory::pixels(self.size).saturating_mul(3))?;
        slides(
            &self.lesson,
            (self.size, self.ground),
            self.numbers.clone(),
            |number, slide| take(slide, number).map_err(SlideFailure::Taken),
        )
        .map_err(|failure| self.failure(failure))
    }

    /// The record of the slide with this number, for the file `output`: words and picture, so that no scene comes back from
    /// it.
    fn record(&self, slide: &Slide, number: usize, output: &Path) -> Record {
        let [width, height] = self.size;
        let mut words = vec![
            "lesson".to_owned(),
            as_path(&self.source.address()),
            "--slides".to_owned(),
            as_path(&self.folder.display().to_string()),
            "--size".to_owned(),
            format!("{width}x{height}"),
            format!("--step={number}"),
        ];
        if self.ground != Ground::default() {
            words.push(format!("--theme={}", self.ground.name()));
        }
        let step = number.checked_sub(1).and_then(|index| self.lesson.steps.get(index));
        // Lessons of the program and scenes of the gallery are no files.
        let inputs = match (&self.source, step.map(|step| &step.scene)) {
            (LessonSource::File(lesson), Some(SceneSource::File(scene))) => vec![lesson, scene],
            (LessonSource::File(lesson), _) => vec![lesson],
            (LessonSource::BuiltIn(_), _) => Vec::new(),
        };
        Record {
            inputs: inputs.into_iter().map(|path| input_file(path, output)).collect(),
            textures: slide.scene.as_deref().map_or_else(Vec::new, texture_files),
            ..plain_record(words, self.size)
        }
    }

    /// In the terms of the command line.
    fn failure(&self, failure: SlideFailure) -> Failure {
        match failure {
            SlideFailure::Taken(failure) => failure,
            SlideFailure::Drawn(error @ SlideError::Threads(_)) => Failure::other(error),
            SlideFailure::Drawn(error @ SlideError::Scene { step, .. }) if self.is_starved(step) => {
                Failure::other(error)
            }
            SlideFailure::Drawn(error) => Failure::input(format!("{}: {error}", self.source.address())),
        }
    }

    /// Whether a step's scene cannot be read for lack of memory.
    fn is_starved(&self, step: usize) -> bool {
        let step = step.checked_sub(1).and_then(|index| self.lesson.steps.get(index));
        let read = step.map(|step| step.scene.read(DialectChoice::Auto));
        matches!(read, Some(Err(error)) if error.problem.is_of_memory())
    }

    /// What the slides must not replace, asked before they are drawn.
    fn guard(&self, force: bool) -> Result<Guard, Failure> {
        let mut guard = Guard::new(force);
        let paths = self.numbers.clone().map(|number| self.path(number));
        let there: Vec<PathBuf> = paths.filter(|path| path.symlink_metadata().is_ok()).collect();
        if there.is_empty() {
            // Reading every scene once more would be for nothing.
            return Ok(guard);
        }
        self.protect(&mut guard);
        for path in there {
            let target = guard.target(&path, Named::ByProgram);
            target.map_err(|error| render::unwritable_by("--slides", &path, &error))?;
        }
        Ok(guard)
    }

    /// Protects the lesson, the scenes and pictures that its steps name, and the scenes' textures.
    fn protect(&self, guard: &mut Guard) {
        if let LessonSource::File(path) = &self.source {
            guard.protect(path);
        }
        let mut known = HashSet::new();
        for step in &self.lesson.steps {
            if let Some((Against::File(picture), _)) = &step.against {
                guard.protect(picture);
            }
            let SceneSource::File(path) = &step.scene else { continue };
            if !known.insert(path) {
                continue;
            }
            guard.protect(path);
            // Each reading has textures that the other does not know. What cannot be read is told when it is drawn.
            for dialect in [DialectChoice::Svg, DialectChoice::Course] {
                if let Ok(scene) = step.scene.read(dialect) {
                    step.scene.protect(&scene.files, guard);
                }
            }
        }
    }
}

/// What went wrong with a slide.
enum SlideFailure {
    Drawn(SlideError),
    Taken(Failure),
}

impl From<SlideError> for SlideFailure {
    fn from(error: SlideError) -> Self {
        Self::Drawn(error)
    }
}
