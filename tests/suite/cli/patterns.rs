//! `rasterscope pattern`, and patterns from files.

use std::fs;
use std::path::Path;
use std::process::Command;
use std::time::{Duration, Instant};

use rasterscope::figure::{Record, encode_png};
use rasterscope::raster::Framebuffer;

use crate::support::program::{done, run};
use crate::support::refusal::assert_refused;

/// A board of a small picture, as a table.
const BOARD: [&str; 9] = [
    "board",
    "a.svg",
    "--csv",
    "--frames",
    "1",
    "--size",
    "40x30",
    "--region",
    "0,0,40,30",
];

const SCENE: &str = r##"<svg xmlns="http://www.w3.org/2000/svg" width="40" height="30">
  <polygon points="2,3 37,9 11,28" fill="#123456"/>
</svg>"##;

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
    let together = report["together"]["power"].as_array().unwrap();
    assert_eq!(together.len(), 17, "up to two cycles in eighths: {json}");
    assert_eq!(together[0].as_f64(), Some(256.0), "64 pixels, all in phase: {json}");
    let (_, other, _) = printed(&["jittered", "--sample-rate=4", "--seed=3", "--pixel=8,9", "--json"]);
    assert_ne!(json, other, "another pixel has others");
}

#[test]
fn cli_pattern_refuses_what_a_pattern_does_not_take() {
    let arguments = ["pattern", "poisson"];
    let words = ["poisson: no pattern", "grid|rotated", "TOML file"];
    assert_refused(&run(Path::new("."), &arguments), &arguments, &words);
    let (status, out, error) = printed(&["grid", "--sample-rate", "5"]);
    assert_eq!((status, out.as_str()), (Some(2), ""), "{error}");
    assert!(error.lines().count() == 1 && error.contains("4 is nearest"), "{error}");
}

/// What `render` says to a pattern's file with this text.
fn refused(document: &[u8], words: &[&str]) {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("a.svg"), SCENE).unwrap();
    fs::write(folder.path().join("p.toml"), document).unwrap();
    let arguments = ["render", "a.svg", "-o", "a.png", "--size", "8x8", "--pattern", "p.toml"];
    let begin = Instant::now();
    let output = run(folder.path(), &arguments);
    let took = begin.elapsed();
    assert!(took < Duration::from_secs(5), "{words:?}: {took:?}");
    assert_refused(&output, &arguments, words);
    assert!(!folder.path().join("a.png").exists(), "{words:?}: nothing is written");
}

#[test]
fn cli_pattern_files_at_fault_are_told_with_place_and_cure() {
    let of = |samples: &str| format!("name = \"own\"\nsamples = [\n  {samples}\n]\n");
    let one = "{ x = 0.5, y = 0.5 },";
    // All samples in one line.
    let minified = format!("name=\"own\"\nsamples=[{}{{x=0.5,y=7}}]", "{x=0.5,y=0.5},".repeat(200));
    let weight = "p.toml:3:32: a weight is a whole number from 1 to 256; write one";
    let place = ":3:9: not a place in the pixel; give a number from 0 to below 1";
    let weighted = |weight: &str| of(&format!("{{ x = 0.5, y = 0.5, weight = {weight} }}"));
    let placed = |x: &str| of(&format!("{{ x = {x}, y = 0.5 }}"));
    for (document, told) in [
        (
            "# \n".repeat(30_000) + &of(one),
            "p.toml: is larger than 64 KiB; give a sample pattern in TOML",
        ),
        (of(""), "p.toml:2:11: 0 samples; a pattern has 1 to 256"),
        (of(&one.repeat(257)), "p.toml:2:11: 257 samples; a pattern has 1 to 256"),
        (weighted("0"), weight),
        (weighted("-1"), weight),
        (weighted("1e9"), weight),
        (weighted("1000000000"), weight),
        (placed("1.0"), place),
        (placed("nan"), place),
        ("<svg/>".to_owned(), "p.toml:1:7: not TOML: "),
        (format!("samples = {}", "[".repeat(30_000)), "p.toml:1:"),
        (minified, "p.toml:2:2819: not a place in the pixel"),
    ] {
        refused(document.as_bytes(), &["--pattern: p.toml", told]);
    }
    refused(
        b"samples = [{ x = 0.25, y = 0.5 }]\nname = \"grid\"",
        &["--pattern: p.toml:2:8", "another name"],
    );
    refused(
        b"name = \"\xff\xfe\"",
        &["--pattern: p.toml: is not text in UTF-8; save it in that encoding"],
    );
}

#[test]
fn cli_pattern_file_is_in_the_record_itself() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("own.toml");
    fs::write(folder.path().join("a.svg"), SCENE).unwrap();
    fs::write(
        &file,
        "name = \"own\"\ngrid = 4\nsamples = [{ x = 1, y = 3 }, { x = 2, y = 2, weight = 2 }]",
    )
    .unwrap();
    let render = |pattern: &str, to: &str| {
        let arguments = ["render", "a.svg", "-o", to, "--size", "40x30", "--pattern", pattern];
        done(folder.path(), &arguments);
        image::open(folder.path().join(to)).unwrap().into_rgba8()
    };
    let drawn = render("own.toml", "a.png");
    assert!(drawn != render("grid", "grid.png"), "it makes a difference");
    fs::remove_file(&file).unwrap();
    let record = Record::of_file(&folder.path().join("a.png")).unwrap().unwrap();
    let own = "own:64/192+128/128x2";
    let told = record.settings.get("pattern").map(String::as_str);
    assert_eq!(told, Some(own), "the samples");
    assert!(
        !record.command_line.contains("toml"),
        "no file: {}",
        record.command_line
    );
    let said = done(folder.path(), &["rerun", "a.png", "--check"]);
    assert_eq!(said.trim(), "a.png: the same, all 1200 pixels", "without the file");
    assert!(drawn == render(own, "b.png"), "written out as the record has it");
    // A record of a stranger names no file that is read.
    let stranger = Record {
        arguments: record
            .arguments
            .iter()
            .map(|word| word.replace(own, "own.toml"))
            .collect(),
        ..record
    };
    let bytes = encode_png(&Framebuffer::new(2, 2), Some(&stranger)).unwrap();
    fs::write(folder.path().join("c.png"), bytes).unwrap();
    let arguments = ["rerun", "c.png", "--check"];
    assert_refused(&run(folder.path(), &arguments), &arguments, &["own.toml", "--pattern"]);
}

/// A folder with the scene `a.svg` and the pattern `own.toml` of three samples in two places.
fn folder_with_a_pattern() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("a.svg"), SCENE).unwrap();
    let own = "name = \"own\"\ngrid = 4\nsamples = [{ x = 1, y = 3 }, { x = 2, y = 2, weight = 2 }]";
    fs::write(folder.path().join("own.toml"), own).unwrap();
    folder
}

#[test]
fn cli_sheets_tell_how_many_samples_each_pattern_brings() {
    let folder = folder_with_a_pattern();
    let lists = |more: &[&str]| {
        let first = ["sheet", "a.svg", "-o", "s.png", "--size", "40x30", "--force"];
        done(folder.path(), &[&first, more].concat());
        fs::read_to_string(folder.path().join("s/figures.md")).unwrap()
    };
    let told = lists(&["--pattern=msaa-8,grid,own.toml"]);
    assert!(
        told.contains("with pattern msaa-8 (8 samples), grid (1 sample), own (3 samples). Each"),
        "{told}"
    );
    assert!(!told.contains("In all"), "no number of samples is that of all: {told}");
    assert!(
        folder.path().join("s/03_pattern-own-3-samples.png").is_file(),
        "short names"
    );
    let told = lists(&["--pattern=grid,rotated", "--sample-rate=4"]);
    assert!(
        told.contains("with pattern grid, rotated. In all: sample rate 4"),
        "{told}"
    );
    let said = done(folder.path(), &["rerun", "s.png", "--check"]);
    assert!(said.contains("the same"), "{said}");
}

#[test]
fn cli_sweeps_and_boards_take_patterns_from_files() {
    let folder = folder_with_a_pattern();
    let sweep = ["sweep", "a.svg", "--csv", "o.csv", "--size", "40x30", "--frames", "1"];
    let said = done(folder.path(), &[&sweep[..], &["--pattern=grid,own.toml"]].concat());
    let rows: Vec<Vec<&str>> = said.lines().map(|line| line.split_whitespace().collect()).collect();
    assert_eq!(rows[0][..2], ["pattern", "sample_rate"], "{said}");
    assert_eq!(
        (&rows[1][..2], &rows[2][..2]),
        (&["grid", "1"][..], &["own", "3"][..]),
        "{said}"
    );
    let table = fs::read_to_string(folder.path().join("o.csv")).unwrap();
    assert!(
        table.contains("\nown,3,"),
        "by its name, whose samples the chart's record has: {table}"
    );
    let chart = Record::of_file(&folder.path().join("o.png")).unwrap().unwrap();
    assert!(
        chart.command_line.contains("own:64/192+128/128x2"),
        "{}",
        chart.command_line
    );
    let board = |more: &[&str]| done(folder.path(), &[&BOARD[..], more].concat());
    let varied = board(&["--vary", "pattern=grid,own.toml"]);
    assert!(varied.contains("3,own"), "{varied}");
    let added = board(&["--with", "A", "--with", "rules float, pattern own.toml"]);
    assert!(added.contains("3,own"), "{added}");
    fs::remove_file(folder.path().join("own.toml")).unwrap();
    let arguments = ["board", "a.svg", "--with", "pattern own.toml"];
    assert_refused(&run(folder.path(), &arguments), &arguments, &["--with", "own.toml"]);
}

#[test]
fn cli_samples_of_patterns_flood_no_caption_and_no_table() {
    let folder = folder_with_a_pattern();
    let at = |name: &str| fs::read_to_string(folder.path().join(name)).unwrap();
    let small = ["--size", "40x30", "--pattern", "own.toml"];
    let sheet = ["sheet", "a.svg", "-o", "s.png", "--pixel-sampling", "nearest,bilinear"];
    done(folder.path(), &[&sheet[..], &small].concat());
    let told = at("s/figures.md");
    assert!(told.contains(", pattern own. Each") && !told.contains("own:"), "{told}");
    let record = Record::of_file(&folder.path().join("s.png")).unwrap().unwrap();
    assert!(record.command_line.contains("own:64/192"), "{}", record.command_line);
    let measured = ["--frames", "1"];
    let sweep = [
        "sweep",
        "a.svg",
        "--csv",
        "o.csv",
        "--pixel-sampling",
        "nearest,bilinear",
    ];
    done(folder.path(), &[&sweep[..], &small, &measured].concat());
    let told = at("o.csv");
    assert!(told.contains(",own,") && !told.contains("own:"), "{told}");
    let board = ["board", "a.svg", "--vary", "pattern=grid,own.toml", "--size", "40x30"];
    for form in ["--csv", "--markdown"] {
        let told = done(folder.path(), &[&board[..], &measured, &[form]].concat());
        assert!(told.contains("own") && !told.contains("own:"), "{told}");
    }
    let board = ["board", "a.svg", "--with=A", "--with=pixel-sampling bilinear"];
    let told = done(folder.path(), &[&board[..], &small, &measured].concat());
    assert!(told.contains("pattern own") && !told.contains("own:"), "{told}");
}

#[test]
fn cli_patterns_of_one_name_are_refused_beside_each_other() {
    let folder = folder_with_a_pattern();
    let other = "name = \"own\"\nsamples = [{ x = 0.5, y = 0.5 }]";
    fs::write(folder.path().join("other.toml"), other).unwrap();
    let files = "--pattern=own.toml,other.toml";
    let written = "--pattern=own:64/192,own:128/128";
    let small = "--size=40x30";
    for (arguments, told) in [
        (
            &["sheet", "a.svg", "-o", "s.png", small, files][..],
            ["own.toml and other.toml", "`own`"],
        ),
        (
            &["sweep", "a.svg", "--csv", "s.csv", small, files],
            ["own.toml and other.toml", "another name"],
        ),
        (
            &["sweep", "a.svg", "--csv", "s.csv", small, written],
            ["own:64/192 and own:128/128", "another name"],
        ),
        (
            &["board", "a.svg", small, "--vary", "pattern=own.toml,other.toml"],
            ["own.toml and other.toml", "another name"],
        ),
        (
            &[
                "board",
                "a.svg",
                small,
                "--with=pattern own.toml",
                "--with=pattern other.toml",
            ],
            ["own:64/192", "own:128/128"],
        ),
        (
            &[
                "board",
                "a.svg",
                small,
                "--with=pattern own.toml",
                "--vary=pattern=other.toml,grid",
            ],
            ["own:64/192", "own:128/128"],
        ),
    ] {
        assert_refused(&run(folder.path(), arguments), arguments, &told);
    }
    // The same samples twice are one pattern.
    let twice = [
        "board",
        "a.svg",
        small,
        "--frames=1",
        "--with=pattern own.toml",
        "--vary=pattern=own.toml,grid",
    ];
    done(folder.path(), &twice);
}

#[test]
fn cli_files_of_patterns_may_have_commas_in_their_names() {
    let folder = folder_with_a_pattern();
    fs::rename(folder.path().join("own.toml"), folder.path().join("my,own.toml")).unwrap();
    let render = ["render", "a.svg", "-o", "a.png", "--pattern", "my,own.toml"];
    done(folder.path(), &render);
    let record = Record::of_file(&folder.path().join("a.png")).unwrap().unwrap();
    assert_eq!(record.settings["pattern"], "own:64/192+128/128x2", "the only value");
    let sheet = ["sheet", "a.svg", "-o", "s.png", "--size", "40x30"];
    let list = ["--pattern=grid,\"my,own.toml\""];
    done(folder.path(), &[&sheet[..], &list].concat());
    let told = fs::read_to_string(folder.path().join("s/figures.md")).unwrap();
    assert!(told.contains("grid (1 sample), own (3 samples)"), "in a list: {told}");
    let with = ["--with", "rules float, pattern \"my,own.toml\""];
    let added = done(folder.path(), &[&BOARD[..], &with].concat());
    assert!(added.contains("3,own"), "among settings: {added}");
}

#[test]
fn cli_pixels_of_patterns_from_files_are_told_of_exact_areas() {
    let folder = tempfile::tempdir().unwrap();
    let scene = [
        "inspect",
        "gallery:study/01_zone_plate.svg",
        "--pixel",
        "170,32",
        "--size",
        "400x300",
    ];
    let told = done(folder.path(), &[&scene[..], &["--pattern", "msaa-8"]].concat());
    let told = told.split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(
        told.contains("Coverage by exact areas: 110 levels"),
        "its number of samples is fixed: {told}"
    );
}

#[test]
fn cli_explanations_tell_what_places_weigh() {
    let folder = folder_with_a_pattern();
    let told = done(
        folder.path(),
        &[
            "inspect",
            "a.svg",
            "--pixel",
            "12,10",
            "--size",
            "40x30",
            "--pattern",
            "own.toml",
        ],
    );
    assert!(told.contains("Each of the 3 samples weighs 1/3"), "{told}");
    assert!(
        told.contains("Samples 2, 3 are one place, (0.502, 0.502), which weighs 2/3."),
        "{told}"
    );
}
