//! A disk that is full: one clear line, the status of what the machine lacks, and no half file. A limit of a file's size makes a write fail as a full disk does,
//! after some of it went through.

#![cfg(unix)]

use std::fs;
use std::path::Path;
use std::process::Output;

use crate::support::folder::names;
use crate::support::program::run_after;
use crate::support::refusal::assert_told;

/// Runs the program where no file may grow beyond `blocks` of 512 bytes.
fn run_with_room(blocks: u32, folder: &Path, arguments: &[&str]) -> Output {
    // The signal that comes with the error would end the program.
    run_after(&format!("trap '' XFSZ; ulimit -f {blocks}"), folder, arguments)
}

#[test]
fn full_disk_leaves_no_half_file() {
    let scene = "gallery:texmap/test4.svg";
    let size = "--size=400x400";
    let commands: [&[&str]; 4] = [
        &["render", scene, "-o", "out.png", size],
        &["sheet", scene, "-o", "out.png", "--sample-rate=1,4", size],
        &["lesson", "lesson:anisotropy", "--slides", "out", "--size=480x300"],
        &["writeup", "course", "-o", "out"],
    ];
    for arguments in commands {
        let folder = tempfile::tempdir().unwrap();
        let output = run_with_room(64, folder.path(), arguments);
        assert_told(&output, 1, arguments, &["out", "cannot"]);
        let mut folders = vec![folder.path().to_owned()];
        while let Some(folder) = folders.pop() {
            for name in names(&folder) {
                let path = folder.join(&name);
                if path.is_dir() {
                    folders.push(path);
                    continue;
                }
                assert!(!name.starts_with('.'), "{arguments:?} left {name}");
                // What was finished before, such as the scenes of a write-up, is whole.
                let is_whole = name.ends_with("svg") || image::open(&path).is_ok();
                assert!(is_whole, "{arguments:?} left half of {name}");
            }
        }
    }
}

#[test]
fn full_disk_costs_no_measurement() {
    let folder = tempfile::tempdir().unwrap();
    let lists = ["--sample-rate=1,4", "--size=40x40", "--frames=1"];
    let arguments = [&["sweep", "gallery:basic/test4.svg", "--csv", "t.csv"], &lists[..]].concat();
    // Room for the table and not for the chart.
    let output = run_with_room(8, folder.path(), &arguments);
    assert_eq!(output.status.code(), Some(1), "{output:?}");
    let stderr = String::from_utf8_lossy(&output.stderr);
    assert!(
        stderr.contains("t.png: cannot write") && stderr.contains("--plot"),
        "{stderr}"
    );
    let told = String::from_utf8(output.stdout).unwrap();
    assert_eq!(told.lines().count(), 3, "the table is printed: {told}");
    assert_eq!(names(folder.path()), ["t.csv"], "and written");
    let table = fs::read_to_string(folder.path().join("t.csv")).unwrap();
    assert_eq!(table.lines().count(), 3, "whole: {table}");
}

#[test]
fn full_disk_keeps_what_was_there() {
    let folder = tempfile::tempdir().unwrap();
    let arguments = ["render", "gallery:texmap/test4.svg", "-o", "out.png", "--size=400x400"];
    fs::write(folder.path().join("out.png"), "before").unwrap();
    let output = run_with_room(64, folder.path(), &arguments);
    assert_told(&output, 1, &arguments, &["out.png", "cannot"]);
    assert_eq!(names(folder.path()), ["out.png"], "nothing else");
    assert_eq!(fs::read(folder.path().join("out.png")).unwrap(), b"before", "unchanged");
    let room = run_with_room(20_000, folder.path(), &arguments);
    assert!(room.status.success(), "with room for it: {room:?}");
}
