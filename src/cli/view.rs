//! `rasterscope view`: the window.

use super::arguments::ViewerOptions;
use super::failure::Failure;
use crate::viewer::Restored;

/// Opens the window, or plays a session without one.
#[cfg(feature = "window")]
pub(super) fn run(options: &ViewerOptions, restored: Option<&Restored>) -> Result<(), Failure> {
    use crate::app::{self, ScriptSource, ViewOptions};
    use crate::viewer::LessonSource;

    let lessons: Vec<LessonSource> = options
        .paths
        .iter()
        .filter_map(|path| LessonSource::from_address(path))
        .collect();
    for lesson in &lessons {
        lesson.read().map_err(Failure::input)?;
    }
    let (entries, problems) = crate::viewer::list_scenes(&options.paths);
    if entries.is_empty()
        && lessons.is_empty()
        && let Some(problem) = problems.into_iter().next()
    {
        return Err(Failure::Input(problem));
    }
    if let Some(threads) = options.framing.threads {
        // Fails only if the pool runs already, and nothing has used it before this line.
        rayon::ThreadPoolBuilder::new()
            .num_threads(threads.into())
            .build_global()
            .map_err(Failure::other)?;
    }
    let file = options.script.clone().map(ScriptSource::File);
    let view_options = ViewOptions {
        paths: options.paths.clone(),
        settings: settings(options),
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
        grammar: Some(super::recorded::GRAMMAR),
        restored: restored.cloned(),
    };
    app::run(view_options).map_err(|error| {
        if error.is_input() {
            Failure::input(error)
        } else {
            Failure::other(error)
        }
    })
}

#[cfg(feature = "window")]
fn settings(options: &ViewerOptions) -> crate::viewer::Settings {
    crate::viewer::Settings {
        render: options.sampling.settings(options.framing.view),
        dialect: options.sampling.reading(),
        ..Default::default()
    }
}

/// Says that there is no window in this build.
#[cfg(not(feature = "window"))]
pub(super) fn run(_: &ViewerOptions, _: Option<&Restored>) -> Result<(), Failure> {
    let cure = "build it with the feature `window`, or use `rasterscope render`";
    Err(Failure::other(format!(
        "this program was built without its window; {cure}"
    )))
}
