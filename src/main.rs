//! Arguments to command to exit status: nothing else.

use std::process::ExitCode;

fn main() -> ExitCode {
    rasterscope::cli::run(std::env::args_os())
}
