//! `rasterscope pattern`.

use std::path::Path;
use std::process::Command;

/// What the program prints.
fn printed(arguments: &[&str]) -> (Option<i32>, String, String) {
    let output = Command::new(env!("CARGO_BIN_EXE_rasterscope"))
        .arg("pattern")
        .args(arguments)
        .current_dir(Path::new(env!("CARGO_TARGET_TMPDIR")))
        .output()
        .unwrap();
    let [out, error] = [output.stdout, output.stderr].map(|bytes| String::from_utf8(bytes).unwrap());
    (output.status.code(), out, error)
}

#[test]
fn cli_pattern_tells_all_patterns_beside_each_other() {
    let (status, text, _) = printed(&[]);
    assert_eq!(status, Some(0), "{text}");
    let row = |name: &str| -> Vec<f64> {
        let line = text.lines().find(|line| line.starts_with(&format!("{name} "))).unwrap();
        line.split_whitespace()
            .skip(1)
            .map(|word| word.parse().unwrap())
            .collect()
    };
    // Samples, discrepancy, distance, columns, rows, low power.
    assert_eq!(row("grid"), [16.0, 0.2344, 0.25, 4.0, 4.0, 0.0]);
    let (random, even) = (row("random"), row("multi-jittered"));
    assert!(
        even[1] < random[1] && even[2] > random[2],
        "more even than chance: {text}"
    );
    assert!(even[5] < 0.5 * random[5], "and less noise: {text}");
    let (status, text, _) = printed(&["--sample-rate", "5"]);
    assert_eq!(status, Some(0), "{text}");
    assert!(
        !text.contains("grid") && text.contains("sobol"),
        "those that take five: {text}"
    );
}

#[test]
fn cli_pattern_prints_the_points_that_pixels_have() {
    let (status, json, _) = printed(&["jittered", "--sample-rate=4", "--seed=3", "--pixel=7,9", "--json"]);
    assert_eq!(status, Some(0), "{json}");
    let report: serde_json::Value = serde_json::from_str(&json).unwrap();
    let points = report["points"].as_array().unwrap();
    assert_eq!(points.len(), 4, "one for each sample");
    let cells: std::collections::BTreeSet<[bool; 2]> = points
        .iter()
        .map(|point| [0, 1].map(|i| point[i].as_f64().unwrap() >= 0.5))
        .collect();
    assert_eq!(cells.len(), 4, "one in each cell: {json}");
    assert_eq!(
        report["spectrum"]["power"][0].as_f64(),
        Some(4.0),
        "all in phase: {json}"
    );
    let (_, other, _) = printed(&["jittered", "--sample-rate=4", "--seed=3", "--pixel=8,9", "--json"]);
    assert_ne!(json, other, "another pixel has others");
}

#[test]
fn cli_pattern_refuses_what_a_pattern_does_not_take() {
    let (status, out, error) = printed(&["grid", "--sample-rate", "5"]);
    assert_eq!((status, out.as_str()), (Some(2), ""), "{error}");
    assert!(error.lines().count() == 1 && error.contains("4 is nearest"), "{error}");
}
