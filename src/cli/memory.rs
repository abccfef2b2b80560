//! How much memory drawing a picture takes, as Linux counts it; other systems do not tell.

use std::fs;
use std::process::{Command, Stdio};

use crate::viewer::PictureSpec;

/// The largest resident set of this process since its start, in megabytes of 2^20 bytes.
pub(super) fn peak_megabytes() -> Option<f64> {
    let status = fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"))?;
    let kilobytes: f64 = line.trim().trim_end_matches(" kB").parse().ok()?;
    Some(kilobytes / 1024.0)
}

/// The same of a process of its own that reads the scene and draws the picture: what was drawn before leaves memory behind
/// in this one. `None` where it cannot be told.
pub(super) fn peak_of_drawing(spec: &PictureSpec, threads: Option<u16>) -> Option<f64> {
    let mut command = Command::new(std::env::current_exe().ok()?);
    command.args(["bench", "--json", "--frames", "1"]).args(spec.options());
    if let Some(threads) = threads {
        command.arg(format!("--threads={threads}"));
    }
    command.arg("--").arg(spec.scene.address());
    let output = command.stdin(Stdio::null()).stderr(Stdio::null()).output().ok()?;
    let report: serde_json::Value = serde_json::from_slice(&output.stdout).ok()?;
    report["peak_mb"].as_f64().filter(|_| output.status.success())
}
