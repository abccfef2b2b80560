//! What the system does not give: memory, threads, room in a file, a sane clock. One line, and no file that is not whole.

#![cfg(target_os = "linux")]

use std::fs;
use std::path::Path;
use std::process::{Command, Output, Stdio};
use std::thread::sleep;
use std::time::{Duration, Instant};

use crate::support::folder::names;
use crate::support::program::{command, done, run_after};

/// One line, this exit status, nothing left.
fn assert_told(output: &Output, status: i32, words: &[&str], folder: &Path) {
    let stderr = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(status), "{stderr}");
    assert_eq!(stderr.trim_end().lines().count(), 1, "one line: {stderr}");
    for word in words {
        assert!(stderr.contains(word), "{word}: {stderr}");
    }
    let left = names(folder).into_iter().filter(|name| name != "in");
    assert_eq!(left.collect::<Vec<_>>(), [""; 0], "nothing left");
}

#[test]
fn limits_of_memory_are_told() {
    let scene = "gallery:basic/test4.svg";
    let commands: &[&[&str]] = &[
        &["render", scene, "-o", "a.png", "--size=16384x16384"],
        &["inspect", scene, "--pixel=1,1", "--size=16384x16384"],
        &["bench", scene, "--size=16384x16384", "--frames=1"],
        &["sheet", scene, "-o", "a.png", "--sample-rate=1,4,9", "--size=4000x4000"],
        #[cfg(feature = "window")]
        &[scene, "--headless", "--size=16384x16384"],
    ];
    for arguments in commands {
        let folder = tempfile::tempdir().unwrap();
        let output = run_after("ulimit -v 900000", folder.path(), arguments);
        assert_told(&output, 1, &["memory", "--size"], folder.path());
    }
}

/// A folder with `in`: a scene of many shapes, one with a large texture, and two large pictures.
fn folder_of_large_inputs() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    let inner = folder.path().join("in");
    fs::create_dir(&inner).unwrap();
    let shape = |i: u32| format!("<rect x='{}' y='{}' width='1' height='1'/>", i % 800, i / 800);
    let shapes: String = (0..60_000).map(shape).collect();
    fs::write(
        inner.join("many.svg"),
        format!("<svg width='800' height='800'>{shapes}</svg>"),
    )
    .unwrap();
    let textured = "<svg width='40' height='30'><image href='a.png' width='40' height='30'/></svg>";
    fs::write(inner.join("textured.svg"), textured).unwrap();
    let lesson = "title = 'x'\n[[step]]\ntitle = 'y'\nscene = 'textured.svg'\ntext = 'z'\n";
    fs::write(inner.join("lesson.toml"), lesson).unwrap();
    for (name, scene) in [
        ("a.png", "gallery:basic/test3.svg"),
        ("b.png", "gallery:basic/test4.svg"),
    ] {
        done(&inner, &["render", scene, "-o", name, "--size=4000x4000"]);
    }
    folder
}

#[test]
fn limits_of_memory_for_what_is_read_are_told() {
    let folder = folder_of_large_inputs();
    let small = "--size=40x30";
    let one = "--threads=1";
    let commands: [&[&str]; 8] = [
        &["render", "in/many.svg", "-o", "a.png", small, one],
        &["render", "in/textured.svg", "-o", "a.png", small, one],
        &["inspect", "in/textured.svg", "--pixel=1,1", "--json", small, one],
        &[
            "sheet",
            "in/textured.svg",
            "-o",
            "a.png",
            "--sample-rate=1,4",
            "--size=90x90",
            one,
        ],
        &["sweep", "in/textured.svg", "--csv", "a.csv", small, one],
        &["diff", "in/a.png", "in/b.png", one],
        &["diff", "in/a.png", "in/b.png", "-o", "a.png", one],
        &["lesson", "in/lesson.toml", "--slides", "out", "--size=480x270"],
    ];
    for arguments in commands {
        // More than the program takes for itself, and less than the input does.
        let output = run_after("ulimit -v 110000", folder.path(), arguments);
        assert_told(&output, 1, &["out of memory"], folder.path());
    }
}

#[test]
fn limits_of_threads_are_told() {
    let scene = "gallery:basic/test4.svg";
    let commands: &[&[&str]] = &[
        &["render", scene, "-o", "a.png"],
        &["inspect", scene, "--pixel=1,1", "--threads=3"],
        #[cfg(feature = "window")]
        &[scene, "--headless"],
    ];
    for arguments in commands {
        let folder = tempfile::tempdir().unwrap();
        // Stacks that are larger than all memory: no thread starts.
        let limit = "ulimit -v 4000000; export RUST_MIN_STACK=100000000000";
        let output = run_after(limit, folder.path(), arguments);
        assert_told(&output, 1, &["cannot start", "thread"], folder.path());
    }
}

#[test]
fn limits_of_a_file_are_told_where_their_signal_is_not_ignored() {
    let folder = tempfile::tempdir().unwrap();
    let arguments = ["render", "gallery:texmap/test4.svg", "-o", "a.png", "--size=400x400"];
    let output = run_after("ulimit -f 64", folder.path(), &arguments);
    // As with a full disk: the machine has no room, and the place is as good as any.
    assert_told(&output, 1, &["a.png", "too large"], folder.path());
}

#[cfg(feature = "window")]
#[test]
fn limits_of_time_zones_do_no_harm() {
    for zone in [
        "/dev/zero",
        ":/dev/zero",
        "fifo",
        "Nowhere/At all",
        "\u{1b}[2J",
        "../../../etc/passwd",
        "<A>99999999",
    ] {
        let folder = tempfile::tempdir().unwrap();
        let limit = format!("mkfifo fifo; ulimit -v 4000000; export TZ='{zone}'");
        let output = run_after(
            &limit,
            folder.path(),
            &["gallery:basic/test4.svg", "--headless", "--size=320x240"],
        );
        assert!(
            output.status.success() && output.stderr.is_empty(),
            "{zone}: {output:?}"
        );
        let saved = names(folder.path())
            .into_iter()
            .filter(|name| name.starts_with("rasterscope-"));
        assert_eq!(saved.count(), 1, "{zone}: {output:?}");
        fs::remove_file(folder.path().join("fifo")).unwrap();
    }
}

/// What an allocation that fails does to the program, wherever it is.
#[test]
fn limits_of_small_allocations_end_the_program_as_others_do() {
    let folder = tempfile::tempdir().unwrap();
    let scene = "gallery:basic/test4.svg";
    let mut bench = command(folder.path(), &["bench", scene, "--frames=100000"]);
    let mut running = bench.stdout(Stdio::null()).spawn().unwrap();
    let status = format!("/proc/{}/status", running.id());
    let listens = || {
        let status = fs::read_to_string(&status).unwrap();
        let mask = status.lines().find_map(|line| line.strip_prefix("SigCgt:")).unwrap();
        u64::from_str_radix(mask.trim(), 16).unwrap() >> (6 - 1) & 1 == 1
    };
    let start = Instant::now();
    while !listens() {
        assert!(start.elapsed() < Duration::from_mins(1), "it never listens");
        sleep(Duration::from_millis(10));
    }
    let sent = Command::new("kill").args(["-ABRT", &running.id().to_string()]).status();
    assert!(sent.unwrap().success(), "a signal");
    assert_eq!(running.wait().unwrap().code(), Some(1), "no core, no signal's status");
    assert_eq!(names(folder.path()), [""; 0], "nothing left");
}
