//! Write-ups from outside: from an empty folder to every figure, each of which can be drawn again.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use glam::DVec2;
use rasterscope::figure::{InsetPlace, InsetSpec, Record, encode_png};
use rasterscope::geometry::View;
use rasterscope::raster::{Framebuffer, SampleRate};
use rasterscope::render::{RenderSettings, draw};
use rasterscope::scene::{DialectChoice, load};

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
    // The first pin was proposed for another picture.
    let pins = "# Where insets look: X,Y:REGION@FACTOR:CORNER, with u before X for canvas units.\n# By `rasterscope writeup`.\nown = \"u4,5:8@4:top-left\"\ntest4 = \"u20,30:8@4:top-left\"\n";
    fs::write(at("out/pins.toml"), pins).unwrap();
    fs::create_dir(at("out/scenes")).unwrap();
    fs::write(
        at("out/scenes/own.svg"),
        "<!-- Another picture; made by rasterscope. -->",
    )
    .unwrap();
    let own = ["--scenes", "svg", "--own", "photo.png", "--robot", "robot.svg"];
    let output = run(folder.path(), &[&["writeup", "-o", "out"], &own[..]].concat());
    assert!(output.status.success(), "{output:?}");
    let told = String::from_utf8(output.stderr).unwrap();
    assert!(
        told.contains("svg: no basic/test7.svg in this folder; the built-in scene"),
        "{told}"
    );
    assert!(
        told.contains("pins.toml: the pin own is proposed anew, for the picture is another"),
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
    assert!(!pins.contains("u4,5:8"), "not that of the other picture: {pins}");
    fs::write(at("pins.toml"), "# mine\ntest4 = \"u9999,9999:16@8:auto\"\n").unwrap();
    let arguments = ["writeup", "-o", "more", "--pins", "pins.toml"];
    assert_refused(
        &run(folder.path(), &arguments),
        &arguments,
        &["rasterscope: pins.toml: line 2: test4: pixel ", "outside"],
    );
    fs::write(at("pins.toml"), "# mine\nown = \"u90000,9:16@8:auto\"\n").unwrap();
    assert_refused(
        &run(folder.path(), &arguments),
        &arguments,
        &["pins.toml: line 2: own: it lies outside the picture", "move it"],
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
    refused(&["-o", "out", "--scenes", "missing"], &["missing", "--scenes"]);
    refused(&["-o", "out", "--scenes", "file"], &["file", "--scenes"]);
    refused(&["-o", "out", "--own", "missing.png"], &["missing.png"]);
    refused(
        &["-o", "out", "--pins", "pins.toml"],
        &["pins.toml: line 1: no figure has the pin test9; the pins are test4, texture, own,"],
    );
    // Somebody else's page: nothing is put beside it.
    fs::create_dir(folder.path().join("page")).unwrap();
    fs::write(folder.path().join("page/index.html"), "mine").unwrap();
    refused(&["-o", "page"], &["page/index.html", "--force"]);
    let names = fs::read_dir(folder.path().join("page")).unwrap().count();
    assert_eq!(names, 1, "no folder of scenes");
}

/// Fat corners and thin slivers; a lower edge that nearly fills a row of pixels at the size of one figure but not of another.
const SLIVERS: &str = r##"<svg xmlns="http://www.w3.org/2000/svg" width="500" height="620">
<polygon fill="#1850D0" points="0,199.772 118,6 239,199.772"/>
<polygon fill="#20A040" points="320,160 440,3 488,131"/>
<polygon fill="#D02020" points="12,290.5 250,281 492,252.5"/>
<polygon fill="#C09020" points="240,560 22,560 22,348"/>
<polygon fill="#B020B0" points="461,612 477,300 470,616"/>
</svg>"##;

/// The squared differences of both pictures in the square of 16 pixels around a place.
fn squared_around(a: &Framebuffer, b: &Framebuffer, [x, y]: [u32; 2]) -> u64 {
    let pixels = (y - 8..y + 8).flat_map(|y| (x - 8..x + 8).map(move |x| (y * a.width() + x) as usize));
    let squared = |i: usize| -> u64 {
        let pairs = a.pixels()[i].to_be_bytes().into_iter().zip(b.pixels()[i].to_be_bytes());
        pairs.map(|(a, b)| u64::from(a.abs_diff(b)).pow(2)).sum()
    };
    pixels.map(squared).sum()
}

#[test]
fn writeup_shows_a_scene_whole_and_looks_where_most_differs() {
    let folder = tempfile::tempdir().unwrap();
    fs::create_dir_all(folder.path().join("svg/basic")).unwrap();
    let file = folder.path().join("svg/basic/test4.svg");
    fs::write(&file, SLIVERS).unwrap();
    let output = run(folder.path(), &["writeup", "-o", "out", "--scenes", "svg"]);
    assert!(output.status.success(), "{output:?}");
    let line = |name: &str| {
        let record = Record::of_file(&folder.path().join("out").join(name)).unwrap().unwrap();
        record.command_line
    };
    let scene = load(&file, DialectChoice::Auto).unwrap();
    let size = [594; 2];
    let view = View::Default.transform(scene.canvas, size);
    let [one, sixteen] = [1, 16].map(|samples| {
        let settings = RenderSettings {
            sample_rate: SampleRate::new(samples).unwrap(),
            ..RenderSettings::default()
        };
        let mut frame = Framebuffer::new(size[0], size[1]);
        draw(&scene, &view, &settings, &mut frame);
        frame
    });
    let supersampling = line("T2_supersampling.png");
    let inset = supersampling
        .split("--inset ")
        .nth(1)
        .unwrap()
        .split(' ')
        .next()
        .unwrap();
    let inset: InsetSpec = inset.parse().unwrap();
    let InsetPlace::User(at) = inset.at else {
        panic!("{supersampling}")
    };
    let at = view.to_pixels(at).floor();
    let chosen = [at.x, at.y].map(|side| (8..586_u32).find(|pixel| f64::from(*pixel) >= side).unwrap());
    let most = (8..586_u32)
        .step_by(2)
        .flat_map(|y| (8..586_u32).step_by(2).map(move |x| [x, y]));
    let most = most.map(|place| squared_around(&one, &sixteen, place)).max().unwrap();
    let found = squared_around(&one, &sixteen, chosen);
    assert!(found * 4 > most * 3, "{found} of {most}: {supersampling}");
    // The rotated view shows all four corners of the canvas.
    let rotated = line("X2_rotated.png");
    let numbers = rotated.split("--view=").nth(1).unwrap().split(' ').next().unwrap();
    let numbers: Vec<f64> = numbers.split(',').map(|number| number.parse().unwrap()).collect();
    let view = View::At {
        center: DVec2::new(numbers[0], numbers[1]),
        scale: numbers[2],
        rotation: numbers[3],
    };
    let view = view.transform(scene.canvas, [800; 2]);
    for corner in [[0.0, 0.0], [500.0, 0.0], [0.0, 620.0], [500.0, 620.0]] {
        let at = view.to_pixels(DVec2::from(corner));
        assert!(
            at.min_element() > 0.0 && at.max_element() < 800.0,
            "{corner:?}: {rotated}"
        );
    }
    assert!(
        line("T6_levels.png").contains("--level-sampling=zero,nearest,linear"),
        "every level sampling"
    );
}
