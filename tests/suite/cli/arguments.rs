//! The program from outside: what it prints, writes and answers as exit status.

use std::fs;
use std::path::Path;
use std::process::Command;

use rasterscope::geometry::View;
use rasterscope::render::RenderSettings;
use rasterscope::scene::{DialectChoice, load};

use crate::support::program::run;
use crate::support::refusal::assert_refused;
use crate::support::scenes::{at_rate, drawn};

const SCENE: &str = r##"<svg width="40" height="30"><polygon points="2,3 37,9 11,28" fill="#123456"/></svg>"##;

/// Runs the program, which must refuse.
fn refused(folder: &Path, arguments: &[&str], words: &[&str]) {
    assert_refused(&run(folder, arguments), arguments, words);
}

fn folder_with(files: &[(&str, &str)]) -> tempfile::TempDir {
    let folder = tempfile::tempdir().expect("a temporary folder");
    for (name, text) in files {
        let path = folder.path().join(name);
        fs::create_dir_all(path.parent().expect("a folder")).expect("a writable folder");
        fs::write(path, text).expect("a writable folder");
    }
    folder
}

#[test]
fn cli_tells_a_mistyped_command() {
    let folder = folder_with(&[("a.svg", SCENE)]);
    for (arguments, name) in [
        (&["rendr", "a.svg"][..], "did you mean `rasterscope render`?"),
        (&["rendr", "a.svg", "-o", "b.png"], "there is no command rendr"),
        (&["spektrum", "a.svg"], "did you mean `rasterscope spectrum`?"),
    ] {
        refused(folder.path(), arguments, &[name]);
    }
    assert!(!folder.path().join("b.png").exists(), "nothing is drawn");
}

#[test]
fn cli_visualisations_come_with_a_legend_where_there_is_room() {
    let folder = folder_with(&[("a.svg", SCENE)]);
    let picture = |name: &str, more: &[&str]| {
        let mut arguments = vec!["render", "a.svg", "-o", name, "--visualise", "coverage", "--size"];
        arguments.extend(more);
        let output = run(folder.path(), &arguments);
        assert!(output.status.success(), "{output:?}");
        let told = String::from_utf8_lossy(&output.stderr).into_owned();
        (image::open(folder.path().join(name)).expect("a PNG").into_rgba8(), told)
    };
    let (with, told) = picture("with.png", &["400x300"]);
    assert_eq!(told, "", "nothing to tell");
    let (without, _) = picture("without.png", &["400x300", "--no-legend"]);
    let changed = with.pixels().zip(without.pixels()).filter(|(a, b)| a != b).count();
    assert!(changed > 5000, "{changed} pixels are the legend's");
    assert_eq!(
        with.get_pixel(390, 10),
        without.get_pixel(390, 10),
        "elsewhere nothing changes"
    );
    let (_, told) = picture("small.png", &["100x80"]);
    assert!(told.contains("no room for the legend in 100x80 pixels; make"), "{told}");
    for name in ["with.png", "without.png", "small.png"] {
        let output = run(folder.path(), &["rerun", name, "--check", "--threads", "1"]);
        assert!(output.status.success(), "{name} again: {output:?}");
    }
}

#[test]
fn cli_renders_what_the_library_draws() {
    let folder = folder_with(&[("a.svg", SCENE)]);
    let view = "--view=20,15,3.5,30";
    let output = run(
        folder.path(),
        &[
            "render",
            "a.svg",
            "-o",
            "b.png",
            "--size",
            "90x70",
            "--sample-rate",
            "9",
            view,
        ],
    );
    assert!(output.status.success(), "{output:?}");
    assert!(
        output.stdout.is_empty() && output.stderr.is_empty(),
        "no news is good news: {output:?}"
    );
    let scene = load(&folder.path().join("a.svg"), DialectChoice::Auto).expect("a scene");
    let view = View::At {
        center: glam::DVec2::new(20.0, 15.0),
        scale: 3.5,
        rotation: 30.0,
    };
    let settings = RenderSettings {
        outline: true,
        ..at_rate(9)
    };
    let frame = drawn(&scene, &view.transform(scene.canvas, [90, 70]), &settings, [90, 70]);
    let picture = image::open(folder.path().join("b.png")).expect("a PNG").into_rgba8();
    assert_eq!(picture.dimensions(), (90, 70), "as asked");
    for (x, y, pixel) in picture.enumerate_pixels() {
        assert_eq!(Some(pixel.0), frame.rgba(x, y), "pixel {x}, {y}");
    }
}

/// Lines beside a circle: both dialects read it, each in its way.
const EITHER: &str = r##"<svg width="40" height="30"><line x1="2" y1="3" x2="37" y2="9" stroke="#123456"/><circle cx="9" cy="9" r="5"/></svg>"##;

#[test]
fn cli_says_which_of_two_readings_was_taken() {
    let folder = folder_with(&[("a.svg", EITHER)]);
    let render = |more: &[&str]| {
        let arguments = [&["render", "a.svg", "-o", "b.png", "--size", "40x30"], more].concat();
        let output = run(folder.path(), &arguments);
        assert!(output.status.success(), "{output:?}");
        let told = String::from_utf8_lossy(&output.stderr).into_owned();
        (fs::read(folder.path().join("b.png")).expect("a picture"), told)
    };
    let pixels = |png: &[u8]| image::load_from_memory(png).expect("a PNG").into_rgba8();
    let (svg, told) = render(&[]);
    assert!(
        told.contains("a.svg: read as svg; --dialect course makes another picture"),
        "{told}"
    );
    let (_, asked) = render(&["--dialect", "svg"]);
    assert!(!asked.contains("read as"), "asked for, nothing to tell: {asked}");
    let (course, told) = render(&["--rules", "course"]);
    assert!(
        told.contains("read as course, as --rules course asks for; --dialect svg makes"),
        "{told}"
    );
    let (asked, _) = render(&["--rules", "course", "--dialect", "course"]);
    assert!(pixels(&course) == pixels(&asked), "--rules course means the dialect");
    assert!(pixels(&course) != pixels(&svg), "another picture");
    let (kept, _) = render(&["--rules", "course", "--dialect", "svg"]);
    assert!(pixels(&kept) != pixels(&asked), "the option decides");
}

#[test]
fn cli_reads_a_folder_of_the_course_as_a_whole() {
    let own = "<svg width='4' height='3'><colortri points='0 0 4 0 0 3' colors='1 0 0 1 0 1 0 1 0 0 1 1'/></svg>";
    let only_svg =
        "<svg xmlns='http://www.w3.org/2000/svg' width='4' height='3'><path d='M0 0h4v3z' fill='#ff0000'/></svg>";
    let folder = folder_with(&[
        ("in/a.svg", EITHER),
        ("in/deep/b.svg", own),
        ("in/drawing.svg", only_svg),
        ("out/c.svg", EITHER),
    ]);
    let args = ["render", "in", "-o", "pictures", "--size", "40x30"];
    let output = run(folder.path(), &args);
    let told = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(
        told.contains("read as course, as other scenes of the folder are; --dialect svg makes another"),
        "{told}"
    );
    assert!(!told.contains("drawing.svg"), "SVG without a word: {told}");
    let alone = [
        "render",
        "in/a.svg",
        "-o",
        "c.png",
        "--size",
        "40x30",
        "--dialect",
        "course",
    ];
    assert!(run(folder.path(), &alone).status.success(), "alone");
    let open = |name: &str| image::open(folder.path().join(name)).expect("a PNG").into_rgba8();
    assert!(open("pictures/a.png") == open("c.png"), "as the course's");
    let drawing = open("pictures/drawing.png");
    assert_eq!(
        drawing.get_pixel(25, 10).0,
        [255, 0, 0, 255],
        "which the course cannot draw"
    );
    for picture in ["pictures/a.png", "pictures/drawing.png"] {
        let check = ["rerun", picture, "--check", "--threads", "1"];
        assert!(
            run(folder.path(), &check).status.success(),
            "the record of {picture} says so"
        );
    }
    let (entries, _) = rasterscope::viewer::list_scenes(&[folder.path().join("out")]);
    assert_eq!(entries.len(), 1, "another folder");
    assert!(
        !rasterscope::viewer::is_folder_of_course(&folder.path().join("out")),
        "is not the course's"
    );
}

#[test]
fn cli_renders_transparent_canvas() {
    let folder = folder_with(&[("a.svg", SCENE)]);
    let options = [
        "render",
        "a.svg",
        "-o",
        "b.png",
        "--size",
        "40x30",
        "--view",
        "canvas",
        "--background",
        "transparent",
    ];
    assert!(run(folder.path(), &options).status.success(), "done");
    let picture = image::open(folder.path().join("b.png")).expect("a PNG").into_rgba8();
    assert_eq!(picture.get_pixel(0, 0).0[3], 0, "no outline, no paper");
    assert_eq!(picture.get_pixel(15, 12).0, [0x12, 0x34, 0x56, 255], "the triangle");
}

#[test]
fn cli_renders_every_scene_of_a_folder() {
    let folder = folder_with(&[("in/a.svg", SCENE), ("in/deep/b.svg", SCENE), ("in/c.txt", "no scene")]);
    let output = run(folder.path(), &["render", "in", "-o", "out", "--size", "20x20"]);
    assert!(output.status.success(), "{output:?}");
    assert!(
        folder.path().join("out/a.png").is_file() && folder.path().join("out/deep/b.png").is_file(),
        "both"
    );
    fs::write(folder.path().join("in/broken.svg"), "<svg").expect("a writable folder");
    fs::remove_dir_all(folder.path().join("out")).expect("the folder is there");
    let output = run(folder.path(), &["render", "in", "-o", "out", "--size", "20x20"]);
    let stderr = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(2), "one is broken: {stderr}");
    assert!(
        stderr.contains("broken.svg") && stderr.contains("1 of 3"),
        "it is named: {stderr}"
    );
    assert!(
        folder.path().join("out/a.png").is_file() && folder.path().join("out/deep/b.png").is_file(),
        "others too"
    );
}

#[test]
fn cli_never_draws_two_scenes_into_one_picture() {
    let folder = folder_with(&[("in/a.svg", SCENE), ("in/a.SVG", SCENE)]);
    let output = run(folder.path(), &["render", "in", "-o", "out", "--size", "20x20"]);
    let stderr = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(2), "{stderr}");
    assert!(stderr.contains("rename"), "the cure: {stderr}");
}

#[cfg(feature = "window")]
#[test]
fn cli_view_answers_mistakes_too() {
    let folder = folder_with(&[("a.svg", SCENE), ("broken.svg", "<svg>\n<g></svg>")]);
    refused(folder.path(), &["nowhere.svg"], &["nowhere.svg"]);
    refused(folder.path(), &["view", "--headless", "broken.svg"], &["broken.svg:2:"]);
    refused(
        folder.path(),
        &["a.svg", "--headless", "--frame-log", "log.csv"],
        &["--frame-log", "--headless"],
    );
    refused(
        folder.path(),
        &["a.svg", "--headless", "--do", "shot a.svg"],
        &["a.svg", ".png"],
    );
    let rates = ["a.svg", "--headless", "--do", "rate 4; rate 5; rate 9"];
    refused(folder.path(), &rates, &["--do:1:9: pattern grid takes a square number"]);
    let scene = ["a.svg", "--headless", "--do", "scene nope"];
    refused(
        folder.path(),
        &scene,
        &["\"nope\" is not a scene's number, from 1; write that behind scene"],
    );
    let late = ["a.svg", "--headless", "--do", "key Ctrl+Q; shot never.png"];
    refused(
        folder.path(),
        &late,
        &["--do:1:13: it is not played", "let that one be the last"],
    );
    let against = ["a.svg", "--headless", "--against", "sample-rate 5"];
    refused(
        folder.path(),
        &against,
        &["--against: pattern grid takes a square number"],
    );
    let against = ["a.svg", "--headless", "--against", "sample-rate 5, pattern sobol"];
    let taken = run(folder.path(), &against);
    assert!(taken.status.success(), "in any order: {taken:?}");
    let nowhere = [
        "a.svg",
        "--headless",
        "--screenshot-dir",
        "no/such",
        "--do",
        "key s; wait",
    ];
    refused(folder.path(), &nowhere, &["no/such"]);
    assert_eq!(
        fs::read_to_string(folder.path().join("a.svg")).expect("still there"),
        SCENE,
        "untouched"
    );
}

/// Also where the message about it has left the screen, or others pushed it out.
#[cfg(feature = "window")]
#[test]
fn cli_view_names_every_step_that_went_wrong() {
    let folder = folder_with(&[("a.svg", SCENE), ("old.png", "kept")]);
    let steps = "save-as old.png; wait 60000; theme light; save-as no/1.png; save-as new.png; scene 9; theme dark";
    let run = run(folder.path(), &["a.svg", "--headless", "--do", steps]);
    let told = String::from_utf8(run.stderr).expect("text");
    assert_eq!(run.status.code(), Some(2), "{told}");
    assert_eq!(
        told.lines()
            .filter(|line| line.starts_with("rasterscope: --do:1:"))
            .count(),
        3,
        "{told}"
    );
    assert!(told.contains("--do:1:1: old.png: this file exists"), "{told}");
    assert!(told.contains("--do:1:43: no/1.png: cannot save here"), "{told}");
    assert!(told.contains("--do:1:78: "), "{told}");
    assert!(folder.path().join("new.png").exists(), "what could be done was");
}

#[test]
fn cli_reports_what_it_skips() {
    let text = SCENE.replace("<polygon", "\n  <foreignObject width='3' height='3'/><polygon");
    let folder = folder_with(&[("a.svg", &text)]);
    let output = run(folder.path(), &["render", "a.svg", "-o", "b.png", "--size", "20x20"]);
    assert!(output.status.success(), "a picture all the same: {output:?}");
    let stderr = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(
        stderr.contains("a.svg:2:3: <foreignObject>"),
        "file, line, column, name: {stderr}"
    );
}

#[test]
fn cli_answers_mistakes_in_one_line_with_status_two() {
    let folder = folder_with(&[
        ("a.svg", SCENE),
        ("broken.svg", "<svg>\n<g></svg>"),
        ("empty.svg", ""),
        ("list/x", ""),
    ]);
    let to = |scene: &'static str| ["render", scene, "-o", "b.png"];
    refused(folder.path(), &to("nowhere.svg"), &["nowhere.svg"]);
    refused(folder.path(), &to("broken.svg"), &["broken.svg:2:"]);
    refused(folder.path(), &to("empty.svg"), &["empty.svg", "empty"]);
    refused(folder.path(), &["render", "list", "-o", "out"], &["list", "no scene"]);
    refused(folder.path(), &["render", "a.svg", "-o", "b.gif"], &["b.gif", ".png"]);
    refused(
        folder.path(),
        &["render", "a.svg", "-o", "no/such/b.png"],
        &["no/such/b.png"],
    );
    refused(
        folder.path(),
        &["render", "a.svg", "-o", "b.png", "--sample-rate", "7"],
        &["7", "square"],
    );
    refused(
        folder.path(),
        &["render", "a.svg", "-o", "b.png", "--size", "big"],
        &["big", "WIDTHxHEIGHT"],
    );
    refused(
        folder.path(),
        &["render", "a.svg", "-o", "b.png", "--colour"],
        &["--colour"],
    );
    refused(
        folder.path(),
        &["render", "nofolder", "-o", "out"],
        &["rasterscope: nofolder: there is no such file or folder"],
    );
    refused(
        folder.path(),
        &["sheet", "a.svg", "-o", "b.png", "--sample-rate", "1-4"],
        &["\"1-4\" is not a whole number", "see `rasterscope sheet --help`"],
    );
    refused(
        folder.path(),
        &["board", "a.svg", "--with", "frob 3"],
        &["there is no setting frob; there are sample-rate, pattern,"],
    );
    refused(folder.path(), &["bench", "nowhere.svg"], &["nowhere.svg"]);
    assert!(!folder.path().join("b.png").exists(), "nothing was written");
}

#[test]
fn cli_bench_prints_json() {
    let folder = folder_with(&[("a.svg", SCENE)]);
    let options = [
        "bench",
        "a.svg",
        "--size",
        "64x48",
        "--sample-rate",
        "4",
        "--frames",
        "3",
        "--json",
        "--threads",
        "2",
    ];
    let output = run(folder.path(), &options);
    assert!(output.status.success(), "{output:?}");
    let printed = String::from_utf8_lossy(&output.stdout);
    let times = printed
        .split(['{', ',', '}'])
        .filter(|part| part.contains("_ms\":") || part.contains("raster"));
    let digits = |part: &str| part.rsplit_once('.').map_or(0, |(_, digits)| digits.trim().len());
    assert!(times.clone().count() > 2, "{printed}");
    assert!(
        times.clone().all(|part| digits(part) <= 6),
        "whole nanoseconds: {printed}"
    );
    let report: serde_json::Value = serde_json::from_str(&printed).expect("one JSON object");
    for (name, value) in [
        ("width", 64),
        ("height", 48),
        ("sample_rate", 4),
        ("frames", 3),
        ("threads", 2),
    ] {
        assert_eq!(report[name], value, "{name} of {report}");
    }
    let stages = &report["stages_ms"];
    for stage in ["transform", "bin", "raster", "resolve"] {
        assert!(stages[stage].as_f64() >= Some(0.0), "{stage} of {report}");
    }
    assert!(stages["present"].is_null(), "nothing is presented: {report}");
    assert_eq!(report["triangles"], 1, "triangles of {report}");
    assert_eq!(
        report["counters"]["triangles"], 1,
        "once more among the counters: {report}"
    );
    for counter in ["blocks_whole", "blocks_split", "samples_shaded"] {
        assert!(report["counters"][counter].is_u64(), "{counter} of {report}");
    }
    assert!(
        report["counters"]["blocks_split"].as_u64() > Some(0),
        "the triangle has edges: {report}"
    );
    assert_eq!(
        report["counters"]["samples_shaded"], 0,
        "flat colours need no shading: {report}"
    );
    let (median, min) = (report["median_ms"].as_f64(), report["min_ms"].as_f64());
    assert!(min > Some(0.0) && min <= median, "times: {report}");
    let text = run(folder.path(), &["bench", "a.svg", "--size", "64x48", "--frames", "1"]);
    assert!(
        String::from_utf8_lossy(&text.stdout).contains("median"),
        "text for people"
    );
}

#[test]
fn cli_draws_the_same_bytes_with_every_simd_level() {
    let folder = folder_with(&[("a.svg", SCENE)]);
    // One name for all, since the file tells it.
    let picture = "a.png";
    let draw = |level: &str| {
        let output = Command::new(env!("CARGO_BIN_EXE_rasterscope"))
            .current_dir(folder.path())
            .env("RASTERSCOPE_SIMD", level)
            .args([
                "render",
                "a.svg",
                "-o",
                picture,
                "--size",
                "80x60",
                "--sample-rate",
                "4",
            ])
            .output()
            .expect("the program starts");
        let path = folder.path().join(picture);
        let bytes = fs::read(&path).ok();
        let _ = fs::remove_file(path);
        (output, bytes)
    };
    let (_, expected) = draw("auto");
    assert!(expected.is_some(), "a picture");
    for (name, _) in rasterscope::simd::available() {
        let (output, picture) = draw(name);
        assert!(output.status.success(), "{name}: {output:?}");
        assert_eq!(picture, expected, "{name}");
    }
    let (output, picture) = draw("mmx");
    let stderr = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!((output.status.code(), picture), (Some(2), None), "{stderr}");
    assert!(
        stderr.contains("RASTERSCOPE_SIMD") && stderr.contains("baseline"),
        "the cure: {stderr}"
    );
}

#[test]
fn cli_bench_times_several_scenes() {
    let folder = folder_with(&[("a.svg", SCENE), ("b.svg", &SCENE.replace("40", "50"))]);
    let options = ["bench", "a.svg", "b.svg", "--size", "20x10", "--frames", "2"];
    let text = run(folder.path(), &options);
    let text = String::from_utf8(text.stdout).expect("text");
    assert!(
        text.contains("a.svg\n20 x 10") && text.contains("\n\nb.svg\n20 x 10"),
        "both: {text}"
    );
    let output = run(folder.path(), &[&options[..], &["--json"]].concat());
    let reports: serde_json::Value = serde_json::from_slice(&output.stdout).expect("JSON");
    let reports = reports.as_array().expect("a list");
    let names: Vec<_> = reports.iter().map(|report| report["scene"].as_str()).collect();
    assert_eq!(names, [Some("a.svg"), Some("b.svg")], "in their order");
    assert!(
        reports.iter().all(|report| report["width"] == 20),
        "as asked: {reports:?}"
    );
    refused(folder.path(), &["bench", "a.svg", "nowhere.svg"], &["nowhere.svg"]);
    refused(folder.path(), &["bench"], &["SCENE"]);
}

#[test]
fn cli_refuses_values_beyond_their_limits() {
    let folder = folder_with(&[("a.svg", SCENE)]);
    for (option, value, words) in [
        ("--anisotropy", "0", "from 1, which is off, to 64"),
        ("--anisotropy", "65", "to 64"),
        ("--anisotropy", "-4", "to 64"),
        ("--lod-bias", "17", "from -16 to 16"),
        ("--lod-bias", "inf", "from -16 to 16"),
        ("--lod-level", "-1", "from 0, the base, to 16"),
        ("--lod-level", "17", "to 16"),
        ("--lod-per", "texel", "pixel, sample"),
    ] {
        let option = format!("{option}={value}");
        refused(
            folder.path(),
            &["render", "a.svg", "-o", "b.png", &option],
            &[value, words],
        );
    }
    for (command, option, most) in [
        ("bench", "--frames", 100_000),
        ("board", "--frames", 10_000),
        ("bench", "--threads", 256),
        ("spectrum", "--peaks", 1000),
        ("pattern", "--sample-rate", 256),
    ] {
        for value in ["0", "1.5", "-1", &(most + 1).to_string()] {
            let option = format!("{option}={value}");
            let words = format!("the value is a whole number from 1 to {most};");
            refused(folder.path(), &[command, "a.svg", &option], &[value, &words]);
        }
    }
}

#[test]
fn cli_helps() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    for (arguments, word) in [
        (&["--help"][..], "render"),
        (&["render", "--help"], "--sample-rate"),
        (&["--version"], "0."),
    ] {
        let output = run(folder.path(), arguments);
        assert!(
            output.status.success() && output.stderr.is_empty(),
            "{arguments:?}: {output:?}"
        );
        assert!(
            String::from_utf8_lossy(&output.stdout).contains(word),
            "{arguments:?} says {word}"
        );
    }
}

#[test]
fn cli_inspect_explains_a_pixel_in_words_and_numbers() {
    let document = "<svg width=\"4\" height=\"4\">\n<rect id=\"sky\" width=\"4\" height=\"4\" fill=\"#0000FF\"/>\n\
                    <polygon id=\"tip\" points=\"0,0 2,0 0,4\" fill=\"#FF0000\"/>\n</svg>";
    let folder = folder_with(&[("two.svg", document)]);
    let inspect = |more: &[&str]| {
        let options = ["--size", "4x4", "--sample-rate", "4", "--view", "canvas"];
        let output = run(
            folder.path(),
            &[&["inspect", "two.svg", "--pixel", "1,0"], &options[..], more].concat(),
        );
        assert!(output.status.success() && output.stderr.is_empty(), "{output:?}");
        String::from_utf8(output.stdout).expect("text")
    };
    let text = inspect(&[]);
    assert!(
        text.lines().all(|line| line.chars().count() <= 80),
        "80 columns: {text}"
    );
    for expected in [
        "Pixel (1, 0) of 4 x 4",
        "colour      #BF0040",
        "3 of 4 samples show 2 (triangle of polygon \"tip\", line 3), 1 shows 1 (polygon of rect",
        "(3 x 255 + 1 x 0) / 4 = 191.25, rounded to 191",
        "two.svg:3:1",
        "3 | <polygon id=\"tip\"",
        "paints 3 of 4 samples: 1-3",
        "covers 75 % of the pixel's area, 75 % of its samples",
    ] {
        let joined = text.split_whitespace().collect::<Vec<_>>().join(" ");
        let expected = expected.split_whitespace().collect::<Vec<_>>().join(" ");
        assert!(joined.contains(&expected), "{expected:?} is in {text}");
    }
    let light = inspect(&["--resolve", "linear"]);
    assert!(
        light.contains("light 765 / 4 = 191.25, encoded 224.6104"),
        "three quarters of the light: {light}"
    );
    let outside = inspect(&["--sample", "4"]);
    assert!(
        outside.contains("outside") && outside.contains("leaves this sample as it was"),
        "why not: {outside}"
    );
    let report: serde_json::Value = serde_json::from_str(&inspect(&["--json"])).expect("JSON");
    assert_eq!(report["version"], 1, "the shape of the report");
    assert_eq!(report["hex"], "#BF0040", "the pixel");
    assert_eq!(report["samples"][3]["stack"], serde_json::json!([0]), "the last sample");
    let tip = &report["paints"][1];
    assert_eq!(tip["source"]["id"], "tip", "the primitive");
    assert_eq!(tip["shape"]["kind"], "triangle", "its kind");
    assert_eq!(tip["views"][3]["edges"][1]["verdict"], "outside", "why not: {tip}");
}

#[test]
fn cli_inspect_refuses_what_is_not_there() {
    let folder = folder_with(&[("a.svg", SCENE)]);
    let refuse = |options: &[&str], words: &[&str]| {
        refused(folder.path(), &[&["inspect", "a.svg"], options].concat(), words);
    };
    refuse(
        &["--pixel", "1024,0"],
        &["--pixel 1024,0", "1024x1024", "0,0 to 1023,1023"],
    );
    refuse(&["--pixel", "1"], &["a pixel is its column and row from 0"]);
    refuse(&["--pixel", "1,-1"], &["a pixel is its column and row from 0"]);
    let sample = ["--pixel", "1,1", "--sample", "5"];
    refuse(&sample, &["--sample 5", "the pixel has one, number 1"]);
    refuse(&[&sample[..], &["--sample-rate", "4"]].concat(), &["samples 1 to 4"]);
    refuse(
        &[&sample[..], &["--sample-rate", "9", "--coverage", "exact"]].concat(),
        &["--sample 5", "the pixel has no samples; 1 stands for its centre"],
    );
    refuse(&[], &["--pixel"]);
}
