//! `rasterscope diff` from outside: its numbers, its picture, its exit status.

use std::fs;
use std::path::Path;
use std::process::{Command, Output};

use rasterscope::compare::{decode_picture, encoded_size};
use rasterscope::figure::save_png;
use rasterscope::raster::Framebuffer;

use crate::support::refusal::assert_refused;

fn run(folder: &Path, arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_rasterscope"))
        .current_dir(folder)
        .arg("diff")
        .args(arguments)
        .output()
        .unwrap()
}

/// A folder with a grey `a.png`; `b.png`, where two pixels differ; `small.png`; and files that are no pictures.
fn folder() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    let mut frame = Framebuffer::new(40, 30);
    frame.pixels_mut().fill(0xFF64_6464);
    save_png(&frame, &folder.path().join("a.png")).unwrap();
    frame.pixels_mut()[3 * 40 + 7] = 0xFF97_6464;
    frame.pixels_mut()[20 * 40 + 30] = 0xFF64_6162;
    save_png(&frame, &folder.path().join("b.png")).unwrap();
    save_png(&Framebuffer::new(4, 3), &folder.path().join("small.png")).unwrap();
    fs::write(folder.path().join("notes.txt"), "no picture").unwrap();
    let half = fs::read(folder.path().join("a.png")).unwrap();
    fs::write(folder.path().join("half.png"), &half[..half.len() / 2]).unwrap();
    folder
}

fn json(output: &Output) -> serde_json::Value {
    serde_json::from_slice(&output.stdout).unwrap()
}

#[test]
fn diff_decodes_pictures_as_they_are_stored() {
    let pixels = [[1, 2, 3, 255], [200, 100, 50, 128], [9, 9, 9, 0]];
    let mut bytes = Vec::new();
    let encoder = image::codecs::png::PngEncoder::new(&mut bytes);
    let color = image::ExtendedColorType::Rgba8;
    image::ImageEncoder::write_image(encoder, pixels.as_flattened(), 3, 1, color).unwrap();
    assert_eq!(encoded_size(&bytes).unwrap(), [3, 1], "size");
    let frame = decode_picture(&bytes).unwrap();
    assert_eq!(
        frame.pixels(),
        [0xFF01_0203, 0x80C8_6432, 0],
        "straight, nothing hidden"
    );
    assert!(decode_picture(b"<svg/>").is_err(), "no picture");
    assert!(decode_picture(&bytes[..bytes.len() / 2]).is_err(), "half a picture");
}

#[test]
fn diff_answers_by_its_exit_status() {
    let folder = folder();
    let status = |arguments: &[&str]| run(folder.path(), arguments).status.code();
    assert_eq!(status(&["a.png", "a.png"]), Some(0), "equal");
    assert_eq!(status(&["a.png", "b.png"]), Some(1), "different");
    assert_eq!(
        status(&["a.png", "b.png", "--tolerance", "50"]),
        Some(1),
        "by 51 levels"
    );
    assert_eq!(
        status(&["a.png", "b.png", "--tolerance", "51"]),
        Some(0),
        "within the tolerance"
    );
}

#[test]
fn diff_prints_json_of_its_documented_shape() {
    let folder = folder();
    let output = run(
        folder.path(),
        &[
            "a.png",
            "b.png",
            "--json",
            "--tolerance",
            "4",
            "-o",
            "d.png",
            "--normalize",
        ],
    );
    let report = json(&output);
    for (name, value) in [
        ("version", 1),
        ("width", 40),
        ("height", 30),
        ("channels", 3),
        ("tolerance", 4),
        ("differing_pixels", 2),
        ("pixels_beyond_tolerance", 1),
    ] {
        assert_eq!(report[name], value, "{name} of {report}");
    }
    assert_eq!(report["within_tolerance"], false, "{report}");
    assert_eq!(
        report["largest"]["red"],
        serde_json::json!({"level": 51, "x": 7, "y": 3}),
        "red"
    );
    assert_eq!(
        report["largest"]["green"],
        serde_json::json!({"level": 3, "x": 30, "y": 20}),
        "green"
    );
    assert!(report["largest"]["alpha"].is_null(), "alpha is equal");
    // 51 + 3 + 2 levels, squares 2601 + 9 + 4, among 3600 channels.
    let near = |name: &str, value: f64| {
        let found = report[name].as_f64().unwrap();
        assert!((found - value).abs() < 1e-9, "{name} is {found} instead of {value}");
    };
    near("mae", 56.0 / 3600.0);
    near("rmse", (2614.0_f64 / 3600.0).sqrt());
    near("psnr", 10.0 * (65_025.0_f64 * 3600.0 / 2614.0).log10());
    for (name, low, high) in [("ssim", 0.9, 0.9999), ("flip", 1e-6, 0.1)] {
        assert!(
            (low..high).contains(&report[name].as_f64().unwrap()),
            "{name} of {report}"
        );
    }
    assert_eq!(
        report["places"][0],
        serde_json::json!({"x": 7, "y": 3, "levels": [51, 0, 0, 0]}),
        "the worst"
    );
    assert_eq!(report["places"][1]["x"], 30, "the next");
    assert_eq!(report["picture"]["mode"], "absolute", "{report}");
    assert_eq!(
        report["picture"]["gain"], 5.0,
        "51 levels are a fifth of white: {report}"
    );
    let equal = json(&run(folder.path(), &["a.png", "a.png", "--json"]));
    assert!(equal["psnr"].is_null() && equal["picture"].is_null(), "{equal}");
    assert_eq!(
        (&equal["ssim"], &equal["flip"]),
        (&1.0.into(), &0.0.into()),
        "equal pictures"
    );
}

#[test]
fn diff_prints_text_that_fits_a_terminal() {
    let folder = folder();
    let text = String::from_utf8(run(folder.path(), &["a.png", "b.png", "--tolerance", "4"]).stdout).unwrap();
    for words in [
        "2 of 1200 (0.17 %)",
        "51 levels, first at (7, 3)",
        "MAE",
        "RMSE",
        "PSNR",
        "SSIM",
        "FLIP",
        "(30, 20)",
    ] {
        assert!(text.contains(words), "{words} in {text}");
    }
    assert!(
        text.lines().all(|line| line.chars().count() <= 80),
        "80 columns: {text}"
    );
    let text = String::from_utf8(run(folder.path(), &["a.png", "a.png"]).stdout).unwrap();
    assert!(
        text.contains("equal: all pixels, in 8 bits per channel.\n") && text.contains("infinite"),
        "{text}"
    );
    // Neither is compared, and the text says so.
    for (name, red) in [("c.png", 1), ("d.png", 2)] {
        let pixel = image::Rgba([red, 0, 0, 0_u16]);
        let picture = image::ImageBuffer::from_pixel(4, 3, pixel);
        image::DynamicImage::ImageRgba16(picture)
            .save(folder.path().join(name))
            .unwrap();
    }
    let text = String::from_utf8(run(folder.path(), &["c.png", "d.png"]).stdout).unwrap();
    assert!(
        text.contains("in 8 bits per channel.\nColours of transparent pixels are not compared."),
        "{text}"
    );
}

#[test]
fn diff_saves_each_kind_of_picture() {
    let folder = folder();
    let mut pictures = Vec::new();
    for mode in ["signed", "absolute", "relative", "squared"] {
        let output = run(
            folder.path(),
            &["a.png", "b.png", "-o", "d.png", "--mode", mode, "--gain", "2"],
        );
        assert_eq!(output.status.code(), Some(1), "{mode}: {output:?}");
        let picture = image::open(folder.path().join("d.png")).unwrap().into_rgba8();
        assert_eq!(picture.dimensions(), (40, 30), "{mode}");
        let [equal, worst] = [[0, 0], [7, 3]].map(|[x, y]| picture.get_pixel(x, y).0);
        assert_ne!(equal, worst, "{mode} shows the difference");
        pictures.push(worst);
    }
    pictures.sort_unstable();
    pictures.dedup();
    assert_eq!(pictures.len(), 4, "four measures, four colours: {pictures:?}");
}

#[test]
fn diff_of_a_scene_guesses_the_cause() {
    let folder = folder();
    let scene = r##"<svg width="40" height="30"><polygon points="2,3 37,9 11,28" fill="#123456"/></svg>"##;
    fs::write(folder.path().join("a.svg"), scene).unwrap();
    let drawn = Command::new(env!("CARGO_BIN_EXE_rasterscope"))
        .current_dir(folder.path())
        .args([
            "render",
            "a.svg",
            "-o",
            "moved.png",
            "--size",
            "120x90",
            "--view",
            "19.875,14.875,4",
        ])
        .args(["--sample-rate", "4"])
        .status();
    assert!(drawn.unwrap().success(), "drawn half a pixel further");
    let options = ["a.svg", "moved.png", "--view", "20,15,4", "--sample-rate", "4"];
    let output = run(folder.path(), &options);
    let text = String::from_utf8(output.stdout).unwrap();
    assert_eq!(output.status.code(), Some(1), "{text}");
    assert!(text.contains("shifted by +0.5 pixels across and +0.5 down"), "{text}");
    assert!(
        text.lines().all(|line| line.chars().count() <= 80),
        "80 columns: {text}"
    );
    let report = json(&run(folder.path(), &[&options[..], &["--json"]].concat()));
    assert!(report["guess"]["explained"].as_f64().unwrap() > 0.9, "{report}");
    let same = [
        &["a.svg", "moved.png", "--view", "19.875,14.875,4"],
        &options[4..],
        &["--json"],
    ]
    .concat();
    let output = run(folder.path(), &same);
    assert_eq!(output.status.code(), Some(0), "its own picture: {output:?}");
    assert!(json(&output)["guess"].is_null(), "nothing to explain");
}

#[test]
fn diff_answers_mistakes_in_one_line() {
    let folder = folder();
    for (arguments, words) in [
        (&["a.png", "nowhere.png"][..], &["nowhere.png", "no such file"][..]),
        (&["notes.txt", "a.png"], &["notes.txt", "PNG"]),
        (&["a.png", "half.png"], &["half.png", "PNG"]),
        (&["a.png", "."], &[".", "not a regular file"]),
        (&["a.png", "small.png"], &["small.png: 4 x 3", "a.png has 40 x 30"]),
        (&["a.png", "b.png", "-o", "d.gif"], &["d.gif", ".png"]),
        (&["a.png", "b.png", "-o", "no/such/d.png"], &["no/such/d.png"]),
        (&["a.png", "b.svg"], &["b.svg", "render"]),
        (&["a.svg", "a.png"], &["a.svg"]),
        (&["a.png"], &["<B>"]),
        (&["a.png", "b.png", "--gain", "-1"], &["gain"]),
        (&["a.png", "b.png", "--mode", "signed"], &["--output"]),
        (&["a.png", "b.png", "--normalize"], &["--output"]),
        (
            &["a.png", "b.png", "--sample-rate", "16"],
            &["--sample-rate: of two pictures none is drawn", "in place of a.png"],
        ),
        (&["a.png", "b.png", "--view", "canvas"], &["--view: of two pictures"]),
    ] {
        assert_refused(&run(folder.path(), arguments), arguments, words);
    }
}

#[test]
fn diff_refuses_more_pixels_than_memory_is_meant_for() {
    let folder = folder();
    for name in ["a.png", "b.png"] {
        let mut bytes = fs::read(folder.path().join(name)).unwrap();
        // Width and height in the header, and its checksum.
        for (i, byte) in [0, 0, 64, 0, 0, 0, 64, 0].into_iter().enumerate() {
            bytes[16 + i] = byte;
        }
        let checksum = crc32(&bytes[12..29]);
        bytes[29..33].copy_from_slice(&checksum.to_be_bytes());
        fs::write(folder.path().join(format!("large-{name}")), bytes).unwrap();
    }
    let arguments = ["large-a.png", "large-b.png"];
    let words = [
        "large-b.png: 16384 x 16384 pixels",
        "100000000",
        "--max-pixels 268435456",
    ];
    assert_refused(&run(folder.path(), &arguments), &arguments, &words);
    let small = ["a.png", "b.png", "--max-pixels", "1199"];
    assert_refused(&run(folder.path(), &small), &small, &["40 x 30", "--max-pixels 1200"]);
    let enough = run(
        folder.path(),
        &["a.png", "b.png", "--max-pixels", "1200", "-o", "d.png"],
    );
    assert_eq!(enough.status.code(), Some(1), "they differ: {enough:?}");
}

/// The checksum of PNG chunks, bit by bit.
fn crc32(bytes: &[u8]) -> u32 {
    let rest = bytes.iter().fold(u32::MAX, |rest, byte| {
        (0..8).fold(rest ^ u32::from(*byte), |rest, _| {
            if rest & 1 == 1 {
                (rest >> 1) ^ 0xEDB8_8320
            } else {
                rest >> 1
            }
        })
    });
    !rest
}
