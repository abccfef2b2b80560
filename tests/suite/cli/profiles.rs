//! `rasterscope profile`: an edge in numbers, beside the truth.

use std::fs;
use std::path::Path;

use crate::support::program::{command, done};
use crate::support::refusal::assert_refused;

/// The scene of filters: a square of 180 on 80, whose left side is at 36.
const FILTERS: &str = "svg/study/22_what_filters_cost.svg";
/// The line across that side, in the middle of the square.
const ACROSS: &[&str] = &["--line=20,76,52,76", "--view=canvas", "--size=512x384"];
/// The same where the side runs through the middle of pixels.
const THROUGH: &[&str] = &["--line=20,76,52,76", "--view=256.5,192,1", "--size=512x384"];

/// The object of `--json`, of a scene of ours.
fn report(scene: &str, options: &[&str]) -> serde_json::Value {
    let scene = Path::new(env!("CARGO_MANIFEST_DIR")).join(scene);
    let words = [&["profile", scene.to_str().unwrap(), "--json"], options].concat();
    serde_json::from_str(&done(Path::new(env!("CARGO_TARGET_TMPDIR")), &words)).unwrap()
}

fn number(report: &serde_json::Value, side: &str, name: &str) -> f64 {
    report[side]["edge"][name].as_f64().unwrap()
}

#[test]
fn profile_counts_the_shades_of_a_leaning_edge() {
    // Along the edge, which leans by a little more than a pixel: every shade that the samples have.
    let along = ["--line=512,120,511,900", "--size=1024x1024"];
    let shades = |options: &[&str], side: &str| {
        let report = report("svg/study/14_one_edge.svg", &[&along, options].concat());
        report[side]["shades"].as_u64().unwrap()
    };
    assert_eq!(shades(&[], "picture"), 2, "one sample");
    assert_eq!(shades(&["--sample-rate=16"], "picture"), 5, "four columns of a grid");
    assert_eq!(
        shades(&["--sample-rate=16", "--pattern=rotated"], "picture"),
        17,
        "sixteen"
    );
    let truth = shades(&[], "truth");
    assert!(
        truth > 100,
        "256 columns, of which the pixels have met so many: {truth}"
    );
    assert_eq!(
        shades(&["--sample-rate=256"], "picture"),
        17,
        "sixteen columns of a grid of 256"
    );
}

#[test]
fn profile_tells_how_far_filters_ring_and_blur() {
    let of = |filter: &str| {
        let filter = format!("--resolve-filter={filter}");
        let report = report(FILTERS, &[THROUGH, &["--sample-rate=16", &filter]].concat());
        ["width", "overshoot", "undershoot"].map(|name| number(&report, "picture", name))
    };
    let [middle, over, under] = of("box");
    assert!((middle - 1.6).abs() < 1e-9, "a pixel that is half covered: {middle}");
    assert!(over + under < 1e-9, "the box never rings: {over}, {under}");
    let [sharp, over, under] = of("lanczos3");
    assert!(
        over > 0.06 && under > 0.06,
        "Lanczos rings on both sides: {over}, {under}"
    );
    let [soft, over, under] = of("b-spline");
    assert!(over + under < 1e-9, "the B-spline never rings: {over}, {under}");
    assert!(sharp < middle && middle < soft, "but blurs: {sharp}, {middle}, {soft}");
}

#[test]
fn profile_prints_a_table_and_writes_one() {
    let folder = tempfile::tempdir().unwrap();
    let scene = Path::new(env!("CARGO_MANIFEST_DIR")).join(FILTERS);
    let words = [
        &["profile", scene.to_str().unwrap(), "--csv", "edge.csv", "--channel=red"],
        ACROSS,
    ]
    .concat();
    let text = done(folder.path(), &words);
    let lines: Vec<&str> = text.lines().collect();
    assert!(
        lines[0].contains("line from 20, 76 to 52, 76, 33 pixels, red"),
        "{text}"
    );
    let cells: Vec<&str> = lines[2].split_whitespace().collect();
    assert_eq!(
        cells,
        ["picture", "2", "80.0", "180.0", "0.80", "px", "0.0", "%", "0.0", "%"],
        "{text}"
    );
    let table = fs::read_to_string(folder.path().join("edge.csv")).unwrap();
    let rows: Vec<&str> = table.lines().collect();
    assert_eq!(rows.len(), 34, "a head, and a line for each pixel");
    assert_eq!(
        rows[1], "0.0000,20,76,80,90,102,255,88.378,80,90,102,255,88.378",
        "the first pixel"
    );
    assert!(rows[33].starts_with("32.0000,52,76,180,188,198,255,"), "{}", rows[33]);
    // Its own table may be written again, that of another may not.
    done(folder.path(), &words);
    fs::write(folder.path().join("edge.csv"), "mine").unwrap();
    let output = command(folder.path(), &words).output().unwrap();
    assert_refused(&output, &words, &["edge.csv", "--force"]);
}

#[test]
fn profile_without_an_edge_says_so() {
    let folder = tempfile::tempdir().unwrap();
    let scene = Path::new(env!("CARGO_MANIFEST_DIR")).join(FILTERS);
    for line in ["--line=40,60,60,60", "--line=40,60,40,60"] {
        let words = [&["profile", scene.to_str().unwrap(), line], &ACROSS[1..]].concat();
        let text = done(folder.path(), &words);
        assert!(text.contains("no edge: both ends of the line are alike"), "{text}");
    }
    let words = [
        &["profile", scene.to_str().unwrap(), "--line=36,26,236,26"],
        &ACROSS[1..],
    ]
    .concat();
    assert!(
        !done(folder.path(), &words).contains("no single edge"),
        "within one tint"
    );
    let words = [
        &["profile", scene.to_str().unwrap(), "--line=10,76,90,76"],
        &ACROSS[1..],
    ]
    .concat();
    let text = done(folder.path(), &words);
    assert!(
        text.contains("the values ") && text.contains("would be those of no single edge."),
        "across two: {text}"
    );
    assert!(
        !text.contains(" px") && text.contains('\u{2013}'),
        "of which no number is: {text}"
    );
    let report = report(FILTERS, &["--line=-40,60,600,60", "--view=canvas", "--size=512x384"]);
    assert_eq!(report["pixels"].as_array().unwrap().len(), 512, "what the picture has");
    assert_eq!(
        report["pixels"][0]["distance"].as_f64(),
        Some(40.0),
        "from the end outside"
    );
}

#[test]
fn profile_refuses_what_it_cannot_measure() {
    let folder = tempfile::tempdir().unwrap();
    let scene = Path::new(env!("CARGO_MANIFEST_DIR")).join(FILTERS);
    let scene = scene.to_str().unwrap();
    for (arguments, words) in [
        (
            vec![scene, "--line=0,500,9,500", "--size=64x48"],
            vec!["--line 0,500,9,500", "outside", "63,47"],
        ),
        (vec![scene, "--line=1,2,3"], vec!["300,200,340,200"]),
        (vec![scene], vec!["--line"]),
        (vec!["none.svg", "--line=1,2,3,4"], vec!["none.svg"]),
        (
            vec![scene, "--line=1,2,3,4", "--csv", "no/t.csv"],
            vec!["no/t.csv", "--csv"],
        ),
        (vec![scene, "--line=1,2,3,4", "--channel=hue"], vec!["hue"]),
    ] {
        let all = [&["profile"], arguments.as_slice()].concat();
        let output = command(folder.path(), &all).output().unwrap();
        assert_refused(&output, &all, &words);
    }
}

/// Few samples make stairs along one edge that the line follows: the truth's values do not, and nothing is said of it.
#[test]
fn profile_along_an_edge_says_whose_values_go_back_and_forth() {
    let folder = tempfile::tempdir().unwrap();
    let scene = folder.path().join("slope.svg");
    let slope = r##"<svg xmlns="http://www.w3.org/2000/svg" width="60" height="60" viewBox="0 0 60 60"><rect width="60" height="60" fill="#fff"/><polygon points="0,0 30.3,0 24.1,60 0,60" fill="#204080"/></svg>"##;
    fs::write(&scene, slope).unwrap();
    let words = [
        "profile",
        scene.to_str().unwrap(),
        "--dialect=svg",
        "--line=25,2,30,58",
        "--size=60x60",
        "--view=canvas",
        "--sample-rate=4",
    ];
    let text = done(folder.path(), &words);
    assert!(text.contains("In the picture the values "), "{text}");
    assert!(
        !text.contains("In the truth") && !text.contains("and in the truth"),
        "{text}"
    );
    assert!(!text.contains("crosses"), "there is one edge: {text}");
}
