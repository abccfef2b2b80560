//! Plays a script on a stage: the viewer alone, or a whole window.

use std::io;
use std::path::Path;
use std::time::Duration;

use glam::DVec2;

use super::parse::{Script, ScriptError, Step};
use crate::figure::{Destination, save_picture};
use crate::raster::Framebuffer;
use crate::viewer::{Command, Effect, KeyPress, PointerButton, PointerCommand, Viewer, WindowCommand, commands};

/// Moves of the pointer in one drag.
const DRAG_MOVES: u32 = 4;

/// Where a script is played. A window routes keys and pointer through its panels first.
pub trait Stage {
    /// Runs a command and carries out its effects.
    fn command(&mut self, command: Command);

    /// Waits until the picture of everything so far is finished.
    fn settle(&mut self);

    /// Saves a picture of the whole window in `path`, replacing the file.
    ///
    /// # Errors
    /// One line: what went wrong and the cure.
    fn shot(&mut self, path: &Path) -> Result<(), String>;

    /// Whether the program was told to end: later steps cannot be played.
    fn has_quit(&self) -> bool;

    /// What went wrong and was not mended since, each one line with the cure, oldest first. Steps go on, so that a script can take
    /// a picture of it.
    fn problems(&self) -> Vec<String> {
        Vec::new()
    }

    /// Presses and releases a key.
    fn key(&mut self, press: KeyPress) {
        if let Some(command) = commands::for_key(&press) {
            self.command(command.clone());
        }
    }

    /// Types into what has the keyboard. Without panels nothing has.
    fn type_text(&mut self, _text: &str) {}

    /// Moves the pointer to a window pixel, or out of the window.
    fn pointer(&mut self, at: Option<DVec2>) {
        self.command(match at {
            Some(at) => Command::Pointer(PointerCommand::Moved { at }),
            None => Command::Pointer(PointerCommand::Left),
        });
    }

    /// Presses (`down`) or releases a button of the mouse.
    fn button(&mut self, button: PointerButton, down: bool) {
        self.command(if down {
            Command::Pointer(PointerCommand::Pressed(button))
        } else {
            Command::Pointer(PointerCommand::Released(button))
        });
    }

    /// Turns the wheel.
    fn wheel(&mut self, clicks: f64) {
        self.command(Command::Pointer(PointerCommand::Wheel { clicks }));
    }

    /// Gives the window another size, in device pixels.
    fn resize(&mut self, size: [u32; 2]) {
        self.command(Command::Window(WindowCommand::Resize(size)));
    }

    /// Lets time pass.
    fn wait(&mut self, time: Duration) {
        std::thread::sleep(time);
    }
}

/// Plays all steps, each after the picture of the one before is finished.
///
/// # Errors
/// At the first step that cannot be performed, or that comes after the end of the program; and with every step that made something
/// go wrong that no later one mended. They are in the order of the steps.
pub fn play(script: &Script, name: &str, stage: &mut dyn Stage) -> Result<(), Vec<ScriptError>> {
    stage.settle();
    let mut told = stage.problems();
    let mut wrong = Vec::new();
    for step in &script.steps {
        if stage.has_quit() {
            if wrong.is_empty() {
                let unplayed = "it is not played, for a step before it ended the program; let that one be the last";
                wrong.push(step.error(name, unplayed.to_owned()));
            }
            return Err(wrong);
        }
        if let Err(message) = perform(&step.step, stage) {
            wrong.push(step.error(name, message));
            return Err(wrong);
        }
        stage.settle();
        let problems = stage.problems();
        wrong.retain(|error: &ScriptError| problems.contains(&error.message));
        let new = problems.iter().filter(|problem| !told.contains(problem));
        wrong.extend(new.map(|problem| step.error(name, problem.clone())));
        told = problems;
    }
    if wrong.is_empty() { Ok(()) } else { Err(wrong) }
}

/// Performs one step. A window that cannot wait calls this for one step after the other, each time the picture is
/// finished.
///
/// # Errors
/// One line: what went wrong and the cure.
pub fn perform(step: &Step, stage: &mut dyn Stage) -> Result<(), String> {
    match step {
        Step::Key(press) => stage.key(*press),
        Step::Type(text) => stage.type_text(text),
        Step::Move(at) => stage.pointer(Some(*at)),
        Step::Leave => stage.pointer(None),
        Step::Click { at, button } => {
            stage.pointer(Some(*at));
            stage.button(*button, true);
            stage.button(*button, false);
        }
        Step::Drag { from, to } => {
            stage.pointer(Some(*from));
            stage.button(PointerButton::Primary, true);
            for i in 1..=DRAG_MOVES {
                stage.pointer(Some(from.lerp(*to, f64::from(i) / f64::from(DRAG_MOVES))));
            }
            stage.button(PointerButton::Primary, false);
        }
        Step::Wheel { clicks, at } => {
            if at.is_some() {
                stage.pointer(*at);
            }
            stage.wheel(*clicks);
        }
        Step::Resize(size) => stage.resize(*size),
        Step::Wait(Some(time)) => stage.wait(*time),
        Step::Wait(None) => stage.settle(),
        Step::Shot(path) => return stage.shot(path),
        Step::Run(command) => stage.command(command.clone()),
    }
    Ok(())
}

/// A viewer without window and panels: pictures show frame and inset.
#[derive(Debug)]
pub struct ViewerStage<'a> {
    viewer: &'a mut Viewer,
    has_quit: bool,
    /// The last text that was copied.
    pub clipboard: Option<String>,
}

impl<'a> ViewerStage<'a> {
    /// Plays on `viewer`.
    pub fn new(viewer: &'a mut Viewer) -> Self {
        Self {
            viewer,
            has_quit: false,
            clipboard: None,
        }
    }
}

impl Stage for ViewerStage<'_> {
    fn command(&mut self, command: Command) {
        for effect in self.viewer.apply(command) {
            match effect {
                Effect::CopyText(text) => self.clipboard = Some(text),
                // Without a window there is no clipboard for pictures, no desktop, and there are no panels.
                Effect::CopyPicture(_) | Effect::OpenFolder(_) | Effect::FocusPanel { .. } => {}
                Effect::PictureOfWindow => {
                    self.viewer.finish();
                    let picture = self.viewer.window().picture();
                    self.viewer.save_window_picture(picture);
                }
                Effect::Quit => self.has_quit = true,
            }
        }
    }

    fn settle(&mut self) {
        self.viewer.finish();
    }

    fn shot(&mut self, path: &Path) -> Result<(), String> {
        save_window(self.viewer, &self.viewer.window().picture(), path).map_err(|error| {
            format!(
                "{}: cannot write this file: {error}; choose another place",
                path.display()
            )
        })
    }

    fn has_quit(&self) -> bool {
        self.has_quit
    }
}

/// Writes a picture of the window with its record.
///
/// # Errors
/// When it has no pixels or the file cannot be written.
pub fn save_window(viewer: &Viewer, picture: &Framebuffer, path: &Path) -> io::Result<()> {
    let record = viewer.recipes().record_of_window(path);
    save_picture(
        picture,
        record.as_ref(),
        Destination::by_user(path),
        &viewer.recipes().guard(),
    )
}
