//! `rasterscope view`: the window.

use super::failure::Failure;
use super::options::view::ViewerOptions;
use crate::viewer::Restored;

/// Opens the window, or plays a session without one.
#[cfg(feature = "window")]
pub(super) fn run(options: &ViewerOptions, restored: Option<&Restored>) -> Result<(), Failure> {
    use super::picture::set_threads;
    use super::{interrupt, memory};
    use crate::app::{self, ScriptSource, ViewOptions};
    use crate::viewer::{Against, LessonSource, patterns, picture};

    let is_pattern = |path: &&std::path::PathBuf| patterns::is_pattern_file(path);
    for pattern in options.paths.iter().filter(is_pattern) {
        patterns::of_file(pattern).map_err(Failure::Input)?;
    }
    let has_pattern = options.paths.iter().any(|path| is_pattern(&path));
    let lessons: Vec<LessonSource> = options
        .paths
        .iter()
        .filter(|path| !is_pattern(path))
        .filter_map(|path| LessonSource::from_address(path))
        .collect();
    for lesson in &lessons {
        lesson.read().map_err(Failure::input)?;
    }
    let (entries, problems) = crate::viewer::list_scenes(&options.paths);
    if entries.is_empty()
        && lessons.is_empty()
        && !has_pattern
        && let Some(problem) = problems.into_iter().next()
    {
        return Err(Failure::Input(problem));
    }
    if let Some(Against::Changed(changes)) = &options.against
        && let Some(problem) = picture::apply_all(changes, &mut settings(options))
    {
        return Err(Failure::Input(format!("--against: {problem}")));
    }
    let threads = options.framing.threads;
    set_threads(threads)?;
    if options.headless {
        let pixels = options.size.map_or(0, |size| memory::pixels(size.0));
        // A window holds its frame three times over: as it is, as it was, and below the panels.
        memory::ask_for(pixels.saturating_mul(3))?;
    }
    let file = options.script.clone().map(ScriptSource::File);
    let view_options = ViewOptions {
        paths: options.paths.clone(),
        settings: settings(options),
        given: options.sampling.given().to_vec(),
        view: options.framing.view,
        against: options.against.clone(),
        size: options.size.map(|size| size.0),
        scale: options.scale,
        theme: options.theme,
        screenshot_dir: options.screenshot_dir.clone(),
        screenshot_name: options.screenshot_name.clone().unwrap_or_default(),
        script: file.or(options.commands.clone().map(ScriptSource::Text)),
        headless: options.headless,
        frame_log: options.frame_log.clone(),
        no_config: options.no_config,
        force: options.force,
        grammar: Some(super::restore::GRAMMAR),
        restored: restored.cloned(),
        await_end: Some(interrupt::instead),
    };
    #[cfg(windows)]
    super::windows::leave_console_of_desktop();
    app::run(view_options).map_err(failure)
}

/// Why a session ended; each step of a script that went wrong has a line of its own.
#[cfg(feature = "window")]
fn failure(error: crate::app::AppError) -> Failure {
    use crate::app::AppError;

    match error {
        AppError::Ended => super::interrupt::ended(),
        AppError::Steps(mut wrong) => {
            let last = wrong.pop().map_or(String::new(), |error| error.to_string());
            for error in wrong {
                super::failure::print_error(&error.to_string());
            }
            Failure::input(last)
        }
        error if error.is_input() => Failure::input(error),
        error => Failure::other(error),
    }
}

#[cfg(feature = "window")]
fn settings(options: &ViewerOptions) -> crate::viewer::Settings {
    let sampling = &options.sampling;
    crate::viewer::Settings::of(sampling.settings(options.framing.view), sampling.reading())
}

/// Says that there is no window in this build.
#[cfg(not(feature = "window"))]
pub(super) fn run(_: &ViewerOptions, _: Option<&Restored>) -> Result<(), Failure> {
    let cure = "build it with the feature `window`, or use `rasterscope render`";
    Err(Failure::other(format!(
        "this program was built without its window; {cure}"
    )))
}
