//! What commands write, from outside: never over what they read, never over what others made.

use std::fs;
use std::path::Path;
use std::time::{Duration, Instant};

use rasterscope::figure::{encode_png, save_png};
use rasterscope::raster::Framebuffer;

use crate::support::folder::names;
use crate::support::program::{done, run};
use crate::support::refusal::assert_refused;

const SCENE: &str = r#"<svg width="40" height="30"><texture texid="t" filename="tex%74ure.png"/>
<textri texid="t" uvs="0 0 1 0 1 1" points="2,3 37,9 11,28"/></svg>"#;

const SMALL: &str = "--size=40x30";

fn picture(color: u32) -> Framebuffer {
    let mut frame = Framebuffer::new(4, 4);
    frame.pixels_mut().fill(color);
    frame
}

/// A scene with its texture, and a picture of no program that is known.
fn folder() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("s.svg"), SCENE).unwrap();
    save_png(&picture(0xff10_2030), &folder.path().join("texture.png")).unwrap();
    save_png(&picture(0xff40_2030), &folder.path().join("other.png")).unwrap();
    folder
}

/// Runs the program, which must refuse and leave every file as it was.
fn refused(folder: &Path, arguments: &[&str], words: &[&str]) {
    refused_in(folder, ".", arguments, words);
}

/// As [`refused`], where the files lie in a folder inside.
fn refused_in(folder: &Path, inner: &str, arguments: &[&str], words: &[&str]) {
    let inner = folder.join(inner);
    let all = || -> Vec<_> {
        let names = names(&inner).into_iter();
        names.map(|name| (fs::read(inner.join(&name)).ok(), name)).collect()
    };
    let before = all();
    assert_refused(&run(folder, arguments), arguments, words);
    assert_eq!(all(), before, "{arguments:?}: nothing else");
}

#[test]
fn outputs_never_replace_an_input() {
    let folder = folder();
    let folder = folder.path();
    refused(folder, &["sweep", "s.svg", "--csv", "s.svg", SMALL], &["s.svg", "read"]);
    refused(
        folder,
        &[
            "sweep",
            "s.svg",
            "--csv",
            "t.csv",
            "--plot",
            "texture.png",
            SMALL,
            "--frames=1",
        ],
        &["texture.png", "read"],
    );
    refused(
        folder,
        &["render", "s.svg", "-o", "texture.png", SMALL],
        &["texture.png", "read"],
    );
    refused(
        folder,
        &["render", "s.svg", "-o", "./texture.png", SMALL, "--force"],
        &["texture.png", "read"],
    );
    refused(
        folder,
        &["sheet", "s.svg", "-o", "texture.png", SMALL],
        &["texture.png", "read"],
    );
    refused(
        folder,
        &["diff", "texture.png", "other.png", "-o", "texture.png"],
        &["texture.png", "read"],
    );
    refused(
        folder,
        &["diff", "texture.png", "other.png", "-o", "other.png"],
        &["other.png", "read"],
    );
    done(folder, &["render", "s.svg", "-o", "own.png", SMALL]);
    refused(
        folder,
        &["render", "own.png", "-o", "own.png", "--sample-rate=4"],
        &["own.png", "read"],
    );
    refused(folder, &["rerun", "own.png", "-o", "own.png"], &["own.png", "read"]);
    if cfg!(feature = "window") {
        let shot = ["s.svg", "--headless", "--do", "wait; shot texture.png"];
        refused(folder, &shot, &["texture.png", "read"]);
    }
    done(folder, &["render", "s.svg", "-o", "own.png", SMALL]);
}

#[test]
#[cfg(feature = "window")]
fn notes_on_a_scene_read_alike_everywhere() {
    let folder = tempfile::tempdir().unwrap();
    let scene =
        r#"<svg width="40" height="30"><rect width="9" height="9"/><foreignObject width="9" height="9"/></svg>"#;
    fs::write(folder.path().join("s.svg"), scene).unwrap();
    let told = |arguments: &[&str]| String::from_utf8(run(folder.path(), arguments).stderr).unwrap();
    let drawn = told(&["render", "s.svg", "-o", "s.png", SMALL]);
    assert!(drawn.starts_with("rasterscope: s.svg:1:"), "{drawn}");
    assert_eq!(told(&["view", "s.svg", "--headless", "--do", "wait; quit"]), drawn);
}

#[test]
fn outputs_never_replace_what_a_scene_names_in_vain() {
    let folder = folder();
    let folder = folder.path();
    let at = |name: &str| folder.join(name);
    let webp = b"RIFF\x1a\0\0\0WEBPVP8L\x0d\0\0\0\x2f\0\0\0\x10\x07\x10\x11\x11\x88\x88\xfe\x07\0";
    for (name, body) in [
        // Of a kind that is not read.
        ("kind.svg", r#"<texture texid="t" filename="w.png"/>"#),
        ("unused.svg", r#"<texture texid="u" filename="w.png"/>"#),
        ("misspelt.svg", r#"<texture texid="T" filename="./w%2Epng"/>"#),
        ("image.svg", r#"<image width="9" height="9" href="w.png"/>"#),
        (
            "hidden.svg",
            r#"<g display="none"><image width="9" height="9" href="w.png"/></g>"#,
        ),
    ] {
        let triangle = r#"<textri texid="t" uvs="0 0 1 0 1 1" points="2,3 37,9 11,28"/>"#;
        let scene = format!(r#"<svg width="40" height="30">{body}{triangle}</svg>"#);
        fs::write(at(name), scene).unwrap();
        fs::write(at("w.png"), webp).unwrap();
        let arguments = ["render", name, "-o", "w.png", SMALL, "--force"];
        let told = run(folder, &arguments);
        let stderr = String::from_utf8_lossy(&told.stderr).into_owned();
        assert_eq!(told.status.code(), Some(2), "{name}: {stderr}");
        assert!(stderr.contains("w.png: cannot write here"), "{name}: {stderr}");
        assert_eq!(fs::read(at("w.png")).unwrap(), webp, "{name}: what was there");
    }
    fs::create_dir(at("coll")).unwrap();
    fs::write(at("coll/a.svg"), SCENE.replace("tex%74ure", "a")).unwrap();
    fs::write(at("coll/a.png"), webp).unwrap();
    let told = run(folder, &["render", "coll", "-o", "coll", SMALL, "--force"]);
    assert_eq!(told.status.code(), Some(2), "{told:?}");
    assert_eq!(fs::read(at("coll/a.png")).unwrap(), webp, "of a whole folder as well");
}

#[test]
fn outputs_are_files_and_never_standard_output() {
    let folder = folder();
    let line = "--line=1,5,30,5";
    for arguments in [
        &["sweep", "s.svg", "--csv", "-", SMALL][..],
        &["sweep", "s.svg", "--csv", "t.csv", "--markdown", "-", SMALL],
        &["profile", "s.svg", "--csv", "-", line, SMALL],
        &["spectrum", "s.svg", "--csv=-", SMALL],
    ] {
        refused(
            folder.path(),
            arguments,
            &["-: cannot write here", "standard output", "./-"],
        );
    }
    // Whoever wants a file of that name says so.
    let words = ["profile", "s.svg", "--csv", "./-", line, SMALL];
    done(folder.path(), &words);
    assert!(folder.path().join("-").is_file(), "as it was asked for");
}

#[test]
fn outputs_replace_their_own_making_only() {
    let folder = folder();
    let folder = folder.path();
    let at = |name: &str| folder.join(name);
    // A name that the user gave: any picture.
    done(folder, &["render", "s.svg", "-o", "other.png", SMALL]);
    // Names that the program chose.
    let sheet = [
        "sheet",
        "s.svg",
        "-o",
        "sheet.png",
        "--sample-rate=1,4",
        "--size=120x90",
    ];
    done(folder, &sheet);
    done(folder, &sheet);
    for name in ["figures.md", "figures.html", "figures.tex"] {
        let own = fs::read(at("sheet").join(name)).unwrap();
        fs::write(at("sheet").join(name), "my notes").unwrap();
        refused(folder, &sheet, &[name, "--force"]);
        assert_eq!(fs::read(at("sheet").join(name)).unwrap(), b"my notes", "{name}");
        fs::write(at("sheet").join(name), own).unwrap();
    }
    let slides = [
        "lesson",
        "lesson:anisotropy",
        "--slides",
        "slides",
        "--size=480x300",
        "--step=1",
    ];
    done(folder, &slides);
    done(folder, &slides);
    let foreign = encode_png(&picture(0xff00_0000), None).unwrap();
    fs::write(at("slides/01.png"), &foreign).unwrap();
    refused(folder, &slides, &["01.png", "--force"]);
    assert_eq!(fs::read(at("slides/01.png")).unwrap(), foreign, "kept");
    done(folder, &[&slides[..], &["--force"]].concat());
    assert_ne!(fs::read(at("slides/01.png")).unwrap(), foreign, "given up");
}

#[test]
fn outputs_of_folders_and_tables_replace_their_own_making_only() {
    let folder = folder();
    let folder = folder.path();
    let at = |name: &str| folder.join(name);
    let foreign = encode_png(&picture(0xff00_0000), None).unwrap();
    fs::create_dir(at("in")).unwrap();
    fs::rename(at("s.svg"), at("in/a.svg")).unwrap();
    fs::write(at("in/a.png"), &foreign).unwrap();
    let output = run(folder, &["render", "in", "-o", "in", SMALL]);
    assert_eq!(output.status.code(), Some(2), "{output:?}");
    let told = String::from_utf8_lossy(&output.stderr);
    assert!(
        told.contains("1 of 1 pictures were not written"),
        "it could be drawn: {told}"
    );
    assert_eq!(fs::read(at("in/a.png")).unwrap(), foreign, "kept");
    fs::write(at("in/b.svg"), SCENE).unwrap();
    refused(
        folder,
        &["render", "in", "-o", "other.png", SMALL],
        &["other.png", "a file", "folder with -o"],
    );
    refused(
        folder,
        &["render", "in", "-o", "new.PNG", SMALL],
        &["new.PNG", "go into a folder", "another with -o"],
    );
    fs::write(at("points.csv"), "name,points\nme,9\n").unwrap();
    let sweep = |table| ["sweep", "gallery:basic/test4.svg", "--csv", table, SMALL, "--frames=1"];
    refused(folder, &sweep("points.csv"), &["points.csv", "--force"]);
    done(folder, &sweep("own.csv"));
    done(folder, &sweep("own.csv"));
    // A table of another command is none of its own making.
    let profile = [
        "profile",
        "gallery:basic/test4.svg",
        "--line=2,5,30,20",
        "--csv",
        "own.csv",
        SMALL,
    ];
    refused(folder, &profile, &["own.csv", "table of a sweep", "--force"]);
    let spectrum = ["spectrum", "gallery:basic/test4.svg", "--csv", "own.csv", SMALL];
    refused(folder, &spectrum, &["own.csv", "table of a sweep", "--force"]);
    done(folder, &[&profile[..], &["--force"]].concat());
    done(folder, &profile);
    refused(folder, &sweep("own.csv"), &["own.csv", "table of a profile", "--force"]);
    // The chart beside the table has a name that nobody said.
    done(folder, &["render", "gallery:basic/test4.svg", "-o", "drawn.png", SMALL]);
    let drawn = fs::read(at("drawn.png")).unwrap();
    refused(folder, &sweep("drawn.csv"), &["drawn.png", "--plot", "--force"]);
    assert!(fs::read(at("drawn.png")).unwrap() == drawn, "kept");
}

/// A lesson of which `slides/01.png` is the texture of the second step's scene.
fn lesson(folder: &Path) {
    fs::create_dir(folder.join("slides")).unwrap();
    fs::write(folder.join("s.svg"), SCENE.replace("tex%74ure.png", "slides/01.png")).unwrap();
    // A picture of ours, as slides are.
    done(
        folder,
        &["render", "gallery:basic/test3.svg", "-o", "slides/01.png", SMALL],
    );
    let steps = "title = 'x'\n[[step]]\ntitle = 'y'\nscene = 'gallery:basic/test4.svg'\ntext = 'z'\n\
                 [[step]]\ntitle = 'y'\nscene = 's.svg'\ntext = 'z'\n";
    fs::write(folder.join("lesson.toml"), steps).unwrap();
}

#[test]
fn outputs_of_a_lesson_never_replace_what_its_steps_show() {
    let folder = folder();
    let folder = folder.path();
    lesson(folder);
    let slides = ["lesson", "lesson.toml", "--slides", "slides", "--size=480x270"];
    refused_in(folder, "slides", &slides, &["01.png", "read"]);
    refused_in(
        folder,
        "slides",
        &[&slides[..], &["--force"]].concat(),
        &["01.png", "read"],
    );
    // A step whose slide is another file, and another folder: nothing is in their way.
    done(folder, &[&slides[..], &["--step=2"]].concat());
    done(
        folder,
        &["lesson", "lesson.toml", "--slides", "other", "--size=480x270"],
    );
    refused_in(
        folder,
        "slides",
        &["rerun", "other/02.png", "-o", "slides/01.png"],
        &["01.png", "read"],
    );
}

#[test]
fn outputs_drawn_again_never_replace_an_input() {
    let folder = folder();
    let folder = folder.path();
    let axes = "--sample-rate=1,4";
    done(folder, &["sheet", "s.svg", "-o", "sheet.png", axes, "--size=120x90"]);
    done(folder, &["render", "s.svg", "-o", "own.png", SMALL]);
    let compared = ["diff", "s.svg", "own.png", "--sample-rate=4", "-o"];
    let difference = run(folder, &[&compared[..], &["difference.png"]].concat());
    assert_eq!(difference.status.code(), Some(1), "other samples: {difference:?}");
    refused(
        folder,
        &[&compared[..], &["texture.png"]].concat(),
        &["texture.png", "read"],
    );
    for shot in ["sheet.png", "difference.png"] {
        refused(folder, &["rerun", shot, "-o", "texture.png"], &["texture.png", "read"]);
    }
}

#[test]
fn outputs_of_a_sheet_are_looked_at_before_it_is_drawn() {
    let folder = folder();
    let folder = folder.path();
    fs::create_dir(folder.join("sheet")).unwrap();
    // Minutes of work, and none of it is done.
    let slow: String = (0..20_000)
        .map(|_| "<rect width='9000' height='9000' fill='red' fill-opacity='0.1'/>")
        .collect();
    fs::write(
        folder.join("slow.svg"),
        format!("<svg width='9000' height='9000'>{slow}</svg>"),
    )
    .unwrap();
    let sheet = [
        "sheet",
        "slow.svg",
        "-o",
        "sheet.png",
        "--sample-rate=64,256",
        "--size=900x900",
    ];
    for name in ["figures.md", "figures.tex", "figures.html", "01_sample-rate-64.png"] {
        let path = folder.join("sheet").join(name);
        fs::write(&path, "my notes").unwrap();
        let start = Instant::now();
        refused_in(folder, "sheet", &sheet, &[name, "--force"]);
        assert!(
            start.elapsed() < Duration::from_secs(5),
            "{name}: {:?}",
            start.elapsed()
        );
        fs::remove_file(path).unwrap();
    }
}

#[test]
fn outputs_of_a_writeup_keep_pages_and_pins_of_others() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    fs::create_dir(at("out")).unwrap();
    fs::write(at("out/index.html"), "<p>My page</p>").unwrap();
    let writeup = ["writeup", "course", "-o", "out"];
    let output = run(folder.path(), &writeup);
    assert_refused(&output, &writeup, &["index.html", "--force"]);
    assert_eq!(fs::read(at("out/index.html")).unwrap(), b"<p>My page</p>", "kept");
    fs::remove_file(at("out/index.html")).unwrap();
    let pins = "# the tip of the needle\ntest4 = \"u614,777:16@8:auto\"\n";
    fs::write(at("out/pins.toml"), pins).unwrap();
    done(folder.path(), &writeup);
    let after = fs::read_to_string(at("out/pins.toml")).unwrap();
    assert!(
        after.starts_with(pins) && after.len() > pins.len(),
        "comments stay: {after}"
    );
}

#[cfg(unix)]
#[test]
fn outputs_follow_links_or_refuse_them() {
    use std::os::unix::fs::symlink;
    let folder = folder();
    let at = |name: &str| folder.path().join(name);
    symlink("none.png", at("dangling.png")).unwrap();
    symlink("texture.png", at("link.png")).unwrap();
    symlink("other.png", at("good.png")).unwrap();
    refused(
        folder.path(),
        &["render", "s.svg", "-o", "dangling.png", SMALL],
        &["dangling.png", "leads nowhere"],
    );
    refused(
        folder.path(),
        &["render", "s.svg", "-o", "link.png", SMALL],
        &["link.png", "read"],
    );
    done(folder.path(), &["render", "s.svg", "-o", "good.png", SMALL]);
    assert!(at("good.png").is_symlink(), "the link stays");
    assert_eq!(
        image::image_dimensions(at("other.png")).unwrap(),
        (40, 30),
        "what it leads to"
    );
}
