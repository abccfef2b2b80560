//! `rasterscope board`: several settings of one region in numbers, and the sorted tables of `sweep`.

use std::fs;
use std::path::Path;

use rasterscope::figure::Record;

use crate::support::program::{command, done};
use crate::support::refusal::assert_refused;

const SCENE: &str = r##"<svg width="40" height="30"><polygon points="2,3 37,9 11,28" fill="#123456"/></svg>"##;

fn folder() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("a.svg"), SCENE).unwrap();
    folder
}

fn board(folder: &Path, options: &[&str]) -> serde_json::Value {
    let words = [&["board", "a.svg", "--json", "--frames=1", "--size=90x70"], options].concat();
    serde_json::from_str(&done(folder, &words)).unwrap()
}

/// The numbers of an entry: RMSE and FLIP.
fn numbers(report: &serde_json::Value, entry: usize) -> [f64; 2] {
    ["rmse", "flip"].map(|name| report["entries"][entry][name].as_f64().unwrap())
}

#[test]
fn board_says_what_diff_and_sweep_say() {
    let folder = folder();
    let at = folder.path();
    // The whole picture as the region: then the pictures of `render` can be compared.
    let report = board(at, &["--with=A", "--with=sample-rate 16", "--region=0,0,90,70"]);
    assert_eq!(report["entries"][0]["settings"]["sample-rate"], "16", "the best first");
    assert_eq!(
        report["entries"][1]["settings"],
        serde_json::json!({}),
        "A changes nothing"
    );
    for (entry, rate) in [(0, "16"), (1, "1")] {
        for (name, rate, pattern) in [("own.png", rate, "grid"), ("truth.png", "256", "hammersley")] {
            let (rate, pattern) = (format!("--sample-rate={rate}"), format!("--pattern={pattern}"));
            done(at, &["render", "a.svg", "-o", name, "--size=90x70", &rate, &pattern]);
        }
        let output = command(at, &["diff", "truth.png", "own.png", "--json"])
            .output()
            .unwrap();
        let diff: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
        let own = numbers(&report, entry);
        for (found, name) in own.iter().zip(["rmse", "flip"]) {
            let expected = diff[name].as_f64().unwrap();
            assert!(
                expected > 0.0 && (found - expected).abs() < 1e-9,
                "{name} of {rate}: {found}, not {expected}"
            );
        }
    }
    let lists = ["--sample-rate=1,16", "--size=90x70", "--frames=1", "--sort=rmse"];
    let words = [&["sweep", "a.svg", "--csv", "t.csv", "--markdown", "t.md"], &lists[..]].concat();
    done(at, &words);
    let table = fs::read_to_string(at.join("t.csv")).unwrap();
    let line: Vec<&str> = table.lines().nth(1).unwrap().split(',').collect();
    assert_eq!(line[0], "16", "sorted: {table}");
    let [rmse, flip] = numbers(&report, 0);
    let close = |cell: &str, value: f64| (cell.parse::<f64>().unwrap() - value).abs() < 1e-5;
    assert!(close(line[4], rmse) && close(line[7], flip), "{table} {rmse} {flip}");
    let markdown = fs::read_to_string(at.join("t.md")).unwrap();
    let mut lines = markdown.lines();
    let head = "| sample_rate | median_ms | min_ms | peak_mb | rmse | psnr_db | ssim | flip |";
    assert_eq!(lines.next(), Some(head), "{markdown}");
    assert!(
        lines.nth(1).is_some_and(|line| line.starts_with("| 16 |")),
        "{markdown}"
    );
    // The program's own tables may be written again.
    done(at, &words);
}

#[test]
fn board_truth_follows_a_or_is_chosen() {
    let folder = folder();
    let of = |options: &[&str]| {
        let report = board(
            folder.path(),
            &[&["--with=resolve linear", "--region=30,20,30,30"], options].concat(),
        );
        (
            report["truth_space"].as_str().unwrap().to_owned(),
            numbers(&report, 0)[0],
        )
    };
    let (stored, against_stored) = of(&["--sample-rate=16"]);
    let (linear, against_linear) = of(&["--sample-rate=16", "--truth-space=linear"]);
    let (as_a, _) = of(&["--sample-rate=16", "--resolve=linear"]);
    assert_eq!(
        [stored, linear, as_a],
        ["stored", "linear", "linear"],
        "as A, unless chosen"
    );
    assert!(
        against_linear < against_stored,
        "light against light: {against_linear} < {against_stored}"
    );
    let sweep = |options: &[&str]| {
        let words = [
            "sweep",
            "a.svg",
            "--csv",
            "s.csv",
            "--size=90x70",
            "--frames=1",
            "--sample-rate=16",
        ];
        done(folder.path(), &[&words[..], options].concat());
        let table = fs::read_to_string(folder.path().join("s.csv")).unwrap();
        let cell = table
            .lines()
            .nth(1)
            .unwrap()
            .split(',')
            .rev()
            .nth(3)
            .unwrap()
            .to_owned();
        cell.parse::<f64>().unwrap()
    };
    assert!(
        sweep(&["--truth-space=linear"]) > sweep(&[]),
        "stored values against light are farther"
    );
}

#[test]
fn board_is_a_table_and_a_picture() {
    let folder = folder();
    let at = folder.path();
    let words = [
        "board",
        "a.svg",
        "--size=90x70",
        "--frames=1",
        "--vary=pattern=grid,r2,sobol",
    ];
    let text = done(at, &[&words[..], &["--sample-rate=4"]].concat());
    assert_eq!(
        text.lines().count(),
        5,
        "names, three patterns, what was compared: {text}"
    );
    assert!(
        text.contains("64 \u{d7} 64 pixels from 13, 3 of 90 \u{d7} 70"),
        "in the middle: {text}"
    );
    let csv = done(at, &[&words[..], &["--csv", "--sort=time"]].concat());
    assert!(
        csv.starts_with("pattern,rmse,flip,time_ms\n") && !csv.contains('\r'),
        "{csv:?}"
    );
    let times: Vec<f64> = csv
        .lines()
        .skip(1)
        .map(|line| line.rsplit(',').next().unwrap().parse().unwrap())
        .collect();
    assert!(times.len() == 3 && times.is_sorted(), "{csv}");
    let markdown = done(at, &[&words[..], &["--markdown", "-o", "b.png"]].concat());
    assert!(
        markdown.starts_with("| pattern | rmse |") && markdown.contains("|---|"),
        "{markdown}"
    );
    let picture = image::open(at.join("b.png")).unwrap();
    assert!(
        picture.width() > 4 * 256 && picture.height() > 256,
        "the truth and three tiles"
    );
    let again = ["rerun", "b.png", "-o", "again.png"];
    let output = command(at, &again).output().unwrap();
    assert!(output.status.success(), "{output:?}");
    let size = image::image_dimensions(at.join("again.png")).unwrap();
    assert_eq!(size, (picture.width(), picture.height()), "the same board");
    let output = command(at, &["rerun", "b.png", "--check"]).output().unwrap();
    assert_refused(&output, &["rerun"], &["times", "rasterscope board a.svg"]);
    let shown = done(at, &["render", "b.png", "-o", "a.png"]);
    assert!(shown.is_empty(), "what A is comes back: {shown}");
    assert_eq!(
        image::image_dimensions(at.join("a.png")).unwrap(),
        (90, 70),
        "with its size"
    );
}

#[test]
fn board_tells_how_its_times_were_taken() {
    let folder = folder();
    let at = folder.path();
    let name = "a*b*c <i>.svg";
    fs::write(at.join(name), SCENE).unwrap();
    let words = ["board", name, "--size=90x70", "--with=A", "--markdown", "-o", "b.png"];
    for (frames, told) in [("--frames=1", "drawn once."), ("--frames=3", "the median of several.")] {
        let markdown = done(at, &[&words[..], &[frames]].concat());
        assert!(markdown.contains(told), "{markdown}");
        assert!(markdown.contains("a\\*b\\*c \\<i\\>.svg"), "no marks: {markdown}");
        let record = Record::of_file(&at.join("b.png")).unwrap().unwrap();
        assert!(record.command_line.contains(frames), "{}", record.command_line);
    }
}

#[test]
fn board_of_an_even_region_says_that_nothing_differs() {
    let folder = folder();
    let words = |region| {
        [
            "board",
            "a.svg",
            "--vary=sample-rate",
            "--frames=1",
            "--size=90x70",
            region,
        ]
    };
    let text = done(folder.path(), &words("--region=80,60,8,8"));
    assert!(text.contains("Nothing differs here: choose another part"), "{text}");
    let text = done(folder.path(), &words("--region=0,0,90,70"));
    assert!(!text.contains("Nothing differs"), "{text}");
}

#[test]
fn board_refuses_what_makes_no_sense() {
    let folder = folder();
    let many: Vec<String> = (1..=10).map(|seed| format!("--with=seed {seed}")).collect();
    let many: Vec<&str> = many.iter().map(String::as_str).collect();
    for (options, told) in [
        (&[][..], "--vary pattern"),
        (&["--with=foo"], "is not a setting"),
        (&["--with=pattern poisson"], "poisson"),
        (&["--with=A", "--with=sample-rate 1"], "already"),
        (&["--with=sample-rate 5"], "square"),
        (&["--vary=nothing"], "nothing"),
        (&["--vary=pattern=grid,grid"], "twice"),
        (&["--vary=sample-rate="], "empty"),
        (&["--vary=sample-rate=1,5"], "--vary: sample-rate 5: "),
        (&["--vary=sample-rate=7,8,9"], "square"),
        (&["--with=A", "--region=80,0,64,64"], "outside"),
        (&["--with=A", "--region=4294967295,0,4294967295,1"], "outside"),
        (&["--with=A", "-o", "b.jpg"], ".png"),
        (&["--with=A", "-o", "a.svg"], "a.svg"),
        (&many, "at most 9"),
    ] {
        let words = [&["board", "a.svg", "--size=90x70"], options].concat();
        let output = command(folder.path(), &words).output().unwrap();
        assert_refused(&output, &words, &[told]);
    }
    assert_eq!(
        fs::read_to_string(folder.path().join("a.svg")).unwrap(),
        SCENE,
        "nothing is written"
    );
}
