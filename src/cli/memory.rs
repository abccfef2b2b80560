//! How much memory drawing a picture takes, as Linux, Windows and macOS count it. And whether there is enough for a picture.

use std::process::{Command, Stdio};

use super::failure::Failure;
use crate::memory::{self, OutOfMemory};
use crate::viewer::PictureSpec;

/// What a pixel needs until it is in a file: its frame, its channels for the encoder, the encoded file and a spare.
const BYTES_PER_PIXEL: u64 = 16;
/// What a picture needs besides.
const BYTES_BESIDE: u64 = 16 << 20;

/// Asks the system for as much memory as pictures with this many pixels will need, and gives it back. Who asks before the work
/// can say what is wrong; the drawing itself cannot.
pub(super) fn ask_for(pixels: u64) -> Result<(), Failure> {
    ask(pixels, "draw fewer with --size")
}

/// As [`ask_for`], for pictures from outside.
pub(super) fn ask_for_comparing(pixels: u64) -> Result<(), Failure> {
    ask(pixels, "compare smaller pictures")
}

fn ask(pixels: u64, cure: &str) -> Result<(), Failure> {
    let bytes = pixels.saturating_mul(BYTES_PER_PIXEL).saturating_add(BYTES_BESIDE);
    memory::ask_for(bytes).map_err(|OutOfMemory { megabytes }| {
        Failure::other(format!(
            "out of memory: {pixels} pixels need about {megabytes} MB, and the system gives less; {cure}"
        ))
    })
}

/// How many pixels a picture of this size has.
pub(super) fn pixels([width, height]: [u32; 2]) -> u64 {
    u64::from(width) * u64::from(height)
}

/// The largest resident set of this process since its start, in megabytes of 2^20 bytes; `None` where the system does not tell.
#[cfg(not(any(windows, target_os = "macos")))]
pub(super) fn peak_megabytes() -> Option<f64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"))?;
    let kilobytes: f64 = line.trim().trim_end_matches(" kB").parse().ok()?;
    Some(kilobytes / 1024.0)
}

/// The same on Windows.
#[cfg(windows)]
pub(super) fn peak_megabytes() -> Option<f64> {
    super::windows::peak_bytes().map(|bytes| bytes as f64 / 1_048_576.0)
}

/// The same on macOS.
#[cfg(target_os = "macos")]
pub(super) fn peak_megabytes() -> Option<f64> {
    use nix::sys::resource::{UsageWho, getrusage};
    // In bytes there, where other systems of its family count kilobytes.
    let usage = getrusage(UsageWho::RUSAGE_SELF).ok()?;
    Some(usage.max_rss() as f64 / 1_048_576.0)
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
