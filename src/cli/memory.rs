//! How much memory the process has used at most, as Linux counts it; other systems do not tell.

use std::fs;

/// Forgets the peak so far: from here on the kernel counts anew. Whether it does.
pub(super) fn forget_peak() -> bool {
    // See proc_pid_clear_refs(5).
    fs::write("/proc/self/clear_refs", "5").is_ok()
}

/// The largest resident set since the start, or since [`forget_peak`], in megabytes of 2^20 bytes.
pub(super) fn peak_megabytes() -> Option<f64> {
    let status = fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"))?;
    let kilobytes: f64 = line.trim().trim_end_matches(" kB").parse().ok()?;
    Some(kilobytes / 1024.0)
}
