//! `rasterscope sweep`: the table agrees with what single pictures say, the chart is there, Ctrl+C leaves what is done.

use std::fs;
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use rasterscope::color::ResolveSpace;
use rasterscope::compare::Pair;
use rasterscope::geometry::View;
use rasterscope::raster::{Framebuffer, SampleRate};
use rasterscope::render::{CancelToken, RenderSettings, draw};
use rasterscope::scene::{DialectChoice, load};

use crate::support::folder::names;
use crate::support::program::command;
#[cfg(unix)]
use crate::support::program::interrupt;
use crate::support::refusal::assert_refused;

const SCENE: &str = r##"<svg width="40" height="30"><polygon points="2,3 37,9 11,28" fill="#123456"/></svg>"##;

fn sweep(folder: &Path, arguments: &[&str]) -> Command {
    command(folder, &[&["sweep"], arguments].concat())
}

fn folder() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("a.svg"), SCENE).unwrap();
    folder
}

/// The lines of a table, cut at commas.
fn cells(path: &Path) -> Vec<Vec<String>> {
    let text = fs::read_to_string(path).unwrap();
    text.lines()
        .map(|line| line.split(',').map(str::to_owned).collect())
        .collect()
}

/// What the library says of 16 samples per pixel: RMSE, PSNR, SSIM and FLIP against the truth.
fn measured_at_sixteen(scene: &Path) -> [f64; 4] {
    let scene = load(scene, DialectChoice::Auto).unwrap();
    let picture = |settings: RenderSettings| {
        let mut frame = Framebuffer::new(90, 70);
        draw(
            &scene,
            &View::Default.transform(scene.canvas, [90, 70]),
            &settings,
            &mut frame,
        );
        frame
    };
    let plain = RenderSettings {
        sample_rate: SampleRate::new(16).unwrap(),
        resolve: ResolveSpace::Linear,
        ..RenderSettings::default()
    };
    let (own, truth) = (picture(plain), picture(plain.truth()));
    let (pair, stop) = (Pair::new(&own, &truth).unwrap(), CancelToken::default());
    let levels = pair.levels();
    [
        levels.rmse(),
        levels.psnr(),
        pair.ssim(&stop).unwrap(),
        pair.flip(&stop).unwrap(),
    ]
}

#[test]
fn sweep_measures_every_combination_against_the_truth() {
    let folder = folder();
    let lists = [
        "a.svg",
        "--csv",
        "t.csv",
        "--size",
        "90x70",
        "--sample-rate=1,16",
        "--rules=standard,course",
    ];
    let output = sweep(folder.path(), &lists)
        .args(["--frames", "2", "--resolve=linear"])
        .output()
        .unwrap();
    assert!(output.status.success(), "{output:?}");
    let table = cells(&folder.path().join("t.csv"));
    let head = "sample_rate,rules,resolve,median_ms,min_ms,peak_mb,rmse,psnr_db,ssim,flip";
    assert_eq!(table[0].join(","), head, "names and units");
    let choices: Vec<String> = table[1..].iter().map(|line| line[..3].join(" ")).collect();
    assert_eq!(
        choices,
        [
            "1 standard linear",
            "16 standard linear",
            "1 course linear",
            "16 course linear"
        ],
        "the first changes fastest"
    );
    let expected = measured_at_sixteen(&folder.path().join("a.svg"));
    for (cell, expected) in table[2][6..].iter().zip(expected) {
        let value: f64 = cell.parse().unwrap();
        assert!(
            (value - expected).abs() < 1e-4,
            "{value}, not {expected}: {:?}",
            table[2]
        );
    }
    let number = |line: usize, column: usize| table[line][column].parse::<f64>().unwrap();
    assert!(number(1, 9) > number(2, 9), "sixteen samples are nearer to the truth");
    for line in 1..=4 {
        assert!(
            number(line, 3) >= number(line, 4) && number(line, 4) > 0.0,
            "times of line {line}"
        );
        #[cfg(target_os = "linux")]
        assert!(number(line, 5) > 1.0, "a process takes some memory");
    }
    let text = String::from_utf8(output.stdout).unwrap();
    assert!(
        text.lines().count() == 5 && text.contains("course") && !text.contains("linear"),
        "{text}"
    );
    let chart = image::open(folder.path().join("t.png")).unwrap().into_rgb8();
    assert_eq!(chart.dimensions(), (1500, 1000), "the chart");
    assert_eq!(
        names(folder.path()),
        ["a.svg", "t.csv", "t.png"],
        "nothing else is left"
    );
}

#[cfg(target_os = "linux")]
#[test]
fn sweep_memory_does_not_depend_on_the_order() {
    let folder = folder();
    let peaks = |rates: &str| {
        let lists = [
            "a.svg",
            "--csv",
            "t.csv",
            "--size",
            "900x900",
            "--frames=1",
            "--threads=1",
        ];
        let output = sweep(folder.path(), &lists)
            .arg(format!("--sample-rate={rates}"))
            .output();
        assert!(output.unwrap().status.success(), "{rates}");
        let table = cells(&folder.path().join("t.csv"));
        let column = table[0].iter().position(|name| name == "peak_mb").unwrap();
        let mut peaks: Vec<(u32, f64)> = table[1..]
            .iter()
            .map(|line| (line[0].parse().unwrap(), line[column].parse().unwrap()))
            .collect();
        peaks.sort_by_key(|(rate, _)| *rate);
        peaks
    };
    let (up, down) = (peaks("1,4,16"), peaks("16,4,1"));
    for ((rate, first), (_, second)) in up.iter().zip(&down) {
        assert!((first - second).abs() < 2.0, "rate {rate}: {up:?} and {down:?}");
    }
}

/// Of SVG that the course's reading does not draw: an empty picture would be without any error.
#[test]
fn sweep_of_rules_measures_one_reading_of_the_document() {
    let folder = tempfile::tempdir().unwrap();
    let path = r##"<svg width="40" height="30"><path d="M2 3 L37 9 L11 28Z" fill="#123456"/></svg>"##;
    fs::write(folder.path().join("a.svg"), path).unwrap();
    let arguments = [
        "a.svg",
        "--csv",
        "t.csv",
        "--rules=standard,course",
        "--size=40x30",
        "--frames=1",
    ];
    assert!(sweep(folder.path(), &arguments).status().unwrap().success(), "measured");
    let table = cells(&folder.path().join("t.csv"));
    let column = table[0].iter().position(|name| name == "rmse").unwrap();
    for row in &table[1..] {
        let rmse: f64 = row[column].parse().unwrap();
        assert!(rmse > 1.0, "{row:?}");
    }
}

#[test]
fn sweep_refuses_before_it_measures() {
    let folder = folder();
    for (arguments, words) in [
        (
            vec!["a.svg", "--csv", "t.csv", "--sample-rate=1,5"],
            vec!["5", "square"],
        ),
        (
            vec!["a.svg", "--csv", "nowhere/t.csv"],
            vec!["nowhere/t.csv: cannot write", "no folder nowhere", "make it"],
        ),
        (vec!["a.svg", "--csv", "t.png"], vec!["t.png", "one file"]),
        (
            vec!["a.svg", "--csv", "t.csv", "--plot", "t.jpg"],
            vec!["t.jpg", ".png"],
        ),
        (vec!["a.svg", "--csv", "t.csv", "--no-such=1,2"], vec!["--no-such"]),
        (vec!["none.svg", "--csv", "t.csv"], vec!["none.svg"]),
        // The chart would lie beside it.
        (vec!["a.svg", "--csv", "/dev/null"], vec!["/dev/null", "--plot"]),
        (vec!["a.svg", "--csv", "t.csv", "--quality", "taste"], vec!["taste"]),
    ] {
        let output = sweep(folder.path(), &arguments).output().unwrap();
        let words: Vec<&str> = words;
        assert_refused(&output, &arguments, &words);
    }
    let list: Vec<String> = (-1000..1000)
        .map(|step| format!("{}", f64::from(step) / 64.0))
        .collect();
    let output = sweep(
        folder.path(),
        &["a.svg", "--csv", "t.csv", &format!("--lod-bias={}", list.join(","))],
    )
    .output()
    .unwrap();
    assert_refused(&output, &["2000 biases"], &["1000 combinations", "fewer"]);
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1, "nothing is written");
}

#[cfg(unix)]
#[test]
fn sweep_leaves_what_is_measured_when_interrupted() {
    let folder = folder();
    let list: Vec<String> = (-512..=400).map(|step| format!("{}", f64::from(step) / 32.0)).collect();
    let lists = format!("--lod-bias={}", list.join(","));
    let running = sweep(folder.path(), &["a.svg", "--csv", "t.csv", "--size=300x300", &lists])
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    // Long enough for some of nine hundred combinations, and far from long enough for all of them.
    std::thread::sleep(Duration::from_millis(1500));
    let start = Instant::now();
    interrupt(&running);
    let output = running.wait_with_output().unwrap();
    assert_eq!(output.status.code(), Some(130), "as after any Ctrl+C");
    assert!(start.elapsed() < Duration::from_secs(20), "at once");
    let stderr = String::from_utf8_lossy(&output.stderr);
    assert!(
        stderr.contains("stopped by Ctrl+C: ") && stderr.contains("combinations are in t.csv"),
        "{stderr}"
    );
    let table = cells(&folder.path().join("t.csv"));
    assert!(table.len() > 1 && table.len() < 900, "{} lines", table.len());
    assert!(table.iter().all(|line| line.len() == 8), "whole lines");
    assert!(folder.path().join("t.png").is_file(), "and the chart");
}
