//! Sheets from outside: what is written, how it is laid out, what is refused.

use std::fs;

use rasterscope::compare::decode_picture;
use rasterscope::figure::Record;

use crate::support::folder::names;
use crate::support::golden::check;
use crate::support::program::{done, run};
use crate::support::refusal::assert_refused;

const STAR: &str = "gallery:basic/test4.svg";

/// A sheet of six small panels with an inset, in a folder of its own.
fn sheet(more: &[&str]) -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    let axes = ["--sample-rate", "1,4,16", "--pattern", "grid,jittered"];
    let look = ["--size", "160x160", "--inset", "u614,777:8@6"];
    done(
        folder.path(),
        &[&["sheet", STAR, "-o", "s.png"], &axes[..], &look[..], more].concat(),
    );
    folder
}

#[test]
fn golden_sheet_light_and_dark() {
    let mut problems = Vec::new();
    for (name, more) in [
        ("figure_sheet_light", &[][..]),
        ("figure_sheet_dark", &["--theme", "dark", "--note", "A note"]),
    ] {
        let folder = sheet(more);
        let bytes = fs::read(folder.path().join("s.png")).unwrap();
        problems.extend(check(name, &decode_picture(&bytes).unwrap(), 1).err());
    }
    assert!(problems.is_empty(), "{problems:?}");
}

#[test]
fn sheet_writes_panels_and_snippets_beside_it() {
    let folder = sheet(&[]);
    assert_eq!(names(folder.path()), ["s", "s.png"], "nothing else is left");
    let panels = [
        "01_sample-rate-1_pattern-grid.png",
        "02_sample-rate-4_pattern-grid.png",
        "03_sample-rate-16_pattern-grid.png",
        "04_sample-rate-1_pattern-jittered.png",
        "05_sample-rate-4_pattern-jittered.png",
        "06_sample-rate-16_pattern-jittered.png",
    ];
    let snippets = ["figures.html", "figures.md", "figures.tex"];
    assert_eq!(
        names(&folder.path().join("s")),
        [&panels[..], &snippets].concat(),
        "one for each combination"
    );
    for panel in panels {
        let said = done(
            folder.path(),
            &["rerun", &format!("s/{panel}"), "--check", "--threads", "2"],
        );
        assert!(said.contains("the same, all 25600 pixels"), "{panel}: {said}");
    }
    for snippet in snippets {
        let text = fs::read_to_string(folder.path().join("s").join(snippet)).unwrap();
        let mentions = |name: &str| text.contains(name);
        assert!(
            panels.iter().all(|panel| mentions(panel)) && mentions("../s.png"),
            "{snippet}: {text}"
        );
        assert!(
            mentions("sample rate 1, 4, 16") && mentions("pattern grid, jittered"),
            "{snippet}: {text}"
        );
    }
    let panel = Record::of_file(&folder.path().join("s").join(panels[4]))
        .unwrap()
        .unwrap();
    assert!(
        panel
            .command_line
            .ends_with("--sample-rate 4 --pattern jittered --inset u614,777:8@6:auto"),
        "{}",
        panel.command_line
    );
}

#[test]
fn sheet_is_drawn_again_and_brings_its_first_panel_back() {
    let folder = sheet(&["--note", "times are of one machine"]);
    for threads in ["1", "3"] {
        let said = done(folder.path(), &["rerun", "s.png", "--check", "--threads", threads]);
        assert!(said.contains("the same"), "{said}");
    }
    let told = Record::of_file(&folder.path().join("s.png")).unwrap().unwrap();
    let line = "rasterscope sheet gallery:basic/test4.svg -o s.png --sample-rate=1,4,16 --pattern=grid,jittered \
                --size=160x160 --view=default --inset u614,777:8@6:auto '--note=times are of one machine'";
    assert_eq!(told.command_line, line, "the whole sheet");
    done(folder.path(), &["render", "s.png", "-o", "one.png"]);
    let said = Record::of_file(&folder.path().join("one.png"))
        .unwrap()
        .unwrap()
        .command_line;
    assert!(
        said.contains("--size 160x160") && said.ends_with("--inset u614,777:8@6:auto"),
        "{said}"
    );
}

/// Of SVG that the course's reading does not draw.
#[test]
fn sheet_of_rules_shows_one_reading_of_the_document() {
    let folder = tempfile::tempdir().unwrap();
    let path = r##"<svg xmlns="http://www.w3.org/2000/svg" width="40" height="30"><path d="M2 3 L37 9 L11 28Z" fill="#123456"/></svg>"##;
    fs::write(folder.path().join("a.svg"), path).unwrap();
    let arguments = [
        "sheet",
        "a.svg",
        "-o",
        "s.png",
        "--rules",
        "standard,course",
        "--size",
        "40x30",
    ];
    done(folder.path(), &arguments);
    for panel in ["01_rules-standard.png", "02_rules-course.png"] {
        let panel = format!("s/{panel}");
        let picture = image::open(folder.path().join(&panel)).unwrap().into_rgb8();
        assert_eq!(picture.get_pixel(15, 12).0, [0x12, 0x34, 0x56], "{panel}");
        let said = done(folder.path(), &["rerun", &panel, "--check"]);
        assert!(said.contains("the same"), "{said}");
    }
}

#[test]
fn sheet_of_one_axis_takes_rows_where_it_is_long() {
    let folder = tempfile::tempdir().unwrap();
    let rates = "1,4,9,16,25,36,49";
    done(
        folder.path(),
        &["sheet", STAR, "-o", "s.png", "--sample-rate", rates, "--size", "60x60"],
    );
    let picture = image::open(folder.path().join("s.png")).unwrap();
    assert!(
        picture.width() < 400 && picture.height() > 150,
        "two rows: {}x{}",
        picture.width(),
        picture.height()
    );
    let told = done(folder.path(), &["rerun", "s.png", "--check"]);
    assert!(told.contains("the same"), "{told}");
}

#[test]
fn sheet_of_one_axis_is_stacked_where_that_is_asked_for() {
    let folder = tempfile::tempdir().unwrap();
    let axis = ["--sample-rate", "1,4,16", "--size", "120x90"];
    let view = ["--view", "600.123456789,600.987654321,0.123456789123"];
    done(
        folder.path(),
        &[&["sheet", STAR, "-o", "s.png", "--stacked"], &axis[..], &view].concat(),
    );
    let sheet = image::open(folder.path().join("s.png")).unwrap();
    assert!(
        sheet.height() > 3 * 90 && sheet.width() < 2 * 120,
        "{}x{}",
        sheet.width(),
        sheet.height()
    );
    let told = Record::of_file(&folder.path().join("s.png")).unwrap().unwrap();
    assert!(told.command_line.contains("--stacked"), "{}", told.command_line);
    assert!(told.command_line.contains("600.123456789,"), "to the last digit");
    let snippet = fs::read_to_string(folder.path().join("s/figures.md")).unwrap();
    assert!(
        snippet.contains("view 600.12,600.99,0.123457"),
        "no more digits than can be seen: {snippet}"
    );
    done(folder.path(), &["rerun", "--check", "s.png"]);
    let two = [
        "sheet",
        STAR,
        "-o",
        "t.png",
        "--stacked",
        "--pattern",
        "grid,r2",
        "--rules",
        "standard,course",
    ];
    assert_refused(&run(folder.path(), &two), &two, &["--stacked", "two lists"]);
}

#[test]
fn sheet_of_visualisations_has_their_legends_below() {
    let folder = tempfile::tempdir().unwrap();
    let size = ["--size", "200x200"];
    let axis = ["--visualise", "coverage,overdraw"];
    done(
        folder.path(),
        &[&["sheet", STAR, "-o", "s.png"], &size[..], &axis[..]].concat(),
    );
    done(
        folder.path(),
        &[
            &["sheet", STAR, "-o", "plain.png"],
            &size[..],
            &["--sample-rate", "1,4"],
        ]
        .concat(),
    );
    let height = |name: &str| image::open(folder.path().join(name)).unwrap().height();
    assert!(height("s.png") > height("plain.png") + 30, "legends take room");
    let told = done(folder.path(), &["rerun", "s.png", "--check"]);
    assert!(told.contains("the same"), "{told}");
    let panel = Record::of_file(&folder.path().join("s/01_visualise-coverage.png"))
        .unwrap()
        .unwrap();
    assert!(
        panel.command_line.ends_with("--visualise coverage --no-legend"),
        "{}",
        panel.command_line
    );
}

#[test]
fn sheet_at_fault_writes_nothing() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("a.svg"), "<svg width='9' height='9'/>").unwrap();
    fs::write(folder.path().join("taken"), "a file").unwrap();
    let before = names(folder.path());
    let rates = (1..=16).map(|n| (n * n).to_string()).collect::<Vec<_>>().join(",");
    let refused = |more: &[&str], words: &[&str]| {
        let arguments = [&["sheet", "a.svg"], more].concat();
        assert_refused(&run(folder.path(), &arguments), &arguments, words);
        assert_eq!(names(folder.path()), before, "{more:?} leaves nothing");
    };
    refused(&["-o", "s.png", "--sample-rate", "1,5"], &["--sample-rate 5"]);
    // Before the system is asked for memory.
    refused(
        &["-o", "s.png", "--sample-rate", "1,4", "--size", "16384x16384"],
        &["the sheet would have 32768x16384 pixels", "a smaller --size"],
    );
    refused(
        &["-o", "s.png", "--pattern", "grid,poisson"],
        &["poisson", "grid|rotated", "TOML file"],
    );
    refused(&["-o", "s.png", "--sharpness", "1,2"], &["--sharpness"]);
    refused(
        &[
            "-o",
            "s.png",
            "--sample-rate",
            rates.as_str(),
            "--pattern",
            "grid,rotated,jittered,jittered-same,r2",
        ],
        &["64", "80"],
    );
    let list = |values: std::ops::RangeInclusive<i32>| values.map(|n| n.to_string()).collect::<Vec<_>>().join(",");
    let (seeds, biases) = (list(1..=100), format!("--lod-bias={}", list(-16..=16)));
    refused(
        &[
            "-o",
            "s.png",
            "--seed",
            &seeds,
            &biases,
            "--sample-rate=1,4,9,16,25,36,49,64",
            "--anisotropy=1,2,4,8,16",
            "--pattern=grid,r2,sobol",
            "--pixel-sampling=nearest,bilinear,mitchell",
        ],
        &["64", "over a million"],
    );
    refused(
        &["-o", "s.png", "--sample-rate", "1,4", "--size", "9000x9000"],
        &["smaller --size"],
    );
    refused(
        &["-o", "s.png", "--sample-rate", "1,4", "--inset", "u99,99"],
        &["outside"],
    );
    refused(&["-o", "s.jpg", "--sample-rate", "1,4"], &[".png"]);
    refused(
        &["-o", "no/such/s.png", "--sample-rate", "1,4", "--size", "9x9"],
        &["no/such", "-o"],
    );
    refused(
        &["-o", "taken.png", "--sample-rate", "1,4", "--size", "9x9"],
        &["taken", "-o"],
    );
}
