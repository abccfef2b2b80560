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
    let mut worst = 0.0_f64;
    for (name, scene) in &scenes {
        let before = kilobytes("VmRSS:").filter(|_| fs::write("/proc/self/clear_refs", "5").is_ok());
        // The frame itself counts, too.
        Ours::new(scene, size, settings(RATE), &pool).draw();
        let Some(megabytes) = before
            .zip(kilobytes("VmHWM:"))
            .map(|(before, peak)| (peak - before) / 1024.0)
        else {
            continue;
        };
        say(&format!(
            "{name:14} 1920x1080 @{RATE}: {megabytes:.1} MB at most beside the scene"
        ));
        worst = worst.max(megabytes);
    }
    let row = (worst > 0.0).then(|| Row {
        work: "memory while drawing 1920x1080 at rate 64, beside scene and textures",
        must: "150 MB",
        aim: "",
        here: format!("{worst:.0} MB"),
        part: "memory",
    });
    row.into_iter().collect()
}

fn kilobytes(field: &str) -> Option<f64> {
    let status = fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find_map(|line| line.strip_prefix(field))?;
    line.trim().trim_end_matches(" kB").parse().ok()
}
