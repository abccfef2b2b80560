//! How much memory the process has used at most, as Linux counts it; other systems do not tell. And whether there is
//! enough for a picture.

use std::fs;

use super::failure::Failure;

/// What a pixel needs until it is in a file: its frame, its channels for the encoder, the encoded file and a spare.
const BYTES_PER_PIXEL: u64 = 16;
/// What a picture needs besides.
const BYTES_BESIDE: u64 = 16 << 20;

/// Asks the system for as much memory as pictures of so many pixels will need, and gives it back. Who asks before the work
/// can say what is wrong; the drawing itself cannot.
pub(super) fn ask_for(pixels: u64) -> Result<(), Failure> {
    let bytes = pixels.saturating_mul(BYTES_PER_PIXEL).saturating_add(BYTES_BESIDE);
    let mut room: Vec<u8> = Vec::new();
    let asked = room.try_reserve_exact(usize::try_from(bytes).unwrap_or(usize::MAX));
    // A room that nobody looks at would never be asked for.
    std::hint::black_box(&room);
    asked.map_err(|_| {
        let megabytes = bytes >> 20;
        Failure::other(format!(
            "out of memory: {pixels} pixels need about {megabytes} MB, and the system gives less; draw fewer with --size"
        ))
    })
}

/// How many pixels a picture of this size has.
pub(super) fn pixels([width, height]: [u32; 2]) -> u64 {
    u64::from(width) * u64::from(height)
}

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
