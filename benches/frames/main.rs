//! What a frame costs, ours and the peers': `cargo bench --bench frames -- [PART ...]`.
//!
//! Parts: `parts`, `stages`, `flat`, `drawings`, `course`, `slivers`, `textured`, `million`, `patterns`, `resolve`, `points`, `memory`; all of them without an
//! argument. The last lines are the table of the README. SVG files instead of parts are drawn as the drawings are; `--export FOLDER`
//! times us and writes what `benches/llvmpipe` draws, `--export-skia FOLDER` what `benches/skia` draws.

mod choices;
mod course;
mod drawings;
mod export;
mod flat;
mod memory;
mod meshes;
mod ours;
mod parts;
mod peers;
mod race;
mod scenes;
mod table;

use std::path::Path;
use std::time::Duration;

use rasterscope::scene;

use race::Budget;
use table::{markdown, say};

const BUDGET: Budget = Budget {
    time: Duration::from_millis(2500),
    max_rounds: 60,
};

fn main() {
    // Cargo adds `--bench`.
    let words: Vec<String> = std::env::args().skip(1).filter(|word| word != "--bench").collect();
    if let [option, folder] = words.as_slice()
        && let Some(export) = export::by_option(option)
    {
        export(folder.as_ref(), BUDGET).expect("a folder that can be written");
        return;
    }
    let paths: Vec<&Path> = words.iter().map(Path::new).collect();
    if paths.first().is_some_and(|path| scene::is_document(path)) {
        drawings::files(&paths, BUDGET);
        return;
    }
    let wanted = |part: &str| words.is_empty() || words.iter().any(|word| word == part);
    // First, while the allocator holds nothing of others.
    let memory = if wanted("memory") { memory::memory() } else { Vec::new() };
    let mut rows = Vec::new();
    if wanted("parts") {
        parts::parts();
    }
    if wanted("stages") {
        parts::stages();
    }
    say("\nmilliseconds, median (minimum); /1: one thread; @16: sixteen samples per pixel");
    if wanted("flat") {
        rows.extend(flat::flat(BUDGET));
    }
    if wanted("drawings") {
        rows.extend(drawings::drawings(BUDGET));
    }
    if wanted("course") {
        rows.extend(course::course(BUDGET));
    }
    if wanted("slivers") {
        rows.extend(flat::slivers(BUDGET));
    }
    if wanted("textured") {
        rows.extend(meshes::textured(BUDGET));
    }
    if wanted("million") {
        rows.extend(meshes::million(BUDGET));
    }
    if wanted("patterns") {
        rows.extend(choices::patterns(BUDGET));
    }
    if wanted("resolve") {
        rows.extend(choices::resolve(BUDGET));
    }
    if wanted("points") {
        meshes::points(BUDGET);
    }
    rows.extend(memory);
    if !rows.is_empty() {
        say(&format!("\n{}", markdown(&rows)));
    }
}
