//! What a frame needs beside its scene: the process's peak of memory, as Linux counts it.

use std::fs;

use crate::ours::{Ours, pool, settings};
use crate::scenes::{flat, mesh};
use crate::table::{Row, say};

/// Rate of the row.
const RATE: u32 = 64;

/// The row of memory; none where the kernel does not tell.
pub(crate) fn memory() -> Vec<Row> {
    let size = [1920, 1080];
    let mut scenes: Vec<_> = flat::all(size).iter().map(|flat| (flat.name, flat.read())).collect();
    scenes.extend(mesh::textured(size).into_iter().map(|mesh| (mesh.name, mesh.scene)));
    let pool = pool(2);
    // Once, with all scenes in memory: what an earlier frame has freed serves the next one and must not be left out.
    let before = kilobytes("VmRSS:").filter(|_| fs::write("/proc/self/clear_refs", "5").is_ok());
    for (name, scene) in &scenes {
        // The frame itself counts, too.
        Ours::new(scene, size, settings(RATE), pool).draw();
        if let Some((before, peak)) = before.zip(kilobytes("VmHWM:")) {
            let [beside, all] = [peak - before, peak].map(|kilobytes| kilobytes / 1024.0);
            say(&format!(
                "{name:14} 1920x1080 @{RATE}: at most {beside:.1} MB beside the scenes, {all:.1} MB in all"
            ));
        }
    }
    let row = before.zip(kilobytes("VmHWM:")).map(|(before, peak)| Row {
        work: "memory while drawing 1920x1080 at rate 64, beside scene and textures",
        must: "150 MB",
        aim: "",
        here: format!("{:.0} MB ({:.0} MB in all)", (peak - before) / 1024.0, peak / 1024.0),
        part: "memory",
    });
    row.into_iter().collect()
}

fn kilobytes(field: &str) -> Option<f64> {
    let status = fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find_map(|line| line.strip_prefix(field))?;
    line.trim().trim_end_matches(" kB").parse().ok()
}
