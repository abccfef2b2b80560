//! The steps of a lesson as slides: the words on the left, on the right the picture that the window shows.

mod marks;
mod page;

use std::io;
use std::ops::RangeInclusive;
use std::sync::Arc;

use glam::DVec2;

use self::marks::draw_marks;
use self::page::Page;
use crate::figure::Ground;
use crate::raster::Framebuffer;
use crate::scene::Scene;
use crate::viewer::LessonCommand;
use crate::viewer::ab::other::Arrangement;
use crate::viewer::command::Command;
use crate::viewer::lesson::model::{Lesson, LessonStep};
use crate::viewer::library::SceneEntry;
use crate::viewer::state::{Viewer, ViewerOptions};

/// Why there are no slides.
#[derive(Debug, thiserror::Error)]
pub enum SlideError {
    /// The system gives no threads.
    #[error("cannot draw slides: {0}")]
    Threads(#[from] io::Error),
    /// A text is too long.
    #[error("step {step}: its text does not fit on a slide of {width} x {height} pixels; shorten it or split the step")]
    TextTooLong {
        /// Number of the step, from 1.
        step: usize,
        /// Size of the slide.
        width: u32,
        /// See `width`.
        height: u32,
    },
    /// A pin lies outside.
    #[error("step {step}: its pin {x},{y} is not in the picture; move the pin, or the view so that it shows it")]
    PinOutside {
        /// Number of the step, from 1.
        step: usize,
        /// The pin, in canvas units.
        x: f64,
        /// See `x`.
        y: f64,
    },
    /// A scene cannot be drawn.
    #[error("step {step}: {problem}")]
    Scene {
        /// Number of the step, from 1.
        step: usize,
        /// One line: file, place, cause, cure.
        problem: String,
    },
}

/// A step as a picture.
#[derive(Clone, Debug)]
pub struct Slide {
    /// Words and picture.
    pub picture: Framebuffer,
    /// The scene in it.
    pub scene: Option<Arc<Scene>>,
}

/// Draws the steps with these `numbers`, counted from 1, as slides of `size` pixels on this `ground` and hands each to `take` with
/// its number.
///
/// # Errors
/// When a step cannot be drawn, or when `take` says so.
pub fn slides<E: From<SlideError>>(
    lesson: &Lesson,
    (size, ground): ([u32; 2], Ground),
    numbers: RangeInclusive<usize>,
    mut take: impl FnMut(usize, &Slide) -> Result<(), E>,
) -> Result<(), E> {
    let (page, lesson) = (Page::new(size, ground), &as_stills(lesson));
    for (number, step) in (1..).zip(&lesson.steps).filter(|(number, _)| numbers.contains(number)) {
        let slide = slide(&page, lesson, number, step)?;
        take(number, &slide)?;
    }
    Ok(())
}

/// Draws the step with this number, counted from 1. Its viewer is its own: where a step before left the magnifier, or what
/// else it changed, is nothing to this one.
fn slide(page: &Page, lesson: &Lesson, number: usize, step: &LessonStep) -> Result<Slide, SlideError> {
    let options = ViewerOptions {
        window: page.picture_size(),
        ..ViewerOptions::default()
    };
    let mut viewer = Viewer::new(options)?;
    viewer.opening().lessons().begin(lesson.clone(), None);
    let _ = viewer.apply(Command::Lesson(LessonCommand::Step(number - 1)));
    viewer.finish();
    if let Some(problem) = viewer.scene_list().current().and_then(|entry| entry.failure()) {
        let (step, problem) = (number, problem.to_owned());
        return Err(SlideError::Scene { step, problem });
    }
    if let Some(pin) = step.pin.filter(|_| viewer.pixels().pinned().is_none()) {
        let (step, DVec2 { x, y }) = (number, pin);
        return Err(SlideError::PinOutside { step, x, y });
    }
    let mut slide = page.blank();
    let mut picture = viewer.window().picture();
    draw_marks(&viewer, &mut picture);
    page.paste(&picture, &mut slide);
    if let Some(text) = caption_of(&viewer) {
        page.caption(&mut slide, &text);
    }
    let of = format!("{}  {number} / {}", lesson.title, lesson.steps.len());
    if !page.write(&mut slide, step, &of) {
        let ([width, height], step) = (page.size, number);
        return Err(SlideError::TextTooLong { step, width, height });
    }
    let scene = viewer.scene_list().current().and_then(SceneEntry::scene).cloned();
    Ok(Slide { picture: slide, scene })
}

/// The lesson as pictures show it that do not move: what flips in the window stands side by side.
fn as_stills(lesson: &Lesson) -> Lesson {
    let mut lesson = lesson.clone();
    for step in &mut lesson.steps {
        if let Some((_, arrangement @ Arrangement::Flip)) = &mut step.against {
            *arrangement = Arrangement::SideBySide;
        }
    }
    lesson
}

/// What the picture shows of A and B; `None` where nothing is compared.
fn caption_of(viewer: &Viewer) -> Option<String> {
    let ab = viewer.ab();
    let [a, b] = ab.sides(viewer.settings())?;
    Some(match ab.arrangement() {
        Arrangement::Alone => a,
        Arrangement::Difference => {
            let measure = ab.difference_style().measure.name();
            format!("{measure} difference of A and B  |  {a}  |  {b}")
        }
        Arrangement::Wipe | Arrangement::SideBySide | Arrangement::Flip => {
            let both = ab.shared_words(viewer.settings());
            let both = both.map_or(String::new(), |words| format!("  |  both: {words}"));
            format!("{a}  |  {b}{both}")
        }
    })
}
