//! Ctrl+C and bars: a command stops between files, and tells a terminal, and only that, how far it is.

#![cfg(target_os = "linux")]

use std::fs;
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

use crate::support::folder::names;
use crate::support::program::{command, done, interrupt};

/// A scene that takes minutes to draw at 256 samples, and to explain.
fn slow_scene(folder: &Path) {
    let polygon = |i: u32| {
        let (x, y) = (i * 37 % 800, i * 91 % 700);
        let points = format!("{x},{y} {},{} {},{}", x + 3100, y + 70, x + 90, y + 3200);
        format!("<polygon points='{points}' fill='#{i:06x}' fill-opacity='0.5'/>")
    };
    let polygons: Vec<String> = (0..40_000).map(polygon).collect();
    let text = format!("<svg width='4000' height='4000'>{}</svg>", polygons.concat());
    fs::write(folder.join("slow.svg"), text).unwrap();
}

/// The program at work, and what it prints.
fn started(folder: &Path, arguments: &[&str]) -> Child {
    let mut command = command(folder, arguments);
    command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap()
}

#[test]
fn interrupts_stop_every_command_between_files() {
    let slow = "--sample-rate=256";
    let commands: &[&[&str]] = &[
        &["render", "slow.svg", "-o", "out.png", slow],
        &["sheet", "slow.svg", "-o", "out.png", slow],
        &["inspect", "slow.svg", "--pixel=500,500", slow],
        &["diff", "slow.svg", "other.png", slow],
        &["bench", "slow.svg", slow],
        &["sweep", "slow.svg", "--csv", "out.csv", slow, "--frames=10000"],
        &["board", "slow.svg", "--with=A", "-o", "out.png", slow, "--frames=10000"],
        &["rerun", "shot.png", "-o", "out.png", "--scene", "slow.svg"],
        &["writeup", "-o", "out", "--robot", "slow.svg", "--scenes", "."],
        &["lesson", "slow.toml", "--slides", "out"],
    ];
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    fs::write(at("quick.svg"), "<svg width='9' height='9'/>").unwrap();
    for name in ["other.png", "shot.png"] {
        done(folder.path(), &["render", "quick.svg", "-o", name, slow]);
    }
    slow_scene(folder.path());
    fs::create_dir_all(at("basic")).unwrap();
    fs::copy(at("slow.svg"), at("basic/test4.svg")).unwrap();
    fs::write(
        at("slow.toml"),
        "title = 'slow'\n[[step]]\nscene = 'slow.svg'\nsample-rate = 256\ntitle = 'x'\ntext = 'y'\n",
    )
    .unwrap();
    for arguments in commands {
        let running = started(folder.path(), arguments);
        std::thread::sleep(Duration::from_millis(1500));
        let start = Instant::now();
        interrupt(&running);
        let output = running.wait_with_output().unwrap();
        let stderr = String::from_utf8_lossy(&output.stderr);
        // A single pixel may be explained by then.
        if arguments.starts_with(&["inspect"]) && !output.stdout.is_empty() {
            continue;
        }
        assert_eq!(output.status.code(), Some(130), "{arguments:?}: {stderr}");
        assert!(start.elapsed() < Duration::from_secs(10), "{arguments:?}: at once");
        let told = stderr.lines().filter(|line| line.contains("stopped by Ctrl+C")).count();
        assert!(told == 1 && output.stdout.is_empty(), "{arguments:?}: {stderr}");
        let written = ["out.png", "out.csv"].iter().any(|name| at(name).exists());
        assert!(!written, "{arguments:?}: no picture, no table");
        assert!(
            names(folder.path()).iter().all(|name| !name.starts_with('.')),
            "{arguments:?}: no part of one"
        );
    }
}

#[test]
fn bars_are_for_terminals_and_long_work_only() {
    let folder = tempfile::tempdir().unwrap();
    slow_scene(folder.path());
    fs::write(folder.path().join("quick.svg"), "<svg width='9' height='9'/>").unwrap();
    let program = env!("CARGO_BIN_EXE_rasterscope");
    let on_terminal = |line: &str, seconds: u32| {
        // `script` gives its command a terminal, and writes down what comes.
        let line = format!("timeout --foreground -s INT {seconds} {program} {line}");
        let mut command = Command::new("script");
        command
            .args(["-qec", &line, "/dev/null"])
            .current_dir(folder.path())
            .stdin(Stdio::null());
        let output = command.output().unwrap();
        String::from_utf8_lossy(&output.stdout).into_owned()
    };
    // A busy machine may take a while until it draws at all.
    let mut long = String::new();
    for seconds in [4, 8, 16] {
        long = on_terminal("render slow.svg -o out.png --sample-rate 256", seconds);
        if long.contains("Ctrl+C stops") {
            break;
        }
    }
    assert!(long.contains("Ctrl+C stops"), "a bar: {long:?}");
    assert!(long.contains("stopped by Ctrl+C"), "and an end: {long:?}");
    let short = on_terminal("render quick.svg -o out.png", 4);
    assert_eq!(short, "", "nothing to wait for");
    let arguments = ["render", "slow.svg", "-o", "out2.png", "--sample-rate=256"];
    let mut running = started(folder.path(), &arguments);
    std::thread::sleep(Duration::from_millis(3500));
    running.kill().unwrap();
    let output = running.wait_with_output().unwrap();
    assert_eq!(output.stderr, b"", "no bar without a terminal");
}
