//! Sessions without a window: the same viewer and panels, time that only scripts move, pictures in files.

use std::fs::File;
use std::io::{self, Read as _};
use std::path::Path;

use super::session::{Clock, Session};
use super::{AppError, ScriptSource, ViewOptions};
use crate::viewer::script::{Script, Stage as _, play};
use crate::viewer::{Message, MessageKind, Theme, Viewer, ViewerOptions, Waker};

/// A window's size where nobody says another, in points.
pub(super) const DEFAULT_SIZE: [f32; 2] = [1280.0, 800.0];

/// Largest script, in bytes.
const MAX_SCRIPT: usize = 16 << 20;

/// The script, read, and its name in messages.
#[derive(Clone, Debug)]
pub(super) struct NamedScript {
    pub(super) script: Script,
    pub(super) name: String,
}

/// Reads the script that `options` name.
///
/// # Errors
/// When its file cannot be read or it is at fault.
pub(super) fn read_script(options: &ViewOptions) -> Result<Option<NamedScript>, AppError> {
    let (text, name) = match &options.script {
        None => return Ok(None),
        Some(ScriptSource::Text(text)) => (text.clone(), "--do".to_owned()),
        Some(ScriptSource::File(path)) => {
            let name = path.display().to_string();
            let text = read_text(path).map_err(|error| {
                AppError::Script(format!("{name}: cannot read this script: {error}; give a text file"))
            })?;
            (text, name)
        }
    };
    let script = Script::parse(&text, &name).map_err(|error| AppError::Script(error.to_string()))?;
    Ok(Some(NamedScript { script, name }))
}

/// A text file, or a pipe that ends, of a size that a person could have written.
fn read_text(path: &Path) -> io::Result<String> {
    let mut text = String::new();
    let limit = u64::try_from(MAX_SCRIPT).unwrap_or(u64::MAX);
    File::open(path)?.take(limit + 1).read_to_string(&mut text)?;
    if text.len() > MAX_SCRIPT {
        return Err(io::Error::other("it is larger than 16 MiB"));
    }
    Ok(text)
}

/// How the viewer of a session starts.
pub(super) fn viewer_options(
    options: &ViewOptions,
    window: [u32; 2],
    theme: Option<Theme>,
    waker: Waker,
) -> ViewerOptions {
    ViewerOptions {
        paths: options.paths.clone(),
        settings: options.settings,
        view: options.view,
        against: options.against.clone(),
        window,
        screenshot_dir: options.screenshot_dir.clone(),
        screenshot_name: options.screenshot_name.clone(),
        theme: options.theme.or(theme).unwrap_or_default(),
        takes_drops: true,
        waker,
        grammar: options.grammar,
        restored: options.restored.clone(),
    }
}

/// The window's size in device pixels.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "clamped to the longest side of a frame"
)]
pub(super) fn window_size(options: &ViewOptions, scale: f32) -> [u32; 2] {
    let longest = crate::raster::Framebuffer::MAX_SIDE;
    let default = DEFAULT_SIZE.map(|side| (side * scale).round().clamp(1.0, longest as f32) as u32);
    options.size.unwrap_or(default).map(|side| side.min(longest))
}

/// Plays the script; without one, saves one picture of the window. Returns what was saved without a script.
///
/// # Errors
/// When a step fails or the picture cannot be saved.
pub(super) fn run(options: &ViewOptions) -> Result<Option<String>, AppError> {
    let script = read_script(options)?;
    let scale = options.scale.unwrap_or(1.0).clamp(0.5, 8.0);
    let waker: Waker = std::sync::Arc::new(|| {});
    let viewer =
        Viewer::new(viewer_options(options, window_size(options, scale), None, waker)).map_err(AppError::Threads)?;
    let mut session = Session::new(viewer, scale, Clock::Simulated(0.0));
    if let Some(NamedScript { script, name }) = script {
        play(&script, &name, &mut session).map_err(AppError::Steps)?;
        session.settle();
        return untroubled(&session).map(|()| None);
    }
    session.settle();
    untroubled(&session)?;
    session.run(crate::viewer::Command::Export(
        crate::viewer::ExportCommand::WindowScreenshot,
    ));
    session.settle();
    match session.viewer().chrome().messages().last() {
        Some(Message {
            kind: MessageKind::Saved,
            text,
            ..
        }) => Ok(Some(text.clone())),
        Some(message) => Err(AppError::Input(message.text.clone())),
        None => Err(AppError::Window("no picture was saved".to_owned())),
    }
}

/// Whether all went well so far: the scene could be read, screenshots could be saved. If not, the first thing that
/// went wrong.
fn untroubled(session: &Session) -> Result<(), AppError> {
    let first = session.problems().into_iter().next();
    first.map_or(Ok(()), |problem| Err(AppError::Input(problem)))
}
