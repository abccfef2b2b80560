//! What a scene, a record and a lesson may read from the disk: pictures that the user may read, and nothing that is no file.

#![cfg(unix)]

use std::fs;
use std::path::Path;
use std::process::Command;
use std::time::{Duration, Instant};

use rasterscope::figure::save_png;
use rasterscope::raster::Framebuffer;
use rasterscope::scene::{self, DialectChoice};

use crate::support::program::run;
use crate::support::refusal::assert_refused;

/// What no message may repeat.
const SECRET: &str = "root:x:0:0";
/// How long a refusal may take on a busy machine.
const AT_ONCE: Duration = Duration::from_secs(10);

/// A folder with `outside/picture.png`, `inner/deep`, a pipe and a file that is no picture.
fn folder() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    for name in ["outside", "inner/deep"] {
        fs::create_dir_all(folder.path().join(name)).unwrap();
    }
    let mut frame = Framebuffer::new(2, 2);
    frame.pixels_mut().fill(0xFF11_8833);
    save_png(&frame, &folder.path().join("outside/picture.png")).unwrap();
    fs::write(folder.path().join("outside/secret"), SECRET.repeat(100)).unwrap();
    let made = Command::new("mkfifo").arg(folder.path().join("pipe")).status();
    assert!(made.unwrap().success(), "a pipe");
    folder
}

/// The report on a scene in `inner/deep` with an image at `address`.
fn report_on(folder: &Path, address: &str) -> Vec<String> {
    let document = format!(
        "<svg xmlns='http://www.w3.org/2000/svg' width='4' height='4'><image width='4' height='4' href='{address}'/></svg>"
    );
    let path = folder.join("inner/deep/scene.svg");
    fs::write(&path, document).unwrap();
    let started = Instant::now();
    let scene = scene::load(&path, DialectChoice::Auto).unwrap();
    assert!(started.elapsed() < AT_ONCE, "{address}: {:?}", started.elapsed());
    scene.report.lines().collect()
}

#[test]
fn disk_pictures_are_read_wherever_they_lie() {
    let folder = folder();
    let absolute = folder.path().join("outside/picture.png").display().to_string();
    for address in ["../../outside/picture.png", &absolute, &format!("file://{absolute}")] {
        assert_eq!(report_on(folder.path(), address), Vec::<String>::new(), "{address}");
    }
}

#[test]
fn disk_scenes_read_nothing_but_files() {
    let folder = folder();
    let pipe = folder.path().join("pipe").display().to_string();
    for address in [
        &pipe,
        "../../pipe",
        "/dev/zero",
        "/dev/stdin",
        "..",
        "/",
        "http://127.0.0.1:9/a.png",
        "HTTPS://example.com/a.png",
        "//host/share/a.png",
        "file:////host/share/a.png",
        "smb://host/share/a.png",
        "\\\\host\\share\\a.png",
        "%5c%5chost%5cshare",
        "../../outside/secret",
        "/proc/self/environ",
    ] {
        let report = report_on(folder.path(), address);
        assert_eq!(report.len(), 1, "{address}: one line: {report:?}");
        assert!(report[0].ends_with("a checker is drawn"), "{address}: {report:?}");
        let shown = report[0].replace(address, "");
        assert!(!shown.contains("root:"), "what it holds is not shown: {shown}");
        let is_remote = address.contains("host") || address.to_lowercase().starts_with("http");
        assert_eq!(is_remote, report[0].contains("not fetched"), "{address}: {report:?}");
    }
}

#[test]
fn disk_documents_that_are_no_files_are_refused() {
    let folder = folder();
    let scene = "<svg width='4' height='3'><rect width='4' height='3'/></svg>";
    fs::write(folder.path().join("a.svg"), scene).unwrap();
    let drawn = run(folder.path(), &["render", "a.svg", "-o", "a.png", "--size", "8x6"]);
    assert!(drawn.status.success(), "{drawn:?}");
    fs::remove_file(folder.path().join("a.svg")).unwrap();
    fs::rename(folder.path().join("pipe"), folder.path().join("a.svg")).unwrap();
    for (name, place) in [
        ("pipe", "a.svg"),
        ("device", "/dev/zero"),
        ("folder", "outside"),
        ("secret", "outside/secret"),
    ] {
        let lesson = format!("title = 'x'\n[[step]]\ntitle = 'y'\nscene = '{place}'\ntext = 'z'\n");
        fs::write(folder.path().join(format!("{name}.toml")), lesson).unwrap();
    }
    let before = names(folder.path());
    for arguments in [
        &["rerun", "a.png", "--check"][..],
        &["render", "a.svg", "-o", "b.png"],
        &["render", "/dev/zero", "-o", "b.png"],
        &["inspect", "a.svg", "--pixel", "0,0"],
        &["diff", "/dev/zero", "a.png"],
        &["lesson", "pipe.toml", "--slides", "slides"],
        &["lesson", "device.toml", "--slides", "slides"],
        &["lesson", "folder.toml", "--slides", "slides"],
        &["lesson", "secret.toml", "--slides", "slides"],
        &["lesson", "/dev/zero", "--slides", "slides"],
    ] {
        let started = Instant::now();
        let output = run(folder.path(), arguments);
        assert!(started.elapsed() < AT_ONCE, "{arguments:?}: {:?}", started.elapsed());
        assert_refused(&output, arguments, &[]);
        assert!(!String::from_utf8_lossy(&output.stderr).contains(SECRET), "{output:?}");
    }
    assert_eq!(names(folder.path()), before, "nothing is written");
}

/// The names in a folder and below.
fn names(folder: &Path) -> Vec<String> {
    let mut names = Vec::new();
    let mut open = vec![folder.to_owned()];
    while let Some(folder) = open.pop() {
        for item in fs::read_dir(folder).unwrap() {
            let path = item.unwrap().path();
            names.push(path.display().to_string());
            if path.is_dir() {
                open.push(path);
            }
        }
    }
    names.sort();
    names
}
