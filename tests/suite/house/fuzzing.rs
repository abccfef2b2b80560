//! A smoke of the fuzz targets without a fuzzer: their seeds as they are, then mutated for a few seconds each.
//!
//! `fuzz/targets.rs` says what is fuzzed and which promises a target checks. `FUZZ_SECONDS=600 cargo test fuzz` runs
//! longer; `cargo fuzz run scene` searches by coverage.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;
use std::time::{Duration, Instant};

use crate::support::mutation::mutate;

#[path = "../../../fuzz/targets.rs"]
mod targets;

use targets::{TARGETS, Target};

/// How long one input may take in a checked build on a busy machine: the slowest ones, polygons of thousands of corners that are
/// explained by their truths, take a sixth of it where nothing runs beside them.
const PATIENCE: Duration = Duration::from_mins(1);
/// How long each target runs unless `FUZZ_SECONDS` says otherwise.
const SECONDS: u64 = 10;
/// What parsers stumble over: numbers at the ends of their ranges, delimiters, characters that are no text.
const SPLICES: [&str; 26] = [
    "-",
    "-0",
    "e999",
    "nan",
    "inf",
    "1e38",
    "1e-45",
    "99999999999999999999",
    "\"",
    "'",
    "<",
    ">",
    "&",
    "<g>",
    "</g>",
    "\u{0}",
    "\u{1b}[2J",
    "\u{202e}",
    "%",
    "(",
    "url(#",
    "0 0 0",
    "=",
    "[[",
    "\n",
    "..",
];

fn seconds() -> u64 {
    let chosen = std::env::var("FUZZ_SECONDS").ok();
    chosen.and_then(|seconds| seconds.parse().ok()).unwrap_or(SECONDS)
}

thread_local! {
    /// Threads of a test's own, so that it waits for no other test's pictures.
    static POOL: rayon::ThreadPool = rayon::ThreadPoolBuilder::new().num_threads(2).build().expect("a pool");
}

/// Runs one input; a panic is reported with its bytes.
fn run(target: &Target, input: &[u8]) {
    let started = Instant::now();
    let done = std::panic::catch_unwind(std::panic::AssertUnwindSafe(|| {
        POOL.with(|pool| pool.install(|| (target.run)(input)));
    }));
    let what = String::from_utf8_lossy(input).escape_debug().to_string();
    let name = target.name;
    assert!(done.is_ok(), "{name} fails on {} bytes: {what}", input.len());
    assert!(
        started.elapsed() < PATIENCE,
        "{name} took {:?} for {what}",
        started.elapsed()
    );
}

/// The seeds of a target, and then what becomes of them.
fn smoke(name: &str) {
    let target = TARGETS.iter().find(|target| target.name == name).expect("a target");
    let seeds = target.inputs();
    assert!(seeds.len() >= 2, "{name} has {} seeds", seeds.len());
    for seed in &seeds {
        run(target, seed);
    }
    arbtest::arbtest(|u| {
        let mut input = u.choose(&seeds)?.clone();
        for _ in 0..u.int_in_range(1..=6)? {
            mutate(u, &mut input, &SPLICES)?;
        }
        run(target, &input);
        Ok(())
    })
    .budget_ms(seconds() * 1000);
}

#[test]
fn fuzz_scene() {
    smoke("scene");
}

#[test]
fn fuzz_image() {
    smoke("image");
}

#[test]
fn fuzz_record() {
    smoke("record");
}

#[test]
fn fuzz_lesson() {
    smoke("lesson");
}

#[test]
fn fuzz_pattern() {
    smoke("pattern");
}

#[test]
fn fuzz_script() {
    smoke("script");
}

#[test]
fn fuzz_pins() {
    smoke("pins");
}

#[test]
fn fuzz_arguments() {
    smoke("arguments");
}

/// A target that only one of both runs would be forgotten by the other.
#[test]
fn fuzz_targets_are_those_of_the_fuzzer() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let files = fs::read_dir(root.join("fuzz/fuzz_targets")).unwrap();
    let files: BTreeSet<_> = files
        .map(|file| file.unwrap().path().file_stem().unwrap().to_owned())
        .collect();
    let named: BTreeSet<_> = TARGETS.iter().map(|target| target.name.into()).collect();
    assert_eq!(files, named, "one file for each target");
    let manifest = fs::read_to_string(root.join("fuzz/Cargo.toml")).unwrap();
    for target in TARGETS {
        let line = format!("path = \"fuzz_targets/{}.rs\"", target.name);
        assert!(manifest.contains(&line), "{line} stands in fuzz/Cargo.toml");
    }
}
