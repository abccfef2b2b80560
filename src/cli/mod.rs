//! The command line: one file per command.
//!
//! What an exit status means stands on the page that `rasterscope help options` prints; `failure` and `interrupt` give it.

mod arguments;
mod bench;
mod board;
mod completions;
mod diff;
mod examples;
mod failure;
mod help;
mod inspect;
mod interrupt;
mod lesson;
mod memory;
mod options;
mod pattern;
mod picture;
mod profile;
mod progress;
mod render;
mod rerun;
mod restore;
mod rounded;
mod sheet;
mod size;
mod spectrum;
mod sweep;
mod view;
mod view_option;
#[cfg(windows)]
mod windows;
mod writeup;

pub use restore::GRAMMAR;

use std::ffi::OsString;
use std::process::ExitCode;

use arguments::{Arguments, Verb};
use failure::Failure;
use progress::Progress;

use crate::scene::{self, Fonts};
use crate::simd;
use crate::viewer::Restored;

/// The environment variable that fixes the vector instructions: for measurements that must not depend on the machine.
const SIMD_VARIABLE: &str = "RASTERSCOPE_SIMD";

/// The environment variable that leaves out the system's typefaces if it is `shipped`: for pictures that must not depend on the
/// machine.
const FONTS_VARIABLE: &str = "RASTERSCOPE_FONTS";

/// Runs the program with its arguments, its own name first.
pub fn run(arguments: impl IntoIterator<Item = OsString>) -> ExitCode {
    interrupt::listen();
    let done = restore::parse(arguments).and_then(|(arguments, restored)| {
        choose_simd()?;
        choose_fonts(&arguments)?;
        execute(&arguments, restored.as_ref())
    });
    match done {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => failure.report(),
    }
}

/// Whether `text` is a file of pins that `writeup` takes: for tests and fuzzing, which start no program.
///
/// # Errors
/// One line for the first mistake.
#[doc(hidden)]
pub fn check_pins(text: &str) -> Result<(), String> {
    writeup::check_pins(text).map_err(Failure::into_line)
}

fn choose_simd() -> Result<(), Failure> {
    let Some(name) = std::env::var_os(SIMD_VARIABLE) else {
        return Ok(());
    };
    simd::choose(&name.to_string_lossy()).map_err(|error| Failure::input(format!("{SIMD_VARIABLE}: {error}")))
}

fn choose_fonts(arguments: &Arguments) -> Result<(), Failure> {
    let fonts = Fonts {
        system: std::env::var_os(FONTS_VARIABLE).is_none_or(|value| value != "shipped"),
        more: arguments.fonts.clone(),
    };
    scene::set_fonts(fonts).map_err(|path| {
        let path = path.display();
        Failure::input(format!(
            "--font {path}: no typeface is there; give a TrueType or OpenType file, or a folder of them"
        ))
    })
}

/// `restored` is the picture that scene and options come from.
fn execute(arguments: &Arguments, restored: Option<&Restored>) -> Result<(), Failure> {
    // The window shows what it does, and sweeps have a bar of their own.
    let has_bar = match &arguments.verb {
        Verb::View(_) | Verb::Sweep(_) => false,
        Verb::Lesson(options) => options.slides.is_some(),
        _ => true,
    };
    let _progress = has_bar.then(Progress::start);
    match &arguments.verb {
        Verb::View(options) => view::run(options, restored),
        Verb::Render(options) => render::run(options, restored),
        Verb::Sheet(options) => sheet::run(options, restored),
        Verb::Sweep(options) => sweep::run(options, restored),
        Verb::Writeup(options) => writeup::run(options),
        Verb::Rerun(options) => rerun::run(options),
        Verb::Board(options) => board::run(options, restored),
        Verb::Inspect(options) => inspect::run(options, restored),
        Verb::Diff(options) => diff::run(options),
        Verb::Lesson(options) => lesson::run(options),
        Verb::Bench(options) => bench::run(options),
        Verb::Pattern(options) => pattern::run(options),
        Verb::Profile(options) => profile::run(options, restored),
        Verb::Spectrum(options) => spectrum::run(options, restored),
    }
}
