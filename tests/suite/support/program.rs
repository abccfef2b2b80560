//! The real program, started without a display.

use std::path::Path;
#[cfg(unix)]
use std::process::Child;
use std::process::{Command, Output};

/// The program in `folder`, to be started.
pub(crate) fn command(folder: &Path, arguments: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_rasterscope"));
    command.current_dir(folder).args(arguments);
    command.env_remove("DISPLAY").env_remove("WAYLAND_DISPLAY");
    command
}

/// Runs the program in `folder` until it ends.
pub(crate) fn run(folder: &Path, arguments: &[&str]) -> Output {
    command(folder, arguments).output().expect("the program starts")
}

/// As [`run`], after a line of shell that takes something away from it; ended where it hangs.
#[cfg(unix)]
pub(crate) fn run_after(limit: &str, folder: &Path, arguments: &[&str]) -> Output {
    let script = format!("{limit}; exec timeout 120 \"$@\"");
    let mut command = Command::new("sh");
    command
        .args(["-c", &script, "sh", env!("CARGO_BIN_EXE_rasterscope")])
        .args(arguments)
        .current_dir(folder);
    command.env_remove("DISPLAY").env_remove("WAYLAND_DISPLAY");
    command.output().expect("a shell")
}

/// Sends what Ctrl+C sends.
#[cfg(unix)]
pub(crate) fn interrupt(running: &Child) {
    let id = running.id().to_string();
    let sent = Command::new("kill").args(["-INT", &id]).status();
    assert!(sent.expect("a program of every system").success(), "a signal");
}

/// Runs the program, which must not complain; what it prints.
pub(crate) fn done(folder: &Path, arguments: &[&str]) -> String {
    let output = run(folder, arguments);
    assert!(
        output.status.success() && output.stderr.is_empty(),
        "{arguments:?}: {output:?}"
    );
    String::from_utf8(output.stdout).expect("text")
}
