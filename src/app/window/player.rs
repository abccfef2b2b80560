//! Plays a script in a window, a step at a time, so that the window lives on meanwhile.

use std::collections::VecDeque;
use std::time::{Duration, Instant};

use winit::dpi::PhysicalSize;

use super::super::AppError;
use super::super::headless::NamedScript;
use super::opened::Opened;
use crate::viewer::script::{ScriptError, ScriptStep, Step, perform};

/// Longest wait for a window to take another size: some never do.
const RESIZE_PATIENCE: Duration = Duration::from_secs(2);

/// A script being played.
#[derive(Debug)]
pub(super) struct Player {
    steps: VecDeque<ScriptStep>,
    name: String,
    /// Not before this.
    until: Option<Instant>,
    /// The size that the window was asked to take.
    awaited: Option<[u32; 2]>,
}

impl Player {
    pub(super) fn new(script: NamedScript) -> Self {
        Self {
            steps: script.script.steps.into(),
            name: script.name,
            until: None,
            awaited: None,
        }
    }

    /// Performs the steps that can be performed now; returns when to come back.
    ///
    /// # Errors
    /// When a step fails.
    pub(super) fn advance(&mut self, opened: &mut Opened) -> Result<Option<Instant>, AppError> {
        while !self.steps.is_empty() && opened.session.viewer().is_settled() {
            if self.awaited == Some(opened.session.viewer().chrome().window_size()) {
                (self.awaited, self.until) = (None, None);
            }
            if let Some(until) = self.until.filter(|until| *until > Instant::now()) {
                return Ok(Some(until));
            }
            (self.awaited, self.until) = (None, None);
            let Some(ScriptStep { line, column, step }) = self.steps.pop_front() else {
                break;
            };
            match step {
                Step::Wait(Some(time)) => self.until = Instant::now().checked_add(time),
                Step::Resize(size) => {
                    self.awaited = Some(size);
                    self.until = Instant::now().checked_add(RESIZE_PATIENCE);
                    if let Some(at_once) = opened.window.request_inner_size(PhysicalSize::new(size[0], size[1])) {
                        opened.resized(at_once);
                    }
                }
                step => perform(&step, &mut opened.session).map_err(|message| {
                    let name = self.name.clone();
                    AppError::Script(
                        ScriptError {
                            name,
                            line,
                            column,
                            message,
                        }
                        .to_string(),
                    )
                })?,
            }
            opened.touch();
        }
        Ok(None)
    }
}
