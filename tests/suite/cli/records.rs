//! Pictures that tell how they were made: what their files carry, and that it brings the picture and its state back.

use std::fs;
use std::path::Path;

use rasterscope::figure::{Record, encode_png};
use rasterscope::raster::Framebuffer;
use rasterscope::scene::FileDigest;

use crate::support::program::{done, run};
use crate::support::refusal::assert_refused;

const SCENE: &str = r##"<svg xmlns="http://www.w3.org/2000/svg" width="40" height="30">
  <polygon points="2,3 37,9 11,28" fill="#123456"/>
  <image href="t.png" x="2" y="2" width="20" height="20"/>
</svg>"##;

fn texture(color: u32) -> Vec<u8> {
    let mut picture = Framebuffer::new(4, 4);
    picture.pixels_mut().fill(color);
    picture.pixels_mut()[5] = 0xff00_0000;
    encode_png(&picture, None).unwrap()
}

/// A folder with a scene, its texture, and a folder for pictures.
fn workplace() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    fs::create_dir(folder.path().join("out")).unwrap();
    fs::write(folder.path().join("a.svg"), SCENE).unwrap();
    fs::write(folder.path().join("t.png"), texture(0xffff_8000)).unwrap();
    folder
}

fn record(path: &Path) -> Record {
    Record::of_file(path)
        .unwrap()
        .unwrap_or_else(|| panic!("{} has a record", path.display()))
}

#[rustfmt::skip]
const RENDER: [&str; 22] = [
    "render", "a.svg", "-o", "out/a.png", "--size", "90x70", "--view=20,15,2.5,30", "--sample-rate", "9",
    "--shading-rate", "centroid", "--coverage", "exact", "--pixel-sampling", "mitchell", "--texture-wrap", "repeat",
    "--post-process", "smaa", "--background", "#ff8000", "--threads=1",
];

#[test]
fn record_tells_scene_textures_and_settings() {
    let work = workplace();
    done(work.path(), &RENDER);
    let told = record(&work.path().join("out/a.png"));
    assert_eq!(told.version, 1, "the shape");
    let line = "rasterscope render a.svg -o out/a.png --size 90x70 --view=20,15,2.5,30 --sample-rate 9 \
                --shading-rate centroid --coverage exact --pixel-sampling mitchell --texture-wrap repeat --post-process smaa \
                --background '#ff8000'";
    assert_eq!(told.command_line, line, "threads make no difference");
    let scene = told.scene.unwrap();
    let digest = |name: &str| FileDigest::of(&fs::read(work.path().join(name)).unwrap()).to_string();
    assert_eq!(
        (scene.address.as_str(), scene.sha256),
        ("a.svg", digest("a.svg")),
        "the scene"
    );
    assert_eq!(scene.beside.as_deref(), Some("../a.svg"), "from the picture");
    assert_eq!(
        (told.textures[0].address.as_str(), &told.textures[0].sha256),
        ("t.png", &digest("t.png")),
        "one texture"
    );
    let settings: Vec<_> = told
        .settings
        .iter()
        .map(|(name, value)| format!("{name} {value}"))
        .collect();
    assert_eq!(
        settings,
        [
            "background #ff8000",
            "coverage exact",
            "pixel-sampling mitchell",
            "post-process smaa",
            "sample-rate 9",
            "shading-rate centroid",
            "texture-wrap repeat"
        ],
        "what is not default"
    );
    assert_eq!(
        (told.view.as_str(), told.size),
        ("20,15,2.5,30", [90, 70]),
        "what is seen"
    );
}

#[test]
fn rerun_finds_every_pixel_again_from_anywhere() {
    let work = workplace();
    done(work.path(), &RENDER);
    for threads in ["1", "3"] {
        let said = done(work.path(), &["rerun", "out/a.png", "--check", "--threads", threads]);
        assert_eq!(said.trim(), "out/a.png: the same, all 6300 pixels", "{threads} threads");
    }
    let said = done(&work.path().join("out"), &["rerun", "a.png", "--check"]);
    assert!(said.contains("the same"), "from another folder: {said}");
    done(work.path(), &["rerun", "out/a.png", "-o", "out/b.png"]);
    let [a, b] = ["out/a.png", "out/b.png"].map(|name| image::open(work.path().join(name)).unwrap().into_rgba8());
    assert!(a == b, "written again");
    assert!(
        record(&work.path().join("out/b.png"))
            .command_line
            .contains("-o out/b.png"),
        "with its own record"
    );
}

#[test]
fn rerun_names_the_typefaces_that_a_picture_was_drawn_with() {
    let folder = tempfile::tempdir().unwrap();
    let letters = "<svg xmlns='http://www.w3.org/2000/svg' width='30' height='20'><text y='15'>Ab</text></svg>";
    fs::write(folder.path().join("t.svg"), letters).unwrap();
    fs::write(folder.path().join("f.ttf"), epaint_default_fonts::HACK_REGULAR).unwrap();
    done(
        folder.path(),
        &["render", "t.svg", "-o", "t.png", "--size", "30x20", "--font", "f.ttf"],
    );
    let told = record(&folder.path().join("t.png"));
    assert!(told.command_line.ends_with("--font f.ttf"), "{}", told.command_line);
    let note = "t.png: drawn with --font f.ttf; give it for the same letters";
    let told = |arguments: &[&str]| String::from_utf8_lossy(&run(folder.path(), arguments).stderr).contains(note);
    assert!(told(&["rerun", "t.png", "--check"]), "records choose no typefaces");
    assert!(
        !told(&["rerun", "t.png", "--check", "--font", "f.ttf"]),
        "they were given"
    );
}

#[test]
fn rerun_tells_how_much_differs_and_why() {
    let work = workplace();
    done(work.path(), &RENDER);
    fs::write(work.path().join("t.png"), texture(0xff00_80ff)).unwrap();
    let output = run(work.path(), &["rerun", "out/a.png", "--check"]);
    let said = String::from_utf8(output.stdout).unwrap();
    assert_eq!(output.status.code(), Some(1), "{said}");
    assert!(
        said.starts_with("out/a.png: differs in ") && said.contains(" of 6300 pixels; the texture t.png changed"),
        "{said}"
    );
    fs::write(work.path().join("a.svg"), SCENE.replace("11,28", "12,28")).unwrap();
    let output = run(work.path(), &["rerun", "out/a.png", "--check"]);
    let said = String::from_utf8(output.stdout).unwrap();
    assert!(
        said.contains("the scene ") && said.contains(" and one more file changed since"),
        "{said}"
    );
    let output = run(work.path(), &["render", "out/a.png", "-o", "out/c.png"]);
    let warned = String::from_utf8(output.stderr).unwrap();
    assert!(
        output.status.success() && warned.lines().count() == 1 && warned.contains("changed since"),
        "{warned}"
    );
    // A change that no pixel shows, and nothing is guessed about what was compared.
    fs::write(work.path().join("t.png"), texture(0xffff_8000)).unwrap();
    fs::write(work.path().join("a.svg"), format!("{SCENE}\n")).unwrap();
    let said = done(work.path(), &["rerun", "out/a.png", "--check"]);
    assert!(
        said.contains("the same, all 6300 pixels, although the scene ") && !said.contains("may differ"),
        "{said}"
    );
    fs::write(work.path().join("a.svg"), SCENE).unwrap();
    fs::remove_file(work.path().join("t.png")).unwrap();
    let output = run(work.path(), &["rerun", "out/a.png", "--check"]);
    let said = String::from_utf8(output.stdout).unwrap();
    assert!(
        said.contains(" pixels; the texture t.png is gone since out/a.png was made") && !said.contains("SHA-256"),
        "{said}"
    );
}

#[test]
fn rerun_names_a_texture_that_was_missing_then() {
    let work = workplace();
    fs::remove_file(work.path().join("t.png")).unwrap();
    let drawn = run(work.path(), &["render", "a.svg", "-o", "b.png", "--size", "60x60"]);
    assert!(drawn.status.success(), "a checker: {drawn:?}");
    fs::write(work.path().join("t.png"), texture(0xffff_8000)).unwrap();
    let output = run(work.path(), &["rerun", "b.png", "--check"]);
    let said = String::from_utf8(output.stdout).unwrap();
    assert_eq!(output.status.code(), Some(1), "{said}");
    let why = "of 3600 pixels; the texture t.png could not be read when b.png was made, and can be now";
    assert!(said.contains(why), "{said}");
}

#[test]
fn rerun_refuses_what_tells_nothing() {
    let work = workplace();
    fs::write(work.path().join("plain.png"), texture(0xff00_0000)).unwrap();
    let refused = |arguments: &[&str], words: &[&str]| assert_refused(&run(work.path(), arguments), arguments, words);
    refused(&["rerun", "plain.png", "--check"], &["plain.png", "no record", "give"]);
    refused(&["rerun", "missing.png", "--check"], &["missing.png"]);
    let hostile = [
        (vec!["view", "--do", "shot /tmp/x.png"], "drawn again"),
        (vec!["render", "a.svg", "-o", "b.png", "--size", "0x5"], "size"),
        (vec!["--help"], "help"),
        (vec![], "help"),
        (vec!["render", "nowhere.svg", "-o", "b.png"], "nowhere.svg"),
    ];
    for (arguments, word) in hostile {
        let record = Record {
            version: 1,
            arguments: arguments.into_iter().map(str::to_owned).collect(),
            ..Record::default()
        };
        let bytes = encode_png(&Framebuffer::new(2, 2), Some(&record)).unwrap();
        fs::write(work.path().join("hostile.png"), bytes).unwrap();
        refused(&["rerun", "hostile.png", "--check"], &[word]);
    }
    done(work.path(), &["render", "a.svg", "-o", "out/s.png", "--size", "30x20"]);
    fs::rename(work.path().join("a.svg"), work.path().join("b.svg")).unwrap();
    refused(
        &["rerun", "out/s.png", "--check"],
        &["out/s.png: its scene a.svg is not there", "--scene FILE"],
    );
    refused(
        &["render", "out/s.png", "-o", "c.png"],
        &["out/s.png: its scene a.svg", "--scene FILE"],
    );
    done(work.path(), &["rerun", "out/s.png", "--check", "--scene", "b.svg"]);
    done(work.path(), &["diff", "plain.png", "plain.png", "-o", "d.png"]);
    refused(
        &["render", "d.png", "-o", "c.png"],
        &["d.png: this is the difference of two pictures, from which no scene comes back; give a scene"],
    );
    let told = record(&work.path().join("d.png"));
    assert_eq!(
        told.command_line, "rasterscope diff plain.png plain.png -o d.png --mode absolute --gain=1",
        "its own"
    );
}

#[test]
fn rerun_draws_differences_and_slides_too() {
    let work = workplace();
    done(work.path(), &RENDER);
    let said = |name: &str| run(work.path(), &["rerun", name, "--check", "--threads", "1"]);
    let holds = |name: &str| {
        let output = said(name);
        let text = String::from_utf8_lossy(&output.stdout).into_owned();
        assert!(
            output.status.success() && text.contains("the same"),
            "{name}: {output:?}"
        );
    };
    // A drawing of the scene against its picture at another rate, and two pictures.
    let diff = [
        "diff",
        "a.svg",
        "out/a.png",
        "-o",
        "d.png",
        "--gain=8",
        "--sample-rate=1",
    ];
    assert_eq!(run(work.path(), &diff).status.code(), Some(1), "they differ");
    holds("d.png");
    done(
        work.path(),
        &["diff", "out/a.png", "out/a.png", "-o", "e.png", "--normalize"],
    );
    holds("e.png");
    let slides = ["lesson", "lesson:anisotropy", "--slides", "s", "--size", "480x300"];
    let text =
        fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("assets/lessons/anisotropy.toml")).unwrap();
    let steps = text.matches("[[step]]").count();
    done(work.path(), &[&slides[..], &["--step", "2"]].concat());
    let names: Vec<_> = fs::read_dir(work.path().join("s"))
        .unwrap()
        .map(|item| item.unwrap().file_name())
        .collect();
    assert_eq!(names, ["02.png"], "of {steps} steps");
    holds("s/02.png");
    let told = record(&work.path().join("s/02.png"));
    assert!(
        told.command_line.ends_with(" --size 480x300 --step=2"),
        "{}",
        told.command_line
    );
    let refused = |more: &[&str], words: &[&str]| {
        let arguments = [&slides[..], more].concat();
        assert_refused(&run(work.path(), &arguments), &arguments, words);
    };
    refused(&["--step", "99"], &["step 99", &steps.to_string()]);
    refused(&["--step", "0"], &["--step"]);
    // What is compared changed.
    fs::write(work.path().join("out/a.png"), texture(0xff00_00ff)).unwrap();
    let output = said("e.png");
    assert_eq!(output.status.code(), Some(1), "of another size now");
    let text = String::from_utf8_lossy(&output.stdout).into_owned();
    assert!(
        text.contains("out/a.png and one more file changed since e.png was made"),
        "{text}"
    );
}

#[test]
fn rerun_finds_what_differences_and_slides_are_made_from() {
    let work = workplace();
    let lesson = "title = \"T\"\n[[step]]\nscene = \"a.svg\"\ntext = \"See.\"\n";
    fs::write(work.path().join("l.toml"), lesson).unwrap();
    let at = |name: &str| work.path().join(name);
    done(work.path(), &["render", "a.svg", "-o", "a.png", "--size", "40x30"]);
    done(work.path(), &["diff", "a.png", "a.png", "-o", "out/two.png"]);
    done(&at("out"), &["diff", "../a.svg", "../a.png", "-o", "scene.png"]);
    done(
        work.path(),
        &["lesson", "l.toml", "--slides", "out/s", "--size", "480x300"],
    );
    let told = record(&at("out/s/01.png")).inputs;
    let beside: Vec<_> = told.iter().map(|input| input.beside.as_deref()).collect();
    assert_eq!(beside, [Some("../../l.toml"), Some("../../a.svg")], "lesson and scene");
    assert_eq!(
        record(&at("out/scene.png")).textures[0].address,
        "t.png",
        "of the scene"
    );
    let elsewhere = tempfile::tempdir().unwrap();
    let pictures = ["out/two.png", "out/scene.png", "out/s/01.png"];
    let check = |name: &str| run(elsewhere.path(), &["rerun", at(name).to_str().unwrap(), "--check"]);
    for name in pictures {
        let said = String::from_utf8(check(name).stdout).unwrap();
        assert!(said.contains("the same, all "), "{name} from another folder: {said}");
    }
    // Nothing that is seen changes.
    fs::write(at("a.svg"), format!("{SCENE}\n")).unwrap();
    for name in &pictures[1..] {
        let said = String::from_utf8(check(name).stdout).unwrap();
        assert!(
            said.contains(", although ") && said.contains("a.svg changed since"),
            "{name}: {said}"
        );
    }
    let scene = at("out/two.png");
    let scene = ["rerun", scene.to_str().unwrap(), "--check", "--scene", "a.svg"];
    assert_refused(&run(work.path(), &scene), &scene, &["--scene"]);
    fs::remove_file(at("a.png")).unwrap();
    for name in &pictures[..2] {
        let words = ["two.png: it was made from", "scene.png: it was made from"];
        let output = check(name);
        let told = String::from_utf8_lossy(&output.stderr).into_owned();
        assert!(
            output.status.code() == Some(2)
                && words.iter().any(|word| told.contains(word))
                && told.contains("not there"),
            "{name}: {told}"
        );
    }
}

#[test]
fn rerun_says_that_a_texture_of_a_slide_changed() {
    let work = workplace();
    let lesson = "title = \"T\"\n[[step]]\nscene = \"a.svg\"\ntext = \"See.\"\n";
    fs::write(work.path().join("l.toml"), lesson).unwrap();
    done(work.path(), &["lesson", "l.toml", "--slides", "s", "--size", "480x300"]);
    let textures = record(&work.path().join("s/01.png")).textures;
    assert_eq!(textures.len(), 1, "{textures:?}");
    let check = || String::from_utf8(run(work.path(), &["rerun", "s/01.png", "--check"]).stdout).unwrap();
    assert!(check().contains("the same, all "), "{}", check());
    fs::write(work.path().join("t.png"), texture(0xff00_80ff)).unwrap();
    let said = check();
    assert!(
        said.contains("differs in ") && said.contains("; the texture t.png changed since"),
        "{said}"
    );
}

/// What `help records` tells of pictures that are not compared.
#[test]
fn rerun_of_what_cannot_be_compared_is_status_2() {
    let work = workplace();
    done(
        work.path(),
        &[
            "board",
            "a.svg",
            "--size=64x64",
            "--frames=1",
            "--vary=sample-rate",
            "-o",
            "b.png",
        ],
    );
    let sweep = [
        "sweep",
        "a.svg",
        "--size=32x32",
        "--sample-rate=1,4",
        "--frames=1",
        "--csv=c.csv",
    ];
    done(work.path(), &sweep);
    for (name, again) in [("b.png", Some(0)), ("c.png", Some(2))] {
        let rerun = |more: &[&str]| run(work.path(), &[&["rerun", name], more].concat());
        assert_eq!(rerun(&["--check"]).status.code(), Some(2), "{name}");
        assert_eq!(rerun(&["-o", "again.png"]).status.code(), again, "{name}");
    }
}

#[test]
fn render_takes_a_picture_for_its_scene_and_settings() {
    let work = workplace();
    done(work.path(), &RENDER);
    done(
        work.path(),
        &["render", "out/a.png", "-o", "b.png", "--sample-rate", "4"],
    );
    let told = record(&work.path().join("b.png"));
    let line = "rasterscope render out/../a.svg -o b.png --size 90x70 --view=20,15,2.5,30 --sample-rate 4 \
                --shading-rate centroid --coverage exact --pixel-sampling mitchell --texture-wrap repeat --post-process smaa \
                --background '#ff8000'";
    assert_eq!(told.command_line, line, "what is written counts more");
}

#[test]
fn insets_are_part_of_the_picture() {
    let work = workplace();
    let inset = ["--inset", "u12,12:9@12:auto", "--inset", "260,20:8@10:bottom-left"];
    let draw = [&["render", "a.svg", "-o", "out/i.png", "--size", "300x280"], &inset[..]].concat();
    done(work.path(), &draw);
    let told = record(&work.path().join("out/i.png"));
    assert!(told.command_line.ends_with(&inset.join(" ")), "{}", told.command_line);
    let said = done(work.path(), &["rerun", "out/i.png", "--check", "--threads", "2"]);
    assert!(said.contains("the same"), "{said}");
    let refused = |inset: &str, words: &[&str]| {
        let arguments = [
            "render",
            "a.svg",
            "-o",
            "out/no.png",
            "--size",
            "200x100",
            "--inset",
            inset,
        ];
        assert_refused(&run(work.path(), &arguments), &arguments, words);
        assert!(!work.path().join("out/no.png").exists(), "nothing is written");
    };
    refused("200,5", &["--inset 200,5", "outside", "200x100"]);
    refused("u-90,5", &["outside"]);
    refused("100,50:64@96", &["no room", "smaller"]);
    refused("190,10:8@4:top-right", &["no room", "its own subject"]);
}

#[cfg(feature = "window")]
#[test]
fn window_comes_back_from_a_picture() {
    let work = workplace();
    done(work.path(), &RENDER);
    let settings = |name: &str| {
        let told = record(&work.path().join(name));
        assert!(
            told.differs.is_some_and(|differs| differs.contains("window")),
            "panels are no part of it"
        );
        (told.scene.map(|scene| scene.sha256), told.view, told.settings)
    };
    let expected = {
        let told = record(&work.path().join("out/a.png"));
        (told.scene.map(|scene| scene.sha256), told.view, told.settings)
    };
    done(work.path(), &["view", "out/a.png", "--headless", "--do", "shot w.png"]);
    assert_eq!(settings("w.png"), expected, "as an argument");
    assert_eq!(record(&work.path().join("w.png")).size, [90, 70], "with its size");
    done(
        work.path(),
        &["view", "--headless", "--do", "open out/a.png; wait; shot dropped.png"],
    );
    assert_eq!(settings("dropped.png"), expected, "dropped on the gallery");
    done(
        work.path(),
        &[
            "view",
            "dropped.png",
            "--headless",
            "--do",
            "shot again.png",
            "--sample-rate",
            "4",
        ],
    );
    let (_, _, told) = settings("again.png");
    assert_eq!(
        told.get("sample-rate").map(String::as_str),
        Some("4"),
        "what is written counts more"
    );
}
