//! Write-ups from outside: from an empty folder to every figure, each of which can be drawn again.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use rasterscope::figure::{Record, encode_png};
use rasterscope::raster::Framebuffer;

use crate::support::refusal::assert_refused;

fn run(folder: &Path, arguments: &[&str]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_rasterscope"));
    let command = command.current_dir(folder).args(arguments);
    command.env_remove("DISPLAY").env_remove("WAYLAND_DISPLAY");
    command.output().unwrap()
}

/// Every PNG below a folder, but for pictures that scenes show.
fn pictures(folder: &Path) -> Vec<PathBuf> {
    let mut found = Vec::new();
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() && !path.ends_with("scenes") {
            found.extend(pictures(&path));
        } else if path.extension().is_some_and(|ending| ending == "png") {
            found.push(path);
        }
    }
    found.sort();
    found
}

#[test]
fn writeup_from_an_empty_folder_can_be_drawn_again() {
    let folder = tempfile::tempdir().unwrap();
    let output = run(folder.path(), &["writeup", "course", "-o", "out"]);
    assert!(output.status.success() && output.stderr.is_empty(), "{output:?}");
    let out = folder.path().join("out");
    let found = pictures(&out);
    assert!(found.len() >= 12 + 20, "figures and panels: {found:?}");
    // A folder that was moved keeps what it needs.
    let moved = folder.path().join("moved");
    fs::rename(&out, &moved).unwrap();
    let page = fs::read_to_string(moved.join("index.html")).unwrap();
    for path in pictures(&moved) {
        let name = path.strip_prefix(&moved).unwrap().to_str().unwrap();
        if !name.contains(std::path::MAIN_SEPARATOR) {
            assert!(page.contains(&format!("src=\"{name}\"")), "{name} is on the page");
        }
        let output = run(&moved, &["rerun", name, "--check", "--threads", "1"]);
        assert!(
            output.status.success() && output.stderr.is_empty(),
            "{name}: {output:?}"
        );
    }
    let size = image::image_dimensions(moved.join("competition.png")).unwrap();
    assert_eq!(size, (800, 800), "as the competition asks for");
    assert!(page.contains("Time to draw, median of 7"), "times stand in the text");
}

#[test]
fn writeup_takes_own_files_and_pins() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    let mut photo = Framebuffer::new(300, 200);
    for (i, pixel) in (0_u32..).zip(photo.pixels_mut()) {
        *pixel = 0xff00_0000 | i.wrapping_mul(2_654_435_761) >> 8;
    }
    fs::write(at("photo.png"), encode_png(&photo, None).unwrap()).unwrap();
    let scene = "<svg width='100' height='100'><polygon points='5,5 95,10 20,80' fill='#ff0000'/></svg>";
    fs::create_dir_all(at("svg/basic")).unwrap();
    for name in ["robot.svg", "svg/competition.svg", "svg/basic/test4.svg"] {
        fs::write(at(name), scene).unwrap();
    }
    fs::create_dir(at("out")).unwrap();
    fs::write(at("out/pins.toml"), "test4 = \"u20,30:8@4:top-left\"\n").unwrap();
    let own = ["--scenes", "svg", "--own", "photo.png", "--robot", "robot.svg"];
    let output = run(folder.path(), &[&["writeup", "-o", "out"], &own[..]].concat());
    assert!(output.status.success(), "{output:?}");
    let told = String::from_utf8(output.stderr).unwrap();
    assert!(
        told.contains("svg: no basic/test7.svg in this folder; the built-in scene"),
        "{told}"
    );
    let line = |name: &str| Record::of_file(&at(name)).unwrap().unwrap().command_line;
    assert!(
        line("out/T1_triangles.png").contains("render svg/basic/test4.svg"),
        "the course's"
    );
    assert!(
        line("out/T2_supersampling.png").contains("--inset u20,30:8@4:top-left"),
        "its pin"
    );
    assert!(line("out/T3_robot.png").contains("render robot.svg"), "the own robot");
    assert!(
        line("out/competition.png").contains("render svg/competition.svg"),
        "the own entry"
    );
    let own = Record::of_file(&at("out/T6_levels.png")).unwrap().unwrap();
    assert_eq!(own.textures[0].address, "own.png", "the own picture: {own:?}");
    let pins = fs::read_to_string(at("out/pins.toml")).unwrap();
    assert!(
        pins.contains("test4 = \"u20,30:8@4:top-left\"\n") && pins.contains("own = \"u"),
        "{pins}"
    );
}

#[test]
fn writeup_at_fault_is_told_in_one_line() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("file"), "x").unwrap();
    fs::write(folder.path().join("pins.toml"), "test9 = \"3,4\"").unwrap();
    let refused = |more: &[&str], words: &[&str]| {
        let arguments = [&["writeup", "course"], more].concat();
        assert_refused(&run(folder.path(), &arguments), &arguments, words);
        assert!(!folder.path().join("out").exists(), "{more:?} makes nothing");
    };
    refused(&["-o", "file"], &["file", "-o"]);
    refused(&["-o", "file/out"], &["file/out", "-o"]);
    refused(&["-o", "out", "--own", "file"], &["file", "--own"]);
    refused(&["-o", "out", "--own", "missing.png"], &["missing.png"]);
    refused(
        &["-o", "out", "--pins", "pins.toml"],
        &["pins.toml", "no figure has the pin test9"],
    );
}
