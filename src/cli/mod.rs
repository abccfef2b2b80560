//! The command line: one file per command.
//!
//! Exit status 0: done. 2: the input or the arguments are at fault, said in one line on stderr. 1: everything else.

mod arguments;
mod bench;
mod failure;
mod picture;
mod render;
mod size;
mod view;
mod view_option;

use std::ffi::OsString;
use std::process::ExitCode;

use arguments::{Arguments, Verb};
use failure::Failure;

/// Runs the program with its arguments, its own name first.
pub fn run(arguments: impl IntoIterator<Item = OsString>) -> ExitCode {
    match arguments::parse(arguments).and_then(|arguments| execute(&arguments)) {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => failure.report(),
    }
}

fn execute(arguments: &Arguments) -> Result<(), Failure> {
    match &arguments.verb {
        Verb::View(options) => view::run(options),
        Verb::Render(options) => render::run(options),
        Verb::Bench(options) => bench::run(options),
    }
}
